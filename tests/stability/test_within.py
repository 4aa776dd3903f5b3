"""Rounded coefficients: decided where all neighbours agree, and left open where they do not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import loads
from garkcli.stability.algebraic import algebraic_within
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.summary import stability_of_rounded
from garkcli.stability.within import stability_within
from garkcli.tableau.forms import gark
from tests.cli.harness import gark as command

TOLERANCE = fmpq(1, 10**9)


def sdirk(gamma: str) -> str:
    """The stiffly accurate SDIRK method of three stages with γ, of order 3 for roots of its polynomial."""
    g = arb(gamma)
    first = -g * g * 3 / 2 + g * 4 - arb(1) / 4
    second = g * g * 3 / 2 - g * 5 + arb(5) / 4
    middle = (1 - g) / 2
    a, b, c = (x.str(10, radius=False) for x in (first, second, middle))
    return f"methods: [{{A: [[{gamma}, 0, 0], [{c}, {gamma}, 0], [{a}, {b}, {gamma}]], b: [{a}, {b}, {gamma}]}}]"


def test_the_sdirk_method_of_order_three() -> None:
    """γ = 0.4358665215, a root of x³ − 3x² + 3x/2 − 1/6 in ten digits: L-stable, whatever was rounded."""
    (found,) = stability_of_rounded(loads(sdirk("0.4358665215")).tableau, TOLERANCE).linear
    assert (found.a_stable, found.l_stable) == (True, True)


def test_the_other_root_is_not() -> None:
    """γ = 0.1589838999 has order 3 too, and is not A-stable."""
    (found,) = stability_of_rounded(loads(sdirk("0.1589838999")).tableau, TOLERANCE).linear
    assert (found.a_stable, found.l_stable) == (False, False)


@pytest.mark.parametrize("digit", range(4, 9))
@pytest.mark.parametrize("sign", [1, -1])
def test_a_digit_off_is_decided_as_exactly(digit: int, sign: int) -> None:
    """With one digit of the first γ wrong the verdict is the exact one, or open: it is lost one way."""
    text = sdirk("0.4358665215")
    wrong = f"{fmpq(4358665215, 10**10) + fmpq(sign, 10**digit)}"
    tableau = loads(text.replace("[0.4358665215, 0, 0]", f"[{wrong}, 0, 0]")).tableau
    (found,) = stability_of_rounded(tableau, TOLERANCE).linear
    exact = is_a_stable(stability_function(tableau))
    assert exact == (sign > 0)
    assert found.a_stable in {None, exact}


def test_symmetric_methods_are_decided() -> None:
    """E is zero for the Gauss method that the digits mean."""
    half, small, large = "0.25", "-0.0386751346", "0.5386751346"
    text = f"methods: [{{A: [[{half}, {small}], [{large}, {half}]], b: [0.5, 0.5]}}]"
    (found,) = stability_of_rounded(loads(text).tableau, TOLERANCE).linear
    assert (found.a_stable, found.l_stable) == (True, False)


@given(st.sampled_from(["radau-iia", "radau-ia", "lobatto-iiic"]), st.integers(2, 2))
def test_exact_methods_are_decided_alike(name: str, stages: int) -> None:
    """Where something is decided for all neighbours it is what holds exactly."""
    tableau = gark([diagonal_method(name, stages)], {})
    R = stability_function(tableau)
    found = stability_within(tableau, [fmpq(1)], fmpq(1, 10**60))
    assert found.a_stable in {None, is_a_stable(R)}
    assert found.l_stable in {None, is_l_stable(R)}


@pytest.mark.parametrize("name", ["explicit-euler", "heun", "kutta", "rk4"])
def test_explicit_methods_are_decided(name: str) -> None:
    """A polynomial is unbounded, rounded or not."""
    tableau = gark([diagonal_method(name, None)], {})
    assert stability_within(tableau, [fmpq(1)], fmpq(1, 10**60)).a_stable is False


@pytest.mark.parametrize(
    ("A", "b"),
    [
        ("[[1, 0], [0, -1]]", "[1, 0]"),
        ("[[-3, 2], [0, 1]]", "[0, 1]"),
        ("[[0, 1], [3, -2]]", "[1/2, 1/2]"),
        ("[[-6]]", "[0]"),
    ],
)
def test_a_root_that_cancels_is_no_pole(A: str, b: str) -> None:
    """Stages without influence, or equal ones, put a root of det(I − zA) on the left: R is A-stable."""
    tableau = loads(f"methods: [{{A: {A}, b: {b}}}]").tableau
    R = stability_function(tableau)
    assert is_a_stable(R)
    found = stability_within(tableau, [fmpq(1)], fmpq(1, 10**60))
    assert found.a_stable is not False
    assert found.l_stable in {None, is_l_stable(R)}


def test_a_pole_on_the_left_that_stays_decides() -> None:
    """R = 1/(1 + z) has |R(iy)| ≤ 1 for all y, and a pole at −1 for all neighbours."""
    tableau = loads("methods: [{A: [[-1]], b: [-1]}]").tableau
    found = stability_within(tableau, [fmpq(1)], fmpq(1, 10**60))
    assert found.a_stable is False


@pytest.mark.parametrize(("b", "is_stable"), [("-0.5", False), ("0.5", False), ("1.0", True)])
def test_negative_weights_are_not_algebraically_stable(b: str, is_stable: bool) -> None:
    """M = 2ba − b² is positive for a = −1 and b = −1/2, but b gives no norm; for b = 1/2 it is
    negative; backward Euler is stable.
    """
    a = "1.0" if is_stable else "-1.0"
    tableau = loads(f"A: [[{a}]]\nb: [{b}]").tableau
    assert algebraic_within(tableau, fmpq(1, 100)) is is_stable


def test_a_tolerance_changes_no_words(tmp_path: Path) -> None:
    """The intervals of an A-stable method are called as those of exact coefficients, and what only
    these have is said.
    """
    exact, rounded = tmp_path / "exact.yaml", tmp_path / "rounded.yaml"
    exact.write_text("A: [[1/2]]\nb: [1]\n", encoding="utf-8")
    rounded.write_text("A: [[0.6000000000]]\nb: [1]\ntolerance: 1e-10\n", encoding="utf-8")
    told = [command("stability", str(x)).out for x in (exact, rounded)]
    for line in ("real axis", "imaginary axis"):
        [first, second] = [re.search(f"{line} +(.*)", x) for x in told]
        assert first is not None
        assert second is not None
        assert first[1] == second[1]
    assert ["need exact coefficients" in " ".join(x.split()) for x in told] == [False, True]
