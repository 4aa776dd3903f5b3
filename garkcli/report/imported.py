"""``gark import``: what was found in sources, for people and for programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from garkcli.bridges.collecting import Result
from garkcli.errors import counted
from garkcli.page.paint import folded
from garkcli.page.plain import printable
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import COUNT, POSITION, TEXT, Schema, array, nullable, published

SCHEMA = "gark/import/1"
_WIDTH = 80


class _Told(NamedTuple):
    """A result with the file that it was written to."""

    result: Result
    file: str | None


def _order(told: _Told) -> int | None:
    method = told.result.method
    return None if method is None else method.order.order


def _embedded_order(told: _Told) -> int | None:
    method = told.result.method
    if method is None or method.embedded_order is None:
        return None
    return method.embedded_order.order


_METHOD: Record[_Told] = Record(
    Field("source", TEXT, lambda x: x.result.table.source),
    Field("line", POSITION, lambda x: x.result.table.line),
    Field("format", TEXT, lambda x: x.result.table.format),
    Field("name", TEXT, lambda x: x.result.table.name),
    Field("file", nullable(TEXT), lambda x: x.file),
    Field("stages", COUNT, lambda x: x.result.table.stages),
    Field("colours", COUNT, lambda x: x.result.table.colours),
    Field("order", nullable(COUNT), _order),
    Field("embedded_order", nullable(COUNT), _embedded_order),
    Field("notes", array(TEXT), lambda x: list(x.result.notes())),
)
_REPORT: Record[Sequence[_Told]] = Record(
    schema_named(SCHEMA), _METHOD.every("methods", lambda x: x)
)


def import_report_schema() -> Schema:
    """The JSON Schema of ``gark import --format json``."""
    return published("report of gark import", _REPORT.schema)


def render_json(results: Sequence[Result], files: Mapping[int, str]) -> str:
    """The methods as JSON.

    Args:
        results: in order.
        files: where each was written, by its number from 0.
    """
    told = [_Told(x, files.get(k)) for k, x in enumerate(results)]
    return _REPORT.text(told)


def render_yaml(results: Sequence[Result]) -> str:
    """The method files, parted as YAML parts documents."""
    texts = [x.method.text for x in results if x.method is not None]
    return "---\n".join(texts)


def render_text(results: Sequence[Result], files: Mapping[int, str], verbosity: int = 0) -> str:
    """A line for each method, with what people should know below it.

    Args:
        results: in order.
        files: where each was written, by its number from 0.
        verbosity: below 0 without notes, above 0 with the method files.
    """
    lines: list[str] = []
    for k, result in enumerate(results):
        table = result.table
        place = printable(f"{table.source}:{table.line}")
        lines.append(f"{place}  {_title(result)}")
        if k in files:
            lines.append(f"    wrote {printable(files[k])}")
        for note in result.notes() if verbosity >= 0 else ():
            text = printable(note)
            lines += [f"    {x}" for x in folded(text, _WIDTH - 4, "  ")]
        if verbosity > 0 and result.method is not None:
            lines += [f"    {x}" for x in result.method.text.splitlines()]
    found = sum(x.method is not None for x in results)
    lines.append(counted(found, "method"))
    return "\n".join(lines) + "\n"


def _title(result: Result) -> str:
    table = result.table
    name = printable(table.name or result.stem)
    if result.method is None:
        return f"{name}: no method"
    words = [counted(table.stages, "stage")]
    if table.colours > 1:
        words.insert(0, counted(table.colours, "colour"))
    words.append(f"order {result.method.order.order}")
    if result.method.embedded_order is not None:
        embedded = result.method.embedded_order.order
        words.append(f"embedded order {embedded}")
    return f"{name}: {', '.join(words)}"
