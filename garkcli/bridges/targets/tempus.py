"""Tempus of Trilinos: a parameter list in XML, of an explicit, diagonally implicit or IMEX method.

Tempus reads numbers by the stream operator of C++, for which ``1/3`` is 1: all are decimals.
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

from garkcli.bridges.comments import XML, head
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table
from garkcli.bridges.tables import imex_tables, lower_table

DECIMALS = Style()


def write(payload: Payload) -> str:
    """The list of a stepper."""
    lines = XML.lines(head(payload))
    if payload.kind == "rk":
        found = lower_table(payload, "tempus")
        lines += _stepper(payload, payload.stem, found)
        return "\n".join(lines) + "\n"
    explicit, implicit = imex_tables(payload, "tempus")
    body = [_parameter("Stepper Type", "string", "General IMEX RK")]
    body += _stepper(payload, "IMEX-RK Explicit Stepper", explicit)
    body += _stepper(payload, "IMEX-RK Implicit Stepper", implicit)
    order = str(payload.orders.effective)
    body.append(_parameter("overall order", "int", order))
    lines += _list(payload.stem, body)
    return "\n".join(lines) + "\n"


def _stepper(payload: Payload, name: str, found: Table) -> list[str]:
    kind = "General ERK" if found.is_explicit else "General DIRK"
    body = [_parameter("Stepper Type", "string", kind)]
    body += _list("Tableau", _tableau(payload, found))
    return _list(name, body)


def _tableau(payload: Payload, found: Table) -> list[str]:
    """The parameters of a table; embedded weights of a single stage would be read as none."""
    rows = [" ".join(payload.numbers(row, DECIMALS)) for row in found.A]
    strings = {
        "A": " ; ".join(rows),
        "b": " ".join(payload.numbers(found.b, DECIMALS)),
        "c": " ".join(payload.numbers(found.c, DECIMALS)),
    }
    if found.embedded is not None and found.stages > 1:
        embedded = payload.numbers(found.embedded, DECIMALS)
        strings["bstar"] = " ".join(embedded)
    lines = [_parameter(key, "string", x) for key, x in strings.items()]
    order = str(payload.orders.effective)
    return [*lines, _parameter("order", "int", order)]


def _parameter(name: str, kind: str, value: str) -> str:
    return f'<Parameter name="{name}" type="{kind}" value={quoteattr(value)}/>'


def _list(name: str, body: Sequence[str]) -> list[str]:
    inner = [f"  {line}" for line in body]
    return [f"<ParameterList name={quoteattr(name)}>", *inner, "</ParameterList>"]


BRIDGES = (
    Bridge(
        name="tempus",
        summary="Tempus of Trilinos: XML, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark"),
        suffix=".xml",
        write=write,
    ),
)
