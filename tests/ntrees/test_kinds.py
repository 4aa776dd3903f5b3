"""Trees whose vertices have any numbers of branches and count several orders."""

from __future__ import annotations

from functools import cache
from itertools import chain, combinations, combinations_with_replacement, product
from math import prod

import numpy as np
import pytest

from garkcli.errors import TreeError
from garkcli.ntrees.blocks import blocks_of
from garkcli.ntrees.count import Admissible, counts_of, counts_upto
from garkcli.ntrees.kind import LEAF, LINEAR, PLAIN, VertexKind
from garkcli.ntrees.listing import FEW, listed, trees_of
from garkcli.ntrees.notation import format_tree
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree
from tests.whole import at_most, in_whole

ARITIES = [
    frozenset(some) for some in chain.from_iterable(combinations((0, 1, 2), n) for n in (1, 2, 3))
]
NOT_ONE, ONE = VertexKind(frozenset({0, 2})), VertexKind(frozenset({1}))
CASES = {
    "rosenbrock": Admissible(2, ((0, 1), (0, 1)), (NOT_ONE, ONE)),
    "W": Admissible(2, ((0, 1), (0, 1)), (PLAIN, VertexKind(frozenset({1}), is_exact=False))),
    "two orders": Admissible(2, ((0, 1), (1,)), (PLAIN, VertexKind(weight=2))),
    "leaf": Admissible(3, ((0, 1, 2), (0,), ()), (VertexKind(frozenset({2, 0})), LINEAR, LEAF)),
    **{
        f"{sorted(arity)}, {weight}": Admissible(
            2,
            ((0, 1), (0, 1)),
            (VertexKind(arity, weight), VertexKind(frozenset({0, 1}), 3 - weight)),
        )
        for arity in ARITIES
        for weight in (1, 2)
    },
}


def by_definition(admissible: Admissible, order: int) -> list[Tree]:
    """Every tree, from all forests of smaller ones, in the order of trees."""

    @cache
    def trees(root: int, n: int) -> tuple[Tree, ...]:
        kind, rest = admissible.kinds[root], n - admissible.kinds[root].weight
        found = [
            admissible.tree(root, branches)
            for branches in forests(root, rest, rest)
            if (0, 1, 2)[min(len(branches), 2)] in kind.arity
        ]
        return tuple(sorted(found, key=Tree.sort_key))

    @cache
    def forests(root: int, total: int, largest: int) -> tuple[tuple[Tree, ...], ...]:
        if total <= 0:
            return ((),) if total == 0 else ()
        found: list[tuple[Tree, ...]] = []
        for n in range(1, min(total, largest) + 1):
            of_order = [u for m in admissible.branches[root] for u in trees(m, n)]
            for count in range(1, total // n + 1):
                some = combinations_with_replacement(of_order, count)
                rest = forests(root, total - n * count, n - 1)
                found += [(*x, *y) for x, y in product(some, rest)]
        return tuple(found)

    return [u for root in range(admissible.colours) for u in trees(root, order)]


HIGHEST = at_most(6, 8)


@pytest.mark.parametrize("name", CASES)
def test_every_tree_once(name: str) -> None:
    """Counts, table, blocks and a listing by definition have the same trees, in one order, with the
    same ρ, σ and γ.
    """
    admissible = CASES[name]
    table, counts = TreeTable.of(admissible, HIGHEST), counts_upto(admissible, HIGHEST)
    texts = table.notation(np.arange(len(table)))
    for n in range(1, HIGHEST + 1):
        trees = by_definition(admissible, n)
        assert [table.tree(i) for i in table.ids(n)] == trees
        assert [u for block in blocks_of(admissible, n, 3) for u in block.trees()] == trees
        assert [*listed(admissible, n, range(admissible.colours))] == trees
        by_root = tuple(sum(u.root == l for u in trees) for l in range(admissible.colours))
        assert counts[n - 1] == counts_of(admissible, n) == by_root
        for i, u in zip(table.ids(n), trees, strict=True):
            assert (table.order[i], table.sigma[i], table.gamma[i]) == (n, u.symmetry, u.density)
            assert (table.root[i], table.is_exact[i]) == (u.root, u.is_exact)
            assert texts[i] == format_tree(u)
            assert u.kind == admissible.kinds[u.root]


@in_whole
def test_the_cases_are_worth_trying() -> None:
    """There are trees, of several branches, without an exact solution, and of two orders."""
    found = [u for x in CASES.values() for n in range(1, 9) for u in by_definition(x, n)]
    assert len(found) > 5000
    assert any(not u.is_exact for u in found)
    assert any(u.kind.weight == 2 and len(u.branches) > 2 for u in found)


def test_two_colours_of_one_field_are_its_trees() -> None:
    """Where one colour has exactly one branch and the other has none or several, the trees are
    those of one colour: the same numbers, densities and symmetries, up to large orders.
    """
    pair, plain = CASES["rosenbrock"], Admissible.of(1)
    assert [sum(x) for x in counts_upto(pair, 150)] == [sum(x) for x in counts_upto(plain, 150)]
    two, one = TreeTable.of(pair, 9), TreeTable.of(plain, 9)
    for n in range(1, 10):
        here, there = list(two.ids(n)), list(one.ids(n))
        numbers = zip(two.gamma[here].tolist(), two.sigma[here].tolist(), strict=True)
        assert sorted(numbers) == sorted(
            zip(one.gamma[there].tolist(), one.sigma[there].tolist(), strict=True)
        )


def test_density_of_vertices_that_count_twice() -> None:
    """γ of a tall tree of vertices that count two orders is n!, as of twice as many that count one:
    the solution of ÿ = y.
    """
    tall = Tree(0, (), VertexKind(weight=2))
    for n in range(2, 6):
        tall = Tree(0, (tall,), VertexKind(weight=2))
        assert (tall.order, tall.density) == (2 * n, prod(range(1, 2 * n + 1)))


def test_vertices_that_count_nothing_have_no_list() -> None:
    """Trees with them would have no end."""
    with pytest.raises(TreeError, match="no end"):
        Admissible(1, ((0,),), (VertexKind(weight=0),))


def test_table_in_python_integers_with_bare_stems() -> None:
    """Beyond order 20 the columns hold Python integers; γ of the tall tree is exact."""
    admissible = Admissible(2, ((1,), (0, 1)), (VertexKind(frozenset({0})), ONE))
    table = TreeTable.of(admissible, 24)
    assert counts_upto(admissible, 24)[-1] == (0, 1)
    (last,) = table.ids(24)
    assert table.gamma[last] == prod(range(1, 25))


def test_few_trees_are_listed_as_many_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """One by one and in blocks they are the same, in one order, also with some roots alone."""
    admissible = CASES["two orders"]
    for n in range(1, 7):
        some = [*trees_of(admissible, n)]
        first = [*trees_of(admissible, n, [0])]
        assert 0 < len(some) <= FEW
        with monkeypatch.context() as patched:
            patched.setattr("garkcli.ntrees.listing.FEW", -1)
            assert [*trees_of(admissible, n)] == some
            assert [*trees_of(admissible, n, [0])] == first
        assert first == [u for u in some if u.root == 0]


def test_words_of_kinds() -> None:
    """Numbers of branches in words; a linear field has one at most."""
    assert LINEAR.branches == "no branch or one branch"
    assert NOT_ONE.branches == "no branch or several branches"
    assert PLAIN.of_linear_field == LINEAR
