"""LaTeX: the tableau as papers print it, embedded weights below the others."""

from __future__ import annotations

from functools import partial

from flint import arb, fmpq

from garkcli.bridges.comments import PERCENT, head
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.exact.display import to_latex
from garkcli.exact.rewriting import decimal_latex
from garkcli.page.exactly import definition_latex
from garkcli.page.tableau_latex import displays
from garkcli.tableau.letters import with_letters
from garkcli.tableau.pointwise import Cell, Entries

DECIMALS = Style(longest=1000, point=False)


def write(payload: Payload) -> str:
    notes = []
    if payload.embedded is not None:
        notes.append("Below the weights are the embedded ones.")
    if payload.dense is not None:
        notes.append("Left out: dense output.")
    lines = PERCENT.lines(head(payload, *notes))
    entries = Entries(payload.c, payload.A, payload.b, True, 0, embedded=payload.embedded)
    with with_letters(payload.tableau) as letters:
        arrays = [*displays(payload.tableau, entries, partial(_cell, payload))]
    for root, letter in letters.items():
        lines.append(rf"\[ {definition_latex(root, letter)} \]")
    lines += arrays
    return "\n".join(lines) + "\n"


def _cell(payload: Payload, cell: Cell) -> str:
    """An entry: exact, or a decimal if the file has decimals or digits were requested."""
    is_printed = isinstance(cell, fmpq) and payload.tolerance is not None
    if isinstance(cell, arb) or is_printed or payload.digits is not None:
        return decimal_latex(payload.number(cell, DECIMALS))
    return to_latex(cell)


BRIDGES = (
    Bridge(
        name="latex",
        summary="the tableau in LaTeX, as papers print it",
        kinds=EVERYTHING,
        suffix=".tex",
        write=write,
        reads_back=True,
    ),
)
