"""Free N-trees: rooted trees whose root may move along the edges, represented by one rooting.

It is the rooting at the centroid, where no branch has more than half of the vertices.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import cached_property
from itertools import chain, combinations_with_replacement, groupby, product
from typing import Literal, TypeAlias

from garkcli.deadline import checked
from garkcli.frozen import Frozen
from garkcli.ntrees.count import Admissible
from garkcli.ntrees.tree import Tree

Part: TypeAlias = Literal["y", "q", "p"]
"""The unknowns that a colour drives: all (GARK), or positions or momenta (symplectic pair)."""
Nature: TypeAlias = tuple[int, Part]
"""The term of a colour, and the part that it drives."""
Forest: TypeAlias = tuple[Tree, ...]
_Kind: TypeAlias = tuple[int, int]
_PARTNER: dict[Part, Part] = {"y": "y", "q": "p", "p": "q"}


class Structure(Frozen):
    """The colours of a symplectic tableau, and how a tree's root moves among them.

    A vertex of the free tree is a term H^{l} of the split; a colour is a term together with what it
    drives. Below a vertex of term l hangs ``(m, "q")``, V^m, through A^{l,m} or ``(m, "p")``, F^m,
    through Â^{l,m}. With the root moved across that edge the upper vertex hangs below as ``(l,
    "p")`` or ``(l, "q")``, so an edge needs both vector fields: the stages of H^{l} see V^m only if
    there is a force F^l to use it. ``quadratic`` terms have linear vector fields: two edges at a
    vertex at most.

    >>> Structure(((0, "q"), (1, "p"))).admissible.branches
    ((1,), (0,))
    """

    colours: tuple[Nature, ...]
    quadratic: frozenset[int] = frozenset()

    def __post_init__(self) -> None:
        if not self.colours:
            raise ValueError("a symplectic tableau needs at least one colour")
        if len(set(self.colours)) < len(self.colours):
            raise ValueError("two colours are the same part of the same term")
        parts = {part for _, part in self.colours}
        if "y" in parts and len(parts) > 1:
            raise ValueError("colours drive positions and momenta, or all of them everything")

    @classmethod
    def pair(
        cls, velocities: Collection[int], forces: Collection[int], quadratic: Collection[int] = ()
    ) -> Structure:
        """The pair (A, Â) with V^l for ``velocities`` and F^l for ``forces``, in this order."""
        V: list[Nature] = [(l, "q") for l in velocities]
        F: list[Nature] = [(l, "p") for l in forces]
        return cls((*V, *F), frozenset(quadratic))

    @classmethod
    def self_conjugate(cls, colours: int) -> Structure:
        """A symplectic tableau: b^l_i b^m_j = b^l_i a^{l,m}_{ij} + b^m_j a^{m,l}_{ji}."""
        natures: list[Nature] = [(l, "y") for l in range(colours)]
        return cls(tuple(natures))

    @property
    def is_directed(self) -> bool:
        """Whether edges have a direction: from l to m for A^{l,m}, back for Â^{l,m}."""
        return any(part != "y" for _, part in self.colours)

    @cached_property
    def leaders(self) -> dict[int, int]:
        """For each term the first of its colours, which its vertex has as a root."""
        first: dict[int, int] = {}
        for colour, (term, _) in enumerate(self.colours):
            first.setdefault(term, colour)
        return first

    @cached_property
    def _number(self) -> dict[Nature, int]:
        return {nature: colour for colour, nature in enumerate(self.colours)}

    @cached_property
    def admissible(self) -> Admissible:
        everything = range(len(self.colours))
        edges: list[list[bool]] = []
        linear: list[int] = []
        for above, (term, _) in enumerate(self.colours):
            turned = [self._turned(above, below) for below in everything]
            edges.append([colour is not None for colour in turned])
            if term in self.quadratic:
                linear.append(above)
        return Admissible.of(len(self.colours), edges, linear)

    def _turned(self, above: int, below: int) -> int | None:
        """The colour of the upper vertex below its root; None if there is no edge."""
        term, _ = self.colours[above]
        _, part = self.colours[below]
        return self._number.get((term, _PARTNER[part]))

    def is_forward(self, colour: int) -> bool:
        """Whether an edge down to this colour goes through A, not Â."""
        _, part = self.colours[colour]
        return part != "p"

    def lead(self, tree: Tree) -> Tree:
        term, _ = self.colours[tree.root]
        leader = self.leaders[term]
        if leader == tree.root:
            return tree
        return Tree(leader, tree.branches)

    def twins(self, tree: Tree) -> Iterator[Tree]:
        """Every colour of the root: V^l and F^l share stages and weights."""
        term, _ = self.colours[tree.root]
        for colour, (other, _) in enumerate(self.colours):
            if other == term:
                yield Tree(colour, tree.branches)

    def move_root(self, tree: Tree, index: int) -> Tree:
        """The rooting at the root of a branch, u∘v becomes v∘u; ValueError without such an edge."""
        branch = tree.branches[index]
        colour = self._turned(tree.root, branch.root)
        if colour is None:
            raise ValueError(f"colour {tree.root + 1} does not see colour {branch.root + 1}")
        others = list(tree.branches)
        del others[index]
        return self.lead(Tree(branch.root, (*branch.branches, Tree(colour, others))))

    def rootings(self, tree: Tree) -> Iterator[Tree]:
        """The rootings at all vertices, with repeats if vertices are alike."""
        start = self.lead(tree)
        # each rooting with the branches that lead away from where the root came from
        waiting: list[tuple[Tree, Forest]] = [(start, tree.branches)]
        while waiting:
            here, onward = waiting.pop()
            yield here
            waiting.extend(
                (self.move_root(here, here.branches.index(u)), u.branches) for u in onward
            )

    def is_admissible(self, tree: Tree) -> bool:
        below = self.admissible.branches[tree.root]
        is_linear = self.admissible.is_linear(tree.root)
        if is_linear and len(tree.branches) > 1:
            return False
        if any(u.root not in below for u in tree.branches):
            return False
        return all(map(self.is_admissible, tree.branches))

    def centred(self, tree: Tree) -> Tree:
        """The rooting at the centroid; of two the tail of their edge, or the first half."""
        here = self.lead(tree)
        while _twice_largest(here) > here.order:
            here = self.move_root(here, len(here.branches) - 1)
        if _twice_largest(here) < here.order:
            return here
        *rest, half = here.branches
        if self.is_directed:
            is_first = self.is_forward(half.root)
        else:
            is_first = Tree(here.root, rest).sort_key() <= half.sort_key()
        if is_first:
            return here
        return self.move_root(here, len(rest))


def _twice_largest(tree: Tree) -> int:
    """Twice the order of the largest branch: that of the tree if both its ends are centroids."""
    if not tree.branches:
        return 0
    return 2 * tree.branches[-1].order


class Grower(Frozen):
    structure: Structure

    @cached_property
    def _planted(self) -> dict[_Kind, Forest]:
        return {}

    def one_centroid(self, root: int, order: int) -> Iterator[Tree]:
        is_linear = self.structure.admissible.is_linear(root)
        edges = 2 if is_linear else order
        total = order - 1
        for branches in self._forests(root, total, total // 2, edges):
            yield Tree(root, branches)

    def two_centroids(self, root: int, order: int) -> Iterator[Tree]:
        if order % 2:
            return
        is_directed = self.structure.is_directed
        for colour in self.structure.admissible.branches[root]:
            if not self.structure.is_forward(colour):
                continue
            if colour < root and not is_directed:
                continue  # listed from the other half
            is_mirrored = colour == root and not is_directed
            halves = self.planted(colour, order // 2)
            for position, u in enumerate(self.planted(root, order // 2)):
                first = position + 1 if is_mirrored else 0
                for v in halves[first:]:
                    yield Tree(root, (*u.branches, v))

    def planted(self, root: int, order: int) -> Forest:
        key = (order, root)
        if key not in self._planted:
            is_linear = self.structure.admissible.is_linear(root)
            edges = 1 if is_linear else order
            total = order - 1
            trees = [Tree(root, branches) for branches in self._forests(root, total, total, edges)]
            self._planted[key] = tuple(trees)
        return self._planted[key]

    def _forests(self, root: int, total: int, largest: int, edges: int) -> Iterator[Forest]:
        colours = self.structure.admissible.branches[root]
        for outline in _outlines(total, (largest, max(colours, default=0)), colours, edges):
            choices = []
            for kind, alike in groupby(reversed(outline)):
                order, colour = kind
                trees = self.planted(colour, order)
                choices.append(checked(combinations_with_replacement(trees, len(list(alike)))))
            for parts in checked(product(*choices)):
                yield tuple(chain.from_iterable(parts))


def _outlines(
    total: int, bound: _Kind, colours: Sequence[int], edges: int
) -> Iterator[tuple[_Kind, ...]]:
    if total == 0:
        yield ()
        return
    if edges == 0:
        return
    for order in range(1, min(total, bound[0]) + 1):
        for colour in colours:
            kind = order, colour
            if kind > bound:
                continue
            for rest in _outlines(total - order, kind, colours, edges - 1):
                yield (kind, *rest)
