"""Irksome: a module with a ``ButcherTableau``, fully implicit methods among them."""

from __future__ import annotations

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import table
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.tableau.pointwise import Row


def write(payload: Payload) -> str:
    """The arguments are A, b, the embedded weights, c, the orders and gamma0."""
    found = table(payload)
    orders = payload.orders
    lines = HASH.lines(head(payload))
    lines += [
        "",
        "import numpy as np",
        "from irksome.tableaux.ButcherTableaux import ButcherTableau",
        "",
        "A = np.array([",
    ]
    for row in found.A:
        lines += _row(payload, "    [", row, "],")
    lines.append("], dtype=float)")
    lines += _row(payload, "b = np.array([", found.b, "], dtype=float)")
    embedded, gamma = "None", "None"
    if found.embedded is not None:
        # the embedded method has no weight on the explicit term
        embedded, gamma = "bhat", "0"
        row = found.embedded
        lines += _row(payload, "bhat = np.array([", row, "], dtype=float)")
    lines += _row(payload, "c = np.array([", found.c, "], dtype=float)")
    arguments = f"A, b, {embedded}, c, {orders.effective}, {orders.embedded}, {gamma}"
    lines.append(f"{payload.identifier('python')} = ButcherTableau({arguments})")
    return "\n".join(lines) + "\n"


def _row(payload: Payload, begin: str, row: Row, end: str) -> list[str]:
    return filled(payload.numbers(row, PYTHON), begin, end)


BRIDGES = (
    Bridge(
        name="irksome",
        summary="Irksome: a module with a ButcherTableau",
        kinds=("rk",),
        suffix=".py",
        write=write,
    ),
)
