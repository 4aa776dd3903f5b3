"""Enclosures in balls: of expressions, of real roots, and of polynomials.

Results have the precision of ``flint.ctx``. Lists of coefficients start with the constant one.
Statements about polynomials hold for all numbers in the balls, and are None if these are too wide.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, TypeAlias

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly, fmpz, fmpz_poly

from garkcli.deadline import check_time
from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Power, Root


@lru_cache(maxsize=512)
def isolated(coefficients: tuple[int, ...], bits: int) -> tuple[arb, ...]:
    """The real roots of an irreducible polynomial in ascending order, to about ``bits`` bits.

    >>> [float(x) for x in isolated((-2, 0, 1), 64)]
    [-1.4142135623730951, 1.4142135623730951]
    """
    if len(coefficients) == 2:
        with ctx.workprec(bits):
            return (arb(fmpq(-coefficients[0], coefficients[1])),)
    # python-flint's complex_roots may never end if two roots are close
    p = fmpz_poly(list(coefficients))
    return tuple(_narrowed(p, *ends, bits) for ends in _ends(coefficients))


@lru_cache(maxsize=512)
def _ends(coefficients: tuple[int, ...]) -> list[tuple[fmpq, fmpq]]:
    """Rational ends around each real root, no other root between them."""
    mirrored = [-a if k % 2 else a for k, a in enumerate(coefficients)]
    negative = [(-high, -low) for low, high in reversed(_positive(mirrored))]
    return negative + _positive(coefficients)


def _positive(coefficients: Sequence[int]) -> list[tuple[fmpq, fmpq]]:
    """Rational ends around each positive root, by halving and Descartes' rule."""
    degree = len(coefficients) - 1
    *lower, leading = (abs(a).bit_length() for a in coefficients)
    # all roots are below this (Fujiwara)
    size = 1 + max((x - leading) // (degree - k) + 1 for k, x in enumerate(lower))
    width = fmpq(2) ** size
    ends = []
    waiting = [(fmpq_poly(list(coefficients))(fmpq_poly([0, width])).numer(), fmpq(0), width)]
    while waiting:
        check_time()
        p, low, width = waiting.pop()  # the polynomial over the interval as one from 0 to 1
        turned = fmpz_poly(p.coeffs()[::-1])(_NEXT)
        signs = [a > 0 for a in turned.coeffs() if a]
        variations = sum(a != b for a, b in pairwise(signs))
        if variations == 1:
            ends.append((low, low + width))
        elif variations:
            half = width / 2
            left = fmpz_poly([a << degree - k for k, a in enumerate(p.coeffs())])
            waiting += [(left(_NEXT), low + half, half), (left, low, half)]
    return ends


_NEXT = fmpz_poly([1, 1])


def _narrowed(p: fmpz_poly, low: fmpq, high: fmpq, bits: int) -> arb:
    """Refines the only root between two numbers by interval Newton, or by halving if that fails."""
    slopes = p.derivative()
    is_positive = p(low) > 0
    while (high - low) * 2**bits > min(abs(low), abs(high)):
        check_time()
        width, middle = high - low, (low + high) / 2
        with ctx.workprec(2 * bits + 64):
            slope = arb_poly(slopes)(arb(low).union(arb(high)))
            root = arb(middle) - _value(p, middle) / slope
            if root.is_finite():
                low, high = max(low, midpoint(root.lower())), min(high, midpoint(root.upper()))
            if 2 * (high - low) > width:
                middle = (low + high) / 2
                if (_value(p, middle) > 0) == is_positive:
                    low = middle
                else:
                    high = middle
    with ctx.workprec(bits):
        return arb(low).union(arb(high))


def _value(p: fmpz_poly, x: fmpq) -> arb:
    """The value at a number that is not a root: a ball without 0, or the exact value."""
    ball = arb_poly(p)(arb(x))
    return arb(p(x)) if ball.contains(0) else ball


OPERATIONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def integer_power(base: arb, exponent: int) -> arb:
    """A ball to an integer power. python-flint's operator gives nan for balls around 0.

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


def real_root(ball: arb, index: int) -> arb:
    return -((-ball).root(index)) if index % 2 and ball < 0 else ball.root(index)


def enclose(expression: Expression) -> arb:
    """A ball of the value at the precision of ``flint.ctx``; the whole line if a divisor may be 0.

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
            return real_root(enclose(radicand), index)
        case AlgebraicRoot(coefficients=coefficients, number=number):
            return isolated(coefficients, ctx.prec)[number]
    raise TypeError(f"no value: {expression!r}")


def midpoint(ball: arb) -> fmpq:
    mantissa, exponent = ball.mid().man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


def bits_for(grain: fmpq) -> int:
    """The precision at which numbers larger than ``grain`` are not lost."""
    return 2 * int(grain.q.bit_length()) + 64


def root_count(coefficients: Sequence[arb]) -> int | None:
    """The number of distinct real roots, by Sturm's chain; None also if roots are multiple.

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
    return [k * a for k, a in enumerate(coefficients) if k]


def value(coefficients: Sequence[arb | fmpq | fmpz], x: Any) -> Any:
    total: Any = arb(0)
    for a in reversed(coefficients):
        total = total * x + a
    return total


def _negative_remainder(f: Sequence[arb], g: Sequence[arb]) -> list[arb] | None:
    """−(f mod g), without leading zeros; None if a leading coefficient may be 0."""
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
    """Sign changes along the chain at ∞ or −∞."""
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
    return [x + y for x, y in zip(u, v, strict=True)]


def times(u: _Vector, v: _Vector) -> Entries:
    return [x * y for x, y in zip(u, v, strict=True)]


def entrywise_max(u: _Vector, v: _Vector) -> Entries:
    return [x.max(y) for x, y in zip(u, v, strict=True)]


def scalar_product(u: _Vector, v: _Vector) -> arb:
    return sum(times(u, v), arb(0))
