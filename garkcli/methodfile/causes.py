"""The faults of a file by their causes: one cause is told once, with the places where it shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from garkcli.errors import Fault, counted

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


def place_of(found: Found) -> tuple[int, int]:
    """Line and column of a fault."""
    return found.fault.line, found.fault.column


def told_once(found: Sequence[Found]) -> list[Fault]:
    """The faults in file order; those of one cause at their first place, which names the others."""
    causes = Counter(one.cause for one in found)
    first: dict[object, Fault] = {}
    places: dict[object, dict[tuple[int, int], None]] = {}
    for number, one in enumerate(found):
        together = one.cause and (one.is_one or causes[one.cause] > MAX_PLACES)
        key: object = one.cause if together else number
        first.setdefault(key, one.fault)
        places.setdefault(key, {})[place_of(one)] = None
    told: list[Fault] = []
    for key, fault in first.items():
        _, *others = places[key]
        message = fault.message + _elsewhere(others)
        told.append(replace(fault, message=message))
    return told


def _elsewhere(others: Sequence[tuple[int, int]]) -> str:
    """Where else a cause shows: ``(also at 4:12 and in 3 more places)``."""
    if not others:
        return ""
    places = ", ".join(
        f"{line}:{column}" for line, column in others[:MAX_PLACES]
    )
    left = len(others) - MAX_PLACES
    if left > 0:
        return f" (also at {places} and in {counted(left, 'more place')})"
    return f" (also at {places})"
