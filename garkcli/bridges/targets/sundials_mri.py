"""SUNDIALS MRIStep in C: the slow part of a multirate infinitesimal step.

It is the coupling of a file with ``multirate: {mis: …}`` or ``{mri: …}``, or an explicit method:
from stage i − 1 to stage i the fast equation is solved from c_{i−1} to c_i, with the constant slow
tendency Σ_j (a_{ij} − a_{i−1,j}) f_j / (c_i − c_{i−1}). The last stage is the new value. With
``restart`` the fast equation is solved from the beginning of the step.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from operator import mul
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.couplings import coupling_of, embedded_rows
from garkcli.bridges.numbers import c_style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import ball, combined
from garkcli.bridges.structure import Rows, Table, table, vanishes, with_last_stage
from garkcli.bridges.texts import Values
from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import Frozen
from garkcli.tableau.pointwise import Row

if TYPE_CHECKING:
    from garkcli.constructions.infinitesimal import Coupling


class Slow(Frozen):
    """The slow part of a multirate infinitesimal step.

    Attributes:
        nodes: of its stages; the last one is the new value.
        matrices: of τ⁰, τ¹, …, under W for explicit and G for implicit ones; row i leads to stage
            i.
        order: with the fast equation solved exactly, or by the steps in the file.
        embedding: the rows to the embedded value, under W or G one for each power, and its order.
        restart: merk or sr, if fast problems begin with the step.
    """

    nodes: Row
    matrices: Mapping[str, Sequence[Rows]]
    order: int
    embedding: tuple[Mapping[str, Sequence[Row]], int] | None = None
    restart: str = ""

    @property
    def type(self) -> str:
        if self.restart:
            return f"MRISTEP_{self.restart.upper()}"
        names = {"W": "EXPLICIT", "G": "IMPLICIT", "WG": "IMEX"}
        return f"MRISTEP_{names[''.join(self.matrices)]}"

    @property
    def groups(self) -> Sequence[Sequence[int]]:
        """Groups of ``merk`` stages with one forcing, each one fast problem for MRIStep.

        The embedded value is the last stage of the last group but one, with the number of stages
        as its number; the new value is its own group.
        """
        last = len(self.nodes) - 1
        forcing = [tuple(matrix[i] for matrix in self.matrices["W"]) for i in range(last + 1)]
        by_forcing: dict[object, list[int]] = {}
        for i in range(1, last):
            by_forcing.setdefault(forcing[i], []).append(i)
        groups = [sorted(x, key=lambda i: float(ball(self.nodes[i]))) for x in by_forcing.values()]
        rows = () if self.embedding is None else self.embedding[0]["W"]
        zeros = ((ZERO,) * (last + 1),) * (len(forcing[0]) - len(rows))
        if groups and forcing[groups[-1][0]] == (*rows, *zeros):
            groups[-1].append(last + 1)
        else:
            groups.append([last + 1])
        return [*groups, [last]]


def values(payload: Payload, _: Sequence[Table]) -> Values:
    """The coupling, and whether the orders are those with fast steps in the file."""
    has_steps = payload.coupling is not None and payload.kind != "mri"
    return {"slow": slow_part(payload), "has_steps": has_steps}


def slow_part(payload: Payload) -> Slow:
    """A file with a coupling, or an explicit method as one; CannotExport if it is neither."""
    if payload.kind != "rk" or payload.coupling is not None:
        return _coupled(payload, coupling_of(payload))
    found = table(payload)
    ends = zip(found.c, (*found.c[1:], ONE), strict=True)
    goes_on = not any(ball(combined((1, y), (-1, x))) < 0 for x, y in ends)
    if not vanishes(found.c[0]) or not goes_on:
        raise CannotExport(
            "a multirate infinitesimal step goes from node to node, from 0 to 1, and those of "
            f"{payload.name} do not ascend",
            "choose a method with ascending nodes, such as Ralston's of order 3",
        )
    with_value = _with_value(found)
    increments = map(_difference, with_value.A[1:], with_value.A)
    order = infinitesimal_order(found, payload.orders.effective)
    embedding = None
    if with_value.embedded is not None:
        last = _difference(with_value.embedded, with_value.A[-2])
        embedding = {"W": [last]}, min(payload.orders.embedded or 0, 2)
    return Slow(with_value.c, {"W": [((ZERO,) * with_value.stages, *increments)]}, order, embedding)


def _coupled(payload: Payload, coupling: Coupling) -> Slow:
    """The coupling of a file; a matrix is implicit if a row depends on the end of its own stage."""
    nothing = (ZERO,) * len(coupling.nodes)
    by_letter: dict[str, list[Rows]] = {}
    if coupling.matrices is None:
        message = f"the fast problems of {payload.name} begin between stages"
        raise CannotExport(message, "choose a coupling without α and γ")
    if coupling.restart:
        return _restarted(payload, coupling)
    _refuse_stages(payload.name, coupling.nodes, coupling.matrices)
    rows: dict[str, Sequence[Row]] = {}
    last = coupling.embedded
    for part, powers in enumerate(coupling.matrices):
        # row i leads from stage i to the next
        is_implicit = any(any(row[i + 1 :]) for rows in powers for i, row in enumerate(rows))
        letter = "G" if is_implicit else "W"
        if letter in by_letter:
            message = f"both slow parts of {payload.name} are {'im' if is_implicit else 'ex'}plicit"
            raise CannotExport(message, "MRIStep takes an explicit and an implicit one")
        rows[letter] = () if last is None else last.forcing[part]
        by_letter[letter] = _with_first_rows(powers, nothing, len(rows[letter]))
    matrices = {letter: by_letter[letter] for letter in "WG" if letter in by_letter}
    embedding = None if last is None else (rows, payload.orders.embedded or 0)
    return Slow(coupling.nodes, matrices, payload.orders.effective, embedding)


def _with_first_rows(powers: Sequence[Rows], nothing: Row, least: int) -> list[Rows]:
    """The matrices with a first row; at least as many as embedded rows have powers."""
    zeros = (nothing,) * len(nothing)
    return [*((nothing, *matrix) for matrix in powers), *[zeros] * (least - len(powers))]


def _restarted(payload: Payload, coupling: Coupling) -> Slow:
    """CannotExport if a fast problem has no length, or a stage needs a later one."""
    assert coupling.matrices is not None
    nodes = coupling.nodes
    if any(ball(c) <= 0 for c in nodes[1:]):
        message = f"a fast problem of {payload.name} has no length"
        raise CannotExport(message, "choose a coupling whose nodes after the first are positive")
    for powers, used in zip(coupling.matrices, (1, 2), strict=False):
        if any(any(row[i + used :]) for matrix in powers for i, row in enumerate(matrix)):
            cure = "choose one whose forcing uses the stages before, and gamma these and the stage"
            raise CannotExport(f"a stage of {payload.name} uses a later one", cure)
    nothing = (ZERO,) * len(nodes)
    rows = dict(zip("WG", embedded_rows(coupling).values(), strict=False))
    matrices = {
        letter: _with_first_rows(powers, nothing, len(rows.get(letter, ())))
        for letter, powers in zip("WG", coupling.matrices, strict=False)
    }
    embedding = None
    if coupling.embedded is not None:
        embedding = {x: rows[x] for x in matrices}, payload.orders.embedded or 0
    return Slow(nodes, matrices, payload.orders.effective, embedding, coupling.restart)


def _refuse_stages(name: str, nodes: Row, parts: Sequence[Sequence[Rows]]) -> None:
    """MRIStep refuses descending nodes, later stages, and implicit stages with a fast problem."""
    widths = [ball(combined((1, end), (-1, begin))) for begin, end in pairwise(nodes)]
    if any(width < 0 for width in widths):
        cure = "choose a coupling with ascending nodes"
        raise CannotExport(f"the nodes of {name} do not ascend", cure)
    for i, row in ((i, matrix[i]) for x in parts for matrix in x for i in range(len(widths))):
        if any(row[i + 2 :]):
            cure = "choose a coupling whose stages use those before them and themselves"
            raise CannotExport(f"a stage of {name} uses a later one", cure)
        if row[i + 1] and widths[i] > 0:
            message = f"a stage of {name} is implicit, and has a fast problem"
            cure = "choose a coupling with c of the stage before at every implicit stage"
            raise CannotExport(message, cure)


def _with_value(found: Table) -> Table:
    return found if found.is_fsal else with_last_stage(found)


def _difference(row: Row, before: Row) -> Row:
    return tuple(combined((1, x), (-1, y)) for x, y in zip(row, before, strict=True))


def infinitesimal_order(found: Table, order: int) -> int:
    """The order of the step with the fast equation solved exactly, at most 3.

    It is 3 if Σ_i (c_i − c_{i−1}) (e_i + e_{i−1})ᵀ A c = 1/3, the new value among the stages (Knoth
    and Wolke, Applied Numerical Mathematics 28, 1998).
    """
    if order < 3:
        return order
    with_value = _with_value(found)
    values = [sum(map(mul, row, with_value.c), start=ZERO) for row in with_value.A]
    pairs = zip(_difference(with_value.c[1:], with_value.c[:-1]), pairwise(values), strict=True)
    return 3 if sum((width * (x + y) for width, (x, y) in pairs), start=ZERO) == fmpq(1, 3) else 2


BRIDGES = (
    Bridge(
        name="sundials-mri",
        summary="C for MRIStep: slow methods, MIS and MRI couplings",
        kinds=("rk", "ark", "gark", "mri"),
        suffix=".c",
        stages="explicit",
        style=c_style("SUN_RCONST"),
        values=values,
    ),
)
