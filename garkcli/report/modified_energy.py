"""``gark energy --modified``: the energy error in the modified Hamiltonian, over step sizes."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil

from garkcli.backward.energy import ModifiedEnergy, ModifiedRun
from garkcli.convergence.result import Row
from garkcli.exact.display import to_float
from garkcli.page.figures import scientific
from garkcli.page.paint import Paint, folded, indented
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import (
    COUNT,
    DERIVATION,
    EXACT,
    FLAG,
    POSITION,
    TEXT,
    Schema,
    nullable,
    one_of,
    published,
)
from garkcli.report.fault_json import Failure, failure_form
from garkcli.report.problem import describe, driving
from garkcli.tableau.garkmethod import derivation_of

SCHEMA = "gark/modified-energy/1"
_WIDTH = 80
_ERROR = 17  # columns of an error with its slope
_STYLES = {"agree": "good", "disagree": "bad", "undecided": "strong"}
_NUMBER: Schema = {"type": "number"}


@dataclass(frozen=True)
class ModifiedEnergyReport:
    """A measurement with the name of the method."""

    name: str
    run: ModifiedRun


def render(report: ModifiedEnergyReport, format: str, paint: Paint) -> str:
    """The report as text, JSON or CSV."""
    if format == "json":
        return _REPORT.text(report)
    if format == "csv":
        return _csv(report.run)
    return "\n".join(text_of(report, paint)) + "\n"


def render_failure(failure: Failure, format: str) -> str:
    """A measurement that has no result, for programs: its errors, or a table without rows. People
    are told elsewhere.
    """
    if format == "json":
        return _FAILURE.text(failure)
    return "h\n" if format == "csv" else ""


def text_of(report: ModifiedEnergyReport, paint: Paint) -> list[str]:
    """The lines of the report."""
    run = report.run
    problem = describe(run.problem)
    lines = [paint("strong", report.name)]
    lines += indented(folded(problem, _WIDTH - 2, "  "))
    lines += indented(filter(None, [driving(run)]))
    lines.append(f"  to t = {run.t_end}, {run.digits} digits")
    lines.append("  root mean square of H(t) - H(0), and with the modified terms of H")
    rows = run.energies[0].rows
    longest = max(len(str(row.h)) for row in rows)
    label = max(longest + 2, 8)
    room = _WIDTH - 2 - label
    beside = max(1, room // _ERROR)
    for first in range(0, len(run.energies), beside):
        some = run.energies[first : first + beside]
        lines.append("")
        lines += _block(some, label)
    lines.append("")
    for energy in run.energies:
        lines += _verdict(energy, paint)
    return lines


def _block(energies: Sequence[ModifiedEnergy], label: int) -> list[str]:
    """Some of the errors beside each other, with so many columns for the step size."""
    heading = "h".ljust(label)
    for energy in energies:
        heading += _title(energy).rjust(10)
        heading += "slope".rjust(7)
    lines = [f"  {heading}"]
    columns = [energy.rows for energy in energies]
    for rows in zip(*columns, strict=True):
        line = str(rows[0].h).ljust(label)
        for row in rows:
            line += scientific(row.error).rjust(10)
            line += _slope(row).rjust(7)
        lines.append(f"  {line.rstrip()}")
    return lines


def _title(energy: ModifiedEnergy) -> str:
    if not energy.power:
        return "H"
    return f"to h^{energy.power}"


def _slope(row: Row) -> str:
    if row.slope is None:
        return ""
    return f"{row.slope:.3f}"


def _verdict(energy: ModifiedEnergy, paint: Paint) -> Iterator[str]:
    """The exact order beside the observed one."""
    word = energy.verdict
    shown = "DISAGREE" if word == "disagree" else word
    painted = paint(_STYLES[word], shown)
    observed = _observed(energy)
    exact = str(energy.exact_order)
    if energy.is_lower_bound:
        exact = f"at least {exact}"
    title = _title(energy)
    yield f"  {title:<8}{painted}: {observed}, order {exact}"


def _observed(energy: ModifiedEnergy) -> str:
    if energy.observed_order is None:
        return "no error above round-off"
    found = f"observed {energy.observed_order:.3f}"
    if energy.uncertainty is not None:
        thousandths = ceil(1000 * energy.uncertainty)
        rounded_up = max(1, thousandths) / 1000
        found += f" ± {rounded_up:.3f}"
    if not energy.has_settled:
        found += ", slopes have not settled"
    return found


def _csv(run: ModifiedRun) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = [f"error_{energy.power}" for energy in run.energies]
    writer.writerow(["h", *names])
    columns = [energy.rows for energy in run.energies]
    for rows in zip(*columns, strict=True):
        errors = [repr(to_float_error(row)) for row in rows]
        h = to_float(rows[0].h)
        writer.writerow([repr(h), *errors])
    return stream.getvalue()


def to_float_error(row: Row) -> float:
    """The middle of an error, as it is shown."""
    middle = row.error.mid()
    shown = middle.str(6, radius=False)
    return float(shown)


def modified_energy_schema() -> Schema:
    """The JSON Schema of these reports, as plain data."""
    schema = one_of(_REPORT.schema, _FAILURE.schema)
    return published("report of gark energy --modified", schema)


_NUMBER_OR_NULL: Schema = nullable(_NUMBER)
_VERDICT: Schema = {"enum": [*_STYLES]}
_ROW: Record[Row] = Record(
    Field("h", EXACT, lambda x: str(x.h)),
    Field("error", _NUMBER, to_float_error),
    Field("slope", _NUMBER_OR_NULL, lambda x: x.slope),
)
_ENERGY: Record[ModifiedEnergy] = Record(
    Field("power", COUNT, lambda x: x.power),
    Field("exact_order", COUNT, lambda x: x.exact_order),
    Field("exact_order_is_lower_bound", FLAG, lambda x: x.is_lower_bound),
    Field("observed_order", _NUMBER_OR_NULL, lambda x: x.observed_order),
    Field("uncertainty", _NUMBER_OR_NULL, lambda x: x.uncertainty),
    Field("verdict", _VERDICT, lambda x: x.verdict),
    _ROW.every("rows", lambda x: x.rows),
)
_FAILURE = failure_form(SCHEMA)
_REPORT: Record[ModifiedEnergyReport] = Record(
    schema_named(SCHEMA),
    Field("name", TEXT, lambda x: x.name),
    Field("derivation", DERIVATION, lambda x: derivation_of(x.run.method)),
    Field("problem", TEXT, lambda x: x.run.problem.name),
    Field("t_end", EXACT, lambda x: str(x.run.t_end)),
    Field("max_order", POSITION, lambda x: x.run.max_order),
    Field("digits", POSITION, lambda x: x.run.digits),
    _ENERGY.every("energies", lambda x: x.run.energies),
)
