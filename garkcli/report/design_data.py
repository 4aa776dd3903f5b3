"""``gark design --format json``: the verdict, the ideal and the solutions, numbers as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, get_args

from garkcli.design.choices import Choice
from garkcli.design.design import Design, Whose
from garkcli.design.minimise.result import Minimum
from garkcli.design.stable_values import StableValues
from garkcli.design.step import Found, Kind, Step
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import (
    COUNT,
    FLAG,
    INTEGER,
    NULL,
    POSITION,
    TEXT,
    Schema,
    array,
    nullable,
    one_of,
    published,
)
from garkcli.report import minimum_data
from garkcli.report.design_values import conditions, zeros
from garkcli.report.stable_values import set_data, set_schema
from garkcli.trees.notation import format_tree

SCHEMA = "gark/design/1"


def render(
    source: str,
    design: Design,
    digits: int,
    choices: Sequence[Choice] = (),
    minimum: Minimum | None = None,
    sets: Sequence[StableValues] = (),
) -> str:
    """The design as JSON text, with the minimum of an objective where there is one, and with the
    sets of values that are as stable as is wanted.
    """
    shown = _Shown(source, design, digits, choices, minimum, sets)
    return _REPORT.text(shown)


def design_report_schema() -> Schema:
    """The JSON Schema of these reports."""
    return published("report of gark design", _REPORT.schema)


class _Shown(NamedTuple):
    """A design, its file, and how many digits algebraic numbers have."""

    source: str
    design: Design
    digits: int
    choices: Sequence[Choice]
    minimum: Minimum | None
    sets: Sequence[StableValues]

    @property
    def stable(self) -> list[dict[str, Any]] | None:
        """The sets of values that are as stable as is wanted."""
        return [set_data(x, self.digits) for x in self.sets] or None

    @property
    def objective(self) -> minimum_data.Shown | None:
        """What was minimised."""
        if self.minimum is None:
            return None
        return minimum_data.Shown(self.minimum, self.digits)

    @property
    def last(self) -> _StepOf:
        """The highest order that was looked at."""
        return _StepOf(self, self.design.last)

    @property
    def steps(self) -> list[_StepOf]:
        """Every order."""
        return [_StepOf(self, step) for step in self.design.steps]


class _StepOf(NamedTuple):
    """What one order asks."""

    shown: _Shown
    step: Step

    @property
    def solutions(self) -> list[dict[str, Any]]:
        """All solutions, one after the other."""
        return [x for found in self.step.found for x in _solutions(self.shown, found)]


class _Root(NamedTuple):
    """A real solution, by its number among the real roots of what was found."""

    shown: _Shown
    found: Found
    number: int

    @property
    def values(self) -> dict[str, object]:
        """The parameters."""
        values = self.found.solution.real_values[self.number]
        names = self.shown.design.family.parameters
        return {name: root_data(values[name], self.shown.digits) for name in names}


def _order(found: Found) -> int | None:
    return None if found.order is None else found.order.order


def _others(found: Found) -> int:
    """The solutions that are not real."""
    return found.solution.degree - len(found.solution.real)


def _stable(found: _Root) -> bool | None:
    """Whether it is as stable as is wanted; None where nothing is, or it is not decided."""
    if not found.shown.design.family.stable:
        return None
    if found.number in found.found.unstable:
        return False
    return True if found.number in found.found.accepted else None


_VALUES: Schema = {"type": "object", "additionalProperties": ALGEBRAIC}
_FOUND: tuple[Field[Found], ...] = (
    Field("multiplicity", POSITION, lambda x: x.solution.multiplicity),
    Field("order", nullable(COUNT), _order),
)
_REAL: Record[_Root] = Record(
    Field("values", _VALUES, lambda x: x.values),
    Field("real", {"const": True}, lambda _: True),
    Field("admissible", FLAG, lambda x: x.number in x.found.accepted),
    Field("stable", nullable(FLAG), _stable, is_optional=True),
    *inside(lambda x: x.found, _FOUND),
)
_NOT_REAL: Record[Found] = Record(
    Field("values", NULL, lambda _: None),
    Field("real", {"const": False}, lambda _: False),
    Field("count", POSITION, _others),
    *_FOUND,
)


def _solutions(shown: _Shown, found: Found) -> list[dict[str, Any]]:
    """Each real root as a solution, then the others as one."""
    roots = range(len(found.solution.real))
    data = [_REAL.data(_Root(shown, found, k)) for k in roots]
    if _others(found):
        data.append(_NOT_REAL.data(found))
    return data


def _ideal(found: _StepOf) -> list[str] | None:
    step = found.step
    if step.ideal is None or step.kind == "undecided":
        return None
    return zeros(found.shown.design.family, step.polynomials)


def _restrictions(found: _StepOf) -> list[str]:
    return conditions(found.shown.design.family, found.step)


def _real(found: _StepOf) -> list[str] | None:
    if found.step.real is None:
        return None
    return zeros(found.shown.design.family, found.step.polynomials_of_real)


def _dimension(found: _StepOf) -> int | None:
    step = found.step
    return None if step.ideal is None or step.kind == "undecided" else step.ideal.dimension


def _is_complete(found: _StepOf) -> bool | None:
    ideal = found.step.ideal
    return None if ideal is None else ideal.is_proved


def _witness(found: _StepOf) -> str | None:
    witness = found.step.witness
    return None if witness is None else format_tree(witness)


_SOLUTION: Schema = one_of(_REAL.schema, _NOT_REAL.schema)
_STEP: Record[_StepOf] = Record(
    Field("order", POSITION, lambda x: x.step.order),
    Field("verdict", {"enum": [*get_args(Kind)]}, lambda x: x.step.kind),
    Field("reached", nullable(FLAG), lambda x: x.step.has_methods),
    Field("ideal", array(TEXT), _ideal, is_optional=True),
    Field("restrictions", array(TEXT), _restrictions),
    Field("real_ideal", array(TEXT), _real, is_optional=True),
    Field("dimension", INTEGER, _dimension, is_optional=True),
    Field("complete", FLAG, _is_complete, is_optional=True),
    Field("solutions", array(_SOLUTION), lambda x: x.solutions),
    Field("witness", nullable(TEXT), _witness),
)
_CHOICE: Record[Choice] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("value", TEXT, lambda x: x.value),
    Field("order", POSITION, lambda x: x.order),
    Field("dimension_before", INTEGER, lambda x: x.before),
    Field("dimension", INTEGER, lambda x: x.after),
)
_REPORT: Record[_Shown] = Record(
    schema_named(SCHEMA),
    Field("file", TEXT, lambda x: x.source),
    Field("name", TEXT, lambda x: x.design.family.name),
    Field("of", {"enum": [*get_args(Whose)]}, lambda x: x.design.whose),
    Field("unknowns", array(TEXT), lambda x: list(x.design.family.parameters)),
    _CHOICE.every("choices", lambda x: x.choices),
    *inside(lambda x: x.last, _STEP.fields),
    _STEP.every("orders", lambda x: x.steps),
    minimum_data.OBJECTIVE.optional("objective", lambda x: x.objective),
    Field("stable", array(set_schema()), lambda x: x.stable, is_optional=True),
)
