"""Two springs: which fast frequencies are stable for every slow one of an interval.

With a = (hω_s)² and x = (hω_f)² stability at (a, x) depends on the signs of polynomials in both:
det(I − W) and those of the conditions on the eigenvalues. Their irreducible factors are curves in
the plane. Seen from the x-axis nothing changes among the a of [A, B] but at an x where a curve has
a vertical tangent or asymptote, where two curves cross, or where one meets a = A or a = B: at roots
of discriminants, leading coefficients, resultants and restrictions (G. E. Collins 1975). Between
two such x one of them decides, exactly, and each of them is decided by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq, fmpq_mpoly

from garkcli.doing import doing
from garkcli.errors import UsageProblem, counted
from garkcli.exact.cells import Interval, Point, where
from garkcli.exact.field import ZERO, Number
from garkcli.exact.multivariate import Exponents, Multivariate
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import PLANE, curves, projected
from garkcli.exact.roots import RealRoot, number_of
from garkcli.stability.two_frequencies import SplitSprings, plane_of_determinants, stable_where
from garkcli.tableau.tableau import Tableau

MOST_DEGREE = 4
"""Single algebraic x of a larger degree are left open."""
WITNESSES = 8
"""Parts of [A, B] whose ends are tried first: an unstable one decides."""


@dataclass(frozen=True)
class SlowInterval:
    """A method on the two springs, for all slow frequencies of an interval.

    Attributes:
        low: the least a.
        high: the greatest a.
        stable: the x ≥ 0 with all powers of M bounded for every a of them. Where one of
            ``open_points`` is an end, it is left out; where it is inside, it is taken in.
        open_points: single x for which it is not decided whether for some a an eigenvalue ±1 is
            double, or M has a pole.
    """

    low: fmpq
    high: fmpq
    stable: tuple[Interval, ...]
    open_points: tuple[RealRoot, ...]

    @property
    def is_stable_for_all(self) -> bool | None:
        """Whether no fast frequency is unstable; None where single points are open.

        Without any frequency, at a = x = 0, a free particle moves away: that is left out.
        """
        if len(self.stable) != 1:
            return False
        [interval] = self.stable
        if interval.start != RealRoot.rational(ZERO):
            return False
        if interval.end is not None:
            return False
        if not interval.has_start and self.low > 0:
            return False
        if self.open_points:
            return None
        return True

    def __repr__(self) -> str:
        parts = counted(len(self.stable), "interval")
        return f"<SlowInterval {self.low} to {self.high}: stable in {parts}>"


@doing("two springs")
def slow_interval(tableau: Tableau, split: SplitSprings, low: fmpq, high: fmpq) -> SlowInterval:
    """The fast frequencies that are stable for all slow ones of [low, high].

    Raises:
        UsageProblem: the coefficients are irrational, or the split is not one that the structure of
            the tableau is for.
    """
    plane = plane_of_determinants(tableau, split)
    if not all(_is_rational(p) for p in plane):
        raise UsageProblem(
            "an interval of slow frequencies needs rational coefficients",
            "give --slow A for single ones, which are decided in number fields too",
            code="no-radicals",
        )
    critical = _critical(plane, low, high)
    undecided: list[RealRoot] = []
    ends = RealRoot.rational(low), RealRoot.rational(high)
    stable_at = []
    length = high - low
    for k in range(WITNESSES + 1):
        a = low + length * fmpq(k, WITNESSES)
        determinants = [_with_slow(p, a) for p in plane]
        stable_at.append(stable_where(determinants))

    def is_stable(x: Point) -> bool:
        # one a that is unstable decides; that is cheap, as the polynomials in x are rational
        root = x if isinstance(x, RealRoot) else RealRoot.rational(x)
        if not all(_has(intervals, root) for intervals in stable_at):
            return False
        number = number_of(root, MOST_DEGREE)
        if number is None:
            undecided.append(root)
            return True
        determinants = [_with_fast(p, number) for p in plane]
        found = stable_where(determinants)
        return any(_contains(interval, *ends) for interval in found)

    found = where(is_stable, critical, start=ZERO)
    kept = [x for x in found if not (x.is_point and x.start in undecided)]
    stable = tuple(_trimmed(interval, undecided) for interval in kept)
    return SlowInterval(low, high, stable, tuple(undecided))


def _is_rational(p: Multivariate) -> bool:
    return all(isinstance(a, fmpq) for _, a in p.terms)


def _critical(plane: Sequence[Multivariate], low: fmpq, high: fmpq) -> list[Polynomial]:
    """The polynomials in x between whose roots one x decides."""
    return projected(_curves(plane), [low, high])


def _curves(plane: Sequence[Multivariate]) -> list[fmpq_mpoly]:
    """The irreducible factors of all polynomials whose signs tell what is stable."""
    D, a, b, c, d = (_in_plane(p) for p in plane)
    # times D²: tr M, det M and 1
    trace = (a + d) * D
    area = a * d - b * c
    whole = D * D
    both = whole + area
    deciding = [D, b, c, whole - area, both - trace, both + trace]
    return curves(deciding)


def _in_plane(p: Multivariate) -> fmpq_mpoly:
    """The same polynomial with a for y and x for t."""
    terms = {exponents: c for exponents, c in p.terms if isinstance(c, fmpq)}
    return PLANE.from_dict(terms)


def _with_slow(p: Multivariate, a: Number) -> Polynomial:
    """A polynomial in (a, x) as one in x."""
    point = (a,)
    coefficients = [coefficient(point) for coefficient in p.by_last()]
    return Polynomial(coefficients)


def _with_fast(p: Multivariate, x: Number) -> Polynomial:
    """A polynomial in (a, x) as one in a."""
    exchanged: dict[Exponents, Number] = {(k, j): c for (j, k), c in p.terms}
    return _with_slow(Multivariate.of(2, exchanged), x)


def _has(intervals: Sequence[Interval], x: RealRoot) -> bool:
    """Whether a number belongs to one of them."""
    return any(_contains(interval, x, x) for interval in intervals)


def _contains(interval: Interval, left: RealRoot, right: RealRoot) -> bool:
    """Whether [left, right] is a part of it."""
    start, end = interval.start, interval.end
    if start is not None and left < start:
        return False
    if end is not None and end < right:
        return False
    if start == left and not interval.has_start:
        return False
    return interval.has_end or end != right


def _trimmed(interval: Interval, undecided: Sequence[RealRoot]) -> Interval:
    """An interval without those of its ends that are not decided."""
    start, end = interval.start, interval.end
    has_start = interval.has_start and start not in undecided
    has_end = interval.has_end and end not in undecided
    return Interval(start, end, has_start, has_end)
