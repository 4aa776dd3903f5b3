"""The order of dense output x + h Σ b_i(θ) k_i for all θ, and the smoothness of its pieces.

With b_i(θ) = Σ_k B_ik θ^k the condition of a tree u, Σ_i b_i(θ) 𝒜^[u]_i = θ^ρ(u)/γ(u), is one of
polynomials in θ: B_kᵀ 𝒜^[u] is 1/γ(u) for k = ρ(u) and zero for every other k. So the order is at
most the degree, and each power of θ is a functional at the stages (``order.functionals``; Hairer,
Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.6).

The output is continuous if b(1) = b. Its slope h Σ b_i'(θ) k_i is continuous, for all step sizes,
if it is h f(x_0) at θ = 0 and h f(x_1) at θ = 1; two further stages, at x_0 and x_1, decide that.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.exact.display import decimal
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.frozen import Frozen, replace
from garkcli.order.certificate import StageSpans, Witness
from garkcli.order.functionals import Functional, TooManyTrees, first_failure
from garkcli.order.meant import AnyTableau, printed, tolerance_of
from garkcli.order.tolerance import NOT_FOUND, within
from garkcli.tableau.embedded import DenseOutput, Weights
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.order.rounded import Near


class DenseWitness(Frozen):
    """A wrong coefficient of θ^power in the condition of a tree."""

    power: int
    witness: Witness


class DenseOrder(Shown, Frozen):
    """The order of dense output, for all θ.

    Attributes:
        order: within ``tolerance`` if there is one.
        witness: a failing condition of the next order; None if not searched or undecided.
        undecided: why the next order is undecided, or empty.
        tolerance: the rounding of the coefficients; None for exact ones.
    """

    order: int
    witness: DenseWitness | None
    undecided: str = ""
    tolerance: fmpq | None = None

    @property
    def is_lower_bound(self) -> bool:
        return self.witness is None

    def __repr__(self) -> str:
        least = "at least " if self.is_lower_bound else ""
        within = "" if self.tolerance is None else f" within {decimal(self.tolerance)}"
        return f"<DenseOrder {least}{self.order}{within}>"


def dense_order(
    method: AnyTableau, dense: DenseOutput, limit: int, spans: StageSpans | None = None
) -> DenseOrder:
    known = dense if isinstance(method, Tableau) else method.further.dense or dense
    functionals = [Functional(known.coefficients(k), k) for k in range(1, dense.degree + 1)]
    # the next power has no coefficients, and its order should have one
    beyond = dense.degree + 1
    zeros = tuple((ZERO,) * len(colour.b) for colour in printed(method).colours)
    functionals.append(Functional(zeros, beyond))
    orders = range(1, min(limit, beyond) + 1)
    tolerance = tolerance_of(method)
    try:
        failure = first_failure(method, functionals, orders, spans)
    except TooManyTrees as found:
        why = f"order {found.order} is too much to decide"
        return DenseOrder(found.order - 1, None, why, tolerance)
    if failure is None:
        # where no tree is that large, none is larger
        return DenseOrder(limit, None, "", tolerance)
    order = failure.witness.tree.order
    if not isinstance(method, Tableau) and not method.search.excludes_dense(order):
        return DenseOrder(order - 1, None, NOT_FOUND, tolerance)
    witness = DenseWitness(failure.number + 1, failure.witness)
    return DenseOrder(order - 1, witness, "", tolerance)


def ends_at_step(method: AnyTableau, dense: DenseOutput) -> bool:
    """Whether b(1) = b, exactly or within rounding: then the output is continuous."""
    if not isinstance(method, Tableau):
        search = method.search
        search.settled  # noqa: B018 -- it adds the tableaus
        powers = [f"power {power}" for power in range(1, dense.degree + 1)]
        return search.origin.may_be_sum(method.name, powers)
    return all(
        b == x
        for colour, row in zip(method.colours, dense.at(ONE), strict=True)
        for b, x in zip(colour.b, row, strict=True)
    )


class Slopes(Frozen):
    """Whether the slopes at θ = 0 and 1 are f(x_0) and f(x_1), if autonomous; None if undecided."""

    at_start: bool | None
    at_end: bool | None

    @property
    def are_continuous(self) -> bool | None:
        both = {self.at_start, self.at_end}
        if both == {True}:
            return True
        return False if False in both else None


def slopes(method: AnyTableau, dense: DenseOutput) -> Slopes:
    """Returns whether the slopes at both ends of a step are f(x_0) and f(x_1). They are if only
    stages at x_0 or x_1 have weights in them, and not if an elementary weight differs.
    """
    return slopes_where(method, dense, lambda known, _: slopes_at_ends(known), with_ends)


Ends: TypeAlias = tuple[Weights, Weights]


def slopes_where(
    method: AnyTableau,
    dense: DenseOutput,
    ends: Callable[[DenseOutput, Tableau], Ends],
    change: Callable[[Tableau], Tableau] = lambda tableau: tableau,
) -> Slopes:
    """Returns whether the weights of both ``ends`` vanish on every problem, after ``change``."""
    whole: Tableau | Near
    if isinstance(method, Tableau):
        tableau = change(method)
        whole = tableau
    else:
        from garkcli.order.rounded import Near  # balls, which exact methods do without

        dense = method.further.dense or dense
        tableau = change(method.near)
        whole = Near(tableau, method.grain)
    start, end = (_vanishes(whole, Functional(x)) for x in ends(dense, tableau))
    return Slopes(start, end)


def slopes_at_ends(dense: DenseOutput) -> Ends:
    """The slopes at θ = 0 and 1 minus f there, as weights at ``with_ends``."""
    start = _beside(dense.coefficients(1), (-ONE, ZERO))
    return start, _beside(slope_at_one(dense.weights), (ZERO, -ONE))


def with_ends(tableau: Tableau) -> Tableau:
    """The tableau with two more stages in each space, at x_0 and x_1, without weights."""
    spaces = [PointSpace((*x.nodes, ZERO, ONE)) for x in tableau.spaces]
    colours = [
        replace(colour, b=(*colour.b, ZERO, ZERO), c=(*colour.c, ZERO, ONE))
        for colour in tableau.colours
    ]
    blocks = {}
    for (k, m), block in tableau.blocks.items():
        weights = colours[m].b
        blocks[k, m] = (*[(*row, ZERO, ZERO) for row in block], (ZERO,) * len(weights), weights)
    return Tableau(tuple(spaces), tuple(colours), blocks)


def slope_at_one(weights: Sequence[Sequence[Vector]]) -> Weights:
    """b'(1) = Σ_k k B_k, a row for each colour."""
    rows = []
    for of_colour in weights:
        row = []
        for coefficients in of_colour:
            slope: Number = ZERO
            for k, coefficient in enumerate(coefficients, start=1):
                slope = slope + k * coefficient
            row.append(slope)
        rows.append(tuple(row))
    return tuple(rows)


def _beside(rows: Weights, ends: Vector) -> Weights:
    return tuple((*row, *ends) for row in rows)


def _vanishes(method: Tableau | Near, functional: Functional) -> bool | None:
    """Whether a functional is zero on every problem; None if undecided."""
    tableau, grain = (method, ZERO) if isinstance(method, Tableau) else (method.near, method.grain)
    if all(_cancels(tableau, grain, functional.weights, l) for l in range(tableau.size)):
        return True
    largest = max(space.stages for space in tableau.spaces)
    try:
        failure = first_failure(method, [functional], range(1, 2 * largest + 1))
    except TooManyTrees:
        return None
    return None if failure is None else False


def _cancels(tableau: Tableau, grain: fmpq, weights: Weights, l: int) -> bool:
    k = tableau.colours[l].space
    blocks = [block for (j, _), block in tableau.blocks.items() if j == k]
    places: list[Vector] = []
    sums: list[Number] = []
    for i, weight in enumerate(weights[l]):
        row = tuple(x for block in blocks for x in block[i])
        for number, place in enumerate(places):
            if all(within(x - y, grain) for x, y in zip(place, row, strict=True)):
                sums[number] = sums[number] + weight
                break
        else:
            places.append(row)
            sums.append(weight)
    return all(within(weight, grain) for weight in sums)
