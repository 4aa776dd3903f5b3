"""The convergence test: errors over a ladder of step sizes, against the order they can show.

Slopes at steps of usual size may still be those of larger ones, where the error constant is small
or coefficients are large. Then the order is observed over a short time as well, with steps so small
that nothing is left of that.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from flint import fmpq

from garkcli.convergence import ladder
from garkcli.convergence.result import (
    CLOSE,
    MAX_ORDER,
    Convergence,
    Row,
    Stiffness,
    Visible,
    observed_order,
    stiff_order,
)
from garkcli.convergence.solver import Solver
from garkcli.errors import UsageProblem
from garkcli.order import deciding
from garkcli.order.simplifying import simplifying
from garkcli.problems.builtin import GENERIC, GENERIC_RHS, hamiltonian
from garkcli.problems.generic import generic_rhs
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.problems.problem import Problem, merge_terms
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import bind
from garkcli.stepping.linear import whole_steps
from garkcli.tableau.meant import meant
from garkcli.tableau.tableau import Tableau


def seeing_problem(tableaux: Sequence[Tableau], seed: int = 1) -> str:
    """The name of the problem that sees the most trees and is of the form that the structures of
    all methods are for; of most of them where there is none for all.

    It is Hamiltonian unless no method steps a Hamiltonian one: that is so where a colour is linear
    and drives all unknowns. Then it is the one of right-hand sides, linear for these colours.

    Args:
        tableaux: of the methods, at least one.
        seed: of the random coefficients.

    Raises:
        UsageProblem: it is for none of them.

    >>> from garkcli import loads
    >>> seeing_problem([loads("methods: [{family: rk4}]").tableau])
    'generic'
    """
    counts = {}
    for name in GENERIC:
        problems = in_common(name, tableaux, seed)
        counts[name] = sum(map(_fits, tableaux, problems))
        if counts[name] == len(tableaux):
            return name
    # the first of those that are equal
    most = max(counts, key=lambda name: counts[name])
    if counts[most] == 0:
        sides = in_common(GENERIC_RHS, tableaux, seed)
        if any(map(_fits, tableaux, sides)):
            return GENERIC_RHS
        raise UsageProblem(
            "no problem with random coefficients is of the form that the structure is for",
            "name one with --problem",
            code="other-problem",
        )
    return most


def in_common(name: str, tableaux: Sequence[Tableau], seed: int) -> list[Problem]:
    """The problem called ``name`` for each method, with one sum for all of them.

    Its coefficients depend on the number of terms: all methods get that of the method with the
    most, with terms added up where they have fewer.
    """
    terms = [terms_of(with_joined_terms(tableau)) for tableau in tableaux]
    most = max(terms)
    if name == GENERIC_RHS:
        found = [_linear_terms(x) for x, n in zip(tableaux, terms, strict=True) if n == most]
        widest: Problem = generic_rhs(most, seed, frozenset.union(*found))
    else:
        widest = hamiltonian(name, most, seed)
    return [merge_terms(widest, count) for count in terms]


def _linear_terms(tableau: Tableau) -> frozenset[int]:
    """The terms whose colours are linear."""
    return frozenset(x.term for x in tableau.colours if x.is_linear)


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
) -> Convergence:
    """Test the convergence of ``tableau`` on ``problem``.

    Args:
        tableau: of any structure.
        problem: in as many terms as the tableau is for, or in one that has a natural split. The
            oscillator is solved by the exact step map. By default the problem with random
            coefficients that sees every tree of the structure.
        t_end: the problem's own by default, 4/ω for the oscillator.
        steps: step sizes that divide ``t_end``; by default the ladder of
            ``garkcli.convergence.ladder``.
        tolerance: of rounded coefficients; slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well.
        order: of the tableau, where it is known by more than its coefficients, as that of the pair
            of rounded ones.

    Raises:
        UsageProblem: the problem is not of the form of the structure, a step does not divide
            ``t_end``, or the stage equations of a given step have no unique solution.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.

    >>> from garkcli import hamiltonian, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> result = converge(rk4, hamiltonian("pendulum", 1))
    >>> round(result.observed_order, 1), result.verdict
    (4.0, 'agree')
    """
    problem, t_end = _problem_and_time(tableau, problem, t_end, steps)
    timed = _with_time(tableau, problem)
    if order is None or timed is not tableau:
        order = order_of(timed, tolerance)
    solver = _solver(tableau, problem, t_end, tolerance, order)
    rows, plateau = _rows(solver, steps, is_timed)
    fitted = rows[: len(rows) - plateau]
    stiff = _stiffness(solver, tableau, rows, tolerance)
    observed = observed_order(fitted) if stiff is None else stiff_order(fitted)
    is_exact = tolerance is None
    short_time, short_order = None, None
    if is_exact and _is_off(solver, observed):
        longest = min(t_end, usual_time(problem))
        short_time, short_order = _over_short_times(solver, longest)
    return Convergence(
        solver.problem,
        t_end,
        _with_times(solver, rows) if is_timed else tuple(rows),
        plateau,
        observed,
        order,
        solver.visible,
        short_time,
        short_order,
        is_exact or _has_settled(fitted),
        steps is not None,
        stiff,
        all(row.error.is_zero() for row in rows) and solver.rests(),
    )


def _problem_and_time(
    tableau: Tableau,
    problem: Oscillator | Problem | None,
    t_end: fmpq | None,
    steps: Sequence[fmpq] | None,
) -> tuple[Oscillator | Problem, fmpq]:
    """What was asked for, or the defaults; given steps are checked before any work is done."""
    problem = problem or _seeing_every_tree(tableau)
    t_end = usual_time(problem) if t_end is None else t_end
    if steps is not None:
        check_steps(problem, t_end, steps)
    return problem, t_end


def _with_times(solver: Solver, rows: Sequence[Row]) -> tuple[Row, ...]:
    """The rows with the time of their steps in floats."""
    return tuple(solver.timed(row) for row in rows)


def _has_settled(rows: Sequence[Row]) -> bool:
    """Whether there are as many rows as a slope takes, and it has stopped changing."""
    return len(rows) >= ladder.ROWS and ladder.has_settled(rows)


def _rows(solver: Solver, steps: Sequence[fmpq] | None, is_timed: bool) -> tuple[list[Row], int]:
    """The errors over the given steps or those of the ladder, and how many rows of these end on a
    plateau.
    """
    if steps is None:
        return ladder.default_rows(solver, is_timed)
    rows = _given_rows(solver, steps)
    order = ladder.unspoilt_order(solver, rows[-1].h)
    return rows, ladder.plateau(rows, order, solver.rounding())


def _seeing_every_tree(tableau: Tableau) -> Problem:
    """The problem with random coefficients for one method."""
    name = seeing_problem([tableau])
    (problem,) = in_common(name, [tableau], 1)
    return problem


def _with_time(tableau: Tableau, problem: Oscillator | Problem) -> Tableau:
    """The tableau whose order is the one on problems like this: with time as a colour where there
    is time, because nodes need not be row sums.

    Raises:
        UsageProblem: its stages have no times.
    """
    if isinstance(problem, Oscillator):
        return tableau
    from garkcli.stepping.fields import with_clock

    return with_clock(tableau, problem)


def _stiffness(
    solver: Solver, tableau: Tableau, rows: Sequence[Row], tolerance: fmpq | None
) -> Stiffness | None:
    """Where the steps of all rows are far too large for the problem."""
    resolution = solver.resolution(rows[-1].h)
    if resolution < ladder.STIFF:
        return None
    found = simplifying(meant(tableau, tolerance))
    is_stable = ladder.is_part(rows[-1], solver.size())
    return Stiffness(resolution, found.stage_order, is_stable)


def usual_time(problem: Oscillator | Problem) -> fmpq:
    """The final time of a test where none is given."""
    return 4 / problem.omega if isinstance(problem, Oscillator) else problem.t_end


def most_steps(problem: Oscillator | Problem) -> int:
    """Of one row."""
    if isinstance(problem, Oscillator):
        from garkcli.stepping.linear import MAX_STEPS

        return MAX_STEPS
    from garkcli.convergence import stepped_solver

    return stepped_solver.MAX_STEPS


def check_steps(problem: Oscillator | Problem, t_end: fmpq, steps: Sequence[fmpq]) -> None:
    """Whether step sizes can be taken, before any work is done.

    Raises:
        UsageProblem: a step does not divide the time, or there are too many of them.
    """
    limit = most_steps(problem)
    for h in steps:
        count = whole_steps(t_end, h)
        if count > limit:
            message = f"{count} steps (limit {limit})"
            raise UsageProblem(message, "choose a shorter time or larger steps", code="too-many")


def order_of(tableau: Tableau, tolerance: fmpq | None) -> int:
    """By the certificate, up to ``MAX_ORDER``; within the tolerance of rounded coefficients."""
    return deciding.order_of(meant(tableau, tolerance), MAX_ORDER).order


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
    from garkcli.stepping.fields import visible_tableau, visible_trees
    from garkcli.stepping.integrator import bind

    bound = bind(tableau, problem)
    seen = visible_tableau(bound.tableau, bound.fields)
    order = max(order_of(seen, tolerance), predicted)
    visible = Visible(order, problem.is_generic, visible_trees(bound.fields))
    return SteppedSolver(bound, t_end, visible, tolerance)


def _given_rows(solver: Solver, steps: Sequence[fmpq]) -> list[Row]:
    rows: list[Row] = []
    for h in sorted(set(steps), reverse=True):
        before = rows[-1] if rows else None
        row = solver.row(h, before)
        if row.error.is_zero():
            return [row]
        rows.append(row)
    return rows


def _is_off(solver: Solver, observed: float | None) -> bool:
    """Whether an order is observed that is not the one to be seen."""
    if observed is None:
        return False
    return abs(observed - solver.visible.order) > CLOSE


def _over_short_times(solver: Solver, usual: fmpq) -> tuple[fmpq, float | None]:
    """A short time, and the order over it: the first that is a whole number.

    Where only the visible order can be, shorter times follow while it is larger: a condition that
    is missed by little shows only where the powers of the step are smaller still.
    """
    short, order = usual, None
    for decades in solver.decades:
        short = usual / fmpq(10) ** decades
        order = _order_over(solver.over(short))
        if order is None:
            break
        is_whole = abs(order - round(order)) <= CLOSE
        may_fall = solver.visible.is_sharp and order > solver.visible.order + CLOSE
        if is_whole and not may_fall:
            break
    return short, order


def _order_over(solver: Solver) -> float | None:
    """The order up to the final time; None where the problem or the method has no error there."""
    rows: list[Row] = []
    for n in _SHORT_STEPS:
        before = rows[-1] if rows else None
        row = solver.row(solver.t_end / n, before)
        if row.error.is_zero():
            return None
        rows.append(row)
    return observed_order(rows)
