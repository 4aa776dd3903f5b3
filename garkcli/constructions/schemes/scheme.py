"""What a scheme is: the substeps of a composition by name."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

Part: TypeAlias = tuple[str, bool]
"""A fraction of the step as text, and whether the adjoint takes it."""
Parts: TypeAlias = tuple[Part, ...]
MAX_ORDER = 12
"""Largest order of a scheme that is repeated."""


@dataclass(frozen=True)
class Scheme:
    """A composition of one method.

    Attributes:
        name: as in method files.
        order: of the result, for people.
        summary: one line.
        parts: the substeps, from the order of the method and the order that is wanted, both 0
            where the scheme has one order only.
        tolerance: the rounding of its numbers; empty where they are exact.
        has_orders: whether it is made for any order.
        reference: where it was published.
    """

    name: str
    order: str
    summary: str
    parts: Callable[[int, int], Parts]
    tolerance: str = ""
    has_orders: bool = False
    reference: str = ""


def palindrome(half: Sequence[str]) -> Callable[[int, int], Parts]:
    """The substeps γ_1, …, γ_k, 1 − 2 Σ γ, γ_k, …, γ_1."""
    total = " + ".join(f"({x})" for x in half)
    middle = f"1 - 2*({total})"
    texts = (*half, middle, *reversed(half))
    parts = tuple((text, False) for text in texts)
    return lambda _, __: parts


def repeated(fractions: Callable[[int], Sequence[str]]) -> Callable[[int, int], Parts]:
    """A scheme that gains two orders, used as often as it takes.

    Args:
        fractions: the substeps that a symmetric method of some order has to take.
    """

    def parts(base: int, wanted: int) -> Parts:
        texts = ["1"]
        for order in range(base, wanted, 2):
            outer = fractions(order)
            texts = [_times(g, text) for g in outer for text in texts]
        return tuple((text, False) for text in texts)

    return parts


def _times(one: str, other: str) -> str:
    return one if other == "1" else f"({one})*({other})"
