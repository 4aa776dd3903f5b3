"""The sharper bound of docs/sharper-bound.md against the exact order."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from random import Random

import pytest

from garkcli.methodfile.load import load
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.oracles import samples
from tests.oracles.brute import brute_order

FAMILIES = [
    "gauss 2",
    "gauss 3",
    "lobatto-iiia 2",
    "lobatto-iiia 3",
    "lobatto-iiia 4",
    "lobatto-iiib 3",
]
FAMILIES += ["lobatto-iiic 3", "radau-iia 2", "radau-ia 3"]
RULES = ["collocation", "interpolation"]
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


@pytest.mark.parametrize(("first", "second"), list(product(FAMILIES, FAMILIES)))
@pytest.mark.parametrize("rule", RULES)
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
