"""``gark certificate``: a proof that can be checked without this package.

In JSON rational numbers are text; a number of ℚ(θ) is the list of its coordinates in 1, θ, θ², …;
trees are written in brackets. Colours and stage spaces count from 1. ``docs/certificate.md`` has
the format.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

from flint import fmpq, fmpq_poly

from garkcli.check.analysis import MethodProof
from garkcli.errors import counted
from garkcli.exact.cells import between
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number, NumberField, coordinates
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.frozen import replace
from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import Proof
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Kind, Level, Row, Section, maybe, optional
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TEXT, TREE, TRUTH, choice, order_answer
from garkcli.tell.parts import part, parts, rows_of, told
from garkcli.tell.report import Report
from garkcli.version import __version__

HEADLINE, USUAL, DETAIL, DATA = Level
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that says which root θ is."""
In: TypeAlias = "tuple[Any, int]"
"""A part of a tableau over a field of some degree."""


# for people


def _signs(proof: Proof, d: Plain) -> Plain:
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
    mantissa, exponent = ball.mid().man_exp()
    near = fmpq(mantissa) * fmpq(2) ** int(exponent)
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
COLOUR = Section(
    Row("name", TEXT, "0.name"),
    Row("space", INDEX, "0.space"),
    Row("drives", choice("y", "q", "p"), "0.part"),
    Row("linear", TRUTH, "0.is_linear"),
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


def _all(get: Callable[[Any], Iterable[Any]]) -> Callable[[Proof], list[In]]:
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


REPORT: Report[MethodProof] = Report.only(
    "gark/certificate/1",
    "certificate of gark certificate",
    Section(
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
    ),
)


def whole(proof: MethodProof, _: str) -> MethodProof:
    """What the report says of a proof, which has a name."""
    return proof
