"""Σ e(u)² over all trees of an order, without a list of them.

e(u) = (b·𝒜^[u] − 1/γ(u)) / σ(u). A forest F has the stage vector v and the number w of its trees:
𝒜 and 1/γ. Both are products over its trees, so that (v, w) is an element of an algebra S, the stage
space and one factor more. Sums of (v, w) ⊗ (v, w) / σ² over all forests of an order determine
Σ e(u)². With x_u = (v, w) ⊗ (v, w) / σ(u)² for each tree u on a forest, a tree that occurs m times
contributes x_u^m / m!², so that all forests together are

    Π_u Σ_m x_u^m / m!² = exp Σ_k c_k Σ_u x_u^k,   log Σ_m x^m / m!² = Σ_k c_k x^k.

Σ_u x_u comes from the forests of lower order; the powers k ≥ 2 need the trees of half the order,
and these are few. The work grows with the order as a polynomial, whatever the number of trees.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.design.minimise.tensors import (
    Entry,
    Pair,
    Row,
    Square,
    Tensor,
    TensorAlgebra,
    scaled,
    squared,
)
from garkcli.exact.field import ONE
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.tableau.tableau import Edge, Tableau


@dataclass(frozen=True)
class Quotient:
    """A value as numerator and denominator, the latter a square.

    Attributes:
        numerator: a polynomial, or a number.
        denominator: the same, not zero at any method.
    """

    numerator: Entry
    denominator: Entry


def squared_error(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    """Σ e(u)² over all trees of an order.

    Args:
        tableau: entries are exact numbers, or rational functions of parameters.
        order: of the trees.
        ring: the parameters; None where all entries are numbers.
    """
    return _Sums(_Cleared.of(tableau, ring)).total(order)


def squared_coupling_error(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    """The same over the trees of more than one colour."""
    cleared = _Cleared.of(tableau, ring)
    total = _Sums(cleared).total(order)
    numerator = total.numerator
    for l in range(tableau.size):
        if tableau.block(l, l) is not None or order == 1:
            alone = _Sums(cleared.alone(l)).total(order)
            numerator = numerator - alone.numerator
    return Quotient(numerator, total.denominator)


@dataclass(frozen=True)
class _Cleared:
    """A tableau times denominators: blocks D A, weights E b."""

    tableau: Tableau
    blocks: dict[Edge, Square]
    weights: tuple[Row, ...]
    D: Entry
    E: Entry
    one: Entry

    @classmethod
    def of(cls, tableau: Tableau, ring: Parameters | None) -> _Cleared:
        weights = tuple(colour.b for colour in tableau.colours)
        if ring is None:
            blocks = dict(tableau.blocks)
            return cls(tableau, blocks, weights, ONE, ONE, ONE)
        rows = list(chain.from_iterable(tableau.blocks.values()))
        D = common_denominator(chain.from_iterable(rows), ring)
        E = common_denominator(chain.from_iterable(weights), ring)

        def cleared(row: Sequence[object], denominator: Entry) -> Row:
            made = []
            for x in row:
                numerator, own = fraction(x, ring)
                made.append(numerator * (denominator // own))
            return tuple(made)

        blocks = {}
        for edge, block in tableau.blocks.items():
            blocks[edge] = tuple(cleared(row, D) for row in block)
        b = tuple(cleared(row, E) for row in weights)
        return cls(tableau, blocks, b, D, E, ring.constant(fmpq(1)))

    def alone(self, l: int) -> _Cleared:
        """One colour by itself."""
        colour = self.tableau.colours[l]
        space = self.tableau.spaces[colour.space]
        own = {}
        mine = self.tableau.blocks.get((colour.space, l))
        if mine is not None:
            own[0, 0] = mine
        tableau = Tableau((space,), (replace(colour, space=0),), own)
        blocks = {}
        if mine is not None:
            blocks[0, 0] = self.blocks[colour.space, l]
        return replace(self, tableau=tableau, blocks=blocks, weights=(self.weights[l],))


@dataclass(frozen=True)
class _Branch:
    """One tree as it stands on a forest.

    Attributes:
        value: (D A 𝒜, D w / order) of it.
        symmetry: σ.
    """

    value: Pair
    symmetry: int


class _Sums:
    """The sums over forests and branches, order by order."""

    def __init__(self, cleared: _Cleared) -> None:
        self.cleared = cleared
        tableau = cleared.tableau
        self._algebras = [TensorAlgebra(space, cleared.one) for space in tableau.spaces]
        self._forests: list[list[Tensor]] = []
        self._sums: list[list[Tensor]] = []
        self._branches: list[list[list[_Branch]]] = []
        for algebra in self._algebras:
            self._forests.append([squared(algebra.unit)])
            self._sums.append([algebra.nothing])
            self._branches.append([[]])

    def total(self, order: int) -> Quotient:
        """Σ e(u)² over the trees of an order, over all root colours."""
        cleared = self.cleared
        E = cleared.E
        total = cleared.one * 0
        for l, b in enumerate(cleared.weights):
            x = self._of_trees(l, order)
            # (b v)² − 2 (b v) (E w / order) + (E w / order)²
            scale = E * fmpq(1, order)
            rows = [_dot(b, row) for row in x.vv]
            mixed = _dot(b, x.vw) * scale
            total += _dot(b, rows)
            total -= mixed * 2
            total += x.ww * scale * scale
        power = cleared.D ** (order - 1)
        denominator = E * power
        return Quotient(total, denominator * denominator)

    def _of_trees(self, l: int, order: int) -> Tensor:
        """The sum over the forests under a root of colour l."""
        colour = self.cleared.tableau.colours[l]
        self._extend(colour.space, order - 1)
        if colour.is_linear and order > 1:
            return self._sums[colour.space][order - 1]
        return self._forests[colour.space][order - 1]

    def _extend(self, k: int, order: int) -> None:
        """The sums of stage space k up to an order."""
        while len(self._forests[k]) <= order:
            n = len(self._forests[k])
            self._sums[k].append(self._sum_of_branches(k, n))
            self._forests[k].append(self._sum_of_forests(k, n))

    def _sum_of_branches(self, k: int, order: int) -> Tensor:
        """Σ x_u over the trees of an order that the stages of space k see."""
        total = self._algebras[k].nothing
        D = self.cleared.D
        for m in range(self.cleared.tableau.size):
            block = self.cleared.blocks.get((k, m))
            if block is None:
                continue
            x = self._of_trees(m, order)
            scale = D * fmpq(1, order)
            columns = [_applied(block, row) for row in x.vv]
            vv = [_applied(block, row) for row in zip(*columns, strict=True)]
            vw = scaled(_applied(block, x.vw), scale)
            seen = Tensor(tuple(vv), vw, x.ww * scale * scale)
            total = total.plus(seen)
        return total

    def _sum_of_forests(self, k: int, order: int) -> Tensor:
        """The exponential E = exp L by n E_n = Σ_j j L_j E_{n−j}."""
        algebra = self._algebras[k]
        total = algebra.nothing
        for j in range(1, order + 1):
            part = algebra.multiplied(self._logarithm(k, j), self._forests[k][order - j])
            total = total.plus(part.times(fmpq(j, order)))
        return total

    def _logarithm(self, k: int, order: int) -> Tensor:
        """L_j = Σ c_m Σ_u x_u^m over the trees u of order j/m."""
        algebra = self._algebras[k]
        total = self._sums[k][order]
        factors = _logarithm_of_squares(order)
        for m in range(2, order + 1):
            if order % m:
                continue
            for branch in self._all_branches(k, order // m):
                power = algebra.power(branch.value, m)
                x = squared(power)
                symmetries = fmpq(branch.symmetry) ** (2 * m)
                weight = factors[m] / symmetries
                total = total.plus(x.times(weight))
        return total

    def _all_branches(self, k: int, order: int) -> list[_Branch]:
        """Every tree of an order that the stages of space k see."""
        known = self._branches[k]
        while len(known) <= order:
            known.append(list(self._new_branches(k, len(known))))
        return known[order]

    def _new_branches(self, k: int, order: int) -> Iterator[_Branch]:
        D = self.cleared.D
        for m, colour in enumerate(self.cleared.tableau.colours):
            block = self.cleared.blocks.get((k, m))
            if block is None:
                continue
            most = 1 if colour.is_linear else order
            for forest in self._all_forests(colour.space, order - 1, order - 1, most):
                v = _applied(block, forest.value.v)
                w = forest.value.w * D
                value = Pair(v, w * fmpq(1, order))
                yield _Branch(value, forest.symmetry)

    def _all_forests(self, k: int, order: int, largest: int, most: int) -> Iterator[_Branch]:
        """Every forest of an order: trees of the largest order first, and of these each number."""
        algebra = self._algebras[k]
        if order == 0:
            yield _Branch(algebra.unit, 1)
            return
        for n in range(1, min(order, largest) + 1):
            trees = self._all_branches(k, n)
            for count in range(1, min(order // n, most) + 1):
                for chosen in _multisets(algebra, trees, count):
                    rest = self._all_forests(k, order - n * count, n - 1, most - count)
                    for forest in rest:
                        yield _joined(algebra, chosen, forest)


def _multisets(algebra: TensorAlgebra, trees: Sequence[_Branch], count: int) -> Iterator[_Branch]:
    """So many trees out of some, each as often as one likes."""
    if count == 0:
        yield _Branch(algebra.unit, 1)
        return
    for i, tree in enumerate(trees):
        factorial = 1
        for times in range(1, count + 1):
            factorial *= times
            symmetry = factorial * tree.symmetry**times
            some = _Branch(algebra.power(tree.value, times), symmetry)
            for rest in _multisets(algebra, trees[i + 1 :], count - times):
                yield _joined(algebra, some, rest)


def _joined(algebra: TensorAlgebra, a: _Branch, b: _Branch) -> _Branch:
    """Two forests without a common tree as one."""
    v = algebra.product(a.value.v, b.value.v)
    value = Pair(v, a.value.w * b.value.w)
    return _Branch(value, a.symmetry * b.symmetry)


def _dot(a: Sequence[Entry], b: Sequence[Entry]) -> Entry:
    check_time()
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        if x and y:
            total += x * y
    return total


def _applied(block: Square, v: Sequence[Entry]) -> Row:
    return tuple(_dot(row, v) for row in block)


def _logarithm_of_squares(terms: int) -> list[fmpq]:
    """The c_k in log Σ x^m / m!² = Σ c_k x^k.

    >>> _logarithm_of_squares(3)
    [0, 1, -1/4, 1/9]
    """
    a = [fmpq(1)]
    for m in range(1, terms + 1):
        a.append(a[-1] / (m * m))
    c = [fmpq(0)]
    for n in range(1, terms + 1):
        # n a_n = Σ k c_k a_{n−k}, from the derivative of exp
        known = [fmpq(k, n) * c[k] * a[n - k] for k in range(1, n)]
        c.append(a[n] - sum(known, start=fmpq(0)))
    return c
