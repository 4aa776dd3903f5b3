"""``gark stability --format json`` and its JSON Schema: the report of a file, by its kind."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from garkcli.exact.display import decimal
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import DERIVATION, FLAG, TEXT, Schema, array, nullable, one_of, published
from garkcli.report.stability_data import StabilityReport
from garkcli.report.stability_fields import (
    FRACTION,
    IMEX,
    LINEAR,
    OF_COLOUR,
    OSCILLATOR,
    RADIUS,
    RATIO,
    SLOW_INTERVAL,
    SPRINGS,
    Shown,
    ratio,
)
from garkcli.stability.colours import Colours
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.slow_interval import SlowInterval
from garkcli.stability.ssp import AdditiveRadius
from garkcli.stability.summary import LinearStability
from garkcli.stability.two_frequencies import TwoFrequencies

SCHEMA = "gark/stability/1"


def json_of(reports: Sequence[StabilityReport]) -> str:
    """All reports as JSON text."""
    return _REPORT.text(reports)


def stability_report_schema() -> Schema:
    """The JSON Schema of these reports."""
    return published("report of gark stability", _REPORT.schema)


def _alike(report: StabilityReport) -> Shown[LinearStability]:
    return Shown(report.found.linear[0], report.digits)


def _alone(report: StabilityReport) -> list[Shown[LinearStability]]:
    return [Shown(one, report.digits) for one in report.found.linear[1:]]


def _colours(report: StabilityReport) -> Colours:
    assert report.found.colours is not None
    return report.found.colours


def _radii(report: StabilityReport) -> list[Shown[AdditiveRadius]]:
    return [Shown(radius, report.digits) for radius in _colours(report).radii]


def _pair(report: StabilityReport) -> Shown[Colours] | None:
    colours = _colours(report)
    return None if colours.pair is None else Shown(colours, report.digits)


def _oscillator(report: StabilityReport) -> Shown[OscillatorStability]:
    assert report.found.oscillator is not None
    return Shown(report.found.oscillator, report.digits)


def _springs(report: StabilityReport) -> Shown[TwoFrequencies]:
    assert report.springs is not None
    return Shown(report.springs, report.digits)


def _slow(report: StabilityReport) -> Shown[SlowInterval]:
    assert report.slow is not None
    return Shown(report.slow, report.digits)


def _tolerance(report: StabilityReport) -> str | None:
    tolerance = report.found.tolerance
    return None if tolerance is None else decimal(tolerance)


def _algebraic(report: StabilityReport) -> bool | None:
    found = report.found
    if found.algebraic is None:
        return found.algebraic_within
    return found.algebraic.holds


def _head(kind: str) -> tuple[Field[StabilityReport], ...]:
    return (
        Field("file", TEXT, lambda x: x.file),
        Field("name", TEXT, lambda x: x.name),
        Field("derivation", DERIVATION, lambda x: x.derivation),
        Field("kind", {"const": kind}, lambda _: kind),
        Field("tolerance", nullable(TEXT), _tolerance),
    )


_ALIKE = inside(_alike, LINEAR)
_ALONE = OF_COLOUR.every("colours", _alone)
_Fields = tuple[Field[StabilityReport], ...]
_LINEAR_PART: dict[str, _Fields] = {
    "none": _head("oscillator"),
    "alike": (*_head("linear"), *_ALIKE, _ALONE),
    "several": (
        *_head("linear"),
        FRACTION.or_null("R", lambda x: _colours(x).R),
        *_ALIKE[1:],
        _ALONE,
        Field("R_alike", RATIO, lambda x: ratio(x.found.linear[0].R, "z")),
        RADIUS.every("ssp_radii", _radii),
        IMEX.or_null("pair", _pair),
    ),
}
"""By what the colours do on the linear test equation: ``R`` has a z for each colour, or one."""
_OSCILLATOR_PART: dict[bool, _Fields] = {False: (), True: inside(_oscillator, OSCILLATOR)}
"""By whether the method has a split for the oscillator."""
_FORMS: dict[tuple[str, bool], Record[StabilityReport]] = {
    (linear, oscillates): Record(
        *_LINEAR_PART[linear],
        *_OSCILLATOR_PART[oscillates],
        Field("algebraically_stable", nullable(FLAG), _algebraic),
    )
    for linear, oscillates in product(_LINEAR_PART, _OSCILLATOR_PART)
}
_TWO_FREQUENCIES: Record[StabilityReport] = Record(
    *_head("two-frequencies"), *inside(_springs, SPRINGS)
)
_SLOW_INTERVAL: Record[StabilityReport] = Record(
    *_head("slow-interval"), *inside(_slow, SLOW_INTERVAL)
)


def _form(report: StabilityReport) -> Record[StabilityReport]:
    """The fields of a report."""
    if report.slow is not None:
        return _SLOW_INTERVAL
    if report.springs is not None:
        return _TWO_FREQUENCIES
    found = report.found
    linear = "none"
    if found.linear:
        linear = "alike" if found.colours is None else "several"
    return _FORMS[linear, found.oscillator is not None]


_FILE: Schema = one_of(
    _SLOW_INTERVAL.schema, _TWO_FREQUENCIES.schema, *(form.schema for form in _FORMS.values())
)
_REPORT: Record[Sequence[StabilityReport]] = Record(
    schema_named(SCHEMA), Field("files", array(_FILE), lambda xs: [_form(x).data(x) for x in xs])
)
