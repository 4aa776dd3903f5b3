"""Where in a family of polynomials p_x(t) real roots t can appear or disappear as x moves.

They do so only at an x for which two roots meet, or for which the leading coefficient is zero, so
that a root passes through infinity: both are roots of polynomials in x. Between two of them one x
decides for all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.polynomial import Polynomial, interpolated, subresultant
from garkcli.exact.roots import RealRoot, real_roots

MOST_POINTS = 400
"""Values of a resultant that are computed at most: enough for ten stages."""


def critical_polynomials(
    member: Callable[[fmpq], Polynomial], points: Sequence[fmpq]
) -> list[Polynomial]:
    """The leading coefficient of p_x and what decides about its double roots, as polynomials in x.

    That is the first subresultant of p_x and its derivative that is not zero for all x: where it is
    not zero p_x has a fixed number of distinct roots (G. E. Collins 1975).

    Args:
        member: p_x for a rational x, not all constant.
        points: more of them than the degree of the discriminant in x.
    """
    members = [member(x) for x in points]
    degree = max(p.degree for p in members)
    at_points = [p[degree] for p in members]
    leading = interpolated(points, at_points)
    for k in range(degree):
        values = [_with_derivative(p, degree, k) for p in members]
        double = interpolated(points, values)
        if double:
            return [leading, double]
    raise AssertionError("a polynomial has fewer distinct roots than none")


def _with_derivative(p: Polynomial, degree: int, k: int) -> Number:
    """The subresultant of index k of p and p′, for p taken as of ``degree``.

    It is 0 where its leading coefficient is zero. That keeps the values those of one polynomial in
    x, of which the leading coefficient is a factor.
    """
    if p.degree < degree:
        return ZERO
    return subresultant(p, p.derivative(), k)


def roots_between(
    polynomials: Sequence[Polynomial], low: RealRoot, high: RealRoot | None
) -> list[RealRoot]:
    """Numbers between two others, ascending, with all their roots among them; None for ∞.

    Over a number field they are the roots of the norms: one too many only makes one cell more.
    """
    found: set[RealRoot] = set()
    for p in polynomials:
        if p:
            norm = Polynomial.from_flint(p.norm())
            found |= {root for root, _ in real_roots(norm)}
    inside = [x for x in found if low < x]
    if high is not None:
        inside = [x for x in inside if x < high]
    return sorted(inside)
