"""``--choose``: down a family step by step."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.harness import gark

EXPLICIT3 = "unknown: {stages: 3, shape: explicit}\n"


def test_each_choice_says_what_it_leaves(tmp_path: Path) -> None:
    """Dimensions 2, 1, 0, and then the method, Heun's; a choice that leaves none is said."""
    path = tmp_path / "family.yaml"
    path.write_text(EXPLICIT3, encoding="utf-8")
    command = ["design", str(path), "--order", "3"]
    run = gark(*command, "--choose", "c2=1/3", "--choose", "c3=2/3")
    assert run.code == 0
    assert "c2 = 1/3  leaves dimension 1 of order 3, dimension 2" in run.out
    assert "c3 = 2/3  leaves dimension 0 of order 3, dimension 1" in run.out
    assert "b3 = 3/4" in run.out
    chosen = ["--choose", "c2=1/3", "--choose", "a32=0", "--format", "json"]
    none = gark(*command, *chosen)
    data = json.loads(none.out)
    dimensions = [(x["dimension_before"], x["dimension"]) for x in data["choices"]]
    assert (none.code, dimensions) == (1, [(2, 1), (1, -1)])
    lost = gark(*command, "--choose", "c2=1/3", "--choose", "a32=0", "--choose", "c3=1")
    assert "a32 = 0   leaves no method of order 3, dimension 1" in lost.out
    assert "c3 = 1    no method of order 3 is left to choose from" in lost.out
    assert "dimension -1" not in lost.out


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        (["c9=1"], "no unknown 'c9'"),
        (["c2=sqrt(2)"], "a rational number is expected"),
        (["c2=1/0"], "--choose c2"),
        ([f"{x}=1" for x in ("c2", "c3", "a32", "b1", "b2", "b3")], "leaves no unknown"),
    ],
)
def test_faults(choices: list[str], message: str, tmp_path: Path) -> None:
    """What cannot be chosen is refused with a cure."""
    path = tmp_path / "family.yaml"
    path.write_text(EXPLICIT3, encoding="utf-8")
    given = [x for choice in choices for x in ("--choose", choice)]
    run = gark("design", str(path), "--order", "3", *given)
    assert (run.code, message in run.err) == (2, True)
