"""Mistakes in the arguments have a cure."""

from __future__ import annotations

import pytest

from garkcli.cli.main import COMMANDS
from garkcli.cli.usage import MEANT
from tests.cli.harness import gark


@pytest.mark.parametrize(
    ("line", "cure"),
    [
        ("RK4", "gark check RK4"),
        ("mine.gark.yaml", "gark check mine.gark.yaml"),
        ("order rk4", "did you mean 'check'?"),
        ("chekc rk4", "did you mean 'check'?"),
        ("check", "name a file, a folder, or a method of the catalogue"),
        ("tableau", "name a file, or a method of the catalogue"),
        ("check rk4 -format json", "several letters begin with --"),
        ("check rk4 --max-order five", "'five' is no whole number"),
        ("check rk4 --format jsn", "did you mean 'json'?"),
        ("trees 4", "an order is --order 4"),
        ("conditions rk4 3", "an order is --order 3"),
        ("export rk4", "gark list exports shows"),
        ("list rk4", "gark list methods rk4"),
        ("list method", "did you mean 'methods'?"),
    ],
)
def test_a_mistake_has_its_cure(line: str, cure: str) -> None:
    """The last line says what is wrong and what to write; the exit code is that of usage."""
    run = gark(*line.split())
    assert (run.code, run.out) == (2, "")
    assert cure in run.err.splitlines()[-1]


def test_words_that_are_meant_are_commands() -> None:
    """None is a command itself, and what each stands for is one."""
    assert not MEANT.keys() & COMMANDS.keys()
    assert {*MEANT.values()} <= COMMANDS.keys()
