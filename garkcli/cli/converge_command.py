"""``gark converge``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, Output, common
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.dynamics.problems import Oscillator
    from garkcli.methodfile.build import MethodFile
    from garkcli.tableau.tableau import Tableau


@click.command("converge", context_settings=CONTEXT)
@click.argument("file", metavar="FILE")
@click.option(
    "--problem", type=click.Choice(["oscillator"]), default="oscillator", show_default=True, help="What to solve."
)
@click.option("--omega", default="1", show_default=True, metavar="W", help="The frequency of the oscillator.")
@click.option("--split", metavar="K:V,...", help="Each term's share of the kinetic and of the potential energy.")
@click.option("--t-end", metavar="T", help="The final time; 4/W without --drift.")
@click.option("--steps", metavar="H,...", help="Step sizes, instead of a ladder of halvings.")
@click.option("--drift", is_flag=True, help="The energy error over a long time; with --t-end and --step.")
@click.option("--step", metavar="H", help="The step size for --drift.")
@click.option("--plot", metavar="FILE", help="Draw into FILE: .png, .svg or .pdf.")
@common(["text", "json", "csv"])
def command(
    file: str,
    problem: str,  # noqa: ARG001 -- one problem so far
    omega: str,
    split: str | None,
    t_end: str | None,
    steps: str | None,
    drift: bool,
    step: str | None,
    plot: str | None,
    output: Output,
) -> int:
    """The convergence test: errors over step sizes, observed against predicted order, energy error.

    The step map of the oscillator is linear and taken exactly, so that a method of order 12 shows slope 12 and
    not rounding. A file with `methods` is tested as its symplectic pair, every other file as it stands.

    Exit code 1 when the observed order is not the one the method has on this problem.
    """
    from garkcli.dynamics.problems import Oscillator, parse_shares, terms_of
    from garkcli.methodfile.load import load

    if drift and (steps or not (t_end and step)):
        raise UsageProblem("--drift follows one step size over one time", "give --t-end T and --step H")
    if step and not drift:
        raise UsageProblem("--step is the step size of --drift", "give --steps H,H,... for the convergence test")
    if plot is not None:
        from garkcli.report.plot import check_suffix

        check_suffix(Path(plot))
    method = load(file)
    tableau = _applied(method, output)
    terms = terms_of(tableau)
    frequency = _rational("--omega", omega)
    oscillator = (
        Oscillator(frequency, parse_shares(split, terms)) if split else Oscillator.default(terms, frequency)
    )
    time = None if t_end is None else _positive("--t-end", t_end)
    if drift:
        return _drift(tableau, oscillator, method.name, time, _positive("--step", step), plot, output)
    sizes = None if steps is None else [_positive("--steps", h) for h in steps.split(",")]
    return _converge(tableau, oscillator, method, time, sizes, plot, output)


def _applied(method: MethodFile, output: Output) -> Tableau:
    """The tableau that steps: the symplectic pair of ``methods``, else what the file gives."""
    from garkcli.errors import ZeroWeight
    from garkcli.tableau.forms import pair

    if method.form != "methods" or method.tableau.is_partitioned:
        return method.tableau
    try:
        return pair(method.tableau)
    except ZeroWeight as error:
        output.note(f"no symplectic pair ({error.message}): tested as a GARK method")
        return method.tableau


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
    if plot is not None:
        from garkcli.report.plot import convergence_figure, save

        save(convergence_figure(result), Path(plot))
        output.note(f"wrote {plot}")
    return 0 if result.agrees else 1


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
    from garkcli.report import convergence as report

    assert t_end is not None
    result = drift(tableau, problem, t_end, step)
    output.write(report.render_drift(result, name, output.format, output.paint))
    if plot is not None:
        from garkcli.report.plot import drift_figure, save

        save(drift_figure(result), Path(plot))
        output.note(f"wrote {plot}")
    return 0


def _positive(option: str, text: str | None) -> fmpq:
    number = _rational(option, text or "")
    if number <= 0:
        raise UsageProblem(f"{option} {text}: a positive number is expected")
    return number


def _rational(option: str, text: str) -> fmpq:
    from garkcli.errors import ExpressionError
    from garkcli.exact.domain import Domain
    from garkcli.exact.expression import parse
    from garkcli.exact.field import Algebraic

    try:
        expression = parse(text)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        raise UsageProblem(f"{option} {text}: {error.message}", error.help) from None
    if isinstance(number, Algebraic):
        raise UsageProblem(f"{option} {text}: a rational number is expected", "such as 1/2")
    return number
