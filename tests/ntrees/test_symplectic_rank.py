"""The count of independent conditions is proved by rank: of the Jacobian of all conditions, modulo
a prime.

The Jacobian is taken with respect to the free coefficients of the method, by exact forward
differentiation in the integers modulo p, at a random symplectic method. Its rank is at most the
number of classes, by the theorem that members of a class are equivalent, and at most the rank over
the rational functions; reaching the number of classes it proves that none is superfluous.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from garkcli.ntrees.count import count_trees
from garkcli.ntrees.free import Structure
from garkcli.ntrees.symplectic import count_classes, structure_of
from garkcli.ntrees.table import TreeTable
from tests.whole import sample

P = 2**31 - 1
"""The prime: two products of residues add up to less than 2⁶³."""


@dataclass(frozen=True)
class Dual:
    """An array of residues and, on one more axis, its derivatives in all coefficients."""

    value: NDArray[np.int64]
    slope: NDArray[np.int64]

    def __add__(self, other: Dual) -> Dual:
        return Dual((self.value + other.value) % P, (self.slope + other.slope) % P)

    def __rsub__(self, constant: int) -> Dual:
        return Dual((constant - self.value) % P, -self.slope % P)

    def __mul__(self, other: Dual) -> Dual:
        slope = self.value[..., None] * other.slope + other.value[..., None] * self.slope
        return Dual(self.value * other.value % P, slope % P)

    def __getitem__(self, index: Any) -> Dual:
        return Dual(self.value[index], self.slope[index])

    def inverse(self) -> Dual:
        """One over each entry."""
        inverse = np.vectorize(lambda x: pow(int(x), -1, P), otypes=[np.int64])(self.value)
        return Dual(inverse, -(inverse * inverse % P)[..., None] * self.slope % P)

    def total(self) -> Dual:
        """The sum along the last axis."""
        return Dual(self.value.sum(axis=-1) % P, self.slope.sum(axis=-2) % P)

    def transposed(self) -> Dual:
        """Rows and columns of a matrix exchanged."""
        return Dual(self.value.T, self.slope.transpose(1, 0, 2))


class Coefficients:
    """Random residues, each a coefficient of its own to differentiate by."""

    def __init__(self, seed: int, size: int) -> None:
        self.dice = np.random.default_rng(seed)
        self.unit = np.eye(size, dtype=np.int64)
        self.used = 0

    def new(self, *shape: int) -> Dual:
        """An array of new coefficients, none of them zero."""
        number = int(np.prod(shape))
        slope = self.unit[self.used : self.used + number]
        self.used += number
        return Dual(self.dice.integers(1, P, shape), slope.reshape(*shape, -1))


@dataclass(frozen=True)
class Method:
    """Weights and blocks of every colour of a structure."""

    b: list[Dual]
    blocks: dict[tuple[int, int], Dual]


def pair_method(made: Structure, stages: dict[int, int], coefficients: Coefficients) -> Method:
    """A random symplectic pair: free A^{l,m} and b^l, conjugate Â^{l,m}."""
    weights = {term: coefficients.new(s) for term, s in stages.items()}
    forward: dict[tuple[int, int], Dual] = {}
    backward: dict[tuple[int, int], Dual] = {}
    for term in stages:
        for m in made.admissible.branches[made.leaders[term]]:
            other, part = made.colours[m]
            if part == "q":
                A = forward[term, other] = coefficients.new(stages[term], stages[other])
                ratio = (
                    A.transposed() * weights[other].inverse()[:, None]
                )  # a_{ji} / b_i, for Â^{other, term}
                backward[other, term] = weights[term][None] * (1 - ratio)
    blocks = {
        (l, m): (forward if made.colours[m][1] == "q" else backward)[
            made.colours[l][0], made.colours[m][0]
        ]
        for l, below in enumerate(made.admissible.branches)
        for m in below
    }
    return Method([weights[term] for term, _ in made.colours], blocks)


def self_conjugate_method(
    made: Structure, stages: dict[int, int], coefficients: Coefficients
) -> Method:
    """A random symplectic GARK method: a_{ij} = (1/2 + z_{ij}) b_j with z free but
    antisymmetric.
    """
    ends = np.cumsum([0, *stages.values()])
    size = int(ends[-1])
    b = coefficients.new(size)
    upper = coefficients.new(size * (size - 1) // 2)
    z = Dual(
        np.zeros((size, size), np.int64), np.zeros((size, size, upper.slope.shape[-1]), np.int64)
    )
    above = np.triu_indices(size, 1)
    z.value[above], z.slope[above] = upper.value, upper.slope
    half = (P + 1) // 2
    A = (1 - (half - z + z.transposed())) * b[None]
    parts = [slice(start, end) for start, end in pairwise(ends)]
    blocks = {
        (l, m): A[here, there] for l, here in enumerate(parts) for m, there in enumerate(parts)
    }
    return Method([b[parts[term]] for term, _ in made.colours], blocks)


def free_partitioned_method(s: int, coefficients: Coefficients) -> Method:
    """A random partitioned method, not symplectic: q and p share stages and weights, A and Â are
    both free.
    """
    b = coefficients.new(s)
    blocks = [coefficients.new(s, s), coefficients.new(s, s)]
    return Method([b, b], {(l, m): blocks[m] for l in range(2) for m in range(2)})


def jacobian(method: Method, table: TreeTable) -> NDArray[np.int64]:
    """The derivatives of all elementary weights, a row for each tree of the table."""
    vectors: list[Dual] = []
    rows = []
    for stem, branch, root in zip(
        table.stem.tolist(), table.branch.tolist(), table.root.tolist(), strict=True
    ):
        b = method.b[root]
        if branch < 0:
            vector = Dual(np.ones_like(b.value), np.zeros_like(b.slope))
        else:
            below = method.blocks[root, int(table.root[branch])] * vectors[branch][None]
            vector = vectors[stem] * below.total()
        vectors.append(vector)
        rows.append((b * vector).total().slope)
    return np.array(rows)


def rank(matrix: NDArray[np.int64]) -> int:
    """The rank modulo p, by elimination."""
    rows = matrix.copy() % P
    found = 0
    for column in range(rows.shape[1]):
        pivots = np.flatnonzero(rows[found:, column]) + found
        if not len(pivots):
            continue
        rows[[found, pivots[0]]] = rows[[pivots[0], found]]
        scaled = rows[found] * pow(int(rows[found, column]), -1, P) % P
        below = rows[found + 1 :]
        below[:] = (below - below[:, column, None] * scaled % P) % P
        found += 1
        if found == len(rows):
            break
    return found


CASES = [
    (structure_of("pair", 1), 6, (13,), 131),
    (structure_of("pair", 2), 4, (8, 8), 130),
    (structure_of("pair", 3), 3, (7, 7, 7), 75),
    (structure_of("self-conjugate", 1), 8, (9,), 40),
    (structure_of("self-conjugate", 2), 5, (10, 10), 77),
    (structure_of("self-conjugate", 3), 4, (6, 6, 6), 90),
    (structure_of("separable"), 8, (9, 9), 88),
    (structure_of("semi-separable"), 5, (17, 8), 129),
    (structure_of("nystrom"), 9, (14, 14), 67),
    (Structure.pair([0], [0], quadratic=[0]), 6, (10,), 35),
    (Structure.pair([0, 1], [0, 2]), 4, (8, 8, 8), 87),  # H(q, p) + T(p) + U(q)
]
"""Structures, highest orders, stages of each term (enough of them), and the number of classes up to
that order.
"""


def sizes(made: Structure, stages: tuple[int, ...]) -> Iterator[int]:
    """How many free coefficients the method has: weights, then blocks."""
    yield sum(stages)
    if not made.is_directed:
        yield sum(stages) * (sum(stages) - 1) // 2
        return
    s = dict(zip(made.leaders, stages, strict=True))
    for term, leader in made.leaders.items():
        for m in made.admissible.branches[leader]:
            if made.is_forward(m):
                yield s[term] * s[made.colours[m][0]]


@pytest.mark.parametrize(("made", "order", "stages", "classes"), sample(CASES, 4))
def test_rank_is_the_number_of_classes(
    made: Structure, order: int, stages: tuple[int, ...], classes: int
) -> None:
    """All conditions up to an order, at a random symplectic method, have as many independent ones
    as classes.
    """
    size = sum(sizes(made, stages))
    coefficients = Coefficients(order, size)
    of_terms = dict(zip(made.leaders, stages, strict=True))
    build = pair_method if made.is_directed else self_conjugate_method
    method = build(made, of_terms, coefficients)
    assert coefficients.used == size > classes
    assert rank(jacobian(method, TreeTable.of(made.admissible, order))) == classes
    assert sum(count_classes(made, n) for n in range(1, order + 1)) == classes


def test_without_symplecticity_the_rank_is_larger() -> None:
    """Control: with A and Â both free the rank up to order 4 is that of all trees but for twin
    roots, not 13.
    """
    coefficients = Coefficients(4, 7 + 2 * 49)
    jacobian_of_all = jacobian(free_partitioned_method(7, coefficients), TreeTable.upto(2, 4))
    assert rank(jacobian_of_all) == sum(count_trees(2, n) for n in range(1, 5)) // 2 == 36
