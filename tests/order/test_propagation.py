"""What rounding does to the conjugate, the pair and their conditions: bounds held against rounding
itself.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest
from flint import arb, arb_mat, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.display import to_ball
from garkcli.order.conditions import conditions, coupling_graph
from garkcli.order.propagation import Propagation, conjugate_rounding
from garkcli.order.tolerance import rounded_up, within
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from garkcli.trees.table import TreeTable
from tests.oracles import samples
from tests.order.rounded_samples import in_decimals

T = fmpq(1, 10**5)
NAMES = ("gauss 3", "collocation of gauss 2, lobatto-iiia 3", "kutta")
SEEDS = st.integers(0, 2**32 - 1)


def moved(tableau: Tableau, dice: Random) -> Tableau:
    """Every entry of A and b off by at most ``T``, some of them by all of it."""

    def row(values: tuple[fmpq, ...]) -> tuple[fmpq, ...]:
        return tuple(x + T * fmpq(dice.choice([-10, 10, dice.randint(-9, 9)]), 10) for x in values)

    blocks = {key: tuple(row(x) for x in block) for key, block in tableau.blocks.items()}  # type: ignore[arg-type]
    colours = tuple(replace(x, b=row(x.b)) for x in tableau.colours)  # type: ignore[arg-type]
    return replace(tableau, blocks=blocks, colours=colours)


def sample(name: str) -> Tableau:
    """A named method in decimals."""
    return in_decimals(samples.NAMED[name](), 8)


@pytest.mark.parametrize("name", NAMES)
@given(seed=SEEDS)
def test_entries_of_the_conjugate(name: str, seed: int) -> None:
    """The conjugate of a rounded method is within the radii of that of the printed one."""
    tableau = sample(name)
    found = conjugate_rounding(tableau, T)
    assert found is not None
    printed, other = (conjugate(tableau).blocks, conjugate(moved(tableau, Random(seed))).blocks)
    for key, radii in found.hats.items():
        for row, others, bounds in zip(printed[key], other[key], radii.tolist(), strict=True):
            for x, y, bound in zip(row, others, bounds, strict=True):
                assert within(x - y, rounded_up(bound))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("which", ["method", "conjugate", "pair"])
@given(seed=SEEDS)
def test_residuals_change_by_no_more_than_the_effect(name: str, which: str, seed: int) -> None:
    """Every tree up to order 4, for the method, its conjugate and their pair."""
    tableau = sample(name)
    rounding = conjugate_rounding(tableau, T)
    assert rounding is not None
    dice = Random(seed)
    if which == "method":
        printed, other = tableau, moved(tableau, dice)
        made = Propagation(tableau, {}, T)
    elif which == "conjugate":
        printed, other = conjugate(tableau), conjugate(moved(tableau, dice))
        made = rounding.of_conjugate(printed)
    else:
        printed, other = pair(tableau), pair(moved(tableau, dice))
        made = rounding.of_pair(printed)
    table = TreeTable.upto(printed.size, 4 if printed.size < 3 else 3, *coupling_graph(printed))
    trees = [table.tree(i) for i in range(len(table))]
    for one, two in zip(conditions(printed, trees), conditions(other, trees), strict=True):
        assert within(one.value - two.value, rounded_up(made.effect(one.tree.order)))


def test_the_effect_is_of_the_size_of_the_rounding() -> None:
    """Some rounding of Gauss 3 reaches a tenth of the bounds, at every order up to 4."""
    tableau = sample("gauss 3")
    made = Propagation(tableau, {}, T)
    table = TreeTable.upto(1, 4, *coupling_graph(tableau))
    trees = [table.tree(i) for i in range(len(table))]
    reached = [arb(0)] * 4
    for seed in range(40):
        other = moved(tableau, Random(seed))
        for one, two in zip(conditions(tableau, trees), conditions(other, trees), strict=True):
            n = one.tree.order - 1
            reached[n] = reached[n].max(abs(to_ball(one.value - two.value)))
    assert all(10 * reached[n - 1] > made.effect(n) for n in range(1, 5))


def test_a_weight_within_the_tolerance_of_zero_leaves_the_conjugate_open() -> None:
    """b_2 = 10⁻⁶ might be zero within 10⁻⁵, not within 10⁻⁷."""
    tableau = samples.runge_kutta("0, 0", "1/2, 0", "999999/1000000, 1/1000000")
    assert conjugate_rounding(tableau, T) is None
    found = conjugate_rounding(tableau, fmpq(1, 10**7))
    assert found is not None
    assert isinstance(found.hats[0, 0], arb_mat)
