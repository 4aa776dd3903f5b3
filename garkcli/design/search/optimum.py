"""The best method near a solution, by sequential quadratic programming; then short numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.design.member import not_negative
from garkcli.design.minimise import objective as aims
from garkcli.design.search import goals
from garkcli.design.search.descent import descended
from garkcli.design.search.least_squares import least_squares
from garkcli.design.search.one_point import Functions
from garkcli.design.search.points import Fixed, Fixings, rank
from garkcli.design.search.rational import (
    RationalFunction,
    as_float,
    polynomial_functions,
    with_gradients,
)
from garkcli.design.search.residuals import Residuals
from garkcli.design.search.tasks import FEASIBLE, Least, Missing, Total, capped
from garkcli.errors import UsageProblem
from garkcli.frozen import Frozen
from garkcli.tableau.family import Family

if TYPE_CHECKING:
    from garkcli.design.search.chart import Equations, Gradient
    from garkcli.design.search.rational import Array

ROUNDING = 1e-17
"""Sums of squares below this may be zero."""
LARGEST = 20.0
MARGIN = 1e-6
CLOSE = 1e-12
SLACK = 1e-7
"""Relative cost of short numbers in the objective."""
LITTLE = 1e-6
"""Relative gain in the objective for a restart of the optimiser."""
REPEATED = 30
DENOMINATORS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 16, 20, 24, 25, 30, 40, 50, 100, 200, 500)
FINE = tuple(10**k for k in range(3, 13))
"""Denominators tried if no short one works."""


class Optimum(Frozen):
    """A method in floats at a local minimum of an objective, which is minus a level."""

    value: float
    point: tuple[float, ...]

    @property
    def grade(self) -> float:
        """The objective to seven digits, so that values equal up to rounding are equal."""
        return float(f"{self.value:.6e}")

    def is_less(self, other: Optimum, part: float = 0.0) -> bool:
        """Whether the objective is less than at another method by more than a part of it."""
        return self.value < other.value - part * abs(other.value)


class Optimisation:
    """Minimises an objective over the methods of a family with an order. Raises UsageProblem if
    SciPy is not installed, or the objective is not applicable.
    """

    def __init__(
        self, family: Family, conditions: Residuals, objective: aims.Single | aims.WeightedSum
    ) -> None:
        import numpy as np

        try:
            import scipy.optimize  # noqa: F401 -- it may be missing
        except ImportError:
            message = "--search with --minimise needs SciPy"
            cure = 'type pip install "garkcli[design]", or in a checkout pip install ".[design]"'
            raise UsageProblem(message, cure, code="missing-package") from None
        ring = family.ring
        order = conditions.table.max_order
        self.conditions = conditions
        # the conditions of the next order are the error
        wide = Residuals(conditions.tableau, ring, order + 1, conditions.relations)
        self._trees = goals.TreeConditions(wide)
        trees, last = len(wide.table), wide.table.ids(order + 1)
        self._own = np.r_[0 : last.start, trees : len(wide)]
        subject = aims.ObjectiveSubject.of(family, conditions.tableau, order, family.further)
        self._setting = goals.Setting(subject, ring, self._trees)
        self._caps: tuple[Equations, ...] = tuple(
            capped(
                goals.goal_of(level, self._setting),
                level.inside(as_float(bound)),
                aims.INSIDE / 10 if level.key == "-ssp" else 0.0,
            )
            for level, bound in goals.levels_of(family)
        )
        self._aim(objective)
        positive = polynomial_functions(family.positive, ring)
        self._signs = Functions(
            [*positive, *polynomial_functions(not_negative(family), ring)], len(ring.names)
        )
        self._margin = np.zeros(self._signs.shape[0])
        self._margin[: len(positive)] = MARGIN
        self.stable = [
            goals.AStable(family.tested(wanted), wanted.colour, order)
            for wanted in family.stable
            if wanted.kind in ("a-stable", "l-stable")
        ]

    def _aim(self, objective: aims.Single | aims.WeightedSum) -> None:
        terms = goals.terms_of(objective, self.conditions.tableau)
        weighted = [(as_float(w), goals.goal_of(x, self._setting)) for w, x in terms]
        self.total = Total(weighted, self.within)
        is_count = isinstance(objective, aims.SearchMeasure) and objective.key == "nonzero"
        setting = self._setting
        self._entries = goals.entries_of(setting.tableau, setting.ring) if is_count else []
        # measures are no squares
        self._rounding = ROUNDING**0.5 if isinstance(objective, aims.SearchMeasure) else ROUNDING

    def aimed(
        self,
        objective: aims.Single | aims.WeightedSum,
        cap: tuple[aims.Single, float] | None = None,
    ) -> Optimisation:
        """The minimisation of another objective, with a ``cap`` on one, from below for levels."""
        other = copy(self)
        if cap is not None:
            one, bound = cap
            other._caps = (*self._caps, capped(goals.goal_of(one, self._setting), bound))
        other._aim(objective)
        return other

    def equations(self, fixed: Sequence[Fixed] = ()) -> Equations:
        """The conditions, and those of given values, as functions of one point."""
        import numpy as np

        functions = Functions([one.function for one in fixed], self.conditions.unknowns)
        values_wanted = np.array([as_float(one.value) for one in fixed])

        def at(x: Array) -> Gradient:
            values, slopes = self._trees.at(x)
            values, slopes = values[self._own], slopes[self._own]
            if not fixed:
                return values, slopes
            of_fixed, of_found = functions.at(x)
            return np.concatenate([values, of_fixed - values_wanted]), np.concatenate(
                [slopes, of_found]
            )

        return at

    def signs(self, x: Array) -> Gradient:
        """The inequalities without those of the optimised level: values and derivatives."""
        import numpy as np

        signs, slopes = self._signs.at(x)
        values, derivatives = [signs - self._margin], [slopes]
        for at in (*(one.at for one in self.stable), *self._caps):
            signs, slopes = at(x)
            values.append(signs)
            derivatives.append(slopes)
        return np.concatenate(values), np.concatenate(derivatives)

    def improved(self, start: Sequence[float], fixed: Sequence[Fixed] = ()) -> Optimum | None:
        """The best method near a solution ``start``; None if no method near it meets the wants."""
        import numpy as np

        with np.errstate(all="ignore"):
            x, equations = np.array(start), self.equations(fixed)
            best = self.evaluated(x, fixed)
            if best is None or not self.total.has_levels(x):
                near = descended(Missing(self.total), equations, x)
                best = self.evaluated(near, fixed) or best
            if best is None:
                return None
            x = np.array(best.point)
            if self._entries:
                return self._emptied(best)
            end = descended(Least(self.total, x), equations, x)
            return self.evaluated(end, fixed) or best

    def settled(self, best: Optimum) -> Optimum:
        """An optimum from which a restart of the optimiser gains nothing."""
        for _ in range(REPEATED):
            check_time()
            improved = self.improved(best.point)
            if improved is None or not improved.is_less(best, LITTLE):
                break
            best = improved
        return best

    def _emptied(self, best: Optimum) -> Optimum:
        """A method nearby with as many zero coefficients as possible, the smallest ones first."""
        zeros = self._zeros(best)
        found: Optimum | None = best
        while found is not None:
            best, tried = found, self._by_size(best)
            found = None
            for function in tried:
                check_time()
                extended = [*zeros, Fixed(function, fmpq(0))]
                found = self.moved(best.point, extended)
                if found is not None and found.value < best.value:
                    zeros = self._zeros(found)
                    break
                found = None
        return best

    def _by_size(self, at: Optimum) -> list[RationalFunction]:
        """The nonzero coefficients, in ascending order of size."""
        import numpy as np

        values = with_gradients(self._entries, np.array(at.point)[:, None])[0][:, 0]
        pairs = zip(np.abs(values), self._entries, strict=True)
        return [f for x, f in sorted(pairs, key=lambda pair: pair[0]) if x > goals.NOTHING]

    def _zeros(self, at: Optimum) -> list[Fixed]:
        # keeps zero coefficients zero
        others = self._by_size(at)
        return [Fixed(f, fmpq(0)) for f in self._entries if f not in others]

    def within(self, x: Array) -> Gradient:
        import numpy as np

        values, slopes = self.signs(x)
        one = np.eye(len(x))
        return (
            np.concatenate([values, LARGEST - x, LARGEST + x]),
            np.concatenate([slopes, -one, one]),
        )

    def evaluated(self, x: Array, fixed: Sequence[Fixed] = ()) -> Optimum | None:
        """A point corrected to a method, with its objective; None if there is no method there."""
        import numpy as np

        system = Fixings(self.conditions, fixed)
        if not np.all(np.isfinite(x)):
            return None
        if np.max(np.abs(self.equations(fixed)(x)[0]), initial=0.0) > CLOSE:
            minima = least_squares(system.at, x[:, None], 40, CLOSE)
            if not minima.succeeded[0]:
                return None
            x = minima.points[:, 0]
        values, _ = self.signs(x)
        if np.min(values, initial=0.0) < -FEASIBLE:
            return None
        value = self.total.value(x)
        return Optimum(value, tuple(map(float, x))) if np.isfinite(value) else None

    def level(self, place: int, x: Array) -> float:
        return self.total.at_places[place].of(x)

    def is_none(self, optimum: Optimum) -> bool:
        return 0 <= optimum.value < self._rounding

    def shortened(
        self, best: Optimum, wanted: Sequence[RationalFunction]
    ) -> tuple[Fixings, Optimum]:
        """Gives short values to as many functions as the solutions leave free, at little cost."""
        import numpy as np

        fixed = self._zeros(best)
        present = best
        bound = self._rounding if self.is_none(best) else best.value + SLACK * abs(best.value)
        settled = self._rank(fixed, present)
        for function in wanted:
            if settled == len(best.point):
                break
            if self._rank([*fixed, Fixed(function, fmpq(0))], present) == settled:
                continue
            now = with_gradients([function], np.array(present.point)[:, None])[0]
            for value in _near(float(now[0, 0])):
                check_time()
                extended = [*fixed, Fixed(function, value)]
                moved = self.moved(present.point, extended)
                if moved is None or moved.value > bound:
                    continue
                if self._rank(extended, moved) > settled:
                    fixed, present, settled = extended, moved, self._rank(extended, moved)
                    if not self.is_none(best):
                        bound = min(bound, moved.value + SLACK * abs(moved.value))
                    break
        return Fixings(self.conditions, fixed), present

    def _rank(self, fixed: Sequence[Fixed], at: Optimum) -> int:
        import numpy as np

        _, jacobian = self.equations(fixed)(np.array(at.point))
        return len(rank(jacobian))

    def moved(self, near: Sequence[float], fixed: Sequence[Fixed] = ()) -> Optimum | None:
        import numpy as np

        system = Fixings(self.conditions, fixed)
        minima = least_squares(system.at, np.array(near)[:, None], 60, CLOSE)
        if not minima.succeeded[0]:
            return None
        if self._entries:
            with np.errstate(all="ignore"):
                return self.evaluated(minima.points[:, 0], fixed)
        return self.improved([float(x) for x in minima.points[:, 0]], fixed)


def _near(present: float) -> Iterator[fmpq]:
    """Distinct rational numbers near a number, the shorter first."""
    yielded = set()
    for q in (*DENOMINATORS, *FINE):
        value = fmpq(round(present * q), q)
        if abs(as_float(value) - present) < 0.02 and value not in yielded:
            yielded.add(value)
            yield value
