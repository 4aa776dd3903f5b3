"""The nodes of expressions; only formulas of problems have calls and real powers."""

from __future__ import annotations

from flint import fmpq

from garkcli.errors import UndefinedValue
from garkcli.frozen import FrozenBut


class Expression(FrozenBut, kw_only=True):
    """A node; comparisons ignore its offsets, and the decimals of the polynomial of a root."""

    besides = frozenset({"start", "end", "decimals"})

    start: int = 0
    end: int = 0
    decimals: tuple[Literal, ...] = ()


def divided_by_zero(at: Expression, cure: str = "write another divisor") -> UndefinedValue:
    return UndefinedValue("division by zero", cure, at.start, at.end, code="division-by-zero")


class Literal(Expression):
    """A rational number; ``text`` is its notation if it was parsed."""

    besides = Expression.besides | {"text"}

    value: fmpq
    text: str = ""


def is_decimal(literal: Literal) -> bool:
    return "." in literal.text or "e" in literal.text.lower()


class Name(Expression):
    name: str


class Chain(Expression):
    """Operands joined from left to right by ``+ -`` or ``* /``, each preceded by a sign. It is
    flat: the depth of an expression is that of its parentheses.
    """

    signs: str
    operands: tuple[Expression, ...]


class Power(Expression):
    base: Expression
    exponent: int


class Root(Expression):
    """The real root of ``radicand`` of index ``index`` ≥ 2."""

    radicand: Expression
    index: int


class AlgebraicRoot(Expression):
    """The real root of index ``number``, in ascending order, of an irreducible polynomial over ℤ.
    Its degree is 3 or more; ``coefficients`` begin with the lowest, the leading one positive.
    """

    coefficients: tuple[int, ...]
    number: int


class Call(Expression):
    function: str
    argument: Expression


class RealPower(Expression):
    """A power whose exponent is not written as an integer."""

    base: Expression
    exponent: Expression


def parts(expression: Expression) -> tuple[Expression, ...]:
    match expression:
        case Chain(operands=operands):
            return operands
        case Power(base=base):
            return (base,)
        case RealPower(base=base, exponent=exponent):
            return (base, exponent)
        case Root(radicand=radicand):
            return (radicand,)
        case Call(argument=argument):
            return (argument,)
    return ()
