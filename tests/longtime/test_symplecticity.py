"""How symplectic single steps are."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq

from garkcli.longtime.symplecticity import Defect, is_proved, symplecticity_defects
from garkcli.methodfile.load import loads
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import bind, integrate
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau

RK4 = """
ark:
  A: [[[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]]
  b: [[1/6, 1/3, 1/3, 1/6]]
"""
EULER = "ark: {A: [[[0]]], b: [[1]]}"
GAUSS = "methods: [{family: gauss, stages: 2}]"
COUPLED = "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\ntransfer: collocation"
LEAPFROG = """
prk:
  q: {A: [[0], [1]], b: [1], c: [0, 1]}
  p: {A: [[1/2, 0]], b: [1/2, 1/2], c: [1/2]}
structure: separable
"""
H = fmpq(1, 10)


def measured(text: str, name: str, as_pair: bool = False) -> tuple[Tableau, Hamiltonian, Defect]:
    """The defect of the first step."""
    tableau = loads(text).tableau
    tableau = with_joined_terms(pair(tableau) if as_pair else tableau)
    problem = hamiltonian(name, terms_of(tableau))
    (found,) = symplecticity_defects(tableau, problem, H, [(fmpq(0), problem.initial)])
    return tableau, problem, found


@pytest.mark.parametrize(
    ("text", "name", "as_pair"),
    [
        (LEAPFROG, "kepler", False),
        (LEAPFROG, "fput", False),
        (GAUSS, "generic", False),
        (COUPLED, "generic", True),
    ],
)
def test_symplectic_steps(text: str, name: str, as_pair: bool) -> None:
    """What is proved is measured too: no defect down to 10^-50."""
    tableau, problem, found = measured(text, name, as_pair)
    assert is_proved(tableau, problem)
    assert not found.is_seen
    assert found.error < 1e-50


@pytest.mark.parametrize(
    ("text", "name"), [(RK4, "kepler"), (EULER, "pendulum"), (COUPLED, "generic")]
)
def test_other_steps(text: str, name: str) -> None:
    """What is not symplectic is seen, far above what the measurement is good to."""
    tableau, problem, found = measured(text, name)
    assert not is_proved(tableau, problem)
    assert found.is_seen
    assert found.size > 1e20 * found.error


def test_defect_of_explicit_euler() -> None:
    """On the pendulum M = (1, h; −h cos q, 1): MᵀJM − J = h² cos q · J."""
    _, problem, found = measured(EULER, "pendulum")
    q = float(problem.initial[0].p) / float(problem.initial[0].q)
    assert found.size == pytest.approx(0.01 * np.cos(q), rel=1e-14)


def test_defect_is_that_of_floats() -> None:
    """Plain differences in floats give the same, to the few digits they have."""
    tableau, problem, found = measured(RK4, "kepler")
    method, y = (bind(tableau, problem).at(), [float(x.p) / float(x.q) for x in problem.initial])
    columns = []
    for i in range(4):
        ends = []
        for sign in (1, -1):
            moved = list(y)
            moved[i] += sign * 1e-5
            ends.append(np.array(integrate(method, H, 1, moved)))
        columns.append((ends[0] - ends[1]) / 2e-5)
    M = np.stack(columns, axis=1)
    J = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]])
    assert found.size == pytest.approx(np.abs(M.T @ J @ M - J).max(), rel=1e-4)


def test_defect_has_the_order_of_the_method() -> None:
    """Half the step, at least 2⁵ times less: RK4 is symplectic up to its order."""
    tableau = loads(RK4).tableau
    problem = hamiltonian("henon-heiles", 1)
    sizes = [
        symplecticity_defects(tableau, problem, h, [(fmpq(0), problem.initial)])[0].size
        for h in (fmpq(1, 20), fmpq(1, 40))
    ]
    assert np.log2(sizes[0] / sizes[1]) > 4.8


def test_states_of_floats() -> None:
    """A state of a run in floats is taken as the numbers that it has."""
    tableau = loads(LEAPFROG).tableau
    problem = hamiltonian("pendulum", 2)
    first, second = symplecticity_defects(
        tableau, problem, H, [(fmpq(0), (0.1, 0.5)), (fmpq(3), (2.5, -0.3))]
    )
    assert (first.time, second.time) == (0, 3)
    assert not first.is_seen
    assert not second.is_seen


def test_proof_sees_what_the_problem_sees() -> None:
    """Symplectic Euler as an additive method is symplectic for T(p) + V(q) only, and proved for
    that alone.
    """
    tableau = loads("""
tableau:
  A: [[[[0]], [[1]]], [[[0]], [[0]]]]
  b: [[1], [1]]
""").tableau
    assert is_proved(tableau, hamiltonian("pendulum", 2))
    assert not is_proved(tableau, hamiltonian("generic", 2))


def test_proof_within_a_tolerance() -> None:
    """Rounded coefficients are symplectic within their tolerance, and not without it."""
    text = """
tableau:
  A: [[[[0.25, -0.038675134594813], [0.538675134594813, 0.25]]]]
  b: [[0.5, 0.5]]
"""
    tableau, problem = loads(text).tableau, hamiltonian("pendulum", 1)
    assert is_proved(tableau, problem, fmpq(1, 10**12))
    assert is_proved(tableau, problem)  # these rounded ones are symplectic exactly
    tableau = loads(text.replace("94813], [", "94812], [")).tableau
    assert is_proved(tableau, problem, fmpq(1, 10**12))
    assert not is_proved(tableau, problem)
