"""Lists of flat parts as CSV, by the rows that tell them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from garkcli.page.plain import csv_cell
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Section


def csv_text(section: Section, parts: Iterable[Any]) -> str:
    """A line a part, below the keys of its rows; without a part the keys alone."""
    lines = [dict(_cells(section, part)) for part in parts]
    heads = dict.fromkeys(head for line in lines or [dict(_cells(section, None))] for head in line)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(csv_cell, heads))
    writer.writerows([line.get(head, "") for head in heads] for line in lines)
    return text.getvalue()


def _cells(section: Section, part: Any) -> Iterator[tuple[str, str]]:
    """Columns with their cells; all of these are empty where there is no part."""
    for row in section.rows:
        kind = row.kind
        value = None if part is None else row.fact(part).value
        if kind.section is not None:
            yield from _cells(kind.section, value)
        elif value is None:
            yield from () if kind.schema.get("type") in ("object", "array") else [(row.key, "")]
        else:
            found = kind.data(value, Plain()) if kind.csv is None else kind.csv(value)
            if isinstance(found, Mapping):
                yield from found.items()
            elif kind.schema == {"type": "string"}:  # words of strangers, or none
                yield row.key, csv_cell(str(found))
            else:
                yield row.key, str(found).lower() if isinstance(found, bool) else str(found)
