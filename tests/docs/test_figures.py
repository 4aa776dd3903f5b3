"""The figures that the documentation shows."""

from __future__ import annotations

import re
import runpy
import struct
import sys
from pathlib import Path
from typing import Any

import pytest

from garkcli.cli.command import command_of
from tests.cli.harness import gark
from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def size(path: Path) -> tuple[int, int]:
    """Width and height of a PNG."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", data[16:24])
    return width, height


@in_whole
def test_the_figure_is_drawn_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The script beside it makes the figure of the paper."""
    folder = ROOT / "docs" / "figures"
    made = tmp_path / "rectangular.png"
    script = str(folder / "rectangular.py")
    monkeypatch.setattr(sys, "argv", [script, str(made)])
    runpy.run_path(script, run_name="__main__")
    assert size(made) == size(folder / "rectangular.png")


def test_the_picture_of_the_readme_is_what_gark_finds() -> None:
    """Entry, tree and numbers are those that the check of its method names."""
    folder = ROOT / "docs" / "figures"
    made = runpy.run_path(str(folder / "wrong_entry.py"))
    assert made["picture"]() == (folder / "wrong-entry.svg").read_text(encoding="utf-8")
    found = gark("check", "-", stdin=made["RK4"] + "expect: {order: 4}\n").out
    assert "fails at [[]] by -1/18" in found
    assert "with a[3,2] = 1/2 instead of 1/3" in " ".join(found.split())


def test_the_picture_of_least_errors_is_that_of_the_table() -> None:
    """It has the pairs of the table whose least error is known; no rule has less."""
    folder = ROOT / "docs" / "figures"
    made = runpy.run_path(str(folder / "least_error.py"))
    assert made["picture"]() == (folder / "least-error.svg").read_text(encoding="utf-8")
    rows = made["table"]()
    assert len(rows) == 5
    assert all(min(row.values()) == row["least"] for row in rows.values())


def test_figures_of_the_readme_exist() -> None:
    """Every picture it shows is there."""
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README)
    assert "docs/figures/wrong-entry.svg" in pictures
    assert all((ROOT / x).is_file() for x in pictures)


GALLERY = ROOT / "docs" / "figures" / "gallery"
MOST_BYTES = 150_000
MOST_IN_ALL = 1_500_000
"""Of the pictures of the gallery, one and all together."""


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    """What docs/figures/gallery.py defines."""
    return runpy.run_path(str(GALLERY.with_suffix(".py")))


def test_the_gallery_has_its_pictures(script: dict[str, Any]) -> None:
    """Each picture of the page has a text for those who do not see it and a command; the folder
    has them, none besides, and none is large.
    """
    page = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    shown = re.findall(r"!\[([^\]]*)\]\(figures/gallery/([^)]+)\)", page)
    names = {name for _, name in shown}
    assert len(names) == len(shown) >= 12
    assert all(len(text) > 15 for text, _ in shown)
    assert names == set(script["commands"]())
    drawn = {x for x in GALLERY.iterdir() if x.suffix != ".yaml"}
    assert {x.name for x in drawn} == names
    sizes = [x.stat().st_size for x in drawn]
    assert max(sizes) < MOST_BYTES
    assert sum(sizes) < MOST_IN_ALL


def test_commands_of_the_gallery_are_commands(script: dict[str, Any]) -> None:
    """Each is read as it stands, with all its options; the last word is the picture."""
    for name, words in script["commands"]().items():
        command, *arguments = words
        context = command_of(command).make_context(command, arguments)
        assert name in context.params.values()


def test_the_gallery_is_drawn_anew(script: dict[str, Any], tmp_path: Path) -> None:
    """The script draws what the page shows by the commands that stand there: of those that are
    drawn in no time the same, of another one a picture.
    """
    commands = script["commands"]()
    trees = ["trees.svg", "coloured-trees.svg"]
    chosen = {name: commands[name] for name in [*trees, "traces.svg"]}
    script["draw_all"](chosen, tmp_path)
    for name in trees:
        made = (tmp_path / name).read_text(encoding="utf-8")
        assert made == (GALLERY / name).read_text(encoding="utf-8")
    assert "</svg>" in (tmp_path / "traces.svg").read_text(encoding="utf-8")
