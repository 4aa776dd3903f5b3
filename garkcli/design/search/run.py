"""A whole search: starts in batches, what is found proved as it comes, and written as text of
method files: what reports and files need of it, without exact numbers.
"""

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
from garkcli.design.minimise.objective import Level, Single, Sum
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
"""What all residuals are below after the last step of Newton's method. The residuals themselves are
rounding, and no two machines need to agree on them.
"""
TOLERANCE = "1e-30"
"""What a file with so many decimals is meant up to."""


class Method(Frozen):
    """A method that was found.

    Attributes:
        start: the number of the start that led to it, from 1.
        proof: what is known of it.
        order: its exact order where that is known; else that of the conditions that were solved.
        values: of the parameters, exact or decimals.
        residual: a bound on all residuals up to the order; "0" where they vanish.
        objective: what was minimised, at the method, as a decimal or ``infinity``; None where
            nothing was.
        embedded: the order of the embedded weights: the exact one, or that of the conditions that
            were solved; None if the file wants none.
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
        """Whether the values are exact and the order proved."""
        return self.proof == "exact"


def _exact(values: dict[str, Number], root: RealRoot) -> dict[str, str]:
    try:
        return values_text(values, root)
    except MethodError:
        # none of them generates the field of all: each by a polynomial of its own
        return {name: _alone(value, root) for name, value in values.items()}


def _alone(value: Number, root: RealRoot) -> str:
    number = value_at(value, root)
    simple = root_text(number)
    if simple is not None:
        return simple
    polynomial = polynomial_text(Polynomial.from_flint(number.polynomial), "x")
    near = root_decimal(number, DIGITS)
    return f"root_of({polynomial}, {near})".replace("^", "**")


def decimals(number: arb, count: int = DECIMALS) -> str:
    """The nearest decimal number with ``count`` decimals.

    >>> decimals(arb("0.25"), 3)
    '0.250'
    """
    rounded = in_decimals(number, count)
    digits = f"{abs(rounded):0{count + 1}d}"
    sign = "-" if rounded < 0 else ""
    return f"{sign}{digits[:-count]}.{digits[-count:]}"


Start: TypeAlias = list[float]
Ending: TypeAlias = Literal["interrupt", "time", "worker"]
FIRST = 64
"""Starts of the first batch, so that something is found soon; batches grow twofold, for speed."""
TOGETHER = 4
"""Starts from which an objective is minimised before the best of all is proved."""
SAME = 1e-6
"""Solutions no further apart in any unknown are one solution."""


class Result(Mutable):
    """What a search has found so far.

    Attributes:
        starts: how many have been tried.
        successes: how many of them solve the conditions in floats.
        degenerate: how many of the different solutions that were searched are no methods:
            no solution with more digits is near, or the optimiser, which an objective needs, ends
            outside the ranges, signs and stability that are wanted.
        unstable: how many of them are not shown to be as stable as the file wants.
        methods: each once, in the order of the starts; where an objective is minimised the best
            first.
        seconds: of the processor.
        ending: what ended the search before its last start; None where nothing did.
        order: that was wanted.
        whose: order that is.
        seed: of the starts.
        objective: that is minimised, if one is.
    """

    starts: int = 0
    successes: int = 0
    degenerate: int = 0
    unstable: int = 0
    methods: list[Method] = field(default_factory=list)
    seconds: float = 0.0
    ending: Ending | None = None
    order: int = 0
    whose: Whose = "method"
    seed: int = 0
    objective: Single | Sum | None = None

    @property
    def is_interrupted(self) -> bool:
        """Whether there were more starts."""
        return self.ending is not None

    def __repr__(self) -> str:
        methods = counted(len(self.methods), "method")
        return f"<Result {methods} of {counted(self.starts, 'start')}>"


class Timed(Frozen):
    """The result of some work and the seconds of the processor that it took."""

    result: object
    seconds: float


class Batch(Frozen):
    """Work: the solutions that some starts lead to, as ``Search.solve`` has them."""

    starts: list[Start]

    def result(self, search: Search) -> object:
        """The outcome of the work."""
        return search.solve(self.starts)


class Solution(Frozen):
    """Work: the method that a solution in floats makes; None where it makes none, False where that
    is not shown to be as stable as is wanted.

    Attributes:
        start: the number of the start that led to it.
        point: values of the unknowns.
    """

    start: int
    point: Start

    def result(self, search: Search) -> object:
        """The outcome of the work."""
        return _method(search, search.find(self.start, self.point))


class Descent(Frozen):
    """Work: the best method near a solution in floats; None where there is none.

    Attributes:
        start: the number of the start that led to it.
        point: values of the unknowns.
    """

    start: int
    point: Start

    def result(self, search: Search) -> object:
        """The outcome of the work."""
        return search.program.improved(self.point)


class Best(Frozen):
    """Work: the method that an optimum in floats makes; as ``Solution``.

    Attributes:
        start: the number of the start that led to it.
        optimum: the point and its value.
    """

    start: int
    optimum: Optimum

    def result(self, search: Search) -> object:
        """The outcome of the work."""
        return _method(search, search.best(self.start, self.optimum))


def _method(search: Search, find: Find | None) -> object:
    """A find as text; None where there is none, False where it is not shown to be as stable as is
    wanted.
    """
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
    return Method(find.start, find.proof, find.order, values, residual, objective, embedded)


class Task(Protocol):
    """A piece of a search."""

    def result(self, search: Search) -> object:
        """The outcome of the work."""
        ...


def do(search: Search, task: Task) -> Timed:
    """Do a piece of a search, with the time that it takes."""
    before = process_time()
    return Timed(task.result(search), process_time() - before)


MOST = 5
"""Methods that are sought where nothing is said."""


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
) -> Result:
    """Search a family for methods of an order, from random starts.

    Args:
        family: of methods.
        order: that is wanted.
        starts: how many.
        seed: of the starts; the same seed has the same finds everywhere.
        most: the most methods to look for; other successes are counted.
        whose: order is meant: of the method, its symplectic conjugate or its pair.
        seconds: after which the search ends with what was found; None for never.
        objective: that is minimised from each start, a name or a sum of names; None for none.
        first: values of the unknowns that take the place of the first start.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
    """
    result = Result(order=order, whose=whose, seed=seed)
    try:
        with within(seconds):
            search = Search(family, order, whose, objective)
            for found in results(search, starts, seed, most, first=first):
                result = found
    except NotDecided:
        result.ending = "time"
    return result


def results(
    search: Search,
    starts: int,
    seed: int = 0,
    most: int = MOST,
    workers: Workers[Task, Timed] | None = None,
    first: Start | None = None,
) -> Iterator[Result]:
    """Search from random starts; the same object again and again, with more and more in it.

    Args:
        search: what is sought.
        starts: how many.
        seed: of the starts.
        most: the most methods to look for; other successes are counted.
        workers: who does the work; what is found does not depend on that.
        first: values of the unknowns that take the place of the first start.
    """
    workers = workers or Alone(partial(do, search))
    if search.objective is not None:
        search.program  # noqa: B018 -- an objective without meaning is refused at once
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
    """What is known in the middle of a search."""

    def __init__(self, search: Search, workers: Workers[Task, Timed], most: int, seed: int) -> None:
        self.search = search
        self.workers = workers
        self.most = most
        self.result = Result(
            order=search.order, whose=search.whose, seed=seed, objective=search.objective
        )
        self._seen: list[Start] = []
        self._texts: set[tuple[str, ...]] = set()
        self._waiting: list[Descent] = []
        self._optima: list[Best] = []
        self._known: dict[int, Method | None] = {}

    def take(self, group: Sequence[Start], size: int) -> Iterator[Result]:
        """The solutions of some starts, so many at a time: those that are new are proved."""
        parts = range(0, len(group), size)
        batches = [Batch(list(group[k : k + size])) for k in parts]
        first = self.result.starts + 1
        new: list[Solution] = []
        for place, timed in zip(parts, self._done(batches), strict=True):
            self.result.starts = min(first + place + size, first + len(group)) - 1
            assert isinstance(timed.result, list)
            for k, point in timed.result:
                self.result.successes += 1
                if self._is_new(point):
                    new.append(Solution(first + place + k, point))
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

    def _descend(self, new: Sequence[Solution]) -> Iterator[Result]:
        """The best methods near some solutions; those that are now the best of all are proved.

        So many solutions at a time, however many come at once: what is proved does not depend on
        the number of processes.
        """
        self._waiting += [Descent(solution.start, solution.point) for solution in new]
        while len(self._waiting) >= TOGETHER:
            some, self._waiting = self._waiting[:TOGETHER], self._waiting[TOGETHER:]
            yield self._descended(some)

    def rest(self) -> Iterator[Result]:
        """The best methods near the last solutions."""
        if self._waiting:
            yield self._descended(self._waiting)

    def _descended(self, tasks: Sequence[Descent]) -> Result:
        for task, timed in zip(tasks, self._done(tasks), strict=True):
            found = timed.result
            if not isinstance(found, Optimum):
                self.result.degenerate += 1
            elif not any(are_same(found.point, x.optimum.point) for x in self._optima):
                self._optima.append(Best(task.start, found))
        self._optima.sort(key=lambda best: (best.optimum.grade, best.start))
        self._prove()
        return self.result

    def _prove(self) -> None:
        """Prove the best optima that were not, until as many as are wanted make methods."""
        while now := [x for x in self._chosen() if x.start not in self._known]:
            for best, timed in zip(now, self._done(now), strict=True):
                made = timed.result
                self._known[best.start] = made if isinstance(made, Method) else None
                self.result.unstable += made is False
                self.result.degenerate += made is None
        methods = [x for best in self._chosen() if (x := self._known[best.start]) is not None]
        is_level = isinstance(self.search.objective, Level)
        self.result.methods = sorted(
            methods, key=lambda x: float(x.objective or 0), reverse=is_level
        )

    def _chosen(self) -> list[Best]:
        """The best optima that make methods, as far as is known, each method once."""
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

    def _done(self, tasks: Sequence[Task]) -> Iterator[Timed]:
        """What comes of tasks, in their order."""
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
        if not isinstance(found, Method):
            self.result.degenerate += 1
            return
        texts = tuple(found.values.values())
        if texts not in self._texts:
            self._texts.add(texts)
            self.result.methods.append(found)


def are_same(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two points are one up to rounding."""
    return all(abs(a - b) <= SAME for a, b in zip(one, other, strict=True))
