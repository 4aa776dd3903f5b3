"""Whether arrays called A and b are a method at all: other matrices have such names, too."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import PurePath

from flint import arb, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.sources.found import FoundTable
from garkcli.sources.naming import METHODS

_SHORT = re.compile("euler|midpoint|implicit|trapez|crank", re.IGNORECASE)
"""Words for methods of few numbers."""
NEAR = 0.01
"""Sums that differ by less are meant to be the same."""
FAR = 0.5
"""Weights of a method have a sum that is nearer to 1, misprints included."""


def is_plausible(table: FoundTable, method: MethodFile) -> bool:
    """Whether a table is a method: its source says so, or its numbers do. Whole numbers, of one
    stage or without nodes, need words.

    The nodes of a method are the row sums of its matrix, most of them even where one is misprinted;
    without nodes the sum of its weights is 1, and its matrix is triangular or meets order 2.
    """
    if table.is_sure:
        return True
    tableau = method.tableau
    rows = [row for block in tableau.blocks.values() for row in block]
    is_bare = len(rows) < 2 or table.c[0] is None
    is_single = len(rows) < 2 and table.order is None
    if is_single or (is_bare and are_whole((*rows, *(x.b for x in tableau.colours)))):
        words = f"{table.name} {table.around} {PurePath(table.source).name}"
        return METHODS.search(words) is not None or _SHORT.search(words) is not None
    are_near = all(abs(_sum(x.b) - 1) < FAR for x in tableau.colours)
    if table.order is not None:
        return are_near or table.c[0] is not None
    if table.colours > 1:
        return are_near
    block = tableau.block(0, 0)
    colour = tableau.colours[0]
    if block is None:
        return False
    off = abs(_sum(colour.b) - 1)
    if table.c[0] is None:
        products = [to_ball(x) * _sum(row) for x, row in zip(colour.b, block, strict=True)]
        has_order_two = abs(sum(products, arb(0)) - 0.5) < NEAR
        is_triangular = not any(any(row[i + 1 :]) for i, row in enumerate(block))
        return bool(off < NEAR) and len(block) > 1 and (is_triangular or bool(has_order_two))
    columns = tuple(zip(*block, strict=True))
    # whole numbers alone may be a linear system, whose zeros agree
    least = len(block) if are_whole((*block, colour.b)) else (len(block) + 1) // 2
    agreeing = max(_agreeing(block, colour.c), _agreeing(columns, colour.c))
    return bool(off < FAR) and agreeing >= least


def are_whole(rows: Iterable[Sequence[Number]]) -> bool:
    """Whether there are no fractions in some rows."""
    return all(isinstance(x, fmpq) and x.q == 1 for row in rows for x in row)


def _sum(row: Sequence[Number]) -> arb:
    return sum(map(to_ball, row), arb(0))


def _agreeing(rows: Sequence[Sequence[Number]], nodes: Sequence[Number]) -> int:
    """How many rows have a node for a sum."""
    count = 0
    for row, node in zip(rows, nodes, strict=True):
        count += bool(abs(_sum(row) - to_ball(node)) < NEAR)
    return count
