"""AMReX: the lines of an inputs file, read at run time."""

from __future__ import annotations

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import explicit_table

DECIMALS = Style()
"""AMReX reads no fractions."""
_TYPE = 0  # a table of one's own
_UNUSED = "AMReX reads the extended weights, which are the embedded ones, and makes no use of them."


def write(payload: Payload) -> str:
    """The keys of ``integration.rk``; the rows of the lower triangle have their diagonal."""
    found = explicit_table(payload, "amrex")
    rows = [payload.numbers(row[: i + 1], DECIMALS) for i, row in enumerate(found.A)]
    entries = "  ".join(" ".join(row) for row in rows)
    notes = [] if found.embedded is None else [_UNUSED]
    lines = HASH.lines(head(payload, *notes))
    lines += [
        "integration.type = RungeKutta",
        f"integration.rk.type = {_TYPE}",
        _line("weights", payload.numbers(found.b, DECIMALS)),
    ]
    if found.embedded is not None:
        extended = payload.numbers(found.embedded, DECIMALS)
        lines.append(_line("extended_weights", extended))
    lines.append(_line("nodes", payload.numbers(found.c, DECIMALS)))
    lines.append(f"integration.rk.tableau = {entries}")
    return "\n".join(lines) + "\n"


def _line(key: str, numbers: list[str]) -> str:
    return f"integration.rk.{key} = {' '.join(numbers)}"


BRIDGES = (
    Bridge(
        name="amrex",
        summary="AMReX: lines of an inputs file, explicit methods",
        kinds=("rk",),
        suffix=".inputs",
        write=write,
    ),
)
