"""By how much B, C, D and symplecticity are missed: exact elements and functionals of stage spaces,
zero where a condition holds, or balls where coefficients are rounded.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq

from garkcli.exact.linear_map import EntrywiseMap, LinearMap
from garkcli.exact.matrix import Matrix, Vector, dot
from garkcli.tableau import conjugate
from garkcli.tableau.meant import printed
from garkcli.tableau.tableau import Edge, Tableau

if TYPE_CHECKING:
    from garkcli.tableau.meant import AnyTableau
    from garkcli.tableau.rounded import RoundedTableau


class Defects:
    """Left side minus right side of the conditions on one tableau, with the powers of its nodes
    kept.

    Args:
        tableau: as it is printed.
        entries: what is computed with, its own entries or others in their place.
    """

    def __init__(self, tableau: Tableau, entries: Tableau | None = None) -> None:
        self.tableau = tableau
        self.entries = entries or tableau
        self._maps: dict[Edge, LinearMap | EntrywiseMap] = {}
        # for each colour the powers c⁰, c¹, … of its nodes
        self._powers = [[self.entries.space(l).one] for l in range(tableau.size)]

    def power(self, l: int, exponent: int) -> Vector:
        """c^l to a power."""
        powers = self._powers[l]
        while len(powers) <= exponent:
            powers.append(self.entries.space(l).product(powers[-1], self.entries.colours[l].c))
        return powers[exponent]

    def precision(self) -> AbstractContextManager[object]:
        """That of the arithmetic inside."""
        return nullcontext()

    def vanish(self, defects: Iterable[Any]) -> bool:
        """Whether they are all zero."""
        return not any(defects)

    def B(self, l: int, k: int) -> Vector:  # noqa: N802 -- the paper's letter
        """b_l(c_l^(k−1)) − 1/k, eq. (B)."""
        with self.precision():
            mean = dot(self.entries.colours[l].b, self.power(l, k - 1))
            return (mean - fmpq(1, k),)

    def C(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """A^{l,m} c_m^(k−1) − c_l^k / k, eq. (C): an element of the space of l; with k = 1 eq.
        (Aone).
        """
        with self.precision():
            (image,) = self._map(l, m).images([self.power(m, k - 1)])
            return _minus_part(image, self.power(l, k), k)

    def D(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """b_l(c_l^(k−1) A^{l,m} g) − b_m((1 − c_m^k) g) / k, eq. (D): a functional of g in the
        space of m.
        """
        here, there = self.entries.space(l), self.entries.space(m)
        b_l, b_m = self.entries.colours[l].b, self.entries.colours[m].b
        with self.precision():
            weighted = here.times(b_l, self.power(l, k - 1))
            (left,) = self._map(l, m).pullbacks([weighted])
            rest = _minus_part(there.one, self.power(m, k), 1)
            return _minus_part(left, there.times(b_m, rest), k)

    def _map(self, l: int, m: int) -> LinearMap | EntrywiseMap:
        key = self.tableau.colours[l].space, m
        if key not in self._maps:
            self._maps[key] = self._made_ready(self.entries.blocks[key])
        return self._maps[key]

    def _made_ready(self, block: Matrix) -> LinearMap | EntrywiseMap:
        if self.tableau.has_parameters:
            return EntrywiseMap(block)
        return LinearMap(block, self.tableau.field)


class RoundedDefects(Defects):
    """The defects of the methods that a tableau may be a rounding of: balls, which hold 0 where
    rounding explains the defect.

    Their entries belong to stages, also where the exact defects are elements of a stage algebra.
    """

    def __init__(self, rounded: RoundedTableau) -> None:
        super().__init__(rounded.tableau, rounded.in_balls)
        self._bits = rounded.bits

    def precision(self) -> AbstractContextManager[object]:
        return ctx.workprec(self._bits)

    def vanish(self, defects: Iterable[Any]) -> bool:
        """Whether rounding explains them all."""
        return all(x.is_finite() and x.contains(0) for x in map(arb, defects))

    def _made_ready(self, block: Matrix) -> EntrywiseMap:
        return EntrywiseMap(block)


def _minus_part(u: Vector, v: Vector, k: int) -> Vector:
    """The difference u − v/k."""
    return tuple(x - y / k for x, y in zip(u, v, strict=True))


def is_symplectic(method: AnyTableau) -> bool:
    """Whether b_i b_j = b_i a_ij + b_j a_ji between all colours that the symplectic form pairs:
    exactly, or as far as rounding lets it be.
    """
    defects = defects_of(method)
    with defects.precision():
        return defects.vanish(conjugate.symplectic_defects(defects.entries))


def defects_of(method: AnyTableau) -> Defects:
    """The defects of a tableau, over its box where it is rounded."""
    if isinstance(method, Tableau) or method.obstacle:
        return Defects(printed(method))
    return RoundedDefects(method)
