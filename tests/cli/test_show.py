"""``gark show``: all about one method, out of the index or judged."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from garkcli.catalogue.entries import all_entries
from tests.cli.harness import gark

FILE = """
name: Heun
aliases: [heun 3]
description: A method that is well known.
reference: {authors: K. Heun, title: Neue Methoden, year: 1900, coefficients: as printed}
A: [[], [1/3], [0, 2/3]]
b: [1/4, 0, 3/4]
"""


@pytest.mark.parametrize("name", ["rk4", "RECTANGULAR", "ark-ars222"])
def test_a_method_of_the_package_is_as_in_the_list(name: str) -> None:
    """The same facts, with its tableau beside them as ``gark tableau`` has it."""
    shown = json.loads(gark("show", name, "--format", "json").out)
    entries = {entry["name"]: entry for entry in all_entries()}
    entry = entries[name.lower()]
    assert {key: shown[key] for key in entry} == entry
    tableau = json.loads(gark("tableau", name, "--format", "json").out)
    assert shown["tableau"] == tableau


def test_a_file_is_judged(tmp_path: Path) -> None:
    """It has no claims, and all is found; its reference has its fields."""
    (tmp_path / "heun.gark.yaml").write_text(FILE)
    run = gark("show", "heun.gark.yaml", "--format", "json", cwd=tmp_path)
    shown = json.loads(run.out)
    assert (shown["order"], shown["explicit"]) == (3, True)
    assert (shown["facts"], shown["catalogue"]) == ("found", "")
    assert shown["publication"]["year"] == "1900"
    by_name = gark("show", "heun", "--catalogue", str(tmp_path), "--format", "json")
    named = json.loads(by_name.out)
    assert (named["name"], named["order"]) == ("heun", 3)
    assert named["facts"] == "found"


def test_the_text_has_what_people_look_for(tmp_path: Path) -> None:
    """Tableau, orders, properties, aliases, reference; within 80 columns."""
    (tmp_path / "heun.gark.yaml").write_text(FILE)
    run = gark("show", "heun.gark.yaml", cwd=tmp_path)
    lines = run.out.splitlines()
    assert lines[0] == "Heun: order 3"
    assert max(map(len, lines)) <= 80
    told = dict(line[2:].split("  ", 1) for line in lines if "  " in line.strip())
    told = {label: text.strip() for label, text in told.items()}
    assert told["aliases"] == "heun 3"
    assert told["it is"] == "explicit, nodes-in-unit-interval"
    assert "symplectic" in told["it is not"]
    assert told["coefficients"] == "as printed"
    assert told["reference"] == "K. Heun, Neue Methoden, 1900"
    assert "2/3 |   0  2/3    0" in run.out


def test_values_of_parameters_are_judged() -> None:
    """With ``--set`` the index says nothing of the method."""
    run = gark(*("show", "ark-ars222", "--set", "g=1/2", "--format", "json"))
    shown = json.loads(run.out)
    assert shown["facts"] == "found"
    assert shown["gamma"] == "1/2"
    assert shown["order"] == 1


def test_a_family_has_no_one_tableau(tmp_path: Path) -> None:
    """It is told as everywhere."""
    (tmp_path / "f.gark.yaml").write_text("parameters: {t: free}\nA: [[t]]\nb: [1]\n")
    run = gark("show", "f.gark.yaml", cwd=tmp_path)
    assert run.code == 2
    assert "t" in run.err
