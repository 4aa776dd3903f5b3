"""By how much B, C and D are missed, and which symplectic tableaus are so within a tolerance.

A defect is an exact element, functional or bilinear form of stage spaces: zero where the condition
holds, and within t where all its values at the nodes are, ``tolerance`` says how.
"""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.exact.linear_map import EntrywiseMap, LinearMap
from garkcli.exact.matrix import Vector, dot
from garkcli.order.tolerance import form_within, functional_within
from garkcli.tableau.conjugate import symplectic_defect
from garkcli.tableau.tableau import Edge, Tableau


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

    def B(self, l: int, k: int) -> Number:  # noqa: N802 -- the paper's letter
        """b_l(c_l^(k−1)) − 1/k, eq. (B)."""
        b = self.tableau.colours[l].b
        mean = dot(b, self.power(l, k - 1))
        return mean - fmpq(1, k)

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


def is_symplectic_within(tableau: Tableau, tolerance: fmpq) -> bool:
    """Whether |b_i a_ij + b_j a_ji − b_i b_j| ≤ ``tolerance`` between all colours that the
    symplectic form pairs.

    Where positions and momenta share stages their weights are within ``tolerance`` of each other,
    too.
    """
    for l, one in enumerate(tableau.colours):
        for m, other in enumerate(tableau.colours):
            parts = {one.part, other.part}
            is_canonical = parts == {"q", "p"}
            if is_canonical and one.space == other.space:
                space = tableau.space(l)
                difference = _minus_part(one.b, other.b, 1)
                if not functional_within(space, difference, tolerance):
                    return False
            if not is_canonical and parts != {"y"}:
                continue  # velocities among each other, or forces: the form pairs none
            forth = tableau.block(l, m)
            back = tableau.block(m, l)
            if forth is None and back is None:
                continue
            if forth is None or back is None:
                return False
            defect = symplectic_defect(tableau, l, m)
            spaces = tableau.space(l), tableau.space(m)
            if not form_within(*spaces, defect, tolerance):
                return False
    return True
