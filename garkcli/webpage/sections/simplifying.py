"""B, C and D, block by block, and the bounds that they give."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.findings import BOUND, SHARP_BOUND
from garkcli.order.simplifying import Simplifying
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section

_LEVELS = 6
"""Shades of the grid; larger numbers have the last one."""


def _content(method: Reported) -> Content | None:
    found, limit = _found(method)
    tableau = method.tableau
    if found is None or tableau is None:
        return None
    names = [colour.name for colour in tableau.colours]
    data = method.data
    bounds = [("bound", found.bound, BOUND, _number(data, "bound"))]
    bounds.append(("sharper bound", found.sharp_bound, SHARP_BOUND, _number(data, "sharp_bound")))
    return {
        "names": names,
        "B": _cells(found.B, limit),
        "C": [_cells(row, limit) for row in found.C],
        "D": [_cells(row, limit) for row in found.D],
        "numbers": _numbers(found),
        "bounds": bounds,
        "every": method.outcome.every,
    }


def _found(method: Reported) -> tuple[Simplifying | None, int]:
    """What holds, and where the search for it stopped."""
    analysis = method.outcome.analysis
    if analysis is not None:
        return analysis.simplifying, analysis.limit
    every = method.outcome.every
    if every is None:
        return None, 0
    value = every.simplifying.value
    if not isinstance(value, Simplifying):
        return None, 0
    return value, every.limit


def _number(data: Content, name: str) -> int:
    """A bound as ``gark check`` reports it: within a tolerance as far as it is borne out."""
    if name in data.get("simplifying", {}):
        number: int = data["simplifying"][name]
        return number
    found = data[name]
    value: int = found["value"] if isinstance(found, dict) else found
    return value


def _cells(numbers: Sequence[int | None], limit: int) -> list[tuple[str, int | None]]:
    """The text of each cell, and its shade; none where there is no block."""
    found: list[tuple[str, int | None]] = []
    for number in numbers:
        if number is None:
            found.append(("–", None))
            continue
        text = f"≥ {number}" if number >= limit else str(number)
        found.append((text, max(0, min(number, _LEVELS))))
    return found


def _numbers(found: Simplifying) -> list[tuple[str, str]]:
    """What the bounds are made of; those that reached the limit may be larger."""
    numbers = {"r": found.r, "η": found.eta, "ζ": found.zeta, "ξ": found.xi, "χ": found.chi}
    return [
        (name, f"at least {number}" if found.is_open(number) else str(number))
        for name, number in numbers.items()
    ]


SECTION = Section("simplifying", "Simplifying assumptions", _content)
