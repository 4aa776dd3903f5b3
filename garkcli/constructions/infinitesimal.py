"""Multirate infinitesimal methods: between slow stages a fast problem is solved, exactly or by
small steps of a method.

    v(0) = y_n + Σ_j α_ij (Y_j − y_n),   v(1) is Y_i before its correction, and
    dv/dτ = h d_i f(v) + Σ_j γ_ij (Y_j − y_n) + h Σ_m Σ_j Σ_k ω^m,k_ij τ^k g_m(Y_j).

The first colour is f, the fast part, the others are the g_m. Collocation with n nodes in place of
the exact solution changes no condition of an order p if n is large enough: docs/exact-order.md,
section 10.

O. Knoth, R. Wolke, Appl. Numer. Math. 28 (1998) 327; J. Wensch, O. Knoth, A. Galant, BIT 49 (2009)
449, with α and γ; A. Sandu, SIAM J. Numer. Anal. 57 (2019) 2300, with polynomials; R. Chinomona, D.
Reynolds, SIAM J. Sci. Comput. 43 (2021) A3082, with two slow parts; V. T. Luan, R. Chinomona, D.
Reynolds, SIAM J. Sci. Comput. 42 (2020) A1245, and A. Fish, D. Reynolds, S. Roberts, J. Comput.
Appl. Math. 438 (2024) 115534, with every fast problem from y_n; S. Roberts, A. Sarshar, A. Sandu,
SIAM J. Sci. Comput. 42 (2020) A1609, with step-predictors.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import pairwise
from math import factorial
from operator import mul

from flint import fmpq

from garkcli.constructions import multirate
from garkcli.constructions.composition import MAX_STAGES, refuse_large
from garkcli.errors import MethodError
from garkcli.exact.display import to_float
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, dot
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen, replace
from garkcli.order.meant import AnyTableau
from garkcli.properties.reduction import merged
from garkcli.tableau.embedded import NOTHING, Further, as_colours, from_colours
from garkcli.tableau.polynomial_space import antiderivative
from garkcli.tableau.stages import Flow, PointSpace
from garkcli.tableau.tableau import Method, Tableau

Powers = tuple[Vector, ...]
"""Rows over the slow stages, one for each of τ⁰, τ¹, …"""


class FastInterval(Frozen):
    """One fast problem, with τ from 0 to 1.

    Attributes:
        begin: α_ij: the coefficients of Y_j − y_n in its initial value.
        drift: γ_ij: the coefficients of Y_j − y_n that are added evenly on the way.
        width: d_i, of the fast part.
        forcing: the rows of each slow part.
        after: for each slow part the row that is added at the end, or empty.
    """

    begin: Vector
    drift: Vector
    width: Number
    forcing: tuple[Powers, ...]
    after: tuple[Vector, ...] = ()

    @property
    def rows(self) -> Iterator[tuple[int, Vector]]:
        for part, powers in enumerate(self.forcing):
            for row in powers:
                yield part, row
        yield from ((part, row) for part, row in enumerate(self.after) if row)


class Coupling(Frozen):
    """The slow stages, and the fast problems between them.

    Attributes:
        nodes: of the slow stages, from 0 to 1; the last one is the end of the step.
        intervals: those that lead to each stage after the first.
        embedded: the interval that leads to the embedded value, or None.
        matrices: for each slow part those of τ⁰, τ¹, …, as in the file; row i leads to the stage
            after stage i. None for methods with α, β and γ.
        restart: their convention if fast problems begin at y_n; else empty.
        has_own_nodes: whether its coefficients determine the nodes.
    """

    nodes: Vector
    intervals: tuple[FastInterval, ...]
    embedded: FastInterval | None = None
    matrices: tuple[tuple[Matrix, ...], ...] | None = None
    restart: str = ""
    has_own_nodes: bool = False

    @property
    def rows(self) -> Iterator[Vector]:
        yield self.nodes
        for interval in self.every:
            yield from (interval.begin, interval.drift, (interval.width,))
            yield from (row for _, row in interval.rows)

    @property
    def parts(self) -> int:
        return len(self.intervals[0].forcing)

    @cached_property
    def every(self) -> tuple[FastInterval, ...]:
        return self.intervals if self.embedded is None else (*self.intervals, self.embedded)


def following(
    nodes: Vector,
    matrices: tuple[tuple[Matrix, ...], ...],
    embedded: tuple[Powers, ...] | None = None,
) -> Coupling:
    """Every fast problem begins at the end of the one before: MIS, MRI-GARK, IMEX-MRI-GARK.

    ``nodes`` go from 0 to 1, the end of the step; ``matrices`` are for each slow part those of τ⁰,
    τ¹, …; row i leads from stage i to the next. ``embedded`` has for each slow part the rows from
    the last stage but one to the embedded value.
    """
    columns = len(nodes)
    intervals = [
        FastInterval(_unit(columns, i), _zeros(columns), end - begin, _rows(matrices, i))
        for i, (begin, end) in enumerate(pairwise(nodes))
    ]
    last = None if embedded is None else replace(intervals[-1], forcing=embedded)
    return Coupling(nodes, tuple(intervals), last, matrices)


def mis_coupling(base: Method, embedded: Vector | None = None) -> Coupling:
    """The coupling of multirate infinitesimal steps: differences of the rows of a method."""
    rows = [*base.A, base.b]
    differences = [_difference(row, before) for before, row in pairwise(rows)]
    last = None if embedded is None else ((_difference(embedded, base.A[-1]),),)
    return following((*base.c, ONE), ((tuple(differences),),), last)


def restarted(
    nodes: Vector,
    forcing: tuple[tuple[Matrix, ...], ...],
    embedded: tuple[Powers, ...] | None = None,
    after: Matrix | None = None,
    embedded_after: Vector | None = None,
) -> Coupling:
    """Every fast problem begins at y_n and goes on to c_i: IMEX-MRI-SR.

    ``nodes`` begin with 0 and end with 1, in any order between. ``forcing`` has for each slow part
    the matrices of τ⁰, τ¹, …, τ = 1 at c_i; row i leads to the stage after stage i. ``embedded``
    has for each slow part the rows to the embedded value at 1. ``after`` is the correction by the
    last slow part after each fast problem.
    """
    zeros = _zeros(len(nodes))
    before = ((),) * (len(forcing) - 1)

    def interval(c: Number, powers: tuple[Powers, ...], row: Vector | None) -> FastInterval:
        return FastInterval(zeros, zeros, c, powers, () if row is None else (*before, row))

    rows = after or [None] * (len(nodes) - 1)
    intervals = [
        interval(c, _rows(forcing, i), row)
        for i, (c, row) in enumerate(zip(nodes[1:], rows, strict=True))
    ]
    last = None if embedded is None else interval(ONE, embedded, embedded_after)
    return Coupling(nodes, tuple(intervals), last)


def of_step_time(nodes: Vector, matrices: tuple[Matrix, ...]) -> tuple[Matrix, ...]:
    """Polynomials in the time of the step, θ = c_i τ (MERK methods), rewritten in τ."""
    return tuple(
        tuple(tuple(c ** (k + 1) * x for x in row) for c, row in zip(nodes, matrix, strict=True))
        for k, matrix in enumerate(matrices)
    )


def generalized(alpha: Matrix, beta: Matrix, gamma: Matrix) -> Coupling:
    """The methods of Wensch, Knoth and Galant; MethodError if α or γ uses a later stage."""
    nodes: list[Number] = [ZERO]
    intervals = []
    for begin, row, drift in zip(alpha, beta, gamma, strict=True):
        for letter, values in (("alpha", begin), ("gamma", drift)):
            if any(values[len(nodes) :]):
                message = f"{letter}, row {len(nodes)} uses a later stage"
                cure = "a row has the stages before its own"
                raise MethodError(message, cure, code="cannot-construct")
        width = sum(row, ZERO)
        known = [*nodes, *_zeros(len(row) - len(nodes))]
        nodes.append(dot(begin, known) + dot(drift, known) + width)
        intervals.append(FastInterval(begin, drift, width, ((row,),)))
    return Coupling(tuple(nodes), tuple(intervals), has_own_nodes=True)


def check_ends(coupling: Coupling) -> None:
    """Refuses nodes that do not go from 0 to 1, unless α, β and γ determine them."""
    nodes = coupling.nodes
    if coupling.has_own_nodes:
        return
    if nodes[0]:
        message = f"the slow stages begin at {nodes[0]}, not at 0"
        raise MethodError(message, "take a slow method with c_1 = 0", code="cannot-construct")
    if nodes[-1] != ONE:
        message = f"the slow stages end at {nodes[-1]}, not at 1"
        raise MethodError(message, "give the end of the step as last node", code="cannot-construct")


def _zeros(columns: int) -> Vector:
    return (ZERO,) * columns


def _unit(columns: int, i: int) -> Vector:
    return tuple(ONE if j == i else ZERO for j in range(columns))


def _difference(row: Vector, before: Vector) -> Vector:
    return (*(x - y for x, y in zip(row, before, strict=True)), ZERO)


def _rows(matrices: tuple[tuple[Matrix, ...], ...], i: int) -> tuple[Powers, ...]:
    return tuple(tuple(matrix[i] for matrix in powers) for powers in matrices)


class CollocationPlan(Frozen):
    """The collocation and the slow stages of a method, chosen once by its printed numbers.

    Attributes:
        fast: for each interval the nodes of the collocation for the exact solution, or 1 for a
            method; 0 without a fast part.
        stages: the slow stages with slopes in use, from 0.
        order: the order up to which collocation changes no condition; None for a method.
    """

    fast: tuple[int, ...]
    stages: tuple[int, ...]
    order: int | None = None


def plan_for_method(coupling: Coupling) -> CollocationPlan:
    last = len(coupling.nodes) - 1
    is_seen = any(row[-1] for interval in coupling.every for _, row in interval.rows)
    stages = range(last + 1 if is_seen else last)
    return CollocationPlan(_solved(coupling, [1] * len(coupling.every)), tuple(stages))


def _solved(coupling: Coupling, counts: Sequence[int]) -> tuple[int, ...]:
    """The counts at intervals where the fast part moves, or at the first one."""
    moves = [bool(x.width) for x in coupling.every]
    moves[0] |= not any(moves)
    return tuple(n if x else 0 for n, x in zip(counts, moves, strict=True))


def plan_for_flow(coupling: Coupling) -> CollocationPlan:
    """The plan with the exact solution of each fast problem.

    The order is at most ``highest``, and at most ``apparent_order`` unless rounding explains large
    residuals or coefficients are unknown, so collocation that keeps the trees up to the next order
    decides it. Otherwise, or with too many stages for that, the search for the order ends there.
    """
    seen = {j for interval in coupling.every for _, row in interval.rows for j in _support(row)}
    degrees = _solved(coupling, [max(1, *map(len, x.forcing)) for x in coupling.every])
    room = max(MAX_STAGES - len(seen) - len(degrees), 0)
    wanted = highest(coupling)
    if not any(isinstance(x, Parametric) for row in coupling.rows for x in row):
        wanted = min(wanted, apparent_order(coupling, seen))
    order = max(1, min(wanted, room // (sum(degrees) or 1)))
    refuse_large(sum(degrees) + len(degrees), multirate.SMALLER)
    counts = tuple(d * order + 1 if d else 0 for d in degrees)
    return CollocationPlan(counts, tuple(sorted(seen or {0})), order + 1)


def _support(row: Vector) -> list[int]:
    return [j for j, x in enumerate(row) if x]


def highest(coupling: Coupling) -> int:
    """An upper bound of the order, from the dependencies of the slow stages.

    With a zero fast part it is a Runge–Kutta method. The order of an explicit one is at most the
    length of its longest chain of stages, as the unbranched tree with one vertex more has weight 0.
    If stages see themselves but no later ones, the stability function has real poles and a
    numerator of degree at most s, hence order at most s + 1 (Hairer and Wanner II, Theorem
    IV.4.18); any other has at most 2 s.
    """
    sees: list[set[int]] = [set()]
    for interval in coupling.every:
        found = {j for _, row in interval.rows for j in _support(row)}
        for row in (interval.begin, interval.drift):
            found |= {j for i in _support(row) if i < len(sees) for j in sees[i]}
        sees.append(found)
    used = set().union(*sees)
    if all(j < i for i in used for j in sees[i]):
        length = [0] * len(sees)
        for i, seen in enumerate(sees):
            length[i] = 1 + max((length[j] for j in seen), default=0)
        return max(length[len(coupling.intervals) :]) - 1
    return len(used) + 1 if all(j <= i for i in used for j in sees[i]) else 2 * len(used)


_PLAIN = 1e-3
"""Larger relative residuals are not rounding."""


def apparent_order(coupling: Coupling, stages: Iterable[int]) -> int:
    """Returns the order up to which quadrature and the unbranched trees fit, or rounding may
    explain it, for the slow method with equal parts, with b or the embedded weights.
    """
    still = CollocationPlan((0,) * len(coupling.every), tuple(sorted(stages)) or (0,))
    made, further = _Infinitesimal(coupling, still, None, 1).made()
    slow = [m for m, colour in enumerate(made.colours) if colour.space == multirate.SLOW]
    A = _as_one(zip(*(made.blocks[multirate.SLOW, m] for m in slow), strict=True))
    weights = [[made.colours[m].b for m in slow]]
    if further.embedded is not None:
        weights.append([further.embedded[m] for m in slow])
    return max(fitting(_sums(A, b)) for b in _as_one(weights))


def _as_one(rows: Iterable[Iterable[Vector]]) -> list[list[float]]:
    """The means over the slow parts, row by row."""
    return [
        [sum(map(to_float, column)) / len(column) for column in zip(*x, strict=True)] for x in rows
    ]


def _sums(A: Sequence[Sequence[float]], b: Sequence[float]) -> Iterator[tuple[float, float]]:
    """The sums b Aᵏ 𝟙 and b cᵏ, k = 0, 1, …"""

    def applied(v: Sequence[float]) -> list[float]:
        return [sum(map(mul, row, v)) for row in A]

    tall = bushy = [1.0] * len(b)
    c = applied(tall)
    for _ in range(2 * len(b) + 1):
        yield sum(map(mul, b, tall)), sum(map(mul, b, bushy))
        tall, bushy = applied(tall), [*map(mul, bushy, c)]


def fitting(values: Iterable[tuple[float, float]]) -> int:
    """The order up to which the weights of the unbranched and the bushy trees are about right."""
    order = 0
    for order, pair in enumerate(values, start=1):
        for value, due in zip(pair, (1 / factorial(order), 1 / order), strict=True):
            if abs(value - due) > _PLAIN * due:
                return order - 1
    return order


@lru_cache(maxsize=32)
def collocation(stages: int) -> Method:
    return collocation_at(tuple(fmpq(k, stages) for k in range(1, stages + 1)))


def collocation_at(nodes: Vector) -> Method:
    space = PointSpace(nodes)
    integrals = [antiderivative(x) for x in space.basis_polynomials()]
    powers = [[node**k for k in range(len(nodes) + 1)] for node in nodes]
    A = tuple(tuple(dot(x, row) for x in integrals) for row in powers)
    return Method("", space, A, A[-1])


def infinitesimal(
    coupling: Coupling, plan: CollocationPlan, fast: Method | None = None, steps: int = 1
) -> tuple[Tableau, Further]:
    """Returns the method with its embedded weights; raises MethodError for too many stages.
    ``fast`` is the method of the ``steps`` between two slow stages, None for exact solutions.
    """
    if fast is not None:
        refuse_large(len(coupling.every) * (steps * fast.stages + 2), multirate.SMALLER)
    return _finished(_Infinitesimal(coupling, plan, fast, steps), plan)


def _finished(program: _Infinitesimal, plan: CollocationPlan) -> tuple[Tableau, Further]:
    made, further = program.made()
    if plan.order is None:
        return from_colours(merged(as_colours(made, further)), further)
    flow, *others = made.spaces
    return replace(made, spaces=(Flow(flow.nodes, plan.order), *others)), further


def interpolation(slow: Method) -> Powers:
    """Returns the forcing that interpolates the slopes; CoincidingNodes for two equal nodes."""
    polynomials = tuple(slow.space.basis_polynomials())
    return tuple(tuple(p[k] for p in polynomials) for k in range(slow.stages))


def plan_for_predictor(
    slow: Method, forcing: Iterable[Powers], fast: Method | None
) -> CollocationPlan:
    """Returns the plan of a step-predictor; ``forcing`` also has that for the embedded value."""
    s = slow.stages
    stages = tuple(range(s))
    degrees = [max(len(powers), 1) for powers in forcing]
    if fast is not None:
        return CollocationPlan((1,) * len(degrees), stages)
    is_explicit = not any(x for i, row in enumerate(slow.A) for x in row[i:])
    is_lower = not any(x for i, row in enumerate(slow.A) for x in row[i + 1 :])
    order = s if is_explicit else s + 1 if is_lower else 2 * s
    room = MAX_STAGES - 2 * s - len(degrees)
    order = max(1, min(order, room // sum(degrees)))
    return CollocationPlan(tuple(d * order + 1 for d in degrees), stages, order + 1)


def predicted(
    slow: Method,
    forcing: tuple[Powers, ...],
    plan: CollocationPlan,
    fast: Method | None = None,
    steps: int = 1,
) -> tuple[Tableau, Further]:
    """The slow method takes the step for both parts; then the fast problem is solved from y_n to
    the end of the step, with polynomials of the slow slopes as forcing. MethodError for too many
    stages.
    """
    of_fast = sum(plan.fast) if fast is None else len(forcing) * steps * fast.stages
    refuse_large(2 * slow.stages + of_fast, multirate.SMALLER)
    zeros = _zeros(slow.stages + 1)
    ways = [
        FastInterval(zeros, zeros, ONE, (tuple((*row, ZERO) for row in powers),))
        for powers in forcing
    ]
    coupling = Coupling((*slow.c, ONE), tuple(ways[:1]), ways[1] if len(ways) > 1 else None)
    return _finished(_Predicted(coupling, plan, fast, steps, slow), plan)


def slow_part(method: AnyTableau) -> AnyTableau:
    """The slow method by itself, with a zero fast part."""
    if isinstance(method, Tableau):
        return _slow_part(method)
    return method.derive("slow part", _slow_part)


def _slow_part(tableau: Tableau) -> Tableau:
    slow = [m for m, colour in enumerate(tableau.colours) if colour.space == multirate.SLOW]
    colours = tuple(replace(tableau.colours[m], space=0) for m in slow)
    blocks = {(0, n): tableau.blocks[multirate.SLOW, m] for n, m in enumerate(slow)}
    return Tableau((tableau.spaces[multirate.SLOW],), colours, blocks)


class _Infinitesimal:
    def __init__(
        self, coupling: Coupling, plan: CollocationPlan, fast: Method | None, steps: int
    ) -> None:
        self.coupling = coupling
        self.plan = plan
        self.fast = fast
        self.steps = steps
        self.program = multirate.SmallSteps([multirate.FAST, *[multirate.SLOW] * coupling.parts])
        self.values: list[multirate.Value] = []
        self.places = {j: n for n, j in enumerate(plan.stages)}

    def made(self) -> tuple[Tableau, Further]:
        """Unused slow slopes are left out."""
        result = self._result()
        further = NOTHING
        if self.coupling.embedded is not None:
            value = self._after(len(self.coupling.intervals), self.coupling.embedded)
            weights = self.program.tableau(value)
            further = Further(tuple(colour.b for colour in weights.colours))
        return self.program.tableau(result), further

    def _result(self) -> multirate.Value:
        self._reached(multirate.START)
        for i, interval in enumerate(self.coupling.intervals):
            self._reached(self._after(i, interval))
        return self.values[-1]

    def _reached(self, value: multirate.Value) -> None:
        """Adds a slow stage; an implicit one already has its own slope in its value."""
        i = len(self.values)
        if i in self.places:
            self.program.add(multirate.SLOW, value, self.coupling.nodes[i])
        self.values.append(value)

    def _after(self, i: int, interval: FastInterval) -> multirate.Value:
        value = self._mixed(interval.begin)
        drift = self._mixed(interval.drift)
        count = self.plan.fast[i]
        if not count:
            value = multirate.summed(value, drift, self._forced(interval))
        elif self.fast is None:
            value = self._small_step(interval, value, drift, collocation(count), ZERO, ONE)
        else:
            length = fmpq(1, self.steps)
            for n in range(self.steps):
                begin = n * length
                value = self._small_step(interval, value, drift, self.fast, begin, length)
        for part, row in enumerate(interval.after):
            value = multirate.summed(value, self._slow(part, row) if row else multirate.START)
        return value

    def _mixed(self, row: Vector) -> multirate.Value:
        pairs = [(x, self.values[j]) for j, x in enumerate(row) if x]
        scaled = [{slope: x * weight for slope, weight in value.items()} for x, value in pairs]
        return scaled[0] if len(scaled) == 1 else multirate.summed(*scaled)

    def _slow(self, part: int, row: Vector) -> multirate.Value:
        return {
            (multirate.SLOW + part, self.places[j]): x
            for j, x in enumerate(row)
            if j in self.places
        }

    def _node(self, interval: FastInterval, tau: Number) -> Number:
        nodes = self.coupling.nodes
        return dot(interval.begin, nodes) + tau * (dot(interval.drift, nodes) + interval.width)

    def _small_step(
        self,
        interval: FastInterval,
        value: multirate.Value,
        drift: multirate.Value,
        fast: Method,
        begin: Number,
        length: Number,
    ) -> multirate.Value:
        first = self.program.count(multirate.FAST)
        stages = range(first, first + fast.stages)
        times = [begin + length * c for c in fast.c]
        for row, time in zip(fast.A, times, strict=True):
            inner = self._moved(interval, drift, row, times, stages, length)
            self.program.add(
                multirate.FAST, multirate.summed(value, inner), self._node(interval, time)
            )
        return multirate.summed(value, self._moved(interval, drift, fast.b, times, stages, length))

    def _moved(
        self,
        interval: FastInterval,
        drift: multirate.Value,
        weights: Vector,
        times: Sequence[Number],
        stages: range,
        length: Number,
    ) -> multirate.Value:
        scaled = [length * w for w in weights]
        moved = multirate.of_slopes(multirate.FAST, stages, [interval.width * w for w in scaled])
        moments = [
            dot(scaled, [time**k for time in times])
            for k in range(max(map(len, interval.forcing)) or 1)
        ]
        along = {slope: moments[0] * weight for slope, weight in drift.items()}
        parts = [
            self._slow(part, tuple(moments[k] * x for x in row))
            for part, powers in enumerate(interval.forcing)
            for k, row in enumerate(powers)
        ]
        return multirate.summed(moved, along, *parts)

    def _forced(self, interval: FastInterval) -> multirate.Value:
        return multirate.summed(
            *(
                self._slow(part, tuple(x * fmpq(1, k + 1) for x in row))
                for part, powers in enumerate(interval.forcing)
                for k, row in enumerate(powers)
            )
        )


class _Predicted(_Infinitesimal):
    """The tableau of a step-predictor; its slow stages are those of a method for both parts."""

    def __init__(
        self,
        coupling: Coupling,
        plan: CollocationPlan,
        fast: Method | None,
        steps: int,
        slow: Method,
    ) -> None:
        super().__init__(coupling, plan, fast, steps)
        self.slow = slow

    def _result(self) -> multirate.Value:
        multirate.add_slow_stages(self.program, self.slow)
        return self._after(0, self.coupling.intervals[0])
