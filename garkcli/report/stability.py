"""``gark stability`` as text, JSON or LaTeX."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from garkcli.errors import UsageProblem
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral
from garkcli.report.exactly import polynomial_latex
from garkcli.report.json_text import to_json
from garkcli.report.paint import Paint
from garkcli.report.stability_colours import colours_data, fraction_latex
from garkcli.report.stability_data import StabilityReport, as_data
from garkcli.report.stability_text import text_of


def render(reports: Sequence[StabilityReport], format: str, paint: Paint) -> str:
    """All reports in one format."""
    if format == "json":
        data = {
            "schema": "gark/stability/1",
            "files": [_data(report) for report in reports],
        }
        return to_json(data) + "\n"
    if format == "latex":
        return "\n".join(_latex(report) for report in reports)
    return "\n".join("\n".join(text_of(report, paint)) + "\n" for report in reports)


def _data(report: StabilityReport) -> dict[str, Any]:
    """One report as plain data: for several colours R is the one with a z for each."""
    data = as_data(report)
    colours = report.found.colours
    if colours is not None:
        data["R_alike"] = data["R"]
        data |= colours_data(colours, report.digits)
    return data


def _latex(report: StabilityReport) -> str:
    lines = []
    if report.slow is not None:
        raise UsageProblem(
            "an interval of slow frequencies has no formula", "give --slow A for one"
        )
    if report.springs is not None:
        trace = report.springs.trace
        lines.append(
            _latex_line(
                r"\operatorname{tr} M(x)", trace.numerator, trace.denominator, "x"
            )
        )
    else:
        colours = report.found.colours
        fraction = None if colours is None else fraction_latex(colours)
        if fraction is not None:
            lines.append(fraction)
        for one in report.found.linear:
            name = "R(z)" if one.name == "all" else rf"R_{{\mathrm{{{one.name}}}}}(z)"
            lines.append(_latex_line(name, one.R.numerator, one.R.denominator, "z"))
        oscillator = report.found.oscillator
        if oscillator is not None:
            trace, area = oscillator.trace, oscillator.determinant
            name = r"\operatorname{tr} M(x)"
            lines.append(_latex_line(name, trace.numerator, trace.denominator, "x"))
            lines.append(
                _latex_line(r"\det M(x)", area.numerator, area.denominator, "x")
            )
    return "\\begin{align*}\n" + " \\\\\n".join(lines) + "\n\\end{align*}\n"


def _latex_line(
    name: str, numerator: Polynomial, denominator: Polynomial, variable: str
) -> str:
    over, under = (
        polynomial_latex(p, variable) for p in integral([numerator, denominator])
    )
    return f"  {name} &= " + (over if under == "1" else rf"\frac{{{over}}}{{{under}}}")
