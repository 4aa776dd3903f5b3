"""The properties of a method in the JSON of ``gark check``, with their schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

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

_KIND: Schema = {"enum": ["explicit", "diagonally implicit", "fully implicit", None]}


def _truth(key: str) -> Field[Analysis]:
    """A property that holds or not; null where it has no meaning or is not decided."""
    field = find(key).field
    return Field(field, nullable(FLAG), lambda x: x.subject.verdict(key).value)


def _stage_order_is_open(found: Analysis) -> bool | None:
    return found.subject.verdict("stage-order").is_at_least or None


def _kind(found: Shape | None) -> str | None:
    if found is None:
        return None
    return found.kind


def _gamma(found: Shape | None) -> str | None:
    if found is None or found.gamma is None:
        return None
    return to_text(found.gamma)


def _undecided(found: Analysis) -> list[str]:
    cheap = [key for key in KEYS if find(key).is_cheap]
    verdict = found.subject.verdict
    return [key for key in cheap if verdict(key).is_undecided]


class _Colour(NamedTuple):
    """One colour of a method."""

    subject: Subject
    number: int

    @property
    def name(self) -> str:
        """As the file calls it."""
        colour = self.subject.tableau.colours[self.number]
        return colour.name

    @property
    def shape(self) -> Shape | None:
        """Which of its stages depend on which; None where it has no block of its own."""
        return self.subject.shapes[self.number]

    @property
    def stage_order(self) -> int:
        """Of its stages."""
        return self.subject.stage_orders[self.number]

    @property
    def is_open(self) -> bool:
        """Whether its stage order may be larger."""
        return self.stage_order >= self.subject.limit


_OF_COLOUR: Record[_Colour] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("kind", _KIND, lambda x: _kind(x.shape)),
    Field("gamma", nullable(EXACT), lambda x: _gamma(x.shape)),
    Field("stage_order", COUNT, lambda x: x.stage_order),
    Field("stage_order_is_lower_bound", TRUE, lambda x: x.is_open or None, is_optional=True),
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


def _by_colour(found: Analysis) -> list[_Colour]:
    numbers = range(found.tableau.size)
    return [_Colour(found.subject, l) for l in numbers]


def _names(tableau: Tableau, space: int) -> list[str]:
    return [colour.name for colour in tableau.colours if colour.space == space]


def _system(tableau: Tableau, vertices: tuple[Vertex, ...]) -> list[dict[str, Any]]:
    """A system of stages, space by space."""
    by_space: dict[int, list[int]] = {}
    for space, stage in vertices:
        by_space.setdefault(space, []).append(stage + 1)
    return [
        {"colours": _names(tableau, space), "stages": stages} for space, stages in by_space.items()
    ]


def _together(found: Analysis) -> list[list[dict[str, Any]]]:
    return [_system(found.tableau, x) for x in found.subject.shape.systems]


def _renumbering(found: Analysis) -> list[dict[str, Any]] | None:
    reflections = found.subject.symmetry.reflections
    if not reflections:
        return None
    renumbered = []
    for space, reflection in enumerate(reflections):
        names = _names(found.tableau, space)
        stages: object = "1 - x"
        if reflection.images is not None:
            stages = [i + 1 for i in reflection.images]
        renumbered.append({"colours": names, "stages": stages})
    return renumbered


def _implicit_stages(found: Analysis) -> int | None:
    return found.subject.shape.implicit_stages


def _stage_order(found: Analysis) -> int:
    return min(found.subject.stage_orders)


PROPERTIES: Record[Analysis] = Record(
    *map(_truth, ("explicit", "diagonally-implicit", "sdirk", "esdirk")),
    Field("gamma", nullable(EXACT), lambda x: _gamma(x.subject.shape)),
    _truth("fully-implicit"),
    Field("implicit_stages", nullable(COUNT), _implicit_stages),
    Field("solved_together", array(array(_STAGES)), _together),
    *map(_truth, ("stiffly-accurate", "fsal", "symmetric")),
    Field("renumbering", nullable(array(_RENUMBERED)), _renumbering),
    Field("symplectic", FLAG, lambda x: x.symplectic),
    _truth("reducible"),
    Field("stage_order", COUNT, _stage_order),
    Field("stage_order_is_lower_bound", TRUE, _stage_order_is_open, is_optional=True),
    *map(_truth, ("nodes-in-unit-interval", "positive-weights")),
    _truth("algebraically-stable"),
    _OF_COLOUR.every("by_colour", _by_colour),
    Field("undecided", array(TEXT), _undecided),
)
"""The properties that every check decides."""


def _value(found: Verdict) -> Any:
    """A value for programs; null where there is none."""
    value = found.value
    if not isinstance(value, Size):
        return value
    if value.root is None:
        return "infinity"
    return root_data(value.root)


_VALUE: Schema = one_of({"type": ["boolean", "integer", "string", "null"]}, ROOT_OF)
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
