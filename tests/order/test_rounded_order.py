"""The order within a tolerance: the catalogue, exact enumeration, edges of the tolerance, spans
against trees.
"""

from __future__ import annotations

from dataclasses import replace
from math import log10
from random import Random

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import ZeroWeight
from garkcli.exact.display import to_ball
from garkcli.families.registry import diagonal_method
from garkcli.order import rounded as module
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import find_order
from garkcli.order.conditions import conditions, coupling_graph
from garkcli.order.residuals import TreeResiduals
from garkcli.order.rounded import RoundedOrder, find_order_within
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.enclosing import enclose_tableau
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.method import butcher
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from garkcli.trees.table import TreeTable
from tests.oracles import samples
from tests.order.rounded_samples import ENTRIES, gauss_lobatto, in_decimals, nearest, published

SEEDS = st.integers(0, 2**32 - 1)


def largest_residuals(tableau: Tableau, limit: int) -> list[fmpq]:
    """The largest |residual| of each order up to ``limit``, all trees in exact rationals."""
    table = TreeTable.upto(tableau.size, limit, *coupling_graph(tableau))
    largest = [fmpq(0)] * limit
    for condition in conditions(tableau, map(table.tree, range(len(table)))):
        n = condition.tree.order - 1
        largest[n] = max(largest[n], abs(condition.residual))
    return largest


def rounded(tableau: Tableau, dice: Random, size: fmpq) -> Tableau:
    """Every entry of the blocks and weights moved by a random amount up to ``size``."""

    def moved(row: tuple[fmpq, ...]) -> tuple[fmpq, ...]:
        return tuple(x + size * fmpq(dice.randint(-100, 100), 100) for x in row)

    blocks = {key: tuple(moved(row) for row in block) for key, block in tableau.blocks.items()}  # type: ignore[arg-type]
    colours = tuple(replace(x, b=moved(x.b)) for x in tableau.colours)  # type: ignore[arg-type]
    return Tableau(tableau.spaces, colours, blocks)


def assert_witness(found: RoundedOrder) -> None:
    """The witness belongs to the next order and misses the tolerance, exactly."""
    assert found.witness is not None
    assert found.witness.tree.order == found.order + 1
    assert abs(to_ball(found.witness.residual)) > found.tolerance
    assert len(found.sizes) == len(found.means) == found.order + 1


@pytest.mark.parametrize("name", ENTRIES)
def test_the_catalogue_has_its_verified_orders(name: str) -> None:
    """Each of the 94 methods has its verified order within its rounding, and a witness one order
    higher.
    """
    found = find_order_within(published(name), power_of_ten(ENTRIES[name]["rounding"]))
    assert found.order == ENTRIES[name]["verified_order"]
    assert not found.undecided
    assert_witness(found)


def power_of_ten(rounding: float) -> fmpq:
    """The rounding of an entry, exact."""
    return fmpq(1, 10 ** round(-log10(rounding)))


def test_conjugates_and_pairs_of_the_catalogue_are_decided() -> None:
    """Wherever they exist; a pair has no higher order than the method and its conjugate."""
    decided = 0
    for name, entry in ENTRIES.items():
        method, tolerance = published(name), power_of_ten(entry["rounding"])
        try:
            both, other = pair(method), conjugate(method)
        except ZeroWeight:
            continue
        orders = [find_order_within(x, tolerance) for x in (both, method, other)]
        assert not any(x.undecided for x in orders)
        assert orders[0].order <= min(orders[1].order, orders[2].order)
        decided += 1
    assert decided > 30


@given(SEEDS)
def test_orders_are_those_of_exact_enumeration(seed: int) -> None:
    """Random graphs and rounded named methods, every tree in exact rationals, tolerances of all
    sizes.
    """
    dice = Random(seed)
    tableau = samples.random_graph(dice)
    if dice.random() < 0.5:
        tableau = gark([samples.method(dice.choice(["rk4", "kutta", "heun", "ssp2 4"]))], {})
    tableau = rounded(tableau, dice, fmpq(1, 10 ** dice.randint(1, 30)))
    tolerance = fmpq(1, 10 ** dice.randint(0, 31))
    exact = largest_residuals(tableau, 5)
    expected = next((n for n, size in enumerate(exact) if size > tolerance), 5)
    found = find_order_within(tableau, tolerance, 5)
    assert found.order == expected
    assert found.is_lower_bound == (expected == 5)
    with ctx.workprec(2000):
        assert all(
            bound >= size for bound, size in zip(found.sizes[:expected], exact, strict=False)
        )


@pytest.mark.parametrize("doubts", [0, 64])
def test_a_residual_equal_to_the_tolerance_is_met(
    doubts: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Equality counts as met and the least excess does not, though no ball can tell the two
    apart.
    """
    monkeypatch.setattr(module, "FEW_DOUBTS", doubts)
    monkeypatch.setattr(module, "MOST_BITS", 500)
    tableau = published("sciml_IMEXSSP3433")
    edge = max(largest_residuals(tableau, 3))
    assert find_order_within(tableau, edge).order == 3
    below = find_order_within(tableau, edge - fmpq(1, 10**400))
    assert below.order < 3
    assert below.witness is not None
    assert abs(below.witness.residual) == edge


def test_irrational_residuals_near_the_tolerance() -> None:
    """A residual of ℚ(cbrt(2)) is told from tolerances 10⁻⁹⁰ away on both sides."""
    tableau = samples.runge_kutta("0, 0", "cbrt(2), 0", "1 - cbrt(4)/4, cbrt(4)/4")
    exact = find_order(tableau)
    table = TreeTable.upto(1, exact.order + 1)
    trees = map(table.tree, table.ids(exact.order + 1))
    with ctx.workprec(400):
        size = max((abs(to_ball(x.residual, 100)) for x in conditions(tableau, trees)), key=float)
        below = nearest(size, 90)
    assert find_order_within(tableau, below).order == exact.order
    assert find_order_within(tableau, below + fmpq(1, 10**90)).order > exact.order


def test_a_perturbed_coefficient_lowers_the_order() -> None:
    """The weights decide order 1, a late coefficient a later order, a change below the tolerance
    nothing.
    """
    tableau = published("DP8_Hairer_853_float64")
    tolerance = fmpq(1, 10**12)

    def changed(size: fmpq, in_weights: bool) -> int:
        (colour,), block = tableau.colours, tableau.blocks[0, 0]
        if in_weights:
            colour = replace(colour, b=(colour.b[0] + size, *colour.b[1:]))
        else:
            last = (block[-1][0] + size, *block[-1][1:])
            block = (*block[:-1], last)
        return find_order_within(
            replace(tableau, colours=(colour,), blocks={(0, 0): block}), tolerance
        ).order

    assert [changed(fmpq(1, 10**n), True) for n in (10, 14)] == [0, 8]
    assert [changed(fmpq(1, 10**n), False) for n in (4, 14)] == [1, 8]


@given(SEEDS)
def test_spans_bound_every_tree(seed: int) -> None:
    """Whatever the grain, the bound is not below the largest residual, and members reach it or
    less.
    """
    dice = Random(seed)
    tableau = rounded(samples.random_graph(dice), dice, fmpq(1, 10 ** dice.randint(2, 20)))
    grain = arb(fmpq(1, 10 ** dice.randint(0, 25)))
    spans = ApproximateSpans(tableau, enclose_tableau(tableau, 600), grain)
    for n, largest in enumerate(largest_residuals(tableau, 5), start=1):
        sizes = spans.sizes(n)
        with ctx.workprec(2000):
            assert sizes.bound >= largest
            assert not sizes.reached > largest


def test_spans_are_sharp_where_all_is_known() -> None:
    """With members for every direction, spans and trees see the same largest residual of Gauss 2 at
    order 5.
    """
    tableau = gark([diagonal_method("gauss", 2)], {})
    enclosure = enclose_tableau(tableau, 300)
    spans, trees = (ApproximateSpans(tableau, enclosure, arb(0)), TreeResiduals(tableau, enclosure))
    assert spans.sizes(4).bound < fmpq(1, 10**60)
    assert spans.sizes(5).reached.overlaps(trees.sizes(5).reached)


@pytest.mark.parametrize(
    ("stages", "digits", "tolerance", "order"),
    [(2, 16, 14, 4), (3, 30, 28, 6), (4, 30, 26, 8), (6, 30, 25, 12), (10, 60, 45, 20)],
)
def test_gauss_and_lobatto_in_decimals(
    stages: int, digits: int, tolerance: int, order: int
) -> None:
    """The pair has four colours: 3.6·10¹¹ trees up to order 13 for Gauss 6 are no obstacle."""
    both = pair(gauss_lobatto(stages, digits))
    found = find_order_within(both, fmpq(1, 10**tolerance))
    assert found.order == order
    assert found.largest_residual < fmpq(1, 10**tolerance)
    assert_witness(found)
    assert ("spans" in found.means) == (stages > 2)


def test_families_mixed_with_decimals() -> None:
    """A family stays exact beside a method in decimals: its nodes are enclosed as finely as
    needed.
    """
    gauss, lobatto = (diagonal_method("gauss", 3), diagonal_method("lobatto-iiia", 4))
    cut = in_decimals(gark([lobatto], {}), 30)
    decimal = butcher(cut.blocks[0, 0], cut.colours[0].b, cut.colours[0].c)
    mixed = gark(
        [gauss, decimal], {(0, 1): collocation(gauss, decimal), (1, 0): collocation(decimal, gauss)}
    )
    assert find_order(mixed).order < 6
    assert find_order_within(mixed, fmpq(1, 10**28)).order == 6
    assert find_order_within(pair(mixed), fmpq(1, 10**28)).order == 6


def test_exact_methods_need_no_trees() -> None:
    """Gauss 10 × Lobatto IIIA 11 as families, any tolerance below its errors: decided by the
    certificate.
    """
    both = pair(samples.everywhere(collocation, "gauss 10", "lobatto-iiia 11"))
    found = find_order_within(both, fmpq(1, 10**30))
    assert (found.order, set(found.means)) == (20, {"exact"})
    assert found.witness == find_order(both).witness


def test_what_is_too_much_is_left_undecided() -> None:
    """A tolerance at the size of the rounding: the trees are too many, the bounds too wide, nothing
    is claimed.
    """
    found = find_order_within(pair(gauss_lobatto(6, 30)), fmpq(1, 10**28))
    assert found.undecided
    assert found.witness is None
    assert 6 <= found.order < 12


def test_spans_come_first_then_trees(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where spans cannot tell, trees do as long as they are not too many."""
    tableau = gauss_lobatto(2, 30)
    edge = max(largest_residuals(tableau, 4))
    monkeypatch.setattr(module, "FEW_TREES", 0)
    assert "trees" in find_order_within(tableau, edge).means
    assert find_order_within(tableau, edge).order == 4
    monkeypatch.setattr(module, "MOST_TREES", 0)
    assert find_order_within(tableau, edge).undecided


def test_limits() -> None:
    """The search stops at its limit with a lower bound; a tolerance of zero asks for the exact
    order.
    """
    tableau = published("sprk_Yoshida_6_8")
    found = find_order_within(tableau, fmpq(1, 10**30), 3)
    assert (found.order, found.is_lower_bound, found.undecided) == (3, True, False)
    assert find_order_within(tableau, fmpq(0)).order == find_order(tableau).order == 0
    endless = samples.without_cycles()
    assert find_order_within(endless, fmpq(1, 2)).order == 60
