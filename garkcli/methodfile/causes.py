"""The faults of a file by their causes: one cause is told once, with the places where it shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from garkcli.errors import Fault, counted

Place: TypeAlias = tuple[int, int]
"""Line and column, from 1."""
MAX_PLACES = 3
"""Most further places that are named where one cause shows in many."""


@dataclass(frozen=True)
class Found:
    """A fault as it was noted.

    Attributes:
        fault: what is told.
        cause: what it has in common with others; empty for a fault on its own.
        is_one: whether faults of this cause are told once, however few there are.
    """

    fault: Fault
    cause: str = ""
    is_one: bool = False


def place_of(found: Found) -> Place:
    """Line and column of a fault."""
    return found.fault.line, found.fault.column


def told_once(found: Sequence[Found]) -> list[Fault]:
    """The faults in file order; those of one cause at their first place, which names the others."""
    causes = Counter(one.cause for one in found)
    first: dict[object, Fault] = {}
    places: dict[object, list[Place]] = {}
    for number, one in enumerate(found):
        key: object = number
        is_often = causes[one.cause] > MAX_PLACES
        if one.cause and (one.is_one or is_often):
            key = one.cause
        first.setdefault(key, one.fault)
        places.setdefault(key, []).append(place_of(one))
    told: list[Fault] = []
    for key, fault in first.items():
        _, *others = dict.fromkeys(places[key])
        message = fault.message + _elsewhere(others)
        told.append(replace(fault, message=message))
    return told


def _elsewhere(others: Sequence[Place]) -> str:
    """Where else a cause shows: ``(also at 4:12 and in 3 more places)``."""
    if not others:
        return ""
    named = others[:MAX_PLACES]
    places = ", ".join(f"{line}:{column}" for line, column in named)
    left = len(others) - MAX_PLACES
    if left > 0:
        return f" (also at {places} and in {counted(left, 'more place')})"
    return f" (also at {places})"
