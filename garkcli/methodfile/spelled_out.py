"""Butcher tableaus, the form ``tableau``, and the weights beside b: embedded, dense, predictor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Sized
from typing import TypeAlias

from garkcli.errors import counted
from garkcli.frozen import replace
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode, is_null
from garkcli.grammar.source import Entries, Home
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import UNKNOWN, NumbersReader, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW

Weights: TypeAlias = tuple[Row, ...]
Names: TypeAlias = tuple[str, str, str]
MAX_DEGREE = 60
"""The largest degree of dense output; its order is no larger."""
FORM_OF_DENSE = (
    "write dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}, "
    "a row per stage: the coefficients of θ, θ², …"
)
DENSE = g.mapping(
    g.Key(
        "degree: 2", g.count(1, MAX_DEGREE), "The degree of the polynomials in θ.", is_needed=True
    ),
    g.Key(
        "weights: [[1, -1/2], [0, 1/2]]",
        g.ValueKind(lambda: {"type": "array", "minItems": 1}),
        "A row per stage with the coefficients of θ, θ², …; of several colours a block for each.",
        is_needed=True,
    ),
    form=FORM_OF_DENSE,
)
MAX_POWERS = 10
"""Most matrices of a predictor, one for each power of r."""
PREDICTOR = g.mapping(
    g.Key(
        "old: [[], [-1/2, 3/2]]",
        g.ValueKind(lambda: {"type": "array", "minItems": 1}),
        "The weights of the slopes of the last step, row by row; or a matrix each for 1, r, r², …, "
        "with the ratio r of this step size to the last one.",
    ),
    g.Key(
        "new: [[], [1/2]]",
        g.ValueKind(lambda: {"type": "array", "minItems": 1}),
        "The weights of the slopes of this step, of earlier stages alone, in the same way.",
    ),
    form="write predictor: {old: [[], [-1/2, 3/2]]}, a row per stage",
    rules=(g.Ways("slopes are", ("old", "new"), "no weights", "give old or new", is_one=False),),
)
_SAID_BY_B = dict.fromkeys(("stages", "s"), "the number of entries in b says it")
EXAMPLE = "write A and b, and c if it is not the row sums: {A: [[0, 0], [1/2, 0]], b: [0, 1]}"
_LEVELS = (
    "a method of one colour has A: [[…], …] and b: […], one of two A: [[A11, A12], [A21, A22]]"
)


_PAGE = "docs/method-file.md#embedded-and-dense-further-weights"


def _all_of(*kinds: g.Schema) -> g.ValueKind:
    """The value is read once the colours are known."""
    return g.ValueKind(lambda: {"anyOf": list(kinds)})


def rows_of(item: g.Schema) -> g.Schema:
    return {"type": "array", "minItems": 1, "items": item}


_MATRIX, _ROW = MATRIX.schema(), ROW.schema()
_BLOCKS = rows_of({"anyOf": [_MATRIX, {"type": "null"}]})
_DENSE = g.defined("dense")
TABLEAU_KEYS = (
    g.Key(
        "A: [[0, 0], [1/2, 0]]",
        _all_of(_MATRIX, rows_of(_BLOCKS)),
        "The matrix of a Butcher tableau, row by row; rows may end at the diagonal or before it. "
        "Of several colours rows of blocks A^{l,m}, null where colour l does not see colour m.",
        page="docs/method-file.md#a-b-c-a-butcher-tableau",
        also=("matrix", "coefficients"),
    ),
    g.Key(
        "b: [0, 1]",
        _all_of(_ROW, rows_of(_ROW)),
        "The weights, one per stage; of several colours a row each.",
        also=("weights", "weight"),
    ),
    g.Key(
        "c: [0, 1/2]",
        _all_of(_ROW, rows_of({"anyOf": [_ROW, {"type": "null"}]})),
        "The nodes, one per stage; of several colours a row each. Where they are left out they are "
        "the row sums of A. Order conditions do not depend on them, B, C, D and the "
        "non-autonomous order do.",
        also=("nodes", "abscissae", "abscissas"),
    ),
    g.Key(
        "embedded: [1, 0]",
        _all_of(_ROW, rows_of(_ROW)),
        "Embedded weights, one per stage; a row for each colour. Write them beside b.",
        page=_PAGE,
        also=(
            *("bhat", "b_hat", "b-hat", "bh", "b2", "b*", "b^", "btilde", "be"),
            *("b_embedded", "bembed", "embedding"),
        ),
    ),
    g.Key(
        "dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}",
        g.ValueKind(_DENSE.schema, inside=DENSE.inside),
        "Dense output: weights polynomial in θ without constant terms. Write it beside b.",
        page=_PAGE,
        also=("bi", "binterp", "b_theta"),
    ),
)
_PREDICTOR = g.defined("predictor")
PREDICTOR_KEY = g.Key(
    "predictor: {old: [[], [-1/2, 3/2]]}",
    g.ValueKind(_PREDICTOR.schema, inside=PREDICTOR.inside),
    "Weights that predict the values of implicit stages from the slopes of the last step and of "
    "earlier stages. Write it beside b, for one colour.",
    page="docs/method-file.md#predictor-where-the-stages-begin",
)


def with_coefficients(*keys: g.Key, form: str) -> g.ValueKind:
    also = {key.name: key.also for key in TABLEAU_KEYS}
    needed = [
        replace(key, is_needed=key.name in {"A", "b"}, also=also.get(key.name, ())) for key in keys
    ]
    return g.mapping(*needed, form=form, cures=_elsewhere)


def _elsewhere() -> Mapping[str, str | Home]:
    # declared where this tableau is a part of files
    return {**g.declared("garkcli.methodfile.file_keys", "elsewhere")(), **_SAID_BY_B}


TABLEAU = with_coefficients(
    *(replace(key, page="") for key in TABLEAU_KEYS[:-1]),
    replace(TABLEAU_KEYS[-1], kind=_DENSE, page=""),
    replace(PREDICTOR_KEY, kind=_PREDICTOR, page=""),
    form=EXAMPLE,
)
BUTCHER_KEYS = (
    g.Key("name: my method", g.TEXT, "The name of this diagonal method."),
    g.Key(
        "A: [[0, 0], [1/2, 1/2]]",
        g.defined("matrix"),
        "The matrix of this diagonal method, row by row.",
    ),
    g.Key("b: [1/2, 1/2]", g.defined("row"), "The weights of this diagonal method, one per stage."),
    g.Key(
        "c: [0, 1]",
        g.defined("row"),
        "The nodes of this diagonal method; the row sums of A where they are left out.",
    ),
    g.Key(
        "embedded: [1, 0]",
        g.defined("row"),
        "Embedded weights of this diagonal method, one per stage.",
    ),
    g.Key(
        "dense: {degree: 1, weights: [[1/2], [1/2]]}",
        _DENSE,
        "Dense output of this diagonal method.",
    ),
)
_METHOD = with_coefficients(*BUTCHER_KEYS, form="give family and stages, or A and b")
BUTCHER = with_coefficients(*BUTCHER_KEYS, form=EXAMPLE)


def entries_of(number: int) -> str:
    return counted(number, "entry", "entries")


def _spelled(node: Node, wanted: int, each: str) -> str:
    """The cure for one ? in place of a list of them; empty otherwise."""
    if not isinstance(node, ScalarNode) or node.value != UNKNOWN:
        return ""
    return f"write [{', '.join([repr(UNKNOWN)] * wanted)}], one per {each}"


def one_each(
    at: NumbersReader,
    node: Node,
    name: str,
    items: Sized,
    noun: str,
    each: str,
    wanted: int,
    cure: str,
) -> bool:
    """Reports ``b has 2 rows for 3 colours`` if ``noun`` is row and ``each`` is colour."""
    count = len(items)
    if count != wanted:
        cure = _spelled(node, wanted, each) or cure
        has = entries_of(count) if noun == "entry" else counted(count, noun)
        message = f"{name} has {has} for {counted(wanted, each)}"
        at.source.fault(node, message, cure, code="wrong-size")
    return count == wanted


def depth_of_lists(node: Node) -> int:
    if not isinstance(node, SequenceNode):
        return 0
    return 1 + max(map(depth_of_lists, node.value), default=0)


def _holds_a_number(node: Node) -> bool:
    """Whether nested lists contain anything but null."""
    if isinstance(node, SequenceNode):
        return any(map(_holds_a_number, node.value))
    return not is_null(node)


def _has_an_empty_row(node: Node) -> bool:
    return isinstance(node, SequenceNode) and any(
        isinstance(row, SequenceNode) and not row.value for row in node.value
    )


def colours_in(at: NumbersReader, node: Node, name: str) -> list[Node] | None:
    """The items of a list, one for each colour; None, with a fault, if too many."""
    items = at.source.items(node, name)
    if isinstance(node, SequenceNode) and not items:
        at.source.fault(node, f"{name} is empty", "give one for each colour", code="empty")
    return None if are_too_many(at, items, node) else items


def are_too_many(at: NumbersReader, colours: Sized, node: Node) -> bool:
    if len(colours) <= d.MAX_COLOURS:
        return False
    message = f"{len(colours)} colours (limit {d.MAX_COLOURS})"
    at.source.fault(node, message, "no method needs that many", code="too-many")
    return True


def butcher(at: NumbersReader, node: Node, where: str, names: Names) -> d.ButcherText | None:
    """Reads a spelled-out method; ``names`` are those of its A, b and c in messages."""
    entries: g.ReadMapping | None = _METHOD.read(at, node, where)
    if entries is None or not {"A", "b"} <= entries.keys():
        return None
    method = _method(at, entries, names)
    if method is None:
        return None
    beside = further_of_method(at, entries, len(method[1]), names_beside(names[1]))
    return d.ButcherText(node, entries.get("name", ""), *method, beside)


def _method(
    at: NumbersReader, entries: Entries, names: Names
) -> tuple[Rows, Row, Row | None] | None:
    name_of_A, name_of_b, name_of_c = names
    A = at.numbers.matrix(entries["A"], name_of_A)
    b = at.numbers.row(entries["b"], name_of_b)
    c = at.numbers.row(entries["c"], name_of_c) if "c" in entries else None
    if not A or not b or c == ():
        return None
    stages, rows = len(b), len(A)
    why = f"{name_of_b} has {entries_of(stages)}"
    is_square = all(len(row) == rows for row in A)
    if is_square and rows != stages and (c is None or len(c) == rows):
        # A and c agree with each other, so the mistake is in b
        message = f"{name_of_b} has {entries_of(stages)}, {name_of_A} is {rows} by {rows}"
        cure = _spelled(entries["b"], rows, "stage") or "b needs one entry per stage"
        at.source.fault(entries["b"], message, cure, code="wrong-size")
        return None
    A = at.numbers.fitted(A, entries["A"], name_of_A, (stages, stages), why)
    if c is not None:
        nodes_fit(at, entries["c"], name_of_c, c, stages)
    return A, b, c


def nodes_fit(at: NumbersReader, node: Node, name: str, c: Row, stages: int) -> bool:
    cure = "give one node for each stage, or leave c out"
    return one_each(at, node, name, c, "entry", "stage", stages, cure)


def tableau(at: NumbersReader, node: Node, linear: Node | None) -> d.TableauText | None:
    """``linear`` lists its linear colours."""
    entries: g.ReadMapping | None = TABLEAU.read(at, node, "tableau")
    if entries is None or not {"A", "b"} <= entries.keys():
        return None
    return tableau_of(at, entries, linear)


def tableau_of(at: NumbersReader, entries: Entries, linear: Node | None) -> d.TableauText | None:
    """Reads a method of one colour or several, distinguished by the nesting of A."""
    A, b = entries["A"], entries["b"]
    depth, is_one_row = depth_of_lists(A), depth_of_lists(b) < 2
    # [[null]] may be a row of blocks as well; [[]] is the short form of [[0]]
    is_one_matrix = depth <= 2 and (_holds_a_number(A) or (is_one_row and _has_an_empty_row(A)))
    if is_one_matrix and is_one_row:
        method = _method(at, entries, ("A", "b", "c"))
        if method is None:
            return None
        beside = further_of_method(at, entries, len(method[1]))
        beside = _with_predictor(at, entries, beside, len(method[1]))
        colours = _linear(at, linear, 1)
        return d.TableauText(((method[0],),), (method[1],), (method[2],), colours, (beside,))
    if is_one_matrix:
        cure = "write the second row as embedded: […], beside b"
        if len(b.value) == 1:
            cure = "write b as one row: b: [0, 1]"
        elif all(isinstance(x, SequenceNode) and len(x.value) == 1 for x in b.value):
            cure = "b is a column here: write it as one row, [0, 1]"
        message = "A is one matrix, of one colour, and b a list of rows"
        at.source.fault(b, message, cure, code="wrong-size")
        return None
    if depth == 3 and not is_one_row:
        cure = f"matrices on shared stages are the form ark; {_LEVELS}"
        at.source.fault(A, "A is a list of matrices", cure, code="list-expected")
        return None
    if depth > 3 and is_one_row and not isinstance(b, MappingNode):
        message = "A has blocks, as of several colours, and b is one row"
        at.source.fault(b, message, _LEVELS, code="wrong-size")
        return None
    return _blocks(at, entries, linear)


def _with_predictor(
    at: NumbersReader, entries: Entries, beside: d.FurtherText, stages: int
) -> d.FurtherText:
    if "predictor" not in entries:
        return beside
    return replace(beside, predictor=_predictor(at, entries["predictor"], stages))


def _predictor(at: NumbersReader, node: Node, stages: int) -> d.PredictorText | None:
    entries: g.ReadMapping | None = PREDICTOR.read(at, node, "predictor")
    if entries is None or not entries:
        return None
    given = {key: _powers(at, entries[key], f"predictor, {key}", stages) for key in entries}
    if not all(given.values()):
        return None
    return d.PredictorText(node, given.get("old", ()), given.get("new", ()))


def _powers(at: NumbersReader, node: Node, where: str, stages: int) -> tuple[Rows, ...]:
    """The matrices of 1, r, r², …, or that of 1 alone; none after a fault."""
    is_one = depth_of_lists(node) < 3
    items = [node] if is_one else at.source.items(node, where)
    if len(items) > MAX_POWERS:
        message = f"{where} has {len(items)} matrices (limit {MAX_POWERS})"
        at.source.fault(node, message, "take polynomials of a lower degree", code="too-many")
        return ()
    matrices = []
    for k, item in enumerate(items, start=1):
        name = where if is_one else f"{where}, matrix {k}"
        rows = at.numbers.matrix(item, name)
        zero = at.numbers.written("0", item, name)
        rows = tuple(row + (zero,) * (stages - len(row)) for row in rows)
        why = f"b has {entries_of(stages)}"
        matrices.append(at.numbers.fitted(rows, item, name, (stages, stages), why))
    return tuple(matrices) if all(matrices) else ()


def _blocks(at: NumbersReader, entries: Entries, linear: Node | None) -> d.TableauText | None:
    items = colours_in(at, entries["b"], "b")
    if items is None:
        return None
    b = tuple(at.numbers.row(item, d.of_colour("b", l)) for l, item in enumerate(items))
    rows = at.source.items(entries["A"], "A")
    if not isinstance(entries["A"], SequenceNode):
        return None  # said above
    if len(rows) != len(b):
        message = f"A has {counted(len(rows), 'row')} of blocks and b {len(b)} of weights"
        at.source.fault(entries["A"], message, "both have one per colour", code="wrong-size")
        return None
    A = tuple(_block_row(at, l, row, b) for l, row in enumerate(rows))
    c = _node_rows(at, entries.get("c"), b)
    if not b or not all(b) or any(len(row) != len(b) for row in A):
        return None
    colours = _linear(at, linear, len(b))
    beside = further_of_colours(at, entries, [len(row) for row in b])
    if len(b) == 1:
        beside = (_with_predictor(at, entries, beside[0], len(b[0])),)
    elif "predictor" in entries:
        message = "predictor is for a method of one colour"
        at.source.fault(entries["predictor"], message, "leave it out", code="not-together")
    return d.TableauText(A, b, c, colours, beside)


def _block_row(at: NumbersReader, l: int, node: Node, b: Weights) -> tuple[Rows | None, ...]:
    where = f"row {l + 1} of blocks"
    items = at.source.items(node, f"A, {where}")
    cure = "write null for a block that does not exist"
    one_each(at, node, where, items, "block", "colour", len(b), cure)
    return tuple(_block(at, item, l, m, b) for m, item in enumerate(items[: len(b)]))


def _block(at: NumbersReader, node: Node, l: int, m: int, b: Weights) -> Rows | None:
    if is_null(node):
        return None
    where, (rows, columns) = d.block_name(l, m), (len(b[l]), len(b[m]))
    block = at.numbers.matrix(node, where)
    if not rows or not columns:
        return block
    why = f"{d.of_colour('b', l)} has {entries_of(rows)} and {d.of_colour('b', m)} has {columns}"
    return at.numbers.fitted(block, node, where, (rows, columns), why)


def _node_rows(at: NumbersReader, node: Node | None, b: Weights) -> tuple[Row | None, ...]:
    items = [] if node is None else at.source.items(node, "c")
    cure = "give a row per colour, null where they are left out"
    if node is None or not one_each(at, node, "c", items, "row", "colour", len(b), cure):
        return (None,) * len(b)
    rows: list[Row | None] = []
    for l, item in enumerate(items):
        where = d.of_colour("c", l)
        row = None if is_null(item) else at.numbers.row(item, where)
        if row and b[l]:
            nodes_fit(at, item, where, row, len(b[l]))
        rows.append(row)
    return tuple(rows)


def _linear(at: NumbersReader, node: Node | None, colours: int) -> tuple[int, ...]:
    numbers: list[int] = []
    for item in () if node is None else at.source.items(node, "linear"):
        colour = at.source.whole(item, "linear", smallest=1)
        if colour is not None and colour > colours:
            there = "there is 1" if colours == 1 else f"there are {colours}"
            at.source.fault(item, f"linear: there is no colour {colour}", there, code="wrong-value")
        elif colour is not None:
            numbers.append(colour - 1)
    return tuple(numbers)


def names_beside(name_of_b: str) -> tuple[str, str]:
    """Names for messages, from that of the weights.

    >>> names_beside("b^{2}"), names_beside("q.b")
    (('embedded^{2}', 'dense^{2}'), ('q.embedded', 'q.dense'))
    """
    before, _, after = name_of_b.rpartition("b")
    return f"{before}embedded{after}", f"{before}dense{after}"


def further_of_method(
    at: NumbersReader, entries: Entries, stages: int, names: tuple[str, str] = d.BESIDE
) -> d.FurtherText:
    embedded = dense = None
    if "embedded" in entries and not _is_of_several(at, entries["embedded"], names[0], 2):
        embedded = _weights(at, entries["embedded"], names[0], stages)
    degree, weights = _parts(at, entries, names[1])
    where = f"{names[1]}, weights"
    if weights is not None and not _is_of_several(at, weights, where, 3):
        dense = polynomials(at, weights, where, stages, degree)
    return _further(entries, embedded, dense)


def further_of_colours(
    at: NumbersReader, entries: Entries, stages: Sequence[int], is_shared: bool = False
) -> tuple[d.FurtherText, ...]:
    """``is_shared`` allows a single row, or block, for all colours."""
    rows: dict[int, Row | None] = {}
    blocks: dict[int, Rows | None] = {}
    if "embedded" in entries:
        for l, item, name in _a_colour(at, entries["embedded"], "embedded", stages, is_shared, 1):
            rows[l] = _weights(at, item, name, stages[l])
    degree, weights = _parts(at, entries, "dense")
    if weights is not None:
        for l, item, name in _a_colour(at, weights, "dense, weights", stages, is_shared, 2):
            blocks[l] = polynomials(at, item, name, stages[l], degree)
    return tuple(_further(entries, rows.get(l), blocks.get(l)) for l in range(len(stages)))


def _a_colour(
    at: NumbersReader, node: Node, where: str, stages: Sized, is_shared: bool, depth: int
) -> Iterator[tuple[int, Node, str]]:
    colours, is_one = len(stages), _depth(node) == depth
    if is_shared and is_one:
        yield from ((l, node, where) for l in range(colours))
        return
    noun = "row" if depth == 1 else "block"
    cure = f"give a {noun} per colour, each with a {'weight' if depth == 1 else 'row'} per stage"
    if is_shared:
        cure += f", or a single shared {noun}"
    items = at.source.items(node, where, cure)
    if len(items) == colours and not is_one:
        key, comma, part = where.partition(",")
        yield from ((l, x, d.of_colour(key, l) + comma + part) for l, x in enumerate(items))
    elif isinstance(node, SequenceNode):
        count = f"one {noun}" if is_one else counted(len(items), noun)
        message = f"{where} has {count} for {counted(colours, 'colour')}"
        at.source.fault(node, message, cure, code="wrong-size")


def _is_of_several(at: NumbersReader, node: Node, where: str, depth: int) -> bool:
    if _depth(node) != depth:
        return False
    noun = "row" if depth == 2 else "block"
    cure = f"write it as one {noun}, without the outer brackets"
    if len(node.value) > 1:
        cure = "a method has one of them; make another file for the other"
    message = f"{where} has {counted(len(node.value), noun)} in a list, for one colour"
    at.source.fault(node, message, cure, code="wrong-size")
    return True


def _weights(at: NumbersReader, node: Node, where: str, stages: int) -> Row | None:
    row = at.numbers.row(node, where)
    if row and stages:
        one_each(at, node, where, row, "entry", "stage", stages, "give a weight per stage, as in b")
    return row or None


def _parts(at: NumbersReader, entries: Entries, where: str) -> tuple[int, Node | None]:
    fields: g.ReadMapping | None = (
        DENSE.read(at, entries["dense"], where) if "dense" in entries else None
    )
    if fields is None or not {"degree", "weights"} <= fields.keys():
        return 0, None
    return fields["degree"], fields["weights"]


def polynomials(at: NumbersReader, node: Node, where: str, stages: int, degree: int) -> Rows | None:
    rows = at.numbers.matrix(node, where)
    if not rows or not stages:
        return None
    cure = "give a row per stage: the coefficients of θ, θ², …"
    if not one_each(at, node, where, rows, "row", "stage", stages, cure):
        return None
    for i, row in enumerate(rows):
        if len(row) != degree:
            message = f"{where}, row {i + 1} has {entries_of(len(row))} for degree {degree}"
            cure = "give the coefficients of θ, …, θ^degree, zeros too"
            place = node.value[i] if isinstance(node, SequenceNode) else node
            at.source.fault(place, message, cure, code="wrong-size")
            return None
    return rows


def refuse_partial(
    at: NumbersReader, further: Sequence[d.FurtherText], names: Sequence[str], node: Node
) -> None:
    for key in d.BESIDE:
        given = [getattr(text, key) is not None for text in further]
        if any(given) and not all(given):
            having, lacking = names[given.index(True)], names[given.index(False)]
            message = f"{key}: {having} has it and {lacking} does not"
            cure = "give it for each colour; repeat the weights b if they are meant"
            at.source.fault(node, message, cure, code="missing-key")


def _further(entries: Entries, embedded: Row | None, dense: Rows | None) -> d.FurtherText:
    if embedded is None and dense is None:
        return d.NOTHING_FURTHER
    return d.FurtherText(embedded, dense, next(entries[key] for key in d.BESIDE if key in entries))


def _depth(node: Node) -> int:
    """The depth of lists at their first items; 0 for a scalar."""
    depth = 0
    while isinstance(node, SequenceNode) and node.value:
        depth += 1
        node = node.value[0]
    return depth
