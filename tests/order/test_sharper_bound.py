"""The sharper bound of docs/sharper-bound.md against the exact order."""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations, product
from pathlib import Path
from random import Random

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.methodfile.load import load
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import RULES, combination
from tests.oracles import samples
from tests.oracles.brute import brute_order
from tests.order.sharpness import counted, drawn, table
from tests.whole import IS_WHOLE, at_most, sample

DOCS = Path(__file__).parents[2] / "docs/sharper-bound.md"

FAMILIES = [
    "gauss 2",
    "gauss 3",
    "lobatto-iiia 2",
    "lobatto-iiia 3",
    "lobatto-iiia 4",
    "lobatto-iiib 3",
]
FAMILIES += ["lobatto-iiic 3", "radau-iia 2", "radau-ia 3"]
RANDOM: dict[str, Callable[[Random], Tableau]] = {
    "graph": samples.random_graph,
    "additive": samples.random_additive,
    "partitioned": samples.random_partitioned,
    "changed": samples.changed,
}


def assert_bounded(tableau: Tableau) -> int:
    """The bounds in their order below the exact one; how far the sharper one is from it."""
    found = simplifying(tableau, 14)
    order = find_order(tableau, 14)
    assert found.bound <= found.sharp_bound <= order.order
    return order.order - found.sharp_bound


@pytest.mark.parametrize(("first", "second"), sample([*product(FAMILIES, FAMILIES)], 4))
@pytest.mark.parametrize("rule", ["collocation", "interpolation"])
def test_families(first: str, second: str, rule: str) -> None:
    """Two families coupled by a rule, and the symplectic pair that they form."""
    tableau = samples.everywhere(getattr(samples, rule), first, second)
    assert_bounded(tableau)
    both = _pair(tableau)
    if both is not None:
        assert_bounded(both)


def _pair(tableau: Tableau) -> Tableau | None:
    from garkcli.errors import ZeroWeight

    try:
        return pair(tableau)
    except ZeroWeight:
        return None


@pytest.mark.parametrize("kind", RANDOM)
@pytest.mark.parametrize("seed", range(40))
def test_random_tableaus(kind: str, seed: int) -> None:
    """Random graphs, additive and partitioned methods, and known methods that were changed."""
    tableau = RANDOM[kind](Random(seed))
    found = simplifying(tableau, 8)
    order = find_order(tableau, 8).order
    assert found.bound <= found.sharp_bound <= order


@pytest.mark.parametrize("seed", range(10))
def test_against_every_tree(seed: int) -> None:
    """The same with the order by all trees, which shares nothing with the certificate."""
    tableau = samples.changed(Random(seed))
    bound = min(simplifying(tableau, 5).sharp_bound, 4)
    assert brute_order(tableau, 4) >= bound


def test_it_is_sharper() -> None:
    """The pair of the collocation example: printed 3, sharper 4, true 4."""
    both = pair(load("methods/collocation.gark.yaml").tableau)
    found = simplifying(both)
    assert (found.bound, found.sharp_bound, find_order(both).order) == (3, 4, 4)


def test_it_is_attained_by_most_pairs_of_families() -> None:
    """Where both are symplectic constructions the sharper bound is the order; the printed one is not."""
    sharp = printed = total = 0
    for first, second in product(FAMILIES[:5], repeat=2):
        both = _pair(samples.everywhere(samples.collocation, first, second))
        if both is None:
            continue
        found = simplifying(both, 14)
        order = find_order(both, 14).order
        total += 1
        sharp += found.sharp_bound == order
        printed += found.bound == order
    assert sharp > printed
    assert sharp >= 0.9 * total


RULE_NAMES = st.sampled_from(list(RULES))
SMALL = st.sampled_from([name for name in FAMILIES if not name.endswith("4")])


@st.composite
def coupled(draw: st.DrawFn) -> Tableau:
    """Up to three methods of families, each block absent, by a rule, or a combination of two."""
    methods = [samples.method(draw(SMALL)) for _ in range(draw(st.integers(1, 3)))]
    blocks = {}
    for l, m in permutations(range(len(methods)), 2):
        if draw(st.booleans()):
            first, second = RULES[draw(RULE_NAMES)], RULES[draw(RULE_NAMES)]
            weight = fmpq(draw(st.integers(-1, 3)), 2)
            terms = [(weight, first), (1 - weight, second)]
            blocks[l, m] = combination(terms, methods[l], methods[m])
    return gark(methods, blocks)


@settings(max_examples=at_most(15, 300))
@given(coupled())
def test_no_bound_exceeds_the_order(tableau: Tableau) -> None:
    """Printed bound ≤ sharper bound ≤ order, of whatever is coupled and of its symplectic pair."""
    assert_bounded(tableau)
    both = _pair(tableau)
    if both is not None:
        assert_bounded(both)


def test_the_documented_counts() -> None:
    """docs/sharper-bound.md has the table that counting makes, in ``make whole``: of pairs whose blocks
    are made by rules the sharper bound is the order each time.
    """
    assert not IS_WHOLE or "\n".join(table()) in DOCS.read_text(encoding="utf-8")
    pairs = [pair(tableau) for tableau in drawn(combine=False, count=at_most(20, 50), seed=1)]
    found = counted(pairs)
    assert found.sharp == found.methods > found.printed
