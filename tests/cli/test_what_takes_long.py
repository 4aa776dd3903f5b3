"""Every command says what takes long while it works; see ``garkcli.page.progress``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from garkcli.cli.table import FORMER
from garkcli.doing import telling
from tests.cli.harness import NAMES, Run, gark
from tests.listener import Listener

COLLOCATION = "methods/collocation.gark.yaml"
SPEC = "tests/examples/sweeps/small.yaml"
TOLD = {
    "check": ([COLLOCATION], "order"),
    "claims": ([COLLOCATION], "order"),
    "trees": (["-n", "3"], "trees"),
    "conditions": (["-n", "3"], "conditions"),
    "tableau": ([COLLOCATION], f"reading {COLLOCATION}"),
    "conjugate": ([COLLOCATION], f"reading {COLLOCATION}"),
    "reduce": ([COLLOCATION], "smallest method"),
    "convert": ([COLLOCATION, "--to", "gark"], "other form"),
    "diff": (["rk4", "rk4"], "differences"),
    "stability": (["rk4"], "stability"),
    "modified": (["rk4", "-n", "3"], "modified equation"),
    "converge": (["rk4", "--problem", "pendulum"], "h = 1/16"),
    "energy": (["rk4", "--problem", "pendulum", "--t-end", "1"], "steps"),
    "export": (["rk4", "--to", "csv"], "numbers and orders"),
    "import": (["tests/bridges/sources/kutta.csv"], "files"),
    "audit": (["tests/bridges/sources/kutta.csv"], "files"),
    "certificate": (["rk4"], "proof"),
    "show": (["rk4"], "reading rk4"),
    "plot": (["rk4"], "reading rk4"),
    "report": (["rk4", "--no-pictures", "-o", "-"], "methods"),
}
"""Arguments of each command, and something that it says."""
AT_ONCE = {"new", "explain", "list", "cite", "schema"}
"""Commands that have nothing to compute."""
ELSEWHERE = {"design", "sweep", "lsp"}
"""Commands whose work is counted in tests of their own, or in a process apart."""


def told(*arguments: str, stdin: str = "") -> tuple[Run, Listener]:
    """A run, and what it said while it worked."""
    who = Listener()
    with telling(who):
        return gark(*arguments, stdin=stdin), who


def test_no_command_is_forgotten() -> None:
    """A new command is entered here with what it says."""
    assert {*TOLD} | AT_ONCE | ELSEWHERE == NAMES


@pytest.mark.parametrize("command", TOLD)
def test_a_command_says_what_it_is_at(command: str) -> None:
    """Something of its own, not only that it works."""
    arguments, something = TOLD[command]
    run, who = told(command, *arguments)
    assert run.code in {0, 3}, run.err
    assert something in [work.what for work in who.told]


def test_a_sweep_counts_its_methods(tmp_path: Path) -> None:
    """How many there are, and in the end all of them are done."""
    run, who = told("sweep", SPEC, "--rows", str(tmp_path / "rows.jsonl"))
    assert run.code in {0, 3}, run.err
    (methods,) = [work for work in who.told if work.what == "methods"]
    assert methods.done == methods.total != 0


def test_reading_a_problem_is_told(tmp_path: Path) -> None:
    """What is found of a problem file before a step is taken: its Legendre transform, and whether
    its invariants are any.
    """
    path = tmp_path / "pendulum.yaml"
    path.write_text(
        "variables: [x]\nlagrangian: vx**2/2 + cos(x)\ninitial: {x: 1, vx: 0}\n"
        "invariants: {no: x}\n"
    )
    run, who = told("energy", "rk4", "--problem", str(path), "--t-end", "1")
    assert run.code in {0, 3}, run.err
    said = [work.what for work in who.told]
    for what in (f"reading {path}", "Legendre transform", "invariants along the solution"):
        assert what in said


@pytest.mark.parametrize(("quiet", "is_hushed"), [([], False), (["-q"], True)])
def test_quiet_hushes(quiet: list[str], is_hushed: bool) -> None:
    """With ``-q`` nobody is told any more."""
    _, who = told("tableau", "rk4", *quiet)
    assert who.is_hushed is is_hushed


def test_a_command_listens(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each has a line called like it, until it says more."""
    seen: list[str] = []

    @contextmanager
    def watching(what: str) -> Iterator[None]:
        seen.append(what)
        yield

    monkeypatch.setattr(sys.modules["garkcli.cli.main"], "watching", watching)
    for command in TOLD:
        gark(command, "--help")
    assert seen == [f"gark {FORMER.get(command, (command,))[0]}" for command in TOLD]
