"""Optima along a curve: an objective for bounds on another one, the front, or values of an unknown.

Each place of the curve is a bound or a value. There the optimiser starts from the optima of random
starts, and then from the optima of the neighbours, until none improves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.crew.work import Workers, in_order
from garkcli.design.minimise.objective import LevelObjective, Single, WeightedSum
from garkcli.design.search.goals import objective_on
from garkcli.design.search.optimum import Optimum
from garkcli.design.search.points import Fixed
from garkcli.design.search.rational import RationalFunction, as_float
from garkcli.design.search.run import Batch, Ending, Start, Timed, are_same
from garkcli.design.search.search import Search
from garkcli.errors import UsageProblem
from garkcli.frozen import Frozen, Mutable, field

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array
    from garkcli.design.search.run import SearchTask

PLACES = 17
SEEDS = 4
"""Optima of random starts of each objective from which a place begins."""
PASSES = 12
GAIN = 1e-5
"""Relative size of an improvement of an objective."""
ALIKE = 1e-8
"""Numbers with a smaller relative difference are equal up to rounding."""
WIDE = 20.0
"""The bounds of a front are in geometric progression if its ends differ by a larger factor."""
INSIDE = 1e-3
"""The last bound is inside the front by this part: at its end there are only single points."""


class Knot(Frozen):
    """A point of a curve: ``across`` may be the value of an unknown, ``up`` is an objective."""

    across: float
    up: float
    point: tuple[float, ...]


class OptimaCurve(Mutable):
    """Optima along a curve, as far as known, in ascending order of ``across``.

    Attributes:
        across, up: the names of both axes, both objectives for a front.
        starts, successes: the starts so far, and how many solve the conditions.
        seconds: of the processor.
        ending: the reason why the search ended early.
    """

    across: str
    up: str
    is_front: bool
    order: int
    seed: int
    knots: list[Knot] = field(default_factory=list)
    starts: int = 0
    successes: int = 0
    seconds: float = 0.0
    ending: Ending | None = None


class CurvePlace(Frozen):
    """A task: the best method at a place of a curve, or None.

    The optimiser starts from ``points``; ``objective`` is by default that of the search. ``cap`` is
    another one and its bound, ``value`` an unknown and its value.
    """

    points: tuple[Start, ...]
    objective: str | None = None
    cap: tuple[str, float] | None = None
    value: tuple[str, str] | None = None

    def result(self, search: Search) -> object:
        wanted = self.objective or search.text
        assert wanted is not None
        cap = None if self.cap is None else (_single(self.cap[0], search), self.cap[1])
        program = search.program.aimed(objective_on(wanted, search.tableau), cap)
        fixed = []
        if self.value is not None:
            name, text = self.value
            ring = search.family.ring
            fixed = [Fixed(RationalFunction(ring.parameter(name), ring), fmpq(*_parts(text)))]
        moved = [program.moved(point, fixed) for point in self.points]
        return min((x for x in moved if x is not None), key=lambda x: x.value, default=None)


def _parts(text: str) -> list[int]:
    return [int(part) for part in text.split("/")]


def _single(text: str, search: Search) -> Single:
    """An objective that may be bounded; UsageProblem for a sum."""
    objective = objective_on(text, search.tableau)
    if isinstance(objective, WeightedSum):
        message = f"--front takes two single objectives, and {text} is a sum"
        raise UsageProblem(message, "--minimise takes sums", code="option-value")
    return objective


def front(
    search: Search, second: str, starts: int, seed: int, workers: Workers[SearchTask, Timed]
) -> Iterator[OptimaCurve]:
    """The front of two objectives; yields one curve object again and again as it improves. Raises
    UsageProblem if an objective is a sum or not applicable.
    """
    assert search.text is not None
    one, other = _single(search.text, search), _single(second, search)
    run = _CurveRun(
        search, OptimaCurve(_axis(one), _axis(other), True, search.order, seed), workers
    )
    programs = [search.program, search.program.aimed(other)]
    yield from run.seek(starts, seed, [None, second])
    if not all(run.seeds):
        return

    def knot(x: Optimum) -> Knot:
        values = [program.total.value(_array(x)) for program in programs]
        return Knot(_shown(one, values[0]), _shown(other, values[1]), x.point)

    ends = [programs[1].total.value(_array(run.seeds[k][0])) for k in (0, 1)]
    ends[1] += INSIDE * (ends[0] - ends[1])
    bounds = _between(ends[0], ends[1])
    places = [CurvePlace((), cap=(second, _shown(other, bound))) for bound in bounds]
    every = [x for seeds in run.seeds for x in seeds]
    for optima in run.passes(places, [every] * len(places)):
        knots = [knot(x) for x in (*optima, run.seeds[0][0], run.seeds[1][0]) if x is not None]
        signs = [-1 if isinstance(x, LevelObjective) else 1 for x in (one, other)]
        run.curve.knots = list(_best(knots, *signs))
        yield run.curve


def along(
    search: Search, name: str, starts: int, seed: int, workers: Workers[SearchTask, Timed]
) -> Iterator[OptimaCurve]:
    """The optimum for each value of an unknown in its range; yields as ``front``. Raises
    UsageProblem if there is no such unknown, it has no range with two ends, or the objective is not
    applicable.
    """
    assert search.objective is not None
    least, greatest = _range(search, name)
    values = [least + (greatest - least) * fmpq(k, PLACES - 1) for k in range(PLACES)]
    up = _axis(search.objective)
    run = _CurveRun(search, OptimaCurve(name, up, False, search.order, seed), workers)
    yield from run.seek(starts, seed, [None])
    place_of = search.family.ring.names.index(name)
    places = [CurvePlace((), value=(name, str(value))) for value in values]
    seeds = [_nearest(run.seeds[0], place_of, as_float(value)) for value in values]
    for optima in run.passes(places, seeds):
        run.curve.knots = [
            Knot(as_float(value), _shown(search.objective, x.value), x.point)
            for value, x in zip(values, optima, strict=True)
            if x is not None
        ]
        yield run.curve


def _nearest(optima: Sequence[Optimum], place: int, value: float) -> list[Optimum]:
    return sorted(optima, key=lambda x: abs(x.point[place] - value))[:SEEDS]


def _range(search: Search, name: str) -> tuple[fmpq, fmpq]:
    names = search.family.parameters
    if name not in names:
        message = f"--along: no unknown {name!r}"
        raise UsageProblem(message, f"one of {', '.join(names)}", code="option-value")
    least, greatest = search.family.ranges.get(name, (None, None))
    if least is None or greatest is None:
        message = f"--along: {name} has no range with two ends"
        cure = f"write range: {{{name}: [1/4, 1]}} under design"
        raise UsageProblem(message, cure, code="option-value")
    return least, greatest


def _axis(objective: Single | WeightedSum) -> str:
    return objective.key if isinstance(objective, WeightedSum) else objective.key.removeprefix("-")


def _shown(objective: Single | WeightedSum, value: float) -> float:
    return -value + 0.0 if isinstance(objective, LevelObjective) else value


def _array(x: Optimum) -> Array:
    import numpy as np

    return np.array(x.point)


def _between(start: float, end: float) -> list[float]:
    shares = [k / (PLACES - 1) for k in range(PLACES)]
    if start * end > 0 and max(start / end, end / start) > WIDE:
        return [start * (end / start) ** share for share in shares]
    return [start + (end - start) * share for share in shares]


def _best(knots: Sequence[Knot], across: int, up: int) -> Iterator[Knot]:
    """The knots that no other one beats in both; a sign is −1 if larger values are better."""
    ranked = sorted(knots, key=lambda x: (across * x.across, up * x.up))
    least = float("inf")
    chosen: list[Knot] = []
    for knot in ranked:
        if up * knot.up < least - ALIKE * abs(least if chosen else 0.0):
            least = up * knot.up
            chosen.append(knot)
    yield from sorted(chosen, key=lambda x: x.across)


class _CurveRun:
    def __init__(
        self, search: Search, curve: OptimaCurve, workers: Workers[SearchTask, Timed]
    ) -> None:
        self.search = search
        self.curve = curve
        self.workers = workers
        self.seeds: list[list[Optimum]] = []

    def _done(self, tasks: Sequence[SearchTask]) -> Iterator[object]:
        for timed in in_order(self.workers, tasks):
            self.curve.seconds += timed.seconds
            yield timed.result

    def seek(
        self, starts: int, seed: int, objectives: Sequence[str | None]
    ) -> Iterator[OptimaCurve]:
        every = list(self.search.starts(seed, starts))
        size = max(1, min(self.search.batch, -(-starts // self.workers.size)))
        batches = [Batch(every[k : k + size]) for k in range(0, starts, size)]
        solutions: list[Start] = []
        for batch, found in zip(batches, self._done(batches), strict=True):
            assert isinstance(found, list)
            self.curve.starts += len(batch.starts)
            self.curve.successes += len(found)
            for _, point in found:
                if not any(are_same(point, other) for other in solutions):
                    solutions.append(point)
            yield self.curve
        for objective in objectives:
            tasks = [CurvePlace((point,), objective) for point in solutions]
            optima = [x for x in self._done(tasks) if isinstance(x, Optimum)]
            self.seeds.append(_distinct(sorted(optima, key=lambda x: x.value)))
            yield self.curve

    def passes(
        self, places: Sequence[CurvePlace], seeds: Sequence[Sequence[Optimum]]
    ) -> Iterator[list[Optimum | None]]:
        best: list[Optimum | None] = [None] * len(places)
        tried = [[x.point for x in some] for some in seeds]
        for _ in range(PASSES):
            which = [k for k, points in enumerate(tried) if points]
            tasks = [
                CurvePlace(tuple(map(list, tried[k])), cap=places[k].cap, value=places[k].value)
                for k in which
            ]
            changed = []
            for k, found in zip(which, self._done(tasks), strict=True):
                before = best[k]
                if isinstance(found, Optimum) and (before is None or found.is_less(before, GAIN)):
                    best[k] = found
                    changed.append(k)
            yield best
            if not changed:
                break
            tried = [
                [best[j].point for j in (k - 1, k + 1) if j in changed]  # type: ignore[union-attr]
                for k in range(len(places))
            ]


def _distinct(optima: Sequence[Optimum]) -> list[Optimum]:
    chosen: list[Optimum] = []
    for x in optima:
        if not any(are_same(x.point, other.point) for other in chosen):
            chosen.append(x)
        if len(chosen) == SEEDS:
            break
    return chosen
