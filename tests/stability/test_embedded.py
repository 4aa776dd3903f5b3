"""Stability with the embedded weights in place of b, against that of the method that has them as b,
and against a step computed by elimination.
"""

from __future__ import annotations

import json
from typing import Any

import pytest
from flint import acb, acb_mat, arb

from garkcli import load, loads
from garkcli.api.anymethod import method_of
from garkcli.api.calls import find_stability
from garkcli.exact.display import to_ball
from garkcli.methodfile.build import MethodFile
from garkcli.tableau.embedded import with_weights
from tests.cli.harness import gark

EXACT = ["dormand-prince-5", "tr-bdf2", "sdirk-2", "heun-euler", "radau-iia"]


def with_embedded(name: str) -> MethodFile:
    """A method of the catalogue, or one of two others."""
    if name == "radau-iia":
        return loads("methods: [{family: radau-iia, stages: 2, embedded: [1/2, 1/2]}]")
    if name == "heun-euler":
        return loads("{A: [[], [1]], b: [1/2, 1/2], embedded: [1, 0]}")
    return load(name)


@pytest.mark.parametrize("name", EXACT)
def test_it_is_that_of_the_method_with_these_weights(name: str) -> None:
    """All that is decided of R̂ is what is decided of a method whose b they are."""
    method = with_embedded(name)
    assert method.embedded is not None
    found = find_stability(method).embedded
    other = method_of(with_weights(method.tableau, method.embedded))
    [alone, *_] = find_stability(other).linear
    assert found is not None
    keys = ("R", "a_stable", "l_stable", "sector", "real", "imaginary")
    assert [getattr(found, x) for x in keys] == [getattr(alone, x) for x in keys]
    assert (found.ssp, found.is_linear_alone) == (None, True)


@pytest.mark.parametrize("name", [*EXACT, "kvaerno-3", "ark-324"])
def test_it_multiplies_y_in_a_step(name: str) -> None:
    """1 + z b̂ᵀ (I − zA)⁻¹ 𝟙 in balls, of all colours with one z."""
    method = with_embedded(name)
    found = find_stability(method).embedded
    assert method.embedded is not None
    assert found is not None
    z = acb(arb("-0.7"), arb("0.4"))
    tableau = method.tableau
    shared = all(x.space == tableau.colours[0].space for x in tableau.colours)
    assert shared
    s = tableau.spaces[0].stages
    total = acb_mat(s, s)
    row = [acb(0)] * s
    for l in range(tableau.size):
        A = tableau.blocks[0, l]
        for i in range(s):
            row[i] += to_ball(method.embedded[l][i])
            for j in range(s):
                total[i, j] += to_ball(A[i][j])
    identity = acb_mat([[int(i == j) for j in range(s)] for i in range(s)])
    stages = (identity - total * z).solve(acb_mat([[1]] * s))
    value = 1 + z * sum((row[i] * stages[i, 0] for i in range(s)), start=acb(0))
    P, Q = (
        sum((to_ball(a) * z**k for k, a in enumerate(p.coefficients)), start=acb(0))
        for p in (found.R.numerator, found.R.denominator)
    )
    assert abs(P / Q - value) < 1e-10


def test_stable_methods_with_embedded_weights_that_are_not() -> None:
    """TR-BDF2's R̂ is unbounded (M. E. Hosea, L. F. Shampine, 1996), those of Kværnø's pair and of
    Rodas are stable too (A. Kværnø, 2004; E. Hairer, G. Wanner, section IV.7); rounded or not.
    """
    said = {}
    for name in ("tr-bdf2", "kvaerno-3", "rodas4", "ros34pw2", "ark-324"):
        found = find_stability(name).embedded
        assert found is not None
        said[name] = found.a_stable, found.l_stable
    assert said == {
        "tr-bdf2": (False, False),
        "kvaerno-3": (True, False),
        "rodas4": (True, True),
        "ros34pw2": (True, False),
        "ark-324": (False, False),
    }


def test_methods_without() -> None:
    """None, nor for conjugates, nor where nothing is linear."""
    assert find_stability("rk4").embedded is None
    assert find_stability(load("sdirk-2").pair).embedded is None


def in_json(name: str) -> Any:
    """What the report says of embedded weights."""
    [report] = json.loads(gark("stability", name, "--format", "json").out)["files"]
    return report["embedded"]


def test_it_is_reported() -> None:
    """Once in words, with its fields in JSON."""
    run = gark("stability", "sdirk-2")
    assert run.out.count("R̂(z) 1 / (-z + 1), R̂(∞) 0, A-stable, L-stable") == 1
    data = in_json("sdirk-2")
    assert data["R"] == {"numerator": "1", "denominator": "-z + 1"}
    assert (data["R_infinity"], data["a_stable"], data["l_stable"]) == ("0", True, True)
    assert in_json("rk4") is None


def test_a_rosenbrock_method_is_no_runge_kutta_method() -> None:
    """Which is why it has no algebraic stability."""
    run = gark("stability", "ros3p")
    assert run.code == 0
    assert "not a Runge-Kutta method" in " ".join(run.out.split())
