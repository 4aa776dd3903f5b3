"""Algebraic stability and the SSP coefficient: the classical values, and a second way."""

from __future__ import annotations

import numpy as np
import pytest
from flint import ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import load, loads
from garkcli.stability.algebraic import algebraic_stability, is_positive_semidefinite
from garkcli.stability.ssp import ssp_coefficient
from garkcli.stability.within import ssp_within
from garkcli.tableau.forms import gark
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau
from tests.oracles.draws import fractions
from tests.whole import at_most

SSP_10_4 = (
    "methods: [{A: ["
    + ", ".join(
        str([*(["1/6"] * i), *(["0"] * (10 - i))])
        if i < 5
        else str([*(["1/15"] * 5), *(["1/6"] * (i - 5)), *(["0"] * (10 - i))])
        for i in range(10)
    )
    + "], b: ["
    + ", ".join(["1/10"] * 10)
    + "]}]"
)
SHU_OSHER = "methods: [{A: [[0,0,0],[1,0,0],[1/4,1/4,0]], b: [1/6,1/6,2/3]}]"
SSP_4_3 = (
    "methods: [{A: [[0,0,0,0],[1/2,0,0,0],[1/2,1/2,0,0],[1/6,1/6,1/6,0]], b: [1/6,1/6,1/6,1/2]}]"
)
SSP_3_2 = "methods: [{A: [[0,0,0],[1/2,0,0],[1/2,1/2,0]], b: [1/3,1/3,1/3]}]"


@pytest.mark.parametrize("stages", range(2, 6))
@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("gauss", True),
        ("radau-ia", True),
        ("radau-iia", True),
        ("lobatto-iiia", False),
        ("lobatto-iiib", False),
        ("lobatto-iiic", True),
    ],
)
def test_the_classical_families(name: str, expected: bool, stages: int) -> None:
    """Burrage and Butcher (1979); Hairer, Wanner, section IV.12."""
    found = algebraic_stability(gark([diagonal_method(name, stages)], {}))
    assert found is not None
    assert found.holds == expected


@given(st.integers(1, 4), st.data())
def test_semidefinite_against_eigenvalues(n: int, data: st.DataObject) -> None:
    """Gram matrices are; with one taken off the smallest eigenvalue, they are not."""
    entries = st.lists(st.integers(-3, 3), min_size=n, max_size=n)
    rows = [data.draw(entries) for _ in range(data.draw(st.integers(1, n)))]
    gram = np.array(rows).T @ np.array(rows)
    exact = tuple(tuple(fmpq(int(x)) for x in row) for row in gram)
    assert is_positive_semidefinite(exact)
    lowest = float(np.min(np.linalg.eigvalsh(gram)))
    less = fmpq(int(np.floor(lowest + 0.5)) + 1)
    shifted = tuple(
        tuple(x - less if i == j else x for j, x in enumerate(row)) for i, row in enumerate(exact)
    )
    assert not is_positive_semidefinite(shifted)


def test_the_pair_of_a_gark_method() -> None:
    """Gauss 2 twice with symplectic coupling is algebraically stable: M is zero."""
    tableau = loads(
        "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 2}]\ntransfer: collocation"
    ).tableau
    found = algebraic_stability(tableau)
    assert found is not None
    assert found.holds
    other = algebraic_stability(load("methods/collocation.gark.yaml").tableau)
    assert other is not None
    assert not other.holds


@pytest.mark.parametrize(
    ("text", "expected"),
    [(SHU_OSHER, 1), (SSP_3_2, 2), (SSP_4_3, 2), (SSP_10_4, 6)],
    ids=["SSP(3,3)", "SSP(3,2)", "SSP(4,3)", "SSP(10,4)"],
)
def test_optimal_ssp_methods(text: str, expected: int) -> None:
    """S. Gottlieb, D. Ketcheson, C.-W. Shu (2011), chapter 6."""
    found = ssp_coefficient(loads(text).tableau)
    assert found is not None
    assert found.value is not None
    assert found.value.exact == expected


@pytest.mark.parametrize(
    ("name", "stages", "expected"),
    [
        ("explicit-euler", None, 1),
        ("heun", None, 1),
        ("rk4", None, 0),
        ("gauss", 1, 2),
        ("gauss", 2, 0),
    ],
)
def test_classical_methods(name: str, stages: int | None, expected: int) -> None:
    """Kraaijevanger (1991)."""
    found = ssp_coefficient(gark([diagonal_method(name, stages)], {}))
    assert found is not None
    assert found.value is not None
    assert found.value.exact == expected


def test_backward_euler_has_no_limit() -> None:
    """It is contractive for every step size."""
    found = ssp_coefficient(gark([diagonal_method("radau-iia", 1)], {}))
    assert found is not None
    assert found.value is None


@st.composite
def explicit(draw: st.DrawFn) -> Tableau:
    """Random explicit methods with entries that are not negative."""
    s = draw(st.integers(1, 4))
    entry = fractions(0, 1, 6)
    A = [[str(draw(entry)) if j < i else "0" for j in range(s)] for i in range(s)]
    b = [str(draw(entry)) for _ in range(s)]
    return loads(f"methods: [{{A: {A}, b: {b}}}]").tableau


@settings(max_examples=at_most(12, 300))
@given(explicit())
def test_the_conditions_by_floating_point(tableau: Tableau) -> None:
    """A little below the radius all entries are positive, a little above one is not."""
    found = ssp_coefficient(tableau)
    assert found is not None
    exact = in_points(tableau)
    assert exact is not None
    A = exact.block(0, 0)
    assert A is not None
    s = len(A)
    K = np.zeros((s + 1, s + 1))
    K[:s, :s] = [[float(x) for x in row] for row in A]
    K[s, :s] = [float(x) for x in exact.colours[0].b]

    def smallest(r: float) -> float:
        inverse = np.linalg.inv(np.eye(s + 1) + r * K)
        return float(min((K @ inverse).min(), (inverse @ np.ones(s + 1)).min()))

    radius = 5.0 if found.value is None else float(found.value.ball(64))
    if radius > 0.01:
        assert smallest(radius * 0.999) >= -1e-9
    if found.value is not None:
        assert min(smallest(radius + t) for t in (1e-3, 1e-2, 0.1, 0.5, 1.0)) < 0


ALONE = """
tableau:
  A: [[[[0, 0], [1, 0]], [[0], [1]]], [[[3/4, -1/4]], [[1/2]]]]
  b: [[1/2, 1/2], [1]]
"""


@pytest.mark.parametrize("transfer", ["collocation", "interpolation"])
@pytest.mark.parametrize(
    "names", [("ssp2", "radau-iia"), ("ssp2", "gauss"), ("radau-iia", "ssp2"), ("heun", "ssp2")]
)
def test_a_colour_alone_is_its_diagonal_method(names: tuple[str, str], transfer: str) -> None:
    """Rows of stages at which other colours are evaluated ask for nothing: each colour alone has
    the coefficient of its diagonal method, whatever couples them, exactly and within a tolerance.
    """
    stages = {"ssp2": 3, "radau-iia": 1, "gauss": 1, "heun": None}
    members = ", ".join(
        f"{{family: {x}{f', stages: {stages[x]}' if stages[x] else ''}}}" for x in names
    )
    tableau = loads(f"methods: [{members}]\ntransfer: {transfer}").tableau
    for l, name in enumerate(names):
        shares = [fmpq(int(l == m)) for m in range(2)]
        alone = ssp_coefficient(gark([diagonal_method(name, stages[name])], {}))
        assert ssp_coefficient(tableau, shares) == alone
        assert alone is not None
        points = in_points(tableau)
        assert points is not None
        with ctx.workprec(400):
            near = ssp_within(points, shares, fmpq(1, 10**60))
        exact = alone.value and alone.value.exact
        assert (exact is None) == (near.high is None)
        assert exact is None or near.low <= exact <= near.high


def test_a_colour_alone_with_negative_entries_in_rows_of_the_other() -> None:
    """Heun's method beside the midpoint: 1 and 2."""
    tableau = loads(ALONE).tableau
    found = [
        ssp_coefficient(tableau, shares) for shares in ([fmpq(1), fmpq(0)], [fmpq(0), fmpq(1)])
    ]
    assert [x.value.exact for x in found if x and x.value] == [1, 2]
