"""Everything a command does is a Python call: docs/python.md names it, and it says the same."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import garkcli
from garkcli.cli.command import declaration_of, parameter_of, told
from garkcli.cli.options import Option
from garkcli.cli.table import COMMANDS
from garkcli.errors import MethodError
from tests.cli.harness import gark
from tests.docs.tables import table
from tests.whole import in_whole

PAGE = Path(__file__).resolve().parents[2] / "docs" / "python.md"
COMMON = "every command"


def calls() -> str:
    """The table of commands."""
    rows = [(f"`{x}`", ", ".join(f"`{call}`" for call in row.calls)) for x, row in COMMANDS.items()]
    return table(("`gark`", "in Python"), [row for row in rows if row[1]]).rstrip()


def declared() -> Iterator[tuple[str, Option]]:
    """Every command with each of its options, without former ones."""
    for name in COMMANDS:
        for option in declaration_of(name).all_options:
            if not option.is_argument and not option.is_former:
                yield name, option


def arguments() -> str:
    """The table of options that are arguments of another name: a function a row."""
    found: dict[str, dict[str, None]] = {}
    for _, option in declared():
        if option.of:
            flag = option.key
            function, _, name = option.of.partition(".")
            is_same = flag.removeprefix("--").replace("-", "_") == name
            if not is_same:
                found.setdefault(function, {})[f"`{flag}` (`{name}=`)"] = None
    rows = [(f"`{x}`", ", ".join(sorted(options))) for x, options in sorted(found.items())]
    return table(("function", "options"), rows).rstrip()


@pytest.mark.parametrize("made", [calls, arguments], ids=lambda x: x.__name__)
def test_the_tables_are_made_of_the_one_of_calls(made: Callable[[], str]) -> None:
    """The page has what each command and each option is in Python."""
    text = PAGE.read_text(encoding="utf-8")
    begin, end = f"<!-- {made.__name__} -->\n", f"\n<!-- end of {made.__name__} -->"
    head, _, rest = text.partition(begin)
    found, _, tail = rest.partition(end)
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + begin + made() + end + tail, encoding="utf-8")
        return
    assert found == made()


def test_every_call_is_public() -> None:
    """The commands name what the package has."""
    for command, row in COMMANDS.items():
        assert set(row.calls) <= set(garkcli.__all__), command


def test_every_argument_is_one() -> None:
    """An option that is an argument names one of a public function, whose docstring tells it; and a
    flag that has no default of its own is not set there either.
    """
    for command, option in declared():
        if not option.of:
            continue
        function = option.of.partition(".")[0]
        assert function in garkcli.__all__
        parameter = parameter_of(option.of)
        assert option.help or told(option.of), (command, option)
        if option.is_flag and "flag_value" not in option.kind.settings:
            assert parameter.default is False, option


def test_what_is_no_argument_is_told() -> None:
    """The page says what the other options are in Python, and names no option that is not there."""
    page = PAGE.read_text(encoding="utf-8")
    part = page.partition("<!-- end of arguments -->")[2].partition("\n## ")[0]
    told_there = set()
    for line in part.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if len(cells) == 3 and not cells[0].startswith(("option", "---")):
            of = COMMANDS if cells[1] == COMMON else cells[1].split(", ")
            told_there |= {(x, y) for x in re.findall(r"`(-[\w-]+)`", cells[0]) for y in of}
            for call in re.findall(r"`(\w+)\(", cells[2]):
                assert call in garkcli.__all__, call
    others = [(option.flags, command) for command, option in declared() if not option.of]
    for flags, command in others:
        written = {x.partition("/")[0] for x in flags}
        assert any((x, command) in told_there for x in written), (command, flags)
    known = {x.partition("/")[0] for flags, _ in others for x in flags}
    assert {x for x, _ in told_there} <= known | {"-h", "--folder", "--sort", "--judge"}


def shown(*arguments: str) -> str:
    """What a command writes."""
    result = gark(*arguments)
    assert result.code in (None, 0), result.err
    return result.out


@in_whole
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
        (("--project",), garkcli.project_schema()),
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
    trees = list(garkcli.trees(4, colours=2))
    assert len(trees) == garkcli.count_trees(4, 2) == 52
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
    names = garkcli.names()
    for kind in ("families", "transfer", "problems", "exports"):
        assert names[kind]
        listed = shown("list", kind)
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
