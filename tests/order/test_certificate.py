"""The certificate against every tree, and against power series that know no trees."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from flint import fmpq

from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau, butcher
from tests.oracles import samples
from tests.oracles.brute import Trees, Weights, brute_order, density, failing, plain, same_tree
from tests.oracles.series import series_order
from tests.whole import in_whole

RANDOM: dict[str, tuple[Callable[[Random], Tableau], int]] = {
    "graph": (samples.random_graph, 60),
    "additive": (samples.random_additive, 10),
    "partitioned": (samples.random_partitioned, 10),
    "changed": (samples.changed, 100),
}
LIMIT = 5
"""Random tableaus may have no end; their trees are listed up to this order."""


def cases(count_divisor: int = 1) -> list[pytest.param]:
    """Makers of random tableaus, each with its own seed."""
    return [
        pytest.param(lambda make=make, seed=seed: make(Random(seed)), id=f"{kind}-{seed}")  # type: ignore[misc]
        for kind, (make, count) in RANDOM.items()
        for seed in range(count // count_divisor)
    ]


NAMED = [pytest.param(make, id=name) for name, make in samples.NAMED.items()]


def assert_witness_fails(tableau: Tableau, found: Order) -> None:
    """The witness is an admissible tree of the next order, with the value and requirement that it
    states.
    """
    assert found.witness is not None
    tree = plain(found.witness.tree)
    trees_there = Trees(tableau).of_order(found.order + 1)
    assert any(same_tree(tree, u) for u in trees_there)
    assert found.witness.value == Weights(tableau).weight(tree)
    assert found.witness.required == fmpq(1, density(tree))
    assert found.witness.residual == found.witness.value - found.witness.required
    assert found.witness.value != found.witness.required


@pytest.mark.parametrize("make", NAMED)
def test_named_tableaus_against_every_tree(make: Callable[[], Tableau]) -> None:
    """All conditions hold up to the order that the certificate finds, and its witness fails one
    order higher.
    """
    tableau = make()
    found = find_order(tableau)
    assert brute_order(tableau, found.order + 1) == found.order
    assert_witness_fails(tableau, found)


@pytest.mark.parametrize("make", cases())
def test_random_tableaus_against_every_tree(make: Callable[[], Tableau]) -> None:
    """Random coefficients, coupling graphs and linear colours: the same order as by listing all
    trees.
    """
    tableau = make()
    found = find_order(tableau, LIMIT)
    assert found.order == brute_order(tableau, LIMIT)
    if found.witness is None:
        assert found.order == LIMIT
    else:
        assert_witness_fails(tableau, found)


@pytest.mark.parametrize("make", NAMED)
def test_named_tableaus_against_power_series(make: Callable[[], Tableau]) -> None:
    """One step on a random polynomial problem agrees with the flow in exactly as many powers of
    h.
    """
    tableau = make()
    order = find_order(tableau).order
    assert series_order(tableau, order + 1) == order


@pytest.mark.parametrize("make", cases(count_divisor=2))
def test_random_tableaus_against_power_series(make: Callable[[], Tableau]) -> None:
    """The same on random tableaus, where absent edges and linear fields are those of the
    problem.
    """
    tableau = make()
    assert series_order(tableau, LIMIT, seed=1) == find_order(tableau, LIMIT).order


@in_whole
def test_random_tableaus_are_worth_trying() -> None:
    """Among the random tableaus are all orders from 0 to the limit, with and without absent
    edges.
    """
    tableaus = [case.values[0]() for case in cases()]
    orders = {find_order(tableau, LIMIT).order for tableau in tableaus}
    sparse = sum(len(list(tableau.edges())) < tableau.size**2 for tableau in tableaus)
    linear = sum(any(colour.is_linear for colour in tableau.colours) for tableau in tableaus)
    assert orders == set(range(LIMIT + 1))
    assert sparse > 10
    assert linear > 10
    assert len(tableaus) - sparse > 10


@pytest.mark.parametrize("seed", range(5))
def test_a_perturbed_entry_is_noticed(seed: int) -> None:
    """After a change of one coefficient the order is lower, and what all trees say."""
    tableau = samples.perturbed(samples.NAMED["gauss 3"](), Random(seed))
    found = find_order(tableau)
    assert found.order < 6
    assert found.order == brute_order(tableau, 6)


def test_without_cycles_there_is_only_a_lower_bound() -> None:
    """Where trees end, so do their conditions: the order is the one of the quadratures, then
    void.
    """
    tableau = samples.without_cycles()
    trees = Trees(tableau)
    assert [len(trees.of_order(n)) for n in (1, 2, 3, 4)] == [2, 1, 1, 1]
    assert find_order(tableau).order == brute_order(tableau, 8) == 6
    quadrature_alone = samples.NAMED["one linear of two"]()
    lonely = Tableau(quadrature_alone.spaces, quadrature_alone.colours, {})
    assert find_order(lonely) == Order(DEFAULT_LIMIT, None)
    assert find_order(lonely, 7) == Order(7, None)
    assert find_order(lonely).is_lower_bound


def test_linear_fields_can_make_all_conditions_void() -> None:
    """A linear colour that sees one that sees nothing has two conditions, and both hold for the
    midpoint rule.
    """
    full = samples.everywhere(samples.RULES["collocation"], "gauss 1", "gauss 1")
    chain = samples.with_linear(
        Tableau(full.spaces, full.colours, {(0, 1): full.blocks[0, 1]}), ["1"]
    )
    assert [len(Trees(chain).of_order(n)) for n in (1, 2, 3)] == [2, 1, 0]
    assert find_order(chain) == Order(DEFAULT_LIMIT, None)


def test_the_limit_is_a_lower_bound() -> None:
    """A search that stops early says at least, one that is allowed to fail says exactly."""
    tableau = samples.NAMED["gauss 3"]()
    assert find_order(tableau, 5) == Order(5, None)
    assert find_order(tableau, 6) == Order(6, None)
    assert find_order(tableau, 7).order == 6
    assert not find_order(tableau, 7).is_lower_bound


def test_weights_that_do_not_sum_to_one_have_order_0() -> None:
    """Order 0 comes with a single vertex as its witness."""
    found = find_order(samples.NAMED["order 0"]())
    assert found.order == 0
    assert found.witness is not None
    assert plain(found.witness.tree) == (0, ())
    assert (found.witness.value, found.witness.required) == (fmpq(5, 6), fmpq(1))


def test_many_trees_fail_where_one_witness_is_named() -> None:
    """The witness is one of the failing trees that the list of all trees finds, and not the only
    one.
    """
    tableau = samples.NAMED["pair of lower order"]()
    found = find_order(tableau)
    assert found.witness is not None
    trees = failing(tableau, found.order + 1)
    assert any(same_tree(plain(found.witness.tree), u) for u in trees)
    assert 1 < len(trees) < len(Trees(tableau).of_order(found.order + 1))


def test_of_equal_residuals_the_first_is_told() -> None:
    """Both colours have weights of seven digits, which miss 1 alike; larger ones are told first."""
    third = fmpq(3333333, 10**7)
    zero = fmpq(0)
    A = ((zero,) * 3, (fmpq(1, 2), zero, zero), (zero, fmpq(1), zero))
    method, other = (butcher(A, (third, third, third - off)) for off in (zero, fmpq(1, 10**8)))
    for colours, root in (([method, method], 0), ([method, other], 1), ([other, method], 0)):
        witness = find_order(gark(colours, {})).witness
        assert witness is not None
        assert (witness.tree.order, witness.tree.root) == (1, root)
