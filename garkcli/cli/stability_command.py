"""``gark stability``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, Output, common

if TYPE_CHECKING:
    from garkcli.stability.two_frequencies import TwoFrequencies
    from garkcli.tableau.tableau import Tableau


@click.command("stability", context_settings=CONTEXT)
@click.argument("files", metavar="FILE...", nargs=-1, required=True)
@click.option(
    "--slow",
    metavar="A",
    help="Two springs: (hω)² of the slow one, a rational number; with --fast.",
)
@click.option("--fast", metavar="COLOUR", help="Two springs: the colour of the fast one.")
@click.option(
    "--digits",
    type=click.IntRange(1, 1000),
    default=12,
    show_default=True,
    metavar="N",
    help="Digits of numbers that have no simple radicals.",
)
@common(["text", "json", "latex"])
def command(
    files: tuple[str, ...], slow: str | None, fast: str | None, digits: int, output: Output
) -> int:
    """Stability on linear, oscillating and contractive problems, decided exactly.

    The stability function with A-, L- and A(α)-stability; the trace on the harmonic oscillator,
    its intervals of stability, P-stability, phase lag; algebraic stability; the SSP coefficient.
    """
    from garkcli.errors import UsageProblem
    from garkcli.methodfile.load import load
    from garkcli.report.stability import render
    from garkcli.report.stability_data import StabilityReport
    from garkcli.stability.summary import stability, stability_of_rounded

    if (slow is None) != (fast is None):
        raise UsageProblem("--slow and --fast belong together", "give both")
    reports = []
    for file in files:
        method = load(file)
        springs = None
        if slow is not None and fast is not None:
            if method.tolerance is not None:
                raise UsageProblem(
                    f"{file}: with rounded coefficients nothing is decided about two springs",
                    "give exact coefficients, without tolerance",
                )
            springs = _springs(method.tableau, slow, fast)
        if method.tolerance is None:
            found = stability(method.tableau)
        else:
            found = stability_of_rounded(method.tableau, method.tolerance)
        reports.append(StabilityReport(file, method.name, found, springs, digits))
    output.write(render(reports, output.format, output.paint))
    return 0


def _springs(tableau: Tableau, slow: str, fast: str) -> TwoFrequencies:
    """The two springs that the options ask for."""
    from garkcli.cli.stepping import rational
    from garkcli.errors import UsageProblem, did_you_mean
    from garkcli.stability.two_frequencies import springs, two_frequencies

    names = [colour.name for colour in tableau.colours]
    if fast not in names:
        raise UsageProblem(f"--fast: no colour {fast!r}", did_you_mean(fast, names))
    term = tableau.colours[names.index(fast)].term
    strength = rational("--slow", slow)
    if strength < 0:
        raise UsageProblem(f"--slow {slow}: a square is not negative", "give 0 or more")
    return two_frequencies(tableau, springs(tableau, term), strength)
