"""Mistakes in the arguments have a cure."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from garkcli.cli.main import COMMANDS
from garkcli.cli.usage import MEANT
from tests.cli.harness import ROOT, gark


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


@pytest.mark.parametrize("arguments", [["convert", "rk4", "--to", "tableau"], ["new", "--zzz"]])
def test_a_mistake_fits_the_terminal(arguments: list[str]) -> None:
    """Its lines are as long as those of the terminal, with the same words that a pipe gets in one
    line; arguments are no options.
    """
    pty = pytest.importorskip("pty", reason="there are no pseudo-terminals")
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "garkcli", *arguments]
    environment = {**os.environ, "COLUMNS": "60"}
    subprocess.run(command, stderr=theirs, env=environment, cwd=ROOT, check=False)
    os.close(theirs)
    shown = os.read(ours, 10_000).decode().splitlines()
    os.close(ours)
    assert max(map(len, shown[2:])) <= 60
    piped = subprocess.run(
        command, stderr=subprocess.PIPE, env=environment, cwd=ROOT, text=True, check=False
    ).stderr
    assert " ".join(" ".join(shown).split()) == " ".join(piped.split())
    assert "one of: file" not in piped
