"""Formulas: expressions with functions and real powers, for problems; coefficients have neither.

The grammar is that of ``garkcli.exact.expression`` with::

    power    = atom [ "**" ["+" | "-"] atom ]
    atom     = ... | FUNCTION "(" sum ")"

where the exponent has to be a constant, and ``pi`` is a name.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from garkcli.errors import ExpressionError, LimitExceeded, did_you_mean
from garkcli.exact.expression import FUNCTIONS as ROOTS
from garkcli.exact.expression import MAX_EXPONENT, Parser
from garkcli.exact.nodes import Chain, Expression, Literal, Power

FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")
"""The functions of formulas besides the roots: each has a derivative wherever it is defined."""
CONSTANTS = ("pi",)
"""Names of formulas that have a value of their own."""
RESERVED = frozenset({*FUNCTIONS, *CONSTANTS, *ROOTS})
"""Names that nothing else can have in a formula."""
_CURES = {
    "ln": "write log(x)",
    "abs": "|x| has no derivative at 0; write sqrt(x**2 + d) with some d > 0",
    "pow": "write x**y",
    "arcsin": "write asin(x)",
    "arccos": "write acos(x)",
    "arctan": "write atan(x)",
}


@dataclass(frozen=True)
class Call(Expression):
    """A function of one argument, one of ``FUNCTIONS``."""

    function: str
    argument: Expression


@dataclass(frozen=True)
class RealPower(Expression):
    """A power whose exponent is not a whole number as it is written."""

    base: Expression
    exponent: Expression


def parse_formula(text: str) -> Expression:
    """Read ``text``.

    Raises:
        ExpressionError: it is not in the grammar; the error knows the offset.
        LimitExceeded: it is, but beyond the limits of ``garkcli.exact.expression``.

    >>> parse_formula("exp(-x)").function
    'exp'
    """
    return _FormulaParser(text).whole()


class _FormulaParser(Parser):
    noun: ClassVar[str] = "formula"
    value_noun: ClassVar[str] = "formula"
    example: ClassVar[str] = "write one, such as p**2/2 - cos(x)"
    cure: ClassVar[str] = "write names, digits 0-9, + - * / ** ( ) and functions such as sin(x)"

    def _raised(self, base: Expression, is_negative: bool, start: int) -> Expression:
        exponent = self._atom()
        if isinstance(exponent, Literal) and exponent.value.q == 1:
            if abs(exponent.value) > MAX_EXPONENT:
                message = f"an exponent is larger than {MAX_EXPONENT}"
                raise LimitExceeded(message, "use a smaller one", exponent.start, exponent.end)
            n = int(exponent.value.p)
            return Power(base, -n if is_negative else n, start=start, end=self.last_end)
        if is_negative:
            exponent = Chain("-", (exponent,), start=exponent.start, end=exponent.end)
        return RealPower(base, exponent, start=start, end=self.last_end)

    def _function(self, name: str, start: int) -> Expression:
        if name == "root_of":
            message = "root_of is for coefficients of methods, not for formulas"
            raise ExpressionError(
                message, "write radicals", start, self.last_end, code="unknown-function"
            )
        if name in ROOTS:
            return super()._function(name, start)
        if name not in FUNCTIONS:
            message = f"{name!r} is not a function of formulas"
            raise ExpressionError(
                message, _cure_of(name), start, self.last_end, code="unknown-function"
            )
        opened = self.start
        self._advance()
        argument = self._sum()
        self._expect(")", opened)
        return Call(name, argument, start=start, end=self.last_end)


def _cure_of(name: str) -> str:
    """What to write instead of a function that is not known."""
    if name in _CURES:
        return _CURES[name]
    known = (*FUNCTIONS, "sqrt")
    near = did_you_mean(name, known)
    if near.startswith("did"):
        return near
    return f"write products with *, as in {name}*(x); functions: {', '.join(known)}"
