"""What is packed, and that it can be unpacked and used everywhere."""

from __future__ import annotations

import re
import sys
import tomllib
from collections import Counter
from pathlib import Path

import pytest

from tests.cli.harness import gark
from tests.portable.venvs import EXTRAS, MSOLVE

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "garkcli"
RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?|.*[<>:\"|?*\\]|.*[. ]", re.I)
"""Names of devices on Windows, at whose end nothing counts, signs it does not take, and ends that
it drops.
"""
LONGEST = 140
"""Windows has 260 signs for a whole path, of which this leaves some for the folder."""
OF_TOOLS = re.compile(r"\..*|__pycache__|build|dist|.*\.egg-info")


def packed_files() -> list[Path]:
    """Every file of the tree, without what tools leave there, from the root."""
    folders, found = [ROOT], []
    while folders:
        for path in folders.pop().iterdir():
            if OF_TOOLS.fullmatch(path.name):
                continue
            if path.is_dir():
                folders.append(path)
            else:
                found.append(path.relative_to(ROOT))
    return found


@pytest.mark.skipif(not PACKAGE.is_dir(), reason="there is a wheel instead")
def test_every_file_of_the_package_is_packed() -> None:
    """Modules are in packages; what is no module is named in pyproject.toml."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    setuptools = tomllib.loads(text)["tool"]["setuptools"]
    named: set[Path] = set()
    for pattern in setuptools["package-data"]["garkcli"]:
        matched = {*PACKAGE.glob(pattern)}
        assert matched, pattern
        named |= matched
    files = [ROOT / x for x in packed_files() if x.parts[0] == "garkcli"]
    modules = {x for x in files if x.suffix == ".py"}
    assert {*files} - modules == named
    folders = {path.parent for path in modules}
    assert [x for x in folders if not (x / "__init__.py").is_file()] == []


def test_every_file_can_be_unpacked_everywhere() -> None:
    """Where capitals do not count, where some names are devices, where paths are short."""
    names = [path.as_posix() for path in packed_files()]
    lower = Counter(name.lower() for name in names)
    assert len(names) > 100
    assert [name for name, times in lower.items() if times > 1] == []
    parts = {part for name in names for part in name.split("/")}
    assert [part for part in parts if RESERVED.fullmatch(part)] == []
    assert [name for name in names if len(name) > LONGEST] == []
    assert [name for name in names if not name.isascii()] == []


def test_the_page_names_every_extra() -> None:
    """Those that users may want are in the table on installing, and no others."""
    text = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    section = text.split("## Installing\n")[1].split("\n## ")[0]
    table = section.split("| extra |")[1]
    assert sorted(re.findall(r"^\| `(\w+)`", table, re.M)) == sorted([*EXTRAS, MSOLVE])


@pytest.mark.parametrize("command", ["stability", "converge", "energy"])
def test_a_figure_without_matplotlib(
    command: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Every command that draws says which extra brings it, and leaves no file behind."""
    for name in [x for x in sys.modules if x.startswith("matplotlib")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    figure = tmp_path / "figure.png"
    run = gark(command, "rk4", "--plot", str(figure))
    assert (run.code, "garkcli[plot]" in run.err) == (2, True)
    assert (run.out, figure.exists()) == ("", False)
