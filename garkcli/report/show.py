"""``gark show``: all about one method, as text and as JSON."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import wrap
from typing import Any

from garkcli.page.paint import Paint, indented
from garkcli.page.plain import printable
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, nullable, published
from garkcli.properties.registry import every_property
from garkcli.reference import Reference
from garkcli.report import tableau_json, tableau_text
from garkcli.report.catalogue_list import METHOD, Entry
from garkcli.report.citation import REFERENCE, reference_data
from garkcli.tableau.pointwise import Entries
from garkcli.tableau.tableau import Tableau

SCHEMA = "gark/show/1"
_LABEL = 22
"""Columns of what a line is about."""
_ORDERS = {
    "order": "order",
    "embedded_order": "embedded order",
    "nonautonomous_order": "order with time",
    "conjugate_order": "conjugate order",
    "pair_order": "pair order",
    "stage_order": "stage order",
    "error_constant": "error constant",
}
"""Numbers that have a line of their own; others are among the properties."""


@dataclass(frozen=True)
class Shown:
    """A method.

    Attributes:
        entry: as the list of methods has it.
        tableau: its blocks.
        entries: what is shown of them.
        description: of its file.
        reference: its fields; None where it is plain text.
        title: what people call it.
    """

    entry: Entry
    tableau: Tableau
    entries: Entries
    description: str
    reference: Reference | None

    @property
    def title(self) -> str:
        """What people call it."""
        return printable(self.entry["title"] or self.entry["name"])


def render(shown: Shown, format: str, paint: Paint, width: int) -> str:
    """All about the method.

    Args:
        shown: the method.
        format: text or json.
        paint: for the terminal.
        width: its columns.
    """
    if format == "json":
        return _REPORT.text(shown)
    readable = shown.entries
    if shown.entry["exact"] is False:
        readable = tableau_text.readable(readable)
    tableau = tableau_text.render(shown.tableau, readable, shown.title, paint, width)
    lines = _about(shown, width)
    return f"{tableau}\n" + "\n".join(lines) + "\n"


def show_report_schema() -> Schema:
    """The JSON Schema of ``gark show``."""
    return published("report of gark show", _REPORT.schema)


def _about(shown: Shown, width: int) -> list[str]:
    """What is known of it, a line or more for each thing."""
    entry = shown.entry
    told = {
        "name": entry["name"],
        "aliases": ", ".join(entry["aliases"]),
        "": " ".join(shown.description.split()),
        "kind": _kind(entry),
    }
    for key, label in _ORDERS.items():
        if entry[key] is not None:
            told[label] = str(entry[key])
    told["it is"] = ", ".join(_true(entry))
    told["it is not"] = ", ".join(_false(entry))
    told |= _sizes(entry)
    told["not decided"] = ", ".join(map(_words, entry["undecided"]))
    told["rounded to"] = entry["tolerance"] or ""
    told["reference"] = entry["reference"]
    if shown.reference is not None:
        told["doi"] = shown.reference.doi
        told["coefficients"] = shown.reference.coefficients
    told["file"] = entry["file"]
    lines = []
    for label, text in told.items():
        if text:
            lines += _lines(label, printable(text), width)
    return lines


def _lines(label: str, text: str, width: int) -> list[str]:
    """A label with its text beside it."""
    first, *rest = wrap(text, width - _LABEL, break_long_words=False, break_on_hyphens=False)
    return [label.ljust(_LABEL) + first, *indented(rest, " " * _LABEL)]


def _kind(entry: Entry) -> str:
    """What kind of method, of how many stages and colours."""
    stages = ", ".join(map(str, entry["stages_by_colour"]))
    colours = f"{entry['colours']} colour"
    if entry["colours"] != 1:
        colours += "s"
    about = [entry["kind"], colours, f"stages {stages}"]
    if entry["structure"] != "general":
        about.append(f"for {entry['structure']} problems")
    if entry["dense"]:
        about.append("with dense output")
    return ", ".join(about)


def _truths() -> list[str]:
    found = [x.field for x in every_property() if x.kind == "truth"]
    return ["symplectic", *found]


def _true(entry: Entry) -> list[str]:
    return [_words(key) for key in _truths() if entry[key] is True]


def _false(entry: Entry) -> list[str]:
    return [_words(key) for key in _truths() if entry[key] is False]


def _words(key: str) -> str:
    """The key of a property for people."""
    return key.replace("_", "-")


def _sizes(entry: Entry) -> dict[str, str]:
    """Its properties that are numbers and have no line yet."""
    found = {}
    for one in every_property():
        value = entry[one.field]
        if one.kind == "truth" or one.field in _ORDERS or value is None:
            continue
        found[one.key.replace("-", " ")[: _LABEL - 1]] = str(value)
    return found


def _reference(shown: Shown) -> dict[str, Any] | None:
    return reference_data(shown.reference)


def _tableau(shown: Shown) -> dict[str, Any]:
    return tableau_json.as_data(shown.tableau, shown.entries, shown.title)


_REPORT: Record[Shown] = Record(
    schema_named(SCHEMA),
    *(
        Field(field.name, field.schema, lambda x, f=field: f.value(x.entry))  # type: ignore[misc]
        for field in METHOD.fields
    ),
    Field("description", TEXT, lambda x: x.description),
    Field("publication", nullable(REFERENCE), _reference),
    Field("tableau", tableau_json.REPORT.schema, _tableau),
)
