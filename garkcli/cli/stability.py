"""``gark stability``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.cli import options as opt
from garkcli.cli.arguments import point, ratio, rational, square
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.errors import HasFreeParameters, UsageProblem, did_you_mean
from garkcli.frozen import replace
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.report.stability import StabilityReport
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau


class StabilityOptions(opt.Derivable):
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    at: tuple[tuple[fmpq, fmpq], ...] = opt.repeated(
        "--at", opt.read("Z", point), of="find_stability.at", heading="One λ"
    )
    ratio: tuple[fmpq, ...] = opt.repeated(
        "--ratio", opt.read("Q", ratio), of="find_stability.ratios"
    )
    order_star: bool = opt.flag(
        "--order-star", "In the picture |R(z)| > |exp z| instead.", of="plot.is_order_star"
    )
    slow: str | None = opt.option(
        "--slow",
        opt.text("A"),
        "The slow one of two springs: its (hω)², or A..B for all of them; with --fast.",
        of="two_springs.slow",
        heading="Two springs",
    )
    fast: str | None = opt.FAST
    digits: int = opt.preset(
        "--digits",
        opt.DECIMALS,
        12,
        "Digits of numbers that have no simple radicals.",
        heading="Report",
    )
    seconds: float | None = opt.option(
        "--seconds",
        opt.SECONDS,
        "Seconds of processor time after which the rest is not decided.",
        of="find_stability.seconds",
    )
    plot: str | None = opt.PLOT
    rules = (
        *opt.of_springs(slow),
        opt.excludes((ratio, at), slow, "OPTION does not go with --slow", "leave one of them out"),
        opt.needs(
            order_star,
            (plot, opt.VERBOSE),
            "--order-star is for the picture",
            "give -v or --plot FILE too",
        ),
    )


@declared("stability", StabilityOptions, FORMATS)
def stability(given: StabilityOptions, output: Output) -> None:
    """Stability on linear, oscillating and contractive problems, decided exactly.

    The stability function with A-, L- and A(α)-stability; the trace on the harmonic oscillator with
    its stable intervals, P-stability and phase lag; algebraic stability; the SSP coefficient. With
    free parameters R(z), and the values for which the method is stable.
    """
    from garkcli.methodfile.naming import called
    from garkcli.report.stability import REPORT

    if given.plot is not None and not Path(given.plot).parent.is_dir():
        message = f"cannot write {given.plot}: there is no such folder"
        raise UsageProblem(message, "choose another place", code="cannot-write")
    reports = []
    paths = output.files_meant(given.files, given.settings)
    for file in paths:
        try:
            method = given.method(file, is_any_kind=True)
        except HasFreeParameters as error:
            if len(paths) > 1:
                raise
            from garkcli.cli.tableaux import read_family
            from garkcli.report.every import STABILITY, every_stability

            needs = {
                f"--{given.which}": given.which,
                "--slow": given.slow,
                "--ratio": given.ratio,
                "--at": given.at,
                "--plot": given.plot,
            }
            read, family = read_family(error, given.settings, needs)
            output.tell(STABILITY, every_stability(read.source, read.name, family))
            return
        reports.append(_report(called(file), method, given, output))
    output.tell(REPORT, *reports)
    if given.plot is not None:
        from garkcli.plots.regions import stability_scene

        named = [(x.name, x.found) for x in reports]
        scene = stability_scene(named, given.order_star, reports[0].plane)
        output.save_plot(scene, given.plot)


def colour_named(tableau: Tableau, colour: str) -> int:
    """Returns a colour counted from 1; UsageProblem if the method has no such colour."""
    names = [x.name for x in tableau.colours]
    if colour not in names:
        message = f"--fast: no colour {colour!r}"
        raise UsageProblem(message, did_you_mean(colour, names), code="wrong-value")
    return 1 + names.index(colour)


def _report(
    file: str, method: GarkMethod, given: StabilityOptions, output: Output
) -> StabilityReport:
    from garkcli.api.calls import find_stability, two_springs
    from garkcli.report.stability import StabilityReport
    from garkcli.stability.springs_plane import plane_with_ends_of
    from garkcli.stability.summary import Stability
    from garkcli.stability.two_frequencies import SlowInterval, springs

    tableau = method.tableau
    found = Stability(tableau, (), None, None)
    if given.slow is None:
        found = find_stability(method, **given.of("find_stability"))
    report = StabilityReport(
        file,
        method.name,
        found,
        digits=given.digits,
        derivation=method.derivation,
        is_order_star=given.order_star,
    )
    if given.slow is None or given.fast is None:
        return report
    colour = colour_named(tableau, given.fast)
    low, high = _strengths(given.slow)
    of_springs = two_springs(method, (low, high) if ".." in given.slow else low, colour)
    if isinstance(of_springs, SlowInterval):
        report = replace(report, slow=of_springs)
    else:
        report = replace(report, springs=of_springs)
    if given.plot is None and output.verbosity <= 0:
        return report
    split = springs(tableau, tableau.colours[colour - 1].term)
    return replace(report, plane=plane_with_ends_of(tableau, split, of_springs.stable, high))


def _strengths(slow: str) -> tuple[fmpq, fmpq]:
    first, dots, last = slow.partition("..")
    low = square("--slow", first)
    high = rational("--slow", last) if dots else low
    if dots and not low < high:
        message = f"--slow {slow}: the ends are not in ascending order"
        raise UsageProblem(message, "give --slow A..B", code="option-value")
    return low, high
