"""The simplifying conditions B, C, D of the paper, and the order they guarantee.

Each is a statement about elements of stage spaces, so it is decided exactly without the nodes themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from flint import fmpq

from garkcli.exact.matrix import Vector, apply, apply_left, dot
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Simplifying:
    """The largest r, η, ζ for which B^{l}(r), C^{l,m}(η), D^{l,m}(ζ) hold, up to a limit.

    Attributes:
        B: r^{l} for each colour.
        C: η^{l,m}; None where the block does not exist.
        D: ζ^{l,m}; None where the block does not exist.
    """

    B: tuple[int, ...]
    C: tuple[tuple[int | None, ...], ...]
    D: tuple[tuple[int | None, ...], ...]

    @property
    def r(self) -> int:
        """Min r^{l}."""
        return min(self.B)

    @property
    def eta(self) -> int:
        """η = min η^{l,m}, over the blocks that exist; r where there are none."""
        return min((x for row in self.C for x in row if x is not None), default=self.r)

    @property
    def zeta(self) -> int:
        """ζ = min ζ^{l,m}, over the blocks that exist; r where there are none."""
        return min((x for row in self.D for x in row if x is not None), default=self.r)

    @property
    def xi(self) -> int:
        """ξ = min (η^{l,m} + ζ^{l,m})."""
        sums = (
            x + y
            for row, other in zip(self.C, self.D, strict=True)
            for x, y in zip(row, other, strict=True)
            if x is not None and y is not None
        )
        return min(sums, default=self.r)

    @property
    def bound(self) -> int:
        """min{r, 2η+2, ξ+1, η+ζ+1}, the Simplifying Assumption Theorem (orderGARK) as printed.

        A valid lower bound of the order, seldom sharp; ξ + 1 is never the smallest.
        """
        return min(self.r, 2 * self.eta + 2, self.xi + 1, self.eta + self.zeta + 1)


def simplifying(tableau: Tableau, limit: int = DEFAULT_LIMIT) -> Simplifying:
    """B, C and D of a tableau; each search stops at ``limit``."""
    conditions = _Conditions(tableau, limit)
    colours = range(tableau.size)
    return Simplifying(
        tuple(conditions.B(l) for l in colours),
        tuple(tuple(conditions.C(l, m) for m in colours) for l in colours),
        tuple(tuple(conditions.D(l, m) for m in colours) for l in colours),
    )


class _Conditions:
    """The three conditions of one tableau, with the powers of its nodes kept."""

    def __init__(self, tableau: Tableau, limit: int) -> None:
        self.tableau = tableau
        self.limit = limit
        self._powers = [[tableau.space(l).one] for l in range(tableau.size)]

    def power(self, l: int, exponent: int) -> Vector:
        """c^l to a power."""
        powers = self._powers[l]
        while len(powers) <= exponent:
            powers.append(self.tableau.space(l).product(powers[-1], self.tableau.colours[l].c))
        return powers[exponent]

    def B(self, l: int) -> int:  # noqa: N802 -- the paper's letter
        """r^{l}, eq. (B): b^T c^(k−1) = 1/k."""
        return self._largest(lambda k: dot(self.tableau.colours[l].b, self.power(l, k - 1)) == fmpq(1, k))

    def C(self, l: int, m: int) -> int | None:  # noqa: N802
        """η^{l,m}, eq. (C): A^{l,m} c_m^(k−1) = c_l^k / k."""
        block = self.tableau.block(l, m)
        if block is None:
            return None
        return self._largest(lambda k: apply(block, self.power(m, k - 1)) == tuple(x / k for x in self.power(l, k)))

    def D(self, l: int, m: int) -> int | None:  # noqa: N802
        """ζ^{l,m}, eq. (D): b_l(c_l^(k−1) A^{l,m} g) = b_m((1 − c_m^k) g) / k for all g."""
        block = self.tableau.block(l, m)
        if block is None:
            return None
        here, there = self.tableau.space(l), self.tableau.space(m)
        b_l, b_m = self.tableau.colours[l].b, self.tableau.colours[m].b

        def holds(k: int) -> bool:
            left = apply_left(here.times(b_l, self.power(l, k - 1)), block)
            rest = tuple(x - y for x, y in zip(there.one, self.power(m, k), strict=True))
            return left == tuple(x / k for x in there.times(b_m, rest))

        return self._largest(holds)

    def _largest(self, holds: Callable[[int], bool]) -> int:
        return next((k - 1 for k in range(1, self.limit + 1) if not holds(k)), self.limit)


def consistent_blocks(tableau: Tableau) -> dict[tuple[int, int], bool]:
    """For each block that exists whether A^{l,m} 𝟙 = c^{l}, eq. (Aone)."""
    return {(l, m): _is_consistent(tableau, l, m) for l, m in tableau.edges()}


def _is_consistent(tableau: Tableau, l: int, m: int) -> bool:
    block = tableau.block(l, m)
    return block is not None and apply(block, tableau.space(m).one) == tableau.colours[l].c
