"""Steps on right-hand sides: against the formulas of textbooks, written out by hand."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx, fmpq

from garkcli import converge, integrate, loads
from garkcli.errors import UsageProblem
from garkcli.problems.builtin import problem
from garkcli.problems.files.load import loads_problem
from garkcli.problems.problem import Problem
from garkcli.stepping.integrator import bind
from garkcli.tableau.tableau import Tableau

PENDULUM = """
variables: [x, v]
rhs: {x: v, v: cos(t) - sin(x)*v**2}
initial: {x: 1/2, v: 1/4}
"""
SPLIT = """
variables: [y]
rhs: [sin(t) - y**2, -3*(y - exp(-t))]
initial: {y: 2}
"""


def rk4() -> Tableau:
    """The classical method."""
    return loads("methods: [{family: rk4}]").tableau


def test_rk4_with_time() -> None:
    """Two unknowns and t, four stages at t, t + h/2, t + h/2 and t + h: by hand."""

    def f(t: float, x: float, v: float) -> tuple[float, float]:
        return v, math.cos(t) - math.sin(x) * v**2

    x, v, h = 0.5, 0.25, 0.125
    for n in range(4):
        t = n * h
        k1 = f(t, x, v)
        k2 = f(t + h / 2, x + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = f(t + h / 2, x + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = f(t + h, x + h * k3[0], v + h * k3[1])
        sums = [a + 2 * b + 2 * c + d for a, b, c, d in zip(k1, k2, k3, k4, strict=True)]
        x, v = x + h / 6 * sums[0], v + h / 6 * sums[1]
    found = integrate(bind(rk4(), loads_problem(PENDULUM)).at(), fmpq(1, 8), 4)
    assert found == pytest.approx([x, v], rel=1e-14)


def test_an_imex_method_with_time() -> None:
    """Explicit midpoint with the implicit one, one term each: the implicit stage is linear and is
    solved by hand.
    """
    imex = loads("ark: {A: [[[0, 0], [1/2, 0]], [[0, 0], [0, 1/2]]], b: [[0, 1], [0, 1]]}").tableau
    y, h = 2.0, 0.125
    for n in range(4):
        t = n * h
        middle = t + h / 2
        explicit = math.sin(t) - y**2
        # Y = y + h/2 explicit - 3 h/2 (Y - exp(-middle))
        right = y + h / 2 * explicit + 1.5 * h * math.exp(-middle)
        Y = right / (1 + 1.5 * h)
        y += h * (math.sin(middle) - Y**2 - 3 * (Y - math.exp(-middle)))
    found = integrate(bind(imex, loads_problem(SPLIT)).at(), fmpq(1, 8), 4)
    assert found == pytest.approx([y], rel=1e-13)


@pytest.mark.parametrize("family", ["rk4", "gauss", "lobatto-iiia"])
@pytest.mark.parametrize(
    "solved", [loads_problem(PENDULUM), problem("van-der-pol", 1)], ids=["t", "no t"]
)
def test_balls_and_floats(family: str, solved: Problem) -> None:
    """The two programs of one method differ by round-off."""
    stages = 4 if family == "rk4" else 3
    made = loads(f"methods: [{{family: {family}, stages: {stages}}}]").tableau
    bound = bind(made, solved)
    floats = integrate(bound.at(), fmpq(1, 8), 4)
    with ctx.workprec(200):
        balls = [float(arb(x)) for x in integrate(bound.at(40), fmpq(1, 8), 4)]
    assert floats == pytest.approx(balls, rel=1e-13)


def test_nodes_are_those_of_the_tableau() -> None:
    """The implicit midpoint rule whose node is printed as 0 has order 1 on a problem with t, and
    order 2 on one without; the visible order says so.
    """
    midpoint = loads("methods: [{A: [[1/2]], b: [1], c: [0]}]").tableau
    with_time = converge(midpoint, loads_problem(PENDULUM))
    assert with_time.visible_order == 2 - 1
    assert with_time.observed_order == pytest.approx(1, abs=0.05)
    without = converge(midpoint, problem("van-der-pol", 1))
    assert without.visible_order == 2
    assert without.observed_order == pytest.approx(2, abs=0.05)


def test_time_as_an_unknown_is_the_same() -> None:
    """Where row sums are the nodes of all blocks: t, and an unknown with the derivative 1 in either
    colour, end at the same state.
    """
    ars = loads(
        "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [1/2, 1/2]]], b: [[1/2, 1/2], [1/2, 1/2]]}"
    ).tableau
    ends = [integrate(bind(ars, loads_problem(SPLIT)).at(), fmpq(1, 8), 8)[0]]
    for first, second in (("1", "0"), ("0", "1")):
        text = (
            "variables: [y, s]\n"
            f"rhs: [{{y: sin(s) - y**2, s: {first}}}, {{y: -3*(y - exp(-s)), s: {second}}}]\n"
            "initial: {y: 2, s: 0}\n"
        )
        bound = bind(ars, loads_problem(text))
        ends.append(integrate(bound.at(), fmpq(1, 8), 8)[0])
    assert ends == pytest.approx([ends[0]] * 3, rel=1e-14)


@pytest.mark.parametrize(
    ("method", "message"),
    [
        ("prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1]}}", "drives positions and momenta"),
        (
            "tableau: {A: [[[[0]], [[0]]], [[[1]], [[1]]]], b: [[1], [1]]}\nlinear: [2]",
            "the stages of the method have no times",
        ),
    ],
)
def test_what_is_refused(method: str, message: str) -> None:
    """Methods for momenta, and a colour that is linear: it has no time in it."""
    with pytest.raises(UsageProblem, match=message):
        bind(loads(method).tableau, loads_problem(SPLIT))


def test_numbers_of_terms_have_to_agree() -> None:
    """Right-hand sides have no natural split; one colour gets their sum."""
    three = loads_problem(SPLIT.replace("rhs: [", "rhs: [y, "))
    two = loads(
        "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 3}]\ntransfer: collocation"
    )
    with pytest.raises(UsageProblem, match="has 3 terms, the method is for 2"):
        bind(two.tableau, three)
    alone = bind(rk4(), three).problem
    assert len(alone.terms) == 1
