"""The suite runs the tests of every room."""

from __future__ import annotations

from fnmatch import fnmatch
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
APART = {"tests/benchmarks", "tests/browser", "tests/tried"}
"""Rooms whose tests have make targets of their own."""


def test_no_room_is_left_out(pytestconfig: pytest.Config) -> None:
    """A name that pytest passes over hides all folders of this name, also rooms of the package."""
    hidden = pytestconfig.getini("norecursedirs")

    def is_passed_over(folder: Path) -> bool:
        path = f"/{folder.relative_to(ROOT).as_posix()}"
        return any(fnmatch(path, f"*/{pattern}") for pattern in hidden)

    rooms = {x.parent for x in (ROOT / "tests").rglob("test_*.py")}
    rooms |= {x.parent for x in (ROOT / "garkcli").rglob("*.py")}
    ways = {room: [room, *room.parents] for room in rooms}
    left_out = {
        room.relative_to(ROOT).as_posix()
        for room, way in ways.items()
        if any(is_passed_over(x) for x in way if ROOT in x.parents)
    }
    assert left_out == APART
