"""``gark energy``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, PATH, Output, common
from garkcli.cli.problems import (
    ProblemType,
    find_problem,
    is_path,
    note_changing,
    omega_option,
    plot_option,
    seed_option,
    split_option,
    t_end_option,
)
from garkcli.cli.stepping import positive, refuse_misplaced, stepped_tableau
from garkcli.cli.streams import say_problem
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.longtime.history import LongRun
    from garkcli.longtime.symplecticity import Symplecticity
    from garkcli.methodfile.build import MethodFile
    from garkcli.problems.hamiltonian import Hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.report.energy_text import Claim
    from garkcli.tableau.tableau import Tableau


@click.command("energy", context_settings=CONTEXT)
@click.argument("file", type=PATH, metavar="FILE")
@click.option(
    "--problem",
    type=ProblemType(),
    default="oscillator",
    show_default=True,
    help="What to follow: a name that gark list shows, or a problem file.",
)
@omega_option
@split_option
@seed_option
@t_end_option
@click.option("--step", metavar="H", help="The step size; each problem has its own.")
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
    "--max-error", metavar="E", help="Claim that no energy error is larger than E."
)
@plot_option
@common(["text", "json", "csv"])
def command(
    file: str,
    problem: str,
    omega: str | None,
    split: str | None,
    seed: int | None,
    t_end: str | None,
    step: str | None,
    digits: int | None,
    points: int,
    symplecticity: bool,
    bounded: bool,
    max_error: str | None,
    plot: str | None,
    output: Output,
) -> int:
    """The energy error over a long time, and that of every other invariant: does it drift?

    A drift is told from the oscillation around it by a fit, and has an uncertainty. The step map of
    the oscillator is linear: there the energy error has no rounding, and whether it is bounded for
    all time is decided exactly. The other problems are stepped in floats with compensated
    summation, or with --digits. A file with `methods` is taken as its symplectic pair, every other
    file as it stands.

    A drift that a slow modulation may explain is undecided, and a longer run proposed.

    Exit code 1 when the claim of --bounded or --max-error fails, a step fails, or the energy blows
    up or the orbit escapes. What is undecided does not meet --bounded.
    """
    from garkcli.longtime.history import whole_run
    from garkcli.longtime.longtime import long_run, usual
    from garkcli.methodfile.load import load
    from garkcli.problems.hamiltonian import FLOAT_DIGITS
    from garkcli.report import energy as report
    from garkcli.report.energy_text import Report
    from garkcli.report.progress import tracked
    from garkcli.stepping.dependency import with_joined_terms
    from garkcli.stepping.step import StepFailed

    refuse_misplaced(problem, seed, {"--omega": omega, "--split": split})
    if problem == "oscillator" and digits is not None:
        raise UsageProblem(
            "--digits is not for the oscillator: its steps are exact", "leave it out"
        )
    if plot is not None:
        from garkcli.plots.convergence_plot import check_suffix

        check_suffix(Path(plot))
    limit = None if max_error is None else positive("--max-error", max_error)
    time = None if t_end is None else positive("--t-end", t_end)
    size = None if step is None else positive("--step", step)
    method = load(file)
    tableau = stepped_tableau(method, output)
    if problem == "oscillator":
        solved: Oscillator | Hamiltonian = _oscillator(tableau, omega, split)
    else:
        tableau = with_joined_terms(tableau)
        solved = find_problem(problem, tableau, seed)
        if is_path(problem):
            note_changing(solved, output)
    h, end = whole_run(size, time, *usual(solved))
    try:
        run = long_run(
            tableau,
            solved,
            end,
            h,
            digits or FLOAT_DIGITS,
            points,
            method.tolerance,
            lambda path, total: tracked(path, total, "steps", output.verbosity >= 0),
        )
        steps = _symplecticity(tableau, method, run, symplecticity)
    except StepFailed as error:
        say_problem(error)
        return 1
    claims = _claims(run, bounded, limit)
    made = Report(method.name, run, steps, claims)
    output.write(
        report.render(made, output.format, output.paint, output.verbosity >= 0)
    )
    if plot is not None:
        from garkcli.plots.convergence_plot import save
        from garkcli.plots.energy_plot import energy_figure

        save(energy_figure(run), Path(plot))
        output.note(f"wrote {plot}")
    return 0 if all(claim.holds for claim in claims) and not run.is_unstable else 1


def _oscillator(tableau: Tableau, omega: str | None, split: str | None) -> Oscillator:
    """The oscillator of --omega and --split."""
    from garkcli.problems.oscillator import Oscillator, parse_shares, terms_of

    terms = terms_of(tableau)
    frequency = positive("--omega", omega or "1")
    if split:
        return Oscillator(frequency, parse_shares(split, terms))
    return Oscillator.default(terms, frequency)


def _symplecticity(
    tableau: Tableau, method: MethodFile, run: LongRun, is_measured: bool
) -> Symplecticity:
    """Of the steps of ``run``: by the coefficients, and measured where that was asked for."""
    from garkcli.longtime.symplecticity import (
        Symplecticity,
        holds,
        is_proved,
        symplecticity_defects,
    )
    from garkcli.problems.oscillator import Oscillator

    if isinstance(run.problem, Oscillator):
        return Symplecticity(holds(tableau, method.tolerance))
    proved = is_proved(tableau, run.problem, method.tolerance)
    if not is_measured:
        return Symplecticity(proved)
    return Symplecticity(
        proved, symplecticity_defects(tableau, run.problem, run.step, run.states)
    )


def _claims(run: LongRun, bounded: bool, limit: fmpq | None) -> tuple[Claim, ...]:
    """What the options claim. What is undecided is not shown to be bounded."""
    from garkcli.exact.display import decimal, to_float
    from garkcli.report.energy_text import Claim
    from garkcli.report.figures import measured

    claims = []
    if bounded:
        found = [
            f"{x.name} {x.verdict}"
            for x in run.invariants
            if x.verdict in ("drifts", "unstable", "undecided")
        ]
        claims.append(Claim("bounded", ", ".join(found) or "bounded", not found))
    if limit is not None:
        energy = run.energy
        holds = not run.is_unstable and energy.max_error <= to_float(limit)
        found_error = measured(energy.max_error, energy.round_off)
        claims.append(Claim(f"max-error: {decimal(limit)}", found_error, holds))
    return tuple(claims)
