"""Methods that parts of a solution set, or an edge and what is within it, have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from garkcli.design.minimise.result import Candidate
from garkcli.design.solutions import value_at
from garkcli.exact.roots import RealRoot

_STRENGTH = ("exact", "exists", "numerical")


def without_repeats(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Each method once, with the most that is known of it, in the order of their first places."""
    by_value: dict[RealRoot | None, list[int]] = {}
    for place, candidate in enumerate(candidates):
        by_value.setdefault(candidate.value, []).append(place)
    kept: dict[int, Candidate] = {}
    for places in by_value.values():
        if len(places) == 1:
            kept[places[0]] = candidates[places[0]]
            continue
        same: dict[tuple[RealRoot, ...], list[int]] = {}
        for place in places:
            same.setdefault(_coordinates(candidates[place]), []).append(place)
        for group in same.values():
            kept[group[0]] = _joined([candidates[k] for k in group])
    return [kept[place] for place in sorted(kept)]


def _coordinates(candidate: Candidate) -> tuple[RealRoot, ...]:
    """The unknowns of a method, as real numbers."""
    solution = candidate.found.solution
    root = solution.real[candidate.index]
    return tuple(value_at(solution.values[name], root) for name in sorted(solution.values))


def _joined(same: Sequence[Candidate]) -> Candidate:
    """What is known of one method."""
    best = min(same, key=lambda x: _STRENGTH.index(x.proof))
    return replace(best, is_constant=any(x.is_constant for x in same))
