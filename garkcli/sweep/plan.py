"""The methods of a sweep: templates times the values of their parameters, each with a key."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import accumulate
from typing import Literal, TypeAlias

from garkcli.frozen import Frozen
from garkcli.sweep.columns import INFINITY, Value
from garkcli.sweep.methods import Template

Relation: TypeAlias = Literal["=", ">=", "<=", ">", "<"]


class RowCondition(Frozen):
    column: str
    relation: Relation
    bound: bool | float

    def holds(self, value: Value) -> bool:
        """Returns whether a value fulfils the condition; missing values do not."""
        if value is None:
            return False
        left, right = number(value), float(self.bound)
        match self.relation:
            case "=":
                return left == right
            case ">=":
                return left >= right
            case "<=":
                return left <= right
            case ">":
                return left > right
            case "<":
                return left < right


def number(value: Value) -> float:
    if value == INFINITY:
        return math.inf
    assert value is not None
    return float(value)


class Point(Frozen):
    """One method of a sweep, with its key in the sweep, and a seed if it is searched for."""

    key: str
    template: Template
    settings: Mapping[str, str]
    seed: int | None = None


class Criteria(Frozen):
    """The columns and conditions of a sweep; the first that fails ends the row of a method."""

    columns: tuple[str, ...]
    conditions: tuple[RowCondition, ...]

    @cached_property
    def _as_text(self) -> str:
        conditions = [(x.column, x.relation, x.bound) for x in self.conditions]
        return json.dumps([self.columns, conditions])

    def fingerprint(self, template: Template) -> str:
        text = f"{self._as_text}\n{template.text}"
        if template.is_searched:
            text += f"\norder {template.order}, {template.starts} starts"
        return hashlib.sha256(text.encode()).hexdigest()[:12]


class Plan(Frozen):
    """The methods of a sweep and their columns, in order of importance in ``best``."""

    name: str
    templates: tuple[Template, ...]
    grids: Mapping[str, tuple[str, ...]]
    criteria: Criteria
    best: tuple[str, ...] = ()
    pareto: tuple[str, ...] = ()

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *accumulate(x.count(self.grids) for x in self.templates)]

    def __len__(self) -> int:
        return self._starts[-1]

    def points(self) -> Iterator[Point]:
        for template in self.templates:
            for index in range(template.count(self.grids)):
                settings = {}
                seed = None
                if template.is_searched:
                    index, place = divmod(index, len(template.seeds))
                    seed = template.seeds[place]
                for name in reversed(template.parameters):
                    values = self.grids[name]
                    index, place = divmod(index, len(values))
                    settings[name] = values[place]
                in_order = {name: settings[name] for name in template.parameters}
                values_text = ", ".join(f"{name}={x}" for name, x in in_order.items())
                parts = [template.name, values_text] if values_text else [template.name]
                if seed is not None:
                    parts.append(f"seed {seed}")
                yield Point("; ".join(parts), template, in_order, seed)

    @property
    def has_searches(self) -> bool:
        return any(template.is_searched for template in self.templates)
