"""``gark certificate``: a proof as JSON that can be checked without this package.

Rational numbers are text; a number of ℚ(θ) is the list of its coordinates in 1, θ, θ², …; trees
are written in brackets. Colours and stage spaces count from 1. ``docs/certificate.md`` has the
format.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from flint import fmpq, fmpq_poly

from garkcli import __version__
from garkcli.check.proof import MethodProof
from garkcli.exact.cells import between
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number, NumberField, coordinates
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.order.certificate import Witness
from garkcli.order.proof import Proof
from garkcli.report.json_text import to_json
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Colour, Tableau
from garkcli.trees.notation import format_tree

Document: TypeAlias = dict[str, Any]
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that says which root θ is."""


def render(proof: MethodProof) -> str:
    """The proof as JSON text."""
    tableau = proof.method.tableau
    document: Document = {
        "schema": "gark/certificate/1",
        "name": proof.name,
        "version": __version__,
        "field": _field(tableau.field),
        "method": _proof(proof.method),
    }
    if proof.conjugate is not None:
        document["conjugate"] = _proof(proof.conjugate)
    if proof.pair is not None:
        document["pair"] = _proof(proof.pair)
        document["pair"]["colour_of"] = _colours_of_pair(tableau, proof.pair.tableau)
    if proof.obstacle:
        document["no_conjugate"] = proof.obstacle
    return to_json(document) + "\n"


def _field(field: NumberField | None) -> Document | None:
    """θ by its minimal polynomial, lowest coefficient first, and an interval around it."""
    if field is None:
        return None
    theta = field.element(fmpq_poly([0, 1]))
    mantissa, exponent = to_ball(theta, DIGITS_OF_ROOT + 10).mid().man_exp()
    near = fmpq(mantissa) * fmpq(2) ** int(exponent)
    unit = fmpq(1, 10**DIGITS_OF_ROOT)
    rounded = unit * (near / unit).floor()
    below, above = rounded - unit, rounded + 2 * unit
    modulus = [str(field.modulus[k]) for k in range(field.degree + 1)]
    return {"modulus": modulus, "theta_between": [str(below), str(above)]}


def _proof(proof: Proof) -> Document:
    data = _tableau(proof.tableau)
    order = proof.order
    data["order"] = order.order
    data["spanning"] = [
        [[format_tree(tree) for tree in trees] for trees in by_colour]
        for by_colour in proof.spanning
    ]
    data["witness"] = _witness(order.witness, proof.tableau.degree)
    return data


def _witness(witness: Witness | None, degree: int) -> Document | None:
    """The tree that fails, None where the search ended at its limit."""
    if witness is None:
        return None
    return {
        "tree": format_tree(witness.tree),
        "value": _number(witness.value, degree),
        "required": str(witness.required),
    }


def _tableau(tableau: Tableau) -> Document:
    degree = tableau.degree
    colours = [_colour(colour, degree) for colour in tableau.colours]
    blocks = []
    for (k, m), block in sorted(tableau.blocks.items()):
        matrix = [[_number(x, degree) for x in row] for row in block]
        blocks.append({"space": k + 1, "colour": m + 1, "A": matrix})
    return {
        "spaces": [_space(space) for space in tableau.spaces],
        "colours": colours,
        "blocks": blocks,
    }


def _colour(colour: Colour, degree: int) -> Document:
    return {
        "name": colour.name,
        "space": colour.space + 1,
        "drives": colour.part,
        "linear": colour.is_linear,
        "b": [_number(x, degree) for x in colour.b],
    }


def _space(space: StageSpace) -> Document:
    """K^s, or K[x]/(M) with M lowest coefficient first and points at which its sign changes."""
    if isinstance(space, PolynomialSpace):
        modulus = [str(space.modulus[k]) for k in range(space.stages + 1)]
        return {
            "stages": space.stages,
            "modulus": modulus,
            "between_nodes": [str(x) for x in _between_nodes(space.modulus)],
        }
    return {"stages": space.stages}


def _between_nodes(modulus: fmpq_poly) -> list[fmpq]:
    """Points to the left of the nodes, between neighbours, and to the right."""
    nodes = [root for root, _ in real_roots(Polynomial.from_flint(modulus))]
    left_ends = [None, *nodes]
    right_ends = [*nodes, None]
    return [between(a, b) for a, b in zip(left_ends, right_ends, strict=True)]


def _number(number: Number, degree: int) -> str | list[str]:
    if degree == 1:
        return str(number)
    return [str(x) for x in coordinates(number, degree)]


def _colours_of_pair(tableau: Tableau, both: Tableau) -> list[int]:
    """Which colour of the method each colour of the pair comes from."""
    return [index % tableau.size + 1 for index in range(both.size)]
