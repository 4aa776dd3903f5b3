"""``gark energy --format json`` and its JSON Schema."""

from __future__ import annotations

from typing import NamedTuple, get_args

from flint import fmpq

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.history import Doubt, InvariantHistory, LongRun, Verdict
from garkcli.longtime.stability import Stability
from garkcli.longtime.symplecticity import Defect, Symplecticity
from garkcli.longtime.trend import Shape
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import (
    COUNT,
    DERIVATION,
    EXACT,
    FLAG,
    NUMBER,
    POSITION,
    SIZE,
    TEXT,
    Schema,
    nullable,
    one_of,
    published,
)
from garkcli.report.energy_text import Claim, Report
from garkcli.report.fault_json import Failure, failure_form
from garkcli.report.problem import Stepped
from garkcli.report.problem_json import NAME, TERMS
from garkcli.tableau.garkmethod import derivation_of

SCHEMA = "gark/energy/1"


def json_of(report: Report) -> str:
    """The report as JSON text."""
    form = _REPORTS[type(report.run.problem)]
    return form.text(report)


def json_of_failure(failure: Failure) -> str:
    """A run that has no result, as JSON."""
    return _FAILURE.text(failure)


def energy_report_schema() -> Schema:
    """The JSON Schema of these reports."""
    forms = (form.schema for form in _REPORTS.values())
    return published("report of gark energy", one_of(*forms, _FAILURE.schema))


class _Quantity(NamedTuple):
    """What became of one quantity, and the time that was reached."""

    history: InvariantHistory
    end: float

    @property
    def drift_in_all(self) -> float | None:
        """What the drift adds up to."""
        drift = self.history.drift
        if drift is None:
            return None
        return drift * self.end


def _float(x: fmpq | None) -> float | None:
    if x is None:
        return None
    return to_float(x)


def _turns(run: LongRun) -> int | None:
    """None where the steps are exact: nothing is counted then."""
    if run.digits is None:
        return None
    return run.turns


def _has_blown_up(run: LongRun) -> bool:
    return run.is_unstable and run.escaped is None


class _Measured(NamedTuple):
    """How symplectic the steps are, and the stability of the step map of the oscillator."""

    found: Symplecticity
    stability: Stability | None


def _measured(report: Report) -> _Measured | None:
    """None where the problem is not Hamiltonian."""
    if report.symplecticity is None:
        return None
    return _Measured(report.symplecticity, report.run.stability)


def _determinant(measured: _Measured) -> str | None:
    """The determinant of M minus 1, of the step map of the oscillator."""
    stability = measured.stability
    if stability is None:
        return None
    difference = stability.determinant - 1
    return to_decimal(difference, 4)


def _quantities(run: LongRun) -> list[_Quantity]:
    return [_Quantity(history, run.end) for history in run.invariants]


def _problem(run: LongRun) -> Stepped:
    return run.problem


_VERDICT: Schema = {"enum": [*get_args(Verdict)]}
_TREND: Schema = {"enum": [*get_args(Shape)]}
_QUANTITY: Record[_Quantity] = Record(
    Field("name", TEXT, lambda x: x.history.name),
    Field("initial", NUMBER, lambda x: x.history.initial),
    Field("max_error", SIZE, lambda x: x.history.max_error),
    Field("drift", NUMBER, lambda x: x.history.drift),
    Field("drift_uncertainty", SIZE, lambda x: x.history.uncertainty),
    Field("drift_in_all", NUMBER, lambda x: x.drift_in_all),
    Field("oscillation", SIZE, lambda x: x.history.amplitude),
    Field("round_off", SIZE, lambda x: x.history.round_off),
    Field("rounded_coefficients", SIZE, lambda x: x.history.coefficients),
    Field("verdict", _VERDICT, lambda x: x.history.verdict),
    Field("trend", _TREND, lambda x: x.history.shape),
    Field("t_end_to_decide", SIZE, lambda x: _float(x.history.longer)),
    Field("doubt", {"enum": [*get_args(Doubt), None]}, lambda x: x.history.doubt),
    Field("no_value_at", SIZE, lambda x: _float(x.history.no_value_at)),
)
_RUN: tuple[Field[LongRun], ...] = (
    Field("step", SIZE, lambda x: to_float(x.step)),
    Field("step_exact", EXACT, lambda x: str(x.step)),
    Field("t_end", SIZE, lambda x: to_float(x.t_end)),
    Field("t_end_exact", EXACT, lambda x: str(x.t_end)),
    Field("steps", COUNT, lambda x: x.steps),
    Field("digits", nullable(POSITION), lambda x: x.digits),
    Field("turns", nullable(COUNT), _turns),
    Field("blew_up", FLAG, _has_blown_up),
    Field("escaped_at", SIZE, lambda x: _float(x.escaped)),
    Field("drifts", FLAG, lambda x: x.drifts),
    _QUANTITY.every("quantities", _quantities),
)
_DEFECT: Record[Defect] = Record(
    Field("t", SIZE, lambda x: to_float(x.time)),
    Field("size", SIZE, lambda x: x.size),
    Field("good_to", SIZE, lambda x: x.error),
)
_SYMPLECTIC: Record[_Measured] = Record(
    Field("proved", FLAG, lambda x: x.found.is_proved),
    Field("determinant_minus_1", TEXT, _determinant, is_optional=True),
    _DEFECT.every("defects", lambda x: x.found.defects),
)
_CLAIM: Record[Claim] = Record(
    Field("claim", TEXT, lambda x: x.claim),
    Field("found", TEXT, lambda x: x.found),
    Field("holds", FLAG, lambda x: x.holds),
)
_REPORTS: dict[type[Stepped], Record[Report]] = {
    kind: Record(
        schema_named(SCHEMA),
        *inside(lambda x: x.run, inside(_problem, [NAME, *terms])),
        Field("name", TEXT, lambda x: x.name),
        Field("derivation", DERIVATION, lambda x: derivation_of(x.run.method)),
        *inside(lambda x: x.run, _RUN),
        _SYMPLECTIC.or_null("symplectic", _measured),
        _CLAIM.every("claims", lambda x: x.claims),
    )
    for kind, terms in TERMS.items()
}
"""By the kind of the problem."""
_FAILURE = failure_form(SCHEMA)
