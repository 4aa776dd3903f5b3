"""The simplifying conditions B, C, D of the paper, the order they guarantee, and symplecticity.

A defect is an element or a functional of a stage space, zero if the condition holds, so it is
decided exactly without the nodes; its entries are balls if coefficients are rounded.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, TypeAlias

from garkcli.doing import doing
from garkcli.frozen import Frozen, FrozenBut
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.defects import Defects, RoundedDefects
from garkcli.order.meant import AnyTableau
from garkcli.tableau import conjugate
from garkcli.tableau.tableau import Edge, Tableau


def is_symplectic(method: AnyTableau) -> bool:
    """Whether b_i b_j = b_i a_ij + b_j a_ji between all colours that the symplectic form pairs. A
    GARK tableau is then its own conjugate; momentum blocks of a partitioned one are conjugates of
    its position blocks, with equal weights if they share stages. No weight is a divisor.
    """
    defects = defects_of(method)
    with defects.precision():
        return defects.vanish(conjugate.symplectic_defects(defects.entries))


def defects_of(method: AnyTableau) -> Defects:
    """The defects of the method that is meant; MethodError if it is no GARK method."""
    tableau = method if isinstance(method, Tableau) else method.tableau
    tableau.demand_fields("a simplifying condition", with_flow=True)
    if isinstance(method, Tableau):
        return Defects(method)
    if not method.search.box.numbers:
        return Defects(method.tableau)
    return RoundedDefects(method.near, method.grain)


Table: TypeAlias = "tuple[tuple[int | None, ...], ...]"


class Simplifying(FrozenBut):
    """The largest r, η, ζ for which B^{l}(r), C^{l,m}(η), D^{l,m}(ζ) hold, up to a limit.

    Attributes:
        B: r^{l} for each colour.
        C: η^{l,m}; None if the block does not exist.
        D: ζ^{l,m}; None if the block does not exist.
        limit: the limit of each search: numbers that reached it may be larger.

    >>> from garkcli import simplifying
    >>> found = simplifying("gauss-2")
    >>> found.B, found.C, found.D, found.bound
    ((4,), ((2,),), ((2,),), 4)
    """

    besides = frozenset({"limit"})

    B: tuple[int, ...]
    C: Table
    D: Table
    limit: int = DEFAULT_LIMIT

    def is_open(self, number: int) -> bool:
        """Whether a number computed from these may be larger, as one of them reached the limit."""
        entries = (*self.B, *_existing(self.C), *_existing(self.D))
        return number >= self.limit and max(entries, default=0) >= self.limit

    @property
    def stage_orders(self) -> tuple[int, ...]:
        """For each colour the largest q with B(q) and C(q) for all its stages."""
        rows = zip(self.B, self.C, strict=True)
        return tuple(min([r, *(eta for eta in etas if eta is not None)]) for r, etas in rows)

    @property
    def stage_order(self) -> int:
        """The largest q with B(q) and C(q)."""
        return min(self.r, self.eta)

    @property
    def r(self) -> int:
        """The least r^{l}."""
        return min(self.B)

    @property
    def eta(self) -> int:
        """η = min η^{l,m} over the blocks that exist; r if there are none."""
        return min(_existing(self.C), default=self.r)

    @property
    def zeta(self) -> int:
        """ζ = min ζ^{l,m} over the blocks that exist; r if there are none."""
        return min(_existing(self.D), default=self.r)

    @property
    def xi(self) -> int:
        """ξ = min (η^{l,m} + ζ^{l,m})."""
        sums: list[int] = []
        for etas, zetas in zip(self.C, self.D, strict=True):
            for eta, zeta in zip(etas, zetas, strict=True):
                if eta is not None and zeta is not None:
                    sums.append(eta + zeta)
        return min(sums, default=self.r)

    @property
    def bound(self) -> int:
        """min{r, 2η+2, ξ+1, η+ζ+1}, the Simplifying Assumption Theorem (orderGARK) as printed.

        A valid lower bound of the order, seldom sharp; ξ + 1 is never the smallest.
        """
        return min(self.r, 2 * self.eta + 2, self.xi + 1, self.eta + self.zeta + 1)

    @property
    def chi(self) -> int:
        """χ = min (ζ^{l,m} + η^{m,n}) over pairs of blocks l ← m ← n; r if there are none."""
        sums: list[int] = []
        for row in self.D:
            for zeta, etas in zip(row, self.C, strict=True):
                if zeta is not None:
                    sums += [zeta + eta for eta in etas if eta is not None]
        return min(sums, default=self.r)

    @property
    def sharp_bound(self) -> int:
        """min{r, 2η+2, ξ+1, χ+2, η+ζ+3}, proved in docs/sharper-bound.md."""
        return min(self.r, 2 * self.eta + 2, self.xi + 1, self.chi + 2, self.eta + self.zeta + 3)


def _existing(table: Table) -> list[int]:
    return [number for row in table for number in row if number is not None]


@doing("B, C and D")
def simplifying(
    method: AnyTableau, limit: int = DEFAULT_LIMIT, letters: str = "BCD"
) -> Simplifying:
    """Returns B, C and D, or only ``letters``, up to ``limit``. A rounded method meets a condition
    if rounding explains every entry of its defect.
    """
    defects = defects_of(method)
    tableau = defects.tableau
    alike = _Alike.of(tableau)
    colours = range(tableau.size)

    @cache
    def largest(defect: Callable[..., Any], *block: int) -> int:
        vanishing = (defects.vanish(defect(*block, k)) for k in range(1, limit + 1))
        return next((k for k, vanishes in enumerate(vanishing) if not vanishes), limit)

    def of_blocks(letter: str, defect: Callable[..., Any], first: Sequence[int]) -> Table:
        if letter not in letters:
            return ()
        return tuple(
            tuple(
                None if tableau.block(l, m) is None else largest(defect, first[l], m)
                for m in colours
            )
            for l in colours
        )

    B = tuple(largest(defects.B, l) for l in alike.weights) if "B" in letters else ()
    C = of_blocks("C", defects.C, alike.nodes)
    return Simplifying(B, C, of_blocks("D", defects.D, alike.weights), limit)


class _Alike(Frozen):
    """For each colour the first one with equal stages and nodes, and with equal weights too.
    Conditions of such colours are equal.
    """

    nodes: tuple[int, ...]
    weights: tuple[int, ...]

    @staticmethod
    def of(tableau: Tableau) -> _Alike:
        nodes = [(x.space, x.c) for x in tableau.colours]
        weights = [(x.space, x.c, x.b) for x in tableau.colours]
        # compared, not hashed: flint hashes fractions by Python's, which takes longer
        return _Alike(tuple(map(nodes.index, nodes)), tuple(map(weights.index, weights)))


def consistent_blocks(method: AnyTableau) -> dict[Edge, bool]:
    """For each block whether A^{l,m} 𝟙 = c^{l}, eq. (Aone), exactly or within rounding."""
    defects = defects_of(method)
    alike = _Alike.of(defects.tableau)
    known: dict[Edge, bool] = {}
    consistent: dict[Edge, bool] = {}
    for l, m in defects.tableau.edges():
        key = alike.nodes[l], m
        if key not in known:
            defect: Any = defects.C(l, m, 1)
            known[key] = defects.vanish(defect)
        consistent[l, m] = known[key]
    return consistent


def inconsistent_blocks(method: AnyTableau | None) -> tuple[Edge, ...]:
    if method is None:
        return ()
    return tuple(edge for edge, holds in consistent_blocks(method).items() if not holds)
