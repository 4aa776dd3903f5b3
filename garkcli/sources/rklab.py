"""Block matrices [c A; q b; p d]: a table, its orders and its embedded weights in one matrix."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from garkcli.sources.found import MAX_STAGES
from garkcli.sources.values import ZERO, Array, Number, SourceRecord, Value, whole

TINY = 1e-9
"""Rounding of weights leaves their sum this near to 1."""
NEAR = 0.01
"""Sums that differ by less, relative to the largest entry of a row, are equal."""
_TABLEAU = re.compile("butcher|tableau|(?<!s)table")
"""Names of whole tableaus: ``rk_table``, but not ``a_stable``."""
FAR = 0.5
"""Largest distance of the sum of weights from 1, misprints included."""


def blocks_in(
    name: str, value: Value, title: str = ""
) -> Iterator[tuple[str, Mapping[str, Value]]]:
    """The names and roles of block matrices in a value, also under the keys of a dictionary, and
    beside their order. A matrix under a number is named after ``title``.
    """
    if isinstance(value, SourceRecord) and not value.kind:
        for key, x in value.fields.items():
            yield from blocks_in(f"{title or name} {key}" if key.isdigit() else key, x)
    elif isinstance(value, Array) and value.is_matrix:
        roles = _block_roles(value, name.lower())
        if roles is not None:
            yield name, roles
    elif isinstance(value, Array) and len(value.items) == 2 and whole(value.items[1]):
        for key, roles in blocks_in(name, value.items[0]):
            yield key, {**roles, "order": value.items[1]}


def _block_roles(value: Array, name: str) -> Mapping[str, Value] | None:
    """The roles of the parts of a block matrix; None for other matrices.

    q and p, beside the weights, are the orders in RKLab's B; elsewhere they may be the node 1, or q
    twice. Without a name all rows except one must sum to their nodes.
    """
    rows = [list(x.items) for x in value.items if isinstance(x, Array)]
    columns = max(map(len, rows))
    stages = columns - 1
    if not 0 < stages <= MAX_STAGES or len(rows) - stages not in (1, 2):
        return None
    corners = [row[0] if row else ZERO for row in rows[stages:]]
    for i, row in enumerate(rows):
        if len(row) < columns and (i >= stages or len(row) <= i):
            return None
        # a triangle, or the full square
        row += [ZERO] * (columns - len(row))
    numbers = [*rows[:stages], *(row[1:] for row in rows[stages:])]
    if not all(isinstance(x, Number) for row in numbers for x in row):
        return None
    near = [[x.near if isinstance(x, Number) else 0.0 for x in row] for row in rows]
    agreeing = sum(abs(sum(row[1:]) - row[0]) <= NEAR * max(map(abs, row)) for row in near[:stages])
    # rows of zeros agree with any nodes
    zeros = sum(not any(row) for row in near[:stages])
    off = abs(sum(near[stages][1:]) - 1)
    order = whole(corners[0])
    is_tableau = _TABLEAU.search(name) is not None
    is_named = is_tableau or (name.startswith("b") and order is not None and order > 0)
    # with an order and several weights of sum 1 the nodes need not be row sums
    has_fractions = any(not x.is_integer() for row in near for x in row)
    is_ordered = name == "b" and is_named and off < TINY and stages > 1 and has_fractions
    # integers alone may be anything
    is_near = agreeing - zeros >= (stages - zeros) / (1 + has_fractions)
    is_block = is_ordered or (off < FAR and is_near)
    is_explicit = not any(x for i, row in enumerate(near[:stages]) for x in row[i + 1 :])
    is_plain = off < NEAR and agreeing >= max(2, stages - is_explicit)
    # only the weights may be wrong if all rows are those of an explicit method
    is_plain |= off < FAR and is_explicit and agreeing == stages > 2
    is_plain &= has_fractions
    if not (is_block if is_named else is_plain and any(row[0] for row in near[:stages])):
        # an ordinary matrix
        return None
    roles: dict[str, Value] = {
        "A": Array([Array(row[1:]) for row in rows[:stages]]),
        "b": Array(rows[stages][1:]),
        "c": Array([row[0] for row in rows[:stages]]),
    }
    if order and (name == "b" or order > 1):
        roles["order"] = corners[0]
    if len(rows) == stages + 2 and (whole(corners[1]) or any(near[-1][1:])):
        roles["embedded"] = Array(rows[-1][1:])
        if "order" in roles and whole(corners[1]) not in (0, None if name == "b" else order):
            roles["embedded_order"] = corners[1]
    return roles
