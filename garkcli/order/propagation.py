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
from garkcli.tableau.conjugate import are_opposite
from garkcli.tableau.enclosing import Enclosure, enclose_tableau
from garkcli.tableau.tableau import Tableau

BITS = 128
"""Precision of the bounds; they are wanted to a digit or two."""
Entries = list[arb]
Radii = Mapping[tuple[int, int], arb_mat]


@dataclass(frozen=True, eq=False)
class _Range:
    """Bounds on the entries of some vectors, and on how far rounding moves them."""

    size: Entries
    change: Entries

    def moved(self) -> Entries:
        """Bounds on the entries once rounding has moved them: S + D."""
        return [s + d for s, d in zip(self.size, self.change, strict=True)]


class Propagation:
    """Bounds on what rounding does to the residuals of one tableau, order after order.

    Args:
        tableau: the tableau whose conditions are meant.
        radii: for each block how far its entries may be off; where a block is missing it is
            ``tolerance`` everywhere.
        tolerance: how far weights may be off.
        weights: for each colour how far its weights may be off, where that is not ``tolerance``.
    """

    def __init__(
        self,
        tableau: Tableau,
        radii: Radii,
        tolerance: fmpq,
        weights: Sequence[Entries] | None = None,
    ) -> None:
        self.tableau = tableau
        with ctx.workprec(BITS):
            self._rounding = arb(tolerance)
            enclosure = enclose_tableau(tableau, BITS)
            self._stages = enclosure.stages
            self._b = [_upper(b.entries()) for b in enclosure.b]
            self._A = {key: _upper_rows(A) for key, A in enclosure.A.items()}
            self._off = {key: self._radii_of(key, radii) for key in enclosure.A}
            self._off_b = weights or [[self._rounding] * len(b) for b in self._b]
        # a vertex has the vector 𝟙, which rounding does not move
        self._forests = [[_Range([arb(1)] * s, [arb(0)] * s)] for s in self._stages]
        self._branches: list[list[_Range | None]] = [[None] for _ in self._stages]

    def _radii_of(self, key: tuple[int, int], radii: Radii) -> list[Entries]:
        if key in radii:
            return _upper_rows(radii[key])
        rows = self._A[key]
        return [[self._rounding] * len(row) for row in rows]

    def effect(self, order: int) -> arb:
        """No residual of ``order`` changes by more."""
        found = arb(0)
        with ctx.workprec(BITS):
            for l, (b, off) in enumerate(zip(self._b, self._off_b, strict=True)):
                vectors = self._stage_vectors(l, order)
                if vectors is None:
                    continue
                kept = _dot(b, vectors.change)
                added = _dot(off, vectors.moved())
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

    def _stage_vectors(self, l: int, order: int) -> _Range | None:
        """All 𝒜^[u] of an order with root colour l; None where there is no such tree."""
        colour = self.tableau.colours[l]
        self._extend(colour.space, order - 1)
        if colour.is_linear and order > 1:
            return self._branches[colour.space][order - 1]
        return self._forests[colour.space][order - 1]

    def _extend(self, k: int, order: int) -> None:
        while len(self._forests[k]) <= order:
            n = len(self._forests[k])
            self._branches[k].append(self._new_branches(k, n))
            self._forests[k].append(self._new_forests(k, n))

    def _new_branches(self, k: int, order: int) -> _Range | None:
        found: _Range | None = None
        for m in range(self.tableau.size):
            vectors = self._stage_vectors(m, order) if (k, m) in self._A else None
            if vectors is None:
                continue
            A = self._A[k, m]
            size = _image(A, vectors.size)
            kept = _image(A, vectors.change)
            added = _image(self._off[k, m], vectors.moved())
            change = [x + y for x, y in zip(kept, added, strict=True)]
            found = _either(found, _Range(size, change))
        return found

    def _new_forests(self, k: int, order: int) -> _Range:
        """One branch, or the smallest branch times the forest of the others."""
        zero = [arb(0)] * self._stages[k]
        found = self._branches[k][order]
        for j in range(1, order // 2 + 1):
            branch, rest = self._branches[k][j], self._forests[k][order - j]
            if branch is not None:
                found = _either(found, _product(branch, rest))
        if found is None:
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
        return arb(units.get(value, largest if value else fmpq(0)))

    with ctx.workprec(BITS):
        radii: dict[tuple[int, int], arb_mat] = {}
        for key, block in tableau.blocks.items():
            radii[key] = arb_mat([[unit(x) for x in row] for row in block])
        weights = [[unit(x) for x in colour.b] for colour in tableau.colours]
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
        radii = {(rows[l], m): off for (l, m), off in self.hats.items()}
        return Propagation(conjugated, radii, self.tolerance)

    def of_pair(self, both: Tableau) -> Propagation:
        """For the conditions of the pair: half of its blocks are those of the method."""
        N = self.tableau.size
        colours = self.tableau.colours
        radii: dict[tuple[int, int], arb_mat] = {}
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
        b = enclose_tableau(self.tableau, BITS).b[l].entries()
        radii = self.hats[l, m].tolist()
        with ctx.workprec(BITS):
            for row, offs, b_i in zip(defect.tolist(), radii, b, strict=True):
                for x, off in zip(row, offs, strict=True):
                    if abs(x) > abs(b_i) * off:
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
    hats: dict[tuple[int, int], arb_mat] = {}
    for m, l in tableau.edges():
        if are_opposite(tableau.colours[l], tableau.colours[m]):
            radii = _hat(tableau, enclosure, l, m, tolerance)
            if radii is None:
                return None
            hats[l, m] = radii
    return ConjugateRounding(tableau, tolerance, hats)


def _hat(
    tableau: Tableau, enclosure: Enclosure, l: int, m: int, tolerance: fmpq
) -> arb_mat | None:
    """The radii of Â^{l,m}, made from A^{m,l}."""
    block = enclosure.A[tableau.colours[m].space, l].tolist()
    rows: list[Entries] = []
    with ctx.workprec(BITS):
        t = arb(tolerance)
        for i, b_i in enumerate(enclosure.b[l].entries()):
            rest = abs(b_i) - t
            if not rest > 0:
                return None
            row: Entries = []
            for j, b_j in enumerate(enclosure.b[m].entries()):
                a = block[j][i]
                product = t * (abs(a) + abs(b_j) + t)
                quotient = t * abs(b_j * a / b_i)
                radius = t + (product + quotient) / rest
                row.append(radius.abs_upper())
            rows.append(row)
    return arb_mat(rows)


def _either(x: _Range | None, y: _Range) -> _Range:
    if x is None:
        return y
    return _Range(_entrywise(x.size, y.size), _entrywise(x.change, y.change))


def _product(x: _Range, y: _Range) -> _Range:
    size, change = [], []
    for s, d, other_s, other_d in zip(x.size, x.change, y.size, y.change, strict=True):
        size.append(s * other_s)
        change.append(s * other_d + d * other_s + d * other_d)
    return _Range(size, change)


def _entrywise(u: Sequence[arb], v: Sequence[arb]) -> Entries:
    return [x.max(y) for x, y in zip(u, v, strict=True)]


def _dot(u: Sequence[arb], v: Sequence[arb]) -> arb:
    return sum((x * y for x, y in zip(u, v, strict=True)), arb(0))


def _image(rows: Sequence[Entries], vector: Sequence[arb]) -> Entries:
    return [_dot(row, vector) for row in rows]


def _total(values: Sequence[arb]) -> arb:
    return sum(values, arb(0))


def _upper(row: Sequence[arb]) -> Entries:
    return [x.abs_upper() for x in row]


def _upper_rows(matrix: arb_mat) -> list[Entries]:
    return [_upper(row) for row in matrix.tolist()]
