"""``gark export --to certificate``: a proof that can be checked without this package.

In JSON rational numbers are text; a number of ℚ(θ) is the list of its coordinates in 1, θ, θ², …;
trees are written in brackets. Colours and stage spaces count from 1. ``docs/certificate.md`` has
the format. That of a rounded method proves that one within its rounding has the order.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeAlias, TypeVar

from flint import fmpq, fmpq_poly

from garkcli.check.analysis import MethodProof
from garkcli.errors import counted
from garkcli.exact.cells import between
from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number, NumberField, coordinates
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.exact.traces import rational_text
from garkcli.exact.traces import told as made_of
from garkcli.frozen import replace
from garkcli.ntrees.kind import FIELDS
from garkcli.ntrees.kind import Kind as VertexKind
from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import Proof
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.reason import NO_REASON
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, optional, via
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TEXT, TREE, TRUTH, choice, order_answer
from garkcli.tell.parts import SAID, part, parts, rows_of, told
from garkcli.tell.report import Report
from garkcli.version import __version__

if TYPE_CHECKING:
    from garkcli.check.existing import ExistenceProof, PrintedNumber
    from garkcli.ntrees.tree import Tree
    from garkcli.order.certificate import Witness
    from garkcli.tableau.tableau import Colour, Tableau

HEADLINE, USUAL, DETAIL, DATA = Level
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that says which root θ is."""
P = TypeVar("P")
Block: TypeAlias = "tuple[tuple[int, int], Sequence[Sequence[Number]]]"
"""The space and the colour that it is between, and its entries."""


class In(NamedTuple, Generic[P]):
    """A part of a tableau over a field of some degree."""

    part: P
    degree: int


def _signs(proof: Proof | ExistenceProof, d: Plain) -> Plain:
    """The dialect with the colours of a method, its conjugate or its pair."""
    return replace(d, colours=[colour.name for colour in proof.tableau.colours])


def _proved(proof: Proof, d: Plain) -> str:
    """``4, proved by 8 trees; order 5 fails at …``."""
    found = proof.order
    count = sum(len(trees) for by_colour in proof.spanning for trees in by_colour)
    order = d.known(str(found.order), order_answer(found).status)
    text = f"{order}, proved by {counted(count, 'tree')}"
    return text if found.witness is None else f"{text}; {_signs(proof, d).failure(found.witness)}"


def _tree_rows(proof: Proof, d: Plain) -> list[tuple[str, str]]:
    d = _signs(proof, d)
    return [
        (f"order {k}", ", ".join(d.tree(tree) for trees in by_colour for tree in trees))
        for k, by_colour in enumerate(proof.spanning, start=1)
    ]


def _texts(polynomial: fmpq_poly) -> list[str]:
    """Coefficients, lowest first."""
    return [str(a) for a in polynomial.coeffs()]


def _theta_between(field: NumberField) -> list[str]:
    """An interval around θ."""
    ball = to_ball(field.element(fmpq_poly([0, 1])), DIGITS_OF_ROOT + 10)
    near = midpoint(ball)
    unit = fmpq(1, 10**DIGITS_OF_ROOT)
    units = (near / unit).floor()
    rounded = unit * units
    low = rounded - unit
    return [str(low), str(rounded + 2 * unit)]


def _between_nodes(modulus: fmpq_poly) -> list[fmpq]:
    """Points to the left of the nodes, between neighbours, and to the right."""
    nodes = [root for root, _ in real_roots(Polynomial.from_flint(modulus))]
    gaps = zip([None, *nodes], [*nodes, None], strict=True)
    return [between(a, b) for a, b in gaps]


def _number(number: Number, degree: int) -> str | list[str]:
    return str(number) if degree == 1 else [str(x) for x in coordinates(number, degree)]


def _between(space: StageSpace) -> list[str] | None:
    if not isinstance(space, PolynomialSpace):
        return None
    return [str(x) for x in _between_nodes(space.modulus)]


def _modulus(space: StageSpace) -> list[str] | None:
    return None if not isinstance(space, PolynomialSpace) else _texts(space.modulus)


def _numbers(found: Iterable[Number], degree: int) -> list[str | list[str]]:
    return [_number(x, degree) for x in found]


RATIONAL: S.Schema = {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}
NUMBER: S.Schema = S.one_of(RATIONAL, S.array(RATIONAL))
"""A rational number, or the coordinates of one of ℚ(θ)."""
RATIONALS: Kind[Sequence[str]] = Kind(Json(S.array(RATIONAL)))
NUMBERS: Kind[object] = Kind(Json(S.array(NUMBER)))
ROWS: Kind[object] = Kind(Json(S.array(S.array(NUMBER))))
ARITY: Kind[Sequence[int]] = Kind(Json(S.array(S.one_of({"enum": [0, 1, 2]}))))
VALUE: Kind[object] = Kind(Json(NUMBER))
REQUIRED: Kind[str] = Kind(Json(RATIONAL))
FIELD: Section[NumberField] = Section(
    Row("modulus", RATIONALS, lambda x: _texts(x.modulus)),
    Row("theta_between", RATIONALS, _theta_between),
)
STAGES: Row[StageSpace] = Row("stages", POSITION, lambda x: x.stages)
SPACE: Section[StageSpace] = Section(
    STAGES, optional("modulus", RATIONALS, _modulus), optional("between_nodes", RATIONALS, _between)
)
VERTICES: Section[VertexKind] = Section(
    Row("branches", ARITY, lambda x: sorted(x.arity)),
    Row("weight", POSITION, lambda x: x.weight),
    Row("in_solution", TRUTH, lambda x: x.is_exact),
)


def _own_kind(colour: Colour) -> VertexKind | None:
    """The kind of vertices where the key ``linear`` does not say it."""
    return None if colour.kind in FIELDS else colour.kind


OF_COLOUR: Rows[Colour] = (
    Row("name", TEXT, lambda x: x.name),
    Row("space", INDEX, lambda x: x.space),
    Row("drives", choice("y", "q", "p"), lambda x: x.part),
    Row("linear", TRUTH, lambda x: x.is_linear),
    optional("vertices", part(VERTICES), _own_kind),
)
OF_BLOCK: Rows[Block] = (
    Row("space", INDEX, lambda x: x[0][0]),
    Row("colour", INDEX, lambda x: x[0][1]),
)
COLOUR: Section[In[Colour]] = Section(
    via(lambda x: x.part, OF_COLOUR), Row("b", NUMBERS, lambda x: _numbers(x.part.b, x.degree))
)
BLOCK: Section[In[Block]] = Section(
    via(lambda x: x.part, OF_BLOCK),
    Row("A", ROWS, lambda x: [_numbers(row, x.degree) for row in x.part[1]]),
)
WITNESS: Section[In[Witness]] = Section(
    Row("tree", TREE, lambda x: x.part.tree),
    Row("value", VALUE, lambda x: _number(x.part.value, x.degree)),
    Row("required", REQUIRED, lambda x: str(x.part.required)),
)


def _blocks(tableau: Tableau) -> list[Block]:
    return sorted(tableau.blocks.items())


def _all(found: Iterable[P], tableau: Tableau) -> list[In[P]]:
    return [In(x, tableau.degree) for x in found]


def _witness(proof: Proof) -> In[Witness] | None:
    """The tree that fails; None if the search ended at its limit."""
    witness = proof.order.witness
    return None if witness is None else In(witness, proof.tableau.degree)


TREES: Kind[Sequence[Sequence[Sequence[Tree]]]] = Kind(
    Json(
        S.array(S.array(S.array(S.TEXT))),
        lambda spanning, _: [
            [[format_tree(tree) for tree in trees] for trees in by_colour] for by_colour in spanning
        ],
    )
)
TRUE_OF: Rows[Proof] = [
    Row("order", COUNT, lambda x: x.order.order, DATA),
    Row("spanning", TREES, lambda x: x.spanning, DATA),
    maybe("witness", part(WITNESS), _witness, DATA),
    itself("spanning_in_words", rows_of(_tree_rows), DETAIL),
]
TRUTH_OF = Section(TRUE_OF)
PROOF: Section[Proof] = Section(
    Row("spaces", parts(SPACE), lambda x: x.tableau.spaces, DATA),
    Row("colours", parts(COLOUR), lambda x: _all(x.tableau.colours, x.tableau), DATA),
    Row("blocks", parts(BLOCK), lambda x: _all(_blocks(x.tableau), x.tableau), DATA),
    TRUE_OF,
)


def _pair(proof: MethodProof) -> Proof | None:
    """The pair, if the method has the conjugate that it is made with."""
    return None if proof.conjugate is None else proof.pair


EXACT: Section[MethodProof] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    maybe("field", part(FIELD), lambda x: x.method.tableau.field, DATA),
    Row("order", told(_proved), lambda x: x.method, HEADLINE),
    Row("conjugate_order", told(_proved), lambda x: x.conjugate),
    Row("pair_order", told(_proved), lambda x: x.pair),
    Row("method", part(PROOF), lambda x: x.method, DETAIL),
    optional("conjugate", part(PROOF), lambda x: x.conjugate, DETAIL),
    optional("pair", part(TRUTH_OF), _pair, DETAIL),
    optional("no_conjugate", TEXT, lambda x: str(x.obstacle) or None),
    title=lambda x, d: d.prose(x.name),
)


def _exists(proof: ExistenceProof, d: Plain) -> str:
    """``4: a method is proved to exist by 8 conditions``."""
    found = proof.order
    status = replace(order_answer(found).status, open=NO_REASON, at_least=proof.witness is None)
    order = d.known(str(found.order), status)
    count = counted(len(proof.conditions), "condition")
    return f"{order}: a method is proved to exist by {count}"


def _excluded(proof: ExistenceProof) -> str | None:
    """The proof that no method within the tolerance has the next order."""
    order, count = proof.order.order + 1, len(proof.witness or ())
    if count:
        how = "a condition excludes" if count == 1 else f"{count} conditions together exclude"
        return f"no method within the tolerance has order {order}: {how} it"
    if proof.order.witness is None:
        return None
    return f"that order {order} fails is left out: it takes more than a sum of conditions"


def _condition_rows(proof: ExistenceProof, d: Plain) -> list[tuple[str, str]]:
    d = _signs(proof, d)
    trees = [tree for tree, _ in proof.conditions]
    orders = range(1, proof.order.order + 1)
    return [(f"order {k}", ", ".join(d.tree(u) for u in trees if u.order == k)) for k in orders]


DECIMAL: S.Schema = {"type": "string", "pattern": r"^-?\d+([/.]\d+)?$"}
"""A rational number, also in decimals."""
MADE: S.Schema = S.one_of(DECIMAL, {"type": "integer"}, {"type": "array"})
"""An entry: a rational number, the number of a printed one, or [sign, one, other]."""
SHORT: Kind[fmpq] = Kind(Json(DECIMAL, lambda x, _: rational_text(x)))
SHORTS: Kind[Sequence[fmpq]] = Kind(
    Json(S.array(DECIMAL), lambda row, _: [rational_text(x) for x in row])
)
ENTRIES: Kind[Sequence[Number]] = Kind(
    Json(S.array(MADE), lambda row, _: [made_of(x) for x in row])
)
MATRIX: Kind[Sequence[Sequence[Number]]] = Kind(
    Json(S.array(S.array(MADE)), lambda rows, _: [[made_of(x) for x in row] for row in rows])
)
PRINTED: Section[PrintedNumber] = Section(
    Row("printed", SHORT, lambda x: x.printed),
    Row("radius", SHORT, lambda x: x.radius),
    Row("centre", SHORT, lambda x: x.centre),
    Row("width", SHORT, lambda x: x.width),
)
TRACED_COLOUR: Section[Colour] = Section(OF_COLOUR, Row("b", ENTRIES, lambda x: x.b))
TRACED_BLOCK: Section[Block] = Section(OF_BLOCK, Row("A", MATRIX, lambda x: x[1]))
CONDITION: Section[tuple[Tree, tuple[fmpq, ...]]] = Section(
    Row("tree", TREE, lambda x: x[0]), Row("W", SHORTS, lambda x: x[1])
)
FACTOR: Section[tuple[Tree, fmpq]] = Section(
    Row("tree", TREE, lambda x: x[0]), Row("factor", SHORT, lambda x: x[1])
)
EXISTING: Section[ExistenceProof] = Section(
    Row("spaces", parts(Section(STAGES)), lambda x: x.tableau.spaces, DATA),
    Row("colours", parts(TRACED_COLOUR), lambda x: x.tableau.colours, DATA),
    Row("blocks", parts(TRACED_BLOCK), lambda x: _blocks(x.tableau), DATA),
    Row("order", COUNT, lambda x: x.order.order, DATA),
    Row("conditions", parts(CONDITION), lambda x: x.conditions, DATA),
    maybe("witness", parts(FACTOR), lambda x: x.witness, DATA),
)
WITHIN: Section[ExistenceProof] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    itself("order", told(_exists), HEADLINE),
    Row("excluded", SAID, _excluded, label="next order"),
    Row("numbers", parts(PRINTED), lambda x: x.numbers, DATA),
    itself("method", part(EXISTING), DATA),
    itself("spanning_in_words", rows_of(_condition_rows), DETAIL),
    title=lambda x, d: d.prose(x.name),
)


def form(proof: MethodProof | ExistenceProof) -> Section[Any]:
    return EXACT if isinstance(proof, MethodProof) else WITHIN


REPORT: Report[MethodProof | ExistenceProof] = Report(
    "gark/certificate/1", "certificate of gark certificate", lambda: [EXACT, WITHIN], form, key=""
)
