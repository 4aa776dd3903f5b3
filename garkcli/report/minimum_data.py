"""``objective`` in the report of ``gark design --minimise --format json``."""

from __future__ import annotations

from typing import NamedTuple, get_args

from garkcli.design.minimise.result import Candidate, Extent, Limit, Minimum, Proof
from garkcli.design.solutions import value_at
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral, polynomial_text, root_decimal
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.page.record import Field, Record
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, nullable


class Shown(NamedTuple):
    """A minimum, and how many digits algebraic numbers have."""

    minimum: Minimum
    digits: int

    @property
    def minimisers(self) -> list[_One]:
        """The methods with the least value."""
        return [_One(self, x) for x in self.minimum.minimisers]

    @property
    def limits(self) -> list[_Toward]:
        """Where it is approached."""
        return [_Toward(self, x) for x in self.minimum.limits]


class _One(NamedTuple):
    """One method."""

    shown: Shown
    candidate: Candidate

    @property
    def values(self) -> dict[str, object]:
        """The parameters."""
        found = self.candidate.found
        root = found.solution.real[self.candidate.index]
        names = self.shown.minimum.design.family.parameters
        values = {}
        for name in names:
            value = value_at(found.solution.values[name], root)
            values[name] = root_data(value, self.shown.digits)
        return values

    @property
    def order(self) -> int | None:
        """By its own certificate."""
        order = self.candidate.found.order
        return None if order is None else order.order


class _Toward(NamedTuple):
    """One limit."""

    shown: Shown
    limit: Limit

    @property
    def toward(self) -> object:
        """The end."""
        toward = self.limit.toward
        if toward.end is not None:
            return root_data(toward.end, self.shown.digits)
        return "infinity" if toward.is_right else "-infinity"


def _exact(shown: Shown) -> object:
    value = shown.minimum.value
    if value is not None:
        return root_data(value, shown.digits)
    return "infinity" if shown.minimum.is_infinite else None


def _decimal(shown: Shown) -> str | None:
    value = shown.minimum.value
    if value is not None:
        return root_decimal(value, shown.digits)
    return "infinity" if shown.minimum.is_infinite else None


def _gradient(shown: Shown) -> str | None:
    gradient, name = shown.minimum.gradient, shown.minimum.parameter
    if gradient is None or name is None:
        return None
    [primitive] = integral([gradient]) if gradient else [Polynomial([])]
    return polynomial_text(primitive, name)


_VALUES: Schema = {"type": "object", "additionalProperties": ALGEBRAIC}
_MINIMISER: Record[_One] = Record(
    Field("values", _VALUES, lambda x: x.values),
    Field("order", nullable(COUNT), lambda x: x.order),
    Field("proof", {"enum": [*get_args(Proof)]}, lambda x: x.candidate.proof),
    Field("constant", FLAG, lambda x: x.candidate.is_constant),
)
_LIMIT: Record[_Toward] = Record(
    Field("parameter", TEXT, lambda x: x.limit.parameter),
    Field("toward", ALGEBRAIC, lambda x: x.toward),
)
OBJECTIVE: Record[Shown] = Record(
    Field("name", TEXT, lambda x: x.minimum.objective.key),
    Field("order", POSITION, lambda x: x.minimum.step.order),
    Field("value", nullable(TEXT), _decimal),
    Field("exact", nullable(ALGEBRAIC), _exact),
    Field("among", {"enum": [*get_args(Extent)]}, lambda x: x.minimum.extent),
    Field("compared", COUNT, lambda x: x.minimum.candidates),
    Field("gradient", TEXT, _gradient, is_optional=True),
    _MINIMISER.every("minimisers", lambda x: x.minimisers),
    _LIMIT.every("limits", lambda x: x.limits),
)
"""The objective, its least value and the methods that have it."""
