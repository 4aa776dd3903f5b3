"""A tableau for people: as the paper prints it where it fits, block by block where it does not."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from garkcli.exact.display import to_ball, to_text
from garkcli.page.cells import cell_text, distinct_rows
from garkcli.page.paint import aligned, indented
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau

_MARGIN = " " * 4
_GAP = "  "


def readable(entries: Entries) -> Entries:
    """The entries of a method with rounded coefficients for people: fractions longer than decimals
    as decimals.
    """
    widest = entries.digits + len("-0.")

    def short(cell: Cell) -> Cell:
        if isinstance(cell, arb):
            return cell
        if len(to_text(cell)) <= widest:
            return cell
        return to_ball(cell, entries.digits)

    return entries.changed(short)


def tableau_lines(tableau: Tableau, entries: Entries, width: int = 80) -> list[str]:
    """The whole tableau.

    Args:
        tableau: for the names of its colours.
        entries: its entries, see ``garkcli.tableau.pointwise``.
        width: columns of the terminal.
    """
    lines = _grid(tableau, entries)
    if max(map(len, lines)) > width:
        lines = _listing(tableau, entries, width)
    return [*lines, *_dense(tableau, entries, width)]


def _grid(tableau: Tableau, entries: Entries) -> list[str]:
    """C | A^{1,1} | A^{1,2} | …, one colour under the other, b and embedded weights below."""
    shown = distinct_rows(tableau)
    columns = [_node_column(entries, shown)]
    for m in range(tableau.size):
        column = _colour_column(tableau, entries, shown, m)
        columns.append(column)
    widths = [max(map(len, column)) for column in columns]
    lines = [" | ".join(map(str.rjust, cells, widths)) for cells in zip(*columns, strict=True)]
    rule = "-+-".join(["-" * width for width in widths])
    out = [lines[0], rule]
    start = 1
    for l in shown:
        end = start + len(entries.c[l])
        out += [*lines[start:end], rule]
        start = end
    out += lines[start:]
    return [line.rstrip() for line in out]


def _node_column(entries: Entries, shown: list[int]) -> list[str]:
    """The nodes of the stage spaces shown, between an empty head and an empty foot."""
    cells = [""]
    for l in shown:
        cells += _texts(entries.c[l], entries.digits)
    cells += [""] if entries.embedded is None else ["b", "embedded"]
    return aligned([[text] for text in cells])


def _colour_column(tableau: Tableau, entries: Entries, shown: list[int], m: int) -> list[str]:
    """The name of a colour, its blocks under each other, and its weights."""
    digits = entries.digits
    weights = _texts(entries.b[m], digits)
    absent = ["."] * len(weights)
    rows = [[""] * len(weights)]
    for l in shown:
        block = entries.A[l][m]
        if block is None:
            rows += [absent] * len(entries.c[l])
        else:
            rows += [_texts(row, digits) for row in block]
    rows.append(weights)
    if entries.embedded is not None:
        rows.append(_texts(entries.embedded[m], digits))
    lines = aligned(rows)
    lines[0] = tableau.colours[m].name
    return lines


def _texts(cells: Sequence[Cell], digits: int) -> list[str]:
    """Entries as texts."""
    return [cell_text(x, digits) for x in cells]


def _listing(tableau: Tableau, entries: Entries, width: int) -> list[str]:
    """Each block on its own."""
    digits = entries.digits
    names = [colour.name for colour in tableau.colours]
    lines: list[str] = []
    vectors = [("c", entries.c), ("b", entries.b)]
    if entries.embedded is not None:
        vectors.append(("embedded", entries.embedded))
    for l, name in enumerate(names):
        for letter, rows in vectors:
            texts = _texts(rows[l], digits)
            lines += _vector(f"{letter}{{{name}}}", texts, width)
        lines.append("")
    for l in distinct_rows(tableau):
        row_name = names[l]
        for name, block in zip(names, entries.A[l], strict=True):
            if block is None:
                continue
            cells = [_texts(row, digits) for row in block]
            title = f"A{{{row_name},{name}}}"
            lines += _block(title, cells, width)
    return lines[:-1]


def _dense(tableau: Tableau, entries: Entries, width: int) -> list[str]:
    """The polynomials of dense output, a block per colour with a row per stage."""
    if entries.dense is None:
        return []
    lines = ["", "dense output, in each row the coefficients of θ, θ², …", ""]
    for colour, rows in zip(tableau.colours, entries.dense, strict=True):
        cells = [_texts(row, entries.digits) for row in rows]
        lines += _block(f"b{{{colour.name}}}(θ)", cells, width)
    return lines[:-1]


def _block(name: str, cells: Sequence[Sequence[str]], width: int) -> list[str]:
    """A block beneath its name: whole where it fits, else as many of its columns at a time as do.

    Args:
        name: what the block is called.
        cells: its entries.
        width: columns of the terminal. An entry that is longer has lines of its own.
    """
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
    """The columns of a block in groups that each fit between the margin and ``width``."""
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
    """Columns by their numbers from 1."""
    first, last = columns.start + 1, columns.stop
    if first == last:
        return f"column {first}"
    joint = "and" if last == first + 1 else "to"
    return f"columns {first} {joint} {last}"


def _vector(name: str, texts: Sequence[str], width: int) -> list[str]:
    """Nodes or weights, in as many lines as they need."""
    lines = [f"{name} ="]
    margin = " " * (len(name) + 2)
    for text, end in zip(texts, [","] * (len(texts) - 1) + [""], strict=True):
        longer = f"{lines[-1]} {text}{end}"
        if len(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(f"{margin} {text}{end}")
    return lines
