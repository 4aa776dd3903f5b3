"""The arrays of Nyström, nonlinearly partitioned and multiderivative methods by their papers'
names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal, TypeAlias

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Kind, OwnArrays, Payload
from garkcli.constructions.nprk import arrays_of, is_nprk, matrix_of
from garkcli.constructions.nystrom import POSITIONS, VELOCITIES, Nystrom, is_nystrom
from garkcli.tableau.embedded import Further
from garkcli.tableau.tableau import Tableau

OwnKind: TypeAlias = Literal["nystrom", "nprk", "derivatives"]
Nested: TypeAlias = tuple[Any, ...]
"""Entries in nested tuples, one level per dimension."""
KINDS: Mapping[Kind, str] = {
    "nystrom": "Nyström methods",
    "nprk": "nonlinearly partitioned methods",
    "derivatives": "multiderivative methods",
}


def own_kind(tableau: Tableau) -> OwnKind | None:
    if tableau.uses_derivatives:
        return "derivatives"
    if tableau.has_fields_alone:
        return None
    if is_nystrom(tableau):
        return "nystrom"
    return "nprk" if is_nprk(tableau) else None


def own_arrays(kind: OwnKind, tableau: Tableau, further: Further) -> OwnArrays:
    make = {"nystrom": _of_nystrom, "nprk": _of_nprk, "derivatives": _of_derivatives}[kind]
    return {name: rows for name, rows in make(tableau, further) if rows is not None}


_Named: TypeAlias = Iterator[tuple[str, Nested | None]]


def _of_nystrom(tableau: Tableau, further: Further) -> _Named:
    method = Nystrom.of(tableau)
    yield from (("Abar", method.Abar), ("A", method.A), ("c", method.c))
    yield from (("bbar", method.bbar), ("b", method.b))
    embedded, dense = further.embedded, further.dense
    if embedded is not None:
        yield from (("embedded_bbar", embedded[POSITIONS]), ("embedded", embedded[VELOCITIES]))
    if dense is not None:
        yield from (("dense_bbar", dense.weights[POSITIONS]), ("dense", dense.weights[VELOCITIES]))


def _of_nprk(tableau: Tableau, further: Further) -> _Named:
    a, c = arrays_of(tableau)
    yield from (("a", a), ("c", c), ("b", matrix_of(tableau.colours[0].b, tableau)))
    if further.embedded is not None:
        yield "embedded", matrix_of(further.embedded[0], tableau)


def _of_derivatives(tableau: Tableau, further: Further) -> _Named:
    from garkcli.constructions.derivatives import Derivatives, embedded_of  # few need it

    method = Derivatives.of(tableau)
    yield from (("A", method.A), ("c", method.nodes), ("b", method.b))
    if further.embedded is not None:
        yield "embedded", embedded_of(further.embedded, tableau)


def stepped_values(payload: Payload) -> Mapping[str, Any]:
    """CannotExport if a stage needs a later one, or itself with derivatives of more than F."""
    kind, arrays, name = own_kind(payload.tableau), payload.own, payload.name
    assert kind is not None
    assert arrays is not None
    if kind == "nprk":
        latest = [*map(_latest, arrays["a"])]
        message = f"a stage of {name} needs a later one, and programs solve one at a time"
        is_computed = all(last <= i for i, last in enumerate(latest))
    else:
        latest = []
        rows = [arrays[x] for x in ("Abar", "A") if x in arrays]
        matrices = rows if kind == "nystrom" else arrays["A"]
        message = f"a stage of {name} needs itself or a later one, and the step is explicit"
        is_computed = not any(any(row[i:]) for x in matrices for i, row in enumerate(x))
    if not is_computed:
        raise CannotExport(message, f"--to json has all {KINDS[kind]}")
    return {
        "own": arrays,
        "depths": {key: _depth(x) for key, x in arrays.items()},
        "is_implicit": any(last == i for i, last in enumerate(latest)),
    }


def _latest(matrix: Nested) -> int:
    """The last stage that is an argument with a nonzero weight; −1 if there is none."""
    places = [(j, k) for j, row in enumerate(matrix) for k, x in enumerate(row) if x]
    return max(map(max, places), default=-1)


def _depth(array: object) -> int:
    return 1 + _depth(array[0]) if isinstance(array, tuple) else 0
