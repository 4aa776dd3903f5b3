"""Counts of N-trees without generating them."""

import pytest

from garkcli.trees.count import Admissible, count_by_root, count_trees, counts_upto


@pytest.mark.parametrize(
    ("colours", "counts"),
    [
        (1, [1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766, 12486, 32973, 87811]),
        (2, [2, 4, 14, 52, 214, 916, 4116, 18996, 89894, 433196]),
        (4, [4, 16, 104, 752, 5996, 50512, 444256, 4027360]),
    ],
)
def test_known_counts(colours: int, counts: list[int]) -> None:
    """Rooted trees (OEIS A000081) and rooted trees with two and four colours of vertices."""
    assert [count_trees(colours, n) for n in range(1, len(counts) + 1)] == counts


def test_large_orders_are_exact() -> None:
    """Counts far beyond 64 bits satisfy the functional equation: adding a root of any colour to a forest.

    Order 60 with three colours is compared with a second evaluation of the Euler transform, as the
    coefficient of a product over the trees' orders.
    """
    order, colours = 60, 3
    forests = [1] + [0] * (order - 1)
    count = 0
    for n in range(1, order + 1):
        count = colours * forests[n - 1]
        for degree in range(order - 1, n - 1, -1):  # times (1 - x^n)^(-count)
            ways, total = 1, forests[degree]
            for k in range(1, degree // n + 1):
                ways = ways * (count + k - 1) // k
                total += ways * forests[degree - k * n]
            forests[degree] = total
    assert count_trees(colours, order) == count


def test_roots_are_alike_where_all_edges_exist() -> None:
    """Without restrictions every root colour has the same number of trees."""
    assert count_by_root(3, 5) == (count_trees(3, 5) // 3,) * 3


def test_a_linear_colour_grows_tall_trees_only() -> None:
    """One linear colour has one tree of each order, however high."""
    assert [count_trees(1, n, linear=[0]) for n in (1, 2, 30)] == [1, 1, 1]


def test_no_edges_no_trees() -> None:
    """Colours that see nothing have single vertices only."""
    assert counts_upto(Admissible.of(2, [[False, False], [False, False]]), 3) == [(1, 1), (0, 0), (0, 0)]


@pytest.mark.parametrize(
    ("colours", "order", "edges", "linear"),
    [(0, 1, None, ()), (1, 0, None, ()), (2, 1, [[True]], ()), (2, 1, [[True], [True]], ()), (2, 1, None, (2,))],
)
def test_senseless_questions_are_refused(
    colours: int, order: int, edges: list[list[bool]] | None, linear: tuple[int, ...]
) -> None:
    """No colours, order 0, a matrix of the wrong shape, an unknown linear colour: each a ValueError."""
    with pytest.raises(ValueError, match=r"colour|order|edges"):
        count_trees(colours, order, edges, linear)
