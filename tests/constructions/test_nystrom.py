"""Nyström methods: spans, all trees, and power series that know neither trees nor gark."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from random import Random

import pytest
from flint import fmpq

from garkcli.check.nystrom import NystromDense
from garkcli.constructions.nystrom import Nystrom, dense_of, nystrom
from garkcli.errors import ShapeMismatch
from garkcli.exact.matrix import apply, apply_left
from garkcli.frozen import replace
from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import find_order
from garkcli.order.conditions import all_conditions
from garkcli.tableau.tableau import Tableau
from tests.constructions.test_rosenbrock import RUNGE_KUTTA, engine, fractions
from tests.oracles import nystrom_series as series
from tests.oracles.brute import Trees, Weights, brute_order, required
from tests.whole import at_most

LIMIT = 5


def made(method: series.Method) -> Nystrom:
    A = None if method.A is None else engine(method.A)
    return Nystrom(engine(method.Abar), A, engine(method.c), engine(method.bbar), engine(method.b))


def of_runge_kutta(A: series.Matrix, b: list[Fraction]) -> series.Method:
    """What a Runge–Kutta method is for q̇ = p, ṗ = g(q, p): Ā = A², b̄ = Aᵀb."""
    s = range(len(b))
    Abar = [[sum((A[i][k] * A[k][j] for k in s), Fraction(0)) for j in s] for i in s]
    bbar = [sum((b[k] * A[k][j] for k in s), Fraction(0)) for j in s]
    return series.Method(Abar, A, [sum(row, Fraction(0)) for row in A], bbar, b)


FINE = series.Method(
    fractions(
        "0 0 0 0 0; 2/81 0 0 0 0; 1/36 1/36 0 0 0; 9/128 0 27/128 0 0; 11/60 -3/20 9/25 8/75 0"
    ),
    fractions(
        "0 0 0 0 0; 2/9 0 0 0 0; 1/12 1/4 0 0 0; 69/128 -243/128 135/64 0 0;"
        " -17/12 27/4 -27/5 16/15 0"
    ),
    fractions("0 2/9 1/3 3/4 1")[0],
    fractions("19/180 0 63/200 16/225 1/120")[0],
    fractions("1/9 0 9/20 16/45 1/12")[0],
)
"""J. M. Fine, Computing 38 (1987) 281: order 4."""
NYSTROM_5 = series.Method(
    fractions("0 0 0 0; 1/50 0 0 0; -1/27 7/27 0 0; 3/10 -2/35 9/35 0"),
    None,
    fractions("0 1/5 2/3 1")[0],
    fractions("14/336 100/336 54/336 0")[0],
    fractions("14/336 125/336 162/336 35/336")[0],
)
"""E. J. Nyström's method of order 5 for g(q); E. Hairer, S. P. Nørsett, G. Wanner, *Solving
ODEs I*, table II.14.2.
"""


def random_method(seed: int) -> series.Method:
    """Runge–Kutta methods and published ones, one entry changed or none; small fractions whose
    weights sum to 1.
    """
    dice = Random(seed)
    kind = dice.choice(["free", "rk", "rk", "fine", "q"])
    if kind == "free":
        s = dice.choice([2, 3])

        def matrix() -> list[list[Fraction]]:
            return [
                [Fraction(dice.randint(-2, 3), dice.randint(1, 4)) for _ in range(s)]
                for _ in range(s)
            ]

        A = matrix() if dice.random() < 0.7 else None
        c = [sum(row) for row in A] if A else [Fraction(dice.randint(0, 3), 3) for _ in range(s)]
        b = [Fraction(dice.randint(1, 3), dice.randint(2, 4)) for _ in range(s - 1)]
        b.append(1 - sum(b))
        bbar = [x * (1 - y) for x, y in zip(b, c, strict=True)]
        return series.Method(matrix(), A, c, bbar, b)
    if kind == "rk":
        A, b = dice.choice(RUNGE_KUTTA)
        method = of_runge_kutta(A, b)
    else:
        method = FINE if kind == "fine" else NYSTROM_5
    if dice.random() < 0.2:
        return method
    name = dice.choice(["Abar", "A", "c", "bbar", "b"] if method.A else ["Abar", "c", "bbar", "b"])
    value = getattr(method, name)
    off = Fraction(dice.choice([-1, 1]), dice.randint(2, 9))
    if name in {"Abar", "A"}:
        value = [list(row) for row in value]
        i = dice.randint(1, len(value) - 1)
        value[i][dice.randint(0, i - 1)] += off
    else:
        value = list(value)
        value[dice.randint(0, len(value) - 1)] += off
    return series.Method(**{**vars(method), name: value})


def brute_orders(tableau: Tableau) -> tuple[int, int]:
    """Of q and of q′: the trees by the colours of their roots."""
    trees, weights = Trees(tableau), Weights(tableau)
    found = []
    for root in (0, 1):
        missed = (
            n - 1
            for n in range(1, LIMIT + 1)
            if any(
                weights.weight(u) != required(tableau, u) for u in trees.of_order(n) if u[0] == root
            )
        )
        found.append(next(missed, LIMIT))
    return found[0], found[1]


def test_random_methods_three_ways() -> None:
    """Spans, all trees and power series find one order of q and one of q′; all up to 4 occur."""
    of_q, of_v = Counter[int](), Counter[int]()
    for seed in range(at_most(80, 250)):
        method = random_method(seed)
        tableau = made(method).tableau
        q, v = series.orders(method, LIMIT, seed)
        assert brute_orders(tableau) == (q, v)
        assert find_order(made(method).in_positions, LIMIT).order == q
        assert find_order(made(method).in_velocities, LIMIT).order == v
        assert find_order(tableau, LIMIT).order == min(q, v) == brute_order(tableau, LIMIT)
        of_q[q] += 1
        of_v[v] += 1
    assert {1, 2, 3, 4} <= of_q.keys()
    assert {0, 1, 2, 3, 4} <= of_v.keys()
    assert of_q != of_v


def test_time_is_at_the_nodes() -> None:
    """The order for g(t, q, q′) with t + c_i h in the stages is that for g(q, q′), also with nodes
    that are no row sums: time and q′ have the same columns.
    """
    found = Counter[int]()
    for seed in range(30):
        method = random_method(seed)
        with_time = series.orders(method, LIMIT, seed, has_time=True)
        assert with_time == series.orders(method, LIMIT, seed)
        found[min(with_time)] += 1
    assert {1, 2, 3, 5} <= found.keys()


def test_published_methods() -> None:
    """Fine's method has order 4, and 5 in q; with the misprint −234/128 of a program 1, and 2 in q.
    Nyström's has order 5 for g(q).
    """
    fine = made(FINE)
    assert find_order(fine.tableau, 8).order == 4
    assert find_order(fine.in_positions, 8).order == 5
    assert FINE.A is not None
    rows = [list(row) for row in FINE.A]
    rows[3][1] = Fraction(-234, 128)
    wrong = replace(fine, A=engine(rows))
    assert (find_order(wrong.in_positions).order, find_order(wrong.in_velocities).order) == (2, 1)
    assert series.orders(series.Method(**{**vars(FINE), "A": rows}), LIMIT) == (2, 1)
    assert find_order(made(NYSTROM_5).tableau, 8).order == 5


def counted_by_series(*, sees_velocity: bool, most: int) -> list[int]:
    """Trees with a root of q′: the root counts one order, and on it is a multiset of leaves q′, of
    such trees, and of such trees that count one order more.
    """
    trees = [0] * (most + 1)
    for n in range(1, most + 1):
        branches = [0, 1, *trees[1:most]]
        if sees_velocity:
            branches = [x + y for x, y in zip(branches, trees, strict=True)]
        forests = [1] + [0] * most
        for weight in range(1, n):
            for _ in range(branches[weight]):
                for k in range(weight, n):
                    forests[k] += forests[k - weight]
        trees[n] = forests[n - 1]
    return trees[1:]


def test_numbers_of_conditions() -> None:
    """There are as many trees with a root of q′ as the recursion by multisets counts; for g(q) they
    are those of E. Hairer, S. P. Nørsett, G. Wanner, *Solving ODEs I*, II.14.
    """
    general, special = made(FINE).tableau, made(NYSTROM_5).tableau

    def counts(tableau: Tableau) -> list[int]:
        return [sum(x.tree.root == 1 for x in all_conditions(tableau, n)) for n in range(1, 7)]

    assert counts(special) == [1, 1, 2, 3, 6, 10]
    assert counts(special) == counted_by_series(sees_velocity=False, most=6)
    assert counts(general) == counted_by_series(sees_velocity=True, most=6)


def test_conditions_of_the_book() -> None:
    """The conditions of order 3 are those of E. Hairer, S. P. Nørsett, G. Wanner, *Solving ODEs I*,
    II.14: b, A, Ā and c at their places.
    """
    method = made(random_method(3))
    assert method.A is not None
    one = (fmpq(1),) * len(method.b)
    a = apply(method.A, one)
    expected = {
        "[[]_2]_1": apply_left(method.bbar, method.A),
        "[[]_1]_2": apply_left(method.b, method.Abar),
        "[[[]_3]_2]_2": apply_left(
            method.b,
            tuple(tuple(x * y for x, y in zip(row, method.c, strict=True)) for row in method.A),
        ),
        "[[]_2,[]_3]_2": tuple(x * y * z for x, y, z in zip(method.b, a, method.c, strict=True)),
    }
    found = {format_tree(x.tree): x for x in all_conditions(method.tableau, 3)}
    for tree, terms in expected.items():
        assert found[tree].value == sum(terms, start=fmpq(0))
    assert [found[u].required for u in expected] == [fmpq(1, n) for n in (6, 6, 6, 3)]


def test_the_method_of_a_tableau() -> None:
    """``Nystrom.of`` is the inverse of ``tableau``, with A or without."""
    for method in map(made, (FINE, NYSTROM_5, random_method(1))):
        assert Nystrom.of(method.tableau) == method


def test_partitioned_method_has_the_same_orders() -> None:
    """The partitioned method for q̇ = p, ṗ = g(q) is the Nyström method: its order is that for g(q)
    of all trees, and its steps are the same.
    """
    for seed in range(40):
        method = made(random_method(seed))
        alone = replace(method, A=None)
        assert find_order(alone.partitioned, LIMIT).order == find_order(alone.tableau, LIMIT).order


def test_wrong_shapes() -> None:
    """Matrices and rows of other sizes than b are refused."""
    zero, one = fmpq(0), fmpq(1)
    row, square = (one, zero), ((zero, zero), (one, zero))
    assert nystrom(square, None, row, row, row).b == row
    for wrong in (
        (((zero,),), None, row, row, row),
        (square, ((zero, zero),), row, row, row),
        (square, None, (one,), row, row),
        (square, None, row, (one,), row),
    ):
        with pytest.raises(ShapeMismatch, match="b has 2 entries"):
            nystrom(*wrong)


Polynomials = list[list[Fraction]]


def interpolated(method: series.Method, seed: int) -> tuple[Polynomials, Polynomials | None]:
    """Hermite's polynomials through both ends of the step, of degree 3, or with g at the beginning
    of degree 4, the velocity their slope; one coefficient changed or none.
    """
    dice = Random(seed)
    is_quartic, bbar = dice.random() < 0.7, Polynomials()
    for i, (x, y) in enumerate(zip(method.bbar, method.b, strict=True)):
        first = Fraction(is_quartic and i == 0)
        D, V = x - first / 2, y - first
        tail = [4 * D - V, V - 3 * D] if is_quartic else [V - 2 * D, Fraction(0)]
        bbar.append([Fraction(0), first / 2 if is_quartic else 3 * D - V, *tail])
    if dice.random() < 0.4:
        return bbar, None
    b = [[k * x for k, x in enumerate(row[1:], start=2)] + [Fraction(0)] for row in bbar]
    which = dice.choice([bbar, b])
    which[dice.randrange(len(b))][dice.randint(1, 3)] += Fraction(dice.randint(0, 1), 3)
    return bbar, b


def at(method: series.Method, theta: Fraction, bbar: Polynomials, b: Polynomials) -> series.Method:
    """The output at θ as a step of θh."""

    def value(row: list[Fraction]) -> Fraction:
        return sum((x * theta**k for k, x in enumerate(row, start=1)), Fraction(0))

    def over(rows: series.Matrix, factor: Fraction) -> series.Matrix:
        return [[x / factor for x in row] for row in rows]

    return series.Method(
        over(method.Abar, theta**2),
        None if method.A is None else over(method.A, theta),
        [x / theta for x in method.c],
        [value(row) / theta**2 for row in bbar],
        [value(row) / theta for row in b],
    )


def test_dense_output_by_power_series() -> None:
    """The orders of dense output in q and in q′ are the smallest of those at several θ, by power
    series; all from 1 to 4 occur.
    """
    of_q, of_v = Counter[int](), Counter[int]()
    for seed in range(at_most(60, 250)):
        method = random_method(seed)
        bbar, b = interpolated(method, seed)
        dense = dense_of(engine(bbar), None if b is None else engine(b))
        b = b or [[k * x for k, x in enumerate(row[1:], start=2)] for row in bbar]
        found = NystromDense.of(made(method).tableau, dense, LIMIT, None)
        seen = [
            series.orders(at(method, Fraction(theta), bbar, b), LIMIT, seed)
            for theta in ("1/3", "3/5", "5/7", "-2/3", "3/2")
        ]
        q, v = (min(x) for x in zip(*seen, strict=True))
        assert (found.position_order.order, found.velocity_order.order) == (q, v)
        assert found.order.order == min(q, v)
        of_q[q] += 1
        of_v[v] += 1
    assert {1, 2, 3, 4} <= of_q.keys()
    assert {0, 1, 2, 3} <= of_v.keys()
