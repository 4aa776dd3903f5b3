"""Splittings known by name: in which order the parts of a problem flow, and how long."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

FlowText: TypeAlias = tuple[int, str]
"""A part of the problem, counted from 0, and for which fraction of the step it flows."""


@dataclass(frozen=True)
class Splitting:
    """A splitting by name.

    Attributes:
        name: as in method files.
        order: where the flows are exact, or of that order, for people.
        summary: one line.
        flows: one after the other, for a number of parts.
        terms: how many parts it is for; 0 for any number.
        tolerance: the rounding of its numbers; empty where they are exact.
        reference: where it was published.
    """

    name: str
    order: str
    summary: str
    flows: Callable[[int], tuple[FlowText, ...]]
    terms: int = 0
    tolerance: str = ""
    reference: str = ""


def _lie(terms: int) -> tuple[FlowText, ...]:
    return tuple((l, "1") for l in range(terms))


def _strang(terms: int) -> tuple[FlowText, ...]:
    there = [(l, "1/2") for l in range(terms - 1)]
    return (*there, (terms - 1, "1"), *reversed(there))


def alternating(a: Sequence[str], b: Sequence[str]) -> tuple[FlowText, ...]:
    """Part 1 for a_1, part 2 for b_1, part 1 for a_2, and so on; b may be one shorter."""
    flows: list[FlowText] = []
    for i, text in enumerate(a):
        flows.append((0, text))
        if i < len(b):
            flows.append((1, b[i]))
    return tuple(flows)


def _two(a: Sequence[str], b: Sequence[str]) -> Callable[[int], tuple[FlowText, ...]]:
    flows = alternating(a, b)
    return lambda _: flows


def _mirrored(half: Sequence[str], count: int) -> tuple[str, ...]:
    """A palindrome of so many texts, whose sum is 1: the texts in the middle are what is left."""
    total = " + ".join(f"({x})" for x in half)
    if count % 2:
        return (*half, f"1 - 2*({total})", *reversed(half))
    rest = f"1/2 - ({total})"
    return (*half, rest, rest, *reversed(half))


_OF_BLANES = "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002)"
_S6 = (
    _mirrored(("0.0792036964311957", "0.353172906049774", "-0.0420650803577195"), 7),
    _mirrored(("0.209515106613362", "-0.143851773179818"), 6),
)
_S10 = (
    _mirrored(
        (
            "0.0502627644003922",
            "0.413514300428344",
            "0.0450798897943977",
            "-0.188054853819569",
            "0.541960678450780",
        ),
        11,
    ),
    _mirrored(
        ("0.148816447901042", "-0.132385865767784", "0.067307604692185", "0.432666402578175"), 10
    ),
)
SPLITTINGS = {
    splitting.name: splitting
    for splitting in (
        Splitting("lie", "1", "each part once", _lie),
        Splitting(
            "strang",
            "2",
            "each part but the last for half of the step, and back",
            _strang,
            reference="G. Strang, SIAM J. Numer. Anal. 5 (1968)",
        ),
        Splitting(
            "ruth-3",
            "3",
            "the method of order 3, three flows each",
            _two(("1", "-2/3", "2/3"), ("-1/24", "3/4", "7/24")),
            2,
            reference="R. Ruth, IEEE Trans. Nucl. Sci. 30 (1983)",
        ),
        Splitting(
            "blanes-moan-4", "4", "13 flows, small error", _two(*_S6), 2, "1e-14", _OF_BLANES
        ),
        Splitting(
            "blanes-moan-6", "6", "21 flows, small error", _two(*_S10), 2, "1e-14", _OF_BLANES
        ),
    )
}
"""Every splitting by name."""
