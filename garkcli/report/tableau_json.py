"""``gark tableau`` and ``gark conjugate`` as JSON: exact strings, with floats of the same shape
beside them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from flint import arb

from garkcli.exact.display import to_float
from garkcli.report.check_json import colours_data
from garkcli.report.json_text import to_json
from garkcli.report.tableau_text import cell_text
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau


def render(tableau: Tableau, entries: Entries, name: str) -> str:
    """The tableau as JSON text."""
    data = {
        "schema": "gark/tableau/1",
        "name": name,
        "exact": entries.is_exact,
        "colours": colours_data(tableau),
        **_mapped(entries, lambda cell: cell_text(cell, entries.digits)),
        "float": _mapped(entries, _float),
    }
    return to_json(data) + "\n"


def _float(cell: Cell) -> float:
    return float(cell) if isinstance(cell, arb) else to_float(cell)


def _mapped(entries: Entries, change: Callable[[Cell], Any]) -> dict[str, Any]:
    return {
        "c": [[change(x) for x in row] for row in entries.c],
        "A": [
            [
                None if block is None else [[change(x) for x in row] for row in block]
                for block in row
            ]
            for row in entries.A
        ],
        "b": [[change(x) for x in row] for row in entries.b],
    }
