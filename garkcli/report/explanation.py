"""What a claim means, for people and for programs."""

from __future__ import annotations

from typing import Any

from garkcli.page.paint import Paint, folded
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, published
from garkcli.properties.definitions import Definition

SCHEMA = "gark/explain/1"
_WIDTH = 80
_MARGIN = 11

_REPORT: Record[Definition] = Record(
    schema_named(SCHEMA),
    Field("key", TEXT, lambda x: x.key),
    Field("definition", TEXT, lambda x: x.text),
    Field("values", TEXT, lambda x: x.values.replace("`", "")),
    Field("for", TEXT, lambda x: x.meaning or "all methods"),
    Field("source", TEXT, lambda x: x.source),
    is_open=True,
)


def explanation_schema() -> Schema:
    """The JSON Schema of ``gark check --explain KEY --format json``."""
    return published("report of gark check --explain", _REPORT.schema)


def as_data(found: Definition) -> dict[str, Any]:
    """The explanation as plain data."""
    return _REPORT.data(found)


def render(found: Definition, format: str, paint: Paint) -> str:
    """The explanation as text, or as JSON."""
    if format == "json":
        return _REPORT.text(found)
    lines = [paint("strong", found.key)]
    lines += ["  " + line for line in folded(found.text, _WIDTH - 2, "")]
    parts = [
        ("claim", found.values.replace("`", "")),
        ("for", found.meaning),
        ("source", found.source),
    ]
    for label, text in parts:
        for line in folded(text, _WIDTH - _MARGIN, "") if text else ():
            lines.append(f"  {label:{_MARGIN - 2}}{line}")
            label = ""
    return "\n".join(lines) + "\n"


def as_markdown(found: Definition) -> str:
    """The explanation as a section of a page."""
    lines = [f"### {found.key}", "", found.text, "", f"Claim: {found.values}."]
    if found.meaning:
        lines[-1] += f" For {found.meaning}."
    lines += ["", f"Source: {found.source}."]
    return "\n".join(lines) + "\n"
