"""``gark energy``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli.options import CONTEXT, PATH, Output, common, settings_option
from garkcli.cli.problems import (
    ProblemType,
    find_problem,
    is_path,
    note_changing,
    plot_option,
    problem_options,
    unsplit_problem,
)
from garkcli.cli.stepping import (
    check_plot,
    given_positive,
    oscillator,
    refuse_misplaced,
    stepped_tableau,
)
from garkcli.cli.streams import say_problem
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.longtime.history import LongRun
    from garkcli.longtime.symplecticity import Symplecticity
    from garkcli.methodfile.build import MethodFile
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem
    from garkcli.report.energy_text import Claim
    from garkcli.tableau.tableau import Tableau


NOT_BOUNDED = frozenset({"drifts", "unstable", "undecided"})
"""Verdicts that do not meet ``--bounded``."""


@click.command("energy", context_settings=CONTEXT)
@click.argument("file", type=PATH, metavar="FILE")
@click.option(
    "--problem",
    type=ProblemType(),
    default="oscillator",
    show_default=True,
    help="What to follow: a name that gark list shows, or a problem file.",
)
@problem_options
@click.option(
    "--step", metavar="H", help="The step size; each problem has its own."
)
@click.option(
    "--digits",
    type=click.IntRange(1, 200),
    metavar="N",
    help="Step with N digits instead of floats.",
)
@click.option(
    "--points",
    type=click.IntRange(10, 1_000_000),
    default=2000,
    show_default=True,
    metavar="N",
    help="How many times the plot and --format csv keep, extremes among them.",
)
@click.option(
    "--symplecticity",
    is_flag=True,
    help="Measure MᵀJM − J of steps, M = ∂y₁/∂y₀.",
)
@click.option(
    "--bounded",
    is_flag=True,
    help="Claim that nothing drifts, as far as this run can tell.",
)
@click.option(
    "--max-error",
    metavar="E",
    help="Claim that no energy error is larger than E.",
)
@click.option(
    "--modified",
    type=click.IntRange(1, 100),
    is_flag=False,
    flag_value=5,
    metavar="[ORDER]",
    help="Measure in the modified Hamiltonian of trees up to ORDER, 5 by default, too.",
)
@plot_option
@settings_option
@common(["text", "json", "csv"])
def command(settings: dict[str, str], output: Output, **options: Any) -> int:
    """The energy error over a long time, and that of every other invariant: does it drift?

    A drift is told from the oscillation around it by a fit, and has an uncertainty. The step map of
    the oscillator is linear: there the energy error has no rounding, and whether it is bounded for
    all time is decided exactly. The other problems are stepped in floats with compensated
    summation, or with --digits. A file with `methods` is taken as its symplectic pair, every other
    file as it stands.

    A drift that a slow modulation may explain is undecided, and a longer run proposed.

    Exit code 1 when the claim of --bounded or --max-error fails, a step fails, or the energy blows
    up or the orbit escapes. What is undecided does not meet --bounded.

    With --modified the energy error over step sizes, of H and of its modified Hamiltonian, cut off
    after each power of h: it has the order of the next one. Exit code 1 where it has a lower order.
    """
    from garkcli.methodfile.load import load
    from garkcli.report import energy as report
    from garkcli.report.energy_text import Report
    from garkcli.stepping.step import StepFailed

    wanted = Wanted(**options)
    _check(wanted)
    if wanted.modified is not None:
        return _in_modified(wanted, wanted.modified, settings, output)
    limit = given_positive("--max-error", wanted.max_error)
    time = given_positive("--t-end", wanted.t_end)
    step = given_positive("--step", wanted.step)
    method = load(wanted.file, settings)
    tableau, problem = _at_work(method, wanted, output)
    try:
        run = _run(method, tableau, problem, time, step, wanted, output)
        steps = _symplecticity(tableau, method, run, wanted.symplecticity)
    except StepFailed as error:
        say_problem(error)
        return 1
    claims = _claims(run, wanted.bounded, limit)
    made = Report(method.name, run, steps, claims)
    says_all = output.verbosity >= 0
    output.write(report.render(made, output.format, output.paint, says_all))
    if wanted.plot is not None:
        from garkcli.plots.energy_plot import energy_figure
        from garkcli.plots.saving import save

        save(energy_figure(run), Path(wanted.plot))
        output.note(f"wrote {wanted.plot}")
    is_met = all(claim.holds for claim in claims)
    return 0 if is_met and not run.is_unstable else 1


@dataclass(frozen=True)
class Wanted:
    """What is asked for, by the names of the options.

    Attributes:
        file: the method.
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


def _in_modified(
    wanted: Wanted, order: int, settings: Mapping[str, str], output: Output
) -> int:
    """The energy error in the modified Hamiltonian."""
    from garkcli.cli.modified_energy import measure_modified
    from garkcli.methodfile.load import load

    others = {
        "--omega": wanted.omega,
        "--split": wanted.split,
        "--stiffness": wanted.stiffness,
        "--digits": wanted.digits,
        "--symplecticity": wanted.symplecticity,
        "--bounded": wanted.bounded,
        "--max-error": wanted.max_error,
        "--plot": wanted.plot,
    }
    times = wanted.t_end, wanted.step
    return measure_modified(
        load(wanted.file, settings),
        wanted.problem,
        wanted.seed,
        times,
        order,
        others,
        output,
    )


def _check(wanted: Wanted) -> None:
    """Refuse options that do not go together, before anything is read.

    Raises:
        UsageProblem: two of them do not.
    """
    of_oscillator = {"--omega": wanted.omega, "--split": wanted.split}
    refuse_misplaced(
        wanted.problem, wanted.seed, wanted.stiffness, of_oscillator
    )
    if wanted.problem == "oscillator" and wanted.digits is not None:
        message = "--digits is not for the oscillator: its steps are exact"
        raise UsageProblem(message, "leave it out")
    check_plot(wanted.plot)


def _at_work(
    method: MethodFile, wanted: Wanted, output: Output
) -> tuple[Tableau, Oscillator | Problem]:
    """The tableau that steps, and the problem in as many terms as it is for."""
    from garkcli.problems.hamiltonian import Hamiltonian
    from garkcli.problems.oscillator import terms_of
    from garkcli.stepping.fields import with_joined_terms
    from garkcli.stepping.matching import split_into

    if wanted.problem == "oscillator":
        tableau = stepped_tableau(method, output)
        return tableau, oscillator(tableau, wanted.omega, wanted.split)
    stiffness = given_positive("--stiffness", wanted.stiffness)
    read = unsplit_problem(wanted.problem, stiffness)
    _check_quantities(read, wanted)
    has_momenta = isinstance(read, Hamiltonian)
    tableau = stepped_tableau(method, output, has_momenta=has_momenta)
    tableau = with_joined_terms(tableau)
    if is_path(wanted.problem):
        problem = split_into(read, terms_of(tableau))
        note_changing(problem, output)
        return tableau, problem
    return tableau, find_problem(
        wanted.problem, tableau, wanted.seed, stiffness
    )


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
        )
    if wanted.symplecticity and not isinstance(problem, Hamiltonian):
        raise UsageProblem(
            f"--symplecticity is for Hamiltonian problems, and {problem.name} is none",
            "leave it out",
        )


def _run(
    method: MethodFile,
    tableau: Tableau,
    problem: Oscillator | Problem,
    time: fmpq | None,
    step: fmpq | None,
    wanted: Wanted,
    output: Output,
) -> LongRun:
    """The long run, with a bar on a terminal.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    from garkcli.longtime.history import whole_run
    from garkcli.longtime.longtime import long_run, usual
    from garkcli.page.progress import tracked
    from garkcli.problems.hamiltonian import FLOAT_DIGITS

    h, t_end = whole_run(step, time, *usual(problem))
    shows_bar = output.verbosity >= 0
    return long_run(
        tableau,
        problem,
        t_end,
        h,
        wanted.digits or FLOAT_DIGITS,
        wanted.points,
        method.tolerance,
        lambda path, total: tracked(path, total, "steps", shows_bar),
    )


def _symplecticity(
    tableau: Tableau, method: MethodFile, run: LongRun, is_measured: bool
) -> Symplecticity | None:
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

    if isinstance(run.problem, RightHandSide):
        return None
    if isinstance(run.problem, Oscillator):
        return Symplecticity(holds(tableau, method.tolerance))
    proved = is_proved(tableau, run.problem, method.tolerance)
    if not is_measured:
        return Symplecticity(proved)
    defects = symplecticity_defects(tableau, run.problem, run.step, run.states)
    return Symplecticity(proved, defects)


def _claims(
    run: LongRun, bounded: bool, limit: fmpq | None
) -> tuple[Claim, ...]:
    """What the options claim. What is undecided is not shown to be bounded."""
    from garkcli.exact.display import decimal, to_float
    from garkcli.page.figures import measured
    from garkcli.report.energy_text import Claim

    claims = []
    if bounded:
        wrong = [x for x in run.invariants if x.verdict in NOT_BOUNDED]
        found = ", ".join(f"{x.name} {x.verdict}" for x in wrong)
        claims.append(Claim("bounded", found or "bounded", not wrong))
    if limit is not None:
        # the energy, or of what else is conserved the one with the largest error
        energy = run.energy or max(run.invariants, key=lambda x: x.max_error)
        holds = not run.is_unstable and energy.max_error <= to_float(limit)
        found_error = measured(energy.max_error, energy.round_off)
        claims.append(
            Claim(f"max-error: {decimal(limit)}", found_error, holds)
        )
    return tuple(claims)
