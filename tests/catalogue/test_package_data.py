"""The method files of the package: that they are in it, what they are called, what else has them."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pytest

from garkcli.methodfile.shelves import key_of

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "garkcli" / "catalogue" / "data"
FILES = sorted(DATA.rglob("*.gark.yaml"))
COPIES = sorted((ROOT / "methods").rglob("*.gark.yaml"))
NAME = re.compile(r"[a-z0-9]+(?:[.-][a-z0-9]+)*\.gark\.yaml", re.ASCII)


def test_every_file_is_part_of_the_package() -> None:
    """What pyproject.toml says goes into the wheel matches each of them, and nothing is beside."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    setuptools = tomllib.loads(text)["tool"]["setuptools"]
    package = ROOT / "garkcli"
    packed: set[Path] = set()
    for pattern in setuptools["package-data"]["garkcli"]:
        packed.update(package.glob(pattern))
    assert FILES
    assert set(FILES) <= packed
    assert {x for x in DATA.rglob("*") if x.is_file()} == set(FILES)


def test_names_are_such_as_people_type() -> None:
    """Lower case, words joined by hyphens, each name once."""
    names = [path.name for path in FILES]
    assert [x for x in names if not NAME.fullmatch(x)] == []
    assert len(names) == len(set(names))
    assert {path.parent.parent for path in FILES} == {DATA}


@pytest.mark.parametrize("copy", COPIES, ids=lambda x: x.name)
def test_the_methods_beside_the_package_are_copies(copy: Path) -> None:
    """``methods/`` is what a reader of the repository works with: the same files, byte by byte."""
    (original,) = [path for path in FILES if path.name == copy.name]
    assert copy.read_bytes() == original.read_bytes()


def test_a_name_or_alias_means_one_method() -> None:
    """However it is spelt: nobody is asked which of two was meant."""
    index = ROOT / "garkcli" / "catalogue" / "index.json"
    methods = json.loads(index.read_text(encoding="utf-8"))["methods"]
    meant: dict[str, set[str]] = {}
    for method in methods:
        for name in (method["name"], *method["aliases"]):
            meant.setdefault(key_of(name), set()).add(method["name"])
    assert [name for name, those in meant.items() if len(those) > 1] == []
