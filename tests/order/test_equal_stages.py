"""Classes of equal stages, exactly and within a tolerance."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli import loads
from garkcli.order.equal_stages import equal_stages

FILE = "A: [[1/4, 1/4, 0], [2501/10000, 1/4, 0], [0, 1/2, 1/2]]\nb: [1/4, 1/4, 1/2]\n"


@pytest.mark.parametrize(
    ("tolerance", "classes"),
    [
        (fmpq(0), [[0], [1], [2]]),
        (fmpq(1, 100_000), [[0], [1], [2]]),
        (fmpq(1, 1000), [[0, 1], [2]]),
    ],
)
def test_equal_stages_within_a_tolerance(tolerance: fmpq, classes: list[list[int]]) -> None:
    """The nodes of the first two stages, and their sums over the class of both, differ by 1e-4."""
    assert equal_stages(loads(FILE).tableau, tolerance) == [classes]
