"""Completion in the shell: commands, options, files, problems."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.shell_completion import BashComplete

from garkcli.cli.main import COMMANDS, gark
from garkcli.report.schemas import REPORTS
from tests.cli.harness import ROOT


def completions(*words: str) -> list[tuple[str, str]]:
    """What a shell is offered for the last word, with its kind."""
    shell = BashComplete(gark, {}, "gark", "_GARK_COMPLETE")
    return [(x.type, x.value) for x in shell.get_completions(list(words[:-1]), words[-1])]


def test_commands_are_completed() -> None:
    """Every command that begins so."""
    assert [value for _, value in completions("c")] == [x for x in COMMANDS if x.startswith("c")]


def test_the_word_for_help_is_completed() -> None:
    """And commands behind it; behind what is no command a shell is not told of the mistake."""
    assert completions("he") == [("plain", "help")]
    assert completions("help", "che") == [("plain", "check")]
    assert completions("chekc", "che") == [("plain", "check")]


@pytest.mark.parametrize(
    "words",
    [
        *[(name, "./m") for name in ("check", "converge", "energy", "tableau", "conjugate")],
        ("conditions", "./m"),
        ("check", "a", "qqq"),
        ("check", "--baseline", "b"),
        ("tableau", "m", "-o", "r"),
        ("energy", "m", "--plot", "p"),
        ("trees", "--svg", "t"),
        ("converge", "m", "--problem", "folder/"),
    ],
    ids=" ".join,
)
def test_files_are_completed(words: tuple[str, ...]) -> None:
    """Wherever a file is meant the shell completes files."""
    assert completions(*words) == [("file", words[-1])]


def test_problems_are_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Names of problems and problem files beside each other; values of other options."""
    for name in ("kepler.yaml", "pendulum.yml", "pictures.png"):
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path)
    assert completions("energy", "m", "--problem", "k") == [
        ("plain", "kepler"),
        ("plain", "kepler.yaml"),
    ]
    assert ("plain", "pendulum.yml") in completions("converge", "m", "--problem", "p")
    assert ("plain", "pendulum") in completions("converge", "m", "--problem", "p")
    assert completions("check", "m", "--format", "sa") == [("plain", "sarif")]


def test_reports_with_a_schema_are_completed() -> None:
    """Every report whose schema there is, and no other command."""
    found = completions("schema", "--report", "con")
    assert found == [
        ("plain", "conditions"),
        ("plain", "conjugate"),
        ("plain", "convert"),
        ("plain", "converge"),
    ]
    assert [x for _, x in completions("schema", "--report", "")] == list(REPORTS)


@pytest.mark.skipif(os.name != "posix", reason="asks as bash does")
def test_a_shell_is_answered() -> None:
    """The program answers the question that bash puts in the environment."""
    variables = {"_GARK_COMPLETE": "bash_complete", "COMP_WORDS": "gark ch", "COMP_CWORD": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "garkcli"],
        env={**os.environ, "PYTHONPATH": str(ROOT), **variables},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout.split(",")[1].strip() == "check"
    assert done.stderr == ""
    assert isinstance(gark, click.Group)
