"""Ranges of several parameters: which polynomials have no zero in them, and what follows of them.

A polynomial is rewritten in u ≥ 0, with t = (l + g u)/(1 + u) for a range [l, g] and t = l ± u
for one with a single end: where no coefficient is negative and those at the corners are positive
it has no zero. For [l, g] these are its coefficients in the basis of Bernstein, up to positive
factors. The converse is not claimed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from math import prod
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.errors import MethodError
from garkcli.exact.field import ZERO
from garkcli.exact.parametric import Parameters, Parametric
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots

Range: TypeAlias = tuple[fmpq | None, fmpq | None]
"""The least and the greatest value; None where there is none."""
_Chart: TypeAlias = Callable[[fmpq_mpoly], tuple[fmpq_mpoly, fmpq_mpoly]]
"""A parameter in u: numerator and denominator."""

FREE: Range = (None, None)
MOST_TERMS = 300
"""A polynomial that may become one of more terms in u is taken for one that may be zero."""


def can_vanish(
    p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]
) -> bool:
    """Whether a polynomial may have a real zero within the ranges of its parameters.

    Args:
        p: a polynomial.
        ring: of it.
        ranges: of its parameters; unknowns for roots of numbers have none.

    Returns:
        False only where it has no zero for certain.
    """
    if not p:
        return True
    factors = [factor for factor, _ in p.factor()[1]]
    return any(_can_vanish(factor, ring, ranges) for factor in factors)


def _can_vanish(
    p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]
) -> bool:
    """The same of an irreducible polynomial."""
    used = [k for k, degree in enumerate(p.degrees()) if degree]
    terms = prod(int(p.degrees()[k]) + 1 for k in used)
    has_roots = any(ring.names[k] not in ranges for k in used)
    if has_roots or terms > MOST_TERMS:
        return True
    inside = [ranges[ring.names[k]] for k in used]
    if len(used) == 1:
        # all of them are known
        roots = real_roots(_in_one_of(p, used[0]))
        return any(is_within(root, inside[0]) for root, _ in roots)
    cases = product(*map(_charts, inside))
    return any(_may_vanish(p, used, inside, case) for case in cases)


def is_within(value: RealRoot, ends: Range) -> bool:
    """Whether a number lies in a range, its ends included."""
    least, greatest = ends
    below = least is not None and value < RealRoot.rational(least)
    above = greatest is not None and RealRoot.rational(greatest) < value
    return not below and not above


def _in_one_of(p: fmpq_mpoly, index: int) -> Polynomial:
    """A polynomial in which one unknown occurs, in that."""
    powers = {int(e[index]): fmpq(a) for e, a in p.to_dict().items()}
    return Polynomial([powers.get(k, ZERO) for k in range(max(powers) + 1)])


def _charts(ends: Range) -> Iterator[_Chart]:
    """The range as the image of u ≥ 0; the whole line as that of two."""
    least, greatest = ends
    if least is not None and greatest is not None:
        yield lambda u: (least + greatest * u, 1 + u)
    elif least is not None:
        yield lambda u: (least + u, 1 + 0 * u)
    elif greatest is not None:
        yield lambda u: (greatest - u, 1 + 0 * u)
    else:
        yield lambda u: (u, 1 + 0 * u)
        yield lambda u: (-u, 1 + 0 * u)


def _may_vanish(
    p: fmpq_mpoly,
    used: Sequence[int],
    inside: Sequence[Range],
    case: Sequence[_Chart],
) -> bool:
    """Whether coefficients in u leave it open that there is a zero."""
    context = p.context()
    u = context.gens()
    degrees = [int(degree) for degree in p.degrees()]
    total = context.constant(0)
    for exponents, a in p.to_dict().items():
        term = context.constant(a)
        for k, chart in zip(used, case, strict=True):
            over, under = chart(u[k])
            power = int(exponents[k])
            term *= over**power * under ** (degrees[k] - power)
        total += term
    found = {tuple(map(int, e)): a for e, a in total.to_dict().items()}
    # a closed range has a corner at each end, the others at u = 0 alone
    corners: list[tuple[int, ...]] = [(0,)] * len(degrees)
    for k, ends in zip(used, inside, strict=True):
        if None not in ends:
            corners[k] = (0, degrees[k])
    at_corners = [found.get(corner, ZERO) for corner in product(*corners)]
    one = at_corners[0]
    has_zero = any(a * one <= 0 for a in at_corners)
    return has_zero or any(a * one < 0 for a in found.values())


def carried(
    fixed: Mapping[str, object],
    ranges: Mapping[str, Range],
    left: Sequence[str],
) -> dict[str, Range]:
    """The ranges of the parameters that are left, with what those of the others make of them.

    Args:
        fixed: the values of the others, numbers and polynomials in those that are left.
        ranges: of all.
        left: the names of those that are left.

    Raises:
        MethodError: a range leaves no value, or is not one of a parameter that is left.
    """
    found = {name: ranges[name] for name in left}
    for name, value in fixed.items():
        least, greatest = ranges[name]
        if ranges[name] == FREE:
            continue
        other, slope, rest = _affine(name, value, left)
        shifted = [None if x is None else x - rest for x in (least, greatest)]
        if other is None:
            _fail_outside(name, value, (shifted[0], shifted[1]))
            continue
        low, high = (None if x is None else x / slope for x in shifted)
        new = (low, high) if slope > 0 else (high, low)
        found[other] = _common(other, found[other], new)
    return found


def _affine(
    name: str, value: object, left: Sequence[str]
) -> tuple[str | None, fmpq, fmpq]:
    """The one parameter in a value, its factor, and what is added; None in a number."""
    if isinstance(value, fmpq):
        return None, ZERO, value
    assert isinstance(value, Parametric)
    p = value.numerator
    used = [k for k, degree in enumerate(p.degrees()) if degree]
    other = value.ring.names[used[0]]
    is_one = len(used) == 1 and value.denominator.is_one()
    if not is_one or p.degrees()[used[0]] != 1 or other not in left:
        text = value.ring.text(p)
        raise MethodError(
            f"{name} has a range, and its value {text} follows from others",
            "give the range to one of these, or values with --set",
        )
    rest, slope = (p.to_dict().get(e, ZERO) for e in _first_two(p, used[0]))
    return other, fmpq(slope), fmpq(rest)


def _first_two(p: fmpq_mpoly, index: int) -> list[tuple[int, ...]]:
    """The exponents of 1 and of an unknown."""
    size = len(p.degrees())
    return [(0,) * size, tuple(int(k == index) for k in range(size))]


def _fail_outside(name: str, value: object, shifted: Range) -> None:
    """Refuse a number outside of the range of its parameter, which is given less the number."""
    least, greatest = shifted
    below = least is not None and least > 0
    above = greatest is not None and greatest < 0
    if below or above:
        raise MethodError(
            f"{name} = {value} follows, which is outside of its range",
            "change the range, or what fixes the value",
        )


def _common(name: str, one: Range, other: Range) -> Range:
    """The intersection of two ranges of a parameter."""
    starts = [x[0] for x in (one, other) if x[0] is not None]
    ends = [x[1] for x in (one, other) if x[1] is not None]
    least = max(starts, default=None)
    greatest = min(ends, default=None)
    if least is not None and greatest is not None and greatest < least:
        raise MethodError(
            f"the ranges leave no value of {name}",
            "change one of them, or what fixes the others",
        )
    return least, greatest
