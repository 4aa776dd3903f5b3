"""The forms ``ark`` and ``prk``, whose colours share stages."""

from __future__ import annotations

from garkcli.errors import counted
from garkcli.frozen import replace
from garkcli.grammar.keys import Key, ReadMapping, ValueKind, defined, mapping
from garkcli.grammar.nodes import Node, SequenceNode, key_nodes
from garkcli.methodfile import description as d
from garkcli.methodfile import spelled_out
from garkcli.methodfile.numbers import NumbersReader, Rows

_FORM_OF_PRK = "give q: {A, b} and p: {A, b}"
_ROW = defined("row").schema()
_ROWS = ValueKind(lambda: {"anyOf": [_ROW, {"type": "array", "items": _ROW}]})
ARK = spelled_out.with_coefficients(
    Key(
        "A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]]",
        ValueKind(lambda: spelled_out.rows_of(defined("matrix").schema())),
        "One matrix per colour, all of the same size.",
    ),
    Key("b: [0, 1]", _ROWS, "The weights: one row per colour, or a single shared row."),
    Key(
        "c: [0, 1]",
        defined("row"),
        "The nodes, which all colours share; the row sums of the first matrix where left out.",
    ),
    Key("embedded: [1, 0]", _ROWS, "Embedded weights: one row per colour, or a single shared row."),
    Key(
        "dense: {degree: 1, weights: [[[0], [1]], [[0], [1]]]}",
        defined("dense"),
        "Dense output: a block of polynomials a colour.",
    ),
    form=spelled_out.EXAMPLE,
)
PRK = mapping(
    Key(
        "q: {A: [[0], [1]], b: [1]}",
        defined("butcher"),
        "The tableau of the positions: A has a row for each node at which the force is taken and "
        "a column for each velocity, b weighs the velocities.",
        is_needed=True,
    ),
    Key(
        "p: {A: [[1/2, 0]], b: [1/2, 1/2]}",
        defined("butcher"),
        "The tableau of the momenta: A has a row for each velocity and a column for each force, "
        "b weighs the forces.",
        is_needed=True,
    ),
    form=_FORM_OF_PRK,
)


def ark(at: NumbersReader, node: Node) -> d.ArkText | None:
    entries: ReadMapping | None = ARK.read(at, node, "ark")
    if entries is None or not {"A", "b"} <= entries.keys():
        return None
    matrices = _matrices(at, entries["A"])
    if matrices is None:
        return None
    colours = len(matrices)
    items = at.source.items(entries["b"], "b")
    if any(isinstance(item, SequenceNode) for item in items):
        b = tuple(at.numbers.row(item, d.of_colour("b", m)) for m, item in enumerate(items))
    else:  # the same row for all
        b = (at.numbers.row(entries["b"], "b"),) * colours
    c = at.numbers.row(entries["c"], "c") if "c" in entries else None
    cure = "give a row per colour, or a single shared row"
    if not spelled_out.one_each(at, entries["b"], "b", b, "row", "colour", colours, cure):
        return None
    if not matrices or not all(matrices) or not all(b):
        return None
    stages = len(matrices[0])
    why = "the colours of an ark share stages"
    A = tuple(
        at.numbers.fitted(rows, item, d.of_colour("A", m), (stages, stages), why)
        for m, (rows, item) in enumerate(zip(matrices, entries["A"].value, strict=True))
    )
    is_shared = all(row is b[0] for row in b)
    for m, row in enumerate(b[:1] if is_shared else b):
        name = "b" if is_shared else d.of_colour("b", m)
        spelled_out.one_each(
            at, entries["b"], name, row, "entry", "stage", stages, "give a weight per stage"
        )
    if c is not None:
        spelled_out.nodes_fit(at, entries["c"], "c", c, stages)
    return d.ArkText(
        A, b, c, spelled_out.further_of_colours(at, entries, [stages] * colours, is_shared=True)
    )


def _matrices(at: NumbersReader, node: Node) -> list[Rows] | None:
    items = spelled_out.colours_in(at, node, "A")
    if items and spelled_out.depth_of_lists(node) == 2:
        message = "A is one matrix, and an ark has one per colour"
        cure = "write A: [AE, AI]; or tableau: for one colour"
        at.source.fault(node, message, cure, code="wrong-size")
        return None
    if items is None:
        return None
    return [at.numbers.matrix(item, d.of_colour("A", m)) for m, item in enumerate(items)]


def prk(at: NumbersReader, node: Node, structure: d.Structure) -> d.PrkText | None:
    """Reads the form ``prk``; its blocks are rectangular unless the structure is general."""
    entries: ReadMapping | None = PRK.read(at, node, "prk")
    if entries is None or len(entries) < 2:
        return None
    q, p = (_part(at, entries[part], part) for part in "qp")
    if q is None or p is None:
        return None
    # the velocity stages belong to the weights of q, the force stages to those of p
    s_v, s_f = len(q.b), len(p.b)
    if structure == "general" and s_v != s_f:
        message = f"prk: q has {counted(s_v, 'weight')} and p has {s_f}"
        cure = "a general problem needs one set of stages; or structure: separable"
        at.source.fault(node, message, cure, code="wrong-size")
        return None
    why = f"q.b has {spelled_out.entries_of(s_v)} and p.b has {s_f}"
    spelled_out.refuse_partial(at, (q.further, p.further), ("q", "p"), node)
    return d.PrkText(_fitted(at, q, "q", (s_f, s_v), why), _fitted(at, p, "p", (s_v, s_f), why))


def _part(at: NumbersReader, node: Node, part: str) -> d.ButcherText | None:
    entries: ReadMapping | None = spelled_out.BUTCHER.read(at, node, f"prk, {part}")
    if entries is None or not {"A", "b"} <= entries.keys():
        return None
    A = at.numbers.matrix(entries["A"], f"{part}.A")
    b = at.numbers.row(entries["b"], f"{part}.b")
    c = at.numbers.row(entries["c"], f"{part}.c") if "c" in entries else None
    if not A or not b:
        return None
    beside = spelled_out.further_of_method(
        at, entries, len(b), spelled_out.names_beside(f"{part}.b")
    )
    return d.ButcherText(node, entries.get("name", ""), A, b, c, beside)


def _fitted(
    at: NumbersReader, text: d.ButcherText, part: str, shape: tuple[int, int], why: str
) -> d.ButcherText:
    keys = key_nodes(text.node)
    A = at.numbers.fitted(text.A, keys.get("A", text.node), f"{part}.A", shape, why)
    if text.c is not None:
        place, cure = keys.get("c", text.node), "give one of each"
        spelled_out.one_each(at, place, f"{part}.c", text.c, "entry", "node", shape[0], cure)
    return replace(text, A=A)
