"""A tableau as text: in the layout of the paper if it fits, otherwise block by block."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from typing import TypeAlias

from flint import arb

from garkcli.exact.display import shortest, to_ball
from garkcli.exact.parametric import Parametric
from garkcli.page.cells import cell_text, distinct_rows, lines_of
from garkcli.page.lines import aligned, folded, indented
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau

Text: TypeAlias = Callable[[Cell], str]
_MARGIN = " " * 4
LONGEST = 64
"""Longer exact entries are decimals where these are enough."""


def room_for_entry(width: int) -> int:
    return min(LONGEST, width - len(_MARGIN))


_GAP = "  "


def readable(entries: Entries) -> Entries:
    """Returns the entries of a rounded method, with fractions longer than decimals as decimals."""
    widest = entries.digits + len("-0.")

    def short(cell: Cell) -> Cell:
        if isinstance(cell, arb):
            return cell
        if len(shortest(cell)) <= widest:
            return cell
        return to_ball(cell, entries.digits)

    return entries.changed(short)


def shortened(entries: Entries, longest: int, spelt: Callable[[str], str] = str) -> Entries:
    """Returns the entries, with exact ones of more than ``longest`` signs as decimals."""

    def short(cell: Cell) -> Cell:
        if isinstance(cell, (arb, Parametric)) or len(spelt(shortest(cell))) <= longest:
            return cell
        return to_ball(cell, entries.digits)

    return entries.changed(short)


def tableau_lines(
    tableau: Tableau, entries: Entries, width: int = 80, spelt: Callable[[str], str] = str
) -> list[str]:
    def text(cell: Cell) -> str:
        return spelt(cell_text(cell, entries.digits))

    lines = _grid(tableau, entries, text)
    if max(map(len, lines)) > width:
        lines = _listing(tableau, entries, width, text)
    return [*lines, *_dense(tableau, entries, width, text), *_predictor(entries, width, text)]


def _grid(tableau: Tableau, entries: Entries, text: Text) -> list[str]:
    lines = list(lines_of(entries, distinct_rows(tableau), range(tableau.size)))
    heads = [text(x.node) for x in lines if x.node is not None]
    heads += [""] if entries.embedded is None else ["b", "embedded"]
    columns = [aligned([[head] for head in ("", *heads)])]
    for m, colour in enumerate(tableau.colours):
        blank = [""] * len(entries.b[m])
        absent = ["."] * len(blank)
        rows = (absent if (row := x.groups[m]) is None else [*map(text, row)] for x in lines)
        columns.append([colour.name, *aligned([blank, *rows])[1:]])
    widths = [max(map(len, column)) for column in columns]
    first, *rest = (" | ".join(map(str.rjust, x, widths)) for x in zip(*columns, strict=True))
    rule = "-+-".join("-" * width for width in widths)
    shown = ([rule, row] if x.is_first else [row] for x, row in zip(lines, rest, strict=True))
    return [line.rstrip() for line in chain([first], *shown)]


def _listing(tableau: Tableau, entries: Entries, width: int, text: Text) -> list[str]:
    names = [colour.name for colour in tableau.colours]
    lines: list[str] = []
    vectors = [("c", entries.c), ("b", entries.b)]
    if entries.embedded is not None:
        vectors.append(("embedded", entries.embedded))
    for l, name in enumerate(names):
        for letter, rows in vectors:
            lines += vector_lines(_named(letter, tableau, name), [*map(text, rows[l])], width)
        lines.append("")
    for l in distinct_rows(tableau):
        for name, block in zip(names, entries.A[l], strict=True):
            if block is None:
                continue
            cells = [[*map(text, row)] for row in block]
            lines += block_lines(_named("A", tableau, names[l], name), cells, width)
    return [*lines[:-1], *_shared_rows(tableau, width)]


def _shared_rows(tableau: Tableau, width: int) -> list[str]:
    """Says whose stages a colour shares."""
    shown = {tableau.colours[l].space: tableau.colours[l].name for l in distinct_rows(tableau)}
    same = [
        f"{_named('A', tableau, colour.name, '·')} = "
        f"{_named('A', tableau, shown[colour.space], '·')}"
        for colour in tableau.colours
        if shown[colour.space] != colour.name
    ]
    return ["", *folded(", ".join(same), width, "  ")] if same else []


def _named(letter: str, tableau: Tableau, *colours: str) -> str:
    return f"{letter}{{{','.join(colours)}}}" if tableau.size > 1 else letter


def _dense(tableau: Tableau, entries: Entries, width: int, text: Text) -> list[str]:
    if entries.dense is None:
        return []
    lines = ["", "dense output, in each row the coefficients of θ, θ², …", ""]
    for colour, rows in zip(tableau.colours, entries.dense, strict=True):
        cells = [[*map(text, row)] for row in rows]
        lines += block_lines(f"{_named('b', tableau, colour.name)}(θ)", cells, width)
    return lines[:-1]


def _predictor(entries: Entries, width: int, text: Text) -> list[str]:
    lines = []
    for name, matrices in entries.predictor:
        lines += ["", f"predictor, weights of {_SLOPES[name]}, h = r h_old", ""]
        for k, matrix in enumerate(matrices):
            cells = [[*map(text, row)] for row in matrix]
            lines += block_lines(("1", "r")[k] if k < 2 else f"r^{k}", cells, width)
        lines.pop()
    return lines


_SLOPES = {"old": "the slopes of the last step", "new": "the slopes of earlier stages"}


def block_lines(name: str, cells: Sequence[Sequence[str]], width: int) -> list[str]:
    """Returns a block below its name, as many columns at a time as fit."""
    count = len(cells[0])
    groups = _columns_that_fit(cells, width)
    lines = []
    for group in groups:
        title = name
        if len(group) < count:
            title += f", {_numbers(group)} of {count}"
        rows = aligned([row[group.start : group.stop] for row in cells], _GAP, right=False)
        lines.append(f"{title} =")
        lines += indented(rows, _MARGIN)
        lines.append("")
    return lines


def _columns_that_fit(cells: Sequence[Sequence[str]], width: int) -> list[range]:
    gap = len(_GAP)
    room = width - len(_MARGIN) + gap  # the last column has no gap behind it
    groups = []
    start = 0
    used = 0
    for j, column in enumerate(zip(*cells, strict=True)):
        taken = max(map(len, column)) + gap
        if used and used + taken > room:
            groups.append(range(start, j))
            start = j
            used = 0
        used += taken
    groups.append(range(start, len(cells[0])))
    return groups


def _numbers(columns: range) -> str:
    first, last = columns.start + 1, columns.stop
    if first == last:
        return f"column {first}"
    joint = "and" if last == first + 1 else "to"
    return f"columns {first} {joint} {last}"


def vector_lines(name: str, texts: Sequence[str], width: int) -> list[str]:
    lines = [f"{name} ="]
    margin = " " * (len(name) + 2)
    for text, end in zip(texts, [","] * (len(texts) - 1) + [""], strict=True):
        longer = f"{lines[-1]} {text}{end}"
        if len(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(f"{margin} {text}{end}")
    return lines
