"""The convergence test: errors over a ladder of step sizes, against the order they can show.

Slopes at usual steps may still be those of larger ones, where the error constant is small or
coefficients are large. Then the order is observed over a short time as well, with tiny steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from flint import fmpq

from garkcli.convergence import ladder, result
from garkcli.convergence.ladder import Solver
from garkcli.convergence.solver import ROWS
from garkcli.errors import UsageProblem
from garkcli.order import deciding
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.meant import meant
from garkcli.order.simplifying import simplifying
from garkcli.order.weak_stages import weak_stage_order
from garkcli.problems.builtin import GENERIC, GENERIC_RHS, hamiltonian
from garkcli.problems.generic import generic_rhs
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.problems.problem import Problem, merge_terms
from garkcli.stepping.fields import visible_tableau, visible_trees, with_clock, with_joined_terms
from garkcli.stepping.integrator import bind
from garkcli.stepping.linear import MAX_STEPS, whole_steps
from garkcli.tableau.tableau import Tableau


def seeing_problem(tableaux: Sequence[Tableau], seed: int = 1) -> str:
    """Returns the problem that sees the most trees and suits all methods, or most; UsageProblem
    without one. It is Hamiltonian unless no method steps such a one, as when a linear colour drives
    all.

    >>> from garkcli import loads
    >>> seeing_problem([loads("methods: [{family: rk4}]").tableau])
    'generic'
    """
    counts = {}
    for name in GENERIC:
        counts[name] = sum(map(_fits, tableaux, in_common(name, tableaux, seed)))
        if counts[name] == len(tableaux):
            return name
    # the first of equal ones
    most = max(counts, key=lambda name: counts[name])
    if counts[most] == 0:
        if any(map(_fits, tableaux, in_common(GENERIC_RHS, tableaux, seed))):
            return GENERIC_RHS
        message = "no problem with random coefficients is of the form that the structure is for"
        raise UsageProblem(message, "name one with --problem", code="other-problem")
    return most


def in_common(name: str, tableaux: Sequence[Tableau], seed: int) -> list[Problem]:
    """Returns a problem for each method, with one sum for all: its coefficients depend on the
    number of terms, so all get that of the method with the most, with terms added up for fewer.
    """
    terms = [terms_of(with_joined_terms(tableau)) for tableau in tableaux]
    most = max(terms)
    if name == GENERIC_RHS:
        linear = [
            frozenset(x.term for x in tableau.colours if x.is_linear)
            for tableau, n in zip(tableaux, terms, strict=True)
            if n == most
        ]
        widest: Problem = generic_rhs(most, seed, frozenset.union(*linear))
    else:
        widest = hamiltonian(name, most, seed)
    return [merge_terms(widest, count) for count in terms]


def _fits(tableau: Tableau, problem: Problem) -> bool:
    with suppress(UsageProblem):
        bind(tableau, problem)
        return True
    return False


_SHORT_STEPS = (4, 8, 16, 32)  # in which a short time is stepped through


def converge(
    tableau: Tableau,
    problem: Oscillator | Problem | None = None,
    t_end: fmpq | None = None,
    steps: Sequence[fmpq] | None = None,
    tolerance: fmpq | None = None,
    is_timed: bool = False,
    order: int | None = None,
) -> result.Convergence:
    """Tests the convergence of ``tableau`` on ``problem``, in as many terms or with a natural
    split; the oscillator is solved by the exact step map; by default all trees are seen.

    ``tolerance`` is the rounding of the coefficients; slopes may then end on a plateau. ``order``
    is given if more than the coefficients is known, as for the pair of a rounded method. Raises
    UsageProblem if the problem or a step does not fit, or the stage equations of a given step are
    singular; StepFailed if Newton's method fails for it, or for all of the default ladder.

    >>> from garkcli import hamiltonian, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> result = converge(rk4, hamiltonian("pendulum", 1))
    >>> round(result.observed_order, 1), result.verdict
    (4.0, 'agree')
    """
    if problem is None:
        (problem,) = in_common(seeing_problem([tableau]), [tableau], 1)
    t_end = usual_time(problem) if t_end is None else t_end
    if steps is not None:
        check_steps(problem, t_end, steps)
    # nodes need not be row sums: the order is that with time as a colour
    timed = tableau if isinstance(problem, Oscillator) else with_clock(tableau, problem)
    if order is None or timed is not tableau:
        order = order_of(timed, tolerance)
    solver = _solver(tableau, problem, t_end, tolerance, order)
    rows, plateau = _rows(solver, steps, is_timed)
    fitted = rows[: len(rows) - plateau]
    stiff = _stiffness(solver, tableau, rows, tolerance)
    observed = result.observed_order(fitted) if stiff is None else result.stiff_order(fitted)
    is_exact = tolerance is None
    short_time, short_order = None, None
    is_off = observed is not None and abs(observed - solver.visible.order) > result.CLOSE
    if is_exact and is_off:
        short_time, short_order = _over_short_times(solver, min(t_end, usual_time(problem)))
    return result.Convergence(
        solver.problem,
        t_end,
        tuple(map(solver.timed, rows)) if is_timed else tuple(rows),
        plateau,
        observed,
        order,
        solver.visible,
        short_time,
        short_order,
        is_exact or (len(fitted) >= ROWS and ladder.has_settled(fitted)),
        steps is not None,
        stiff,
        all(row.error.is_zero() for row in rows) and solver.rests(),
    )


def _rows(
    solver: Solver, steps: Sequence[fmpq] | None, is_timed: bool
) -> tuple[list[result.StepSizeRow], int]:
    """The errors over the given steps or the ladder, and the rows at the end on a plateau."""
    if steps is None:
        return ladder.default_rows(solver, is_timed)
    rows = _given_rows(solver, steps)
    order = ladder.unspoilt_order(solver, rows[-1].h)
    return rows, ladder.plateau(rows, order, solver.rounding())


def _stiffness(
    solver: Solver, tableau: Tableau, rows: Sequence[result.StepSizeRow], tolerance: fmpq | None
) -> result.Stiffness | None:
    """The stiffness, if the steps of all rows are far too large for the problem; else None."""
    resolution = solver.resolution(rows[-1].h)
    if resolution < ladder.STIFF:
        return None
    is_stable = ladder.is_part(rows[-1], solver.size())
    if not tableau.has_fields_alone:
        return result.Stiffness(resolution, None, None, is_stable)
    method = meant(tableau, tolerance)
    weak = weak_stage_order(method, range(tableau.size), DEFAULT_LIMIT)
    known_weak = None if weak == DEFAULT_LIMIT else weak
    return result.Stiffness(resolution, simplifying(method).stage_order, known_weak, is_stable)


def usual_time(problem: Oscillator | Problem) -> fmpq:
    return 4 / problem.omega if isinstance(problem, Oscillator) else problem.t_end


def most_steps(problem: Oscillator | Problem) -> int:
    if isinstance(problem, Oscillator):
        return MAX_STEPS
    from garkcli.convergence import stepped_solver

    return stepped_solver.MAX_STEPS


def check_steps(problem: Oscillator | Problem, t_end: fmpq, steps: Sequence[fmpq]) -> None:
    """Raises UsageProblem if a step does not divide the time, or for too many steps."""
    limit = most_steps(problem)
    for h in steps:
        count = whole_steps(t_end, h)
        if count > limit:
            message = f"{count} steps (limit {limit})"
            raise UsageProblem(message, "choose a shorter time or larger steps", code="too-many")


def order_of(tableau: Tableau, tolerance: fmpq | None) -> int:
    """The order by the certificate, up to ``MAX_ORDER``, within the tolerance."""
    return deciding.order_of(meant(tableau, tolerance), result.MAX_ORDER).order


def _solver(
    tableau: Tableau,
    problem: Oscillator | Problem,
    t_end: fmpq,
    tolerance: fmpq | None,
    predicted: int,
) -> Solver:
    if isinstance(problem, Oscillator):
        from garkcli.convergence.linear_solver import linear_solver

        return linear_solver(tableau, problem, t_end, tolerance, predicted)
    from garkcli.convergence.stepped_solver import SteppedSolver

    bound = bind(tableau, problem)
    order = max(order_of(visible_tableau(bound.tableau, bound.fields), tolerance), predicted)
    visible = result.Visible(order, problem.is_generic, visible_trees(bound.fields))
    return SteppedSolver(bound, t_end, visible, tolerance)


def _given_rows(solver: Solver, steps: Sequence[fmpq]) -> list[result.StepSizeRow]:
    rows: list[result.StepSizeRow] = []
    for h in sorted(set(steps), reverse=True):
        row = solver.row(h, rows[-1] if rows else None)
        if row.error.is_zero():
            return [row]
        rows.append(row)
    return rows


def _over_short_times(solver: Solver, usual: fmpq) -> tuple[fmpq, float | None]:
    """A short time with a whole order over it. If only the visible order is possible, shorter times
    follow while it is larger: a nearly satisfied condition shows only at smaller steps.
    """
    short, order = usual, None
    for decades in solver.decades:
        short = usual / fmpq(10) ** decades
        over = solver.over(short)
        rows = _given_rows(over, [over.t_end / n for n in _SHORT_STEPS])
        order = None if rows[-1].error.is_zero() else result.observed_order(rows)
        if order is None:
            break
        is_whole = abs(order - round(order)) <= result.CLOSE
        may_fall = solver.visible.is_sharp and order > solver.visible.order + result.CLOSE
        if is_whole and not may_fall:
            break
    return short, order
