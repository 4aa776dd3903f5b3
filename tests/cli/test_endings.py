"""What a file gets is what its ending says: one rule for all commands."""

from __future__ import annotations

import csv
import json
import re
import shlex
from collections.abc import Callable, Mapping
from pathlib import Path

import click
import pytest

from garkcli.bridges.registry import bridges
from garkcli.bridges.texts import LANGUAGES
from garkcli.cli.command import command_of, declaration_of
from garkcli.cli.endings import ENDINGS
from garkcli.cli.table import COMMANDS, FORMER
from garkcli.methodfile.load import loads
from tests.cli.harness import Run, gark

SOURCE = "A = [[0, 0], [1/2, 0]]\nb = [0, 1]\nc = [0, 1/2]\n"
FAMILY = "parameters: {a: free}\nA: [[0, 0], [a, 0]]\nb: [0, 1]\ndesign: {order: 2}\n"
SWEEP = "methods: [{family: gauss, stages: 1..2}]\ncolumns: [order]\n"
FRONT = ("--order", "2", "--search", "3", "--front", "error", "coefficients")
"""What ``gark design`` writes as CSV."""
COMMANDS_WITH = {
    "check": ["rk4"],
    "show": ["rk4"],
    "list": ["methods", "heun"],
    "explain": ["order"],
    "cite": ["rk4"],
    "stability": ["rk4"],
    "conditions": ["-n", "2"],
    "trees": ["3"],
    "modified": ["heun", "-n", "2"],
    "converge": ["heun", "--problem", "oscillator", "--steps", "1/2,1/4"],
    "energy": ["heun", "--t-end", "1"],
    "tableau": ["rk4"],
    "conjugate": ["gauss-2"],
    "convert": ["rk4"],
    "reduce": ["rk4"],
    "diff": ["rk4", "kutta-38"],
    "design": ["family.yaml"],
    "sweep": ["spec.yaml", "--rows", "rows.jsonl"],
    "import": ["heun.py"],
    "audit": ["heun.py"],
    "claims": ["rk4"],
    "certificate": ["heun"],
    "schema": [],
    "plot": ["rk4"],
    "report": ["heun", "--no-pictures"],
    "new": ["--tableau", "0 | ; 1/2 | 1/2; | 0 1"],
}
"""Arguments with which commands do little."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a file for each command that takes one."""
    for name, text in (("heun.py", SOURCE), ("family.yaml", FAMILY), ("spec.yaml", SWEEP)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def formats_of(command: str) -> list[str]:
    """What ``--format`` of a command takes; empty where it has none."""
    kinds = {x.name: x.type for x in command_of(FORMER.get(command, (command,))[0]).params}
    kind = kinds.get("format")
    return [*kind.choices] if isinstance(kind, click.Choice) else []


HAS: Mapping[str, Callable[[str], object]] = {
    ".json": json.loads,
    ".csv": lambda text: len({len(row) for row in csv.reader(text.splitlines())}) == 1,
    ".jsonl": lambda text: [json.loads(x) for x in text.splitlines()],
    ".ndjson": lambda text: [json.loads(x) for x in text.splitlines()],
    ".sarif": lambda text: json.loads(text)["runs"],
    ".md": lambda text: re.search(r"^(\||\*\*|# \w)", text, re.MULTILINE),
    ".tex": lambda text: "\\" in text,
    ".html": lambda text: "<!doctype html>" in text.lower(),
    ".yaml": loads,
    ".bib": lambda text: "\n@article{" in text,
    ".xml": lambda text: text.startswith("<?xml"),
    ".v": lambda text: "Proof." in text,
    ".txt": lambda text: not text.startswith(("{", "<", "%", "@", "\\")),
}
"""What shows that a file is what its ending says."""


@pytest.mark.parametrize("command", COMMANDS_WITH)
def test_every_ending_at_every_command(command: str, folder: Path) -> None:
    """A file has what its ending says, without ``--format``; where the command has nothing of the
    kind nothing is written, and the cure names an ending.
    """
    formats = formats_of(command)
    for ending, shows in HAS.items():
        path = folder / f"made{ending}"
        front = FRONT if (command, ending) == ("design", ".csv") else ()
        run = gark(command, *COMMANDS_WITH[command], *front, "-o", path.name, cwd=folder)
        # a text holds what a command writes that has no other text
        held = ENDINGS.get(ending, ("text",) if "text" in formats else formats)
        if not {*held} & {*formats}:
            assert (run.code, path.exists()) == (2, False), (command, ending)
            assert "choose another ending: ." in run.err
            continue
        assert path.exists(), (command, ending, run.err)
        if ending in ENDINGS or "text" in formats:
            assert shows(path.read_text(encoding="utf-8")), (command, ending)
        for made in (path, folder / "rows.jsonl"):
            made.unlink(missing_ok=True)


def test_every_command_is_tried() -> None:
    """Those that take ``-o`` are in the list above; ``export`` and ``lsp`` have tests of their own."""
    takes = {name for name in COMMANDS if any(x.name == "output" for x in command_of(name).params)}
    assert takes - {"export", "lsp"} == {*COMMANDS_WITH} - {*FORMER}


def test_every_format_has_an_ending() -> None:
    """What commands and targets write has an ending that names it, but for what is made for logs."""
    held = {format for formats in ENDINGS.values() for format in formats}
    named = {format for command in COMMANDS for format in formats_of(command)}
    assert named - held == {"auto", "text", "github"}
    assert {x.lower() for x in LANGUAGES} <= {*ENDINGS}
    assert {x.suffix.lower() for x in bridges().values()} <= {*ENDINGS}


def refused(run: Run, path: Path, *words: str) -> bool:
    """Whether a run ended with these words and without a file."""
    return run.code == 2 and not path.exists() and all(word in run.err for word in words)


def test_a_format_that_its_file_contradicts(tmp_path: Path) -> None:
    """``--format`` and an ending that say two things; a text may hold any format, SARIF is JSON, and
    an ending that is not known says nothing.
    """
    asked = ("tableau", "rk4", "--format", "json", "-o")
    run = gark(*asked, "x.tex", cwd=tmp_path)
    assert refused(run, tmp_path / "x.tex", "json does not go into a .tex file", "--format")
    for name in ("x.txt", "x.JSON", "x", "x.out"):
        assert gark(*asked, name, cwd=tmp_path).code == 0
        assert json.loads((tmp_path / name).read_text(encoding="utf-8"))
    gark("tableau", "rk4", "-o", "y.JSON", cwd=tmp_path)
    assert json.loads((tmp_path / "y.JSON").read_text(encoding="utf-8"))
    assert gark("check", "rk4", "--format", "sarif", "-o", "s.json", cwd=tmp_path).code == 0
    assert "runs" in json.loads((tmp_path / "s.json").read_text(encoding="utf-8"))
    gark("tableau", "rk4", "-o", "y.out", cwd=tmp_path)
    assert (tmp_path / "y.out").read_text(encoding="utf-8") == gark("tableau", "rk4").out


def test_the_project_has_no_say_over_an_ending(tmp_path: Path) -> None:
    """``format`` of .gark.toml is for reports whose file says none."""
    (tmp_path / ".gark.toml").write_text('format = "github"\n', encoding="utf-8")
    gark("check", "rk4", "-o", "x.json", cwd=tmp_path)
    assert json.loads((tmp_path / "x.json").read_text(encoding="utf-8"))


def test_what_is_text_alone_goes_into_no_other_file(tmp_path: Path) -> None:
    """A comparison with an earlier report, and the meaning of a claim in SARIF."""
    gark("check", "rk4", "-o", "base.json", cwd=tmp_path)
    run = gark("check", "rk4", "--baseline", "base.json", "-o", "x.json", cwd=tmp_path)
    assert refused(run, tmp_path / "x.json", "no .json file can be written here")
    run = gark("check", "--explain", "order", "-o", "x.sarif", cwd=tmp_path)
    assert refused(run, tmp_path / "x.sarif", "no .sarif file can be written here")


@pytest.mark.parametrize("target", ["numpy", "c", "json", "latex", "mathematica", "boost"])
def test_files_for_targets(target: str, tmp_path: Path) -> None:
    """A target goes into files of its language, and into no method file."""
    own = bridges()[target].suffix
    for ending in ENDINGS:
        path = tmp_path / f"x{ending}"
        run = gark("export", "heun", "--to", target, "-o", path.name, cwd=tmp_path)
        if {*ENDINGS[ending]} & {*ENDINGS[own.lower()]}:
            assert (run.code, path.exists()) == (0, True), ending
        else:
            assert refused(run, path, f"{target} is not for a {ending} file", f"ending {own}")
    assert "gark convert" in gark("export", "heun", "--to", target, "-o", "x.gark.yaml").err
    other = "c" if target == "numpy" else "numpy"
    run = gark("export", "heun", "--to", target, "-o", f"x{bridges()[other].suffix}", cwd=tmp_path)
    assert run.code == 0 or other in run.err


def test_other_options_that_name_files(folder: Path) -> None:
    """``--emit``, ``--rows``, ``--svg`` and ``--parquet`` write one kind each; so does ``new``."""
    written = [x for name in COMMANDS for x in declaration_of(name).all_options if x.kind.holds]
    assert {x.key: x.kind.holds for x in written} == {
        "--emit": "yaml",
        "--rows": "jsonl",
        "--svg": "svg",
        "--parquet": "parquet",
    }
    wrong = [
        ("x.json", "design", "family.yaml", "--emit"),
        ("x.csv", "sweep", "spec.yaml", "--rows"),
        ("x.png", "trees", "3", "--svg"),
        ("x.csv", "sweep", "spec.yaml", "--parquet"),
        ("x.json", "new", "--tableau", "0 | ; | 1"),
    ]
    for name, *words in wrong:
        run = gark(*words, name, cwd=folder)
        assert refused(run, folder / name, f"{words[-1]} {name}: no") or words[0] == "new"
        assert run.code == 2
        assert re.search("choose another ending: .(yaml|jsonl|svg|parquet)", run.err)


def test_several_methods_are_no_method_file(tmp_path: Path) -> None:
    """``gark import`` names them and the cure; one of them alone goes into the file."""
    table = "class {}:\n    A = [[0, 0], [1/2, 0]]\n    b = [0, 1]\n    c = [0, 1/2]\n"
    (tmp_path / "one.py").write_text(table.format("One"), encoding="utf-8")
    (tmp_path / "two.py").write_text(table.format("Two"), encoding="utf-8")
    for asked in ((), ("--format", "yaml")):
        run = gark("import", "one.py", "two.py", "-o", "m.gark.yaml", *asked, cwd=tmp_path)
        path = tmp_path / "m.gark.yaml"
        assert refused(run, path, "2 methods are found: One, Two", "--output-dir DIR writes")
    assert gark("import", "one.py", "-o", "m.gark.yaml", cwd=tmp_path).code == 0
    assert gark("check", "-q", "m.gark.yaml", cwd=tmp_path).code == 0


@pytest.mark.parametrize(
    ("typed", "path", "said"),
    [
        ("plot heun", "region.png", "gark stability heun --plot region.png"),
        (
            "plot heun --what convergence",
            "an error.pdf",
            "gark converge heun --plot 'an error.pdf'",
        ),
        ("stability heun", "a.png", "gark stability heun --plot a.png"),
        ("trees 3", "t.svg", "gark trees 3 --svg t.svg"),
        ("trees 3", "t.png", "gark trees 3 --svg t.svg"),
    ],
)
def test_the_cure_of_a_picture_draws_it(tmp_path: Path, typed: str, path: str, said: str) -> None:
    """The line to type, or the option of the command, is told and works."""
    run = gark(*typed.split(), "-o", path, cwd=tmp_path)
    told = said if said.startswith("gark plot") else said.removeprefix(f"gark {typed} ")
    assert (run.code, f"; {told} draws" in run.err) == (2, True), run.err
    assert gark(*shlex.split(said)[1:], cwd=tmp_path).code == 0
    assert [x.suffix for x in tmp_path.iterdir()] == [Path(shlex.split(said)[-1]).suffix]


def test_the_cure_of_a_page_is_of_pages(tmp_path: Path) -> None:
    """``gark report`` draws no picture and writes no LaTeX."""
    for path, said in (("r.pdf", "a browser prints the page"), ("r.tex", "gark check, tableau")):
        run = gark("report", "heun", "-o", path, cwd=tmp_path)
        assert (run.code, said in run.err) == (2, True)
        assert "--plot" not in run.err
