"""Stage vectors with the number 1/γ beside them, and symmetric tensors of these.

(v, w) is an element of the algebra S, a stage space and one factor more; (v, w) ⊗ (v, w) is one of
S ⊗ S.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace

Entry: TypeAlias = Any
"""A polynomial of parameters, or an exact number."""
Row: TypeAlias = tuple[Entry, ...]
Square: TypeAlias = tuple[Row, ...]


@dataclass(frozen=True)
class Pair:
    """(v, w): a stage vector and a number."""

    v: Row
    w: Entry


@dataclass(frozen=True)
class Tensor:
    """A symmetric element of S ⊗ S: its parts v ⊗ v, v ⊗ w and w ⊗ w."""

    vv: Square
    vw: Row
    ww: Entry

    def plus(self, other: Tensor) -> Tensor:
        """The sum."""
        rows = zip(self.vv, other.vv, strict=True)
        return Tensor(
            tuple(_added(a, b) for a, b in rows), _added(self.vw, other.vw), self.ww + other.ww
        )

    def times(self, factor: fmpq) -> Tensor:
        """A multiple."""
        return Tensor(
            tuple(scaled(row, factor) for row in self.vv), scaled(self.vw, factor), self.ww * factor
        )


def _added(a: Row, b: Row) -> Row:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def scaled(row: Row, factor: Entry) -> Row:
    check_time()
    return tuple(x * factor for x in row)


class TensorAlgebra:
    """S ⊗ S for one stage space."""

    def __init__(self, space: StageSpace, one: Entry) -> None:
        self.space = space
        self.zero = one * 0
        self.unit = Pair(tuple(one * x for x in space.one), one)

    def product(self, u: Row, v: Row) -> Row:
        """The product of two stage vectors."""
        if not isinstance(self.space, PolynomialSpace):
            return multiplied(u, v)
        raised = self._convolved([(u, v)])
        return self._reduced(raised)

    def _convolved(self, pairs: Sequence[tuple[Row, Row]]) -> list[Entry]:
        check_time()
        s = self.space.stages
        out = [self.zero] * (2 * s - 1)
        for u, v in pairs:
            for i, x in enumerate(u):
                for j, y in enumerate(v, start=i):
                    if x and y:
                        out[j] += x * y
        return out

    def _reduced(self, out: list[Entry]) -> Row:
        """x^k for k ≥ s by the node polynomial, from the highest down."""
        space = self.space
        assert isinstance(space, PolynomialSpace)
        s = space.stages
        lower = [space.modulus[j] for j in range(s)]
        for k in reversed(range(s, 2 * s - 1)):
            highest = out[k]
            for j, a in enumerate(lower, start=k - s):
                out[j] -= highest * a
        return tuple(out[:s])

    def multiplied(self, a: Tensor, b: Tensor) -> Tensor:
        """The product of two tensors."""
        vv = self._squares(a.vv, b.vv)
        vw = self.product(a.vw, b.vw)
        ww = a.ww * b.ww
        return Tensor(vv, vw, ww)

    def _squares(self, a: Square, b: Square) -> Square:
        if not isinstance(self.space, PolynomialSpace):
            pairs_of_rows = zip(a, b, strict=True)
            return tuple(multiplied(u, v) for u, v in pairs_of_rows)
        # rows are polynomials in y, the column of rows one in x
        s = self.space.stages
        rows = []
        for k in range(2 * s - 1):
            first = max(0, k - s + 1)
            last = min(k, s - 1)
            pairs = []
            for i in range(first, last + 1):
                pair = a[i], b[k - i]
                pairs.append(pair)
            raised = self._convolved(pairs)
            rows.append(self._reduced(raised))
        columns = zip(*rows, strict=True)
        reduced = [self._reduced(list(column)) for column in columns]
        return tuple(zip(*reduced, strict=True))

    def power(self, x: Pair, k: int) -> Pair:
        """The k-th power of an element of S."""
        v = x.v
        w = x.w
        for _ in range(k - 1):
            v = self.product(v, x.v)
            w = w * x.w
        return Pair(v, w)

    @cached_property
    def nothing(self) -> Tensor:
        """Zero."""
        s = self.space.stages
        row = (self.zero,) * s
        return Tensor((row,) * s, row, self.zero)


def squared(x: Pair) -> Tensor:
    """The tensor x ⊗ x."""
    vv = tuple(scaled(x.v, a) for a in x.v)
    vw = scaled(x.v, x.w)
    ww = x.w * x.w
    return Tensor(vv, vw, ww)


def multiplied(u: Row, v: Row) -> Row:
    """The product, entry by entry."""
    check_time()
    return tuple(x * y for x, y in zip(u, v, strict=True))
