"""The form ``nystrom``: Nyström methods for q″ = g(q, q′), or g(q)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from garkcli.constructions.nystrom import dense_of, weights_of
from garkcli.constructions.nystrom import nystrom as method
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node
from garkcli.methodfile import description as d
from garkcli.methodfile import spelled_out
from garkcli.methodfile.numbers import NumbersReader, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further
from garkcli.tableau.tableau import butcher

_FORM = "give {Abar: [[], [1/2]], c: [0, 1], bbar: [1/2, 0], b: [1/2, 1/2]}, with A for g(q, q′)"
_FORM_OF_EMBEDDED = "give {bbar: [1/2, 0], b: [1, 0]}, or one of them"
_FORM_OF_DENSE = (
    "write dense: {degree: 2, bbar: [[0, 1/2], [0, 0]], b: [[1, -1/2], [0, 1/2]]}, "
    "a row per stage: the coefficients of θ, θ², …"
)
_OF_STAGES = "give one per stage"
EMBEDDED = g.mapping(
    g.Key(
        "bbar: [1/2, 0]",
        ROW,
        "Embedded weights of the step in q, one per stage; bbar itself where they are left out.",
        also=("b_bar", "Bbar"),
    ),
    g.Key(
        "b: [1, 0]",
        ROW,
        "Embedded weights of the step in q′, one per stage; b itself where they are left out.",
    ),
    form=_FORM_OF_EMBEDDED,
)
_POLYNOMIALS = g.ValueKind(lambda: {"type": "array", "minItems": 1})
DENSE = g.mapping(
    g.Key(
        "degree: 2",
        g.count(1, spelled_out.MAX_DEGREE),
        "The degree of the polynomials in θ.",
        is_needed=True,
    ),
    g.Key(
        "bbar: [[0, 1/2], [0, 0]]",
        _POLYNOMIALS,
        "A row per stage with the coefficients of θ, θ², … in the weight of q.",
        is_needed=True,
        also=("b_bar", "Bbar"),
    ),
    g.Key(
        "b: [[1, -1/2], [0, 1/2]]",
        _POLYNOMIALS,
        "The same in the weight of q′; where they are left out, q′ is the slope of q.",
    ),
    form=_FORM_OF_DENSE,
)
NYSTROM = g.mapping(
    g.Key(
        "Abar: [[], [1/2]]",
        MATRIX,
        "The matrix Ā through which positions see g, row by row; rows may end before the diagonal.",
        is_needed=True,
        also=("A_bar", "abar", "a_bar"),
    ),
    g.Key(
        "A: [[], [1]]",
        MATRIX,
        "The matrix through which velocities see g, row by row; left out where g depends on q "
        "alone.",
    ),
    g.Key(
        "c: [0, 1]",
        ROW,
        "How much of h q′ is in the position of each stage, and where time is; the row sums of A "
        "where it is left out.",
        also=("nodes",),
    ),
    g.Key(
        "bbar: [1/2, 0]",
        ROW,
        "The weights of the step in q, one per stage.",
        is_needed=True,
        also=("b_bar", "Bbar"),
    ),
    g.Key("b: [1/2, 1/2]", ROW, "The weights of the step in q′, one per stage.", is_needed=True),
    g.Key(
        "embedded: {bbar: [1/2, 0], b: [1, 0]}",
        EMBEDDED,
        "Embedded weights of both steps, or of one of them.",
        also=("bhat", "b_hat", "bh"),
    ),
    g.Key(
        "dense: {degree: 2, bbar: [[0, 1/2], [0, 0]], b: [[1, -1/2], [0, 1/2]]}",
        DENSE,
        "Dense output of both steps: weights polynomial in θ without constant terms.",
        page="docs/method-file.md#nystrom-nyström-methods",
    ),
    form=_FORM,
    rules=(
        g.Ways(
            "the nodes are",
            ("A", "c"),
            "no nodes",
            "give c, how much of h q′ is in the position of each stage",
            is_one=False,
        ),
    ),
)


class NystromText(d.OwnContent):
    """``A`` is None if g depends on q only, ``c`` for the row sums of A. ``embedded`` has weights
    in q and in q′, None for those of the method; ``dense`` polynomials, in q′ None for slopes of
    those in q.
    """

    Abar: Rows
    A: Rows | None
    c: Row | None
    bbar: Row
    b: Row
    embedded: tuple[Row | None, Row | None] | None = None
    dense: tuple[Rows, Rows | None] | None = None

    @property
    def beside(self) -> tuple[d.FurtherText, ...]:
        if self.embedded is None and self.dense is None:
            return ()
        embedded, dense = self.embedded, self.dense or (None, None)
        return tuple(
            d.FurtherText(None if embedded is None else embedded[k] or own, dense[k])
            for k, own in enumerate((self.bbar, self.b))
        )

    def places(self) -> Iterator[d.Place]:
        for row in self.embedded or ():
            yield from d.places_of([row or ()], 0, "embedded")
        for polynomials in self.dense or ():
            yield from d.places_of(polynomials or (), 0, "dense")

    def made(self, values: Values, _: object) -> d.Made:
        matrix, vector = values.matrix, values.vector
        A = None if self.A is None else matrix(self.A)
        c = vector(self.c or ()) if A is None or self.c else butcher(A, vector(self.b)).c
        nystrom_method = method(matrix(self.Abar), A, c, vector(self.bbar), vector(self.b))
        return d.Made(nystrom_method.tableau, partial(self._further, values))

    def _further(self, values: Values) -> Further:
        embedded = dense = None
        if not self.beside:
            return Further()
        of_q, of_v = self.beside
        if of_q.embedded is not None and of_v.embedded is not None:
            embedded = weights_of(values.vector(of_q.embedded), values.vector(of_v.embedded))
        if of_q.dense is not None:
            b = None if of_v.dense is None else values.matrix(of_v.dense)
            dense = dense_of(values.matrix(of_q.dense), b)
        return Further(embedded, dense)


def nystrom(at: NumbersReader, node: Node) -> NystromText | None:
    fields: g.ReadMapping | None = NYSTROM.read(at, node, "nystrom")
    if fields is None or not fields.is_right or not fields["b"]:
        return None
    b: Row = fields["b"]
    stages = len(b)
    why = f"b has {spelled_out.entries_of(stages)}"

    def matrix(key: str) -> Rows | None:
        if key not in fields:
            return None
        return at.numbers.fitted(fields[key], fields.nodes[key], key, (stages, stages), why)

    def row(entries: g.ReadMapping, key: str, name: str) -> Row | None:
        if key not in entries:
            return None
        given: Row = entries[key]
        place = entries.nodes[key]
        spelled_out.one_each(at, place, name, given, "entry", "stage", stages, _OF_STAGES)
        return given

    Abar = matrix("Abar")
    bbar = row(fields, "bbar", "bbar")
    if not Abar or not bbar:
        return None
    embedded = None
    if "embedded" in fields:
        inside: g.ReadMapping = fields["embedded"]
        embedded = row(inside, "bbar", "embedded, bbar"), row(inside, "b", "embedded, b")
        if embedded == (None, None):
            at.source.fault(inside.node, "embedded is empty", _FORM_OF_EMBEDDED, code="empty")
    dense = _dense(at, fields["dense"], stages) if "dense" in fields else None
    return NystromText(node, Abar, matrix("A"), row(fields, "c", "c"), bbar, b, embedded, dense)


def _dense(
    at: NumbersReader, entries: g.ReadMapping, stages: int
) -> tuple[Rows, Rows | None] | None:
    def rows(key: str) -> Rows | None:
        node, where = entries.nodes[key], f"dense, {key}"
        return spelled_out.polynomials(at, node, where, stages, entries["degree"])

    if not {"degree", "bbar"} <= entries.keys():
        return None
    bbar = rows("bbar")
    b = rows("b") if "b" in entries else None
    return None if bbar is None else (bbar, b)
