"""A long run as the options of ``gark energy`` ask for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from garkcli.cli.options import Output, check_plot
from garkcli.cli.problems import find_problem, is_path, note_changing, unsplit_problem
from garkcli.cli.stepping import given_positive, oscillator, refuse_misplaced
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.longtime.history import LongRun
    from garkcli.longtime.symplecticity import Symplecticity
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Wanted:
    """What is asked for, by the names of the options.

    Attributes:
        file: the method.
        which: "conjugate" or "pair" where that is to step; None for the method itself.
        problem: a name or the path of a problem file.
        omega, split, seed, stiffness: of the problems that take them.
        t_end, step: the time and the step size, as they were written; None for those of the
            problem.
        digits: of the steps, or None for floats.
        points: about how many times are kept.
        symplecticity: whether that of the steps is measured.
        bounded, max_error: what is claimed.
        plot: the file to draw into, if any.
        modified: the order of the modified Hamiltonian to measure in, or None.
    """

    file: str
    which: str | None
    problem: str
    omega: str | None
    split: str | None
    seed: int | None
    stiffness: str | None
    t_end: str | None
    step: str | None
    digits: int | None
    points: int
    symplecticity: bool
    bounded: bool
    max_error: str | None
    plot: str | None
    modified: int | None


def check_wanted(wanted: Wanted) -> None:
    """Refuse options that do not go together, before anything is read.

    Raises:
        UsageProblem: two of them do not.
    """
    of_oscillator = {"--omega": wanted.omega, "--split": wanted.split}
    refuse_misplaced(wanted.problem, wanted.seed, wanted.stiffness, of_oscillator)
    if wanted.problem == "oscillator" and wanted.digits is not None:
        message = "--digits is not for the oscillator: its steps are exact"
        raise UsageProblem(message, "leave it out", code="other-problem")
    check_plot(wanted.plot)


def problem_of(tableau: Tableau, wanted: Wanted, output: Output) -> Oscillator | Problem:
    """The problem in as many terms as the tableau is for."""
    from garkcli.problems.oscillator import terms_of
    from garkcli.stepping.fields import split_into, with_joined_terms

    if wanted.problem == "oscillator":
        return oscillator(tableau, wanted.omega, wanted.split)
    stiffness = given_positive("--stiffness", wanted.stiffness)
    read = unsplit_problem(wanted.problem, stiffness)
    _check_quantities(read, wanted)
    if is_path(wanted.problem):
        problem = split_into(read, terms_of(with_joined_terms(tableau)))
        note_changing(problem, output)
        return problem
    return find_problem(wanted.problem, tableau, wanted.seed, stiffness)


def _check_quantities(problem: Problem, wanted: Wanted) -> None:
    """Refuse to follow what is not there.

    Raises:
        UsageProblem: nothing is conserved, or the problem is not Hamiltonian and its steps are to
            be symplectic.
    """
    from garkcli.problems.hamiltonian import Hamiltonian

    if not problem.quantities:
        raise UsageProblem(
            f"{problem.name} has no energy and no invariants to follow",
            "give invariants in a problem file, or choose a Hamiltonian problem",
            code="other-problem",
        )
    if wanted.symplecticity and not isinstance(problem, Hamiltonian):
        raise UsageProblem(
            f"--symplecticity is for Hamiltonian problems, and {problem.name} is none",
            "leave it out",
            code="other-problem",
        )


def followed(
    method: GarkMethod,
    problem: Oscillator | Problem,
    time: fmpq | None,
    step: fmpq | None,
    wanted: Wanted,
) -> LongRun:
    """The long run.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    from garkcli.api.runs import long_run
    from garkcli.problems.hamiltonian import FLOAT_DIGITS

    return long_run(method, problem, time, step, wanted.digits or FLOAT_DIGITS, wanted.points)


def symplecticity_of(method: GarkMethod, run: LongRun, is_measured: bool) -> Symplecticity | None:
    """Of the steps of ``run``: by the coefficients, and measured where that was asked for; None
    where the problem is not Hamiltonian.
    """
    from garkcli.longtime.symplecticity import (
        Symplecticity,
        holds,
        is_proved,
        symplecticity_defects,
    )
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.righthandside import RightHandSide

    tableau = method.tableau
    if isinstance(run.problem, RightHandSide):
        return None
    if isinstance(run.problem, Oscillator):
        return Symplecticity(holds(tableau, method.tolerance))
    proved = is_proved(tableau, run.problem, method.tolerance)
    if not is_measured:
        return Symplecticity(proved)
    defects = symplecticity_defects(tableau, run.problem, run.step, run.states)
    return Symplecticity(proved, defects)
