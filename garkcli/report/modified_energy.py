"""``gark energy --modified``: the energy error in the modified Hamiltonian, over step sizes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil
from typing import Any, NamedTuple, get_args

from flint import fmpq

from garkcli.backward.energy import ModifiedEnergy, ModifiedRun, Verdict
from garkcli.convergence.result import StepSizeRow as Step
from garkcli.frozen import Frozen
from garkcli.page.figures import scientific
from garkcli.report.convergence import STEP_SIZE
from garkcli.report.problem import describe, driving
from garkcli.report.remarks import FAILURE, FailedRun
from garkcli.tableau.garkmethod import derivation_of
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import Answer, Json, Kind, Level, Row, Rows, Section, Words, maybe, via
from garkcli.tell.kinds import COUNT, DERIVATION, EXACT, POSITION, TEXT, TRUTH
from garkcli.tell.parts import SAID, parts, rows_of, shown, table, told
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
MOST = 12


class ModifiedEnergyReport(Frozen):
    name: str
    run: ModifiedRun


def _error(row: Step) -> float:
    return float(row.error.mid().str(6, radius=False))


def _terms(energy: ModifiedEnergy) -> str:
    """``to h^2``, or ``H`` alone."""
    return f"to h^{energy.power}" if energy.power else "H"


def _observed(energy: ModifiedEnergy) -> str:
    if energy.observed_order is None:
        return "no error above round-off"
    found = f"{energy.observed_order:.3f}"
    if energy.uncertainty is not None:
        rounded_up = max(1, ceil(1000 * energy.uncertainty)) / 1000
        found += f" ± {rounded_up:.3f}"
    return found if energy.has_settled else f"{found}, slopes have not settled"


def _verdict(verdict: str, d: Plain) -> str:
    if verdict == "disagree":
        return d.bad("DISAGREE")
    return d.good(verdict) if verdict == "agree" else d.note(verdict)


def _answer(energies: Sequence[ModifiedEnergy], d: Plain) -> str:
    found: dict[str, list[str]] = {}
    for energy in energies:
        found.setdefault(energy.verdict, []).append(_terms(energy))
    texts = (f"{_verdict(x, d)} for {d.prose(', '.join(terms))}" for x, terms in found.items())
    return f"orders {'; '.join(texts)}"


class Errors(NamedTuple):
    h: fmpq
    errors: list[tuple[ModifiedEnergy, Step]]


def _errors(run: ModifiedRun) -> Iterator[Errors]:
    for k, row in enumerate(run.energies[0].rows):
        yield Errors(row.h, [(energy, energy.rows[k]) for energy in run.energies])


def _cells(errors: list[tuple[ModifiedEnergy, Step]], d: Plain) -> list[tuple[str, str]]:
    cells = []
    for energy, row in errors:
        slope = "" if row.slope is None else f"{row.slope:.3f}"
        terms = d.prose(_terms(energy))
        cells += [(f"error {terms}", d.prose(scientific(row.error))), (f"slope {terms}", slope)]
    return cells


NUMBER: Kind[float] = Kind(Json({"type": "number"}))
STEP: Section[Step] = Section(
    Row("h", EXACT, lambda x: x.h),
    Row("error", NUMBER, _error),
    maybe("slope", NUMBER, lambda x: x.slope),
)
VERDICT: Kind[str] = Kind(Json({"enum": [*get_args(Verdict)]}), Words(_verdict))
ENERGY: Section[ModifiedEnergy] = Section(
    Row("terms", SAID, _terms, label=""),
    Row("power", COUNT, lambda x: x.power, DATA),
    Row("verdict", VERDICT, lambda x: x.verdict),
    Row("exact_order", COUNT, lambda x: Answer(x.exact_order, Status(at_least=x.is_lower_bound))),
    Row("exact_order_is_lower_bound", TRUTH, lambda x: x.is_lower_bound, DATA),
    Row("observed", SAID, _observed, label="observed order"),
    maybe("observed_order", NUMBER, lambda x: x.observed_order, DATA),
    maybe("uncertainty", NUMBER, lambda x: x.uncertainty, DATA),
    Row("rows", parts(STEP), lambda x: x.rows, DATA),
)
SIZES: Section[Errors] = Section(
    Row("h", STEP_SIZE, lambda x: x.h), Row("errors", rows_of(_cells), lambda x: x.errors)
)
RUN: Rows[ModifiedRun] = (
    Row("problem", TEXT, lambda x: x.problem.name, DATA),
    Row("answer", told(_answer), lambda x: x.energies, HEADLINE, label=""),
    Row(
        "problem_in_words",
        SAID,
        lambda x: f"{describe(x.problem)}; to t = {x.t_end}, {x.digits} digits",
        label="problem",
    ),
    Row("colours_in_words", SAID, driving, label="colours"),
    Row("t_end", EXACT, lambda x: x.t_end, DATA),
    Row("max_order", POSITION, lambda x: x.max_order, DATA),
    Row("digits", POSITION, lambda x: x.digits, DATA),
    Row("energies", table(ENERGY, MOST), lambda x: x.energies, label=""),
    Row(
        "errors",
        shown(SIZES, MOST),
        lambda x: list(_errors(x)),
        label="root mean square of H(t) - H(0), and with the modified terms of H",
    ),
)
MEASURED: Section[ModifiedEnergyReport] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("derivation", DERIVATION, lambda x: derivation_of(x.run.method), DATA),
    via(lambda x: x.run, RUN),
    title=lambda x, d: d.prose(x.name),
)
ERRORS: Kind[Sequence[tuple[ModifiedEnergy, Step]]] = Kind(
    Json({"type": "object"}, csv=lambda x: {f"error_{e.power}": repr(_error(s)) for e, s in x})
)
LINE: Section[Errors] = Section(
    Row("h", STEP_SIZE, lambda x: x.h), Row("errors", ERRORS, lambda x: x.errors)
)


def form(x: ModifiedEnergyReport | FailedRun) -> Section[Any]:
    return FAILURE if isinstance(x, FailedRun) else MEASURED


REPORT: Report[ModifiedEnergyReport | FailedRun] = Report(
    "gark/modified-energy/1",
    "report of gark energy --modified",
    lambda: (MEASURED, FAILURE),
    form,
    key="",
    lines=lambda x: (LINE, () if isinstance(x, FailedRun) else _errors(x.run)),
)


def whole(run: ModifiedRun, name: str) -> ModifiedEnergyReport:
    return ModifiedEnergyReport(name or ("" if run.method is None else run.method.name), run)
