"""Rosenbrock–Wanner and W-methods: spans, all trees, and power series that know neither trees nor
gark.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from garkcli import hamiltonian, loads
from garkcli.backward.modified import modified_equation
from garkcli.constructions.composition import Substep, adjoint, in_turn
from garkcli.constructions.rosenbrock import Rosenbrock, rosenbrock, seen, transformed
from garkcli.design.conditions import FamilyConditions
from garkcli.design.search.residuals import Residuals
from garkcli.errors import MethodError
from garkcli.exact.matrix import Vector, add, apply, dot
from garkcli.exact.parametric import Parameters
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.writer import write_method
from garkcli.ntrees.notation import format_tree, parse_tree
from garkcli.order import constants
from garkcli.order.admissible import count_conditions, elementary_weight, is_admissible
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import find_order
from garkcli.order.conditions import all_conditions, conditions
from garkcli.order.deciding import order_of
from garkcli.order.dense import dense_order
from garkcli.order.functionals import KnownOrders, estimator
from garkcli.order.meant import as_meant
from garkcli.order.rounded import RoundedOrder
from garkcli.order.simplifying import is_symplectic
from garkcli.order.tree_residuals import TreeResiduals
from garkcli.stability.fraction import stability_fraction
from garkcli.stability.oscillator import usual_oscillator
from garkcli.stepping.integrator import bind
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.forms import pair, with_time
from garkcli.tableau.tableau import Tableau
from tests.oracles import rosenbrock_series as series
from tests.oracles.brute import Trees, Weights, brute_order, plain, required, same_tree
from tests.whole import at_most

TABLEAUS: dict[series.Which, Callable[[Rosenbrock], Tableau]] = {
    "exact": lambda method: method.tableau,
    "any": lambda method: method.with_any_matrix,
    "old": lambda method: method.with_old_jacobian,
}
LIMIT = 5
Square = list[list[Fraction]]


def engine(x: Any) -> Any:
    """Fractions, at any depth, as numbers of the engine."""
    if isinstance(x, Fraction):
        return fmpq(x.numerator, x.denominator)
    return tuple(map(engine, x))


def fractions(text: str) -> Square:
    """A matrix, written in rows."""
    return [[Fraction(x) for x in row.split()] for row in text.split(";")]


def made(method: series.Method) -> Rosenbrock:
    return Rosenbrock(engine(method.alpha), engine(method.gamma), engine(method.b))


def numbers(x: Any) -> Any:
    """Numbers of the engine, at any depth, as fractions."""
    if isinstance(x, fmpq):
        return Fraction(int(x.p), int(x.q))
    return [*map(numbers, x)]


RODAS3 = transformed(
    engine(fractions("0 0 0 0; 0 0 0 0; 2 0 0 0; 2 0 1 0")),
    engine(fractions("0 0 0 0; 4 0 0 0; 1 -1 0 0; 1 -1 -8/3 0")),
    (fmpq(1, 2),) * 4,
    engine(fractions("2 0 1 1")[0]),
)
"""A. Sandu et al., "Benchmarking stiff ODE solvers for atmospheric chemistry problems II", Atmos.
Environ. 31 (1997) 3459.
"""
RODAS3_EMBEDDED = engine(fractions("3/4 -1/4 1/2 0")[0])
THETA = loads("A: [[sqrt(3)/6]]\nb: [1]").tableau.block(0, 0)
RUNGE_KUTTA = (
    (fractions("0 0; 2/3 0"), fractions("1/4 3/4")[0]),
    (fractions("0 0 0; 1/2 0 0; -1 2 0"), fractions("1/6 2/3 1/6")[0]),
    (fractions("0 0 0 0; 1/2 0 0 0; 0 1/2 0 0; 0 0 1 0"), fractions("1/6 1/3 1/3 1/6")[0]),
)


def ros3p() -> Rosenbrock:
    """J. Lang, J. Verwer, "ROS3P – an accurate third-order Rosenbrock solver designed for parabolic
    problems", BIT 41 (2001) 731; γ = 1/2 + √3/6.
    """
    assert THETA is not None
    g, zero, one = fmpq(1, 2) + THETA[0][0], fmpq(0), fmpq(1)
    alpha = ((zero,) * 3, (one, zero, zero), (one, zero, zero))
    gamma = ((g, zero, zero), (-one, g, zero), (-g, fmpq(1, 2) - 2 * g, g))
    return rosenbrock(alpha, gamma, engine(fractions("2/3 0 1/3")[0]))


def random_matrix(dice: Random, s: int, diagonal: Fraction) -> Square:
    def entry(i: int, j: int) -> Fraction:
        if i == j:
            return diagonal
        return Fraction(dice.randint(-3, 3), dice.randint(1, 3)) if j < i else Fraction(0)

    return [[entry(i, j) for j in range(s)] for i in range(s)]


def random_method(seed: int) -> series.Method:
    """Small fractions; most sum to 1, many meet the second condition, and some are Runge–Kutta
    methods or RODAS3 with one entry changed, or none.
    """
    dice = Random(seed)
    kind = dice.choice(["free", "tuned", "tuned", "rk", "rk", "rodas3"])
    if kind == "rk":
        alpha, b = dice.choice(RUNGE_KUTTA)
        gamma = [[Fraction(0)] * len(b) for _ in b]
        if dice.random() < 0.6:  # γ𝟙 = 0, and γc = 0 where two nodes are equal
            i = dice.randint(1, len(b) - 1)
            gamma[-1][i - 1] = Fraction(dice.randint(1, 3), 2)
            gamma[-1][i] = -gamma[-1][i - 1]
        if dice.random() < 0.2:
            gamma[0][0] = Fraction(1, 2)
    elif kind == "rodas3":
        alpha, gamma = numbers(RODAS3.alpha[0][0]), numbers(RODAS3.gamma[0][0])
        b = numbers(RODAS3.b[0])
        for _ in range(dice.randint(0, 1)):
            i = dice.randint(1, 3)
            dice.choice([alpha, gamma])[i][dice.randint(0, i - 1)] += Fraction(
                1, dice.randint(2, 9)
            )
    else:
        s = dice.choice([2, 3])
        alpha = random_matrix(dice, s, Fraction(0))
        gamma = random_matrix(dice, s, Fraction(dice.randint(1, 4), 4))
        b = [Fraction(dice.randint(1, 3), dice.randint(2, 4)) for _ in range(s - 1)]
        b.append(1 - sum(b))
        if kind == "tuned" and b[-1]:
            beta = [sum(x) + sum(y) for x, y in zip(alpha, gamma, strict=True)]
            off = Fraction(1, 2) - sum(x * y for x, y in zip(b, beta, strict=True))
            gamma[-1][0] += off / b[-1]
    return series.Method([[alpha]], [[gamma]], [b])


def assert_agreed(tableau: Tableau, method: series.Method, which: series.Which, seed: int) -> int:
    """The order, three ways; the witness is an admissible tree that fails."""
    found = find_order(tableau, LIMIT)
    assert found.order == brute_order(tableau, LIMIT) == series.order(method, which, LIMIT, seed)
    if found.witness is not None:
        tree = plain(found.witness.tree)
        assert any(same_tree(tree, u) for u in Trees(tableau).of_order(found.order + 1))
        assert found.witness.value == Weights(tableau).weight(tree)
        assert found.witness.required == required(tableau, tree) != found.witness.value
    return found.order


@pytest.mark.parametrize("which", TABLEAUS)
def test_random_methods_three_ways(which: series.Which) -> None:
    """Spans, all trees and power series find one order; each order up to 4 occurs."""
    orders = Counter(
        assert_agreed(TABLEAUS[which](made(method)), method, which, seed)
        for seed in range(at_most(70, 250))
        for method in [random_method(seed)]
    )
    assert {1, 2, 3, 4} <= orders.keys()
    assert orders[2] > 5


def test_random_methods_with_time_three_ways() -> None:
    """Of f(t, y), with nodes and weights of f_t that are the row sums, or one of them wrong."""
    orders = Counter()
    for seed in range(at_most(20, 250)):
        dice, method = Random(seed), random_method(seed)
        c = [sum(row, Fraction(0)) for row in method.alpha[0][0]]
        d = [sum(row, Fraction(0)) for row in method.gamma[0][0]]
        if dice.random() < 0.5:
            dice.choice([c, d])[-1] += Fraction(dice.choice([-1, 1]), dice.randint(2, 4))
        timed = replace(made(method), c=(engine(c),), d=(engine(d),)).with_time
        limit = replace_time(method, c, d)
        orders[assert_agreed(timed, limit, "exact", seed)] += 1
    assert {1, 2, 3} <= orders.keys()


def replace_time(method: series.Method, c: Sequence[Fraction], d: Sequence[Fraction]) -> Any:
    return series.Method(method.alpha, method.gamma, method.b, c, d)


@pytest.mark.parametrize("which", TABLEAUS)
def test_two_colours_three_ways(which: series.Which) -> None:
    """Linearly implicit GARK methods: two fields, each with its own Jacobian."""
    orders = Counter()
    for seed in range(at_most(10, 250)):
        one, other = random_method(seed), random_method(seed + 1)
        if len(one.b[0]) != len(other.b[0]) or seed % 2 == 0:
            other = one
        (alpha,), (gamma,) = one.alpha[0], one.gamma[0]
        (second,), (third,) = other.alpha[0], other.gamma[0]
        method = series.Method(
            [[alpha, second], [alpha, second]],
            [[gamma, third], [gamma, third]],
            [one.b[0], other.b[0]],
        )
        tableau = TABLEAUS[which](made(method))
        found = find_order(tableau, 4).order
        assert found == brute_order(tableau, 4) == series.order(method, which, 4, seed)
        orders[found] += 1
    assert {1, 2, 3} <= orders.keys()


def test_published_methods() -> None:
    """RODAS3 and ROS3P have order 3 and embedded order 2; with any matrix RODAS3 loses two orders,
    and with an old Jacobian one. ROS2 keeps order 2 with any matrix, whatever γ is.
    """
    orders = {which: find_order(of(RODAS3)).order for which, of in TABLEAUS.items()}
    assert orders == {"exact": 3, "any": 1, "old": 2}
    assert find_order(RODAS3.with_time).order == 3
    embedded = replace(RODAS3, b=(RODAS3_EMBEDDED,))
    assert find_order(embedded.tableau).order == 2
    assert find_order(ros3p().tableau).order == 3
    assert find_order(ros3p().with_time).order == 3
    worse = replace(ros3p(), b=(engine(fractions("1/3 1/3 1/3")[0]),))
    assert find_order(worse.tableau).order == 2
    for g in (fmpq(1, 5), fmpq(1), fmpq(2)):
        zero, one, half = fmpq(0), fmpq(1), fmpq(1, 2)
        ros2 = rosenbrock(((zero, zero), (one, zero)), ((g, zero), (-2 * g, g)), (half, half))
        assert [find_order(of(ros2)).order for of in TABLEAUS.values()] == [2, 2, 2]


def test_wrong_weights_of_time() -> None:
    """Nodes and d that are not the row sums, as a program may have them: order 1 of f(t, y), while
    that of f(y) is 3.
    """
    sums = apply(RODAS3.gamma[0][0], (fmpq(1),) * 4)
    wrong = (*sums[:3], sums[3] + fmpq(1, 2))
    assert find_order(replace(RODAS3, d=(wrong,)).with_time).order == 1
    assert find_order(replace(RODAS3, d=(sums,)).with_time).order == 3


GRK4T = """
0 0 0 0; 0.462 0 0 0; -0.0815668168327 0.961775150166 0 0; -0.0815668168327 0.961775150166 0 0 |
0.231 0 0 0; -0.270629667752 0.231 0 0; 0.311254483294 0.00852445628482 0.231 0;
0.282816832044 -0.457959483281 -0.111208333333 0.231 |
0.217487371653 0.486229037990 0 0.296283590357"""
"""P. Kaps, P. Rentrop, "Generalized Runge–Kutta methods of order four with stepsize control for
stiff ordinary differential equations", Numer. Math. 33 (1979) 55.
"""


def grk4t(text: str = GRK4T) -> MethodFile:
    alpha, gamma, b = (
        [f"[{', '.join(row.split())}]" for row in part.split(";")] for part in text.split("|")
    )
    keys = f"alpha: [{', '.join(alpha)}], gamma: [{', '.join(gamma)}], b: {b[0]}"
    return loads(f"rosenbrock: {{{keys}}}\ntolerance: 1e-11")


def test_rounded_method() -> None:
    """GRK4T has order 4 within its digits and not 5; of f with an old Jacobian 2, of any matrix 1;
    with one digit changed 1.
    """
    method = as_meant(grk4t())
    old, w = seen(method, "with_old_jacobian"), seen(method, "with_any_matrix")
    orders = [order_of(x) for x in (method, old, w)]
    assert [x.order for x in orders] == [4, 2, 1]
    assert all(x.witness is not None for x in orders)
    assert find_order(grk4t().tableau).order < 4
    assert isinstance(orders[0], RoundedOrder)
    assert arb(0) < orders[0].largest_residual < 1e-12
    misprint = grk4t(GRK4T.replace("0.961775150166", "0.961875150166"))
    assert order_of(as_meant(misprint)).order == 1


def test_conditions_of_the_book() -> None:
    """The elementary weights of the trees up to order 4 are the sums of E. Hairer, G. Wanner,
    *Solving ODEs II*, table IV.7.1, with β in chains and α at branchings.
    """
    method = made(random_method(5))
    tableau = method.tableau
    alpha, b = method.alpha[0][0], method.b[0]
    beta = add(alpha, method.gamma[0][0])
    one = (fmpq(1),) * len(b)
    c, e = apply(alpha, one), apply(beta, one)

    def times(*rows: Vector) -> Vector:
        result = one
        for row in rows:
            result = tuple(x * y for x, y in zip(result, row, strict=True))
        return result

    expected = {
        "[]_1": one,
        "[[]_1]_2": e,
        "[[]_1,[]_1]_1": times(c, c),
        "[[[]_1]_2]_2": apply(beta, e),
        "[[]_1,[]_1,[]_1]_1": times(c, c, c),
        "[[[]_1]_2,[]_1]_1": times(apply(alpha, e), c),
        "[[[]_1,[]_1]_1]_2": apply(beta, times(c, c)),
        "[[[[]_1]_2]_2]_2": apply(beta, apply(beta, e)),
    }
    found = [x for n in range(1, 5) for x in all_conditions(tableau, n)]
    assert {format_tree(x.tree) for x in found} == expected.keys()
    for x in found:
        assert x.value == dot(b, expected[format_tree(x.tree)])
        assert x.required == fmpq(1, x.tree.density)


def test_trees_from_text() -> None:
    """Conditions of trees in text know what vertices count; others than the admissible ones are
    refused.
    """
    tableau = RODAS3.with_old_jacobian
    (found,) = conditions(tableau, [parse_tree("[[[]_1]_2]_3")])
    assert (found.tree.order, found.required) == (4, 0)
    assert found.value == elementary_weight(tableau, found.tree)
    for text in ("[]_2", "[[]_1]_1", "[[]_1,[]_1]_3"):
        tree = parse_tree(text)
        assert not is_admissible(tableau, tree)
        with pytest.raises(MethodError, match=r"have (one branch|no branch or several branches)"):
            list(conditions(tableau, [tree]))


@pytest.mark.parametrize("which", TABLEAUS)
def test_balls_of_all_trees(which: series.Which) -> None:
    """Residuals in balls are those of the conditions, tree by tree; the approximate spans bound
    them all, and members reach what they say.
    """
    tableau = TABLEAUS[which](made(random_method(11)))
    enclosure = enclose_tableau(tableau, 200)
    residuals = TreeResiduals(tableau, enclosure)
    spans = ApproximateSpans(tableau, enclosure, arb(10) ** -20)
    for order in range(1, 7):
        exact = {x.tree: x for x in all_conditions(tableau, order)}
        table = residuals.table(order)
        found = {table.tree(u): (value, due) for value, due, u in residuals.of_order(order)}
        assert found.keys() == exact.keys()
        with ctx.workprec(200):
            for tree, (value, due) in found.items():
                assert value.overlaps(arb(exact[tree].residual))
                assert due.overlaps(arb(exact[tree].required))
            sizes = spans.sizes(order)
            normalised = [
                abs(arb(x.residual)) * u.density / u.kind.integrated(order)
                for u, x in exact.items()
            ]
            assert all(not x > sizes.bound for x in normalised)
            for size, tree in sizes.members:
                assert abs(size - abs(arb(exact[tree].residual))) < 1e-15


@pytest.mark.parametrize("which", TABLEAUS)
def test_error_constants(which: series.Which) -> None:
    """In floats they are the exact ones, and these are sums over all trees."""
    tableau = TABLEAUS[which](RODAS3)
    for order in (3, 4, 5):
        exact = constants.error_constants(tableau, order)
        floats = constants._in_floats(tableau, order, 1)
        assert exact is not None
        assert exact.is_exact
        assert exact.all.trees == floats.all.trees == count_conditions(tableau, order)
        assert floats.all.two == pytest.approx(exact.all.two, rel=1e-12, abs=1e-14)
        assert floats.coupling.two == pytest.approx(exact.coupling.two, rel=1e-12, abs=1e-14)
        total = sum(
            ((x.residual / x.tree.symmetry) ** 2 for x in all_conditions(tableau, order)), fmpq(0)
        )
        assert exact.all.two_squared == total


def test_embedded_weights_and_dense_output() -> None:
    """The estimate of RODAS3 is O(h³). Dense output of degree 2 has order 2 with the exact
    Jacobian, as β counts in it; with any matrix it has order 1.
    """
    tableau, (b,) = RODAS3.tableau, RODAS3.b
    weights = tuple(RODAS3_EMBEDDED if x.term == 0 else x.b for x in tableau.colours)
    found = estimator(tableau, weights, KnownOrders(2, True, 5))
    assert (found.order, found.is_zero) == (3, False)
    beta = add(RODAS3.alpha[0][0], RODAS3.gamma[0][0])
    e = apply(beta, (fmpq(1),) * 4)
    slope = fmpq(1, 2) / (e[2] - e[0])
    second = (-slope, fmpq(0), slope, fmpq(0))
    rows = tuple(zip((x - y for x, y in zip(b, second, strict=True)), second, strict=True))
    for which, order in (("exact", 2), ("any", 1)):
        of = TABLEAUS[which](RODAS3)  # type: ignore[index]
        dense = DenseOutput((rows,) * of.size)
        assert dense_order(of, dense, 5).order == order


def family(ring: Parameters) -> Rosenbrock:
    """Two stages, with γ and γ_21 free of each other but for order 2."""
    g, zero = ring.parameter("g"), fmpq(0)
    low = (fmpq(1, 2) - g) / fmpq(3, 4) - fmpq(2, 3)
    return rosenbrock(
        ((zero, zero), (fmpq(2, 3), zero)), ((g, zero), (low, g)), (fmpq(1, 4), fmpq(3, 4))
    )


def test_free_parameter() -> None:
    """Two stages have order 3 for γ² − γ + 1/6 = 0 alone: γ = 1/2 ± √3/6 (Hairer and Wanner). With
    any matrix order 2 is left for γ = 0 and the γ_21 that belongs to it at most.
    """
    ring = Parameters(["g"])
    (g,) = ring.context.gens()
    tableau = family(ring).tableau
    made_of = FamilyConditions(tableau, ring)
    found = [[x.polynomial for x in made_of.of_order(n) if x.polynomial] for n in (1, 2, 3, 4)]
    assert found[:2] == [[], []]
    (third,) = found[2]
    assert third / third.leading_coefficient() == g**2 - g + fmpq(1, 6)
    assert found[3]
    # the search sees the same, tree by tree
    for which, of in TABLEAUS.items():
        residuals = Residuals(of(family(ring)), ring, 4)
        point = fmpq(1, 3)
        values, _ = residuals.at(np.array([[1 / 3]]))
        at = of(replace(family(ring), gamma=(((numbers_at(point)),),)))
        for order in range(1, 5):
            for u in residuals.table.ids(order):
                tree = residuals.table.tree(u)
                (x,) = conditions(at, [tree])
                scale = fmpq(tree.density, tree.kind.integrated(order))
                exact = float(numbers(x.residual * scale))
                assert values[u, 0] == pytest.approx(exact, abs=1e-14), which


def numbers_at(g: fmpq) -> Any:
    low = (fmpq(1, 2) - g) / fmpq(3, 4) - fmpq(2, 3)
    return ((g, fmpq(0)), (low, g))


def test_what_is_for_gark_methods_says_so() -> None:
    """Conjugate, pair, simplifying conditions, compositions, steps of W-methods, files and
    stability functions are refused.
    """
    tableau = RODAS3.tableau
    pendulum = hamiltonian("pendulum", 1)
    refusing: list[Callable[[], object]] = [
        lambda: conjugate(tableau),
        lambda: pair(tableau),
        lambda: with_time(tableau),
        lambda: is_symplectic(tableau),
        lambda: in_turn([Substep(tableau, fmpq(1))]),
        lambda: adjoint(tableau),
        lambda: modified_equation(tableau, 3),
        lambda: write_method(tableau, "RODAS3", None),
        lambda: stability_fraction(tableau),
        lambda: usual_oscillator(tableau),
        lambda: usual_oscillator(RODAS3.with_any_matrix),
        lambda: bind(RODAS3.on_dae, pendulum),
    ]
    for call in refusing:
        with pytest.raises(MethodError, match="for GARK methods, which this method is not"):
            call()


def test_wrong_shapes() -> None:
    """Matrices of other sizes than b, and a zero on the diagonal of γ, are refused."""
    zero = fmpq(0)
    with pytest.raises(MethodError, match="gamma is not 1 by 1"):
        rosenbrock(((zero,),), ((zero, zero),), (fmpq(1),))
    with pytest.raises(MethodError, match="diagonal entry of gamma is 0"):
        transformed(((zero,),), ((zero,),), (zero,), (fmpq(1),))
