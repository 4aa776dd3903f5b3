"""What runs of built-in problems cost, against a check in the same run."""

from __future__ import annotations

import pytest

from tests.benchmarks.measuring import GARK, assert_ratio, interleaved, process

CHECK = process([*GARK, "check", "rk4"])


@pytest.mark.parametrize(
    "arguments", [["converge", "rk4"], ["energy", "rk4"], ["energy", "verlet"]]
)
def test_built_in_problems(arguments: list[str]) -> None:
    """A convergence test and a long run cost at most twice a check: they need no sympy."""
    ours, check = interleaved(process([*GARK, *arguments]), CHECK)
    name = " ".join(arguments)
    assert_ratio(f"gark {name} / gark check rk4", ours / check, 2, f"{ours:.3f} s, {check:.3f} s")
