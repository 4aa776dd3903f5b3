"""Polynomials in a parameter t and another variable, from their values at rational t."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import count
from typing import cast

from flint import fmpq, fmpq_mpoly

from garkcli.exact.parametric import Parameters, fraction
from garkcli.exact.polynomial import Polynomial, interpolated
from garkcli.exact.projection import PLANE


def largest_degree(numbers: Iterable[object], denominator: fmpq_mpoly, ring: Parameters) -> int:
    """The largest degree in t of numbers times a common denominator, and of that itself."""
    degrees = [int(denominator.total_degree())]
    for x in numbers:
        numerator, own = fraction(x, ring)
        if numerator:
            cleared = numerator * (denominator // own)
            degrees.append(int(cleared.total_degree()))
    return max(degrees)


def values_without(poles: fmpq_mpoly) -> Iterator[fmpq]:
    """0, 1, 2, … without the roots of a polynomial."""
    for k in count():
        t = fmpq(k)
        if poles(t):
            yield t


def through(points: Sequence[fmpq], values: Sequence[Polynomial]) -> fmpq_mpoly:
    """The polynomial in y and t with given polynomials in y at given t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for j in range(max(p.degree for p in values) + 1):
        coefficient = interpolated(points, [p[j] for p in values])
        for k, a in enumerate(coefficient.coefficients):
            if a:
                terms[j, k] = cast("fmpq", a)
    return PLANE.from_dict(terms)
