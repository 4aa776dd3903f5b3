"""The energy error in the modified Hamiltonian has the order of the next power of h."""

from __future__ import annotations

import csv
import io
import json
from itertools import pairwise
from typing import Any

import pytest
from flint import arb, fmpq
from jsonschema import Draft7Validator

from garkcli import hamiltonian, load, loads
from garkcli.backward import energy
from garkcli.backward.energy import ModifiedRun, modified_run
from garkcli.backward.formulas import ModifiedFormula, PowerTerm, modified_formula
from garkcli.convergence.result import StepSizeRow, slope_between
from garkcli.errors import UsageProblem
from garkcli.frozen import replace
from garkcli.report.modified_energy import REPORT
from garkcli.stepping.integrator import StepFailed
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.whole import in_whole

VERLET = "methods/stoermer-verlet.gark.yaml"


def _verlet() -> Tableau:
    return load(VERLET).tableau


def _orders(run: ModifiedRun) -> list[tuple[int, int, bool, str]]:
    return [(x.power, x.exact_order, x.is_lower_bound, x.verdict) for x in run.energies]


@in_whole
def test_stoermer_verlet_on_the_pendulum() -> None:
    """Order 2 in H, and 4, 6, 8 with one, two, three terms more, each slope within a thousandth."""
    run = modified_run(_verlet(), hamiltonian("pendulum", 2), 7)
    assert _orders(run) == [
        (0, 2, False, "agree"),
        (2, 4, False, "agree"),
        (4, 6, False, "agree"),
        (6, 8, False, "agree"),
    ]
    for column in run.energies:
        assert column.observed_order == pytest.approx(column.exact_order, abs=1e-3)
        slopes = [row.slope for row in column.rows if row.slope is not None]
        assert slopes[-1] == pytest.approx(column.exact_order, abs=1e-3)
    first = [column.rows[0].error for column in run.energies]
    assert all(b < a / 100 for a, b in pairwise(first))


def test_other_structures() -> None:
    """A pair of four colours with coefficients in a number field, and a method of one vector field
    on a problem of one term.
    """
    coupled = pair(load("methods/collocation.gark.yaml").tableau)
    run = modified_run(coupled, hamiltonian("pendulum", 2), 5, fmpq(1))
    assert _orders(run) == [(0, 4, False, "agree"), (4, 6, False, "agree")]
    midpoint = loads("{A: [[1/2]], b: [1]}").tableau
    run = modified_run(midpoint, hamiltonian("pendulum", 1), 3, fmpq(1))
    assert _orders(run) == [(0, 2, False, "agree"), (2, 4, False, "agree")]


def _wrong(tableau: Tableau, problem: Any, order: int) -> ModifiedFormula:
    """A formula whose second term is a thousandth too large."""
    found = modified_formula(tableau, problem, order)
    terms = []
    for term in found.terms:
        (formula,) = term.formulas
        wrong = formula * 1001 / 1000 if term.power == 2 else formula
        terms.append(PowerTerm(term.power, (wrong,)))
    return replace(found, terms=tuple(terms))


def test_a_wrong_formula_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """With one coefficient off by a thousandth the error never comes to the order of the next
    power.
    """
    monkeypatch.setattr(energy, "modified_formula", _wrong)
    run = modified_run(_verlet(), hamiltonian("pendulum", 2), 3)
    assert [x.verdict for x in run.energies] == ["agree", "disagree"]
    assert run.is_refuted


def test_a_lower_bound_of_the_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the next power is beyond the trees that are looked at, the order is at least that."""
    monkeypatch.setattr(energy, "_BEYOND", 0)
    run = modified_run(_verlet(), hamiltonian("pendulum", 2), 3)
    assert _orders(run)[-1] == (2, 3, True, "agree")


def test_no_energy_error_at_all() -> None:
    """Without a force energy is kept, and nothing is claimed of an order."""
    problem = replace(hamiltonian("pendulum", 2), initial=(fmpq(0), fmpq(0)))
    run = modified_run(_verlet(), problem, 3)
    assert [x.verdict for x in run.energies] == ["undecided", "undecided"]
    assert not run.is_refuted


def test_what_has_no_modified_hamiltonian() -> None:
    """A method that is not symplectic or not consistent, and too many steps, are refused."""
    pendulum = hamiltonian("pendulum", 1)
    rk4 = load("methods/rk4.gark.yaml").tableau
    with pytest.raises(UsageProblem, match="not symplectic"):
        modified_run(rk4, pendulum, 3)
    half = loads("{A: [[1/4]], b: [1/2]}").tableau
    with pytest.raises(UsageProblem, match="not consistent"):
        modified_run(half, pendulum, 3)
    with pytest.raises(UsageProblem, match="steps"):
        modified_run(_verlet(), hamiltonian("pendulum", 2), 3, longest=fmpq(1, 10_000))


@pytest.mark.parametrize(("places", "digits"), [(20, 39), (40, 60), (50, 69), (130, 200)])
def test_digits_are_as_many_as_the_smallest_error_needs(places: int, digits: int) -> None:
    """Doubled until an error is seen, then enough for six halvings of h at order 2: 3.6 places."""

    class Seen(energy.Meter):
        def errors(self, count: int) -> list[arb]:  # noqa: ARG002
            return [arb(10) ** -places + arb(0, arb(10) ** (2 - self.digits))]

    meter = Seen(bound=None, formulas=(), powers=(0,), t_end=fmpq(1))  # type: ignore[arg-type]
    meter.choose_digits(4, 2)
    assert abs(meter.digits - digits) <= 1


def test_slopes_settle_above_rounding_alone() -> None:
    """Errors 2^-4k show order 4; too few, with rounding as large as they are, or without an order
    they show nothing.
    """

    def table(errors: list[arb]) -> list[StepSizeRow]:
        rows: list[StepSizeRow] = []
        for k, error in enumerate(errors):
            slope = slope_between(rows[-1] if rows else None, fmpq(1, 2**k), error)
            rows.append(StepSizeRow(fmpq(1, 2**k), error, slope, error, digits=30))
        return rows

    errors = [arb(2) ** (-4 * k) for k in range(energy.ROWS)]
    assert energy.slopes_have_settled(table(errors))
    assert not energy.slopes_have_settled(table(errors[:-1]))
    rounded = [*errors[:-1], arb(errors[-1].mid(), 2 * errors[-1].mid())]
    assert not energy.slopes_have_settled(table(rounded))
    erratic = [x * (k % 2 + 1) for k, x in enumerate(errors)]
    assert not energy.slopes_have_settled(table(erratic))


def test_the_command() -> None:
    """The table fits 80 columns; JSON has its schema; CSV the same errors; options that do not
    belong are refused.
    """
    arguments = ("energy", VERLET, "--problem", "pendulum", "--t-end", "1")
    run = gark(*arguments, "--modified", "7")
    assert run.code == 0
    assert ["to", "h^6", "agree", "8", "8.000", "±", "0.001"] in [
        x.split() for x in run.out.splitlines()
    ]
    lines = run.out.splitlines()
    assert all(len(line) <= 80 and line == line.rstrip() for line in lines)
    report = json.loads(gark(*arguments, "--modified", "3", "--format", "json").out)
    schema = REPORT.schema
    assert not list(Draft7Validator(schema).iter_errors(report))
    printed = json.loads(gark("schema", "--report", "modified-energy").out)
    for shown, form in zip(printed["oneOf"], schema["oneOf"], strict=True):
        assert list(shown["properties"]) == list(form["properties"])
    text = gark(*arguments, "--modified", "3", "--format", "csv").out
    rows = list(csv.DictReader(io.StringIO(text)))
    for k, column in enumerate(report["energies"]):
        assert column["power"] == 2 * k
        errors = [float(row[f"error_{column['power']}"]) for row in rows]
        assert errors == [row["error"] for row in column["rows"]]
    refused = gark(*arguments, "--bounded", "--modified")
    assert refused.code == 2
    assert "--bounded does not go with --modified" in refused.err


def test_long_step_sizes_fit_the_terminal() -> None:
    """Step sizes with many digits take columns from the errors."""
    time = ("--t-end", "1000/997", "--step", "1/30", "--modified", "7")
    run = gark("energy", VERLET, "--problem", "pendulum", *time)
    assert run.code == 0
    assert all(len(line) <= 80 for line in run.out.splitlines())
    assert "1000/495509" not in run.out
    assert "to h^6  agree              8 " in run.out


@in_whole
def test_a_step_that_fails() -> None:
    """Where a step leaves the domain of H that is told as of every run."""
    start = (fmpq(2), fmpq(0), fmpq(0), fmpq(0))
    kepler = replace(hamiltonian("kepler", 2), initial=start)
    with pytest.raises(StepFailed, match="step 1 of size 4"):
        # one kick and one drift of this size end in the centre
        modified_run(_verlet(), kepler, 3, fmpq(8), fmpq(4))
