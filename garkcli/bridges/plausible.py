"""Whether arrays called A and b are a method: other matrices have these names, too."""

from __future__ import annotations

import operator
import re
from collections.abc import Iterable, Sequence
from pathlib import PurePath

from flint import arb, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.sources import naming
from garkcli.sources.found import FoundTable

_SHORT = re.compile("euler|midpoint|implicit|trapez|crank", re.IGNORECASE)
NEAR = 0.01
"""Sums that differ by less count as equal; those of rows relative to the largest entry."""
TINY = 1e-9
"""Conditions with smaller residuals count as held."""
FAR = 0.5
"""Largest distance of the sum of weights from 1, misprints included."""


def is_plausible(table: FoundTable, method: MethodFile) -> bool:
    """Whether a table is a method, by its source or its numbers. A matrix of zeros has no nodes;
    integers with one stage or without nodes need words.

    If no reading decides, as with several misprints, the sum of the weights must be near 1, and the
    nodes the row sums of half of the rows; without nodes order 2 must nearly hold, or the matrix be
    triangular.
    """
    tableau = method.tableau
    rows = [row for block in tableau.blocks.values() for row in block]
    if len(rows) > 1 and not any(map(any, rows)) and table.c[0] is not None:
        # f at several times, and always at y: no steps of one method
        return not any(map(any, (x.c for x in tableau.colours)))
    if table.is_sure or table.linked:
        return True
    is_bare = len(rows) < 2 or table.c[0] is None
    is_single = len(rows) < 2 and table.order is None
    if is_single or (is_bare and _are_whole((*rows, *(x.b for x in tableau.colours)))):
        return speaks(table)
    has_nodes, is_declared = table.c[0] is not None, table.order is not None
    limit = FAR if has_nodes or is_declared else NEAR
    is_near = all(bool(abs(_sum(x.b) - 1) < limit) for x in tableau.colours)
    if is_declared:
        return is_near or has_nodes
    if table.colours > 1 or not is_near:
        return is_near
    colour = tableau.colours[0]
    if not has_nodes:
        is_lower = not any(any(row[i + 1 :]) for i, row in enumerate(rows))
        moment = _sum(map(operator.mul, colour.b, colour.c)) - 0.5
        return len(rows) > 1 and (is_lower or bool(abs(moment) < NEAR))
    pairs = zip(rows, colour.c, strict=True)
    agreeing = sum(_agree(row, c) for row, c in pairs)
    by_nodes, by_rows = (
        abs(_sum(map(operator.mul, colour.b, x)) - 0.5) for x in (colour.c, map(_sum, rows))
    )
    is_quadrature = by_nodes < TINY and abs(_sum(colour.b) - 1) < TINY
    if speaks(table) and is_quadrature and by_rows > NEAR:
        # only the matrix is wrong
        return not _are_whole((*rows, colour.b))
    # integers alone may be a linear system, whose zeros agree
    return agreeing >= (len(rows) if _are_whole((*rows, colour.b)) else len(rows) / 2)


def speaks(table: FoundTable) -> bool:
    words = f"{table.name} {table.around} {PurePath(table.source).name}"
    return naming.speaks(words) or _SHORT.search(words) is not None


def _are_whole(rows: Iterable[Sequence[Number]]) -> bool:
    return all(isinstance(x, fmpq) and x.q == 1 for row in rows for x in row)


def _agree(row: Sequence[Number], node: Number) -> bool:
    # tiny numbers, such as covariances, are near any others
    largest = max(map(abs, map(to_ball, (*row, node))))
    return bool(abs(_sum(row) - to_ball(node)) <= NEAR * largest)


def _sum(row: Iterable[Number]) -> arb:
    return sum(map(to_ball, row), arb(0))
