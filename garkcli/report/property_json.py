"""The properties of a method in the JSON of ``gark check``, with their schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.exact.display import to_text
from garkcli.page.exactly import ROOT_OF, root_data
from garkcli.page.record import Field, Record
from garkcli.page.schema import (
    COUNT,
    EXACT,
    FLAG,
    POSITION,
    TEXT,
    TRUE,
    Schema,
    array,
    nullable,
    one_of,
)
from garkcli.properties.keys import KEYS
from garkcli.properties.property import Size, Verdict
from garkcli.properties.registry import find

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Outcome
    from garkcli.properties.pattern import Vertex
    from garkcli.properties.shape import Shape
    from garkcli.properties.subject import Subject
    from garkcli.tableau.tableau import Tableau

_KIND: Schema = {
    "enum": ["explicit", "diagonally implicit", "fully implicit", None],
}


def _truth(key: str) -> Field[Analysis]:
    """A property that holds or not; null where it has no meaning or is not decided."""
    field = find(key).field
    return Field(field, nullable(FLAG), lambda x: x.subject.verdict(key).value)


def _stage_order_is_open(found: Analysis) -> bool | None:
    return found.subject.verdict("stage-order").is_at_least or None


def _kind(found: Shape | None) -> str | None:
    return None if found is None else found.kind


def _gamma(found: Shape | None) -> str | None:
    if found is None or found.gamma is None:
        return None
    return to_text(found.gamma)


def _undecided(found: Analysis) -> list[str]:
    return [
        key
        for key in KEYS
        if find(key).is_cheap and found.subject.verdict(key).is_undecided
    ]


_OF_COLOUR: Record[tuple[Subject, int]] = Record(
    Field("name", TEXT, lambda x: x[0].tableau.colours[x[1]].name),
    Field("kind", _KIND, lambda x: _kind(x[0].shapes[x[1]])),
    Field("gamma", nullable(EXACT), lambda x: _gamma(x[0].shapes[x[1]])),
    Field("stage_order", COUNT, lambda x: x[0].stage_orders[x[1]]),
)
_STAGES: Schema = {
    "type": "object",
    "required": ["colours", "stages"],
    "properties": {"colours": array(TEXT), "stages": array(POSITION)},
    "additionalProperties": False,
}
_RENUMBERED: Schema = {
    "type": "object",
    "required": ["colours", "stages"],
    "properties": {
        "colours": array(TEXT),
        "stages": {"oneOf": [array(POSITION), {"const": "1 - x"}]},
    },
    "additionalProperties": False,
}


def _by_colour(found: Analysis) -> list[dict[str, Any]]:
    colours = range(found.tableau.size)
    return [_OF_COLOUR.data((found.subject, l)) for l in colours]


def _names(tableau: Tableau, space: int) -> list[str]:
    return [colour.name for colour in tableau.colours if colour.space == space]


def _system(
    tableau: Tableau, vertices: tuple[Vertex, ...]
) -> list[dict[str, Any]]:
    """A system of stages, space by space."""
    by_space: dict[int, list[int]] = {}
    for space, stage in vertices:
        by_space.setdefault(space, []).append(stage + 1)
    return [
        {"colours": _names(tableau, space), "stages": stages}
        for space, stages in by_space.items()
    ]


def _together(found: Analysis) -> list[list[dict[str, Any]]]:
    return [_system(found.tableau, x) for x in found.subject.shape.systems]


def _renumbering(found: Analysis) -> list[dict[str, Any]] | None:
    reflections = found.subject.symmetry.reflections
    if not reflections:
        return None
    return [
        {
            "colours": _names(found.tableau, space),
            "stages": "1 - x"
            if x.images is None
            else [i + 1 for i in x.images],
        }
        for space, x in enumerate(reflections)
    ]


PROPERTIES: Record[Analysis] = Record(
    *map(_truth, ("explicit", "diagonally-implicit", "sdirk", "esdirk")),
    Field("gamma", nullable(EXACT), lambda x: _gamma(x.subject.shape)),
    _truth("fully-implicit"),
    Field(
        "implicit_stages",
        nullable(COUNT),
        lambda x: x.subject.shape.implicit_stages,
    ),
    Field("solved_together", array(array(_STAGES)), _together),
    *map(_truth, ("stiffly-accurate", "fsal", "symmetric")),
    Field("renumbering", nullable(array(_RENUMBERED)), _renumbering),
    Field("symplectic", FLAG, lambda x: x.symplectic),
    _truth("reducible"),
    Field("stage_order", COUNT, lambda x: min(x.subject.stage_orders)),
    Field(
        "stage_order_is_lower_bound",
        TRUE,
        _stage_order_is_open,
        is_optional=True,
    ),
    *map(_truth, ("nodes-in-unit-interval", "positive-weights")),
    _truth("algebraically-stable"),
    Field("by_colour", array(_OF_COLOUR.schema), _by_colour),
    Field("undecided", array(TEXT), _undecided),
)
"""The properties that every check decides."""


def _value(found: Verdict) -> Any:
    """A value for programs; null where there is none."""
    value = found.value
    if not isinstance(value, Size):
        return value
    return "infinity" if value.root is None else root_data(value.root)


_VALUE: Schema = one_of(
    {"type": ["boolean", "integer", "string", "null"]}, ROOT_OF
)
_VERDICT: Record[tuple[str, Verdict]] = Record(
    Field("property", {"enum": list(KEYS)}, lambda x: x[0]),
    Field("value", _VALUE, lambda x: _value(x[1])),
    Field("undecided", FLAG, lambda x: x[1].is_undecided),
    Field("why", TEXT, lambda x: x[1].why),
)


def _every_property(outcome: Outcome) -> list[dict[str, Any]] | None:
    if outcome.analysis is None or not outcome.wants_properties:
        return None
    subject = outcome.analysis.subject
    return [_VERDICT.data((key, subject.verdict(key))) for key in KEYS]


EVERY_PROPERTY: Field[Outcome] = Field(
    "every_property", array(_VERDICT.schema), _every_property, is_optional=True
)
"""All properties with what decides them, where they were asked for."""
