"""NumPy: a Python module with arrays of floats, each the nearest to the exact number."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.tableau.pointwise import Block, Row

PYTHON = Style(longest=100, fraction="{p}/{q}", point=False)
"""Python rounds the quotient of two whole numbers, and a decimal of any length, once."""


def write(payload: Payload) -> str:
    """A module with A, b, c, and what else there is."""
    lines = HASH.lines(head(payload, *_notes(payload)))
    lines += ["", "import numpy as np", ""]
    lines += definitions(payload)
    return "\n".join(lines) + "\n"


def definitions(payload: Payload) -> list[str]:
    """The assignments: arrays of one vector field, lists of arrays of several."""
    lines = [f"order = {payload.orders.order}"]
    if payload.orders.embedded is not None:
        lines.append(f"embedded_order = {payload.orders.embedded}")
    if payload.kind == "rk":
        lines += _array("A", payload.A[0][0] or (), payload)
        lines += _array("b", payload.b[0], payload)
        lines += _array("c", payload.c[0], payload)
        if payload.embedded is not None:
            lines += _array("embedded", payload.embedded[0], payload)
        if payload.dense is not None:
            lines += _array("dense", payload.dense[0], payload)
        return lines
    lines += _blocks(payload)
    lines += _list("b", payload.b, payload)
    lines += _list("c", payload.c, payload)
    if payload.embedded is not None:
        lines += _list("embedded", payload.embedded, payload)
    if payload.dense is not None:
        lines += _list("dense", payload.dense, payload)
    return lines


def _notes(payload: Payload) -> list[str]:
    notes = []
    if payload.kind != "rk":
        notes.append(
            "A[l][m] has the weights with which the stages of vector field l see vector field m."
        )
    if payload.dense is not None:
        notes.append("dense: the coefficients of theta, theta^2, ... of b_i(theta), a row a stage.")
    return notes


def _blocks(payload: Payload) -> list[str]:
    lines = ["A = ["]
    for blocks in payload.A:
        lines.append("    [")
        for block in blocks:
            lines += _item(block, payload, 8)
        lines.append("    ],")
    return [*lines, "]"]


def _list(name: str, rows: Sequence[Row | Sequence[Row]], payload: Payload) -> list[str]:
    lines = [f"{name} = ["]
    for row in rows:
        lines += _item(row, payload, 4)
    return [*lines, "]"]


def _item(cells: Block | Row | Sequence[Row], payload: Payload, indent: int) -> list[str]:
    """An array in a list, or None."""
    margin = " " * indent
    if cells is None:
        return [f"{margin}None,"]
    lines = _array("", cells, payload)
    return [f"{margin}{line}" for line in lines[:-1]] + [f"{margin}{lines[-1]},"]


def _array(name: str, cells: Row | Sequence[Row], payload: Payload) -> list[str]:
    """An assignment of an array, or the array alone."""
    begin = f"{name} = np.array(" if name else "np.array("
    if cells and not isinstance(cells[0], tuple):
        numbers = payload.numbers(cells, PYTHON)  # type: ignore[arg-type]
        return filled(numbers, f"{begin}[", "], dtype=float)")
    lines = [f"{begin}["]
    for row in cells:
        numbers = payload.numbers(row, PYTHON)  # type: ignore[arg-type]
        lines += filled(numbers, "    [", "],")
    return [*lines, "], dtype=float)"]


BRIDGES = (
    Bridge(
        name="numpy",
        summary="a Python module with NumPy arrays",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".py",
        write=write,
        reads_back=True,
    ),
)
