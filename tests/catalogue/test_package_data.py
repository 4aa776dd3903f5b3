"""The method files of the package: that they are in it, what they are called, what else has them."""

from __future__ import annotations

import json
import re
import tomllib
from fractions import Fraction
from math import factorial
from pathlib import Path

import pytest
import yaml

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


def test_hyphens_do_not_choose_the_method() -> None:
    """Nor other signs: ``SDIRK2`` is ``sdirk-2``. But ``RadauIIA5`` has order 5 where people know
    it from, with three stages.
    """
    index = ROOT / "garkcli" / "catalogue" / "index.json"
    methods = json.loads(index.read_text(encoding="utf-8"))["methods"]
    meant: dict[str, set[str]] = {}
    for method in methods:
        for name in (method["name"], *method["aliases"]):
            letters = re.sub(r"[^a-z0-9*]", "", name.casefold())
            meant.setdefault(letters, set()).add(method["name"])
    several = {name for name, those in meant.items() if len(those) > 1}
    assert several == {"radauiia5"}


def test_merson_is_as_printed() -> None:
    """Its second row of weights has order 5 for linear problems, for which it is called 4("5"), and
    its estimate is Merson's (2 k1 - 9 k3 + 8 k4 - k5)/30.
    """
    text = (DATA / "erk" / "merson-4.gark.yaml").read_text(encoding="utf-8")
    file = yaml.load(text, yaml.BaseLoader)
    weights = [Fraction(x) for x in file["b"]]
    embedded = [Fraction(x) for x in file["embedded"]]
    of_stages = [Fraction(1)] * 5
    for order in range(1, 6):
        sums = zip(embedded, of_stages, strict=True)
        assert sum(b * k for b, k in sums) == Fraction(1, factorial(order))
        rows = [[Fraction(x) for x in row] for row in file["A"]]
        of_stages = [
            sum((a * k for a, k in zip(row, of_stages, strict=False)), Fraction()) for row in rows
        ]
    pairs = zip(weights, embedded, strict=True)
    assert [30 * (b - e) for b, e in pairs] == [2, 0, -9, 8, -1]
