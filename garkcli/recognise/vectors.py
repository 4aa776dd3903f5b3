"""Rows of numbers that may be the nodes or the weights of a method."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from garkcli.frozen import Frozen, replace
from garkcli.recognise.given import ALL, AT, LENGTH, UNIT, VALUE, Given

if TYPE_CHECKING:
    from garkcli.arrays import Floats

MOST_LACKING = 3
"""The most nodes that may be left out."""
WIDEST = 3
"""A matrix of so many rows or columns may be several vectors."""


class Vector(Frozen, eq=False):
    """Numbers in a row.

    Attributes:
        of: the array that they are in.
        numbers: shape (s, 4).
        which: row or column it is; empty for all of the array.
        how: that is said in words.
        is_behind_first: whether another number is in front.
        is_behind_zero, is_cut_in_front: whether a zero was put in front, or behind.
        is_fitted: whether zeros were put in, or left out.
        is_incomplete: whether some of its numbers are row sums.
        is_sum: whether it has the row sums of a matrix.
        is_off: whether its sum is nearly 1, and no rounding explains the difference.
        is_last_row: whether it is one of the matrix that it is tried with.
    """

    of: Given
    numbers: Floats
    which: str = ""
    how: str = ""
    is_behind_first: bool = False
    is_behind_zero: bool = False
    is_cut_in_front: bool = False
    is_fitted: bool = False
    is_incomplete: bool = False
    is_sum: bool = False
    is_off: bool = False
    is_last_row: bool = False

    @cached_property
    def total(self) -> float:
        """The sum of its numbers."""
        return float(self.numbers[:, VALUE].sum())

    @cached_property
    def rounding(self) -> float:
        """The largest error of the value."""
        x = self.numbers
        return float(12 * x[:, UNIT].sum() + 1e-13 * np.abs(x[:, VALUE]).sum())


def vectors_of(given: Given) -> Iterator[Vector]:
    """The vectors in an array: all of it, or few rows or columns."""
    numbers = given.numbers
    if not given.is_matrix:
        yield Vector(given, numbers)
        if len(numbers) > 2 and numbers[0, VALUE].is_integer():
            how = "the first number of the weights is an order"
            yield Vector(given, numbers[1:], "behind", how, is_behind_first=True)
        return
    r, k = numbers.shape[:2]
    if (r == k and r > 2) or len({*map(len, given.rows)}) > 1:
        return
    for i in range(r) if r <= WIDEST and k > 1 else ():
        yield Vector(given, numbers[i], f"row {i + 1}")
        if k > 2:
            which = f"row {i + 1} behind its first number"
            yield Vector(given, numbers[i, 1:], which, is_behind_first=True)
    for j in range(k) if k <= WIDEST and r > 1 else ():
        yield Vector(given, numbers[:, j], f"column {j + 1}")


def sums_of(given: Given) -> Iterator[Vector]:
    """The row sums of a square matrix: the nodes of a part that goes with another."""
    if not given.is_matrix or len(given.rows) < 2:
        return
    numbers = given.numbers
    r, k = numbers.shape[:2]
    if r in (k, k + 1):
        parts = (numbers[..., VALUE].sum(1), numbers[..., UNIT].sum(1), numbers[..., LENGTH].max(1))
        yield Vector(given, np.stack([*parts, np.zeros(r)], axis=1), is_sum=True)


def fitted(vector: Vector, stages: int) -> Iterator[Vector]:
    """A vector with as many numbers as there are stages: whole, with a zero, without zeros."""
    numbers, n = vector.numbers, len(vector.numbers)
    if n == stages:
        yield vector
    elif n == stages - 1 and stages > 1:
        zero = np.zeros((1, numbers.shape[1]))
        vector = replace(vector, is_fitted=True)
        yield replace(vector, numbers=np.concatenate([zero, numbers]), is_behind_zero=True)
        yield replace(vector, numbers=np.concatenate([numbers, zero]), is_cut_in_front=True)
    elif n > stages and not numbers[stages:, VALUE].any():
        yield replace(vector, numbers=numbers[:stages], is_fitted=True)


def nodes_in(vector: Vector, sums: Floats) -> Iterator[Vector]:
    """A vector as nodes. Those that have names of their own may lack the last ones, which are 1,
    and the first one, which is 0; others that are left out are row sums.

    Args:
        vector: of them.
        sums: of the rows of the matrix, shape (s,).
    """
    numbers, n, stages = vector.numbers, len(vector.numbers), len(sums)
    found = list(fitted(vector, stages))
    lacking = stages - n if vector.of.is_made and stages > 2 else 0
    for ones in (lacking - 1, lacking) if lacking <= MOST_LACKING else ():
        if ones > 0:
            parts = [np.zeros((lacking - ones, numbers.shape[1])), numbers, np.array([ALL] * ones)]
            found.append(replace(vector, numbers=np.concatenate(parts)))
    for each in found:
        if not vector.of.is_made:
            yield each
            continue
        missing = (each.numbers[:, AT] == 0) & (sums != 0)
        if missing.any():
            filled = each.numbers.copy()
            filled[missing, VALUE] = sums[missing]
            each = replace(each, numbers=filled, is_incomplete=True)
        if missing.sum() < 3:
            yield each
