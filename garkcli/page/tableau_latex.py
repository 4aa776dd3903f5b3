"""A tableau as LaTeX arrays, laid out as the paper prints it; needs amsmath only.

A method for positions and momenta is two arrays, Q and P, as in eq. (psymplecticGARK): each with
the stages at which its part is computed and the weights that update it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from flint import arb

from garkcli.exact.display import to_latex
from garkcli.frozen import Frozen
from garkcli.page.cells import cell_text, distinct_rows
from garkcli.page.latex import number
from garkcli.tableau.pointwise import Cell, Entries, Row
from garkcli.tableau.tableau import Tableau

MAX_BESIDE = 8
"""Most columns of two arrays that stand beside each other."""


def tableau_lines(tableau: Tableau, entries: Entries) -> list[str]:
    """The arrays, and the polynomials of dense output."""
    return [*displays(tableau, entries, entries.embedded), *_dense(entries)]


class _Shown(Frozen):
    """What stands in the arrays.

    Attributes:
        entries: of the tableau.
        text: an entry in LaTeX.
        feet: the rows of weights below the line, each with a row per colour.
    """

    entries: Entries
    text: Callable[[Cell], str]
    feet: Sequence[Sequence[Row]]


def displays(
    tableau: Tableau,
    entries: Entries,
    embedded: Sequence[Row] | None = None,
    text: Callable[[Cell], str] | None = None,
) -> Iterator[str]:
    """The lines of the arrays.

    Args:
        tableau: for its colours, and for what they drive.
        entries: its entries.
        embedded: further weights, below b.
        text: an entry in LaTeX; by default exact ones exactly.
    """
    feet = [entries.b]
    if embedded is not None:
        feet.append(tuple(embedded))

    def usual(cell: Cell) -> str:
        return _cell(cell, entries)

    shown = _Shown(entries, text or usual, feet)
    arrays = []
    columns = 0
    for letter, stages, driven in parts_of(tableau):
        array = _array(shown, stages, driven)
        if not letter:
            yield from _display(array)
            return
        arrays.append([f"{letter}: \\quad", *array])
        columns += sum(len(entries.b[m]) for m in driven)
    if columns <= MAX_BESIDE:
        positions, momenta = arrays
        yield from _display([*positions, "\\qquad", *momenta])
    else:
        for array in arrays:
            yield from _display(array)


def parts_of(tableau: Tableau) -> Iterator[tuple[str, Sequence[int], Sequence[int]]]:
    """The arrays that a tableau is printed as: a letter or none, a colour for each group of rows,
    the colours of the columns.
    """
    if not tableau.is_partitioned:
        yield "", distinct_rows(tableau), range(tableau.size)
        return
    for letter, part in (("Q", "q"), ("P", "p")):
        numbered = enumerate(tableau.colours)
        driven = [m for m, colour in numbered if colour.part == part]
        yield letter, _stages_of(tableau, driven), driven


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


def _array(shown: _Shown, stages: Sequence[int], colours: Sequence[int]) -> list[str]:
    """C | A | …, the stages of one colour of ``stages`` under those of the other, b below."""
    entries = shown.entries
    text = shown.text
    groups = "|".join("c" * len(entries.b[m]) for m in colours)
    lines = [f"\\begin{{array}}{{c|{groups}}}"]
    for l in stages:
        for i, node in enumerate(entries.c[l]):
            cells = [text(node)]
            for m in colours:
                block = entries.A[l][m]
                if block is None:
                    cells += [""] * len(entries.b[m])
                else:
                    cells += map(text, block[i])
            row = " & ".join(cells)
            lines.append(f"  {row} \\\\")
        lines.append(r"  \hline")
    feet = []
    for weights in shown.feet:
        cells = [text(x) for m in colours for x in weights[m]]
        row = " & ".join(cells)
        feet.append(f"  & {row}")
    lines.append(" \\\\\n".join(feet))
    lines.append("\\end{array}")
    return lines


def _dense(entries: Entries) -> Iterator[str]:
    """The polynomials of dense output, one a line."""
    if entries.dense is None:
        return
    yield r"\["
    yield r"\begin{aligned}"
    for weight, polynomial in dense_polynomials(entries):
        yield f"  {weight} &= {polynomial} \\\\"
    yield r"\end{aligned}"
    yield r"\]"


def dense_polynomials(entries: Entries) -> Iterator[tuple[str, str]]:
    """The weights of dense output and their polynomials in θ."""
    found = entries.dense or ()
    for l, rows in enumerate(found, start=1):
        letter = f"b^{{[{l}]}}" if len(found) > 1 else "b"
        for i, row in enumerate(rows, start=1):
            terms = _polynomial([_cell(x, entries) for x in row])
            yield f"{letter}_{{{i}}}(\\theta)", terms


def _polynomial(coefficients: Sequence[str]) -> str:
    """A polynomial in θ without a constant term, from its coefficients in LaTeX."""
    text = ""
    for k, coefficient in enumerate(coefficients, start=1):
        if coefficient == "0":
            continue
        power = r"\theta" if k == 1 else f"\\theta^{{{k}}}"
        sign, size = "+", coefficient
        if size.startswith("-"):
            sign, size = "-", size[1:]
        if _is_sum(size):
            sign, size = "+", rf"\left({coefficient}\right)"
        factor = "" if size == "1" else size
        if text:
            text += f" {sign} {factor}{power}"
        else:
            text = f"{'-' if sign == '-' else ''}{factor}{power}"
    return text or "0"


def _is_sum(latex: str) -> bool:
    """Whether a number is written as a sum, outside of braces."""
    depth = 0
    for sign in latex:
        depth += (sign == "{") - (sign == "}")
        if depth == 0 and sign in "+-":
            return True
    return False


def _cell(cell: Cell, entries: Entries) -> str:
    return number(cell_text(cell, entries.digits)) if isinstance(cell, arb) else to_latex(cell)
