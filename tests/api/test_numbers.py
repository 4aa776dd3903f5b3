"""Wherever a number is taken it may be of any kind, and means the same."""

from __future__ import annotations

import inspect
from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import garkcli
from garkcli import (
    MethodError,
    Oscillator,
    bind,
    converge,
    find_order,
    hamiltonian,
    integrate,
    load,
    loads,
    long_run,
    simplifying,
)
from garkcli.exact.given import rational_of
from tests.api import typed_use

MIDPOINT = loads("A: [[1/2]]\nb: [1]")
ROUNDED = loads("A: [[0.499999999]]\nb: [1]")


def eighths() -> dict[str, Any]:
    """1/8 in numbers of every kind."""
    import numpy as np
    import sympy

    return {
        "FLINT": fmpq(1, 8),
        "Fraction": Fraction(1, 8),
        "float": 0.125,
        "Decimal": Decimal("0.125"),
        "text": "1/8",
        "formula": "1/4 - 1/8",
        "NumPy": np.float64(0.125),
        "NumPy's short float": np.float32(0.125),
        "SymPy": sympy.Rational(1, 8),
        "SymPy's expression": sympy.sqrt(4) / 16,
    }


@pytest.mark.parametrize("kind", eighths())
def test_numbers_of_every_kind(kind: str) -> None:
    """Step sizes, times, frequencies, tolerances and parameters."""
    x = eighths()[kind]
    eighth = fmpq(1, 8)
    assert rational_of(x, "x") == eighth
    spring = Oscillator(x, ((1, 1),))
    assert spring == Oscillator(eighth, ((fmpq(1), fmpq(1)),))
    found = converge(MIDPOINT, spring, x, [x])
    assert found.rows[0].h == eighth
    wanted = long_run(MIDPOINT, spring, fmpq(1), eighth)
    found_run = long_run(MIDPOINT, spring, 1, x)
    assert found_run.step == eighth
    assert found_run.times == wanted.times
    assert find_order(ROUNDED, tolerance=x).order >= 2
    assert simplifying(ROUNDED, tolerance=x).B[0] >= 2
    family = "parameters: {a: 1}\nA: [[a]]\nb: [1]"
    made = loads(family, settings={"a": x})
    assert made.A[0][0] == eighth


def test_a_script_as_people_write_it() -> None:
    """Everything that mypy takes in it is taken, and means the same."""
    assert typed_use.orders() == [2, 2, 2, 4]
    assert typed_use.parameters() == {"((1/4,),)"}
    typed_use.runs()
    typed_use.conditions_and_blocks()


def test_steps_of_a_trajectory() -> None:
    """Of whatever kind, a step is the same step."""
    integrator = bind(load("rk4"), hamiltonian("pendulum", 1)).at(15)
    wanted = integrate(integrator, fmpq(1, 8), 3)
    assert integrate(integrator, 0.125, 3) == wanted  # type: ignore[arg-type]


@given(st.fractions(-5, 5, max_denominator=100))
@settings(max_examples=15, deadline=None)
def test_a_fraction_and_its_text_are_one_number(x: Fraction) -> None:
    """And that is the number."""
    found = rational_of(x, "x")
    assert found == fmpq(x.numerator, x.denominator)
    assert rational_of(str(x), "x") == found


@pytest.mark.parametrize(
    ("given_number", "said"),
    [
        (1 / 3, "h: 0.3333333333333333 is a rounded number"),
        ("1/0", "h: division by zero, character 3 of '1/0'"),
        ("1/4 + x", "character 7 of '1/4 + x'"),
        ("sqrt(2)", "h: sqrt(2) is irrational"),
        (True, "h: True is not a number"),
        (1j, "h: 1j of type complex is not an exact real number"),
        (None, "h: None of type NoneType"),
    ],
)
def test_what_is_no_rational_number_is_refused(given_number: Any, said: str) -> None:
    """The error names the argument, the place in a text, and the cure."""
    with pytest.raises(MethodError) as caught:
        rational_of(given_number, "h")
    assert said in str(caught.value)
    assert caught.value.help in str(caught.value)
    assert caught.value.help
    assert "tolerance" not in caught.value.help


def test_a_number_among_many_has_its_place() -> None:
    """In a list and in a mapping."""
    with pytest.raises(MethodError, match=r"^steps\[1\]: "):
        converge(MIDPOINT, steps=["1/8", object()])  # type: ignore[list-item]
    with pytest.raises(MethodError, match=r"^settings\['a'\]: "):
        loads("A: [[0]]\nb: [1]", settings={"a": 1 / 3})  # type: ignore[dict-item]


def test_a_wrong_call_is_said_by_the_function() -> None:
    """What Python says of arguments that are missing or too many stays what it says."""
    with pytest.raises(TypeError, match="long_run"):
        long_run(MIDPOINT)  # type: ignore[call-arg]


def test_help_shows_the_arguments() -> None:
    """A function that takes any number has the signature and the docstring of its own."""
    assert list(inspect.signature(garkcli.load).parameters) == ["path", "settings"]
    assert "Args:" in (inspect.getdoc(garkcli.load) or "")
    assert garkcli.load.__name__ == "load"
