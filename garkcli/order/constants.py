"""The principal error: how far the first failing conditions are off, over all their trees.

The local error of a method of order r is h^(r+1) Σ e(u) F(u) + …, with e(u) = (b_lᵀ 𝒜^[u] − 1/γ(u))
/ σ(u) over the trees of order r + 1. Hairer, Nørsett & Wanner, *Solving Ordinary Differential
Equations I*, II.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import arb

from garkcli.exact.display import to_float
from garkcli.exact.field import ZERO, Number
from garkcli.order.conditions import coupling_graph
from garkcli.order.listing import all_conditions, count_conditions
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import count_trees
from garkcli.trees.tree import Tree

if TYPE_CHECKING:
    import numpy as np

    from garkcli.trees.table import TreeTable

EXACT_CONDITIONS = 3_000
"""Most conditions that are evaluated exactly; beyond them floats do."""
MAX_TREES = 10_000_000
"""Most trees up to the order in question; beyond them there are no error constants."""


@dataclass(frozen=True)
class Norms:
    """Norms of the error coefficients e(u) of some trees.

    Attributes:
        trees: how many.
        two_squared: Σ e(u)², exact where the coefficients are; else None.
        two: (Σ e(u)²)^½, a float.
        largest: max |e(u)|, a float.
        worst: a tree where it is reached; None where all are zero or there are no trees.
        worst_value: e(worst), exact where the coefficients are; else None.
    """

    trees: int
    two_squared: Number | None
    two: float
    largest: float
    worst: Tree | None
    worst_value: Number | None


@dataclass(frozen=True)
class ErrorConstants:
    """The norms of one order, over all trees and over the trees that mix colours.

    Attributes:
        order: of the trees; the order of the method plus one.
        is_exact: whether the coefficients were computed exactly; otherwise in floats.
        all: over all trees.
        coupling: over the trees with more than one colour.
    """

    order: int
    is_exact: bool
    all: Norms
    coupling: Norms


def error_constants(tableau: Tableau, order: int) -> ErrorConstants | None:
    """The error constants at ``order``; None where there are more than ``MAX_TREES`` trees."""
    if count_conditions(tableau, order) <= EXACT_CONDITIONS:
        return _exact(tableau, order)
    edges, linear = coupling_graph(tableau)
    if (
        sum(count_trees(tableau.size, n, edges, linear) for n in range(1, order + 1))
        > MAX_TREES
    ):
        return None
    return _in_floats(tableau, order)


def _exact(tableau: Tableau, order: int) -> ErrorConstants:
    coefficients = [
        (x.residual / x.tree.symmetry, x.trees) for x in all_conditions(tableau, order)
    ]

    def norms(only_coupling: bool) -> Norms:
        chosen = [
            (e, kept)
            for e, trees in coefficients
            if (kept := [u for u in trees if len(u.colours) > 1 or not only_coupling])
        ]
        total: Number = ZERO
        for e, trees in chosen:
            total = total + len(trees) * (e * e)
        sizes = [abs(to_float(e)) for e, _ in chosen]
        largest = max(sizes, default=0.0)
        e, u = ZERO, None
        if largest:
            e, (u, *_) = chosen[sizes.index(largest)]
        return Norms(
            trees=sum(len(trees) for _, trees in chosen),
            two_squared=total,
            two=to_float(total) ** 0.5,
            largest=largest,
            worst=u,
            worst_value=e if u is not None else None,
        )

    return ErrorConstants(order, True, norms(False), norms(True))


def _in_floats(tableau: Tableau, order: int) -> ErrorConstants:
    import numpy as np

    from garkcli.trees.table import TreeTable
    from garkcli.trees.weights import elementary_weights

    edges, linear = coupling_graph(tableau)
    table = TreeTable.upto(tableau.size, order, edges, linear)
    entries = numeric_entries(tableau, 25)
    rows = [colour.space for colour in tableau.colours]
    blocks = {}
    for l, m in tableau.edges():
        blocks[rows[l], m] = np.array(
            [[_float(x) for x in row] for row in entries.A[l][m] or ()]
        )
    weights = [np.array([_float(x) for x in row]) for row in entries.b]
    ids = table.ids(order)
    values = elementary_weights(table, rows, blocks, weights)[ids.start : ids.stop]
    gamma = table.gamma[ids.start : ids.stop].astype(float)
    sigma = table.sigma[ids.start : ids.stop].astype(float)
    e = (values - 1.0 / gamma) / sigma
    mixes = _mixes(table)[ids.start : ids.stop]

    def norms(chosen: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Norms:
        sizes = np.where(chosen, np.abs(e), 0.0)
        worst = int(sizes.argmax()) if sizes.any() else None
        return Norms(
            trees=int(chosen.sum()),
            two_squared=None,
            two=float(np.sqrt((sizes**2).sum())),
            largest=float(sizes.max(initial=0.0)),
            worst=None if worst is None else table.tree(ids.start + worst),
            worst_value=None,
        )

    return ErrorConstants(
        order, False, norms(np.ones(len(ids), dtype=bool)), norms(mixes)
    )


def _float(cell: Cell) -> float:
    return float(cell) if isinstance(cell, arb) else to_float(cell)


def _mixes(table: TreeTable) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """For each tree of a table whether more than one colour occurs in it."""
    import numpy as np

    mixes = np.zeros(len(table), dtype=bool)
    for n in range(2, int(table.order[-1]) + 1):
        ids = slice(table.ids(n).start, table.ids(n).stop)
        stem, branch = table.stem[ids], table.branch[ids]
        mixes[ids] = (
            mixes[stem] | mixes[branch] | (table.root[stem] != table.root[branch])
        )
    return mixes
