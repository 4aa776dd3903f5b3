"""The tree table against trees made one by one, and against the identities of the theory."""

from functools import cache
from itertools import combinations_with_replacement, product
from math import factorial

import numpy as np
import pytest

from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.ntrees.notation import format_tree
from garkcli.ntrees.table import MAX_TREES, TableTooLarge, TreeTable
from garkcli.ntrees.tree import Tree

EDGES = [[False, True, False], [True, False, True], [True, True, True]]


def partitions(n: int, largest: int) -> list[list[int]]:
    """The partitions of n into parts of at most ``largest``."""
    if n == 0:
        return [[]]
    return [[k, *rest] for k in range(min(n, largest), 0, -1) for rest in partitions(n - k, k)]


@cache
def brute_force(colours: int, order: int) -> frozenset[Tree]:
    """Every N-tree of an order: a root on every choice of trees for every partition of the rest."""
    found = set()
    for parts in partitions(order - 1, order - 1):
        choices = [
            combinations_with_replacement(
                sorted(brute_force(colours, k), key=Tree.sort_key), parts.count(k)
            )
            for k in sorted(set(parts))
        ]
        for groups in product(*choices):
            found.update(
                Tree(root, [u for group in groups for u in group]) for root in range(colours)
            )
    return frozenset(found)


def admissible(tree: Tree, edges: list[list[bool]], linear: tuple[int, ...]) -> bool:
    """Whether every parent sees its branches, and linear vertices have one branch at most."""
    return all(
        all(edges[v.root][u.root] for u in v.branches)
        and not (v.root in linear and len(v.branches) > 1)
        for v in tree.vertices()
    )


@pytest.mark.parametrize(("colours", "order"), [(1, 9), (2, 6), (3, 5), (4, 4)])
def test_every_tree_once(colours: int, order: int) -> None:
    """The table has exactly the trees of the brute force, in the order of Tree, with their σ, γ, ρ
    and root.
    """
    table = TreeTable.upto(colours, order)
    trees = [table.tree(i) for i in range(len(table))]
    assert trees == sorted(trees, key=Tree.sort_key)
    for n in range(1, order + 1):
        ids = table.ids(n)
        assert set(trees[ids.start : ids.stop]) == brute_force(colours, n)
    assert len(set(trees)) == len(trees)
    assert table.sigma.tolist() == [u.symmetry for u in trees]
    assert table.gamma.tolist() == [u.density for u in trees]
    assert table.order.tolist() == [u.order for u in trees]
    assert table.root.tolist() == [u.root for u in trees]


@pytest.mark.parametrize(("colours", "order"), [(1, 14), (2, 9), (3, 8), (4, 7), (5, 6)])
def test_labelled_trees_add_up(colours: int, order: int) -> None:
    """Σ n!/(σ γ) over the trees of order n is Nⁿ (n - 1)!, the number of increasing labelled
    N-trees.
    """
    table = TreeTable.upto(colours, order)
    for n in range(1, order + 1):
        ids = table.ids(n)
        labellings = factorial(n) // (
            table.sigma[ids.start : ids.stop] * table.gamma[ids.start : ids.stop]
        )
        assert labellings.sum() == colours**n * factorial(n - 1)


def test_columns_say_how_a_tree_is_made() -> None:
    """The tree of a row is its stem with the branch put on, the branch ids of a stem never
    decrease.
    """
    table = TreeTable.upto(2, 6)
    for i in range(2, len(table)):
        stem, branch = (table.tree(int(table.stem[i])), table.tree(int(table.branch[i])))
        assert table.tree(i) == Tree(stem.root, [*stem.branches, branch])
        assert table.branch[i] >= table.branch[table.stem[i]]
        assert table.multiplicity[i] == table.tree(i).branches.count(branch)


@pytest.mark.parametrize("linear", [(), (1,), (0, 2)])
def test_restrictions(linear: tuple[int, ...]) -> None:
    """With edges and linear colours exactly the admissible trees are made and counted."""
    table = TreeTable.upto(3, 6, EDGES, linear)
    for n, counts in enumerate(counts_upto(table.admissible, 6), 1):
        made = {table.tree(i) for i in table.ids(n)}
        assert made == {u for u in brute_force(3, n) if admissible(u, EDGES, linear)}
        assert counts == tuple(len(table.ids(n, root)) for root in range(3))


def test_nystrom_trees() -> None:
    """Separable problems with velocities linear in the momenta: colours alternate and V carries one
    branch.
    """
    table = TreeTable.upto(2, 9, [[False, True], [True, False]], linear=[0])
    assert [len(table.ids(n, root=1)) for n in range(1, 10)] == [1, 1, 2, 3, 6, 10, 20, 36, 72]


@pytest.mark.parametrize("colours", [True, False])
def test_notation_of_many_trees(colours: bool) -> None:
    """Text made from the parents' texts is the text of the tree, in whatever order and portions it
    is asked.
    """
    table = TreeTable.upto(2, 7)
    some = np.arange(len(table))[::-7]
    assert table.notation(some, colours) == [format_tree(table.tree(int(i)), colours) for i in some]
    everything = [format_tree(table.tree(i), colours) for i in range(len(table))]
    assert table.notation(range(len(table)), colours) == everything
    assert table.notation([], colours) == []


def test_exact_beyond_64_bits() -> None:
    """A trunk of 13 linear vertices under each bush: orders up to 26, where γ does not fit into 64
    bits.
    """
    edges = [[True, True], [False, False]]  # colour 1 ends a branch
    table = TreeTable.upto(2, 26, edges, linear=[0])
    for i in range(len(table)):
        u = table.tree(i)
        assert (table.sigma[i], table.gamma[i]) == (u.symmetry, u.density)
    assert table.gamma.max() == factorial(26)
    assert all(isinstance(value, int) for value in [*table.gamma, *table.sigma])


def test_bushes_beyond_64_bits() -> None:
    """A root that sees leaves only: σ of the bush of order 30 is 29!, exact."""
    table = TreeTable.upto(2, 30, [[False, True], [False, False]])
    assert [len(table.ids(n)) for n in (2, 3, 30)] == [1, 1, 1]
    assert table.sigma[-1] == factorial(29)
    assert table.gamma[-1] == 30


def test_columns_are_read_only() -> None:
    """A table cannot be changed behind the back of another user of it."""
    with pytest.raises(ValueError, match="read-only"):
        TreeTable.upto(1, 3).sigma[0] = 2


def test_too_large_a_table_is_refused_at_once() -> None:
    """More than MAX_TREES trees are counted, not made."""
    with pytest.raises(
        TableTooLarge, match=rf"more than 10\^28 trees of order up to 30 .*limit {MAX_TREES}"
    ):
        TreeTable.upto(4, 30)
    total = sum(map(sum, counts_upto(Admissible.of(4), 30)))
    assert 10**28 < total < 10**29
    with pytest.raises(TableTooLarge, match="196268698287 trees of order up to 29 with 1 colour "):
        TreeTable.upto(1, 29)


def test_no_such_id() -> None:
    """Ids outside the table are refused, negative ones too."""
    table = TreeTable.upto(1, 3)
    for bad in (-1, len(table)):
        with pytest.raises(IndexError, match="no tree"):
            table.tree(bad)
