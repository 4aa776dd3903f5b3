"""The public names: one table, of which the stub for type checkers is made."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable
from importlib import import_module
from inspect import signature
from pathlib import Path

import pytest

import garkcli
from garkcli.upward import Shown, answered
from tests.cli.harness import gark

STUB = Path(garkcli.__file__).with_suffix(".pyi")
CATALOGUE = "catalogue"


def stub() -> str:
    """Every public name from its home, as type checkers read it."""
    homes = {name: home for name, home in garkcli.HOMES.items() if name != home}
    homes |= {"Catalogue": "catalogue.mapping", "__version__": "version"}
    lines = [
        "# made from the table in __init__.py by GARK_UPDATE_SNAPSHOTS=1 pytest tests/api",
        *sorted(f"from garkcli.{home} import {name} as {name}" for name, home in homes.items()),
        "",
        "NAMES: dict[str, dict[str, str]]",
        "HOMES: dict[str, str]",
        "ANSWERS: dict[str, str]",
        "__all__: list[str]",
        f"{CATALOGUE}: Catalogue",
    ]
    return "\n".join(lines) + "\n"


def test_the_stub_is_made_from_the_table() -> None:
    """Type checkers see what the package has, from where it is."""
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        STUB.write_text(stub(), encoding="utf-8")
    assert STUB.read_text(encoding="utf-8") == stub()


def test_no_name_is_listed_twice() -> None:
    """Each public name has one home and one topic."""
    names = [
        name for homes in garkcli.NAMES.values() for some in homes.values() for name in some.split()
    ]
    assert len(names) == len(set(names)) == len(garkcli.__all__)


@pytest.mark.parametrize("room", garkcli.ANSWERS)
def test_what_answers_is_there(room: str) -> None:
    """Each function of the table takes a value of the class that it is for."""
    module = import_module(f"garkcli.{room}")
    for answer in garkcli.ANSWERS[room].split():
        question, _, name = answer.partition("=")
        function = getattr(module, name)
        (first, *_) = signature(function).parameters.values()
        kind = question.partition(".")[0]
        takes = str(first.annotation)
        assert kind in takes or takes in {"AnyMethod", "Any", "AnyOrder", "Number", "object"}, (
            answer
        )


def test_what_nobody_answers_is_nothing() -> None:
    """A value of which there is no picture has none."""
    assert answered(Shown(), "svg") is None
    assert Shown()._repr_html_() is None


RESULTS: list[Callable[[], object]] = [
    lambda: garkcli.find_order("rk4"),
    lambda: garkcli.find_order("rk4").witness,
    lambda: garkcli.find_order("ark-324"),
    lambda: garkcli.analyse("heun"),
    lambda: garkcli.check_file("rk4"),
    lambda: garkcli.compare("rk4", "heun"),
    lambda: garkcli.convert("heun"),
    lambda: garkcli.find_property("rk4", "a-stable"),
    lambda: garkcli.find_stability("heun"),
    lambda: garkcli.find_stability("heun").linear[0],
    lambda: garkcli.hamiltonian("kepler"),
    lambda: garkcli.prove_method("heun"),
    lambda: garkcli.simplifying("rk4"),
    lambda: next(garkcli.conditions("rk4", ["[[]]"])),
]
"""Results of functions, one of each class."""


def test_help_has_an_example() -> None:
    """``help`` of every public name, and of what functions return, shows how it is used."""
    public = [getattr(garkcli, name) for name in garkcli.__all__]
    public += [type(result()) for result in RESULTS]
    assert [x for x in public if ">>>" not in (inspect.getdoc(x) or "")] == []


def test_trees_are_written_as_the_commands_write_them() -> None:
    """Without colours for one colour, with them for several; both are read again."""
    witness = garkcli.find_order("rk4").witness
    assert witness is not None
    shown = gark("check", "rk4").out
    assert f"fails at {witness.tree} by" in shown
    assert str(witness.tree) == "[[[[[]]]]]"
    of_two = garkcli.parse_tree("[[]_2]_1")
    assert str(of_two) == "[[]_2]_1"
    assert garkcli.parse_tree(str(witness.tree)) == witness.tree
    lines = [line.split() for line in gark("trees", "3").out.splitlines()]
    written = [cells[0] for cells in lines if cells and cells[0].startswith("[")]
    assert [str(u) for u in garkcli.trees(3)] == written
