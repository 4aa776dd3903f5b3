"""One member of a family of methods: its tableau with values for the parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import cast

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.errors import VanishingDenominator
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.parametric import Parameters, Parametric, fraction
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau


def member(tableau: Tableau, ring: Parameters, values: Mapping[str, Number]) -> Tableau:
    """The tableau with every parameter replaced by its value.

    Args:
        tableau: entries are rational numbers and rational functions of the parameters.
        ring: the parameters.
        values: of each of them, all in one field.

    Raises:
        VanishingDenominator: a denominator is zero there.
    """
    at = _At([values[name] for name in ring.names])
    spaces = tuple(at.space(space) for space in tableau.spaces)
    colours = tuple(
        replace(colour, b=at.vector(colour.b), c=at.vector(colour.c)) for colour in tableau.colours
    )
    blocks = {key: at.matrix(block) for key, block in tableau.blocks.items()}
    return Tableau(spaces, colours, blocks)


def value_of(polynomial: fmpq_mpoly, ring: Parameters, values: Mapping[str, Number]) -> Number:
    """A polynomial in the parameters at one point."""
    return _At([values[name] for name in ring.names]).polynomial(polynomial)


class _At:
    """Evaluates rational functions at one point."""

    def __init__(self, values: list[Number]) -> None:
        self.values = values
        functions = [x for x in cast("list[object]", values) if isinstance(x, Parametric)]
        self._ring = functions[0].ring if functions else None
        self._monomials = None if self._ring is None else _monomials(values, self._ring)

    def space(self, space: StageSpace) -> StageSpace:
        if isinstance(space, PointSpace):
            return PointSpace(self.vector(space.points))
        return space

    def matrix(self, rows: Matrix) -> Matrix:
        return tuple(self.vector(row) for row in rows)

    def vector(self, row: Vector) -> Vector:
        return tuple(self.number(x) for x in row)

    def number(self, x: object) -> Number:
        if not isinstance(x, Parametric):
            return cast("fmpq", x)
        denominator = self.polynomial(x.denominator)
        if not denominator:
            raise VanishingDenominator(
                "a denominator is zero: no method has these values", f"it is that of {x}"
            )
        return self.polynomial(x.numerator) / denominator

    def polynomial(self, polynomial: fmpq_mpoly) -> Number:
        check_time()
        if self._ring is not None and self._monomials is not None:
            # parameters that have other names, or values
            found = polynomial.compose(*self._monomials, ctx=self._ring.context)
            return cast("Number", self._ring.quotient(found, self._ring.constant(fmpq(1))))
        total: Number = ZERO
        for exponents, a in polynomial.to_dict().items():
            term: Number = ONE * fmpq(a)
            for value, exponent in zip(self.values, exponents, strict=True):
                for _ in range(int(exponent)):
                    term = term * value
            total = total + term
        return total


def _monomials(values: list[Number], ring: Parameters) -> list[fmpq_mpoly] | None:
    """Values as polynomials of one term each; None where they are others."""
    found = []
    for x in values:
        if not isinstance(x, (fmpq, Parametric)):
            return None
        numerator, denominator = fraction(x, ring)
        if len(numerator) > 1 or not denominator.is_one():
            return None
        found.append(numerator)
    return found
