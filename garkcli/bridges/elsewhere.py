"""Orders that a source tree declares apart from its tables: for an algorithm, for a class."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from textwrap import dedent

from garkcli.bridges.readers.registry import find_tables, readers_for
from garkcli.bridges.said import order_said_of
from garkcli.bridges.sources import source_text
from garkcli.errors import UsageProblem
from garkcli.frozen import replace
from garkcli.sources.found import FoundTable, troubled

_OF_ALGORITHM = re.compile(
    r"^[ \t]*(?:\w+\.)?alg_order\(\s*\w{0,50}::(?:Union\{)?(?P<names>[\w\s,.]{1,900})\}?\s*\)"
    r"\s*=\s*(?P<order>[0-9]{1,2})[ \t]*(?:#.*)?$",
    re.MULTILINE,
)
"""``alg_order(::Tsit5) = 5`` of SciML."""
_CLASS = re.compile(r"^class\s+(?P<name>\w+).*(?P<body>(?:\n(?:[ \t].*)?)*)", re.MULTILINE)
_USED = re.compile(r"^\w*tableau\b[^=\n]*=[ \t]*(?P<name>\w+)[ \t]*(?:#.*)?$", re.MULTILINE)
_ORDER = re.compile(r"^order\b[^=\n]*=[ \t]*(?P<n>[0-9]{1,2})[ \t]*(?:#.*)?$", re.MULTILINE)
"""An order in the class body, where lines have no margin."""
_MADE_FOR = re.compile(
    r"(?P<name>\w+?)(?:E?S?DIRK)?(?:IMEX)?(?:Rodas)?(?:Constant)?(?:Cache|Tableau)(?:Actual)?"
)
"""A table is named after its algorithm: ``Tsit5ConstantCache``, ``ROS3PRodasTableau``."""


def declared_orders(paths: Iterable[str]) -> Mapping[str, int]:
    by_name: dict[str, set[int]] = {}
    for path in paths:
        if not path.endswith((".jl", ".py")):
            continue
        try:
            text, _ = source_text(path)
        except UsageProblem:
            continue
        for name, order in orders_in(text):
            by_name.setdefault(name, set()).add(order)
    return {name: orders.pop() for name, orders in by_name.items() if len(orders) == 1}


def orders_in(text: str) -> list[tuple[str, int]]:
    r"""The orders declared in one source, with names.

    >>> orders_in("alg_order(alg::Union{BS5, Tsit5}) = 5")
    [('BS5', 5), ('Tsit5', 5)]
    >>> orders_in("class RK4(Solver):\n  def f():\n    order = 3\n  order = 4\n  tableau = _RK4\n")
    [('RK4', 4), ('_RK4', 4)]
    """
    declared = []
    for match in _OF_ALGORITHM.finditer(text) if "alg_order" in text else ():
        names = [name.strip().rpartition(".")[2] for name in match["names"].split(",")]
        declared += [(name, int(match["order"])) for name in names]
    for match in _CLASS.finditer(text) if "order" in text else ():
        body = dedent(match["body"])
        order = _ORDER.search(body)
        if order is not None:
            names = [match["name"], *(x["name"] for x in _USED.finditer(body))]
            declared += [(name, int(order["n"])) for name in names]
    return declared


def with_bases(
    tables: Sequence[FoundTable], source: str, others: Sequence[str]
) -> Sequence[FoundTable]:
    """Coefficients of tables that others name: here, or in a list of macros elsewhere."""
    missing = {x.base for x in tables if x.base}
    if not missing:
        return tables
    bases = {x.name: x for x in tables if x.b and x.name in missing}
    for path in others:
        missing -= bases.keys()
        if not missing:
            break
        if path != source and path.endswith(_LISTS):
            text, _ = source_text(path)
            if re.search(rf"\(\s*(?:{'|'.join(map(re.escape, missing))})\s*,\s*\{{", text):
                tables_there = find_tables(text, path, readers_for(path))
                bases |= {x.name: x for x in tables_there if x.b and x.name in missing}
    return [_with_base(x, bases.get(x.base)) if x.base else x for x in tables]


_LISTS = (".def", ".c", ".h", ".cpp", ".hpp")


def _with_base(table: FoundTable, base: FoundTable | None) -> FoundTable:
    if base is None:
        return troubled(table, f"it is made of {table.base}, which is in none of these sources")
    embedded = base.embedded
    orders = {"order": table.order or base.order}
    orders["embedded_order"] = table.embedded_order or base.embedded_order
    return replace(
        table, base="", A=base.A, b=base.b, c=base.c, embedded=embedded, units=base.units, **orders
    )


def with_declared(
    tables: Iterable[FoundTable], text: str, orders: Mapping[str, int]
) -> Iterator[FoundTable]:
    lines = text.split("\n")
    for table in tables:
        if table.order or table.kind:
            yield table
        else:
            said = order_said_of(lines, table.line)
            yield replace(table, order=order_of(table, orders), said_order=said)


def order_of(table: FoundTable, orders: Mapping[str, int]) -> int | None:
    if table.name in orders:
        return orders[table.name]
    made_for = _MADE_FOR.fullmatch(table.name)
    return None if made_for is None else orders.get(made_for["name"])
