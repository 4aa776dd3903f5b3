"""An installation without the extra ``audit``: what it reads, and what it says of sources."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from garkcli.bridges.readers import registry
from tests.cli.harness import ROOT, gark

SOURCES = Path("tests/bridges/sources")
WITHOUT = """
import sys
from garkcli.bridges.readers.registry import all_readers
grammars = {x for reader in all_readers().values() for x in reader.grammars}
sys.modules |= dict.fromkeys(["tree_sitter", *grammars])  # none of them can be imported
from garkcli.cli.main import main
main(sys.argv[1:])
"""


@pytest.fixture
def _no_grammars(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of tree-sitter is found."""
    monkeypatch.setattr(registry, "find_spec", lambda _: None)


@pytest.mark.usefixtures("_no_grammars")
@pytest.mark.parametrize("command", ["audit", "import"])
@pytest.mark.parametrize("source", ["ralston.c", "kutta.m", ".", "-"])
def test_a_source_without_grammars(command: str, source: str, tmp_path: Path) -> None:
    """One message with the line to type and exit code 2: for a file of a language, for a folder
    with one, for an ending that MATLAB shares with Mathematica, and for standard input.
    """
    path = source if source == "-" else str(SOURCES / source)
    folder = tmp_path / "methods"
    more = ["--output-dir", str(folder)] if command == "import" else []
    run = gark(command, path, *more, stdin="double A[1][1] = {{0}};")
    assert (run.code, run.out) == (2, "")
    said = " ".join(run.err.split())
    assert said.count("gark: ") == 1
    assert "without tree-sitter and its grammars" in said
    assert 'pip install "garkcli[audit]"' in said
    assert not [*folder.glob("*")]


@pytest.mark.usefixtures("_no_grammars")
def test_what_needs_no_grammar_is_read() -> None:
    """Data, LaTeX and Mathematica, also through standard input where the format is given."""
    for name in ("kutta.csv", "paper.tex", "lists.wl"):
        assert gark("audit", str(SOURCES / name)).code in {0, 1}
    text = (ROOT / SOURCES / "kutta.csv").read_text(encoding="utf-8")
    assert gark("import", "-", "--from", "csv", stdin=text).code == 0


def test_one_grammar_that_lacks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Other languages are read all the same."""
    absent = {"tree_sitter_c"}
    found = registry.find_spec
    monkeypatch.setattr(registry, "find_spec", lambda x: None if x in absent else found(x))
    assert gark("audit", str(SOURCES / "kutta.f90")).code == 0
    assert gark("audit", str(SOURCES / "ralston.c")).code == 2


def test_nothing_else_imports_a_grammar() -> None:
    """A process that cannot import tree-sitter checks a method and reads rows, and refuses C as if
    it were not installed.
    """

    def code(*arguments: str) -> int:
        command = [sys.executable, "-c", WITHOUT, *arguments]
        return subprocess.run(command, cwd=ROOT, capture_output=True, check=False).returncode

    assert code("audit", str(SOURCES / "kutta.csv")) == 0
    assert code("audit", str(SOURCES / "ralston.c")) == 2


def test_the_extra_has_every_grammar() -> None:
    """Those of the readers, and the library, and no others; the program itself needs none."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    project = tomllib.loads(text)["project"]
    extra = {re.split("[>=]", x)[0] for x in project["optional-dependencies"]["audit"]}
    grammars = {x for r in registry.all_readers().values() for x in r.grammars}
    assert extra == {x.replace("_", "-") for x in {"tree_sitter", *grammars}}
    assert not [x for x in project["dependencies"] if x.startswith("tree-sitter")]
