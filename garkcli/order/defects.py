"""By how much B, C and D are missed: exact elements and functionals of stage spaces, zero where a
condition holds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.exact.linear_map import EntrywiseMap, LinearMap
from garkcli.exact.matrix import Vector, dot
from garkcli.tableau import conjugate
from garkcli.tableau.meant import printed
from garkcli.tableau.tableau import Edge, Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded_defects import RoundedDefects
    from garkcli.tableau.meant import AnyTableau


class Defects:
    """Left side minus right side of the conditions on one tableau, with the powers of its nodes
    kept.
    """

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._maps: dict[Edge, LinearMap | EntrywiseMap] = {}
        # for each colour the powers c⁰, c¹, … of its nodes
        self._powers: list[list[Vector]] = []
        for l in range(tableau.size):
            one = tableau.space(l).one
            self._powers.append([one])

    def power(self, l: int, exponent: int) -> Vector:
        """c^l to a power."""
        space = self.tableau.space(l)
        c = self.tableau.colours[l].c
        powers = self._powers[l]
        while len(powers) <= exponent:
            last = powers[-1]
            following = space.product(last, c)
            powers.append(following)
        return powers[exponent]

    @staticmethod
    def vanish(defects: Vector) -> bool:
        """Whether they are all zero."""
        return not any(defects)

    def B(self, l: int, k: int) -> Vector:  # noqa: N802 -- the paper's letter
        """b_l(c_l^(k−1)) − 1/k, eq. (B)."""
        b = self.tableau.colours[l].b
        mean = dot(b, self.power(l, k - 1))
        return (mean - fmpq(1, k),)

    def C(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """A^{l,m} c_m^(k−1) − c_l^k / k, eq. (C): an element of the space of l; with k = 1 eq.
        (Aone).
        """
        power = self.power(m, k - 1)
        (image,) = self._map(l, m).images([power])
        return _minus_part(image, self.power(l, k), k)

    def D(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """b_l(c_l^(k−1) A^{l,m} g) − b_m((1 − c_m^k) g) / k, eq. (D): a functional of g in the
        space of m.
        """
        here = self.tableau.space(l)
        there = self.tableau.space(m)
        b_l = self.tableau.colours[l].b
        b_m = self.tableau.colours[m].b
        power = self.power(l, k - 1)
        weighted = here.times(b_l, power)
        (left,) = self._map(l, m).pullbacks([weighted])
        power = self.power(m, k)
        rest = _minus_part(there.one, power, 1)
        right = there.times(b_m, rest)
        return _minus_part(left, right, k)

    def _map(self, l: int, m: int) -> LinearMap | EntrywiseMap:
        key = self.tableau.colours[l].space, m
        if key not in self._maps:
            block = self.tableau.blocks[key]
            if self.tableau.has_parameters:
                self._maps[key] = EntrywiseMap(block)
            else:
                self._maps[key] = LinearMap(block, self.tableau.field)
        return self._maps[key]


def _minus_part(u: Vector, v: Vector, k: int) -> Vector:
    """The difference u − v/k."""
    pairs = zip(u, v, strict=True)
    difference = [x - y / k for x, y in pairs]
    return tuple(difference)


def is_symplectic(method: AnyTableau) -> bool:
    """Whether b_i b_j = b_i a_ij + b_j a_ji between all colours that the symplectic form pairs:
    exactly, or as far as rounding lets it be.
    """
    if isinstance(method, Tableau) or method.obstacle:
        return conjugate.is_symplectic(printed(method))
    from garkcli.order.rounded_defects import is_symplectic_within

    return is_symplectic_within(method)


def defects_of(method: AnyTableau) -> Defects | RoundedDefects:
    """The defects of a tableau, over its box where it is rounded."""
    if isinstance(method, Tableau) or method.obstacle:
        return Defects(printed(method))
    # balls, which exact methods do without
    from garkcli.order.rounded_defects import RoundedDefects

    return RoundedDefects(method)
