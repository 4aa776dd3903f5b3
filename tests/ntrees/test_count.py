"""Counts of N-trees without generating them."""

from time import process_time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.ntrees import count
from garkcli.ntrees.count import Admissible, count_by_root, count_trees, counts_upto
from tests.whole import at_most, in_whole


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
    """Counts far beyond 64 bits satisfy the functional equation: adding a root of any colour to a
    forest.

    Order 60 with three colours is compared with a second evaluation of the Euler transform, as the
    coefficient of a product over the trees' orders.
    """
    order, colours = 60, 3
    forests = [1] + [0] * (order - 1)
    trees = 0
    for n in range(1, order + 1):
        trees = colours * forests[n - 1]
        for degree in range(order - 1, n - 1, -1):  # times (1 - x^n)^(-trees)
            ways, total = 1, forests[degree]
            for k in range(1, degree // n + 1):
                ways = ways * (trees + k - 1) // k
                total += ways * forests[degree - k * n]
            forests[degree] = total
    assert count_trees(colours, order) == trees


def test_roots_are_alike_where_all_edges_exist() -> None:
    """Without restrictions every root colour has the same number of trees."""
    assert count_by_root(3, 5) == (count_trees(3, 5) // 3,) * 3


def test_a_linear_colour_grows_tall_trees_only() -> None:
    """One linear colour has one tree of each order, however high."""
    assert [count_trees(1, n, linear=[0]) for n in (1, 2, 30)] == [1, 1, 1]


def test_no_edges_no_trees() -> None:
    """Colours that see nothing have single vertices only."""
    assert counts_upto(Admissible.of(2, [[False, False], [False, False]]), 3) == [
        (1, 1),
        (0, 0),
        (0, 0),
    ]


@pytest.mark.parametrize(
    ("colours", "order", "edges", "linear"),
    [
        (0, 1, None, ()),
        (1, 0, None, ()),
        (2, 1, [[True]], ()),
        (2, 1, [[True], [True]], ()),
        (2, 1, None, (2,)),
    ],
)
def test_senseless_questions_are_refused(
    colours: int, order: int, edges: list[list[bool]] | None, linear: tuple[int, ...]
) -> None:
    """No colours, order 0, a matrix of the wrong shape, an unknown linear colour: each a
    ValueError.
    """
    with pytest.raises(ValueError, match=r"colour|order|edges"):
        count_trees(colours, order, edges, linear)


def one_by_one(admissible: Admissible, order: int) -> list[tuple[int, ...]]:
    """The Euler transform as it is written, without blocks, leaders or products of polynomials."""
    colours = range(admissible.colours)
    forests = [[1] for _ in colours]
    for n in range(1, order):
        grown = []
        for colour in colours:
            t = [0, *(sum(forests[m][k] for m in admissible.branches[colour]) for k in range(n))]
            c = [sum(d * t[d] for d in range(1, k + 1) if k % d == 0) for k in range(n + 1)]
            total = sum(c[k] * forests[colour][n - k] for k in range(1, n + 1))
            assert admissible.is_linear(colour) or total % n == 0
            grown.append(t[n] if admissible.is_linear(colour) else total // n)
        for f, x in zip(forests, grown, strict=True):
            f.append(x)
    return [tuple(f[n] for f in forests) for n in range(order)]


@given(data=st.data(), colours=st.integers(1, 3), order=st.integers(1, 30), short=st.integers(1, 7))
@settings(max_examples=at_most(10, 200), deadline=None)
def test_blocks_make_no_difference(
    data: st.DataObject, colours: int, order: int, short: int
) -> None:
    """With any edges and linear colours, and blocks of any length, the counts are those of the
    formula.
    """
    row = st.lists(st.booleans(), min_size=colours, max_size=colours)
    edges = data.draw(st.lists(row, min_size=colours, max_size=colours))
    linear = data.draw(st.sets(st.integers(0, colours - 1)))
    admissible = Admissible.of(colours, edges, linear)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(count, "SHORT", short)
        assert counts_upto(admissible, order) == one_by_one(admissible, order)


def test_counts_of_any_order_begin_alike() -> None:
    """Where blocks end depends on the order asked for; the counts do not."""
    admissible = Admissible.of(2, [[True, True], [True, False]], [1])
    long = counts_upto(admissible, 400)
    for order in (47, 48, 49, 95, 96, 97, 98, 191, 193, 255, 256, 257, 399):
        assert counts_upto(admissible, order) == long[:order]


@in_whole
def test_thousands_of_vertices_are_soon_counted() -> None:
    """Order 3000 has O(M(n) log n) operations, not n² on long integers; the last digits are those
    of the formula.

    The sum over k of c(k) f(n - k) is n f(n): the defining equation, at the highest order.
    """
    order = 3000
    before = process_time()
    numbers = [trees for (trees,) in counts_upto(Admissible.of(1), order + 1)]
    assert process_time() - before < 10
    t, f = [0, *numbers], numbers
    c = [0] * (order + 1)
    for d in range(1, order + 1):
        for k in range(d, order + 1, d):
            c[k] += d * t[d]
    assert sum(c[k] * f[order - k] for k in range(1, order + 1)) == order * f[order]
