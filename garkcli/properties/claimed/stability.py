"""Stability: its kinds, and the sizes of stability intervals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flint import acb, acb_poly, arb, ctx, fmpq

from garkcli.exact.cells import Interval, between, first_end
from garkcli.exact.display import in_digits, to_ball
from garkcli.exact.field import ZERO
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    ball_decimal,
    integral,
    polynomial_text,
    root_decimal,
    root_text,
)
from garkcli.exact.roots import RealRoot, sign, square_root
from garkcli.properties.naming import entry, entry_is, number_words, place
from garkcli.properties.subject import MISSING_BLOCKS, SEES_ALL, Subject, claimed
from garkcli.properties.verdict import Size, Verdict
from garkcli.reason import NO_REASON, Formula, Reason
from garkcli.stability import linear as linear_problems
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.stability.ball_polynomials import Bounds
    from garkcli.stability.oscillator import OscillatorStability

_BITS = 128
_DIGITS = 6
_DIGITS_OF_ENDS = 15
_LONG = 60


def decide_within(found: bool | None) -> Verdict:
    if found is None:
        return Verdict.undecided("a polynomial is too near to zero where it has a sign")
    return Verdict(found)


def obstacle_to_a_stability(R: linear_problems.StabilityFunction) -> Reason:
    """Why |R| > 1 somewhere in the left half plane; empty for an A-stable method."""
    P, Q = R.numerator, R.denominator
    if P.degree > Q.degree:
        return Reason("R(z) is not bounded: its numerator has the larger degree")
    if not linear_problems.poles_are_right(Q):
        return Reason("R has a pole at z = {}", _left_pole(Q))
    gap = first_gap(linear_problems.imaginary_set(R))
    if gap is None:
        return NO_REASON
    where = "|R(iy)| > 1 at x = y² = {}"
    x = Formula(str(between(gap.start, gap.end)))
    (E,) = integral([linear_problems.e_polynomial(R)])
    text = polynomial_text(E, "x")
    return (
        Reason(f"{where}: there {{}} < 0", x, Formula(text))
        if len(text) <= _LONG
        else Reason(where, x)
    )


def _left_pole(Q: Polynomial) -> str:
    """The root of Q with the smallest real part, in digits; of several the first above ℝ."""
    before = ctx.prec
    try:
        # roots of higher multiplicity cannot be enclosed
        upper = [z for z in _roots(Q.square_free()) if not z.imag < 0]
        least = min(upper, key=lambda z: z.real.mid())
        as_far = [z for z in upper if z.real.overlaps(least.real)]
        pole = min(as_far, key=lambda z: z.imag.mid())
        real = ball_decimal(pole.real, _DIGITS)
        if pole.imag.contains(0):
            return real
        return f"{real} ± {ball_decimal(pole.imag, _DIGITS)}i"
    finally:
        ctx.prec = before


def _roots(Q: Polynomial) -> list[acb]:
    bits = _BITS
    while True:
        ctx.prec = bits
        digits = bits * 3 // 10
        balls = [acb(to_ball(a, digits)) for a in Q.coefficients]
        try:
            roots: list[acb] = acb_poly(balls).roots(tol=arb(2) ** -60, maxprec=4 * bits)
        except ValueError:
            bits *= 2
        else:
            return roots


def first_gap(intervals: Sequence[Interval]) -> Interval | None:
    """The first part of [0, ∞) that a set of intervals omits, or None."""
    end, is_left_out = RealRoot.rational(ZERO), True
    for found in intervals:
        if found.start is not None and (end < found.start or not found.has_start):
            return Interval(end, found.start, is_left_out, not found.has_start)
        if found.end is None:
            return None
        end, is_left_out = found.end, not found.has_end
    return Interval(end, None, is_left_out)


def inequality(gap: Interval, variable: str) -> Reason:
    if gap.is_point:
        return Reason(f"{variable} = {{}}", _number(gap.start))
    low = Reason(f"{{}} {'≤' if gap.has_start else '<'} {variable}", _number(gap.start))
    if gap.end is None:
        return low
    return Reason(f"{{}} {'≤' if gap.has_end else '<'} {{}}", low, _number(gap.end))


def _number(root: RealRoot | None) -> Formula | str:
    assert root is not None
    text = root_text(root)
    return Formula(text) if text else root_decimal(root, 12)


@claimed(
    "G. Dahlquist, BIT 3 (1963); E. Hairer, G. Wanner, Solving ODEs II, section IV.3",
    meaning=SEES_ALL,
    is_cheap=False,
    asks="signs",
)
def a_stable(subject: Subject) -> Verdict:
    """|R(z)| ≤ 1 for all z with Re z ≤ 0, where R is the stability function, y_1 = R(hλ) y_0 for ẏ
    = λy with all vector fields equal. Decided from the poles of R and the polynomial E = |Q(iy)|² −
    |P(iy)|² for R = P/Q.
    """
    if not subject.is_linear:
        return Verdict.meaningless(MISSING_BLOCKS)
    if subject.tolerance:
        return decide_within(subject.linear_within[0])
    return Verdict.unless(obstacle_to_a_stability(subject.linear))


@claimed("B. L. Ehle, thesis, Waterloo (1969)", meaning=SEES_ALL, is_cheap=False, asks="signs")
def l_stable(subject: Subject) -> Verdict:
    """A-stable with R(∞) = 0: one step damps infinitely stiff parts."""
    if not subject.is_linear:
        return Verdict.meaningless(MISSING_BLOCKS)
    if subject.tolerance:
        return decide_within(subject.linear_within[1])
    R = subject.linear
    limit = R.at_infinity()
    if limit:
        return Verdict(False, Reason("R(∞) = {}", number_words(limit)))
    return Verdict.unless(obstacle_to_a_stability(R))


@claimed(
    "J. D. Lambert, I. A. Watson, J. Inst. Math. Appl. 18 (1976)",
    meaning="methods whose vector fields can carry the split oscillator",
    is_cheap=False,
    asks="signs",
)
def p_stable(subject: Subject) -> Verdict:
    """On the harmonic oscillator q̈ = −ω²q no numerical solution grows or decays, for any step
    size: the step matrix M(hω) has the determinant 1, and its powers are bounded; for a Runge–Kutta
    method |R(iy)| = 1 for all y. With several terms the kinetic energy is the first, the potential
    one is divided equally among the others.
    """
    found = _on_oscillator(subject)
    if isinstance(found, Verdict):
        return found
    if found.is_p_stable:
        return Verdict(True)
    if found.is_i_stable:
        return Verdict(False, Reason("solutions decay; i-stable claims that they are bounded"))
    return _growing(found)


@claimed(
    "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.3",
    meaning="methods whose vector fields can carry the split oscillator",
    is_cheap=False,
    asks="signs",
)
def i_stable(subject: Subject) -> Verdict:
    """On the harmonic oscillator q̈ = −ω²q all numerical solutions stay bounded for every step
    size: the powers of the step matrix M(hω) are bounded; for a Runge–Kutta method |R(iy)| ≤ 1
    for all y. The oscillator is split as for p-stable.
    """
    found = _on_oscillator(subject)
    if isinstance(found, Verdict):
        return found
    return Verdict(True) if found.is_i_stable else _growing(found)


def _on_oscillator(subject: Subject) -> OscillatorStability | Verdict:
    from garkcli.errors import UsageProblem
    from garkcli.problems.oscillator import Oscillator, terms_of
    from garkcli.stability.oscillator import oscillator_stability

    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    tableau = subject.tableau
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    try:
        return oscillator_stability(tableau, problem)
    except UsageProblem as error:
        return Verdict.meaningless(Reason(error.message))


def _growing(found: OscillatorStability) -> Verdict:
    gap = first_gap(found.stable)
    assert gap is not None
    where = inequality(gap, "(hω)²")
    return Verdict(False, Reason("powers of the step matrix are not bounded for {}", where))


@claimed(
    "J. F. B. M. Kraaijevanger, BIT 31 (1991); additive methods: "
    "I. Higueras, SIAM J. Numer. Anal. 44 (2006)",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
    asks="signs",
)
def ssp_coefficient(subject: Subject) -> Verdict:
    """The radius of absolute monotonicity: the largest r for which, with K = (A 0; bᵀ 0), no entry
    of (I + rK)⁻¹ K and (I + rK)⁻¹ 𝟙 is negative. Up to r times the step size with which explicit
    Euler keeps a convex bound, the method keeps it (strong stability preserving). With several
    colours, r is the same for each.
    """
    from garkcli.stability.ssp import ssp_coefficient

    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    if subject.points is None:
        return Verdict.undecided("the nodes have no simple radicals")
    negative = _negative(subject.points, subject.tolerance)
    if negative:
        return Verdict(Size(RealRoot.rational(ZERO)), negative)
    if subject.tolerance:
        return _between(subject.intervals.ssp)
    found = ssp_coefficient(subject.points)
    assert found is not None
    return Verdict(Size(found.value))


def _between(found: Bounds, is_squared: bool = False) -> Verdict:
    """A number known between bounds, with the digits that these share."""
    if found.low is None:
        return Verdict(Size(None))
    if found.high is None:
        return Verdict.undecided("its end is not found")
    low, high = arb(found.low), arb(found.high)
    with ctx.workprec(_BITS):
        ball = low.union(high).sqrt() if is_squared else low.union(high)
        if not ball.rad() < abs(ball) * arb(10) ** -_DIGITS_OF_ENDS and ball != 0:
            return Verdict.undecided("its end is not found to enough digits")
        return Verdict(Size(RealRoot.rational(in_digits(ball, _DIGITS_OF_ENDS))))


def _negative(tableau: Tableau, tolerance: fmpq) -> Reason:
    for (k, m), block in tableau.blocks.items():
        for i, row in enumerate(block):
            for j, a in enumerate(row):
                if a and sign(a + tolerance) < 0:
                    return entry_is(entry(tableau, k, m, i, j), a)
    for m, colour in enumerate(tableau.colours):
        for j, b in enumerate(colour.b):
            if b and sign(b + tolerance) < 0:
                return entry_is(place("b", tableau, [m], j), b)
    return NO_REASON


@claimed(
    "E. Hairer, G. Wanner, Solving ODEs II, section IV.2",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
    asks="signs",
)
def real_stability(subject: Subject) -> Verdict:
    """The length of the real stability interval: the largest x with |R(z)| ≤ 1 on [−x, 0]."""
    if not subject.is_linear:
        return Verdict.meaningless(MISSING_BLOCKS)
    if subject.tolerance:
        return _between(subject.intervals.real)
    return Verdict(Size(first_end(linear_problems.real_set(subject.linear))))


@claimed(
    "P. J. van der Houwen, Construction of Integration Formulas (1977), section 2.3",
    kind="number",
    meaning=SEES_ALL,
    is_cheap=False,
    asks="signs",
)
def imaginary_stability(subject: Subject) -> Verdict:
    """The length of the imaginary stability interval: the largest y with |R(z)| ≤ 1 on [−iy,
    iy].
    """
    if not subject.is_linear:
        return Verdict.meaningless(MISSING_BLOCKS)
    if subject.tolerance:
        return _between(subject.intervals.imaginary, is_squared=True)
    squared = first_end(linear_problems.imaginary_set(subject.linear))
    return Verdict(Size(None if squared is None else square_root(squared)))
