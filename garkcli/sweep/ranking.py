"""Which methods are best: sorted by columns, and those that no other surpasses in all of them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

from garkcli.sweep.columns import columns
from garkcli.sweep.plan import number
from garkcli.sweep.row import Row

_Point = list[float]
"""A number a column, smaller for better."""


def kept(rows: Iterable[Row]) -> list[Row]:
    """The rows of methods that fulfil all conditions."""
    return [row for row in rows if row["kept"] is True]


def distinct(rows: Iterable[Row]) -> list[Row]:
    """The first row of each method: several seeds may find the same."""
    found: dict[str, Row] = {}
    for row in rows:
        known_by = str(row["key"])
        if "values" in row:  # it was searched for
            known_by = json.dumps([row.get(x) for x in ("method", "parameters", "values")])
        found.setdefault(known_by, row)
    return list(found.values())


def best_first(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Rows sorted by columns, the first counting most; what has no value comes last, and equal
    ones are in the order of their keys.
    """

    def place(row: Row) -> tuple[object, ...]:
        return (*_badness(row, by), str(row["key"]))

    return sorted(rows, key=place)


def pareto_front(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """The rows with all values that no other row surpasses: at least as good in every column and
    better in one.
    """
    complete = [row for row in rows if all(row.get(name) is not None for name in by)]
    front: list[Row] = []
    points: list[_Point] = []
    # whatever surpasses a row comes before it in lexicographic order
    for row in best_first(complete, by):
        point = [badness for _, badness in _badness(row, by)]
        as_good = (x for x in points if all(a <= b for a, b in zip(x, point, strict=True)))
        if all(x == point for x in as_good):
            front.append(row)
            points.append(point)
    return front


def _badness(row: Row, by: Sequence[str]) -> list[tuple[bool, float]]:
    """For each column whether its value is missing, and a number that is smaller for better."""
    found = []
    for name in by:
        value = row.get(name)
        assert not isinstance(value, dict)
        size = 0.0 if value is None else number(value)
        found.append((value is None, -size if columns()[name].more_is_better else size))
    return found
