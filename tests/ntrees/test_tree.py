"""One tree: its canonical form and its three numbers."""

import random
from itertools import pairwise
from math import factorial

from hypothesis import given
from hypothesis import strategies as st

from garkcli.ntrees.tree import Tree

trees = st.recursive(
    st.builds(Tree, st.integers(0, 3)),
    lambda inner: st.builds(Tree, st.integers(0, 3), st.lists(inner, max_size=4)),
    max_leaves=12,
)


def test_symmetry_sees_colours() -> None:
    """[τ1,τ1] has an automorphism, [τ1,τ2] has none: σ is 2 and 1."""
    assert Tree(0, [Tree(0), Tree(0)]).symmetry == 2
    assert Tree(0, [Tree(0), Tree(1)]).symmetry == 1


@given(trees, st.randoms(use_true_random=False))
def test_the_order_of_branches_does_not_matter(tree: Tree, dice: random.Random) -> None:
    """A tree is equal to, and hashes as, any shuffling of its branches at every vertex."""

    def shuffled(u: Tree) -> Tree:
        branches = [shuffled(v) for v in u.branches]
        return Tree(u.root, dice.sample(branches, len(branches)))

    other = shuffled(tree)
    assert other == tree
    assert hash(other) == hash(tree)
    assert (other.symmetry, other.density, other.order) == (tree.symmetry, tree.density, tree.order)


@given(trees)
def test_labellings_are_counted_by_an_integer(tree: Tree) -> None:
    """σ γ divides n!: the quotient counts the increasing labellings of the tree."""
    assert factorial(tree.order) % (tree.symmetry * tree.density) == 0


@given(trees)
def test_vertices_carry_the_colours(tree: Tree) -> None:
    """There are as many vertices as the order says, and γ is the product of the orders of their
    subtrees.
    """
    subtrees = list(tree.vertices())
    product = 1
    for u in subtrees:
        product *= u.order
    assert len(subtrees) == tree.order
    assert product == tree.density
    assert tree.colours == {u.root for u in subtrees}


@given(st.lists(trees, min_size=2, max_size=6))
def test_the_order_of_trees_is_total(forest: list[Tree]) -> None:
    """Sort keys are equal for equal trees only, and smaller trees come first."""
    ranked = sorted(forest, key=Tree.sort_key)
    assert [u.order for u in ranked] == sorted(u.order for u in forest)
    for u, v in pairwise(ranked):
        assert (u.sort_key() == v.sort_key()) == (u == v)
