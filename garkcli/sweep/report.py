"""The results of a sweep: the rows, the best of them sorted by columns, and the Pareto front."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from garkcli.errors import counted
from garkcli.frozen import Frozen
from garkcli.sweep.columns import columns
from garkcli.sweep.plan import Plan, number
from garkcli.sweep.row import Row
from garkcli.upward import Shown

_Point = list[float]
"""One number for each column; smaller is better."""


def kept(rows: Iterable[Row]) -> list[Row]:
    return [row for row in rows if row["kept"] is True]


def distinct(rows: Iterable[Row]) -> list[Row]:
    """Returns the first row of each method: several seeds may find the same one."""
    by_method: dict[str, Row] = {}
    for row in rows:
        known_by = str(row["key"])
        if "values" in row:  # it was searched for
            known_by = json.dumps([row.get(x) for x in ("method", "parameters", "values")])
        by_method.setdefault(known_by, row)
    return list(by_method.values())


def best_first(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Returns rows sorted by columns, missing values last, ties by key."""

    def place(row: Row) -> tuple[object, ...]:
        return (*_badness(row, by), str(row["key"]))

    return sorted(rows, key=place)


def pareto_front(rows: Sequence[Row], by: Sequence[str]) -> list[Row]:
    """Returns the complete rows that no other row dominates."""
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
    """Returns for each column whether the value is missing, and its badness."""
    numbers = []
    for name in by:
        value = row.get(name)
        assert not isinstance(value, dict)
        size = 0.0 if value is None else number(value)
        numbers.append((value is None, -size if columns()[name].more_is_better else size))
    return numbers


class SweepReport(Shown, Frozen):
    """The results of a sweep.

    Attributes:
        source: the spec file.
        plan: the sweep.
        rows: all rows.
        top: how many of the best are shown in texts.
    """

    source: str
    plan: Plan
    rows: Mapping[str, Row]
    top: int

    @property
    def done(self) -> list[Row]:
        keys = (point.key for point in self.plan.points())
        return [self.rows[key] for key in keys if key in self.rows]

    @cached_property
    def kept(self) -> list[Row]:
        return distinct(kept(self.done))

    @property
    def repeated(self) -> int:
        """The number of kept rows whose method occurs in another row."""
        return len(kept(self.done)) - len(self.kept)

    @property
    def best(self) -> list[Row]:
        rows = self.kept
        return best_first(rows, self.plan.best) if self.plan.best else rows

    @property
    def front(self) -> list[Row]:
        return pareto_front(self.kept, self.plan.pareto)

    @property
    def failed(self) -> list[Row]:
        """The rows of methods that could not be made."""
        return [row for row in self.done if "failure" in row]

    def __repr__(self) -> str:
        return f"<SweepReport {self.source}: {counted(len(self.done), 'row')}>"
