"""``render`` writes what the commands print, in every format that they have."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import garkcli
from garkcli import MethodError, UsageProblem, render
from garkcli.report.rendering import _writer_of
from tests.cli.harness import gark
from tests.whole import sample

FAMILY = "tests/examples/families/sdirk.gark.yaml"
PLANE = "tests/examples/families/plane.gark.yaml"
NO_CLAIMS = "tests/examples/valid/smallest.gark.yaml"
KUTTA = "tests/bridges/sources/kutta.csv"
STEPS = ("--problem", "pendulum", "--steps", "1/2,1/4")
NAMES = {x: garkcli.load(x).name for x in ("rk4", "stoermer-verlet")}
Made = tuple[Callable[[], Any], tuple[str, ...], str]
MADE: dict[str, Made] = {
    "GarkMethod": (lambda: garkcli.load("rk4"), ("tableau", "rk4"), ""),
    "Outcome": (lambda: garkcli.check_file("rk4"), ("check", "rk4"), ""),
    "Analysis": (lambda: garkcli.analyse(NO_CLAIMS), ("check", NO_CLAIMS), NO_CLAIMS),
    "Stability": (lambda: garkcli.find_stability("rk4"), ("stability", "rk4"), NAMES["rk4"]),
    "Convergence": (
        lambda: garkcli.converge("rk4", "pendulum", steps=[0.5, 0.25]),
        ("converge", "rk4", *STEPS),
        NAMES["rk4"],
    ),
    "LongRun": (
        lambda: garkcli.long_run("rk4", "pendulum", 20, "1/10"),
        ("energy", "rk4", "--problem", "pendulum", "--t-end", "20"),
        NAMES["rk4"],
    ),
    "Comparison": (lambda: garkcli.compare("rk4", "heun"), ("diff", "rk4", "heun"), ""),
    "BackwardAnalysis": (
        lambda: garkcli.backward_analysis("stoermer-verlet", 3),
        ("modified", "stoermer-verlet", "--order", "3"),
        NAMES["stoermer-verlet"],
    ),
    "ModifiedRun": (
        lambda: garkcli.modified_run("stoermer-verlet", "pendulum", 2),
        (*("energy", "stoermer-verlet", "--modified", "2"), *("--problem", "pendulum")),
        NAMES["stoermer-verlet"],
    ),
    "Design": (lambda: garkcli.find_parameters(FAMILY), ("design", FAMILY), FAMILY),
    "Minimum": (
        lambda: garkcli.minimise(FAMILY, "error"),
        ("design", FAMILY, "--minimise", "error"),
        FAMILY,
    ),
    "StableValues": (
        lambda: garkcli.stable_values(FAMILY, "a-stable"),
        ("design", FAMILY, "--a-stable"),
        FAMILY,
    ),
    "StableValues of two parameters": (
        lambda: garkcli.stable_values(PLANE, "a-stable"),
        ("design", PLANE, "--a-stable"),
        PLANE,
    ),
    "ExistenceProof": (
        lambda: garkcli.prove_method_exists("kvaerno-3"),
        ("certificate", "kvaerno-3"),
        "",
    ),
    "MethodProof": (lambda: garkcli.prove_method("rk4"), ("certificate", "rk4"), ""),
    "Meaning": (lambda: garkcli.explain("density"), ("explain", "density"), "density"),
    "Audited": (lambda: list(garkcli.audit(KUTTA)), ("audit", KUTTA), ""),
}
"""A value of each kind, the command that prints it, and the name that it gives to the method."""
FILES = {"Analysis", "Stability", "BackwardAnalysis", "Comparison", "LongRun"}
"""Reports that have the path that the command was given, or of long runs whether the coefficients
make the steps symplectic.
"""


def first(made: Any) -> Any:
    """A value, or the first of several."""
    return made[0] if isinstance(made, list) else made


@cache
def made(kind: str) -> Any:
    """What is rendered, made once."""
    return MADE[kind][0]()


@pytest.mark.parametrize("kind", MADE)
def test_it_is_what_the_command_prints(kind: str) -> None:
    """In each format, line by line; the names of files apart, which a value does not know. Sweeps
    have a file of rows, and a test of their own.
    """
    _, command, name = MADE[kind]
    for format in sample(list(_writer_of(first(made(kind)))[2]), 2):
        printed = gark(*command, "--format", format).out.splitlines()
        shown = render(made(kind), format, name).splitlines()
        assert len(printed) > 1 or format == "github" or kind == "Audited"
        if kind in FILES:
            told = [line for line in printed if line not in shown]
            assert len(told) <= 5 <= len(shown), told
        else:
            assert shown == printed, format


def test_a_sweep_is_rendered(tmp_path: Path) -> None:
    """In each format of the command."""
    spec = tmp_path / "spec.yaml"
    text = "methods:\n  - {family: gauss, stages: [1, 2]}\ncolumns: [order]\n"
    spec.write_text(text, encoding="utf-8")
    rows = tmp_path / "spec.jsonl"
    report = garkcli.run_sweep(spec, rows)
    for name in ("text", "json", "markdown", "latex", "jsonl", "csv"):
        command = ("sweep", str(spec), "--resume", "--format", name)
        assert render(report, name) == gark(*command).out


def test_what_no_command_prints_is_refused() -> None:
    """A value of another kind, and a format that the command has not."""
    with pytest.raises(
        MethodError, match=r"no command prints values of the kind str; give .* analyse"
    ):
        render("rk4")
    with pytest.raises(UsageProblem, match="no format 'html' of GarkMethod"):
        render(garkcli.load("rk4"), "html")


def test_plots_are_drawn_and_saved(tmp_path: Path) -> None:
    """A run is saved; several convergence tests in one figure."""
    found = [garkcli.converge(x, "pendulum", steps=[0.5, 0.25]) for x in ("rk4", "heun")]
    run = garkcli.long_run("rk4", "pendulum", 2, "1/10")
    path = tmp_path / "energy.svg"
    garkcli.plot(run, path=path)
    assert "<svg" in path.read_text(encoding="utf-8")
    assert garkcli.plot(*found, names=["A"]).axes
    for results, said in (
        ([], "nothing to draw"),
        ([run, found[0]], "several kinds"),
        ([run, run], "not drawn together"),
        ([3], "no figure of the kind int"),
    ):
        with pytest.raises(MethodError, match=said):
            garkcli.plot(*results)
    with pytest.raises(UsageProblem, match=r"end it in \.png"):
        garkcli.plot(run, path=tmp_path / "errors.txt")


def test_two_springs_are_those_of_the_command() -> None:
    """One slow frequency, and an interval of them; colours count from 1."""
    one = garkcli.two_springs("collocation", "1/4")
    both = garkcli.two_springs("collocation", (0, 0.25), fast=1)
    assert one.stable
    assert (both.low, both.high) == (0, garkcli.load("heun").b[0] / 2)
    for slow, fast, said in (
        (-1, 1, "a square is not negative"),
        ((1, 1), 1, "not in ascending order"),
        (1, 0, "no colour 0"),
    ):
        with pytest.raises(MethodError, match=said):
            garkcli.two_springs("collocation", slow, fast)
    with pytest.raises(UsageProblem, match="did you mean 'a-stable'"):
        garkcli.stable_values(FAMILY, "astable")  # type: ignore[arg-type]
