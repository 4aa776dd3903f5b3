"""Every command that wrote a file says so, and lists that are asked for alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from garkcli.cli.looking_up import LISTS
from garkcli.report.listing import ROWS
from tests.cli.harness import gark

COMMANDS = ["check rk4", "tableau rk4", "stability rk4", "report rk4", "trees --order 3", "list"]


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_says_what_it_wrote(command: str, tmp_path: Path) -> None:
    path = tmp_path / "result"
    run = gark(*command.split(), "-o", str(path))
    assert (run.code, run.out) == (0, "")
    assert run.err == f"wrote {path}\n"
    assert path.stat().st_size > 0
    assert gark(*command.split(), "-q", "-o", str(path)).err == ""


@pytest.mark.parametrize("what", LISTS)
def test_one_list_alone(what: str) -> None:
    whole = json.loads(gark("list", "--format", "json").out)
    alone = json.loads(gark("list", what, "--format", "json").out)
    assert alone == {"schema": "gark/list/1", what: whole[what]}


def test_every_list_can_be_asked_for() -> None:
    assert set(LISTS) == set(ROWS)
