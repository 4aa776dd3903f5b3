"""Which methods are best: sorted by columns, and those that no other surpasses in all of them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

from garkcli.sweep.columns import Value, columns
from garkcli.sweep.plan import number
from garkcli.sweep.row import Row


def kept(rows: Iterable[Row]) -> list[Row]:
    """The rows of methods that fulfil all conditions."""
    return [row for row in rows if row["kept"] is True]


def distinct(rows: Iterable[Row]) -> list[Row]:
    """The first row of each method: several seeds may find the same."""
    found: dict[str, Row] = {}
    for row in rows:
        what = [row.get(name) for name in ("method", "parameters", "values")]
        known_by = json.dumps(what) if "values" in row else str(row["key"])
        found.setdefault(known_by, row)
    return list(found.values())


def best_first(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Rows sorted by columns, the first counting most; what has no value comes last, and equal
    ones are in the order of their keys.
    """
    return sorted(rows, key=lambda row: (*_badness(row, by), str(row["key"])))


def pareto_front(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """The rows with all values that no other row surpasses: at least as good in every column and
    better in one.
    """
    complete = [
        row for row in rows if all(row.get(name) is not None for name in by)
    ]
    front: list[tuple[Row, tuple[float, ...]]] = []
    # whatever surpasses a row comes before it in lexicographic order
    for row in best_first(complete, by):
        point = tuple(badness for _, badness in _badness(row, by))
        if not any(_surpasses(other, point) for _, other in front):
            front.append((row, point))
    return [row for row, _ in front]


def _surpasses(other: Sequence[float], point: Sequence[float]) -> bool:
    is_as_good = all(a <= b for a, b in zip(other, point, strict=True))
    return is_as_good and tuple(other) != tuple(point)


def _badness(row: Row, by: Sequence[str]) -> list[tuple[bool, float]]:
    """For each column whether its value is missing, and a number that is smaller for better."""
    found = []
    for name in by:
        value = row.get(name)
        assert not isinstance(value, dict)
        found.append((value is None, _size(name, value)))
    return found


def _size(name: str, value: Value) -> float:
    if value is None:
        return 0.0
    size = number(value)
    return -size if columns()[name].more_is_better else size
