"""The certificate on high-order pairs, as whole processes."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from tests.benchmarks.measuring import GARK, assert_ratio, peak_of_children, seconds


@pytest.mark.parametrize(
    ("gauss", "order", "limit", "megabytes"),
    [(6, 12, 3.0, 300.0), (10, 20, 3.0, 300.0), (20, 40, 60.0, 1000.0)],
)
def test_collocation_pair(
    gauss: int, order: int, limit: float, megabytes: float, tmp_path: Path
) -> None:
    """Gauss s with Lobatto IIIA s + 1 by collocation: every order is 2s, in seconds, in little
    memory.
    """
    file = tmp_path / "m.gark.yaml"
    methods = f"[{{family: gauss, stages: {gauss}}}, {{family: lobatto-iiia, stages: {gauss + 1}}}]"
    file.write_text(f"methods: {methods}\ntransfer: collocation\n")
    command = [*GARK, "check", str(file), "--format", "json"]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)[
        "files"
    ][0]
    assert (found["order"], found["conjugate_order"], found["pair_order"]) == (order, order, order)
    time = seconds(lambda: subprocess.run(command, check=True, capture_output=True), 3)
    memory = peak_of_children()
    assert_ratio(
        f"gark check, Gauss {gauss} and Lobatto {gauss + 1} / {limit:g} s",
        time / limit,
        1.0,
        f"{time:.3f} s",
    )
    assert_ratio(f"its memory / {megabytes:g} MB", memory / megabytes, 1.0, f"{memory:.0f} MB")
