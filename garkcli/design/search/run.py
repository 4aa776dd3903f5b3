"""A whole search: starts in batches, what is found proved as it comes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from time import process_time
from typing import Protocol, TypeAlias

from garkcli.design.design import Whose
from garkcli.design.search.search import Search
from garkcli.design.search.told import Method, told
from garkcli.tableau.family import Family

Start: TypeAlias = list[float]
FIRST = 64
"""Starts of the first batch, so that something is found soon; batches grow twofold, for speed."""
SAME = 1e-6
"""Solutions no further apart in any unknown are one solution."""


@dataclass
class Result:
    """What a search has found so far.

    Attributes:
        starts: how many have been tried.
        successes: how many of them solve the conditions in floats.
        degenerate: how many of the different solutions that were looked into are no methods:
            no solution with more digits is near.
        methods: each once, in the order of the starts.
        seconds: of the processor.
        is_interrupted: whether there were more starts.
    """

    starts: int = 0
    successes: int = 0
    degenerate: int = 0
    methods: list[Method] = field(default_factory=list)
    seconds: float = 0.0
    is_interrupted: bool = False


@dataclass(frozen=True)
class Timed:
    """The result of some work and the seconds of the processor that it took."""

    result: object
    seconds: float


class Crew(Protocol):
    """Who does the work: this process, or several."""

    size: int

    def solve(self, batches: Sequence[list[Start]]) -> list[Timed]:
        """``Search.solve`` of each batch."""

    def prove(self, solutions: Sequence[tuple[int, Start]]) -> list[Timed]:
        """The method that each solution makes, or None."""


class Alone:
    """The work done in this process, one thing after the other."""

    size = 1

    def __init__(self, search: Search) -> None:
        self.search = search

    def solve(self, batches: Sequence[list[Start]]) -> list[Timed]:
        """``Search.solve`` of each batch."""
        return [solve(self.search, batch) for batch in batches]

    def prove(self, solutions: Sequence[tuple[int, Start]]) -> list[Timed]:
        """The method that each solution makes, or None."""
        return [prove(self.search, one) for one in solutions]


def solve(search: Search, batch: list[Start]) -> Timed:
    """The solutions that the starts of a batch lead to, with the time."""
    before = process_time()
    solved = search.solve(batch)
    return Timed(solved, process_time() - before)


def prove(search: Search, solution: tuple[int, Start]) -> Timed:
    """The method that a solution makes, with the time."""
    before = process_time()
    find = search.find(*solution)
    made = None if find is None else told(find, search.family.parameters)
    return Timed(made, process_time() - before)


MOST = 5
"""Methods that are looked for where nothing is said."""


def search_methods(
    family: Family,
    order: int,
    starts: int = 100,
    seed: int = 0,
    most: int = MOST,
    whose: Whose = "method",
) -> Result:
    """Search a family for methods of an order, from random starts.

    Args:
        family: of methods.
        order: that is wanted.
        starts: how many.
        seed: of the starts; the same seed has the same finds everywhere.
        most: methods that are looked for at most; other successes are counted.
        whose: order is meant: of the method, its symplectic conjugate or its pair.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
    """
    result = Result()
    for found in results(Search(family, order, whose), starts, seed, most):
        result = found
    return result


def results(
    search: Search,
    starts: int,
    seed: int = 0,
    most: int = MOST,
    crew: Crew | None = None,
) -> Iterator[Result]:
    """Search from random starts; the same object again and again, with more and more in it.

    Args:
        search: what is looked for.
        starts: how many.
        seed: of the starts.
        most: methods that are looked for at most; other successes are counted.
        crew: who does the work.
    """
    crew = crew or Alone(search)
    run = _Run(search, crew, most)
    coming = search.starts(seed, starts)
    largest = max(1, min(search.batch, -(-starts // crew.size)))
    size = min(FIRST, largest)
    while group := list(islice(coming, size * crew.size)):
        batches = [group[k : k + size] for k in range(0, len(group), size)]
        solved = crew.solve(batches)
        first = run.result.starts
        run.result.starts += len(group)
        yield from run.take(solved, first, size)
        size = min(2 * size, largest)


class _Run:
    """What is known in the middle of a search."""

    def __init__(self, search: Search, crew: Crew, most: int) -> None:
        self.search = search
        self.crew = crew
        self.most = most
        self.result = Result()
        self._seen: list[Start] = []
        self._texts: set[tuple[str, ...]] = set()

    def take(
        self, solved: Sequence[Timed], first: int, size: int
    ) -> Iterator[Result]:
        """The solutions of some batches: those that are new are proved."""
        new: list[tuple[int, Start]] = []
        for number, timed in enumerate(solved):
            self.result.seconds += timed.seconds
            assert isinstance(timed.result, list)
            for k, point in timed.result:
                self.result.successes += 1
                if self._is_new(point):
                    new.append((first + number * size + k + 1, point))
        yield self.result
        while new and len(self.result.methods) < self.most:
            now, new = new[: self.crew.size], new[self.crew.size :]
            for timed in self.crew.prove(now):
                self.result.seconds += timed.seconds
                self._keep(timed.result)
            yield self.result

    def _is_new(self, point: Start) -> bool:
        if len(self.result.methods) >= self.most:
            return False
        for other in self._seen:
            if all(
                abs(a - b) <= SAME for a, b in zip(point, other, strict=True)
            ):
                return False
        self._seen.append(point)
        return True

    def _keep(self, found: object) -> None:
        if len(self.result.methods) >= self.most:
            return
        if not isinstance(found, Method):
            self.result.degenerate += 1
            return
        texts = tuple(found.values.values())
        if texts not in self._texts:
            self._texts.add(texts)
            self.result.methods.append(found)
