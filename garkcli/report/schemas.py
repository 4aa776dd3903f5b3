"""The JSON Schemas of reports; a command with a JSON report adds itself to ``REPORTS``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib import import_module
from typing import Any

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.glossary.fields import field_text
from garkcli.glossary.key import keys_of
from garkcli.page.schema import Schema
from garkcli.tell.report import Report

_TABLEAU = "garkcli.report.tableau:REPORT"
REPORTS = {
    "check": "garkcli.report.checked:REPORT",
    "claims": "garkcli.report.claims:REPORT",
    "explain": "garkcli.report.meaning:REPORT",
    "trees": "garkcli.report.trees:trees_report_schema",
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
    "modified": "garkcli.report.modified:REPORT",
    "modified-energy": "garkcli.report.modified_energy:REPORT",
    "converge": "garkcli.report.comparison:schema",
    "energy": "garkcli.report.energy:REPORT",
    "certificate": "garkcli.report.certificate:REPORT",
    "export": "garkcli.bridges.targets.exact_texts:export_schema",
    "list": "garkcli.report.listing:REPORT",
    "list-methods": "garkcli.report.methods:REPORT",
    "show": "garkcli.report.methods:SHOWN",
    "cite": "garkcli.report.citation:REPORT",
    "list-exports": "garkcli.report.listing:EXPORTS",
    "audit": "garkcli.report.audited:REPORT",
    "import": "garkcli.report.imported:REPORT",
    "sweep": "garkcli.report.sweep:REPORT",
}


REFERENCES = (("publication",), ("reference",))
"""Fields whose parts are those of a reference in a method file."""


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


def told(schema: Schema, report: str) -> Schema:
    found: Schema = _walked(schema, (report,))
    return found


def _walked(node: Any, path: tuple[str, ...]) -> Any:
    if isinstance(node, list):
        return [_walked(part, path) for part in node]
    if not isinstance(node, dict):
        return node
    found = {}
    for word, part in node.items():
        if word == "properties":
            found[word] = {name: _field(value, (*path, name)) for name, value in part.items()}
        else:
            found[word] = _walked(part, path)
    return found


def _field(schema: Any, path: tuple[str, ...]) -> Any:
    inner = _walked(schema, path)
    text = text_of(path)
    if not (text and isinstance(inner, dict)):
        return inner
    number = inner.get("description", "")
    return {**inner, "description": f"{text} {number}".rstrip()}


def text_of(path: tuple[str, ...]) -> str:
    """The description of the field, or of the claim, column or key it is."""
    name = path[-1]
    if path[-2:-1] in REFERENCES:
        return _elsewhere().get(name, "")
    return field_text(path) or _elsewhere().get(name, "")


@lru_cache(maxsize=1)
def _elsewhere() -> Mapping[str, str]:
    from garkcli.properties.definitions import every_definition

    found = {}
    for kind, above in (("method", "reference."), ("sweep", "where.")):
        for path, key in keys_of(kind).items():
            if path.startswith(above):
                name = path.removeprefix(above)
                found[name] = found[name.replace("-", "_")] = key.text
    for claim in every_definition():
        found[claim.key] = found[claim.key.replace("-", "_")] = claim.text
    return found
