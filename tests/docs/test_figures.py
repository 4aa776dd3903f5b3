"""The figure in the README, and the sessions beside it."""

from __future__ import annotations

import re
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.harness import gark

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
SESSIONS = re.findall(r"^\$ gark (energy .*)\n((?:.*\n)*?)(?=```|\$ gark )", README, re.MULTILINE)
"""Arguments and what is printed."""


def size(path: Path) -> tuple[int, int]:
    """Width and height of a PNG."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", data[16:24])
    return width, height


def test_the_figure_is_drawn_anew(tmp_path: Path) -> None:
    """The script beside it makes the figure that the README shows."""
    folder = ROOT / "docs" / "figures"
    made = tmp_path / "rectangular.png"
    done = subprocess.run(
        [sys.executable, str(folder / "rectangular.py"), str(made)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert size(made) == size(folder / "rectangular.png")


def test_figures_of_the_readme_exist() -> None:
    """Every picture it shows is there."""
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README)
    assert "docs/figures/rectangular.png" in pictures
    assert all((ROOT / x).is_file() for x in pictures)


@pytest.mark.parametrize(("arguments", "printed"), SESSIONS)
def test_energy_sessions(arguments: str, printed: str, tmp_path: Path) -> None:
    """What the README shows is what is printed."""
    run = gark(*arguments.replace("energy.png", str(tmp_path / "energy.png")).split())
    assert run.out.strip() == printed.strip()


def test_there_are_energy_sessions() -> None:
    """The pattern finds them."""
    assert len(SESSIONS) == 2
