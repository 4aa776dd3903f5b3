"""Convergence tests in text keep within a terminal whatever they are about."""

from __future__ import annotations

from functools import cache

import pytest
from flint import arb, fmpq

from garkcli.convergence.convergence import converge
from garkcli.convergence.result import Convergence, Cost, Visible
from garkcli.errors import Remark
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.problems.builtin import hamiltonian
from garkcli.report.comparison import REPORT as SEVERAL
from garkcli.report.comparison import ConvergedMethod, ConvergedMethods
from garkcli.report.convergence import REPORT, ConvergenceReport
from garkcli.tableau.forms import gark

NAMES = ("rk4", "a long name " * 20, "word-without-spaces" * 4, "方法" * 15)
STEPS = [fmpq(2, 12345678), fmpq(1, 12345678)]


@cache
def result_with(invariants: int, name: str = "angular momentum about the centre") -> Convergence:
    """A test whose problem has so many invariants, and rows with long numbers."""
    found = converge(gark([diagonal_method("rk4")], {}), hamiltonian("kepler", 1), steps=[fmpq(1)])
    expression = found.problem.invariants[0][1]  # type: ignore[union-attr]
    named = tuple((f"{name} {k}", expression) for k in range(invariants))
    problem = replace(found.problem, name="Kepler's problem " * 9, invariants=named)  # type: ignore[type-var]
    cost = Cost(1_000_000, 987_654_321, 123_456_789, 12_345_678, 1.5e-3)
    errors = (arb(1) / 3,) * invariants
    rows = [
        replace(found.rows[0], h=h, digits=1000, cost=cost, invariant_errors=errors) for h in STEPS
    ]
    visible = Visible(12, False, "it sees " + "trees of many kinds, " * 12)
    return replace(
        found,
        problem=problem,
        rows=tuple(rows),
        observed_order=11.98,
        short_time=fmpq(4, 10**96),
        short_order=3.0,
        visible=visible,
        plateau=1,
    )


def width(text: str) -> int:
    """Of the longest line."""
    return max(map(len, text.splitlines()))


@pytest.mark.parametrize("with_work", [False, True])
@pytest.mark.parametrize("invariants", [0, 1, 2, 5])
@pytest.mark.parametrize("name", NAMES)
def test_one_method(name: str, invariants: int, with_work: bool) -> None:
    """Every error of every invariant is there, and no line is wider than 80 columns."""
    for verbosity in (0, 1):
        test = ConvergenceReport(result_with(invariants), name, with_work)
        text = REPORT.render([test], verbosity=verbosity)
        assert width(text) <= 80
        assert text.count("0.3333") == 2 * invariants


def test_long_names_of_invariants() -> None:
    """They are cut, not the table."""
    assert width(REPORT.render([ConvergenceReport(result_with(2, "x" * 200), "rk4")])) <= 80


@pytest.mark.parametrize("with_work", [False, True])
@pytest.mark.parametrize("count", [2, 5, 30])
def test_several_methods(count: int, with_work: bool) -> None:
    """Names, verdicts, remarks, faults, costs and the plot."""
    made = []
    for k in range(count):
        file = f"folder/{'deep/' * 30}{k}.gark.yaml"
        name = NAMES[k % len(NAMES)]
        if k == 1:
            made.append(ConvergedMethod(file, name, None, (Remark("no such thing " * 20),), 2))
        else:
            made.append(ConvergedMethod(file, name, result_with(1), (), 0))
    compared = ConvergedMethods(made, with_work, "evaluations" if with_work else "h")
    assert width(SEVERAL.render([compared], verbosity=1)) <= 80


def test_plots_fit_narrow_terminals() -> None:
    """60 columns, with costs too."""
    result = converge(gark([diagonal_method("rk4")], {}), hamiltonian("pendulum", 1), is_timed=True)
    for with_work in (False, True):
        test = ConvergenceReport(result, "rk4", with_work, "evaluations" if with_work else "h")
        lines = REPORT.render([test], verbosity=1).splitlines()
        start = next(k for k, line in enumerate(lines) if line.strip() == "error")
        assert max(map(len, lines[start:])) <= 60
    entries = [ConvergedMethod("a", "a", result, (), 0), ConvergedMethod("b", "b", result, (), 0)]
    for against in ("h", "evaluations", "seconds"):
        lines = SEVERAL.render([ConvergedMethods(entries, True, against)], verbosity=1).splitlines()
        start = next(k for k, line in enumerate(lines) if line.strip() == "error")
        assert max(map(len, lines[start:])) <= 60
