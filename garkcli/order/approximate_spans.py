"""Bounds on the residuals of all trees of an order without listing the trees.

The affine spans of ``certificate`` for rounded coefficients, where nothing is exactly dependent.
Some trees are members, with their normalised stage vectors ψ_i; every other tree u of the same
order and root colour is

    ψ(u) = Σ λ_i ψ_i + e,      Σ λ_i = 1,      w Σ|λ_i| ≤ Λ,      w |e| ≤ ε,      w |ψ(u)| ≤ π,

with one Λ for all trees, vectors ε and π that hold entry by entry, and w = ρ(u)/γ(u), the factor
between ψ(u) and 𝒜^[u]. The order condition of u is w (b_lᵀ ψ(u) − 1/ρ) = 0, so its residual is at
most

    Λ max_i |b_lᵀ ψ_i − 1/ρ| + |b_l|ᵀ ε.

Λ, ε and π follow branches and products: a branch ρ A ψ has the factor 1/γ = w/ρ, hence Λ/ρ, |A| ε
and |A| π; a product of independent parts has Λ Λ', π ε' + ε π' + ε ε' and π π'. All numbers are
balls, so the bounds are proved; the choice of members only makes them good or bad.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TypeAlias

from flint import arb, arb_mat, ctx

from garkcli.order.residuals import Sizes
from garkcli.tableau.enclosing import Enclosure
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree

Entries = list[arb]


@dataclass(frozen=True, eq=False)
class _Member:
    """A vector that is known, and the branches of its tree."""

    vector: Entries
    branches: tuple[Tree, ...]


@dataclass(frozen=True, eq=False)
class _Hull:
    """Members, and how far all others of their kind are from them: Λ, ε and π."""

    members: Sequence[_Member]
    weight: arb
    error: Entries
    size: Entries


_Hulls: TypeAlias = "list[list[_Hull | None]]"
"""For each stage space the hulls of its branches or forests, order after order."""


class ApproximateSpans:
    """Members and bounds for the branches and forests of each stage space, made on demand.

    Args:
        tableau: the tableau.
        enclosure: its entries; their bits are the precision.
        grain: what is shorter is counted as an error instead of becoming a member.
    """

    def __init__(self, tableau: Tableau, enclosure: Enclosure, grain: arb) -> None:
        self.tableau = tableau
        self.enclosure = enclosure
        self.grain = grain
        self._absolute = {key: _absolute_matrix(A) for key, A in enclosure.A.items()}
        self._branches: _Hulls = [[None] for _ in enclosure.stages]
        self._forests: _Hulls = [[_unit(s)] for s in enclosure.stages]

    def sizes(self, order: int) -> Sizes:
        """A bound on all |residuals| of an order, and the largest among those of members."""
        bound = reached = arb(0)
        largest: Tree | None = None
        with ctx.workprec(self.enclosure.bits):
            for l, b in enumerate(self.enclosure.b):
                hull = self._stage_vectors(l, order)
                if hull is None:
                    continue
                worst = arb(0)
                weights = b.entries()
                required = arb(1) / order
                for member in hull.members:
                    tree = Tree(l, member.branches)
                    defect = abs(_dot(weights, member.vector) - required)
                    size = defect * order / tree.density
                    worst = worst.max(defect)
                    if largest is None or size > reached:
                        reached, largest = size, tree
                beyond = _dot(_absolute(weights), hull.error)
                bound = bound.max(hull.weight * worst + beyond)
        return Sizes(bound.abs_upper(), reached, largest)

    def _stage_vectors(self, l: int, order: int) -> _Hull | None:
        """The trees of an order with root colour l; None where there is none."""
        colour = self.tableau.colours[l]
        self._extend(colour.space, order - 1)
        if colour.is_linear and order > 1:
            return self._branches[colour.space][order - 1]
        return self._forests[colour.space][order - 1]

    def _extend(self, k: int, order: int) -> None:
        while len(self._forests[k]) <= order:
            n = len(self._forests[k])
            branches = list(self._new_branches(k, n))
            self._branches[k].append(_reduced(branches, self.grain))
            forests = list(self._new_forests(k, n))
            self._forests[k].append(_reduced(forests, self.grain))

    def _new_branches(self, k: int, order: int) -> Iterator[_Hull]:
        """Order · A ψ over the colours that the stages of space k see."""
        for m in range(self.tableau.size):
            if (k, m) not in self.enclosure.A:
                continue
            hull = self._stage_vectors(m, order)
            if hull is None:
                continue
            A = self.enclosure.A[k, m] * order
            members = []
            for x in hull.members:
                branch = Tree(m, x.branches)
                members.append(_Member(_image(A, x.vector), (branch,)))
            absolute = self._absolute[k, m]
            error = _image(absolute, hull.error)
            size = _image(absolute, hull.size)
            yield _Hull(members, hull.weight / order, error, size)

    def _new_forests(self, k: int, order: int) -> Iterator[_Hull]:
        """The smallest branch times the forest of the others, or one branch.

        The bush comes first: its density is the least, so that where an order fails it often shows
        it.
        """
        for j in range(1, order // 2 + 1):
            branch, rest = self._branches[k][j], self._forests[k][order - j]
            if branch is not None and rest is not None:
                yield _product(branch, rest)
        single = self._branches[k][order]
        if single is not None:
            yield single


def _unit(stages: int) -> _Hull:
    """What the single vertex has: its vector is 𝟙, and nothing is beyond it."""
    one = [arb(1)] * stages
    zero = [arb(0)] * stages
    return _Hull([_Member(one, ())], arb(1), zero, one)


def _product(x: _Hull, y: _Hull) -> _Hull:
    members = []
    for v in x.members:
        for w in y.members:
            vector = [a * b for a, b in zip(v.vector, w.vector, strict=True)]
            members.append(_Member(vector, (*v.branches, *w.branches)))
    error, size = [], []
    for p, e, q, f in zip(x.size, x.error, y.size, y.error, strict=True):
        error.append(p * f + e * q + e * f)
        size.append(p * q)
    return _Hull(members, x.weight * y.weight, error, size)


def _reduced(hulls: Sequence[_Hull], grain: arb) -> _Hull | None:
    """Few of the members of all hulls, and bounds that hold for everything in any of them."""
    if not hulls:
        return None
    members = [member for hull in hulls for member in hull.members]
    points = [[arb(1), *member.vector] for member in members]
    chosen, weights = _affine_weights(points, grain)
    kept = [members[i] for i in chosen]
    corners = arb_mat([points[i] for i in chosen])
    misses = (arb_mat(points) - weights * corners).tolist()
    rows = weights.tolist()
    found: _Hull | None = None
    start = 0
    for hull in hulls:
        part = slice(start, start + len(hull.members))
        start = part.stop
        found = _joined(found, _around(kept, hull, rows[part], misses[part]))
    return found


def _around(
    kept: Sequence[_Member], hull: _Hull, weights: list[Entries], misses: list[Entries]
) -> _Hull:
    """The bounds of one hull around the members that are kept.

    ``weights`` and ``misses`` have a row for each member of the hull: its λ in the members kept,
    and what these leave of (1, ψ).
    """
    amount = arb(0)
    for row in weights:
        amount = amount.max(reduce(add, _absolute(row)))
    miss = reduce(_entrywise, [_absolute(row[1:]) for row in misses])
    error = [e + hull.weight * d for e, d in zip(hull.error, miss, strict=True)]
    return _Hull(kept, hull.weight * amount, error, hull.size)


def _joined(one: _Hull | None, other: _Hull) -> _Hull:
    """Bounds that hold in both of two hulls with the same members."""
    if one is None:
        return other
    return _Hull(
        other.members,
        one.weight.max(other.weight),
        _entrywise(one.error, other.error),
        _entrywise(one.size, other.size),
    )


def _affine_weights(points: Sequence[Entries], grain: arb) -> tuple[list[int], arb_mat]:
    """Which of the points (1, ψ) become members, and λ of each point in them: a row that sums to 1.

    The true λ solve the equations of as many coordinates as there are members, that of the ones
    among them, so balls around the solution hold weights whose sum is exactly 1.
    """
    chosen, columns = _pivots(arb_mat(points), grain)
    while True:
        rows = [[point[j] for j in columns] for point in points]
        corner = arb_mat([rows[i] for i in chosen])
        try:
            return chosen, arb_mat(rows) * corner.inv()
        except ZeroDivisionError:
            # too flat for the precision: fewer members, larger errors
            chosen, columns = chosen[:-1], columns[:-1]


def _pivots(points: arb_mat, grain: arb) -> tuple[list[int], list[int]]:
    """Rows far from each other's affine hull, and as many columns, by elimination with the largest
    pivots.

    The first column, of ones, comes first: combinations of rows that agree in it are affine.
    """
    rest = points.mid()
    rows, columns = [0], [0]
    while True:
        i, j = rows[-1], columns[-1]
        entries = rest.tolist()
        column = arb_mat([[row[j]] for row in entries])
        pivot_row = arb_mat([entries[i]]) / rest[i, j]
        rest = (rest - column * pivot_row).mid()
        if len(rows) == min(rest.nrows(), rest.ncols()):
            return rows, columns
        sizes = [float(abs(x)) for x in rest.entries()]
        largest = max(sizes)
        if largest <= float(grain):
            return rows, columns
        i, j = divmod(sizes.index(largest), rest.ncols())
        rows.append(i)
        columns.append(j)


def _absolute(row: Sequence[arb]) -> Entries:
    return [abs(x) for x in row]


def _absolute_matrix(A: arb_mat) -> arb_mat:
    """|A|, entry by entry."""
    return arb_mat([_absolute(row) for row in A.tolist()])


def _image(A: arb_mat, vector: Sequence[arb]) -> Entries:
    return (A * arb_mat([[x] for x in vector])).entries()


def _dot(u: Sequence[arb], v: Sequence[arb]) -> arb:
    return reduce(add, (x * y for x, y in zip(u, v, strict=True)), arb(0))


def _entrywise(u: Sequence[arb], v: Sequence[arb]) -> Entries:
    return [x.max(y) for x, y in zip(u, v, strict=True)]
