"""The manual page is what the commands say of themselves."""

from __future__ import annotations

import os
import re
import runpy
import shutil
import subprocess
import tomllib
from collections.abc import Callable
from typing import Any

import pytest

from garkcli.cli.table import COMMANDS
from tests.cli.harness import ROOT

FOLDER = ROOT / "docs" / "man"
PAGE = FOLDER / "gark.1"


@pytest.fixture(scope="module")
def program() -> dict[str, Any]:
    """What the program that makes the page defines."""
    return runpy.run_path(str(FOLDER / "page.py"))


def test_the_page_is_the_help(program: dict[str, Any]) -> None:
    """Made anew it is the one in the tree; every command has its section."""
    wanted = program["page"]()
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(wanted, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == wanted
    named = re.findall(r'^\.SS "gark (\S+)', wanted, re.MULTILINE)
    assert named == list(COMMANDS)
    codes = program["exit_codes"]()
    assert [*codes] == ["0", "1", "2", "3", "130", "141"]


def test_no_text_is_taken_for_a_request(program: dict[str, Any]) -> None:
    """What begins like a macro, has a backslash or a dash says what it says."""
    escaped: Callable[[str], str] = program["escaped"]
    assert escaped(".gark.toml") == r"\&.gark.toml"
    assert escaped("'a'") == r"\&'a'"
    assert escaped(r'a\b -c "d"') == r"a\eb \-c \(dqd\(dq"


def test_completion_is_told_as_in_the_documentation(program: dict[str, Any]) -> None:
    """The lines for the shells are those of docs/command-line.md."""
    text = (ROOT / "docs/command-line.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?:bash|zsh|fish) \| `(.*)` \| `(.*)` \|$", text, re.MULTILINE)
    found = {file: line.replace(r"\|", "|") for file, line in rows}
    assert found == program["SHELLS"]


def test_the_page_is_installed() -> None:
    """The wheel has it where man looks for the page of a command."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    setuptools = tomllib.loads(text)["tool"]["setuptools"]
    assert setuptools["data-files"] == {"share/man/man1": [PAGE.relative_to(ROOT).as_posix()]}


@pytest.mark.skipif(not shutil.which("groff"), reason="there is no groff")
def test_groff_has_no_complaint() -> None:
    """It is set without a warning of its formatter, with a line for each option."""
    done = subprocess.run(
        ["groff", "-k", "-man", "-ww", "-Tutf8", str(PAGE)],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
    )
    assert done.stderr == ""
    plain = re.sub(".\b", "", done.stdout)  # bold letters are struck twice
    assert "--require-claims" in plain
