"""Stage vectors with the number 1/γ beside them, and symmetric tensors of these.

(v, w) is an element of the algebra S, a stage space and one factor more; (v, w) ⊗ (v, w) is one of
S ⊗ S.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.design.cleared import Entry, Row, Square
from garkcli.exact.matrix import apply
from garkcli.tableau.polynomial_space import PolynomialSpace, convolution
from garkcli.tableau.stages import StageSpace


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
        check_time()
        return self.space.product(u, v)

    def multiplied(self, a: Tensor, b: Tensor) -> Tensor:
        """The product of two tensors."""
        vv = self._squares(a.vv, b.vv)
        vw = self.product(a.vw, b.vw)
        ww = a.ww * b.ww
        return Tensor(vv, vw, ww)

    def _squares(self, a: Square, b: Square) -> Square:
        if not isinstance(self.space, PolynomialSpace):
            return tuple(map(self.product, a, b))
        # rows are polynomials in y, the column of rows one in x
        s = self.space.stages
        reductions = self.space.reductions(2 * s - 1)
        rows: list[Row] = [(self.zero,) * (2 * s - 1)] * (2 * s - 1)
        for i, u in enumerate(a):
            for j, v in enumerate(b, start=i):
                check_time()
                rows[j] = _added(rows[j], convolution(u, v))
        half = [apply(reductions, row) for row in rows]
        columns = [apply(reductions, column) for column in zip(*half, strict=True)]
        return tuple(zip(*columns, strict=True))

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
