"""Lists of flat parts as CSV, by the rows that tell them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Any

from garkcli.page.plain import csv_cell
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Section


def csv_text(section: Section, parts: Iterable[Any]) -> str:
    """A line a part, below the keys of its rows; without a part the keys alone."""
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


def csv_lines(section: Section, parts: Iterable[Any], d: Plain) -> Iterator[str]:
    """The same of parts that all have the cells of the first one, while they are found."""
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


def _cells(section: Section, part: Any, d: Plain) -> Iterator[tuple[str, str]]:
    """Columns with their cells; all of these are empty where there is no part."""
    for row in section.rows:
        kind = row.kind
        if not kind.is_data:
            continue
        value = None if part is None else row.answer(part).value
        if kind.section is not None:
            yield from _cells(kind.section, value, d)
        elif value is None:
            yield from () if kind.schema.get("type") in ("object", "array") else [(row.key, "")]
        else:
            found = kind.data(value, d) if kind.csv is None else kind.csv(value)
            if isinstance(found, Mapping):
                yield from found.items()
            elif kind.schema == {"type": "string"}:  # words of strangers, or none
                yield row.key, csv_cell(str(found))
            else:
                yield row.key, str(found).lower() if isinstance(found, bool) else str(found)
