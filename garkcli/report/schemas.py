"""The JSON Schemas of what the commands write: one function a command.

A command with a JSON report adds itself to ``REPORTS``.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.report.field_texts import told
from garkcli.tell.report import Report

_TABLEAU = "garkcli.report.tableau:REPORT"
REPORTS = {
    "check": "garkcli.report.checked:REPORT",
    "claims": "garkcli.report.claims:REPORT",
    "explain": "garkcli.report.meaning:REPORT",
    "trees": "garkcli.report.symplectic:trees_report_schema",
    "conditions": "garkcli.report.conditions:REPORT",
    "tableau": _TABLEAU,
    "conjugate": _TABLEAU,
    "reduce": _TABLEAU,
    "convert": _TABLEAU,
    "diff": "garkcli.report.diff:REPORT",
    "stability": "garkcli.report.stability:REPORT",
    "stability-every": "garkcli.report.every:STABILITY",
    "design": "garkcli.report.design:REPORT",
    "design-search": "garkcli.report.search:REPORT",
    "design-curve": "garkcli.report.design_curve:REPORT",
    "design-stability": "garkcli.report.stable_values:REPORT",
    "design-within": "garkcli.report.design_within:REPORT",
    "design-plane": "garkcli.report.stable_plane:REPORT",
    "modified": "garkcli.report.modified:REPORT",
    "modified-energy": "garkcli.report.modified_energy:REPORT",
    "converge": "garkcli.report.comparison:schema",
    "energy": "garkcli.report.energy:REPORT",
    "certificate": "garkcli.report.certificate:REPORT",
    "export": "garkcli.bridges.targets.exact_texts:export_schema",
    "list": "garkcli.report.listing:REPORT",
    "list-methods": "garkcli.report.list_methods:REPORT",
    "show": "garkcli.report.show:REPORT",
    "cite": "garkcli.report.citation:REPORT",
    "list-exports": "garkcli.report.listing:EXPORTS",
    "audit": "garkcli.report.audited:REPORT",
    "import": "garkcli.report.imported:REPORT",
    "sweep": "garkcli.report.sweep:REPORT",
}
"""The place of a report, or of the function that makes its schema."""


def report_schema(command: str) -> dict[str, Any]:
    """The JSON Schema of the output of ``gark COMMAND --format json``, as plain data.

    Args:
        command: such as ``"check"``.

    Raises:
        UsageProblem: no schema is had for the command.

    >>> report_schema("check")["type"]
    'object'
    """
    if command not in REPORTS:
        message = f"no schema of a report of {command!r}"
        raise UsageProblem(message, did_you_mean(command, REPORTS), code="unknown-word")
    module, function = REPORTS[command].split(":")
    maker = getattr(import_module(module), function)
    schema: dict[str, Any] = maker.schema if isinstance(maker, Report) else maker()
    return told(schema, command)
