"""An oscillator with a slow and a fast spring, driven by different colours.

q̈ = −(ω_s² + ω_f²) q. With a = (hω_s)² given and x = (hω_f)² the step matrix is rational in x;
where the two colours do not fit together it has resonances, intervals of x in which |tr M| > 2. A
determinant is a polynomial in x of degree at most the number of unknown stage values, so it is
interpolated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.doing import doing
from garkcli.errors import UsageProblem, counted
from garkcli.exact.cells import Interval
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, outer, reciprocal_characteristic, subtract
from garkcli.exact.multivariate import Multivariate, lattice, through_points
from garkcli.exact.polynomial import Polynomial, gcd, interpolated
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.oscillator import Ratio, stable_set
from garkcli.stepping.stage_system import StageSystem, stage_system
from garkcli.tableau.tableau import Colour, Tableau


@dataclass(frozen=True)
class SplitSprings:
    """Which term has which spring.

    Attributes:
        kinetic: the share of the kinetic energy of each term.
        slow: the share of the slow spring.
        fast: the share of the fast spring.
    """

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


@dataclass(frozen=True)
class TwoFrequencies:
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
    """The fast spring to one term, the slow one to the others that may have potential energy. All
    kinetic energy is in the first term.

    Args:
        tableau: the method.
        fast: the term of the fast spring, counted from 0.

    Raises:
        UsageProblem: the method has one term only, or none is left for the slow spring.
    """
    terms = terms_of(tableau)
    if terms < 2:
        raise UsageProblem(
            "a method of one term has no two colours for two springs",
            "take a method with at least two terms",
            code="split",
        )
    with_force = {x.term for x in tableau.colours if x.part in "yp"}
    slow_terms = _slow_terms(terms, fast, with_force)
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


def _slow_terms(terms: int, fast: int, with_force: set[int]) -> list[int]:
    """The terms that share the slow spring: not the kinetic one, where others are left."""
    others = [l for l in range(terms) if l != fast and l in with_force]
    later = [l for l in others if l > 0]
    return later or others


@doing("two springs")
def two_frequencies(tableau: Tableau, split: SplitSprings, slow: fmpq) -> TwoFrequencies:
    """The exact intervals of the fast frequency for one slow one.

    Raises:
        UsageProblem: the split is not one that the structure of the tableau is for.
    """
    check_structure(tableau, _like_an_oscillator(split))
    determinants = line_of_determinants(tableau, split, slow)
    M = _reduced(determinants)
    N, D = M.trace.numerator, M.trace.denominator
    return TwoFrequencies(
        slow=slow,
        trace=M.trace,
        determinant=M.determinant,
        discriminant=D * D * 4 - N * N,
        stable=M.stable(),
    )


def unknowns_of(tableau: Tableau, split: SplitSprings) -> int:
    """The number of equations of the stages.

    Raises:
        UsageProblem: the split is not one that the structure of the tableau is for.
    """
    check_structure(tableau, _like_an_oscillator(split))
    return len(_system(tableau, split, ZERO, ZERO).W)


def line_of_determinants(tableau: Tableau, split: SplitSprings, slow: fmpq) -> list[Polynomial]:
    """det(I − W) and, times it, the entries of M, as polynomials in x for one slow frequency."""
    unknowns = len(_system(tableau, split, slow, ZERO).W)
    points = [fmpq(k) for k in range(unknowns + 1)]
    rows = []
    for x in points:
        system = _system(tableau, split, slow, x)
        rows.append(_determinants(system))
    columns = zip(*rows, strict=True)
    return [interpolated(points, column) for column in columns]


def plane_of_determinants(tableau: Tableau, split: SplitSprings) -> tuple[Multivariate, ...]:
    """det(I − W) and, times it, the entries of M, as polynomials in (a, x).

    W is linear in (a, x), so that its determinants have at most its size as total degree.

    Raises:
        UsageProblem: the split is not one that the structure of the tableau is for.
    """
    check_structure(tableau, _like_an_oscillator(split))
    degree = len(_system(tableau, split, ZERO, ZERO).W)
    points = list(lattice(2, degree))
    rows = []
    for i, j in points:
        system = _system(tableau, split, fmpq(i), fmpq(j))
        rows.append(_determinants(system))
    planes = []
    for column in zip(*rows, strict=True):
        values = dict(zip(points, column, strict=True))
        planes.append(through_points(values, degree))
    return tuple(planes)


def stable_where(determinants: Sequence[Polynomial]) -> tuple[Interval, ...]:
    """The x ≥ 0 with all powers of M bounded, from det(I − W) and the entries of M times it."""
    return _reduced(determinants).stable()


@dataclass(frozen=True)
class _StepMatrix:
    """M over its common denominator, all polynomials in x.

    Attributes:
        trace: tr M.
        determinant: det M.
        off_diagonal: the entries of M off the diagonal, times the denominator.
        denominator: the poles of M are its roots.
    """

    trace: Ratio
    determinant: Ratio
    off_diagonal: tuple[Polynomial, Polynomial]
    denominator: Polynomial

    def stable(self) -> tuple[Interval, ...]:
        """The x ≥ 0 with all powers of M bounded."""
        return stable_set(self.trace, self.determinant, self.off_diagonal, self.denominator)


def _reduced(polynomials: Sequence[Polynomial]) -> _StepMatrix:
    """M from det(I − W) and its entries times that, without their common factor: roots of it are
    no poles of M.
    """
    common = polynomials[0]
    for p in polynomials:
        common = gcd(common, p)
    D, a, b, c, d = (p // common for p in polynomials)
    trace = Ratio.of(a + d, D)
    determinant = Ratio.of(a * d - b * c, D * D)
    return _StepMatrix(trace, determinant, (b, c), D)


def _like_an_oscillator(split: SplitSprings) -> Oscillator:
    """A split with the same terms in play, for the check of the structure."""
    shares = []
    terms = zip(split.kinetic, split.slow, split.fast, strict=True)
    for kinetic, slow, fast in terms:
        force = (slow + fast) / 2
        shares.append((kinetic, force))
    return Oscillator(ONE, tuple(shares))


def _system(tableau: Tableau, split: SplitSprings, slow: fmpq, x: fmpq) -> StageSystem:
    # both springs are kept in the structure of the system, whatever their strengths
    fields = [split.matrix(colour, slow, x) for colour in tableau.colours]
    kept = [split.matrix(colour, ONE, ONE) for colour in tableau.colours]
    return stage_system(tableau, fields, kept)


def _determinants(system: StageSystem) -> Sequence[Number]:
    """det(I − W) and, times it, the entries of M = I + B (I − W)⁻¹ E."""
    D = _determinant(system.W)
    entries: list[Number] = []
    for i, weights in enumerate(system.B):
        for j in range(2):
            # det(I − W + e bᵀ) = D + D bᵀ (I − W)⁻¹ e
            column = tuple(row[j] for row in system.E)
            rank_one = outer(column, weights)
            changed = subtract(system.W, rank_one)
            entry = _determinant(changed) - D
            if i == j:
                entry += D
            entries.append(entry)
    return (D, *entries)


def _determinant(W: Matrix) -> Number:
    """det(I − W)."""
    return reciprocal_characteristic(W)(ONE)
