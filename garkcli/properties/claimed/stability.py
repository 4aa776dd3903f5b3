"""Kinds of stability, and how far they reach."""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.cells import Interval, first_end
from garkcli.exact.field import ZERO
from garkcli.exact.roots import RealRoot, sign, square_root
from garkcli.properties.linear import (
    decide_within,
    ends_text,
    first_gap,
    no_meaning,
    obstacle_to_a_stability,
)
from garkcli.properties.naming import entry_name, number_text, weight_name
from garkcli.properties.property import SEES_ALL, Size, Verdict, claimed
from garkcli.properties.subject import Subject
from garkcli.tableau.tableau import Tableau


@claimed(
    "G. Dahlquist, BIT 3 (1963); E. Hairer, G. Wanner, Solving ODEs II, section IV.3",
    meaning=SEES_ALL,
    is_cheap=False,
)
def a_stable(subject: Subject) -> Verdict:
    """|R(z)| ≤ 1 for all z with Re z ≤ 0, where R is the stability function, y_1 = R(hλ) y_0 for ẏ
    = λy with all vector fields equal. Decided by the poles of R and the polynomial E = |Q(iy)|² −
    |P(iy)|² for R = P/Q.
    """
    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return decide_within(subject.linear_within.a_stable)
    return Verdict.unless(obstacle_to_a_stability(subject.linear))


@claimed("B. L. Ehle, thesis, Waterloo (1969)", meaning=SEES_ALL, is_cheap=False)
def l_stable(subject: Subject) -> Verdict:
    """A-stable with R(∞) = 0: what is infinitely stiff is damped in one step."""
    R = subject.linear
    if R is None:
        return no_meaning()
    if subject.tolerance:
        return decide_within(subject.linear_within.l_stable)
    limit = R.at_infinity()
    if limit:
        return Verdict(False, f"R(∞) = {number_text(limit)}")
    return Verdict.unless(obstacle_to_a_stability(R))


@claimed(
    "J. D. Lambert, I. A. Watson, J. Inst. Math. Appl. 18 (1976)",
    meaning="methods whose vector fields can carry the split oscillator",
    is_cheap=False,
)
def p_stable(subject: Subject) -> Verdict:
    """On the harmonic oscillator q̈ = −ω²q all numerical solutions stay bounded for every step
    size: the powers of the step matrix M(hω) are bounded. With several terms the kinetic energy is
    the first, the potential one is divided equally among the others.
    """
    from garkcli.errors import UsageProblem
    from garkcli.problems.oscillator import Oscillator, terms_of
    from garkcli.stability.oscillator import oscillator_stability

    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    tableau = subject.tableau
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    try:
        found = oscillator_stability(tableau, problem)
    except UsageProblem as error:
        return Verdict.meaningless(error.message)
    if found.is_p_stable:
        return Verdict(True)
    return Verdict(False, _lost(found.stable))


def _lost(stable: tuple[Interval, ...]) -> str:
    gap = first_gap(stable)
    return f"powers of the step matrix are not bounded for {ends_text(gap, '(hω)²')}"


@claimed(
    "J. F. B. M. Kraaijevanger, BIT 31 (1991); additive methods: "
    "I. Higueras, SIAM J. Numer. Anal. 44 (2006)",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
)
def ssp_coefficient(subject: Subject) -> Verdict:
    """The radius of absolute monotonicity: the largest r for which, with K = (A 0; bᵀ 0), no entry
    of (I + rK)⁻¹ K and (I + rK)⁻¹ 𝟙 is negative. Up to r times the step size with which explicit
    Euler keeps a convex bound, the method keeps it (strong stability preserving). For several
    colours the same r for each.
    """
    from garkcli.stability.ssp import ssp_coefficient

    if not subject.is_complete:
        return no_meaning()
    if subject.points is None:
        return Verdict.undecided("the nodes have no simple radicals")
    negative = _negative(subject.points, subject.tolerance)
    if subject.tolerance and not negative:
        return Verdict.undecided("the coefficients are rounded")
    if negative:
        return Verdict(Size(RealRoot.rational(ZERO)), negative)
    found = ssp_coefficient(subject.points)
    assert found is not None
    return Verdict(Size(found.value))


def _negative(tableau: Tableau, tolerance: fmpq) -> str:
    """The first negative coefficient, with which there is no absolute monotonicity."""
    for (k, m), block in tableau.blocks.items():
        for i, row in enumerate(block):
            for j, a in enumerate(row):
                if a and sign(a + tolerance) < 0:
                    name = entry_name(tableau, k, m, i, j)
                    return f"{name} is {number_text(a)}"
    for m, colour in enumerate(tableau.colours):
        for j, b in enumerate(colour.b):
            if b and sign(b + tolerance) < 0:
                return f"{weight_name(tableau, m, j)} is {number_text(b)}"
    return ""


@claimed(
    "E. Hairer, G. Wanner, Solving ODEs II, section IV.2",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
)
def real_stability(subject: Subject) -> Verdict:
    """The length of the real stability interval: the largest x for which |R(z)| ≤ 1 on [−x, 0]."""
    from garkcli.stability.linear import real_set

    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    return Verdict(Size(first_end(real_set(subject.linear))))


@claimed(
    "P. J. van der Houwen, Construction of Integration Formulas (1977), section 2.3",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
)
def imaginary_stability(subject: Subject) -> Verdict:
    """The length of the imaginary stability interval: the largest y for which |R(z)| ≤ 1 on [−iy,
    iy].
    """
    from garkcli.stability.linear import imaginary_set

    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    squared = first_end(imaginary_set(subject.linear))
    return Verdict(Size(None if squared is None else square_root(squared)))
