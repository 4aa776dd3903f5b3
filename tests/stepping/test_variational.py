"""The symplectic pair is the discrete Euler–Lagrange scheme of a discrete Lagrangian, eq. (des).

    L_d(q_0, q_1) = ext h Σ_l Σ_i b^l_i L^l(Q^l_i, V^l_i),   Q^l_i = q_0 + h Σ_m Σ_j a^{l,m}_{ij}
    V^m_j,

over all V with q_1 = q_0 + h Σ_m Σ_i b^m_i V^m_i. The extremum is found by Newton's method for the
V and the multiplier λ, from the numbers A and b alone: no conjugate, no vector field and no stage
of a step enters.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from flint import arb, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mpmath import mpf

from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.integrator import bind, trajectory
from garkcli.tableau.forms import gark, pair, spelled_out, symplectic_pair
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Method, Tableau
from garkcli.transfer import collocation, interpolation, symplectic_blocks
from tests.whole import at_most, in_whole, sample

H = fmpq(1, 10)
DIGITS = 50
"""Of the discrete Lagrangian."""
MANY = 40
"""Of the trajectories in balls."""
TOLERANCES = {FLOAT_DIGITS: 1e-13, MANY: 1e-35}


@dataclass(frozen=True)
class Lagrangian:
    """L = Σ_l L^l(q, v); an L^l without v has no velocities V^l, as in the separable case.

    Attributes:
        variables: names of the positions x; their velocities are vx.
        terms: L^l.
        start: q(0), then p(0).
    """

    variables: tuple[str, ...]
    terms: tuple[Any, ...]
    start: tuple[fmpq, ...]

    @cached_property
    def q(self) -> tuple[Any, ...]:
        return symbols(self.variables, "q")

    @cached_property
    def v(self) -> tuple[Any, ...]:
        return tuple(sympy.Symbol(f"v{x}", real=True) for x in self.variables)

    @cached_property
    def moving(self) -> tuple[int, ...]:
        """The terms with velocities."""
        return tuple(l for l, L in enumerate(self.terms) if L.free_symbols & set(self.v))

    @cached_property
    def derivatives(self) -> tuple[Callable[..., Any], ...]:
        """Of each term the value, the gradient by (q, v) and the Hessian, as functions of mpmath's
        numbers.
        """
        y = (*self.q, *self.v)
        return tuple(
            sympy.lambdify(
                y,
                [L, [L.diff(x) for x in y], [[L.diff(x, z) for z in y] for x in y]],
                modules="mpmath",
                cse=True,
            )
            for L in self.terms
        )

    def hamiltonian(self) -> Hamiltonian:
        """H^l(q, p) = p·v − L^l with ∂L^l/∂v = p, term by term."""
        return Hamiltonian(
            "legendre", self.variables, tuple(map(self._legendre, self.terms)), self.start, fmpq(1)
        )

    def _legendre(self, L: Any) -> Any:
        if not L.free_symbols & set(self.v):
            return -L
        p = symbols(self.variables, "p")
        somewhere = {x: sympy.Rational(k, 7) for k, x in enumerate((*self.q, *p), start=1)}
        momenta = tuple(zip(self.v, p, strict=True))
        for v in sympy.solve([L.diff(w) - x for w, x in momenta], self.v, dict=True):
            if all(
                abs(L.diff(w).subs(v).subs(somewhere) - somewhere[x]).n() < 1e-9 for w, x in momenta
            ):
                return (sum(x * w for w, x in momenta) - L).subs(v)
        raise AssertionError(f"no velocities for {L}")


X, Y = symbols(("x", "y"), "q")
U, W = sympy.symbols("vx vy", real=True)
LINE = {
    "one": ((1 + X**2) * U**2 / 2 - sympy.cos(X),),
    "two": (
        (1 + X**2) * U**2 / 2 - sympy.cos(X),
        (2 + sympy.sin(X)) * U**2 / 2 + X**3 * U / 3 - X**4 / 4,
    ),
    "three": (
        (1 + X**2) * U**2 / 2 - sympy.cos(X),
        -sympy.sqrt(1 - U**2) + sympy.exp(X) / 5,
        (3 + sympy.cos(X)) * U**2 / 2 - X**2 * U / 5 - X**3 / 3,
    ),
    "semi-separable": ((2 + sympy.cos(X)) * U**2 / 2 + X**2 * U - X**3 / 3, -sympy.exp(-X) - X**4),
    "separable": (-sympy.sqrt(1 - U**2), sympy.cos(X) - X**4 / 4),
}
PLANE = {
    "two": (
        ((1 + Y**2) * U**2 + X * U * W + (2 + X**2) * W**2) / 2 + X * Y * U - sympy.cos(X - Y),
        ((2 + sympy.sin(X)) * U**2 + (1 + X**2 * Y**2) * W**2) / 2 - X**4 / 4 - X**2 * Y,
    ),
    "semi-separable": (
        ((1 + Y**2) * U**2 + (1 + X**2) * W**2) / 2 - X * Y,
        -sympy.cos(X - 2 * Y) - Y**4,
    ),
    "separable": ((U**2 + U * W + W**2) / 2, -(X**2) * Y + Y**3 / 3 - sympy.exp(X) / 2),
}
START = (fmpq(2, 5), fmpq(-1, 5), fmpq(1, 2), fmpq(3, 10))


@cache
def lagrangian(name: str, dimension: int) -> Lagrangian:
    """One of the problems above."""
    if dimension == 1:
        return Lagrangian(("x",), LINE[name], START[1:3])
    return Lagrangian(("x", "y"), PLANE[name], START)


@cache
def hamiltonian(L: Lagrangian) -> Hamiltonian:
    """Its Legendre transform."""
    return L.hamiltonian()


def methods(*named: tuple[str, int]) -> list[Method]:
    """Diagonal methods by family and number of stages."""
    return [diagonal_method(family, stages) for family, stages in named]


def built(rule: Any, diagonal: Sequence[Method]) -> Tableau:
    """The positions' tableau with every transfer block by ``rule``."""
    return gark(
        diagonal,
        {
            (l, m): rule(diagonal[l], diagonal[m])
            for l in range(len(diagonal))
            for m in range(len(diagonal))
            if l != m
        },
    )


def symplectic(diagonal: Sequence[Method]) -> Tableau:
    """Collocation on the first method, the opposite block its conjugate."""
    return gark(diagonal, symplectic_blocks(collocation, diagonal, 0, 1))


GAUSS_LOBATTO = methods(("gauss", 2), ("lobatto-iiia", 3))
THREE = methods(("gauss", 1), ("radau-iia", 2), ("lobatto-iiic", 3))
FLAWED = spelled_out(
    [
        [((fmpq(1, 3), fmpq(0)), (fmpq(2, 3), fmpq(1, 4))), None],
        [((fmpq(1, 5), fmpq(0)),) * 3, None],
    ],
    [(fmpq(1, 4), fmpq(3, 4)), (fmpq(1, 2), fmpq(0), fmpq(1, 2))],
    [None, None],
)
"""Of order 1 at best, with a zero weight where the semi-separable case allows it."""


@dataclass(frozen=True)
class Case:
    """A tableau of the positions and a Lagrangian.

    Attributes:
        tableau: A and b.
        problem: name and number of degrees of freedom of the Lagrangian.
        full: whether the method is the pair for general problems; else for the fields the problem
            has.
    """

    tableau: Tableau
    problem: tuple[str, int]
    full: bool = True

    @property
    def lagrangian(self) -> Lagrangian:
        return lagrangian(*self.problem)

    @property
    def pair(self) -> Tableau:
        if self.full:
            return pair(self.tableau)
        forces = [
            l
            for l, L in enumerate(self.lagrangian.terms)
            if L.free_symbols & set(self.lagrangian.q)
        ]
        return symplectic_pair(self.tableau, self.lagrangian.moving, forces)

    def path(self, digits: int, count: int = 3, tableau: Tableau | None = None) -> list[Any]:
        """(q, p) after 0, 1, … steps, in mpmath's numbers, shape (count + 1, 2, d)."""
        made = bind(tableau or self.pair, hamiltonian(self.lagrangian)).at(digits)
        return [
            np.array(list(map(number, y)), object).reshape(2, -1)
            for y in trajectory(made, H, count)
        ]


CASES = {
    "one method": Case(gark(methods(("lobatto-iiic", 3)), {}), ("one", 1)),
    "explicit": Case(gark([diagonal_method("rk4")], {}), ("one", 1)),
    "collocation": Case(built(collocation, GAUSS_LOBATTO), ("two", 1)),
    "interpolation": Case(built(interpolation, GAUSS_LOBATTO), ("two", 1)),
    "symplectic collocation": Case(symplectic(GAUSS_LOBATTO), ("two", 1)),
    "three terms": Case(built(collocation, THREE), ("three", 1)),
    "three terms, interpolated": Case(built(interpolation, THREE), ("three", 1)),
    "plane": Case(built(collocation, GAUSS_LOBATTO), ("two", 2)),
    "plane, interpolation": Case(built(interpolation, GAUSS_LOBATTO[::-1]), ("two", 2)),
    "semi-separable": Case(built(collocation, GAUSS_LOBATTO), ("semi-separable", 1), full=False),
    "semi-separable by the general pair": Case(
        built(interpolation, GAUSS_LOBATTO), ("semi-separable", 1)
    ),
    "semi-separable, zero weight": Case(FLAWED, ("semi-separable", 2), full=False),
    "rectangular": Case(built(collocation, GAUSS_LOBATTO), ("separable", 1), full=False),
    "rectangular in the plane": Case(
        built(interpolation, GAUSS_LOBATTO), ("separable", 2), full=False
    ),
    "separable by the general pair": Case(symplectic(GAUSS_LOBATTO), ("separable", 1)),
}
SOME = ("collocation", "three terms", "plane", "semi-separable", "rectangular")


def number(x: Any) -> mpf:
    """A float, or the midpoint of a ball, unchanged."""
    if isinstance(x, arb):
        mantissa, exponent = x.mid().man_exp()
        return mpf((int(mantissa), int(exponent)))
    return mpf(x)


@dataclass(frozen=True)
class Discrete:
    """L_d of a tableau (A, b).

    Attributes:
        lagrangian: d degrees of freedom.
        stages: for each stage that counts its term, its weight, and the increment of (Q, V) over
            (q_0, 0) as a matrix on all V, shape (2d, n).
        rows: the increment q_1 − q_0 as a matrix on all V, shape (d, n).
    """

    lagrangian: Lagrangian
    stages: tuple[tuple[int, mpf, Any], ...]
    rows: Any

    def extremum(self, q0: Any, q1: Any) -> tuple[mpf, Any, Any]:
        """L_d, ∂L_d/∂q_0 and ∂L_d/∂q_1.

        With S(V, q_0) the sum, L_d = S + λ·(q_0 + h Σ b V − q_1) is stationary in V and λ, so its
        derivatives are those with V and λ held fixed.
        """
        d, n = self.rows.shape
        h, rows = rational(H), self.rows
        multiplier = np.array([mpf(0)] * d, object)
        V = np.tile((q1 - q0) / sum(rows[0]), n // d)
        small = False
        for _ in range(40):
            value, force = mpf(0), np.array([mpf(0)] * d, object)
            residual = np.concatenate([rows.T @ multiplier, q0 - q1 + rows @ V])
            matrix = np.full((n + d, n + d), mpf(0), object)
            matrix[:n, n:], matrix[n:, :n] = rows.T, rows
            for term, b, J in self.stages:
                at = J @ V
                at[:d] += q0
                L, slope, curvature = (
                    np.array(x, object) for x in self.lagrangian.derivatives[term](*at)
                )
                value += h * b * L[()]
                force += slope[:d] * (h * b)
                residual[:n] += (J.T @ slope) * (h * b)
                matrix[:n, :n] += (J.T @ curvature @ J) * (h * b)
            if small:
                return value, force + multiplier, -multiplier
            change = np.array(
                list(mpmath.lu_solve(mpmath.matrix(matrix.tolist()), list(residual))), object
            )
            V, multiplier = V - change[:n], multiplier - change[n:]
            small = max(abs(change)) < mpf(10) ** (2 - DIGITS // 2)  # its square is what is left
        raise AssertionError("no extremum")


def rational(x: fmpq) -> mpf:
    """A rational number as mpmath's."""
    return mpf(int(x.p)) / int(x.q)


def discrete(tableau: Tableau, L: Lagrangian) -> Discrete:
    """L_d from the entries of ``tableau``."""
    entries, d, h = (numeric_entries(tableau, DIGITS + 10), len(L.variables), rational(H))
    sizes = [len(entries.b[m]) for m in L.moving]
    unit = np.array([[mpf(int(i == j)) for j in range(d)] for i in range(d)], object)

    def spread(row: Sequence[Any]) -> Any:
        """A row of n coefficients as a matrix on V, shape (d, n d)."""
        return np.hstack([unit * x for x in row])

    stages = []
    for l, weights in enumerate(entries.b):
        for i, b in enumerate(weights):
            positions = [
                h * number(a) for m in L.moving for a in seen(entries.A[l][m], i, len(entries.b[m]))
            ]
            velocities = [
                mpf(int((m, j) == (l, i)))
                for m, s in zip(L.moving, sizes, strict=True)
                for j in range(s)
            ]
            stages.append((l, number(b), np.vstack([spread(positions), spread(velocities)])))
    return Discrete(
        L, tuple(stages), spread([h * number(b) for m in L.moving for b in entries.b[m]])
    )


def seen(block: Any, i: int, stages: int) -> Sequence[Any]:
    """A row of a block; zeros where there is none."""
    return block[i] if block is not None else [0.0] * stages


@pytest.fixture(autouse=True)
def _many_digits() -> Iterator[None]:
    with mpmath.workdps(DIGITS):
        yield


def size(x: Any) -> float:
    """The largest entry."""
    return float(max(abs(x)))


def imbalances(case: Case, path: Sequence[Any]) -> tuple[float, float]:
    """The largest D_2 L_d(q_{k−1}, q_k) + D_1 L_d(q_k, q_{k+1}), and the largest misses of the
    momenta.
    """
    made = discrete(case.tableau, case.lagrangian)
    slopes = [made.extremum(now[0], then[0])[1:] for now, then in pairwise(path)]
    stationarity = [size(before[1] + after[0]) for before, after in pairwise(slopes)]
    momenta = [
        max(size(before + now[1]), size(after - then[1]))
        for (before, after), (now, then) in zip(slopes, pairwise(path), strict=True)
    ]
    return max(stationarity), max(momenta)


@in_whole
@pytest.mark.parametrize(
    ("name", "digits"),
    [*((name, MANY) for name in sample([*CASES], 4)), *((name, FLOAT_DIGITS) for name in SOME)],
)
def test_trajectory_makes_the_discrete_action_stationary(name: str, digits: int) -> None:
    """The discrete Euler–Lagrange equations and both discrete Legendre transforms, to round-off."""
    case = CASES[name]
    assert max(imbalances(case, case.path(digits, 2))) < TOLERANCES[digits]


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=in_whole) if x == "plane" else x for x in SOME]
)
def test_derivatives_are_those_of_the_discrete_lagrangian(name: str) -> None:
    """Central differences of L_d, and of the action as the position between two steps moves: it
    does not change.
    """
    case = CASES[name]
    made, (q0, q1, q2) = (
        discrete(case.tableau, case.lagrangian),
        (y[0] for y in case.path(MANY, 2)),
    )
    _, before, after = made.extremum(q0, q1)
    tiny = mpf(10) ** -12
    for k in range(len(q0)):
        shift = np.array([tiny * int(i == k) for i in range(len(q0))], object)

        def slope(action: Callable[[Any], mpf], shift: Any = shift) -> mpf:
            return (action(shift) - action(-shift)) / (2 * tiny)

        assert abs(slope(lambda z: made.extremum(q0 + z, q1)[0]) - before[k]) < 1e-20
        assert abs(slope(lambda z: made.extremum(q0, q1 + z)[0]) - after[k]) < 1e-20
        assert (
            abs(slope(lambda z: made.extremum(q0, q1 + z)[0] + made.extremum(q1 + z, q2)[0]))
            < 1e-20
        )
        assert min(abs(before[k]), abs(after[k])) > 1e-3


def test_discrete_lagrangians_known_in_closed_form() -> None:
    """Implicit midpoint: h L((q_0 + q_1)/2, (q_1 − q_0)/h); Störmer–Verlet: the mean of both ends'
    potentials.
    """
    h, q0, q1 = (rational(H), np.array([mpf("0.4")], object), np.array([mpf("0.43")], object))
    one, separable = lagrangian("one", 1), lagrangian("separable", 1)
    velocity = (q1[0] - q0[0]) / h
    midpoint, *_ = discrete(gark(methods(("gauss", 1)), {}), one).extremum(q0, q1)
    assert abs(midpoint - h * one.derivatives[0]((q0[0] + q1[0]) / 2, velocity)[0]) < 1e-45
    trapezoidal = built(collocation, methods(("gauss", 1), ("lobatto-iiia", 2)))
    verlet, *_ = discrete(trapezoidal, separable).extremum(q0, q1)
    potential = sum(separable.derivatives[1](q[0], velocity)[0] for q in (q0, q1)) / 2
    assert abs(verlet - h * (separable.derivatives[0](q0[0], velocity)[0] + potential)) < 1e-45


FRACTIONS = st.builds(fmpq, st.integers(-6, 6), st.integers(6, 9))


@st.composite
def tableaux(draw: st.DrawFn) -> Tableau:
    """Any blocks, any nonzero weights whose sums are not small, for one to three terms of one to
    three stages.
    """
    sizes = draw(st.lists(st.integers(1, 3), min_size=1, max_size=3))

    def row(length: int, entries: st.SearchStrategy[fmpq] = FRACTIONS) -> tuple[fmpq, ...]:
        return tuple(draw(entries) for _ in range(length))

    b = [row(s, FRACTIONS.filter(bool)) for s in sizes]
    b = [
        (*weights[1:], weights[0] + (0 if sum(weights) > fmpq(1, 2) else 1 - sum(weights)))
        for weights in b
    ]
    blocks = [[tuple(row(t) for _ in range(s)) for t in sizes] for s in sizes]
    assume(all(map(all, b)))
    return spelled_out(blocks, b, [None] * len(sizes))


@in_whole
@given(tableaux())
@settings(max_examples=at_most(8, 25))
def test_any_tableau_has_a_variational_pair(tableau: Tableau) -> None:
    """Not a matter of order or consistency: random blocks and weights, to round-off."""
    case = Case(tableau, (("one", "two", "three")[tableau.size - 1], 1))
    assert max(imbalances(case, case.path(MANY, 2))) < TOLERANCES[MANY]


@in_whole
@pytest.mark.parametrize("name", SOME)
@pytest.mark.parametrize(
    ("digits", "error"), [(FLOAT_DIGITS, fmpq(1, 10**4)), (MANY, fmpq(1, 10**20))]
)
def test_perturbed_conjugate_is_not_variational(name: str, digits: int, error: fmpq) -> None:
    """One coefficient of Â off by 1e-4, or by 1e-20 in balls: the equations are missed by a part of
    that.
    """
    case = CASES[name]
    right = case.pair
    where = next(key for key in right.blocks if right.colours[key[1]].part == "p")
    first, *rest = right.blocks[where]
    wrong = replace(right, blocks={**right.blocks, where: ((first[0] + error, *first[1:]), *rest)})
    found = imbalances(case, case.path(digits, tableau=wrong))
    assert min(found) > 1e-4 * float(rational(error)) > 100 * TOLERANCES[digits]


@pytest.mark.parametrize("name", ["one method", "collocation", "three terms", "plane"])
def test_gark_method_is_not_variational(name: str) -> None:
    """The same method for positions and momenta, without its conjugate."""
    case = CASES[name]
    found = imbalances(case, case.path(MANY, tableau=case.tableau))
    assert min(found) > 1e-11


def test_other_tableau_is_not_variational() -> None:
    """The pair by collocation does not make the action by interpolation stationary."""
    case = CASES["collocation"]
    found = imbalances(
        dataclasses.replace(case, tableau=CASES["interpolation"].tableau), case.path(MANY)
    )
    assert min(found) > 1e-11
