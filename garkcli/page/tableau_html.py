"""A tableau as HTML tables, with Q and P for partitioned methods."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from garkcli.errors import printable
from garkcli.page.cells import cell_text, lines_of, parts_of
from garkcli.tableau.pointwise import Entries
from garkcli.tableau.tableau import Tableau

_LINE = "1px solid"


def tableau_lines(tableau: Tableau, entries: Entries, name: str = "") -> list[str]:
    return [
        _table(", ".join(filter(None, (name, letter))), _rows(tableau, entries, stages, colours))
        for letter, stages, colours in parts_of(tableau)
    ]


def _rows(
    tableau: Tableau, entries: Entries, stages: Sequence[int], colours: Sequence[int]
) -> Iterator[str]:
    if len(colours) > 1:
        yield _heads(tableau, entries, colours)
    for line in lines_of(entries, stages, colours):
        head = "" if line.node is None else cell_text(line.node, entries.digits)
        groups = [
            [""] * len(entries.b[m]) if row is None else [cell_text(x, entries.digits) for x in row]
            for m, row in zip(colours, line.groups, strict=True)
        ]
        yield _row(head, groups, line.is_first)


def _heads(tableau: Tableau, entries: Entries, colours: Sequence[int]) -> str:
    heads = ['<th scope="col"></th>']
    for m in colours:
        name = _text(tableau.colours[m].name)
        attributes = f'scope="col" colspan="{len(entries.b[m])}"'
        heads.append(f"<th {attributes}>{name}</th>")
    joined = "".join(heads)
    return f"<tr>{joined}</tr>"


def _row(head: str, groups: Sequence[Sequence[str]], is_first: bool) -> str:
    above = f"border-top:{_LINE};" if is_first else ""
    cells = [_cell(head, above)]
    for group in groups:
        style = f"{above}border-left:{_LINE};"
        for text in group:
            cells.append(_cell(text, style))
            style = above
    joined = "".join(cells)
    return f"<tr>{joined}</tr>"


def _cell(text: str, style: str) -> str:
    # where a page gives tables no room of their own, fractions side by side would touch
    return f'<td style="padding:0.1em 0.5em;{style}">{_text(text)}</td>'


def _table(title: str, rows: Iterable[str]) -> str:
    beside = "white-space:nowrap;text-align:left"
    caption = f'<caption style="{beside}">{_text(title)}</caption>' if title else ""
    style = "border-collapse:collapse"
    body = "\n".join(rows)
    return f'<table style="{style}">{caption}<tbody>\n{body}\n</tbody></table>'


def _text(text: str) -> str:
    return escape(printable(text))
