"""The order within a tolerance, of tableaus whose coefficients are rounded.

A condition is met when |b_lᵀ 𝒜^[u] − 1/γ(u)| ≤ t. That is decided by proof, never by floats:
exactly as far as the conditions hold exactly, then by all trees of an order in ball arithmetic, or
by bounds from approximate spans where the trees are too many. A residual whose ball holds t is
evaluated exactly; one that equals t counts as met.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.doing import doing
from garkcli.exact.display import decimal, to_ball
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import DEFAULT_LIMIT, Witness, find_order
from garkcli.order.conditions import coupling_graph, elementary_weight
from garkcli.order.residuals import TreeResiduals
from garkcli.order.tolerance import rounded_up, unnatural, within
from garkcli.tableau.enclosing import enclose_tableau
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import Admissible, counts_upto
from garkcli.trees.tree import Tree

FEW_TREES = 20_000
"""Up to so many trees an order is decided by listing them; beyond, spans are tried first."""
MOST_TREES = 500_000
"""Beyond so many trees of an order they are not listed at all."""
FEW_DOUBTS = 64
"""So many residuals near the tolerance are evaluated exactly; more of them, in finer balls
first.
"""
MOST_BITS = 8192
"""The finest balls; what they leave in doubt is evaluated exactly however much there is."""
GUARD = 96
"""Bits beyond those of the tolerance that balls begin with."""
GRAIN = 64
"""Spans count what is shorter than this part of the tolerance as an error."""

Means: TypeAlias = Literal["exact", "trees", "spans"]
"""How an order was decided: conditions hold exactly; every tree was evaluated; by bounds on all
trees.
"""
Effect: TypeAlias = Callable[[int], "arb | None"]
"""What rounding does to the residuals of an order at most; None where nothing is known of that."""


@dataclass(frozen=True, eq=False)
class Doubt:
    """Why an order is left open: its residuals miss the tolerance, and rounding may be the cause.

    Attributes:
        reached: the |residual| that misses it.
        effect: how large rounding may make residuals of this order; None where without bound.
    """

    reached: arb
    effect: arb | None


@dataclass(frozen=True, repr=False)
class RoundedOrder:
    """The outcome: every condition up to ``order`` is met within ``tolerance``.

    Attributes:
        order: the largest such order, a lower bound where there is no witness.
        tolerance: t ≥ 0; where rounding of the coefficients explains more, what was needed of that.
        witness: a tree of the next order with |residual| > t; its value is exact.
        undecided: whether the next order was too much to decide; otherwise a search without witness
            stopped at its limit.
        sizes: for each order 1, 2, … that was decided a bound on all |residuals|; for the order
            that fails, the |residual| of the witness.
        means: what decided each of these orders.
        doubt: why the next order is not decided within the tolerance, where that is so.
    """

    order: int
    tolerance: fmpq
    witness: Witness | None
    undecided: bool = False
    sizes: tuple[arb, ...] = field(default=(), compare=False)
    means: tuple[Means, ...] = ()
    doubt: Doubt | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        least = "at least " if self.is_lower_bound else ""
        tolerance = decimal(self.tolerance)
        return f"<RoundedOrder {least}{self.order} within {tolerance}>"

    @property
    def is_lower_bound(self) -> bool:
        """Whether nothing is known to fail."""
        return self.witness is None

    @property
    def largest_residual(self) -> arb:
        """A bound on all |residuals| up to ``order``."""
        bound = arb(0)
        for size in self.sizes[: self.order]:
            bound = bound.max(size)
        return bound


@doing("order within the tolerance")
def find_order_within(
    tableau: Tableau, tolerance: fmpq, limit: int = DEFAULT_LIMIT, effect: Effect | None = None
) -> RoundedOrder:
    """The largest r ≤ ``limit`` for which all conditions of order ≤ r are met within ``tolerance``.

    With an ``effect``, residuals of order n that exceed the tolerance t are met within
    t + effect(n) instead, as far as that is too small for a genuine residual, ``unnatural``; beyond
    that they are left open. They fail where they exceed it, as rounding does not explain them.

    Args:
        tableau: any tableau; its coupling graph decides which trees count.
        tolerance: t ≥ 0; with 0 this is ``find_order``.
        limit: the order at which to stop.
        effect: for a tableau that is computed from rounded coefficients, what that does.
    """
    exact = find_order(tableau, limit)
    verdicts = [_Verdict("exact", arb(0))] * exact.order
    if exact.witness is not None:
        decision = _Decision(tableau, tolerance, effect)
        verdicts.append(decision.first(exact.witness))
        while verdicts[-1].is_met and len(verdicts) < limit:
            order = len(verdicts) + 1
            verdicts.append(decision.of(order))
    decided = [verdict for verdict in verdicts if verdict.size is not None]
    met = [verdict for verdict in verdicts if verdict.is_met]
    wider = [verdict.tolerance for verdict in met if verdict.tolerance is not None]
    last = verdicts[-1] if verdicts else None
    return RoundedOrder(
        order=len(met),
        tolerance=max(wider, default=tolerance),
        witness=last.witness if last else None,
        undecided=len(decided) < len(verdicts),
        sizes=tuple(verdict.size for verdict in decided if verdict.size is not None),
        means=tuple(verdict.means for verdict in decided),
        doubt=last.doubt if last else None,
    )


@dataclass(frozen=True, eq=False)
class _Verdict:
    """What became of one order: met with ``size`` a bound, failed with a witness, or undecided:
    neither.

    ``tolerance`` is what it is met within, where that is more than was asked for.
    """

    means: Means
    size: arb | None = None
    witness: Witness | None = None
    tolerance: fmpq | None = None
    doubt: Doubt | None = None

    @property
    def is_met(self) -> bool:
        return self.size is not None and self.witness is None


class _Decision:
    """One order after the other of one tableau, with one tolerance > 0."""

    def __init__(self, tableau: Tableau, tolerance: fmpq, effect: Effect | None) -> None:
        self.tableau = tableau
        self.tolerance = tolerance
        self.effect = effect
        # the tolerance is at least 2 to the power of minus this
        numerator, denominator = tolerance.p, tolerance.q
        bits_above = int(numerator.bit_length())
        bits_below = int(denominator.bit_length())
        self.magnitude = bits_below - bits_above + 1
        self.bits = GUARD + max(self.magnitude, 0)
        self.admissible = Admissible.of(tableau.size, *coupling_graph(tableau))

    def first(self, witness: Witness) -> _Verdict:
        """The first order that fails exactly; no tree is listed where its witness shows enough."""
        order = witness.tree.order
        if within(witness.residual, self.tolerance):
            return self.of(order)
        return self._explained(order, _failed("exact", witness))

    def of(self, order: int) -> _Verdict:
        """One order, within the tolerance and what rounding explains."""
        return self._explained(order, self._decided(order, self.tolerance))

    def _explained(self, order: int, verdict: _Verdict) -> _Verdict:
        """What is left of a failure once rounding is known."""
        if self.effect is None or verdict.witness is None or verdict.size is None:
            return verdict
        effect = self.effect(order)
        doubtful = _Verdict(verdict.means, doubt=Doubt(verdict.size, effect))
        if effect is None:
            return doubtful
        tolerance = self.tolerance + rounded_up(effect)
        if not within(verdict.witness.residual, tolerance):
            return verdict
        if tolerance > unnatural(order):
            return doubtful
        return replace(self._decided(order, tolerance), tolerance=tolerance)

    @cached_property
    def trees(self) -> TreeResiduals:
        return TreeResiduals(self.tableau, enclose_tableau(self.tableau, self.bits))

    @cached_property
    def spans(self) -> ApproximateSpans:
        # each member as short as the grain costs bits
        bits = GUARD + 6 * max(self.magnitude, 8)
        enclosure = enclose_tableau(self.tableau, bits)
        grain = arb(self.tolerance) / GRAIN
        return ApproximateSpans(self.tableau, enclosure, grain)

    def _decided(self, order: int, tolerance: fmpq) -> _Verdict:
        """One order within any tolerance that is not smaller than the one asked for."""
        count = sum(counts_upto(self.admissible, order)[-1])
        if count > FEW_TREES:
            verdict = self._by_spans(order, tolerance)
            if verdict.size is not None or count > MOST_TREES:
                return verdict
        return self._by_trees(order, tolerance)

    def _by_spans(self, order: int, tolerance: fmpq) -> _Verdict:
        sizes = self.spans.sizes(order)
        with ctx.workprec(self.bits):
            limit = arb(tolerance)
            if sizes.bound <= limit:
                return _Verdict("spans", sizes.bound)
            if sizes.largest is not None and sizes.reached > limit:
                return _failed("spans", self._witness(sizes.largest))
        return _Verdict("spans")

    def _by_trees(self, order: int, tolerance: fmpq) -> _Verdict:
        with ctx.workprec(self.bits):
            limit = arb(tolerance)
        sizes = self.trees.sizes(order, limit)
        if sizes.largest is not None and sizes.reached > limit:
            return _failed("trees", self._witness(sizes.largest))
        if len(sizes.doubtful) > FEW_DOUBTS and self.bits < MOST_BITS:
            self.bits *= 2
            del self.trees
            return self._by_trees(order, tolerance)
        for tree in sizes.doubtful:
            witness = self._witness(tree)
            if not within(witness.residual, tolerance):
                return _failed("trees", witness)
        return _Verdict("trees", sizes.bound)

    def _witness(self, tree: Tree) -> Witness:
        weight = elementary_weight(self.tableau, tree)
        return Witness(tree, weight, fmpq(1, tree.density))


def _failed(means: Means, witness: Witness) -> _Verdict:
    return _Verdict(means, abs(to_ball(witness.residual)), witness)
