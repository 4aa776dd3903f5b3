"""A tableau as LaTeX arrays in the layout of the paper: Q and P, as in eq. (psymplecticGARK), for
the stages and weights of both parts of a partitioned method.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from flint import arb

from garkcli.exact.display import to_latex
from garkcli.exact.polynomial_text import power_text
from garkcli.exact.rewriting import decimal_latex
from garkcli.page.cells import cell_text, lines_of, parts_of
from garkcli.page.exactly import sum_latex
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau

MAX_BESIDE = 8
"""The most columns of two arrays side by side."""


def tableau_lines(tableau: Tableau, entries: Entries) -> list[str]:
    return [*displays(tableau, entries), *_dense(entries), *_predictor(entries)]


def displays(
    tableau: Tableau, entries: Entries, text: Callable[[Cell], str] | None = None
) -> Iterator[str]:
    arrays = [
        [*([f"{letter}: \\quad"] if letter else []), *_array(entries, text, stages, driven)]
        for letter, stages, driven in parts_of(tableau)
    ]
    if len(arrays) > 1 and sum(map(len, entries.b)) <= MAX_BESIDE:
        positions, momenta = arrays
        arrays = [[*positions, "\\qquad", *momenta]]
    for array in arrays:
        yield from _display(array)


def _display(lines: Sequence[str]) -> Iterator[str]:
    yield r"\["
    yield r"\renewcommand{\arraystretch}{1.2}"
    yield from lines
    yield r"\]"


def _array(
    entries: Entries,
    text: Callable[[Cell], str] | None,
    stages: Sequence[int],
    colours: Sequence[int],
) -> Iterator[str]:
    def usual(cell: Cell) -> str:
        return _cell(cell, entries)

    text = text or usual
    groups = "|".join("c" * len(entries.b[m]) for m in colours)
    yield f"\\begin{{array}}{{c|{groups}}}"
    *lines, last = lines_of(entries, stages, colours)
    for k, line in enumerate([*lines, last]):
        if line.is_first and k:
            yield r"  \hline"
        cells = [] if line.node is None else [text(line.node)]
        for m, row in zip(colours, line.groups, strict=True):
            cells += [""] * len(entries.b[m]) if row is None else map(text, row)
        end = "" if line is last else r" \\"
        yield f"  {'& ' if line.node is None else ''}{' & '.join(cells)}{end}"
    yield "\\end{array}"


def _dense(entries: Entries) -> Iterator[str]:
    if entries.dense is None:
        return
    yield r"\["
    yield r"\begin{aligned}"
    for weight, polynomial in dense_polynomials(entries):
        yield f"  {weight} &= {polynomial} \\\\"
    yield r"\end{aligned}"
    yield r"\]"


def dense_polynomials(entries: Entries) -> Iterator[tuple[str, str]]:
    found = entries.dense or ()
    for l, rows in enumerate(found, start=1):
        letter = f"b^{{[{l}]}}" if len(found) > 1 else "b"
        for i, row in enumerate(rows, start=1):
            powers = ((x, power_text(r"\theta", k, f"{{{k}}}")) for k, x in enumerate(row, 1))
            yield f"{letter}_{{{i}}}(\\theta)", sum_latex(powers, lambda x: _cell(x, entries))


def _predictor(entries: Entries) -> Iterator[str]:
    for name, matrices in entries.predictor:
        letter = {"old": "P", "new": "Q"}[name]
        yield r"\["
        for k, matrix in enumerate(matrices):
            begin = f"{letter}(r) = " if not k else f"+ {power_text('r', k, f'{{{k}}}')}"
            yield f"{begin}\\begin{{pmatrix}}"
            for row in matrix:
                yield f"  {' & '.join(_cell(x, entries) for x in row)} \\\\"
            yield r"\end{pmatrix}"
        yield r"\]"


def _cell(cell: Cell, entries: Entries) -> str:
    return (
        decimal_latex(cell_text(cell, entries.digits)) if isinstance(cell, arb) else to_latex(cell)
    )
