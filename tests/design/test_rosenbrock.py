"""Rosenbrock methods with unknowns: what the literature says of their parameters, and power series
that know neither trees nor gark.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq

from garkcli import load, loads, loads_family, search_methods
from garkcli.api.design import found_methods, minimise, stable_values
from garkcli.check.claims import verify
from garkcli.check.rosenbrock import RosenbrockAnalysis, analyse_rosenbrock
from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.design.design import Design, find_parameters
from garkcli.design.minimise.squared_error import squared_error
from garkcli.errors import GarkError, MethodError
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.shapes import layout_of
from garkcli.order.conditions import all_conditions
from tests.oracles import dae_series
from tests.oracles import rosenbrock_series as series
from tests.whole import in_whole

TWO = "unknown: {stages: 2, shape: rosenbrock, embedded: true}\n"
THREE = "unknown: {stages: 3, shape: rosenbrock}\n"
ROS2 = """parameters: {g: free}
rosenbrock: {alpha: [[0, 0], [1, 0]], gamma: [[g, 0], [-2*g, g]], b: [1/2, 1/2]}
"""


def design(text: str, order: int | None = None) -> Design:
    family = loads_family(text)
    return find_parameters(family, order or family.order)


def only(found: Design) -> dict[str, Number]:
    """The values of the one solution that is taken."""
    [one] = [x for x in found.last.found if x.accepted]
    return dict(one.solution.values)


def ends(found: Design) -> list[str]:
    """The stable values of gamma, which are single ones."""
    [values] = found.last.known.stable
    assert values.names == ("gamma",)
    assert all(x.is_point for x in values.found)
    return [f"{float(x.start.ball(64).mid()):.10f}" for x in values.found if x.start]


def analysis(method: MethodFile) -> RosenbrockAnalysis:
    return analyse_rosenbrock(method.tableau, 6, None, method.further)


def oracle(method: MethodFile) -> series.Method:
    """A method of rational numbers, for the series."""

    def numbers(x: Any) -> Any:
        return Fraction(str(x)) if isinstance(x, fmpq) else [*map(numbers, x)]

    found = Rosenbrock.of(method.tableau)
    return series.Method(*map(numbers, (found.alpha, found.gamma, found.b)))


def test_two_stages_of_order_2() -> None:
    """Of order 2 for every γ, L-stable for γ = 1 ± √2/2 (J. Verwer et al., SIAM J. Sci. Comput. 20
    (1999) 1456: ROS2); with any matrix too exactly if b₂ γ₂₁ = −γ, of which order 2 alone has all.
    """
    two = TWO + "design: {order: 2, fix: {c2: 1, bh1: 1}, embedded-order: 1, l-stable: true%s}"
    with_jacobian, with_any = design(two % ""), design(two % ", w-order: 2")
    assert ends(with_jacobian) == ends(with_any) == ["0.2928932188", "1.7071067812"]
    ring = with_any.family.ring
    names = dict(zip(ring.names, ring.context.gens(), strict=True))
    w_condition = names["b2"] * (names["d2"] - names["gamma"]) + names["gamma"]
    for found, holds in ((with_jacobian, False), (with_any, True)):
        assert found.last.ideal.contains(w_condition) is holds  # type: ignore[union-attr]


def test_two_stages_of_order_3() -> None:
    """Exactly for γ = (3 ± √3)/6, the zeros of 6γ² − 6γ + 1; order 4 for none (HW IV.7: of s stages
    with one γ the orders are s + 1 at most).
    """
    found = design("unknown: {stages: 2, shape: rosenbrock}\n")
    assert [step.kind for step in found.steps] == ["family", "family", "family", "none"]
    assert "6*gamma^2 - 6*gamma + 1" in map(str, found.steps[2].polynomials)


def test_three_stages_with_ros3p_among_them() -> None:
    """With α₂₁ = α₃₁ = 1, α₃₂ = 0 order 3 is A-stable for exactly 1/3 ≤ γ ≤ 1.0685790… (HW table
    IV.6.3), and with R(∞) = 1 − √3 and d of J. Lang, J. Verwer, BIT 41 (2001) 731, it is ROS3P.
    """
    text = THREE + "design: {order: 3, fix: {c2: 1, c3: 1, alpha32: 0%s}%s}"
    [values] = design(text % ("", ", a-stable: true")).last.known.stable
    [interval] = values.found
    assert interval.start is not None
    assert interval.end is not None
    assert interval.start.exact == fmpq(1, 3)
    assert f"{float(interval.end.ball(64).mid()):.10f}" == "1.0685790213"
    fix = ", d2: gamma - 1, d3: 1/2 - 2*gamma, gamma32: 1/2 - 2*gamma"
    found = design(text % (fix, ", R-infinity: 1 - sqrt(3), a-stable: true"))
    [ros3p] = found_methods(found)
    published = Rosenbrock.of(load("ros3p").tableau)
    assert Rosenbrock.of(ros3p.tableau) == published


@pytest.mark.parametrize(
    ("want", "which"), [("w-order: 2", "any"), ("old-jacobian-order: 3", "old")]
)
def test_found_methods_have_their_orders(want: str, which: series.Which) -> None:
    """Three stages of order 3 with a rational γ: the certificate and power series find the orders
    that are wanted, and no further one.
    """
    text = THREE + f"design: {{order: 3, {want}, fix: {{gamma: 1/2, c2: 1/2}}}}"
    family = loads_family(text)
    found = search_methods(family, 3, starts=4, most=1)
    [method] = found_methods(found, family)
    result = analysis(method)
    orders = (result.order.order, result.w_order.order, result.old_jacobian_order.order)
    by_series = tuple(series.order(oracle(method), x, 5) for x in ("exact", "any", "old"))
    assert orders == by_series
    assert orders[0] == 3
    assert series.order(oracle(method), which, 5) == int(want[-1])
    assert all(claim.holds for claim in verify(method.claims, result))


def test_index_1() -> None:
    """Order 3 on DAEs of index 1: the series of dae_series agree; those of a method with order 3
    alone do not.
    """
    fix = "fix: {gamma: 3/4, c2: 1, c3: 1/2}"
    found = []
    for want in ("index-1-order: 3, ", ""):
        family = loads_family(f"{THREE}design: {{order: 3, {want}{fix}}}")
        [method] = found_methods(search_methods(family, 3, starts=4, most=1), family)
        one = oracle(method)
        y, z = dae_series.orders(one.alpha[0][0], one.gamma[0][0], one.b[0], 4)
        order = analysis(method).index_1_order
        assert order is not None
        assert order.order == min(y, z + 1)
        found.append(order.order)
    assert found == [3, 2]


@in_whole
def test_l_stable_order_4() -> None:
    """Four stages of order 4, of order 2 with any matrix, and with R(∞) = 0, which a search takes
    for an equation: γ is a zero of 24γ⁴ − 96γ³ + 72γ² − 16γ + 1, and the L-stable methods are those
    with 0.57281606… (HW table IV.6.4).
    """
    text = (
        "unknown: {stages: 4, shape: rosenbrock}\ndesign: {order: 4, w-order: 2, l-stable: true}\n"
    )
    family = loads_family(text)
    found = search_methods(family, 4, starts=5, most=1)
    [method] = found_methods(found, family)
    gamma: Any = Rosenbrock.of(method.tableau).diagonal[0]
    assert 24 * gamma**4 - 96 * gamma**3 + 72 * gamma**2 - 16 * gamma + 1 == 0
    assert f"{float(to_ball(gamma)):.8f}" == "0.57281606"
    result = analysis(method)
    assert (result.order.order, result.w_order.order) == (4, 2)
    assert all(claim.holds for claim in verify(method.claims, result))


def test_a_search_asks_for_damping() -> None:
    """L-stable methods are found though γ must be a zero of 1 − 4γ + 2γ²: R(∞) = 0 is an equation
    of the search. With both of its zeros the method is L-stable.
    """
    text = "unknown: {stages: 2, shape: %s}\ndesign: {order: 2, l-stable: true}\n"
    for shape in ("rosenbrock", "sdirk"):
        found = search_methods(loads_family(text % shape), 2, starts=2, most=2)
        assert found.methods
        assert all(x.is_exact for x in found.methods)


def test_wrong_nodes_of_time() -> None:
    """With c and d unknown too, b·c and b·(c + d) have their conditions for f(t, y) alone."""
    text = """rosenbrock:
  alpha: [[0, 0], [1, 0]]
  gamma: [[1/2, 0], [-1, 1/2]]
  b: [1/2, 1/2]
  c: [0, "?"]
  d: [1/2, "?"]
design: {order: 2%s}
"""
    assert design(text % "").last.kind == "every-value"
    values = only(design(text % ", nonautonomous-order: 2, fix: {c2: 1}"))
    assert values["d2"] == fmpq(-1, 2)


def test_unknown_entries() -> None:
    """``"?"`` is an unknown in α, γ, b, c, d and the embedded weights, named by its place."""
    text = """rosenbrock:
  alpha: [[0, 0], ["?", 0]]
  gamma: [["?", 0], ["?", "?"]]
  b: ["?", "?"]
  c: [0, "?"]
  d: ["?", 0]
  embedded: ["?", 1]
"""
    names = ("alpha21", "gamma11", "gamma21", "gamma22", "b1", "b2", "c2", "d1", "bh1")
    assert sorted(loads_family(text).parameters) == sorted(names)


def test_shapes() -> None:
    """First entries of rows are what c and d leave; a stiffly accurate method has b = e_s β."""
    layout = layout_of(3, ["rosenbrock", "stiffly-accurate"])
    assert layout.unknowns == ("c2", "alpha32", "gamma", "d2", "b1", "b2")
    alpha, gamma = layout.A
    assert (alpha[1][0], gamma[1][0]) == ("c2", "d2 - gamma")
    values = {"b1": "1/5", "b2": "1/7", "gamma": "1/3", "alpha32": "2", "c2": "1", "d2": "1"}
    family = loads("unknown: {stages: 3, shape: [rosenbrock, stiffly-accurate]}", settings=values)
    beta = Rosenbrock.of(family.tableau).on_test_equation.block(0, 0)
    assert beta is not None
    assert [str(x) for x in beta[-1]] == ["1/5", "1/7", "1/3"]


def test_sums_of_squared_errors() -> None:
    """Σ e(u)² by tensors is that over a list of all trees, whose colours are f and f'."""
    tableaus = [load(name).tableau for name in ("rodas3", "ros3p")]
    # the exact solution has no error of the matrix, which counts two orders
    tableaus.append(Rosenbrock.of(tableaus[0]).with_old_jacobian)
    for tableau in tableaus:
        for order in range(1, 6):
            errors = (
                (x.value - x.required) / x.tree.symmetry
                for x in all_conditions(tableau, order)
                for _ in x.trees
            )
            total = squared_error(tableau, order, None)
            listed = sum((e * e for e in errors), start=fmpq(0))  # type: ignore
            assert total.numerator / total.denominator == listed


def test_least_error() -> None:
    """Of the L-stable ones of ROS2 the smaller γ has the least error, and the file says so."""
    text = TWO + (
        "design: {order: 2, w-order: 2, embedded-order: 1, index-1-order: 2, fix: {c2: 1, bh1: 1},"
        " l-stable: true}"
    )
    found = minimise(loads_family(text), "error")
    [method] = found_methods(found)
    claims = verify(method.claims, analysis(method))
    keys = ["order", "embedded-order", "w-order", "index-1-order", "l-stable"]
    assert [claim.key for claim in method.claims] == keys
    assert all(claim.holds for claim in claims)


def test_stable_values() -> None:
    """Of one parameter alone, as for the Runge–Kutta method with A = β."""
    runge_kutta = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
    for kind in ("a-stable", "l-stable"):
        found, same = (stable_values(loads_family(x), kind) for x in (ROS2, runge_kutta))
        assert found.found == same.found != ()  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ("symplectic: true", "symplectic is not for Rosenbrock methods"),
        ("stage-order: 1", "stage-order is not for Rosenbrock methods"),
        ("embedded-w-order: 1", "embedded-w-order needs embedded weights"),
    ],
)
def test_wants_without_meaning(wanted: str, message: str) -> None:
    """Demands that are not for Rosenbrock methods are refused, with its place."""
    with pytest.raises(GarkError, match=message):
        loads_family(f"{THREE}design: {{{wanted}}}")


def test_refused() -> None:
    """Wants of Rosenbrock methods for others; pairs, SSP and coefficients of Rosenbrock methods."""
    with pytest.raises(GarkError, match="w-order is for Rosenbrock methods"):
        loads_family("unknown: {stages: 2, shape: sdirk}\ndesign: {w-order: 2}")
    with pytest.raises(GarkError, match="dirk does not go with rosenbrock"):
        layout_of(2, ["rosenbrock", "dirk"])
    with pytest.raises(GarkError, match="asks for a last node 1"):
        layout_of(1, ["rosenbrock", "stiffly-accurate"])
    family = loads_family("unknown: {stages: 2, shape: rosenbrock}")
    with pytest.raises(MethodError, match="for GARK methods"):
        find_parameters(family, 2, "pair")
    for objective in ("-ssp", "coefficients", "-oscillator-interval"):
        with pytest.raises(MethodError, match="for GARK methods"):
            minimise(loads_family(ROS2), objective)
