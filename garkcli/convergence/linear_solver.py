"""Solves the oscillator by powers of the exact R(h), enclosed in as many bits as the error needs: a
slope is never one of rounding errors.
"""

from __future__ import annotations

from itertools import islice
from math import ceil, factorial

from flint import arb, arb_mat, ctx, fmpq

from garkcli.convergence.result import StepSizeRow, Visible, absolute, slope_between
from garkcli.convergence.solver import MAX_DIGITS, REACHED, NoUniqueStep, cost_of, work_of
from garkcli.errors import UsageProblem
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Mutable, field, replace
from garkcli.problems.expr import rational
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.vectorfield import symbols
from garkcli.stepping import linear
from garkcli.stepping.integrator import Integrator, Stepper, bind
from garkcli.stepping.linearly_implicit import LinearlyImplicit
from garkcli.tableau.along_flow import AlongFlow
from garkcli.tableau.tableau import Tableau

ERROR_BITS = 40
"""Correct bits of every error."""
ENERGY_BITS = 20
LINEAR_ONLY = (
    "a linear problem sees only the unbranched trees: "
    "it can show an order too high, never one too low"
)
_FIRST_BITS = 128
# balls are as exact as the smallest errors need
_DECADES = (6, 12, 24, 48, 96, 192, 384)
# digits of an error by which steps and the step map have to agree
_AGREEING = 8


class LinearSolver(Mutable):
    """A method on the oscillator with q(0) = 1, p(0) = ω/2; ``spoilt`` is rounding in R(1/ω)."""

    tableau: Tableau
    step: linear.LinearStep
    t_end: fmpq
    visible: Visible
    spoilt: arb = field(default_factory=arb)
    most_steps: int = linear.MAX_STEPS
    decades: tuple[int, ...] = _DECADES
    integrators: dict[int, Integrator] = field(default_factory=dict)

    @property
    def problem(self) -> Oscillator:
        return self.step.problem

    @property
    def unit(self) -> fmpq:
        """1/ω."""
        return 1 / self.problem.omega

    @property
    def longest(self) -> fmpq:
        """ωh = 1/2, where the first terms of the expansion in h dominate."""
        return self.unit / 2

    def is_too_short(self, h: fmpq) -> bool:  # noqa: ARG002 -- none is
        """Never: the unit of time of the oscillator is its period."""
        return False

    def resolution(self, h: fmpq) -> float:  # noqa: ARG002 -- of all steps
        """0: the oscillator is never taken to be stiff."""
        return 0.0

    def row(self, h: fmpq, before: StepSizeRow | None) -> StepSizeRow:
        """Errors to ``ERROR_BITS``; NoUniqueStep if the stage equations are singular at h."""
        steps = linear.whole_steps(self.t_end, h)
        try:
            R = self.step.at(h)
        except UsageProblem as pole:
            raise NoUniqueStep(pole.message, pole.help, code=pole.code) from None
        error, energy_error = _errors(R, steps, self.problem.omega, self.t_end)
        return StepSizeRow(h, error, slope_between(before, h, error), energy_error)

    def size(self) -> arb:
        """|q| + |p/ω| at the start plus that at the end."""
        omega = self.problem.omega
        q, p = _solution(omega, self.t_end)
        return arb(fmpq(3, 2)) + abs(q) + abs(p / omega)

    def rests(self) -> bool:
        """Never at a rational time, where sines and cosines are irrational."""
        return False

    def rounding(self) -> arb:
        time = arb(self.t_end / self.unit)
        return self.size() * self.spoilt * max(arb(1), time)

    def over(self, t_end: fmpq) -> LinearSolver:
        return replace(self, t_end=t_end)

    def timed(self, row: StepSizeRow) -> StepSizeRow:
        """The row with its cost, in floats if these reach its error; none below ``MAX_DIGITS``."""
        steps = linear.whole_steps(self.t_end, row.h)
        y, cost = work_of(self._integrator(FLOAT_DIGITS), row.h, steps)
        if abs(self._distance(y) - row.error) < REACHED * row.error:
            return replace(row, cost=cost)
        decades = float(row.error.log() / arb(10).log())
        digits = 10 * ceil((_AGREEING - decades) / 10)
        if digits > MAX_DIGITS:
            return row
        state = Stepper(self._integrator(digits), row.h)
        state.advance(steps)
        return replace(row, cost=cost_of(state))

    def _integrator(self, digits: int) -> Integrator:
        if digits not in self.integrators:
            problem = hamiltonian_of(self.problem, self.t_end)
            self.integrators[digits] = bind(self.tableau, problem).at(digits)
        return self.integrators[digits]

    def _distance(self, y: list[float]) -> arb:
        """‖(Δq, Δp/ω)‖₂ of a state in floats from the solution at the final time."""
        omega = self.problem.omega
        with ctx.workprec(_FIRST_BITS):
            q, p = _solution(omega, self.t_end)
            dq = y[0] - q
            dp = (y[1] - p) / omega
            return arb(dq**2 + dp**2).sqrt()


def linear_solver(
    tableau: Tableau,
    problem: Oscillator,
    t_end: fmpq,
    tolerance: fmpq | None = None,
    predicted: int = 0,
) -> LinearSolver:
    """The visible order is at least ``predicted``; UsageProblem if the split does not suit."""
    implicit = LinearlyImplicit.of(tableau)
    if implicit is not None and implicit.taken != "exact":
        message = "the oscillator takes R(z) exactly, which is that of the exact Jacobian"
        raise UsageProblem(message, "name another problem", code="other-problem")
    made = implicit.on_linear_problems if implicit else tableau
    if tableau.uses_derivatives:
        made = AlongFlow.of(tableau).on_test_equation
    step = linear.linear_step(made, problem)
    met = linear.visible_order(step, tolerance)
    order = max(met, predicted)
    # where the next condition itself is below the tolerance nothing is known of it
    is_sharp = True
    spoilt = arb(0)
    if tolerance is not None:
        is_sharp = fmpq(1, factorial(order + 1)) > tolerance
        spoilt = sum(islice(linear.deviations(step), met), arb(0))
    return LinearSolver(tableau, step, t_end, Visible(order, is_sharp, LINEAR_ONLY), spoilt)


def _solution(omega: fmpq, t: fmpq) -> tuple[arb, arb]:
    """(q, p) at time t, from q(0) = 1 and p(0) = ω/2, at the current precision."""
    sine, cosine = arb(omega * t).sin_cos()
    q = cosine + sine / 2
    p = (cosine / 2 - sine) * omega
    return q, p


def _errors(R: Matrix, n: int, omega: fmpq, t_end: fmpq) -> tuple[arb, arb]:
    """Error and energy error of y_n = Rⁿ y₀. The loop ends because the error is not zero: R and y₀
    are algebraic, cos ωt and sin ωt are not (Lindemann). The energy error can be zero, so four
    times the bits suffice; then it is a ball about 0.
    """
    bits, enough = _FIRST_BITS, 0
    is_conserved = linear.conserves_energy(R, omega)
    while True:
        with ctx.workprec(bits):
            error, energy_error = _errors_of(linear.enclosure(R, bits) ** n, omega, t_end)
        if error.rel_accuracy_bits() >= ERROR_BITS:
            if is_conserved:
                return error, arb(0)
            enough = enough or 4 * bits
            is_sharp = energy_error.rel_accuracy_bits() >= ENERGY_BITS
            if is_sharp or bits >= enough:
                return error, energy_error
        bits *= 2


def _errors_of(power: arb_mat, omega: fmpq, t: fmpq) -> tuple[arb, arb]:
    q0, p0 = arb(1), arb(omega) / 2
    q = power[0, 0] * q0 + power[0, 1] * p0
    p = power[1, 0] * q0 + power[1, 1] * p0
    exact_q, exact_p = _solution(omega, t)
    dq, dp = q - exact_q, (p - exact_p) / omega
    kinetic = p * p - p0 * p0
    potential = arb(omega) ** 2 * (q * q - q0 * q0)
    error = (dq * dq + dp * dp).sqrt()
    return error, absolute((kinetic + potential) / 2)


def hamiltonian_of(oscillator: Oscillator, t_end: fmpq) -> Hamiltonian:
    (q,) = symbols(("q",), "q")
    (p,) = symbols(("q",), "p")
    omega = rational(oscillator.omega)
    terms = []
    for k, v in oscillator.shares:
        kinetic = rational(k) * p**2 / 2
        terms.append(kinetic + rational(v) * omega**2 * q**2 / 2)
    start = (fmpq(1), oscillator.omega / 2)
    return Hamiltonian("oscillator", ("q",), tuple(terms), start, t_end)
