"""A tableau as LaTeX arrays, laid out as the paper prints it; needs amsmath only.

A method for positions and momenta is two arrays, Q and P, as in eq. (psymplecticGARK): each with
the stages at which its part is computed and the weights that update it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import arb

from garkcli.exact.display import to_latex
from garkcli.page.latex import fragment, number
from garkcli.report.tableau_text import cell_text, distinct_rows, remark
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau

MAX_BESIDE = 8
"""Most columns of two arrays that stand beside each other."""


def render(
    tableau: Tableau, entries: Entries, name: str, is_document: bool = False
) -> str:
    """The arrays, with a comment that names them.

    Args:
        tableau: for its colours, and for what they drive.
        entries: its entries, see ``garkcli.tableau.pointwise``.
        name: one line.
        is_document: whether the text is a document that compiles as it stands.
    """
    comments = (name, remark(entries))
    lines = [f"% {comment}\n" for comment in comments if comment]
    displays = _displays(tableau, entries)
    lines += [f"{line}\n" for line in displays]
    if is_document:
        return "".join(fragment(lines, is_document))
    return "".join(lines)


def _displays(tableau: Tableau, entries: Entries) -> Iterator[str]:
    if not tableau.is_partitioned:
        colours = range(tableau.size)
        yield from _display(_array(entries, distinct_rows(tableau), colours))
        return
    arrays = []
    columns = 0
    for letter, part in (("Q", "q"), ("P", "p")):
        numbered = enumerate(tableau.colours)
        driven = [m for m, colour in numbered if colour.part == part]
        stages = _stages_of(tableau, driven)
        array = _array(entries, stages, driven)
        arrays.append([f"{letter}: \\quad", *array])
        columns += sum(len(entries.b[m]) for m in driven)
    if columns <= MAX_BESIDE:
        positions, momenta = arrays
        yield from _display([*positions, "\\qquad", *momenta])
    else:
        for array in arrays:
            yield from _display(array)


def _stages_of(tableau: Tableau, driven: Sequence[int]) -> list[int]:
    """A colour for each stage space whose stages see one of the colours ``driven``."""
    seeing = []
    for l in distinct_rows(tableau):
        blocks = [tableau.block(l, m) for m in driven]
        if any(block is not None for block in blocks):
            seeing.append(l)
    return seeing


def _display(lines: Sequence[str]) -> Iterator[str]:
    yield r"\["
    yield r"\renewcommand{\arraystretch}{1.2}"
    yield from lines
    yield r"\]"


def _array(
    entries: Entries, shown: Sequence[int], colours: Sequence[int]
) -> list[str]:
    """C | A | …, the stages of one colour of ``shown`` under those of the other, b below."""
    groups = "|".join("c" * len(entries.b[m]) for m in colours)
    lines = [f"\\begin{{array}}{{c|{groups}}}"]
    for l in shown:
        for i, node in enumerate(entries.c[l]):
            cells = [_cell(node, entries)]
            for m in colours:
                block = entries.A[l][m]
                if block is None:
                    cells += [""] * len(entries.b[m])
                else:
                    cells += [_cell(x, entries) for x in block[i]]
            row = " & ".join(cells)
            lines.append(f"  {row} \\\\")
        lines.append(r"  \hline")
    weights = []
    for m in colours:
        weights += [_cell(x, entries) for x in entries.b[m]]
    row = " & ".join(weights)
    lines.append(f"  & {row}")
    lines.append("\\end{array}")
    return lines


def _cell(cell: Cell, entries: Entries) -> str:
    if isinstance(cell, arb):
        return number(cell_text(cell, entries.digits))
    return to_latex(cell)
