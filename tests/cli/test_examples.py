"""The lines with which each help begins run as they are."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from garkcli.cli.table import COMMANDS
from tests.cli.harness import gark

FILES = {
    "mine.yaml": "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n",
    "sdirk.yaml": "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n",
    "spec.yaml": "methods:\n  - {family: [gauss, radau-iia], stages: 2}\ncolumns: [order]\n",
    "tables.json": '{"A": [[0, 0], [1, 0]], "b": [0.5, 0.5], "c": [0, 1], "order": 2}',
}
"""The files of the reader that the lines name."""


@pytest.mark.parametrize("command", COMMANDS)
def test_each_example_runs(command: str, tmp_path: Path) -> None:
    """Every command has two or three, which its help shows below the usage, and which succeed."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    lines = COMMANDS[command].examples
    assert 2 <= len(lines) <= 3
    _, *told = gark(command, "--help").out.partition("\n\n")
    begin = [x.strip() for x in told[1].splitlines()[: len(lines)]]
    assert begin == [*lines]
    for line in lines:
        program, *arguments = shlex.split(line)
        run = gark(*arguments, cwd=tmp_path)
        assert (program, arguments[0], run.code) == ("gark", command, 0), run.err
