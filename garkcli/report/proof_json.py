"""``gark certificate``: a proof as JSON that can be checked without this package.

Rational numbers are text; a number of ℚ(θ) is the list of its coordinates in 1, θ, θ², …; trees
are written in brackets. Colours and stage spaces count from 1. ``docs/certificate.md`` has the
format.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Generic, NamedTuple, TypeAlias, TypeVar

from flint import fmpq, fmpq_poly

from garkcli.check.proof import MethodProof
from garkcli.exact.cells import between
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number, NumberField, coordinates
from garkcli.exact.matrix import Matrix
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.order.certificate import Witness
from garkcli.order.proof import Proof
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, array, one_of, published
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Colour, Tableau
from garkcli.trees.notation import format_tree
from garkcli.version import __version__

SCHEMA = "gark/certificate/1"
Part = TypeVar("Part")
_Block: TypeAlias = tuple[tuple[int, int], Matrix]
"""The rows of a block, with its stage space and colour."""
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that says which root θ is."""


def render(proof: MethodProof) -> str:
    """The proof as JSON text."""
    return _REPORT.text(proof)


def certificate_schema() -> Schema:
    """The JSON Schema of certificates."""
    return published("certificate of gark certificate", _REPORT.schema)


def _texts(polynomial: fmpq_poly) -> list[str]:
    """The coefficients of a polynomial, lowest first."""
    return [str(a) for a in polynomial.coeffs()]


def _coefficients(field: NumberField) -> list[str]:
    """The minimal polynomial of θ, lowest coefficient first."""
    return _texts(field.modulus)


def _theta_between(field: NumberField) -> list[str]:
    """An interval around θ."""
    theta = field.element(fmpq_poly([0, 1]))
    ball = to_ball(theta, DIGITS_OF_ROOT + 10)
    mantissa, exponent = ball.mid().man_exp()
    power = fmpq(2) ** int(exponent)
    near = fmpq(mantissa) * power
    unit = fmpq(1, 10**DIGITS_OF_ROOT)
    units = (near / unit).floor()
    rounded = unit * units
    low = rounded - unit
    high = rounded + 2 * unit
    return [str(low), str(high)]


def _between_nodes(modulus: fmpq_poly) -> list[fmpq]:
    """Points to the left of the nodes, between neighbours, and to the right."""
    polynomial = Polynomial.from_flint(modulus)
    nodes = [root for root, _ in real_roots(polynomial)]
    left_ends = [None, *nodes]
    right_ends = [*nodes, None]
    gaps = zip(left_ends, right_ends, strict=True)
    return [between(a, b) for a, b in gaps]


def _number(number: Number, degree: int) -> str | list[str]:
    if degree == 1:
        return str(number)
    return [str(x) for x in coordinates(number, degree)]


def _between(space: StageSpace) -> list[str] | None:
    if not isinstance(space, PolynomialSpace):
        return None
    points = _between_nodes(space.modulus)
    return [str(x) for x in points]


def _modulus(space: StageSpace) -> list[str] | None:
    if not isinstance(space, PolynomialSpace):
        return None
    return _texts(space.modulus)


class _In(NamedTuple, Generic[Part]):
    """A part of a tableau over a field of some degree."""

    part: Part
    degree: int

    def numbers(self, found: Iterable[Number]) -> list[str | list[str]]:
        """These numbers as text, or as coordinates."""
        return [_number(x, self.degree) for x in found]


_RATIONAL: Schema = {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}
_NUMBER: Schema = one_of(_RATIONAL, array(_RATIONAL))
"""A rational number, or the coordinates of one of ℚ(θ)."""
_FIELD: Record[NumberField] = Record(
    Field("modulus", array(_RATIONAL), _coefficients),
    Field("theta_between", array(_RATIONAL), _theta_between),
)
_SPACE: Record[StageSpace] = Record(
    Field("stages", POSITION, lambda x: x.stages),
    Field("modulus", array(_RATIONAL), _modulus, is_optional=True),
    Field("between_nodes", array(_RATIONAL), _between, is_optional=True),
)
_COLOUR: Record[_In[Colour]] = Record(
    Field("name", TEXT, lambda x: x.part.name),
    Field("space", POSITION, lambda x: x.part.space + 1),
    Field("drives", {"enum": ["y", "q", "p"]}, lambda x: x.part.part),
    Field("linear", FLAG, lambda x: x.part.is_linear),
    Field("b", array(_NUMBER), lambda x: x.numbers(x.part.b)),
)


def _space_of(block: _In[_Block]) -> int:
    space, _ = block.part[0]
    return space + 1


def _colour_of(block: _In[_Block]) -> int:
    _, colour = block.part[0]
    return colour + 1


def _rows_of(block: _In[_Block]) -> list[list[str | list[str]]]:
    _, rows = block.part
    return [block.numbers(row) for row in rows]


_BLOCK: Record[_In[_Block]] = Record(
    Field("space", POSITION, _space_of),
    Field("colour", POSITION, _colour_of),
    Field("A", array(array(_NUMBER)), _rows_of),
)
_WITNESS: Record[_In[Witness]] = Record(
    Field("tree", TEXT, lambda x: format_tree(x.part.tree)),
    Field("value", _NUMBER, lambda x: _number(x.part.value, x.degree)),
    Field("required", _RATIONAL, lambda x: str(x.part.required)),
)


def _parts(tableau: Tableau, parts: Iterable[Part]) -> list[_In[Part]]:
    return [_In(part, tableau.degree) for part in parts]


def _colours(proof: Proof) -> list[_In[Colour]]:
    tableau = proof.tableau
    return _parts(tableau, tableau.colours)


def _blocks(proof: Proof) -> list[_In[_Block]]:
    tableau = proof.tableau
    blocks = sorted(tableau.blocks.items())
    return _parts(tableau, blocks)


def _witness(proof: Proof) -> _In[Witness] | None:
    """The tree that fails; None where the search ended at its limit."""
    witness = proof.order.witness
    if witness is None:
        return None
    return _In(witness, proof.tableau.degree)


def _spanning(proof: Proof) -> list[list[list[str]]]:
    """The trees that span, order by order and colour by colour."""
    written = []
    for by_colour in proof.spanning:
        of_order = []
        for trees in by_colour:
            texts = [format_tree(tree) for tree in trees]
            of_order.append(texts)
        written.append(of_order)
    return written


_TREES: Schema = array(array(array(TEXT)))
_TRUTH: Record[Proof] = Record(
    Field("order", COUNT, lambda x: x.order.order),
    Field("spanning", _TREES, _spanning),
    _WITNESS.or_null("witness", _witness),
)
_PROOF: Record[Proof] = Record(
    _SPACE.every("spaces", lambda x: x.tableau.spaces),
    _COLOUR.every("colours", _colours),
    _BLOCK.every("blocks", _blocks),
    *_TRUTH.fields,
)


def _pair(proof: MethodProof) -> Proof | None:
    """The pair where a reader can make it, of the method and its conjugate."""
    return None if proof.conjugate is None else proof.pair


def _obstacle(proof: MethodProof) -> str | None:
    return proof.obstacle or None


_REPORT: Record[MethodProof] = Record(
    schema_named(SCHEMA),
    Field("name", TEXT, lambda x: x.name),
    Field("version", TEXT, lambda _: __version__),
    _FIELD.or_null("field", lambda x: x.method.tableau.field),
    _PROOF.whole("method", lambda x: x.method),
    _PROOF.optional("conjugate", lambda x: x.conjugate),
    _TRUTH.optional("pair", _pair),
    Field("no_conjugate", TEXT, _obstacle, is_optional=True),
)
