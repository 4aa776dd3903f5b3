"""Trees, as text or objects, and the order conditions of a method."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TypeAlias

from garkcli.api.anymethod import AnyMethod, meant_of
from garkcli.api.numbers import Number, Whole, colours_of, whole
from garkcli.errors import MethodError, counted
from garkcli.exact.field import Number as Exact
from garkcli.ntrees import count, notation
from garkcli.ntrees.blocks import iter_blocks
from garkcli.ntrees.notation import parse_tree
from garkcli.ntrees.tree import Tree
from garkcli.order import conditions as by_tree
from garkcli.order.conditions import Condition
from garkcli.tableau.tableau import Tableau

AnyTree: TypeAlias = "Tree | str"
"""A tree, or its text in bracket notation."""


def tree_of(given: AnyTree) -> Tree:
    """Returns the tree; TreeError for a text that is not one, MethodError for other types."""
    if isinstance(given, Tree):
        return given
    if isinstance(given, str):
        return parse_tree(given)
    raise MethodError(
        f"a tree is expected, not {type(given).__name__}",
        "give its text, such as '[[],[]]'",
        code="arrays",
    )


def format_tree(tree: AnyTree, colours: bool = True) -> str:
    """A tree in bracket notation, with the colours of its vertices counted from 1.

    Args:
        tree: a tree, or its text, whose branches are sorted.
        colours: whether the colours are written.

    >>> format_tree("[[]_2,[[]_1]_1]_1"), format_tree("[[]_2,[[]_1]_1]_1", colours=False)
    ('[[[]_1]_1,[]_2]_1', '[[[]],[]]')
    """
    return notation.format_tree(tree_of(tree), colours)


def trees(order: Whole, colours: Whole = 1) -> Iterator[Tree]:
    """The trees of an order, in the order of ``gark trees``.

    Args:
        order: the number of vertices, at least 1.
        colours: the number of colours.

    >>> [format_tree(u, colours=False) for u in trees(3)]
    ['[[],[]]', '[[[]]]']
    """
    blocks = iter_blocks(whole(colours, "colours", 1), whole(order, "order", 1))
    return (parse_tree(text) for block in blocks for text in block.notation())


def count_trees(
    order: Whole,
    colours: Whole = 1,
    edges: Sequence[Sequence[bool]] | None = None,
    linear: Collection[int] = (),
) -> int:
    """The number of trees of an order, without enumeration.

    Args:
        order: the number of vertices, at least 1.
        colours: the number N of colours.
        edges: shape (N, N), whether a vertex of the row's colour may carry a branch whose root has
            the column's colour; by default all may.
        linear: colours, counted from 1, whose vertices have at most one branch.

    >>> [count_trees(n) for n in range(1, 9)]
    [1, 1, 2, 4, 9, 20, 48, 115]
    >>> count_trees(5, 2), count_trees(5, 2, edges=[[False, True], [True, False]])
    (214, 18)
    """
    colours = whole(colours, "colours", 1)
    order = whole(order, "order", 1)
    return count.count_trees(colours, order, edges, colours_of(linear, "linear", colours))


def conditions(
    method: AnyMethod, trees: AnyTree | Iterable[AnyTree], tolerance: Number | None = None
) -> Iterator[Condition]:
    """The order conditions of some trees, eq. (bA).

    Args:
        method: whatever ``method_of`` takes.
        trees: trees, or their texts; or one of them.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    Raises:
        MethodError: the method has no such condition, or no such colour.

    >>> [(str(x.tree), x.value, x.residual) for x in conditions("heun", ["[[],[]]", "[[[]]]"])]
    [('[[],[]]', 1/2, 1/6), ('[[[]]]', 0, -1/6)]
    """
    method, known_as = meant_of(method, tolerance, is_any_kind=True)
    if isinstance(trees, (str, Tree)) or not isinstance(trees, Iterable):
        trees = [trees]
    return by_tree.conditions(known_as, (_fitting(tree, method.tableau) for tree in trees))


def all_conditions(
    method: AnyMethod, order: Whole, tolerance: Number | None = None
) -> Iterator[Condition]:
    """The order conditions of one order; identical ones occur once.

    Args:
        method: whatever ``method_of`` takes.
        order: the order of the trees, at least 1.
        tolerance: as in ``conditions``.

    >>> [x.holds for x in all_conditions("rk4", 4)]
    [True, True, True, True]
    """
    order = whole(order, "order", 1)
    _, known_as = meant_of(method, tolerance, is_any_kind=True)
    return by_tree.all_conditions(known_as, order)


def elementary_weight(method: AnyMethod, tree: AnyTree) -> Exact:
    """b_lᵀ 𝒜^[u] of a tree u with a root of colour l, exact.

    Args:
        method: whatever ``method_of`` takes.
        tree: a tree, or its text.

    >>> elementary_weight("rk4", "[[[[]]]]"), elementary_weight("rk4", "[[[[[]]]]]")
    (1/24, 0)
    """
    return next(conditions(method, [tree])).value


def _fitting(given: AnyTree, tableau: Tableau) -> Tree:
    """Raises MethodError if the method lacks a colour."""
    tree = tree_of(given)
    largest = max(tree.colours) + 1
    if largest > tableau.size:
        message = f"the tree {tree} has colour {largest}"
        cure = f"the method has {counted(tableau.size, 'colour')}"
        raise MethodError(message, cure, code="no-such-tree")
    return tree
