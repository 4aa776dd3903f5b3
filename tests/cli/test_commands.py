"""Every command in every format on real files: exit codes, streams, JSON, files written."""

import csv
import io
import json
import os
import re
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import yaml
from flint import fmpq
from jsonschema import Draft7Validator

from garkcli.check import analysis
from garkcli.cli.command import command_of, declaration_of
from garkcli.cli.table import COMMANDS, FORMER
from garkcli.methodfile.load import load, loads
from tests.cli.harness import ROOT, gark, gark_once
from tests.whole import in_whole, sample

COLLOCATION = "methods/collocation.gark.yaml"
VERLET = "methods/stoermer-verlet.gark.yaml"
SWEEP = "tests/examples/sweeps/small.yaml"
FREE = "tests/examples/families/sdirk.gark.yaml"
ARK = "methods/ark-ars222.gark.yaml"
FAILING = "tests/examples/failing/collocation-misprinted.gark.yaml"
INVALID = "tests/examples/invalid/many-faults.gark.yaml"
RUNS = [
    (
        ("check", COLLOCATION),
        ("auto", "text", "json", "github", "sarif", "junit", "markdown", "latex"),
    ),
    (("trees", "-N", "2", "-n", "3"), ("text", "json", "ndjson", "csv", "markdown", "latex")),
    (
        ("trees", "-N", "2", "-n", "3", "--count", "--upto"),
        ("text", "json", "ndjson", "csv", "latex"),
    ),
    (("conditions", "-n", "3"), ("text", "json", "csv", "markdown", "latex")),
    (("conditions", "-N", "2", "-n", "3", "--coloured"), ("text", "json", "csv", "latex")),
    (
        ("conditions", COLLOCATION, "-n", "3", "--pair"),
        ("text", "json", "csv", "markdown", "latex"),
    ),
    (("tableau", COLLOCATION), ("text", "yaml", "json", "markdown", "latex")),
    (("conjugate", VERLET), ("text", "yaml", "json", "markdown", "latex")),
    (("conjugate", COLLOCATION, "--pair"), ("text", "yaml", "json", "markdown", "latex")),
    (("stability", COLLOCATION), ("text", "json", "markdown", "latex")),
    (("converge", VERLET, "--steps", "1/2,1/4,1/8"), ("text", "json", "markdown", "latex", "csv")),
    (("converge", VERLET, ARK, "--steps", "1/2,1/4,1/8"), ("text", "json", "csv")),
    (
        ("converge", VERLET, COLLOCATION, "--problem", "pendulum"),
        ("text", "json", "csv", "markdown", "latex"),
    ),
    (
        ("energy", VERLET, "--t-end", "20", "--step", "1/10"),
        ("text", "json", "csv", "markdown", "latex"),
    ),
    (
        ("audit", "tests/bridges/sources/register.cpp"),
        ("auto", "text", "json", "markdown", "latex", "github", "sarif"),
    ),
    (
        ("import", "tests/bridges/sources/rotated.json"),
        ("text", "json", "yaml", "markdown", "latex"),
    ),
    (("list",), ("text", "json", "markdown", "latex")),
    (("show", COLLOCATION), ("text", "json", "markdown", "latex")),
    (("cite", COLLOCATION), ("bibtex", "text", "json", "markdown", "latex")),
    (("report", VERLET, "--no-pictures", "-o", "-"), ("html",)),
    (("plot", VERLET, "--what", "tableau"), ("text", "svg")),
    (("list", "methods", "rk4"), ("text", "json", "csv", "markdown", "latex")),
    (("claims", VERLET), ("text", "json", "markdown", "latex")),
    (("diff", VERLET, VERLET), ("text", "json", "markdown", "latex")),
    (("convert", COLLOCATION), ("yaml", "text", "json", "markdown", "latex")),
    (("new", "--family", "gauss:2", "--family", "gauss:1"), ("yaml",)),
    (("explain", "density"), ("text", "json", "markdown", "latex")),
    (("reduce", VERLET), ("yaml", "text", "json", "markdown", "latex")),
    (("modified", VERLET), ("text", "json", "markdown", "latex")),
    (("certificate", VERLET), ("json", "text", "markdown", "latex", "coq")),
    (("design", FREE), ("text", "json", "markdown", "latex")),
    (
        ("design", FREE, "--order", "2", "--search", "3", "--front", "error", "coefficients"),
        ("csv",),
    ),
    (("sweep", SWEEP, "--rows", os.devnull), ("text", "json", "markdown", "latex", "jsonl", "csv")),
    (("schema",), ("json",)),
    (("schema", "--report"), ("json",)),
]
EACH = [
    pytest.param((*run, "--format", f), id=f"{' '.join(run[:1])}-{i}-{f}")
    for i, (run, fs) in enumerate(RUNS)
    for f in fs
]
WITHOUT_A_REPORT = {"export", "lsp"}
"""What they write has the format of a target, or of a protocol."""
IN_JSON = {run: fs for run, fs in RUNS if "json" in fs}


def test_every_format_of_every_command_is_tried() -> None:
    """The runs of this file name every command and every format there is."""
    known = {}
    for name in {*COMMANDS} - WITHOUT_A_REPORT:
        command = command_of(name)
        (choice,) = [x.type for x in command.params if x.name == "format"]
        known[name] = set(choice.choices)
    tried = {
        name: {f for run, formats in RUNS if FORMER.get(run[0], run)[0] == name for f in formats}
        for name in known
    }
    assert tried == known


def data(*arguments: str) -> dict[str, object]:
    """The JSON report of a run that succeeds."""
    run = gark(*arguments, "--format", "json")
    assert run.code == 0, run.err
    found = json.loads(run.out)
    assert isinstance(found, dict)
    return found


@pytest.mark.parametrize("arguments", EACH)
def test_every_command_runs_in_every_format(arguments: tuple[str, ...]) -> None:
    """The report is on stdout, in the format asked for; nothing but notes is on stderr; the exit
    code is 0.
    """
    run = gark_once(*arguments)
    assert run.code == 0, run.err
    assert run.out.endswith("\n") or arguments[-1] == "github"  # which only knows of failures
    assert "error" not in run.err
    if arguments[-1] in {"json", "sarif"}:
        json.loads(run.out)
    elif arguments[-1] == "junit":
        assert ET.fromstring(run.out).tag == "testsuites"
    elif arguments[-1] == "ndjson":
        assert [json.loads(line) for line in run.out.splitlines()]
    elif arguments[-1] == "csv":
        widths = {len(row) for row in csv.reader(io.StringIO(run.out))}
        assert len(widths) == 1
    elif arguments[-1] == "yaml":
        assert loads(run.out).tableau.size == 2 + 2 * ("--pair" in arguments)


@pytest.mark.parametrize("arguments", [(*run, "--format", formats[0]) for run, formats in RUNS])
def test_a_report_in_a_file_is_the_report_on_stdout(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    """``-o FILE`` writes what stdout would show, whole, and leaves nothing else in the
    directory.
    """
    target = tmp_path / "report"
    run = gark(*arguments, "-o", str(target))
    assert (run.code, run.out) == (0, "")
    assert target.read_text(encoding="utf-8") == gark_once(*arguments).out
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_nothing_is_left_where_a_report_cannot_be_written(tmp_path: Path) -> None:
    """Into a directory that does not exist nothing is written: exit code 2, a message, no partial
    file.
    """
    run = gark("check", COLLOCATION, "-o", str(tmp_path / "nowhere" / "report"))
    assert (run.code, run.out) == (2, "")
    assert "cannot write" in run.err
    assert list(tmp_path.iterdir()) == []
    assert gark("check", COLLOCATION, "-o", str(tmp_path)).code == 2
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_replaced_only_by_a_whole_report(tmp_path: Path) -> None:
    """A run that fails before its report leaves the old file as it was; one that succeeds replaces
    it.
    """
    target = tmp_path / "report"
    target.write_text("old")
    assert gark("tableau", INVALID, "-o", str(target)).code == 2
    assert target.read_text() == "old"
    assert gark("tableau", VERLET, "-o", str(target)).code == 0
    assert target.read_text(encoding="utf-8").startswith("Störmer-Verlet")


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_help_of_every_command(command: str) -> None:
    """``--help`` and ``-h`` show the same, with every option the command has but former ones and a
    choice of one; the group lists the command.
    """
    run = gark_once(command, "--help")
    assert run.code == 0
    assert run.out == gark(command, "-h").out
    declared = declaration_of(command)
    options = {
        x.key
        for x in declared.all_options
        if not x.is_argument and not x.is_former and (x.key != "--format" or declared.formats[1:])
    }
    assert {*options, "--help"} <= set(re.findall(r"--[a-z0-9-]+", run.out))
    assert f"  {command} " in gark_once("--help").out


def test_every_command_is_where_the_table_says() -> None:
    """The files of the room declare the commands of the table, and no others."""
    declaring = {
        path.stem: set(
            re.findall(r"^@declared\(\s*\"(\w+)\"", path.read_text("utf-8"), re.MULTILINE)
        )
        for path in (ROOT / "garkcli/cli").glob("*.py")
    }
    assert {name: row.file for name, row in COMMANDS.items()} == {
        name: file for file, names in declaring.items() for name in names
    }


def test_version() -> None:
    """``--version`` says the version of the package."""
    from garkcli import __version__

    assert gark("--version").out == f"gark {__version__}\n"


@pytest.mark.parametrize(
    ("code", "arguments"),
    [
        (0, ("check", COLLOCATION)),
        (0, ("check", "methods")),
        (1, ("check", FAILING)),
        (1, ("check", COLLOCATION, FAILING, "-q")),
        (2, ("check", INVALID)),
        (2, ("check", FAILING, INVALID, COLLOCATION)),
        (2, ("check", "nowhere.gark.yaml")),
        (2, ("check", "tests/cli/snapshots")),
        (2, ("check",)),
        (2, ("check", COLLOCATION, "--format", "yaml")),
        (2, ("check", COLLOCATION, "--max-order", "0")),
        (2, ()),
        (2, ("trees",)),
        (2, ("trees", "-n", "3", "--root", "2")),
        (2, ("trees", "-n", "3", "--colours-used", "2")),
        (2, ("trees", "-n", "3", "--count", "--colours-used", "1")),
        (2, ("conditions", "--pair")),
        (2, ("conditions", COLLOCATION, "-N", "2")),
        (2, ("conditions", ARK, "--conjugate")),
        (2, ("tableau", INVALID)),
        (2, ("conjugate", ARK)),
        (2, ("conjugate", "methods/gauss6-lobatto7.gark.yaml", "--pair", "--format", "yaml")),
        (2, ("converge", VERLET, "--omega", "sqrt(2)")),
        (2, ("converge", VERLET, "--steps", "1/2,-1/4")),
        (2, ("converge", VERLET, "--steps", "1/0")),
        (2, ("converge", VERLET, "--drift")),
        (2, ("converge", VERLET, "--step", "1")),
        (2, ("converge", VERLET, "--plot", "plot.txt")),
        (2, ("nonsense",)),
        (2, ("check", COLLOCATION, "--no-such-option")),
    ],
)
def test_exit_codes(code: int, arguments: tuple[str, ...]) -> None:
    """0 all holds, 1 a claim fails, 2 usage or a file that is no method; the largest of several
    files.
    """
    run = gark(*arguments)
    assert run.code == code, run.err
    assert "Traceback" not in run.out + run.err
    assert "internal fault" not in run.err
    if code:
        assert run.out + run.err


def test_a_method_comes_from_standard_input() -> None:
    """``-`` is standard input, and its faults are those of <stdin>."""
    text = (ROOT / COLLOCATION).read_text(encoding="utf-8")
    assert gark("tableau", "-", stdin=text).out == gark("tableau", COLLOCATION).out
    run = gark("check", "-", stdin="methods: [{family: gaus, stages: 2}]")
    assert run.code == 2
    assert run.out.startswith("<stdin>:1:20: error[unknown-word]: no family 'gaus'\n")


def test_a_directory_is_all_method_files_below_it(tmp_path: Path) -> None:
    """Every *.gark.yaml below a directory is checked, in order, and no other file."""
    (tmp_path / "b").mkdir()
    for name in ("z.gark.yaml", "a.gark.yaml", "b/m.gark.yaml", "b/other.yaml"):
        (tmp_path / name).write_text("methods: [{family: gauss, stages: 1}]")
    report = json.loads(gark("check", str(tmp_path), "--format", "json").out)
    names = [Path(x["file"]).relative_to(tmp_path).as_posix() for x in report["files"]]
    assert names == ["a.gark.yaml", "b/m.gark.yaml", "z.gark.yaml"]


def test_quiet_says_only_what_fails() -> None:
    """With ``-q`` a run that holds says nothing, and one that fails says the claim."""
    assert gark("check", COLLOCATION, VERLET, "-q").out == ""
    assert "expected 4, found 2" in gark("check", FAILING, "-q").out


def test_verbose_shows_every_file_in_full() -> None:
    """With ``-v`` several files are reported as one would be with it."""
    both = gark("check", COLLOCATION, VERLET, "-v").out
    for path in (COLLOCATION, VERLET):
        assert gark("check", path, "-v").out.rstrip() in both


def test_colour_is_asked_for() -> None:
    """Escape codes are there with ``--color always`` and not otherwise; the text is the same."""
    painted = gark("check", COLLOCATION, "--color", "always").out
    assert "\x1b[" in painted
    assert (
        re.sub(r"\x1b\[[0-9;]*m", "", painted) == gark("check", COLLOCATION, "--color", "never").out
    )
    assert "\x1b[" not in gark("check", COLLOCATION).out


def test_the_search_stops_at_the_highest_order() -> None:
    """``--max-order`` makes the order a lower bound, in the text and in JSON; claims are
    decided.
    """
    gauss = "methods: [{family: gauss, stages: 4}]"
    run = gark("check", "-", "--max-order", "3", "--format", "json", stdin=gauss)
    (found,) = json.loads(run.out)["files"]
    assert (found["order"], found["order_is_lower_bound"], found["witness"]) == (3, True, None)
    assert "at least 3" in gark("check", "-", "--max-order", "3", stdin=gauss).out
    claimed = gark("check", "-", "--max-order", "3", stdin=f"{gauss}\nexpect: {{order: 8}}")
    assert claimed.code == 0


def test_json_of_check() -> None:
    """The report on the collocation example has every field of the documentation, with the paper's
    values.
    """
    report = data("check", COLLOCATION)
    assert report["schema"] == "gark/check/1"
    assert report["summary"] == {"files": 1, "failed": 0, "undecided": 0, "without_claims": 0}
    (found,) = report["files"]
    assert found["colours"] == [{"name": "1", "stages": 2}, {"name": "2", "stages": 3}]
    assert (found["order"], found["conjugate_order"], found["pair_order"]) == (4, 4, 4)
    assert (found["ok"], found["exact"], found["tolerance"]) == (True, True, None)
    assert (found["consistent"], found["symplectic"], found["pair_bound"]) == (True, False, 3)
    assert found["simplifying"]["C"] == [[2, 3], [3, 3]]
    assert found["witness"]["order"] == 5
    assert fmpq(*map(int, found["witness"]["value"].split("/"))) - fmpq(1, 120) == fmpq(-1, 720)
    assert {x["claim"]: x["holds"] for x in found["claims"]}["order"] is True


def test_json_of_a_file_that_cannot_be_read() -> None:
    """Each fault is an error with line, column, message and help; the other files are reported all
    the same.
    """
    run = gark("check", INVALID, COLLOCATION, "--format", "json")
    assert run.code == 2
    bad, good = json.loads(run.out)["files"]
    assert bad["ok"] is False
    assert good["ok"] is True
    assert {"line", "column", "message", "help"} <= set(bad["errors"][0])
    assert [error["line"] for error in bad["errors"]] == sorted(
        error["line"] for error in bad["errors"]
    )


def test_json_of_trees() -> None:
    """52 trees of order 4 in two colours, 26 for each root; with --count the same numbers and no
    trees.
    """
    report = data("trees", "-N", "2", "-n", "4")
    assert (report["colours"], report["order"], report["count"]) == (2, 4, 52)
    assert report["by_root"] == {"1": 26, "2": 26}
    trees = report["trees"]
    assert len(trees) == 52
    assert set(trees[0]) == {"tree", "root", "order", "sigma", "gamma"}
    counted = data("trees", "-N", "2", "-n", "4", "--count")
    assert "trees" not in counted
    assert {key: report[key] for key in counted} == counted


@in_whole
@pytest.mark.parametrize("options", [[], ["--symplectic"]])
def test_counts_of_any_number_of_digits(options: list[str]) -> None:
    """They are written out, in every format, and Python's limit for the digits of numbers, here
    the smallest one that there is, is left as it was.
    """
    limit = sys.get_int_max_str_digits()
    least = sys.int_info.str_digits_check_threshold
    sys.set_int_max_str_digits(least)
    try:
        runs = [
            gark("trees", "--count", "-N", "9", "-n", "550", "--format", x, *options)
            for x in ("text", "json", "csv")
        ]
        assert sys.get_int_max_str_digits() == least
    finally:
        sys.set_int_max_str_digits(limit)
    assert [run.code for run in runs] == [0, 0, 0]
    assert [run.err for run in runs] == ["", "", ""]
    found = [re.findall(rf"\d{{{least + 1},}}", run.out)[0] for run in runs]
    assert found[0] == found[1]


def test_more_trees_than_fit_are_refused() -> None:
    """The number and the cure, with no word of a fault of the program."""
    run = gark("trees", "-n", "30", "--yes")
    assert run.code == 2
    assert run.err.startswith("gark: 196268698287 trees of order up to 29 with 1 colour (limit")
    assert "count them" in run.err


@pytest.mark.parametrize("options", [(), ("--format", "csv"), ("-o", "trees.txt")])
def test_millions_of_lines_are_asked_for_twice(options: tuple[str, ...], tmp_path: Path) -> None:
    """Without a terminal to ask they are refused at once, with the number and both cures; a million
    and fewer are listed.
    """
    run = gark("trees", "-N", "3", "-n", "9", *options, cwd=tmp_path)
    assert (run.code, run.out) == (2, "")
    assert list(tmp_path.iterdir()) == []
    counted = gark("trees", "-N", "3", "-n", "9", "--count", "--format", "json").out
    number = json.loads(counted)["count"]
    assert run.err == f"gark: {number} trees\nhelp: --yes lists them, --count counts them\n"


def test_whoever_is_asked_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a terminal the answer decides; anything but yes is no."""
    from garkcli.cli import trees

    monkeypatch.setattr(trees, "is_terminal", lambda _: True)
    monkeypatch.setattr(trees, "MANY", 10)
    for answer, code in (("y\n", 0), ("yes\n", 0), ("n\n", 2), ("\n", 2), ("", 2)):
        run = gark("trees", "-n", "6", stdin=answer)
        assert run.code == code
        assert run.err.startswith("20 trees: list them all? [y/N]\n")
        assert ("[[]" in run.out) is (code == 0)


def test_a_tableau_as_a_method_file(tmp_path: Path) -> None:
    """--format yaml spells out every block, and loads again to the same tableau; where the nodes
    have no radicals it says so.
    """
    for path in (COLLOCATION, ARK, VERLET):
        run = gark("tableau", path, "--format", "yaml")
        assert run.code == 0
        (tmp_path / "m.gark.yaml").write_text(run.out, encoding="utf-8")
        again = gark("tableau", "m.gark.yaml", "--format", "json", cwd=tmp_path)
        assert again.out == gark("tableau", path, "--format", "json").out
    run = gark("tableau", "methods/gauss6-lobatto7.gark.yaml", "--format", "yaml")
    assert run.code == 2
    assert "no simple radicals" in run.err


def test_json_of_conditions() -> None:
    """Without a file each row has its tree and condition; with a file also its values, as exact
    text.
    """
    plain = data("conditions", "-n", "4")["conditions"]
    assert len(plain) == 8
    assert {"tree", "root", "order", "sigma", "gamma", "condition"} <= set(plain[0])
    coloured = data("conditions", "-N", "2", "-n", "4", "--only")["conditions"]
    assert len(coloured) == 52
    valued = data("conditions", FAILING, "-n", "3")["conditions"]
    assert {"value", "required", "residual", "holds"} <= set(valued[0])
    failing = [row for row in valued if not row["holds"]]
    assert {row["residual"] for row in failing} >= {"17/108"}
    assert data("conditions", FAILING, "-n", "3", "--failing")["conditions"] == failing


@pytest.mark.parametrize("command", ["tableau", "conjugate"])
def test_json_of_a_tableau(command: str) -> None:
    """Exact strings and floats have the same shape: nodes, blocks and weights of each colour."""
    report = data(command, COLLOCATION)
    assert [colour["stages"] for colour in report["colours"]] == [2, 3]
    for part in (report, report["float"]):
        assert [len(row) for row in part["c"]] == [2, 3]
        assert [len(row) for row in part["b"]] == [2, 3]
        assert [[(len(x), len(x[0])) for x in row] for row in part["A"]] == [
            [(2, 2), (2, 3)],
            [(3, 2), (3, 3)],
        ]
    assert report["c"][0] == ["1/2 - sqrt(3)/6", "1/2 + sqrt(3)/6"]
    assert report["float"]["c"][0] == pytest.approx(
        [0.21132486540518713, 0.7886751345948129], abs=1e-16
    )


def test_absent_blocks_are_null() -> None:
    """A block that does not exist is null in JSON, and null again when the YAML is loaded."""
    report = data("tableau", VERLET)
    assert [[x is None for x in row] for row in report["A"]] == [[True, False], [False, True]]


def test_json_of_converge() -> None:
    """The observed order is near the predicted one, and every step has h, error, slope, energy
    error.
    """
    report = data("converge", VERLET)
    assert (report["problem"], report["predicted_order"]) == ("generic-separable", 2)
    assert report["observed_order"] == pytest.approx(2, abs=0.1)
    assert {"h", "error", "slope", "energy_error"} <= set(report["steps"][0])
    assert [step["h"] for step in report["steps"]] == sorted(
        (x["h"] for x in report["steps"]), reverse=True
    )


def test_json_of_list() -> None:
    """Families, transfer rules and problems are those that files and options accept."""
    from garkcli.families.registry import FAMILIES
    from garkcli.methodfile.transfers import ALL_RULES
    from garkcli.problems.builtin import PROBLEMS

    report = data("list")
    assert [x["name"] for x in report["families"]] == list(FAMILIES)
    assert [x["name"] for x in report["transfer"]] == list(ALL_RULES)
    assert [x["name"] for x in report["problems"]] == list(PROBLEMS)


def test_the_conjugate_twice_is_the_file() -> None:
    """``gark conjugate --format yaml`` through itself gives the original blocks exactly."""
    once = gark("conjugate", COLLOCATION, "--format", "yaml")
    twice = gark("conjugate", "-", "--format", "json", stdin=once.out)
    wanted, found = data("tableau", COLLOCATION), json.loads(twice.out)
    assert [found[key] for key in "cAb"] == [wanted[key] for key in "cAb"]


def test_conjugate_without_radicals_says_so() -> None:
    """Where nodes have no simple radicals the file says ``conjugate: true``, with a note on
    stderr.
    """
    run = gark("conjugate", "methods/gauss6-lobatto7.gark.yaml", "--format", "yaml")
    assert loads(run.out).is_conjugate
    assert "conjugate: true" in run.err
    assert load(str(ROOT / "methods/gauss6-lobatto7.gark.yaml")).is_conjugate is False


@in_whole
def test_pictures_are_written(tmp_path: Path) -> None:
    """``--svg`` draws every tree into one well-formed sheet, ``--plot`` a figure; stderr says which
    file.
    """
    sheet, figure = tmp_path / "trees.svg", tmp_path / "order.svg"
    run = gark("trees", "-N", "2", "-n", "3", "--svg", str(sheet))
    assert (run.code, run.out, run.err) == (0, "", f"wrote {sheet}\n")
    assert ET.parse(sheet).getroot().tag.endswith("svg")
    assert gark("converge", VERLET, "--steps", "1/2,1/4", "--plot", str(figure)).code == 0
    assert ET.parse(figure).getroot().tag.endswith("svg")


@in_whole
def test_the_schema_allows_every_file_that_loads() -> None:
    """``gark schema`` is a JSON Schema, and no valid example is underlined by an editor that uses
    it.
    """
    schema = data("schema")
    validator = Draft7Validator(schema)
    validator.check_schema(schema)
    assert not validator.is_valid(
        {"methods": [{"family": "gauss", "stages": 2}], "descripton": "a slip"}
    )
    files = sorted(
        [*ROOT.glob("methods/*.gark.yaml"), *ROOT.glob("tests/examples/valid/*.gark.yaml")]
    )
    wrong = {
        x.name: e.message
        for x in files
        for e in validator.iter_errors(yaml.safe_load(x.read_text("utf-8-sig")))
    }
    assert wrong == {}


@in_whole
def test_the_schema_of_reports_allows_reports() -> None:
    """``gark schema --report`` describes what ``gark check --format json`` writes, faults
    included.
    """
    schema = data("schema", "--report")
    some = sample(sorted(str(x) for x in ROOT.glob("methods/*.gark.yaml")), 5)
    found = json.loads(gark("check", *some, FAILING, INVALID, ARK, "--format", "json").out)
    assert [error.message for error in Draft7Validator(schema).iter_errors(found)] == []
    assert not Draft7Validator(schema).is_valid({"schema": "gark/check/1"})
    assert data("schema", "--report", "check") == schema


def test_a_report_without_a_schema_is_named() -> None:
    """``gark schema --report WORD`` of no report: exit code 2 and the nearest command."""
    run = gark("schema", "--report", "chek")
    assert run.code == 2
    assert "did you mean 'check'?" in run.err


@pytest.mark.parametrize("command", ["check", "tableau", "conjugate", "conditions", "stability"])
def test_numbers_beyond_floats_are_no_infinity(command: str, tmp_path: Path) -> None:
    """JSON has no Infinity: a coefficient of 400 digits is null as a float, and exact as text."""
    path = tmp_path / "huge.yaml"
    path.write_text('methods: [{A: [["1e400"]], b: [1]}]\n', encoding="utf-8")
    more = ["--error-constants"] if command == "check" else []
    more += ["--order", "2"] if command == "conditions" else []
    run = gark(command, str(path), *more, "--format", "json")

    def refused(name: str) -> None:
        pytest.fail(name)

    json.loads(run.out, parse_constant=refused)
    assert "000000" in run.out


def test_digits_of_a_check() -> None:
    """Values and residuals in decimals where they are asked for."""
    run = gark("check", COLLOCATION, "--digits", "4", "-v")
    assert " by about -0.001389\n" in run.out
    assert ": about 0.006944 instead of about 0.008333\n" in run.out
    assert "1/144" not in run.out
    assert "-1/720" not in run.out


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_help_says_what_stands_for_a_method(name: str) -> None:
    """Every command that reads methods says that names and families stand for one, and the commands
    that take several say what directories and patterns mean.
    """
    takes = [x.flags[0] for x in declaration_of(name).methods]
    assert {x.strip("[].") for x in takes} <= {"FILE", "FIRST", "SECOND"}
    text = " ".join(gark(name, "--help").out.split())
    assert ("a name of the catalogue such as rk4" in text) is bool(takes)
    assert ("a directory stands for all *.gark.yaml" in text) is any("..." in x for x in takes)


OF_DECIMALS = [
    *("stability", "show", "tableau", "conjugate", "modified", "convert", "claims", "certificate"),
    *("conditions", "export --to json", "energy --step 1/2 --t-end 10", "diff rk4", "plot"),
    *("converge", "report -o page.html"),
]


@pytest.mark.parametrize("command", OF_DECIMALS)
def test_every_command_says_that_coefficients_look_rounded(command: str, tmp_path: Path) -> None:
    """A method in decimals without tolerance is pointed out by every command that reads it, once; with
    the line, or quietly, there is nothing to say.
    """
    text = (
        "A: [[0.2928932188134524, 0], [0.7071067811865476, 0.2928932188134524]]\n"
        "b: [0.7071067811865476, 0.2928932188134524]\n"
    )
    place, exact = tmp_path / "sdirk.gark.yaml", tmp_path / "within.gark.yaml"
    place.write_text(text, encoding="utf-8")
    exact.write_text(f"{text}tolerance: 1e-16\n", encoding="utf-8")
    name, *options = command.split()
    hint = "hint: the coefficients look rounded; with the line  tolerance: 1e-16  order 2 holds"
    assert gark(name, str(place), *options, cwd=tmp_path).err.count(hint) == 1
    assert "look rounded" not in gark(name, str(exact), *options, cwd=tmp_path).err


def test_a_line_of_several_checks_says_it_too(tmp_path: Path) -> None:
    """``gark check`` of several files has the missing line below each one that lacks it."""
    place = tmp_path / "heun.yaml"
    place.write_text(
        "A: [[0, 0, 0], [0.3333333333, 0, 0], [0, 0.6666666667, 0]]\nb: [1/4, 0, 3/4]\n"
    )
    run = gark("check", str(place), "rk4")
    (hint,) = [x for x in run.out.splitlines() if x.startswith("  hint")]
    assert hint == "  hint  the coefficients look rounded to 10 decimal places; with the line"
    assert "        tolerance: 1e-10 order 3 holds\nok   rk4" in run.out
    assert "hint" not in gark("check", str(place), "rk4", "-q").out


def test_nobody_looks_for_rounding_that_nobody_reads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With ``-q`` no time goes into the hint, which for many stages takes half a minute."""
    place = tmp_path / "half.gark.yaml"
    place.write_text("A: [[0.3333333333333333]]\nb: [1]\n", encoding="utf-8")
    asked: list[object] = []
    monkeypatch.setattr(analysis, "looks_rounded", asked.append)
    for words, count in (("-q",), 0), ((), 1):
        assert gark("tableau", str(place), *words).code == 0
        assert len(asked) == count


@in_whole
def test_long_fractions_are_decimals_in_text_alone(tmp_path: Path) -> None:
    """Numbers with dozens of digits have decimals in the report; with ``-v`` and for programs they
    are exact.
    """
    place = tmp_path / "sdirk.gark.yaml"
    place.write_text(
        "A: [[0.2928932188134524, 0], [0.7071067811865476, 0.2928932188134524]]\n"
        "b: [0.7071067811865476, 0.2928932188134524]\n",
        encoding="utf-8",
    )
    usual, verbose, data = (
        gark("stability", str(place), *x).out for x in ((), ("-v",), ("--format", "json"))
    )
    assert not re.search(r"[0-9]{20}", usual)
    assert "about (0.41421356*z + 1) / (0.085786438*z^2" in " ".join(usual.split())
    # E = |Q(iy)|² − |P(iy)|² keeps its size: denominators are not cleared
    assert "E = about 0.0073593129*x^2 - 2.1382670e-16*x" in " ".join(usual.split())
    for text in (verbose, data):
        assert re.search(r"2588834764831845000000000000000\*z", text)
