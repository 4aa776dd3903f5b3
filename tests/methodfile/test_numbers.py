"""Coefficients: the text is taken at its word."""

from collections.abc import Mapping
from time import process_time

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import MethodFileError
from garkcli.exact.display import to_text
from garkcli.exact.field import Number
from garkcli.methodfile.load import loads
from tests.whole import in_whole


def value(scalar: str, parameters: Mapping[str, str] | None = None) -> Number:
    """What the program reads for a coefficient."""
    header = "parameters: {" + ", ".join(f"{k}: {x}" for k, x in (parameters or {}).items()) + "}\n"
    block = loads(f"{header}tableau: {{c: [[0]], A: [[[[{scalar}]]]], b: [[1]]}}").tableau.block(
        0, 0
    )
    assert block is not None
    return block[0][0]


@pytest.mark.parametrize(
    ("scalar", "expected"),
    [
        ("0.1", fmpq(1, 10)),
        ("'0.1'", fmpq(1, 10)),
        ("1e-3", fmpq(1, 1000)),
        ("2.5E+1", fmpq(25)),
        (".5", fmpq(1, 2)),
        ("7.", fmpq(7)),
        ("-3", fmpq(-3)),
        ("+3", fmpq(3)),
        ("1/3", fmpq(1, 3)),
        ("1/2/2", fmpq(1, 4)),
        ("1 - 2 - 3", fmpq(-4)),
        ("-2**2", fmpq(-4)),
        ("(-2)^2", fmpq(4)),
        ("2**-3", fmpq(1, 8)),
        ("2*-1", fmpq(-2)),
        ("sqrt(9/4)", fmpq(3, 2)),
        ("cbrt(-27)", fmpq(-3)),
        ('"root(16, 4)"', fmpq(2)),
        ("sqrt(2)**2", fmpq(2)),
        ("sqrt(2)*sqrt(3) - sqrt(6)", fmpq(0)),
        ("sqrt(3 + 2*sqrt(2)) - sqrt(2)", fmpq(1)),
        ("1/(1 + sqrt(2)) - sqrt(2)", fmpq(-1)),
        ("9" * 400, fmpq(10**400 - 1)),
    ],
)
def test_a_coefficient_is_the_number_it_is_written_as(scalar: str, expected: fmpq) -> None:
    """Every notation gives its exact rational value; decimals are never binary floats."""
    assert value(scalar) == expected


@given(st.integers(-(10**30), 10**30), st.integers(1, 10**30))
def test_every_fraction_is_read_exactly(p: int, q: int) -> None:
    """p/q is the rational number p/q, of any size."""
    assert value(f"{p}/{q}") == fmpq(p, q)


@given(
    st.decimals(allow_nan=False, allow_infinity=False, min_value=-1000, max_value=1000, places=25)
)
def test_every_decimal_is_read_exactly(number: object) -> None:
    """A decimal of 28 digits is that decimal, which no float could hold."""
    text = f"{number:f}"
    whole, _, fraction = text.partition(".")
    assert value(text) == fmpq(int(whole + fraction), 10 ** len(fraction))


def test_parameters_are_chained() -> None:
    """A parameter may use those before it, and its value is exact."""
    chain = {"g": "1 - sqrt(2)/2", "d": "1 - 1/(2*g)", "e": "d - d"}
    assert to_text(value("g", chain)) == "1 - sqrt(2)/2"
    assert value("2*g*(1 - d)", chain) == 1
    assert value("e", chain) == 0


def test_a_parameter_is_a_value_and_not_a_text() -> None:
    """-s**2 of s = 1 + 1 is -(2**2): a parameter is put in as if in parentheses."""
    assert value("-s**2", {"s": "1 + 1"}) == -4
    assert value("6/s", {"s": "1 + 1"}) == 3


@pytest.mark.parametrize(
    "scalar", ["010", "0x10", "1_000", "1:30", "yes", "on", "~", "2001-12-14", ".inf", ".NaN"]
)
def test_a_plain_scalar_that_yaml_reads_as_something_else_is_refused(scalar: str) -> None:
    """What YAML 1.1 takes for an octal, a base-60 number, a word or a date is never silently a
    coefficient.
    """
    with pytest.raises(MethodFileError) as caught:
        value(scalar)
    assert scalar in caught.value.faults[0].message or scalar == "~"


def test_nothing_in_a_file_is_executed(tmp_path: object) -> None:
    """A call in a coefficient is refused, and what it would have done has not happened."""
    mark = f"{tmp_path}/executed"
    with pytest.raises(MethodFileError):
        value(f"\"__import__('pathlib').Path('{mark}').touch()\"")
    with pytest.raises(MethodFileError):
        loads(f"methods: [!!python/object/apply:os.system ['touch {mark}']]")
    from pathlib import Path

    assert not Path(mark).exists()


def test_a_text_means_what_its_parameters_mean() -> None:
    """A name that is used before it is defined is a fault there, and there alone."""
    with pytest.raises(MethodFileError) as caught:
        loads("parameters: {a: x, x: 1/2}\nmethods: [{A: [[x]], b: [2*x]}]\n")
    (fault,) = caught.value.faults
    assert (fault.line, fault.column) == (1, 17)
    assert loads("parameters: {x: 1/2}\nmethods: [{A: [[x]], b: [2*x]}]\n").tableau.blocks[
        0, 0
    ] == ((fmpq(1, 2),),)


def test_underscores_are_soon_read() -> None:
    """What YAML takes for a number is told in one pass: a text of underscores takes no quadratic
    time.
    """
    before = process_time()
    with pytest.raises(MethodFileError, match="100001 characters"):
        loads(f"methods: [{{A: [[{'_' * 100_000}x]], b: [1]}}]")
    with pytest.raises(MethodFileError, match="different numbers to different readers"):
        loads("methods: [{A: [[1_0_0]], b: [1]}]")
    assert process_time() - before < 2


@in_whole
def test_long_chains_of_parameters_are_refused() -> None:
    """Parameters that each use the one before: read to a depth of two hundred, then told."""

    def chain(length: int) -> dict[str, str]:
        return {"p0": "sqrt(2)"} | {f"p{i}": f"p{i - 1} + 1" for i in range(1, length)}

    assert value("p190 - p189", chain(191)) == 1
    with pytest.raises(
        MethodFileError, match="p199: nested more than 200 deep, with the parameters written out"
    ):
        value("p1499", chain(1500))
