"""The form ``nprk``: nonlinearly partitioned methods for ẏ = F(y, y)."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.constructions.nprk import nprk as method
from garkcli.errors import counted
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import NumbersReader, Rows
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further

_FORM = "give {a: [[], [[], [1]]], b: [[], [1]]}: a matrix for each stage, and one of weights"
_MATRIX = g.ValueKind(lambda: {"type": "array", "items": {"type": "array"}})
NPRK = g.mapping(
    g.Key(
        "a: [[], [[], [1]]]",
        g.ValueKind(lambda: {"type": "array", "minItems": 1, "items": _MATRIX.schema()}),
        "The numbers a_ijk: for each stage i a matrix, row j for the first argument of F, column k "
        "for the second; rows and matrices may end early, zeros follow.",
        is_needed=True,
    ),
    g.Key("b: [[], [1]]", _MATRIX, "The weights b_jk, in the same way.", is_needed=True),
    g.Key("embedded: [[1]]", _MATRIX, "Embedded weights, in the same way.", also=("bhat",)),
    form=_FORM,
)


class NprkText(d.OwnContent):
    """``a`` has a matrix for each stage; rows and matrices may end early, followed by zeros."""

    a: tuple[Rows, ...]
    b: Rows
    embedded: Rows | None = None

    def places(self) -> Iterator[d.Place]:
        yield from d.places_of(self.embedded or (), 0, "embedded")

    def made(self, values: Values, _: object) -> d.Made:
        matrix = values.matrix
        embedded = None if self.embedded is None else matrix(self.embedded)
        tableau, row = method([*map(matrix, self.a)], matrix(self.b), embedded)
        further = Further() if row is None else Further((row,) * tableau.size)
        return d.Made(tableau, lambda: further)


def nprk(at: NumbersReader, node: Node) -> NprkText | None:
    entries: g.ReadMapping | None = NPRK.read(at, node, "nprk")
    if entries is None or not entries.is_right:
        return None
    stages = at.source.items(entries["a"], "a", _FORM)
    a = [_matrix(at, x, f"a, stage {i}", len(stages)) for i, x in enumerate(stages, start=1)]
    b = _matrix(at, entries["b"], "b", len(stages))
    embedded = None
    if "embedded" in entries:
        embedded = _matrix(at, entries["embedded"], "embedded", len(stages))
    return NprkText(node, tuple(a), b, embedded)


def _matrix(at: NumbersReader, node: Node, where: str, stages: int) -> Rows:
    items = at.source.items(node, where, _FORM)
    rows = at.numbers.matrix(node, where) if items else ()
    longest = max([len(rows), *map(len, rows)], default=0)
    if longest > stages:
        message = (
            f"{where} has {counted(longest, 'entry', 'entries')} for {counted(stages, 'stage')}"
        )
        at.source.fault(node, message, "a has a matrix for each stage", code="wrong-size")
    return rows
