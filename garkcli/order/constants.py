"""The principal error: norms of the first failing conditions over all their trees.

The local error of a method of order r is h^(r+1) Σ e(u) F(u) + …, with e(u) = (b_lᵀ 𝒜^[u] − 1/γ(u))
/ σ(u) over the trees of order r + 1. Hairer, Nørsett & Wanner, *Solving Ordinary Differential
Equations I*, II.3.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from flint import arb, ctx

from garkcli import numpy_on_use as np
from garkcli.doing import doing
from garkcli.exact.display import to_ball, to_float
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.ntrees.count import counts_upto
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import count_conditions, coupling_graph
from garkcli.order.conditions import all_conditions
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.tableau import Tableau

EXACT_CONDITIONS = 3_000
"""Most conditions that are evaluated exactly, not in floats."""
EXACT_ESTIMATES = 300
_BITS = 128
MAX_TREES = 10_000_000
Mask: TypeAlias = "np.ndarray[tuple[int], np.dtype[np.bool_]]"
_Coefficient: TypeAlias = "tuple[Number, Sequence[Tree]]"


class Norms(Frozen):
    """Norms of the error coefficients e(u) of some trees.

    Attributes:
        two_squared: Σ e(u)² if the coefficients are exact, else None.
        two: (Σ e(u)²)^½.
        largest: max |e(u)|.
        worst: a tree with the largest |e(u)|; None if all are zero.
        worst_value: e(worst) if the coefficients are exact, else None.
    """

    trees: int
    two_squared: Number | None
    two: float
    largest: float
    worst: Tree | None
    worst_value: Number | None


class ErrorConstants(Frozen):
    """The norms one order above the method's; ``coupling`` is over trees of several colours."""

    order: int
    is_exact: bool
    all: Norms
    coupling: Norms


def error_constants(tableau: Tableau, order: int) -> ErrorConstants | None:
    """The error constants at ``order``; None if there are more than ``MAX_TREES`` trees."""
    return _constants(tableau, order, 1, EXACT_CONDITIONS)


def estimate_constants(
    difference: Tableau, order: int, is_rounded: bool = False
) -> ErrorConstants | None:
    """Norms of the (b − b̂)_lᵀ 𝒜^[u] / σ(u) of the error estimate h Σ (b_i − b̂_i) k_i.
    ``difference`` has the weights b − b̂. For rounded coefficients exact norms mean nothing.
    """
    exact = 0 if is_rounded else EXACT_ESTIMATES
    return _constants(difference, order, 0, exact)


@doing("error constants")
def _constants(tableau: Tableau, order: int, share: int, most_exact: int) -> ErrorConstants | None:
    """The norms of (b_lᵀ 𝒜^[u] − share/γ(u)) / σ(u)."""
    if count_conditions(tableau, order) <= most_exact:
        everything: list[_Coefficient] = []
        coupling: list[_Coefficient] = []
        for condition in all_conditions(tableau, order):
            e = (condition.value - share * condition.required) / condition.tree.symmetry
            mixed = [u for u in condition.trees if len(u.colours) > 1]
            everything.append((e, condition.trees))
            if mixed:
                coupling.append((e, mixed))
        return ErrorConstants(order, True, _exact_norms(everything), _exact_norms(coupling))
    if sum(map(sum, counts_upto(coupling_graph(tableau), order))) > MAX_TREES:
        return None
    return _in_floats(tableau, order, share)


def _exact_norms(coefficients: Sequence[_Coefficient]) -> Norms:
    trees = 0
    squared: Number = ZERO
    for e, same in coefficients:
        trees += len(same)
        squared = squared + len(same) * (e * e)
    # in balls, whose exponents have no bound: floats of tiny coefficients would all be 0
    with ctx.workprec(_BITS):
        sizes = [abs(to_ball(e)).mid() for e, _ in coefficients]
        largest = max(sizes, default=arb(0))
        two = to_ball(squared).sqrt()
    worst: Tree | None = None
    worst_value: Number | None = None
    if largest > 0:
        worst_value, same = coefficients[sizes.index(largest)]
        worst = same[0]
    return Norms(
        trees=trees,
        two_squared=squared,
        two=float(two),
        largest=float(largest),
        worst=worst,
        worst_value=worst_value,
    )


def _in_floats(tableau: Tableau, order: int, share: int) -> ErrorConstants:
    from garkcli.ntrees.stage_vectors import elementary_weights
    from garkcli.ntrees.table import TreeTable

    table = TreeTable.of(coupling_graph(tableau), order)
    entries = numeric_entries(tableau, 25)
    rows = [colour.space for colour in tableau.colours]
    blocks = {}
    for l, m in tableau.edges():
        A = entries.A[l][m] or ()
        blocks[rows[l], m] = np.array([_floats(row) for row in A])
    weights = [np.array(_floats(row)) for row in entries.b]
    ids = table.ids(order)
    last = slice(ids.start, ids.stop)
    values = elementary_weights(table, rows, blocks, weights)[last]
    required = share * table.is_exact[last] / table.gamma[last].astype(float)
    coefficients = np.abs((values - required) / table.sigma[last].astype(float))
    mixed = table.is_mixed[last]

    def norms(chosen: Mask) -> Norms:
        sizes = np.where(chosen, coefficients, 0.0)
        worst = None
        if sizes.any():
            worst = table.tree(ids.start + int(sizes.argmax()))
        sum_of_squares = (sizes**2).sum()
        return Norms(
            trees=int(chosen.sum()),
            two_squared=None,
            two=float(np.sqrt(sum_of_squares)),
            largest=float(sizes.max(initial=0.0)),
            worst=worst,
            worst_value=None,
        )

    own = np.isin(table.root[last], [*tableau.roots])
    return ErrorConstants(order, False, norms(own), norms(mixed & own))


def _floats(row: Iterable[Cell]) -> list[float]:
    return [float(x) if isinstance(x, arb) else to_float(x) for x in row]
