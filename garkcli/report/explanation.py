"""What a claim means, for people and for programs."""

from __future__ import annotations

from typing import Any

from garkcli.page.paint import Paint, folded, indented
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, published
from garkcli.properties.definitions import Definition

SCHEMA = "gark/explain/1"
_WIDTH = 80
_MARGIN = 11


def _values(found: Definition) -> str:
    """The values that may be claimed, without the marks of code."""
    return found.values.replace("`", "")


_REPORT: Record[Definition] = Record(
    schema_named(SCHEMA),
    Field("key", TEXT, lambda x: x.key),
    Field("definition", TEXT, lambda x: x.text),
    Field("values", TEXT, _values),
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
    text = folded(found.text, _WIDTH - 2, "")
    lines = [paint("strong", found.key)]
    lines += indented(text)
    lines += _part("claim", _values(found))
    lines += _part("for", found.meaning)
    lines += _part("source", found.source)
    return "\n".join(lines) + "\n"


def _part(label: str, text: str) -> list[str]:
    """A part of the explanation beside its label; nothing where it is empty."""
    if not text:
        return []
    margin = " " * _MARGIN
    first, *rest = folded(text, _WIDTH - _MARGIN, "")
    head = f"  {label}".ljust(_MARGIN)
    return [head + first, *indented(rest, margin)]


def as_markdown(found: Definition) -> str:
    """The explanation as a section of a page."""
    lines = [f"### {found.key}", "", found.text, "", f"Claim: {found.values}."]
    if found.meaning:
        lines[-1] += f" For {found.meaning}."
    lines += ["", f"Source: {found.source}."]
    return "\n".join(lines) + "\n"
