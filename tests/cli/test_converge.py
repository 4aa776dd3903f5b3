"""``gark converge`` with several files and with the cost of the steps."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from jsonschema import Draft7Validator

from garkcli.errors import UNKNOWN
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

COLLOCATION = "methods/collocation.gark.yaml"
INTERPOLATION = "methods/interpolation.gark.yaml"
RECTANGULAR = "methods/rectangular.gark.yaml"
VERLET = "methods/stoermer-verlet.gark.yaml"
ARS = "methods/ark-ars222.gark.yaml"
INVALID = "tests/examples/invalid/many-faults.gark.yaml"


def test_several_methods_side_by_side() -> None:
    """All slopes are the orders, on a problem that sees every tree."""
    run = gark(
        "converge", COLLOCATION, INTERPOLATION, ARS, "--problem", "generic", "--format", "json"
    )
    assert run.code == 0, run.err
    results = json.loads(run.out)["results"]
    assert [x["visible_order"] for x in results] == [4, 4, 2]
    assert all(abs(x["steps"][-1]["slope"] - x["visible_order"]) < 0.05 for x in results)
    assert all(x["agrees"] for x in results)


@in_whole
def test_different_terms_have_the_same_sum() -> None:
    """The random H is that of the method with most terms, whatever the order of the files; others
    add terms up.
    """
    three = "methods/three-colours.gark.yaml"
    steps = ("--steps", "1/2,1/4", "--problem", "generic", "--format", "json")
    results = {}
    for files in ((COLLOCATION, three), (three, COLLOCATION)):
        run = gark("converge", *files, *steps)
        for result in json.loads(run.out)["results"]:
            results.setdefault(result["file"], []).append(
                (result["hamiltonian"], [x["error"] for x in result["steps"]])
            )
    assert all(x == y for x, y in results.values())
    assert len(results[three][0][0]) == 3
    assert len(results[COLLOCATION][0][0]) == 2
    assert results[three][0][0][0] == results[COLLOCATION][0][0][0]


def test_a_faulty_file_stops_none() -> None:
    """Its faults are on stderr with their lines, the others are compared, exit code 2."""
    run = gark(
        "converge", VERLET, INVALID, "nowhere.gark.yaml", RECTANGULAR, "--problem", "pendulum"
    )
    assert run.code == 2
    assert f"{INVALID}:" in run.err
    assert "nowhere.gark.yaml: error[no-such-file]: no such file" in run.err
    assert run.out.count("they agree") == 2
    assert run.out.count("FAILED ") == 2
    assert run.out.startswith("4 methods: 2 agree, 2 FAILED\n")


def test_a_failing_step_stops_none() -> None:
    """Exit code 1, or 2 where another file has faults."""
    long = ("--problem", "generic", "--t-end", "1000000", "--steps", "1000000")
    run = gark("converge", COLLOCATION, INTERPOLATION, *long)
    assert run.code == 1
    assert run.err.count("step 1 of size 1000000") == 2
    assert gark("converge", COLLOCATION, INVALID, *long).code == 2


def test_a_method_for_other_problems_stops_none() -> None:
    """The rectangular method is not for generic: said with its name, exit code 2."""
    run = gark(
        "converge",
        RECTANGULAR,
        COLLOCATION,
        "--problem",
        "generic",
        "--steps",
        "1/8,1/16,1/32,1/64",
    )
    assert run.code == 2
    assert f"{RECTANGULAR}: error[other-problem]: H{{1}} of generic depends on q" in run.err
    assert "they agree" in run.out


@in_whole
def test_disagreement_of_one_is_exit_code_1() -> None:
    """Steps far too large for one of them."""
    run = gark("converge", VERLET, RECTANGULAR, "--problem", "kepler", "--steps", "1/2,1/4")
    assert run.code == 1
    assert "THEY DISAGREE" in run.out


def test_directories_and_patterns(tmp_path: Path) -> None:
    """As for check: a directory stands for its method files, a pattern for what it matches."""
    for name in ("a", "b"):
        (tmp_path / f"{name}.gark.yaml").write_bytes((ROOT / VERLET).read_bytes())
    for argument in (str(tmp_path), str(tmp_path / "*.yaml")):
        run = gark("converge", argument, "--format", "json")
        assert [Path(x["file"]).name for x in json.loads(run.out)["results"]] == [
            "a.gark.yaml",
            "b.gark.yaml",
        ]


def test_problem_file_for_several() -> None:
    """It is read once, also from standard input; its faults are those of the whole run."""
    text = (
        "{variables: [x], hamiltonian: [px**2/2, 1 - cos(x)], initial: {x: 1, px: 1/2}, t_end: 4}"
    )
    run = gark("converge", VERLET, RECTANGULAR, "--problem", "-", stdin=text)
    assert (run.code, run.out.count("they agree")) == (0, 2), run.err
    broken = gark("converge", VERLET, RECTANGULAR, "--problem", "-", stdin="{variables: [x]}")
    assert (broken.code, broken.out) == (2, "")


@pytest.mark.parametrize("problem", ["oscillator", pytest.param("kepler", marks=in_whole)])
@pytest.mark.parametrize("files", [(RECTANGULAR,), (RECTANGULAR, VERLET)])
def test_work_in_every_format(problem: str, files: tuple[str, ...]) -> None:
    """Evaluations and time are in the table, in JSON and in CSV."""
    arguments = ("converge", *files, "--problem", problem, "--work")
    text = gark(*arguments)
    assert text.code == 0, text.err
    assert "evaluations" in text.out
    assert max(map(len, text.out.splitlines())) <= 80
    data = json.loads(gark(*arguments, "--format", "json").out)
    for result in data.get("results", [data]):
        counts = [row["work"]["evaluations"] for row in result["steps"]]
        assert counts == sorted(counts)
        assert all(
            row["work"]["seconds"] is None or row["work"]["seconds"] > 0 for row in result["steps"]
        )
        assert result["steps"][0]["work"]["seconds"] is not None
    rows = list(csv.DictReader(io.StringIO(gark(*arguments, "--format", "csv").out)))
    assert all(int(row["evaluations"]) >= int(row["steps"]) > 0 for row in rows)


@in_whole
def test_work_keeps_coarse_steps() -> None:
    """Large errors are asked for as well when costs are compared: the ladder begins with longer
    steps.
    """
    arguments = (
        "converge",
        "methods/gauss6-lobatto7.gark.yaml",
        "--problem",
        "henon-heiles",
        "--format",
        "json",
    )
    plain, with_work = (json.loads(gark(*arguments, *x).out) for x in ((), ("--work",)))
    assert with_work["steps"][0]["h"] > plain["steps"][0]["h"]
    assert [x["error"] for x in with_work["steps"][-3:]] == [
        x["error"] for x in plain["steps"][-3:]
    ]


@in_whole
@pytest.mark.parametrize(
    ("arguments", "suffix"),
    [
        ((VERLET, RECTANGULAR), ".png"),
        ((VERLET, RECTANGULAR, "--work"), ".svg"),
        ((RECTANGULAR, "--work"), ".pdf"),
    ],
)
def test_figures_are_the_same_each_time(
    tmp_path: Path, arguments: tuple[str, ...], suffix: str
) -> None:
    """Two runs of a comparison draw the same file, to the byte; so do two of one method's work."""
    steps = ("--steps", "1/4,1/8,1/16", "--problem", "pendulum", "-q")
    paths = [tmp_path / f"{n}{suffix}" for n in (1, 2)]
    for path in paths:
        run = gark("converge", *arguments, *steps, "--plot", str(path))
        assert run.code == 0, run.err
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_nothing_to_draw(tmp_path: Path) -> None:
    """Without a single result there is no figure, and that is said."""
    run = gark("converge", INVALID, "nowhere.gark.yaml", "--plot", str(tmp_path / "a.png"))
    assert run.code == 2
    assert "nothing to draw" in run.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("said", "arguments"),
    [
        ("--against seconds is not known without measuring it", (VERLET, "--against", "seconds")),
        ("--omega 0: a positive number is expected", (VERLET, RECTANGULAR, "--omega", "0")),
        ("no figure can be saved", (VERLET, RECTANGULAR, "--plot", "figure.jpg")),
        ("there is no such folder", (VERLET, RECTANGULAR, "--plot", "nowhere/figure.png")),
    ],
)
def test_options_that_do_not_go_together(said: str, arguments: tuple[str, ...]) -> None:
    """Said once, before anything is computed."""
    run = gark("converge", *arguments)
    assert (run.code, run.out) == (2, "")
    assert run.err.count(said) == 1


LOGISTIC = "{variables: [y], rhs: {y: y*(1 - y)}, initial: {y: %s}}"


@pytest.mark.parametrize("method", [pytest.param("rk4", marks=in_whole), "forward-euler"])
def test_nothing_seen_confirms_nothing(method: str) -> None:
    """On an equilibrium no method makes an error, whatever its order is: undecided, exit code 3, also
    where it is one of several. A start beside it has an order to be seen.
    """
    rest = ("--problem", "-")
    run = gark("converge", method, *rest, stdin=LOGISTIC % 1)
    assert run.code == 3
    assert ": undecided" in " ".join(run.out.split())
    assert "the solution does not move, so that no method makes an error" in " ".join(
        run.out.split()
    )
    both = gark("converge", method, "heun", *rest, stdin=LOGISTIC % 1)
    assert both.code == 3
    assert "agree" not in both.out
    assert gark("converge", method, *rest, stdin=LOGISTIC % "1/2").code == 0


@in_whole
def test_no_error_confirms_nothing() -> None:
    """A polynomial that the method solves exactly: the order that it has is not the one it shows."""
    fall = "{variables: [x, v], rhs: {x: v, v: -1}, initial: {x: 0, v: 1}}"
    run = gark("converge", "heun", "--problem", "-", stdin=fall)
    assert run.code == 3
    assert "the method makes no error on this problem, which shows no order" in " ".join(
        run.out.split()
    )
    steps = ("--steps", "1/2,1/4,1/8", "--format", "json")
    report = json.loads(gark("converge", "heun", "--problem", "-", *steps, stdin=fall).out)
    assert (report["verdict"], report["agrees"]) == ("undecided", False)


def test_one_step_size_is_undecided() -> None:
    """It shows no order, and has the exit code of what is not decided."""
    run = gark("converge", "rk4", "--problem", "pendulum", "--steps", "1/8")
    assert run.code == 3
    assert "one step size shows no order" in run.out


IMPLICIT = "ark: {A: [[[1]]], b: [[1]]}"
POLE = "{variables: [y], rhs: {y: y**2}, initial: {y: 1}, t_end: 2}"


@pytest.mark.parametrize(
    ("arguments", "problem", "code"),
    [
        (("converge", "--steps", "1000000", "--t-end", "1000000", "--problem", "generic"), "", 1),
        (("converge", "--problem", "-"), POLE, 1),
        (("converge", "--problem", "generic-rhs", "--pair"), "", 2),
        (("energy", "--problem", "kepler", "--step", "1/2"), "", 1),
        (("energy", "--problem", "kepler", "--t-end", "1e9"), "", 2),
        (("energy", "--problem", "pendulum", "--modified"), "", 2),
    ],
)
def test_a_run_that_fails_is_a_report(
    arguments: tuple[str, ...], problem: str, code: int, tmp_path: Path
) -> None:
    """JSON says what has failed, by its schema; CSV has no rows. People are told on stderr, and the
    exit code is that of the failure.
    """
    path = tmp_path / "euler.yaml"
    path.write_text(IMPLICIT, encoding="utf-8")
    command, *options = arguments
    name = "modified-energy" if "--modified" in options else command
    run = gark(command, str(path), *options, "--format", "json", stdin=problem)
    assert run.code == code
    report = json.loads(run.out)
    schema = json.loads(gark("schema", "--report", name).out)
    assert not list(Draft7Validator(schema).iter_errors(report))
    (error,) = report["errors"]
    assert error["code"] != UNKNOWN
    assert f"gark: {error['message']}\nhelp: {error['help']}" in run.err
    table = gark(command, str(path), *options, "--format", "csv", stdin=problem)
    assert (table.code, list(csv.DictReader(io.StringIO(table.out)))) == (code, [])
    assert gark(command, str(path), *options, stdin=problem).out == ""


def test_a_file_that_is_no_method_is_a_report() -> None:
    """With its faults and their places, as in a comparison."""
    for command in ("converge", "energy"):
        run = gark(command, INVALID, "--format", "json")
        assert run.code == 2
        errors = json.loads(run.out)["errors"]
        assert len(errors) > 1
        assert all(error["line"] for error in errors)


def test_rounded_coefficients_agree_for_tiny_steps_only(tmp_path: Path) -> None:
    """A method of order 3 in ten digits has order 1, and shows 3: words, table and the slope of the
    reference do not say that 3 is 1.
    """
    file = tmp_path / "ten.yaml"
    file.write_text(
        """
A:
  - [0.4358665215, 0, 0]
  - [0.2820667392, 0.4358665215, 0]
  - [1.2084966492, -0.6443631707, 0.4358665215]
b: [1.2084966492, -0.6443631707, 0.4358665215]
""",
        encoding="utf-8",
    )
    run = gark("converge", str(file), "-v")
    assert run.code == 0
    assert "order 3.00 observed, 1 visible: tiny steps agree" in " ".join(run.out.split())
    assert "reference, slope 3" in run.out
    both = gark("converge", str(file), "alexander-3").out
    assert [both.count(x) for x in ("tiny steps agree", "they agree")] == [1, 1]
    exact = gark("converge", "alexander-3", "-v").out
    assert "they agree" in exact
    assert "reference, slope 3" in exact


@in_whole
def test_rounded_coefficients_are_hinted_at(tmp_path: Path) -> None:
    """Gauss 2 in 13 digits has order 1 or 2 and shows 4, over a short time what it is: then the line
    that is missing is said; with it the order is 4.
    """
    text = """
ark:
  A: [[[0.25, -0.0386751345948], [0.5386751345948, 0.25]]]
  b: [[0.5, 0.5]]
"""
    rounded, toleranced = (tmp_path / "rounded.gark.yaml", tmp_path / "toleranced.gark.yaml")
    rounded.write_text(text, encoding="utf-8")
    toleranced.write_text(f"{text}tolerance: 1e-13\n", encoding="utf-8")
    hint = "hint: the coefficients look rounded; with the line  tolerance: 1e-13  order 4 holds"
    alone = gark("converge", str(rounded))
    assert (alone.code, hint in alone.err) == (0, True)
    assert "conditions of order 3 are missed by little" in alone.out
    both = gark("converge", str(rounded), str(toleranced))
    assert (both.code, both.err.count(hint)) == (0, 1)


def test_details_end_with_a_plot() -> None:
    """Of one method and of several, over evaluations with ``--work``; a quiet report is the answer
    alone.
    """
    steps = ("--steps", "1/4,1/8", "--problem", "pendulum")
    for arguments in ((VERLET,), (VERLET, RECTANGULAR)):
        usual, all_of_it = (gark("converge", *arguments, *steps, *x).out for x in ((), ("-v",)))
        assert "┤" not in usual
        assert all_of_it.startswith(usual.splitlines()[0])
        assert any("step size h" in line for line in all_of_it.splitlines()[-2:])
        assert gark("converge", *arguments, *steps, "-q").out == usual.splitlines()[0] + "\n"
    worked = gark("converge", VERLET, *steps, "--work", "-v").out
    assert worked.splitlines()[-2].endswith("evaluations of vector fields")


def test_an_invariant_without_a_value(tmp_path: Path) -> None:
    """One that has no value at the end is unknown there in every format, and stops no test."""
    problem = tmp_path / "turning.yaml"
    problem.write_text(
        "variables: [x]\nhamiltonian: px**2/2 + x**2/2\ninitial: {x: 3/10, px: 1}\nt_end: 4\n"
        "invariants: {I: log(px)}\n"
    )
    arguments = ("converge", "rk4", "--problem", str(problem))
    shown = gark(*arguments)
    assert shown.code == 0
    assert "I error" in shown.out
    assert " unknown " in shown.out
    report = json.loads(gark(*arguments, "--format", "json").out)
    schema = json.loads(gark("schema", "--report", "converge").out)
    assert not list(Draft7Validator(schema).iter_errors(report))
    assert {step["invariant_errors"]["I"] for step in report["steps"]} == {None}
    rows = list(csv.DictReader(io.StringIO(gark(*arguments, "--format", "csv").out)))
    assert {row["I_error"] for row in rows} == {""}
