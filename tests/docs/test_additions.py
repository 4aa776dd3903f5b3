"""The six most likely additions, made in a copy of the package as CONTRIBUTING.md says: nothing
besides is touched, and every command has them.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

import garkcli
from tests.cli.harness import ROOT
from tests.whole import in_whole

PACKAGE = Path(garkcli.__file__).parent
RK4 = "A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]\nb: [1/6, 1/3, 1/3, 1/6]\n"

SCRIPT = """
import contextlib, io, json, sys
from garkcli.cli import main
printed = []
for command in sys.argv[1:]:
    with contextlib.redirect_stdout(io.StringIO()) as out:
        try:
            main(command.split())
        except SystemExit as end:
            assert not end.code, (command, end.code)
    printed.append(out.getvalue())
print(json.dumps(printed))
"""
"""Runs commands, one after the other."""


class Copy:
    """A copy of the package, and its command."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        # with the byte code of what stays as it is, but for that of pytest
        unused = shutil.ignore_patterns("*-pytest-*")
        shutil.copytree(PACKAGE, folder / "garkcli", ignore=unused)
        (folder / "m.yaml").write_text(RK4)

    def write(self, path: str, text: str) -> None:
        """A new file."""
        file = self.folder / path
        assert not file.exists()
        file.write_text(text, encoding="utf-8")

    def insert(self, path: str, before: str, text: str) -> None:
        """A line of a list, or what else is new in a file, before what is there."""
        file = self.folder / path
        old = file.read_text(encoding="utf-8")
        assert old.count(before) == 1, before
        file.write_text(old.replace(before, text + before), encoding="utf-8")

    def gark(self, *commands: str) -> list[str]:
        """What each command prints, all in one process; each must succeed."""
        variables: Mapping[str, str] = {
            **os.environ, "PYTHONPATH": str(self.folder), "COLUMNS": "80", "PYTHONUTF8": "1",
        }  # fmt: skip
        run = subprocess.run(
            [sys.executable, "-c", SCRIPT, *commands],
            cwd=self.folder, env=variables, capture_output=True, encoding="utf-8", check=False,
        )  # fmt: skip
        assert run.returncode == 0, f"{commands}: {run.stderr}"
        printed: list[str] = json.loads(run.stdout)
        return printed


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    """The package as it is."""
    return Copy(tmp_path)


def row(what: str) -> str:
    """The row of the table on what is added, without the column of tests."""
    lines = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").splitlines()
    [found] = [line for line in lines if line.startswith(f"| {what} ")]
    return found.rpartition("| `tests/")[0]


@in_whole
def test_a_family_is_one_file(copy: Copy) -> None:
    """Method files, the list, the explanation, the schema and the suggestion have it."""
    assert "`garkcli/families/NAME.py`" in row("family of methods")
    copy.write(
        "garkcli/families/gaussian.py",
        '"""Gauss methods by another name."""\n\n'
        "from garkcli.families.family import of_stages\n"
        "from garkcli.families.collocation import gauss\n\n"
        'FAMILIES = (of_stages("gaussian", gauss, 1, "2s", "of a test"),)\n',
    )
    copy.write("two.yaml", "methods: [{family: gaussian, stages: 2}]\nexpect: {order: 4}\n")
    checked, listed, explained, schema = copy.gark(
        "check two.yaml", "list families", "explain gaussian", "schema"
    )
    assert "order 4, proved" in checked
    assert "gaussian" in listed
    assert "Of a test" in explained
    assert '"gaussian"' in schema


@in_whole
def test_a_property_is_a_function_and_a_word(copy: Copy) -> None:
    """Reports, claims, the catalogue, its filters, comparisons and explanations have it."""
    assert "`garkcli/properties/claimed`" in row("property, which files may claim")
    file = copy.folder / "garkcli/properties/claimed/solving.py"
    file.write_text(
        file.read_text(encoding="utf-8") + '\n\n@claimed("this test", asks="signs")\n'
        "def few_stages(subject: Subject) -> Verdict:\n"
        '    """The first method has at most four stages."""\n'
        "    return Verdict(len(subject.tableau.colours[0].b) <= 4)\n",
        encoding="utf-8",
    )
    copy.insert("garkcli/properties/registry.py", "explicit diagonally-implicit", "few-stages ")
    copy.write("claim.yaml", RK4 + "expect: {few-stages: true}\n")
    claimed, told, data, explained, entry, listed, schema, _ = copy.gark(
        "check claim.yaml",
        "check m.yaml -v",
        "check m.yaml --format json",
        "explain few-stages",
        "show rk4 --format json",
        "list methods --few-stages",
        "schema",
        "report m.yaml -o page.html",
    )
    assert "claim holds" in claimed
    assert "few-stages" in told.replace(" ", "-")
    [checked] = json.loads(data)["files"]
    assert checked["properties"]["few_stages"] is True
    assert "at most four stages" in explained
    assert "few_stages" in json.loads(entry)["undecided"]
    assert "rk4" not in listed
    assert "few-stages" in schema
    assert "few" in (copy.folder / "page.html").read_text(encoding="utf-8")


@in_whole
def test_a_target_is_a_file_and_a_template(copy: Copy) -> None:
    """The list and the export have it."""
    assert "found by itself" in row("target of `gark export`")
    copy.write(
        "garkcli/bridges/targets/weights.py",
        '"""The weights alone."""\n\n'
        "from garkcli.bridges.registry import Bridge\n\n"
        'BRIDGES = (Bridge("weights", "the weights alone", ".tsv"),)\n',
    )
    copy.write("garkcli/bridges/templates/weights.tsv.jinja", "{{ row('b = ', b[0], '') }}\n")
    listed, exported = copy.gark("list exports", "export m.yaml --to weights")
    assert "weights" in listed
    assert "b = " in exported


@in_whole
def test_a_problem_is_an_entry(copy: Copy) -> None:
    """The list and every command that runs problems have it."""
    assert "`garkcli/problems/builtin.py`" in row("problem")
    copy.insert(
        "garkcli/problems/builtin.py",
        '    mechanical(\n        "henon-heiles",',
        "    mechanical(\n"
        '        "swing", "a pendulum by another name", "½p² + 1 − cos q", _ALTERNATING,\n'
        '        Mechanical(("x",), pendulum_potential, numbers("1 1/2"), fmpq(4)),\n    ),\n',
    )
    listed, converged, followed = copy.gark(
        "list problems",
        "converge m.yaml --problem swing",
        "energy m.yaml --problem swing --t-end 40 --format json",
    )
    assert "swing" in listed
    assert "they agree" in converged
    assert "swing" in followed


@in_whole
def test_a_format_of_check_is_a_function_and_a_line(copy: Copy) -> None:
    """The option has it."""
    assert "`garkcli/report/check_formats.py`" in row("format of `gark check`")
    file = copy.folder / "garkcli/report/check_findings.py"
    file.write_text(
        file.read_text(encoding="utf-8") + "\n\ndef names(outcomes: Sequence[Outcome]) -> str:\n"
        '    """A line a file."""\n'
        '    return "".join(f"file {x.file}\\n" for x in outcomes)\n',
        encoding="utf-8",
    )
    copy.insert("garkcli/report/check_formats.py", '"junit", "github")', '"names", ')
    checked, told = copy.gark("check m.yaml --format names", "check --help")
    assert checked == "file m.yaml\n"
    assert "names" in told


@in_whole
def test_a_warning_is_an_entry_and_a_line(copy: Copy) -> None:
    """Every format, the page and the explanation have it; nothing fails."""
    assert "`garkcli/check/findings.py`" in row("warning or hint about a method file")
    copy.insert(
        "garkcli/glossary/data/findings.toml",
        "[audit.order]",
        '[check.four-stages]\ntext = "The method has four stages."\ncure = "Take three."\n\n',
    )
    copy.insert(
        "garkcli/check/findings.py",
        "    for text in filter(is_lost,",
        "    if outcome.analysis and len(outcome.analysis.tableau.colours[0].b) == 4:\n"
        '        yield _warning("four-stages", "there are four stages")\n',
    )
    formats = ("text", "json", "sarif", "junit", "github", "markdown", "latex")
    told = copy.gark(
        *(f"check m.yaml --format {x}" for x in formats),
        *("check m.yaml m.yaml", "check m.yaml m.yaml --format markdown", "explain four-stages"),
        "report m.yaml -o page.html",
    )
    page = (copy.folder / "page.html").read_text(encoding="utf-8")
    for text in (*told[:-2], page):
        assert "four-stages" in text
        assert "there are four stages" in text
        assert "take three" in text
    assert "Take three." in told[-2]
