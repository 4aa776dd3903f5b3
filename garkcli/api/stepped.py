"""The GARK methods that take the steps of Nyström and nonlinearly partitioned methods."""

from __future__ import annotations

import os

from flint import fmpq

from garkcli.api.problems import OSCILLATOR, AnyProblem, demand_name
from garkcli.constructions.nprk import additive, is_nprk
from garkcli.constructions.nystrom import Nystrom, Which, is_nystrom, seen
from garkcli.convergence.result import MAX_ORDER
from garkcli.errors import UsageProblem
from garkcli.order.deciding import order_of
from garkcli.order.meant import AnyTableau, keep, meant, printed
from garkcli.problems import builtin
from garkcli.problems.files.load import load_problem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.vectorfield import symbols
from garkcli.tableau.tableau import Tableau

WITH_VELOCITIES = "damped-pendulum"
"""The default problem for Nyström methods with y′."""


def stepped(
    tableau: Tableau, tolerance: fmpq | None, problem: AnyProblem | None
) -> tuple[Tableau, AnyProblem | None, int | None]:
    """Returns the tableau that takes the steps, the problem, and the order if it differs.

    A Nyström method solves q̇ = p, ṗ = g(q) as a partitioned method, and ṗ = g(q, p) as one whose
    two vector fields drive all unknowns; a nonlinearly partitioned one solves f₁(y) + f₂(y). Raises
    UsageProblem unless the problem is q″ = g(q, q′), without q′ if the method is for q″ = g(q).
    """
    if is_nprk(tableau):
        made = additive(tableau)
        method = meant(tableau, tolerance)
        if not isinstance(method, Tableau):
            rounded = method.derive("additive", additive)
            keep(rounded)
            made = printed(rounded)
        return made, problem, None
    if not is_nystrom(tableau):
        return tableau, problem, None
    has_velocities = Nystrom.of(tableau).A is not None
    if problem is None and has_velocities:
        problem = WITH_VELOCITIES
    found = _read(problem)
    if found is None or isinstance(found, (Hamiltonian, Oscillator)):
        return _seen(tableau, tolerance, "partitioned"), problem, None
    _check(found, has_velocities)
    order = order_of(meant(tableau, tolerance), MAX_ORDER).order
    return _seen(tableau, tolerance, "split"), problem, order


def _seen(tableau: Tableau, tolerance: fmpq | None, which: Which) -> Tableau:
    made: AnyTableau = seen(meant(tableau, tolerance), which)
    if not isinstance(made, Tableau):
        keep(made)
    return printed(made)


def _read(problem: AnyProblem | None) -> Problem | Oscillator | None:
    """Returns the problem, a named one in two terms; None for any Hamiltonian one."""
    if problem is None or isinstance(problem, (Problem, Oscillator)):
        return problem
    demand_name(problem)
    name = os.fspath(problem)
    if name == OSCILLATOR:
        return None
    return load_problem(name) if builtin.is_path(name) else builtin.problem(name, 2)


def _check(problem: RightHandSide, has_velocities: bool) -> None:
    unknowns = symbols(problem.variables, "y")
    d = len(unknowns) // 2
    is_of_form = len(unknowns) == 2 * d and len(problem.terms) == 2 and not problem.has_time
    if is_of_form:
        first, second = problem.terms
        is_of_form = tuple(first) == (*unknowns[d:], *(0 for _ in range(d)))
        is_of_form = is_of_form and not any(tuple(second)[:d])
    cure = "choose a Hamiltonian problem with ½|p|²"
    if not is_of_form:
        message = f"a Nyström method is for q″ = g(q, q′), and {problem.name} is not written so"
        cure += f", or one in the terms (q′, 0) and (0, g), such as {WITH_VELOCITIES}"
        raise UsageProblem(message, cure, code="other-problem")
    if not has_velocities:
        message = f"the method is for q″ = g(q), and {problem.name} has q′"
        raise UsageProblem(message, cure, code="other-problem")
