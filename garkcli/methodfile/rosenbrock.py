"""The form ``rosenbrock``: as in papers, or transformed as in programs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Sized
from functools import partial
from itertools import chain

from garkcli.constructions.rosenbrock import Rosenbrock, transformed, transformed_weights
from garkcli.exact.matrix import Matrix
from garkcli.frozen import replace
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node, ScalarNode, is_null
from garkcli.methodfile import description, spelled_out
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import Coefficient, NumbersReader, Row, Rows
from garkcli.methodfile.parameters import MATRIX, NUMBER, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further

_FORM = (
    "give {alpha: [[0, 0], [1, 0]], gamma: [[1/2, 0], [-1, 1/2]], b: [1/2, 1/2]}, "
    "or {transformed: {A: …, C: …, gamma: …, m: …}}"
)
_FORM_OF_TRANSFORMED = (
    "give {A: [[0, 0], [2, 0]], C: [[0, 0], [-4, 0]], gamma: 1/2, m: [3, 1]}: "
    "A = α Γ⁻¹, C = diag(1/γ) − Γ⁻¹, m = b Γ⁻¹"
)
_FORM_OF_BLOCKS = (
    "give {alpha: [[…, null], [null, …]], gamma: [[…, null], [null, …]], b: [[1/2, 1/2], [1]]}: a "
    "row of matrices, and one of weights, for each colour"
)
_DENSE = g.defined("dense")
_C = g.Key(
    "c: [0, 1]",
    ROW,
    "Where f(t, y) is evaluated, one per stage; the row sums of α where left out.",
    also=("nodes", "a", "ros_alpha"),
)
_D = g.Key(
    "d: [1/2, -1/2]",
    ROW,
    "The weights of ∂f/∂t, one per stage; the row sums of γ where left out.",
    also=("gamma_i", "ros_gamma"),
)
TRANSFORMED = g.mapping(
    g.Key("A: [[0, 0], [2, 0]]", MATRIX, "The matrix α Γ⁻¹, row by row.", is_needed=True),
    g.Key(
        "C: [[0, 0], [-4, 0]]",
        MATRIX,
        "The matrix diag(1/γ) − Γ⁻¹, row by row; its diagonal is zero.",
        is_needed=True,
    ),
    g.Key(
        "gamma: 1/2",
        g.ValueKind(lambda: {"anyOf": [NUMBER.schema(), ROW.schema()]}),
        "The diagonal of Γ: one number, or one per stage.",
        is_needed=True,
    ),
    g.Key("m: [3, 1]", ROW, "The weights b Γ⁻¹, one per stage.", is_needed=True),
    g.Key(
        "e: [1, 1]",
        ROW,
        "Weights of the error estimate, one per stage: m minus the embedded weights.",
    ),
    _C,
    _D,
    g.Key(
        "dense: {degree: 1, weights: [[3], [1]]}",
        _DENSE,
        "Dense output at the stages of the transformed method.",
    ),
    form=_FORM_OF_TRANSFORMED,
)
_OF_COLOURS = g.ValueKind(lambda: spelled_out.rows_of(ROW.schema()))
_BLOCK = {"anyOf": [MATRIX.schema(), {"type": "null"}]}
_BLOCKS = g.ValueKind(lambda: spelled_out.rows_of(spelled_out.rows_of(_BLOCK)))
BLOCKS = g.mapping(
    g.Key(
        "alpha: [[[[], [1]], null], [[[], [1]], [[], [1]]]]",
        _BLOCKS,
        "The matrices α^{l,m}, a row of them for each colour l; null is zero.",
        is_needed=True,
    ),
    g.Key(
        "gamma: [[[[1], [-2, 1]], null], [null, null]]",
        _BLOCKS,
        "The matrices γ^{l,m} beside the Jacobian of f^{l}, in the same way.",
        is_needed=True,
    ),
    g.Key(
        "b: [[1/2, 1/2], [1/2, 1/2]]", _OF_COLOURS, "The weights of each colour.", is_needed=True
    ),
    g.Key(
        "c: [[0, 1], [0, 1]]",
        _OF_COLOURS,
        "Where f^{l}(t, y) is evaluated; the row sums of α^{l,l} where left out.",
    ),
    g.Key(
        "d: [[1, -1], [0, 0]]",
        _OF_COLOURS,
        "The weights of ∂f^{l}/∂t; the row sums of γ^{l,l} where left out.",
    ),
    g.Key("embedded: [[1, 0], [1, 0]]", _OF_COLOURS, "Embedded weights of each colour."),
    form=_FORM_OF_BLOCKS,
)
ROSENBROCK = g.mapping(
    g.Key(
        "alpha: [[0, 0], [1, 0]]",
        MATRIX,
        "The matrix α of the arguments of f, row by row; rows may end before the diagonal.",
    ),
    g.Key(
        "gamma: [[1/2, 0], [-1, 1/2]]",
        MATRIX,
        "The matrix γ beside the Jacobian, with its diagonal, row by row.",
    ),
    g.Key("b: [1/2, 1/2]", ROW, "The weights, one per stage."),
    _C,
    _D,
    g.Key(
        "embedded: [1, 0]",
        g.ValueKind(ROW.schema),
        "Embedded weights, one per stage.",
        also=("bhat", "b_hat", "bh", "b2"),
    ),
    g.Key(
        "dense: {degree: 1, weights: [[1/2], [1/2]]}",
        _DENSE,
        "Dense output: weights polynomial in θ without constant terms.",
    ),
    g.Key(
        "transformed: {A: [[0, 0], [2, 0]], C: [[0, 0], [-4, 0]], gamma: 1/2, m: [3, 1]}",
        TRANSFORMED,
        "The method as programs store it, in place of alpha, gamma and b.",
    ),
    g.Key(
        "blocks: {alpha: [[[[1]]]], gamma: [[[[1]]]], b: [[1]]}",
        BLOCKS,
        "A method of several colours, each with its Jacobian (GARK-ROW), in place of alpha, gamma "
        "and b.",
    ),
    form=_FORM,
    rules=(
        g.Ways(
            "the coefficients are",
            (
                g.Together(("alpha", "gamma", "b"), ("c", "d", "embedded", "dense")),
                "transformed",
                "blocks",
            ),
            "no coefficients",
            _FORM,
        ),
    ),
)


class RosenbrockText(description.OwnContent):
    alpha: tuple[tuple[Rows, ...], ...]
    gamma: tuple[tuple[Rows, ...], ...]
    b: Rows
    c: Rows | None = None
    d: Rows | None = None
    diagonal: Row | None = None
    error: Row | None = None
    beside: tuple[description.FurtherText, ...] = (description.NOTHING_FURTHER,)

    @property
    def names(self) -> Sequence[str]:
        return [""] * len(self.b) if len(self.b) > 1 else ()

    def places(self) -> Iterator[description.Place]:
        """The numbers; those of one colour are all alike."""
        yield from description.places_of([self.error or ()], 0, "embedded")
        for l in range(len(self.b) if len(self.b) > 1 else 0):
            for of_colours in (self.alpha, self.gamma):
                yield from description.places_of(chain.from_iterable(of_colours[l]), l)
            others = (x[l] for x in (self.c, self.d) if x is not None)
            yield from description.places_of([self.b[l], *others], l)
        yield from super().places()

    def made(self, values: Values, _: object) -> description.Made:
        matrix, vector = values.matrix, values.vector
        alpha, gamma = (
            tuple(tuple(map(matrix, row)) for row in blocks) for blocks in (self.alpha, self.gamma)
        )
        finish = None
        if self.diagonal is None:
            rosenbrock_method = Rosenbrock(alpha, gamma, matrix(self.b))
        else:
            b = vector(self.b[0])
            rosenbrock_method = transformed(alpha[0][0], gamma[0][0], vector(self.diagonal), b)
            finish = partial(
                self._finished,
                values,
                rosenbrock_method.tableau.size,
                rosenbrock_method.gamma[0][0],
            )
        c, d_ = (None if x is None else matrix(x) for x in (self.c, self.d))
        return description.Made(replace(rosenbrock_method, c=c, d=d_).tableau, finish=finish)

    def _finished(self, values: Values, size: int, gamma: Matrix, further: Further) -> Further:
        if self.error is not None:
            pairs = zip(values.vector(self.b[0]), values.vector(self.error), strict=True)
            row = tuple(m - e for m, e in pairs)
            further = Further((row,) * size, further.dense)
        return transformed_weights(further, gamma)


def rosenbrock(at: NumbersReader, node: Node) -> RosenbrockText | None:
    entries: g.ReadMapping | None = ROSENBROCK.read(at, node, "rosenbrock")
    if entries is None or not entries.is_right:
        return None
    if "blocks" in entries:
        return _several(at, node, entries["blocks"])
    if "transformed" in entries:
        stored: g.ReadMapping = entries["transformed"]
        return _text(at, node, stored, ("A", "C", "m"), stored["C"])
    return _text(at, node, entries, ("alpha", "gamma", "b"), entries["gamma"])


def _text(
    at: NumbersReader, node: Node, entries: g.ReadMapping, names: tuple[str, str, str], gamma: Rows
) -> RosenbrockText | None:
    name_of_alpha, name_of_gamma, name_of_b = names
    b: Row = entries[name_of_b]
    stages = len(b)
    if not stages:
        return None
    why = f"{name_of_b} has {spelled_out.entries_of(stages)}"
    matrices = [
        at.numbers.fitted(rows, entries.nodes[name], name, (stages, stages), why)
        for name, rows in ((name_of_alpha, entries[name_of_alpha]), (name_of_gamma, gamma))
    ]
    rows = {
        key: _row(at, entries, key, stages) if key in entries else None for key in ("c", "d", "e")
    }
    diagonal = None
    if name_of_gamma == "C":
        diagonal = _diagonal(at, entries.nodes["gamma"], stages)
    further = spelled_out.further_of_method(at, entries.nodes, stages)
    alpha, full = (((rows,),) for rows in matrices)
    c, d_ = ((row,) if row is not None else None for row in (rows["c"], rows["d"]))
    return RosenbrockText(node, alpha, full, (b,), c, d_, diagonal, rows["e"], (further,))


def _several(at: NumbersReader, node: Node, entries: g.ReadMapping) -> RosenbrockText | None:
    before = len(at.source.faults)

    def rows(key: str) -> Rows | None:
        if key not in entries:
            return None
        items = spelled_out.colours_in(at, entries[key], key) or []
        return tuple(at.numbers.row(x, d.of_colour(key, l)) for l, x in enumerate(items))

    b = rows("b") or ()
    N = len(b)
    if not N or not all(b):
        return None

    def is_one_each(place: Node, name: str, items: Sized, noun: str) -> bool:
        cure = "give one per colour"
        return spelled_out.one_each(at, place, name, items, noun, "colour", N, cure)

    def blocks(key: str) -> tuple[tuple[Rows, ...], ...]:
        lines = at.source.items(entries[key], key, _FORM_OF_BLOCKS)
        if not is_one_each(entries[key], key, lines, "row"):
            return ()
        return tuple(tuple(line(key, l, x)) for l, x in enumerate(lines))

    def line(key: str, l: int, place: Node) -> Iterator[Rows]:
        items = at.source.items(place, f"{key}, row {l + 1}", _FORM_OF_BLOCKS)
        if not is_one_each(place, f"{key}, row {l + 1}", items, "block"):
            return
        for m, item in enumerate(items):
            name, shape = f"{key}^{{{l + 1},{m + 1}}}", (len(b[l]), len(b[m]))
            if is_null(item):
                zero = at.numbers.written("0", item, name)
                yield ((zero,) * shape[1],) * shape[0]
            else:
                why = f"b^{{{l + 1}}} has {spelled_out.entries_of(shape[0])}"
                yield at.numbers.fitted(at.numbers.matrix(item, name), item, name, shape, why)

    def beside(key: str) -> Rows | None:
        given = rows(key)
        if given is not None and is_one_each(entries[key], key, given, "row"):
            for l, (row, own) in enumerate(zip(given, b, strict=True)):
                name, cure = d.of_colour(key, l), "give one per stage"
                spelled_out.one_each(at, entries[key], name, row, "entry", "stage", len(own), cure)
        return given

    alpha, gamma = blocks("alpha"), blocks("gamma")
    c, d_, embedded = (beside(key) for key in ("c", "d", "embedded"))
    if len(at.source.faults) > before:
        return None
    further = tuple(map(d.FurtherText, embedded or (None,) * N))
    return RosenbrockText(node, alpha, gamma, b, c, d_, beside=further)


def _row(at: NumbersReader, entries: g.ReadMapping, name: str, stages: int) -> Row:
    row: Row = entries[name]
    cure = "give one per stage, or leave it out"
    spelled_out.one_each(at, entries.nodes[name], name, row, "entry", "stage", stages, cure)
    return row


def _diagonal(at: NumbersReader, node: Node, stages: int) -> tuple[Coefficient, ...]:
    row = at.numbers.row(node, "gamma")
    if isinstance(node, ScalarNode):
        return row * stages
    spelled_out.one_each(
        at, node, "gamma", row, "entry", "stage", stages, "give one number, or one per stage"
    )
    return row
