"""CSV: a row an entry, every number as exact text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.targets.json_data import style_of
from garkcli.tableau.pointwise import Row

COLUMNS = "part,l,m,i,j,value"
"""Colours and stages count from 1; of ``dense`` j is the power of theta."""


def write(payload: Payload) -> str:
    """The rows, below a head of comments."""
    lines = HASH.lines(head(payload))
    lines.append(COLUMNS)
    lines += _rows(payload)
    return "\n".join(lines) + "\n"


def _rows(payload: Payload) -> Iterator[str]:
    for l, blocks in enumerate(payload.A, start=1):
        for m, block in enumerate(blocks, start=1):
            if block is not None:
                yield from _matrix(payload, f"A,{l},{m}", block)
    parts = [("b", payload.b), ("c", payload.c)]
    if payload.embedded is not None:
        parts.append(("embedded", payload.embedded))
    for part, rows in parts:
        for l, row in enumerate(rows, start=1):
            for i, text in enumerate(_texts(payload, row), start=1):
                yield f"{part},{l},,{i},,{text}"
    for l, rows in enumerate(payload.dense or (), start=1):
        yield from _matrix(payload, f"dense,{l},", rows)


def _matrix(payload: Payload, place: str, rows: Sequence[Row]) -> Iterator[str]:
    for i, row in enumerate(rows, start=1):
        for j, text in enumerate(_texts(payload, row), start=1):
            yield f"{place},{i},{j},{text}"


def _texts(payload: Payload, row: Row) -> Iterator[str]:
    for text in payload.numbers(row, style_of(payload)):
        # the comma of root(x, n)
        yield f'"{text}"' if "," in text else text


BRIDGES = (
    Bridge(
        name="csv",
        summary="CSV, a row an entry, every number as exact text",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".csv",
        write=write,
        reads_back=True,
    ),
)
