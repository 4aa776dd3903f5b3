"""Enclosures in balls: of expressions, of real roots, and of polynomials.

What is enclosed has as many digits as ``flint.ctx`` has, and a bound on what is missing. A list of
coefficients starts with that of 1; statements on polynomials hold for all numbers in the balls,
and is None where these are too wide to tell.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq, fmpz_poly

from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Power, Root


@lru_cache(maxsize=512)
def isolated(coefficients: tuple[int, ...], bits: int) -> tuple[arb, ...]:
    """The real roots of an irreducible polynomial in ascending order, with about ``bits`` bits.

    python-flint isolates all roots and gives real ones an imaginary part that is exactly zero.

    Args:
        coefficients: the lowest first.
        bits: the precision.
    """
    with ctx.workprec(bits):
        roots: list[Any] = fmpz_poly(list(coefficients)).complex_roots()
        real = [root.real for root, _ in roots if root.imag == 0]
        real.sort(key=lambda ball: ball.mid())
        return tuple(real)


OPERATIONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
"""What the signs of a chain do with what is before them."""


def integer_power(base: arb, exponent: int) -> arb:
    """A ball to an integer power. The operator of python-flint gives nan for balls around 0.

    >>> integer_power(arb(0, 0.5), 2).str(2), (arb(0, 0.5) ** 2).str(2)
    ('[+/- 0.251]', 'nan')
    """
    power, square, rest = arb(1), base, abs(exponent)
    while rest:
        if rest % 2:
            power *= square
        square *= square
        rest //= 2
    return power if exponent >= 0 else 1 / power


def enclose(expression: Expression) -> arb:
    """A ball that holds the value of ``expression``, at the current ``flint.ctx`` precision.

    The value is undefined, and the ball all of the reals, where a divisor cannot be distinguished
    from 0.

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
            ball = enclose(radicand)
            if index % 2 and ball < 0:
                return -((-ball).root(index))
            return ball.root(index)
        case AlgebraicRoot(coefficients=coefficients, number=number):
            return isolated(coefficients, ctx.prec)[number]
    raise TypeError(f"no value: {expression!r}")


def midpoint(ball: arb) -> fmpq:
    """The middle of a ball, exactly."""
    mantissa, exponent = ball.mid().man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


def root_count(coefficients: Sequence[arb]) -> int | None:
    """The number of distinct real roots, by Sturm's chain; None too where roots are multiple.

    >>> root_count([arb(-2), arb(0), arb(1)]), root_count([arb(2), arb(0), arb(1)])
    (2, 0)
    """
    return cauchy_index(coefficients, derivative(coefficients))


def cauchy_index(f: Sequence[arb], g: Sequence[arb]) -> int | None:
    """The Cauchy index of g/f over the real line, by the chain f, g, −rem, …"""
    chain = [list(f), list(g)]
    while len(chain[-1]) > 1:
        rest = _negative_remainder(chain[-2], chain[-1])
        if rest is None:
            return None
        chain.append(rest)
    if not chain[-1]:
        return None
    if any(p[-1].contains(0) for p in chain):
        return None
    return _variations(chain, at_plus=False) - _variations(chain, at_plus=True)


def derivative(coefficients: Sequence[arb]) -> list[arb]:
    """The derivative."""
    return [k * a for k, a in enumerate(coefficients) if k]


def value(coefficients: Sequence[arb | fmpq], x: Any) -> Any:
    """The value at a ball, real or complex, by Horner's rule."""
    total: Any = arb(0)
    for a in reversed(coefficients):
        total = total * x + a
    return total


def _negative_remainder(f: Sequence[arb], g: Sequence[arb]) -> list[arb] | None:
    """−(f mod g), with a leading coefficient that is not zero."""
    *lower, leading = g
    if leading.contains(0):
        return None
    rest = list(f)
    while len(rest) >= len(g):
        factor = rest.pop() / leading
        for k, a in enumerate(lower, start=len(rest) - len(lower)):
            rest[k] = rest[k] - factor * a
    while rest and rest[-1].is_zero():
        rest.pop()
    if not rest or rest[-1].contains(0):
        return None
    return [-a for a in rest]


def _variations(chain: Sequence[Sequence[arb]], at_plus: bool) -> int:
    """Changes of sign along the chain at ∞ or −∞."""
    signs = []
    for p in chain:
        is_positive = bool(p[-1] > 0)
        has_odd_degree = len(p) % 2 == 0
        if has_odd_degree and not at_plus:
            is_positive = not is_positive
        signs.append(is_positive)
    return sum(1 for a, b in pairwise(signs) if a != b)


Entries: TypeAlias = list[arb]
_Vector: TypeAlias = Sequence[arb]


def plus(u: _Vector, v: _Vector) -> Entries:
    """The sum u + v."""
    return [x + y for x, y in zip(u, v, strict=True)]


def times(u: _Vector, v: _Vector) -> Entries:
    """The product u ⊙ v."""
    return [x * y for x, y in zip(u, v, strict=True)]


def entrywise_max(u: _Vector, v: _Vector) -> Entries:
    """The larger of each two entries."""
    return [x.max(y) for x, y in zip(u, v, strict=True)]


def scalar_product(u: _Vector, v: _Vector) -> arb:
    """uᵀ v."""
    return sum(times(u, v), arb(0))
