"""By how much B, C, D and symplecticity are missed by the methods that a tableau may be a rounding
of: a ball an entry, which holds 0 where rounding explains the defect.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager

from flint import arb, ctx

from garkcli.order.entries import scalar_product, times
from garkcli.tableau.conjugate import are_opposite
from garkcli.tableau.rounded import RoundedTableau, Row


class RoundedDefects:
    """The defects of ``order.defects``, and those of symplecticity, over the box of a tableau.

    Their entries belong to stages, also where the exact defects are elements of a stage algebra.
    """

    def __init__(self, rounded: RoundedTableau) -> None:
        self.tableau = rounded.tableau
        self.rounded = rounded
        self._b = [x.entries() for x in rounded.balls.b]
        self._powers = [[[arb(1)] * len(row)] for row in rounded.nodes]
        self._A = {key: block.tolist() for key, block in rounded.balls.A.items()}

    @staticmethod
    def vanish(defects: Sequence[arb]) -> bool:
        """Whether rounding explains them all."""
        return all(x.is_finite() and x.contains(0) for x in defects)

    def power(self, l: int, exponent: int) -> Row:
        """c^l to a power; balls that hold 0 have none by their logarithms."""
        powers = self._powers[l]
        while len(powers) <= exponent:
            powers.append(times(powers[-1], self.rounded.nodes[l]))
        return powers[exponent]

    def B(self, l: int, k: int) -> Row:  # noqa: N802 -- the paper's letter
        """As ``Defects.B``."""
        with self._precision():
            return [scalar_product(self._b[l], self.power(l, k - 1)) - arb(1) / k]

    def C(self, l: int, m: int, k: int) -> Row:  # noqa: N802
        """As ``Defects.C``, a ball a stage of l."""
        with self._precision():
            powers = self.power(m, k - 1)
            rows = zip(self._block(l, m), self.power(l, k), strict=True)
            return [scalar_product(row, powers) - c / k for row, c in rows]

    def D(self, l: int, m: int, k: int) -> Row:  # noqa: N802
        """As ``Defects.D``, a ball a stage of m."""
        with self._precision():
            row = times(self._b[l], self.power(l, k - 1))
            columns = zip(*self._block(l, m), strict=True)
            ends = zip(self._b[m], self.power(m, k), strict=True)
            return [
                scalar_product(row, column) - b * (1 - c) / k
                for column, (b, c) in zip(columns, ends, strict=True)
            ]

    def symplectic(self, l: int, m: int) -> Row:
        """b_i a_ij + b_j a_ji − b_i b_j for all stages i of l and j of m; both blocks exist."""
        forth, back = self._block(l, m), self._block(m, l)
        with self._precision():
            return [
                b_i * forth[i][j] + b_j * back[j][i] - b_i * b_j
                for i, b_i in enumerate(self._b[l])
                for j, b_j in enumerate(self._b[m])
            ]

    def weights(self, l: int, m: int) -> Row:
        """b_l − b_m, of colours with the same stages."""
        with self._precision():
            return [x - y for x, y in zip(self._b[l], self._b[m], strict=True)]

    def _block(self, l: int, m: int) -> list[Row]:
        return self._A[self.tableau.colours[l].space, m]

    def _precision(self) -> AbstractContextManager[None]:
        return ctx.workprec(self.rounded.bits)


def is_symplectic_within(rounded: RoundedTableau) -> bool:
    """Whether rounding explains every b_i a_ij + b_j a_ji − b_i b_j between the colours that the
    symplectic form pairs, and every difference of weights where positions and momenta share stages.
    """
    tableau = rounded.tableau
    defects = RoundedDefects(rounded)
    for l, one in enumerate(tableau.colours):
        for m, other in enumerate(tableau.colours):
            share_stages = {one.part, other.part} == {"q", "p"} and one.space == other.space
            if share_stages and not defects.vanish(defects.weights(l, m)):
                return False
            if not are_opposite(one, other):
                continue
            forth, back = tableau.block(l, m), tableau.block(m, l)
            if (forth is None) != (back is None):
                return False
            if forth is not None and not defects.vanish(defects.symplectic(l, m)):
                return False
    return True
