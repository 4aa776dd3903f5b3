"""Shapes of tableaus of unknowns, as texts that each shape modifies."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from itertools import chain, pairwise, product
from typing import Any, Literal, TypeAlias

from garkcli.errors import MethodError
from garkcli.frozen import Frozen, replace
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Extent, Node, extent, node_at, shortened
from garkcli.grammar.source import Entries
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import NumbersReader

TextRow: TypeAlias = tuple[str, ...]
Texts: TypeAlias = tuple[TextRow, ...]
ZERO = "0"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_OWN = re.compile(r"(?:a|e|alpha|gamma)[0-9_]+")


class UnknownLayout(Frozen):
    """A tableau whose entries are zeros, names of unknowns and sums of them.

    ``A`` has a matrix for each colour, or the matrices of another form: α and γ of a Rosenbrock
    method; Ā of a Nyström method, and A if g depends on velocities; α and β of Shu and Osher, a row
    for each value except the first; Γ⁰ and Γ¹ of a multirate coupling, a row for each step from one
    node to the next. ``b`` and ``embedded`` have a row for each colour, or one for all of an ark; b̄
    and b of a Nyström method; none for Shu and Osher and for couplings. ``c`` has the nodes of a
    Nyström method, or those of a coupling and the end of the step.
    """

    kind: Literal["tableau", "ark", "prk", "rosenbrock", "nystrom", "shu-osher", "multirate"]
    A: tuple[Texts, ...]
    b: Texts
    embedded: Texts | None = None
    c: TextRow = ()

    @property
    def stages(self) -> int:
        return len(self.b[0] if self.b else self.A[0])

    @property
    def unknowns(self) -> tuple[str, ...]:
        texts = chain.from_iterable(chain([self.c], *self.A, self.b, self.embedded or ()))
        return tuple(dict.fromkeys(name for text in texts for name in _NAME.findall(text)))

    def with_entries(self, entry: Callable[[int, int, str], str]) -> UnknownLayout:
        """The layout with ``entry(row, column, text)``, from 0, in its last matrix."""
        *others, last = self.A
        changed = tuple(
            tuple(entry(i, j, text) for j, text in enumerate(row)) for i, row in enumerate(last)
        )
        return replace(self, A=(*others, changed))


def full_layout(stages: int) -> UnknownLayout:
    join = _join(stages)
    numbers = range(1, stages + 1)
    rows = tuple(tuple(f"a{join}{i}{join}{j}" for j in numbers) for i in numbers)
    return UnknownLayout("tableau", (rows,), (tuple(f"b{join}{i}" for i in numbers),))


def _join(stages: int) -> str:
    """The separator of numbers in names, needed if they may have two digits."""
    return "" if stages < 10 else "_"


def with_embedded(layout: UnknownLayout) -> UnknownLayout:
    """An unknown for each embedded weight: bh1 beside b1."""
    join, stages = _join(layout.stages), range(1, layout.stages + 1)
    if layout.kind == "multirate":
        return _with_embedded_rows(layout)
    letters = {"prk": ("a", "b"), "nystrom": ("bbar", "b")}.get(layout.kind, ("b",))
    return replace(layout, embedded=tuple(tuple(f"{x}h{join}{i}" for i in stages) for x in letters))


def with_nodes(layout: UnknownLayout) -> UnknownLayout:
    """The node c_i replaces the first entry of row i.

    If that entry is an unknown that occurs nowhere else, it is the node minus the rest of the row:
    the methods are the same, and nodes are what people choose. So is the sum d_i of a row of γ.
    """
    if layout.kind in {"prk", "nystrom", "shu-osher", "multirate"}:
        return layout
    everything = [*layout.b[0], *chain.from_iterable(chain(*layout.A))]

    def row_with_node(i: int, row: TextRow) -> TextRow:
        first, *others = row
        uses = [text for text in everything if first in _NAME.findall(text)]
        if not _OWN.fullmatch(first) or len(uses) > 1:
            return row
        letter = "d" if first.startswith("gamma") else "c"
        node = f"{letter}{_join(layout.stages)}{i}"
        return (_rest(node, others), *others)

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
    """Source: J. M. Sanz-Serna, L. Abia, *Order conditions for canonical RK schemes*, 1991."""
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
    """Rows of weights up to the diagonal, or before it."""
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
        """The weight of stage j after register step i, both counted from 1."""
        terms = [
            "*".join([f"B{join}{m}", *(f"A{join}{k}" for k in range(j + 1, m + 1))])
            for m in range(j, i + 1)
        ]
        return " + ".join(terms) or ZERO

    stages = range(1, s + 1)
    rows = tuple(tuple(weight(i - 1, j) for j in stages) for i in stages)
    return replace(layout, A=(rows,), b=(tuple(weight(s, j) for j in stages),))


def _nystrom(layout: UnknownLayout) -> UnknownLayout:
    """Ā below the diagonal, and the nodes 0, c2, c3, …"""
    join = _join(layout.stages)
    Abar = tuple(tuple(x.replace("a", "abar", 1) for x in row) for row in _explicit(layout).A[0])
    bbar = tuple(x.replace("b", "bbar", 1) for x in layout.b[0])
    c = (ZERO, *(f"c{join}{i}" for i in range(2, layout.stages + 1)))
    return UnknownLayout("nystrom", (Abar,), (bbar, *layout.b), c=c)


def _velocities(layout: UnknownLayout) -> UnknownLayout:
    if layout.kind != "nystrom":
        message = "velocities are those of a nystrom shape"
        raise MethodError(message, "begin with nystrom", code="not-together")
    plain = _explicit(full_layout(layout.stages)).A[0]
    rows = [
        (_rest(node, row[1:]), *row[1:]) if i else row
        for i, (node, row) in enumerate(zip(layout.c, plain, strict=True))
    ]
    return replace(layout, A=(*layout.A, tuple(rows)))


def _rest(total: str, others: Iterable[str]) -> str:
    """A number minus others; zeros are left out."""
    terms = [x for x in others if x != ZERO]
    if total == ZERO and terms:
        return f"-{' - '.join(terms)}"
    return " - ".join([total, *terms])


def _last_stage_is_step(layout: UnknownLayout) -> UnknownLayout:
    if layout.stages == 1:
        message = "stiffly-accurate asks for a last node 1, which one stage does not have"
        raise MethodError(message, "take two stages", code="not-together")
    bbar, b = layout.b
    bbar = (*bbar[:-1], ZERO)
    if len(layout.A) > 1:
        b = (_rest("1", b[1:-1]), *b[1:-1], ZERO)  # the sum is the last node
    rows = (bbar, b)[: len(layout.A)]
    A = tuple((*matrix[:-1], row) for matrix, row in zip(layout.A, rows, strict=True))
    return replace(layout, A=A, b=(bbar, b), c=(*layout.c[:-1], "1"))


def _shu_osher(layout: UnknownLayout) -> UnknownLayout:
    """Row i combines values and slopes before value i + 1; α_i1 is 1 minus the others."""
    s, join = layout.stages, _join(layout.stages)

    def named(letter: str, i: int) -> list[str]:
        return [f"{letter}{join}{i}{join}{j}" for j in range(1, i + 1)]

    rows = range(1, s + 1)
    alpha = [named("alpha", i)[1:] for i in rows]
    beta = tuple((*named("beta", i), *(ZERO,) * (s - i)) for i in rows)
    whole = tuple((_rest("1", x), *x, *(ZERO,) * (s - 1 - len(x))) for x in alpha)
    return UnknownLayout("shu-osher", (whole, beta), ())


def _mri(layout: UnknownLayout) -> UnknownLayout:
    """An explicit coupling with a forcing that is linear in time. Linear slow solutions are exact:
    the rows of Γ⁰ sum to the differences of the nodes, those of Γ¹ to zero.

    A. Sandu, *A class of multirate infinitesimal GARK methods*, SIAM J. Numer. Anal. 57, 2019.
    """
    s, join = layout.stages, _join(layout.stages)
    c = (ZERO, *(f"c{join}{i}" for i in range(2, s + 1)), "1")
    sums = [_rest(end, [begin]) for begin, end in pairwise(c)]
    matrices = []
    for power, totals in enumerate((sums, [ZERO] * s), start=1):
        rows = []
        for i, total in enumerate(totals, start=1):
            others = [f"gamma{power}_{i}{join}{j}" for j in range(2, i + 1)]
            rows.append((_rest(total, others), *others, *(ZERO,) * (s + 1 - i)))
        matrices.append(tuple(rows))
    return UnknownLayout("multirate", tuple(matrices), (), c=c)


def _with_embedded_rows(layout: UnknownLayout) -> UnknownLayout:
    s, join = layout.stages, _join(layout.stages)
    rows = []
    for power, total in enumerate((_rest("1", [layout.c[-2]]), ZERO), start=1):
        others = [f"bh{power}_{join}{j}" for j in range(2, s + 1)]
        rows.append((_rest(total, others), *others, ZERO))
    return replace(layout, embedded=tuple(rows))


def _rosenbrock(layout: UnknownLayout) -> UnknownLayout:
    alpha = [[x.replace("a", "alpha", 1) for x in row] for row in _explicit(layout).A[0]]
    gamma = [[x.replace("a", "gamma", 1) for x in row] for row in _dirk(layout).A[0]]
    for i, row in enumerate(gamma):
        row[i] = "gamma"
    made = tuple(tuple(map(tuple, rows)) for rows in (alpha, gamma))
    return UnknownLayout("rosenbrock", made, layout.b)


def _stiffly_accurate_rosenbrock(layout: UnknownLayout) -> UnknownLayout:
    """Sets the last row of β = α + γ to b, and the last node to 1.

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
    if layout.kind == "nystrom":
        return _last_stage_is_step(layout)
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
    """A shape that ``begins`` determines the colours and comes first."""

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
        TableauShape(
            "shu-osher", "an explicit method by α and β of Shu and Osher", _shu_osher, True
        ),
        TableauShape("nystrom", "a Nyström method for g(q), Ā below the diagonal", _nystrom, True),
        TableauShape(
            "velocities", "of a Nyström method for g(q, q′), A below the diagonal", _velocities
        ),
        TableauShape("mri", "an explicit coupling of fast problems, linear in time", _mri, True),
        TableauShape("stiffly-accurate", "the last row of A is b", _stiffly_accurate),
        TableauShape("palindromic", "the same method backwards", _palindromic),
    )
}


def layout_of(stages: int, names: Sequence[str]) -> UnknownLayout:
    """Shapes apply in their order; MethodError if they exclude each other.

    >>> layout_of(2, ["sdirk"]).A
    ((('gamma', '0'), ('c2 - gamma', 'gamma')),)
    """
    layout = full_layout(stages)
    for place, name in enumerate(names):
        shape = SHAPES[name]
        if shape.begins and place:
            message = f"{name} comes after {names[0]}"
            raise MethodError(message, f"begin with {name}", code="not-together")
        if layout.kind in _AFTER and name not in _AFTER[layout.kind]:
            message = f"the shape {name} does not go with {names[0]}"
            cure = f"with it goes {' and '.join(_AFTER[layout.kind]) or 'no other shape'}"
            raise MethodError(message, cure, code="not-together")
        layout = shape.applied(layout)
    return with_nodes(layout)


_AFTER: dict[str, tuple[str, ...]] = {
    "rosenbrock": ("stiffly-accurate",),
    "nystrom": ("velocities", "stiffly-accurate"),
    "shu-osher": (),
    "multirate": (),
}
FORM = "write unknown: {stages: 3, shape: sdirk}"
MAX_STAGES = 20
"""Twelve unknowns without structure are too many."""


def _shape(at: Any, node: Node, where: str) -> str | None:
    name: str | None = at.source.scalar(node, where)
    if name is None or name in SHAPES:
        return name
    message = f"{where}: {shortened(name)} is not a shape"
    at.source.unknown_word(node, message, name, SHAPES)
    return None


_SHAPE = g.ValueKind(g.word(lambda: {name: x.summary for name, x in SHAPES.items()}).schema, _shape)
UNKNOWN = g.mapping(
    g.Key(
        "stages: 3",
        g.ValueKind(g.count(1, MAX_STAGES).schema, g.count(1).read),
        "The number of stages of the tableau of unknowns.",
        is_needed=True,
    ),
    g.Key(
        "shape: [dirk, stiffly-accurate]",
        g.one_or_more(_SHAPE),
        "Which entries are unknown, zero, equal or given: a shape, or several that go together.",
        is_needed=True,
    ),
    g.Key(
        "embedded: true", g.FLAG, "Whether there are embedded weights bh1, bh2, … too, all unknown."
    ),
    form=FORM,
)


class Shaped(Frozen):
    layout: UnknownLayout
    entries: Entries
    place: Extent

    @property
    def form(self) -> d.Form:
        return self.layout.kind


def shaped(at: NumbersReader, key: Node, node: Node) -> Shaped | None:
    """The tableau for ``unknown``, at the node ``key``; None after a fault."""
    entries: g.ReadMapping | None = UNKNOWN.read(at, node, "unknown")
    if entries is None or not entries.is_right:
        return None
    if entries["stages"] > MAX_STAGES:
        message = f"{entries['stages']} stages of unknowns (limit {MAX_STAGES})"
        at.source.fault(entries.nodes["stages"], message, "use fewer stages", code="too-many")
        return None
    try:
        layout = layout_of(entries["stages"], entries["shape"])
    except MethodError as error:
        at.source.fault(entries.nodes["shape"], error.message, error.help, code=error.code)
        return None
    if entries.get("embedded"):
        layout = with_embedded(layout)
    for name in layout.unknowns:
        if name not in at.numbers.parameters:  # it has a value or a range there
            at.numbers.unknown(name, node, name)
    written = {name: node_at(value, node) for name, value in _keys(layout).items()}
    return Shaped(layout, written, extent(at.source.text, key, node))


def _keys(layout: UnknownLayout) -> dict[str, Any]:
    (first, *more), rows = layout.A, layout.embedded
    beside: dict[str, Any] = {} if rows is None else {"embedded": rows[0]}
    match layout.kind:
        case "tableau":
            return {"A": first, "b": layout.b[0], **beside}
        case "ark":
            inside: dict[str, Any] = {"A": layout.A, "b": layout.b[0], **beside}
        case "prk":
            each = zip("qp", layout.A, layout.b, rows or (None, None), strict=True)
            inside = {x: {"A": A, "b": b, **({"embedded": e} if e else {})} for x, A, b, e in each}
        case "rosenbrock":
            inside = {"alpha": first, "gamma": more[0], "b": layout.b[0], **beside}
        case "shu-osher":
            inside = {"alpha": first, "beta": more[0], **beside}
        case "nystrom":
            matrices = dict(zip(("Abar", "A"), layout.A, strict=False))
            weights = dict(zip(("bbar", "b"), layout.b, strict=True))
            inside = {**matrices, "c": layout.c, **weights}
            if rows is not None:
                inside["embedded"] = dict(zip(("bbar", "b"), rows, strict=True))
        case "multirate":
            coupling = {"c": layout.c, "gamma": layout.A}
            inside = {"mri": {**coupling, **({"embedded": rows} if rows else {})}, "fast": "exact"}
    return {layout.kind: inside}


def spelled(layout: UnknownLayout) -> str:
    lines = []
    for key, value in _keys(layout).items():
        if isinstance(value, dict):
            lines += [f"{key}:", *(f"  {name}: {_in_brackets(x)}" for name, x in value.items())]
        else:
            lines.append(f"{key}: {_in_brackets(value)}")
    return "\n".join(lines)


def _in_brackets(value: Any) -> str:
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key}: {_in_brackets(x)}' for key, x in value.items())}}}"
    return value if isinstance(value, str) else f"[{', '.join(map(_in_brackets, value))}]"
