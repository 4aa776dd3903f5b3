"""``multirate``: small steps of a fast method within one step of a slow one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TypeAlias

from flint import fmpq

from garkcli.constructions import infinitesimal as mri
from garkcli.constructions.multirate import Blocks, by_blocks, by_rule, slowest_first
from garkcli.errors import MethodError, counted
from garkcli.exact.matrix import Matrix
from garkcli.exact.nodes import Literal
from garkcli.exact.rewriting import Expanded
from garkcli.frozen import Frozen, replace
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.constructed.parts import METHOD, PartReader
from garkcli.methodfile.description import ConstructionText, Make, PartText
from garkcli.methodfile.load import NO_SETTINGS, built, described
from garkcli.methodfile.numbers import Coefficient, Numbers, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further
from garkcli.tableau.forms import one_field
from garkcli.tableau.tableau import Method, Tableau
from garkcli.transfer import RULES

TableauOf: TypeAlias = Callable[[PartText], Tableau]


class Infinitesimal(Frozen):
    """``fast`` is None for the exact solution; ``steps`` are small ones between two slow stages."""

    fast: PartText | None
    coupling: Callable[[TableauOf, Values], mri.Coupling]
    steps: int

    def __call__(self, tableau_of: TableauOf, values: Values) -> tuple[Tableau, Further]:
        coupling = self.coupling(tableau_of, values)
        values.once(("ends", id(self)), lambda: mri.check_ends(coupling))
        plan_for = mri.plan_for_flow if self.fast is None else mri.plan_for_method
        plan: mri.CollocationPlan = values.once(("plan", id(self)), lambda: plan_for(coupling))
        fast = None if self.fast is None else method_of_part(tableau_of, self.fast, "fast")
        return mri.infinitesimal(coupling, plan, fast, self.steps)


def method_of_part(tableau_of: TableauOf, part: PartText, key: str) -> Method:
    """The method of a part; MethodError if it has several vector fields."""
    tableau = tableau_of(part)
    message = f"multirate, {key}: a method of {counted(tableau.size, 'colour')}, "
    return one_field(tableau, message + "where a method of one vector field is expected")


_FORM = "write for instance {mis: kutta, fast: rk4, steps: 4}"
_FORM_OF_MRI = "write {c: [0, 1/2, 1], gamma: [[[1/2, 0], [0, 1/2]]]}"
_FORM_OF_MIS = (
    "write a method, or {alpha: [[], [0, 1/2]], beta: [[1/2], [0, 1/2]], gamma: [[0], [0]]}"
)
_FORM_OF_COUPLING = "write slowest-first, collocation, {gamma: [[…]]}, or "
_FORM_OF_COUPLING += "{fast-slow: [[…]], slow-fast: [[…]]}"
MAX_STEPS = 400
MAX_POWERS = 12
"""Most powers of τ, with one matrix each."""
SLOWEST_FIRST = "slowest-first"
EXACT = "exact"
RESTARTS = {
    "merk": "polynomials in the time of the step, from 0 to 1",
    "sr": "polynomials in the time of the fast problem, from 0 to 1; gamma is added after it",
}
_BLOCKS = ("fast-slow", "slow-fast")
_NAMES = ("lambda", "M")
"""The number of a small step, from 1, and the number of small steps."""

_SMALL_STEPS = g.ValueKind(MATRIX.schema, g.as_it_is)
_COUPLING = g.mapping(
    g.Key(
        "fast-slow: [[(lambda - 1)/M]]",
        _SMALL_STEPS,
        "The coefficients of the slow slopes in the fast stages of small step lambda; entries may "
        "use lambda and M.",
        is_needed=True,
    ),
    g.Key(
        "slow-fast: [[0]]",
        _SMALL_STEPS,
        "The coefficients of the fast slopes of small step lambda in the slow stages; entries may "
        "use lambda and M.",
        is_needed=True,
    ),
    form=_FORM_OF_COUPLING,
)
_PREDICTOR = g.mapping(
    g.Key(
        "gamma: [[2/3, 1/3, 1/3, -1/3], [-1, 0, 0, 1]]",
        MATRIX,
        "How the slow slopes force the fast problem, which goes through the whole step after the "
        "slow method has taken it for both parts: a row for each power of the time of the step, "
        "a column a slow stage.",
        is_needed=True,
    ),
    g.Key("embedded: [[1/6, 1/3, 1/3, 1/6]]", MATRIX, "The rows that lead to the embedded value."),
    form=_FORM_OF_COUPLING,
)


def _one_of(names: tuple[str, ...], kind: g.ValueKind, other: g.ValueKind) -> g.ValueKind:
    def is_it(node: Node) -> bool:
        return isinstance(node, MappingNode) and any(k.value in names for k, _ in node.value)

    return g.ValueKind(
        lambda: {"anyOf": [other.schema(), kind.schema()]},
        lambda at, node, where: (kind if is_it(node) else other).read(at, node, where),
        lambda: (*other.inside(), *kind.inside()),
    )


def _powers(key: str) -> g.ValueKind:
    return g.list_of(MATRIX, "matrices", MAX_POWERS, f"{key}, matrix {{}}", _FORM_OF_MRI)


_EMBEDDED = g.mapping(
    g.Key("gamma: [[1/12, -1/3, 7/12]]", MATRIX, "Embedded rows of gamma, one for each power."),
    g.Key("omega: [[1/12, -1/3, 7/12]]", MATRIX, "Embedded rows of omega, one for each power."),
)
_MRI = g.mapping(
    g.Key(
        "c: [0, 1/3, 2/3, 1]",
        ROW,
        "The nodes that the slow stages go through, from 0 to 1.",
        is_needed=True,
    ),
    g.Key(
        "gamma: [[[1/3], [-1/3, 2/3], [0, -2/3, 1]]]",
        _powers("gamma"),
        "The coefficients of the implicit slow part, or of the only one: a matrix for each power.",
    ),
    g.Key(
        "omega: [[[1/3], [-1/3, 2/3], [0, -2/3, 1]]]",
        _powers("omega"),
        "The coefficients of the explicit slow part beside an implicit one.",
    ),
    g.Key(
        "embedded: [[1/12, -1/3, 7/12]]",
        g.either(MATRIX, MATRIX, _EMBEDDED),
        "The rows that lead to the embedded value, one for each power; of two slow parts a "
        "mapping.",
    ),
    g.Key(
        "restart: merk",
        g.word(lambda: RESTARTS),
        "That every fast problem begins at the beginning of the step, and what its forcing is: "
        f"merk, {RESTARTS['merk']}; sr, {RESTARTS['sr']}.",
    ),
    form=_FORM_OF_MRI,
    rules=[g.Ways("", ("gamma", "omega"), "gamma missing", _FORM_OF_MRI, is_one=False)],
)
_GENERALIZED = g.mapping(
    *(
        g.Key(f"{name}: {value}", MATRIX, f"The matrix {text}.", is_needed=True)
        for name, value, text in (
            ("alpha", "[[], [0, 1/2]]", "α: how much of Y_j − y_n the fast problem begins with"),
            ("beta", "[[1/2], [0, 1/2]]", "β of the slow slopes; its row sums are the widths"),
            ("gamma", "[[], [0, 0]]", "γ: how much of Y_j − y_n is added on the way"),
        )
    ),
    form=_FORM_OF_MIS,
)


_MIS = _one_of(("beta",), _GENERALIZED, METHOD)


def _is_exact(node: Node) -> bool:
    return isinstance(node, ScalarNode) and node.value == EXACT


_FAST = g.ValueKind(
    lambda: {"anyOf": [{"const": EXACT}, METHOD.schema()]},
    lambda at, node, where: EXACT if _is_exact(node) else METHOD.read(at, node, where),
)
_MRI_OR_NAME = g.ValueKind(
    lambda: {"anyOf": [{"type": "string"}, _MRI.schema()]},
    lambda at, node, where: (METHOD if isinstance(node, ScalarNode) else _MRI).read(
        at, node, where
    ),
    _MRI.inside,
)
_SLOW = g.Ways("the slow part is", ("slow", "mis", "mri"), "the slow method is missing", _FORM)
_KEYS = g.mapping(
    g.Key(
        "fast: rk4",
        _FAST,
        "The method of the fast part, of one colour; or exact: its exact solution.",
        is_needed=True,
    ),
    g.Key("steps: 4", g.count(1, MAX_STEPS), "The number of small steps of the fast part."),
    g.Key("slow: kutta", METHOD, "The method of the slow part, of one colour."),
    g.Key(
        "coupling: slowest-first",
        g.either(
            g.word(lambda: (SLOWEST_FIRST, *RULES)),
            at_mapping=_one_of(("gamma", "embedded"), _PREDICTOR, _COUPLING),
        ),
        "The coupling of the slow and the fast part: slowest-first, a transfer rule for all "
        "small steps as one method, the matrices of each small step, or a forcing by polynomials.",
        SLOWEST_FIRST,
    ),
    g.Key(
        "mis: {A: [[], [1/3], [-3/16, 15/16]], b: [1/6, 3/10, 8/15]}",
        _MIS,
        "The slow method of multirate infinitesimal steps with a constant forcing: between two "
        "stages the fast problem is solved; or its matrices α, β, γ.",
    ),
    g.Key(
        "mri: {c: [0, 1], gamma: [[[1]]]}",
        _MRI_OR_NAME,
        "Multirate infinitesimal steps whose forcing has polynomials in time; or the name of a "
        "method with such steps, whose coupling it is.",
    ),
    form=_FORM,
    rules=[
        _SLOW,
        g.KeyRelation("coupling", "coupling does not go with {way}", needs=("slow",)),
        g.KeyRelation(
            "fast",
            "steps missing",
            "give the number of small steps, or write fast: exact",
            needs=("steps",),
            code="missing-key",
            values=g.KeyValues({"not": {"const": EXACT}}, lambda node: not _is_exact(node)),
        ),
        g.KeyRelation(
            "fast",
            "steps does not go with fast: exact",
            "leave it out, or name a fast method",
            bars=("steps",),
            values=g.KeyValues({"const": EXACT}, _is_exact),
        ),
    ],
)


class StepPredictor(Frozen):
    """``slow`` takes the step for both parts; ``forcing`` has the rows of the fast problem and of
    the embedded value, empty if the slow slopes are interpolated; ``fast`` is None for the exact
    solution.
    """

    slow: PartText
    fast: PartText | None
    forcing: Mapping[str, Rows]
    steps: int

    def __call__(self, tableau_of: TableauOf, values: Values) -> tuple[Tableau, Further]:
        slow = method_of_part(tableau_of, self.slow, "slow")
        forcing = tuple(map(values.matrix, self.forcing.values())) or (mri.interpolation(slow),)
        for key, rows in zip(self.forcing, forcing, strict=False):
            if len(rows[0]) != slow.stages:
                message = f"{key} has {counted(len(rows[0]), 'column')}, and the slow method "
                message += f"{counted(slow.stages, 'stage')}"
                raise MethodError(message, "give a column a slow stage", code="wrong-size")
        fast = None if self.fast is None else method_of_part(tableau_of, self.fast, "fast")
        plan = values.once(("plan", id(self)), lambda: mri.plan_for_predictor(slow, forcing, fast))
        return mri.predicted(slow, forcing, plan, fast, self.steps)


def _mis(part: PartText) -> Callable[[TableauOf, Values], mri.Coupling]:
    def coupling(tableau_of: TableauOf, values: Values) -> mri.Coupling:
        row = _embedded_of(part)
        embedded = None if row is None else values.vector(row)
        return mri.mis_coupling(method_of_part(tableau_of, part, "mis"), embedded)

    return coupling


def _embedded_of(part: PartText) -> Row | None:
    texts = part.description.content.beside
    return texts[0].embedded if len(texts) == 1 else None


def _generalized(
    at: PartReader, entries: g.ReadMapping
) -> Callable[[TableauOf, Values], mri.Coupling]:
    stages = len(entries["beta"])
    parts = [
        _filled(at, entries[key], entries.nodes[key], key, stages + 1)
        for key in ("alpha", "beta", "gamma")
    ]
    return lambda _, values: mri.generalized(*map(values.matrix, parts))


def _coupling_by_name(
    at: PartReader, entries: g.ReadMapping
) -> Callable[[TableauOf, Values], mri.Coupling]:
    part: PartText = entries["mri"]
    at.parts.remove(part)  # its coupling is taken, not its step
    content = part.description.content
    if isinstance(content, ConstructionText) and isinstance(content.make, Infinitesimal):
        make = content.make
        at.parts.extend(x for x in content.parts if x is not make.fast)
        return make.coupling
    message = "multirate, mri: no coupling of slow stages is in this method"
    cure = "name a method of gark list methods --kind mri, or write mis: NAME"
    at.source.fault(entries.nodes["mri"], message, cure, code="wrong-value")
    return lambda *_: mri.following((), ())


def _read(at: PartReader, entries: g.ReadMapping, _: str) -> ConstructionText | None:
    before = len(at.source.faults)
    kept: tuple[PartText, ...] = ()
    rounding = None
    if "slow" in entries:
        make = _coupled(at, entries)
    else:
        if isinstance(entries.get("mri"), PartText):
            coupling = _coupling_by_name(at, entries)
            rounding = entries["mri"].tolerance
        elif "mri" in entries:
            coupling = _polynomials(at, entries["mri"])
        elif isinstance(entries["mis"], g.ReadMapping):
            coupling = _generalized(at, entries["mis"])
        else:
            coupling, kept = _mis(entries["mis"]), (entries["mis"],)
        fast = None if entries["fast"] == EXACT else entries["fast"]
        make = Infinitesimal(fast, coupling, entries.get("steps", 1))
    if len(at.source.faults) > before:
        return None
    return replace(at.made(entries.node, make, rounding), kept=kept)


def _coupled(at: PartReader, entries: g.ReadMapping) -> Make:
    coupling = entries.get("coupling", SLOWEST_FIRST)
    is_exact = entries["fast"] == EXACT
    if isinstance(coupling, g.ReadMapping) and "gamma" in coupling:
        rows = {key: coupling[key] for key in ("gamma", "embedded") if key in coupling}
        for key, matrix in rows.items():
            at.numbers.rectangular(matrix, coupling.nodes[key], key)
        fast = None if is_exact else entries["fast"]
        return StepPredictor(entries["slow"], fast, rows, entries.get("steps", 1))
    if is_exact and coupling != SLOWEST_FIRST:
        message = (
            "multirate: fast: exact goes with slowest-first or gamma, not with another coupling"
        )
        cure = "name a fast method and its steps"
        at.source.fault(entries.nodes["fast"], message, cure, code="not-together")
        coupling = SLOWEST_FIRST
    if is_exact:
        return StepPredictor(entries["slow"], None, {}, 1)
    steps: int = entries.get("steps", 1)
    keys = _BLOCKS if isinstance(coupling, g.ReadMapping) else ()
    matrices = [[*_small_steps(at, coupling[key], key, steps)] for key in keys]

    def made(tableau_of: TableauOf, values: Values) -> Tableau:
        slow = method_of_part(tableau_of, entries["slow"], "slow")
        fast = method_of_part(tableau_of, entries["fast"], "fast")
        if coupling == SLOWEST_FIRST:
            return slowest_first(slow, fast, steps)
        if isinstance(coupling, str):
            return by_rule(slow, fast, steps, RULES[coupling])
        of_fast, of_slow = (tuple(map(values.matrix, every)) for every in matrices)
        _check_shape("fast-slow", of_fast[0], fast, slow)
        _check_shape("slow-fast", of_slow[0], slow, fast)
        return by_blocks(slow, fast, Blocks(of_fast, of_slow))

    return made


def _check_shape(key: str, matrix: Matrix, seeing: Method, seen: Method) -> None:
    shape, wanted = (len(matrix), len(matrix[0])), (seeing.stages, seen.stages)
    if shape != wanted:
        message = f"{key} is {shape[0]} by {shape[1]} and should be {wanted[0]} by {wanted[1]}"
        cure = "give a row for each stage that sees, a column for each seen"
        raise MethodError(message, cure, code="wrong-size")


def _small_steps(at: PartReader, node: Node, key: str, steps: int) -> Iterator[Rows]:
    """A coupling matrix for each small step, whose number its entries may use."""
    before = len(at.source.faults)
    for step in range(1, steps + 1):
        with _defined(at.numbers, (step, steps)):
            rows = at.numbers.matrix(node, key)
        at.numbers.rectangular(rows, node, key)
        if len(at.source.faults) > before:
            return
        yield rows


@contextmanager
def _defined(numbers: Numbers, values: tuple[int, int]) -> Iterator[None]:
    """Defines ``lambda`` and ``M`` as numbers while it is open."""
    before = {name: numbers.parameters.get(name) for name in _NAMES}
    for name, number in zip(_NAMES, values, strict=True):
        numbers.define(name, Expanded(Literal(fmpq(number))))
    yield
    for name, value in before.items():
        if value is None:
            numbers.forget(name)
        else:
            numbers.define(name, value)


def _polynomials(
    at: PartReader, entries: g.ReadMapping
) -> Callable[[TableauOf, Values], mri.Coupling]:
    c: Row = entries["c"]
    restart = entries.get("restart")
    matrices: dict[str, list[Rows]] = {}
    rows = _embedded_rows(at, entries)
    for key in ("omega", "gamma"):
        if key in entries:
            each = enumerate(zip(entries[key], entries.nodes[key].value, strict=True), start=1)
            matrices[key] = [_filled(at, *x, f"{key}, matrix {k}", len(c)) for k, x in each]
    if restart:
        _check_restart(at, entries, matrices)

    def coupling(_: TableauOf, values: Values) -> mri.Coupling:
        nodes = values.vector(c)
        powers = {key: tuple(map(values.matrix, x)) for key, x in matrices.items()}
        embedded: dict[str, mri.Powers] | None = None
        if rows is not None:
            embedded = {key: tuple(map(values.vector, rows.get(key, ()))) for key in powers}
        if restart is None:
            last = None if embedded is None else tuple(embedded.values())
            return mri.following(nodes, tuple(powers.values()), last)
        if restart == "merk":
            (forcing,) = powers.values()
            last = None if embedded is None else tuple(embedded.values())
            made = mri.restarted(nodes, (mri.of_step_time(nodes[1:], forcing),), last)
        else:
            parts = max(len(powers), 1)
            forcing = powers.get("omega", powers.get("gamma", ()))
            after = powers["gamma"][0] if parts > 1 else None
            last = row = None
            if embedded is not None:
                last = (embedded["omega"],) * parts
                row = embedded["gamma"][0] if parts > 1 and embedded["gamma"] else None
            made = mri.restarted(nodes, (forcing,) * parts, last, after, row)
        return replace(made, matrices=tuple(powers.values()), restart=restart)

    return coupling


def _check_restart(
    at: PartReader, entries: g.ReadMapping, matrices: Mapping[str, Sequence[Rows]]
) -> None:
    restart = entries["restart"]
    if restart == "merk" and len(matrices) > 1:
        message = "multirate, mri: restart: merk goes with omega, not with omega and gamma"
        cure = "give omega alone, or restart: sr"
        at.source.fault(entries.nodes["restart"], message, cure, code="not-together")
    elif restart == "sr" and "omega" not in matrices:
        message = "multirate, mri: omega missing beside restart: sr"
        cure = "write omega for gamma: the forcing"
        at.source.fault(entries.nodes["restart"], message, cure, code="missing-key")
    elif restart == "sr" and len(matrices.get("gamma", ())) > 1:
        message = f"multirate, mri: gamma has {len(matrices['gamma'])} matrices, and is added once"
        cure = "restart: sr has one matrix gamma: [[[…]]]"
        at.source.fault(entries.nodes["gamma"], message, cure, code="wrong-size")
    rows = entries.get("embedded")
    count = len(rows.get("gamma", ())) if isinstance(rows, g.ReadMapping) else 0
    if restart == "sr" and count > 1:
        message = f"multirate, mri, embedded: gamma has {count} rows, and is added once"
        cure = "restart: sr has one row gamma: [[…]]"
        at.source.fault(entries["embedded"].nodes["gamma"], message, cure, code="wrong-size")


def _embedded_rows(at: PartReader, entries: g.ReadMapping) -> dict[str, Rows] | None:
    given = entries.get("embedded")
    if given is None:
        return None
    node = entries.nodes["embedded"]
    keys = [key for key in ("omega", "gamma") if key in entries]
    if not isinstance(given, g.ReadMapping):
        if len(keys) > 1:
            message = "multirate, mri, embedded: a mapping is expected here"
            cure = "of two slow parts write embedded: {omega: [[…]], gamma: [[…]]}"
            at.source.fault(node, message, cure, code="mapping-expected")
        given, places = {keys[0]: given}, {keys[0]: node}
    else:
        places = dict(given.nodes)
    rows: dict[str, Rows] = {}
    for key, matrix in given.items():
        name = f"embedded, {key}" if len(places) > 1 else "embedded"
        if key not in keys:
            message = f"multirate, mri: {key} missing beside embedded rows of it"
            at.source.fault(places[key], message, "leave them out", code="missing-key")
        rows[key] = _widened(at, matrix, places[key], name, len(entries["c"]))
    return rows


def _widened(at: PartReader, rows: Rows, node: Node, name: str, nodes: int) -> Rows:
    width = max(map(len, rows), default=0)
    if width > nodes:
        message = f"{name} has {counted(width, 'column')} for {counted(nodes, 'node')}"
        at.source.fault(node, message, "give a column a node", code="wrong-size")
    zero = at.numbers.written("0", node, name)
    return tuple(row + (zero,) * (nodes - len(row)) for row in rows)


def _filled(at: PartReader, rows: Rows, node: Node, name: str, nodes: int) -> Rows:
    """The matrix filled with zeros, without a first row of zeros for the start of the step."""
    if len(rows) == nodes and not any(map(_is_nonzero, rows[0])):
        rows = rows[1:]
    width = max(map(len, rows), default=0)
    if len(rows) != nodes - 1 or width > nodes:
        message = f"{name} is {len(rows)} by {width} for {counted(nodes, 'node')}"
        cure = "give a row from each node to the next, a column a node"
        at.source.fault(node, message, cure, code="wrong-value")
        return rows
    return _widened(at, rows, node, name, nodes)


def _is_nonzero(entry: Coefficient) -> bool:
    expression = entry.expression
    return not (isinstance(expression, Literal) and not expression.value)


KIND = _KEYS.then(_read)


def coupling_of(method: MethodFile) -> mri.Coupling | None:
    """The coupling of the slow stages; None for other files, and with given parameters."""
    if method.form != "multirate":
        return None
    reader, description = described(method.text, method.source, NO_SETTINGS)
    content = description.content
    if not isinstance(content, ConstructionText) or description.is_conjugate:
        return None
    made = built(reader, description, Values)
    if not isinstance(content.make, Infinitesimal) or made.tableau != method.tableau:
        return None
    return content.make.coupling(made.part, made.values)
