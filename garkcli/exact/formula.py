"""Formulas of problems: expressions with functions and real powers, which coefficients do not have.

The grammar is that of ``garkcli.exact.expression`` with::

    power    = atom [ "**" ["+" | "-"] atom ]
    atom     = ... | FUNCTION "(" sum ")"

where the exponent has to be a constant, and ``pi`` is a name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar, TypeAlias

from flint import arb, fmpq

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue, did_you_mean, nearest
from garkcli.exact import nodes
from garkcli.exact.domain import MAX_BITS, too_many_bits
from garkcli.exact.enclosing import OPERATIONS, integer_power
from garkcli.exact.expression import FUNCTIONS as ROOTS
from garkcli.exact.expression import MAX_EXPONENT, Parser
from garkcli.exact.rewriting import format_expression

FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")
"""Functions of formulas besides roots, differentiable wherever they are defined."""
CONSTANTS = ("pi",)
RESERVED = frozenset({*FUNCTIONS, *CONSTANTS, *ROOTS})
"""Names that variables and parameters cannot have."""
_CURES = {
    "ln": "write log(x)",
    "abs": "|x| has no derivative at 0; write sqrt(x**2 + d) with some d > 0",
    "pow": "write x**y",
    "arcsin": "write asin(x)",
    "arccos": "write acos(x)",
    "arctan": "write atan(x)",
}


def parse_formula(text: str) -> nodes.Expression:
    """Parses ``text``; raises as ``garkcli.exact.expression.parse``.

    >>> parse_formula("exp(-x)").function
    'exp'
    """
    return _FormulaParser(text).whole()


class _FormulaParser(Parser):
    noun: ClassVar[str] = "formula"
    value_noun: ClassVar[str] = "formula"
    example: ClassVar[str] = "write one, such as p**2/2 - cos(x)"
    cure: ClassVar[str] = "write names, digits 0-9, + - * / ** ( ) and functions such as sin(x)"

    def _raised(self, base: nodes.Expression, is_negative: bool, start: int) -> nodes.Expression:
        exponent = self._atom()
        if isinstance(exponent, nodes.Literal) and exponent.value.q == 1:
            if abs(exponent.value) > MAX_EXPONENT:
                message = f"an exponent is larger than {MAX_EXPONENT}"
                raise LimitExceeded(message, "use a smaller one", exponent.start, exponent.end)
            n = int(exponent.value.p)
            return nodes.Power(base, -n if is_negative else n, start=start, end=self.last_end)
        if is_negative:
            exponent = nodes.Chain("-", (exponent,), start=exponent.start, end=exponent.end)
        return nodes.RealPower(base, exponent, start=start, end=self.last_end)

    def _function(self, name: str, start: int) -> nodes.Expression:
        if name == "root_of":
            message = "root_of is for coefficients of methods, not for formulas"
            raise ExpressionError(
                message, "write radicals", start, self.last_end, code="unknown-function"
            )
        if name in ROOTS:
            return super()._function(name, start)
        if name not in FUNCTIONS:
            message = f"{name!r} is not a function of formulas"
            cure, meant = _cure_of(name)
            place = start, self.last_end
            raise ExpressionError(message, cure, *place, code="unknown-function", meant=meant)
        opened = self.start
        self._advance()
        argument = self._sum()
        self._expect(")", opened)
        return nodes.Call(name, argument, start=start, end=self.last_end)


def _cure_of(name: str) -> tuple[str, str]:
    if name in _CURES:
        return _CURES[name], ""
    known = (*FUNCTIONS, "sqrt")
    near = did_you_mean(name, known)
    if near.startswith("did"):
        return near, nearest(name, known)
    return f"write products with *, as in {name}*(x); functions: {', '.join(known)}", ""


Value: TypeAlias = fmpq | arb
MAX_DENOMINATOR = 10_000
FLOAT_BITS = 1000
"""Values are below 2^``FLOAT_BITS``, so that products with floats do not overflow."""
_FUNCTIONS: Mapping[str, Callable[[arb], arb]] = {name: getattr(arb, name) for name in FUNCTIONS}


def value_of(expression: nodes.Expression, names: Mapping[str, Value]) -> Value:
    """Returns the value at the precision of ``flint.ctx``; rational operations are exact.

    Raises UndefinedValue, with offsets, for a value that is not real or not decided: log(-1), 1/0;
    LimitExceeded beyond ``MAX_BITS`` or floats; KeyError for a name without a value.
    """
    match expression:
        case nodes.Literal(value=number):
            return number
        case nodes.Name(name=name):
            return arb.pi() if name == "pi" else names[name]
        case nodes.Chain(signs=signs, operands=operands):
            is_sum = signs[0] in "+-"
            total: Value = fmpq(0) if is_sum else fmpq(1)
            for sign, operand in zip(signs, operands, strict=True):
                total = _applied(sign, total, value_of(operand, names), operand)
                total = _bounded(total, expression)
            return total
        case nodes.Power(base=base, exponent=exponent):
            x = value_of(base, names)
            return _power(x, fmpq(exponent), expression, base)
        case nodes.RealPower(base=base, exponent=exponent):
            x = value_of(base, names)
            return _power(x, exponent_of(exponent, names), expression, base)
        case nodes.Root(radicand=radicand, index=index):
            x = value_of(radicand, names)
            return _root(x, index, expression, radicand)
        case nodes.Call(function=function, argument=argument):
            x = value_of(argument, names)
            return _finite(_FUNCTIONS[function](arb(x)), expression, function, argument, x)
    raise TypeError(f"no expression: {expression!r}")


def exponent_of(expression: nodes.Expression, names: Mapping[str, Value]) -> fmpq:
    """The exponent; UndefinedValue if it is irrational, LimitExceeded if it is too large."""
    value = value_of(expression, names)
    start, end = expression.start, expression.end
    if isinstance(value, arb):
        message = f"the exponent {format_expression(expression)} is not a rational number"
        cure = "write a fraction or a decimal, such as 3/2"
        raise UndefinedValue(message, cure, start, end, code="not-real")
    if abs(value) > MAX_EXPONENT or value.q > MAX_DENOMINATOR:
        fault = f"is beyond {MAX_EXPONENT} or has more than four decimals"
        message = f"the exponent {shown(value)} {fault}"
        raise LimitExceeded(message, "use a smaller or simpler one", start, end)
    return value


def shown(x: Value) -> str:
    if isinstance(x, fmpq) and len(str(x)) <= 12:
        return str(x)
    return f"{float(arb(x)):.6g}"


def _applied(sign: str, left: Value, right: Value, at: nodes.Expression) -> Value:
    if sign == "/":
        _check_divisor(right, at)
    if isinstance(left, arb) or isinstance(right, arb):
        left = arb(left)
        right = arb(right)
    result: Value = OPERATIONS[sign](left, right)
    return result


def _check_divisor(number: Value, at: nodes.Expression) -> None:
    may_be_zero = not number
    if isinstance(number, arb):
        may_be_zero = number.contains(0)
    if not may_be_zero:
        return
    if isinstance(at, nodes.Literal):
        raise nodes.divided_by_zero(at)
    raise nodes.divided_by_zero(at, f"{_cut(format_expression(at))} is 0 here")


def _cut(text: str) -> str:
    if len(text) <= 40:
        return text
    start = text[:39]
    return f"{start}…"


def _power(base: Value, exponent: fmpq, at: nodes.Expression, of: nodes.Expression) -> Value:
    if exponent < 0:
        _check_divisor(base, of)
    if exponent.q == 1:
        n = int(exponent.p)
        if not isinstance(base, fmpq):
            return _bounded(integer_power(base, n), at)
        if base.height_bits() * abs(n) > MAX_BITS:
            raise too_many_bits(at)
        return base**n
    if isinstance(base, fmpq) and not base:
        return fmpq(0)
    if not arb(base) > 0:
        message = f"a power with the exponent {exponent} of {shown(base)}"
        cure = "such powers are of positive numbers"
        raise UndefinedValue(message, cure, at.start, at.end, code="not-real")
    return _bounded(arb(base) ** arb(exponent), at)


def _root(radicand: Value, index: int, at: nodes.Expression, of: nodes.Expression) -> Value:
    is_odd = index % 2 == 1
    if isinstance(radicand, fmpq) and (is_odd or radicand >= 0):
        size = abs(radicand)
        root = fmpq(size.p.root(index), size.q.root(index))
        if root**index == size:
            return -root if radicand < 0 else root
    x = arb(radicand)
    if is_odd and x < 0:
        return -((-x).root(index))
    return _finite(x.root(index), at, "a root" if is_odd else "an even root", of, radicand)


def _finite(
    result: arb, at: nodes.Expression, function: str, of: nodes.Expression, x: Value
) -> Value:
    if not result.is_finite():
        what = _cut(format_expression(of))
        if what != str(x):
            what = f"{what} = {shown(x)}"
        message = f"{function} of {what} is not a real number"
        cure = "choose an argument with a real value"
        raise UndefinedValue(message, cure, at.start, at.end, code="not-real")
    return _bounded(result, at)


def _bounded(number: Value, at: nodes.Expression) -> Value:
    if isinstance(number, fmpq) and number.height_bits() > MAX_BITS:
        raise too_many_bits(at)
    size = abs(arb(number))
    is_large_enough = size > _LEAST or size.contains(0)
    is_within = size < _MOST and is_large_enough
    if not is_within:
        bound = f"above 2^{FLOAT_BITS}"
        if size < 1:
            bound = f"below 2^-{MAX_BITS}"
        raise LimitExceeded(f"a number {bound}", "choose other units", at.start, at.end)
    return number


_MOST = arb(2) ** FLOAT_BITS
_LEAST = arb(2) ** -MAX_BITS
