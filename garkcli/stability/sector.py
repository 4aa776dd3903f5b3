"""A(α)-stability: the largest sector in which |R| ≤ 1, with its angle as an algebraic number.

On the ray z = −r e^{iφ} the difference E = |Q|² − |P|² is a polynomial in r and c = cos φ, since

    |p(−r e^{iφ})|² = Σ_{j,k} a_j a_k (−r)^{j+k} cos (j − k)φ,    cos nφ = T_n(c).

E/r is positive at r = 0 for φ < π/2. As φ grows, it can become negative somewhere only where it has
a double root, or where its leading coefficient is zero: at roots of a resultant in c. Between them
one angle decides for all. The sector is closed: on its edge |R| ≤ 1 by continuity.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq

from garkcli.exact.cells import between, roots_of
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.polynomial import Polynomial, interpolated, subresultant
from garkcli.exact.roots import RealRoot, real_roots, sign
from garkcli.frozen import Frozen
from garkcli.stability.linear import StabilityFunction, is_a_stable

MOST_POINTS = 400
"""Most values of a resultant: enough for ten stages."""


def critical_polynomials(
    member: Callable[[fmpq], Polynomial], points: Sequence[fmpq]
) -> list[Polynomial]:
    """Polynomials in x between whose roots one x decides for all: real roots of p_x appear or
    disappear only if two roots meet or one passes through infinity. They are the leading
    coefficient of p_x and the first subresultant of p_x and its derivative that is not zero for all
    x: where that is nonzero p_x has a fixed number of distinct roots (G. E. Collins 1975).
    ``points`` are more rational x than the degree of the discriminant.
    """
    members = [member(x) for x in points]
    degree = max(p.degree for p in members)
    leading = interpolated(points, [p[degree] for p in members])
    for k in range(degree):
        double = interpolated(points, [_with_derivative(p, degree, k) for p in members])
        if double:
            return [leading, double]
    raise AssertionError("a polynomial has fewer distinct roots than none")


def _with_derivative(p: Polynomial, degree: int, k: int) -> Number:
    """The subresultant of index k of p and p′, for p of nominal ``degree``: 0 if the leading
    coefficient is. Then the values belong to one polynomial in x, with that as a factor.
    """
    if p.degree < degree:
        return ZERO
    return subresultant(p, p.derivative(), k)


def roots_between(
    polynomials: Sequence[Polynomial], low: RealRoot, high: RealRoot | None
) -> list[RealRoot]:
    """Numbers between two others, None for ∞, ascending, that include all roots of polynomials
    there. Over a number field they are the roots of the norms; further numbers do no harm.
    """
    norms = (Polynomial.from_flint(p.norm()) for p in polynomials if p)
    return [x for x in roots_of(norms) if low < x and (high is None or x < high)]


class Sector(Frozen):
    """The largest sector |arg(−z)| ≤ α with |R| ≤ 1: cos α, or None if not even α = 0."""

    cosine: RealRoot | None


def largest_sector(R: StabilityFunction) -> Sector | None:
    """The angle of A(α)-stability, the negative real axis for α = 0; None if undecided."""
    if is_a_stable(R):
        return Sector(RealRoot.rational(ZERO))
    if not _is_bounded_at(R, ONE):
        return Sector(None)
    critical = _critical_cosines(R)
    if critical is None:
        return None
    edge = RealRoot.rational(ONE)
    for root in reversed([RealRoot.rational(ZERO), *critical]):
        if not _is_bounded_at(R, between(root, edge)):
            return Sector(edge)
        edge = root
    return Sector(edge)


def _critical_cosines(R: StabilityFunction) -> list[RealRoot] | None:
    """The cosines in (0, 1) at which |R| ≤ 1 on the ray may change, ascending."""
    stages = max(R.numerator.degree, R.denominator.degree)
    # E/r has this degree in r, and coefficients of degree ``stages`` in c; its discriminant is a
    # determinant of 2 · highest − 1 rows of them
    highest = 2 * stages - 1
    count = (2 * highest - 1) * stages + 1
    if count > MOST_POINTS:
        return None
    points = [fmpq(k, count + 1) for k in range(1, count + 1)]
    critical = critical_polynomials(lambda c: _on_ray(R, c), points)
    return roots_between(critical, RealRoot.rational(ZERO), RealRoot.rational(ONE))


def _on_ray(R: StabilityFunction, c: Number) -> Polynomial:
    over = _squared_on_ray(R.numerator, c)
    under = _squared_on_ray(R.denominator, c)
    E = under - over
    return Polynomial(E.coefficients[1:])


def _squared_on_ray(p: Polynomial, c: Number) -> Polynomial:
    # t_0(c), T_1(c), …: the cosines of the multiples of φ
    cosines: list[Number] = [ONE, c]
    for _ in range(p.degree):
        before, last = cosines[-2:]
        cosines.append(2 * c * last - before)
    squared: list[Number] = [ZERO] * (2 * p.degree + 1)
    for j, a in enumerate(p.coefficients):
        for k, b in enumerate(p.coefficients):
            power = j + k
            term = a * b * cosines[abs(j - k)]
            if power % 2:
                term = -term
            squared[power] = squared[power] + term
    return Polynomial(squared)


def _is_bounded_at(R: StabilityFunction, c: fmpq) -> bool:
    ray = _on_ray(R, c)  # not zero: |R| = 1 on a ray with rational cos φ > 0 alone means R = 1
    if sign(ray.leading) < 0:
        return False
    poles = _squared_on_ray(R.denominator, c)
    origin = RealRoot.rational(ZERO)
    if any(root > origin for root, _ in real_roots(poles)):
        return False
    powers = [power for root, power in real_roots(ray) if root > origin]
    # at a root of even multiplicity E is zero and does not change its sign
    return all(power % 2 == 0 for power in powers)
