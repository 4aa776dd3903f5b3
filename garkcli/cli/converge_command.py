"""``gark converge``."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garkcli.cli.converging import Problems, Wanted, compared, hint_rounding, tested
from garkcli.cli.options import CONTEXT, PATH, Output, common
from garkcli.cli.problems import (
    ProblemType,
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
    from matplotlib.figure import Figure

AXES = ("h", "evaluations", "seconds")
"""What plots of errors can have below."""


def _moved(_: click.Context, option: click.Parameter, value: object) -> None:
    """Say where an option has gone that earlier versions had."""
    if value:
        raise UsageProblem(
            f"gark converge has no {option.opts[0]}: the energy over a long time is gark energy",
            "gark energy FILE --t-end T --step H",
        )


@click.command("converge", context_settings=CONTEXT)
@click.argument("files", nargs=-1, required=True, type=PATH, metavar="FILE...")
@click.option(
    "--problem",
    type=ProblemType(),
    help="What to solve: a name that gark list shows, or a problem file; by default a random "
    "polynomial that sees every tree of the methods.",
)
@omega_option
@split_option
@seed_option
@t_end_option
@click.option(
    "--steps",
    metavar="H,...",
    help="Step sizes, instead of a ladder of halvings that fits the errors.",
)
@click.option(
    "--work",
    is_flag=True,
    help="Count evaluations, measure time, and plot the errors against them.",
)
@click.option(
    "--against",
    type=click.Choice(AXES),
    help="What plots have below: h, or evaluations with --work; seconds depend on the machine.",
)
@click.option("--drift", is_flag=True, hidden=True, expose_value=False, callback=_moved)
@click.option("--step", hidden=True, expose_value=False, callback=_moved)
@plot_option
@common(["text", "json", "csv"])
def command(
    files: tuple[str, ...],
    problem: str | None,
    omega: str | None,
    split: str | None,
    seed: int | None,
    t_end: str | None,
    steps: str | None,
    work: bool,
    against: str | None,
    plot: str | None,
    output: Output,
) -> int:
    """The convergence test: errors over step sizes, observed against predicted order, energy error.

    Steps are taken with as many digits as the errors need, so that a method of order 12 shows slope
    12 and not rounding; the step map of the oscillator is linear and taken exactly. Without
    --problem it is generic, or its counterpart for separable, semi-separable and Nyström methods:
    these see every tree, others may show a higher order than the method has. A file with `methods`
    is tested as its symplectic pair, every other file as it stands.

    Several FILEs, directories (all *.gark.yaml below them) or patterns are compared, in one table
    and one plot. With --work they are compared by what their errors cost.

    Exit code: 0 every observed order is the one the method has on this problem, 1 one is not, or a
    step fails, 2 a file cannot be read, or its method is not for this problem.
    """
    from garkcli.methodfile.finding import find_files

    paths = list(find_files(files))
    if problem is None and (omega or split):
        problem = "oscillator"  # what these options are for
    if problem is not None:
        refuse_misplaced(problem, seed, {"--omega": omega, "--split": split})
    if omega:
        positive("--omega", omega)
    if against not in (None, "h") and not work:
        raise UsageProblem(
            f"--against {against} is not known without measuring it", "add --work"
        )
    if plot is not None:
        from garkcli.plots.convergence_plot import check_suffix

        check_suffix(Path(plot))
    wanted = Wanted(
        problem,
        omega,
        split,
        seed,
        None if t_end is None else positive("--t-end", t_end),
        None
        if steps is None
        else tuple(positive("--steps", h) for h in steps.split(",")),
        work,
    )
    shown = Shown(work, against or ("evaluations" if work else "h"), plot)
    return (
        _one(paths[0], wanted, shown, output)
        if len(paths) == 1
        else _several(paths, wanted, shown, output)
    )


@dataclass(frozen=True)
class Shown:
    """What of the results is shown.

    Attributes:
        work: whether costs are.
        against: the horizontal axis of plots.
        plot: the file to draw into, if any.
    """

    work: bool
    against: str
    plot: str | None


def _one(path: str, wanted: Wanted, shown: Shown, output: Output) -> int:
    """The test of one method."""
    from garkcli.methodfile.load import load
    from garkcli.report import convergence as report
    from garkcli.report.progress import watching
    from garkcli.stepping.step import StepFailed

    problems = Problems(wanted)
    method = load(path)
    tableau = stepped_tableau(method, output)
    problems.prepare([tableau])
    if problems.read is not None:
        note_changing(problems.read, output)
    try:
        with watching(output.verbosity >= 0) as watch:
            result = tested(method, tableau, wanted, problems, watch)
    except StepFailed as error:
        say_problem(error)
        return 1
    output.write(
        report.render(result, method.name, output.format, output.paint, shown.work)
    )
    hint_rounding(method, tableau, result, output)
    if shown.plot is not None:
        from garkcli.plots.convergence_plot import comparison_figure, convergence_figure

        if shown.against == "h" and not shown.work:
            figure = convergence_figure(result, method.name)
        else:
            figure = comparison_figure([(method.name, result)], shown.against)
        _save(figure, shown, output)
    return int(result.verdict == "disagree")


def _several(paths: list[str], wanted: Wanted, shown: Shown, output: Output) -> int:
    """The comparison; what fails is told, and stops nothing."""
    from garkcli.report import comparison as report

    entries = compared(paths, wanted, output)
    output.write(
        report.render(entries, output.format, output.paint, shown.work, shown.against)
    )
    results = [
        (entry.name, entry.result) for entry in entries if entry.result is not None
    ]
    if shown.plot is not None:
        if results:
            from garkcli.plots.convergence_plot import comparison_figure

            _save(comparison_figure(results, shown.against), shown, output)
        else:
            output.note(f"nothing to draw into {shown.plot}")
    return max(entry.exit_code for entry in entries)


def _save(figure: Figure, shown: Shown, output: Output) -> None:
    from garkcli.plots.convergence_plot import save

    save(figure, Path(shown.plot or ""))
    output.note(f"wrote {shown.plot}")
