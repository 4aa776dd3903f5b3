"""The adjoint of a method: the inverse of its step with −h.

It has the same weights and the blocks 𝟙 b_mᵀ − A^{l,m}, its nodes are 1 − c: E. Hairer, C. Lubich,
G. Wanner, *Geometric Numerical Integration*, section V.2. Stages at points are put in the opposite
order, so that those of a composition stay in turn; a stage algebra is reflected, x → 1 − x.
"""

from __future__ import annotations

from dataclasses import replace

from flint import fmpq, fmpq_poly

from garkcli.constructions.composition import advance
from garkcli.exact.field import Number
from garkcli.exact.matrix import (
    Matrix,
    Vector,
    apply,
    apply_left,
    identity,
    multiply,
    outer,
    subtract,
)
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Edge, Tableau


def adjoint(tableau: Tableau) -> Tableau:
    """The adjoint method; the adjoint of that is the method itself."""
    turns = [_turn(space) for space in tableau.spaces]
    colours = []
    for l, colour in enumerate(tableau.colours):
        turn = turns[colour.space]
        end = advance(tableau, l)
        own = tableau.spaces[colour.space].one
        rest_of_time = [end * one - c for one, c in zip(own, colour.c, strict=True)]
        b, c = apply_left(colour.b, turn), apply(turn, rest_of_time)
        colours.append(replace(colour, b=b, c=c))
    blocks: dict[Edge, Matrix] = {}
    for (k, m), block in tableau.blocks.items():
        colour = tableau.colours[m]
        rest = subtract(outer(tableau.spaces[k].one, colour.b), block)
        blocks[k, m] = multiply(turns[k], multiply(rest, turns[colour.space]))
    spaces: list[StageSpace] = []
    for k, space in enumerate(tableau.spaces):
        nodes_of = next((x.c for x in colours if x.space == k), space.nodes)
        spaces.append(_turned_space(space, nodes_of))
    return Tableau(tuple(spaces), tuple(colours), blocks)


def _turned_space(space: StageSpace, nodes: Vector) -> StageSpace:
    """The space of the turned stages."""
    if isinstance(space, PolynomialSpace):
        modulus = space.modulus(fmpq_poly([1, -1]))
        return PolynomialSpace(modulus / modulus.leading_coefficient())
    return PointSpace(nodes)


def _turn(space: StageSpace) -> Matrix:
    """The opposite order of stages, or f(x) → f(1 − x) on polynomials; its own inverse."""
    if not isinstance(space, PolynomialSpace):
        return tuple(reversed(identity(space.stages)))
    columns: list[list[Number]] = []
    power = fmpq_poly([1])
    for _ in range(space.stages):
        columns.append([fmpq(power[i]) for i in range(space.stages)])
        power *= fmpq_poly([1, -1])
    return tuple(zip(*columns, strict=True))
