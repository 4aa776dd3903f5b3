"""A script as people write it, with what they have at hand: mypy checks it with the package, and a
test runs it.
"""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import sympy
from flint import fmpq, fmpz

import garkcli
from garkcli import (
    Oscillator,
    all_conditions,
    analyse,
    compare,
    conditions,
    conjugate,
    converge,
    count_trees,
    diagonal_method,
    elementary_weight,
    export,
    find_order,
    find_property,
    find_stability,
    from_arrays,
    gark,
    integrate,
    load,
    loads,
    long_run,
    pair,
    problem,
    simplifying,
    symplectic_pair,
)

FAMILY = "parameters: {a: 1/2}\nA: [[a]]\nb: [1]"


def orders() -> list[int]:
    """Of whatever stands for a method, within tolerances of every kind."""
    heun = ([[0, 0], [1, 0]], [0.5, "1/2"])
    arrays = from_arrays(np.array([[0, 0], [1, 0]]), np.array([0.5, 0.5]), name="Heun")
    for tolerance in (0, 1e-9, "1e-9", Fraction(1, 10**9), Decimal("1e-9")):
        assert find_order(arrays, tolerance=tolerance).order == 2
    assert find_order(arrays, tolerance=fmpq(1, 10**9)).order == 2
    assert analyse("gauss-2", limit=6).order.order == 4
    methods = (arrays, heun, "heun", Path("methods/interpolation.gark.yaml"))
    return [find_order(method).order for method in methods]


def parameters() -> set[str]:
    """One coefficient in numbers of every kind."""
    quarter = (
        "1/4",
        0.25,
        Fraction(1, 4),
        Decimal("0.25"),
        fmpq(1, 4),
        np.float32(0.25),
        np.float64(0.25),
        sympy.Rational(1, 4),
    )
    made = [loads(FAMILY, settings={"a": x}) for x in quarter]
    whole = [
        diagonal_method("gauss", stages) for stages in (1, np.int64(1), fmpz(1), sympy.Integer(1))
    ]
    assert {str(method.A) for method in whole} == {"((1/2,),)"}
    return {str(method.A) for method in made}


def runs() -> None:
    """On problems by name and as values, with steps of every kind."""
    steps = (0.5, "1/4", Fraction(1, 8))
    found = converge("rk4", "pendulum", t_end=2, steps=steps)
    assert found.verdict == "agree"
    spring = Oscillator(Fraction(1, 2), [(1, 1)])
    assert long_run(pair("gauss-1"), spring, 20, 0.1).steps == 200
    made = garkcli.bind("rk4", problem("pendulum", terms=np.int64(1))).at()
    assert len(integrate(made, 0.1, 3)) == 2


def conditions_and_blocks() -> None:
    """Trees as texts, colours from 1."""
    rk4 = load("rk4")
    assert elementary_weight(rk4, "[[[]]]") == fmpq(1, 6)
    assert all(x.holds for x in conditions("rk4", ["[[],[]]"]))
    assert len(list(all_conditions("rk4", 4))) == count_trees(4)
    assert simplifying("gauss-2").B == (4,)
    both = gark(["gauss-1", "gauss-1"], {(1, 2): [["1/2"]], (2, 1): [[0.5]]})
    assert both.A[1, 2] == ((fmpq(1, 2),),)
    assert symplectic_pair(both, [1], [1, 2]).stages == (1, 1, 1)
    assert compare(conjugate("gauss-2"), "gauss-2").sameness is not None
    assert find_property("gauss-2", "stage-order").value == 2
    assert find_stability("gauss-2", tolerance=0.0).linear[0].a_stable
    assert export("rk4", "csv", digits=np.int64(12))
