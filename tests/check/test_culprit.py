"""Which entry or which sum is wrong in a file that claims nothing, and in one that does."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.check.check_file import check_method
from garkcli.check.findings import claim_hint, hints
from garkcli.check.outcome import Outcome
from garkcli.exact.display import to_float
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from garkcli.order.conditions import all_conditions
from garkcli.order.repair import Repair
from garkcli.report.checked import REPORT
from tests.whole import in_whole

RK4 = "A: [[], [1/2], [0, {a32}], [0, 0, 1]]\nb: [1/6, 1/3, 1/3, {b4}]\n"
NODES = "c: [0, 1/2, 1/2, 1]\n"


def checked(text: str) -> Outcome:
    """The outcome of a text."""
    return check_method(loads(text))


def told(outcome: Outcome) -> str:
    """Its report, in one line."""
    return " ".join(REPORT.render([outcome], width=400).split())


@pytest.mark.parametrize("claims", ["", "expect: {order: 4}\n", "expect: {symplectic: false}\n"])
@pytest.mark.parametrize("nodes", ["", NODES])
def test_an_entry_is_named_whatever_is_claimed(claims: str, nodes: str) -> None:
    """The one wrong entry of the method of Kutta is named with its value, with and without a claim
    and nodes; carried out, it gives order 4 and no more.
    """
    outcome = checked(RK4.format(a32="1/3", b4="1/6") + nodes + claims)
    assert outcome.blame is not None
    (repair,) = outcome.blame.repairs
    assert repair == Repair(0, 0, 2, 1, fmpq(1, 3), fmpq(1, 2))
    assert outcome.analysis is not None
    assert find_order(repair.carried_out(outcome.analysis.tableau)).order == 4
    assert "would hold with a[3,2] = 1/2 instead of 1/3" in told(outcome)
    assert ("row 3 has the sum 1/3, its node is 1/2" in told(outcome)) is bool(nodes)


def test_a_claim_that_holds_is_believed() -> None:
    """Who claims order 1 of the same table knows of it."""
    assert checked(RK4.format(a32="1/3", b4="1/6") + "expect: {order: 1}\n").blame is None


@pytest.mark.parametrize("claims", ["", "expect: {order: 4}\n"])
def test_a_wrong_sum_of_weights_is_told(claims: str) -> None:
    """The weights of the method with two slips sum to 7/6, and no single entry mends it; programs
    read the sum too.
    """
    outcome = checked(RK4.format(a32="1/3", b4="1/3") + claims)
    assert [x.message for x in hints(outcome)] == ["the weights have the sum 7/6"]
    (found,) = REPORT.data(outcome)["wrong_sums"]
    assert (found["b"], found["sum"], found["required"]) == ([1], "7/6", "1")


def test_a_wrong_weight_is_named() -> None:
    """Each weight alone could mend the sum; one of them mends order 4."""
    said = [x.message for x in hints(checked(RK4.format(a32="1/2", b4="1/3")))]
    entry = "order 4 would hold with b[4] = 1/6 instead of 1/3"
    assert said == ["the weights have the sum 7/6", entry]


def test_a_repair_that_reaches_less_than_the_claim() -> None:
    """Decimals that are rounded have order 2 with another weight; nothing says order 4 of it."""
    text = RK4.format(a32="1/2", b4="0.16").replace("1/6", "0.16666667")
    text = text.replace("1/3", "0.33333333") + "expect: {order: 4}\n"
    outcome = checked(text)
    entry = "order 2 would hold with b[4] = 0.16666667 instead of 4/25"
    assert [str(claim_hint(outcome, "order")), [*hints(outcome)][-1].message] == [entry, entry]


def test_all_conditions_that_fail_are_counted() -> None:
    """Equal weights at 0 and 1 have order 2, and with another matrix no condition of order 3."""
    text = "ark:\n  A: [[[0, 0], [1, 0]], [[1/2, 0], [0, 1/2]]]\n  b: [[1/2, 1/2], [1/2, 1/2]]\n"
    outcome = checked(text + "expect: {order: 3}\n")
    assert outcome.blame is not None
    assert outcome.blame.failing == outcome.blame.total
    assert f"hint all {outcome.blame.total} conditions of order 3 fail" in told(outcome)


def test_an_embedded_weight_is_named() -> None:
    """The embedded weights of Bogacki and Shampine with 1/8 for 1/4: their sum and the entry."""
    text = (
        "A: [[], [1/2], [0, 3/4], [2/9, 1/3, 4/9]]\nb: [2/9, 1/3, 4/9, 0]\n"
        "embedded: [7/24, 1/8, 1/3, 1/8]\n"
    )
    said = [x.message for x in hints(checked(text))]
    assert said == [
        "the embedded weights have the sum 7/8",
        "embedded order 2 would hold with embedded b[2] = 1/4 instead of 1/8",
    ]


@in_whole
def test_decimals_are_mended_within_their_rounding() -> None:
    """A digit of the matrix of the method of Alexander in decimals, without tolerance and claims:
    the entry is named, with the digits that it had.
    """
    entries = ("0.4358665215", "0.2820667392", "0.4358665215", "1.2084966492", "-0.6443631707")
    g, a21, _, b1, b2 = entries
    text = f"A: [[{g}], [{a21}, {g}], [{b1}, {b2}, {g}]]\nb: [{b1}, {b2}, {g}]\n"
    assert not any("would hold" in str(x) for x in hints(checked(text)))
    wrong = checked(text.replace("[0.28", "[0.38")).blame
    assert wrong is not None
    assert wrong.restored == 3
    (repair,) = (x for x in wrong.repairs if x.i == 1 and x.j == 0)
    assert abs(repair.new - fmpq(2820667392, 10**10)) < fmpq(1, 10**8)


TSITOURAS = """A:
  - []
  - [0.161]
  - [-0.008480655492356989, 0.335480655492357]
  - [2.8971530571054935, -6.359448489975075, 4.3622954328695815]
  - [5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525]
  - [5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401,
     -0.028269050394068383]
b: [0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081,
    2.324710524099774]
"""


@pytest.mark.parametrize("claim", ["", "expect: {order: 5}\n"])
def test_a_wrong_entry_is_named_beside_the_missing_tolerance(claim: str) -> None:
    """Two digits of a_63 of Tsitouras' method in decimals are exchanged, and no tolerance is given:
    the hint on it, with which order 1 holds, does not hide the entry, with which order 5 does. The
    right method has the hint alone.
    """
    right = checked(TSITOURAS + claim)
    assert "instead of" not in told(right)
    assert right.remark is not None
    assert right.remark.order == 5
    text = TSITOURAS.replace("8.159367898576159", "8.159376898576159") + claim
    wrong = checked(text)
    assert wrong.blame is not None
    assert wrong.blame.within == fmpq(1, 10**15)
    (repair,) = wrong.blame.repairs
    assert (repair.i, repair.j) == (5, 2)
    assert repair.new == fmpq(8159367898576159, 10**15)
    goal = "the claimed order" if claim else "order 5"
    new, old = "8.159367898576159", "8.159376898576159"
    assert f"within 1e-15 {goal} would hold with a[6,3] = {new} instead of {old}" in told(wrong)
    assert "tolerance: 1e-15 order 1 holds" in told(wrong)
    # the second way: with both changes in the file the order is there
    mended = checked(text.replace(old, new) + "tolerance: 1e-15\n").analysis
    assert mended is not None
    assert mended.order.order == 5


ALEXANDER = """A: [[0.4359, 0, 0], [0.2821, 0.4359, 0], [1.2085, -0.6444, 0.4359]]
b: [1.2085, -0.6444, 0.4359]
"""
SHEET = "A: [[], [0.5], [0, 0.5], [0, 0, 1]]\nb: [0.1667, 0.3333, 0.3333, {}]\n"


@pytest.mark.parametrize("claim", ["", "expect: {order: 3}\n"])
def test_decimals_of_a_sheet_look_rounded(claim: str) -> None:
    """Alexander's method and RK4 with four decimals, as a student types them: the line to write is
    named, and with it the order is there. Two decimals are rounded if both are simple fractions; one
    alone only beside no fraction.
    """
    for text, places, order in (
        (ALEXANDER, 4, 3),
        (SHEET.format("0.1667"), 4, 4),
        ("A: [[], [0.3333], [0, 0.6667]]\nb: [0.25, 0, 0.75]\n", 4, 3),
        ("A: [[], [0.5], [0, 0.5], [0, 0, 1]]\nb: [0.1667, 1/3, 1/3, 1/6]\n", 4, 4),
        ("A: [[], [0.6667]]\nb: [0.25, 0.75]\n", 4, 2),
        ("A: [[], [0.5], [0, 0.5], [0, 0, 1]]\nb: [0.167, 0.333, 0.333, 0.167]\n", 3, 4),
    ):
        found = checked(text + claim).remark
        assert found is not None
        assert (found.line, found.order) == (f"tolerance: 1e-{places}", order)
        within = checked(f"{text}{found.line}\n").analysis
        assert within is not None
        assert within.order.order == order
    for text in ("A: [[], [0.625]]\nb: [0.2, 0.801]\n", "A: [[], [0.667]]\nb: [0.25, 0.75]\n"):
        assert checked(text).remark is None


@pytest.mark.parametrize("claim", ["", "expect: {order: 4}\n"])
def test_a_claim_hides_no_wrong_entry(claim: str) -> None:
    """A digit of the last weight of the sheet is wrong: the entry is named, claimed or not."""
    wrong = checked(SHEET.format("0.1567") + claim).blame
    assert wrong is not None
    assert [(x.old, x.new) for x in wrong.repairs] == [(fmpq(1567, 10**4), fmpq(1667, 10**4))]


ARS_232 = """parameters: {g: 1 - sqrt(2)/2, d: -2*sqrt(2)/3}
ark:
  c: [0, g, 1]
  A: [[[], [g], [d, 1 - d]], [[0], [0, g], [0, 1 - g, g]]]
  b: [0, 1 - g, g]
expect: {order: 2}
"""


def test_entries_that_mend_a_row_come_first() -> None:
    """The implicit matrix of ARS(2,3,2) has √2/3 for √2/2: of all entries that would restore the
    order, the one that mends the sum of its row too is named first.
    """
    assert checked(ARS_232).ok
    wrong = checked(ARS_232.replace("[0, 1 - g, g]]]", "[0, sqrt(2)/3, g]]]")).blame
    assert wrong is not None
    assert len(wrong.repairs) > 3
    first = wrong.repairs[0]
    assert (first.m, first.i, first.j) == (1, 2, 1)
    assert str(first.new) == str(checked(ARS_232).analysis.tableau.blocks[0, 1][2][1])


NAMES = ["forward-euler", "midpoint", "heun", "kutta", "rk4", "imex-ssp2-222", "theta-23"]
PUBLISHED = [
    *(*NAMES, "backward-euler", "bogacki-shampine-3"),
    pytest.param("ars-343", marks=in_whole),
    "lobatto-iiia-iiib-2",
]


@pytest.mark.parametrize("name", PUBLISHED)
def test_right_methods_have_no_slip(name: str) -> None:
    """No entry of a published method is called wrong when its claims are left out, though some are
    one entry away from the next order.
    """
    assert check_method(replace(load(name), claims=())).blame is None


def test_a_rounded_method_fails_by_its_largest_residual() -> None:
    """ARS(3,4,3) misses order 4 by rounding in some conditions; the one that is shown is of the size
    of the largest of all.
    """
    tableau = load("ars-343").tableau
    witness = find_order(tableau).witness
    assert witness is not None
    largest = max(abs(to_float(x.residual)) for x in all_conditions(tableau, 4))
    assert abs(to_float(witness.residual)) > largest / 2 > 1e-2


def test_within_a_tolerance_the_largest_residual_is_shown() -> None:
    """Of the trapezoidal rule within a tolerance bᵀc² fails by 1/6 and bᵀAc by 1/12: the first is
    shown, though the search meets the second one first.
    """
    outcome = checked("A: [[0, 0], [1/2, 1/2]]\nb: [1/2, 1/2]\ntolerance: 1e-9\n")
    assert outcome.analysis is not None
    witness = outcome.analysis.order.witness
    assert witness is not None
    assert (str(witness.tree), witness.residual) == ("[[],[]]", fmpq(1, 6))


@pytest.mark.parametrize(("nodes", "is_named"), [("", False), ("c: [0, 1/2]\n", True)])
def test_one_order_more_is_told_where_the_node_agrees(nodes: str, is_named: bool) -> None:
    """a₂₁ = 1/2 in place of 1/3 gives order 2 for 1: the node 1/2 says that it was meant."""
    outcome = checked("A: [[0, 0], [1/3, 0]]\nb: [0, 1]\n" + nodes)
    found = () if outcome.blame is None else outcome.blame.repairs
    assert found == ((Repair(0, 0, 1, 0, fmpq(1, 3), fmpq(1, 2)),) if is_named else ())


def test_a_block_of_stages_behind_an_algebra_is_named() -> None:
    """Nodes of Gauss without radicals have no rows; row 2 of the other method has the wrong sum."""
    outcome = checked(
        "methods: [{family: gauss, stages: 7}, {A: [[0, 0], [1/3, 0]], c: [0, 1/2], b: [1/2, 1/2]}]\n"
        "transfer: interpolation\n"
    )
    assert "row 2 of A{2,2} has the sum 1/3, its node is 1/2" in " ".join(told(outcome).split())
