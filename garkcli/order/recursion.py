"""Something for all trees of an order at once, from the same for smaller orders: no tree is listed.

A tree is its root with a forest on it. A forest is its smallest branch beside the forest of the
others, and a branch is a tree seen through a block A. So one value for all forests of an order, and
one for all branches, follow from those of the orders below.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Generic, TypeVar

from garkcli.tableau.tableau import Tableau

Found = TypeVar("Found")


class OrderByOrder(ABC, Generic[Found]):
    """One value for the branches of each order, and one for the forests, of every stage space.

    Args:
        tableau: the tableau whose trees are meant.
        empty: for each stage space what the empty forest has: that of a single vertex.
    """

    def __init__(self, tableau: Tableau, empty: Sequence[Found]) -> None:
        self.tableau = tableau
        # for each stage space one order after the other
        self._forests: list[list[Found | None]] = []
        self._branches: list[list[Found | None]] = []
        for value in empty:
            self._forests.append([value])
            self._branches.append([None])

    def of_trees(self, l: int, order: int) -> Found | None:
        """What all trees of an order with root colour l have; None where there is none."""
        colour = self.tableau.colours[l]
        k = colour.space
        self._extend(k, order - 1)
        if colour.is_linear and order > 1:
            return self._branches[k][order - 1]
        return self._forests[k][order - 1]

    def _extend(self, k: int, order: int) -> None:
        """Make all values of stage space k up to an order."""
        while len(self._forests[k]) <= order:
            n = len(self._forests[k])
            branches = self._new_branches(k, n)
            self._branches[k].append(branches)
            forests = self._new_forests(k, n)
            self._forests[k].append(forests)

    def _split_forests(self, k: int, order: int) -> Iterator[tuple[Found, Found]]:
        """The smallest branch, and the forest of the others, of all forests of two branches at
        least.
        """
        for j in range(1, order // 2 + 1):
            branch = self._branches[k][j]
            rest = self._forests[k][order - j]
            if branch is not None and rest is not None:
                yield branch, rest

    @abstractmethod
    def _new_branches(self, k: int, order: int) -> Found | None:
        """What the branches of an order have, over the colours that the stages of space k see."""

    @abstractmethod
    def _new_forests(self, k: int, order: int) -> Found | None:
        """What the forests of an order have, from smaller ones and the branches of this order."""
