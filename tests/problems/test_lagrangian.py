"""The Legendre transform: exact identities for quadratic Lagrangians, tested solutions of others,
and refusals.
"""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import example, given, settings
from hypothesis import strategies as st
from sympy import Rational, cos, cosh, exp, log, sin, sqrt

from garkcli.errors import NoLegendreTransform
from garkcli.problems.lagrangian import initial_momenta, legendre_transform, missing_derivative
from garkcli.problems.mass import enclosed, velocities
from garkcli.problems.solving import solutions
from garkcli.problems.vectorfield import symbols
from tests.whole import in_whole

LETTERS = ("x", "y", "z")
SMALL = st.integers(-3, 3)


def names(d: int) -> tuple[tuple[str, ...], Any, Any, Any]:
    """The first d variables and their symbols q, v, p."""
    variables = LETTERS[:d]
    return (variables, symbols(variables, "q"), velocities(variables), symbols(variables, "p"))


def balls(values: dict[Any, Any]) -> dict[Any, arb]:
    """Values as enclosures."""
    with ctx.workprec(300):
        return {x: arb(fmpq(int(y.p), int(y.q))) for x, y in values.items()}


@st.composite
def lagrangians(draw: st.DrawFn) -> tuple[int, Any, dict[Any, Any], dict[Any, Any]]:
    """L = ½ v·M(q)v + b(q)·v − V(q) with polynomials of q, and rational q and v."""
    d = draw(st.integers(1, 3))
    _, q, v, _ = names(d)

    def polynomial() -> Any:
        square = draw(st.sampled_from(q)) * draw(st.sampled_from(q))
        return sum(draw(SMALL) * term for term in (1, *q, square)) / 4

    M = [
        [polynomial() if draw(st.booleans()) else sympy.Integer(draw(SMALL)) for _ in v] for _ in v
    ]
    T = sum((M[min(i, j)][max(i, j)]) * v[i] * v[j] for i in range(d) for j in range(d)) / 2
    T += sum(draw(st.integers(1, 5)) * x**2 for x in v)
    L = T + sum(polynomial() * x for x in v) - polynomial()
    values = [Rational(draw(st.integers(-20, 20)), draw(st.integers(1, 9))) for _ in range(2 * d)]
    return (d, L, dict(zip(q, values[:d], strict=True)), dict(zip(v, values[d:], strict=True)))


@in_whole
@settings(max_examples=4)
@example((1, sympy.Integer(0), *({s[0]: Rational(0)} for s in names(1)[1:3])))
@given(lagrangians())
def test_quadratic_lagrangians_are_transformed_exactly(
    given_: tuple[int, Any, dict[Any, Any], dict[Any, Any]],
) -> None:
    """At p = ∂L/∂v: ∂H/∂p = v, H + L = p·v and ∂H/∂q = −∂L/∂q, as rational numbers."""
    d, L, q, v = given_
    variables, _, v_symbols, p_symbols = names(d)
    if not L.free_symbols.intersection(v_symbols):  # a term of the potential
        assert legendre_transform(L, variables, balls(q)) == -L
        return
    hessian = sympy.Matrix([[L.diff(a, b).xreplace(q) for a in v] for b in v])
    if hessian.det() == 0:
        with pytest.raises(NoLegendreTransform, match="singular"):
            legendre_transform(L, variables, balls(q))
        return
    H = legendre_transform(L, variables, balls(q))
    p = {x: L.diff(y).xreplace({**q, **v}) for x, y in zip(p_symbols, v, strict=True)}
    at = {**q, **p}
    assert [H.diff(x).xreplace(at) for x in p] == list(v.values())
    assert H.xreplace(at) + L.xreplace({**q, **v}) == sum(
        a * b for a, b in zip(p.values(), v.values(), strict=True)
    )
    assert all(H.diff(x).xreplace(at) == -L.diff(x).xreplace({**q, **v}) for x in q)


@in_whole
@pytest.mark.parametrize("coupled", [3, 4])
def test_chains_of_pendulums(coupled: int) -> None:
    """Mass matrices with cosines of differences: the identities hold in balls of 80 digits."""
    variables = tuple("abcde"[:coupled])
    q, v, p = (symbols(variables, "q"), velocities(variables), symbols(variables, "p"))
    L = sum(
        (coupled - max(i, j)) * cos(q[i] - q[j]) * v[i] * v[j] / 2
        for i in range(coupled)
        for j in range(coupled)
    ) + sum(cos(x) for x in q)
    start = {x: Rational(k, 7) for k, x in enumerate((*q, *v), 1)}
    H = legendre_transform(L, variables, {x: y for x, y in balls(start).items() if x in q})
    at = balls(start)
    momenta = dict(zip(p, enclosed([L.diff(x) for x in v], at), strict=True))
    back = enclosed([H.diff(x) for x in p], {**at, **momenta})
    assert all(x.overlaps(at[y]) and x.rad() < 1e-60 for x, y in zip(back, v, strict=True))


(X, Y), (VX, VY), (PX, PY) = (names(2)[k] for k in (1, 2, 3))


@pytest.mark.parametrize(
    ("L", "d"),
    [
        (-sqrt(1 - VX**2) - X**2 / 2, 1),
        (-18 * sqrt(1 - (VX**2 + VY**2) / 9) - X * Y, 2),
        (-2 * sqrt(1 - VX**2 - X**2 * VY**2), 2),
        (-2 * sqrt(1 - VX**2 - VY**2) + sin(Y) * VX - X * VY, 2),
        (-2 * sqrt(1 - VX**2) - 3 * sqrt(1 - VY**2) - X * Y, 2),
        (-2 * sqrt(1 - VX**2) + VY**2 / 2 + X * VY, 2),
        (cosh(VX) + X, 1),
        (X * exp(VX), 1),
        (VX**4 / 4, 1),
        (VX * log(VX) + X**2, 1),
        (VX**3 / 3 + VY**2, 2),
    ],
)
@pytest.mark.parametrize("knows_velocities", [True, False])
def test_other_lagrangians(L: Any, d: int, knows_velocities: bool) -> None:
    """Solved and right: at other places than the solution was tested at, with 60 digits."""
    variables, q, v, p = names(d)
    values = {**dict(zip(q, (Rational(3, 10), Rational(7, 10)), strict=False))}
    values |= dict(zip(v, (Rational(1, 2), Rational(1, 5)), strict=False))
    at = balls(values)
    momenta = dict(zip(p, enclosed([L.diff(x) for x in v], at), strict=True))
    start = at if knows_velocities else {x: y for x, y in (at | momenta).items() if x not in v}
    if not knows_velocities and L.has(VX**3):
        with pytest.raises(NoLegendreTransform, match="several velocities"):
            legendre_transform(L, variables, start)
        return
    H = legendre_transform(L, variables, start)
    assert not H.free_symbols & set(v)
    elsewhere = balls({x: y + Rational(k, 17) for k, (x, y) in enumerate(values.items(), 1)})
    momenta = dict(zip(p, enclosed([L.diff(x) for x in v], elsewhere), strict=True))
    there = {**elsewhere, **momenta}
    back = enclosed([H.diff(x) for x in p], there)
    assert all(x.overlaps(elsewhere[y]) and x.rad() < 1e-60 for x, y in zip(back, v, strict=True))
    sides = enclosed([H + L - sum(a * b for a, b in zip(p, v, strict=True))], there)
    assert sides[0].contains(0)
    assert sides[0].rad() < 1e-60


@pytest.mark.parametrize(
    ("L", "message"),
    [
        (VX**2 / 2 + cos(X), "vy does not occur beside vx"),
        ((VX + VY) ** 2, "the mass matrix of vx, vy is singular"),
        (VX * X + VY, "the mass matrix of vx is singular"),
        (VX**2 * (sin(X) ** 2 + cos(X) ** 2 - 1) + VY**2, "the mass matrix of vx is singular"),
        (X**2 * VX**2 - Rational(9, 100) * VX**2 + VY**2, "the mass matrix of vx is singular"),
        (VX**4 + VX**2 + VY**2, "not solved for vx"),
        (VX**2 * VY**2, "not solved for vx, vy"),
        (VX**6 + VX + VX**5 + VY**2, "not solved for vx"),
    ],
)
def test_what_has_no_transform_is_refused(L: Any, message: str) -> None:
    """Degenerate mass matrices, and what is not solved in closed form."""
    start = balls({X: Rational(3, 10), Y: Rational(7, 10), VX: Rational(1, 2), VY: Rational(1, 5)})
    with pytest.raises(NoLegendreTransform) as caught:
        legendre_transform(L, ("x", "y"), start)
    assert message in caught.value.message
    assert caught.value.help


def test_too_many_coupled_velocities_are_refused() -> None:
    """Six velocities with a mass matrix of the positions; as many with constant masses are no
    trouble.
    """
    variables = tuple(f"x{i}" for i in range(6))
    q, v = symbols(variables, "q"), velocities(variables)
    start = dict.fromkeys(q, arb(0))
    constant = sum((x + y) ** 2 for x in v for y in v)
    assert legendre_transform(constant, variables, start).free_symbols == set(
        symbols(variables, "p")
    )
    with pytest.raises(NoLegendreTransform, match="6 coupled velocities"):
        legendre_transform(constant + cos(q[0]) * v[0] ** 2, variables, start)


def test_terms_have_velocities_of_their_own() -> None:
    """Two terms v²/2 are two Hamiltonians p²/2 with q̇ = 2p; their sum in one term is p²/4 with q̇
    = p/2.
    """
    variables, (x,), (v,), (p,) = names(1)
    start = {x: arb(0)}
    one, other = (legendre_transform(v**2 / 2, variables, start) for _ in range(2))
    assert (one + other).diff(p) == 2 * p
    assert legendre_transform(v**2, variables, start).diff(p) == p / 2
    assert legendre_transform(-cos(x), variables, start) == cos(x)


def test_momenta_of_velocities() -> None:
    """With one moving term ∂L/∂v; with several the p for which all velocities together are q̇."""
    variables, (x,), (v,), (p,) = names(1)
    at = balls({x: Rational(1, 2), v: Rational(3)})
    terms = [v**2 / 2, -cos(x)]
    assert initial_momenta(terms, [p**2 / 2, cos(x)], variables, at)[0].overlaps(arb(3))
    terms = [(1 + x**2) * v**2 / 2 + x * v, v**2]
    H = [legendre_transform(L, variables, at) for L in terms]
    (found,) = initial_momenta(terms, H, variables, at)
    rate = enclosed([sum(H).diff(p)], {x: at[x], p: found})[0]
    assert rate.overlaps(arb(3))
    assert rate.rad() < 1e-60
    with pytest.raises(NoLegendreTransform) as caught:
        initial_momenta(
            [v**2, cosh(v)], [p**2 / 4, legendre_transform(cosh(v), variables, at)], variables, at
        )
    assert "momenta" in caught.value.help


def test_derivatives_at_the_start() -> None:
    """The variable by which there is none."""
    _, (x, y), _, (px, py) = names(2)
    by = (x, y, px, py)
    at = balls({x: Rational(0), y: Rational(1), px: Rational(1), py: Rational(1)})
    assert missing_derivative(y**2 + px**2, by, at) is None
    assert missing_derivative(y**2 + x ** Rational(1, 2), by, at) == (
        "no derivative by x",
        "start elsewhere",
    )
    assert missing_derivative(sqrt(py - 1) + sin(x), by, at) == (
        "no derivative by py",
        "start elsewhere",
    )
    kinks = missing_derivative(sympy.asin(sqrt(1 - 1 / py**2)), by, at)
    assert kinks is not None
    assert "the derivative by py has kinks" in kinks[0]


@pytest.mark.parametrize(
    "outer",
    [
        *(
            sin,
            cos,
            sympy.tan,
            sympy.asin,
            sympy.acos,
            sympy.atan,
            sympy.sinh,
            cosh,
            sympy.tanh,
            exp,
            log,
            sqrt,
        ),
        *(lambda u: u**2, lambda u: 1 / u, lambda u: u**3, lambda u: 2**u, lambda u: u + 1 / u),
        *(lambda u: u / sqrt(1 + u**2), lambda u: u + sqrt(1 + u)),
    ],
)
@pytest.mark.parametrize(("a", "b"), [(Rational(1, 2), 1), (0, 2), (-1, Rational(7, 2))])
def test_scalar_equations(a: Any, b: Any, outer: Any) -> None:
    """One of the candidates for outer(a + b u) = c is 1/3, for the c that 1/3 gives."""
    u = sympy.Symbol("u", real=True)
    found = solutions(outer(a + b * u), u, outer(a + Rational(b) / 3))
    assert any(abs(complex(x) - 1 / 3) < 1e-9 for x in found)


@in_whole
def test_what_is_not_solved() -> None:
    """No candidates: the unknown in two places, too long an equation, no unknown."""
    u, c = sympy.symbols("u c")
    assert solutions(u + sin(u), u, c) == []
    assert solutions(sum(sin(k * u) for k in range(200)), u, c) == []
    assert solutions(c, u, c) == []
    assert solutions(u**5 + u, u, c) == []
    assert Rational(1, 2) in solutions(u**4 + u**2, u, Rational(5, 16))
