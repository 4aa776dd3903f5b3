"""gark convert --to recovered writes the method that a rounded file means: its digits are true."""

from __future__ import annotations

import re

import pytest
from flint import arb, ctx, fmpq, fmpq_poly

from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_method
from garkcli.conversion.convert import convert
from garkcli.conversion.sheet import CannotConvert
from garkcli.errors import MethodError, UsageProblem
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from garkcli.order.meant import as_meant
from garkcli.order.polishing import polished
from garkcli.order.rounded import RoundedTableau
from garkcli.order.rows import Label
from tests.cli.harness import gark
from tests.whole import in_whole

TR_BDF2 = """
tolerance: 1e-13
A:
  - [0, 0, 0]
  - [0.29289321881345, 0.29289321881345, 0]
  - [0.35355339059327, 0.35355339059327, 0.29289321881345]
b: [0.35355339059327, 0.35355339059327, 0.29289321881345]
expect: {order: 2, l-stable: true}
"""
FAMILY = "{tolerance: 1e-3, A: [[0, 0], [0.6667, 0]], b: [0.2496, 0.7496]}"
AT_AN_END = """
tolerance: 1e-6
A: [[0, 0, 0], [1/4, 0, 0], [0, 1, 0]]
b: [0.2, 0.4, 0.39999895]
"""
FURTHER = """
tolerance: 1e-9
A: [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.75, 0, 0], [0.222222222, 0.333333333, 0.444444444, 0]]
b: [0.222222222, 0.333333333, 0.444444444, 0]
embedded: [0.291666667, 0.25, 0.333333333, 0.125]
dense:
  degree: 3
  weights:
    - [1, -1.333333333, 0.555555556]
    - [0, 1, -0.666666667]
    - [0, 1.333333333, -0.888888889]
    - [0, -1, 1]
"""


def recovered(text: str, digits: int | None = None, is_recognising: bool = False) -> MethodFile:
    """The file that is written."""
    return convert(loads(text), "recovered", None, digits, is_recognising).method


def search_of(text: str) -> RoundedTableau:
    """The rounded method with all its orders decided."""
    method = loads(text)
    analyse(method.tableau, tolerance=method.tolerance, further=method.further)
    found = as_meant(method)
    assert isinstance(found, RoundedTableau)
    return found


def numbers(text: str) -> list[fmpq]:
    """The decimals of a file with a point in them, in their order."""
    return [fmpq(int(x.replace(".", "")), 10 ** len(x.split(".")[1])) for x in decimals(text)]


def decimals(text: str) -> list[str]:
    """The same as they are written."""
    return re.findall(r"-?[0-9]+\.[0-9]+", text)


def test_radicals_of_a_rounded_method() -> None:
    """Of TR-BDF2 in 14 digits the exact method is written, as its authors derived it: in ℚ(√2),
    without a tolerance, of order 2 and not 3, and L-stable.
    """
    made = recovered(TR_BDF2, is_recognising=True)
    exact = loads(
        "{A: [[0, 0, 0], [1 - sqrt(2)/2, 1 - sqrt(2)/2, 0], [sqrt(2)/4, sqrt(2)/4, 1 - sqrt(2)/2]],"
        " b: [sqrt(2)/4, sqrt(2)/4, 1 - sqrt(2)/2]}"
    )
    assert made.tolerance is None
    assert str(made.A) == str(exact.A)
    assert find_order(made.tableau).order == 2
    assert all(claim.holds for claim in check_method(made).claims)


@pytest.mark.parametrize("digits", [3, 50, pytest.param(200, marks=in_whole)])
def test_digits_are_those_of_the_exact_numbers(digits: int) -> None:
    """Each decimal is the one nearest to its number, computed from √2 in balls, and the tolerance
    is a unit of the last digit.
    """
    made = recovered(TR_BDF2, digits)
    with ctx.workdps(2 * digits + 10):
        gamma, weight = 1 - arb(2).sqrt() / 2, arb(2).sqrt() / 4
        wanted = [gamma, gamma, weight, weight, gamma]
        unit = fmpq(10) ** -digits
        written = [x for row in made.A for x in row if x]
        assert all(abs(x - arb(y)) < unit / 2 for x, y in zip(wanted, written, strict=True))
    assert made.tolerance == unit
    assert all(len(x.split(".")[1]) <= digits for x in decimals(made.text))


def test_of_a_family_the_nearest_method_is_taken() -> None:
    """Two stages of order 2 are a family, b2 a = 1/2 and b1 = 1 − b2: the digits are those of the
    root of the polynomial that says where the sum of the squares of the shifts is least.
    """
    made = recovered(FAMILY, 40)
    a, b1, b2 = (fmpq(x, 10**4) for x in (6667, 2496, 7496))
    # half the derivative of (a − a')² + (b1 − b1')² + (b2 − b2')² by b2, times 4 b2³
    b = fmpq_poly([0, 1])
    slope = (fmpq_poly([1]) - 2 * a * b) * -1 + 4 * b**3 * ((b - b2) + (b - 1 + b1))
    roots = [root.ball(300) for root, _ in real_roots(Polynomial.from_flint(slope))]
    (near,) = [x for x in roots if abs(x - arb(b2)) < 1e-3]
    with ctx.workdps(80):
        wanted = [1 / (2 * near), 1 - near, near]
        written = [made.A[1][0], *made.b]
        half = arb(10) ** -40 / 2
        assert all(abs(x - arb(y)) < half for x, y in zip(wanted, written, strict=True))


def test_numbers_stay_within_their_radii() -> None:
    """Without a bound the weights of least squares would be 1.0096 t off at b3: it is moved by t, and
    the others by what is nearest then.
    """
    made = recovered(AT_AN_END, 12)
    assert [*made.b] == [fmpq(19999985, 10**8), fmpq(4000002, 10**7), fmpq(39999995, 10**8)]


def test_numbers_stay_at_their_ends() -> None:
    """1 − 1e-12 has to be 1, which is as far as it may go; the other numbers move by 1e-20."""
    text = (
        "{tolerance: {others: 1e-20, embedded: 1e-12}, A: [[0, 0], [0.66666666666666666667, 0]],"
        " b: [0.25, 0.75], embedded: [0.999999999999, 0]}"
    )
    made = recovered(text, 30)
    assert made.embedded == ((1, 0),)
    assert abs(made.b[1] * made.c[1] - fmpq(1, 2)) < fmpq(1, 10**29)


@pytest.mark.parametrize("text", [FAMILY, pytest.param(FURTHER, marks=in_whole)])
def test_digits_do_not_depend_on_the_start(text: str) -> None:
    """Wherever floats lead the search to, give or take 1e-9 t, the same digits are written."""
    found = search_of(text)
    shifts = polished(found.search, 60).shifts
    place = found.search.place
    moves = [x + fmpq(k + 1, 10**9) for k, x in enumerate(place.shifts)]
    place.shifts = tuple(moves)
    again = polished(found.search, 60).shifts
    assert all(abs(x - y) < fmpq(1, 10**60) for x, y in zip(shifts, again, strict=True))


@in_whole
def test_further_weights_are_written_too() -> None:
    """Embedded weights and dense output are those of the same method, with as many digits; all
    orders hold within a unit of the last digit, and no number moves by more than t.
    """
    made = recovered(FURTHER, 30)
    before = loads(FURTHER)
    assert made.tolerance == fmpq(1, 10**30)
    found = analyse(made.tableau, tolerance=made.tolerance, further=made.further)
    assert found.order.order == 3
    assert found.embedded is not None
    assert found.embedded.order.order == 2
    assert found.dense is not None
    assert found.dense.order.order == 3
    rows = zip(before.further.rows, made.further.rows, strict=True)
    pairs = [(x, y) for one, other in rows for x, y in zip(one[0], other[0], strict=True)]
    assert all(abs(x - y) <= fmpq(1, 10**9) + fmpq(1, 10**30) for x, y in pairs)


@in_whole
def test_claims_of_long_compositions_stay() -> None:
    """Each row of sums is longer than the one before, and each number is printed many times: all
    that was true of the method is found again within its new digits, its symmetry too.
    """
    made = convert(load("blanes-moan-srkn-11b"), "recovered")
    assert made.left_out == ()
    assert {"B", "C", "D", "sharp-bound"} <= {claim.key for claim in made.method.claims}


def test_exact_entries_stay_exact() -> None:
    """Short fractions are exact, so they are written as they are; decimals may be off."""
    made = recovered("{tolerance: 1e-20, A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2],"
                     " embedded: [0.3, 0.7]}")  # fmt: skip
    assert "b:\n    - [1/2, 1/2]" in made.text
    assert "- [0.3, 0.7]" in made.text


def test_numbers_that_are_not_recognised_stay_decimals() -> None:
    """The nearest method of a family is in no field of small degree."""
    assert recovered(FAMILY, 50, is_recognising=True).tolerance == fmpq(1, 10**50)


def test_a_finer_tolerance_keeps_its_digits() -> None:
    """Without --digits there are as many as the file has, and 50 at least."""
    fine = FAMILY.replace("1e-3", "1e-70").replace("0.6667", "0.5").replace("0.2496", "0.0")
    fine = fine.replace("0.7496", "1.0").replace("0.0,", "0,")
    assert recovered(fine).tolerance <= fmpq(1, 10**70)
    assert recovered(FAMILY).tolerance == fmpq(1, 10**50)


def test_of_exact_methods_nothing_is_recovered() -> None:
    """The message says so, and what says that coefficients are rounded; digits are for this form."""
    with pytest.raises(CannotConvert, match="nothing to recover"):
        recovered("{A: [[0]], b: [1]}")
    with pytest.raises(UsageProblem, match="has the numbers of the file"):
        convert(loads(TR_BDF2), "gark", digits=5)
    result = gark("convert", "rk4", "--digits", "5")
    assert result.code == 2
    assert "--to recovered" in result.err


def test_no_digits_are_invented() -> None:
    """Where rows exclude each other there is no method to more digits, and the error says so."""
    search = search_of(FAMILY).search
    search.shape = {"method": {Label("node", 0, k=0): [1], Label("node", 0, k=1): [1]}}
    with pytest.raises(MethodError, match="no more digits"):
        polished(search, 40)
