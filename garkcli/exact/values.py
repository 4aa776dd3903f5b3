"""What a formula is worth for given values of its names: an exact rational number where it is one,
else a ball.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.errors import LimitExceeded, UndefinedValue
from garkcli.exact.domain import MAX_BITS
from garkcli.exact.expression import (
    MAX_EXPONENT,
    Chain,
    Expression,
    Literal,
    Name,
    Power,
    Root,
)
from garkcli.exact.formula import Call, RealPower
from garkcli.exact.rewriting import format_expression

Value: TypeAlias = fmpq | arb
"""A number in a formula."""
MAX_DENOMINATOR = 10_000
"""Largest denominator of an exponent."""
FLOAT_BITS = 1000
"""Largest numbers are 2^``FLOAT_BITS``: floats can still be multiplied by them."""
_FUNCTIONS: Mapping[str, Callable[[arb], arb]] = {
    "sin": arb.sin,
    "cos": arb.cos,
    "tan": arb.tan,
    "asin": arb.asin,
    "acos": arb.acos,
    "atan": arb.atan,
    "sinh": arb.sinh,
    "cosh": arb.cosh,
    "tanh": arb.tanh,
    "exp": arb.exp,
    "log": arb.log,
}


def value_of(expression: Expression, names: Mapping[str, Value]) -> Value:
    """The value, at the current ``flint.ctx`` precision; rational operations on rational numbers
    are exact.

    Args:
        expression: any, with whatever roots, powers and functions.
        names: a value for each name in it but ``pi``.

    Raises:
        UndefinedValue: an operation has no real value, or none that can be told: log(-1), 1/0,
            sqrt(-2). The error knows the offsets of the operation.
        LimitExceeded: a number of more than ``MAX_BITS`` bits or beyond the floats, or an exponent
            that is none.
        KeyError: a name without a value.

    >>> from garkcli.exact.formula import parse_formula
    >>> value_of(parse_formula("(1 + x)**2/3"), {"x": fmpq(1, 2)})
    3/4
    """
    match expression:
        case Literal(value=number):
            return number
        case Name(name=name):
            return arb.pi() if name == "pi" else names[name]
        case Chain(signs=signs, operands=operands):
            total: Value = fmpq(0 if signs[0] in "+-" else 1)
            for sign, operand in zip(signs, operands, strict=True):
                total = _bounded(
                    _applied(sign, total, value_of(operand, names), operand), expression
                )
            return total
        case Power(base=base, exponent=exponent):
            return _power(value_of(base, names), fmpq(exponent), expression, base)
        case RealPower(base=base, exponent=exponent):
            return _power(
                value_of(base, names), exponent_of(exponent, names), expression, base
            )
        case Root(radicand=radicand, index=index):
            return _root(value_of(radicand, names), index, expression, radicand)
        case Call(function=function, argument=argument):
            x = value_of(argument, names)
            return _finite(
                _FUNCTIONS[function](arb(x)), expression, function, argument, x
            )
    raise TypeError(f"no expression: {expression!r}")


def exponent_of(expression: Expression, names: Mapping[str, Value]) -> fmpq:
    """The rational number that an exponent is.

    Raises:
        UndefinedValue: it is irrational.
        LimitExceeded: it is too large, or its denominator is.
    """
    value = value_of(expression, names)
    if isinstance(value, arb):
        message = f"the exponent {format_expression(expression)} is no rational number"
        raise UndefinedValue(
            message,
            "write a fraction or a decimal, such as 3/2",
            expression.start,
            expression.end,
        )
    if abs(value) > MAX_EXPONENT or value.q > MAX_DENOMINATOR:
        message = f"the exponent {shown(value)} is beyond {MAX_EXPONENT} or has more than four decimals"
        raise LimitExceeded(
            message, "use a smaller or simpler one", expression.start, expression.end
        )
    return value


def shown(x: Value) -> str:
    """A number in a message.

    >>> shown(fmpq(1, 3)), shown(arb(2).sqrt())
    ('1/3', '1.41421')
    """
    if isinstance(x, fmpq) and len(str(x)) <= 12:
        return str(x)
    return f"{float(arb(x)):.6g}"


def _applied(sign: str, left: Value, right: Value, at: Expression) -> Value:
    if sign == "/":
        _check_divisor(right, at)
    if isinstance(left, arb) or isinstance(right, arb):
        left, right = arb(left), arb(right)
    if sign == "+":
        return left + right
    if sign == "-":
        return left - right
    return left * right if sign == "*" else left / right


def _check_divisor(number: Value, at: Expression) -> None:
    if number.contains(0) if isinstance(number, arb) else not number:
        what = (
            ""
            if isinstance(at, Literal)
            else f"{_cut(format_expression(at))} is 0 here"
        )
        raise UndefinedValue("division by zero", what, at.start, at.end)


def _cut(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:39]}…"


def _power(base: Value, exponent: fmpq, at: Expression, of: Expression) -> Value:
    """A power; the base is positive where the exponent is no whole number."""
    if exponent < 0:
        _check_divisor(base, of)
    if exponent.q == 1:
        if isinstance(base, fmpq):
            _bounded(
                fmpq(1) if base.height_bits() * abs(exponent) <= MAX_BITS else None, at
            )
            return base ** int(exponent.p)
        return _bounded(base ** int(exponent.p), at)
    if isinstance(base, fmpq) and not base:
        return fmpq(0)
    if not arb(base) > 0:
        message = f"a power with the exponent {exponent} of {shown(base)}"
        raise UndefinedValue(
            message, "such powers are of positive numbers", at.start, at.end
        )
    return _bounded(arb(base) ** arb(exponent), at)


def _root(radicand: Value, index: int, at: Expression, of: Expression) -> Value:
    if isinstance(radicand, fmpq):
        size, sign = abs(radicand), -1 if radicand < 0 else 1
        if sign > 0 or index % 2:
            p, q = size.p.root(index), size.q.root(index)
            if fmpq(p, q) ** index == size:
                return fmpq(sign * p, q)
    x = arb(radicand)
    if index % 2 and x < 0:
        return -((-x).root(index))
    return _finite(
        x.root(index), at, "an even root" if index % 2 == 0 else "a root", of, radicand
    )


def _finite(
    result: arb, at: Expression, function: str, of: Expression, x: Value
) -> Value:
    if not result.is_finite():
        inner = _cut(format_expression(of))
        what = f"{inner} = {shown(x)}" if inner != str(x) else inner
        raise UndefinedValue(
            f"{function} of {what} is no real number", "", at.start, at.end
        )
    return _bounded(result, at)


def _bounded(number: Value | None, at: Expression) -> Value:
    if number is None or (isinstance(number, fmpq) and number.height_bits() > MAX_BITS):
        raise LimitExceeded(
            f"a number of more than {MAX_BITS} bits",
            "write it smaller",
            at.start,
            at.end,
        )
    size = abs(arb(number))
    if not (size < _MOST and (size > _LEAST or size.contains(0))):
        message = f"a number {'below 2^-' if size < 1 else 'above 2^'}{MAX_BITS if size < 1 else FLOAT_BITS}"
        raise LimitExceeded(message, "choose other units", at.start, at.end)
    return number


_MOST = arb(2) ** FLOAT_BITS
_LEAST = arb(2) ** -MAX_BITS
