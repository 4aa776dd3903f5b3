"""A tableau as a LaTeX array, laid out as the paper prints it; needs amsmath only."""

from __future__ import annotations

from flint import arb

from garkcli.exact.display import to_latex
from garkcli.report.latex import number
from garkcli.report.tableau_text import cell_text, remark
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau


def render(tableau: Tableau, entries: Entries, name: str) -> str:
    """The array, with a comment that names it."""
    N = tableau.size
    groups = "|".join("c" * len(entries.b[m]) for m in range(N))
    lines = [f"% {line}" for line in (name, remark(entries)) if line]
    lines += ["\\[", "\\renewcommand{\\arraystretch}{1.2}", f"\\begin{{array}}{{c|{groups}}}"]
    rows: dict[int, int] = {}
    for l, colour in enumerate(tableau.colours):
        rows.setdefault(colour.space, l)
    for l in rows.values():
        for i, node in enumerate(entries.c[l]):
            cells = [_cell(node, entries)]
            for m in range(N):
                block = entries.A[l][m]
                empty = [""] * len(entries.b[m])
                cells += empty if block is None else [_cell(x, entries) for x in block[i]]
            lines.append("  " + " & ".join(cells) + r" \\")
        lines.append(r"  \hline")
    weights = [_cell(x, entries) for row in entries.b for x in row]
    lines += ["  & " + " & ".join(weights), "\\end{array}", "\\]"]
    return "\n".join(lines) + "\n"


def _cell(cell: Cell, entries: Entries) -> str:
    return number(cell_text(cell, entries.digits)) if isinstance(cell, arb) else to_latex(cell)
