"""What searches for the rounded methods of the catalogue start with: it is theirs, and not believed
where it is wrong.
"""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest
from flint import fmpq

from garkcli.catalogue.facts import digest, method_files
from garkcli.methodfile.load import load, loads
from garkcli.order import recovered
from garkcli.order.meant import as_meant, with_further
from garkcli.order.recovering import Recovery
from garkcli.order.rounded import RoundedTableau
from garkcli.order.rows import Label
from tests.whole import sample

DATA = Path(recovered.FILE).parents[1] / "catalogue" / "data"
PATHS = dict(method_files(DATA))
KEPT = recovered.kept()
NAMES = [x["method"] for x in KEPT.values() if "shifts" in x]


def search_of(name: str) -> Recovery:
    """A new search for a method of the catalogue."""
    rounded = with_further(as_meant(load(str(PATHS[name]))))
    assert isinstance(rounded, RoundedTableau)
    return rounded.search


def facts_of(search: Recovery) -> tuple[object, ...]:
    """What was found of the method and its embedded weights."""
    search.settled  # noqa: B018 -- it searches
    orders = [search.order_of(name, 20)[0] for name in ("method", "embedded")[: _rows(search)]]
    return orders, sorted(map(str, search.shape.get("method", {})))


def _rows(search: Recovery) -> int:
    return 1 if search.printed_further.embedded is None else 2


def test_it_is_of_the_files_as_they_are() -> None:
    """Each is made from the text of its method file."""
    for kept in KEPT.values():
        text = PATHS[kept["method"]].read_text(encoding="utf-8")
        assert kept["digest"] == digest(text), f"{kept['method']} has changed: run make catalogue"


@pytest.mark.parametrize("name", sample(NAMES, 12))
def test_a_search_starts_there(name: str) -> None:
    """The conditions that are kept vanish at the place, and nothing moves from there."""
    search = search_of(name)
    key, data = search.kept
    assert {**data, "method": name, "digest": KEPT[key]["digest"]} == KEPT[key]


@pytest.mark.parametrize("name", sample(NAMES, 40))
def test_a_search_from_the_print_finds_as_much(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Orders and shape are those of a search that knows nothing."""
    found = facts_of(search_of(name))
    monkeypatch.setattr(recovered, "_all", dict)
    assert facts_of(search_of(name)) == found


HEUN = "{A: [[0, 0], [0.667, 0]], b: [0.25, 0.75], tolerance: 1e-3}"
"""Ralston's method, and beside it all others of order 2."""


def heun() -> Recovery:
    """A search for a method with numbers a₂₁, b₁, b₂, in the order of the file."""
    rounded = as_meant(loads(HEUN))
    assert isinstance(rounded, RoundedTableau)
    return rounded.search


def known(search: Recovery, a: fmpq, shape: dict[Label, list[int]]) -> dict[str, dict[str, object]]:
    """A file that says that the method has a for a₂₁ and order 2, and some shape."""
    values = {fmpq(667, 1000): a, fmpq(1, 4): 1 - 1 / (2 * a), fmpq(3, 4): 1 / (2 * a)}
    exact = [(values[x] - x) / t for x, t in zip(search.box.numbers, search.box.radii, strict=True)]
    shifts = [fmpq((x * fmpq(1 << 400)).floor(), 1 << 400) for x in exact]
    return {recovered.key_of(search.box): recovered.as_data(shifts, {"method": shape}, {})}


def test_a_place_of_the_file_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of many methods of order 2 the one that the file has."""
    kept = known(heun(), fmpq(6671, 10000), {Label("B", 0, k=1): [0]})
    monkeypatch.setattr(recovered, "_all", lambda: kept)
    search = heun()
    place = search.settled
    assert search.order_of("method", 5)[0] == 2
    shift = place.shifts[search.box.numbers.index(fmpq(667, 1000))]
    assert abs(shift - fmpq(1, 10)) < fmpq(1, 10**100)


@pytest.mark.parametrize(
    ("a", "shape"),
    [
        pytest.param(fmpq(670, 1000), Label("B", 0, k=1), id="beyond-the-box"),
        pytest.param(fmpq(6671, 10000), Label("B", 0, k=3), id="a-shape-that-it-lacks"),
    ],
)
def test_a_wrong_place_is_not_taken(a: fmpq, shape: Label, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is beyond the box, or does not meet what it should, is left."""
    kept = known(heun(), a, {shape: [0]})
    monkeypatch.setattr(recovered, "_all", lambda: kept)
    search = heun()
    place = search.settled
    assert search.order_of("method", 5)[0] == 2
    assert place.is_inside
    shift = place.shifts[search.box.numbers.index(fmpq(667, 1000))]
    assert abs(shift - fmpq(1, 10)) > fmpq(1, 100)


def test_the_file_is_one_line_a_method() -> None:
    """A change of one method is a change of one line."""
    lines = recovered.FILE.read_text(encoding="ascii").splitlines()
    assert len(lines) == len(KEPT) + 2
    assert json.loads("{" + lines[1].rstrip(",") + "}")


@pytest.mark.parametrize("tolerance", ["1e-3", "digits"])
def test_another_process_has_the_same_method(tolerance: str) -> None:
    """A search that was sent has the numbers that it had found, and goes on from there."""
    text = HEUN.replace("1e-3", tolerance)
    method = as_meant(loads(text))
    assert isinstance(method, RoundedTableau)
    method.conjugate()
    place = method.search.settled
    sent: RoundedTableau = pickle.loads(pickle.dumps(method))
    assert sent.search.settled.shifts == place.shifts
    assert sent.near.colours == method.near.colours
    name = "conjugate of method"
    order, _, missed = sent.search.order_of(name, 4)
    assert (order, missed) == method.search.order_of(name, 4)[::2]
    again = with_further(pickle.loads(pickle.dumps(loads(text).tableau)))
    fresh = as_meant(loads(text))
    assert isinstance(fresh, RoundedTableau)
    if again is not None:
        assert again.search.box.numbers == fresh.search.box.numbers
