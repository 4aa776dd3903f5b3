"""An oscillator with a slow and a fast spring, driven by different colours.

q̈ = −(ω_s² + ω_f²) q. For fixed a = (hω_s)² the step matrix is rational in x = (hω_f)²; poorly
coupled colours have resonances, intervals of x in which |tr M| > 2. A determinant is a polynomial
in x of degree at most the number of unknown stage values, so it is interpolated.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.doing import doing
from garkcli.errors import UsageProblem, counted
from garkcli.exact.cells import Interval, Point, contains, has, where
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, outer, subtract
from garkcli.exact.multivariate import Exponents, Multivariate, lattice, through_points
from garkcli.exact.parametric import factors
from garkcli.exact.polynomial import Polynomial, gcd, interpolated, reciprocal_characteristic
from garkcli.exact.projection import PLANE, projected
from garkcli.exact.roots import RealRoot, number_of
from garkcli.frozen import Frozen
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.oscillator import Ratio, stable_set
from garkcli.stepping.linear import StageSystem, stage_system
from garkcli.tableau.tableau import Colour, Tableau


class SplitSprings(Frozen):
    kinetic: tuple[fmpq, ...]
    slow: tuple[fmpq, ...]
    fast: tuple[fmpq, ...]

    def matrix(self, colour: Colour, a: Number, x: Number) -> Matrix:
        """L with (q, p)˙ = L (q, p), h = 1, shape (2, 2)."""
        l = colour.term
        velocity = self.kinetic[l]
        force = self.slow[l] * a + self.fast[l] * x
        if colour.part == "p":
            velocity = ZERO
        if colour.part == "q":
            force = ZERO
        return ((ZERO, velocity), (-force, ZERO))


class TwoFrequencies(Frozen):
    """A method on the two springs, for one slow frequency.

    Attributes:
        slow: a = (hω_s)².
        trace: tr M as a function of x = (hω_f)².
        determinant: det M as a function of x.
        discriminant: 4D² − N² with tr M = N/D.
        stable: the x ≥ 0 with all powers of M bounded.
    """

    slow: fmpq
    trace: Ratio
    determinant: Ratio
    discriminant: Polynomial
    stable: tuple[Interval, ...]

    def __repr__(self) -> str:
        parts = counted(len(self.stable), "interval")
        return f"<TwoFrequencies slow {self.slow}: stable in {parts}>"


def springs(tableau: Tableau, fast: int) -> SplitSprings:
    """Returns the fast spring for one term and the slow one for the other terms with forces. The
    first term has all kinetic energy. Raises UsageProblem if no term is left for the slow one.
    """
    terms = terms_of(tableau)
    if terms < 2:
        message = "a method of one term has no two colours for two springs"
        raise UsageProblem(message, "take a method with at least two terms", code="split")
    with_force = {x.term for x in tableau.colours if x.part in "yp"}
    # the terms that share the slow spring: not the kinetic one, where others are left
    others = [l for l in range(terms) if l != fast and l in with_force]
    later = [l for l in others if l > 0]
    slow_terms = later or others
    if fast not in with_force or not slow_terms:
        message = f"term {fast + 1} leaves no term for the other spring"
        raise UsageProblem(message, "give another colour with --fast", code="split")
    share = fmpq(1, len(slow_terms))
    kinetic = [ZERO] * terms
    kinetic[0] = ONE
    slow = [ZERO] * terms
    for l in slow_terms:
        slow[l] = share
    strong = [ZERO] * terms
    strong[fast] = ONE
    return SplitSprings(tuple(kinetic), tuple(slow), tuple(strong))


@doing("two springs")
def two_frequencies(tableau: Tableau, split: SplitSprings, slow: fmpq) -> TwoFrequencies:
    """The exact fast intervals for one slow frequency; UsageProblem if the split does not suit."""
    check_structure(tableau, _like_an_oscillator(split))
    M = _reduced(line_of_determinants(tableau, split, slow))
    trace, determinant, *_ = M
    N, D = trace.numerator, trace.denominator
    return TwoFrequencies(
        slow=slow,
        trace=trace,
        determinant=determinant,
        discriminant=D * D * 4 - N * N,
        stable=stable_set(*M),
    )


def unknowns_of(tableau: Tableau, split: SplitSprings) -> int:
    """The number of equations of the stages; UsageProblem if the split does not suit."""
    check_structure(tableau, _like_an_oscillator(split))
    return len(_system(tableau, split, ZERO, ZERO).W)


def line_of_determinants(tableau: Tableau, split: SplitSprings, slow: fmpq) -> list[Polynomial]:
    """D = det(I − W) and the entries of D · M, as polynomials in x for one slow frequency."""
    unknowns = len(_system(tableau, split, slow, ZERO).W)
    points = [fmpq(k) for k in range(unknowns + 1)]
    rows = [_determinants(_system(tableau, split, slow, x)) for x in points]
    return [interpolated(points, column) for column in zip(*rows, strict=True)]


def plane_of_determinants(tableau: Tableau, split: SplitSprings) -> tuple[Multivariate, ...]:
    """Returns D = det(I − W) and the entries of D · M in (a, x), of degrees ≤ the size of W."""
    check_structure(tableau, _like_an_oscillator(split))
    degree = len(_system(tableau, split, ZERO, ZERO).W)
    points = list(lattice(2, degree))
    rows = [_determinants(_system(tableau, split, fmpq(i), fmpq(j))) for i, j in points]
    return tuple(
        through_points(dict(zip(points, column, strict=True)), degree)
        for column in zip(*rows, strict=True)
    )


def stable_where(determinants: Sequence[Polynomial]) -> tuple[Interval, ...]:
    """The x ≥ 0 with all powers of M bounded, from D = det(I − W) and the entries of D · M."""
    return stable_set(*_reduced(determinants))


def _reduced(
    polynomials: Sequence[Polynomial],
) -> tuple[Ratio, Ratio, tuple[Polynomial, Polynomial], Polynomial]:
    """The arguments of ``stable_set``, without the common factor, whose roots are no poles of M."""
    common = polynomials[0]
    for p in polynomials:
        common = gcd(common, p)
    D, a, b, c, d = (p // common for p in polynomials)
    return Ratio.of(a + d, D), Ratio.of(a * d - b * c, D * D), (b, c), D


def _like_an_oscillator(split: SplitSprings) -> Oscillator:
    terms = zip(split.kinetic, split.slow, split.fast, strict=True)
    return Oscillator(ONE, tuple((kinetic, (slow + fast) / 2) for kinetic, slow, fast in terms))


def _system(tableau: Tableau, split: SplitSprings, slow: fmpq, x: fmpq) -> StageSystem:
    # both springs are kept in the structure of the system, whatever their strengths
    fields = [split.matrix(colour, slow, x) for colour in tableau.colours]
    kept = [split.matrix(colour, ONE, ONE) for colour in tableau.colours]
    return stage_system(tableau, fields, kept)


def _determinants(system: StageSystem) -> Sequence[Number]:
    """D = det(I − W) and the entries of D · M, M = I + B (I − W)⁻¹ E."""
    D = _determinant(system.W)
    entries: list[Number] = []
    for i, weights in enumerate(system.B):
        for j in range(2):
            # det(I − W + e bᵀ) = D + D bᵀ (I − W)⁻¹ e
            column = tuple(row[j] for row in system.E)
            entry = _determinant(subtract(system.W, outer(column, weights))) - D
            if i == j:
                entry += D
            entries.append(entry)
    return (D, *entries)


def _determinant(W: Matrix) -> Number:
    return reciprocal_characteristic(W)(ONE)


MOST_DEGREE = 4
"""Single algebraic x of larger degree are undecided."""
WITNESSES = 8
"""Parts of [A, B] whose ends are tried first: an unstable one decides."""


class SlowInterval(Frozen):
    """A method on the two springs, for all slow frequencies of an interval.

    Attributes:
        low: the least a.
        high: the greatest a.
        stable: the x ≥ 0 with all powers of M bounded for every a, without ``open_points`` at ends.
        open_points: undecided x: for some a an eigenvalue ±1 may be double, or M may have a pole.
    """

    low: fmpq
    high: fmpq
    stable: tuple[Interval, ...]
    open_points: tuple[RealRoot, ...]

    @property
    def is_stable_for_all(self) -> bool | None:
        """Whether all fast frequencies are stable; None if single points are undecided. The free
        particle a = x = 0 is ignored.
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
    """Returns the x that are stable for all a in [low, high]; UsageProblem if not rational."""
    plane = plane_of_determinants(tableau, split)
    if not all(isinstance(a, fmpq) for p in plane for _, a in p.terms):
        message = "an interval of slow frequencies needs rational coefficients"
        cure = "give --slow A for single ones, which are decided in number fields too"
        raise UsageProblem(message, cure, code="no-radicals")
    # with a for y and x for t
    D, a, b, c, d = (
        PLANE.from_dict({e: c for e, c in p.terms if isinstance(c, fmpq)}) for p in plane
    )
    # between the roots of these one x decides
    critical = projected(factors([D, b, c, *eigenvalue_conditions(D, a, b, c, d)]), [low, high])
    undecided: list[RealRoot] = []
    ends = RealRoot.rational(low), RealRoot.rational(high)
    stable_at = []
    for k in range(WITNESSES + 1):
        witness = low + (high - low) * fmpq(k, WITNESSES)
        stable_at.append(stable_where([_with_slow(p, witness) for p in plane]))

    def is_stable(x: Point) -> bool:
        # one a that is unstable decides; that is cheap, as the polynomials in x are rational
        root = x if isinstance(x, RealRoot) else RealRoot.rational(x)
        if not all(has(intervals, root) for intervals in stable_at):
            return False
        number = number_of(root, MOST_DEGREE)
        if number is None:
            undecided.append(root)
            return True
        slow = stable_where([_with_fast(p, number) for p in plane])
        return any(contains(interval, *ends) for interval in slow)

    intervals = where(is_stable, critical, start=ZERO)
    stable = tuple(
        _trimmed(x, undecided) for x in intervals if not (x.is_point and x.start in undecided)
    )
    return SlowInterval(low, high, stable, tuple(undecided))


def eigenvalue_conditions(
    D: fmpq_mpoly, a: fmpq_mpoly, b: fmpq_mpoly, c: fmpq_mpoly, d: fmpq_mpoly
) -> list[fmpq_mpoly]:
    """D² (1 − det M) and D² (1 + det M ∓ tr M): none is negative if powers of M are bounded."""
    whole = D * D
    trace = (a + d) * D
    area = a * d - b * c
    both = whole + area
    return [whole - area, both - trace, both + trace]


def _with_slow(p: Multivariate, a: Number) -> Polynomial:
    return Polynomial([coefficient((a,)) for coefficient in p.by_last()])


def _with_fast(p: Multivariate, x: Number) -> Polynomial:
    exchanged: dict[Exponents, Number] = {(k, j): c for (j, k), c in p.terms}
    return _with_slow(Multivariate.of(2, exchanged), x)


def _trimmed(interval: Interval, undecided: Sequence[RealRoot]) -> Interval:
    start, end = interval.start, interval.end
    has_start = interval.has_start and start not in undecided
    has_end = interval.has_end and end not in undecided
    return Interval(start, end, has_start, has_end)
