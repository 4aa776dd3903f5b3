"""The energy error of a symplectic method, measured in its modified Hamiltonian.

H̃ = H + h^k H_k + …, truncated after some power of h, changes along the numerical solution by h^m
(H_m(y) − H_m(y_0)) + …, with the next power h^m, up to times that grow exponentially with 1/h. So
its error has order m, while that of H has the order of the method. Source: Hairer, Lubich and
Wanner, *Geometric Numerical Integration*, 2nd ed. (2006), theorem IX.8.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from math import log10
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.backward.formulas import ModifiedFormula, modified_formula
from garkcli.convergence.ladder import has_settled
from garkcli.convergence.result import CLOSE, StepSizeRow, observed_order, slope_between
from garkcli.doing import counting
from garkcli.errors import UsageProblem
from garkcli.frozen import Frozen, Mutable
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import is_constant, symbols
from garkcli.stepping.integrator import Binding, bind, trajectory
from garkcli.stepping.linear import whole_steps
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import GarkMethod


ROWS = 5
"""Number of step sizes; up to ``MAX_ROWS`` if the slopes have not settled."""
MAX_ROWS = 7
MAX_STEPS = 20_000
_DIGITS = 30  # of the first look
_MOST_DIGITS = 200
_SPARE = 15  # digits of the smallest error
_LOST = 4  # digits that steps and formulas lose, besides those of their number


class Meter(Mutable):
    """Measures the energy error with each truncation of the modified Hamiltonian. ``formulas`` are
    H and the coefficients of ``powers`` of h, 0 first.
    """

    bound: Binding
    formulas: Sequence[Any]
    powers: Sequence[int]
    t_end: fmpq
    digits: int = _DIGITS

    def choose_digits(self, first: int, order: int) -> None:
        """Sets the digits such that the smallest error, about h^order, is far above rounding."""
        while True:
            smallest = self.errors(first)[-1]
            is_seen = not smallest.contains(0)
            if is_seen or self.digits >= _MOST_DIGITS:
                break
            self.digits = min(2 * self.digits, _MOST_DIGITS)
        if is_seen:
            fall = arb(2) ** (-order * (MAX_ROWS - 1))
            needed = _places(smallest.mid() * fall) + _SPARE
            self.digits = min(max(self.digits, needed), _MOST_DIGITS)

    def table(self, first: int) -> list[list[StepSizeRow]]:
        table: list[list[StepSizeRow]] = []
        for k in range(MAX_ROWS):
            count = first * 2**k
            h = self.t_end / count
            columns = zip(*table, strict=True)
            if k >= ROWS and (count > MAX_STEPS or all(map(slopes_have_settled, columns))):
                break
            row = []
            for i, error in enumerate(self.errors(count)):
                before = table[-1][i] if table else None
                slope = slope_between(before, h, error)
                row.append(StepSizeRow(h, error, slope, error, digits=self.digits))
            table.append(row)
        return table

    def errors(self, count: int) -> list[arb]:
        """The root mean square over time of H̃(y_n) − H̃(y_0) for each truncation."""
        integrator = self.bound.at(self.digits)
        h = self.t_end / count
        variables = self.bound.problem.variables
        q = symbols(variables, "q")
        p = symbols(variables, "p")
        path = counting(f"h = {h}", trajectory(integrator, h, count), count + 1)
        with ctx.workprec(integrator.bits):
            values_of = function(tuple(self.formulas), (*q, *p), True)
            squares = [arb(0) for _ in self.powers]
            start: list[arb] = []
            for n, y in enumerate(path):
                amounts = zip(self.powers, values_of(*y), strict=True)
                # H̃ up to each of the powers
                values = list(accumulate(value * arb(h**power) for power, value in amounts))
                start = start or values
                for k, first in enumerate(start):
                    square = (values[k] - first).mid() ** 2
                    # the trapezoidal rule; the change is 0 at the start
                    squares[k] += square / 2 if n == count else square
            sizes = [abs(x) for x in start]
            rounding = arb(10) ** (_LOST - self.digits)
            noise = sum(sizes, arb(1)) * rounding * count
            means = [(x / count).sqrt() for x in squares]
            # with what rounding can have done to them
            return [arb(x.mid(), noise.mid()) for x in means]


def are_above_noise(rows: Sequence[StepSizeRow]) -> bool:
    return not any(row.error.contains(0) for row in rows)


def slopes_have_settled(rows: Sequence[StepSizeRow]) -> bool:
    """Whether the errors of one truncation show an order, as in a convergence test."""
    are_enough = len(rows) >= ROWS
    return are_enough and are_above_noise(rows) and has_settled(rows)


def _places(x: arb) -> int:
    mantissa, exponent = x.mid().man_exp()
    bits = mantissa.bit_length() + int(exponent)
    return max(0, round(-bits * log10(2)))


Verdict: TypeAlias = Literal["agree", "disagree", "undecided"]
_BEYOND = 3  # further orders in which the next power of h is sought


class ModifiedEnergy(Frozen):
    """The error of the modified Hamiltonian up to some power of h.

    Attributes:
        power: the power of its last term; 0 is H itself.
        exact_order: the next power, or if it is a lower bound the first that was not examined.
        is_lower_bound: whether that power was not examined.
        rows: step sizes and the root mean squares of H̃(y_n) − H̃(y_0) over time.
        observed_order: extrapolated from the last rows; None if errors are below round-off.
        uncertainty: how much the last row has changed that; None without an order.
        has_settled: whether the slopes have settled, as in a convergence test.
    """

    power: int
    exact_order: int
    is_lower_bound: bool
    rows: tuple[StepSizeRow, ...]
    observed_order: float | None
    uncertainty: float | None
    has_settled: bool

    @property
    def verdict(self) -> Verdict:
        """Compares both orders; undecided if slopes have not settled, or errors are too small, as
        for constant H_m.
        """
        if self.observed_order is None or not self.has_settled:
            return "undecided"
        excess = self.observed_order - self.exact_order
        if excess < -CLOSE:
            return "disagree"
        return "agree" if self.is_lower_bound or excess <= CLOSE else "undecided"

    def __repr__(self) -> str:
        return f"<ModifiedEnergy h^{self.power}: {self.verdict}>"


class ModifiedRun(Shown, Frozen):
    """Energy errors in H and in its modifications.

    Attributes:
        problem: in as many terms as the method has.
        t_end: the final time.
        max_order: of the trees in the modified Hamiltonian.
        digits: of the steps.
        energies: by ascending powers of h, H first.
        method: the method, if more than its tableau is known.
    """

    problem: Hamiltonian
    t_end: fmpq
    max_order: int
    digits: int
    energies: tuple[ModifiedEnergy, ...]
    method: GarkMethod | None = None

    @property
    def is_refuted(self) -> bool:
        """Whether an observed order is below the exact one."""
        return any(x.verdict == "disagree" for x in self.energies)

    def __repr__(self) -> str:
        found = ", ".join(f"h^{x.power} {x.verdict}" for x in self.energies)
        return f"<ModifiedRun {self.problem.name}: {found}>"


def modified_run(
    tableau: Tableau,
    problem: Hamiltonian,
    max_order: int,
    t_end: fmpq | None = None,
    longest: fmpq | None = None,
) -> ModifiedRun:
    """Measures the error of a symplectic method on ``problem`` in its modified Hamiltonian, with
    powers of h up to one less than ``max_order`` and steps up to ``longest``. Raises UsageProblem
    if the method is not symplectic or consistent, or for too much work; StepFailed if a step was
    not solved.

    >>> from garkcli import hamiltonian, load
    >>> verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    >>> run = modified_run(verlet, hamiltonian("pendulum", 2), 3)
    >>> [(x.power, x.exact_order, x.verdict) for x in run.energies]
    [(0, 2, 'agree'), (2, 4, 'agree')]
    """
    formula = modified_formula(tableau, problem, max_order)
    if formula.of != "hamiltonian":
        message = "the method has no modified Hamiltonian: it is not symplectic by its coefficients"
        cure = "gark modified shows its modified equation"
        raise UsageProblem(message, cure, code="not-symplectic")
    if not formula.is_consistent:
        message = "the method is not consistent"
        raise UsageProblem(message, "it approximates no solution", code="not-consistent")
    powers, formulas = _changing(formula)
    following = [(power, False) for power in powers[1:]]
    following.append(_next_power(tableau, formula))
    bound = bind(tableau, problem)
    t_end = problem.t_end if t_end is None else t_end
    if longest is None:
        longest = problem.long_run[0] if problem.long_run else t_end / 40
    whole_steps(t_end, t_end)  # refuses a time that is not positive
    count = int((t_end / longest).ceil())
    if count * 2 ** (ROWS - 1) > MAX_STEPS:
        message = f"{count * 2 ** (ROWS - 1)} steps (limit {MAX_STEPS})"
        raise UsageProblem(message, "choose a shorter time or a larger step", code="too-many")
    first = max(count, 2)
    meter = Meter(bound, formulas, powers, t_end)
    meter.choose_digits(first, following[-1][0])
    table = meter.table(first)
    energies = []
    for k, (power, (order, is_lower_bound)) in enumerate(zip(powers, following, strict=True)):
        energies.append(_energy(power, order, is_lower_bound, tuple(row[k] for row in table)))
    return ModifiedRun(formula.problem, t_end, max_order, meter.digits, tuple(energies))


def _changing(formula: ModifiedFormula) -> tuple[list[int], list[Any]]:
    powers, formulas = [], []
    for term in formula.terms:
        (expression,) = term.formulas
        if term.power == 0 or not is_constant(expression):
            powers.append(term.power)
            formulas.append(expression)
    return powers, formulas


def _next_power(tableau: Tableau, formula: ModifiedFormula) -> tuple[int, bool]:
    for order in range(formula.max_order + 1, formula.max_order + _BEYOND + 1):
        try:
            longer = modified_formula(tableau, formula.problem, order)
        except UsageProblem:  # too many trees
            return order - 1, True
        powers, _ = _changing(longer)
        if powers[-1] == order - 1:
            return order - 1, False
    return formula.max_order + _BEYOND, True


def _energy(
    power: int, order: int, is_lower_bound: bool, rows: tuple[StepSizeRow, ...]
) -> ModifiedEnergy:
    are_seen = are_above_noise(rows)
    observed = observed_order(rows) if are_seen else None
    before = observed_order(rows[:-1]) if are_seen else None
    uncertainty = None
    if observed is not None and before is not None:
        uncertainty = abs(observed - before)
    return ModifiedEnergy(
        power=power,
        exact_order=order,
        is_lower_bound=is_lower_bound,
        rows=rows,
        observed_order=observed,
        uncertainty=uncertainty,
        has_settled=slopes_have_settled(rows),
    )
