"""One step on the oscillator: against floats, Padé, symplecticity, and the structures of the
paper.
"""

from __future__ import annotations

from itertools import islice
from math import factorial

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.errors import UsageProblem
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.matrix import Matrix
from garkcli.families.registry import diagonal_method
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stepping.linear import (
    conserves_energy,
    deviations,
    enclosure,
    linear_step,
    visible_order,
    whole_steps,
)
from garkcli.tableau.forms import (
    additive,
    gark,
    pair,
    partitioned,
    separable_prk,
    spelled_out,
    symplectic_pair,
)
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.whole import at_most

H = fmpq(1, 3)
ONE = fmpq(1)


def gark_of(*names: tuple[str, int]) -> Tableau:
    """The collocation GARK tableau of some families."""
    methods = [diagonal_method(*name) for name in names]
    N = range(len(methods))
    return gark(
        methods, {(l, m): collocation(methods[l], methods[m]) for l in N for m in N if l != m}
    )


def default(tableau: Tableau, omega: fmpq = ONE) -> Oscillator:
    """The default split for a tableau."""
    return Oscillator.default(terms_of(tableau), omega)


def determinant(R: Matrix) -> object:
    """Of a 2 by 2 matrix."""
    return R[0][0] * R[1][1] - R[0][1] * R[1][0]


def float_matrix(R: Matrix) -> np.ndarray:
    """Rounded."""
    return np.array([[float(x) for x in row] for row in enclosure(R, 80).tolist()])


def dense_step(tableau: Tableau, problem: Oscillator, h: float) -> np.ndarray:
    """R(h) by the textbook: values at real nodes, Kronecker products, one dense solve, all in
    floats.
    """
    change = []  # coordinates → values at the nodes
    for space in tableau.spaces:
        if hasattr(space, "modulus"):
            coefficients = [
                float(space.modulus[k].p) / float(space.modulus[k].q)
                for k in range(space.stages + 1)
            ]
            change.append(np.vander(np.roots(coefficients[::-1]), increasing=True))
        else:
            change.append(np.eye(space.stages))
    sizes = [space.stages for space in tableau.spaces]
    start = np.concatenate([[0], np.cumsum(sizes)])
    total = start[-1]
    system, weights = np.eye(2 * total), np.zeros((2, 2 * total))
    for m, colour in enumerate(tableau.colours):
        L = float_matrix(problem.matrix(colour))
        seen = slice(2 * start[colour.space], 2 * start[colour.space + 1])
        to_values = np.linalg.inv(change[colour.space])
        b = np.array([[float(x) for x in enclosure((colour.b,), 80).tolist()[0]]]) @ to_values
        weights[:, seen] += np.kron(b, L)
        for k in range(len(sizes)):
            if (k, m) in tableau.blocks:
                block = change[k] @ float_matrix(tableau.blocks[k, m]) @ to_values
                system[2 * start[k] : 2 * start[k + 1], seen] -= h * np.kron(block, L)
    stages = np.linalg.solve(system, np.kron(np.ones((total, 1)), np.eye(2)))
    return np.eye(2) + h * weights @ stages


def rectangular_in_radicals() -> Tableau:
    """The paper's rectangular method as printed, eq. (rectangular)."""
    texts = [
        [["0", "0"], ["1/4 + sqrt(3)/8", "1/4 - sqrt(3)/8"], ["1/2", "1/2"]],
        [["1/6", "1/3 - sqrt(3)/6", "0"], ["1/6", "1/3 + sqrt(3)/6", "0"]],
    ]
    parsed = [[[parse(x) for x in row] for row in block] for block in texts]
    domain = Domain([x for block in parsed for row in block for x in row])
    A_q, A_p = (tuple(tuple(domain.evaluate(x) for x in row) for row in block) for block in parsed)
    b_q, b_p = (fmpq(1, 2),) * 2, (fmpq(1, 6), fmpq(2, 3), fmpq(1, 6))
    return separable_prk((A_q, b_q, None), (A_p, b_p, None))


GAUSS_LOBATTO = gark_of(("gauss", 2), ("lobatto-iiia", 3))
TABLEAUS = {
    "one colour": gark_of(("radau-iia", 3)),
    "explicit": gark_of(("rk4", 4)),
    "gark": GAUSS_LOBATTO,
    "three colours": gark_of(("gauss", 2), ("lobatto-iiia", 3), ("radau-iia", 2)),
    "pair": pair(GAUSS_LOBATTO),
    "pair of one": pair(gark_of(("radau-ia", 2))),
    "semi-separable": symplectic_pair(GAUSS_LOBATTO, [0], [0, 1]),
    "separable": symplectic_pair(GAUSS_LOBATTO, [0], [1]),
    "in radicals": rectangular_in_radicals(),
    "additive": additive(
        [diagonal_method("heun").A, ((fmpq(0),) * 2, (fmpq(1, 2),) * 2)],
        [(fmpq(1, 2),) * 2] * 2,
        None,
    ),
    "partitioned": partitioned(diagonal_method("heun"), diagonal_method("explicit-midpoint")),
}


@pytest.mark.parametrize("name", TABLEAUS)
@pytest.mark.parametrize("omega", [fmpq(1), fmpq(7, 3)])
def test_step_is_that_of_a_dense_computation(name: str, omega: fmpq) -> None:
    """Every structure: the exact step in stage spaces is the float step at the nodes."""
    tableau = TABLEAUS[name]
    problem = default(tableau, omega)
    exact = float_matrix(linear_step(tableau, problem).at(H))
    assert exact == pytest.approx(dense_step(tableau, problem, float(H)), abs=1e-12)


def test_radicals_and_families_make_the_same_rectangular_method() -> None:
    """The printed coefficients over ℚ(√3) give the very same rational step as the construction over
    ℚ.
    """
    one, other = TABLEAUS["separable"], TABLEAUS["in radicals"]
    assert linear_step(one, default(one)).at(H) == linear_step(other, default(other)).at(H)


@pytest.mark.parametrize("s", [1, 2, 3, 6])
def test_gauss_step_is_the_pade_approximant(s: int) -> None:
    """Gauss with s stages: R(h) = P(−hL)⁻¹ P(hL), the diagonal Padé approximant, and it conserves
    energy.
    """
    tableau, omega = gark_of(("gauss", s)), fmpq(3, 2)
    P = [
        fmpq(
            factorial(2 * s - k) * factorial(s), factorial(2 * s) * factorial(k) * factorial(s - k)
        )
        for k in range(s + 1)
    ]
    # on an eigenvector L is iω: P(ihω) = C + iS with real C, S, and R(h) is the rotation by P/P̄
    x = omega * H
    C = sum(((-1) ** (k // 2) * P[k] * x**k for k in range(0, s + 1, 2)), fmpq(0))
    S = sum(((-1) ** (k // 2) * P[k] * x**k for k in range(1, s + 1, 2)), fmpq(0))
    cosine, sine = ((C * C - S * S) / (C * C + S * S), 2 * C * S / (C * C + S * S))
    R = linear_step(tableau, default(tableau, omega)).at(H)
    rotation = ((cosine, sine / omega), (-omega * sine, cosine))
    assert rotation == R
    assert conserves_energy(R, omega)


@pytest.mark.parametrize(
    "name", ["pair", "pair of one", "semi-separable", "separable", "in radicals"]
)
def test_pairs_are_symplectic(name: str) -> None:
    """Det R(h) = 1 exactly, which for a plane is symplecticity; energy is not conserved exactly."""
    tableau = TABLEAUS[name]
    R = linear_step(tableau, default(tableau)).at(H)
    assert determinant(R) == 1
    assert not conserves_energy(R, fmpq(1))


@pytest.mark.parametrize("name", ["one colour", "explicit", "partitioned"])
def test_other_methods_are_not_symplectic(name: str) -> None:
    """The test above can fail: methods that are no pairs have another determinant."""
    tableau = TABLEAUS[name]
    assert determinant(linear_step(tableau, default(tableau)).at(H)) != 1


@settings(max_examples=at_most(8, 25), deadline=None)
@given(st.fractions(0, 1, max_denominator=9), st.fractions(-1, 2, max_denominator=9))
def test_one_method_on_all_terms_does_not_see_the_split(kinetic: object, potential: object) -> None:
    """Gauss 2 twice is Gauss 2, whatever the shares."""
    k, v = (fmpq(x.numerator, x.denominator) for x in (kinetic, potential))  # type: ignore[attr-defined]
    twice, once = gark_of(("gauss", 2), ("gauss", 2)), gark_of(("gauss", 2))
    split = Oscillator(fmpq(2), ((k, v), (1 - k, 1 - v)))
    assert linear_step(twice, split).at(H) == linear_step(once, default(once, fmpq(2))).at(H)


@pytest.mark.parametrize("name", TABLEAUS)
def test_series_sums_to_the_step(name: str) -> None:
    """The power series of R and its exact value agree for a small h, to the first term left out."""
    tableau, h = TABLEAUS[name], fmpq(1, 64)
    step = linear_step(tableau, default(tableau))
    total = np.eye(2) + sum(
        float_matrix(R_k) * float(h) ** k for k, R_k in enumerate(islice(step.series(), 8), start=1)
    )
    assert total == pytest.approx(float_matrix(step.at(h)), abs=1e-13)


@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("one colour", 5),
        ("explicit", 4),
        ("gark", 4),
        ("pair", 4),
        ("separable", 4),
        ("in radicals", 4),
    ],
)
def test_visible_order(name: str, order: int) -> None:
    """The order of R(h) as a series; the coefficient after it differs."""
    step = linear_step(TABLEAUS[name], default(TABLEAUS[name], fmpq(5, 2)))
    assert visible_order(step) == order
    values = list(islice(deviations(step), order + 1))
    assert all(x == 0 for x in values[:order])
    assert values[order] > 0


def test_visible_order_within_a_tolerance() -> None:
    """A weight that is off by 1e-12 is of order 0 exactly, and of order 2 within 1e-10."""
    b = (fmpq(1, 2), fmpq(1, 2) + fmpq(1, 10**12))
    tableau = spelled_out([[((fmpq(0), fmpq(0)), (fmpq(1), fmpq(0)))]], [b], [None])
    step = linear_step(tableau, default(tableau))
    assert visible_order(step) == 0
    assert visible_order(step, fmpq(1, 10**10)) == 2


def test_visible_order_ends_where_the_tolerance_hides_all() -> None:
    """Within 1e-4 the coefficients 1/k! of the exponential are none from order 8 on, so that a
    method with small ones there agrees for ever: the search ends at 7.
    """
    tableau = gark([diagonal_method("gauss", 6)], {})
    step = linear_step(tableau, default(tableau))
    assert visible_order(step) == 12
    assert visible_order(step, fmpq(1, 10**4)) == 7


def test_precision_is_what_was_asked_for() -> None:
    """The enclosure of an irrational or long number has the bits."""
    tableau = TABLEAUS["separable"]
    step = linear_step(tableau, default(tableau))
    assert all(x.rel_accuracy_bits() >= 500 for x in enclosure(step.at(H), 500).entries())


def test_singular_stage_equations() -> None:
    """Y = y₀ + h·a·(p, −q) with a real pole: at h = 1 this split method has none but infinitely
    many stages.
    """
    one = fmpq(1)
    blocks: list[list[Matrix | None]] = [[((one,),), ((one,),)], [((-one,),), ((one,),)]]
    tableau = spelled_out(blocks, [(one,), (one,)], [None, None])
    step = linear_step(tableau, default(tableau))
    with pytest.raises(UsageProblem, match="no unique solution for h = 1"):
        step.at(one)
    assert step.at(fmpq(1, 2))


@pytest.mark.parametrize(("t_end", "h"), [("1", "0"), ("-1", "1"), ("1", "2"), ("1", "2/7")])
def test_steps_have_to_divide_the_time(t_end: str, h: str) -> None:
    """No step is silently made longer or shorter."""
    t, x = (fmpq(*map(int, text.split("/"))) for text in (t_end, h))
    with pytest.raises(UsageProblem):
        whole_steps(t, x)
