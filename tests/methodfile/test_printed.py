"""Digits of coefficients, and parameters that no coefficient uses."""

from __future__ import annotations

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import MethodFileError
from garkcli.exact.expression import parse
from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import printed_units

MIDPOINT = "methods: [{A: [[1/2]], b: [1]}]\n"


def unit(text: str, beside: str = "0.7886751345948129") -> fmpq:
    """By how much a coefficient may be off in a file with a long decimal."""
    pairs = [(parse(text), fmpq(7)), (parse(beside), fmpq(8))]
    return printed_units(pairs)[fmpq(7)]


@pytest.mark.parametrize(
    ("text", "size"),
    [
        ("0.2113248654051871", fmpq(1, 10**16)),
        ("21.13248654051871e-2", fmpq(1, 10**16)),
        ("-0.2113248654051871", fmpq(1, 10**16)),
        ("1/3", fmpq(0)),
        ("0.25", fmpq(0)),
        ("sqrt(3)/6", fmpq(0)),
        ("2*0.2113248654051871", fmpq(2, 10**16)),
        ("1 - 0.2113248654051871", fmpq(1, 10**16)),
        ("1767732205903/4055673282236", fmpq(6, 10**24)),
        ("2*(1767732205903/4055673282236 - 1/2)", fmpq(12, 10**24)),
        ("1/641*1/6701*1/16361", fmpq(0)),
        ("160639443/500000000", fmpq(1, 10**9)),
        ("161/1000000", fmpq(0)),
    ],
)
def test_units_of_the_last_place(text: str, size: fmpq) -> None:
    """Long decimals are off by one in their last place, approximants by 100/q²; short numbers are
    exact, and what is made of them.
    """
    found = unit(text)
    assert size <= found <= fmpq(5, 4) * size


@given(st.integers(8, 40), st.integers(0, 9), st.integers(1, 9))
def test_a_rounded_decimal_is_within_its_unit(digits: int, whole: int, last: int) -> None:
    """Cut off or rounded after any number of digits, the number is within one unit of the text."""
    text = f"{whole}.{'3' * (digits - 1)}{last}"
    assert fmpq(1, 10**digits) <= unit(text, text) <= fmpq(2, 10**digits)


def test_an_unused_parameter_is_not_in_the_field() -> None:
    """The field stays ℚ, or that of the coefficients, whatever else has a name."""
    assert loads("parameters: {s: sqrt(2)}\n" + MIDPOINT).tableau.degree == 1
    text = (
        "parameters: {s: sqrt(2), t: cbrt(5), u: s*t, v: sqrt(3)/2}\nmethods: [{A: [[v]], b: [1]}]"
    )
    assert loads(text).tableau.degree == 2
    used = "parameters: {s: sqrt(2), u: 2*s}\nmethods: [{A: [[u]], b: [1]}]"
    assert loads(used).tableau.degree == 2


@pytest.mark.parametrize("wrong", ["sqrt(-2)", "1/0", "1/(1 - 1)"])
def test_a_faulty_unused_parameter_is_reported(wrong: str) -> None:
    """It stands in the file, and is wrong there."""
    with pytest.raises(MethodFileError) as caught:
        loads(f"parameters: {{s: {wrong}}}\n{MIDPOINT}")
    assert caught.value.faults[0].line == 1


def test_one_cause_is_one_fault() -> None:
    """A faulty parameter that is used twice."""
    with pytest.raises(MethodFileError) as caught:
        loads("parameters: {s: sqrt(-2)}\nmethods: [{A: [[s, s], [s, s]], b: [1/2, 1/2]}]")
    assert caught.value.faults[0].line == 1
