"""A whole search: starts in batches, proofs as solutions come, and the methods as text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import islice
from math import floor, log10
from time import process_time
from typing import Literal, Protocol, TypeAlias

from flint import arb

from garkcli.crew.work import Alone, Workers, in_order
from garkcli.deadline import within
from garkcli.design.choices import DIGITS, values_text
from garkcli.design.member import Whose
from garkcli.design.minimise.objective import LevelObjective, Single, WeightedSum
from garkcli.design.search.optimum import Optimum
from garkcli.design.search.points import small_bits
from garkcli.design.search.rational import in_decimals
from garkcli.design.search.search import BITS, DECIMALS, Find, Proof, Search
from garkcli.design.solutions import value_at
from garkcli.errors import MethodError, NotDecided, counted
from garkcli.exact.field import Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, Mutable, field
from garkcli.tableau.family import Family

RESIDUAL = f"1e-{floor(log10(2) * small_bits(BITS))}"
"""A bound on residuals, which are rounding and may differ between machines."""
TOLERANCE = "1e-30"


class FoundMethod(Frozen):
    """A method that was found.

    Attributes:
        start: the number of the start that led to it, from 1.
        order: its exact order if known; otherwise the order of the solved conditions.
        values: the parameters, exact or as decimals.
        residual: a bound on all residuals up to the order; "0" if they vanish.
        objective: a decimal or ``infinity``; None without an objective.
        embedded: the order of the embedded weights; None if the file wants none.
    """

    start: int
    proof: Proof
    order: int
    values: Mapping[str, str]
    residual: str
    objective: str | None = None
    embedded: int | None = None

    @property
    def is_exact(self) -> bool:
        return self.proof == "exact"


def _exact(values: dict[str, Number], root: RealRoot) -> dict[str, str]:
    try:
        return values_text(values, root)
    except MethodError:
        # none of them generates the field of all, so each is a root of its own polynomial
        return {name: _root_text(value, root) for name, value in values.items()}


def _root_text(value: Number, root: RealRoot) -> str:
    number = value_at(value, root)
    simple = root_text(number)
    if simple is not None:
        return simple
    polynomial = polynomial_text(Polynomial.from_flint(number.polynomial), "x")
    near = root_decimal(number, DIGITS)
    return f"root_of({polynomial}, {near})".replace("^", "**")


def decimals(number: arb, count: int = DECIMALS) -> str:
    rounded = in_decimals(number, count)
    digits = f"{abs(rounded):0{count + 1}d}"
    sign = "-" if rounded < 0 else ""
    return f"{sign}{digits[:-count]}.{digits[-count:]}"


Start: TypeAlias = list[float]
Ending: TypeAlias = Literal["interrupt", "time", "worker"]
FIRST = 64
"""Starts of the first batch, small for a quick first find; later batches double, for speed."""
TOGETHER = 4
"""Starts from which an objective is minimised before the best of all is proved."""
SAME = 1e-6
"""Solutions that differ by at most this in each unknown are one solution."""


class SearchResult(Mutable):
    """The state of a search.

    Attributes:
        starts: the number of starts so far.
        successes: the number of them that solve the conditions in floats.
        degenerate: the number of distinct solutions without a solution of more digits near by, or
            outside the wanted ranges, signs and stability at the end.
        unstable: the number of those whose wanted stability is not proved.
        methods: distinct ones, in the order of the starts; with an objective the best first.
        seconds: of the processor.
        ending: the reason why the search ended before its last start; None otherwise.
        order: the wanted order.
        whose: the order of the method, its conjugate, or its pair.
        seed: of the starts.
        objective: to minimise, if any.
    """

    starts: int = 0
    successes: int = 0
    degenerate: int = 0
    unstable: int = 0
    methods: list[FoundMethod] = field(default_factory=list)
    seconds: float = 0.0
    ending: Ending | None = None
    order: int = 0
    whose: Whose = "method"
    seed: int = 0
    objective: Single | WeightedSum | None = None

    @property
    def is_interrupted(self) -> bool:
        """Whether the search ended before its last start."""
        return self.ending is not None

    def __repr__(self) -> str:
        methods = counted(len(self.methods), "method")
        return f"<SearchResult {methods} of {counted(self.starts, 'start')}>"


class Timed(Frozen):
    result: object
    seconds: float


class Batch(Frozen):
    starts: list[Start]

    def result(self, search: Search) -> object:
        return search.solve(self.starts)


class SolutionTask(Frozen):
    """A task: the method of a solution in floats, or None; False if its stability is not proved."""

    start: int
    point: Start

    def result(self, search: Search) -> object:
        return _method(search, search.find(self.start, self.point))


class Descent(Frozen):
    """A task: the best method near a solution in floats; None if there is none."""

    start: int
    point: Start

    def result(self, search: Search) -> object:
        return search.program.improved(self.point)


class Best(Frozen):
    """A task: the method of an optimum in floats; None or False as in ``SolutionTask``."""

    start: int
    optimum: Optimum

    def result(self, search: Search) -> object:
        return _method(search, search.best(self.start, self.optimum))


def _method(search: Search, find: Find | None) -> object:
    """A find as text; None if there is none, False if its stability is not proved."""
    if find is None or not find.is_stable:
        return None if find is None else False
    if find.found is not None:
        solution = find.found.solution
        exact = {name: solution.values[name] for name in search.family.parameters}
        values = _exact(exact, solution.real[0])
    else:
        values = {name: decimals(find.digits[name]) for name in search.family.parameters}
    residual = "0" if find.found is not None else RESIDUAL
    objective = None if search.objective is None else search.value(find)
    embedded = search.embedded_order(find)
    return FoundMethod(find.start, find.proof, find.order, values, residual, objective, embedded)


class SearchTask(Protocol):
    def result(self, search: Search) -> object: ...


def do(search: Search, task: SearchTask) -> Timed:
    before = process_time()
    return Timed(task.result(search), process_time() - before)


MOST = 5


def search_methods(
    family: Family,
    order: int,
    starts: int = 100,
    seed: int = 0,
    most: int = MOST,
    whose: Whose = "method",
    seconds: float | None = None,
    objective: str | None = None,
    first: Start | None = None,
) -> SearchResult:
    """Search a family for methods of an order, from random starts.

    One seed gives the same finds on every machine. Successes beyond ``most`` are counted; after
    ``seconds`` the search ends with its finds. ``first`` replaces the first start. Raises
    ZeroWeight if a weight is zero for every value, so there is no conjugate.
    """
    result = SearchResult(order=order, whose=whose, seed=seed)
    try:
        with within(seconds):
            search = Search(family, order, whose, objective)
            for state in results(search, starts, seed, most, first=first):
                result = state
    except NotDecided:
        result.ending = "time"
    return result


def results(
    search: Search,
    starts: int,
    seed: int = 0,
    most: int = MOST,
    workers: Workers[SearchTask, Timed] | None = None,
    first: Start | None = None,
) -> Iterator[SearchResult]:
    """Searches from random starts; yields one result object again and again as it grows. The finds
    do not depend on the workers.
    """
    workers = workers or Alone(partial(do, search))
    if search.objective is not None:
        search.program  # noqa: B018 -- refuses an objective that is not applicable at once
    coming = search.starts(seed, starts, first)
    run = _Run(search, workers, most, seed)
    size = FIRST
    while True:
        together = workers.size
        size = max(1, min(size, search.batch, -(-starts // together)))
        group = list(islice(coming, size * together))
        if not group:
            yield from run.rest()
            return
        yield from run.take(group, size)
        size *= 2


class _Run:
    def __init__(
        self, search: Search, workers: Workers[SearchTask, Timed], most: int, seed: int
    ) -> None:
        self.search = search
        self.workers = workers
        self.most = most
        self.result = SearchResult(
            order=search.order, whose=search.whose, seed=seed, objective=search.objective
        )
        self._seen: list[Start] = []
        self._texts: set[tuple[str, ...]] = set()
        self._waiting: list[Descent] = []
        self._optima: list[Best] = []
        self._known: dict[int, FoundMethod | None] = {}

    def take(self, group: Sequence[Start], size: int) -> Iterator[SearchResult]:
        """Takes starts, ``size`` for each task, and proves the new solutions."""
        parts = range(0, len(group), size)
        batches = [Batch(list(group[k : k + size])) for k in parts]
        first = self.result.starts + 1
        new: list[SolutionTask] = []
        for place, timed in zip(parts, self._done(batches), strict=True):
            self.result.starts = min(first + place + size, first + len(group)) - 1
            assert isinstance(timed.result, list)
            for k, point in timed.result:
                self.result.successes += 1
                if self._is_new(point):
                    new.append(SolutionTask(first + place + k, point))
            yield self.result
        if self.search.objective is not None:
            yield from self._descend(new)
            return
        while new and len(self.result.methods) < self.most:
            together = self.workers.size
            now, new = new[:together], new[together:]
            for timed in self._done(now):
                self._keep(timed.result)
            yield self.result

    def _descend(self, new: Sequence[SolutionTask]) -> Iterator[SearchResult]:
        """Finds the best methods near some solutions, and proves those that are the best of all.
        With ``TOGETHER`` solutions at a time proofs do not depend on the number of processes.
        """
        self._waiting += [Descent(solution.start, solution.point) for solution in new]
        while len(self._waiting) >= TOGETHER:
            some, self._waiting = self._waiting[:TOGETHER], self._waiting[TOGETHER:]
            yield self._descended(some)

    def rest(self) -> Iterator[SearchResult]:
        if self._waiting:
            yield self._descended(self._waiting)

    def _descended(self, tasks: Sequence[Descent]) -> SearchResult:
        for task, timed in zip(tasks, self._done(tasks), strict=True):
            optimum = timed.result
            if not isinstance(optimum, Optimum):
                self.result.degenerate += 1
            elif not any(are_same(optimum.point, x.optimum.point) for x in self._optima):
                self._optima.append(Best(task.start, optimum))
        self._optima.sort(key=lambda best: (best.optimum.grade, best.start))
        self._prove()
        return self.result

    def _prove(self) -> None:
        # until the wanted number of methods is reached
        while unproved := [x for x in self._chosen() if x.start not in self._known]:
            for best, timed in zip(unproved, self._done(unproved), strict=True):
                made = timed.result
                self._known[best.start] = made if isinstance(made, FoundMethod) else None
                self.result.unstable += made is False
                self.result.degenerate += made is None
        methods = [x for best in self._chosen() if (x := self._known[best.start]) is not None]
        is_level = isinstance(self.search.objective, LevelObjective)
        self.result.methods = sorted(
            methods, key=lambda x: float(x.objective or 0), reverse=is_level
        )

    def _chosen(self) -> list[Best]:
        """The best optima that give methods, as far as known, without repeated methods."""
        chosen: list[Best] = []
        texts: set[tuple[str, ...]] = set()
        for best in self._optima:
            made = self._known.get(best.start)
            if made is not None and tuple(made.values.values()) in texts:
                continue
            if made is not None:
                texts.add(tuple(made.values.values()))
            if made is not None or best.start not in self._known:
                chosen.append(best)
            if len(chosen) == self.most:
                break
        return chosen

    def _done(self, tasks: Sequence[SearchTask]) -> Iterator[Timed]:
        for timed in in_order(self.workers, tasks):
            self.result.seconds += timed.seconds
            yield timed

    def _is_new(self, point: Start) -> bool:
        if self.search.objective is None and len(self.result.methods) >= self.most:
            return False
        if any(are_same(point, other) for other in self._seen):
            return False
        self._seen.append(point)
        return True

    def _keep(self, found: object) -> None:
        if len(self.result.methods) >= self.most:
            return
        if found is False:
            self.result.unstable += 1
            return
        if not isinstance(found, FoundMethod):
            self.result.degenerate += 1
            return
        texts = tuple(found.values.values())
        if texts not in self._texts:
            self._texts.add(texts)
            self.result.methods.append(found)


def are_same(one: Sequence[float], other: Sequence[float]) -> bool:
    return all(abs(a - b) <= SAME for a, b in zip(one, other, strict=True))
