"""CONTRIBUTING.md: where each kind of thing is added."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (?!add a|-)(.+?) \| (.+?) \| (.+?) \| (.+?) \|$", TEXT, re.M)
PATHS = sorted(set(re.findall(r"`((?:garkcli|tests|docs)/[^`\s]+)`", TEXT)))


def files(pattern: str) -> list[Path]:
    """The files of a path in which words in capitals stand for a name."""
    glob = re.sub(r"\b(?:NAME|KIND)\b|NAME", "*", pattern)
    return [x for x in ROOT.glob(glob) if x.name != "__init__.py"]


@pytest.mark.parametrize("path", PATHS)
def test_what_is_named_is_there(path: str) -> None:
    """Each file exists; where a name is left open there are files of that kind."""
    assert files(path)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_a_kind_has_a_place_and_a_test(row: tuple[str, ...]) -> None:
    """What is written is in the package or the pages; what tests it is in the tests."""
    _, write, _, tested = row
    assert re.search(r"`(garkcli|docs)/", write)
    assert tested == "there" or re.search(r"`tests/\w+/test_\w+\.py`", tested)


def test_lists_are_in_the_files_that_are_named() -> None:
    """Those that a row of the table names by the name of a variable."""
    for folder, name in (
        ("garkcli/transfer.py", "RULES"),
        ("garkcli/constructions/schemes.py", "SCHEMES"),
        ("garkcli/constructions/schemes.py", "SPLITTINGS"),
        ("garkcli/cli/table.py", "COMMANDS"),
        ("garkcli/webpage/page.py", "SECTIONS"),
        ("garkcli/webpage/sections/orders.py", "content"),
        ("garkcli/bridges/targets/plain.py", "BRIDGES"),
        ("garkcli/sources/languages/julia.py", "READER"),
    ):
        assert f"`{name}`" in TEXT
        text = (ROOT / folder).read_text(encoding="utf-8")
        assert re.search(rf"^({name}\b.*= |def {name}\()", text, re.MULTILINE), folder


def test_a_file_that_is_not_there_is_found() -> None:
    """The comparison can fail."""
    assert not files("garkcli/families/nothing_of_the_kind.py")
    assert not files("garkcli/families/NAME.yaml")
