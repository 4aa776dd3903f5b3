"""What rounding of the coefficients does to the conjugate, to the pair, and to their conditions.

Let each entry of A and b be off by at most t. With |b_i| > t the entries of the conjugate,
Â_ij = b_j − b_j a_ji / b_i, are then off by at most

    t + (t (|a_ji| + |b_j| + t) + t |b_j a_ji / b_i|) / (|b_i| − t):

the product b_j a_ji changes by at most t (|a_ji| + |b_j| + t), and with β the change of b_i

    x'/(b_i + β) − x/b_i = (x' − x)/(b_i + β) − (x/b_i) β/(b_i + β).

A weight that is not larger than t might be zero, and then nothing is known about the conjugate.

From entries to residuals: let all trees of an order and root colour have |𝒜^[u]| ≤ S entry by
entry, and let it change by at most D. A branch A 𝒜 has |A| S and |A| D + δA (S + D), a product of
two forests S S' and S D' + D S' + D D', the value bᵀ 𝒜 changes by |b|ᵀ D + δbᵀ (S + D). So one
recursion over the orders bounds what rounding does to any residual of an order, with no tree
listed. All numbers are balls, the bounds are proved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from flint import arb, arb_mat, ctx, fmpq

from garkcli.exact.field import Number
from garkcli.order.entries import Entries, entrywise_max, plus, scalar_product, times
from garkcli.order.recursion import OrderByOrder
from garkcli.tableau.conjugate import are_opposite
from garkcli.tableau.enclosing import Enclosure, enclose_tableau
from garkcli.tableau.tableau import Edge, Tableau

BITS = 128
"""Precision of the bounds; they are wanted to a digit or two."""
Rows = Sequence[Entries]
Radii = Mapping[Edge, arb_mat]


@dataclass(frozen=True, eq=False)
class _Range:
    """Bounds on the entries of some vectors, and on how far rounding moves them."""

    size: Entries
    change: Entries

    def moved(self) -> Entries:
        """Bounds on the entries once rounding has moved them: S + D."""
        return plus(self.size, self.change)


class Propagation(OrderByOrder[_Range]):
    """Bounds on what rounding does to the residuals of one tableau, order after order.

    Args:
        tableau: the tableau whose conditions are meant.
        radii: for each block how far its entries may be off; where a block is missing it is
            ``tolerance`` everywhere.
        tolerance: how far weights may be off.
        weights: for each colour how far its weights may be off, where that is not ``tolerance``.
    """

    def __init__(
        self, tableau: Tableau, radii: Radii, tolerance: fmpq, weights: Rows | None = None
    ) -> None:
        with ctx.workprec(BITS):
            self._rounding = arb(tolerance)
            enclosure = enclose_tableau(tableau, BITS)
            self._stages = enclosure.stages
            self._b = [_upper(b.entries()) for b in enclosure.b]
            self._A: dict[Edge, Rows] = {}
            self._off: dict[Edge, Rows] = {}
            for key, A in enclosure.A.items():
                rows = _upper_rows(A)
                self._A[key] = rows
                self._off[key] = self._all_alike(rows)
                if key in radii:
                    self._off[key] = _upper_rows(radii[key])
            self._off_b = weights or self._all_alike(self._b)
        single_vertices = [_unit(s) for s in self._stages]
        super().__init__(tableau, single_vertices)

    def _all_alike(self, rows: Rows) -> Rows:
        """The rounding of all coefficients, in the shape of ``rows``."""
        return [[self._rounding] * len(row) for row in rows]

    def effect(self, order: int) -> arb:
        """No residual of ``order`` changes by more."""
        found = arb(0)
        with ctx.workprec(BITS):
            for l, b in enumerate(self._b):
                vectors = self.of_trees(l, order)
                if vectors is None:
                    continue
                kept = scalar_product(b, vectors.change)
                moved = vectors.moved()
                added = scalar_product(self._off_b[l], moved)
                found = found.max(kept + added)
        return found.abs_upper()

    def largest_row_sum(self) -> arb:
        """The largest Σ_j δA_ij of any block: what rounding does to A f where |f| ≤ 1."""
        with ctx.workprec(BITS):
            largest = arb(0)
            for rows in self._off.values():
                for row in rows:
                    largest = largest.max(_total(row))
            return largest.abs_upper()

    def _new_branches(self, k: int, order: int) -> _Range | None:
        found: _Range | None = None
        for m in range(self.tableau.size):
            if (k, m) not in self._A:
                continue
            vectors = self.of_trees(m, order)
            if vectors is not None:
                found = _either(found, self._branch(k, m, vectors))
        return found

    def _branch(self, k: int, m: int, vectors: _Range) -> _Range:
        """What A^{k,m} makes of vectors, and what its own rounding adds."""
        A = self._A[k, m]
        size = _image(A, vectors.size)
        kept = _image(A, vectors.change)
        off = self._off[k, m]
        added = _image(off, vectors.moved())
        return _Range(size, plus(kept, added))

    def _new_forests(self, k: int, order: int) -> _Range:
        """One branch, or the smallest branch times the forest of the others."""
        found = self._branches[k][order]
        for branch, rest in self._split_forests(k, order):
            found = _either(found, _product(branch, rest))
        if found is None:
            zero = [arb(0)] * self._stages[k]
            return _Range(zero, zero)
        return found


def printed_rounding(tableau: Tableau, units: Mapping[Number, fmpq]) -> Propagation:
    """What the last digits of printed coefficients leave open.

    Args:
        tableau: the method.
        units: by how much each value that is printed may be off; what was made of printed values by
            a rule may be off by the largest of them.
    """
    largest = max(units.values(), default=fmpq(0))

    def unit(value: Number) -> arb:
        if value in units:
            return arb(units[value])
        return arb(largest) if value else arb(0)

    with ctx.workprec(BITS):
        radii: dict[Edge, arb_mat] = {}
        for key, block in tableau.blocks.items():
            rows = [[unit(x) for x in row] for row in block]
            radii[key] = arb_mat(rows)
        weights = []
        for colour in tableau.colours:
            row = [unit(x) for x in colour.b]
            weights.append(row)
    return Propagation(tableau, radii, largest, weights)


@dataclass(frozen=True, eq=False)
class ConjugateRounding:
    """How far the entries of the conjugate of a tableau may be off, and what that does.

    Attributes:
        tableau: the method whose coefficients are rounded.
        tolerance: t, by how much at most.
        hats: for each Â^{l,m} its radii, shape (stages of l, stages of m).
    """

    tableau: Tableau
    tolerance: fmpq
    hats: Radii

    def of_conjugate(self, conjugated: Tableau) -> Propagation:
        """For the conditions of the conjugate."""
        # blocks are named by the stages of l: a space for each colour, unless some share theirs
        rows = list(range(self.tableau.size))
        if self.tableau.is_partitioned:
            rows = [colour.space for colour in self.tableau.colours]
        radii: dict[Edge, arb_mat] = {}
        for (l, m), off in self.hats.items():
            radii[rows[l], m] = off
        return Propagation(conjugated, radii, self.tolerance)

    def of_pair(self, both: Tableau) -> Propagation:
        """For the conditions of the pair: half of its blocks are those of the method."""
        N = self.tableau.size
        colours = self.tableau.colours
        radii: dict[Edge, arb_mat] = {}
        for (l, m), off in self.hats.items():
            if not self.tableau.is_partitioned:
                radii[l, N + m] = off
            elif colours[m].part == "p":
                radii[colours[l].space, m] = off
        return Propagation(both, radii, self.tolerance)

    def explains(self, l: int, m: int, defect: arb_mat) -> bool:
        """Whether rounding explains b_i a_ij + b_j a_ji − b_i b_j = b_i (a_ij − Â_ij), entry by
        entry.
        """
        enclosure = enclose_tableau(self.tableau, BITS)
        b = enclosure.b[l].entries()
        radii = self.hats[l, m].tolist()
        defects = defect.tolist()
        with ctx.workprec(BITS):
            for row, offs, b_i in zip(defects, radii, b, strict=True):
                for x, off in zip(row, offs, strict=True):
                    explained = abs(b_i) * off
                    if abs(x) > explained:
                        return False
        return True


def conjugate_rounding(tableau: Tableau, tolerance: fmpq) -> ConjugateRounding | None:
    """The radii of all Â^{l,m}; None where a weight that is divided by is within t of zero.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> midpoint = gark([diagonal_method("gauss", 1)], {})
    >>> found = conjugate_rounding(midpoint, fmpq(1, 1000))
    >>> found.hats[0, 0].str(3, radius=False)
    '[0.00300]'
    """
    enclosure = enclose_tableau(tableau, BITS)
    hats: dict[Edge, arb_mat] = {}
    for m, l in tableau.edges():
        if are_opposite(tableau.colours[l], tableau.colours[m]):
            radii = _hat(tableau, enclosure, l, m, tolerance)
            if radii is None:
                return None
            hats[l, m] = radii
    return ConjugateRounding(tableau, tolerance, hats)


def _hat(tableau: Tableau, enclosure: Enclosure, l: int, m: int, tolerance: fmpq) -> arb_mat | None:
    """The radii of Â^{l,m}, made from A^{m,l}."""
    space = tableau.colours[m].space
    block = enclosure.A[space, l].tolist()
    weights = enclosure.b[m].entries()
    rows: list[Entries] = []
    with ctx.workprec(BITS):
        t = arb(tolerance)
        divisors = enclosure.b[l].entries()
        for i, b_i in enumerate(divisors):
            rest = abs(b_i) - t
            if not rest > 0:
                return None
            row: Entries = []
            for j, b_j in enumerate(weights):
                a = block[j][i]
                factors = abs(a) + abs(b_j)
                product = t * (factors + t)
                quotient = t * abs(b_j * a / b_i)
                radius = t + (product + quotient) / rest
                row.append(radius.abs_upper())
            rows.append(row)
    return arb_mat(rows)


def _unit(stages: int) -> _Range:
    """A vertex has the vector 𝟙, which rounding does not move."""
    one = [arb(1)] * stages
    zero = [arb(0)] * stages
    return _Range(one, zero)


def _either(x: _Range | None, y: _Range) -> _Range:
    if x is None:
        return y
    size = entrywise_max(x.size, y.size)
    change = entrywise_max(x.change, y.change)
    return _Range(size, change)


def _product(x: _Range, y: _Range) -> _Range:
    size = times(x.size, y.size)
    of_second = times(x.size, y.change)
    of_first = times(x.change, y.size)
    one_factor = plus(of_second, of_first)
    both_factors = times(x.change, y.change)
    change = plus(one_factor, both_factors)
    return _Range(size, change)


def _image(rows: Rows, vector: Entries) -> Entries:
    return [scalar_product(row, vector) for row in rows]


def _total(values: Sequence[arb]) -> arb:
    return sum(values, arb(0))


def _upper(row: Sequence[arb]) -> Entries:
    return [x.abs_upper() for x in row]


def _upper_rows(matrix: arb_mat) -> Rows:
    return [_upper(row) for row in matrix.tolist()]
