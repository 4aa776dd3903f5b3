"""Rosenbrock methods on differential-algebraic equations of index 1: spans, all trees, and power
series that know neither trees nor gark.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from random import Random

import pytest
from flint import arb, fmpq

from garkcli import load
from garkcli.constructions.rosenbrock import Rosenbrock, rosenbrock, seen
from garkcli.errors import TreeError
from garkcli.exact.matrix import SingularMatrixError, identity
from garkcli.frozen import replace
from garkcli.order.admissible import coupling_graph
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import Order, find_order
from garkcli.order.deciding import order_of
from garkcli.order.meant import as_meant
from garkcli.tableau.enclosure import enclose_tableau
from tests.constructions.test_rosenbrock import RODAS3, made, numbers, random_method, ros3p
from tests.oracles import dae_series, dae_trees
from tests.oracles import rosenbrock_series as series
from tests.oracles.brute import brute_order
from tests.whole import at_most

LIMIT = 4


def random_on_dae(seed: int) -> series.Method:
    """A random method with γ_ii that are not 0, some of them RODAS3 with one entry changed; its
    conditions for z often hold.
    """
    dice, method = Random(seed), random_method(seed)
    while not all(method.gamma[0][0][i][i] for i in range(len(method.b[0]))):
        seed += 1000
        method = random_method(seed)
    if dice.random() < 0.3:  # b is the last row of α + γ: stiffly accurate
        (alpha,), (gamma,) = method.alpha[0], method.gamma[0]
        b = [x + y for x, y in zip(alpha[-1], gamma[-1], strict=True)]
        method = series.Method(method.alpha, method.gamma, [b])
    return method


def orders_of(method: Rosenbrock, limit: int = LIMIT) -> tuple[int, int, int]:
    """In y, in z, and of both."""
    views = method.on_dae_in_y, method.on_dae_in_z, method.on_dae
    y, z, both = (find_order(x, limit).order for x in views)
    return y, z, both


def test_random_methods_three_ways() -> None:
    """Spans, all trees of the book and power series find one order in y and one in z; that of both
    is the smaller of the first and one more than the second.
    """
    found = Counter()
    for seed in range(at_most(40, 250)):
        method = random_on_dae(seed)
        alpha, gamma, b = method.alpha[0][0], method.gamma[0][0], method.b[0]
        y, z, both = orders_of(made(method))
        assert (y, min(y, z)) == (y, z)
        by_trees = dae_trees.orders(alpha, gamma, b, LIMIT)
        assert (y, z) == by_trees == dae_series.orders(alpha, gamma, b, LIMIT, seed), seed
        assert both == min(y, z + 1)
        found[y, z] += 1
    assert {(1, 1), (2, 1), (3, 3)} <= found.keys()
    assert {y - z for y, z in found} >= {0, 1}


def test_all_trees_of_the_tableau() -> None:
    """With vertices that count no order the trees of the tableau are finitely many, and its order
    by all of them is that by spans.
    """
    for seed in range(8):
        method = made(random_on_dae(seed)).on_dae_in_z
        assert find_order(method, LIMIT).order == brute_order(method, LIMIT)


@pytest.mark.parametrize(
    ("name", "orders"),
    [
        ("rodas3", (3, 3, 3)),
        ("ros3p", (3, 2, 3)),
        ("shampine-rosenbrock-4", (3, 1, 2)),
        ("ros2", (2, 1, 2)),
        ("ode23s", (2, 1, 2)),
    ],
)
def test_published_methods(name: str, orders: tuple[int, int, int]) -> None:
    """RODAS3 and ROS3P have order 3, as their papers say; methods of order 4 that were made for ODEs
    alone have order 2, by b β⁻¹ α² = 1 (Hairer and Wanner, VI.4).
    """
    assert orders_of(Rosenbrock.of(load(name).tableau), 5) == orders


@pytest.mark.parametrize("name", ["rodas4", "rodasp", "ros34pw2", "grk4t"])
def test_rounded_methods(name: str) -> None:
    """RODAS and RODASP have order 4 within their digits, ROS34PW2 order 3, GRK4T order 2: the next
    fails for all methods there. The series of the printed digits misses by rounding alone.
    """
    order = {"rodas4": 4, "rodasp": 4, "ros34pw2": 3, "grk4t": 2}[name]
    method = as_meant(load(name))
    assert not isinstance(method, type(RODAS3.tableau))
    found = order_of(seen(method.aside(), "on_dae"), order + 1)
    assert (found.order, found.witness is not None) == (order, True)
    assert found.largest_residual < 1e-11
    tableau = Rosenbrock.of(method.tableau).on_dae
    spans = ApproximateSpans(tableau, enclose_tableau(tableau, 200), arb(10) ** -30)
    sizes = [spans.sizes(n) for n in range(1, order + 2)]
    assert all(x.bound < 1e-10 for x in sizes[:-1])
    assert sizes[-1].reached > 1e-4


def test_a_search_aside_moves_nothing() -> None:
    """The method that rounded digits mean is the same after orders on DAEs were found."""
    method = as_meant(load("rodas4"))
    before = order_of(method, 5), method.near
    assert order_of(seen(method.aside(), "on_dae_in_z"), 4).order == 4
    assert (order_of(method, 5), method.near) == before


def test_what_counts_no_order() -> None:
    """A g-tree fails ROS3P's order in z one order before its order of both; there is none where z
    is not determined, and no list of such trees.
    """
    found = find_order(ros3p().on_dae_in_z)
    assert found.witness is not None
    assert str(found.witness.tree) == "[[[]_1]_2,[]_1]_3"
    assert (found.order, found.witness.tree.order, found.witness.tree.density) == (2, 3, 2)
    assert not ros3p().on_dae.is_listed
    explicit = replace(RODAS3, gamma=((tuple((fmpq(0),) * 4 for _ in range(4)),),))
    with pytest.raises(SingularMatrixError):
        explicit.on_dae  # noqa: B018 -- it is made here
    with pytest.raises(TreeError, match="no end"):
        coupling_graph(ros3p().on_dae)


def test_implicit_stages() -> None:
    """With β = A of a Runge–Kutta method and γ = 0 stages are those of the state-space form: Radau's
    method of two stages has order 3 in y and z.
    """
    A = ((fmpq(5, 12), fmpq(-1, 12)), (fmpq(3, 4), fmpq(1, 4)))
    zero = ((fmpq(0),) * 2,) * 2
    assert orders_of(rosenbrock(A, zero, A[-1]), 5) == (3, 3, 3)
    assert identity(2) == rosenbrock(A, zero, A[-1]).on_dae.blocks[1, 2]
    assert find_order(rosenbrock(A, zero, A[-1]).on_dae) != Order(3, None)
    assert numbers(A[-1]) == [Fraction(3, 4), Fraction(1, 4)]
