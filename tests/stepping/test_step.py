"""One step, its structure and its failures."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy
from flint import arb, ctx, fmpq

from garkcli.convergence.convergence import converge
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.graph import components
from garkcli.longtime.longtime import long_run
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian, vector_field
from garkcli.problems.oscillator import terms_of
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import GROUPS, symbols
from garkcli.stepping.dependency import Stage
from garkcli.stepping.fields import fields_of, visible_trees, with_joined_terms
from garkcli.stepping.integrator import StepFailed, bind, integrate, trajectory
from garkcli.tableau.forms import gark, pair, separable_prk, symplectic_pair, with_linear
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation, interpolation

H = fmpq(1, 10)


def coupled(s: int, t: int, rule: Any = collocation) -> Tableau:
    """Gauss s × Lobatto IIIA t."""
    one, other = (diagonal_method("gauss", s), diagonal_method("lobatto-iiia", t))
    return gark([one, other], {(0, 1): rule(one, other), (1, 0): rule(other, one)})


RECTANGULAR = symplectic_pair(coupled(2, 3), [0], [1])
SEMI = symplectic_pair(coupled(2, 3), [0], [0, 1])
RK4 = gark([diagonal_method("rk4")], {})
HEUN = gark([diagonal_method("heun"), diagonal_method("heun")], {(0, 1): diagonal_method("heun").A})


def plain_step(tableau: Tableau, problem: Hamiltonian, h: float) -> list[float]:
    """Every stage of every colour by fixed-point iteration, with no thought for structure."""
    entries, d = numeric_entries(tableau), problem.dimension
    A = {
        (l, m): np.array([[float(x) for x in row] for row in block])
        for l, blocks in enumerate(entries.A)
        for m, block in enumerate(blocks)
        if block is not None
    }
    b = [np.array([float(x) for x in row]) for row in entries.b]
    y0 = np.array([float(x.p) / float(x.q) for x in problem.initial])

    @cache
    def function(m: int, group: str) -> Any:
        """The gradient of a colour's term, its arguments being the groups it depends on."""
        f = vector_field(problem, tableau.colours[m].term, group)  # type: ignore[arg-type]
        made = sympy.lambdify(f.arguments, list(f.components), modules="math")
        return None if f.is_zero else (f.depends, made)

    def field(m: int, y: Any) -> Any:
        out, groups = np.zeros(2 * d), {"q": y[:d], "p": y[d:]}
        for group, part, offset in (("q", "yq", 0), ("p", "yp", d)):
            made = function(m, group) if tableau.colours[m].part in part else None
            if made is not None:
                depends, gradient = made
                arguments = [x for g in depends for x in groups[g]]
                out[offset : offset + d] = gradient(*arguments)
        return out

    F = [np.array([field(m, y0)] * len(b[m])) for m in range(tableau.size)]
    for _ in range(80):
        Y = [
            y0 + h * sum(A[l, m] @ F[m] for m in range(tableau.size) if (l, m) in A)
            for l in range(tableau.size)
        ]
        F = [
            np.array([field(m, y) for y in Y[m] + np.zeros((len(b[m]), 2 * d))])
            for m in range(tableau.size)
        ]
    return (y0 + h * sum(b[m] @ F[m] for m in range(tableau.size))).tolist()


@pytest.mark.parametrize(
    ("tableau", "name"),
    [
        (pair(coupled(2, 3)), "generic"),
        (pair(coupled(2, 3, interpolation)), "kepler"),
        (coupled(2, 3), "generic"),
        (gark([diagonal_method("radau-iia", 2)], {}), "generic"),
        (RECTANGULAR, "kepler"),
        (RECTANGULAR, "pendulum"),
        (SEMI, "fput"),
        (RK4, "henon-heiles"),
        (with_linear(RECTANGULAR, ["V1"]), "henon-heiles"),
    ],
)
def test_step_is_that_of_a_plain_iteration(tableau: Tableau, name: str) -> None:
    """General, GARK, separable, rectangular, semi-separable, explicit and Nyström: the same step to
    round-off.
    """
    problem = hamiltonian(name, terms_of(tableau))
    expected = plain_step(tableau, problem, 0.1)
    assert integrate(bind(tableau, problem).at(), H, 1) == pytest.approx(expected, abs=3e-15)
    many = [float(x) for x in integrate(bind(tableau, problem).at(40), H, 1)]
    assert many == pytest.approx(expected, abs=3e-15)


def test_digits_are_correct() -> None:
    """30, 60 and 120 digits agree to the digits of the shorter."""
    problem = hamiltonian("kepler", 2)
    ends = {
        digits: integrate(bind(RECTANGULAR, problem).at(digits), H, 5) for digits in (30, 60, 120)
    }
    with ctx.workprec(420):
        for short, long in ((30, 60), (60, 120)):
            assert max(abs(a - b) for a, b in zip(ends[short], ends[long], strict=True)) < arb(
                10
            ) ** (1 - short)


def unknowns(tableau: Tableau, name: str) -> list[tuple[Stage, ...]]:
    """The unknowns of each implicit block."""
    made = bind(
        with_joined_terms(tableau), hamiltonian(name, terms_of(with_joined_terms(tableau)))
    ).at()
    return [block.unknowns for block in made.program.implicit]


def test_rectangular_method_has_one_implicit_stage() -> None:
    """The positions of the middle Lobatto stage: nothing else is solved for."""
    assert unknowns(RECTANGULAR, "pendulum") == [(Stage(1, 1, "q"),)]


def test_explicit_and_diagonally_implicit_are_found() -> None:
    """Nothing to solve in rk4 and Störmer–Verlet; one stage after the other in a diagonally
    implicit method.
    """
    verlet = separable_prk(
        (((fmpq(0),), (fmpq(1),)), (fmpq(1),), None),
        (((fmpq(1, 2), fmpq(0)),), (fmpq(1, 2),) * 2, None),
    )
    assert unknowns(RK4, "kepler") == unknowns(verlet, "kepler") == []
    third = fmpq(1, 3)
    A = ((third, fmpq(0)), (third, third))
    dirk = gark([diagonal_method("heun")], {})
    dirk = Tableau(dirk.spaces, dirk.colours, {(0, 0): A})
    assert [len(block) for block in unknowns(dirk, "generic")] == [2, 2]  # q and p of a stage


def test_components_come_in_order() -> None:
    """Two cycles and a vertex: each after what it needs, and a long path without recursion."""
    graph = {1: [2], 2: [1, 3], 3: [4], 4: [5], 5: [4]}
    assert [sorted(x) for x in components(graph)] == [[1, 2], [3], [4, 5]]
    assert len(components({k: [k + 1] for k in range(5000)} | {5000: []})) == 5001


@pytest.mark.parametrize("tableau", [pair(coupled(2, 3)), pair(coupled(3, 4, interpolation))])
def test_pair_is_symplectic(tableau: Tableau) -> None:
    """Central differences with 60 digits: ‖MᵀJM − J‖ is their error, where the GARK method's is not
    small.
    """
    problem = hamiltonian("generic", 2)
    assert symplecticity(tableau, problem) < 1e-30
    assert symplecticity(coupled(2, 3), problem) > 1e-13


def symplecticity(tableau: Tableau, problem: Hamiltonian) -> float:
    """‖MᵀJM − J‖ in the largest entry, for one step of size ``H``."""
    made, d = bind(tableau, problem).at(60), problem.dimension
    tiny, columns = fmpq(1, 10**20), []
    for j in range(2 * d):
        ends = []
        for sign in (1, -1):
            start = [x + (sign * tiny if i == j else 0) for i, x in enumerate(problem.initial)]
            ends.append(integrate(made, H, 1, start))
        with ctx.workprec(260):
            columns.append([(a - b) / arb(2 * tiny) for a, b in zip(*ends, strict=True)])
    worst = 0.0
    with ctx.workprec(260):
        for i, u in enumerate(columns):
            for j, v in enumerate(columns):
                form = sum((u[k] * v[k + d] - u[k + d] * v[k] for k in range(d)), arb(0))
                worst = max(worst, abs(float(form - (int(j == i + d) - int(i == j + d)))))
    return worst


def test_energy_stays_near_its_start() -> None:
    """The rectangular pendulum over 500 periods' worth of steps: no growth, where rk4 with the same
    step loses.
    """
    swing = hamiltonian("pendulum", 2)

    def errors(tableau: Tableau, problem: Hamiltonian) -> list[float]:
        path = trajectory(bind(tableau, problem).at(), fmpq(1, 2), 4000)
        energy = [p * p / 2 + 1 - math.cos(q) for q, p in path]
        return [abs(x - energy[0]) for x in energy]

    ours, theirs = (errors(RECTANGULAR, swing), errors(RK4, hamiltonian("pendulum", 1)))
    assert max(ours[2000:]) < 1.01 * max(ours[:2000]) < 1e-3
    assert theirs[-1] > 50 * max(ours)


def test_compensated_sums_keep_the_last_digits() -> None:
    """Thirty thousand steps of free flight: a few units of the last digit, where plain sums lose
    four digits.
    """
    (px,) = symbols(("x",), "p")
    free = Hamiltonian("free", ("x",), (px**2 / 2,), (fmpq(0), fmpq(1, 3)), fmpq(1))
    q, _ = integrate(bind(RK4, free).at(), fmpq(1, 10), 30_000)
    assert q == pytest.approx(1000, abs=3e-13)
    plain = 0.0
    for _ in range(30_000):
        plain += 0.1 * (1 / 3)
    assert abs(plain - 1000) > 1e-10


def test_states_before_a_failure_are_seen() -> None:
    """A body that falls into a singularity: every state before the step that fails, the last by
    itself as well.
    """
    x, px = (symbols(("x",), group)[0] for group in GROUPS)
    fall = Hamiltonian("fall", ("x",), (px**2 / 2 - sympy.sqrt(x),), (fmpq(1), fmpq(-2)), fmpq(1))
    made = bind(RK4, fall).at()
    seen: list[list[float]] = []
    with pytest.raises(StepFailed) as caught:
        seen.extend(trajectory(made, H / 10, 200))
    assert len(seen) == caught.value.number > 40
    assert seen[-1] == integrate(made, H / 10, len(seen) - 1)


@pytest.mark.parametrize("mass", [fmpq(1, 10**20), fmpq(10**10), fmpq(10**20)])
@pytest.mark.parametrize("tableau", [RECTANGULAR, pair(coupled(2, 3)), pair(coupled(3, 4))])
def test_units_do_not_matter(tableau: Tableau, mass: fmpq) -> None:
    """A pendulum of any mass in floats: Newton's method ends by the size of its unknowns alone."""
    (x,), (px,) = (symbols(("x",), group) for group in GROUPS)
    m = sympy.Rational(int(mass.p), int(mass.q))
    terms = (px**2 / (2 * m), -m * sympy.cos(x))
    heavy = Hamiltonian("heavy", ("x",), terms, (fmpq(1), mass / 2), fmpq(1))
    floats, exact = (integrate(bind(tableau, heavy).at(digits), H / 2, 40) for digits in (15, 40))
    assert floats == pytest.approx([float(y) for y in exact], rel=2e-15)


def test_balls_around_zero_have_powers() -> None:
    """A ball of a position at zero, where Kepler's field is smooth: no digit is lost."""
    field = vector_field(hamiltonian("kepler", 2), 1, "p")
    x, y = function(field.components, field.arguments, True)(arb(1), arb(0, 1e-12))
    assert abs(x + 1) < 1e-11
    assert abs(y) < 1e-11


def test_failing_step_says_where() -> None:
    """Kepler with huge steps: the number of the step, its size and the residual."""
    with pytest.raises(StepFailed, match=r"step 1 of size 1000000: .*residual") as caught:
        integrate(bind(pair(coupled(2, 3)), hamiltonian("generic", 2)).at(), fmpq(10**6), 3)
    assert (caught.value.number, caught.value.h) == (1, 10**6)
    assert caught.value.help
    falling = Hamiltonian(
        "fall", ("x",), (1 / symbols(("x",), "q")[0],), (fmpq(0), fmpq(0)), fmpq(1)
    )
    with pytest.raises(StepFailed, match="step 1") as left:
        integrate(bind(RK4, falling).at(), H, 1)
    assert "an earlier final time" in (left.value.help or "")


@pytest.mark.parametrize(
    ("tableau", "name", "said"),
    [
        (RECTANGULAR, "generic", r"H\{1\} of generic depends on q"),
        (SEMI, "generic", r"H\{2\} of generic depends on p"),
        (with_linear(pair(coupled(2, 3)), ["V1"]), "generic", "colour V1 to be linear"),
        (HEUN, "generic", "colour 2 depends on variables driven by colour 1"),
    ],
)
def test_problem_has_to_fit_the_structure(tableau: Tableau, name: str, said: str) -> None:
    """A separable method has no colour for a Hamiltonian that is not."""
    with pytest.raises(UsageProblem, match=said):
        fields_of(tableau, hamiltonian(name, 2))


def test_problem_is_split_for_the_method() -> None:
    """A problem in one term has as many as the method is for, naturally; two terms are not
    three.
    """
    whole, split = (hamiltonian("pendulum", terms) for terms in (1, 2))
    assert integrate(bind(RECTANGULAR, whole).at(), H, 5) == integrate(
        bind(RECTANGULAR, split).at(), H, 5
    )
    triple = gark([diagonal_method("gauss", 1)] * 3, {})
    with pytest.raises(UsageProblem, match="2 terms, the method is for 3"):
        bind(triple, split).at()
    with pytest.raises(UsageProblem, match="2 terms, the method is for 3"):
        converge(triple, split)
    with pytest.raises(UsageProblem, match="2 terms, the method is for 3"):
        long_run(triple, split, fmpq(1), H)


def test_unknown_problem() -> None:
    """A misspelt problem is named with the nearest one."""
    with pytest.raises(UsageProblem, match="pendulum"):
        hamiltonian("pendulm", 2)


@pytest.mark.parametrize(
    ("tableau", "name", "said"),
    [
        (RECTANGULAR, "split-oscillator", "unbranched"),
        (RECTANGULAR, "kepler", "velocities do not branch"),
        (pair(coupled(2, 3)), "generic", "up to degree 7"),
        (RK4, "pendulum", "velocities do not branch"),
    ],
)
def test_what_a_problem_sees(tableau: Tableau, name: str, said: str) -> None:
    """Linear, quadratic kinetic energy, all."""
    assert said in visible_trees(fields_of(tableau, hamiltonian(name, terms_of(tableau))))
