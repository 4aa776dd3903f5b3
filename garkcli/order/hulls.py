"""Affine hulls over ℚ of the stage vectors of all trees up to an order, for a proof assistant.

A stage value over ℚ(θ) of degree d is a vector of s d rational numbers: entry i d + e is the
coefficient of θᵉ at stage i. ψ of a tree is affine in each branch (``docs/certificate.md``), so
hulls that are closed under the recursion for ψ contain it for all trees. A check needs no list of
trees and no theory of number fields.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

from flint import fmpq, fmpq_mat

from garkcli.deadline import check_time
from garkcli.exact.field import flat
from garkcli.exact.matrix import Vector, apply
from garkcli.exact.span import leading_columns
from garkcli.frozen import Frozen
from garkcli.tableau.tableau import Tableau


class Hull(Frozen):
    """The affine space of all base + Σ_k λ_k direction_k, directions in reduced echelon form.
    ``base`` is zero at all pivots.
    """

    base: tuple[fmpq, ...]
    directions: tuple[tuple[int, tuple[fmpq, ...]], ...] = ()

    @classmethod
    def of(cls, points: Sequence[Sequence[fmpq]]) -> Hull:
        first, *others = points
        rows = [[x - y for x, y in zip(other, first, strict=True)] for other in others]
        if not rows:
            return cls(tuple(first))
        reduced, rank = fmpq_mat(rows).rref()
        table = [tuple(row) for row in reduced.tolist()[:rank]]
        pivots = leading_columns(reduced)
        base = list(first)
        for pivot, row in zip(pivots, table, strict=True):
            base = [x - first[pivot] * y for x, y in zip(base, row, strict=True)]
        return cls(tuple(base), tuple(zip(pivots, table, strict=True)))

    @property
    def points(self) -> list[tuple[fmpq, ...]]:
        moved = (
            tuple(x + y for x, y in zip(self.base, row, strict=True)) for _, row in self.directions
        )
        return [self.base, *moved]


class Hulls(Frozen):
    """The hulls for all trees up to an order p; None stands for no trees.

    ``trees[k][l]`` holds ψ of the trees of order k + 1 ≤ p with root colour l, and
    ``branches[j][l]`` A^{l,m} (j ψ(u)) for all trees u of order j < p.
    """

    trees: tuple[tuple[Hull | None, ...], ...]
    branches: tuple[tuple[Hull | None, ...], ...]


def hulls(tableau: Tableau, order: int) -> Hulls:
    colours = range(tableau.size)
    degree = tableau.degree

    def whole(point: Sequence[fmpq]) -> Vector:
        if tableau.field is None:
            return tuple(point)
        parts = (point[i : i + degree] for i in range(0, len(point), degree))
        return tuple(map(tableau.field.from_coordinates, parts))

    def points(hull: Hull | None) -> list[Vector]:
        return [] if hull is None else [whole(point) for point in hull.points]

    def hull_of(vectors: Iterable[Vector]) -> Hull | None:
        found = [flat(vector, degree) for vector in vectors]
        return Hull.of(found) if found else None

    trees: list[tuple[Hull | None, ...]] = [tuple(hull_of([tableau.space(l).one]) for l in colours)]
    branches: list[tuple[Hull | None, ...]] = [(None,) * tableau.size]
    for k in range(1, order):
        check_time()
        branches.append(
            tuple(
                hull_of(
                    apply(block, [k * x for x in point])
                    for m in colours
                    if (block := tableau.block(l, m)) is not None
                    for point in points(trees[k - 1][m])
                )
                for l in colours
            )
        )
        trees.append(
            tuple(
                hull_of(
                    tableau.space(l).product(branch, rest)
                    for j in range(1, k + 1)
                    for branch, rest in product(points(branches[j][l]), points(trees[k - j][l]))
                )
                for l in colours
            )
        )
    return Hulls(tuple(trees), tuple(branches))
