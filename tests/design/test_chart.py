"""Local coordinates of solutions, and the optimiser in them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from garkcli.design.search.chart import Chart, OutsideError
from garkcli.design.search.descent import OptimiserTask, TaskValues, descended


def sphere(x: Any) -> tuple[Any, Any]:
    """The unit sphere, its equation twice."""
    return np.array([x @ x - 1, 3 * (x @ x - 1)]), np.array([2 * x, 6 * x])


def test_points_of_a_chart_are_solutions() -> None:
    """A dependent equation takes no coordinate; derivatives are those of differences."""
    chart = Chart(sphere, np.array([0.0, 0.6, 0.8]))
    assert chart.dimension == 2
    chart.scale(np.array([[2.0, 1.0], [0.0, 1.0]]))
    u = np.array([0.1, -0.2])
    x, slopes = chart.at(u)
    assert x @ x == pytest.approx(1, abs=1e-12)
    for k in range(2):
        step = np.eye(2)[k] * 1e-5
        difference = (chart.at(u + step)[0] - chart.at(u - step)[0]) / 2e-5
        assert np.allclose(slopes[:, k], difference, atol=1e-8)


def test_a_chart_ends() -> None:
    """Over a point of the tangent plane beside the sphere there is no solution."""
    chart = Chart(sphere, np.array([0.0, 0.0, 1.0]))
    with pytest.raises(OutsideError):
        chart.at(np.array([2.0, 0.0]))


class Highest(OptimiserTask):
    """The point of the sphere farthest above x_3 = −1, with x_1 at least 1/2; a level, or not."""

    def __init__(self, has_level: bool) -> None:
        self.levels = int(has_level)

    def value(self, x: Any) -> float:
        return -1 - float(x[2])

    def guess(self, x: Any) -> Any:
        return np.array([1 + float(x[2])] * self.levels)

    def at(self, z: Any) -> TaskValues:
        one = np.eye(len(z))
        signs, slopes = [z[0] - 0.5], [one[0]]
        value = -float(z[-1]) - (not self.levels)
        if self.levels:
            signs.append(1 + z[2] - z[3])
            slopes.append(one[2] - one[3])
        found = value if min(signs) >= -1e-9 else np.inf
        return TaskValues(value, -one[-1], np.array(signs), np.array(slopes), found)


@pytest.mark.parametrize("has_level", [False, True])
def test_the_optimiser_stays_on_the_solutions(has_level: bool) -> None:
    """From the other side of the sphere it takes several charts."""
    end = descended(Highest(has_level), sphere, np.array([0.6, 0.0, -0.8]))
    assert np.allclose(end, [0.5, 0, np.sqrt(0.75)], atol=1e-6)
