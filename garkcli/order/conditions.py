"""Order conditions of a tableau, each with its elementary weight, required value and residual."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import dot
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.count import count_by_root
from garkcli.ntrees.tree import Tree
from garkcli.order.tree_vectors import TreeVectors
from garkcli.tableau.tableau import Colour, Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.order.meant import AnyTableau


class Condition(Shown, Frozen):
    """The order condition b_lᵀ 𝒜^[u] = 1/γ(u) of one tree, eq. (bA).

    Attributes:
        tree: u, with colours counted from 0.
        value: the elementary weight b_lᵀ 𝒜^[u], exact.
        allowed: how far rounding of the coefficients can move the value; zero where they are meant
            exactly.
        is_met: whether the method that they are a rounding of meets it; of exact ones no.
        twins: further root colours with which the tree has the same condition, as they share stages
            and weights.
    """

    tree: Tree
    value: Number
    allowed: fmpq = ZERO
    twins: tuple[int, ...] = ()
    is_met: bool = False

    @property
    def required(self) -> fmpq:
        """1/γ(u)."""
        return fmpq(1, self.tree.density)

    @property
    def residual(self) -> Number:
        """Value − required."""
        return self.value - self.required

    @property
    def holds(self) -> bool:
        """Whether the residual is zero, or that of the method that is rounded."""
        return self.is_exact or self.is_met

    @property
    def is_exact(self) -> bool:
        """Whether the residual is exactly zero."""
        return not self.residual

    @property
    def trees(self) -> tuple[Tree, ...]:
        """The tree with its own root colour and with those of its twins."""
        return (self.tree, *[Tree(l, self.tree.branches) for l in self.twins])

    @property
    def is_coupling(self) -> bool:
        """Whether more than one colour takes part in each tree; otherwise a diagonal method has the
        condition.
        """
        return all(len(tree.colours) > 1 for tree in self.trees)

    def __repr__(self) -> str:
        what = f"{self.tree}: {self.value}"
        if self.is_exact:
            return f"<Condition {what}>"
        return f"<Condition {what} instead of {self.required}>"


def conditions(method: AnyTableau, trees: Iterable[Tree]) -> Iterator[Condition]:
    """The conditions of ``trees`` for a tableau; what comes of shared branches is computed once.

    Raises:
        MethodError: a tree that the coupling graph does not admit.
    """
    tableau = method if isinstance(method, Tableau) else method.tableau
    vectors = TreeVectors(tableau)
    for tree in trees:
        value = dot(tableau.colours[tree.root].b, vectors.of(tree))
        if isinstance(method, Tableau) or value == fmpq(1, tree.density):
            yield Condition(tree, value)
        else:
            yield Condition(tree, value, method.allowed(tree), is_met=method.meets(tree))


def elementary_weight(tableau: Tableau, tree: Tree) -> Number:
    """b_lᵀ 𝒜^[u], exact.

    Raises:
        MethodError: the coupling graph does not admit the tree.
    """
    return next(conditions(tableau, [tree])).value


def is_admissible(tableau: Tableau, tree: Tree) -> bool:
    """Whether every parent sees its branches and no linear colour has two branches."""
    if tableau.colours[tree.root].is_linear and len(tree.branches) > 1:
        return False
    for branch in tree.branches:
        if tableau.block(tree.root, branch.root) is None:
            return False
        if not is_admissible(tableau, branch):
            return False
    return True


def coupling_graph(tableau: Tableau) -> tuple[tuple[tuple[bool, ...], ...], frozenset[int]]:
    """Which trees are admissible: ``edges[l][m]`` whether colour l sees colour m, and the linear
    colours.
    """
    colours = range(tableau.size)
    edges = tuple(tuple(tableau.block(l, m) is not None for m in colours) for l in colours)
    return edges, frozenset(l for l in colours if tableau.colours[l].is_linear)


def twin_roots(tableau: Tableau) -> dict[int, tuple[int, ...]]:
    """The first of each group of colours whose conditions are identical as roots, with the whole
    group.

    Colours that share stages and weights, as V^l and F^l of the symplectic pair, give every tree
    the same elementary weight when they are its root.
    """
    groups: dict[int, tuple[int, ...]] = {}
    for l, colour in enumerate(tableau.colours):
        for first in groups:
            if _are_twins(colour, tableau.colours[first]):
                groups[first] += (l,)
                break
        else:
            groups[l] = (l,)
    return groups


def _are_twins(one: Colour, other: Colour) -> bool:
    """Whether two colours share their stages, their weights, and whether they are linear."""
    if one.space != other.space or one.is_linear != other.is_linear:
        return False
    return one.b == other.b


def count_conditions(tableau: Tableau, order: int) -> int:
    """How many conditions of ``order`` a tableau has, those of twin roots counted once."""
    edges, linear = coupling_graph(tableau)
    by_root = count_by_root(tableau.size, order, edges, linear)
    return sum(by_root[root] for root in twin_roots(tableau))


def all_conditions(method: AnyTableau, order: int) -> Iterator[Condition]:
    """Every condition of ``order``, its value exact, with the twins of its root: identical ones
    come once.
    """
    tableau = method if isinstance(method, Tableau) else method.tableau
    twins = twin_roots(tableau)
    for condition in conditions(method, admissible_trees(tableau, order)):
        yield replace(condition, twins=twins[condition.tree.root][1:])


def admissible_trees(tableau: Tableau, order: int) -> Iterator[Tree]:
    """The trees of ``order`` that the coupling graph admits, one root colour of each group of
    twins.
    """
    from garkcli.ntrees.blocks import iter_blocks  # numpy is paid for here

    edges, linear = coupling_graph(tableau)
    twins = twin_roots(tableau)
    blocks = iter_blocks(
        tableau.size, order, edges=edges, linear=linear, roots=twins, block_size=1 << 14
    )
    for block in blocks:
        yield from block.trees()
