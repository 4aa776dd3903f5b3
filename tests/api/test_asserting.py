"""Orders asserted in tests of one's own, and what a failure says."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli import (
    assert_order,
    conjugate,
    diagonal_method,
    find_order,
    from_arrays,
    load,
    loads,
    method_of,
)
from garkcli.errors import MethodError, MethodFileError
from garkcli.order.certificate import find_order as exact_order
from garkcli.tableau.tableau import Tableau
from tests.api.test_arrays import arrays
from tests.cli.harness import ROOT

HEUN = ([[0, 0], [1, 0]], ["1/2", "1/2"], None, [1, 0])
RK4 = [[0] * 4, ["1/2", 0, 0, 0], [0, "1/2", 0, 0], [0, 0, 1, 0]]
WEIGHTS = ["1/6", "1/3", "1/3", "1/6"]
PATH = ROOT / "methods" / "rk4.gark.yaml"
KINDS: dict[str, Any] = {
    "name": "RK4",
    "path": PATH,
    "path as text": str(PATH),
    "method": load(str(PATH)),
    "tableau": load(str(PATH)).tableau,
    "arrays": (RK4, WEIGHTS),
    "arrays with nodes": (RK4, WEIGHTS, [0, "1/2", 0.5, 1]),
    "a list of arrays": [RK4, WEIGHTS],
    "a mapping": {"A": RK4, "b": WEIGHTS, "name": "RK4"},
    "a family": diagonal_method("rk4", 4),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_method_is_taken(kind: str) -> None:
    """A name, a path, a method, arrays: all of order 4, with conjugate and pair, and no other."""
    assert_order(KINDS[kind], 4, conjugate=4, pair=4)
    assert_order(KINDS[kind], ">= 3")
    for wrong in (3, 5, ">= 5"):
        with pytest.raises(AssertionError, match="has order 4, not"):
            assert_order(KINDS[kind], wrong)


@given(arrays(), st.integers(0, 4))
def test_it_passes_where_the_order_is_that(
    given_arrays: tuple[list[list[Fraction]], list[Fraction]], order: int
) -> None:
    """Of any arrays the assertion holds exactly for the order that the certificate finds."""
    A, b = given_arrays
    found = exact_order(from_arrays(A, b).tableau).order
    if found == order:
        assert_order((A, b), order)
        return
    with pytest.raises(AssertionError):
        assert_order((A, b), order)


def test_a_failure_shows_what_speaks_against_it() -> None:
    """The tree, its weight, what is required, by how much it is off, and the entry to blame."""
    wrong = [*RK4[:3], [0, 0, 2, 0]]
    with pytest.raises(AssertionError) as caught:
        assert_order((wrong, WEIGHTS), 4)
    assert str(caught.value).splitlines() == [
        "the method has order 1, not 4",
        "  fails at order 2: [[]]: 2/3 instead of 1/2, off by 1/6",
        "  order 4 would hold with a[4,3] = 1 instead of 2",
    ]


def test_every_order_that_fails_is_told() -> None:
    """That of the embedded weights, the conjugate and the pair, each with its witness; a repair
    of embedded weights names them.
    """
    with pytest.raises(AssertionError) as caught:
        assert_order(HEUN, 2, embedded=2, conjugate=3, pair=2)
    told = str(caught.value)
    assert "the method with its embedded weights has order 1, not 2" in told
    assert "the method, conjugated, has order 2, not 3" in told
    assert "pair" not in told
    with pytest.raises(AssertionError) as caught:
        assert_order((*HEUN[:3], ["1/2", "1/3"]), 2, embedded=2)
    assert "embedded b[2] = 1/2 instead of 1/3" in str(caught.value)
    assert_order(HEUN, embedded=1)


def test_within_a_tolerance() -> None:
    """Rounded coefficients have their order within the tolerance of the method, or the given one;
    with 0 exactly.
    """
    x = 3**0.5 / 6
    gauss = {"A": [[0.25, 0.25 - x], [0.25 + x, 0.25]], "b": [0.5, 0.5], "tolerance": "1e-15"}
    assert_order(gauss, 4, conjugate=4, pair=4)
    with pytest.raises(AssertionError, match="has order"):
        assert_order(gauss, 4, tolerance=0)
    rough = {**gauss, "A": [[0.25, -0.0387], [0.5387, 0.25]]}
    assert_order({**rough, "tolerance": "1e-4"}, 4)
    with pytest.raises(AssertionError, match="fails at order"):
        assert_order(rough, 4)


def test_a_zero_weight_has_no_conjugate() -> None:
    """It is told as a failure: the order that was asked for does not exist."""
    with pytest.raises(AssertionError, match=r"has no order: .*b_1 = 0"):
        assert_order(([[0, 0], ["1/2", 0]], [0, 1]), 2, conjugate=2)


def test_conjugates_are_named_after_their_method() -> None:
    """A derived method is a method, too."""
    assert_order(conjugate(loads("methods: {family: gauss, stages: 3}")), 6)


@pytest.mark.parametrize(
    ("method", "orders", "why"),
    [
        ("rk4", {}, "no order is given"),
        ("rk4", {"order": "4"}, "'4' is not an order"),
        ("rk4", {"order": True}, "True is not an order"),
        ("rk4", {"order": 4.0}, "4.0 is not an order"),
        ("rk4", {"order": -1}, "-1 is not an order"),
        ("rk4", {"embedded": 3}, "has no embedded weights"),
        (([[0]],), {"order": 1}, "1 arrays are not a method"),
        ({"b": [1]}, {"order": 1}, "A is missing"),
        ({"A": [[0]], "b": [1], "B": []}, {"order": 1}, "no array 'B'"),
        (3, {"order": 1}, "not int"),
    ],
)
def test_mistakes_are_no_failures(method: Any, orders: dict[str, Any], why: str) -> None:
    """What is asked wrongly is an error of its own, with a cure."""
    with pytest.raises(MethodError, match=why) as caught:
        assert_order(method, **orders)
    assert caught.value.help


def test_files_that_are_not_there(tmp_path: Path) -> None:
    """A name that nobody knows, a file that is no method."""
    with pytest.raises(MethodFileError, match="did you mean 'stoermer-verlet'"):
        assert_order("stoermer-verlat", 4)
    path = tmp_path / "empty.gark.yaml"
    path.write_text("", encoding="utf-8")
    with pytest.raises(MethodFileError):
        assert_order(path, 4)


def test_methods_stay_what_they_are() -> None:
    """A method that is given is the one that is taken."""
    method = load(str(PATH))
    assert method_of(method) is method
    assert isinstance(method.tableau, Tableau)
    assert method_of(method.tableau).tableau is method.tableau
    assert find_order(method_of((RK4, WEIGHTS))).order == 4


def test_rounded_arrays_take_the_tolerance_beside_them() -> None:
    """Floats of a solver are refused without one, and are what the tolerance says with it; one that
    stands among the arrays goes first.
    """
    A, b = [[0, 0], [2 / 3, 0]], [1 / 4, 3 / 4]
    assert_order((A, b), 2, tolerance="1e-15")
    assert_order({"A": A, "b": b}, 2, tolerance="1e-15")
    assert_order({"A": A, "b": b, "tolerance": "1e-15"}, 2)
    assert find_order((A, b), tolerance="1e-15").order == 2
    for tolerance in (None, 0):
        with pytest.raises(MethodError, match="rounded number"):
            assert_order((A, b), 2, tolerance=tolerance)
    with pytest.raises(AssertionError):
        assert_order((A, [1 / 3, 2 / 3]), 2, tolerance="1e-15")
