"""The order within a tolerance: the catalogue, exact enumeration, edges of the tolerance, spans
against trees.
"""

from __future__ import annotations

from math import log10
from random import Random

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import loads
from garkcli.check.analysis import analyse_any
from garkcli.errors import ZeroWeight
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.ntrees.table import TreeTable
from garkcli.order.admissible import coupling_graph
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import find_order
from garkcli.order.conditions import conditions
from garkcli.order.meant import as_meant
from garkcli.order.rounded import RoundedOrder, RoundedTableau, find_order_within
from garkcli.order.tree_residuals import TreeResiduals
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau, butcher
from garkcli.transfer import collocation
from tests.oracles import samples
from tests.order.rounded_samples import (
    ENTRIES,
    EXACT,
    ROUNDED,
    gauss_lobatto,
    in_decimals,
    published,
    rounded,
)
from tests.whole import IS_WHOLE, at_most, in_whole, sample

SEEDS = st.integers(0, 2**32 - 1)


def first_missed(method: RoundedTableau, limit: int) -> int:
    """The first order with a condition that rounding does not explain, tree by tree, or the limit."""
    table = TreeTable.of(coupling_graph(method.tableau), limit)
    missed = (
        x.tree.order for x in conditions(method, map(table.tree, range(len(table)))) if not x.holds
    )
    return min(missed, default=limit + 1)


def largest_residuals(tableau: Tableau, limit: int) -> list[fmpq]:
    """The largest |residual| of each order up to ``limit``, all trees in exact rationals."""
    table = TreeTable.of(coupling_graph(tableau), limit)
    largest = [fmpq(0)] * limit
    for condition in conditions(tableau, map(table.tree, range(len(table)))):
        n = condition.tree.order - 1
        largest[n] = max(largest[n], abs(condition.residual))
    return largest


def order_within(tableau: Tableau, tolerance: fmpq, limit: int = 60) -> RoundedOrder:
    """The order with every coefficient off by the tolerance at most."""
    return find_order_within(RoundedTableau.within(tableau, tolerance), limit)


def assert_witness(found: RoundedOrder) -> None:
    """The witness belongs to the next order."""
    assert found.witness is not None
    assert found.witness.tree.order == found.order + 1


LONG = {
    *("sprk_Sofroniou_10_36", "Feagin12", "sprk_McAte8_26digits", "sprk_SuzukiUmeno_8_16"),
    *("sprk_KahanLi_8_18", "sundials_ARK548L2SAb", "sundials_VERNER_16_8_9", "sciml_KenCarp5"),
    *("Feagin10", "sciml_KenCarp4"),
}
"""Methods of many stages, which take long."""
CATALOGUE = ROUNDED if IS_WHOLE else [name for name in ROUNDED if name not in LONG][::5]


@pytest.mark.parametrize("name", [*CATALOGUE, *sample(EXACT[::3], 6)])
def test_the_catalogue_has_its_verified_orders(name: str) -> None:
    """Rounded methods, and some exact ones, have their verified order within their rounding, and a
    witness one order higher; all of them in ``make whole``.
    """
    found = order_within(published(name), power_of_ten(ENTRIES[name]["rounding"]))
    assert found.order == ENTRIES[name]["verified_order"]
    assert not found.undecided
    assert_witness(found)


def power_of_ten(rounding: float) -> fmpq:
    """The rounding of an entry, exact."""
    return fmpq(1, 10 ** round(-log10(rounding)))


@in_whole
def test_conjugates_and_pairs_of_the_catalogue_are_decided() -> None:
    """Wherever they exist; a pair has no higher order than the method and its conjugate. Every sixth
    method, all of them in ``make whole``.
    """
    decided = 0
    for name in sample(list(ENTRIES), 6):
        entry = ENTRIES[name]
        box = RoundedTableau.within(published(name), power_of_ten(entry["rounding"]))
        try:
            both, other = box.pair(), box.conjugate()
        except ZeroWeight:
            continue
        orders = [find_order_within(x) for x in (both, box, other)]
        assert not any(x.undecided for x in orders)
        assert orders[0].order <= min(orders[1].order, orders[2].order)
        decided += 1
    assert decided > at_most(5, 30)


@given(SEEDS)
@settings(max_examples=at_most(6, 50))
def test_orders_are_those_of_every_tree(seed: int) -> None:
    """Random graphs and rounded named methods, tolerances of all sizes: the order is that of the
    conditions of the method that is recovered, one by one.
    """
    dice = Random(seed)
    tableau = samples.random_graph(dice)
    if dice.random() < 0.5:
        tableau = gark([samples.method(dice.choice(["rk4", "kutta", "heun", "ssp2 4"]))], {})
    tableau = rounded(tableau, dice, fmpq(1, 10 ** dice.randint(1, 30)))
    box = RoundedTableau.within(tableau, fmpq(1, 10 ** dice.randint(0, 31)))
    found = find_order_within(box, 5)
    assert found.order == first_missed(box, 5) - 1
    assert found.is_lower_bound == (found.order == 5 or bool(found.undecided))
    exact = largest_residuals(tableau, 5)[: found.order]
    with ctx.workprec(2000):
        assert all(bound >= size for bound, size in zip(found.sizes, exact, strict=False))


@in_whole
@pytest.mark.parametrize(
    "name", sample(["kutta", "rk4", "gauss 3", "lobatto-iiic 3", "radau-iia 3"], 3)
)
@given(seed=SEEDS, exponent=st.integers(3, 20))
@settings(max_examples=at_most(2, 10))
def test_every_rounding_keeps_the_order(name: str, seed: int, exponent: int) -> None:
    """Whatever a method is rounded to within t, it has its order within t, and so have its
    conjugate and its pair.
    """
    exact = in_decimals(gark([samples.method(name)], {}), 40)
    order = order_within(exact, fmpq(1, 10**38)).order
    box = RoundedTableau.within(
        rounded(exact, Random(seed), fmpq(1, 10**exponent)), 2 * fmpq(1, 10**exponent)
    )
    assert find_order_within(box, order).order == order
    limit = min(order, 4)
    wanted = find_order_within(RoundedTableau.within(exact, fmpq(1, 10**38)).pair(), limit).order
    for derived in (box.conjugate(), box.pair()):
        assert find_order_within(derived, limit).order >= wanted


@given(SEEDS)
@settings(max_examples=at_most(10, 150))
def test_what_fails_fails_for_every_method_of_the_box(seed: int) -> None:
    """The condition of a witness is missed by all corners of the box that are tried, on one side."""
    dice = Random(seed)
    tableau = rounded(gark([samples.method("kutta")], {}), dice, fmpq(1, 1000))
    tolerance = fmpq(1, dice.choice([200, 1000, 10**4]))
    found = order_within(tableau, tolerance, 5)
    if found.witness is None:
        return
    sides = set()
    for _ in range(30):
        corner = rounded_to_corner(tableau, dice, tolerance)
        (condition,) = conditions(corner, [found.witness.tree])
        sides.add(condition.residual > 0)
        assert condition.residual != 0
    assert len(sides) == 1


def rounded_to_corner(tableau: Tableau, dice: Random, size: fmpq) -> Tableau:
    """Every coefficient that is not 0 moved by ``size``, up or down."""

    def moved(row: tuple[fmpq, ...]) -> tuple[fmpq, ...]:
        return tuple(x + size * dice.choice([-1, 1]) if x else x for x in row)

    blocks = {key: tuple(moved(row) for row in block) for key, block in tableau.blocks.items()}  # type: ignore[arg-type]
    colours = tuple(replace(x, b=moved(x.b)) for x in tableau.colours)  # type: ignore[arg-type]
    return Tableau(tableau.spaces, colours, blocks)


def test_thirds_with_five_digits() -> None:
    """The weights 0.33333, 0.33333, 0.33333 sum to 1 within 6e-6 a weight, as 1e-5 is no more than three
    of them, and not within 3e-6.
    """
    tableau = gark([butcher(((fmpq(0),) * 3,) * 3, (fmpq(33333, 100000),) * 3)], {})
    assert order_within(tableau, fmpq(6, 10**6)).order == 1
    assert order_within(tableau, fmpq(1, 3 * 10**5)).order == 1
    assert order_within(tableau, fmpq(3, 10**6)).order == 0


@in_whole
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
        return order_within(
            replace(tableau, colours=(colour,), blocks={(0, 0): block}), tolerance
        ).order

    assert [changed(fmpq(1, 10**n), True) for n in (10, 14)] == [0, 8]
    assert [changed(fmpq(1, 10**n), False) for n in (4, 14)] == [1, 8]


@in_whole
@given(SEEDS)
@settings(max_examples=at_most(5, 100))
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
            assert sizes.bound * n >= max_part(tableau, n)


def max_part(tableau: Tableau, order: int) -> fmpq:
    """The largest |residual| of an order in units of what is required, 1/γ."""
    table = TreeTable.of(coupling_graph(tableau), order)
    found = conditions(tableau, map(table.tree, table.ids(order)))
    return max((abs(x.residual) / x.required for x in found), default=fmpq(0))


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
    [
        (2, 16, 16, 4),
        (3, 30, 28, 6),
        (4, 30, 26, 8),
        pytest.param(6, 30, 24, 12, marks=in_whole),
        pytest.param(10, 60, 45, 20, marks=in_whole),
    ],
)
def test_gauss_and_lobatto_in_decimals(
    stages: int, digits: int, tolerance: int, order: int
) -> None:
    """The pair has four colours: 3.6·10¹¹ trees up to order 13 for Gauss 6 are no obstacle."""
    box = RoundedTableau.within(gauss_lobatto(stages, digits), fmpq(1, 10**tolerance))
    found = find_order_within(box.pair())
    assert found.order == order
    assert_witness(found)


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
    box = RoundedTableau.within(mixed, fmpq(1, 10**28))
    assert find_order_within(box).order == 6
    assert find_order_within(box.pair()).order == 6


def test_exact_methods_need_no_trees() -> None:
    """Gauss 10 × Lobatto IIIA 11 as families, any tolerance below its errors: decided by the
    certificate.
    """
    both = pair(samples.everywhere(collocation, "gauss 10", "lobatto-iiia 11"))
    found = order_within(both, fmpq(1, 10**30))
    assert (found.order, found.exact) == (20, 20)
    assert found.witness == find_order(both).witness


def test_limits() -> None:
    """The search stops at its limit with a lower bound."""
    tableau = published("sprk_Yoshida_6_8")
    found = order_within(tableau, fmpq(1, 10**30), 3)
    assert (found.order, found.is_lower_bound, found.undecided) == (3, True, "")


APART = "A: [[0, 0], [1, 0]]\nb: [0.40, 0.50]\ntolerance: 0.05\n"
"""b₁ + b₂ = 1 at b = (0.45, 0.55) alone, where b₂ a₂₁ = 1/2 asks for a₂₁ = 0.909."""


def test_conditions_that_exclude_each_other() -> None:
    """Each holds within the rounding, not both; nothing fails by 0."""
    found = analyse_any(as_meant(loads(APART))).order
    assert found.order == 1
    assert found.witness is not None
    assert (found.witness.is_joint, found.witness.residual) == (True, 0)
    corners = [
        (b1, b2, a)
        for b1 in (fmpq(35, 100), fmpq(45, 100))
        for b2 in (fmpq(45, 100), fmpq(55, 100))
        for a in (fmpq(95, 100), fmpq(105, 100))
    ]
    # their difference is negative at the corners, where a multilinear function is largest
    assert max((b1 + b2 - 1) - (b2 * a - fmpq(1, 2)) for b1, b2, a in corners) < 0
    alone = analyse_any(as_meant(loads(APART.replace("0.40", "0.45").replace("0.05", "0.1")))).order
    assert alone.order == 2


def test_a_condition_that_fails_alone_says_by_how_much() -> None:
    found = analyse_any(as_meant(loads(APART.replace("0.40", "0.20")))).order
    assert found.order == 0
    assert found.witness is not None
    assert not found.witness.is_joint
