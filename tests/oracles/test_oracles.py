"""The oracles themselves: they see what they should see, without the certificate."""

from __future__ import annotations

from itertools import combinations

import pytest
from flint import fmpq

from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.tableau.forms import gark
from garkcli.tableau.polynomial_space import PolynomialSpace
from tests.oracles import samples
from tests.oracles.brute import Plain, Trees, Weights, brute_order, density, order_of, same_tree
from tests.oracles.points import at_points, lagrange, numbers, value
from tests.oracles.series import series_order
from tests.oracles.stages import one, product


def test_trees_are_all_and_once() -> None:
    """The numbers of trees with one and with four colours are the known ones, and no tree comes
    twice.
    """
    alone = Trees(samples.NAMED["gauss 3"]())
    assert [len(alone.of_order(n)) for n in range(1, 10)] == [1, 1, 2, 4, 9, 20, 48, 115, 286]
    pair = Trees(samples.NAMED["pair, collocation"]())
    assert sum(len(pair.of_order(n)) for n in range(1, 6)) == 6872
    assert all(order_of(u) == 4 for u in pair.of_order(4))
    assert not any(same_tree(u, v) for u, v in combinations(pair.of_order(3), 2))


def test_linear_colours_have_chains_only() -> None:
    """With one linear colour there is one tree of each order."""
    trees = Trees(samples.NAMED["linear"]())
    assert [len(trees.of_order(n)) for n in range(1, 6)] == [1] * 5


@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("explicit-euler", 1),
        ("heun", 2),
        ("kutta", 3),
        ("rk4", 4),
        ("gauss 3", 6),
        ("radau-iia 3", 5),
    ],
)
@pytest.mark.parametrize("seed", range(3))
def test_both_oracles_know_textbook_orders(name: str, order: int, seed: int) -> None:
    """Trees and power series give the orders of the textbooks, and both see the next power fail."""
    tableau = samples.NAMED[name]()
    assert brute_order(tableau, order + 2) == order
    assert series_order(tableau, order + 2, seed) == order


def test_table_1_of_the_paper() -> None:
    """The trees to order 4 have the densities of the paper's Table 1, and the classical method
    meets them all.
    """
    tableau = samples.NAMED["rk4"]()
    trees, weights = Trees(tableau), Weights(tableau)
    found = [(n, density(u)) for n in range(1, 5) for u in trees.of_order(n)]
    assert sorted(found) == [(1, 1), (2, 2), (3, 3), (3, 6), (4, 4), (4, 8), (4, 12), (4, 24)]
    assert all(
        weights.weight(u) == fmpq(1, density(u)) for n in range(1, 5) for u in trees.of_order(n)
    )


def test_power_series_see_what_scalar_problems_hide() -> None:
    """Residuals of [τ,[τ]] and [[τ,τ]] that cancel for every scalar equation do not cancel in the
    oracle.

    E adds −1/12 to the first and 1/6 to the second weight, with symmetries 1 and 2, and nothing to
    the others.
    """
    gauss = diagonal_method("gauss", 3)
    E = ((0, fmpq(1, 3), fmpq(1, 6)), (0, 0, 0), (0, -1, 0))
    A = tuple(
        tuple(x + y for x, y in zip(row, more, strict=True))
        for row, more in zip(gauss.A, E, strict=True)
    )
    tableau = gark([replace(gauss, A=A)], {})
    leaf: Plain = (0, ())
    twig: Plain = (0, (leaf,))
    weights = Weights(tableau)
    residual = {u: weights.weight(u) - fmpq(1, density(u)) for u in Trees(tableau).of_order(4)}
    assert sorted(residual.values()) == [fmpq(-1, 12), 0, 0, fmpq(1, 6)]
    assert residual[(0, (leaf, twig))] == fmpq(-1, 12)
    assert residual[(0, ((0, (leaf, leaf)),))] == fmpq(1, 6)
    assert brute_order(tableau, 5) == series_order(tableau, 5) == 3


def test_polynomials_and_points_are_one_algebra() -> None:
    """Values at the nodes of a product modulo M are the products of the values."""
    space = diagonal_method("gauss", 2).space
    assert isinstance(space, PolynomialSpace)
    (nodes,) = numbers("1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6")
    times = product(space)
    u, v = (fmpq(2), fmpq(-3, 5)), (fmpq(1, 7), fmpq(4))
    for c in nodes:
        assert value(times(u, v), c) == value(u, c) * value(v, c)
        assert value(one(space), c) == 1
    for j in range(2):
        assert [value(lagrange(nodes, j), c) for c in nodes] == [
            fmpq(int(i == j)) for i in range(2)
        ]


def test_the_order_does_not_depend_on_the_model() -> None:
    """Both oracles give the polynomial form and the entries in radicals of one method the same
    order.
    """
    tableau = samples.NAMED["pair, interpolation"]()
    nodes = numbers("1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6", "0, 1/2, 1")
    spelled = at_points(tableau, nodes)
    assert brute_order(tableau, 5) == brute_order(spelled, 5)
    assert series_order(tableau, 5) == series_order(spelled, 5)
