"""Order conditions that one method meets and the other does not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from garkcli.order.conditions import Condition, conditions, coupling_graph, twin_roots
from garkcli.tableau.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import count_by_root
from garkcli.trees.tree import Tree

MAX_CONDITIONS = 2000
"""More conditions are not compared, of all orders together."""


@dataclass(frozen=True)
class Met:
    """Conditions of some orders that two methods do not meet alike.

    Attributes:
        order: all conditions up to this order were compared.
        pairs: for each tree with one verdict for each method the two conditions.
    """

    order: int
    pairs: tuple[tuple[Condition, Condition], ...]

    @property
    def first_only(self) -> tuple[tuple[Condition, Condition], ...]:
        """What the first method meets and the second does not."""
        return tuple(x for x in self.pairs if x[0].holds)

    @property
    def second_only(self) -> tuple[tuple[Condition, Condition], ...]:
        """What the second method meets and the first does not."""
        return tuple(x for x in self.pairs if x[1].holds)


def conditions_met(one: AnyTableau, other: AnyTableau, upto: int) -> Met:
    """The conditions that one method meets and the other does not.

    Args:
        one: a method.
        other: another with the same number of colours.
        upto: the highest order of interest; fewer are compared where there are more than
            ``MAX_CONDITIONS`` conditions.
    """
    tableau = printed(one)
    graph = _common_graph(tableau, printed(other))
    roots = _common_roots(tableau, printed(other))
    pairs: list[tuple[Condition, Condition]] = []
    reached, total = 0, 0
    for order in range(1, upto + 1):
        by_root = count_by_root(tableau.size, order, *graph)
        total += sum(by_root[root] for root in roots)
        if total > MAX_CONDITIONS:
            break
        trees = list(_trees(tableau.size, order, graph, roots))
        found = zip(conditions(one, trees), conditions(other, trees), strict=True)
        for first, second in found:
            if first.holds != second.holds:
                pairs.append((first, second))
        reached = order
    return Met(reached, tuple(pairs))


_Graph = tuple[tuple[tuple[bool, ...], ...], frozenset[int]]


def _common_graph(one: Tableau, other: Tableau) -> _Graph:
    """Which trees both methods admit."""
    edges, linear = coupling_graph(one)
    others, linear_too = coupling_graph(other)
    both = []
    for row, second in zip(edges, others, strict=True):
        pairs = zip(row, second, strict=True)
        both.append(tuple(x and y for x, y in pairs))
    return tuple(both), linear | linear_too


def _common_roots(one: Tableau, other: Tableau) -> list[int]:
    """Root colours, one of each group whose conditions are the same in both methods."""
    twins = twin_roots(one)
    if twins == twin_roots(other):
        return list(twins)
    return list(range(one.size))


def _trees(colours: int, order: int, graph: _Graph, roots: Sequence[int]) -> Iterator[Tree]:
    from garkcli.trees.blocks import iter_blocks  # numpy is paid for here

    edges, linear = graph
    blocks = iter_blocks(colours, order, edges=edges, linear=linear, roots=roots)
    for block in blocks:
        yield from block.trees()
