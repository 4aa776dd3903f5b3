"""Defects: both sides of the simplifying conditions subtracted, exactly or in balls."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.exact.enclosing import bits_for
from garkcli.exact.matrix import EntrywiseMap, LinearMap, Matrix, Vector, dot
from garkcli.tableau.tableau import Edge, Tableau


class Defects:
    """The conditions on a tableau as left minus right sides, computed with ``entries``."""

    def __init__(self, tableau: Tableau, entries: Tableau | None = None) -> None:
        self.tableau = tableau
        self.entries = entries or tableau
        self._maps: dict[Edge, LinearMap | EntrywiseMap] = {}
        # for each colour the powers c⁰, c¹, … of its nodes
        self._powers = [[self.entries.space(l).one] for l in range(tableau.size)]

    def power(self, l: int, exponent: int) -> Vector:
        powers = self._powers[l]
        while len(powers) <= exponent:
            powers.append(self.entries.space(l).product(powers[-1], self.entries.colours[l].c))
        return powers[exponent]

    def precision(self) -> AbstractContextManager[object]:
        return nullcontext()

    def weights(self, l: int) -> Vector:
        return self.entries.colours[l].b

    def before(self, l: int, m: int, w: Vector) -> Vector:
        """wᵀ A^{l,m}, a functional on the space of m."""
        with self.precision():
            (found,) = self._map(l, m).pullbacks([w])
        return found

    def vanish(self, defects: Iterable[Any]) -> bool:
        return not any(defects)

    def B(self, l: int, k: int) -> Vector:  # noqa: N802 -- the paper's letter
        """b_l(c_l^(k−1)) − 1/k, eq. (B)."""
        with self.precision():
            return (dot(self.entries.colours[l].b, self.power(l, k - 1)) - fmpq(1, k),)

    def C(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """A^{l,m} c_m^(k−1) − c_l^k / k, eq. (C), in the space of l; with k = 1 eq. (Aone)."""
        with self.precision():
            (image,) = self._map(l, m).images([self.power(m, k - 1)])
            return _minus_part(image, self.power(l, k), k)

    def D(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """b_l(c_l^(k−1) A^{l,m} g) − b_m((1 − c_m^k) g) / k, eq. (D), a functional of g."""
        here, there = self.entries.space(l), self.entries.space(m)
        b_l, b_m = self.entries.colours[l].b, self.entries.colours[m].b
        with self.precision():
            weighted = here.times(b_l, self.power(l, k - 1))
            (left,) = self._map(l, m).pullbacks([weighted])
            rest = _minus_part(there.one, self.power(m, k), 1)
            return _minus_part(left, there.times(b_m, rest), k)

    def even(self, l: int, m: int, k: int) -> Vector:
        """b_l(c_l^k A^{l,m} c_m^k) − 1/(2 (k + 1)²), for a pair of even order 2k + 2."""
        with self.precision():
            (image,) = self._map(l, m).images([self.power(m, k)])
            b_l = self.entries.colours[l].b
            weighted = self.entries.space(l).times(b_l, self.power(l, k))
            return (dot(weighted, image) - fmpq(1, 2 * (k + 1) ** 2),)

    def of(self, letter: str, l: int, m: int, k: int) -> Vector:
        """The defect of a condition by its letter; a condition B belongs to colour l."""
        found: Vector = self.B(l, k) if letter == "B" else getattr(self, letter)(l, m, k)
        return found

    def _map(self, l: int, m: int) -> LinearMap | EntrywiseMap:
        key = self.tableau.colours[l].space, m
        if key not in self._maps:
            self._maps[key] = self._made_ready(self.entries.blocks[key])
        return self._maps[key]

    def _made_ready(self, block: Matrix) -> LinearMap | EntrywiseMap:
        if self.tableau.has_parameters:
            return EntrywiseMap(block)
        return LinearMap(block, self.tableau.field)


class BoxDefects(Defects):
    """The defects of a box on point stages as balls: they contain 0 if one method has none."""

    def __init__(self, tableau: Tableau, balls: Tableau, bits: int) -> None:
        super().__init__(tableau, balls)
        self._bits = bits

    def precision(self) -> AbstractContextManager[object]:
        return ctx.workprec(self._bits)

    def vanish(self, defects: Iterable[Any]) -> bool:
        return all(x.is_finite() and x.contains(0) for x in map(arb, defects))

    def _made_ready(self, block: Matrix) -> EntrywiseMap:
        return EntrywiseMap(block)


class RoundedDefects(BoxDefects):
    def __init__(self, near: Tableau, grain: fmpq) -> None:
        from garkcli.tableau.enclosure import in_balls  # balls, which exact methods do without

        bits = bits_for(grain)
        super().__init__(near, in_balls(near, grain, bits), bits)


def _minus_part(u: Vector, v: Vector, k: int) -> Vector:
    return tuple(x - y / k for x, y in zip(u, v, strict=True))
