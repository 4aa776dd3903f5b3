"""``gark list methods``: what is in the list, what is left out, and how it looks."""

from __future__ import annotations

import csv
import io
import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from garkcli.catalogue.entries import ORDERS, NumberRange, all_entries, read_range, sorted_by
from garkcli.cli.command import command_of
from garkcli.errors import UsageProblem
from garkcli.methodfile.file_keys import KEYS
from garkcli.properties.subject import every_property
from garkcli.report.methods import KEYS_OF_KINDS
from tests.cli.harness import gark

HALF = "name: Halves\nA: [[1/2]]\nb: [1]\n"
Entry = dict[str, Any]


def listed(*arguments: str) -> list[Entry]:
    """The methods of a list, as programs get them."""
    run = gark("list", "methods", *arguments, "--format", "json")
    assert run.code == 0, run.err
    found: list[Entry] = json.loads(run.out)
    return found


def names(*arguments: str) -> set[str]:
    """Their names."""
    return {entry["name"] for entry in listed(*arguments)}


EVERY = {entry["name"]: entry for entry in all_entries()}
FILTERS: dict[str, Callable[[Entry], bool]] = {
    "--order >=4": lambda x: x["order"] >= 4,
    "--order 2..3": lambda x: 2 <= x["order"] <= 3,
    "--nonautonomous-order <=2": lambda x: (
        x["nonautonomous_order"] is not None and x["nonautonomous_order"] <= 2
    ),
    "--stages <3": lambda x: x["stages"] < 3,
    "--colours 2": lambda x: x["colours"] == 2,
    "--stage-order 1": lambda x: x["stage_order"] == 1,
    "--symplectic": lambda x: x["symplectic"] is True,
    "--no-symplectic": lambda x: x["symplectic"] is False,
    "--explicit": lambda x: x["explicit"] is True,
    "--l-stable": lambda x: x["l_stable"] is True,
    "--no-a-stable": lambda x: x["a_stable"] is False,
    "--kind ark": lambda x: x["kind"] == "ark",
    "--structure separable": lambda x: x["structure"] == "separable",
    "--folder found": lambda x: x["file"].startswith("found/"),
    "--explicit --order 4 --kind rk": lambda x: (
        x["explicit"] and x["order"] == 4 and x["kind"] == "rk"
    ),
}


@pytest.mark.parametrize("options", FILTERS)
def test_a_filter_takes_those_and_no_others(options: str) -> None:
    """Compared with a condition on the whole list; what is null is never taken."""
    found = names(*options.split())
    holds = FILTERS[options]
    assert found == {name for name, entry in EVERY.items() if holds(entry)}
    assert found
    assert found != set(EVERY)


def test_every_property_has_its_filter() -> None:
    """A property more is a filter more: truths with their opposite, counts as ranges."""
    options = {name for x in command_of("list").params for name in x.opts}
    opposites = {name for x in command_of("list").params for name in x.secondary_opts}
    for found in every_property():
        if found.kind != "number":
            assert f"--{found.key}" in options
        if found.kind == "truth":
            assert f"--no-{found.key}" in opposites


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("4", NumberRange(4, 4)),
        ("=4", NumberRange(4, 4)),
        (" >= 4 ", NumberRange(4, 10_000)),
        (">4", NumberRange(5, 10_000)),
        ("<=4", NumberRange(0, 4)),
        ("<4", NumberRange(0, 3)),
        ("2 .. 4", NumberRange(2, 4)),
    ],
)
def test_ranges(text: str, found: NumberRange) -> None:
    """As people write them."""
    assert read_range(text) == found


@pytest.mark.parametrize("text", ["", "four", ">", "4..", "-1", "4 5", "٤"])
def test_what_is_no_range(text: str) -> None:
    """It is refused, with the option that it was given to."""
    with pytest.raises(UsageProblem, match="neither a number nor a range"):
        read_range(text)
    run = gark("list", "methods", "--order", text)
    assert run.code == 2
    assert "'--order'" in run.err


def test_words_are_found_without_accents_and_in_references() -> None:
    """In names, aliases, titles and references, each of the words."""
    assert "stoermer-verlet" in names("stormer verlet")
    assert "stoermer-verlet" in names("STÖRMER")
    assert "ark-ars222" in names("ascher", "spiteri")
    assert names("ascher", "zanna") == set()
    run = gark("list", "methods", "ascher", "zanna")
    assert run.out == "no method of the catalogue matches\n"


@pytest.mark.parametrize("column", ORDERS)
def test_lists_are_sorted(column: str) -> None:
    """By what is asked for; what is not known comes last."""
    entries = listed("--sort", column)
    assert entries == sorted_by(list(EVERY.values()), column)
    key = "error_constant" if column == "error" else column
    known = [x[key] for x in entries if x[key] is not None]
    assert [x[key] is None for x in entries] == sorted(x[key] is None for x in entries)
    if column == "error":
        known = [float(x) for x in known]
    assert known == sorted(known, reverse=column == "order")


def test_methods_of_one_s_own_are_as_they_claim(tmp_path: Path) -> None:
    """Until they are judged; a family and a file that is no method are in the list too."""
    claims = "expect: {order: '>= 2', symplectic: true, gamma: 1/2}\n"
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "one.gark.yaml").write_text(HALF + claims)
    (tmp_path / "bad.gark.yaml").write_text("A: [")
    family = "parameters: {t: free}\nA: [[t]]\nb: [1]\naliases: [fam]\n"
    (tmp_path / "some.gark.yaml").write_text(family)
    here = ("--catalogue", str(tmp_path))
    found = {entry["name"]: entry for entry in listed(*here)}
    one = found["one"]
    assert (one["facts"], one["folder"]) == ("claimed", "sub")
    assert one["file"] == str(tmp_path / "sub" / "one.gark.yaml")
    assert (one["order"], one["symplectic"], one["gamma"]) == (2, True, "1/2")
    assert (one["stages"], one["a_stable"]) == (1, None)
    assert (found["bad"]["facts"], found["bad"]["kind"]) == ("unread", None)
    some = found["some"]
    assert (some["kind"], some["aliases"]) == ("family", ["fam"])
    assert set(found) == {*EVERY, "one", "bad", "some"}
    (judged,) = listed(*here, "--judge", "--folder", "sub")
    assert (judged["facts"], judged["a_stable"]) == ("found", True)
    assert judged["order"] == 2
    run = gark("list", "methods", *here, "halves")
    assert "2*" in run.out
    assert "*: as its file claims" in run.out


def test_what_is_hidden_is_not_listed(tmp_path: Path) -> None:
    """A name is in the list once, as the method that it means."""
    (tmp_path / "rk4.gark.yaml").write_text(HALF)
    found = [entry for entry in listed("--catalogue", str(tmp_path)) if entry["name"] == "rk4"]
    assert [entry["title"] for entry in found] == ["Halves"]


def test_the_text_fits_and_says_what_its_letters_mean() -> None:
    """80 columns, every letter of a row in the first lines."""
    run = gark("list", "methods", "--sort", "order")
    lines = run.out.splitlines()
    assert max(map(len, lines)) <= 80
    start = next(i for i, line in enumerate(lines) if line.startswith("  name"))
    legend = " ".join(lines[:start])
    head, rows = lines[start][2:], [x[2:] for x in lines[start + 1 :]]
    assert head.split()[:5] == ["name", "order", "stages", "kind", "type"]
    assert {row.split(" ")[0] for row in rows} - {""} == set(EVERY)
    place = head.index("is")
    marks = set("".join(row[place : place + 6].split(" ")[0] for row in rows))
    for mark in marks:
        assert f"{mark}: " in legend


def test_without_options_a_screen_has_all_kinds_with_their_numbers() -> None:
    """The numbers are those of the lists, and their sum is that of the title."""
    run = gark("list", "methods")
    title, head, *rows = run.out.splitlines()
    assert len(rows) <= 21
    assert max(map(len, run.out.splitlines())) <= 80
    assert max(map(len, gark("list", "methods", COLUMNS="60").out.splitlines())) <= 60
    place = head.index("methods")
    counts: Counter[str] = Counter()
    for row in rows[:-2]:
        counts[row.split()[0]] += int(row[place : place + len("methods")])
    assert counts == Counter(x["kind"] or "unread" for x in listed())
    assert title == f"{counts.total()} methods"


def test_a_table_with_a_wrong_node_has_its_mark() -> None:
    """The order alone would recommend a method of order 1 for y' = f(t, y)."""
    run = gark("list", "methods", "feagin", "--order", "12")
    marked = {line.split()[0] for line in run.out.splitlines() if " t~ " in line}
    assert marked == {"feagin-12-misprint"}
    assert "t: another order for y' = f(t, y)" in run.out


def test_csv_has_every_column() -> None:
    """With the names and the values of JSON, lists with a semicolon."""
    run = gark("list", "methods", "--format", "csv")
    rows = list(csv.DictReader(io.StringIO(run.out)))
    assert len(rows) == len(EVERY)
    for row in rows:
        entry = EVERY[row["name"]]
        assert set(row) == set(entry)
        assert row["order"] == str(entry["order"])
        symplectic = entry["symplectic"]
        assert row["symplectic"] == ("" if symplectic is None else str(symplectic).lower())
        assert row["stages_by_colour"] == "; ".join(map(str, entry["stages_by_colour"]))


def test_markdown_is_a_table() -> None:
    """Cells have no bar of their own, and the properties are words."""
    run = gark("list", "methods", "--format", "markdown", "-v", "stoermer-verlet")
    answer, _, head, rule, row = run.out.splitlines()[:5]
    assert answer == "**1 method**"
    assert head.count("|") == rule.count("|") == row.count("|") == 8
    assert "symplectic, symmetric" in row
    brief = gark("list", "methods", "--format", "markdown", "stoermer-verlet").out
    assert "S: symplectic, R: symmetric" in brief.splitlines()[0]


@pytest.mark.parametrize(
    "arguments",
    [
        ("list", "--order", "3"),
        ("list", "exports", "--symplectic"),
        ("list", "exports", "word"),
        ("list", "--format", "csv"),
    ],
    ids=" ".join,
)
def test_filters_are_for_methods(arguments: tuple[str, ...]) -> None:
    """What else is listed is short, and a filter of it would be passed over."""
    run = gark(*arguments)
    assert run.code == 2
    assert "gark list methods" in run.err


@pytest.mark.parametrize("key", [*KEYS_OF_KINDS])
def test_kinds_by_the_keys_of_files(key: str) -> None:
    """The key under which a file has such a method names the kind: there are methods of each."""
    assert key in {x.name for x in KEYS.values()}
    by_key, by_kind = (
        gark("list", "methods", "--kind", word).out for word in (key, KEYS_OF_KINDS[key])
    )
    assert by_key == by_kind
    assert not by_key.startswith("0 methods")
