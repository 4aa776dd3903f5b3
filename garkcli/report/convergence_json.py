"""``gark converge --format json``, of one method and of several, and its JSON Schema."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, get_args

from flint import arb

from garkcli.convergence.result import Convergence, Cost, Row, Verdict
from garkcli.exact.display import to_float
from garkcli.page.figures import for_programs
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
    array,
    nullable,
    one_of,
    published,
)
from garkcli.report.convergence_data import DIGITS, SLOPE_DIGITS, Entry, invariant_names
from garkcli.report.fault_json import FAULT, Failure, failure_form
from garkcli.report.problem_json import NAME, TERMS, Stepped
from garkcli.tableau.garkmethod import derivation_of

SCHEMA = "gark/converge/1"
SCHEMA_OF_SEVERAL = "gark/converge-comparison/1"


def json_of(result: Convergence, name: str, with_work: bool) -> str:
    """One test as JSON."""
    form = _REPORTS[type(result.problem)]
    return form.text(_Test(result, name, with_work))


def json_of_failure(failure: Failure) -> str:
    """A test that has no result, as JSON."""
    return _FAILURE.text(failure)


def json_of_several(entries: Sequence[Entry], with_work: bool) -> str:
    """Several tests as JSON."""
    tried = [_Tried(entry, with_work) for entry in entries]
    return _COMPARISON.text(tried)


def converge_report_schema() -> Schema:
    """The JSON Schema of these reports, of one method or of several."""
    alone = (form.schema for form in _REPORTS.values())
    schema = one_of(*alone, _FAILURE.schema, _COMPARISON.schema)
    return published("report of gark converge", schema)


class _Test(NamedTuple):
    """The test of one method, and whether the costs of its steps are told."""

    result: Convergence
    name: str
    with_work: bool


class _Tried(NamedTuple):
    """A method of a comparison, and whether the costs of its steps are told."""

    entry: Entry
    with_work: bool

    @property
    def test(self) -> _Test | None:
        """Its test, where there is one."""
        result = self.entry.result
        if result is None:
            return None
        return _Test(result, self.entry.name, self.with_work)


class _Step(NamedTuple):
    """A row, and the names of the invariants besides the energy."""

    row: Row
    names: Sequence[str]

    @property
    def errors(self) -> dict[str, arb]:
        """The errors of the invariants."""
        return dict(zip(self.names, self.row.invariant_errors, strict=True))

    @property
    def in_numbers(self) -> dict[str, float | None]:
        """The same in floats; None where one is unknown."""
        return {name: _number(error) for name, error in self.errors.items()}

    @property
    def below_round_off(self) -> list[str] | None:
        """The quantities whose error is below round-off; None where there are none."""
        measured = dict(self.errors)
        if self.row.energy_error is not None:
            measured = {"energy": self.row.energy_error, **measured}
        below = []
        for name, x in measured.items():
            if x.is_finite() and x.contains(0) and not x.is_zero():
                below.append(name)
        return below or None


def _number(ball: arb) -> float | None:
    digits = for_programs(ball, DIGITS)
    return float(digits) if digits else None


def _energy_error(step: _Step) -> float | None:
    """None where there is no energy."""
    error = step.row.energy_error
    if error is None:
        return None
    return _number(error)


def _place(order: float | None) -> float | None:
    """An order or slope in as many decimal places as say something; never −0."""
    if order is None:
        return None
    return round(order, SLOPE_DIGITS) + 0.0


_BELOW_ROUND_OFF: Field[_Step] = Field(
    "below_round_off", array(TEXT), lambda x: x.below_round_off, is_optional=True
)
_ERRORS: Schema = {"type": "object", "additionalProperties": SIZE}
_STEP: Record[_Step] = Record(
    Field("h", SIZE, lambda x: to_float(x.row.h)),
    Field("h_exact", EXACT, lambda x: str(x.row.h)),
    Field("error", SIZE, lambda x: _number(x.row.error)),
    Field("slope", NUMBER, lambda x: _place(x.row.slope)),
    Field("energy_error", SIZE, _energy_error),
    Field("digits", nullable(POSITION), lambda x: x.row.digits),
    Field("invariant_errors", _ERRORS, lambda x: x.in_numbers),
    _BELOW_ROUND_OFF,
)
_COST: Record[Cost] = Record(
    Field("steps", COUNT, lambda x: x.steps),
    Field("evaluations", COUNT, lambda x: x.evaluations),
    Field("newton_iterations", COUNT, lambda x: x.iterations),
    Field("jacobians", COUNT, lambda x: x.jacobians),
    Field("seconds", SIZE, lambda x: x.seconds),
)
_WORKED_STEP: Record[_Step] = Record(*_STEP.fields, _COST.or_null("work", lambda x: x.row.cost))


def _steps(test: _Test) -> list[dict[str, Any]]:
    names = invariant_names(test.result)
    form = _WORKED_STEP if test.with_work else _STEP
    return [form.data(_Step(row, names)) for row in test.result.rows]


_SHORT: Record[Convergence] = Record(
    Field("t_end", EXACT, lambda x: str(x.short_time)),
    Field("observed_order", NUMBER, lambda x: _place(x.short_order)),
)


def _resolution(result: Convergence) -> float | None:
    """The smallest h ‖∂f/∂y‖ in a few digits."""
    if result.stiff is None:
        return None
    three_digits = f"{result.stiff.resolution:.3g}"
    return float(three_digits)


def _stage_order(result: Convergence) -> int | None:
    if result.stiff is None:
        return None
    return result.stiff.stage_order


_STIFF: Record[Convergence] = Record(
    Field("least_h_times_norm", SIZE, _resolution),
    Field("classical_order", COUNT, lambda x: x.predicted_order),
    Field("stage_order", nullable(COUNT), _stage_order),
    Field("slope", NUMBER, lambda x: _place(x.observed_order)),
)


def _if_stiff(result: Convergence) -> Convergence | None:
    if result.stiff is None:
        return None
    return result


def _problem(result: Convergence) -> Stepped:
    return result.problem


def _if_short(result: Convergence) -> Convergence | None:
    if result.short_time is None:
        return None
    return result


_VERDICT: Schema = {"enum": [*get_args(Verdict)]}
_RESULT: tuple[Field[Convergence], ...] = (
    Field("t_end", EXACT, lambda x: str(x.t_end)),
    Field("predicted_order", COUNT, lambda x: x.predicted_order),
    Field("visible_order", COUNT, lambda x: x.visible_order),
    Field("visible_order_is_exact", FLAG, lambda x: x.visible.is_sharp),
    Field("observed_order", NUMBER, lambda x: _place(x.observed_order)),
    Field("agrees", FLAG, lambda x: x.agrees),
    Field("verdict", _VERDICT, lambda x: x.verdict),
    Field("plateau", COUNT, lambda x: x.plateau),
    _SHORT.optional("short", _if_short),
    _STIFF.optional("stiff", _if_stiff),
)
_STEPS: Schema = array(one_of(_STEP.schema, _WORKED_STEP.schema))
_REPORTS: dict[type[Stepped], Record[_Test]] = {
    kind: Record(
        schema_named(SCHEMA),
        *inside(lambda x: x.result, inside(_problem, [NAME])),
        Field("name", TEXT, lambda x: x.name),
        Field("derivation", DERIVATION, lambda x: derivation_of(x.result.method)),
        *inside(lambda x: x.result, (*inside(_problem, terms), *_RESULT)),
        Field("steps", _STEPS, _steps),
        Field("note", TEXT, lambda x: x.result.visible.trees),
    )
    for kind, terms in TERMS.items()
}
"""By the kind of the problem."""
_FAILURE = failure_form(SCHEMA)
_HEAD: tuple[Field[_Tried], ...] = (
    Field("file", TEXT, lambda x: x.entry.file),
    Field("ok", FLAG, lambda x: x.entry.exit_code == 0),
)
_TESTED: dict[type[Stepped], Record[_Tried]] = {
    kind: Record(*_HEAD, *inside(lambda x: x.test, form.fields)) for kind, form in _REPORTS.items()
}
_UNTESTED: Record[_Tried] = Record(
    *_HEAD,
    Field("name", TEXT, lambda x: x.entry.name),
    FAULT.every("errors", lambda x: x.entry.faults),
)


def _results(tried: Sequence[_Tried]) -> list[dict[str, Any]]:
    return [_form(x).data(x) for x in tried]


def _form(tried: _Tried) -> Record[_Tried]:
    """The fields of a method that was tested, or was not."""
    result = tried.entry.result
    if result is None:
        return _UNTESTED
    kind = type(result.problem)
    return _TESTED[kind]


def _failed(tried: Sequence[_Tried]) -> int:
    return sum(x.entry.exit_code != 0 for x in tried)


_OF_TESTED = [form.schema for form in _TESTED.values()]
_RESULTS: Schema = array(one_of(_UNTESTED.schema, *_OF_TESTED))
_SUMMARY: Record[Sequence[_Tried]] = Record(
    Field("files", COUNT, len), Field("failed", COUNT, _failed)
)
_COMPARISON: Record[Sequence[_Tried]] = Record(
    schema_named(SCHEMA_OF_SEVERAL),
    Field("results", _RESULTS, _results),
    _SUMMARY.whole("summary", lambda x: x),
)
