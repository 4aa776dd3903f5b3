"""Every fenced block of the README and the pages is run, read, or of a kind that is named here."""

from __future__ import annotations

import ast
import json
import re
import shlex
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest
import yaml

from garkcli.cli.main import gark
from garkcli.cli.project import find_project
from garkcli.cli.table import COMMANDS
from garkcli.methodfile.description import FORMS
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.methodfile.shelves import GROUP
from garkcli.problems.files.load import loads_problem
from tests.cli.harness import ROOT
from tests.docs.blocks import Block, blocks, pages
from tests.docs.transcripts import NOT_RUN, PROGRAMS, steps

TESTED = {
    ("docs/contributing/architecture.md", "text"): "test_architecture_docs.py",
    ("docs/ci.md", "python"): "test_ci_docs.py",
    ("docs/ci.md", "sh"): "test_ci_docs.py",
    ("docs/ci.md", "json"): "test_ci_docs.py",
    ("docs/editors.md", "lua"): "test_editors_docs.py",
    ("docs/editors.md", "elisp"): "test_editors_docs.py",
    ("docs/editors.md", "json"): "test_editors_docs.py",
    ("docs/json.md", "json"): "test_json_docs.py",
    ("docs/notebook.md", "{code-cell} python"): "test_notebook_docs.py",
    ("docs/notebook.md", "text"): "test_notebook_docs.py",
    ("docs/tutorial-student.md", "text"): "test_tutorials.py",
}
"""Blocks that a test of their page compares with what the program does, by page and language."""

ANY_METHOD = "A: [[0]]\nb: [1]\n"
TWO_METHODS = """\
methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 3}
"""
THIRD = "  - {family: gauss, stages: 2}\n"


def words(block: Block) -> list[str]:
    """The first words of the commands of a session."""
    lines = re.findall(r"^\$ (.*)$", block.text, re.MULTILINE)
    return [shlex.split(line, comments=True)[0] for line in lines]


def check_session(block: Block) -> None:
    """It begins with a command, and each is one that ``test_transcripts`` runs, or that is named
    as one that it does not.
    """
    assert block.text.startswith("$ "), block.where
    assert set(words(block)) <= {*PROGRAMS, *NOT_RUN}, block.where
    # a # at a prompt is no comment in zsh
    assert not re.search(r"^\$ .*[ \t]#", block.text, re.M), block.where
    for line in re.findall(r"^\$ make ([a-z]+)", block.text, re.MULTILINE):
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        assert re.search(rf"^{line}:", makefile, re.MULTILINE), block.where


def check_file(block: Block) -> None:
    """A session of the page has it, or the checkout, comments apart."""
    if "/" in block.name:
        text = (ROOT / block.name).read_text(encoding="utf-8")
        bare = re.sub(r"^#.*\n", "", text, flags=re.MULTILINE)
        assert block.text == bare, block.where
        return
    of_page = list(steps(block.page))
    assert any(x.file == block.name for x in of_page), block.where
    others = [x for x in of_page if x.file != block.name]
    used = any(block.name in f"{x.command} {x.text}" for x in others)
    assert used or block.name == ".gark.toml", block.where


def check_yaml(block: Block) -> None:
    """A problem, a spec of a sweep, a part of continuous integration or a method, whole or in
    part: read by what reads it.
    """
    data = yaml.safe_load(block.text)
    parts = data if isinstance(data, list) else [data]
    assert all(isinstance(part, dict) for part in parts), block.where
    names = {key for part in parts for key in part}
    if "variables" in names:
        assert loads_problem(block.text).terms
    elif names & {"uses", "run", "jobs", "script", "repos"} or any(
        "script" in value for value in parts[0].values() if value
    ):
        check_steps(data, block)
    else:
        check_method(block, names)


def check_steps(part: Any, block: Block) -> None:
    """Each ``gark`` command of a workflow has words and options that exist."""
    if isinstance(part, list):
        for item in part:
            check_steps(item, block)
    elif isinstance(part, dict):
        for value in part.values():
            check_steps(value, block)
    elif isinstance(part, str) and part.startswith("gark "):
        line = part.partition(">>")[0]
        _, name, *arguments = shlex.split(line, comments=True)
        command = gark.get_command(click.Context(gark), name)
        assert command is not None, f"{block.where}: {line}"
        command.make_context(name, arguments)


def check_method(block: Block, names: set[str]) -> None:
    """It loads: as it is, or a part of a file with the rest around it."""
    text = block.text
    if names & {"transfer"} and "methods" not in names:
        text += "parameters: {tau: 1/2}\n" + TWO_METHODS
        text += THIRD if "1,3" in text else ""
    elif "methods" in names and "transfer" not in names:
        text += "transfer: collocation\n"
    elif not names & {"A", "unknown", *FORMS}:
        text += ANY_METHOD
    if {"unknown", "design"} & names or '"?"' in text:
        assert loads_family(text).tableau.size, block.where
        return
    method = loads(text)
    assert method.tableau.size, block.where
    assert len(method.claims) == len(yaml.safe_load(text).get("expect", ()))


def check_toml(block: Block) -> None:
    """Settings of gark are read, those of others have keys that exist."""
    data = tomllib.loads(block.text)
    if "tool" in data and "pytest" in data["tool"]:
        options = data["tool"]["pytest"]["ini_options"]
        plugin = (ROOT / "garkcli/pytest_plugin.py").read_text("utf-8")
        assert all(f'"{x}"' in plugin for x in options if x != "testpaths")
    elif "project" in data:
        (group,) = data["project"]["entry-points"]
        assert group == GROUP, block.where
    else:
        Path("pyproject.toml").write_text(block.text, encoding="utf-8")
        assert find_project().file == "pyproject.toml", block.where


def check_python(block: Block) -> None:
    """Examples with prompts, which ``test_python_docs`` runs on every page that has some."""
    assert block.text.startswith(">>> "), block.where
    ast.parse("\n".join(re.findall(r"^(?:>>>|\.\.\.) ?(.*)$", block.text, re.M)))


def check_json(block: Block) -> None:
    """Settings of an editor, which name the schema that the page writes."""
    settings = json.loads(block.text)
    schemas = settings["yaml.schemas"]
    page = block.page.read_text(encoding="utf-8")
    assert all(f"-o {name}\n" in page for name in schemas), block.where


def check_examples(block: Block) -> None:
    """Lines with which the help of a command begins, which ``test_examples`` runs."""
    lines = [*block.text.splitlines()]
    assert lines in [[*x.examples] for x in COMMANDS.values()], block.where


CHECKS: dict[str, Callable[[Block], None]] = {
    "console": check_session,
    "json": check_json,
    "python": check_python,
    "sh": check_examples,
    "toml": check_toml,
    "yaml": check_yaml,
}


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_every_block_is_run_or_read(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """None of the page is of a kind that nobody looks at; each is checked by what its kind is."""
    monkeypatch.chdir(tmp_path)
    for block in blocks(page):
        assert not block.indent, f"{block.where}: no test finds it indented"
        place = page.relative_to(ROOT).as_posix(), block.language
        if place in TESTED and not block.name:
            continue
        if block.name:
            check_file(block)
            continue
        assert block.language in CHECKS, (
            f"{block.where}: nobody runs or reads a block of {block.language or 'no language'}"
        )
        CHECKS[block.language](block)


def test_no_exception_is_stale() -> None:
    """Pages that are said to have a test of their own have such blocks, and the test reads them;
    commands that are not run are on some page.
    """
    everything = [block for page in pages() for block in blocks(page)]
    places = {(x.page.relative_to(ROOT).as_posix(), x.language) for x in everything}
    assert set(TESTED) <= places
    for (page, _), test in TESTED.items():
        text = (ROOT / "tests/docs" / test).read_text(encoding="utf-8")
        assert Path(page).stem in text, test
    sessions = [x for x in everything if x.language == "console"]
    assert set(NOT_RUN) <= {word for x in sessions for word in words(x)}


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_no_session_is_hidden(page: Path) -> None:
    """Commands stand in blocks with fences: an indented one would not be run."""
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"^(?: {4,}|\t)\$? ?gark ", text, re.MULTILINE)


def test_a_block_that_nobody_runs_is_found(tmp_path: Path) -> None:
    """The checks can fail: an option that is none, a method that is none, a file that nothing
    uses.
    """
    page = tmp_path / "page.md"

    def block(language: str, text: str) -> Block:
        page.write_text(f"```{language}\n{text}```\n", encoding="utf-8")
        (found,) = blocks(page)
        return found

    with pytest.raises(Exception, match="No such option"):
        check_yaml(block("yaml", "- run: gark check --quite methods\n"))
    with pytest.raises(Exception, match="A"):
        check_yaml(block("yaml", "A: [[0, 0], [1, 0]]\nb: [1]\n"))
    page.write_text("`m.yaml`:\n\n```yaml\nb: [1]\n```\n", encoding="utf-8")
    (unused,) = blocks(page)
    assert unused.name == "m.yaml"
    page.write_text("```yaml\nb: [1]\n", encoding="utf-8")
    with pytest.raises(ValueError, match="no end"):
        list(blocks(page))
