"""Tasks of the optimiser of a search: minimise a sum of goals, or first meet all wants."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from garkcli import numpy_on_use as np
from garkcli.design.search.descent import OptimiserTask, TaskValues
from garkcli.design.search.goals import Bound, Goal, Reach, Smooth, kept

if TYPE_CHECKING:
    from garkcli.design.search.chart import Gradient
    from garkcli.design.search.rational import Array

FEASIBLE = 1e-9
"""Inequalities hold up to this in floats."""
HIGHEST = 1e4
FIRST_LEVEL = 0.5
"""Least level at which the optimiser starts: at 0 nothing depends on the unknowns."""
LEAST_LEVEL = 1e-3
LOW_LEVEL = 0.01
"""The level of methods from which the optimiser starts."""
BISECTIONS = 36


class Height:
    """The level of a method: the largest y, by bisection, up to which inequalities hold."""

    def __init__(self, reach: Reach) -> None:
        self.at = reach.at
        self.margin = reach.margin
        self.of = kept(self._of)

    def _holds(self, x: Array, y: float) -> bool:
        try:
            values, _ = self.at(np.append(x, y))
        except np.linalg.LinAlgError:
            return False
        return bool(np.min(values) >= -FEASIBLE)

    def _of(self, x: Array) -> float:
        low, high = 0.0, FIRST_LEVEL
        while high > LEAST_LEVEL and not self._holds(x, high):
            high /= 8
        while self._holds(x, high):
            if high >= HIGHEST:
                return HIGHEST
            low, high = high, min(1.25 * high, HIGHEST)
        if not low:
            return 0.0
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if self._holds(x, middle) else (low, middle)
        return low


def capped(goal: Goal, bound: float, margin: float = 0.0) -> Callable[[Array], Gradient]:
    """Inequalities for a goal of at most a bound, or a level of at least it, with a margin."""
    unit = abs(bound) or 1.0

    def at(x: Array) -> Gradient:
        if isinstance(goal, Reach):
            values, slopes = goal.at(np.append(x, bound))
            return values - margin, slopes[:, :-1]
        if isinstance(goal, Smooth):
            value, gradient = goal.at(x)
            return np.array([(bound - value) / unit]), -gradient[None] / unit
        values, slopes = goal.at(x)
        return (
            np.concatenate([bound - values, bound + values]) / unit,
            np.concatenate([-slopes, slopes]) / unit,
        )

    return at


class Total:
    """A sum of goals with weights, negative for levels, under the inequalities ``within``."""

    def __init__(
        self, terms: Sequence[tuple[float, Goal]], within: Callable[[Array], Gradient]
    ) -> None:
        self.smooth = [(w, goal) for w, goal in terms if isinstance(goal, Smooth)]
        self.bounds = [(w, goal) for w, goal in terms if isinstance(goal, Bound)]
        levels = [(k, w, Height(x)) for k, (w, x) in enumerate(terms) if isinstance(x, Reach)]
        self.levels = [(w, level) for _, w, level in levels]
        self.at_places = {k: level for k, _, level in levels}
        self.within = within

    def value(self, x: Array) -> float:
        total = sum(w * goal.at(x)[0] for w, goal in self.smooth)
        total += sum(w * _largest(goal.at(x)[0]) for w, goal in self.bounds)
        return float(total + sum(w * level.of(x) for w, level in self.levels))

    def has_levels(self, x: Array) -> bool:
        return all(level.of(x) for _, level in self.levels)

    def parts(self, x: Array) -> Gradient | None:
        """The squared terms, if all smooth goals are sums of squares."""
        terms = [(w, goal.parts(x)) for w, goal in self.smooth if goal.parts is not None]
        if not terms or len(terms) < len(self.smooth):
            return None
        return (
            np.concatenate([w**0.5 * e for w, (e, _) in terms]),
            np.concatenate([w**0.5 * slopes for w, (_, slopes) in terms]),
        )


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))


def missed(signs: Array) -> float:
    """The distance of numbers from being nonnegative."""
    return max(0.0, -float(np.min(signs, initial=0.0)))


class Least(OptimiserTask):
    """Minimises a sum of goals; each bound and each level has its own variable. Bounds are in units
    of their values at the first point.
    """

    def __init__(self, total: Total, start: Array) -> None:
        self._total = total
        self._units = [_largest(goal.at(start)[0]) or 1.0 for _, goal in total.bounds]
        self.levels = len(total.bounds) + len(total.levels)
        if self.levels == len(total.levels) and not total.smooth:
            self.enough = -HIGHEST

    def value(self, x: Array) -> float:
        return self._total.value(x)

    def guess(self, x: Array) -> Array:
        bounds = zip(self._units, self._total.bounds, strict=True)
        sizes = [_largest(goal.at(x)[0]) / unit for unit, (_, goal) in bounds]
        return np.array([*sizes, *(max(y.of(x), FIRST_LEVEL) for _, y in self._total.levels)])

    def parts(self, x: Array) -> Gradient | None:
        return self._total.parts(x)

    def scale(self, x: Array) -> float:
        # a level needs no scale
        is_alone = self.levels and not self._total.smooth and not self._total.bounds
        return 1.0 if is_alone else super().scale(x)

    def at(self, z: Array) -> TaskValues:
        total, n = self._total, len(z) - self.levels
        x, gradient = z[:n], np.zeros(len(z))
        inequalities = [total.within(x)]
        value = total_of_unknowns = 0.0
        for weight, goal in total.smooth:
            y, slope = goal.at(x)
            value += weight * y
            total_of_unknowns += weight * y
            gradient[:n] += weight * slope
        for k, (unit, (weight, bound)) in enumerate(zip(self._units, total.bounds, strict=True), n):
            sizes, slopes = bound.at(x)
            value += weight * unit * z[k]
            total_of_unknowns += weight * _largest(sizes)
            gradient[k] = weight * unit
            for sign in (-1.0, 1.0):
                more = np.zeros((len(sizes), len(z)))
                more[:, :n], more[:, k] = sign * slopes / unit, 1.0
                inequalities.append((z[k] + sign * sizes / unit, more))
        for k, (weight, level) in enumerate(total.levels, n + len(total.bounds)):
            values, slopes = level.at(np.append(x, z[k]))
            value += weight * z[k]
            total_of_unknowns += weight * z[k]
            gradient[k] = weight
            more = np.zeros((len(values), len(z)))
            more[:, :n], more[:, k] = slopes[:, :-1], slopes[:, -1]
            inequalities.append((values - level.margin, more))
        signs = np.concatenate([values for values, _ in inequalities])
        of_signs = np.concatenate([padded(slopes, len(z)) for _, slopes in inequalities])
        # sizes are known without their variables
        sure = [
            values for values, _ in (inequalities[0], *inequalities[1 + 2 * len(self._units) :])
        ]
        is_met = missed(np.concatenate(sure)) <= FEASIBLE
        return TaskValues(value, gradient, signs, of_signs, total_of_unknowns if is_met else np.inf)


class Missing(OptimiserTask):
    """Minimises the least y with which all inequalities hold, for low levels too."""

    levels = 1
    enough = FEASIBLE / 2

    def __init__(self, total: Total) -> None:
        self._total = total

    def _signs(self, x: Array) -> Gradient:
        inequalities = [self._total.within(x)]
        for _, level in self._total.levels:
            values, slopes = level.at(np.append(x, LOW_LEVEL))
            inequalities.append((values, slopes[:, :-1]))
        return np.concatenate([x for x, _ in inequalities]), np.concatenate(
            [x for _, x in inequalities]
        )

    def value(self, x: Array) -> float:
        return missed(self._signs(x)[0])

    def guess(self, x: Array) -> Array:
        return np.array([self.value(x)])

    def scale(self, _x: Array) -> float:
        # y should become 0
        return 1.0

    def at(self, z: Array) -> TaskValues:
        values, slopes = self._signs(z[:-1])
        gradient = np.append(np.zeros(len(z) - 1), 1.0)
        slopes = np.concatenate([slopes, np.ones((len(slopes), 1))], 1)
        return TaskValues(float(z[-1]), gradient, values + z[-1], slopes, missed(values))


def padded(slopes: Array, size: int) -> Array:
    return np.pad(slopes, ((0, 0), (0, size - slopes.shape[1])))
