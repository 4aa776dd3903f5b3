"""Objectives of a search: their gradients are those of their values, and levels what they say."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import pytest

from garkcli.design.search.goals import Reach, Smooth, difference, quotient_of_norms, squared
from garkcli.design.search.tasks import HIGHEST, Height, Total

POINTS = [np.array([0.7, -0.4]), np.array([-1.3, 0.9]), np.array([2.0, 0.25])]
STEP = 1e-6
Array: TypeAlias = "np.ndarray[Any, Any]"


def curved(x: Array) -> tuple[Array, Array]:
    a, b = x
    return np.array([a * a - b, a * b, 1 + b]), np.array([[2 * a, -1], [b, a], [0, 1]])


def straight(x: Array) -> tuple[Array, Array]:
    a, b = x
    return np.array([a + 2, 3 * b - 1, a]), np.array([[1, 0], [0, 3], [1, 0]])


def slopes_of(values: Callable[[Array], Any], x: Array) -> Array:
    """Central differences, shape (values, unknowns)."""
    sides = [(values(x + STEP * e) - values(x - STEP * e)) / (2 * STEP) for e in np.eye(len(x))]
    return np.stack(sides, axis=-1)


GOALS: dict[str, tuple[Smooth, Callable[[Array], Any]]] = {
    "norm": (quotient_of_norms(curved), lambda x: np.linalg.norm(curved(x)[0])),
    "quotient": (
        quotient_of_norms(curved, straight),
        lambda x: np.linalg.norm(curved(x)[0]) / np.linalg.norm(straight(x)[0]),
    ),
    "squares": (squared(curved), lambda x: sum(curved(x)[0] ** 2)),
    "difference": (
        squared(difference(curved, straight)),
        lambda x: sum((curved(x)[0] - straight(x)[0]) ** 2),
    ),
}


@pytest.mark.parametrize("x", POINTS, ids=str)
@pytest.mark.parametrize("name", GOALS)
def test_gradients_are_those_of_the_values(name: str, x: Array) -> None:
    goal, definition = GOALS[name]
    value, gradient = goal.at(x)
    assert value == pytest.approx(definition(x))
    assert gradient == pytest.approx(slopes_of(lambda y: goal.at(y)[0], x), rel=1e-6)


@pytest.mark.parametrize("x", POINTS, ids=str)
def test_squared_terms_of_a_sum_have_its_value(x: Array) -> None:
    """With weights 1/4 and 9; for sums of squares alone."""
    total = Total([(0.25, squared(curved)), (9.0, squared(straight))], straight)
    found = total.parts(x)
    assert found is not None
    parts, slopes = found
    assert parts @ parts == pytest.approx(total.value(x))
    assert slopes == pytest.approx(slopes_of(lambda y: (total.parts(y) or found)[0], x), rel=1e-6)
    plain = Smooth(lambda y: (float(y[0]), np.array([1.0, 0.0])))
    assert Total([(1.0, plain), (1.0, squared(curved))], straight).parts(x) is None


def level_below(bound: float) -> Reach:
    """The y up to a bound."""
    return Reach(lambda at: (np.array([bound - at[-1]]), np.array([[0.0, 0.0, -1.0]])))


@pytest.mark.parametrize(
    ("bound", "level"), [(-1.0, 0.0), (0.02, 0.02), (1.75, 1.75), (3e4, HIGHEST)]
)
def test_a_level_is_the_largest_at_which_inequalities_hold(bound: float, level: float) -> None:
    """0 where they hold at none, and at most HIGHEST."""
    assert Height(level_below(bound)).of(POINTS[0]) == pytest.approx(level, rel=1e-6)
