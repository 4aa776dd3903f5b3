"""The admissible trees of a tableau, and their elementary weights."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

from garkcli.errors import MethodError
from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector, apply, dot
from garkcli.ntrees.count import Admissible, counts_of
from garkcli.ntrees.listing import trees_of
from garkcli.ntrees.tree import Tree
from garkcli.tableau.tableau import Colour, Tableau

_Place: TypeAlias = tuple[int, Tree]

_CURE = "gark conditions FILE lists the trees of a method"


class TreeVectors:
    """Stage vectors of single trees; images of branches are cached."""

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._images: dict[_Place, Vector] = {}

    def of(self, tree: Tree) -> Vector:
        """𝒜^[u], eqs. (Ataul) and (Au); MethodError if the coupling graph does not admit u."""
        colour = self.tableau.colours[tree.root]
        if not colour.kind.allows(len(tree.branches)):
            message = f"colour {colour.name} is linear: its vertices have one branch at most"
            if not colour.is_linear:
                message = f"the vertices of colour {colour.name} have {colour.kind.branches}"
            raise MethodError(message, _CURE, code="tree-not-admissible")
        space = self.tableau.space(tree.root)
        vector = space.one
        for branch in tree.branches:
            vector = space.product(vector, self.image(tree.root, branch))
        return vector

    def image(self, l: int, branch: Tree) -> Vector:
        """A 𝒜^[u] of a branch u, as the stages of a colour see it."""
        colour = self.tableau.colours[l]
        place = colour.space, branch
        if place not in self._images:
            block = self.tableau.blocks.get((colour.space, branch.root))
            if block is None:
                seen = self.tableau.colours[branch.root]
                raise MethodError(
                    f"colour {colour.name} does not see colour {seen.name}: "
                    "the tree is not admissible",
                    _CURE,
                    code="tree-not-admissible",
                )
            self._images[place] = apply(block, self.of(branch))
        return self._images[place]


def elementary_weights(tableau: Tableau, trees: Iterable[Tree]) -> Iterator[tuple[Tree, Number]]:
    """The trees with b_lᵀ 𝒜^[u], exact. Raises MethodError for a tree that the coupling graph does
    not admit, or of an order beyond that up to which the conditions are known.
    """
    vectors = TreeVectors(tableau)
    most = tableau.exact_to
    for tree in map(tableau.known, trees):
        if most is not None and tree.order > most:
            message = f"the conditions of this method are known up to order {most}"
            cure = f"choose trees of at most {most} vertices"
            raise MethodError(message, cure, code="too-many")
        yield tree, dot(tableau.colours[tree.root].b, vectors.of(tree))


def elementary_weight(tableau: Tableau, tree: Tree) -> Number:
    return next(elementary_weights(tableau, [tree]))[1]


def is_admissible(tableau: Tableau, tree: Tree) -> bool:
    if not tableau.colours[tree.root].kind.allows(len(tree.branches)):
        return False
    for branch in tree.branches:
        if tableau.block(tree.root, branch.root) is None:
            return False
        if not is_admissible(tableau, branch):
            return False
    return True


def coupling_graph(tableau: Tableau) -> Admissible:
    colours = range(tableau.size)
    branches = tuple(tuple(m for m in colours if tableau.block(l, m) is not None) for l in colours)
    return Admissible(tableau.size, branches, tuple(colour.kind for colour in tableau.colours))


def are_few(tableau: Tableau, order: int, most: int) -> bool:
    return tableau.is_listed and sum(counts_of(coupling_graph(tableau), order)) <= most


def twin_roots(tableau: Tableau) -> dict[int, tuple[int, ...]]:
    """Root colours with equal stages and weights, so equal conditions, by the first of a group."""
    groups: dict[int, tuple[int, ...]] = {}
    for l in tableau.roots:
        colour = tableau.colours[l]
        for first in groups:
            if _are_twins(colour, tableau.colours[first]):
                groups[first] += (l,)
                break
        else:
            groups[l] = (l,)
    return groups


def _are_twins(one: Colour, other: Colour) -> bool:
    if (one.space, one.kind, one.late) != (other.space, other.kind, other.late):
        return False
    return one.b == other.b


def count_conditions(tableau: Tableau, order: int) -> int:
    """The number of conditions of ``order``, twin roots counted once."""
    by_root = counts_of(coupling_graph(tableau), order)
    return sum(by_root[root] for root in twin_roots(tableau))


def admissible_trees(tableau: Tableau, order: int) -> Iterator[Tree]:
    """The admissible trees of ``order``, with one root colour of each group of twins."""
    return trees_of(coupling_graph(tableau), order, twin_roots(tableau))
