"""Σ e(u)² over all trees of an order, without a list of them.

e(u) = (b·𝒜^[u] − 1/γ(u)) / σ(u). A forest F has the stage vector v and the number w of its trees: 𝒜
and 1/γ. Both are products over its trees, so (v, w) is an element of an algebra S, the stage space
with one more factor. Sums of (v, w) ⊗ (v, w) / σ² over all forests of an order determine Σ e(u)².
With x_u = (v, w) ⊗ (v, w) / σ(u)² for each tree u on a forest, a tree that occurs m times
contributes x_u^m / m!², so all forests together give

    Π_u Σ_m x_u^m / m!² = exp Σ_k c_k Σ_u x_u^k,   log Σ_m x^m / m!² = Σ_k c_k x^k.

Σ_u x_u comes from the forests of lower order; the powers k ≥ 2 need only the few trees of half the
order. The work is polynomial in the order.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import chain

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.design.conditions import Cleared, Entry, Row, Square, without_denominators
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import apply, dot
from garkcli.exact.parametric import Parameters
from garkcli.frozen import Frozen
from garkcli.ntrees.kind import SEVERAL, VertexKind
from garkcli.order.recursion import OrderByOrder
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.polynomial_space import PolynomialSpace, convolution
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau


class Pair(Frozen):
    v: Row
    w: Entry


class Tensor(Frozen):
    """A symmetric element of S ⊗ S: its parts v ⊗ v, v ⊗ w and w ⊗ w."""

    vv: Square
    vw: Row
    ww: Entry

    def plus(self, other: Tensor) -> Tensor:
        rows = zip(self.vv, other.vv, strict=True)
        return Tensor(
            tuple(_added(a, b) for a, b in rows), _added(self.vw, other.vw), self.ww + other.ww
        )

    def times(self, factor: Entry) -> Tensor:
        return Tensor(
            tuple(scaled(row, factor) for row in self.vv), scaled(self.vw, factor), self.ww * factor
        )


def _added(a: Row, b: Row) -> Row:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def scaled(row: Row, factor: Entry) -> Row:
    check_time()
    return tuple(x * factor for x in row)


class TensorAlgebra:
    def __init__(self, space: StageSpace, one: Entry) -> None:
        self.space = space
        self.zero = one * 0
        self.unit = Pair(tuple(one * x for x in space.one), one)

    def product(self, u: Row, v: Row) -> Row:
        check_time()
        return self.space.product(u, v)

    def multiplied(self, a: Tensor, b: Tensor) -> Tensor:
        vv = self._squares(a.vv, b.vv)
        vw = self.product(a.vw, b.vw)
        ww = a.ww * b.ww
        return Tensor(vv, vw, ww)

    def _squares(self, a: Square, b: Square) -> Square:
        if not isinstance(self.space, PolynomialSpace):
            return tuple(map(self.product, a, b))
        # rows are polynomials in y, the column of rows is one in x
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
        v = x.v
        w = x.w
        for _ in range(k - 1):
            v = self.product(v, x.v)
            w = w * x.w
        return Pair(v, w)

    @cached_property
    def nothing(self) -> Tensor:
        s = self.space.stages
        row = (self.zero,) * s
        return Tensor((row,) * s, row, self.zero)


def squared(x: Pair) -> Tensor:
    vv = tuple(scaled(x.v, a) for a in x.v)
    vw = scaled(x.v, x.w)
    ww = x.w * x.w
    return Tensor(vv, vw, ww)


class Quotient(Frozen):
    """A value as numerator and denominator, which is a square and zero at no method."""

    numerator: Entry
    denominator: Entry


def squared_error(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    """Σ e(u)² over all trees of an order, for numbers (without ``ring``) or rational functions.
    Raises MethodError if vertices of a colour count no order, or stages are exact solutions.
    """
    is_known = order <= (tableau.exact_to or order)
    if not is_known or not all(colour.kind.weight for colour in tableau.colours):
        tableau.demand_fields("the sum of squared errors")
    return _Sums(Cleared.of(tableau, ring)).total(order)


def squared_dense_error(
    tableau: Tableau, dense: DenseOutput, order: int, ring: Parameters | None
) -> Quotient:
    """∫ Σ e_θ(u)² dθ over θ from 0 to 1 and all trees of an order, of the errors at θ. With b(θ) =
    Σ_k B_k θ^k, and e_k(u) = (B_k·𝒜^[u] − 1/γ(u)) / σ(u) for k = ρ(u), without 1/γ(u) for other k,
    it is Σ_jk Σ_u e_j(u) e_k(u) / (j + k + 1).
    """
    powers = range(1, max(order, dense.degree) + 1)
    zero = tuple((ZERO,) * len(colour.b) for colour in tableau.colours)
    rows = [dense.coefficients(k) if k <= dense.degree else zero for k in powers]
    E: Entry = ONE
    if ring is not None:
        E, flat = without_denominators(list(chain.from_iterable(rows)), ring)
        size = tableau.size
        rows = [flat[k : k + size] for k in range(0, len(flat), size)]
    weighted = [Weighted(row, k == order) for k, row in zip(powers, rows, strict=True)]
    form = [[fmpq(1, j + k + 1) for k in powers] for j in powers]
    return _Sums(Cleared.of(tableau, ring)).of_form(order, weighted, form, E)


def squared_coupling_error(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    cleared = Cleared.of(tableau, ring)
    total = _Sums(cleared).total(order)
    numerator = total.numerator
    for l in range(tableau.size):
        if tableau.block(l, l) is not None or order == 1:
            of_colour = _Sums(cleared.of_colour(l)).total(order)
            numerator = numerator - of_colour.numerator
    return Quotient(numerator, total.denominator)


class Weighted(Frozen):
    """Weights times a denominator, and whether the exact values are 1/γ(u)."""

    weights: Sequence[Row]
    is_exact: bool


class _Branch(Frozen):
    """One tree as a branch: (D A 𝒜, D w / order), with one factor D for each order, and σ."""

    value: Pair
    symmetry: int


class _Sums(OrderByOrder[Tensor]):
    def __init__(self, cleared: Cleared) -> None:
        self.cleared = cleared
        self._algebras = [TensorAlgebra(x, cleared.one) for x in cleared.tableau.spaces]
        # for each stage space, by order
        self._trees: list[list[list[_Branch]]] = [[[]] for _ in self._algebras]
        super().__init__(cleared.tableau, (squared(x.unit) for x in self._algebras))

    def total(self, order: int) -> Quotient:
        weighted = Weighted(self.cleared.weights, is_exact=True)
        return self.of_form(order, [weighted], [[fmpq(1)]], self.cleared.E)

    def of_form(
        self, order: int, rows: Sequence[Weighted], form: Sequence[Sequence[fmpq]], E: Entry
    ) -> Quotient:
        """Σ_jk q_jk Σ e_j(u) e_k(u) over the trees of an order, for all root colours. ``form`` is
        q; the weights of the e_j have the denominator E.
        """
        cleared = self.cleared
        total = cleared.one * 0
        for l in cleared.tableau.roots:
            kind = cleared.tableau.colours[l].kind
            x = self.of_trees(l, order)
            share = E * _share(kind, order)
            of_colour = cleared.one * 0
            scales = [share if row.is_exact else share * 0 for row in rows]
            for j, (one, s) in enumerate(zip(rows, scales, strict=True)):
                b = one.weights[l]
                v, w = _applied(x.vv, b), dot(b, x.vw)
                for k, (other, t) in enumerate(zip(rows, scales, strict=True)):
                    c = other.weights[l]
                    # (b v) (c v) − (b v) (t w) − (c v) (s w) + (s w) (t w)
                    part = dot(c, v) - w * t - dot(c, x.vw) * s + x.ww * s * t
                    of_colour += part * form[j][k]
            # its branches have one factor D for each order
            total += of_colour * cleared.D ** (2 * (kind.weight - 1))
        power = cleared.D ** (order - 1)
        denominator = E * power
        return Quotient(total, denominator * denominator)

    def _image(self, k: int, m: int, order: int, trees: Tensor) -> Tensor:
        block = self.cleared.blocks[k, m]
        kind = self.tableau.colours[m].kind
        scale = self.cleared.D * _share(kind, order)
        columns = [_applied(block, row) for row in trees.vv]
        vv = tuple(_applied(block, row) for row in zip(*columns, strict=True))
        image = Tensor(vv, scaled(_applied(block, trees.vw), scale), trees.ww * scale * scale)
        more = kind.weight - 1
        return image.times(self.cleared.D ** (2 * more)) if more else image

    def _joined(self, k: int, parts: Iterable[Tensor]) -> Tensor:
        total = self._algebras[k].nothing
        for part in parts:
            total = total.plus(part)
        return total

    def _new_forests(self, k: int, order: int) -> Tensor:
        """The exponential E = exp L by n E_n = Σ_j j L_j E_{n−j}."""
        multiplied = self._algebras[k].multiplied
        parts = []
        for j in range(1, order + 1):
            part = multiplied(self._logarithm(k, j), self.forests(k, order - j))
            parts.append(part.times(fmpq(j, order)))
        return self._joined(k, parts)

    def _new_several(self, k: int, order: int) -> Tensor:
        return self.forests(k, order).plus(self.branches(k, order).times(fmpq(-1)))

    def _logarithm(self, k: int, order: int) -> Tensor:
        """L_j = Σ c_m Σ_u x_u^m over the trees u of order j/m."""
        algebra = self._algebras[k]
        total = self.branches(k, order)
        factors = _logarithm_of_squares(order)
        for m in range(2, order + 1):
            if order % m:
                continue
            for branch in self._all_branches(k, order // m):
                x = squared(algebra.power(branch.value, m))
                symmetries = fmpq(branch.symmetry) ** (2 * m)
                weight = factors[m] / symmetries
                total = total.plus(x.times(weight))
        return total

    def _all_branches(self, k: int, order: int) -> list[_Branch]:
        known = self._trees[k]
        while len(known) <= order:
            known.append(list(self._new_trees(k, len(known))))
        return known[order]

    def _new_trees(self, k: int, order: int) -> Iterator[_Branch]:
        D = self.cleared.D
        for m, colour in enumerate(self.cleared.tableau.colours):
            block = self.cleared.blocks.get((k, m))
            if block is None:
                continue
            kind, rest = colour.kind, order - colour.kind.weight
            if rest < 0:
                continue
            least, most = _branches(kind, rest)
            powers_of_D = D ** (kind.weight - 1)
            for forest in self._all_forests(colour.space, rest, rest, least, most):
                v = scaled(_applied(block, forest.value.v), powers_of_D)
                w = forest.value.w * (powers_of_D * D) * _share(kind, order)
                yield _Branch(Pair(v, w), forest.symmetry)

    def _all_forests(
        self, k: int, order: int, largest: int, least: int, most: int
    ) -> Iterator[_Branch]:
        """Every forest of ``least`` to ``most`` trees, those of the largest order first."""
        algebra = self._algebras[k]
        if order == 0:
            if least <= 0 <= most:
                yield _Branch(algebra.unit, 1)
            return
        for n in range(1, min(order, largest) + 1):
            trees = self._all_branches(k, n)
            for count in range(1, min(order // n, most) + 1):
                for chosen in _multisets(algebra, trees, count):
                    rest = order - n * count, n - 1, least - count, most - count
                    for forest in self._all_forests(k, *rest):
                        yield _joined(algebra, chosen, forest)


def _share(kind: VertexKind, order: int) -> fmpq:
    """The factor of the exact solution for the number of a forest; 0 if the root counts more."""
    is_exact = kind.is_exact and order >= kind.weight
    return fmpq(1, kind.integrated(order)) if is_exact else fmpq(0)


def _branches(kind: VertexKind, rest: int) -> tuple[int, int]:
    """The least and the largest number of branches of a root for a forest of an order."""
    if rest == 0:
        return 0, 0 if kind.allows(0) else -1
    return 1 if kind.allows(1) else SEVERAL, rest if kind.allows(SEVERAL) else int(kind.allows(1))


def _multisets(algebra: TensorAlgebra, trees: Sequence[_Branch], count: int) -> Iterator[_Branch]:
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
    # without a common tree
    v = algebra.product(a.value.v, b.value.v)
    return _Branch(Pair(v, a.value.w * b.value.w), a.symmetry * b.symmetry)


def _applied(block: Square, v: Sequence[Entry]) -> Row:
    check_time()
    return apply(block, v)


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
