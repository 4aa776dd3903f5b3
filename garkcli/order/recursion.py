"""Computes a value for all trees of an order from those of smaller orders, without listing trees.

A tree is its root with a forest on it, a forest its smallest branch beside the others, and a branch
is a tree seen through a block A. So one value for all forests of an order, and one for
all branches, follow from those of the orders below: spanning members, or a sum.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, Generic, TypeAlias, TypeVar

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.exact.field import ONE
from garkcli.exact.matrix import EntrywiseMap, LinearMap
from garkcli.frozen import Frozen
from garkcli.ntrees.kind import SEVERAL, VertexKind
from garkcli.ntrees.tree import Tree
from garkcli.tableau.tableau import Edge, Tableau

Value = TypeVar("Value")


class OrderByOrder(ABC, Generic[Value]):
    """One value for the branches and one for the forests of each order, in every stage space. Each
    is computed once, on demand; after a timeout the next call continues. ``vertices`` has the value
    of the empty forest for each stage space.
    """

    def __init__(self, tableau: Tableau, vertices: Iterable[Value]) -> None:
        self.tableau = tableau
        # by stage space and order
        self._forests = {(k, 0): value for k, value in enumerate(vertices)}
        self._branches: dict[tuple[int, int], Value] = {}
        self._several: dict[tuple[int, int], Value] = {}

    def of_trees(self, l: int, order: int) -> Value:
        colour = self.tableau.colours[l]
        k, kind, rest = colour.space, colour.kind, order - colour.kind.weight
        if rest == 0 and kind.allows(0):
            return self._forests[k, 0]
        arity = kind.arity if rest > 0 else ()
        if 1 in arity:
            under_root = self.forests if SEVERAL in arity else self.branches
        elif SEVERAL in arity:
            under_root = self.several
        else:
            return self._joined(k, ())
        for lower in range(1, rest):  # one after the other: recursion stays flat
            under_root(k, lower)
        return under_root(k, rest)

    def branches(self, k: int, order: int) -> Value:
        if (k, order) not in self._branches:
            images = (
                self._image(k, m, order, self.of_trees(m, order))
                for m in range(self.tableau.size)
                if (k, m) in self.tableau.blocks
            )
            self._branches[k, order] = self._joined(k, images)
        return self._branches[k, order]

    def forests(self, k: int, order: int) -> Value:
        """The forests of an order, of branches that the stages of space k see."""
        if (k, order) not in self._forests:
            self._forests[k, order] = self._new_forests(k, order)
        return self._forests[k, order]

    def several(self, k: int, order: int) -> Value:
        """The forests of at least two branches."""
        if (k, order) not in self._several:
            self._several[k, order] = self._new_several(k, order)
        return self._several[k, order]

    def _splits(self, k: int, order: int) -> Iterator[tuple[Value, Value]]:
        """Pairs of the smallest branch and the other ones, for forests of several."""
        for j in range(1, order // 2 + 1):
            yield self.branches(k, j), self.forests(k, order - j)

    @abstractmethod
    def _image(self, k: int, m: int, order: int, trees: Value) -> Value:
        """Branches order · A ψ in space k; order (order − 1) ⋯ A ψ if vertices count more."""

    @abstractmethod
    def _joined(self, k: int, parts: Iterable[Value]) -> Value:
        """The union of some parts, in space k."""

    @abstractmethod
    def _new_forests(self, k: int, order: int) -> Value:
        """The forests of an order, from smaller ones and the branches up to it."""

    @abstractmethod
    def _new_several(self, k: int, order: int) -> Value:
        """The forests of at least two branches."""


class ForestVector(Frozen):
    """A forest, and its contribution to the stage vector of a tree. ``vector`` is the product of
    the branches' contributions times ``scale``, a common denominator, or 1 if entries have
    inverses. ``exact`` is 1, or 0 if the exact solution has no such branches.
    """

    vector: Sequence[Any]
    branches: tuple[Tree, ...] = ()
    scale: Any = ONE
    exact: int = 1

    def required(self, kind: VertexKind, order: int) -> fmpq:
        """The required weights times vector, for trees with a root of a kind."""
        return fmpq(self.exact * kind.is_exact, kind.integrated(order))


Forests: TypeAlias = Sequence[ForestVector]


class Spans(OrderByOrder[Forests]):
    """Members that span all branches and forests; ``maps`` are blocks times ``scale``."""

    def __init__(
        self,
        tableau: Tableau,
        vertices: Iterable[ForestVector],
        maps: Mapping[Edge, LinearMap | EntrywiseMap],
        scale: Any = ONE,
    ) -> None:
        super().__init__(tableau, ([vertex] for vertex in vertices))
        self._maps = maps
        self._scale = scale

    def members(self, order: int, roots: Mapping[int, int]) -> Iterator[tuple[int, ForestVector]]:
        """Root colours and forests that span those of all trees with conditions of an order."""
        for l, late in roots.items():
            for forest in self.of_trees(l, order - late):
                yield l, forest

    def _image(self, k: int, m: int, order: int, trees: Forests) -> Forests:
        kind = self.tableau.colours[m].kind
        factor = kind.integrated(order)
        images = self._maps[k, m].images([tuple(factor * y for y in x.vector) for x in trees])
        return [
            ForestVector(
                image, (Tree(m, x.branches, kind),), self._scale * x.scale, x.exact * kind.is_exact
            )
            for image, x in zip(images, trees, strict=True)
        ]

    def _new_forests(self, k: int, order: int) -> Forests:
        return self._joined(k, chain([self.branches(k, order)], self._products(k, order)))

    def _new_several(self, k: int, order: int) -> Forests:
        return self._joined(k, self._products(k, order))

    def _products(self, k: int, order: int) -> Iterator[Forests]:
        for branches, rests in self._splits(k, order):
            for branch in branches:
                batch = []
                for rest in rests:
                    check_time()
                    vector = self._product(k, branch.vector, rest.vector)
                    trees = (*branch.branches, *rest.branches)
                    exact = branch.exact * rest.exact
                    batch.append(ForestVector(vector, trees, branch.scale * rest.scale, exact))
                yield batch

    def _product(self, k: int, u: Sequence[Any], v: Sequence[Any]) -> Sequence[Any]:
        return self.tableau.spaces[k].product(u, v)  # type: ignore[arg-type]
