"""``gark converge``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, Output, common
from garkcli.cli.problems import ProblemType, find_problem
from garkcli.cli.stepping import applied, positive, rational
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.dynamics.convergence import Convergence
    from garkcli.dynamics.nonlinear import Observation
    from garkcli.dynamics.problems import Oscillator
    from garkcli.methodfile.build import MethodFile
    from garkcli.tableau.tableau import Tableau


@click.command("converge", context_settings=CONTEXT)
@click.argument("file", metavar="FILE")
@click.option(
    "--problem",
    type=ProblemType(),
    default="oscillator",
    show_default=True,
    help="What to solve: a name that gark list shows, or a problem file.",
)
@click.option("--omega", metavar="W", help="The frequency of the oscillator; 1 by default.")
@click.option("--split", metavar="K:V,...", help="The oscillator's shares of kinetic and potential energy.")
@click.option("--seed", type=click.IntRange(0), metavar="N", help="The coefficients of generic; 1 by default.")
@click.option("--t-end", metavar="T", help="The final time; without --drift each problem has its own.")
@click.option("--steps", metavar="H,...", help="Step sizes, instead of a ladder of halvings.")
@click.option("--drift", is_flag=True, help="The energy error over a long time; with --t-end and --step.")
@click.option("--step", metavar="H", help="The step size for --drift.")
@click.option("--plot", metavar="FILE", help="Draw into FILE: .png, .svg or .pdf.")
@common(["text", "json", "csv"])
def command(
    file: str,
    problem: str,
    omega: str | None,
    split: str | None,
    seed: int | None,
    t_end: str | None,
    steps: str | None,
    drift: bool,
    step: str | None,
    plot: str | None,
    output: Output,
) -> int:
    """The convergence test: errors over step sizes, observed against predicted order, energy error.

    The step map of the oscillator is linear and taken exactly. The other problems are nonlinear (split-oscillator
    apart) and stepped with as many digits as their errors need, so that a method of order 12 shows slope 12 and
    not rounding. generic sees every tree. A file with `methods` is tested as its symplectic pair, every other
    file as it stands.

    Exit code 1 when the observed order is not the one the method has on this problem, or a step fails.
    """
    from garkcli.dynamics.problems import Oscillator, parse_shares, terms_of
    from garkcli.methodfile.load import load

    _check_options(problem, omega, split, seed, drift)
    if drift and (steps or not (t_end and step)):
        raise UsageProblem("--drift follows one step size over one time", "give --t-end T and --step H")
    if step and not drift:
        raise UsageProblem("--step is the step size of --drift", "give --steps H,H,... for the convergence test")
    if plot is not None:
        from garkcli.report.plot import check_suffix

        check_suffix(Path(plot))
    method = load(file)
    tableau = applied(method, output)
    time = None if t_end is None else positive("--t-end", t_end)
    if problem != "oscillator":
        return _observe(tableau, problem, seed, method, time, _sizes(steps), plot, output)
    terms = terms_of(tableau)
    frequency = rational("--omega", omega or "1")
    oscillator = (
        Oscillator(frequency, parse_shares(split, terms)) if split else Oscillator.default(terms, frequency)
    )
    if drift:
        return _drift(tableau, oscillator, method.name, time, positive("--step", step), plot, output)
    return _converge(tableau, oscillator, method, time, _sizes(steps), plot, output)


def _check_options(problem: str, omega: str | None, split: str | None, seed: int | None, drift: bool) -> None:
    """Refuse options of another problem: they would change nothing."""
    if problem != "oscillator" and (omega or split or drift):
        given = "--omega" if omega else "--split" if split else "--drift"
        raise UsageProblem(f"{given} is for the oscillator, not for {problem}", "leave it out")
    if problem != "generic" and seed is not None:
        raise UsageProblem(f"--seed is for the problem generic, not for {problem}", "leave it out")


def _sizes(steps: str | None) -> list[fmpq] | None:
    return None if steps is None else [positive("--steps", h) for h in steps.split(",")]


def _converge(
    tableau: Tableau,
    problem: Oscillator,
    method: MethodFile,
    t_end: fmpq | None,
    steps: list[fmpq] | None,
    plot: str | None,
    output: Output,
) -> int:
    from garkcli.dynamics.convergence import converge
    from garkcli.report import convergence as report

    predicted, tolerance = None, 0.0
    if method.tolerance is not None:
        from garkcli.exact.display import to_float
        from garkcli.order.rounded import find_order_within

        predicted, tolerance = find_order_within(tableau, method.tolerance).order, to_float(method.tolerance)
    result = converge(tableau, problem, t_end, steps, predicted, tolerance)
    output.write(report.render(result, method.name, output.format, output.paint))
    _draw(result, plot, output)
    return 0 if result.agrees else 1


def _observe(
    tableau: Tableau,
    name: str,
    seed: int | None,
    method: MethodFile,
    t_end: fmpq | None,
    steps: list[fmpq] | None,
    plot: str | None,
    output: Output,
) -> int:
    """The convergence test on a nonlinear problem."""
    from garkcli.dynamics.nonlinear import observe
    from garkcli.dynamics.step import StepFailed
    from garkcli.dynamics.structure import fitted
    from garkcli.report import convergence as report

    tableau = fitted(tableau)
    problem = find_problem(name, tableau, seed)
    try:
        result = observe(tableau, problem, t_end, steps, method.tolerance)
    except StepFailed as error:
        click.echo(f"gark: {error.message}\nhelp: {error.help}", err=True)
        return 1
    output.write(report.render(result, method.name, output.format, output.paint))
    _draw(result, plot, output)
    return 0 if result.agrees else 1


def _draw(result: Convergence | Observation, plot: str | None, output: Output) -> None:
    if plot is not None:
        from garkcli.report.plot import convergence_figure, save

        save(convergence_figure(result), Path(plot))
        output.note(f"wrote {plot}")


def _drift(
    tableau: Tableau,
    problem: Oscillator,
    name: str,
    t_end: fmpq | None,
    step: fmpq,
    plot: str | None,
    output: Output,
) -> int:
    from garkcli.dynamics.energy import drift
    from garkcli.report import energy as report

    assert t_end is not None
    result = drift(tableau, problem, t_end, step)
    output.write(report.render_drift(result, name, output.format, output.paint))
    if plot is not None:
        from garkcli.report.energy_plot import drift_figure
        from garkcli.report.plot import save

        save(drift_figure(result), Path(plot))
        output.note(f"wrote {plot}")
    return 0
