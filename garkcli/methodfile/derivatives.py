"""The form ``derivatives``: methods that use derivatives of f along the solution."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.constructions.derivatives import Derivatives, plan
from garkcli.errors import counted
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node
from garkcli.methodfile import description as d
from garkcli.methodfile import spelled_out
from garkcli.methodfile.numbers import NumbersReader, Row, Rows
from garkcli.methodfile.parameters import ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further

_FORM = "give {A: [[[], [1/2]], [[], [1/8]]], b: [[1, 0], [1/6, 1/3]]}: of f, then of f′f, …"
MOST = 9
_ARRAY = {"type": "array", "items": {"type": "array"}}


def _of_each(schema: g.Schema) -> g.ValueKind:
    return g.ValueKind(lambda: {"type": "array", "minItems": 1, "maxItems": MOST, "items": schema})


DERIVATIVES = g.mapping(
    g.Key(
        "A: [[[], [1/2]], [[], [1/8]]]",
        _of_each(_ARRAY),
        "A matrix for f, one for f′f, and so on, row by row; rows and matrices may end early, "
        "zeros follow.",
        is_needed=True,
    ),
    g.Key(
        "b: [[1, 0], [1/6, 1/3]]",
        _of_each({"type": "array"}),
        "The weights of each, one per stage.",
        is_needed=True,
    ),
    g.Key(
        "c: [0, 1/2]",
        ROW,
        "The nodes of time, one per stage; the row sums of the first matrix where left out.",
        also=("nodes",),
    ),
    g.Key(
        "embedded: [[1, 0], [1/2, 0]]",
        _of_each({"type": "array"}),
        "Embedded weights, in the shape of b.",
        also=("bhat",),
    ),
    form=_FORM,
)


class DerivativesText(d.OwnContent):
    """``A`` has matrices for f, f′f, …; ``c`` is None if it has the row sums of the first."""

    A: tuple[Rows, ...]
    b: Rows
    c: Row | None = None
    embedded: Rows | None = None

    def places(self) -> Iterator[d.Place]:
        yield from d.places_of(self.embedded or (), 0, "embedded")

    def made(self, values: Values, _: object) -> d.Made:
        c = None if self.c is None else values.vector(self.c)
        method = Derivatives(tuple(map(values.matrix, self.A)), values.matrix(self.b), c)
        embedded = None if self.embedded is None else values.matrix(self.embedded)
        order: int = values.once(("plan", id(self)), lambda: plan(method, embedded))
        further = Further()
        if embedded is not None:
            further = Further((method.at_points(embedded, order),))
        return d.Made(method.tableau(order), lambda: further)


def derivatives(at: NumbersReader, node: Node) -> DerivativesText | None:
    entries: g.ReadMapping | None = DERIVATIVES.read(at, node, "derivatives")
    if entries is None or not entries.is_right:
        return None
    before = len(at.source.faults)
    items = at.source.items(entries["A"], "A", _FORM)
    if not items:
        at.source.fault(entries["A"], "A is empty", _FORM, code="empty")
        return None
    if len(items) > MOST:
        message = f"A has {len(items)} matrices (limit {MOST})"
        at.source.fault(entries["A"], message, "give one for f, one for f′f, …", code="too-many")
        return None
    b = _weights(at, entries["b"], "b", len(items))
    stages = len(b[0]) if b else 0
    if not stages:
        return None
    A = tuple(_matrix(at, x, f"A, matrix {k}", stages) for k, x in enumerate(items, start=1))
    embedded = None
    rows = [("b", b)]
    if "embedded" in entries:
        embedded = _weights(at, entries["embedded"], "embedded", len(items))
        rows.append(("embedded", embedded))
    for name, weights in rows:
        for k, row in enumerate(weights, start=1):
            _one_each(at, entries[name], f"{name}, row {k}", row, stages)
    c: Row | None = entries.get("c")
    if c is not None:
        _one_each(at, entries.nodes["c"], "c", c, stages)
    if len(at.source.faults) > before:
        return None
    return DerivativesText(node, A, b, c, embedded)


def _weights(at: NumbersReader, node: Node, name: str, derivatives: int) -> Rows:
    """A row for each matrix."""
    rows = at.numbers.matrix(node, name)
    if len(rows) != derivatives:
        matrices = counted(derivatives, "matrix", "matrices")
        message = f"{name} has {counted(len(rows), 'row')} for {matrices}"
        cure = "give the weights of f, then those of f′f, as many rows as A has matrices"
        at.source.fault(node, message, cure, code="wrong-size")
    return rows


def _matrix(at: NumbersReader, node: Node, name: str, stages: int) -> Rows:
    rows = at.numbers.matrix(node, name) if at.source.items(node, name, _FORM) else ()
    longest = max([len(rows), *map(len, rows)], default=0)
    if longest > stages:
        message = (
            f"{name} has {counted(longest, 'entry', 'entries')} for {counted(stages, 'stage')}"
        )
        at.source.fault(node, message, "b has an entry per stage", code="wrong-size")
    zero = at.numbers.written("0", node, name)
    filled = [*rows, *[()] * (stages - len(rows))]
    return tuple(row + (zero,) * (stages - len(row)) for row in filled)


def _one_each(at: NumbersReader, node: Node, name: str, row: Row, stages: int) -> None:
    spelled_out.one_each(at, node, name, row, "entry", "stage", stages, "give one per stage")
