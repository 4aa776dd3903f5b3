"""The verified orders of the catalogue: by the certificate where coefficients are exact, in balls
otherwise.
"""

from __future__ import annotations

import flint
import pytest
from flint import arb, fmpq

from garkcli.order.certificate import find_order
from tests.catalogue.catalogue import Entry, entries, in_balls, tableau
from tests.oracles.brute import Trees, Weights, brute_order, density
from tests.whole import sample

ENTRIES = entries()
EXACT = [name for name, entry in ENTRIES.items() if entry["exact"]]
ROUNDED = [name for name, entry in ENTRIES.items() if not entry["exact"]]
LARGE = {"Feagin12", "sprk_Sofroniou_10_36"}
"""Methods of many stages whose order is held against the same table by the test of all claims."""


def test_the_catalogue_is_whole() -> None:
    """There are 94 methods, each with all its keys, under its own name; 46 of them are exact."""
    keys = {
        "name",
        "kind",
        "N",
        "stages",
        "problem_class",
        "claimed_order",
        "verified_order",
        "exact",
    }
    keys |= {"rounding", "source", "notes", "blocks"}
    assert len(ENTRIES) == 94
    assert all(set(entry) == keys and entry["name"] == name for name, entry in ENTRIES.items())
    assert len(EXACT) == 46


@pytest.mark.parametrize("name", ENTRIES)
def test_shapes(name: str) -> None:
    """Blocks, weights and nodes have the stages that the entry states."""
    entry: Entry = ENTRIES[name]
    blocks, stages = entry["blocks"], entry["stages"]
    assert len(stages) == entry["N"] == len(blocks["A"]) == len(blocks["b"]) == len(blocks["c"])
    for l, s in enumerate(stages):
        assert len(blocks["b"][l]) == len(blocks["c"][l]) == s
        for m, t in enumerate(stages):
            assert [len(row) for row in blocks["A"][l][m]] == [t] * s


@pytest.mark.parametrize("name", sample(EXACT, 3))
def test_exact_methods_have_their_verified_order(name: str) -> None:
    """The certificate gives exactly the order that was verified independently, with a witness one
    higher.
    """
    found = find_order(tableau(ENTRIES[name]))
    assert found.order == ENTRIES[name]["verified_order"]
    assert not found.is_lower_bound


@pytest.mark.parametrize("name", sample([x for x in ROUNDED if x not in LARGE], 3))
def test_rounded_methods_have_their_verified_order_within_their_rounding(name: str) -> None:
    """All residuals up to the verified order are within the rounding of the entry, and one above is
    not.
    """
    entry = ENTRIES[name]
    with flint.ctx.workprec(400):
        rounded = in_balls(entry)
        trees, weights = Trees(rounded), Weights(rounded)

        def residuals(order: int) -> list[arb]:
            return [abs(weights.weight(u) - fmpq(1, density(u))) for u in trees.of_order(order)]

        order, rounding = entry["verified_order"], arb(entry["rounding"])
        assert all(x < rounding for n in range(1, order + 1) for x in residuals(n))
        assert any(x > 100 * rounding for x in residuals(order + 1))


@pytest.mark.parametrize("name", EXACT[::4])
def test_methods_have_their_verified_order_by_all_trees(name: str) -> None:
    """A part of the exact methods, by all trees in exact arithmetic where the certificate uses a
    few.
    """
    order = ENTRIES[name]["verified_order"]
    assert brute_order(tableau(ENTRIES[name]), order + 1) == order
