"""``gark certificate``: a proof that can be checked without this package.

In JSON rational numbers are text; a number of ℚ(θ) is the list of its coordinates in 1, θ, θ², …;
trees are written in brackets. Colours and stage spaces count from 1. ``docs/certificate.md`` has
the format. That of a rounded method proves that one within its rounding has the order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeAlias

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
from garkcli.tell.facts import Kind, Level, Row, Section, maybe, optional
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TEXT, TREE, TRUTH, choice, order_answer
from garkcli.tell.parts import part, parts, rows_of, told
from garkcli.tell.report import Report
from garkcli.version import __version__

if TYPE_CHECKING:
    from garkcli.check.existing import ExistenceProof

HEADLINE, USUAL, DETAIL, DATA = Level
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that says which root θ is."""
In: TypeAlias = "tuple[Any, int]"
"""A part of a tableau over a field of some degree."""


# for people


def _signs(proof: Proof | ExistenceProof, d: Plain) -> Plain:
    """The signs for the trees of a method, its conjugate or its pair."""
    return replace(d, colours=[colour.name for colour in proof.tableau.colours])


def _proved(proof: Proof, d: Plain) -> str:
    """An order, by how many trees it is proved, and the tree that fails."""
    found = proof.order
    count = sum(len(trees) for by_colour in proof.spanning for trees in by_colour)
    order = d.known(str(found.order), order_answer(found).status)
    text = f"{order}, proved by {counted(count, 'tree')}"
    return text if found.witness is None else f"{text}; {_signs(proof, d).failure(found.witness)}"


def _tree_rows(proof: Proof, d: Plain) -> list[tuple[str, str]]:
    """The trees that span those of each order, colour after colour."""
    d = _signs(proof, d)
    return [
        (f"order {k}", ", ".join(d.tree(tree) for trees in by_colour for tree in trees))
        for k, by_colour in enumerate(proof.spanning, start=1)
    ]


# for programs


def _texts(polynomial: fmpq_poly) -> list[str]:
    """The coefficients of a polynomial, lowest first."""
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
RATIONALS = Kind(S.array(RATIONAL))
NUMBERS = Kind(S.array(NUMBER))
FIELD = Section(
    Row("modulus", RATIONALS, lambda x: _texts(x.modulus)),
    Row("theta_between", RATIONALS, _theta_between),
)
SPACE = Section(
    Row("stages", POSITION),
    optional("modulus", RATIONALS, _modulus),
    optional("between_nodes", RATIONALS, _between),
)
VERTICES = Section(
    Row("branches", Kind(S.array(S.one_of({"enum": [0, 1, 2]}))), lambda kind: sorted(kind.arity)),
    Row("weight", POSITION, "weight"),
    Row("in_solution", TRUTH, "is_exact"),
)


def _own_kind(colour: In) -> VertexKind | None:
    """The kind of vertices where the key ``linear`` does not say it."""
    kind: VertexKind = colour[0].kind
    return None if kind in FIELDS else kind


COLOUR = Section(
    Row("name", TEXT, "0.name"),
    Row("space", INDEX, "0.space"),
    Row("drives", choice("y", "q", "p"), "0.part"),
    Row("linear", TRUTH, "0.is_linear"),
    optional("vertices", part(VERTICES), _own_kind),
    Row("b", NUMBERS, lambda x: _numbers(x[0].b, x[1])),
)
BLOCK = Section(
    Row("space", INDEX, "0.0.0"),
    Row("colour", INDEX, "0.0.1"),
    Row("A", Kind(S.array(S.array(NUMBER))), lambda x: [_numbers(row, x[1]) for row in x[0][1]]),
)
WITNESS = Section(
    Row("tree", TREE, "0.tree"),
    Row("value", Kind(NUMBER), lambda x: _number(x[0].value, x[1])),
    Row("required", Kind(RATIONAL), lambda x: str(x[0].required)),
)


def _all(get: Callable[[Any], Iterable[Any]]) -> Callable[[Any], list[In]]:
    """Parts of a tableau with the degree of its numbers."""
    return lambda proof: [(x, proof.tableau.degree) for x in get(proof.tableau)]


def _witness(proof: Proof) -> In | None:
    """The tree that fails; None where the search ended at its limit."""
    witness = proof.order.witness
    return None if witness is None else (witness, proof.tableau.degree)


TREES = Kind(
    S.array(S.array(S.array(S.TEXT))),
    lambda spanning, _: [
        [[format_tree(tree) for tree in trees] for trees in by_colour] for by_colour in spanning
    ],
)
TRUE_OF = [
    Row("order", COUNT, "order.order", DATA),
    Row("spanning", TREES, level=DATA),
    maybe("witness", part(WITNESS), _witness, DATA),
    Row("spanning_in_words", rows_of(_tree_rows), ".", DETAIL),
]
TRUTH_OF = Section(*TRUE_OF)
PROOF = Section(
    Row("spaces", parts(SPACE), "tableau.spaces", DATA),
    Row("colours", parts(COLOUR), _all(lambda tableau: tableau.colours), DATA),
    Row("blocks", parts(BLOCK), _all(lambda tableau: sorted(tableau.blocks.items())), DATA),
    *TRUE_OF,
)


def _pair(proof: MethodProof) -> Proof | None:
    """The pair where a reader can make it, of the method and its conjugate."""
    return None if proof.conjugate is None else proof.pair


EXACT = Section(
    Row("name", TEXT, level=DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    maybe("field", part(FIELD), "method.tableau.field", DATA),
    Row("order", told(_proved), "method", HEADLINE),
    Row("conjugate_order", told(_proved), "conjugate"),
    Row("pair_order", told(_proved), "pair"),
    Row("method", part(PROOF), level=DETAIL),
    optional("conjugate", part(PROOF), level=DETAIL),
    optional("pair", part(TRUTH_OF), _pair, DETAIL),
    optional("no_conjugate", TEXT, lambda x: str(x.obstacle) or None),
    title=lambda x, d: d.prose(x.name),
)


# of rounded methods


def _exists(proof: ExistenceProof, d: Plain) -> str:
    """The order, and by how many conditions a method with it is proved to exist."""
    found = proof.order
    status = replace(order_answer(found).status, open=NO_REASON, at_least=proof.witness is None)
    order = d.known(str(found.order), status)
    count = counted(len(proof.conditions), "condition")
    return f"{order}: a method is proved to exist by {count}"


def _excluded(proof: ExistenceProof) -> str | None:
    """By how many conditions the next order is excluded."""
    order, count = proof.order.order + 1, len(proof.witness or ())
    if count:
        how = "a condition excludes" if count == 1 else f"{count} conditions together exclude"
        return f"no method within the tolerance has order {order}: {how} it"
    if proof.order.witness is None:
        return None
    return f"that order {order} fails is left out: it takes more than a sum of conditions"


def _condition_rows(proof: ExistenceProof, d: Plain) -> list[tuple[str, str]]:
    """The conditions of each order."""
    d = _signs(proof, d)
    trees = [tree for tree, _ in proof.conditions]
    orders = range(1, proof.order.order + 1)
    return [(f"order {k}", ", ".join(d.tree(u) for u in trees if u.order == k)) for k in orders]


DECIMAL: S.Schema = {"type": "string", "pattern": r"^-?\d+([/.]\d+)?$"}
"""A rational number, also in decimals."""
MADE: S.Schema = S.one_of(DECIMAL, {"type": "integer"}, {"type": "array"})
"""How an entry is made: a rational number, the number of a printed one, or [sign, one, other]."""
SHORT = Kind(DECIMAL, lambda x, _: rational_text(x))
SHORTS = Kind(S.array(DECIMAL), lambda row, _: [rational_text(x) for x in row])
PRINTED = Section(
    Row("printed", SHORT), Row("radius", SHORT), Row("centre", SHORT), Row("width", SHORT)
)
OF_COLOUR = Section(
    *COLOUR.rows[:-1], Row("b", Kind(S.array(MADE)), lambda x: [made_of(a) for a in x[0].b])
)
OF_BLOCK = Section(
    *BLOCK.rows[:2],
    Row("A", Kind(S.array(S.array(MADE))), lambda x: [[*map(made_of, row)] for row in x[0][1]]),
)
CONDITION = Section(Row("tree", TREE, "0"), Row("W", SHORTS, "1"))
FACTOR = Section(Row("tree", TREE, "0"), Row("factor", SHORT, "1"))
EXISTING = Section(
    Row("spaces", parts(Section(SPACE.rows[0])), "tableau.spaces", DATA),
    Row("colours", parts(OF_COLOUR), _all(lambda tableau: tableau.colours), DATA),
    Row("blocks", parts(OF_BLOCK), _all(lambda tableau: sorted(tableau.blocks.items())), DATA),
    Row("order", COUNT, "order.order", DATA),
    Row("conditions", parts(CONDITION), level=DATA),
    maybe("witness", parts(FACTOR), level=DATA),
)
WITHIN = Section(
    Row("name", TEXT, level=DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    Row("order", told(_exists), ".", HEADLINE),
    Row("excluded", told(lambda text, d: d.prose(text)), _excluded, label="next order"),
    Row("numbers", parts(PRINTED), level=DATA),
    Row("method", part(EXISTING), ".", DATA),
    Row("spanning_in_words", rows_of(_condition_rows), ".", DETAIL),
    title=lambda x, d: d.prose(x.name),
)

REPORT: Report[Any] = Report(
    "gark/certificate/1",
    "certificate of gark certificate",
    lambda: [EXACT, WITHIN],
    lambda proof: EXACT if isinstance(proof, MethodProof) else WITHIN,
    key="",
)


def whole(proof: Any, _: str) -> Any:
    """What the report says of a proof, which has a name."""
    return proof
