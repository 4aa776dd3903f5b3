"""Tolerances proposed for files without one: for the rounded methods of the catalogue, for no exact
one.
"""

from __future__ import annotations

import re
from random import Random

import pytest
from flint import fmpq

from garkcli.check.analysis import Analysis
from garkcli.check.deciding import analyse
from garkcli.check.outcome import Outcome
from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import printed_units
from garkcli.order.certificate import find_order
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.order.suggestion import Suggestion, suggest_tolerance
from garkcli.page.paint import Paint
from garkcli.report.check_text import render
from garkcli.tableau.tableau import Tableau
from tests.catalogue.catalogue import tableau
from tests.catalogue.method_files import method_file
from tests.oracles import samples
from tests.order.rounded_samples import ENTRIES, EXACT, ROUNDED, gauss_lobatto, published


def suggestion(method: Tableau) -> Suggestion | None:
    """What is proposed for a method."""
    return suggest_tolerance(method, find_order(method))


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
    assert (found.order, found.line) == (8, "tolerance: 1e-14")


@pytest.mark.parametrize(("stages", "digits", "order"), [(2, 10, 4), (3, 30, 6), (6, 30, 12)])
def test_decimals_of_gauss_and_lobatto(stages: int, digits: int, order: int) -> None:
    """Also where the trees are too many to list."""
    decimal = gauss_lobatto(stages, digits)
    found = suggestion(decimal)
    assert found is not None
    assert found.order == order
    assert find_order_within(RoundedTableau.within(decimal, found.tolerance)).order == order


def test_no_gap_no_suggestion() -> None:
    """A weight off by 10⁻⁷, or by 10⁻⁴, under an error of 10⁻⁵ is a mistake, not rounding."""
    rk = samples.runge_kutta("0, 0", "1/2, 0", "1/10000, 9999/10000")
    assert suggestion(rk) is None
    assert suggestion(samples.runge_kutta("0, 0", "1/2, 0", "0, 1000001/1000000")) is None
    off = suggestion(samples.runge_kutta("0, 0", "1/2, 0", "0, 100000001/100000000"))
    assert off is not None
    assert off.tolerance == fmpq(1, 10**7)


DECIMALS = "methods: [{{A: [[0.25, -0.03867513459481288], [{}, 0.25]], b: [0.5, 0.5]}}]"


def analysed(text: str) -> Analysis:
    """What a check finds, the digits of the text known."""
    method = loads(text)
    return analyse(method.tableau, 30, None, lambda: printed_units(method.printed))


def test_no_tolerance_swallows_a_misprint() -> None:
    """One digit of 17 is wrong in the 11th place: that is no rounding, and the entry is named."""
    found = analysed(DECIMALS.format("0.53867513460481288"))
    assert found.suggestion is None
    assert found.misprint is not None
    assert found.misprint.order == 4
    assert found.misprint.residual > 1000 * found.misprint.explained
    assert [(x.i, x.j) for x in found.misprint.repairs] == [(1, 0)]
    shown = render([Outcome("f", "f", analysis=found)], Paint())
    assert "an entry looks misprinted" in shown
    assert "a[2,1] = 0.538675134594812" in shown
    assert "tolerance:" not in shown


def test_what_the_digits_explain_is_proposed() -> None:
    """The same file without the misprint."""
    found = analysed(DECIMALS.format("0.53867513459481288"))
    assert found.misprint is None
    assert found.suggestion is not None
    assert (found.suggestion.order, found.suggestion.line) == (4, "tolerance: 1e-17")


LONG = {"Feagin12", "Feagin10", "sprk_Sofroniou_10_36"}
"""Methods of the highest orders, whose orders ``test_rounded_order.py`` has; they take seconds."""


@pytest.mark.parametrize("name", [x for x in ROUNDED if x not in LONG][::2])
def test_rounded_methods_get_a_line_that_gives_their_order(name: str) -> None:
    """Every other file of a rounded method without its tolerance: none looks misprinted, as its digits
    explain its residuals; the order proposed is the verified one, and with the line added it is
    found.
    """
    found = analysed(re.sub("tolerance: .*", "", method_file(ENTRIES[name])))
    assert found.misprint is None
    proposed = found.suggestion
    assert proposed is not None
    assert proposed.order == ENTRIES[name]["verified_order"]
    assert proposed.rounding < proposed.tolerance < proposed.genuine
    within = find_order_within(RoundedTableau.within(published(name), proposed.tolerance))
    assert within.order == proposed.order


@pytest.mark.parametrize("name", ["sundials_VERNER_10_6_7", "sundials_KVAERNO_4_2_3"])
@pytest.mark.parametrize("seed", range(3))
def test_a_wrong_digit_in_a_published_method(name: str, seed: int) -> None:
    """A digit of A changed in the 11th place is never taken for rounding; where one entry repairs
    all conditions it is that one.
    """
    entry = ENTRIES[name]
    rows = entry["blocks"]["A"][0][0]
    places = [
        (i, j)
        for i, row in enumerate(rows)
        for j, text in enumerate(row)
        if re.fullmatch(r"-?[0-9]\.[0-9]{15,}", text)
    ]
    i, j = Random(seed).choice(places)
    text = rows[i][j]
    at = text.index(".") + 11
    wrong = f"{text[:at]}{(int(text[at]) + 5) % 10}{text[at + 1 :]}"
    changed = [
        [wrong if (k, m) == (i, j) else x for m, x in enumerate(row)] for k, row in enumerate(rows)
    ]
    blocks = {**entry["blocks"], "A": [[changed]]}
    found = analysed(re.sub("tolerance: .*", "", method_file({**entry, "blocks": blocks})))
    assert found.suggestion is None
    assert found.misprint is not None
    assert (i, j) in [(x.i, x.j) for x in found.misprint.repairs]
