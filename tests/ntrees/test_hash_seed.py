"""What is printed does not hang on the hash seed: sets and dictionaries of objects have no say."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]
RUNS = [
    ("tableau", "methods/three-colours.gark.yaml", "--format", "json"),
    ("conjugate", "methods/interpolation.gark.yaml", "--pair", "--format", "latex"),
    ("trees", "-N", "2", "-n", "4"),
    ("conditions", "-N", "2", "-n", "3", "--symplectic"),
    ("conditions", "methods/semi-separable.gark.yaml", "-n", "3", "--symplectic"),
]
SCRIPT = (
    "import sys\n"
    "from garkcli.cli import main\n"
    "for line in sys.argv[1:]:\n"
    "    try:\n"
    "        main(line.split())\n"
    "    except SystemExit as end:\n"
    "        print(line, end.code)\n"
)


@pytest.fixture(scope="module")
def reference() -> str:
    """What the runs print under one seed."""
    return printed("0")


def printed(seed: str) -> str:
    """What all runs print in one process with a hash seed."""
    lines = [" ".join(run) for run in RUNS]
    environment = {**os.environ, "PYTHONHASHSEED": seed, "COLUMNS": "80"}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *lines],
        cwd=ROOT,
        env=environment,
        check=True,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    return done.stdout


@in_whole
@pytest.mark.parametrize("seed", ["1", "12345"])
def test_the_hash_seed_changes_nothing(seed: str, reference: str) -> None:
    """Tableaus in radicals, trees and independent conditions are the same texts, order and all."""
    assert printed(seed) == reference
    assert all(f"{' '.join(run)} 0" in reference for run in RUNS)
