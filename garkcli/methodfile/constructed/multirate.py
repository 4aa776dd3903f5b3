"""``multirate``: small steps of a fast method within one step of a slow one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq
from yaml.nodes import Node

from garkcli.constructions.multirate import (
    Blocks,
    Coupling,
    by_blocks,
    by_rule,
    mis_coupling,
    mri,
    slowest_first,
)
from garkcli.errors import MethodError, counted
from garkcli.exact.matrix import Matrix
from garkcli.exact.nodes import Literal
from garkcli.frozen import Frozen
from garkcli.methodfile import grammar as g
from garkcli.methodfile.constructed.parts import METHOD, PartReader
from garkcli.methodfile.description import ConstructionText, Make, PartText
from garkcli.methodfile.load import NO_SETTINGS, built, described
from garkcli.methodfile.numbers import Entry, Numbers, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.forms import one_field
from garkcli.tableau.tableau import Method, Tableau
from garkcli.transfer import RULES

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile


_FORM = "write for instance {mis: kutta, fast: rk4, steps: 4}"
_FORM_OF_MRI = "write {c: [0, 1/2, 1], gamma: [[[1/2, 0], [0, 1/2]]]}"
_FORM_OF_COUPLING = "write slowest-first, collocation, or "
_FORM_OF_COUPLING += "{fast-slow: [[…]], slow-fast: [[…]]}"
MAX_STEPS = 400
"""Most small steps."""
MAX_POWERS = 12
"""Most matrices of one slow part, one for each power of τ."""
SLOWEST_FIRST = "slowest-first"
_BLOCKS = ("fast-slow", "slow-fast")
_NAMES = ("lambda", "M")
"""Which small step it is, from 1, and how many there are, in coupling matrices."""
TableauOf: TypeAlias = Callable[[PartText], Tableau]

_SMALL_STEPS = g.Kind(MATRIX.schema, g.as_it_is)
_COUPLING = g.mapping(
    g.Key(
        "fast-slow: [[(lambda - 1)/M]]",
        _SMALL_STEPS,
        "How the fast stages of small step lambda see the slow slopes; entries may use lambda "
        "and M.",
        is_needed=True,
    ),
    g.Key(
        "slow-fast: [[0]]",
        _SMALL_STEPS,
        "How the slow stages see the fast slopes of small step lambda; entries may use lambda "
        "and M.",
        is_needed=True,
    ),
    form=_FORM_OF_COUPLING,
)


def _powers(key: str) -> g.Kind:
    """A matrix for each power of τ."""
    return g.list_of(MATRIX, "matrices", MAX_POWERS, f"{key}, matrix {{}}", _FORM_OF_MRI)


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
    form=_FORM_OF_MRI,
    rules=[g.Ways("", ("gamma", "omega"), "gamma missing", _FORM_OF_MRI, is_one=False)],
)
_SLOW = g.Ways("the slow part is", ("slow", "mis", "mri"), "the slow method is missing", _FORM)
_KEYS = g.mapping(
    g.Key("fast: rk4", METHOD, "The method of the fast part, of one colour.", is_needed=True),
    g.Key(
        "steps: 4",
        g.count(1, MAX_STEPS),
        "How many small steps the fast part takes.",
        is_needed=True,
    ),
    g.Key("slow: kutta", METHOD, "The method of the slow part, of one colour."),
    g.Key(
        "coupling: slowest-first",
        g.either(g.word(lambda: (SLOWEST_FIRST, *RULES)), at_mapping=_COUPLING),
        "How the slow and the fast part see each other: slowest-first, a transfer rule for all "
        "small steps as one method, or the matrices of each small step.",
        SLOWEST_FIRST,
    ),
    g.Key(
        "mis: {A: [[], [1/3], [-3/16, 15/16]], b: [1/6, 3/10, 8/15]}",
        METHOD,
        "The slow method of multirate infinitesimal steps with a constant forcing: between two "
        "stages the fast problem is solved by small steps.",
    ),
    g.Key(
        "mri: {c: [0, 1], gamma: [[[1]]]}",
        _MRI,
        "Multirate infinitesimal steps whose forcing has polynomials in time.",
    ),
    form=_FORM,
    rules=[_SLOW, g.Beside("coupling", "coupling does not go with {way}", needs=("slow",))],
)


class Infinitesimal(Frozen):
    """What makes a multirate infinitesimal method.

    Attributes:
        fast: the fast method.
        coupling: of the slow stages, from what gives tableaus and values.
        steps: small ones, between two slow stages.
    """

    fast: PartText
    coupling: Callable[[TableauOf, Values], Coupling]
    steps: int

    def __call__(self, tableau_of: TableauOf, values: Values) -> Tableau:
        """The method."""
        fast = _method(tableau_of, self.fast, "fast")
        return mri(self.coupling(tableau_of, values), fast, self.steps)


def _method(tableau_of: TableauOf, part: PartText, key: str) -> Method:
    tableau = tableau_of(part)
    message = f"multirate, {key}: a method of {counted(tableau.size, 'colour')}, "
    return one_field(tableau, message + "where one of one vector field is expected")


def _mis(found: g.Found) -> Callable[[TableauOf, Values], Coupling]:
    """The coupling by a constant forcing."""
    return lambda tableau_of, _: mis_coupling(_method(tableau_of, found["mis"], "mis"))


def _read(at: PartReader, found: g.Found, _: str) -> ConstructionText | None:
    """The methods, and how they are coupled."""
    before = len(at.source.faults)
    if "slow" in found:
        make = _coupled(at, found)
    else:
        coupling = _mis(found) if "mis" in found else _polynomials(at, found["mri"])
        make = Infinitesimal(found["fast"], coupling, found["steps"])
    return None if len(at.source.faults) > before else at.made(found.node, make)


def _coupled(at: PartReader, found: g.Found) -> Make:
    """Two methods with a coupling by name, or by matrices."""
    coupling = found.get("coupling", SLOWEST_FIRST)
    steps: int = found["steps"]
    keys = _BLOCKS if isinstance(coupling, g.Found) else ()
    matrices = [[*_small_steps(at, coupling[key], key, steps)] for key in keys]

    def made(tableau_of: TableauOf, values: Values) -> Tableau:
        fast, slow = (_method(tableau_of, found[key], key) for key in ("fast", "slow"))
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
    """Refuse a coupling matrix of another shape than its methods.

    Raises:
        MethodError: that is the case.
    """
    found, wanted = (len(matrix), len(matrix[0])), (seeing.stages, seen.stages)
    if found != wanted:
        message = f"{key} is {found[0]} by {found[1]} and should be {wanted[0]} by {wanted[1]}"
        cure = "give a row for each stage that sees, a column for each seen"
        raise MethodError(message, cure, code="wrong-size")


def _small_steps(at: PartReader, node: Node, key: str, steps: int) -> Iterator[Rows]:
    """A coupling matrix for each small step; its entries may use their number."""
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
    """While it is open, ``lambda`` and ``M`` are numbers."""
    before = {name: numbers.parameters.get(name) for name in _NAMES}
    for name, number in zip(_NAMES, values, strict=True):
        numbers.define(name, Literal(fmpq(number)))
    yield
    for name, value in before.items():
        if value is None:
            numbers.forget(name)
        else:
            numbers.define(name, value)


def _polynomials(at: PartReader, found: g.Found) -> Callable[[TableauOf, Values], Coupling]:
    """Polynomial couplings between nodes, of the explicit part before the implicit one."""
    c: Row = found["c"]
    parts = []
    for key in ("omega", "gamma"):
        if key in found:
            each = enumerate(zip(found[key], found.nodes[key].value, strict=True), start=1)
            parts.append([_whole(at, *x, f"{key}, matrix {k}", len(c)) for k, x in each])

    def coupling(_: TableauOf, values: Values) -> Coupling:
        matrices = tuple(tuple(map(values.matrix, part)) for part in parts)
        return Coupling(values.vector(c), matrices)

    return coupling


def _whole(at: PartReader, rows: Rows, node: Node, name: str, nodes: int) -> Rows:
    """The matrix with a row less than nodes and a column a node; what is left out at the right is
    zero, and a first row of zeros, that of the beginning, may be before the others.
    """
    if len(rows) == nodes and not any(map(_is_nonzero, rows[0])):
        rows = rows[1:]
    width = max(map(len, rows), default=0)
    if len(rows) != nodes - 1 or width > nodes:
        message = f"{name} is {len(rows)} by {width} for {counted(nodes, 'node')}"
        cure = "give a row from each node to the next, a column a node"
        at.source.fault(node, message, cure, code="wrong-value")
    zero = at.numbers.written("0", node, name)
    return tuple(row + (zero,) * (nodes - len(row)) for row in rows)


def _is_nonzero(entry: Entry) -> bool:
    expression = entry.expression
    return not (isinstance(expression, Literal) and not expression.value)


KIND = _KEYS.then(_read)


def coupling_of(method: MethodFile) -> Coupling | None:
    """What a file with ``multirate: {mis: …}`` or ``{mri: …}`` couples its slow stages by.

    Returns:
        None for other files, and where values were given for parameters of the file.
    """
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
