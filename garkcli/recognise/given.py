"""The arrays that recognition is given: numbers with names, places and units of digits."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from flint import fmpq

from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.arrays import Floats

VALUE, UNIT, LENGTH, AT = range(4)
"""Places on the last axis of an array of numbers, see ``Entry``."""
MOST_BITS = 52.0
"""No number counts for more."""
PER_DIGIT = 3.32
FLOAT = 4e-16
"""The largest relative error of a float."""


class Entry(NamedTuple):
    """A number.

    Attributes:
        value: of it.
        unit: by how much it may be off.
        bits: how long its description is, as far as that counts.
        at: where it is in the list of all numbers.
    """

    value: float
    unit: float
    bits: float
    at: int


NOTHING = Entry(0.0, 0.0, 0.0, 0)
"""A zero that nobody wrote."""
ALL = Entry(1.0, 0.0, 0.0, 1)
"""A one that nobody wrote."""


class DeclaredOrder(NamedTuple):
    """A whole number that is called an order.

    Attributes:
        name: of it, behind that of the record that it is in.
        order: its value.
        at: where it is in the list of all numbers.
    """

    name: str
    order: int
    at: int

    @property
    def owner(self) -> str:
        """The record that it is in; empty for none."""
        return self.name.rpartition(".")[0]

    @property
    def prefix(self) -> str:
        """The name of its table with ``_`` behind it, in ``rk4_order``; empty for none."""
        stem, mark, _ = self.name.rpartition(".")[2].lower().rpartition("_")
        return stem + mark


class Given(Frozen, eq=False):
    """An array.

    Attributes:
        name: of it, behind those of the records that it is in.
        line: where it is, from 1.
        rows: its numbers; of a vector there is one row.
        is_matrix: whether it is more than that row.
        is_made: whether it was put together, of single numbers or rows with like names.
        beside: numbers without an index beside it, one of which may be its diagonal.
    """

    name: str
    line: int
    rows: tuple[tuple[Entry, ...], ...]
    is_matrix: bool = False
    is_made: bool = False
    beside: tuple[Entry, ...] = ()

    @property
    def owner(self) -> str:
        """The record that it is in; empty for none."""
        return self.name.rpartition(".")[0]

    @cached_property
    def key(self) -> object:
        """A key that arrays with equal numbers share."""
        return self.is_matrix, tuple(tuple(x.value for x in row) for row in self.rows)

    @cached_property
    def fractions(self) -> int:
        """The number of its entries that are not integers."""
        return sum(not x.value.is_integer() for row in self.rows for x in row)

    @cached_property
    def numbers(self) -> Floats:
        """Shape (columns, 4), or (rows, columns, 4) for a matrix, zeros behind short rows."""
        if not self.is_matrix:
            return np.array(self.rows[0], dtype=float)
        found = np.zeros((len(self.rows), max(map(len, self.rows)), 4))
        for i, row in enumerate(self.rows):
            if row:
                found[i, : len(row)] = row
        return found

    def __repr__(self) -> str:
        return f"<Given {self.name}, line {self.line}>"


class Group(Frozen, eq=False):
    """The arrays of a scope.

    Attributes:
        scope: what tells it from others, and the one around it.
        line: where it begins.
        title: what people call it.
        arrays: in it.
        orders: whole numbers that are called orders.
        speaks: whether words around it speak of methods.
        unknown: the names of arrays in it with entries that are not known.
    """

    scope: tuple[int, int | None]
    line: int
    title: str
    arrays: Sequence[Given]
    orders: Sequence[DeclaredOrder] = ()
    speaks: bool = False
    unknown: Sequence[str] = ()


def bits_of(value: fmpq) -> float:
    """The length in bits of a fraction, or of the decimal that it is, or of a fraction that is
    rounded to it.

    >>> bits_of(fmpq(1, 6)), round(bits_of(fmpq(123, 1000)), 2)
    (3.584962500721156, 9.96)
    >>> bits_of(fmpq(1666667, 10**7)) == bits_of(fmpq(1, 6))
    True
    """
    p, q = abs(int(value.p)), int(value.q)
    if not p:
        return 0.0
    long = math.log2(p + 1) + math.log2(q)
    rest = q
    for prime in (2, 5):
        while not rest % prime:
            rest //= prime
    if rest == 1 and q > 1:
        places = next(k for k in range(1, q.bit_length() + 1) if not 10**k % q)
        digits = p * 10**places // q
        long = min(long, PER_DIGIT * math.ceil(math.log10(digits + 1)))
        long = min(long, bits_of_rounded(Fraction(p, q), places))
    return min(long, MOST_BITS)


def bits_of_rounded(value: Fraction, places: int) -> float:
    """The length in bits of a decimal, or of a fraction that is rounded to it."""
    unit = 10**places
    near = value.limit_denominator(math.isqrt(unit) // 10 or 1)
    if abs(near - value) * unit < 1:
        return math.log2(abs(near.numerator) + 1) + math.log2(near.denominator)
    return MOST_BITS
