"""Everything a command does is a Python call: docs/python.md names it, and it says the same."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

import garkcli
from garkcli.cli.main import COMMANDS
from garkcli.cli.main import gark as group
from garkcli.errors import MethodError
from tests.cli.harness import gark

ROOT = Path(__file__).resolve().parents[2]
CALLS = re.compile(r"^\| `([a-z]+)` \| (.*) \|$", re.MULTILINE)
OF_OBJECTS = {"A", "b", "c", "_repr_latex_", "--write"}
"""Words of the table that are attributes of methods, or an option."""


def calls() -> dict[str, list[str]]:
    """The calls of each command, as the page has them."""
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    part = page.partition("## Commands as calls")[2].partition("\n## ")[0]
    return {
        command: re.findall(r"`([^`]+)`", text)
        for command, text in CALLS.findall(part)
        if command != "gark"  # the head of the table
    }


def test_every_command_has_its_calls() -> None:
    """The table has the commands, in their order or another, and only public names."""
    table = calls()
    assert set(table) == set(COMMANDS)
    for command, names in table.items():
        public = [name for name in names if name not in OF_OBJECTS]
        assert public, command
        assert set(public) <= set(garkcli.__all__), command
        for name in public:
            value = getattr(garkcli, name)
            assert callable(value) or name == "catalogue"


def options() -> Iterator[tuple[str, str]]:
    """Every command with each of its options."""
    context = click.Context(group)
    for name in COMMANDS:
        command = group.get_command(context, name)
        assert command is not None
        for option in command.params:
            if isinstance(option, click.Option):
                yield name, "/".join(option.opts)


def rows() -> list[tuple[set[str], set[str], str]]:
    """The table of options: options, commands, and what they are in Python."""
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    part = page.partition("## Options as arguments")[2].partition("\n## ")[0]
    found = []
    for line in part.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if len(cells) == 3 and not cells[0].startswith(("option", "---")):
            told = set(re.findall(r"`(-[\w-]+)`", cells[0]))
            if "filters" in cells[0]:
                told |= {x for of, y in options() if of == "list" for x in y.split("/")}
            found.append((told, set(cells[1].split(", ")), cells[2]))
    return found


def test_every_option_is_an_argument() -> None:
    """The page says of each option of each command what it is in Python, and names no other."""
    table = rows()
    known = set(options())
    for command, option in known:
        assert any(
            told & {*option.split("/")} and of & {command, "every command"} for told, of, _ in table
        ), f"gark {command} {option}"
    for told, of, python in table:
        named = of - {"every command"}
        assert named <= set(COMMANDS)
        every = {x for of, y in known if of in (named or {of}) for x in y.split("/")}
        assert told <= every, told - every
        for call in re.findall(r"`(\w+)\(", python):
            assert call in garkcli.__all__, call


def shown(*arguments: str) -> str:
    """What a command writes."""
    result = gark(*arguments)
    assert result.code in (None, 0), result.err
    return result.out


def test_texts_are_those_of_the_commands() -> None:
    """Exports, certificates, references and schemas, to the letter."""
    rk4 = garkcli.load("rk4")
    assert garkcli.export("rk4", "csv") == shown("export", "rk4", "--to", "csv")
    assert garkcli.export(rk4, "csv") == garkcli.export("rk4", "csv")
    assert garkcli.certificate(rk4) == shown("certificate", "rk4")
    cited = shown("cite", "rk4", "--format", "text")
    assert garkcli.cite(rk4, format="text") == cited
    for option, schema in (
        ((), garkcli.method_file_schema()),
        (("--problem",), garkcli.problem_file_schema()),
        (("--sweep",), garkcli.sweep_schema()),
        (("--report", "check"), garkcli.report_schema("check")),
    ):
        assert json.loads(shown("schema", *option)) == schema


def test_claims_are_those_that_are_written(tmp_path: Path) -> None:
    """``with_claims`` is the file after ``gark claims --write``."""
    text = "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n"
    path = tmp_path / "a.gark.yaml"
    path.write_text(text, encoding="utf-8")
    method = garkcli.load(str(path))
    shown("claims", str(path), "--write")
    written = path.read_text(encoding="utf-8")
    assert garkcli.with_claims(method) == written
    assert garkcli.check_file(str(path)).ok
    assert all(f"  {key}: {value}\n" in written for key, value in garkcli.claims_of(method).items())
    with pytest.raises(MethodError, match="no text"):
        garkcli.with_claims(method.conjugate)  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="no method file"):
        garkcli.export(method.tableau, "csv")


def test_trees_are_those_that_are_listed() -> None:
    """In the same order, and as many as are counted."""
    listed = shown("trees", "-n", "4", "--colours", "2", "--format", "csv")
    trees = list(garkcli.all_trees(4, colours=2))
    assert len(trees) == garkcli.count_trees(2, 4) == 52
    lines = listed.splitlines()[1:]
    assert len(lines) == len(trees)
    for tree, line in zip(trees, lines, strict=True):
        assert garkcli.format_tree(tree) in line


def test_conditions_are_those_of_the_tableau() -> None:
    """All of order 4 hold for the classical method, and not all of order 5."""
    rk4 = garkcli.load("rk4")
    assert all(not x.residual for x in garkcli.all_conditions(rk4, 4))
    assert any(x.residual for x in garkcli.all_conditions(rk4, 5))


def test_stability_is_that_of_the_report() -> None:
    """Exactly, and within the tolerance of the method."""
    gauss = garkcli.diagonal_method("gauss", 2)
    assert garkcli.find_stability(gauss).linear[0].a_stable
    assert not garkcli.find_stability(garkcli.load("rk4")).linear[0].a_stable
    rounded = garkcli.from_arrays([[0.5]], [1], tolerance="1e-9")
    found = garkcli.find_stability(rounded)
    assert found.tableau == rounded.tableau


def test_sources_are_read_and_audited(tmp_path: Path) -> None:
    """What was exported comes back as the same method, and nothing is wrong with it."""
    path = tmp_path / "rk4.csv"
    path.write_text(garkcli.export("rk4", "csv"), encoding="utf-8")
    (found,) = garkcli.import_methods(str(path))
    assert found.tableau == garkcli.load("rk4").tableau
    (again,) = garkcli.import_methods(str(path), format="csv")
    assert again.tableau == found.tableau
    (audited,) = garkcli.audit([str(path)])
    assert not audited.has_errors


def test_names_are_those_that_are_listed() -> None:
    """Each stands in the list that the command prints, and each word is explained."""
    listed = shown("list") + shown("list", "exports")
    names = garkcli.names()
    for kind in ("families", "transfer", "problems", "exports"):
        assert names[kind]
        for name in names[kind]:
            assert name in listed
    word = names["words"][0]
    assert garkcli.explain(word)[0].text


def test_a_sweep_runs_and_goes_on(tmp_path: Path) -> None:
    """Its rows are written, and a second run has nothing left to do."""
    spec = tmp_path / "s.yaml"
    spec.write_text(
        "methods:\n  - {family: gauss, stages: [1, 2]}\ncolumns: [order]\n", encoding="utf-8"
    )
    rows = str(tmp_path / "rows.jsonl")
    report = garkcli.run_sweep(str(spec), rows)
    assert [row["order"] for row in report.done] == [2, 4]
    again = garkcli.run_sweep(str(spec), rows, is_resumed=True)
    assert again.done == report.done
