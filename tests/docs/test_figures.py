"""The figures that the documentation shows."""

from __future__ import annotations

import re
import runpy
import struct
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def size(path: Path) -> tuple[int, int]:
    """Width and height of a PNG."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", data[16:24])
    return width, height


def test_the_figure_is_drawn_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The script beside it makes the figure that the README shows."""
    folder = ROOT / "docs" / "figures"
    made = tmp_path / "rectangular.png"
    script = str(folder / "rectangular.py")
    monkeypatch.setattr(sys, "argv", [script, str(made)])
    runpy.run_path(script, run_name="__main__")
    assert size(made) == size(folder / "rectangular.png")


def test_figures_of_the_readme_exist() -> None:
    """Every picture it shows is there."""
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README)
    assert "docs/figures/rectangular.png" in pictures
    assert all((ROOT / x).is_file() for x in pictures)
