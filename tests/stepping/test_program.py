"""The step as a program: what it costs and that it is the same for floats and balls."""

from __future__ import annotations

import ast

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.families.registry import diagonal_method
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.problems.vectorfield import GROUPS, symbols
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import Stepper, bind, integrate, trajectory
from garkcli.tableau.forms import gark, pair, separable_prk, symplectic_pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.whole import at_most

GAUSS, LOBATTO = (diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3))
COUPLED = gark(
    [GAUSS, LOBATTO], {(0, 1): collocation(GAUSS, LOBATTO), (1, 0): collocation(LOBATTO, GAUSS)}
)
RECTANGULAR = symplectic_pair(COUPLED, [0], [1])
RK4 = gark([diagonal_method("rk4")], {})
METHODS = [
    (RECTANGULAR, "pendulum"),
    (RECTANGULAR, "kepler"),
    (pair(COUPLED), "generic"),
    (pair(COUPLED), "henon-heiles"),
    (RK4, "generic"),
    (gark([LOBATTO], {}), "fput"),
]


def composition(parts: int) -> Tableau:
    """Leapfrog steps one after the other, as one separable method of ``parts`` stages each."""
    b = [fmpq(k % 3 + 1, 2 * parts) for k in range(parts)]
    b = [x / sum(b, fmpq(0)) for x in b]
    half = [(b[0] if k == 0 else b[k - 1] + b[k]) / 2 for k in range(parts)] + [b[-1] / 2]
    Q = [[b[j] if j < i else fmpq(0) for j in range(parts)] for i in range(parts + 1)]
    P = [[half[j] if j <= i else fmpq(0) for j in range(parts + 1)] for i in range(parts)]
    rows = [tuple(tuple(row) for row in A) for A in (Q, P)]
    return separable_prk((rows[0], tuple(b), None), (rows[1], tuple(half), None))


@pytest.mark.parametrize(("tableau", "name"), METHODS)
def test_many_steps_are_single_steps(tableau: Tableau, name: str) -> None:
    """Running on, stopping at each step, and stopping at every third give the same numbers to the
    last bit.
    """
    made = bind(
        with_joined_terms(tableau), hamiltonian(name, terms_of(with_joined_terms(tableau)))
    ).at()
    singly = list(trajectory(made, fmpq(1, 20), 10))
    assert len(singly) == 11
    assert integrate(made, fmpq(1, 20), 10) == singly[-1]
    assert list(trajectory(made, fmpq(1, 20), 10, every=3)) == [singly[k] for k in (0, 3, 6, 9, 10)]
    state = Stepper(made, fmpq(1, 20))
    for k in range(11):
        assert state.y == singly[k]
        state.advance(1)


@pytest.mark.parametrize(("tableau", "name"), METHODS)
def test_balls_take_the_same_path(tableau: Tableau, name: str) -> None:
    """The same structure and coefficients for 15 and for 50 digits, and the same numbers to
    round-off.
    """
    problem = hamiltonian(name, terms_of(with_joined_terms(tableau)))
    few, many = (
        bind(with_joined_terms(tableau), problem).at(),
        bind(with_joined_terms(tableau), problem).at(50),
    )
    assert few.program.coefficients == many.program.coefficients
    assert few.program.implicit == many.program.implicit
    ends = [[float(x) for x in integrate(made, fmpq(1, 20), 10)] for made in (few, many)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-14)


@pytest.mark.parametrize("digits", [15, 40])
@pytest.mark.parametrize(("tableau", "name"), METHODS)
def test_jacobian_in_matrices_is_that_written_out(
    monkeypatch: pytest.MonkeyPatch, tableau: Tableau, name: str, digits: int
) -> None:
    """The same steps, in as many iterations, whichever way the chain rule is done."""
    problem = hamiltonian(name, terms_of(with_joined_terms(tableau)))
    monkeypatch.setattr("garkcli.stepping.newton._DIRECT", 0)
    states = []
    for written in (0, 1000):
        monkeypatch.setattr("garkcli.stepping.newton._WRITTEN", written)
        made = bind(with_joined_terms(tableau), problem).at(digits)
        assert bool(made.program.chains) == (written == 0 and bool(made.program.implicit))
        states.append(Stepper(made, fmpq(1, 20)))
        states[-1].advance(10)
    assert [float(x) for x in states[0].y] == pytest.approx(
        [float(x) for x in states[1].y], abs=1e-15
    )
    assert states[0].work == states[1].work


def test_cyclic_variable_has_balls_too() -> None:
    """An unknown whose field is zero starts as a ball: H = p²/(2 + cos x) + P²/2·(2 + sin x), P
    constant.
    """
    (x, _), (px, py) = (symbols(("x", "y"), group) for group in GROUPS)
    terms = (px**2 / (2 + sympy.cos(x)), py**2 * (2 + sympy.sin(x)) / 2)
    problem = Hamiltonian(
        "cyclic", ("x", "y"), terms, (fmpq(1), fmpq(0), fmpq(1, 2), fmpq(1)), fmpq(1)
    )
    ends = [
        integrate(bind(pair(COUPLED), problem).at(digits), fmpq(1, 10), 5) for digits in (15, 40)
    ]
    assert [float(a) for a in ends[1]] == pytest.approx(ends[0], abs=1e-14)
    assert ends[1][3] == 1


@settings(max_examples=at_most(8, 20), deadline=None)
@given(st.integers(1, 12))
def test_compositions_cost_what_their_steps_cost(parts: int) -> None:
    """Several leapfrog steps in one method: the same numbers as one after the other, and a text of
    length O(n).
    """
    problem = hamiltonian("kepler", 2)
    made = bind(composition(parts), problem).at()
    assert not made.program.implicit
    assert made.program.evaluations == 2 * parts + 1
    products = made.program.source.count("w")
    assert products < 40 * parts + 40
    if parts > 1:
        y = [_number(x) for x in problem.initial]
        for b in composition(parts).colours[0].b:
            y = _leapfrog(y, _number(b) / 10)
        assert integrate(made, fmpq(1, 10), 1) == pytest.approx(y, abs=1e-14)


def _number(x: object) -> float:
    return int(x.p) / int(x.q)  # type: ignore[attr-defined]


def _leapfrog(y: list[float], h: float) -> list[float]:
    q, p = y[:2], y[2:]
    for k in (0, 1):
        r3 = (q[0] ** 2 + q[1] ** 2) ** 1.5
        p = [a - h / 2 * x / r3 for a, x in zip(p, q, strict=True)]
        if k == 0:
            q = [x + h * a for x, a in zip(q, p, strict=True)]
    return [*q, *p]


def test_work_is_counted() -> None:
    """rk4: four evaluations a step. The rectangular method: what is repeated in each iteration, and
    the rest.
    """
    state = Stepper(bind(RK4, hamiltonian("generic", 1)).at(), fmpq(1, 10))
    state.advance(7)
    assert (state.work.evaluations, state.work.iterations, state.work.jacobians) == (
        7 * 4 * 2,
        0,
        0,
    )  # V and F
    state = Stepper(bind(RECTANGULAR, hamiltonian("pendulum", 2)).at(), fmpq(1, 10))
    state.advance(10)
    program, work = state.integrator.program, state.work
    assert (program.evaluations, program.repeated) == (
        2 + 1,
        (3,),
    )  # F at both ends, V frozen; V twice and F
    assert work.evaluations == 10 * 3 + 3 * work.iterations
    assert 20 <= work.iterations <= 40
    assert work.jacobians == work.iterations - 10  # the last of each step needs none


@pytest.mark.parametrize(("tableau", "name"), METHODS)
def test_text_has_names_of_ours_only(tableau: Tableau, name: str) -> None:
    """Every name in the text is one that the writer or the namespace defines: none of the
    problem's.
    """
    problem = hamiltonian(name, terms_of(with_joined_terms(tableau)))
    tree = ast.parse(bind(with_joined_terms(tableau), problem).at().program.source)
    stored = {
        x.id for x in ast.walk(tree) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)
    }
    loaded = {
        x.id for x in ast.walk(tree) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Load)
    }
    known = {
        "abs",
        "range",
        "float",
        "inf",
        "nan",
        "isfinite",
        "precision",
        "iterations",
        "NotSolved",
        "inverted",
        "corrections",
        "chain0",
    }
    known |= {
        "list",
        "sin",
        "cos",
        "sqrt",
        "ArithmeticError",
        "ValueError",
        "state",
        "w",
        "first",
        "count",
        "record",
    }
    assert loaded - stored <= known
    assert not [x for x in ast.walk(tree) if isinstance(x, ast.Attribute | ast.Import)]


def test_a_thousand_digits_from_the_first_step() -> None:
    """Newton's method with Jacobians of floats reaches 1000 digits, a dozen or so an iteration: the
    same number as with 1040, for one unknown and for several.
    """
    for stages in (1, 3):
        tableau = gark([diagonal_method("gauss", stages)], {})
        bound = bind(tableau, hamiltonian("pendulum", 1))
        with ctx.workprec(3500):
            few, many = (integrate(bound.at(digits), fmpq(1, 10), 1) for digits in (1000, 1040))
            for x, y in zip(few, many, strict=True):
                assert abs(x - y) < arb(10) ** -995


def test_one_text_serves_all_digits() -> None:
    """What is bound once is written once for floats and once for balls; the numbers differ."""
    bound = bind(RECTANGULAR, hamiltonian("pendulum", 2))
    assert bound.at().program is bound.at(15).program
    assert bound.at(30).program is bound.at(60).program
    assert bound.at(30).bits < bound.at(60).bits
