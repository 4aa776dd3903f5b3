"""The discrete adjoint of a step is a step of the conjugate, and W. W. Hager's conditions are those
of the pair (docs/pair-order.md).
"""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq, fmpq_mat

from garkcli import load, loads
from garkcli.errors import ZeroWeight
from garkcli.order.certificate import find_order
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark

Rows = list[list[fmpq]]


def arrays(tableau: Tableau) -> tuple[Rows, list[fmpq]]:
    """A and b of a method of one colour with rational coefficients."""
    rows = [[fmpq(x) for x in row] for row in tableau.blocks[0, 0]]
    return rows, [fmpq(x) for x in tableau.colours[0].b]


def column(values: list[fmpq]) -> fmpq_mat:
    return fmpq_mat([[x] for x in values])


@pytest.mark.parametrize("name", ["rk4", "kutta-3", "radau-iia-2", "radau-ia-2", "lobatto-iiic-3"])
def test_the_gradient_of_a_step_is_a_step_of_the_conjugate(name: str) -> None:
    """dy₁/dy₀ with f'(Y_i) = g_i at the stages, any numbers: 1 + bᵀG(I − AG)⁻¹𝟙, and the costate
    goes back by it. Forwards it is a step of Â for ṗ = −g p.
    """
    tableau = load(name).tableau
    A, b = arrays(tableau)
    A_hat, b_hat = arrays(conjugate(tableau))
    assert b_hat == b
    dice, s = Random(7), len(b)
    g = [fmpq(dice.randrange(-20, 20), 11) for _ in b]
    one = column([fmpq(1)] * s)

    def factor(rows: Rows, slopes: list[fmpq]) -> fmpq:
        matrix = [[int(i == j) - rows[i][j] * slopes[j] for j in range(s)] for i in range(s)]
        stages = fmpq_mat(matrix).solve(one)
        return 1 + sum((b[i] * slopes[i] * stages[i, 0] for i in range(s)), start=fmpq(0))

    assert factor(A, g) * factor(A_hat, [-x for x in g]) == 1


def hager(A: Rows, b: list[fmpq]) -> int:
    """The order, up to 4, by the table of W. W. Hager, Numer. Math. 87, 2000."""
    stages = range(len(b))
    c = [sum(row, start=fmpq(0)) for row in A]
    d = [sum((b[i] * A[i][j] for i in stages), start=fmpq(0)) for j in stages]
    e = [x / y for x, y in zip(d, b, strict=True)]

    def total(values: list[fmpq]) -> fmpq:
        return sum(values, start=fmpq(0))

    def twice(u: list[fmpq], v: list[fmpq]) -> fmpq:
        return total([u[i] * A[i][j] * v[j] for i in stages for j in stages])

    bc = [x * y for x, y in zip(b, c, strict=True)]
    met = [
        total(b) == 1,
        total(d) == fmpq(1, 2),
        total([d[i] * c[i] for i in stages]) == fmpq(1, 6)
        and total([bc[i] * c[i] for i in stages]) == fmpq(1, 3)
        and total([d[i] * e[i] for i in stages]) == fmpq(1, 3),
        total([bc[i] * c[i] ** 2 for i in stages]) == fmpq(1, 4)
        and twice(bc, c) == fmpq(1, 8)
        and total([d[i] * c[i] ** 2 for i in stages]) == fmpq(1, 12)
        and twice(d, c) == fmpq(1, 24)
        and total([c[i] * d[i] * e[i] for i in stages]) == fmpq(1, 12)
        and total([d[i] * e[i] ** 2 for i in stages]) == fmpq(1, 4)
        and twice(bc, e) == fmpq(5, 24)
        and twice(d, e) == fmpq(1, 8),
    ]
    return met.index(False) if False in met else 4


NAMES = ["rk4", "kutta-3", "ralston-3", "ssp-33", "ssp-43", "sdirk-4", "esdirk-32i5", "ralston-2"]


def test_the_conditions_are_those_of_the_pair() -> None:
    """Methods of the catalogue, whose pairs have orders from 2 to 4, some of them less than the
    method, and others; with negative weights too.
    """
    tableaus = [load(name).tableau for name in NAMES]
    tableaus += [loads(text).tableau for text in MISSED]
    dice = Random(11)
    for _ in range(20):
        node = fmpq(dice.randrange(1, 9), 7)
        b2 = 1 / (2 * node)
        if b2 != 1:
            tableaus.append(loads(f"A: [[], [{node}]]\nb: [{1 - b2}, {b2}]").tableau)
    found = [min(find_order(pair(x)).order, 4) for x in tableaus]
    assert found == [hager(*arrays(x)) for x in tableaus]
    assert {*found} == {0, 1, 2, 3, 4}


MISSED = [
    "A: [[0, 0], [1, 0]]\nb: [1/4, 3/4]",
    "A: [[1/3, 0], [1, 0]]\nb: [3/4, 1/4]",
    "A: [[5/12, -1/12], [1/2, 1/2]]\nb: [3/4, 1/4]",
    "A: [[0, 0], [1/3, 1/3]]\nb: [1/4, 3/4]",
    "A: [[1/2, 0], [0, 1/2]]\nb: [2/3, 2/3]",
]
"""Methods that miss an order that similar ones have."""


def test_a_zero_weight() -> None:
    """With ε in place of the weight: where a stage that counts sees the stage, â grows as 1/ε and
    gark refuses 0; where none does it has a limit, the conjugate of the smaller method beside it.
    """
    seen = "A: [[0, 0], [1/2, 0]]\nb: [{0}, 1 - {0}]"
    unseen = "A: [[1/2, 0], [1/3, 1/3]]\nb: [1 - {0}, {0}]"
    sizes = [
        max(abs(x) for row in arrays(conjugate(loads(seen.format(e)).tableau))[0] for x in row)
        for e in ("1/10", "1/100", "1/1000")
    ]
    assert sizes[0] < sizes[1] < sizes[2]
    with pytest.raises(ZeroWeight):
        conjugate(loads(seen.format(0)).tableau)
    rows = arrays(conjugate(loads(unseen.format("1/1000000")).tableau))[0]
    smaller = arrays(conjugate(loads("A: [[1/2]]\nb: [1]").tableau))[0]
    assert abs(rows[0][0] - smaller[0][0]) < fmpq(1, 10**5)


def test_it_is_explained() -> None:
    """Under the word that people look for."""
    said = gark("explain", "adjoint").out
    assert "discrete adjoint: term" in said
    assert "Hager" in said
    assert "inverse of its step with −h" in said
