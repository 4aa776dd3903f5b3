"""Shapes of tableaus of unknowns, as text that each shape modifies, and ``unknown`` of a method
file, which names them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from itertools import chain, product
from typing import Any, Literal, TypeAlias

from yaml.nodes import Node

from garkcli.errors import MethodError, did_you_mean
from garkcli.frozen import Frozen, replace
from garkcli.methodfile import description as d
from garkcli.methodfile.grammar import (
    FLAG,
    Key,
    ReadMapping,
    ValueKind,
    count,
    mapping,
    one_or_more,
    word,
)
from garkcli.methodfile.nodes import Extent, extent, shortened
from garkcli.methodfile.numbers import Reading, Row

TextRow: TypeAlias = tuple[str, ...]
Texts: TypeAlias = tuple[TextRow, ...]
ZERO = "0"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_OWN = re.compile(r"(?:a|e|alpha|gamma)[0-9_]+")
"""An entry of a matrix that is an unknown of its own."""


class UnknownLayout(Frozen):
    """A tableau whose entries are zeros, names of unknowns and sums of them.

    ``kind`` is the form of its method file. ``A`` has a matrix for each colour, or α and γ of a
    Rosenbrock method; ``b`` and ``embedded`` a row for each colour, or one for all of an ark.
    """

    kind: Literal["tableau", "ark", "prk", "rosenbrock"]
    A: tuple[Texts, ...]
    b: Texts
    embedded: Texts | None = None

    @property
    def stages(self) -> int:
        return len(self.b[0])

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The names in the layout, row by row."""
        texts = chain.from_iterable(chain(*self.A, self.b, self.embedded or ()))
        return tuple(dict.fromkeys(name for text in texts for name in _NAME.findall(text)))

    def with_entries(self, entry: Callable[[int, int, str], str]) -> UnknownLayout:
        """Returns the layout with changed entries in its last matrix.

        ``entry`` maps a row, a column (from 0) and the text there to the new text.
        """
        *others, last = self.A
        changed = tuple(
            tuple(entry(i, j, text) for j, text in enumerate(row)) for i, row in enumerate(last)
        )
        return replace(self, A=(*others, changed))


def full_layout(stages: int) -> UnknownLayout:
    """Returns the layout with an unknown for each entry, named by its place."""
    join = _join(stages)
    numbers = range(1, stages + 1)
    rows = tuple(tuple(f"a{join}{i}{join}{j}" for j in numbers) for i in numbers)
    return UnknownLayout("tableau", (rows,), (tuple(f"b{join}{i}" for i in numbers),))


def _join(stages: int) -> str:
    """Returns the separator of numbers in names, needed if they may have two digits."""
    return "" if stages < 10 else "_"


def with_embedded(layout: UnknownLayout) -> UnknownLayout:
    """Returns the layout with an unknown for each embedded weight: bh1 beside b1."""
    join, stages = _join(layout.stages), range(1, layout.stages + 1)
    letters = "ab" if layout.kind == "prk" else "b"
    return replace(layout, embedded=tuple(tuple(f"{x}h{join}{i}" for i in stages) for x in letters))


def with_nodes(layout: UnknownLayout) -> UnknownLayout:
    """Returns the layout with the node c_i in place of the first entry of row i.

    If that entry is an unknown that occurs nowhere else, it is the node minus the rest of the row:
    the methods are the same, and nodes are what people choose. The sum d_i of a row of γ is used
    likewise.
    """
    if layout.kind == "prk":
        return layout
    everything = [*layout.b[0], *chain.from_iterable(chain(*layout.A))]

    def row_with_node(i: int, row: TextRow) -> TextRow:
        first, *others = row
        uses = [text for text in everything if first in _NAME.findall(text)]
        if not _OWN.fullmatch(first) or len(uses) > 1:
            return row
        letter = "d" if first.startswith("gamma") else "c"
        node = f"{letter}{_join(layout.stages)}{i}"
        return (" - ".join([node, *(x for x in others if x != ZERO)]), *others)

    return replace(
        layout,
        A=tuple(tuple(row_with_node(i, x) for i, x in enumerate(A, start=1)) for A in layout.A),
    )


def _explicit(layout: UnknownLayout) -> UnknownLayout:
    return layout.with_entries(lambda i, j, text: text if j < i else ZERO)


def _dirk(layout: UnknownLayout) -> UnknownLayout:
    return layout.with_entries(lambda i, j, text: text if j <= i else ZERO)


def _sdirk(layout: UnknownLayout) -> UnknownLayout:
    return _dirk(layout).with_entries(lambda i, j, text: "gamma" if i == j else text)


def _esdirk(layout: UnknownLayout) -> UnknownLayout:
    return _sdirk(layout).with_entries(lambda i, _, text: text if i else ZERO)


def _symplectic_dirk(layout: UnknownLayout) -> UnknownLayout:
    """As in J. M. Sanz-Serna, L. Abia, *Order conditions for canonical Runge-Kutta schemes*,
    1991.
    """
    weights = layout.b[0]

    def entry(i: int, j: int, _: str) -> str:
        if j > i:
            return ZERO
        return f"{weights[j]}/2" if i == j else weights[j]

    return layout.with_entries(entry)


def _imex(layout: UnknownLayout) -> UnknownLayout:
    """Entries of the explicit part are called e_ij; the nodes and the weights are shared."""
    implicit = _esdirk(layout)
    rows = _explicit(layout).A[0]
    named = [tuple(f"e{text[1:]}" if text != ZERO else text for text in row) for row in rows]
    # the nodes of the implicit part are those of the explicit one: e_i1 = c_i − the others
    return UnknownLayout("ark", (tuple(named), implicit.A[0]), layout.b)


def _lower(weights: tuple[str, ...], reach: int) -> Texts:
    """Returns rows of weights up to the diagonal, or before it."""
    stages = len(weights)
    ends = (i + reach for i in range(stages))
    return tuple((*weights[:end], *(ZERO,) * (stages - end)) for end in ends)


def _splitting(layout: UnknownLayout) -> UnknownLayout:
    join = _join(layout.stages)
    drifts, kicks = (tuple(f"{x}{join}{i + 1}" for i in range(layout.stages)) for x in "ab")
    return UnknownLayout("prk", (_lower(drifts, 1), _lower(kicks, 0)), (drifts, kicks))


def _low_storage(layout: UnknownLayout) -> UnknownLayout:
    """Eliminates the two registers of ΔY ← A_i ΔY + h f(Y), Y ← Y + B_i ΔY: after register step i
    the slope of stage j has the weight Σ_{m=j}^i B_m A_m ⋯ A_{j+1}.

    J. H. Williamson, *Low-storage Runge–Kutta schemes*, Journal of Computational Physics 35, 1980.
    """
    s, join = layout.stages, _join(layout.stages)

    def weight(i: int, j: int) -> str:
        """Returns the weight of stage j after register step i, both counted from 1."""
        terms = [
            "*".join([f"B{join}{m}", *(f"A{join}{k}" for k in range(j + 1, m + 1))])
            for m in range(j, i + 1)
        ]
        return " + ".join(terms) or ZERO

    stages = range(1, s + 1)
    rows = tuple(tuple(weight(i - 1, j) for j in stages) for i in stages)
    return replace(layout, A=(rows,), b=(tuple(weight(s, j) for j in stages),))


def _rosenbrock(layout: UnknownLayout) -> UnknownLayout:
    alpha = [[x.replace("a", "alpha", 1) for x in row] for row in _explicit(layout).A[0]]
    gamma = [[x.replace("a", "gamma", 1) for x in row] for row in _dirk(layout).A[0]]
    for i, row in enumerate(gamma):
        row[i] = "gamma"
    made = tuple(tuple(map(tuple, rows)) for rows in (alpha, gamma))
    return UnknownLayout("rosenbrock", made, layout.b)


def _stiffly_accurate_rosenbrock(layout: UnknownLayout) -> UnknownLayout:
    """The last row of β = α + γ is b, and the last node 1.

    E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, VI.4.
    """
    (alpha, gamma), (b,) = layout.A, layout.b
    if len(b) == 1:
        message = "stiffly-accurate asks for a last node 1, which one stage does not have"
        raise MethodError(message, "take two stages", code="not-together")
    between = b[:-1]
    others = [x for x in alpha[-1][1:] if x != ZERO]
    first = " - ".join(["1", *others])
    ahead = (first, *alpha[-1][1:])
    beside = [f"{x} - {y}" for x, y in zip(between[1:], alpha[-1][1:-1], strict=True)]
    row = (" + ".join([f"{between[0]} - 1", *others]), *beside, "gamma")
    weights = (*between, "gamma")
    matrices = ((*alpha[:-1], ahead), (*gamma[:-1], row))
    return replace(layout, A=matrices, b=(weights,))


def _stiffly_accurate(layout: UnknownLayout) -> UnknownLayout:
    if layout.kind == "rosenbrock":
        return _stiffly_accurate_rosenbrock(layout)
    if layout.kind == "prk":
        message = "a partitioned shape is not stiffly accurate"
        raise MethodError(message, "leave one of them out", code="not-together")
    last = layout.A[-1][-1]
    bottom = layout.stages - 1
    # names of weights stay; what the shapes before it fixed in the last row fixes weights: an
    # explicit method gets the last weight 0, and so the first slope of the next step (FSAL)
    pairs = zip(last, layout.b[0], strict=True)
    weights = tuple(b if a.startswith("a") else a for a, b in pairs)
    changed = layout.with_entries(lambda i, j, text: weights[j] if i == bottom else text)
    return replace(changed, b=(weights,) * len(layout.b))


def _palindromic_splitting(layout: UnknownLayout) -> UnknownLayout:
    """a_{s+1−i} = a_i, b_{s−i} = b_i and b_s = 0: the last map is the first one again.

    R. McLachlan, *On the numerical integration of ordinary differential equations by symmetric
    composition methods*, SIAM Journal on Scientific Computing 16, 1995.
    """
    s = layout.stages
    drifts, kicks = layout.b
    a = tuple(drifts[min(i, s - 1 - i)] for i in range(s))
    b = (*(kicks[min(i, s - 2 - i)] for i in range(s - 1)), ZERO)
    return replace(layout, A=(_lower(a, 1), _lower(b, 0)), b=(a, b))


def _palindromic(layout: UnknownLayout) -> UnknownLayout:
    """b_{s+1−i} = b_i and a_{s+1−i,s+1−j} = b_j − a_ij.

    G. Wanner, *Runge-Kutta-methods with expansion in even powers of h*, Computing 11, 1973.
    """
    if layout.kind == "prk":
        return _palindromic_splitting(layout)
    if layout.kind != "tableau" or "gamma" in layout.unknowns:
        message = "palindromic goes with full, dirk, symplectic-dirk and splitting"
        raise MethodError(message, "leave one of them out", code="not-together")
    s = layout.stages
    (weights,), (matrix,) = layout.b, layout.A
    mirrored = {weights[i]: weights[s - 1 - i] for i in range(s // 2, s)}

    def renamed(text: str) -> str:
        return re.sub(r"\w+", lambda found: mirrored.get(found[0], found[0]), text)

    b = tuple(map(renamed, weights))
    rows = [[renamed(text) for text in row] for row in matrix]
    for i, j in product(range(s), repeat=2):
        _mirror(rows, b, i, j)
    return replace(layout, A=(tuple(map(tuple, rows)),), b=(b,))


def _mirror(rows: list[list[str]], b: tuple[str, ...], i: int, j: int) -> None:
    """Writes the entry opposite to (i, j), if that is an unknown of its own."""
    last = len(b) - 1
    k, l = last - i, last - j
    entry, opposite = rows[i][j], rows[k][l]
    if entry == ZERO and opposite == ZERO:
        message = "no explicit shape is palindromic"
        raise MethodError(message, "take full, dirk or symplectic-dirk", code="not-together")
    if not opposite.startswith("a"):
        return
    if entry == ZERO:
        rows[k][l] = b[j]
    elif (i, j) == (k, l):
        rows[k][l] = f"{b[j]}/2"
    elif (i, j) < (k, l):
        rows[k][l] = f"{b[j]} - {entry}"


class TableauShape(Frozen):
    """A shape of tableaus.

    ``applied`` returns a layout with the shape; a shape that ``begins`` determines the colours and
    comes first.
    """

    name: str
    summary: str
    applied: Callable[[UnknownLayout], UnknownLayout]
    begins: bool = False


SHAPES = {
    shape.name: shape
    for shape in (
        TableauShape("full", "every entry unknown", lambda layout: layout),
        TableauShape("explicit", "zero on and above the diagonal", _explicit),
        TableauShape("dirk", "zero above the diagonal", _dirk),
        TableauShape("sdirk", "zero above the diagonal, gamma on it", _sdirk),
        TableauShape("esdirk", "sdirk with a first row of zeros", _esdirk),
        TableauShape(
            "symplectic-dirk",
            "a_ij = b_j below the diagonal, b_i/2 on it: midpoint rules with steps b_i h",
            _symplectic_dirk,
        ),
        TableauShape(
            "imex", "an explicit and an esdirk part with the same nodes and weights", _imex, True
        ),
        TableauShape(
            "splitting", "a1 h of the first part, b1 h of the second, and so on", _splitting, True
        ),
        TableauShape(
            "low-storage", "two registers, ΔY ← A_i ΔY + h f(Y), Y ← Y + B_i ΔY", _low_storage, True
        ),
        TableauShape(
            "rosenbrock", "α below the diagonal, γ too, with gamma on its own", _rosenbrock, True
        ),
        TableauShape("stiffly-accurate", "the last row of A is b", _stiffly_accurate),
        TableauShape("palindromic", "the same method backwards", _palindromic),
    )
}
"""All shapes by name, in the order of the documentation."""


def layout_of(stages: int, names: Sequence[str]) -> UnknownLayout:
    """Returns the tableau of unknowns with some shapes, applied in their order.

    Raises MethodError if they exclude each other.

    >>> layout_of(2, ["sdirk"]).A
    ((('gamma', '0'), ('c2 - gamma', 'gamma')),)
    """
    layout = full_layout(stages)
    for place, name in enumerate(names):
        shape = SHAPES[name]
        if shape.begins and place:
            message = f"{name} comes after {names[0]}"
            raise MethodError(message, f"begin with {name}", code="not-together")
        if layout.kind == "rosenbrock" and name != "stiffly-accurate":
            message = f"{name} does not go with rosenbrock"
            raise MethodError(message, "stiffly-accurate goes with it", code="not-together")
        layout = shape.applied(layout)
    return with_nodes(layout)


FORM = "write unknown: {stages: 3, shape: sdirk}"
MAX_STAGES = 20
"""The largest number of stages; twelve unknowns without structure are too many."""


def _shape(at: Any, node: Node, where: str) -> str | None:
    name: str | None = at.source.scalar(node, where)
    if name is None or name in SHAPES:
        return name
    message = f"{where}: {shortened(name)} is not a shape"
    at.source.fault(node, message, did_you_mean(name, SHAPES), code="unknown-word")
    return None


_SHAPE = ValueKind(word(lambda: {name: x.summary for name, x in SHAPES.items()}).schema, _shape)
UNKNOWN = mapping(
    Key(
        "stages: 3",
        ValueKind(count(1, MAX_STAGES).schema, count(1).read),
        "The number of stages of the tableau of unknowns.",
        is_needed=True,
    ),
    Key(
        "shape: [dirk, stiffly-accurate]",
        one_or_more(_SHAPE),
        "Which entries are unknown, zero, equal or given: a shape, or several that go together.",
        is_needed=True,
    ),
    Key("embedded: true", FLAG, "Whether there are embedded weights bh1, bh2, … too, all unknown."),
    form=FORM,
)
"""The number of stages, and the shape."""


class Shaped(Frozen):
    """The tableau for ``unknown``: the form and the coefficients of the equivalent method file, the
    layout, and the place of ``unknown: …`` in the file.
    """

    form: d.Form
    content: d.TableauText | d.ArkText | d.PrkText | d.RosenbrockText
    layout: UnknownLayout
    place: Extent


def shaped(at: Reading, key: Node, node: Node) -> Shaped | None:
    """Returns the tableau for ``unknown``; None after a fault.

    ``key`` is the node of the word ``unknown``, ``node`` that of its value.
    """
    found: ReadMapping | None = UNKNOWN.read(at, node, "unknown")
    if found is None or not found.is_right:
        return None
    if found["stages"] > MAX_STAGES:
        message = f"{found['stages']} stages of unknowns (limit {MAX_STAGES})"
        at.source.fault(found.nodes["stages"], message, "use fewer stages", code="too-many")
        return None
    try:
        layout = layout_of(found["stages"], found["shape"])
    except MethodError as error:
        at.source.fault(found.nodes["shape"], error.message, error.help, code=error.code)
        return None
    if found.get("embedded"):
        layout = with_embedded(layout)
    for name in layout.unknowns:
        if name not in at.numbers.parameters:  # it has a value or a range there
            at.numbers.unknown(name, node, name)
    place = extent(at.source.text, key, node)
    return Shaped(layout.kind, _content(at, layout, node), layout, place)


def _content(
    at: Reading, layout: UnknownLayout, node: Node
) -> d.TableauText | d.ArkText | d.PrkText | d.RosenbrockText:
    def row(texts: TextRow, where: str) -> Row:
        numbered = enumerate(texts, start=1)
        return tuple(at.numbers.written(x, node, f"{where}, entry {j}") for j, x in numbered)

    matrices = []
    for colour, texts in enumerate(layout.A):
        numbered = enumerate(texts, start=1)
        where = d.of_colour("A", colour)
        matrices.append(tuple(row(x, f"{where}, row {i}") for i, x in numbered))
    weights = [row(x, d.of_colour("b", colour)) for colour, x in enumerate(layout.b)]
    beside = [
        d.FurtherText(row(x, d.of_colour("embedded", colour)), node=node)
        for colour, x in enumerate(layout.embedded or ())
    ]
    further = tuple(beside or [d.NOTHING_FURTHER])
    further *= len(matrices) // len(further)
    if layout.kind == "prk":
        parts = zip(matrices, weights, further, strict=True)
        return d.PrkText(*(d.ButcherText(node, "", A, b, None, x) for A, b, x in parts))
    if layout.kind == "rosenbrock":
        alpha, gamma = matrices
        return d.RosenbrockText(
            node, ((alpha,),), ((gamma,),), tuple(weights[:1]), further=further[:1]
        )
    if layout.kind == "ark":
        return d.ArkText(tuple(matrices), (weights[0],) * len(matrices), None, further)
    return d.TableauText(((matrices[0],),), (weights[0],), (None,), (), further)


def spelled(layout: UnknownLayout) -> str:
    def listed(texts: Iterable[str]) -> str:
        return f"[{', '.join(texts)}]"

    matrices = [listed(map(listed, rows)) for rows in layout.A]
    beside = [f"embedded: {listed(row)}" for row in layout.embedded or ()]
    weights = [f"b: {listed(row)}" for row in layout.b]
    if layout.kind == "prk":
        columns = [weights, beside] if beside else [weights]
        lines = [", ".join(row) for row in zip(*columns, strict=True)]
        parts = zip("qp", matrices, lines, strict=True)
        return "\n".join(["prk:", *(f"  {part}: {{A: {A}, {x}}}" for part, A, x in parts)])
    if layout.kind == "rosenbrock":
        alpha, gamma = (f"{x}: {A}" for x, A in zip(("alpha", "gamma"), matrices, strict=True))
        return "\n  ".join(["rosenbrock:", alpha, gamma, *weights, *beside])
    if layout.kind == "ark":
        return "\n  ".join(["ark:", f"A: {listed(matrices)}", weights[0], *beside])
    return "\n".join([f"A: {matrices[0]}", weights[0], *beside])
