"""--problem: names and files, in what they print, where they end, and what they say when they
cannot.
"""

from __future__ import annotations

import json
from pathlib import Path

import click
import pytest
from click.shell_completion import ShellComplete

from garkcli.api.problems import problem_for
from garkcli.cli.arguments import ProblemType
from garkcli.cli.main import gark as group
from garkcli.errors import UsageProblem
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.load import load
from garkcli.problems.builtin import PROBLEMS, is_path
from garkcli.problems.oscillator import Oscillator
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

RECTANGULAR = "methods/rectangular.gark.yaml"
SEMI_SEPARABLE = "methods/semi-separable.gark.yaml"
COLLOCATION = "methods/collocation.gark.yaml"
THREE = "methods/three-colours.gark.yaml"
STEPS = ("--steps", "1/16,1/32,1/64")


@in_whole
@pytest.mark.parametrize(
    ("method", "problem"),
    [
        (RECTANGULAR, "problems/kepler.yaml"),
        (SEMI_SEPARABLE, "problems/double-pendulum.yaml"),
        (SEMI_SEPARABLE, "problems/spherical-pendulum.yaml"),
        (COLLOCATION, "problems/spherical-pendulum.yaml"),
        (SEMI_SEPARABLE, "double-pendulum"),
        (COLLOCATION, "double-pendulum"),
    ],
)
def test_orders_are_seen(method: str, problem: str) -> None:
    """Problem files, and the built-in double pendulum, by methods whose structure is for them."""
    run = gark("converge", method, "--problem", problem, *STEPS)
    assert run.code == 0, run.err
    assert "they agree" in run.out
    assert run.err == ""


def test_a_file_is_the_built_in_problem() -> None:
    """Kepler from its file and Kepler by name: the same errors."""
    one, other = (
        json.loads(gark("converge", RECTANGULAR, "--problem", x, *STEPS, "--format", "json").out)
        for x in ("problems/kepler.yaml", "kepler")
    )
    assert one["problem"] == "Kepler"
    assert [x["error"] for x in one["steps"]] == pytest.approx(
        [x["error"] for x in other["steps"]], rel=1e-6
    )
    assert "angular momentum" in one["steps"][0]["invariant_errors"]


def test_standard_input_is_a_file() -> None:
    """For ``-``."""
    text = "{variables: [x], hamiltonian: [px**2/2, x**4], initial: {x: 1, px: 0}, t_end: 1}"
    run = gark("converge", RECTANGULAR, "--problem", "-", *STEPS, stdin=text)
    assert run.code == 0, run.err
    assert "x^4" in run.out
    again = gark(
        "converge", RECTANGULAR, "--problem", "-", *STEPS, stdin=text.replace("x**4", "x**6")
    )
    assert "x^6" in again.out


def test_numbers_of_terms(tmp_path: Path) -> None:
    """One colour takes the sum, a natural split any number, and all else is refused with the
    numbers.
    """
    two, one = tmp_path / "two.yaml", tmp_path / "one.yaml"
    start = "initial: {x: 1, px: 0}\n"
    two.write_text(f"variables: [x]\nhamiltonian: [px**2/2, x**2/2]\n{start}")
    one.write_text(f"variables: [x]\nhamiltonian: px**2/2 + x**4/4\n{start}")
    single, double, triple = (
        load(str(ROOT / x)).tableau for x in ("methods/rk4.gark.yaml", COLLOCATION, THREE)
    )
    assert len(problem_for(str(two), single).terms) == 1
    assert len(problem_for(str(two), double).terms) == 2
    assert [len(problem_for(str(one), x).terms) for x in (single, double, triple)] == [1, 2, 3]
    assert len(set(problem_for(str(one), triple).terms)) == 2
    run = gark("converge", THREE, "--problem", str(two))
    assert run.code == 2
    assert "two has 2 terms, the method is for 3" in run.err
    assert "give a list of 3 in its file" in run.err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--problem", "keppler"), "did you mean 'kepler'"),
        (("--problem", "no-such.yaml"), "no-such.yaml: error[no-such-file]: no such file"),
        (("--problem", "problems"), "no problem 'problems'"),
        (("--problem", "./problems"), "not a regular file"),
        (("--problem", RECTANGULAR), "this is a method file, not a problem file"),
        (
            ("--problem", "problems/kepler.yaml", "--seed", "2"),
            "--seed is for the problems generic",
        ),
        (("--problem", "problems/kepler.yaml", "--omega", "2"), "is for the oscillator"),
        (
            ("--problem", "problems/spherical-pendulum.yaml"),
            "H{1} of spherical pendulum depends on q",
        ),
    ],
)
def test_what_is_wrong_is_said(arguments: tuple[str, ...], said: str) -> None:
    """With exit code 2."""
    run = gark("converge", RECTANGULAR, *arguments)
    assert run.code == 2
    assert said in run.err
    assert run.out == ""


def test_faults_have_carets(tmp_path: Path) -> None:
    """All of them, under the text, as method files have them."""
    path = tmp_path / "bad.yaml"
    path.write_text("variables: [x]\nhamiltonian: px**2/2 + z\ninitial: {x: log(-1)}\n")
    run = gark("converge", RECTANGULAR, "--problem", str(path))
    assert run.code == 2
    lines = run.err.splitlines()
    caret = next(i for i, line in enumerate(lines) if "hamiltonian: px" in line) + 1
    assert lines[caret].index("^") == lines[caret - 1].index("z")
    assert "x: log of -1 is not a real number" in run.err
    assert "Traceback" not in run.err


def test_a_problem_file_is_no_method_file() -> None:
    """It is told what it is."""
    run = gark("converge", "problems/kepler.yaml", "--problem", "kepler")
    assert run.code == 2
    assert "this is a problem file, not a method file" in run.err
    assert "--problem FILE" in run.err


KINDS = {
    "method": "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n",
    "problem": "gark: 1\nvariables: [x]\nrhs: {x: -x}\ninitial: {x: 1}\n",
    "sweep": "methods: [{family: gauss, stages: 1..4}]\ncolumns: [order]\n",
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("command", "wanted"),
    [(("check",), "method"), (("converge", "rk4", "--problem"), "problem"), (("sweep",), "sweep")],
)
def test_a_file_of_another_kind_is_one_fault(
    kind: str, command: tuple[str, ...], wanted: str, tmp_path: Path
) -> None:
    """It has the kind of the file in it, whatever the command wants."""
    path = tmp_path / "file.yaml"
    path.write_text(KINDS[kind])
    run = gark(*command, str(path), cwd=tmp_path)
    said = f"error[other-file]: this is a {kind} file, not a {wanted} file"
    text = " ".join((run.out + run.err).split())
    assert (said in text) == (kind != wanted)
    assert text.count("error[") == (kind != wanted)
    assert (run.code == 2) == (kind != wanted)


def test_names_are_those_of_the_list() -> None:
    """What --problem takes is what gark list shows, in one order; each name makes a problem."""
    listed = json.loads(gark("list", "--format", "json").out)["problems"]
    assert [x["name"] for x in listed] == list(PROBLEMS)
    assert all(ProblemType().convert(name, None, None) == name for name in PROBLEMS)
    tableau = load(str(ROOT / COLLOCATION)).tableau
    for name in PROBLEMS:
        found = problem_for(name, tableau)
        assert len(found.shares if isinstance(found, Oscillator) else found.terms) == 2
    assert not any(map(is_path, PROBLEMS))
    with pytest.raises(UsageProblem, match="--seed"):
        problem_for("kepler", tableau, 3)


def test_list_mentions_files() -> None:
    """The text form says where problems of one's own go."""
    assert "double-pendulum" in gark("list", "problems").out
    run = gark("list")
    assert "docs/problem-file.md" in run.out
    assert all(len(line) <= 80 for line in run.out.splitlines())
    every = gark("list", "-v").out
    assert f"\n{len(PROBLEMS)} problems\n" in every
    assert f"\n{len(FAMILIES)} families\n" in every


def test_names_are_completed() -> None:
    """By the shell: names by their beginning, files for all else."""
    complete = ShellComplete(group, {}, "gark", "_GARK_COMPLETE")
    found = complete.get_completions(["converge", COLLOCATION, "--problem"], "dou")
    assert [x.value for x in found] == ["double-pendulum"]
    assert [
        x.type
        for x in complete.get_completions(["converge", COLLOCATION, "--problem"], "problems/")
    ] == ["file"]
    assert isinstance(ProblemType(), click.ParamType)


@pytest.mark.parametrize(
    "command", [("converge", *STEPS), ("energy", "--t-end", "10", "--step", "1/10")]
)
def test_an_invariant_that_is_none_is_told(command: tuple[str, ...]) -> None:
    """A sign that is wrong: x py + y px changes on the exact solution, so its errors are not the
    method's.
    """
    text = Path(ROOT / "problems/kepler.yaml").read_text(encoding="utf-8")
    assert "x*py - y*px" in text
    name, *rest = command
    right, wrong = (
        gark(name, RECTANGULAR, "--problem", "-", *rest, stdin=x)
        for x in (text, text.replace("x*py - y*px", "x*py + y*px"))
    )
    assert {right.code, wrong.code} <= {0, 3}
    assert right.err == ""
    assert (
        "angular momentum is not an invariant: the exact solution changes it by -0.024 to t = 1/32"
        in wrong.err
    )
