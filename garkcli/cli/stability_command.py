"""``gark stability``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.cli.companion import exact_companion
from garkcli.cli.options import (
    Output,
    check_plot,
    declared,
    files_meant,
    refuse_settings_of_several,
    save_plot,
)
from garkcli.errors import HasFreeParameters, UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from flint import fmpq

    from garkcli.report.stability import StabilityReport
    from garkcli.tableau.garkmethod import GarkMethod


@declared("stability", FORMATS)
def command(
    files: tuple[str, ...],
    which: str | None,
    slow: str | None,
    fast: str | None,
    ratio: tuple[str, ...],
    digits: int,
    plot: str | None,
    order_star: bool,
    settings: dict[str, str],
    output: Output,
) -> int:
    """Stability on linear, oscillating and contractive problems, decided exactly.

    The stability function with A-, L- and A(α)-stability; the trace on the harmonic oscillator,
    its intervals of stability, P-stability, phase lag; algebraic stability; the SSP coefficient.
    Of a file with free parameters R(z) with these, and for which values it is stable.
    """
    from garkcli.methodfile.load import load
    from garkcli.report.stability import REPORT

    _check_options(slow, fast, plot, order_star)
    ratios = [_ratio(text) for text in ratio]
    reports = []
    paths = files_meant(files, output)
    refuse_settings_of_several(settings, paths)
    for file in paths:
        try:
            source = load(file, settings)
            method = exact_companion(source, which)
        except HasFreeParameters as error:
            if len(paths) > 1:
                raise
            wants_numbers = {f"--{which}": which, "--slow": slow, "--ratio": ratio, "--plot": plot}
            return _for_every_value(error, settings, wants_numbers, output)
        if slow is None or fast is None:
            reports.append(_whole_report(source.source, method, digits, ratios))
        else:
            reports.append(
                _springs_report(source.source, method, digits, slow, fast, plot is not None)
            )
    output.tell(REPORT, reports)
    if plot is not None:
        from garkcli.plots.regions import stability_scene

        save_plot(stability_scene(reports, order_star), plot, output)
    return 0


def _check_options(slow: str | None, fast: str | None, plot: str | None, order_star: bool) -> None:
    """Whether options that need one another are given together, before any work is done.

    Raises:
        UsageProblem: one of them is missing, or there can be no such picture.
    """
    if (slow is None) != (fast is None):
        raise UsageProblem("--slow and --fast belong together", "give both", code="option-alone")
    if order_star and plot is None:
        raise UsageProblem(
            "--order-star is for the picture", "give --plot FILE too", code="option-alone"
        )
    if plot is not None:
        _check_plot(plot)


def _for_every_value(
    error: HasFreeParameters,
    settings: dict[str, str],
    wants_numbers: Mapping[str, object],
    output: Output,
) -> int:
    """A file with free parameters: R(z), and for which values it is stable."""
    from garkcli.cli.every import read_family, refuse_numbers
    from garkcli.report.every import STABILITY, every_stability

    file, family = read_family(error, settings)
    refuse_numbers(family, wants_numbers)
    found = every_stability(file.source, file.name, family)
    output.tell(STABILITY, [found])
    return 0


def _check_plot(plot: str) -> None:
    """Refuse a picture that could not be written, before the work."""
    check_plot(plot)
    if not Path(plot).parent.is_dir():
        raise UsageProblem(
            f"cannot write {plot}: there is no such folder",
            "choose another place",
            code="cannot-write",
        )


def _ratio(text: str) -> fmpq:
    """One --ratio."""
    from garkcli.cli.stepping import rational

    ratio = rational("--ratio", text)
    if ratio <= 0:
        raise UsageProblem(
            f"--ratio {text}: radii are positive", "the axes are always there", code="option-value"
        )
    return ratio


def _whole_report(
    file: str, method: GarkMethod, digits: int, ratios: Sequence[fmpq]
) -> StabilityReport:
    from garkcli.api.calls import find_stability
    from garkcli.report.stability import StabilityReport

    found = find_stability(method, ratios=ratios)
    return StabilityReport(file, method.name, found, digits=digits, derivation=method.derivation)


def _springs_report(
    file: str, method: GarkMethod, digits: int, slow: str, fast: str, with_plane: bool
) -> StabilityReport:
    """The two springs that the options ask for."""
    from garkcli.api.calls import two_springs
    from garkcli.cli.stepping import colour_named
    from garkcli.report.stability import StabilityReport
    from garkcli.stability.summary import Stability
    from garkcli.stability.two_frequencies import SlowInterval

    tableau = method.tableau
    colour = 1 + colour_named(tableau, fast)
    low, high = _strengths(slow)
    found = two_springs(method, (low, high) if ".." in slow else low, colour)
    nothing = Stability(tableau, (), None, None)
    report = StabilityReport(
        file, method.name, nothing, digits=digits, derivation=method.derivation
    )
    if isinstance(found, SlowInterval):
        report = replace(report, slow=found)
    else:
        report = replace(report, springs=found)
    if with_plane:
        from garkcli.stability.springs_plane import plane_with_ends_of
        from garkcli.stability.two_frequencies import springs

        split = springs(tableau, tableau.colours[colour - 1].term)
        plane = plane_with_ends_of(tableau, split, found.stable, high)
        report = replace(report, plane=plane)
    return report


def _strengths(slow: str) -> tuple[fmpq, fmpq]:
    """The ends of --slow, the same twice for one number."""
    from garkcli.cli.stepping import rational, square

    first, dots, last = slow.partition("..")
    low = square("--slow", first)
    high = rational("--slow", last) if dots else low
    if dots and not low < high:
        raise UsageProblem(
            f"--slow {slow}: the ends are not in ascending order",
            "give --slow A..B",
            code="option-value",
        )
    return low, high
