"""Weights at the stages of a method besides b, held against what they should give, tree by tree.

A functional is a row of weights a colour. At one order, or at none, its elementary weights should
be those of the exact solution, 1/γ(u), and at all others they should vanish: of the difference of
two rows of weights, of the coefficients of one power of θ in dense output, of a slope. As with b
that is a condition on all trees of an order at once, decided on the spanning ones
(``order.certificate``), and within a tolerance on all trees, in balls.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from flint import arb, ctx, fmpq

from garkcli.exact.matrix import dot
from garkcli.order.certificate import StageSpans, Witness
from garkcli.order.conditions import coupling_graph, elementary_weight
from garkcli.order.residuals import TreeResiduals
from garkcli.order.rounded import GUARD
from garkcli.order.tolerance import within
from garkcli.tableau.embedded import Weights, with_weights
from garkcli.tableau.enclosing import enclose_tableau
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import Admissible, counts_upto
from garkcli.trees.tree import Tree

MOST_TREES = 50_000
"""Most trees of an order whose weights are enclosed one by one."""


@dataclass(frozen=True)
class Functional:
    """Weights at the stages, and what they should give.

    Attributes:
        weights: a row a colour.
        exact_at: the order at which their elementary weights should be 1/γ(u); at all others, and
            everywhere where it is None, they should be zero.
    """

    weights: Weights
    exact_at: int | None = None

    def required(self, tree: Tree) -> fmpq:
        """What the elementary weight of a tree should be."""
        return fmpq(self.share(tree.order), tree.density)

    def share(self, order: int) -> int:
        """1 where the weights of an order should be those of the exact solution, else 0."""
        return int(order == self.exact_at)


@dataclass(frozen=True)
class Failure:
    """A functional that does not give what it should: which one in the sequence, and the tree."""

    number: int
    witness: Witness


class Undecided(Exception):
    """More trees of an order, its argument, than are looked at one by one."""

    def __init__(self, order: int) -> None:
        super().__init__(f"{order}: more than {MOST_TREES} trees")
        self.order = order


def first_failure(
    tableau: Tableau,
    functionals: Sequence[Functional],
    orders: Iterable[int],
    spans: StageSpans | None = None,
) -> Failure | None:
    """The first condition that is not met exactly, order by order; None where all are.

    Args:
        tableau: whose stages they are at.
        functionals: each is held against every tree.
        orders: of the trees.
        spans: of the stage vectors, where some are known.
    """
    spans = spans or StageSpans(tableau)
    for order in orders:
        for l in range(tableau.size):
            for forest in spans.stage_vectors(l, order):
                for number, functional in enumerate(functionals):
                    value = dot(functional.weights[l], forest.vector)
                    if value == fmpq(functional.share(order), order):
                        continue
                    tree = Tree(l, forest.branches)
                    # as ψ(u) is γ(u)/ρ(u) times the stage vector of u
                    weight = value * fmpq(order, tree.density)
                    witness = Witness(tree, weight, functional.required(tree))
                    return Failure(number, witness)
    return None


def first_failure_within(
    tableau: Tableau, functionals: Sequence[Functional], orders: Iterable[int], tolerance: fmpq
) -> Failure | None:
    """The first condition that is missed by more than a tolerance t > 0.

    Raises:
        Undecided: an order has more than ``MOST_TREES`` trees, and not all of its conditions are
            met exactly.
    """
    remaining = list(orders)
    exact = first_failure(tableau, functionals, remaining)
    if exact is None:
        return None
    judges = [_Judge(tableau, x, tolerance) for x in functionals]
    edges, linear = coupling_graph(tableau)
    admissible = Admissible.of(tableau.size, edges, linear)
    for order in remaining:
        if order < exact.witness.tree.order:
            continue
        if sum(counts_upto(admissible, order)[-1]) > MOST_TREES:
            raise Undecided(order)
        for number, judge in enumerate(judges):
            witness = judge.failure(order)
            if witness is not None:
                return Failure(number, witness)
    return None


class _Judge:
    """One functional, all trees of an order at a time."""

    def __init__(self, tableau: Tableau, functional: Functional, tolerance: fmpq) -> None:
        self.tableau = with_weights(tableau, functional.weights)
        self.functional = functional
        self.tolerance = tolerance
        below = int(tolerance.q.bit_length()) - int(tolerance.p.bit_length())
        self.bits = GUARD + max(below + 1, 0)
        enclosure = enclose_tableau(self.tableau, self.bits)
        self.residuals = TreeResiduals(self.tableau, enclosure)

    def failure(self, order: int) -> Witness | None:
        """A tree whose weight is off by more than the tolerance."""
        with ctx.workprec(self.bits):
            limit = arb(self.tolerance)
        share = self.functional.share(order)
        sizes = self.residuals.sizes(order, limit, share)
        if sizes.largest is not None and sizes.reached > limit:
            return self._witness(sizes.largest)
        for tree in sizes.doubtful:
            witness = self._witness(tree)
            if not within(witness.residual, self.tolerance):
                return witness
        return None

    def _witness(self, tree: Tree) -> Witness:
        weight = elementary_weight(self.tableau, tree)
        return Witness(tree, weight, self.functional.required(tree))
