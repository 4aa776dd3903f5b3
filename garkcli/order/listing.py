"""All conditions of a tableau of one order, from the tree table; identical ones once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from garkcli.order.conditions import Condition, conditions, coupling_graph, twin_roots
from garkcli.tableau.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import count_by_root
from garkcli.trees.tree import Tree


def count_conditions(tableau: Tableau, order: int) -> int:
    """How many conditions of ``order`` a tableau has, those of twin roots counted once."""
    edges, linear = coupling_graph(tableau)
    by_root = count_by_root(tableau.size, order, edges, linear)
    return sum(by_root[root] for root in twin_roots(tableau))


def all_conditions(method: AnyTableau, order: int) -> Iterator[Condition]:
    """Every condition of ``order``, its value exact, with the twins of its root: identical ones
    come once.
    """
    tableau = printed(method)
    twins = twin_roots(tableau)
    for condition in conditions(method, admissible_trees(tableau, order)):
        others = twins[condition.tree.root][1:]
        yield replace(condition, twins=others)


def admissible_trees(tableau: Tableau, order: int) -> Iterator[Tree]:
    """The trees of ``order`` that the coupling graph admits, one root colour of each group of
    twins.
    """
    from garkcli.trees.blocks import iter_blocks  # numpy is paid for here

    edges, linear = coupling_graph(tableau)
    twins = twin_roots(tableau)
    blocks = iter_blocks(
        tableau.size, order, edges=edges, linear=linear, roots=twins, block_size=1 << 14
    )
    for block in blocks:
        yield from block.trees()
