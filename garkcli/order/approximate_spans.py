"""Bounds the residuals of all trees of an order without listing the trees.

These are the affine spans of ``certificate`` for rounded coefficients, which are hardly ever
exactly dependent. Some trees are members, with normalised stage vectors ψ_i; every other tree u of
the same order and root colour satisfies

    ψ(u) = Σ λ_i ψ_i + e,      Σ λ_i = 1,      Σ|λ_i| ≤ Λ,      |e| ≤ ε,      |ψ(u)| ≤ π,

with one Λ for all trees, and vectors ε and π that hold entry by entry. (If the exact solution does
not have all trees, Σ λ_i is over the members that it has, and 0 for trees that it does not have.)
The order condition b_lᵀ ψ(u) = 1/ρ is missed by at most

    Λ max_i |b_lᵀ ψ_i − 1/ρ| + |b_l|ᵀ ε,

the residual b_lᵀ 𝒜^[u] − 1/γ(u) by ρ/γ ≤ 1 times that. A branch ρ A ψ has Λ, ρ |A| ε and ρ |A| π; a
product of independent parts has Λ Λ', π ε' + ε π' + ε ε' and π π'. All numbers are balls, so the
bounds are proved; the choice of members only makes them good or bad.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import chain
from operator import add

from flint import arb, arb_mat, ctx

from garkcli.exact.enclosing import Entries, entrywise_max, plus, scalar_product, times
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order.recursion import ForestVector, OrderByOrder
from garkcli.tableau.enclosure import Enclosure
from garkcli.tableau.tableau import Edge, Tableau

Rows = list[Entries]
Places = list[int]


class _Hull(Frozen, eq=False):
    members: Sequence[ForestVector]
    weight: arb
    error: Entries
    size: Entries


class HullSizes(Frozen, eq=False):
    """The size of an order: ``bound`` is on |b_lᵀ ψ(u) − 1/ρ| ≥ |residual| for all trees.
    ``members`` are pairs of |residual| and tree, the largest first.
    """

    bound: arb
    members: list[tuple[arb, Tree]]

    @property
    def reached(self) -> arb:
        return self.members[0][0] if self.members else arb(0)


class ApproximateSpans(OrderByOrder[_Hull]):
    """The hulls of each stage space; remainders below ``grain`` are errors, not members."""

    def __init__(self, tableau: Tableau, enclosure: Enclosure, grain: arb) -> None:
        self.enclosure = enclosure
        self.grain = grain
        self._absolute: dict[Edge, arb_mat] = {
            key: arb_mat([_absolute(row) for row in A.tolist()]) for key, A in enclosure.A.items()
        }
        super().__init__(tableau, [_unit(s) for s in enclosure.stages])

    def sizes(self, order: int) -> HullSizes:
        bound = arb(0)
        members: list[tuple[arb, Tree]] = []
        with ctx.workprec(self.enclosure.bits):
            for l, late in self.tableau.roots.items():
                own = order - late
                hull = self.of_trees(l, own)
                kind = self.tableau.colours[l].kind
                weights = self.enclosure.b[l].entries()
                worst = arb(0)
                for member in hull.members:
                    required = arb(member.required(kind, own))
                    defect = abs(scalar_product(weights, member.vector) - required)
                    worst = worst.max(defect)
                    tree = self.tableau.tree(l, member.branches)
                    members.append((defect * kind.integrated(own) / tree.density, tree))
                beyond = scalar_product(_absolute(weights), hull.error)
                bound = bound.max(hull.weight * worst + beyond)
        members.sort(key=lambda x: float(x[0].mid()), reverse=True)
        return HullSizes(bound.abs_upper(), members)

    def _image(self, k: int, m: int, order: int, trees: _Hull) -> _Hull:
        kind = self.tableau.colours[m].kind
        factor = kind.integrated(order)
        A = self.enclosure.A[k, m] * factor
        members = [
            ForestVector(
                _image(A, x.vector), (Tree(m, x.branches, kind),), exact=x.exact * kind.is_exact
            )
            for x in trees.members
        ]
        absolute = self._absolute[k, m] * factor
        return _Hull(
            members, trees.weight, _image(absolute, trees.error), _image(absolute, trees.size)
        )

    def _new_forests(self, k: int, order: int) -> _Hull:
        """The bush comes first: it has the smallest density and often shows that an order fails."""
        return self._joined(k, chain(self._products(k, order), [self.branches(k, order)]))

    def _new_several(self, k: int, order: int) -> _Hull:
        return self._joined(k, self._products(k, order))

    def _products(self, k: int, order: int) -> Iterator[_Hull]:
        return (_product(branch, rest) for branch, rest in self._splits(k, order))

    def _joined(self, k: int, parts: Iterable[_Hull]) -> _Hull:
        hulls = [hull for hull in parts if hull.members]
        if hulls:
            return _reduced(hulls, self.grain)
        nothing = [arb(0)] * self.enclosure.stages[k]
        return _Hull([], arb(0), nothing, nothing)


def _unit(stages: int) -> _Hull:
    one = [arb(1)] * stages
    zero = [arb(0)] * stages
    vertex = ForestVector(one, ())
    return _Hull([vertex], arb(1), zero, one)


def _product(x: _Hull, y: _Hull) -> _Hull:
    members = [
        ForestVector(times(v.vector, w.vector), v.branches + w.branches, exact=v.exact * w.exact)
        for v in x.members
        for w in y.members
    ]
    error = plus(plus(times(x.size, y.error), times(x.error, y.size)), times(x.error, y.error))
    return _Hull(members, x.weight * y.weight, error, times(x.size, y.size))


def _reduced(hulls: Sequence[_Hull], grain: arb) -> _Hull:
    members = [member for hull in hulls for member in hull.members]
    points: Rows = [[arb(member.exact), *member.vector] for member in members]
    chosen, weights = _affine_weights(points, grain)
    kept = [members[i] for i in chosen]
    misses = arb_mat(points) - weights * arb_mat([points[i] for i in chosen])
    weight_rows = weights.tolist()
    miss_rows = misses.tolist()
    around = []
    start = 0
    for hull in hulls:
        own = slice(start, start + len(hull.members))
        around.append(_around(kept, hull, weight_rows[own], miss_rows[own]))
        start = own.stop
    return reduce(_in_both, around)


def _around(kept: Sequence[ForestVector], hull: _Hull, weights: Rows, misses: Rows) -> _Hull:
    """The bounds of one hull around the members that are kept. Rows belong to members of the hull:
    ``weights`` are their λ in those kept, ``misses`` the remainders of (1, ψ), or of (0, ψ) for
    trees that the exact solution does not have.
    """
    amount = arb(0)
    for row in weights:
        amount = amount.max(reduce(add, _absolute(row)))
    distances = [_absolute(row[1:]) for row in misses]
    error = plus(hull.error, [hull.weight * d for d in reduce(entrywise_max, distances)])
    return _Hull(kept, hull.weight * amount, error, hull.size)


def _in_both(one: _Hull, other: _Hull) -> _Hull:
    weight = one.weight.max(other.weight)
    error = entrywise_max(one.error, other.error)
    return _Hull(other.members, weight, error, entrywise_max(one.size, other.size))


def _affine_weights(points: Rows, grain: arb) -> tuple[Places, arb_mat]:
    """The points (1, ψ) that become members, and λ of each point in them: a row that sums to 1. The
    true λ solve the equations of some coordinates, one per member and the first among them, so
    balls around the solution hold weights whose sum is exactly 1; likewise for points (0, ψ).
    """
    chosen, columns = _pivots(arb_mat(points), grain)
    while True:
        rows = [[point[j] for j in columns] for point in points]
        corner = arb_mat([rows[i] for i in chosen])
        try:
            inverse = corner.inv()
        except ZeroDivisionError:
            # too flat for the precision: fewer members, larger errors
            chosen.pop()
            columns.pop()
        else:
            return chosen, arb_mat(rows) * inverse


def _pivots(points: arb_mat, grain: arb) -> tuple[Places, Places]:
    """Rows far from each other's affine hull, and a column for each: the largest pivots. The first
    pivot is a 1 in the first column, so combinations of rows that agree there are affine; if that
    column is 0, it is the largest entry.
    """
    rest = points.mid()
    ones = [i for i in range(rest.nrows()) if rest[i, 0] != 0]
    i, j = (ones[0], 0) if ones else _largest(rest)[0]
    rows, columns = [i], [j]
    while True:
        i = rows[-1]
        j = columns[-1]
        entries = rest.tolist()
        column = arb_mat([[row[j]] for row in entries])
        pivot_row = arb_mat([entries[i]]) / rest[i, j]
        rest = (rest - column * pivot_row).mid()
        if len(rows) == min(rest.nrows(), rest.ncols()):
            return rows, columns
        (i, j), largest = _largest(rest)
        if largest <= float(grain):
            return rows, columns
        rows.append(i)
        columns.append(j)


def _largest(matrix: arb_mat) -> tuple[tuple[int, int], float]:
    sizes = [*map(float, _absolute(matrix.entries()))]
    largest = max(sizes)
    return divmod(sizes.index(largest), matrix.ncols()), largest


def _absolute(row: Sequence[arb]) -> Entries:
    return [abs(x) for x in row]


def _image(A: arb_mat, vector: Sequence[arb]) -> Entries:
    column = arb_mat([[x] for x in vector])
    return (A * column).entries()
