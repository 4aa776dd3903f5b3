"""Effective order: known methods, and what no change of coordinates changes."""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq

from garkcli import load, loads
from garkcli.backward import effective
from garkcli.backward.effective import EffectiveOrder, effective_order
from garkcli.backward.modified import modified_equation
from garkcli.backward.series import Forest, logarithm, transported
from garkcli.frozen import replace
from garkcli.ntrees.count import Admissible

BUTCHER = """
A:
  - []
  - [1/5]
  - [0, 2/5]
  - [3/16, 0, 5/16]
  - [1/4, 0, -5/4, 2]
b: [1/6, 0, 0, 2/3, 1/6]
"""
EULER = "prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1]}}"


def _found(text: str, order: int) -> EffectiveOrder:
    return effective_order(modified_equation(loads(text).tableau, order))


def test_butchers_method() -> None:
    """His five stages have order 4 and effective order 5, which no five stages have as order."""
    equation = modified_equation(loads(BUTCHER).tableau, 7)
    assert equation.order == 4
    assert effective_order(equation) == EffectiveOrder(5, True)


def test_symplectic_euler() -> None:
    """On separable problems it is the Störmer–Verlet method in other coordinates, else it is not of
    order 2 in any.
    """
    assert _found(f"{{{EULER}, structure: separable}}", 5) == EffectiveOrder(2, True)
    assert _found(f"{{{EULER}}}", 4) == EffectiveOrder(1, True)


def test_the_order_can_be_all_there_is() -> None:
    """RK4 and the rectangular method, with irrational coefficients, have no more; a method that is
    not consistent has none.
    """
    for path in ("rk4", "rectangular"):
        tableau = load(f"methods/{path}.gark.yaml").tableau
        assert effective_order(modified_equation(tableau, 6)) == EffectiveOrder(4, True)
    assert _found("{A: [[1/2]], b: [1/2]}", 3) == EffectiveOrder(0, True)


def test_up_to_the_largest_trees() -> None:
    """Where all orders asked for can be reached nothing is proved about the next."""
    assert _found("methods: [{family: gauss, stages: 3}]", 4) == EffectiveOrder(4, False)


@pytest.mark.parametrize("seed", range(3))
def test_a_change_of_coordinates_changes_nothing(seed: int) -> None:
    """RK4 in random other coordinates has order 1 and still the effective order 4."""
    dice = Random(seed)
    equation = modified_equation(load("methods/rk4.gark.yaml").tableau, 6)
    change = [fmpq(dice.randint(-3, 3), 2) for _ in equation.forest.trees]
    moved = transported(equation.forest, equation.coefficients, change, 1)
    other = replace(equation, coefficients=tuple(moved))
    assert other.order < 4
    assert effective_order(other) == EffectiveOrder(4, True)


@pytest.mark.parametrize("seed", range(2))
def test_several_changes_follow_each_other(seed: int) -> None:
    """Gauss 3 in random other coordinates: the orders 3 to 6 are reached one after the other, each
    in the coordinates of those before.
    """
    dice = Random(seed)
    equation = modified_equation(loads("methods: [{family: gauss, stages: 3}]").tableau, 6)
    change = [fmpq(dice.randint(-3, 3), 2) for _ in equation.forest.trees]
    moved = transported(equation.forest, equation.coefficients, change, 1)
    other = replace(equation, coefficients=tuple(moved))
    assert other.order < 4
    assert effective_order(other) == EffectiveOrder(6, False)


def test_a_change_of_coordinates_with_radicals() -> None:
    """Linear systems with a right-hand side in a number field are solved there: the rectangular
    method in other coordinates, with √3 in them.
    """
    tableau = load("methods/rectangular.gark.yaml").tableau
    equation = modified_equation(tableau, 6)
    assert tableau.field is not None
    root = tableau.field.from_coordinates([fmpq(1, 2), fmpq(1, 3)])
    change = [root if tree.order < 4 else fmpq(0) for tree in equation.forest.trees]
    moved = transported(equation.forest, equation.coefficients, change, 1)
    other = replace(equation, coefficients=tuple(moved))
    assert other.order < 4
    assert effective_order(other) == EffectiveOrder(4, True)


def test_midpoint_and_trapezoidal_rule_are_conjugate() -> None:
    """The change of coordinates between them is half a step of the explicit Euler method."""
    midpoint = modified_equation(loads("{A: [[1/2]], b: [1]}").tableau, 7)
    trapezoidal = modified_equation(loads("{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}").tableau, 7)
    forest = midpoint.forest
    half_step = [fmpq(0)] * len(forest.trees)
    half_step[0] = fmpq(1, 2)
    change = [-x for x in logarithm(forest, half_step)]
    moved = transported(forest, midpoint.coefficients, change, 1)
    assert tuple(moved) == trapezoidal.coefficients


def test_the_number_of_conditions() -> None:
    """Butcher and Sanz-Serna: there are as many conditions of effective order n as trees of order n
    less those of order n − 1, for n ≥ 3; 1, 2, 3, 5, 10, 21 in all.
    """
    forest = Forest.of(Admissible.of(1), 6)
    totals = [1]
    for n in range(2, 7):
        rank = effective._bracket_with_delta(forest, n - 1).rank()
        totals.append(totals[-1] + len(forest.of_order(n)) - rank)
    assert totals == [1, 2, 3, 5, 10, 21]


def test_fields_that_do_not_see_each_other() -> None:
    """More commutes there than the flow itself, and a failure proves nothing."""
    apart = "{tableau: {A: [[[[0]], null], [null, [[0]]]], b: [[1], [1]]}}"
    assert _found(apart, 4) == EffectiveOrder(1, False)


def test_large_systems_are_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beyond the limit the order is a lower bound."""
    monkeypatch.setattr(effective, "MAX_SOLVED", 20)
    assert _found(BUTCHER, 7) == EffectiveOrder(5, False)  # a solution exists
    monkeypatch.setattr(effective, "MAX_ENTRIES", 20)
    assert _found(BUTCHER, 7) == EffectiveOrder(4, False)
