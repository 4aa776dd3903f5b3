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


def can_vanish(p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]) -> bool:
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
    _, factors = p.factor()
    return any(_can_vanish(factor, ring, ranges) for factor, _ in factors)


def _can_vanish(p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]) -> bool:
    """The same of an irreducible polynomial."""
    used = _used(p)
    names = [ring.names[k] for k in used]
    has_roots = any(name not in ranges for name in names)
    if has_roots or _terms_in_u(p) > MOST_TERMS:
        return True
    inside = [ranges[name] for name in names]
    if len(used) == 1:
        # all of them are known
        roots = real_roots(_in_one_of(p, used[0]))
        return any(is_within(root, inside[0]) for root, _ in roots)
    cases = product(*map(_charts, inside))
    return any(_may_vanish(p, used, inside, case) for case in cases)


def _used(p: fmpq_mpoly) -> list[int]:
    """The unknowns that occur in a polynomial, by their numbers."""
    return [k for k, degree in enumerate(p.degrees()) if degree]


def _terms_in_u(p: fmpq_mpoly) -> int:
    """How many terms a polynomial can have when it is rewritten."""
    return prod(int(degree) + 1 for degree in p.degrees())


def is_within(value: RealRoot, ends: Range) -> bool:
    """Whether a number lies in a range, its ends included."""
    least, greatest = ends
    below = least is not None and value < RealRoot.rational(least)
    above = greatest is not None and RealRoot.rational(greatest) < value
    return not below and not above


def _in_one_of(p: fmpq_mpoly, index: int) -> Polynomial:
    """A polynomial in which one unknown occurs, in that."""
    powers = {}
    for exponents, a in p.to_dict().items():
        power = int(exponents[index])
        powers[power] = fmpq(a)
    degree = max(powers)
    return Polynomial([powers.get(k, ZERO) for k in range(degree + 1)])


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
    p: fmpq_mpoly, used: Sequence[int], inside: Sequence[Range], case: Sequence[_Chart]
) -> bool:
    """Whether coefficients in u leave it open that there is a zero."""
    found = {}
    for exponents, a in _rewritten(p, used, case).to_dict().items():
        found[tuple(map(int, exponents))] = fmpq(a)
    # a closed range has a corner at each end, the others at u = 0 alone
    degrees = [int(degree) for degree in p.degrees()]
    corners: list[tuple[int, ...]] = [(0,)] * len(degrees)
    for k, ends in zip(used, inside, strict=True):
        if None not in ends:
            corners[k] = (0, degrees[k])
    at_corners = [found.get(corner, ZERO) for corner in product(*corners)]
    one = at_corners[0]
    are_signed_alike = all(a * one > 0 for a in at_corners)
    opposes = any(a * one < 0 for a in found.values())
    return opposes or not are_signed_alike


def _rewritten(p: fmpq_mpoly, used: Sequence[int], case: Sequence[_Chart]) -> fmpq_mpoly:
    """A polynomial in u, without the denominator that is positive."""
    context = p.context()
    u = context.gens()
    degrees = p.degrees()
    total = context.constant(0)
    for exponents, a in p.to_dict().items():
        term = context.constant(a)
        for k, chart in zip(used, case, strict=True):
            over, under = chart(u[k])
            power = int(exponents[k])
            rest = int(degrees[k]) - power
            term *= over**power
            term *= under**rest
        total += term
    return total


def carried(
    fixed: Mapping[str, object], ranges: Mapping[str, Range], left: Sequence[str]
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
        low = None if least is None else least - rest
        high = None if greatest is None else greatest - rest
        if other is None:
            _fail_outside(name, value, (low, high))
            continue
        low = None if low is None else low / slope
        high = None if high is None else high / slope
        new = (low, high) if slope > 0 else (high, low)
        found[other] = _common(other, found[other], new)
    return found


def _affine(name: str, value: object, left: Sequence[str]) -> tuple[str | None, fmpq, fmpq]:
    """The one parameter in a value, its factor, and what is added; None in a number."""
    if isinstance(value, fmpq):
        return None, ZERO, value
    assert isinstance(value, Parametric)
    p = value.numerator
    used = _used(p)
    index = used[0]
    other = value.ring.names[index]
    is_polynomial = value.denominator.is_one()
    is_affine = len(used) == 1 and p.degrees()[index] == 1
    if not is_polynomial or not is_affine or other not in left:
        text = value.ring.text(p)
        raise MethodError(
            f"{name} has a range, and its value {text} follows from others",
            "give the range to one of these, or values with --set",
            code="no-value-left",
        )
    line = _in_one_of(p, index)
    slope, rest = line[1], line[0]
    assert isinstance(slope, fmpq)
    assert isinstance(rest, fmpq)
    return other, slope, rest


def _fail_outside(name: str, value: object, shifted: Range) -> None:
    """Refuse a number outside of the range of its parameter, which is given less the number."""
    least, greatest = shifted
    below = least is not None and least > 0
    above = greatest is not None and greatest < 0
    if below or above:
        raise MethodError(
            f"{name} = {value} follows, which is outside of its range",
            "change the range, or what fixes the value",
            code="no-value-left",
        )


def _common(name: str, one: Range, other: Range) -> Range:
    """The intersection of two ranges of a parameter."""
    both = [one, other]
    starts = [start for start, _ in both if start is not None]
    ends = [end for _, end in both if end is not None]
    least = max(starts, default=None)
    greatest = min(ends, default=None)
    if least is not None and greatest is not None and greatest < least:
        raise MethodError(
            f"the ranges leave no value of {name}",
            "change one of them, or what fixes the others",
            code="no-value-left",
        )
    return least, greatest
