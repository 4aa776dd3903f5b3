"""Whole runs as they were recorded: arguments, exit code, stdout, stderr."""

from pathlib import Path

import pytest

from tests.cli.harness import Run, gark_once
from tests.examples.snapshots import assert_recorded

SNAPSHOTS = Path(__file__).parent / "snapshots"
EXAMPLES = "tests/examples"
VERLET = "methods/stoermer-verlet.gark.yaml"
RUNS = {
    "check-one": ("check", "methods/collocation.gark.yaml"),
    "check-several": (
        "check",
        "methods/rectangular.gark.yaml",
        f"{EXAMPLES}/failing",
        "methods/ark-ars222.gark.yaml",
    ),
    "check-failing": ("check", f"{EXAMPLES}/failing/collocation-misprinted.gark.yaml"),
    "check-invalid": ("check", f"{EXAMPLES}/invalid/many-faults.gark.yaml"),
    "check-zero-weight": ("check", f"{EXAMPLES}/valid/ark-own-weights.gark.yaml"),
    "check-json": ("check", "methods/rectangular.gark.yaml", "--format", "json"),
    "trees": ("trees", "-N", "2", "-n", "3", "--root", "1"),
    "trees-count": ("trees", "-N", "3", "-n", "12", "--upto", "--count", "--root", "2"),
    "conditions": ("conditions", "--order", "4"),
    "conditions-file": ("conditions", VERLET, "--order", "3"),
    "conditions-latex": ("conditions", "--order", "3", "--format", "latex"),
    "tableau": ("tableau", "methods/collocation-conjugate.gark.yaml"),
    "tableau-decimals": ("tableau", "methods/gauss6-lobatto7.gark.yaml", "--digits", "3"),
    "tableau-latex": ("tableau", VERLET, "--format", "latex"),
    "conjugate-pair": ("conjugate", "methods/collocation.gark.yaml", "--pair"),
    "conjugate-yaml": ("conjugate", "methods/gauss6-lobatto7.gark.yaml", "--format", "yaml"),
    "converge": ("converge", VERLET),
    "converge-several": (
        "converge",
        "methods/rectangular.gark.yaml",
        VERLET,
        f"{EXAMPLES}/invalid/empty.gark.yaml",
        "methods/gauss6-lobatto7.gark.yaml",
        "methods/ark-ars222.gark.yaml",
        "methods/three-colours.gark.yaml",
    ),
    "energy": ("energy", "methods/rectangular.gark.yaml"),
    "energy-kepler": (
        "energy",
        "methods/rectangular.gark.yaml",
        "--problem",
        "kepler",
        "--t-end",
        "200",
        "--symplecticity",
    ),
    "energy-drifting": (
        "energy",
        "methods/rk4.gark.yaml",
        "--problem",
        "kepler",
        "--t-end",
        "200",
        "--bounded",
    ),
    "modified": ("modified", VERLET),
    "list": ("list",),
    "list-families": ("list", "families"),
    "list-problems": ("list", "problems"),
    "list-schemes": ("list", "schemes"),
    "help": ("--help",),
    "help-check": ("check", "--help"),
    "usage": ("chek", "methods/collocation.gark.yaml"),
    "usage-option": ("trees", "-N", "2", "-n", "3", "--root", "4"),
    "no-such-file": ("tableau", "nowhere.gark.yaml"),
}
SOURCES = {"conditions-latex"}
"""Runs that write for a program, where lines may be long."""


def record(arguments: tuple[str, ...], run: Run) -> str:
    """A run as text."""
    head = f"$ gark {' '.join(arguments)}\nexit code {run.code}\n"
    return "".join(
        [head, f"\n-- stdout --\n{run.out}", f"\n-- stderr --\n{run.err}" if run.err else ""]
    )


@pytest.mark.parametrize("name", RUNS)
def test_a_run_is_as_recorded(name: str) -> None:
    """Exit code, stdout and stderr are what they were when someone last read them, with no
    colour.
    """
    run = gark_once(*RUNS[name])
    assert "\x1b" not in run.out + run.err
    assert_recorded(SNAPSHOTS / f"{name}.txt", record(RUNS[name], run))


@pytest.mark.parametrize("name", [name for name in RUNS if name not in SOURCES])
def test_a_run_fits_the_terminal(name: str) -> None:
    """No line of the report is wider than 80 columns, file names apart."""
    run = gark_once(*RUNS[name])
    lines = [line for line in (run.out + run.err).splitlines() if ".gark.yaml" not in line]
    assert [line for line in lines if len(line) > 80] == []


def test_every_record_belongs_to_a_run() -> None:
    """No record outlives its run."""
    assert {path.stem for path in SNAPSHOTS.iterdir()} == set(RUNS)
