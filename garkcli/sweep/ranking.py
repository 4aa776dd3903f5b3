"""The best methods: sorted by columns, and those on the Pareto front."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

from garkcli.sweep.columns import columns
from garkcli.sweep.plan import number
from garkcli.sweep.row import Row

_Point = list[float]
"""One number for each column; smaller is better."""


def kept(rows: Iterable[Row]) -> list[Row]:
    """Returns the rows that fulfil all conditions."""
    return [row for row in rows if row["kept"] is True]


def distinct(rows: Iterable[Row]) -> list[Row]:
    """Returns the first row of each method: several seeds may find the same one."""
    found: dict[str, Row] = {}
    for row in rows:
        known_by = str(row["key"])
        if "values" in row:  # it was searched for
            known_by = json.dumps([row.get(x) for x in ("method", "parameters", "values")])
        found.setdefault(known_by, row)
    return list(found.values())


def best_first(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Returns rows sorted by columns, the first counting most. Missing values come last; ties are
    sorted by key.
    """

    def place(row: Row) -> tuple[object, ...]:
        return (*_badness(row, by), str(row["key"]))

    return sorted(rows, key=place)


def pareto_front(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Returns the rows with all values for which no other row is at least as good in every column
    and better in one.
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
    """Returns for each column whether the value is missing, and a number that is smaller for better
    values.
    """
    found = []
    for name in by:
        value = row.get(name)
        assert not isinstance(value, dict)
        size = 0.0 if value is None else number(value)
        found.append((value is None, -size if columns()[name].more_is_better else size))
    return found
