"""Error constants: two code paths, and textbook values."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq

from garkcli import Tableau, Tree, conditions, find_order, load, loads, trees
from garkcli.families.registry import diagonal_method
from garkcli.order import constants
from garkcli.order.admissible import is_admissible
from garkcli.order.conditions import all_conditions
from garkcli.order.constants import error_constants
from garkcli.tableau.forms import gark, pair
from tests.oracles.brute import Plain, Trees
from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]


def engine_tree(u: Plain) -> Tree:
    """A tree of the oracle as one of the engine."""
    return Tree(u[0], map(engine_tree, u[1]))


def example(name: str) -> Tableau:
    """A method of the distribution."""
    return load(str(ROOT / "methods" / f"{name}.gark.yaml")).tableau


@pytest.mark.parametrize(
    "name", ["collocation", "rectangular", "semi-separable", "ark-ars222", "three-colours"]
)
def test_exact_and_float_paths_agree(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The exact sum over trees and the float one over the tree table give the same norms."""
    tableau = example(name)
    order = find_order(tableau).order + 1
    exact = error_constants(tableau, order)
    monkeypatch.setattr(constants, "EXACT_CONDITIONS", 0)
    floats = error_constants(tableau, order)
    assert exact is not None
    assert floats is not None
    assert (exact.is_exact, floats.is_exact) == (True, False)
    for one, other in ((exact.all, floats.all), (exact.coupling, floats.coupling)):
        assert one.trees == other.trees
        assert one.two == pytest.approx(other.two, rel=1e-9)
        assert one.largest == pytest.approx(other.largest, rel=1e-9)


@in_whole
def test_twin_roots_count_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the pair the conditions of V^l and F^l are evaluated once and counted twice."""
    both = pair(example("collocation"))
    exact = error_constants(both, 5)
    assert exact is not None
    assert exact.all.trees == 5996
    monkeypatch.setattr(constants, "EXACT_CONDITIONS", 0)
    floats = error_constants(both, 5)
    assert floats is not None
    assert exact.all.two == pytest.approx(floats.all.two, rel=1e-9)


def test_twin_roots_mix_colours_each_for_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """[τ^F]^V mixes colours and its twin [τ^F]^F does not: the coupling trees are those that do, in
    both paths.
    """
    both = pair(gark([diagonal_method("lobatto-iiia", 2)], {}))
    exact = error_constants(both, 3)
    monkeypatch.setattr(constants, "EXACT_CONDITIONS", 0)
    floats = error_constants(both, 3)
    assert exact is not None
    assert floats is not None
    assert exact.coupling.trees == floats.coupling.trees
    assert exact.coupling.two == pytest.approx(floats.coupling.two, rel=1e-12)
    assert exact.coupling.worst is not None
    assert len(exact.coupling.worst.colours) > 1
    by_hand = [
        (x.residual / x.tree.symmetry) ** 2
        for x in conditions(both, map(engine_tree, Trees(both).of_order(3)))
        if len(x.tree.colours) > 1
    ]
    assert exact.coupling.two_squared == sum(by_hand, start=fmpq(0))


def test_admissible_trees_are_those_of_the_graph() -> None:
    """Of all trees of two colours: where one sees itself alone, and where one is linear too."""
    for linear, count in (("", 8), ("linear: [2]\n", 7)):
        blocks = "A: [[[[1/2]], [[1/3]]], [null, [[1/4]]]]\nb: [[1], [1]]\n"
        tableau = loads(blocks + linear).tableau
        for n in (1, 2, 3):
            wanted = {engine_tree(u) for u in Trees(tableau).of_order(n)}
            found = {u for u in trees(n, 2) if is_admissible(tableau, u)}
            assert found == wanted
        assert len(wanted) == count


def test_classical_method() -> None:
    """The classical method of order 4: by hand, Σ e² over the nine trees of order 5."""
    found = error_constants(gark([diagonal_method("rk4")], {}), 5)
    assert found is not None
    by_hand = [
        (fmpq(5, 24) - fmpq(1, 5)) / 24,
        (fmpq(5, 48) - fmpq(1, 10)) / 2,
        (fmpq(1, 16) - fmpq(1, 15)) / 2,
        (fmpq(1, 24) - fmpq(1, 30)) / 1,
        (fmpq(1, 16) - fmpq(1, 20)) / 2,
        (fmpq(1, 24) - fmpq(1, 20)) / 6,
        (fmpq(1, 48) - fmpq(1, 40)) / 1,
        (fmpq(1, 48) - fmpq(1, 60)) / 2,
        (fmpq(0) - fmpq(1, 120)) / 1,
    ]
    assert found.all.trees == 9
    assert found.all.two_squared == sum((e * e for e in by_hand), start=fmpq(0))
    assert found.coupling.trees == 0


def test_gauss_is_better_than_rk4() -> None:
    """Gauss 2 has the smaller principal error of the two methods of order 4."""
    gauss = error_constants(gark([diagonal_method("gauss", 2)], {}), 5)
    rk4 = error_constants(gark([diagonal_method("rk4")], {}), 5)
    assert gauss is not None
    assert rk4 is not None
    assert 0 < gauss.all.two < rk4.all.two


def test_too_many_trees() -> None:
    """Beyond the limit there are no error constants, and none are made up."""
    assert error_constants(pair(example("gauss6-lobatto7")), 13) is None


def test_a_condition_with_a_diagonal_twin_is_one_of_a_diagonal_method() -> None:
    """Of the pair of one method every condition of order 2 is one of A or of Â, whichever root
    stands for it.
    """
    both = pair(gark([diagonal_method("lobatto-iiia", 2)], {}))
    found = list(all_conditions(both, 2))
    assert [len(x.trees) for x in found] == [2, 2]
    assert [x.tree.colours for x in found] == [{0}, {0, 1}]
    assert not any(x.is_coupling for x in found)
    assert all(
        x.is_coupling == (len(x.tree.branches[0].colours | x.tree.branches[-1].colours) > 1)
        for x in all_conditions(both, 3)
    )
