"""R and |R| at single points, against steps by elimination in balls and values known otherwise."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from flint import acb, arb, fmpq

from garkcli.api.calls import find_stability
from garkcli.errors import GarkError
from garkcli.exact.display import to_ball
from garkcli.stability.summary import AtPoint
from tests.cli.harness import gark


def at(method: Any, *points: Any) -> list[AtPoint]:
    """R of all colours together."""
    return list(find_stability(method, at=points).linear[0].points)


def test_the_classical_method_is_the_exponential_series() -> None:
    """1 + z + z²/2 + z³/6 + z⁴/24, in complex fractions."""
    x, y = Fraction(1, 100), Fraction(-7, 3)
    real, imaginary, power = Fraction(0), Fraction(0), (Fraction(1), Fraction(0))
    for factorial in (1, 1, 2, 6, 24):
        real, imaginary = real + power[0] / factorial, imaginary + power[1] / factorial
        power = power[0] * x - power[1] * y, power[0] * y + power[1] * x
    (found,) = at("rk4", ("0.01", "-7/3"))
    assert found.value == (fmpq(*real.as_integer_ratio()), fmpq(*imaginary.as_integer_ratio()))
    size = real**2 + imaginary**2
    assert found.squared == fmpq(*size.as_integer_ratio())


@pytest.mark.parametrize("text", ["0.01+2i", "-3/2-1/2*i", "2i", "-1e3", "1e-3 - j"])
def test_irrational_coefficients(text: str) -> None:
    """TR-BDF2 step by step: a trapezoidal step of γ, then BDF2, in balls."""
    (found,) = at("tr-bdf2", text)
    assert found.value is not None
    z = acb(*(arb(x) for x in found.z))
    gamma = 2 - arb(2).sqrt()
    middle = (1 + gamma * z / 2) / (1 - gamma * z / 2)
    last = (middle / (gamma * (2 - gamma)) - (1 - gamma) ** 2 / (gamma * (2 - gamma))) / (
        1 - (1 - gamma) / (2 - gamma) * z
    )
    value = acb(*map(to_ball, found.value))
    assert abs(value - last) < 1e-12


def test_poles_and_the_unit_circle() -> None:
    """The midpoint rule: a pole at 2, |R| = 1 on the axis exactly, less on the left."""
    pole, axis, left, right = at("implicit-midpoint", 2, 3j, "-1+i", "1+i")
    assert (pole.value, pole.squared) == (None, None)
    assert axis.squared == 1
    assert left.squared is not None
    assert right.squared is not None
    assert left.squared * right.squared == 1  # R(-z̄) R(z) is 1 in size


def test_of_colours_and_embedded_weights() -> None:
    """Each has its own R."""
    found = find_stability("ark-ars222", at=["-1"])
    assert [x.points[0].value for x in found.linear] == [
        (x.R.numerator(fmpq(-1)) / x.R.denominator(fmpq(-1)), 0) for x in found.linear
    ]
    embedded = find_stability("sdirk-2", at=["-3"]).embedded
    assert embedded is not None
    assert embedded.points[0].value == (fmpq(1, 4), 0)


def test_reports() -> None:
    """In words and in JSON, with as many digits as are asked for."""
    run = gark("stability", "implicit-midpoint", "--at", "2i", "--at=-1+i", "--at", "2")
    text = " ".join(run.out.split())
    assert "z = 2i: i, |R| = 1, exactly" in text
    assert "z = -1 + i: 0.2 + 0.4i, |R| = 0.4472135955, less than 1; z = 2: a pole" in text
    data = json.loads(
        gark("stability", "rk4", "--at", "1/2+i", "--digits", "5", "--format", "json").out
    )
    assert data["files"][0]["points"] == [
        {
            "z": ["1/2", "1"],
            "value": ["337/384", "67/48"],
            "decimals": ["0.8776", "1.3958"],
            "squared": "400865/147456",
            "size": "1.6488",
            "bounded": False,
        }
    ]
    assert gark("stability", "sdirk-2", "--at", "1", "--format", "latex").code == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("rk4", "--at", "2k"), "--at 2k"),
        (("rk4", "--at", "sqrt(2)+i"), "a rational number is expected"),
        (("rk4", "--at", "1+"), "--at 1+"),
        (("methods/rectangular.gark.yaml", "--at", "1"), "R(z) is not defined"),
        (
            ("methods/three-colours.gark.yaml", "--at", "1", "--slow", "1", "--fast", "1"),
            "--at does not go with --slow",
        ),
        (("tests/examples/families/sdirk.gark.yaml", "--at", "1"), "--at"),
    ],
)
def test_what_is_refused(arguments: tuple[str, ...], message: str) -> None:
    run = gark("stability", *arguments)
    assert run.code == 2
    assert message in run.err


def test_python_says_which_is_none() -> None:
    with pytest.raises(GarkError, match=r"at\[1\]: "):
        find_stability("rk4", at=["1", "i2"])
    with pytest.raises(GarkError, match="is not a list"):
        find_stability("rk4", at="1")
