"""The index of the package: made from the files as they are, and the same wherever it is made."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from garkcli import catalogue
from garkcli.catalogue import facts
from garkcli.catalogue.facts import NoMethod, digest, entry_of, made, method_files, update_copies
from garkcli.methodfile.load import described
from garkcli.methodfile.naming import every_shelf
from garkcli.methodfile.shelves import Package
from tests.cli.harness import gark
from tests.whole import sample

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "garkcli" / "catalogue" / "data"
INDEX = ROOT / "garkcli" / "catalogue" / "index.json"
FILES = dict(method_files(DATA))
TEXT = INDEX.read_text(encoding="ascii")
ENTRIES: dict[str, dict[str, Any]] = {entry["name"]: entry for entry in json.loads(TEXT)["methods"]}
GAUSS = "methods: [{family: gauss, stages: 1}]\nexpect: {order: 2}\n"
MAKE = "run make catalogue"


def put(folder: Path, name: str, text: str) -> Path:
    """A method file of a catalogue."""
    path = folder / "irk" / f"{name}.gark.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def test_it_is_made_from_the_files_as_they_are() -> None:
    """Each has its entry, made from its text; nothing else is in the index."""
    assert list(ENTRIES) == sorted(FILES), MAKE
    for name, path in FILES.items():
        entry = ENTRIES[name]
        text = path.read_text(encoding="utf-8")
        assert entry["digest"] == digest(text), f"{name} has changed: {MAKE}"
        assert entry["file"] == path.relative_to(DATA).as_posix()
    assert json.loads(TEXT)["facts"] == facts.VERSION, MAKE


def test_it_says_what_the_files_claim() -> None:
    """Claims are checked elsewhere; of some files what is claimed is in the index as found."""
    compared = 0
    some = sample(list(FILES.items())[::10], 3)
    for name, path in some:
        text = path.read_text(encoding="utf-8")
        _, description = described(text, name, {})
        assert ENTRIES[name]["aliases"] == list(description.aliases)
        for claim in description.claims:
            found = ENTRIES[name].get(claim.key.replace("-", "_"))
            if type(claim.value) is type(found):
                assert claim.value == found, (name, claim.key)
                compared += 1
    assert compared > len(some) / 2


def test_unchanged_entries_are_kept_and_the_rest_judged(tmp_path: Path) -> None:
    """Made anew or brought up to date, the text is the same."""
    judged: list[str] = []
    put(tmp_path, "one", GAUSS)
    first = made(tmp_path, "", judged.append)
    put(tmp_path, "two", GAUSS.replace("stages: 1", "stages: 2").replace("order: 2", "order: 4"))
    put(tmp_path, "one", GAUSS.replace("\n", "\r\n"))
    second = made(tmp_path, first, judged.append)
    assert judged == ["one", "two"]
    assert second == made(tmp_path, "", judged.append)
    entry = json.loads(second)["methods"][1]
    assert (entry["order"], entry["stages"], entry["kind"]) == (4, 2, "rk")
    assert entry["a_stable"] is True
    assert entry["error_constant"] == f"{float(entry['error_constant']):.4g}"


def test_an_index_without_a_property_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """What an older index does not know is not decided: null in JSON, and no filter takes it."""
    older = {name: dict(entry) for name, entry in ENTRIES.items()}
    for entry in older.values():
        del entry["fsal"]
    package = next(x for x in every_shelf() if isinstance(x, Package))
    monkeypatch.setattr(package, "entries", older)
    listed = json.loads(gark("list", "methods", "--format", "json").out)
    assert len(listed) == len(older)
    assert all(entry["fsal"] is None and "fsal" in entry["undecided"] for entry in listed)
    for wish in ("--fsal", "--no-fsal"):
        assert json.loads(gark("list", "methods", wish, "--format", "json").out) == []
    shown = gark("show", "dormand-prince-5", "--format", "json")
    assert (shown.code, json.loads(shown.out)["fsal"]) == (0, None)
    assert re.search(r"not decided +.*fsal", gark("show", "dormand-prince-5").out)
    assert "dormand-prince-5" in catalogue.search(explicit=True)
    assert catalogue.search(fsal=True) == []


def test_an_index_without_a_property_is_made_anew(tmp_path: Path) -> None:
    """Each entry that lacks one is judged again, though its file is as it was."""
    put(tmp_path, "one", GAUSS)
    first = made(tmp_path, "", lambda _: None)
    older = json.loads(first)
    del older["methods"][0]["fsal"]
    judged: list[str] = []
    assert made(tmp_path, json.dumps(older), judged.append) == first
    assert judged == ["one"]


def test_another_version_of_the_facts_makes_all_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the program finds more than it did."""
    put(tmp_path, "one", GAUSS)
    before = made(tmp_path, "", lambda _: None)
    monkeypatch.setattr("garkcli.catalogue.facts.VERSION", 0)
    judged: list[str] = []
    made(tmp_path, before, judged.append)
    assert judged == ["one"]


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("bad", "A: [[0]]", "b missing"),
        ("wrong", GAUSS.replace("order: 2", "order: 3"), "expected 3, found 2"),
        ("open", "parameters: {t: free}\nA: [[t]]\nb: [1]", "free parameters"),
        ("Capital", GAUSS, "not named as methods are; capital.gark.yaml"),
        ("under_score", GAUSS, "under-score.gark.yaml"),
    ],
)
def test_what_is_no_method_has_no_place(tmp_path: Path, name: str, text: str, message: str) -> None:
    """A catalogue with a claim that fails is not made."""
    put(tmp_path, name, text)
    with pytest.raises(NoMethod) as caught:
        made(tmp_path, "", lambda _: None)
    assert message in str(caught.value)


def test_one_name_is_one_method(tmp_path: Path) -> None:
    """Two folders cannot both have it."""
    put(tmp_path, "one", GAUSS)
    put(tmp_path / "more", "one", GAUSS)
    with pytest.raises(NoMethod, match="have one name"):
        method_files(tmp_path)


def test_copies_follow_their_originals(tmp_path: Path) -> None:
    """Only files that are called as a method of the catalogue, and only where they differ."""
    original = put(tmp_path / "data", "one", GAUSS)
    copy = put(tmp_path / "copies", "one", "old")
    other = put(tmp_path / "copies", "mine", "my own")
    changed = update_copies(tmp_path / "data", tmp_path / "copies")
    assert list(changed) == [copy]
    assert copy.read_bytes() == original.read_bytes()
    assert other.read_text() == "my own"
    again = update_copies(tmp_path / "data", tmp_path / "copies")
    assert list(again) == []


@pytest.mark.parametrize("name", ["rk4", "rectangular", "ark-ars222"])
def test_an_entry_is_what_is_found_today(name: str) -> None:
    """Judged again, some methods of different kinds have the entries that they have."""
    path = FILES[name]
    text = path.read_text(encoding="utf-8")
    file = path.relative_to(DATA).as_posix()
    assert entry_of(str(path), name, file, text) == ENTRIES[name]
