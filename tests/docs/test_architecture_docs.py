"""docs/contributing/architecture.md names every room of the package, and only files that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "contributing" / "architecture.md").read_text(encoding="utf-8")
ROOMS = sorted(path.parent.name for path in (ROOT / "garkcli").glob("*/__init__.py"))


def part(room: str) -> str:
    """The lines on a room: to the next line that is no deeper."""
    found = re.search(rf"^  {room}/.*\n(?:   .*\n|\n)*", TEXT, re.MULTILINE)
    assert found, room
    return found.group()


@pytest.mark.parametrize("room", ROOMS)
def test_every_file_that_is_named_exists(room: str) -> None:
    """The map has the files to begin with."""
    named = set(re.findall(r"\b(\w+\.py)\b", part(room)))
    exist = {path.name for path in (ROOT / "garkcli" / room).glob("*.py")}
    assert named <= exist


def test_there_are_no_other_rooms() -> None:
    """Folders of the page are folders of the repository."""
    folders = re.findall(r"^ {2}(\w+)/ ", TEXT, re.MULTILINE)
    assert sorted(folders) == ROOMS
    for name in re.findall(r"^(\w+)/ ", TEXT, re.MULTILINE):
        assert (ROOT / name).is_dir(), name


def test_the_source_distribution_has_every_folder() -> None:
    """Each folder that the page names is in it, or the package itself."""
    grafted = re.findall(r"^graft (\S+)$", (ROOT / "MANIFEST.in").read_text("utf-8"), re.MULTILINE)
    assert {*re.findall(r"^(\w+)/", TEXT, re.MULTILINE)} == {*grafted, "garkcli"} - {".ci"}
