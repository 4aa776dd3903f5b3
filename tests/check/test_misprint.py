"""The wrong number of a file whose tableau has it in several entries."""

from __future__ import annotations

import json

import pytest
from flint import fmpq

from garkcli.check.check_file import check_method
from garkcli.check.outcome import Outcome
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.report.checked import REPORT
from tests.whole import in_whole

RODAS3 = """rosenbrock:
  alpha: [[], [0], [1, 0], [3/4, -1/4, 1/2]]
  gamma: [[1/2], [1, 1/2], [-1/4, -1/4, 1/2], [1/12, 1/12, -2/3, 1/2]]
  b: [5/6, -1/6, -1/6, 1/2]
"""
ROS3 = """rosenbrock:
  alpha: [[], [0.435866521508459], [0.435866521508459, 0]]
  gamma: [[0.435866521508459], [-0.192946556960291, 0.435866521508459],
          [0, 1.749271481257947, 0.435866521508459]]
  b: [-0.754574123854043, 1.941004070619644, -0.186429946765601]
"""
NYSTROM = """nystrom:
  Abar: [[], [1/8], [0, 1/2]]
  c: [0, 1/2, 1]
  bbar: [1/6, 1/3, 0]
  b: [1/6, 2/3, 1/6]
"""


def checked(text: str) -> Outcome:
    return check_method(loads(text))


@pytest.mark.parametrize("claim", ["", "expect: {order: 3}\n"])
def test_an_entry_of_gamma_is_named(claim: str) -> None:
    """γ_43 = −2/5 in place of −2/3 costs RODAS3 two orders. γ_44 = 7/30 restores them too, by
    the sum of β_4: with each of the two in the file the order is 3.
    """
    assert not checked(RODAS3 + claim).misprints
    wrong = RODAS3.replace("-2/3", "-2/5")
    found = checked(wrong + claim).misprints
    assert {(x.old, x.new, x.order) for x in found} == {
        (fmpq(-2, 5), fmpq(-2, 3), 3),
        (fmpq(1, 2), fmpq(7, 30), 3),
    }
    for text in (RODAS3, wrong.replace("-2/5, 1/2", "-2/5, 7/30")):
        analysis = checked(text).rosenbrock
        assert analysis is not None
        assert analysis.order.order == 3
    told = " ".join(REPORT.render([checked(wrong + claim)], width=400).split())
    assert "order 3 would hold with -2/3 instead of -2/5, or 7/30 instead of 1/2" in told


def test_decimals_of_every_kind_look_rounded() -> None:
    """ROS3 without a tolerance: the line is named, in all formats, and with it the order is there;
    then no number seems wrong. With a wrong digit the number is named instead.
    """
    outcome = checked(ROS3)
    assert outcome.remark is not None
    assert (outcome.remark.order, outcome.remark.repairs, outcome.misprints) == (3, (), ())
    line = outcome.remark.line
    text = " ".join(REPORT.render([outcome], width=400).split())
    assert f"with the line {line} order 3 holds" in text
    [finding] = REPORT.document([outcome])["files"][0]["findings"]
    assert finding["code"] == "looks-rounded"
    analysis = checked(f"{ROS3}{line}\n").rosenbrock
    assert analysis is not None
    assert analysis.order.order == 3
    wrong = checked(ROS3.replace("0.1929465", "0.1924965"))
    assert wrong.misprints
    assert wrong.remark is None or wrong.remark.order < 3
    assert checked(RODAS3).remark is None


@pytest.mark.parametrize("tolerance", ["", "tolerance: 1e-14\n"])
def test_a_digit_of_decimals_is_mended(tolerance: str) -> None:
    """Two digits of γ_21 of ROS3 are exchanged; the value comes back to the digits of the others,
    with and without a tolerance.
    """
    assert not checked(ROS3 + tolerance).misprints
    [wrong] = checked(ROS3.replace("0.1929465", "0.1924965") + tolerance).misprints
    assert (wrong.old, wrong.order) == (fmpq(-192496556960291, 10**15), 3)
    assert abs(wrong.new - fmpq(-192946556960291, 10**15)) < fmpq(1, 10**13)


def test_a_weight_of_a_nystrom_method_is_named() -> None:
    """b̄_2 = 1/4 in place of 1/3; JSON has it too."""
    assert not checked(NYSTROM).misprints
    outcome = checked(NYSTROM.replace("1/6, 1/3, 0", "1/6, 1/4, 0") + "expect: {order: 4}\n")
    assert (fmpq(1, 4), fmpq(1, 3), 4) in {(x.old, x.new, x.order) for x in outcome.misprints}
    [told] = json.loads(REPORT.render([outcome], "json"))["files"]
    assert {"old": "1/4", "new": "1/3", "order": 4} in told["misprints"]


@pytest.mark.parametrize(
    "name",
    [
        *("rodas3", "ros3p", "dprkn-64", "tdrk-4", "mri-gark-erk33a", "imex-mri-gark-midpoint"),
        *(pytest.param(x, marks=in_whole) for x in ("rodas4", "grk4t", "fehlberg-rkng-56")),
    ],
)
@pytest.mark.every_case
def test_right_methods_have_no_misprint(name: str) -> None:
    """Nothing is named in a published method that claims nothing."""
    assert not check_method(replace(load(name), claims=())).misprints
