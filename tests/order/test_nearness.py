"""How far a recovered method is from the print, and which entry alone is far off."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from garkcli.check.analysis import analyse
from garkcli.exact.affine import Affine, Forms
from garkcli.methodfile.load import load, loads
from garkcli.order.deciding import order_of
from garkcli.order.existence import has_zero, is_proved_to_exist
from garkcli.order.meant import as_meant, meant
from garkcli.order.nearness import EntryAddress, Nearness, far_alone
from garkcli.order.repair import Repair
from garkcli.order.rounded import RoundedTableau
from garkcli.order.suspects import suspects
from tests.cli.harness import gark
from tests.whole import in_whole, sample

THREE_EIGHTHS = """
tolerance: 1e-9
A:
  - [0, 0, 0, 0]
  - [0.333333333333, 0, 0, 0]
  - [-0.333333333333, 1, 0, 0]
  - [1, -1, 1, 0]
b: [0.125, 0.375, {b3}, 0.125]
"""
OFF = THREE_EIGHTHS.replace("{b3}", "0.3750000007")
TWO_OFF = OFF.replace("b: [0.125", "b: [0.1250000007")


def nearness_of(text: str) -> Nearness:
    """Of a rounded method."""
    method = loads(text)
    found = analyse(method.tableau, tolerance=method.tolerance, further=method.further).nearness
    assert found is not None
    return found


@in_whole
def test_one_entry_is_far_off() -> None:
    """A weight of the 3/8 rule that is 0.7 t off, where all others have twelve digits, is named; it
    is not where the others have as few digits, nor where two are off.
    """
    found = nearness_of(OFF)
    assert found.distance == fmpq(7, 10)
    assert found.entry == found.suspect == EntryAddress("b", 0, None, None, 2)
    assert nearness_of(TWO_OFF).suspect is None
    assert nearness_of(THREE_EIGHTHS.replace("{b3}", "0.375")).suspect is None


@pytest.mark.parametrize("off", ["0.1666666666", "0.16666666672", "0.1666666667"])
def test_the_entry_with_the_largest_shift_is_named(off: str) -> None:
    """Whether its size is rounded up or down: not the first rounded entry of the file."""
    rows = "[[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 0.500000000000, 0, 0], [0, 0, 1, 0]]"
    text = f"tolerance: 1e-10\nA: {rows}\nb: [{off}, 1/3, 1/3, 1/6]\n"
    assert nearness_of(text).entry == EntryAddress("b", 0, None, None, 0)


def test_an_entry_of_dense_output_is_far_off() -> None:
    """The coefficient of θ³ in the last weight of an interpolant, 0.7 t off, with and without
    embedded weights before it.
    """
    for embedded in ("", "embedded: [0.25, 0.25, 0.25, 0.25]\n"):
        third = "0.666666666667"
        text = f"""
tolerance: 1e-9
A: [[], [1/2], [0, 1/2], [0, 0, 1]]
b: [0.166666666667, 0.333333333333, 0.333333333333, 0.166666666667]
{embedded}dense:
  degree: 3
  weights: [[1, -1.5, {third}], [0, 1, -{third}], [0, 1, -{third}], [0, -0.5, 0.6666666673667]]
"""
        found = nearness_of(text)
        assert found.entry == EntryAddress("dense", 0, None, 2, 3)
        assert found.distance == fmpq(7, 10)


def test_two_numbers_of_one_sum_are_no_suspects() -> None:
    """Where conditions see a sum alone, either number may be the wrong one; the same shift of a
    number that stands alone is told.
    """
    basis = np.eye(6)[:5]
    basis[4, 4:] = np.sqrt(0.5)
    assert far_alone(basis, np.array([0, 0, 0, 0, 0.4, 0.4])) is None
    assert far_alone(basis, np.array([0, 0.8, 0, 0, 0, 0])) == 1


def test_rounding_is_no_suspect() -> None:
    """Methods of the catalogue that are rounded to fewer digits have no suspects: rounding moves all
    numbers alike.
    """
    for name in sample(["cash-4-2", "kvaerno-3", "ark-324"], 3):
        method = load(name)
        found = analyse(method.tableau, tolerance=method.tolerance, further=method.further)
        assert found.nearness is not None
        assert found.nearness.suspect is None
        assert found.nearness.distance <= 1


@in_whole
def test_reports_tell_it(tmp_path: Path) -> None:
    """With -v in a line, for programs as fields; not of exact methods."""
    file = tmp_path / "off.gark.yaml"
    file.write_text(OFF)
    text = " ".join(gark("check", "-v", str(file)).out.split())
    assert "recovered 0.7 t from the print, at b[3]; b[3] alone is far off: a misprint?" in text
    assert "recovered" not in gark("check", str(file)).out
    (found,) = json.loads(gark("check", "--format", "json", str(file)).out)["files"]
    entry = {"letter": "b", "colours": [1], "indices": [3]}
    assert found["recovered"] == {
        "distance": 0.7,
        "entry": entry,
        "suspect": entry,
        "met_fully": True,
        "proved_to_exist": False,
    }
    assert "recovered" not in gark("check", "-v", "rk4").out


@pytest.mark.parametrize(
    ("name", "order"), [("kvaerno-3", 3), ("cash-4-2", 4), ("billington-2", 2)]
)
def test_methods_are_proved_to_exist(name: str, order: int) -> None:
    """Of methods without simplifying conditions the order is proved, and no larger one."""
    method = load(name)
    analyse(method.tableau, tolerance=method.tolerance, further=method.further)
    found = as_meant(method)
    assert isinstance(found, RoundedTableau)
    assert is_proved_to_exist(found.search, order)
    assert not is_proved_to_exist(found.search, order + 1)


def test_conditions_that_depend_on_each_other_prove_nothing() -> None:
    """The 3/8 rule with its zeros and ones exact has fewer numbers than conditions."""
    assert not nearness_of(OFF).is_proved


def square_less_two(near: fmpq, radius: fmpq) -> list[Affine]:
    """x² − 2 for all x near a number."""
    x = Affine(arb(near), {0: float(radius.p) / float(radius.q)})
    return [x * x - 2]


def test_the_proof_is_one() -> None:
    """x² − 2 has a zero within 2⁻²⁰ of 1.4142136 and none within 2⁻²⁰ of 1.4142; twice the same
    condition proves nothing, nor does one that depends on nothing, nor a number that is held.
    """
    free, held = np.array([True]), np.array([False])
    radius = fmpq(1, 1 << 20)
    with ctx.workprec(200):
        near = square_less_two(fmpq(14142136, 10**7), radius)
        far = square_less_two(fmpq(14142, 10**4), radius)
        assert has_zero(Forms.of(near, 1), free)
        assert not has_zero(Forms.of(near, 1), held)
        assert not has_zero(Forms.of(far, 1), free)
        assert not has_zero(Forms.of([*near, *near], 1), free)
        assert not has_zero(Forms.of([fmpq(0)], 1), free)
        x = Affine(arb(fmpq(1, 10)), {0: 1.0})
        assert not has_zero(Forms.of([x * x + fmpq(1, 1000)], 1), free)  # to first order there is


def test_a_root_hides_no_wrong_number() -> None:
    """Σ b c = 1/2 holds with a₂₁ = 1/2 for 3/5; either root of the last row needs a smaller change,
    but no print is wrong there.
    """
    text = 'A: [[], [3/5], ["1/2 - sqrt(2)/4", "sqrt(2)/4"]]\nb: [0, 1/4, 3/4]\n'
    method = RoundedTableau.within(loads(text).tableau, fmpq(1, 10**9))
    assert suspects(method, 2) == {Repair(0, 0, 1, 0, fmpq(3, 5), fmpq(1, 2)): 2}


def test_a_number_printed_once_moves_once() -> None:
    """Order 2 asks for g = 1 − √2/2, which is 0.0029 away; five numbers within 0.0025 have it."""
    tolerance = fmpq(25, 10000)
    once = loads("parameters: {g: 0.29}\nA: [[g, 0], [1 - g, g]]\nb: [1 - g, g]\n")
    each = loads("A: [[0.29, 0], [0.71, 0.29]]\nb: [0.71, 0.29]\n")
    orders = [order_of(meant(x.tableau, tolerance), 5).order for x in (once, each)]
    assert orders == [1, 2]
