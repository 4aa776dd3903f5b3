"""What the digits of a file say of its rounding: which tolerance it lacks, which entry is off; nothing
of exact methods.
"""

from __future__ import annotations

import re
from random import Random

import pytest
from flint import fmpq

from garkcli.check.check_file import check_method
from garkcli.check.outcome import Outcome
from garkcli.check.remark import RoundingHint, remark_on
from garkcli.methodfile.load import loads
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import Order, Witness
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.page.look import Look
from garkcli.report.check_text import render
from tests.catalogue.method_files import method_file
from tests.order.rounded_samples import ENTRIES, EXACT, ROUNDED, gauss_lobatto, published
from tests.whole import IS_WHOLE, at_most, in_whole, sample

LIMIT = 12
"""Above all orders of the methods here."""


def checked(text: str, limit: int = LIMIT) -> Outcome:
    """What a check finds."""
    return check_method(loads(text), limit)


def remark(text: str, limit: int = LIMIT) -> RoundingHint | None:
    """What it says of the digits."""
    return checked(text, limit).remark


def shown(outcome: Outcome) -> str:
    """The report, on one line."""
    return " ".join(render([outcome], Look()).split())


FAST = [x for x in EXACT if len(str(ENTRIES[x]["blocks"])) < 2_000]
"""Exact methods of the catalogue whose check takes no time."""


@pytest.mark.parametrize("name", sample(FAST, 6))
def test_exact_methods_get_none(name: str) -> None:
    """Their first failing residuals are genuine."""
    assert remark(method_file(ENTRIES[name])) is None


@in_whole
def test_float64_coefficients() -> None:
    """The eighth-order method of Dormand and Prince in double precision: residuals below 10⁻¹⁵ up
    to order 8.
    """
    found = remark(re.sub("tolerance: .*", "", method_file(ENTRIES["DP8_Hairer_853_float64"])))
    assert found is not None
    assert (found.order, found.line) == (8, "tolerance: 1e-14")


@pytest.mark.parametrize(
    ("stages", "digits", "order"), [(2, 10, 4), pytest.param(3, 30, 6, marks=in_whole)]
)
def test_decimals_of_gauss_and_lobatto(stages: int, digits: int, order: int) -> None:
    """A pair of methods in decimals of their own length."""
    t = gauss_lobatto(stages, digits)

    def text(row: object) -> str:
        return f"[{', '.join(decimal(x, digits) for x in row)}]"  # type: ignore[attr-defined]

    blocks = [[f"[{', '.join(map(text, t.block(l, m) or ()))}]" for m in (0, 1)] for l in (0, 1)]
    rows = ", ".join(f"[{', '.join(row)}]" for row in blocks)
    weights = ", ".join(text(colour.b) for colour in t.colours)
    found = remark(f"tableau:\n  A: [{rows}]\n  b: [{weights}]\n")
    assert found is not None
    assert found.order == order
    assert found.exponent is not None
    within = RoundedTableau.within(t, fmpq(10) ** found.exponent)
    assert find_order_within(within).order == order


def decimal(x: fmpq, digits: int) -> str:
    """All its digits."""
    n = int((abs(x) * 10**digits).p)
    sign = "-" if x < 0 else ""
    return f"{sign}{n // 10**digits}.{n % 10**digits:0{digits}d}"


ONE_STAGE = "methods: [{{A: [[0, 0], [1/2, 0]], b: [{}, {}]}}]\n"


@pytest.mark.parametrize("weights", [("0", "1.0001"), ("0.0001", "0.9999"), ("0", "1.00001")])
def test_a_mistake_is_no_rounding(weights: tuple[str, str]) -> None:
    """A weight that is off by more than its digits leave open; one of few digits is exact. One that
    is off in its ninth place looks rounded.
    """
    assert remark(ONE_STAGE.format(*weights)) is None
    rounded = remark(ONE_STAGE.format("0", "1.00000001"))
    assert rounded is not None
    assert (rounded.order, rounded.line) == (2, "tolerance: 1e-8")


DECIMALS = "methods: [{{A: [[0.25, -0.03867513459481288], [{}, 0.25]], b: [0.5, 0.5]}}]\n"


def test_no_tolerance_swallows_a_misprint() -> None:
    """One digit of 17 is wrong in the 11th place: that is no rounding, and the entry is named."""
    outcome = checked(DECIMALS.format("0.53867513460481288"))
    found = outcome.remark
    assert found is not None
    assert (found.order, found.line) == (4, "")
    assert [(x.i, x.j) for x in found.repairs] == [(1, 0)]
    text = shown(outcome)
    assert "an entry looks misprinted: within the digits of the others order 4 holds" in text
    assert "a[2,1] = 0.538675134594812" in text
    assert "tolerance:" not in text


def test_what_the_digits_explain_is_proposed() -> None:
    """The same file without the misprint."""
    outcome = checked(DECIMALS.format("0.53867513459481288"))
    found = outcome.remark
    assert found is not None
    assert (found.order, found.line, found.repairs) == (4, "tolerance: 1e-17", ())
    hint = "the coefficients look rounded to 17 decimal places; with the line tolerance: 1e-17"
    assert f"{hint} order 4 holds" in shown(outcome)
    assert remark(f"{DECIMALS.format('0.53867513459481288')}{found.line}\n") is None


@pytest.mark.parametrize(("order", "is_sought"), [(2, True), (12, False)])
def test_residuals_of_good_methods_are_no_rounding(
    order: int, is_sought: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """10⁻⁸ is far less than what methods of order 2 miss order 3 by, and what good ones of order 12
    miss order 13 by: there no method is sought, which takes minutes where stages are many.
    """
    sought = []
    monkeypatch.setattr("garkcli.check.remark.within_digits", lambda *x: sought.append(x))
    required = fmpq(1, order + 1)
    found = Order(order, Witness(Tree(0), required + fmpq(1, 10**8), required))
    method = loads(DECIMALS.format("0.53867513459481288"))
    assert remark_on(method.tableau, found, None) is None
    assert bool(sought) is is_sought


LONG = {
    "DP8_Hairer_853",
    "DP8_Hairer_853_float64",
    "Feagin10",
    "Feagin12",
    "sciml_KenCarp4",
    "sciml_KenCarp58",
    "sprk_Sofroniou_10_36",
    "sprk_SuzukiUmeno_8_16",
    "sundials_VERNER_13_7_8",
}
"""Methods of the highest orders, whose orders ``test_rounded_order.py`` has; they take seconds."""


SLOW = {
    *("sciml_KenCarp5", "sciml_ARS343", "sundials_ESDIRK43I6L2SA_6_3_4"),
    *("sundials_VERNER_10_6_7", "sprk_Yoshida6_14digits", "sundials_ARK437L2SA"),
}
"""Those that take a second."""


@in_whole
@pytest.mark.parametrize(
    "name",
    [x for x in sample([x for x in ROUNDED if x not in LONG], 4) if IS_WHOLE or x not in SLOW],
)
def test_rounded_methods_get_a_line_that_gives_their_order(name: str) -> None:
    """Files of rounded methods without their tolerance: none looks misprinted, as its digits
    explain its residuals; the order proposed is the verified one, and with the line added it is
    found.
    """
    proposed = remark(re.sub("tolerance: .*", "", method_file(ENTRIES[name])))
    assert proposed is not None
    assert proposed.repairs == ()
    assert proposed.order == ENTRIES[name]["verified_order"]
    assert proposed.exponent is not None
    tolerance = fmpq(10) ** proposed.exponent
    assert (
        find_order_within(RoundedTableau.within(published(name), tolerance)).order == proposed.order
    )


@pytest.mark.parametrize(
    "name", [pytest.param("sundials_VERNER_10_6_7", marks=in_whole), "sundials_KVAERNO_4_2_3"]
)
@pytest.mark.parametrize("seed", range(at_most(1, 3)))
def test_a_wrong_digit_in_a_published_method(name: str, seed: int) -> None:
    """A digit of A changed in the 11th place is never taken for rounding, and it is named."""
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
    found = remark(re.sub("tolerance: .*", "", method_file({**entry, "blocks": blocks})))
    assert found is not None
    assert found.line == ""
    assert (i, j) in [(x.i, x.j) for x in found.repairs]
