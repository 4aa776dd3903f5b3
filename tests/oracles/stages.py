"""Arithmetic of stage values, written a second time: only the data of a tableau is taken from the
engine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace


def one(space: StageSpace) -> Vector:
    """𝟙: a one for each point, or the constant polynomial 1."""
    s = space.stages
    if isinstance(space, PolynomialSpace):
        return tuple(fmpq(int(k == 0)) for k in range(s))
    return (fmpq(1),) * s


def product(space: StageSpace) -> Callable[[Vector, Vector], Vector]:
    """The product ⊙ of a stage space: stage by stage, or of polynomials with the remainder taken by
    hand.
    """
    if not isinstance(space, PolynomialSpace):
        return lambda u, v: tuple(x * y for x, y in zip(u, v, strict=True))
    s = space.stages
    modulus = [space.modulus[k] for k in range(s)]
    assert space.modulus[s] == 1

    def multiplied(u: Vector, v: Vector) -> Vector:
        out: list[Number] = [fmpq(0)] * (2 * s - 1)
        for i, x in enumerate(u):
            for j, y in enumerate(v):
                out[i + j] = out[i + j] + x * y
        while len(out) > s:
            top = out.pop()
            for k in range(s):
                position = len(out) - s + k
                out[position] = out[position] - top * modulus[k]
        return tuple(out)

    return multiplied


def pairing(u: Sequence[Number], v: Sequence[Number]) -> Number:
    """Σ u_i v_i."""
    total: Number = fmpq(0)
    for x, y in zip(u, v, strict=True):
        total = total + x * y
    return total


def image(block: Matrix, v: Sequence[Number]) -> Vector:
    """The vector A v."""
    return tuple(pairing(row, v) for row in block)
