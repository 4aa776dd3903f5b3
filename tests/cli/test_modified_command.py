"""``gark modified``: what it prints, in every format, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from jsonschema import Draft7Validator

from garkcli.ntrees.notation import parse_tree
from garkcli.page.plaintext import plain_text
from garkcli.report.modified import REPORT
from garkcli.report.schemas import report_schema
from tests.cli.harness import gark
from tests.whole import in_whole

VERLET = "methods/stoermer-verlet.gark.yaml"
RECTANGULAR = "methods/rectangular.gark.yaml"
COLLOCATION = "methods/collocation.gark.yaml"
ROUNDED = """
A: [[0, 0, 0], [0.333333333333333, 0, 0], [0, 0.666666666666667, 0]]
b: [0.25, 0, 0.75]
tolerance: 1e-14
"""
ONE_WAY = "tableau: {A: [[[[1/2]], [[1/2]]], [null, [[1/2]]]], b: [[1], [1]]}"


def words(text: str) -> list[list[str]]:
    """The words of each line."""
    return [line.split() for line in text.splitlines()]


@pytest.mark.parametrize(
    "arguments",
    [
        (VERLET, "-n", "7"),
        (RECTANGULAR, "-n", "6", "--equation"),
        (COLLOCATION,),
        (COLLOCATION, "--pair", "-n", "4"),
        (COLLOCATION, "--conjugate", "--digits", "30"),
    ],
)
def test_a_text_fits_80_columns(arguments: tuple[str, ...]) -> None:
    """However long the trees and the numbers."""
    lines = gark("modified", *arguments).out.splitlines()
    assert [line for line in lines if len(line) > 80] == []


def test_ascii_fits_80_columns() -> None:
    """Signs that are spelled out take no further column at the end of a line."""
    text = gark("modified", VERLET, "-n", "6", "--equation").out
    lines = plain_text(text, "ascii").splitlines()
    assert [line for line in lines if len(line) > 80] == []


@pytest.mark.parametrize(
    "arguments", [(VERLET,), ("methods/rk4.gark.yaml",), (COLLOCATION, "--pair", "-n", "3")]
)
def test_json_is_of_its_schema(arguments: tuple[str, ...]) -> None:
    """Reports have the schema, a damaged one has not, and trees can be read."""
    report = json.loads(gark("modified", *arguments, "--format", "json").out)
    schema = report_schema("modified")
    Draft7Validator.check_schema(schema)
    validator = Draft7Validator(schema)
    assert not list(validator.iter_errors(report))
    assert list(validator.iter_errors({**report, "order": "4"}))
    for term in report["equation"]:
        tree = parse_tree(term["tree"])
        assert (tree.order, tree.symmetry) == (term["order"], term["symmetry"])
    asked = json.loads(gark("schema", "--report", "modified").out)
    assert asked == schema


def test_the_modified_hamiltonian_of_stoermer_verlet() -> None:
    """H + h² (U''(T', T')/12 − T''(U', U')/24) + O(h⁴), as is well known."""
    report = json.loads(gark("modified", VERLET, "-n", "3", "--format", "json").out)
    found = {term["tree"]: term["factor"] for term in report["hamiltonian"]}
    assert found == {"[]_1": "1", "[]_2": "1", "[[]_2,[]_2]_1": "-1/24", "[[]_1,[]_1]_2": "1/12"}
    assert report["symplectic"]
    assert report["symplectic_order_is_lower_bound"]


def test_rounded_coefficients(tmp_path: Path) -> None:
    """The order is the one within the tolerance, the rounding is not listed as coefficients, and
    other orders are lower bounds.
    """
    path = tmp_path / "rounded.gark.yaml"
    path.write_text(ROUNDED, encoding="utf-8")
    text = gark("modified", str(path), "-n", "4").out
    words = " ".join(text.split())
    assert ": order 3 within 1e-14; not symplectic;" in words
    assert "effective order at least 3 within 1e-14" in words
    assert " h^1 " not in text
    assert " h^3 " in text
    report = json.loads(gark("modified", str(path), "--format", "json").out)
    assert report["order"] == 3
    assert report["effective_order"] == 3
    assert report["effective_order_is_lower_bound"]
    assert not list(Draft7Validator(REPORT.schema).iter_errors(report))


def test_a_tableau_without_hamiltonian_problems(tmp_path: Path) -> None:
    """Where no Hamiltonian problem has the form of a tableau, that is said."""
    path = tmp_path / "one-way.gark.yaml"
    path.write_text(ONE_WAY, encoding="utf-8")
    text = gark("modified", str(path), "-n", "3").out
    assert text.count("no Hamiltonian problem has its form") == 2
    report = json.loads(gark("modified", str(path), "--format", "json").out)
    assert report["energy_order"] is None


def test_latex_and_quiet() -> None:
    """LaTeX has a row with a picture for each term and a document on request; --quiet has the
    answer alone.
    """
    latex = gark("modified", VERLET, "-n", "3", "--format", "latex").out
    assert latex.count(r"\begin{tikzpicture}") == 4
    assert r"$-\frac{1}{24}$" in latex
    whole = gark("modified", VERLET, "--format", "latex", "--document").out
    assert whole.startswith(r"\documentclass")
    assert gark("modified", VERLET, "--document").code == 2
    quiet = gark("modified", VERLET, "--quiet").out
    assert quiet.endswith("effective order 2\n")
    assert "h^2" not in quiet


def test_too_many_trees_are_refused() -> None:
    """With the largest order that is possible."""
    run = gark("modified", COLLOCATION, "--pair", "-n", "9")
    assert run.code == 2
    assert "help: ask for --order 5 at most" in run.err


PENDULUM = ("--problem", "pendulum")


def test_the_formula_on_a_problem() -> None:
    """The known modified Hamiltonian, as text within 80 columns, as JSON of the schema, as LaTeX."""
    run = gark("modified", VERLET, *PENDULUM, "-n", "7")
    assert ["H", "h^2", "px^2*cos(x)/12", "-", "sin(x)^2/24"] in words(run.out)
    assert [line for line in run.out.splitlines() if len(line) > 80] == []
    report = json.loads(gark("modified", VERLET, *PENDULUM, "-n", "3", "--format", "json").out)
    assert not list(Draft7Validator(REPORT.schema).iter_errors(report))
    assert report["formula"]["of"] == "hamiltonian"
    assert [term["power"] for term in report["formula"]["terms"]] == [0, 2]
    latex = gark("modified", VERLET, *PENDULUM, "-n", "3", "--format", "latex").out
    assert r"\frac{\sin^{2}{\left(x \right)}}{24}" in latex


def test_the_formula_of_a_method_that_is_not_symplectic(tmp_path: Path) -> None:
    """The equation for each unknown, in a file of one tableau."""
    path = tmp_path / "euler.gark.yaml"
    path.write_text("{A: [[0]], b: [1]}\n", encoding="utf-8")
    text = gark("modified", str(path), *PENDULUM, "-n", "2").out
    assert {("x'", "h^1", "sin(x)/2"), ("px'", "h^1", "px*cos(x)/2")} <= {*map(tuple, words(text))}
    latex = gark("modified", str(path), *PENDULUM, "-n", "2", "--format", "latex").out
    assert r"px' $h^{1}$ & $" in latex


def test_a_problem_file_and_the_pair() -> None:
    """A problem file works as a built-in problem does."""
    text = gark(
        "modified", COLLOCATION, "--pair", "--problem", "problems/kepler.yaml", "-n", "2"
    ).out
    assert text.startswith(
        "symplectic pair of Gauss 2 and Lobatto IIIA 3, coupled by collocation: order"
    )
    assert " of up to 2 vertices, in 4 colours\n" in text
    assert "  px^2/2 + py^2/2 - 1/sqrt(x^2 + y^2)" in text


@in_whole
def test_a_problem_sees_fewer_trees_than_the_pair_has() -> None:
    """Four colours have too many trees of seven vertices, the pendulum sees few of them: the formula
    goes further than the orders are looked for.
    """
    text = gark("modified", COLLOCATION, "--pair", *PENDULUM, "-n", "7").out
    assert " of up to 5 vertices, " in text
    assert "  modified Hamiltonian  up to h^6\n" in text
    assert "  H h^6  " in text


@in_whole
def test_problems_and_options_that_do_not_fit(tmp_path: Path) -> None:
    """Each is refused with a cure."""
    rounded = tmp_path / "rounded.gark.yaml"
    rounded.write_text(ROUNDED, encoding="utf-8")
    for arguments, cure in (
        ((str(rounded), *PENDULUM), "exact coefficients"),
        ((VERLET, *PENDULUM, "--seed", "2"), "leave it out"),
        ((VERLET, "--seed", "2"), "give --problem"),
        ((VERLET, "--problem", "generic-separable", "-n", "3"), "--order 2 at most"),
    ):
        run = gark("modified", *arguments)
        assert run.code == 2, run.out
        assert cure in run.err
