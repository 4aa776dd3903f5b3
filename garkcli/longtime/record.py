"""Records sums, extremes and samples of a long trajectory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from math import ceil
from typing import TYPE_CHECKING, Any

from garkcli import numpy_on_use as np
from garkcli.longtime.history import BLOW_UP
from garkcli.longtime.measure import Measure
from garkcli.longtime.rounding import Exchange
from garkcli.longtime.trend import Trends
from garkcli.stepping.integrator import StepFailed

if TYPE_CHECKING:
    from garkcli.arrays import Floats, Integers


# times that a position has turned back when its motion is called bounded: what only passes by
# turns once
_BOUND = 2
# how many times its former bound a position is when it has left that
_FAR = 2.0


class Excursions:
    """Counts turns, and the extent of each position up to its last one. A position has escaped if
    it had turned back twice, and is now twice as far from zero as before it or its momentum turned
    for the last time. An angle that begins to rotate does not escape: its momentum goes on
    oscillating.
    """

    def __init__(self) -> None:
        self._shape_for(0)
        self._positions: Floats = np.zeros(0)  # at the end

    def _shape_for(self, d: int) -> None:
        # turns of each coordinate, and the step of the last turn of each pair (q, p)
        self._turned: Integers = np.zeros(2 * d, dtype=np.int64)
        self._last_turns: Integers = np.zeros(d, dtype=np.int64)
        self._bounds: Floats = np.zeros(d)  # largest |q| up to the last turn
        self._beyond: Floats = np.zeros(d)  # and after it

    @property
    def turns(self) -> int:
        return int(self._turned.max(initial=0))

    @property
    def escape(self) -> int | None:
        """The number of the last step before a position has escaped, the latest of all; or None."""
        was_bound = self._turned[: len(self._positions)] >= _BOUND
        is_far = abs(self._positions) > _FAR * self._bounds
        has_escaped = was_bound & is_far
        steps = self._last_turns[has_escaped]
        if not steps.size:
            return None
        return int(steps.max())

    def add(self, first: int, states: Floats) -> None:
        """Adds states from step ``first`` on, shape (m, 2d); pieces overlap in two states."""
        d = states.shape[1] // 2
        if not self._turned.size:
            self._shape_for(d)
        moves = np.diff(states, axis=0)
        is_move = np.abs(moves) > _MOVES * np.abs(states[1:])
        directions = np.sign(moves) * is_move
        products = directions[1:] * directions[:-1]
        turned = products < 0
        self._turned += turned.sum(axis=0)
        self._positions = states[-1, :d]
        sizes = np.abs(states[:, :d])
        either = turned[:, :d] | turned[:, d:]
        for i in range(d):
            turns = np.flatnonzero(either[:, i])
            self._add_position(i, first, sizes[:, i], turns)

    def _add_position(self, i: int, first: int, sizes: Floats, turns: Integers) -> None:
        """Adds |q| of position i with turns of it or its momentum, number n at the state n + 1."""
        beyond = self._beyond[i]
        if not turns.size:
            self._beyond[i] = max(beyond, sizes.max())
            return
        last = int(turns[-1]) + 1
        up_to_it = sizes[: last + 1]
        after_it = sizes[last:]
        self._bounds[i] = max(self._bounds[i], beyond, up_to_it.max())
        self._beyond[i] = after_it.max()
        self._last_turns[i] = first + last


COMPARED = 128
"""First steps whose errors are all kept."""
# how many times the energy the energy error is when the failure of a step is called a blow-up
_BLOWN = 1000
_CHUNK = 8192  # steps measured at a time
_TOO_LARGE = 1e150  # whose square is no float; sums of squares are kept
# part of its size that a coordinate moves in a step to have a direction, and of the largest number
# at the start that is a move
_MOVES = 2.0**-40
_PARTS = 4  # equal parts of a run at whose ends the state is kept


class RunRecord:
    """Sums and extremes of all errors, and samples of about ``points`` errors and of states.

    Attributes:
        first: the errors of the start and of ``COMPARED`` steps, shape (steps, invariants).
        states: at the start and after each quarter of the steps, by the number of the step.
        done: the last step measured.
        lost: by invariants, the first step without a value or with one too large to square; then
            nan.
    """

    def __init__(self, measure: Measure, count: int, points: int) -> None:
        signals = len(measure.names)
        self.measure = measure
        self.count = count
        self.trends = Trends(count, signals)
        self.largest: Floats = np.zeros(signals)
        self.first: Floats = np.zeros((0, signals))
        self.states: dict[int, tuple[Any, ...]] = {}
        self.done = -1
        self.blew_up = False
        self.has_moved = False
        self.lost: dict[int, int] = {}
        self._span = 1  # steps of which the extremes are kept
        if count >= points:
            self._span = ceil((count + 1) / max((points - 2) // (2 * signals), 1))
        self._wanted = {count * part // _PARTS for part in range(_PARTS + 1)}
        self._numbers: list[int] = []
        self._errors: list[Floats] = []
        self._start: Floats = np.zeros(0)
        self._last: Floats = np.zeros((0, 0))
        self.excursions = Excursions()
        self.exchange = Exchange()

    @property
    def kept_numbers(self) -> Integers:
        """The steps whose errors are kept: extremes of equal spans, and both ends."""
        return np.array(self._numbers)

    @property
    def kept_errors(self) -> Floats:
        return np.concatenate(self._errors)

    def take(self, path: Iterator[list[Any]]) -> None:
        """Measures states up to a blow-up; StepFailed if a step has failed without one."""
        chunk = self._span * max(1, _CHUNK // self._span)
        while self.done < self.count and not self.blew_up:
            states: list[list[Any]] = []
            try:
                for y in islice(path, chunk):
                    states.append(y)  # noqa: PERF402 -- what comes before a failure is wanted
            except StepFailed:
                self._add(states)
                if self.largest[0] > _BLOWN * self.measure.scale:
                    self.blew_up = True
                if not self.blew_up:
                    raise
                return
            self._add(states)

    def _add(self, states: Sequence[list[Any]]) -> None:
        if not states:
            return
        start = self.done + 1
        errors = self.measure.errors(states)
        # an invariant may have no value somewhere; an energy without one has passed all bounds
        has_passed = np.abs(errors[:, 0]) > BLOW_UP * self.measure.scale
        if self.measure.has_energy:
            has_passed |= np.isnan(errors[:, 0])
        outside = np.flatnonzero(has_passed)
        if outside.size:
            self.blew_up = True
            errors = errors[: outside[0]]
        count = len(errors)
        if not count:
            return
        self.lose(start, errors)
        if start == 0:
            self.first = errors[: COMPARED + 1].copy()
        known = np.nan_to_num(errors, nan=0.0)
        self.trends.add(start, known)
        np.maximum(self.largest, np.abs(known).max(axis=0), out=self.largest)
        self.done += count
        chosen = self._chosen(errors, start)
        self._numbers += [start + i for i in chosen]
        self._errors.append(errors[chosen])
        for number in self._wanted:
            if start <= number <= self.done:
                self.states[number] = tuple(states[number - start])
        self._watch(np.array(states[:count], dtype=np.float64))

    def lose(self, start: int, errors: Floats) -> None:
        """Notes invariants without a value from ``start`` on, whose errors become nan in place."""
        for k, own in enumerate(errors.T):
            missing = np.flatnonzero(~(np.abs(own) < _TOO_LARGE))
            if missing.size:
                number = start + int(missing[0])
                self.lost[k] = min(number, self.lost.get(k, number))
            if k in self.lost:
                own[max(0, self.lost[k] - start) :] = np.nan

    def _chosen(self, errors: Floats, start: int) -> list[int]:
        if self._span == 1:
            return list(range(len(errors)))
        chosen: set[int] = set()
        for number in (0, self.count):
            if start <= number <= self.done:
                chosen.add(number - start)
        spans = -(-len(errors) // self._span)  # rounded up
        for signal in np.nan_to_num(errors, nan=0.0).T:
            chosen.update(extremes(signal, 2 * spans).tolist())
        return sorted(chosen)

    def _watch(self, states: Floats) -> None:
        """Follows the motion; two states are carried over from piece to piece."""
        first = self.done - len(states) + 1
        if self._last.size:
            first -= len(self._last)
            states = np.concatenate([self._last, states])
        self._last = states[-2:]
        if self._start.size == 0:
            self._start = states[0]
        moves = np.abs(states - self._start).max()
        self.has_moved |= bool(moves > _MOVES * np.abs(self._start).max())
        if self.measure.has_energy:
            self.exchange.add(states)
        else:
            # unknowns without momenta turn back by themselves
            states = np.hstack([states, np.zeros_like(states)])
        self.excursions.add(first, states)


def extremes(errors: Floats, points: int) -> Integers:
    """Indices of the minimum and maximum of equal spans, so that plots keep the height of waves."""
    if len(errors) <= points:
        return np.arange(len(errors))
    spans = np.array_split(np.arange(len(errors)), points // 2)
    chosen: set[int] = set()
    for span in spans:
        values = errors[span]
        least = span[np.argmin(values)]
        greatest = span[np.argmax(values)]
        chosen.add(int(least))
        chosen.add(int(greatest))
    return np.array(sorted(chosen))
