"""A tableau over ℚ[x]/(M) entry by entry, from the definition a_{ij} = (A L_j)(c_i) and given
nodes.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.frozen import replace
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Method, Tableau
from tests.oracles.stages import image, pairing


def numbers(*texts: str) -> tuple[Vector, ...]:
    """Rows of numbers of one common domain, written as texts with commas between the numbers."""
    rows = [[parse(entry) for entry in text.split(",")] for text in texts]
    domain = Domain(expression for row in rows for expression in row)
    return tuple(tuple(domain.evaluate(expression) for expression in row) for row in rows)


def lagrange(nodes: Sequence[Number], j: int) -> Vector:
    """The coefficients of L_j, lowest first."""
    result: list[Number] = [fmpq(1)]
    for k, c in enumerate(nodes):
        if k != j:
            shifted, scale = [fmpq(0), *result], nodes[j] - c
            result = [(x - c * y) / scale for x, y in zip(shifted, [*result, fmpq(0)], strict=True)]
    return tuple(result)


def value(polynomial: Sequence[Number], x: Number) -> Number:
    """The value of a polynomial, lowest coefficient first."""
    total: Number = fmpq(0)
    for coefficient in reversed(polynomial):
        total = total * x + coefficient
    return total


def block_at(block: Matrix, rows: Sequence[Number], columns: Sequence[Number]) -> Matrix:
    """The entries (A L_j)(c_i)."""
    images = [image(block, lagrange(columns, j)) for j in range(len(columns))]
    return tuple(tuple(value(f, c) for f in images) for c in rows)


def method_at(method: Method, nodes: Vector) -> Method:
    """A diagonal method of a polynomial space, entry by entry."""
    weights = tuple(pairing(method.b, lagrange(nodes, j)) for j in range(len(nodes)))
    return Method(method.name, PointSpace(nodes), block_at(method.A, nodes, nodes), weights)


def at_points(tableau: Tableau, nodes: Sequence[Vector]) -> Tableau:
    """A tableau whose spaces are all polynomial ones, with the nodes of each space given."""

    def nodes_of(m: int) -> Vector:
        return nodes[tableau.colours[m].space]

    blocks = {
        (k, m): block_at(block, nodes[k], nodes_of(m)) for (k, m), block in tableau.blocks.items()
    }
    colours = tuple(
        replace(
            colour,
            b=tuple(pairing(colour.b, lagrange(nodes_of(m), j)) for j in range(len(nodes_of(m)))),
            c=tuple(value(colour.c, x) for x in nodes_of(m)),
        )
        for m, colour in enumerate(tableau.colours)
    )
    return Tableau(tuple(PointSpace(points) for points in nodes), colours, blocks)
