"""Multirate methods: against the steps as solvers take them, and the orders of the papers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest
from flint import fmpq

from garkcli.api.methods import find_order
from garkcli.convergence.convergence import converge
from garkcli.exact.matrix import Matrix, Vector
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import loads
from garkcli.problems.builtin import hamiltonian
from garkcli.tableau.tableau import Method, Tableau
from tests.oracles.series import series_order

ERK33 = (
    "{c: [0, 1/3, 2/3, 1], gamma: [[[1/3], [-1/3, 2/3], [0, -2/3, 1]],"
    " [[0], [0, 0], [1/2, 0, -1/2]]]}"
)
"""MRI-GARK-ERK33a of Sandu's paper."""
IRK21 = "{c: [0, 1, 1], gamma: [[[1, 0, 0], [-1/2, 0, 1/2]]]}"
"""MRI-GARK-IRK21a: the trapezoidal rule for the slow part."""
KNOTH_WOLKE = "{A: [[], [1/3], [-3/16, 15/16]], b: [1/6, 3/10, 8/15]}"
HEUN_3 = "{A: [[], [1/3], [0, 2/3]], b: [1/4, 0, 3/4]}"
EX2 = "{fast-slow: [[(lambda - 1)/M, 0], [(2*lambda - 1)/(2*M), 0]], slow-fast: [[0, 0], [1/2, 0]]}"
ORDERS = {
    f"{{mis: {KNOTH_WOLKE}, fast: kutta, steps: 2}}": 3,
    f"{{mis: {HEUN_3}, fast: kutta, steps: 2}}": 2,
    f"{{mis: {KNOTH_WOLKE}, fast: heun, steps: 2}}": 2,
    f"{{mri: {ERK33}, fast: kutta, steps: 2}}": 3,
    f"{{mri: {ERK33}, fast: rk4, steps: 1}}": 3,
    f"{{mri: {ERK33}, fast: heun, steps: 2}}": 2,
    f"{{mri: {IRK21}, fast: heun, steps: 2}}": 2,
    "{mis: explicit-euler, fast: rk4, steps: 2}": 1,
    "{slow: heun, fast: heun, steps: 3}": 2,
    "{slow: kutta, fast: kutta, steps: 2}": 3,
    "{slow: kutta, fast: heun, steps: 2}": 2,
    "{slow: {family: gauss, stages: 2}, fast: {family: gauss, stages: 2}, steps: 2}": 4,
    "{slow: {family: gauss, stages: 1}, fast: {family: gauss, stages: 1}, steps: 2,"
    " coupling: collocation}": 2,
    f"{{slow: explicit-midpoint, fast: explicit-midpoint, steps: 3, coupling: {EX2}}}": 2,
}
"""Multirate methods and their orders.

A multirate infinitesimal step of order 3 needs one condition more than the slow method has (Knoth and
Wolke's meets it, Heun's does not); MRI-GARK-ERK33a corrects it with linear polynomials; no method has
a higher order than its fast one.
"""


@pytest.mark.parametrize("text", ORDERS)
def test_orders(text: str) -> None:
    """The order by the certificate is that of the papers; a power series of the step agrees."""
    method = loads(f"multirate: {text}")
    order = ORDERS[text]
    assert find_order(method).order == order
    assert series_order(method.tableau, order + 1) == order


def fast_field(y: fmpq) -> fmpq:
    """A fast part that is nonlinear."""
    return y * y - fmpq(1, 3) * y + 1


def slow_field(y: fmpq) -> fmpq:
    """A slow part that is nonlinear."""
    return fmpq(1, 2) - y * y


FIELDS = (fast_field, slow_field)


def step_of(tableau: Tableau, y: fmpq, h: fmpq) -> fmpq:
    """One explicit step of a tableau, whatever the order in which its stages can be computed."""
    slopes: dict[tuple[int, int], fmpq] = {}
    wanted = [(m, i) for m, colour in enumerate(tableau.colours) for i in range(len(colour.b))]
    while len(slopes) < len(wanted):
        for m, i in wanted:
            row = _row(tableau, m, i)
            if (m, i) not in slopes and row.keys() <= slopes.keys():
                value = y + sum((h * w * slopes[x] for x, w in row.items()), fmpq(0))
                slopes[m, i] = FIELDS[m](value)
    weights = {
        (m, i): b for m, colour in enumerate(tableau.colours) for i, b in enumerate(colour.b)
    }
    return y + sum((h * w * slopes[x] for x, w in weights.items()), fmpq(0))


def _row(tableau: Tableau, m: int, i: int) -> dict[tuple[int, int], fmpq]:
    k = tableau.colours[m].space
    found = {}
    for l in range(tableau.size):
        for j, entry in enumerate(tableau.blocks[k, l][i]):
            if entry:
                assert isinstance(entry, fmpq)
                found[l, j] = entry
    return found


Forcing = Callable[[fmpq], fmpq]


def forced(fast: Method, y: fmpq, steps: int, width: fmpq, forcing: Forcing) -> fmpq:
    """The fast problem dv/dτ = width · f(v) + forcing(τ) from 0 to 1 by small explicit steps."""
    h = fmpq(1, steps)
    for n in range(steps):
        slopes: list[fmpq] = []
        for row, c in zip(fast.A, fast.c, strict=True):
            value = y + h * _dot(row, slopes)
            assert isinstance(c, fmpq)
            slopes.append(width * fast_field(value) + forcing((n + c) * h))
        y = y + h * _dot(fast.b, slopes)
    return y


def _dot(row: Vector, slopes: Sequence[fmpq]) -> fmpq:
    total = fmpq(0)
    for weight, slope in zip(row, slopes, strict=False):
        assert isinstance(weight, fmpq)
        total += weight * slope
    return total


@pytest.mark.parametrize(("name", "steps"), [("heun", 2), ("kutta", 1)])
def test_polynomial_coupling_is_the_fast_problem(name: str, steps: int) -> None:
    """One step of the tableau is what a solver does: from slow stage to slow stage the fast problem
    with the polynomial of slow slopes, solved by small steps; exactly.
    """
    fast = diagonal_method(name)
    made = loads(f"multirate: {{mri: {ERK33}, fast: {name}, steps: {steps}}}")
    start, H = fmpq(1, 2), fmpq(1, 4)
    gamma: tuple[Sequence[Sequence[fmpq]], ...] = (
        ([fmpq(1, 3)], [fmpq(-1, 3), fmpq(2, 3)], [fmpq(0), fmpq(-2, 3), fmpq(1)]),
        ([fmpq(0)], [fmpq(0)] * 2, [fmpq(1, 2), fmpq(0), fmpq(-1, 2)]),
    )
    y, slopes = start, []
    for i in range(3):
        slopes.append(slow_field(y))

        def forcing(tau: fmpq, i: int = i) -> fmpq:
            total = fmpq(0)
            for k, matrix in enumerate(gamma):
                terms = zip(matrix[i], slopes, strict=False)
                total += tau**k * sum((g * f for g, f in terms), fmpq(0))
            return H * total

        y = forced(fast, y, steps, H / 3, forcing)
    assert step_of(made.tableau, start, H) == y


def test_slowest_first_is_what_it_says() -> None:
    """The slow step for both parts, then small steps of the fast part with the slow slopes
    interpolated; exactly.
    """
    made = loads("multirate: {slow: heun, fast: heun, steps: 2}")
    y, H = fmpq(1, 3), fmpq(1, 5)
    one = slow_field(y)
    coarse = y + H * (fast_field(y) + one)
    two = slow_field(coarse)

    def gained(tau: fmpq) -> fmpq:
        return H * (one * (tau - tau**2 / 2) + two * tau**2 / 2)

    value = y
    for n in range(2):
        begin, end = fmpq(n, 2), fmpq(n + 1, 2)
        first = fast_field(value + gained(begin))
        second = fast_field(value + H / 2 * first + gained(end))
        value = value + H / 4 * (first + second)
    assert step_of(made.tableau, y, H) == value + gained(fmpq(1))


def test_coupling_matrices_are_in_their_places() -> None:
    """With matrices for each small step the blocks are those of the paper: A^{f,s,λ} one below the
    other, A^{s,f,λ}/M side by side.
    """
    coupling = "{fast-slow: [[lambda, M]], slow-fast: [[0], [lambda*M]]}"
    made = loads(f"multirate: {{slow: heun, fast: explicit-euler, steps: 3, coupling: {coupling}}}")
    blocks: dict[tuple[int, int], Matrix] = dict(made.tableau.blocks)
    assert blocks[0, 1] == ((1, 3), (2, 3), (3, 3))
    assert blocks[1, 0] == ((0, 0, 0), (1, 2, 3))
    assert made.tableau.colours[0].b == (fmpq(1, 3),) * 3


def test_two_slow_parts() -> None:
    """With omega and gamma there are two slow parts on the same stages: explicit and implicit, the
    IMEX-MRI-GARK form; Heun's method and the trapezoidal rule have order 2 together.
    """
    table = "{c: [0, 1, 1], omega: [[[1], [-1/2, 1/2]]], gamma: [[[1, 0, 0], [-1/2, 0, 1/2]]]}"
    made = loads(f"multirate: {{mri: {table}, fast: heun, steps: 2}}")
    assert made.tableau.size == 3
    assert len(made.tableau.spaces) == 2
    assert find_order(made).order == 2
    assert series_order(made.tableau, 3) == 2


def test_a_table_with_the_row_of_the_beginning() -> None:
    """Tables as codes have them, with a first row of zeros and a column a stage, are the same."""
    padded = (
        "{c: [0, 1/3, 2/3, 1], gamma: [[[0,0,0,0], [1/3,0,0,0], [-1/3,2/3,0,0], [0,-2/3,1,0]],"
        " [[0,0,0,0], [0,0,0,0], [0,0,0,0], [1/2,0,-1/2,0]]]}"
    )
    one, other = (
        loads(f"multirate: {{mri: {x}, fast: heun, steps: 2}}").tableau for x in (ERK33, padded)
    )
    assert one == other


def test_observed_order() -> None:
    """The stepping engine sees order 3 of MRI-GARK-ERK33a with two small steps on a problem."""
    made = loads(f"multirate: {{mri: {ERK33}, fast: kutta, steps: 2}}").tableau
    steps = [fmpq(1, 2**k) for k in (5, 6)]
    found = converge(made, hamiltonian("generic", 2, 1), fmpq(1, 4), steps)
    assert found.observed_order == pytest.approx(3, abs=0.1)
