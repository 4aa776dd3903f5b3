"""What commands print, of values: one writer a kind of value, in the formats of its command."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from garkcli.backward.energy import ModifiedRun
from garkcli.backward.summary import BackwardAnalysis
from garkcli.bridges.audit import Audited
from garkcli.check.analysis import Analysis
from garkcli.check.meanings import Meaning
from garkcli.check.outcome import Outcome
from garkcli.comparison.comparison import Comparison
from garkcli.convergence.result import Convergence
from garkcli.design.design import Design
from garkcli.design.minimise.result import Minimum
from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.longtime.history import LongRun
from garkcli.page.paint import Paint
from garkcli.report.audited import FORMATS as AUDIT_FORMATS
from garkcli.report.sweep import SweepReport
from garkcli.stability.summary import Stability
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tell.report import FORMATS

Writer: TypeAlias = "Callable[[Any, str, str], str]"
"""Of a value, a format, and what to call the method."""
WIDTH = 80
"""Columns of texts."""
_PLAIN = Paint()


def render(value: object, format: str = "text", name: str = "") -> str:
    """What a command prints of a value, in one of its formats.

    Args:
        value: a method (``gark tableau``); what ``check_file``, ``analyse``, ``find_stability``,
            ``converge``, ``long_run``, ``compare``, ``backward_analysis``, ``modified_run``,
            ``find_parameters``, ``minimise``, ``run_sweep``, ``explain`` or ``audit`` returned; or
            a list of outcomes.
        format: as the command has it: ``"text"``, ``"json"`` and others.
        name: what to call the method where the value does not say it.

    Raises:
        MethodError: no command prints such a value.
        UsageProblem: the command has no such format.

    >>> from garkcli import compare, load
    >>> print(render(load("heun")))
    Heun 2(1), the explicit trapezoidal rule
    <BLANKLINE>
             |        1
    ---------+---------
           0 |   0    0
           1 |   1    0
    ---------+---------
           b | 1/2  1/2
    embedded |   1    0
    <BLANKLINE>
    >>> import json
    >>> json.loads(render(compare("heun", "rk4"), "json"))["schema"]
    'gark/diff/1'
    """
    kind, writer, formats = _writer_of(value)
    if format not in formats:
        cure = did_you_mean(format, formats)
        raise UsageProblem(f"no format {format!r} of {kind}", cure)
    return writer(value, format, name)


def _writer_of(value: object) -> tuple[str, Writer, Sequence[str]]:
    """What writes a value.

    Raises:
        MethodError: nothing does.
    """
    one = value
    if isinstance(value, (list, tuple)) and value:
        one = value[0]
    for kind, (writer, formats) in _WRITERS.items():
        if isinstance(one, kind):
            return kind.__name__, writer, formats
    raise MethodError(
        f"no command prints values of the kind {type(value).__name__}",
        "give a method, or what analyse, check_file or another call that"
        " help(garkcli.render) names returned",
    )


def _called(name: str, method: GarkMethod | None) -> str:
    """What the caller says, or what the value knows."""
    return name or (method.name if method is not None else "")


def _method(method: GarkMethod, format: str, _: str) -> str:
    from garkcli.page import tableau_latex
    from garkcli.report.tableau import REPORT, of_method

    if format == "latex":
        return tableau_latex.render(method.tableau, method.entries, method.name, False)
    return REPORT.render([of_method(method)], format)


def _outcomes(value: Any, format: str, _: str) -> str:
    from garkcli.report.check_formats import FORMATS

    outcomes = value if isinstance(value, (list, tuple)) else [value]
    return FORMATS[format](outcomes, _PLAIN, 0, None, WIDTH)


def _analysis(found: Analysis, format: str, name: str) -> str:
    return _outcomes(Outcome(name, name, analysis=found), format, name)


def _stability(found: Stability, format: str, name: str) -> str:
    from garkcli.report.stability import REPORT, StabilityReport

    return REPORT.render([StabilityReport(name, name, found)], format)


def _convergence(result: Convergence, format: str, name: str) -> str:
    from garkcli.report.convergence import REPORT, ConvergenceReport

    return REPORT.render([ConvergenceReport(result, _called(name, result.method))], format)


def _long_run(run: LongRun, format: str, name: str) -> str:
    from garkcli.report.energy import REPORT, EnergyReport

    return REPORT.render([EnergyReport(_called(name, run.method), run)], format)


def _comparison(found: Comparison, format: str, _: str) -> str:
    from garkcli.report.diff import REPORT, compared

    return REPORT.render([compared(found)], format)


def _backward(found: BackwardAnalysis, format: str, name: str) -> str:
    from garkcli.report.modified import render as written
    from garkcli.report.modified_data import ModifiedReport

    return "".join(written(ModifiedReport(name, name, found), format, _PLAIN))


def _modified_run(run: ModifiedRun, format: str, name: str) -> str:
    from garkcli.report.modified_energy import REPORT, ModifiedEnergyReport

    return REPORT.render([ModifiedEnergyReport(_called(name, run.method), run)], format)


def _design(design: Design, format: str, name: str, minimum: Minimum | None = None) -> str:
    from garkcli.report.design import REPORT, DesignReport

    return REPORT.render(
        [DesignReport(name or design.family.name, design, minimum=minimum)], format
    )


def _minimum(minimum: Minimum, format: str, name: str) -> str:
    return _design(minimum.design, format, name, minimum)


def _sweep(report: SweepReport, format: str, _: str) -> str:
    from garkcli.report import sweep

    return sweep.json_lines(report) if format == "jsonl" else sweep.REPORT.render([report], format)


def _meanings(value: Any, format: str, name: str) -> str:
    from garkcli.report.meaning import render as written

    found = value if isinstance(value, (list, tuple)) else [value]
    return written(name or found[0].name, found, format, _PLAIN)


def _audited(value: Any, format: str, _: str) -> str:
    tables = value if isinstance(value, (list, tuple)) else [value]
    return AUDIT_FORMATS[format](tables)


_WRITERS: Mapping[type, tuple[Writer, Sequence[str]]] = {
    GarkMethod: (_method, FORMATS),
    Outcome: (_outcomes, ("text", "json", "sarif", "junit", "github", "markdown", "latex")),
    Analysis: (_analysis, FORMATS),
    Stability: (_stability, FORMATS),
    Convergence: (_convergence, (*FORMATS, "csv")),
    LongRun: (_long_run, (*FORMATS, "csv")),
    Comparison: (_comparison, FORMATS),
    BackwardAnalysis: (_backward, ("text", "json", "latex")),
    ModifiedRun: (_modified_run, (*FORMATS, "csv")),
    Design: (_design, FORMATS),
    Minimum: (_minimum, FORMATS),
    SweepReport: (_sweep, (*FORMATS, "jsonl", "csv")),
    Meaning: (_meanings, ("text", "json")),
    Audited: (_audited, (*AUDIT_FORMATS,)),
}
"""By the kind of a value what writes it, in which formats."""
