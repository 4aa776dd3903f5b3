"""The results of a sweep: the rows, the best of them, and the Pareto front."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from garkcli.errors import counted
from garkcli.frozen import Frozen
from garkcli.sweep.plan import Plan
from garkcli.sweep.ranking import best_first, distinct, kept, pareto_front
from garkcli.sweep.row import Row
from garkcli.upward import Shown


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
        """The rows of the sweep, in its order."""
        keys = (point.key for point in self.plan.points())
        return [self.rows[key] for key in keys if key in self.rows]

    @cached_property
    def kept(self) -> list[Row]:
        """The kept rows, one for each method."""
        return distinct(kept(self.done))

    @property
    def repeated(self) -> int:
        """The number of kept rows whose method occurs in another row."""
        return len(kept(self.done)) - len(self.kept)

    @property
    def best(self) -> list[Row]:
        """The kept rows, the best first."""
        found = self.kept
        return best_first(found, self.plan.best) if self.plan.best else found

    @property
    def front(self) -> list[Row]:
        """The Pareto front."""
        return pareto_front(self.kept, self.plan.pareto)

    @property
    def failed(self) -> list[Row]:
        """The rows of methods that could not be made."""
        return [row for row in self.done if "failure" in row]

    def __repr__(self) -> str:
        return f"<SweepReport {self.source}: {counted(len(self.done), 'row')}>"
