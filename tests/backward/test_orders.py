"""Orders of symplecticity and of energy, and the modified Hamiltonian, against steps on random
Hamiltonian problems as exact power series.
"""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq, fmpq_poly

from garkcli import load, loads
from garkcli.backward.hamiltonian import (
    energy_order,
    free_trees,
    hamiltonian_structure,
    modified_hamiltonian,
    symplectic_order,
)
from garkcli.backward.modified import modified_equation
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.oracles import hamiltonian_series as oracle
from tests.oracles.brute import Trees, Weights
from tests.whole import at_most

RK4 = "methods: [{family: rk4}]"
THREE_EIGHTHS = """
A: [[0, 0, 0, 0], [1/3, 0, 0, 0], [-1/3, 1, 0, 0], [1, -1, 1, 0]]
b: [1/8, 3/8, 3/8, 1/8]
"""
TRAPEZOIDAL = "{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}"
MIDPOINT = "{A: [[1/2]], b: [1]}"
EULER_PAIR = "{prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1]}}}"
NOT_A_PAIR = """
prk:
  q: {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}
  p: {A: [[1/2, 0], [1/2, 0]], b: [1/2, 1/2]}
"""
# b of positions and momenta differ: no Hamiltonian for terms of both
OTHER_WEIGHTS = """
prk:
  q: {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}
  p: {A: [[0, 0], [1, 0]], b: [1, 0]}
"""
IMPLICIT_EXPLICIT = """
ark:
  A: [[[0, 0], [1/2, 0]], [[0, 0], [0, 1/2]]]
  b: [[0, 1], [0, 1]]
"""
SPLIT = """
tableau:
  A: [[[[0]], [[1/2]]], [[[1/2]], [[1/2]]]]
  b: [[1], [1]]
"""


def test_names() -> None:
    """The methods below are read as what they are called."""
    assert modified_equation(loads(RK4).tableau, 5).order == 4
    assert modified_equation(loads(THREE_EIGHTHS).tableau, 5).order == 4
    assert modified_equation(loads(TRAPEZOIDAL).tableau, 5).order == 2


@pytest.mark.parametrize(
    ("text", "limit"),
    [
        (RK4, 5),
        (THREE_EIGHTHS, 5),
        (TRAPEZOIDAL, 4),
        (MIDPOINT, 4),
        (EULER_PAIR, 4),
        (NOT_A_PAIR, 4),
        (OTHER_WEIGHTS, 3),
        (IMPLICIT_EXPLICIT, 3),
        (SPLIT, 3),
    ],
)
def test_orders_of_symplecticity_and_energy(text: str, limit: int) -> None:
    """Both are what the defect of MᵀJM = J and the change of H have as their lowest power of h."""
    tableau = loads(text).tableau
    equation = modified_equation(tableau, limit)
    structure = hamiltonian_structure(tableau)
    assert structure is not None
    problem = oracle.random_problem(tableau, limit + 1, seed=3)
    assert symplectic_order(equation, structure) == oracle.symplectic_order(problem)
    assert energy_order(equation, structure) == oracle.energy_order(problem)


def _brute_symplectic_order(tableau: Tableau, limit: int) -> int:
    """The largest q with a(u∘v) + a(v∘u) = a(u) a(v) for ρ(u) + ρ(v) ≤ q, of one colour."""
    trees, weights = Trees(tableau), Weights(tableau)
    for n in range(2, limit + 1):
        for k in range(1, n):
            for u in trees.of_order(k):
                for v in trees.of_order(n - k):
                    both = weights.weight((0, (*u[1], v)))
                    both += weights.weight((0, (*v[1], u)))
                    if both != weights.weight(u) * weights.weight(v):
                        return n - 1
    return limit


@pytest.mark.parametrize(
    "text", [RK4, THREE_EIGHTHS, TRAPEZOIDAL, MIDPOINT, "methods: [{family: radau-iia, stages: 2}]"]
)
def test_pseudo_symplectic_conditions(text: str) -> None:
    """With elementary weights the order of symplecticity is that of Aubry and Chartier."""
    tableau = loads(text).tableau
    structure = hamiltonian_structure(tableau)
    assert structure is not None
    found = symplectic_order(modified_equation(tableau, 6), structure)
    assert found == _brute_symplectic_order(tableau, 6)


@pytest.mark.parametrize(("c", "order"), [(fmpq(1, 2), 5), (fmpq(1, 3), 4)])
def test_pseudo_symplectic_methods(c: fmpq, order: int) -> None:
    """Explicit methods of order 2 whose steps are symplectic to a higher order.

    Of three stages with c₃ = 1 the conditions of Aubry and Chartier for order 4 leave b₃ a₃₂ c₂ =
    1/8 and b₂ c₂ (1 − c₂) = 1/8.
    """
    b2 = 1 / (8 * c * (1 - c))
    b3 = fmpq(1, 2) - b2 * c
    a32 = 1 / (8 * b3 * c)
    A = f"[[0, 0, 0], [{c}, 0, 0], [{1 - a32}, {a32}, 0]]"
    tableau = loads(f"{{A: {A}, b: [{1 - b2 - b3}, {b2}, {b3}]}}").tableau
    equation = modified_equation(tableau, 6)
    structure = hamiltonian_structure(tableau)
    assert structure is not None
    assert equation.order == 2
    assert symplectic_order(equation, structure) == order
    problem = oracle.random_problem(tableau, order + 2, seed=1)
    assert oracle.symplectic_order(problem) == order


def _check_hamiltonian(tableau: Tableau, order: int) -> None:
    equation = modified_equation(tableau, order)
    structure = hamiltonian_structure(tableau)
    assert structure is not None
    problem = oracle.random_problem(tableau, order + 1, seed=2)
    end, _ = oracle.step(problem)
    start = [fmpq_poly([x]) for x in problem.start]
    changes = []
    for y in (start, end):
        total = fmpq_poly()
        for term in modified_hamiltonian(equation, structure):
            value = problem.elementary_hamiltonian(term.tree.representative, y)
            power = fmpq_poly([0] * (term.tree.order - 1) + [1])
            total += problem.times(value, power) * term.factor
        changes.append(total)
    change = problem.cut(changes[1] - changes[0])
    assert oracle.lowest_power([change], order + 1) == order + 1
    if equation.order < order:
        assert oracle.energy_order(problem) < order  # H itself is not kept so well


@pytest.mark.parametrize(("name", "order"), [("stoermer-verlet", 5), ("prk-lobatto-iiia-iiib", 4)])
def test_the_modified_hamiltonian_is_conserved(name: str, order: int) -> None:
    """Truncated after h^(n−1) it changes by O(h^(n+1)) a step, on random problems, exactly."""
    _check_hamiltonian(load(f"methods/{name}.gark.yaml").tableau, order)


def test_the_modified_hamiltonian_of_other_structures() -> None:
    """The same for one vector field, for symplectic Euler, for the pair of two terms."""
    _check_hamiltonian(loads(MIDPOINT).tableau, 4)
    _check_hamiltonian(loads(EULER_PAIR).tableau, 4)
    _check_hamiltonian(pair(loads(SPLIT).tableau), 3)


def test_elementary_hamiltonians_are_their_gradients() -> None:
    """J⁻¹∇H(u) = Σ ± |Aut T|/σ(θ) F(θ): along a vector w, H(u)' w = ω(Σ …, w), on random
    problems.
    """
    tableau = pair(loads(SPLIT).tableau)
    structure = hamiltonian_structure(tableau)
    assert structure is not None
    problem = oracle.random_problem(tableau, 2, seed=5)
    d = problem.d
    trees = [x for n in (1, 2, 3) for x in free_trees(structure, n)]
    for tree in trees[::3]:
        for i in range(2 * d):
            # modulo h² a step h in one coordinate is a derivative
            y = [fmpq_poly([x]) for x in problem.start]
            y[i] += fmpq_poly([0, 1])
            u = tree.representative
            slope = problem.elementary_hamiltonian(u, y)[1]
            sign, conjugate = (-1, i + d) if i < d else (1, i - d)
            total = fmpq_poly()
            for rooting, parity in tree.rootings:
                for twin in structure.twins(rooting):
                    vector = problem.elementary(twin, y)
                    count = tree.symmetry // rooting.symmetry
                    total += vector[conjugate] * (parity * count)
            assert total[0] == sign * slope


def test_no_structure() -> None:
    """Where roots cannot move there is no order of symplecticity."""
    one_way = "{tableau: {A: [[[[1/2]], [[1/2]]], [null, [[1/2]]]], b: [[1], [1]]}}"
    assert hamiltonian_structure(loads(one_way).tableau) is None


@pytest.mark.parametrize("seed", range(at_most(2, 4)))
def test_random_pairs_have_a_modified_hamiltonian(seed: int) -> None:
    """The pair of a random tableau satisfies all conditions of symplecticity, for each free tree, and
    leaves the modified Hamiltonian as it is, exactly, on a random problem.
    """
    dice = Random(seed)

    def small() -> str:
        return str(fmpq(dice.randint(-3, 3), dice.choice([2, 3])))

    def block(rows: int, columns: int) -> str:
        text = [", ".join(small() for _ in range(columns)) for _ in range(rows)]
        return "[" + ", ".join(f"[{row}]" for row in text) + "]"

    stages = [2, 1]
    A = [[block(k, l) for l in stages] for k in stages]
    rows = ", ".join(f"[{', '.join(row)}]" for row in A)
    tableau = loads(f"tableau: {{A: [{rows}], b: [[1/3, 2/3], [1]]}}").tableau
    both = pair(tableau)
    equation = modified_equation(both, 4)
    structure = hamiltonian_structure(both)
    assert structure is not None
    assert symplectic_order(equation, structure) == 4
    assert energy_order(equation, structure) >= equation.order
    _check_hamiltonian(both, 3)
