"""Values of calls in the formats of commands: by rows, or by a writer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeAlias

from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.page.look import PLAIN
from garkcli.tell.report import FORMATS, Report

if TYPE_CHECKING:
    from garkcli.bridges.audit import Audited
    from garkcli.check.meanings import Meaning
    from garkcli.check.outcome import Outcome
    from garkcli.sweep.report import SweepReport
    from garkcli.tableau.garkmethod import GarkMethod

Writer: TypeAlias = "Callable[[Sequence[Any], str, str], str]"
"""The text is the name of the method."""
WIDTH = 80
TOLD_BY = {
    "backward.BackwardAnalysis": "modified",
    "backward.ModifiedRun": "modified_energy",
    "check.Analysis": "checked",
    "check.RosenbrockAnalysis": "checked",
    "check.NystromAnalysis": "checked",
    "check.NprkAnalysis": "checked",
    "check.DerivativesAnalysis": "checked",
    "check.InfinitesimalAnalysis": "checked",
    "check.ExistenceProof": "certificate",
    "check.MethodProof": "certificate",
    "check.Outcome": "checked",
    "comparison.Comparison": "diff",
    "convergence.Convergence": "convergence",
    "design.Design": "design",
    "design.DesignWithin": "design_within",
    "design.Minimum": "design",
    "design.StableValues": "stable_values",
    "longtime.LongRun": "energy",
    "sweep.SweepReport": "sweep",
    "stability.Stability": "stability",
}
"""The file with the ``REPORT`` of a class; its ``whole`` makes the result of a value and a name."""


def render(value: object, format: str = "text", name: str = "") -> str:
    """The output of a command for a value, in one of its formats.

    Args:
        value: a method (``gark tableau``); what ``check_file``, ``analyse``, ``find_stability``,
            ``converge``, ``long_run``, ``compare``, ``backward_analysis``, ``modified_run``,
            ``find_parameters``, ``minimise``, ``stable_values``, ``prove_method``,
            ``prove_method_exists``, ``run_sweep``, ``explain`` or ``audit`` returned; or a list of
            outcomes.
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
    values = value if isinstance(value, (list, tuple)) and value else [value]
    kind, write, formats = _writer_of(values[0])
    if format not in formats:
        cure = did_you_mean(format, formats)
        message = f"no format {format!r} of {kind.partition('.')[2]}"
        raise UsageProblem(message, cure, code="unknown-word")
    return write(values, format, name)


def latex(method: GarkMethod) -> str:
    return render(method, "latex")


def html(value: object) -> str:
    report, whole = _told_by(TOLD_BY[_kind(value, TOLD_BY)])
    return report.html(whole(value, ""))


def _kind(value: object, known: Mapping[str, object]) -> str:
    """The room and the class of a value, or of a base of its class; else empty."""
    rooms = ((kind, kind.__module__.split(".")) for kind in type(value).__mro__)
    kinds = (f"{''.join(room[1:2])}.{kind.__name__}" for kind, room in rooms)
    return next((x for x in kinds if x in known), "")


def _told_by(file: str) -> tuple[Report[Any], Callable[[Any, str], Any]]:
    module = import_module(f"garkcli.report.{file}")
    return module.REPORT, getattr(module, "whole", lambda value, _: value)


def _writer_of(value: object) -> tuple[str, Writer, Sequence[str]]:
    """Returns the writer of a value; raises MethodError without one."""
    if kind := _kind(value, WRITERS):
        return kind, *WRITERS[kind]
    if kind := _kind(value, TOLD_BY):
        report, whole = _told_by(TOLD_BY[kind])
        formats = FORMATS if report.lines is None else (*FORMATS, "csv")
        return kind, lambda xs, f, name: report.render([whole(x, name) for x in xs], f), formats
    raise MethodError(
        f"no command prints values of the kind {type(value).__name__}",
        "give a method, or what analyse, check_file or another call that"
        " help(garkcli.render) names returned",
        code="arrays",
    )


def _methods(methods: Sequence[GarkMethod], format: str, _: str) -> str:
    from garkcli.report.tableau import REPORT, of_method

    return REPORT.render([of_method(x) for x in methods], format)


def _outcomes(outcomes: Sequence[Outcome], format: str, _: str) -> str:
    from garkcli.report.check_formats import FORMATS

    return FORMATS[format](outcomes, PLAIN, 0, None, WIDTH)


def _sweeps(reports: Sequence[SweepReport], format: str, _: str) -> str:
    from garkcli.report import sweep

    if format == "jsonl":
        return "".join(map(sweep.json_lines, reports))
    return sweep.REPORT.render(reports, format)


def _meanings(found: Sequence[Meaning], format: str, name: str) -> str:
    from garkcli.report.meaning import REPORT, told

    return REPORT.render(told(name or found[0].name, found), format)


def _audited(tables: Sequence[Audited], format: str, _: str) -> str:
    from garkcli.report.audited import FORMATS

    return FORMATS[format](tables)


WRITERS: Mapping[str, tuple[Writer, Sequence[str]]] = {
    "bridges.Audited": (_audited, (*FORMATS, "github", "sarif")),
    "check.Meaning": (_meanings, FORMATS),
    "check.Outcome": (_outcomes, (*FORMATS, "sarif", "junit", "github")),
    "sweep.SweepReport": (_sweeps, (*FORMATS, "csv", "jsonl")),
    "tableau.GarkMethod": (_methods, FORMATS),
}
