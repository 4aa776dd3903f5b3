"""Lists of flat parts as CSV, by the rows that tell them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import TypeVar

from garkcli.page.safety import csv_cell
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Section

T = TypeVar("T")


def csv_text(section: Section[T], parts: Iterable[T]) -> str:
    """A line a part; without a part the keys alone."""
    d = Plain()
    lines = [dict(_cells(section, part, d)) for part in parts]
    heads = dict.fromkeys(
        head for line in lines or [dict(_cells(section, None, d))] for head in line
    )
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(csv_cell, heads))
    writer.writerows([line.get(head, "") for head in heads] for line in lines)
    return text.getvalue()


def csv_lines(section: Section[T], parts: Iterable[T], d: Plain) -> Iterator[str]:
    """Lines of parts as they are found, in the columns of the first."""
    left = iter(parts)
    first = next(left, None)
    yield _line(dict(_cells(section, first, d)))
    if first is None:
        return
    for part in chain([first], left):
        yield _line(dict(_cells(section, part, d)).values())


def _line(cells: Iterable[str]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


def _cells(section: Section[T], part: T | None, d: Plain) -> Iterator[tuple[str, str]]:
    for row in section.rows:
        what = row.kind.what
        value = None if part is None else row.answer(part).value
        if isinstance(what, Section):
            yield from _cells(what, value, d)
        elif not isinstance(what, Json):
            continue
        elif value is None:
            yield from () if what.schema.get("type") in ("object", "array") else [(row.key, "")]
        else:
            found = what.data(value, d) if what.csv is None else what.csv(value)
            if isinstance(found, Mapping):
                yield from found.items()
            elif what.schema == {"type": "string"}:  # words of strangers, or none
                yield row.key, csv_cell(str(found))
            else:
                yield row.key, str(found).lower() if isinstance(found, bool) else str(found)
