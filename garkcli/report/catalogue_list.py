"""``gark list methods``: the catalogue as text, Markdown, CSV and JSON."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from textwrap import wrap
from typing import Any, TypeAlias

from garkcli.page.json_text import to_json
from garkcli.page.paint import Paint, aligned, counted
from garkcli.page.plain import csv_cell, printable
from garkcli.page.record import Field, Record
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, array, nullable, published
from garkcli.properties.property import Kind
from garkcli.properties.registry import every_property

Entry: TypeAlias = dict[str, Any]
_BY_KIND: dict[Kind, Schema] = {
    "truth": nullable(FLAG),
    "count": nullable(COUNT),
    "number": nullable(TEXT),
}
_KINDS: Schema = {"enum": ["rk", "ark", "prk", "gark", "family", None]}
_KNOWN: Schema = {"enum": ["found", "claimed", "unread"]}


def _field(name: str, schema: Schema) -> Field[Entry]:
    return Field(name, schema, lambda entry: entry[name])


METHOD: Record[Entry] = Record(
    _field("name", TEXT),
    _field("aliases", array(TEXT)),
    _field("file", TEXT),
    _field("folder", TEXT),
    _field("catalogue", TEXT),
    _field("facts", _KNOWN),
    _field("title", TEXT),
    _field("reference", TEXT),
    _field("authors", array(TEXT)),
    _field("year", TEXT),
    _field("order", nullable(COUNT)),
    _field("embedded_order", nullable(COUNT)),
    _field("conjugate_order", nullable(COUNT)),
    _field("pair_order", nullable(COUNT)),
    _field("nonautonomous_order", nullable(COUNT)),
    _field("stages", nullable(POSITION)),
    _field("stages_by_colour", array(POSITION)),
    _field("colours", nullable(POSITION)),
    _field("kind", _KINDS),
    _field("structure", nullable(TEXT)),
    _field("exact", nullable(FLAG)),
    _field("tolerance", nullable(TEXT)),
    _field("embedded", nullable(FLAG)),
    _field("dense", nullable(FLAG)),
    _field("error_constant", nullable(TEXT)),
    _field("symplectic", nullable(FLAG)),
    *(_field(x.field, _BY_KIND[x.kind]) for x in every_property()),
    _field("undecided", array(TEXT)),
)
"""A method of the catalogue."""

_MARKS = {
    "A": ("a_stable", "A-stable"),
    "L": ("l_stable", "L-stable"),
    "B": ("algebraically_stable", "algebraically stable"),
    "F": ("fsal", "first same as last"),
    "S": ("symplectic", "symplectic"),
    "R": ("symmetric", "symmetric (reversible)"),
}
"""One letter each of what most people look for."""
_WITH_TIME = ("t", "another order for y' = f(t, y)")
"""The letter of methods whose printed nodes fail them."""
_TYPES = {
    "explicit": "explicit",
    "sdirk": "SDIRK",
    "esdirk": "ESDIRK",
    "diagonally_implicit": "DIRK",
    "fully_implicit": "implicit",
}
"""Words for how the stages depend on each other, the narrower before the wider."""
_HEADS = ("name", "order", "stages", "kind", "type", "is", "reference")
_LONGEST_NAME = 26
"""Longest name that is in one line with what is told of its method."""
_GAP = "  "


def render(entries: Sequence[Entry], format: str, paint: Paint, width: int) -> str:
    """The list.

    Args:
        entries: in the order in which they are shown.
        format: text, json, csv or markdown.
        paint: for the terminal.
        width: its columns.
    """
    if format == "json":
        found = [METHOD.data(entry) for entry in entries]
        return f"{to_json(found)}\n"
    if format == "csv":
        return _csv(entries)
    if format == "markdown":
        return _markdown(entries)
    return _text(entries, paint, width)


def list_methods_schema() -> Schema:
    """The JSON Schema of ``gark list methods``."""
    return published("list of gark list methods", array(METHOD.schema))


def _text(entries: Sequence[Entry], paint: Paint, width: int) -> str:
    """A line a method, and what the letters mean."""
    if not entries:
        return "no method of the catalogue is such\n"
    rows = [_row(entry) for entry in entries]
    lines = _table([_HEADS, *rows], width)
    lines[0] = paint("strong", lines[0])
    told = ". ".join([counted(len(entries), "method"), *_legend(rows)])
    lines += ["", *wrap(told, width)]
    return "\n".join(lines) + "\n"


def _table(rows: Sequence[Sequence[str]], width: int) -> list[str]:
    """Rows as lines of at most ``width``, the last column cut; a long name has its own line."""
    column = min(max(len(row[0]) for row in rows), _LONGEST_NAME)
    facts = aligned([row[1:-1] for row in rows], right=False)
    longest = max(map(len, facts))
    room = width - column - longest - 2 * len(_GAP)
    lines = []
    for row, told in zip(rows, facts, strict=True):
        name = row[0]
        if len(name) > column:
            lines.append(name)
            name = ""
        reference = _cut(row[-1], room)
        cells = (name.ljust(column), told.ljust(longest), reference)
        lines.append(_GAP.join(cells).rstrip())
    return lines


def _cut(text: str, room: int) -> str:
    if len(text) <= room:
        return text
    return f"{text[: room - 1]}…" if room > 1 else ""


def _row(entry: Entry) -> tuple[str, ...]:
    """The cells of one method for people."""
    return (
        printable(entry["name"]),
        _order(entry),
        _stages(entry),
        entry["kind"] or "unread",
        _type(entry),
        _marks(entry),
        printable(short_reference(entry)),
    )


def _order(entry: Entry) -> str:
    """The order with that of embedded weights, marked where it is a claim."""
    if entry["order"] is None:
        return ""
    told = str(entry["order"])
    if entry["embedded_order"] is not None:
        told += f"({entry['embedded_order']})"
    return f"{told}*" if entry["facts"] == "claimed" else told


def _stages(entry: Entry) -> str:
    """How many, a number a colour where colours have stages of their own."""
    if entry["kind"] == "ark":
        return str(entry["stages"])
    return "+".join(map(str, entry["stages_by_colour"]))


def _type(entry: Entry) -> str:
    """How the stages depend on each other."""
    for key, word in _TYPES.items():
        if entry[key]:
            return word
    return ""


def _marks(entry: Entry) -> str:
    marks = [mark for mark, (key, _) in _MARKS.items() if entry[key]]
    marks += _WITH_TIME[0] if _fails_with_time(entry) else ""
    return "".join(marks) + ("~" if entry["exact"] is False else "")


def _fails_with_time(entry: Entry) -> bool:
    """Whether its order is another one where the vector fields depend on time."""
    order = entry["nonautonomous_order"]
    return order is not None and order != entry["order"]


def _legend(rows: Sequence[Sequence[str]]) -> list[str]:
    """What the signs of these rows mean."""
    present = set("".join(row[5] for row in rows))
    told = [f"{x}: {what}" for x, (_, what) in _MARKS.items() if x in present]
    if _WITH_TIME[0] in present:
        told.append(": ".join(_WITH_TIME))
    if "~" in present:
        told.append("~: rounded")
    if any("*" in row[1] for row in rows):
        told.append("*: as its file claims (--judge finds it)")
    return [", ".join(told)] if told else []


def short_reference(entry: Entry) -> str:
    """Last names and year, or the beginning of a reference that is plain text."""
    names = [name.split()[-1] for name in entry["authors"]]
    if not names:
        reference: str = entry["reference"]
        return reference
    if len(names) > 3:
        names = [names[0], "et al."]
        return f"{' '.join(names)} {entry['year']}".rstrip()
    return f"{', '.join(names)} {entry['year']}".rstrip()


def _csv(entries: Sequence[Entry]) -> str:
    """A row a method, a column a field; lists with ``;`` between their items."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([field.name for field in METHOD.fields])
    for entry in entries:
        cells = METHOD.data(entry).values()
        writer.writerow([csv_cell(_cell(value)) for value in cells])
    return stream.getvalue()


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return "; ".join(map(str, value))
    return str(value)


def _markdown(entries: Sequence[Entry]) -> str:
    """A table for a page."""
    heads = (*_HEADS[:5], "properties", "reference")
    lines = [f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    for entry in entries:
        name, order, stages, kind, type_, _, _ = _row(entry)
        told = [what for key, what in _MARKS.values() if entry[key]]
        told += [_WITH_TIME[1]] if _fails_with_time(entry) else []
        told += ["rounded"] if entry["exact"] is False else []
        reference = printable(entry["reference"])
        cells = [f"`{name}`", order, stages, kind, type_, ", ".join(told)]
        row = " | ".join(map(_escaped, [*cells, reference]))
        lines.append(f"| {row} |")
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    return text.replace("|", "\\|")


FORMATS: tuple[str, ...] = ("text", "json", "csv", "markdown")
"""The formats of the list."""
