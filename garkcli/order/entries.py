"""Vectors of balls, entry by entry: for bounds that hold in every entry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from flint import arb

Entries: TypeAlias = list[arb]
_Vector: TypeAlias = Sequence[arb]


def plus(u: _Vector, v: _Vector) -> Entries:
    """The sum u + v."""
    return [x + y for x, y in zip(u, v, strict=True)]


def times(u: _Vector, v: _Vector) -> Entries:
    """The product u ⊙ v."""
    return [x * y for x, y in zip(u, v, strict=True)]


def entrywise_max(u: _Vector, v: _Vector) -> Entries:
    """The larger of each two entries."""
    return [x.max(y) for x, y in zip(u, v, strict=True)]


def scalar_product(u: _Vector, v: _Vector) -> arb:
    """uᵀ v."""
    products = times(u, v)
    return sum(products, arb(0))
