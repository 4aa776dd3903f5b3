"""Expressions in balls: as many digits as ``flint.ctx`` has, and a bound on what is missing."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from flint import arb, ctx

from garkcli.exact.isolating import isolated
from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Power, Root

OPERATIONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
"""What the signs of a chain do with what stands before them."""


def integer_power(base: arb, exponent: int) -> arb:
    """A ball to an integer power. The operator of python-flint gives nan for balls around 0.

    >>> integer_power(arb(0, 0.5), 2).str(2), (arb(0, 0.5) ** 2).str(2)
    ('[+/- 0.251]', 'nan')
    """
    found, square, rest = arb(1), base, abs(exponent)
    while rest:
        if rest % 2:
            found *= square
        square *= square
        rest //= 2
    return found if exponent >= 0 else 1 / found


def enclose(expression: Expression) -> arb:
    """A ball that holds the value of ``expression``, at the current ``flint.ctx`` precision.

    The value is undefined, and the ball all of the reals, where a divisor cannot be told from 0.

    >>> from garkcli.exact.expression import parse
    >>> bool(abs(enclose(parse("sqrt(2)")) ** 2 - 2) < 1e-14)
    True
    """
    match expression:
        case Literal(value=value):
            return arb(value)
        case Chain(signs=signs, operands=operands):
            total = arb(0 if signs[0] in "+-" else 1)
            for sign, operand in zip(signs, operands, strict=True):
                total = OPERATIONS[sign](total, enclose(operand))
            return total
        case Power(base=base, exponent=exponent):
            return integer_power(enclose(base), exponent)
        case Root(radicand=radicand, index=index):
            inside = enclose(radicand)
            if index % 2 and inside < 0:
                return -((-inside).root(index))
            return inside.root(index)
        case AlgebraicRoot(coefficients=coefficients, number=number):
            return isolated(coefficients, ctx.prec)[number]
    raise TypeError(f"no value: {expression!r}")
