"""By how much B, C, D, consistency and symplecticity are missed, and which of them are met within a tolerance.

A defect is an exact element, functional or bilinear form of stage spaces: zero where the condition holds, and
within t where all its values at the nodes are, ``closeness`` says how.
"""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector, apply, apply_left, dot, outer, subtract, transpose
from garkcli.order.closeness import form_within, functional_within
from garkcli.tableau.tableau import Tableau


class Defects:
    """Left side minus right side of the conditions on one tableau, with the powers of its nodes kept."""

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._powers = [[tableau.space(l).one] for l in range(tableau.size)]

    def power(self, l: int, exponent: int) -> Vector:
        """c^l to a power."""
        powers = self._powers[l]
        while len(powers) <= exponent:
            powers.append(self.tableau.space(l).product(powers[-1], self.tableau.colours[l].c))
        return powers[exponent]

    def B(self, l: int, k: int) -> Number:  # noqa: N802 -- the paper's letter
        """b_l(c_l^(k−1)) − 1/k, eq. (B)."""
        return dot(self.tableau.colours[l].b, self.power(l, k - 1)) - fmpq(1, k)

    def C(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """A^{l,m} c_m^(k−1) − c_l^k / k, eq. (C): an element of the space of l."""
        image = apply(self._block(l, m), self.power(m, k - 1))
        return tuple(x - y / k for x, y in zip(image, self.power(l, k), strict=True))

    def D(self, l: int, m: int, k: int) -> Vector:  # noqa: N802
        """b_l(c_l^(k−1) A^{l,m} g) − b_m((1 − c_m^k) g) / k, eq. (D): a functional of g in the space of m."""
        here, there = self.tableau.space(l), self.tableau.space(m)
        left = apply_left(here.times(self.tableau.colours[l].b, self.power(l, k - 1)), self._block(l, m))
        rest = tuple(x - y for x, y in zip(there.one, self.power(m, k), strict=True))
        right = there.times(self.tableau.colours[m].b, rest)
        return tuple(x - y / k for x, y in zip(left, right, strict=True))

    def consistency(self, l: int, m: int) -> Vector:
        """A^{l,m} 𝟙 − c^{l}, eq. (Aone): an element of the space of l."""
        image = apply(self._block(l, m), self.tableau.space(m).one)
        return tuple(x - y for x, y in zip(image, self.tableau.colours[l].c, strict=True))

    def symplecticity(self, l: int, m: int) -> Matrix:
        """B^l A^{l,m} + (A^{m,l})ᵀ B^m − b_l b_mᵀ as a bilinear form on the spaces of l and m."""
        b_l, b_m = self.tableau.colours[l].b, self.tableau.colours[m].b
        gram_l, gram_m = self.tableau.space(l).gram(b_l), self.tableau.space(m).gram(b_m)
        forth = transpose(tuple(apply(gram_l, column) for column in transpose(self._block(l, m))))
        back = tuple(apply(gram_m, column) for column in transpose(self._block(m, l)))
        return subtract(forth, subtract(outer(b_l, b_m), back))

    def _block(self, l: int, m: int) -> Matrix:
        block = self.tableau.block(l, m)
        if block is None:
            raise KeyError((l, m))
        return block


def is_symplectic_within(tableau: Tableau, tolerance: fmpq) -> bool:
    """Whether |b_i a_ij + b_j a_ji − b_i b_j| ≤ ``tolerance`` between all colours that the symplectic form pairs.

    Where positions and momenta share stages their weights are within ``tolerance`` of each other, too.
    """
    defects = Defects(tableau)
    for l, one in enumerate(tableau.colours):
        for m, other in enumerate(tableau.colours):
            parts = {one.part, other.part}
            if parts == {"q", "p"} and one.rows == other.rows:
                difference = tuple(x - y for x, y in zip(one.b, other.b, strict=True))
                if not functional_within(tableau.space(l), difference, tolerance):
                    return False
            if parts not in ({"q", "p"}, {"y"}):
                continue
            forth, back = tableau.block(l, m), tableau.block(m, l)
            if (forth is None) != (back is None):
                return False
            if forth is not None and not form_within(
                tableau.space(l), tableau.space(m), defects.symplecticity(l, m), tolerance
            ):
                return False
    return True
