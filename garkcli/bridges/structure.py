"""Structures that targets require: stages one after the other, explicit, shared; kicks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.bridges.payload import Payload
from garkcli.bridges.rounding import combined
from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import Frozen, Mutable, field, replace
from garkcli.graph import solving_order
from garkcli.tableau.pointwise import Cell, Row

Rows: TypeAlias = tuple[Row, ...]


def vanishes(x: Cell) -> bool:
    """Whether x is known to be 0, which no enclosure is."""
    return not isinstance(x, arb) and not x


class Table(Frozen):
    """``dense`` has the coefficients of θ, θ², … of each b_i(θ)."""

    A: Rows
    b: Row
    c: Row
    embedded: Row | None = None
    dense: Rows | None = None

    @property
    def stages(self) -> int:
        return len(self.b)

    @property
    def is_explicit(self) -> bool:
        return self.is_diagonally_implicit and all(map(vanishes, self.diagonal))

    @property
    def is_diagonally_implicit(self) -> bool:
        """Whether each stage depends only on itself and those before it."""
        return all(vanishes(x) for i, row in enumerate(self.A) for x in row[i + 1 :])

    @property
    def is_fsal(self) -> bool:
        """Whether the last stage is at the new value, at time t + h, and explicit."""
        is_at_end = self.c[-1] == fmpq(1) and vanishes(self.A[-1][-1])
        return self.stages > 1 and is_at_end and self.A[-1] == self.b

    @property
    def begins_at_start(self) -> bool:
        return all(map(vanishes, (*self.A[0], self.c[0])))

    @property
    def is_first_same_as_last(self) -> bool:
        return self.begins_at_start and self.is_fsal

    @property
    def lower(self) -> Rows:
        """The rows of A below the diagonal, from the second on: one entry, two, …"""
        return tuple(row[:i] for i, row in enumerate(self.A) if i)

    @property
    def diagonal(self) -> Row:
        return tuple(row[i] for i, row in enumerate(self.A))

    @property
    def error(self) -> Row:
        """The weights b − b̂ of the error estimate; zeros without embedded weights."""
        if self.embedded is None:
            return (ZERO,) * self.stages
        return tuple(combined((1, x), (-1, y)) for x, y in zip(self.b, self.embedded, strict=True))


def table(payload: Payload) -> Table:
    return Table(
        payload.A[0][0] or (),
        payload.b[0],
        payload.c[0],
        None if payload.embedded is None else payload.embedded[0],
        None if payload.dense is None else payload.dense[0],
    )


def with_last_stage(found: Table) -> Table:
    """The table with f(t + h, y at the end) as a last stage of weight 0."""
    return _with_stage(found, found.stages, found.b, ONE)


def with_first_stage(found: Table) -> Table:
    """The table with f(t, y) as a first stage of weight 0."""
    return _with_stage(found, 0, (ZERO,) * found.stages, ZERO)


def _with_stage(found: Table, at: int, weights: Row, node: Cell) -> Table:
    def with_zero(row: Row) -> Row:
        return (*row[:at], ZERO, *row[at:])

    return replace(
        found,
        A=tuple(map(with_zero, (*found.A[:at], weights, *found.A[at:]))),
        b=with_zero(found.b),
        c=(*found.c[:at], node, *found.c[at:]),
        embedded=found.embedded and with_zero(found.embedded),
    )


class _Stage(Mutable):
    """``rows`` are the stage value as weights of all vector fields; ``place_of`` has the stage
    numbers of colours that evaluate their field here; ``node`` is that of the others.
    """

    rows: tuple[Row, ...]
    place_of: dict[int, int] = field(default_factory=dict)
    node: Cell = ZERO


def shared(payload: Payload) -> list[Table]:
    """The tables of all colours on shared stages, in an order in which they can be computed.

    Every GARK method has this form: the stages are the stage values of all colours one after the
    other, equal ones once; a vector field has zero columns at stages without an evaluation.
    """
    merged = _merged(payload)
    stages = [merged[k] for k in _sorted(merged)]
    return [_table_of(payload, stages, m) for m in range(payload.size)]


def _merged(payload: Payload) -> list[_Stage]:
    distinct: list[_Stage] = []
    for l, blocks in enumerate(payload.A):
        for i, node in enumerate(payload.c[l]):
            rows = tuple(
                (ZERO,) * len(payload.b[m]) if block is None else block[i]
                for m, block in enumerate(blocks)
            )
            # an equal stage without a stage of this colour yet
            same = (x for x in distinct if l not in x.place_of and x.rows == rows)
            stage = next(same, None)
            if stage is None:
                stage = _Stage(rows, node=node)
                distinct.append(stage)
            stage.place_of[l] = i
    return distinct


def _sorted(stages: Sequence[_Stage]) -> list[int]:
    """Orders stages so that none depends on a later one, unless on each other; else as given."""
    at = {(m, j): k for k, stage in enumerate(stages) for m, j in stage.place_of.items()}
    needs = {
        k: [
            at[m, j]
            for m, row in enumerate(stage.rows)
            for j, x in enumerate(row)
            if not vanishes(x)
        ]
        for k, stage in enumerate(stages)
    }
    return solving_order(needs, {k: k for k in needs})


def _table_of(payload: Payload, stages: Sequence[_Stage], m: int) -> Table:
    places = [stage.place_of.get(m) for stage in stages]

    def spread(row: Row) -> Row:
        return tuple(ZERO if j is None else row[j] for j in places)

    nodes = [
        stage.node if j is None else payload.c[m][j]
        for stage, j in zip(stages, places, strict=True)
    ]
    return Table(
        tuple(spread(stage.rows[m]) for stage in stages),
        spread(payload.b[m]),
        tuple(nodes),
        None if payload.embedded is None else spread(payload.embedded[m]),
    )


class Composition(Frozen):
    """A separable method as exact flows, kicks p += hk g(q) and drifts q += hd f(p) in alternation:
    kick 1, drift 1, kick 2, …
    """

    kicks: Row
    drifts: Row

    @property
    def drift_first(self) -> tuple[Row, Row]:
        """The drifts and kicks in alternation with a drift first."""
        if vanishes(self.kicks[0]):
            return self.drifts, (*self.kicks[1:], ZERO)
        if vanishes(self.drifts[-1]):
            return (ZERO, *self.drifts[:-1]), self.kicks
        return (ZERO, *self.drifts), (*self.kicks, ZERO)


def composition(payload: Payload) -> Composition | None:
    """The kicks and drifts of a method for q' = f(p), p' = g(q); None if it has none."""
    at_forces, at_velocities = payload.A[1][0], payload.A[0][1]
    sees_itself = payload.A[0][0] or payload.A[1][1]
    if at_forces is None or at_velocities is None or sees_itself:
        return None
    drifts, kicks = payload.b
    # the kicks by the drifts before each
    steps: dict[frozenset[int], Cell] = {}
    for row, kick in zip(at_forces, kicks, strict=True):
        before = frozenset(j for j, x in enumerate(row) if not vanishes(x))
        if any(row[j] != drifts[j] for j in before):
            return None
        if not vanishes(kick):
            steps[before] = steps.get(before, ZERO) + kick
    for j, drift in enumerate(drifts):
        # the kicks without this drift before them
        later = (x if vanishes(row[j]) else ZERO for row, x in zip(at_forces, kicks, strict=True))
        if not vanishes(drift) and at_velocities[j] != tuple(later):
            return None
    begins = sorted({*steps, frozenset()}, key=len)
    ends = [*begins[1:], frozenset(j for j, drift in enumerate(drifts) if not vanishes(drift))]
    between = list(zip(begins, ends, strict=True))
    if not all(x <= y for x, y in between):
        return None
    return Composition(
        tuple(steps.get(x, ZERO) for x in begins),
        tuple(sum((drifts[j] for j in sorted(y - x)), start=ZERO) for x, y in between),
    )
