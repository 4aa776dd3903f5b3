"""``gark check --format json`` and its JSON Schema: exact numbers as strings, colours and stages
from 1; see docs/json.md.

Each field is declared once, with its schema and how it is computed; those of orders and of hints
in files of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from garkcli.exact.display import decimal
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, array, nullable, published
from garkcli.report.every_json import EVERY_FIELDS, EVERY_VERDICTS
from garkcli.report.fault_json import FAULT
from garkcli.report.further_json import FURTHER_FIELDS
from garkcli.report.hints_json import BLOCK, HINTS, blocks
from garkcli.report.order_json import SIMPLIFYING, order_fields
from garkcli.report.property_json import EVERY_PROPERTY, PROPERTIES

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Claim, Outcome
    from garkcli.tableau.tableau import Colour, Tableau

SCHEMA = "gark/check/1"


def render(outcomes: Sequence[Outcome]) -> str:
    """The report as JSON text."""
    return _REPORT.text(outcomes)


def as_data(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """The report as plain data."""
    return _REPORT.data(outcomes)


def check_report_schema() -> Schema:
    """The JSON Schema of these reports, as plain data."""
    return published("report of gark check", _REPORT.schema)


def colours_data(tableau: Tableau) -> list[dict[str, Any]]:
    """The colours with their stages."""
    return [COLOUR.data((tableau, colour)) for colour in tableau.colours]


def _stages(found: tuple[Tableau, Colour]) -> int:
    tableau, colour = found
    return tableau.spaces[colour.space].stages


def _tolerance(found: Analysis) -> str | None:
    if found.tolerance is None:
        return None
    return decimal(found.tolerance)


def _inconsistent(found: Analysis) -> list[list[int]]:
    return blocks(found.inconsistent)


def _conjugate_consistent(found: Analysis) -> bool | None:
    if found.conjugate is None:
        return None
    return not found.conjugate_inconsistent


def _colours(found: Analysis) -> list[dict[str, Any]]:
    return colours_data(found.tableau)


def _name(found: tuple[Tableau, Colour]) -> str:
    _, colour = found
    return colour.name


COLOUR: Record[tuple[Tableau, Colour]] = Record(
    Field("name", TEXT, _name), Field("stages", POSITION, _stages)
)
"""A colour of a tableau."""
_ANALYSIS: tuple[Field[Analysis], ...] = (
    Field("exact", FLAG, lambda x: x.tolerance is None),
    Field("tolerance", nullable(TEXT), _tolerance),
    Field("colours", array(COLOUR.schema), _colours),
    Field("consistent", FLAG, lambda x: not x.inconsistent),
    Field("inconsistent_blocks", array(BLOCK), _inconsistent),
    Field("conjugate_consistent", nullable(FLAG), _conjugate_consistent),
    Field("symplectic", FLAG, lambda x: x.symplectic),
    *inside(lambda x: x.order, order_fields()),
    *inside(lambda x: x.conjugate_order, order_fields("conjugate_")),
    *inside(lambda x: x.pair_order, order_fields("pair_")),
    *inside(lambda x: x.nonautonomous_order, order_fields("nonautonomous_")),
    *FURTHER_FIELDS,
    SIMPLIFYING.whole("simplifying", lambda x: x),
    Field("pair_bound", nullable(COUNT), lambda x: x.pair_bound),
    Field("sharp_bound", COUNT, lambda x: x.sharp_bound),
    Field("pair_sharp_bound", nullable(COUNT), lambda x: x.pair_sharp_bound),
    PROPERTIES.whole("properties", lambda x: x),
)
"""What was found of a method."""

_CLAIM: Record[Claim] = Record(
    Field("claim", TEXT, lambda x: x.claim),
    Field("expected", TEXT, lambda x: x.expected),
    Field("found", TEXT, lambda x: x.found),
    Field("holds", FLAG, lambda x: x.holds),
    Field("line", POSITION, lambda x: x.line),
    Field("why", TEXT, lambda x: x.why or None, is_optional=True),
)


def _errors(outcome: Outcome) -> list[dict[str, Any]]:
    return [FAULT.data(fault) for fault in outcome.faults]


_ERRORS: Schema = {**array(FAULT.schema), "minItems": 1}
_STRUCTURE: Schema = {"enum": ["general", "semi-separable", "separable", "nystrom"]}
_HEAD: tuple[Field[Outcome], ...] = (
    Field("file", TEXT, lambda x: x.file),
    Field("name", TEXT, lambda x: x.name),
)
_LEFT_BEHIND: Field[Outcome] = Field(
    "left_behind", array(TEXT), lambda x: list(x.left_behind) or None, is_optional=True
)
_CHECKED: Record[Outcome] = Record(
    *_HEAD,
    Field("ok", FLAG, lambda x: x.ok),
    Field("structure", _STRUCTURE, lambda x: x.structure),
    *inside(lambda x: x.analysis, _ANALYSIS),
    _LEFT_BEHIND,
    EVERY_PROPERTY,
    *HINTS,
    _CLAIM.every("claims", lambda x: x.claims),
)
_EVERY: Record[Outcome] = Record(
    *_HEAD,
    Field("ok", FLAG, lambda x: x.ok),
    Field("structure", _STRUCTURE, lambda x: x.structure),
    *inside(lambda x: x.every, EVERY_FIELDS),
    _LEFT_BEHIND,
    EVERY_VERDICTS,
    _CLAIM.every("claims", lambda x: x.claims),
)
_UNREADABLE: Record[Outcome] = Record(
    *_HEAD, Field("ok", {"const": False}, lambda x: x.ok), Field("errors", _ERRORS, _errors)
)


def _files(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    found = []
    for outcome in outcomes:
        record = _UNREADABLE if outcome.analysis is None else _CHECKED
        if outcome.every is not None:
            record = _EVERY
        found.append(record.data(outcome))
    return found


def _failed(outcomes: Sequence[Outcome]) -> int:
    return sum(not outcome.ok for outcome in outcomes)


def _without_claims(outcomes: Sequence[Outcome]) -> int:
    return sum(outcome.makes_no_claim for outcome in outcomes)


_SUMMARY: Record[Sequence[Outcome]] = Record(
    Field("files", COUNT, len),
    Field("failed", COUNT, _failed),
    Field("without_claims", COUNT, _without_claims),
)
_FILE: Schema = {"oneOf": [_UNREADABLE.schema, _CHECKED.schema, _EVERY.schema]}
_REPORT: Record[Sequence[Outcome]] = Record(
    schema_named(SCHEMA),
    Field("files", array(_FILE), _files),
    _SUMMARY.whole("summary", lambda x: x),
    is_open=True,
)
