"""Arrays of single numbers: a21, c2, b1, btilde1."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from garkcli.sources.naming import role_of
from garkcli.sources.values import (
    FILL,
    ZERO,
    Array,
    Number,
    Value,
    computed,
    exact,
    is_matrix,
    is_written,
    items_of,
    near,
)

_NAME = re.compile(r"(?P<stem>[^\W\d_]+[̂̃]?)_?\d{1,4}(?:_\d{1,2})?")
_LETTERS = {*"aAbcdewαβγ", "aa", "alpha", "beta", "gamma", "bhat", "b̂", "bh", "bt", "btilde"}
ARRAYS = {
    x: f"{x}[]" for x in ("A", "A1", "b", "c", "c1", "embedded", "error", "A_q", "b_q", "delta")
}
"""Roles of arrays of coefficients, marked to distinguish them from single ones."""
NEAR = 1e-4
"""Numbers that differ by less are equal."""
_BESIDE = {"a": ("b", "c"), "A": ("b", "c"), "b": ("c", "a"), "α": ("β", "c")}
"""The letters of weights and nodes, by the letter with two indices."""


def family_of(name: str) -> str:
    """The letter or the role of a name like those of coefficients; empty for others."""
    plain = name.rpartition("::")[2].lstrip("_")
    match = _NAME.fullmatch(plain)
    if match is not None and match["stem"] in _LETTERS:
        return match["stem"]
    return ARRAYS.get((role_of(plain) or ("", ""))[1], "")


def whole_families(arrays: Mapping[str, Value]) -> dict[str, Value]:
    """Arrays of single numbers under the names A, b and c: missing weights are zeros, missing nodes
    are row sums, and a missing entry of the second row is its node.
    """
    families = dict(arrays)
    for name, value in arrays.items():
        owner, mark, letter = name.rpartition("::")
        head = f"{owner}{mark}"
        is_beside = letter != "a" and is_matrix(arrays.get(f"{head}a"))
        if letter not in _BESIDE or not is_matrix(value) or is_beside:
            continue
        rows = [list(items_of(row)) for row in value.items]
        own = {x.removeprefix(head): y for x, y in arrays.items() if x.rpartition("::")[0] == owner}
        weights, nodes = _BESIDE[letter]
        if letter == "A":
            weights, nodes = (x if x in own else x.upper() for x in (weights, nodes))
        if weights not in own and {"w", "d"} <= set(own):
            weights, nodes = "w", "d"
        b, c = (own.pop(x, None) for x in (weights, nodes))
        for x in (letter, weights, nodes):
            families.pop(f"{head}{x}", None)
        if isinstance(c, Array) and not is_matrix(c):
            # c1 may be the node of the second stage
            ways = [_filled(x, len(rows)) for x in (c.items, [FILL, *c.items])]
            entries = max(ways, key=lambda way: _agreeing(way, rows))
            if not any(map(is_written, rows[1])):
                rows[1][0] = entries[1]
            pairs = zip(entries, rows, strict=False)
            families[f"{head}c"] = Array([x if is_written(x) else _sum(row) for x, row in pairs])
        families[f"{head}A"] = Array([*map(Array, rows)])
        for role, row in {**own, "b": b}.items():
            if isinstance(row, Array) and not is_matrix(row):
                families[f"{head}{role}"] = Array(_filled(row.items, len(rows)))
    return families


def _filled(row: Sequence[Value], count: int) -> list[Value]:
    return [*row, *[FILL] * (count - len(row))]


def _agreeing(nodes: Sequence[Value], rows: Sequence[Sequence[Value]]) -> int:
    """The number of written nodes that are the sums of their rows."""
    pairs = zip(nodes, rows, strict=False)
    return sum(is_written(c) and abs(near(*row) - near(c)) < NEAR for c, row in pairs)


def _sum(row: Sequence[Value]) -> Value:
    """A sum in place of a node, with all its digits."""
    total: Value = ZERO
    for x in row:
        total = computed("+", total, x, 0)
    return exact(total.value) if isinstance(total, Number) and total.value is not None else total
