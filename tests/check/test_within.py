"""Reports within a tolerance: whatever is rounded and by whatever tolerance it is judged, no line
contradicts another.
"""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq
from hypothesis import example, given, settings
from hypothesis import strategies as st

from garkcli.api.calls import find_stability
from garkcli.check.analysis import Analysis, analyse
from garkcli.check.check_file import check_method
from garkcli.check.claims import verify
from garkcli.check.outcome import Outcome
from garkcli.methodfile.load import loads
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.meant import as_meant
from garkcli.order.recovering import Recovery, RecoveryFailure
from garkcli.order.rounded import RoundedTableau
from garkcli.page.look import Look
from garkcli.report.check_text import render
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau, butcher
from tests.oracles import samples
from tests.order.rounded_samples import in_decimals
from tests.whole import at_most, in_whole, sample

SMALL = [
    name
    for name, make in samples.NAMED.items()
    if not make().is_partitioned and sum(space.stages for space in make().spaces) <= 5
]
GAUSS = "methods: [{A: [[0.25, -0.03867513], [0.53867513, 0.25]], b: [0.5, 0.5]}]\n"
LIMIT = at_most(5, 9)


def words(outcomes: list[Outcome]) -> str:
    """The report with every fact, in one line."""
    return " ".join(render(outcomes, Look(), verbosity=1).split())


def assert_no_contradiction(found: Analysis) -> None:
    """What follows from each other holds together."""
    own, conjugate, both = found.order, found.conjugate_order, found.pair_order
    assert found.bound <= found.sharp_bound <= own.order
    assert bool(found.inconsistent) == any(0 in row for row in found.simplifying.C)
    if not found.inconsistent:
        assert min(found.simplifying.B) >= own.order
    if (
        found.pair is None
        or conjugate is None
        or both is None
        or found.pair_bound is None
        or found.pair_sharp_bound is None
    ):
        return
    assert found.pair_bound <= found.pair_sharp_bound <= both.order
    assert both.order <= min(own.order, conjugate.order)
    assert found.pair_bound <= found.bound
    assert found.pair_sharp_bound <= found.sharp_bound
    if not own.is_lower_bound and own.order < 2:
        assert conjugate.order <= own.order
    if found.symplectic:
        assert own.order == conjugate.order == both.order
        assert own.is_lower_bound == conjugate.is_lower_bound == both.is_lower_bound


@in_whole
@settings(max_examples=at_most(3, 20))
@example("radau-ia 3", 5, fmpq(1, 2))
@given(
    st.sampled_from(SMALL),
    st.sampled_from([3, 5, 8, 12, 16]),
    st.sampled_from([fmpq(1, 2), fmpq(1), fmpq(3), fmpq(30)]),
)
def test_no_report_on_a_rounded_method_contradicts_itself(
    name: str, digits: int, units: fmpq
) -> None:
    """Methods cut off after some digits, with tolerances from half a digit to thirty; where those
    are as coarse as a hundredth every order holds, up to a limit that is lower.
    """
    method, tolerance = in_decimals(samples.NAMED[name](), digits), units / fmpq(10) ** digits
    limit = LIMIT if tolerance < fmpq(1, 100) else at_most(3, 5)
    assert_no_contradiction(analyse(method, limit, tolerance))


def random_method(dice: Random) -> Tableau:
    """Two or three stages, symplectic up to rounding; weights down to a thousandth."""
    stages = dice.choice([2, 3])
    b = [fmpq(dice.choice([1, 5, 300, 700]), 1000) for _ in range(stages - 1)]
    b.append(1 - sum(b, fmpq(0)))
    error = fmpq(1, 10 ** dice.choice([6, 9]))
    rows = [[fmpq(0)] * stages for _ in range(stages)]
    for i in range(stages):
        rows[i][i] = b[i] / 2
        for j in range(i):
            rows[i][j] = fmpq(dice.randint(-9, 9), 10)
            rows[j][i] = b[j] - b[j] * rows[i][j] / b[i] if b[i] else fmpq(0)
    rows = [[x + error * fmpq(dice.randint(-9, 9), 10) for x in row] for row in rows]
    return gark([butcher(tuple(tuple(row) for row in rows), tuple(b))], {})


@settings(max_examples=at_most(10, 300))
@given(st.integers(0, 2**32 - 1), st.integers(5, 11))
def test_nearly_symplectic_methods(seed: int, exponent: int) -> None:
    """Small weights make the conjugate many times less certain than the method."""
    found = analyse(random_method(Random(seed)), LIMIT, fmpq(1, 10**exponent))
    assert_no_contradiction(found)


@pytest.mark.parametrize(
    ("rows", "tolerance"),
    [
        ("[[4/5, -4/5], [-1/5, 701663/990000]]", "1e-3"),
        ("[[17/20, -7/10], [0, 44207/99000]]", "1e-2"),
    ],
)
def test_conjugate_and_pair_fail_order_2_with_the_method(rows: str, tolerance: str) -> None:
    """Though rounding would explain it in them: both divide by a small weight."""
    method = loads(f"A: {rows}\nb: [1/100, 99/100]\ntolerance: {tolerance}\n")
    found = analyse(method.tableau, LIMIT, method.tolerance)
    assert_no_contradiction(found)
    assert found.order.witness is not None
    assert found.pair_order is not None
    assert found.pair_order.witness == found.order.witness


@in_whole
def test_a_tolerance_that_is_too_tight_gets_the_one_that_would_do() -> None:
    """Gauss 2 in 8 decimals is off by 4e-9: with 1e-9 the hint says 1e-8, and that does."""
    method = loads(f"{GAUSS}tolerance: 1e-9\n")
    outcome = check_method(method, LIMIT)
    found, remark = outcome.analysis, outcome.remark
    assert found is not None
    assert (found.order.order, found.bound) == (2, 2)
    assert remark is not None
    assert (remark.line, remark.order) == ("tolerance: 1e-8", 4)
    shown = words([outcome])
    assert "the tolerance 1e-9 is too tight: the coefficients look rounded to 8" in shown
    assert "with the line tolerance: 1e-8 order 4 holds" in shown
    outcome = check_method(loads(f"{GAUSS}{remark.line}\n"), LIMIT)
    better = outcome.analysis
    assert better is not None
    assert outcome.remark is None
    assert (better.order.order, better.bound, better.pair_bound) == (4, 4, 4)
    assert better.symplectic


def test_what_is_left_open_confirms_no_exact_claim() -> None:
    """An order that is a lower bound confirms `>= n`, and leaves an equal number open."""
    body = "methods: [{A: [[0, 0], [0.1, 0.4]], b: [0.0000001, 0.9999999]}]\ntolerance: 1e-6\n"
    for claim, holds in (("'>= 2'", True), ("2", None)):
        method = loads(f"{body}expect: {{conjugate-order: {claim}}}\n")
        (found,) = verify(method.claims, analyse(method.tableau, LIMIT, method.tolerance))
        assert found.holds is holds


@pytest.mark.parametrize("name", sample(SMALL, 2))
def test_much_finer_tolerances_say_what_is_exactly_so(name: str) -> None:
    """Exact rational methods keep their verdicts within 10⁻⁴⁰."""
    method = samples.NAMED[name]()
    near, exact = (analyse(method, LIMIT, fmpq(1, 10**40)), analyse(method, LIMIT))
    orders = [
        [x if x is None else x.order for x in (a.order, a.conjugate_order, a.pair_order)]
        for a in (near, exact)
    ]
    assert orders[0] == orders[1]
    assert (near.bound, near.pair_bound, near.symplectic) == (
        exact.bound,
        exact.pair_bound,
        exact.symplectic,
    )
    bounds = [(a.sharp_bound, a.pair_sharp_bound) for a in (near, exact)]
    assert bounds[0] == bounds[1]


@pytest.mark.parametrize("stages", [2, pytest.param(3, marks=in_whole)])
def test_three_digits_refute_nothing(stages: int) -> None:
    """Gauss methods cut off after three digits have their order within 1e-3: a report may leave it
    open.
    """
    method = in_decimals(gark([samples.method(f"gauss {stages}")], {}), 3)
    found = analyse(method, LIMIT, fmpq(1, 1000))
    assert_no_contradiction(found)
    assert found.order.order >= 2 * stages or found.order.witness is None


def test_an_order_that_the_shape_excludes_may_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    """A proof that no method has an order and the shape of the digits says nothing of the order
    alone.
    """
    box = as_meant(loads(f"tolerance: 1e-6\n{GAUSS}"))
    assert isinstance(box, RoundedTableau)
    search = box.search
    assert search.settled
    answers = iter([RecoveryFailure(True), RecoveryFailure(False)])
    monkeypatch.setattr(search, "move", lambda _: next(answers))
    tree = Tree(0, (Tree(0),) * 4)
    failure = search._meet({"method": [tree]})
    assert failure is not None
    assert not failure.is_proved


def test_a_file_of_order_0_has_a_full_report() -> None:
    """Weights whose sum is 2/5: nothing is proved to exist, and every line is there."""
    text = "{name: x, tolerance: 1e-6, A: [[0, 0], [0.5, 0]], b: [0.1, 0.3]}"
    outcome = check_method(loads(text))
    assert outcome.analysis is not None
    assert outcome.analysis.nearness is not None
    assert not outcome.analysis.nearness.is_proved
    assert "order 0 within 1e-6" in words([outcome])


@pytest.mark.parametrize(
    ("tolerance", "verdict"), [("1e-7", (None, None)), ("1e-9", (False, False))]
)
def test_what_another_method_within_t_may_have_is_not_refuted(
    tolerance: str, verdict: tuple[bool | None, bool | None]
) -> None:
    """2/7, 11/28, 3/14 make an A-stable method on the edge, which is within 1e-7 of these digits;
    the nearest method of order 2 is not A-stable. Within 1e-9 there is none.
    """
    text = "{A: [[0.2857142, 0], [0.3928571, 0.2142857]], b: [1/3, 2/3], tolerance: 1e-7}"
    edge = loads("{A: [[2/7, 0], [11/28, 3/14]], b: [1/3, 2/3]}")
    assert find_stability(edge).linear[0].a_stable
    method = loads(text.replace("1e-7", tolerance))
    found = find_stability(method).linear[0]
    analysis = analyse(method.tableau, tolerance=method.tolerance)
    assert (found.a_stable, analysis.subject.verdict("a-stable").value) == verdict


def test_dense_output_fails_by_proof_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the search for a method with the next order gives up, the order is left open."""
    text = (
        "{tolerance: 1e-3, A: [[0, 0], [0.6667, 0]], b: [0.25, 0.75],"
        " dense: {degree: 2, weights: [[1, -0.5], [0, 0.5]]}}"
    )
    whole = Recovery.recover_dense
    for is_proved in (True, False):
        method = loads(text)
        if not is_proved:
            monkeypatch.setattr(
                Recovery,
                "recover_dense",
                lambda x, limit: (whole(x, limit)[0], RecoveryFailure(False)),
            )
        found = analyse(method.tableau, tolerance=method.tolerance, further=method.further)
        assert found.dense is not None
        assert found.dense.order.order == 1
        assert bool(found.dense.order.witness) == is_proved
        assert bool(found.dense.order.undecided) != is_proved


def test_weights_that_may_be_zero_leave_the_others_alone() -> None:
    """The conjugate divides by 0.0005 ± 0.001; that explicit stages have no order 3 stays proved,
    for the pair too.
    """
    method = loads("{tolerance: 1e-3, A: [[0, 0], [0.5, 0]], b: [0.0005, 0.9995]}")
    found = analyse(method.tableau, at_most(3, DEFAULT_LIMIT), method.tolerance)
    assert found.pair_order is not None
    assert (found.pair_order.order, found.pair_order.is_lower_bound) == (2, False)
