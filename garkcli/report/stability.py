"""``gark stability`` as text, JSON or LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.errors import UsageProblem
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral
from garkcli.page.exactly import polynomial_latex
from garkcli.page.paint import Paint
from garkcli.report.stability_colours import fraction_latex
from garkcli.report.stability_data import StabilityReport
from garkcli.report.stability_text import text_of


def render(reports: Sequence[StabilityReport], format: str, paint: Paint) -> str:
    """All reports in one format."""
    if format == "json":
        from garkcli.report.stability_json import json_of

        return json_of(reports)
    if format == "latex":
        return "\n".join(_latex(report) for report in reports)
    return "\n".join("\n".join(text_of(report, paint)) + "\n" for report in reports)


def _latex(report: StabilityReport) -> str:
    lines = []
    if report.slow is not None:
        raise UsageProblem(
            "an interval of slow frequencies has no formula", "give --slow A for one"
        )
    if report.springs is not None:
        trace = report.springs.trace
        lines.append(
            _latex_line(r"\operatorname{tr} M(x)", trace.numerator, trace.denominator, "x")
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
            lines.append(_latex_line(r"\det M(x)", area.numerator, area.denominator, "x"))
    return "\\begin{align*}\n" + " \\\\\n".join(lines) + "\n\\end{align*}\n"


def _latex_line(name: str, numerator: Polynomial, denominator: Polynomial, variable: str) -> str:
    quotient = quotient_latex(numerator, denominator, variable)
    return f"  {name} &= {quotient}"


def quotient_latex(numerator: Polynomial, denominator: Polynomial, variable: str) -> str:
    """A rational function in LaTeX."""
    over, under = (polynomial_latex(p, variable) for p in integral([numerator, denominator]))
    return over if under == "1" else rf"\frac{{{over}}}{{{under}}}"
