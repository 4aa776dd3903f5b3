"""What a command costs to start, against ``python -c "import sympy"`` in the same run."""

from __future__ import annotations

import pytest

from tests.benchmarks.measuring import GARK, PYTHON, assert_ratio, interleaved, process

SYMPY = process([*PYTHON, "-c", "import sympy"])


@pytest.mark.parametrize(
    ("arguments", "target"),
    [
        (["check", "-q", "rk4"], 0.4),
        (["check", "methods/collocation.gark.yaml"], 0.5),
        (["--help"], 0.3),
    ],
)
def test_startup(arguments: list[str], target: float) -> None:
    """A quiet check, one of the collocation example, and the help cost a fraction of importing
    sympy.
    """
    ours, sympys = interleaved(process([*GARK, *arguments]), SYMPY)
    assert_ratio(
        f"gark {' '.join(arguments)} / import sympy",
        ours / sympys,
        target,
        f"{ours:.3f} s, {sympys:.3f} s",
    )
