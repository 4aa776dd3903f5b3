"""Tolerances proposed for files without one: for the rounded methods of the catalogue, for no exact
one.
"""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.order.certificate import find_order
from garkcli.order.rounded import find_order_within
from garkcli.order.suggestion import Suggestion, suggest_tolerance
from garkcli.tableau.tableau import Tableau
from tests.catalogue.catalogue import tableau
from tests.oracles import samples
from tests.order.rounded_samples import ENTRIES, EXACT, ROUNDED, gauss_lobatto, published


def suggestion(method: Tableau) -> Suggestion | None:
    """What is proposed for a method."""
    return suggest_tolerance(method, find_order(method))


@pytest.mark.parametrize("name", ROUNDED)
def test_rounded_methods_get_a_line_that_gives_their_order(name: str) -> None:
    """The order proposed is the verified one, and with the line added it is found."""
    method = published(name)
    found = suggestion(method)
    assert found is not None
    assert found.order == ENTRIES[name]["verified_order"]
    assert find_order_within(method, found.tolerance).order == found.order
    assert found.rounding < found.tolerance < found.genuine


@pytest.mark.parametrize("name", [name for name in EXACT if name != "sprk_McLachlan_3_3"])
def test_exact_methods_get_none(name: str) -> None:
    """Their first failing residuals are genuine, down to 7·10⁻⁸ at order 9.

    The number field of the one left out takes a minute to find.
    """
    assert suggestion(tableau(ENTRIES[name])) is None


@pytest.mark.parametrize("name", samples.NAMED)
def test_samples_get_none(name: str) -> None:
    """Families and methods in radicals are not rounded, however small their residuals are."""
    assert suggestion(samples.NAMED[name]()) is None


def test_float64_coefficients() -> None:
    """The eighth-order method of Dormand and Prince in double precision: residuals below 10⁻¹⁵ up
    to order 8.
    """
    found = suggestion(published("DP8_Hairer_853_float64"))
    assert found is not None
    assert (found.order, found.line) == (8, "tolerance: 1e-15")


@pytest.mark.parametrize(
    ("stages", "digits", "order"), [(2, 10, 4), (3, 30, 6), (6, 30, 12), (10, 60, 20)]
)
def test_decimals_of_gauss_and_lobatto(stages: int, digits: int, order: int) -> None:
    """Also where the trees are too many to list."""
    decimal = gauss_lobatto(stages, digits)
    found = suggestion(decimal)
    assert found is not None
    assert found.order == order
    assert find_order_within(decimal, found.tolerance).order == order


def test_no_gap_no_suggestion() -> None:
    """A weight off by 10⁻⁷, or by 10⁻⁴, under an error of 10⁻⁵ is a mistake, not rounding."""
    rk = samples.runge_kutta("0, 0", "1/2, 0", "1/10000, 9999/10000")
    assert suggestion(rk) is None
    assert suggestion(samples.runge_kutta("0, 0", "1/2, 0", "0, 1000001/1000000")) is None
    off = suggestion(samples.runge_kutta("0, 0", "1/2, 0", "0, 100000001/100000000"))
    assert off is not None
    assert off.tolerance == fmpq(1, 10**7)
