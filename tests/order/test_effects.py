"""What rounding can do to conditions, held against rounding itself: no method of the box goes
further, and the one at the worst corner goes nearly as far.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from random import Random

import pytest
from flint import arb, arb_mat, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.frozen import replace
from garkcli.ntrees.notation import parse_tree
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree
from garkcli.order.conditions import conditions, coupling_graph, elementary_weight
from garkcli.order.effects import Effects
from garkcli.order.tolerance import within
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.meant import derived
from garkcli.tableau.rounded import ZERO_WEIGHT, RoundedTableau
from garkcli.tableau.tableau import Tableau
from tests.oracles import samples
from tests.order.rounded_samples import in_decimals, published

T = fmpq(1, 10**5)
NAMES = ("gauss 3", "collocation of gauss 2, lobatto-iiia 3", "kutta")
SEEDS = st.integers(0, 2**32 - 1)
DERIVE: dict[str, Callable[[Tableau], Tableau]] = {
    "": lambda tableau: tableau,
    "conjugate": conjugate,
    "pair": pair,
}


def changed(tableau: Tableau, move: Callable[[Number], Number]) -> Tableau:
    """Every coefficient of A and b that is not 0 replaced."""

    def row(values: tuple[Number, ...]) -> tuple[Number, ...]:
        return tuple(move(x) if x else x for x in values)

    blocks = {key: tuple(row(x) for x in block) for key, block in tableau.blocks.items()}
    colours = tuple(replace(x, b=row(x.b)) for x in tableau.colours)
    return replace(tableau, blocks=blocks, colours=colours)


def moved(tableau: Tableau, dice: Random) -> Tableau:
    """Coefficients off by at most ``T``, some of them by all of it."""
    return changed(tableau, lambda x: x + T * fmpq(dice.choice([-10, 10, dice.randint(-9, 9)]), 10))


def sample(name: str) -> Tableau:
    """A named method in decimals."""
    return in_decimals(samples.NAMED[name](), 8)


def trees_of(tableau: Tableau, order: int) -> list[Tree]:
    """All trees up to an order that a tableau admits."""
    table = TreeTable.upto(tableau.size, order, *coupling_graph(tableau))
    return [table.tree(i) for i in range(len(table))]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("which", DERIVE)
@settings(max_examples=10)
@given(seed=SEEDS)
def test_no_method_of_the_box_goes_further(name: str, which: str, seed: int) -> None:
    """Every tree up to order 4, for the method, its conjugate and their pair."""
    tableau = sample(name)
    printed, other = DERIVE[which](tableau), DERIVE[which](moved(tableau, Random(seed)))
    effects = Effects(derived(RoundedTableau.within(tableau, T), which))  # type: ignore[arg-type]
    trees = trees_of(printed, 4 if printed.size < 3 else 3)
    for one, two in zip(conditions(printed, trees), conditions(other, trees), strict=True):
        assert within(one.value - two.value, effects.bound(one.tree))


@pytest.mark.parametrize("name", NAMES)
def test_entries_of_the_conjugate(name: str) -> None:
    """Those of the conjugate of a moved method are within the radii, some of them at half of it."""
    tableau = sample(name)
    found = RoundedTableau.within(tableau, T).conjugate()
    printed = conjugate(tableau).blocks
    reached = arb(0)
    for seed in range(20):
        other = conjugate(moved(tableau, Random(seed))).blocks
        for key, rows in found.A.items():
            for i, j in product(range(len(rows)), range(len(rows[0]))):
                off = abs(to_ball(other[key][i][j] - printed[key][i][j]))
                assert off <= rows[i][j]
                reached = reached.max(off / rows[i][j])
    assert reached > 0.5


def worst_corner(tableau: Tableau, tree: Tree) -> Tableau:
    """The method whose coefficients are off by ``T`` in the direction in which the weight of a tree
    grows, found coefficient by coefficient.
    """
    small = T / 10**6
    directions = []
    for number in range(count := sum(1 for _ in coefficients(tableau))):
        steps = [fmpq(0)] * count
        steps[number] = small
        slope = elementary_weight(stepped(tableau, steps), tree) - elementary_weight(tableau, tree)
        directions.append(T if to_ball(slope) > 0 else -T)
    return stepped(tableau, directions)


def coefficients(tableau: Tableau) -> list[Number]:
    """All that are not 0, in the order of ``changed``."""
    found: list[Number] = []
    changed(tableau, lambda x: found.append(x) or x)
    return found


def stepped(tableau: Tableau, steps: list[fmpq]) -> Tableau:
    """The coefficients moved by so much, in the order of ``coefficients``."""
    remaining = iter(steps)
    return changed(tableau, lambda x: x + next(remaining))


@pytest.mark.parametrize("name", ["gauss 3", "kutta"])
@pytest.mark.parametrize("text", ["[[],[]]", "[[[[]]]]", "[[],[[],[]]]"])
def test_the_worst_corner_goes_nearly_as_far(name: str, text: str) -> None:
    """The bound is no more than a hundredth larger than what some rounding does."""
    tableau, tree = sample(name), parse_tree(text)
    bound = Effects(RoundedTableau.within(tableau, T)).effect(tree)
    change = elementary_weight(worst_corner(tableau, tree), tree) - elementary_weight(tableau, tree)
    assert abs(to_ball(change)) <= bound <= abs(to_ball(change)) * 1.01


def test_derivatives_keep_their_signs() -> None:
    """Coefficients of Dormand and Prince's eighth order method cancel: of the tall tree of order 8
    balls around them lose fifty times what rounding can do.
    """
    box = RoundedTableau.within(published("DP8_Hairer_853_float64"), fmpq(1, 10**15))
    A = box.balls.A[0, 0]
    vector = arb_mat([[1]] * A.nrows())
    for _ in range(7):
        vector = A * vector
    (weight,) = (box.balls.b[0].transpose() * vector).entries()
    assert 50 * Effects(box).effect(parse_tree("[[[[[[[[]]]]]]]]")) < weight.rad()


def test_zeros_are_structure() -> None:
    """An explicit method stays explicit: the tall tree of order 4 keeps its weight 0."""
    tableau = samples.runge_kutta("0, 0, 0", "1/2, 0, 0", "0, 1, 0", "1/6, 2/3, 1/6")
    assert Effects(RoundedTableau.within(tableau, T)).effect(parse_tree("[[[[]]]]")) == 0


def test_a_weight_within_the_tolerance_of_zero_leaves_the_conjugate_open() -> None:
    """b_2 = 10⁻⁶ might be zero within 10⁻⁵, not within 10⁻⁷."""
    tableau = samples.runge_kutta("0, 0", "1/2, 0", "999999/1000000, 1/1000000")
    assert RoundedTableau.within(tableau, T).conjugate().obstacle == ZERO_WEIGHT
    assert RoundedTableau.within(tableau, T).pair().obstacle == ZERO_WEIGHT
    assert not RoundedTableau.within(tableau, fmpq(1, 10**7)).conjugate().obstacle


def test_each_printed_value_has_a_unit_of_its_own() -> None:
    """A value without one was made of printed ones and has the largest; zeros have none."""
    tableau = samples.runge_kutta("0, 0", "1/2, 0", "1/4, 3/4")
    units = {fmpq(1, 2): fmpq(1, 10**3), fmpq(1, 4): fmpq(0)}
    found = RoundedTableau.printed(tableau, units)
    assert found.tolerance == fmpq(1, 10**3)
    assert [[float(x) for x in row] for row in found.A[0, 0]] == [[0, 0], [pytest.approx(1e-3), 0]]
    assert [float(x) for x in found.b[0]] == [0, pytest.approx(1e-3)]
