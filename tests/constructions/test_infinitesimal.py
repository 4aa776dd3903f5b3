"""Multirate methods with the exact fast solution: collocation and spans against power series that
know neither trees nor gark.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from random import Random

import pytest
from flint import fmpq

from garkcli import loads
from garkcli.constructions.infinitesimal import (
    CollocationPlan,
    Coupling,
    following,
    generalized,
    highest,
    infinitesimal,
    of_step_time,
    plan_for_flow,
    restarted,
)
from garkcli.frozen import replace
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import find_order
from garkcli.order.conditions import all_conditions
from garkcli.tableau.tableau import Tableau
from tests.oracles import multirate_series as series
from tests.oracles.brute import brute_order
from tests.whole import at_most

LIMIT = 4


def rows(text: str, columns: int) -> list[list[Fraction]]:
    """A matrix, written in rows; what is left out at the right is zero."""
    found = [[Fraction(x) for x in row.split()] for row in text.split(";")]
    return [row + [Fraction(0)] * (columns - len(row)) for row in found]


def row(text: str) -> list[Fraction]:
    return [Fraction(x) for x in text.split()]


def method(kind: series.Kind, c: str, *forcing: Sequence[str], **more: str) -> series.Method:
    """A method, its matrices written in rows."""
    nodes = row(c)
    powers = [[rows(x, len(nodes)) for x in part] for part in forcing]
    others = {key: rows(text, len(nodes)) for key, text in more.items()}
    return series.Method(kind, nodes, powers, **others)


PUBLISHED = {
    "MIS-KW3": (3, method("mri", "0 1/3 3/4 1", ["1/3; -25/48 15/16; 17/48 -51/80 8/15"])),
    "MRI-GARK-ERK22a": (2, method("mri", "0 1/2 1", ["1/2; -1/2 1"])),
    "MRI-GARK-ERK33a": (
        3,
        method("mri", "0 1/3 2/3 1", ["1/3; -1/3 2/3; 0 -2/3 1", "0; 0 0; 1/2 0 -1/2"]),
    ),
    "MRI-GARK-IRK21a": (2, method("mri", "0 1 1", ["1; -1/2 0 1/2"])),
    "IMEX-MRI-GARK, trapezoidal": (
        2,
        method("mri", "0 1 1 1", ["1; 0; -1/2 0 1/2"], ["1; -1/2 0 1/2; 0"]),
    ),
    "MERK21": (2, method("merk", "0 1/2 1", ["1; 1", "0; -2 2"])),
    "MERK32": (3, method("merk", "0 1/2 2/3 1", ["1; 1; 1", "0; -2 2; -3/2 0 3/2"])),
    "IMEX-MRI-SR21": (
        2,
        method(
            "sr",
            "0 3/5 4/15 1",
            ["3/5; 14/165 2/11; -13/54 137/270 11/15"],
            ["3/5; 14/165 2/11; -13/54 137/270 11/15"],
            gamma="-11/23 11/23; -6692/52371 -18355/52371 11/23;"
            " 11621/90666 -215249/226665 17287/50370 11/23",
        ),
    ),
    "an MIS with α": (2, method("mis", "0 1/2 1", ["1/2; -1/2 1"], alpha="0; 0 1", gamma="0; 0 0")),
}
"""With their orders in the papers."""


def engine(matrix: series.Matrix) -> tuple[tuple[fmpq, ...], ...]:
    return tuple(tuple(fmpq(x.numerator, x.denominator) for x in r) for r in matrix)


def coupling(m: series.Method) -> Coupling:
    """The method as gark has it."""
    [c] = engine([m.c])
    forcing = tuple(tuple(map(engine, powers)) for powers in m.forcing)
    if m.kind == "mri":
        return following(c, forcing)
    if m.kind == "merk":
        return restarted(c, (of_step_time(c[1:], forcing[0]),))
    if m.kind == "sr":
        return restarted(c, forcing, None, engine(m.gamma))
    return generalized(engine(m.alpha), forcing[0][0], engine(m.gamma))


def tableau(m: series.Method) -> Tableau:
    found = coupling(m)
    return infinitesimal(found, plan_for_flow(found))[0]


def changed(m: series.Method, dice: Random) -> series.Method:
    """The method with one or two of its coefficients changed, most often so that the sum of the row
    stays.
    """

    def with_change(matrix: series.Matrix, i: int) -> list[list[Fraction]]:
        made = [list(r) for r in matrix]
        seen = range(i + 1)
        j, k = dice.choice(seen), dice.choice(seen)
        shift = Fraction(dice.randint(-3, 3), dice.randint(1, 4))
        made[i][j] += shift
        if dice.random() < 0.8:
            made[i][k] -= shift
        return made

    part = dice.randrange(len(m.forcing))
    power = dice.randrange(len(m.forcing[part]))
    i = dice.randrange(len(m.c) - 1)
    forcing = [list(powers) for powers in m.forcing]
    forcing[part][power] = with_change(forcing[part][power], i)
    gamma = with_change(m.gamma, i) if m.gamma and dice.random() < 0.5 else m.gamma
    if m.kind == "sr":
        forcing = [forcing[0]] * len(forcing)
    if m.kind == "mis":  # the nodes are what α, β and γ make them
        m = series.Method("mis", m.c, forcing, m.alpha, gamma)
        [nodes] = [coupling(m).nodes]
        return series.Method(
            "mis", [Fraction(int(x.p), int(x.q)) for x in nodes], forcing, m.alpha, gamma
        )
    return series.Method(m.kind, m.c, forcing, m.alpha, gamma)


@pytest.mark.parametrize("name", PUBLISHED)
def test_published(name: str) -> None:
    """The order by the spans is that of the paper, and of the power series; one more fails."""
    order, m = PUBLISHED[name]
    assert find_order(tableau(m)).order == order
    assert series.order(m, order + 1) == order


@pytest.mark.parametrize("name", PUBLISHED)
def test_changed_methods(name: str) -> None:
    """Methods with other coefficients have the order that the power series have, as far as these
    look; every kind loses its order and keeps it.
    """
    dice = Random(name)
    order, m = PUBLISHED[name]
    found: Counter[bool] = Counter()
    for _ in range(4):
        other = changed(m, dice)
        looked = min(order + 1, LIMIT)
        by_spans = find_order(tableau(other), looked).order
        assert by_spans == series.order(other, looked), other
        found[by_spans == order] += 1
    assert found[False]


def test_all_trees_agree() -> None:
    """The conditions of all trees, one by one, say the same as the spans."""
    for name in ("MRI-GARK-ERK22a", "MERK21", "an MIS with α"):
        order, m = PUBLISHED[name]
        assert brute_order(tableau(m), order + 1) == order


def test_collocation_has_enough_nodes_and_no_more() -> None:
    """Up to the order that the plan names every elementary weight is that of finer collocation;
    with a node less in each fast problem some are not.
    """
    found = coupling(method("mri", "0 1", ["0", "2"]))
    plan = plan_for_flow(found)
    assert (plan.fast, plan.order) == ((3,), 2)

    def weights(shift: int) -> list[object]:
        other = CollocationPlan(tuple(n + shift for n in plan.fast), plan.stages, plan.order)
        made, _ = infinitesimal(found, other)
        return [elementary_weight(made, c.tree) for c in all_conditions(made, 2)]

    assert weights(0) == weights(2)
    assert weights(0) != weights(-1)


@pytest.mark.parametrize("name", PUBLISHED)
def test_no_method_exceeds_its_bound(name: str) -> None:
    """The bound by which collocation is chosen is no smaller than the order."""
    order, m = PUBLISHED[name]
    assert highest(coupling(m)) >= order


def predictor(A: str, *gamma: str) -> series.Method:
    """A step-predictor: the slow method, and the forcing of its slopes for each power of τ."""
    A_rows = rows(A, len(A.split(";")))
    s = len(A_rows)
    nothing: series.Row = []
    forcing = [[nothing] * (s - 1) + [row(text)] for text in gamma]
    c = [*map(sum, A_rows), Fraction(1)]
    return series.Method("predictor", c, [forcing], A_rows)


PREDICTORS = {
    "kutta, interpolated": (3, predictor("0;1/2;-1 2", "1 0 0", "-3 4 -1", "2 -4 2")),
    "kutta": (3, predictor("0;1/2;-1 2", "2/3 2/3 -1/3", "-1 0 1")),
    "rk4": (4, predictor("0;1/2;0 1/2;0 0 1", "2/3 1/3 1/3 -1/3", "-1 0 0 1")),
    "implicit midpoint": (2, predictor("1/2", "1")),
    "radau-iia": (3, predictor("5/12 -1/12; 3/4 1/4", "3/2 -1/2", "-3/2 3/2")),
    "lobatto-iiic": (2, predictor("1/2 -1/2; 1/2 1/2", "1 0", "-1 1")),
}
"""With their orders: the conditions are linear in the forcing, and solved by hand."""


def changed_predictor(m: series.Method, dice: Random) -> series.Method:
    """The method with one to three of its coefficients changed, or none: of the forcing so that
    the integral or the sum of a row stays, or not; or of A.
    """
    forcing = [[list(r) for r in matrix] for matrix in m.forcing[0]]
    A = [list(r) for r in m.alpha]
    s = len(A)
    for _ in range(dice.randrange(4)):
        shift = Fraction(dice.choice([-2, -1, 1, 2]), dice.randint(1, 4))
        i, j = dice.randrange(s), dice.randrange(s)
        k = dice.randrange(len(forcing))
        match dice.randrange(4):
            case 0:
                A[i][j] += shift
            case 1:
                forcing[k][-1][i] += shift
            case 2:
                forcing[k][-1][i] += shift
                forcing[k][-1][j] -= shift
            case 3:  # the integral stays
                forcing[k][-1][i] += shift * (k + 1)
                forcing[0][-1][i] -= shift
    return series.Method("predictor", [*map(sum, A), Fraction(1)], [forcing], A)


def predictor_tableau(m: series.Method) -> Tableau:
    """The method as gark has it, read from a file."""

    def text(matrix: series.Matrix) -> str:
        return "[" + ", ".join("[" + ", ".join(map(str, r)) + "]" for r in matrix) + "]"

    gamma = [matrix[-1] for matrix in m.forcing[0]]
    weights = [
        sum((r[j] / (k + 1) for k, r in enumerate(gamma)), Fraction(0)) for j in range(len(m.alpha))
    ]
    slow = f"{{A: {text(m.alpha)}, b: [{', '.join(map(str, weights))}]}}"
    return loads(
        f"multirate: {{slow: {slow}, fast: exact, coupling: {{gamma: {text(gamma)}}}}}"
    ).tableau


@pytest.mark.parametrize("name", PREDICTORS)
def test_step_predictors(name: str) -> None:
    """The order by the spans is that of the power series; one more fails."""
    order, m = PREDICTORS[name]
    assert find_order(predictor_tableau(m)).order == order
    assert series.order(m, order + 1) == order


def test_random_step_predictors_three_ways() -> None:
    """Spans, all trees and power series find one order; all up to 3 occur."""
    found: Counter[int] = Counter()
    limit = 3
    for seed in range(at_most(40, 250)):
        dice = Random(seed)
        _, m = dice.choice([*PREDICTORS.values()])
        m = changed_predictor(m, dice)
        made = predictor_tableau(m)
        order = find_order(made, limit).order
        assert order == series.order(m, limit, seed) == brute_order(made, limit), m
        found[order] += 1
    assert {0, 1, 2, 3} <= found.keys()


def test_interpolation_is_a_forcing() -> None:
    """``slow`` with ``fast: exact`` and no coupling interpolates the slopes."""
    interpolated = loads("multirate: {slow: kutta, fast: exact}").tableau
    assert interpolated == predictor_tableau(PREDICTORS["kutta, interpolated"][1])


def test_small_steps_of_a_predictor() -> None:
    """With small steps of a method the order is at most that of this method; small steps of
    Gauss's method with 2 stages see polynomials of degree 1 exactly.
    """
    text = (
        "multirate: {slow: rk4, fast: %s, coupling: {gamma: [[2/3, 1/3, 1/3, -1/3], [-1, 0, 0, 1]],"
        " embedded: [[1/6, 1/3, 1/3, 1/6]]}, steps: 3}"
    )
    assert find_order(loads(text % "kutta").tableau).order == 3
    found = loads(text % "{family: gauss, stages: 2}")
    assert find_order(found.tableau).order == 4
    assert found.embedded is not None
    colours = zip(found.tableau.colours, found.embedded, strict=True)
    other = replace(found.tableau, colours=tuple(replace(x, b=b) for x, b in colours))
    assert find_order(other).order == 2


def test_embedded_value_is_a_method() -> None:
    """The embedded weights have the order of the method whose last row is the embedded one."""
    text = (
        "multirate: {mri: {c: [0, 1/3, 2/3, 1], gamma: [[[1/3], [-1/3, 2/3], [0, -2/3, 1]],"
        " [[0], [0, 0], [1/2, 0, -1/2]]], embedded: [[1/12, -1/3, 7/12]]}, fast: exact}"
    )
    found = loads(text)
    assert found.embedded is not None
    with_them = [
        replace(x, b=b) for x, b in zip(found.tableau.colours, found.embedded, strict=True)
    ]
    other = method("mri", "0 1/3 2/3 1", ["1/3; -1/3 2/3; 1/12 -1/3 7/12", "0; 0; 0"])
    by_spans = find_order(replace(found.tableau, colours=tuple(with_them))).order
    assert by_spans == find_order(tableau(other)).order == series.order(other, 3) == 2
