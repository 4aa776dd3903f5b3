"""What targets ask of a method: stages one after the other, explicit ones, shared ones, kicks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.rounding import Cell
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, Mutable, field
from garkcli.graph import components
from garkcli.tableau.pointwise import Row

Rows: TypeAlias = tuple[Row, ...]


def vanishes(x: Cell) -> bool:
    """Whether an entry is zero; an enclosure is no proof of that."""
    return not isinstance(x, arb) and not x


def is_lower(rows: Rows, has_diagonal: bool) -> bool:
    """Whether all entries above the diagonal are zero, and those on it unless it may have them."""
    for i, row in enumerate(rows):
        first = i + 1 if has_diagonal else i
        if not all(map(vanishes, row[first:])):
            return False
    return True


class Table(Frozen):
    """The coefficients of one vector field, as a Butcher tableau.

    Attributes:
        A: shape (s, s).
        b: the weights.
        c: the nodes.
        embedded: the embedded weights; None without them.
        dense: the coefficients of θ, θ², … of each b_i(θ); None without them.
    """

    A: Rows
    b: Row
    c: Row
    embedded: Row | None = None
    dense: Rows | None = None

    @property
    def stages(self) -> int:
        """The number of stages."""
        return len(self.b)

    @property
    def is_explicit(self) -> bool:
        """Whether each stage needs only those before it."""
        return is_lower(self.A, has_diagonal=False)

    @property
    def is_diagonally_implicit(self) -> bool:
        """Whether each stage needs only itself and those before it."""
        return is_lower(self.A, has_diagonal=True)

    @property
    def is_fsal(self) -> bool:
        """Whether the last stage is at the new value, at time t + h, and explicit."""
        is_at_end = self.c[-1] == fmpq(1) and vanishes(self.A[-1][-1])
        return self.stages > 1 and is_at_end and self.A[-1] == self.b


def table(payload: Payload) -> Table:
    """The one table of a method for one vector field."""
    block = payload.A[0][0] or ()
    embedded = payload.embedded
    dense = payload.dense
    return Table(
        block,
        payload.b[0],
        payload.c[0],
        None if embedded is None else embedded[0],
        None if dense is None else dense[0],
    )


Place: TypeAlias = tuple[int, int]
"""A colour and a stage of it."""


class _Stage(Mutable):
    """A stage of all colours together, in the making.

    Attributes:
        rows: the stage value as weights of all vector fields, colour by colour.
        place_of: for a colour that evaluates its vector field here, the number of its stage.
        node: where all other vector fields are evaluated.
    """

    rows: tuple[Row, ...]
    place_of: dict[int, int] = field(default_factory=dict)
    node: Cell = ZERO


def shared(payload: Payload) -> list[Table]:
    """The method with all stages shared by all vector fields, in an order in which they can be
    computed: a table a colour.

    Every GARK method is such a method: its stage values, those of all colours one after the other,
    are the stages; a vector field has zero columns where it is not evaluated. Stage values that
    are equal are one stage.
    """
    merged = _merged(payload)
    stages = [merged[k] for k in _sorted(merged)]
    return [_table_of(payload, stages, m) for m in range(payload.size)]


def _merged(payload: Payload) -> list[_Stage]:
    """The different stage values of all colours."""
    found: list[_Stage] = []
    for l in range(payload.size):
        for i, node in enumerate(payload.c[l]):
            rows = tuple(_rows_at(payload, l, i))
            stage = _same(found, rows, l)
            if stage is None:
                stage = _Stage(rows, node=node)
                found.append(stage)
            stage.place_of[l] = i
    return found


def _rows_at(payload: Payload, l: int, i: int) -> Iterator[Row]:
    """The weights of each vector field in stage i of colour l."""
    for m in range(payload.size):
        block = payload.A[l][m]
        if block is None:
            yield (ZERO,) * len(payload.b[m])
        else:
            yield block[i]


def _same(found: Sequence[_Stage], rows: tuple[Row, ...], l: int) -> _Stage | None:
    """A stage with these rows that has no stage of colour l yet."""
    for stage in found:
        if l not in stage.place_of and stage.rows == rows:
            return stage
    return None


def _sorted(stages: Sequence[_Stage]) -> list[int]:
    """An order in which no stage needs a later one, the given one as far as possible."""
    seen: dict[int, list[int]] = {}
    at = {(m, j): k for k, stage in enumerate(stages) for m, j in stage.place_of.items()}
    for k, stage in enumerate(stages):
        needed = []
        for m, row in enumerate(stage.rows):
            needed += [at[m, j] for j, x in enumerate(row) if not vanishes(x)]
        seen[k] = needed
    order: list[int] = []
    # each component comes after those that it needs
    waiting = {min(x): x for x in components(seen)}
    while waiting:
        ready = [k for k, x in waiting.items() if _is_ready(x, seen, {*order})]
        order += sorted(waiting.pop(min(ready)))
    return order


def _is_ready(component: Sequence[int], seen: Mapping[int, Sequence[int]], done: set[int]) -> bool:
    """Whether all that some stages need is computed, or among themselves."""
    needed = {j for k in component for j in seen[k]}
    return needed <= done | {*component}


def _table_of(payload: Payload, stages: Sequence[_Stage], m: int) -> Table:
    """The table of vector field m on shared stages."""
    places = [stage.place_of.get(m) for stage in stages]

    def spread(row: Row) -> Row:
        return tuple(ZERO if j is None else row[j] for j in places)

    nodes = [
        stage.node if j is None else payload.c[m][j]
        for stage, j in zip(stages, places, strict=True)
    ]
    embedded = payload.embedded
    dense = None
    if payload.dense is not None:
        found = payload.dense[m]
        nothing = (ZERO,) * len(found[0])
        dense = tuple(nothing if j is None else found[j] for j in places)
    return Table(
        tuple(spread(stage.rows[m]) for stage in stages),
        spread(payload.b[m]),
        tuple(nodes),
        None if embedded is None else spread(embedded[m]),
        dense,
    )


class Composition(Frozen):
    """A separable method as a sequence of exact flows: kicks p += hk g(q), drifts q += hd f(p).

    Attributes:
        kicks: and
        drifts: by turns, a kick first: kick 1, drift 1, kick 2, …; as many of each.
    """

    kicks: Row
    drifts: Row

    @property
    def drift_first(self) -> tuple[Row, Row]:
        """The same as drifts and kicks by turns, a drift first."""
        if vanishes(self.kicks[0]):
            return self.drifts, (*self.kicks[1:], ZERO)
        if vanishes(self.drifts[-1]):
            return (ZERO, *self.drifts[:-1]), self.kicks
        return (ZERO, *self.drifts), (*self.kicks, ZERO)


def composition(payload: Payload) -> Composition | None:
    """A method for q' = f(p), p' = g(q) as such a sequence; None where it is none."""
    at_forces, at_velocities = payload.A[1][0], payload.A[0][1]
    sees_itself = payload.A[0][0] or payload.A[1][1]
    if at_forces is None or at_velocities is None or sees_itself:
        return None
    drifts, kicks = payload.b
    before: list[tuple[Cell, frozenset[int]]] = []
    for i, kick in enumerate(kicks):
        taken = _taken(at_forces[i], drifts)
        if taken is None:
            return None
        if not vanishes(kick):
            before.append((kick, taken))
    for j, drift in enumerate(drifts):
        taken = _taken(at_velocities[j], kicks)
        if taken is None:
            return None
        if not vanishes(drift) and taken != _later(at_forces, kicks, j):
            return None
    return _by_turns(before, drifts)


def _taken(row: Row, weights: Row) -> frozenset[int] | None:
    """Which steps of the other part lie before a stage; None where one does so in part."""
    found = set()
    for j, (x, weight) in enumerate(zip(row, weights, strict=True)):
        if vanishes(x):
            continue
        if x != weight:
            return None
        found.add(j)
    return frozenset(found)


def _later(at_forces: Rows, kicks: Row, j: int) -> frozenset[int]:
    """The kicks at positions that do not have drift j in them."""
    numbered = enumerate(zip(at_forces, kicks, strict=True))
    return frozenset(i for i, (row, kick) in numbered if kick and vanishes(row[j]))


def _by_turns(before: Sequence[tuple[Cell, frozenset[int]]], drifts: Row) -> Composition | None:
    """Kicks with the drifts that lie before each, put in order; None where there is none."""
    everything = frozenset(j for j, drift in enumerate(drifts) if not vanishes(drift))
    steps = sorted({taken for _, taken in before} | {frozenset()}, key=len)
    found_kicks: list[Cell] = []
    found_drifts: list[Cell] = []
    for taken, following in zip(steps, [*steps[1:], everything], strict=True):
        if not taken <= following:
            return None
        kick = [x for x, when in before if when == taken]
        drift = [drifts[j] for j in sorted(following - taken)]
        found_kicks.append(sum(kick, start=ZERO))
        found_drifts.append(sum(drift, start=ZERO))
    return Composition(tuple(found_kicks), tuple(found_drifts))


def no_composition(payload: Payload, taker: str) -> CannotExport:
    """That a method is no such sequence, and what there is instead."""
    cure = "json, c, fortran and numpy hold it"
    if payload.structure == "general":
        cure = f"for q' = f(p), p' = g(q) say so: structure: separable; {cure}"
    return CannotExport(
        f"{taker} takes kicks and drifts by turns, each explicit, and {payload.name} is no such "
        "composition",
        cure,
    )
