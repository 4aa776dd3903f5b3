"""Several convergence tests in one report: text within the terminal, JSON and CSV with
everything.
"""

from __future__ import annotations

import csv
import io
import json
from functools import cache

import pytest
from flint import arb, fmpq

from garkcli.convergence.convergence import converge
from garkcli.convergence.result import Convergence, Cost, StepSizeRow, curve
from garkcli.errors import Remark
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.page.figures import rounded, scientific
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.report.comparison import REPORT, ConvergedMethod, ConvergedMethods, letters
from garkcli.report.convergence import REPORT as OF_ONE
from garkcli.report.convergence import ConvergenceReport
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau

NAMES = ("explicit-euler", "heun", "kutta", "rk4")


def render(
    entries: list[ConvergedMethod], format: str, with_work: bool = False, against: str = "h"
) -> str:
    """The report of several tests."""
    return REPORT.render([ConvergedMethods(entries, with_work, against)], format)


def render_one(result: Convergence, name: str, format: str, with_work: bool = False) -> str:
    """That of one."""
    return OF_ONE.render([ConvergenceReport(result, name, with_work)], format)


def method(name: str) -> Tableau:
    """One explicit method."""
    return gark([diagonal_method(name)], {})


@cache
def on_kepler(name: str, with_work: bool = False) -> Convergence:
    """Its test on a problem with an invariant, in two rows."""
    return converge(
        method(name),
        hamiltonian("kepler", 1),
        steps=[fmpq(1, 64), fmpq(1, 128)],
        is_timed=with_work,
    )


@cache
def on_oscillator(name: str) -> Convergence:
    """Its test on the oscillator."""
    return converge(
        method(name), Oscillator.default(1, fmpq(1)), fmpq(4), [fmpq(1, 4), fmpq(1, 8), fmpq(1, 16)]
    )


def entries(count: int) -> list[ConvergedMethod]:
    """As many methods on the oscillator."""
    made = [on_oscillator(NAMES[k % len(NAMES)]) for k in range(count)]
    return [
        ConvergedMethod(f"{k}.gark.yaml", f"method {k}", result, (), int(not result.agrees))
        for k, result in enumerate(made)
    ]


FAILED = ConvergedMethod(
    "bad.gark.yaml",
    "bad.gark.yaml",
    None,
    (Remark("no such file", "look elsewhere", 3, 4, "no-such-file"),),
    2,
)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 9])
def test_text_fits_the_terminal(count: int) -> None:
    """Every method has its letter, its errors, its verdict, and no line is wider than 80
    columns.
    """
    found = render(entries(count), "text")
    lines = found.splitlines()
    assert max(map(len, lines)) <= 80
    assert all(line == line.rstrip() for line in lines)
    for letter, entry in zip(letters(count), entries(count), strict=True):
        assert any(x.startswith(f"  {letter} ") and x.endswith(entry.name) for x in lines)
        assert entry.result is not None
        assert scientific(entry.result.rows[-1].error) in found
    assert sum("they agree " in line or "THEY DISAGREE " in line for line in lines) == count


def test_methods_keep_their_step_sizes() -> None:
    """Each error is in the row of its step size; where a method has no such step the cell is
    empty.
    """
    first, second = entries(2)
    assert isinstance(second.result, Convergence)
    second = replace(second, result=replace(second.result, rows=second.result.rows[1:]))
    lines = render([first, second], "text").splitlines()
    quarter = next(line for line in lines if line.split()[:1] == ["1/4"])
    eighth = next(line for line in lines if line.split()[:1] == ["1/8"])
    assert len(quarter.split()) == 2
    assert len(eighth.split()) == 5 - (second.result.rows[0].slope is None)  # type: ignore[union-attr]


def test_failures_are_told_among_the_others() -> None:
    """A method without a result has a verdict of its own and the reason, in all formats."""
    text = render([*entries(1), FAILED], "text")
    assert "FAILED" in text
    assert ["B", "no", "such", "file"] in [line.split() for line in text.splitlines()]
    data = json.loads(render([*entries(1), FAILED], "json"))
    assert data["schema"] == "gark/converge-comparison/1"
    assert data["summary"] == {"files": 2, "failed": 1}
    assert [x["ok"] for x in data["results"]] == [True, False]
    assert data["results"][1]["errors"] == [
        {
            "line": 3,
            "column": 4,
            "code": "no-such-file",
            "message": "no such file",
            "help": "look elsewhere",
        }
    ]
    assert {
        row["file"] for row in csv.DictReader(io.StringIO(render([*entries(1), FAILED], "csv")))
    } == {"0.gark.yaml"}
    assert render([FAILED], "csv").count("\n") == 1
    assert "FAILED" in render([FAILED], "text")


def test_same_names_are_told_apart() -> None:
    """Two methods of one name are shown with their files, others without."""
    first, second = (replace(entry, name="twin") for entry in entries(2))
    text = render([first, second, replace(entries(3)[2], name="other")], "text")
    assert "  twin (0.gark.yaml)\n" in text
    assert "  other\n" in text


def test_results_in_json_are_those_of_single_tests() -> None:
    """A comparison has for each method the very fields of its own report, and which file it is."""
    alone = json.loads(render_one(on_kepler("rk4"), "rk4", "json"))
    entry = ConvergedMethod("x.gark.yaml", "rk4", on_kepler("rk4"), (), 0)
    (among,) = json.loads(render([entry], "json"))["results"]
    assert among == {"file": "x.gark.yaml", "ok": True, **alone}


def test_csv_has_every_column() -> None:
    """Step, error, slope, energy error, each invariant, digits, with work the costs; quoted where
    it has to be.
    """
    name = 'say "rk4", the classical one'
    entry = ConvergedMethod("a,b.gark.yaml", name, on_kepler("rk4", True), (), 0)
    rows = list(csv.DictReader(io.StringIO(render([entry], "csv", with_work=True))))
    assert list(rows[0]) == [
        *(
            "file",
            "method",
            "h",
            "h_exact",
            "error",
            "slope",
            "energy_error",
            "angular_momentum_error",
            "digits",
        ),
        *("steps", "evaluations", "newton_iterations", "jacobians", "seconds"),
    ]
    assert [row["method"] for row in rows] == [name] * 2
    assert rows[0]["file"] == "a,b.gark.yaml"
    for row, known in zip(rows, on_kepler("rk4", True).rows, strict=True):
        assert float(row["h"]) == float(arb(fmpq(*map(int, row["h_exact"].split("/")))))
        assert float(row["error"]) == pytest.approx(float(known.error), rel=1e-5)
        assert float(row["angular_momentum_error"]) == pytest.approx(
            float(known.invariant_errors[0]), rel=1e-5
        )
        assert known.cost is not None
        assert int(row["evaluations"]) == known.cost.evaluations == 8 * known.cost.steps
        assert float(row["seconds"]) > 0
    alone = list(csv.DictReader(io.StringIO(render_one(on_kepler("rk4"), "rk4", "csv"))))
    assert alone == [{k: row[k] for k in alone[0]} for row in rows]


def with_costs(name: str, costs: list[Cost | None], errors: list[float]) -> ConvergedMethod:
    """A method with these errors and costs."""
    rows = tuple(
        StepSizeRow(fmpq(1, 2**k), arb(e), None, arb(0), cost=c)
        for k, (e, c) in enumerate(zip(errors, costs, strict=True))
    )
    return ConvergedMethod(
        f"{name}.gark.yaml", name, replace(on_oscillator("rk4"), rows=rows), (), 0
    )


def test_costs_of_equal_errors() -> None:
    """10^2.5 times the evaluations for 5 decades make 10^0.5 for one; nothing is said beyond the
    rows.
    """
    costs: list[Cost | None] = [Cost(1, 100, 0, 0, 1e-3), Cost(2, round(10**4.5), 0, 0, 1e-1)]
    steep = with_costs("steep", costs, [10**-1.5, 10**-6.5])
    other = with_costs("other", [Cost(1, 50, 0, 0), None], [1e-1, 1e-3])
    text = render([steep, other], "text", with_work=True, against="evaluations")
    block = text[text.index("evaluations for an error of") :].splitlines()
    heads, first = block[0].split()[5:], block[1].split()[1:]
    assert block[0].startswith("evaluations for an error of  ")
    assert dict(zip(heads, first, strict=True)) == {
        "1e-2": "178",
        "1e-3": "562",
        "1e-4": "1778",
        "1e-5": "5623",
        "1e-6": "17783",
    }
    assert block[2].split() == ["B"]
    assert "no seconds where floats do not reach the error" in text
    assert max(map(len, text.splitlines())) <= 80


def test_points_of_a_plot() -> None:
    """Only rows whose cost is known can be plotted against it."""
    entry = with_costs("one", [Cost(1, 50, 0, 0), None, Cost(4, 200, 0, 0, 0.5)], [1e-1, 1e-2, 0.0])
    assert entry.result is not None
    assert [float(x) for x, _ in curve(entry.result, "evaluations")] == [50]
    assert list(curve(entry.result, "seconds")) == []


def test_work_of_one_method_in_text() -> None:
    """A table of costs below the errors, and the plot against evaluations."""
    text = render_one(on_kepler("rk4", True), "rk4", "text", with_work=True)
    cells = [x for line in text.splitlines() if line.split()[:1] == ["1/64"] for x in line.split()]
    at = cells.index("128")
    assert [x for x in cells[at:] if x != "1/64"][:4] == ["128", "1024", "0", "0"]
    assert max(map(len, text.splitlines())) <= 80


def test_oscillator_has_costs_too() -> None:
    """Its step map is not stepped, so that the costs are of the same method on the same problem, in
    steps.
    """
    steps = [fmpq(1, 4), fmpq(1, 8), fmpq(1, 16)]
    problem = Oscillator.default(1, fmpq(1))
    result = converge(method("rk4"), problem, steps=steps, is_timed=True)
    assert [row.cost.evaluations for row in result.rows if row.cost is not None] == [128, 256, 512]
    assert all(row.cost is not None and row.cost.seconds is not None for row in result.rows)
    plain = on_oscillator("rk4").rows
    assert [float(x.error) for x in result.rows] == [float(x.error) for x in plain]


def test_oscillator_beyond_floats_is_counted_without_time() -> None:
    """Gauss 8 with h = 1/4 has an error of 1e-26: more digits, more iterations, no time."""
    tableau = gark([diagonal_method("gauss", 8)], {})
    steps = [fmpq(2), fmpq(1, 4)]
    result = converge(tableau, Oscillator.default(1, fmpq(1)), steps=steps, is_timed=True)
    coarse, fine = (row.cost for row in result.rows)
    assert coarse is not None
    assert fine is not None
    assert coarse.seconds is not None
    assert fine.seconds is None
    assert fine.evaluations / fine.steps > coarse.evaluations / coarse.steps


def test_letters_never_end() -> None:
    """Sixty methods have sixty different names."""
    assert len(set(letters(60))) == 60
    assert letters(3) == ["A", "B", "C"]


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (arb("9.996e-7"), "1.00e-6"),
        (arb(1), "1.00e0"),
        (arb("1e-5000"), "1.00e-5000"),
        (arb(0), "0"),
    ],
)
def test_scientific_numbers(x: arb, text: str) -> None:
    """Rounding may carry into the exponent; there is no smallest number."""
    assert scientific(x) == text
    assert rounded(arb(0)) == "0"
