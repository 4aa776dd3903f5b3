"""The stage vectors 𝒜^[u] of single trees, for any kind of entries."""

from __future__ import annotations

from typing import TypeAlias

from garkcli.errors import MethodError
from garkcli.exact.matrix import Vector, apply
from garkcli.ntrees.tree import Tree
from garkcli.tableau.tableau import Tableau

_Place: TypeAlias = tuple[int, Tree]
"""The stage space that sees a branch, and the branch."""

_CURE = "gark conditions FILE lists the trees of a method"


class TreeVectors:
    """Stage vectors of single trees of a tableau of numbers, polynomials or balls; images of
    branches are cached.
    """

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._images: dict[_Place, Vector] = {}

    def of(self, tree: Tree) -> Vector:
        """𝒜^[u], eqs. (Ataul) and (Au).

        Raises:
            MethodError: the coupling graph does not admit the tree.
        """
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
