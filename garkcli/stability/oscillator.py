"""The harmonic oscillator: the step matrix, its trace, and the stable step sizes.

In the variables (ωq, p) one step is y₁ = M(z) y₀ with z = hω and M rational in z. Its determinant
and its trace are even in z, rational functions of x = z². The eigenvalues are bounded by 1 if

    1 − det M ≥ 0,    1 + det M − tr M ≥ 0,    1 + det M + tr M ≥ 0;

for det M = 1 the last two mean 4D² − N² ≥ 0 with tr M = N/D. If an eigenvalue ±1 is double, powers
of M stay bounded only for M = ±I.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from math import factorial

from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.cells import Interval, Point, is_half_line, sign_of, where
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.frozen import Frozen
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.linear import StepFunction, step_function
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau


class Ratio(Frozen):
    """A rational function in lowest terms; the denominator is 1 at 0."""

    numerator: Polynomial
    denominator: Polynomial

    @classmethod
    def of(cls, numerator: Polynomial, denominator: Polynomial) -> Ratio:
        common = gcd(numerator, denominator)
        over = numerator // common
        under = denominator // common
        unit = ONE / (under[0] or under.leading)
        return cls(over * unit, under * unit)

    @property
    def is_one(self) -> bool:
        return self.numerator == self.denominator


class PhaseError(Frozen):
    """The phase lag z − θ with z = hω and cos θ = tr M / (2 √det M): constant · z^(order+1) + …,
    positive if the numerical solution turns by less than the exact one. For a Runge–Kutta method θ
    is arg R(iz). Source: van der Houwen and Sommeijer, SIAM J. Numer. Anal. 24 (1987), 595–617.

    Attributes:
        order: the phase-lag order; None if the frequency is exact.
        constant: 0 if the frequency is exact; None at order 0, where it may be irrational.
    """

    order: int | None
    constant: Number | None


class OscillatorStability(Frozen):
    """The stability of a method on the oscillator, by the step matrix M(z) in (ωq, p), z = hω.

    ``determinant`` is det M and ``discriminant`` 4D² − N² for tr M = N/D, in x = z²; ``stable`` are
    the x ≥ 0 for which all powers of M are bounded.
    """

    step: StepFunction
    trace: Ratio
    determinant: Ratio
    discriminant: Polynomial
    stable: tuple[Interval, ...]
    phase: PhaseError

    @property
    def is_i_stable(self) -> bool:
        return is_half_line(self.stable)

    @property
    def is_p_stable(self) -> bool:
        """Whether all solutions stay bounded and det M = 1, so that eigenvalues have modulus 1."""
        return self.determinant.is_one and self.is_i_stable

    @property
    def conserved(self) -> tuple[Polynomial, Polynomial, Polynomial] | None:
        """The quadratic form α (ωq)² + β ωqp + γ p² that every step conserves, as (α, β, γ) in z: y
        ↦ det(y, My), up to a factor, for det M = 1; else None.
        """
        if not self.determinant.is_one:
            return None
        (a, b), (c, d) = self.step.numerators
        form = (c, d - a, -b)
        common = Polynomial([])
        for p in form:
            common = gcd(common, p)
        if not common:
            return None  # M is a multiple of the identity: every form is conserved
        reduced = [p // common for p in form]
        numbers = chain.from_iterable(p.coefficients for p in reduced)
        first = next(x for x in numbers if x)
        unit = ONE / first
        alpha, beta, gamma = (p * unit for p in reduced)
        return alpha, beta, gamma


def oscillator_stability(tableau: Tableau, problem: Oscillator) -> OscillatorStability:
    """Returns the stability for every step size; the frequency of ``problem`` is ignored. Raises
    UsageProblem if the split does not suit the structure of the tableau.
    """
    unit = Oscillator(ONE, problem.shares)
    check_structure(tableau, unit)
    return analysed(tableau, [unit.matrix(colour) for colour in tableau.colours])


def usual_oscillator(tableau: Tableau) -> OscillatorStability | None:
    """The method on the oscillator in its usual split; None if there is none."""
    try:
        return oscillator_stability(tableau, Oscillator.default(terms_of(tableau), ONE))
    except UsageProblem:
        return None


def analysed(tableau: Tableau, fields: Sequence[Matrix]) -> OscillatorStability:
    """The stability for fields y ↦ L^m y with L^m = (0, k_m; −v_m, 0) in (ωq, p)."""
    step = step_function(stage_system(tableau, fields))
    (a, b), (c, d) = step.numerators
    poles = _even(step.denominator)
    trace = Ratio.of(_even(a + d), poles)
    determinant = Ratio.of(_even(a * d - b * c), poles * poles)
    N, D = trace.numerator, trace.denominator
    # the entries off the diagonal, odd in z, times z as polynomials in x
    off_diagonal = [Polynomial([ZERO, *p.coefficients[1::2]]) for p in (b, c)]
    return OscillatorStability(
        step=step,
        trace=trace,
        determinant=determinant,
        discriminant=D * D * 4 - N * N,
        stable=stable_set(trace, determinant, off_diagonal, poles),
        phase=phase_error(trace, determinant),
    )


def _even(p: Polynomial) -> Polynomial:
    """A polynomial in z with even powers alone, as one in x = z². Traces and determinants are even:
    reflecting ωq replaces z by −z and keeps them.
    """
    assert not any(p.coefficients[1::2])
    return Polynomial(p.coefficients[::2])


def stable_set(
    trace: Ratio, determinant: Ratio, off_diagonal: Sequence[Polynomial], poles: Polynomial
) -> tuple[Interval, ...]:
    """Returns the x ≥ 0 for which all powers of M are bounded.

    ``off_diagonal`` are two polynomials with the roots of the entries off the diagonal: with a
    double eigenvalue ±1 and det M = 1 the diagonal of M ∓ I is (e, −e) with e² = −bc, so M = ±I if
    both are zero. ``poles`` is the denominator of M in lowest terms: an entry off the diagonal can
    have a pole where trace and determinant have none; there is no step there.
    """
    N, D = trace.numerator, trace.denominator
    P, Q = determinant.numerator, determinant.denominator
    area = Q - P
    right = (Q + P) * D - N * Q
    left = (Q + P) * D + N * Q
    defect = gcd(*off_diagonal)

    def is_stable(x: Point) -> bool:
        sign_d, sign_q = sign_of(D, x), sign_of(Q, x)
        if sign_d == 0 or sign_q == 0 or sign_of(poles, x) == 0:
            return False
        # the conditions are quotients by Q and by D Q
        signs = [sign_of(area, x) * sign_q]
        signs += [sign_of(p, x) * sign_d * sign_q for p in (right, left)]
        if min(signs) < 0:
            return False
        # det M = 1 and tr M = ±2: the eigenvalues are both 1, or both −1
        is_double = signs[0] == 0 and 0 in signs[1:]
        return not is_double or sign_of(defect, x) == 0

    return where(is_stable, [D, Q, area, right, left, defect, poles], start=ZERO)


def phase_error(trace: Ratio, determinant: Ratio) -> PhaseError:
    """The leading term of the phase lag z − θ, by power series in x. With cos θ = tr M / (2 √det
    M), cos² θ − cos² z = 2 sin z cos z (z − θ) + …, where the left-hand side has exact
    coefficients.
    """
    N, D = trace.numerator, trace.denominator
    P, Q = determinant.numerator, determinant.denominator
    # cos² θ = over/under; both are 4 at x = 0, since M is I there
    over = N * N * Q
    under = D * D * P * 4
    terms = 16
    limit = 4 * (over.degree + under.degree) + 40
    while terms <= limit:
        # cos² z = (1 + cos 2z)/2 as a series in x = z²
        series = (fmpq((-4) ** k, 2 * factorial(2 * k)) for k in range(1, terms))
        difference = over - under * Polynomial([ONE, *series])
        known = difference.coefficients[:terms]
        leading = next((k for k, a in enumerate(known) if a), None)
        if leading is not None:
            if leading == 1:  # z − θ is no small part of z
                return PhaseError(0, None)
            # 2 z · c z^(order+1) is the leading term over that of under
            order = 2 * leading - 2
            constant = known[leading] / (under[0] * 2)
            return PhaseError(order, constant)
        terms *= 2
    return PhaseError(None, ZERO)
