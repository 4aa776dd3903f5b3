"""The simplifying conditions B, C, D of the paper, and the order they guarantee.

Each is a statement about elements of stage spaces, so it is decided exactly without the nodes
themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.defects import Defects
from garkcli.order.tolerance import functional_within, vector_within, within
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

    @property
    def chi(self) -> int:
        """χ = min (ζ^{l,m} + η^{m,n}) over pairs of blocks l ← m ← n; r where there are none."""
        sums = (
            zeta + eta
            for row in self.D
            for m, zeta in enumerate(row)
            for eta in self.C[m]
            if zeta is not None and eta is not None
        )
        return min(sums, default=self.r)

    @property
    def sharp_bound(self) -> int:
        """min{r, 2η+2, ξ+1, χ+2, η+ζ+3}, the project's own, proved in docs/sharper-bound.md."""
        by_blocks = min(self.xi + 1, self.chi + 2, self.eta + self.zeta + 3)
        return min(self.r, 2 * self.eta + 2, by_blocks)


def simplifying(
    tableau: Tableau, limit: int = DEFAULT_LIMIT, tolerance: fmpq = ZERO
) -> Simplifying:
    """B, C and D of a tableau; each search stops at ``limit``.

    With a ``tolerance`` every entry of every condition is met within it, otherwise exactly.
    """
    defects, colours = Defects(tableau), range(tableau.size)
    alike = _Alike.of(tableau)
    B: dict[int, int] = {}
    C: dict[tuple[int, int], int] = {}
    D: dict[tuple[int, int], int] = {}

    def largest(is_met: Callable[[int], bool]) -> int:
        return next((k - 1 for k in range(1, limit + 1) if not is_met(k)), limit)

    def r(l: int) -> int:
        key = alike.weights[l]
        if key not in B:
            B[key] = largest(lambda k: within(defects.B(l, k), tolerance))
        return B[key]

    def eta(l: int, m: int) -> int | None:
        if tableau.block(l, m) is None:
            return None
        key, space = (alike.nodes[l], m), tableau.space(l)
        if key not in C:
            C[key] = largest(
                lambda k: vector_within(space, defects.C(l, m, k), tolerance)
            )
        return C[key]

    def zeta(l: int, m: int) -> int | None:
        if tableau.block(l, m) is None:
            return None
        key, space = (alike.weights[l], m), tableau.space(m)
        if key not in D:
            D[key] = largest(
                lambda k: functional_within(space, defects.D(l, m, k), tolerance)
            )
        return D[key]

    return Simplifying(
        tuple(r(l) for l in colours),
        tuple(tuple(eta(l, m) for m in colours) for l in colours),
        tuple(tuple(zeta(l, m) for m in colours) for l in colours),
    )


@dataclass(frozen=True)
class _Alike:
    """For each colour the first one with the same stages and nodes, and with the same weights too.

    Their rows of conditions are the same: in an additive method of many colours all are.
    """

    nodes: tuple[int, ...]
    weights: tuple[int, ...]

    @staticmethod
    def of(tableau: Tableau) -> _Alike:
        nodes: dict[object, int] = {}
        weights: dict[object, int] = {}
        firsts = [
            (
                nodes.setdefault((x.space, x.c), l),
                weights.setdefault((x.space, x.c, x.b), l),
            )
            for l, x in enumerate(tableau.colours)
        ]
        return _Alike(tuple(x for x, _ in firsts), tuple(x for _, x in firsts))


def consistent_blocks(
    tableau: Tableau, tolerance: fmpq = ZERO
) -> dict[tuple[int, int], bool]:
    """For each block that exists whether A^{l,m} 𝟙 = c^{l}, eq. (Aone), within ``tolerance`` at
    every stage.
    """
    defects, alike = Defects(tableau), _Alike.of(tableau)
    known: dict[tuple[int, int], bool] = {}
    found: dict[tuple[int, int], bool] = {}
    for l, m in tableau.edges():
        key = alike.nodes[l], m
        if key not in known:
            known[key] = vector_within(tableau.space(l), defects.C(l, m, 1), tolerance)
        found[l, m] = known[key]
    return found
