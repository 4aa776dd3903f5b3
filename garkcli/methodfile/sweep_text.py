"""What a spec file of a sweep says."""

from __future__ import annotations

from dataclasses import dataclass, field

STARTS = 20
"""Starts of a seed, where nothing is said."""


@dataclass(frozen=True)
class TemplateText:
    """A method file of a sweep, made or read.

    Attributes:
        name: what it is called.
        text: of the file.
        parameters: that are given values in it.
        order: that is searched for by other unknowns of it; 0 where there are none.
    """

    name: str
    text: str
    parameters: tuple[str, ...]
    order: int = 0


@dataclass(frozen=True)
class SearchText:
    """How methods are searched for.

    Attributes:
        seeds: one row each.
        starts: from which each of them looks.
        order: that is wanted; 0 for the order that the file wants.
    """

    seeds: range
    starts: int = STARTS
    order: int = 0


@dataclass
class SweepText:
    """What a spec file says.

    Attributes:
        name: of the sweep.
        templates: the method files.
        grids: the values of each parameter, as text.
        free: parameters of ``methods`` that are left to the search.
        search: how unknowns are searched for, if they are.
        columns: the criteria.
        conditions: column, relation and bound.
        best: columns to sort by.
        pareto: columns of the front.
    """

    name: str = ""
    templates: list[TemplateText] = field(default_factory=list)
    grids: dict[str, tuple[str, ...]] = field(default_factory=dict)
    free: tuple[str, ...] = ()
    search: SearchText | None = None
    columns: list[str] = field(default_factory=list)
    conditions: list[tuple[str, str, bool | float]] = field(default_factory=list)
    best: list[str] = field(default_factory=list)
    pareto: list[str] = field(default_factory=list)
