"""An N-tree: a rooted tree whose vertices carry colours, one colour for each vector field."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from itertools import groupby
from math import factorial, prod

from garkcli.ntrees.kind import FIELDS, PLAIN, VertexKind
from garkcli.upward import Shown, answered


class Tree(Shown):
    """The N-tree ``[u_1, …, u_m]^[l]``: a root of colour ``l`` with its branches.

    Equality ignores the order of branches.

    Attributes:
        root: the colour l, counted from 0; ``colour`` is the same counted from 1.
        branches: the trees u_i, in one canonical order.
        kind: the kind of the root.
        order: ρ(u), the sum of the weights of the vertices.

    >>> cherry = Tree(0, [Tree(1), Tree(1)])
    >>> cherry.order, cherry.density, cherry.symmetry
    (3, 3, 2)
    >>> Tree(0, [Tree(0), Tree(1)]).symmetry
    1

    Source: Zanna, "Order conditions for GARK methods"; Butcher, *B-Series* (2021), chapter 2.
    """

    __slots__ = ("__dict__", "branches", "kind", "order", "root")

    def __init__(self, root: int, branches: Iterable[Tree] = (), kind: VertexKind = PLAIN) -> None:
        self.root = root
        self.kind = kind
        ordered = sorted(branches, key=Tree.sort_key)
        self.branches: tuple[Tree, ...] = tuple(ordered)
        self.order: int = kind.weight + sum(u.order for u in ordered)

    def sort_key(self) -> tuple[object, ...]:
        """A total order on trees, that of the tree table's ids.

        By order, root colour, orders and root colours of branches, the last first, and branches.
        """
        return self._key

    @cached_property
    def _key(self) -> tuple[object, ...]:
        outline = tuple((u.order, u.root) for u in reversed(self.branches))
        return self.order, self.root, outline, tuple(u._key for u in self.branches)

    @cached_property
    def density(self) -> int:
        """γ(u) = ρ(u) γ(u_1) … γ(u_m); a root of weight 2 has ρ(u) (ρ(u) − 1) first."""
        return self.kind.integrated(self.order) * prod([u.density for u in self.branches])

    @cached_property
    def is_exact(self) -> bool:
        """Whether the exact solution has every vertex."""
        return self.kind.is_exact and all(u.is_exact for u in self.branches)

    @cached_property
    def is_of_fields(self) -> bool:
        """Whether every vertex is a vector field that stages evaluate."""
        return all(u.kind in FIELDS for u in self.vertices())

    @cached_property
    def symmetry(self) -> int:
        """σ(u): the number of automorphisms that fix the root and every colour."""
        repeats = [len(list(alike)) for _, alike in groupby(self.branches)]
        return prod(map(factorial, repeats)) * prod([u.symmetry for u in self.branches])

    def vertices(self) -> Iterator[Tree]:
        """Every vertex as the subtree above it, the root first."""
        yield self
        for u in self.branches:
            yield from u.vertices()

    @property
    def colour(self) -> int:
        """The colour of the root, counted from 1."""
        return self.root + 1

    @property
    def colours(self) -> frozenset[int]:
        """The colours that occur, counted from 0."""
        return frozenset(u.root for u in self.vertices())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Tree):
            return NotImplemented
        return self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def __str__(self) -> str:
        text: str = answered(self, "text")
        return text

    def __repr__(self) -> str:
        return f"<Tree {self}>"
