"""LaTeX: the tableau as the paper prints it, embedded weights below the others."""

from __future__ import annotations

from functools import partial

from flint import fmpq

from garkcli.bridges.comments import PERCENT, head
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import Cell
from garkcli.exact.display import decimal_latex, to_latex
from garkcli.exact.field import Algebraic
from garkcli.frozen import replace
from garkcli.page.tableau_latex import displays

DECIMALS = Style(longest=1000, point=False)
"""Of methods with rounded coefficients, and of entries without radicals."""


def write(payload: Payload) -> str:
    """The arrays, for amsmath."""
    lines = PERCENT.lines(head(payload, *_notes(payload)))
    entries = replace(payload.entries, is_exact=True, embedded=payload.embedded)
    lines += displays(payload.tableau, entries, partial(_cell, payload))
    return "\n".join(lines) + "\n"


def _notes(payload: Payload) -> list[str]:
    notes = []
    if payload.embedded is not None:
        notes.append("Below the weights are the embedded ones.")
    if payload.dense is not None:
        notes.append("The dense output of the method is left out.")
    return notes


def _cell(payload: Payload, cell: Cell) -> str:
    """An entry: exact, or a decimal where the file has decimals or digits were requested."""
    is_asked_for = payload.digits is not None
    if isinstance(cell, Algebraic) and not is_asked_for:
        return to_latex(cell)
    is_printed_exactly = payload.tolerance is None and not is_asked_for
    if isinstance(cell, fmpq) and is_printed_exactly:
        return to_latex(cell)
    return decimal_latex(payload.number(cell, DECIMALS))


BRIDGES = (
    Bridge(
        name="latex",
        summary="the tableau in LaTeX, as papers print it",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".tex",
        write=write,
        reads_back=True,
    ),
)
