"""CSV: a row an entry, every number as exact text.

Colours and stages count from 1; of ``dense`` j is the power of theta.
"""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.payload import Payload
from garkcli.bridges.readers.rows import COLUMNS
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.bridges.targets.json_data import style_of


def write(payload: Payload) -> str:
    """The rows, below a head of comments."""
    return "\n".join([*HASH.lines(head(payload)), ",".join(COLUMNS), *_lines(payload)]) + "\n"


def _lines(payload: Payload) -> Iterator[str]:
    for part in ("A", "b", "c", "embedded", "dense"):
        for l, m, rows in payload.parts[part]:
            for i, row in enumerate(rows, start=1):
                for j, text in enumerate(payload.numbers(row, style_of(payload)), start=1):
                    place = f"{i},{j}" if part in {"A", "dense"} else f"{j},"
                    # the comma of root(x, n)
                    value = f'"{text}"' if "," in text else text
                    yield f"{part},{l},{m},{place},{value}"


BRIDGES = (
    Bridge(
        name="csv",
        summary="CSV, a row an entry, every number as exact text",
        kinds=EVERYTHING,
        suffix=".csv",
        write=write,
        reads_back=True,
    ),
)
