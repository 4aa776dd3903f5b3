"""``tolerance`` by place, and by the digits of decimals."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.api.asserting import find_orders
from garkcli.api.design import find_parameters
from garkcli.bridges.preparing import prepared
from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_method
from garkcli.check.existing import prove_method_exists
from garkcli.conversion.convert import convert
from garkcli.design.within import DesignWithin
from garkcli.errors import MethodError, MethodFileError
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.file_keys import method_file_schema
from garkcli.methodfile.load import loads
from garkcli.methodfile.rounded_family import filled
from garkcli.methodfile.tolerance import DIGITS, Tolerance
from garkcli.order.certificate import Order
from garkcli.order.dense import DenseOrder
from garkcli.order.meant import as_meant
from garkcli.order.rounded import RoundedOrder
from garkcli.tableau.tableau import Tableau
from tests.whole import in_whole

RK4 = "A: [[], [0.5], [0, 0.5], [0, 0, 1]]\nb: [1/6, 1/3, 1/3, 1/6]\n"
EMBEDDED = f"{RK4}embedded: [0.166666666667, 0.333333333333, 0.333333333333, 0.166666666667]\n"
TWO_THIRDS = "A: [[0, 0], [0.6667, 0]]\nb: [0.25, 0.75]\n"
PLACES = (
    "A: [[0, 0], [0.66666666666666666667, 0]]\nb: [0.25, 0.75]\nembedded: [0.99999, 0]\n"
    "dense: {degree: 2, weights: [[1, -0.74999999], [0, 0.74999999]]}\n"
)


def test_an_exact_method_has_exact_verdicts_beside_rounded_embedded_weights() -> None:
    """A, b and c are decided by the certificate; of embedded weights that are rounded all orders
    hold that those of the exact weights have, within their tolerance, and no more.
    """
    method = loads(f"tolerance: {{embedded: 1e-12}}\n{EMBEDDED}")
    exact = loads(f"{RK4}embedded: [1/6, 1/3, 1/3, 1/6]")
    found = analyse(method.tableau, 8, method.tolerance, further=method.further)
    wanted = analyse(exact.tableau, 8, further=exact.further)
    assert isinstance(as_meant(method), Tableau)
    assert (method.tolerance, method.embedded_tolerance) == (None, fmpq(1, 10**12))
    assert isinstance(found.order, Order)
    assert found.order == wanted.order
    assert found.subject.tolerance == 0
    assert found.embedded is not None
    assert wanted.embedded is not None
    assert isinstance(found.embedded.order, RoundedOrder)
    assert found.embedded.order.order == wanted.embedded.order.order == 4
    assert found.embedded.order.witness is not None
    assert found.embedded.order.tolerance == fmpq(1, 10**12)
    assert found.tolerance is None


def test_digits_that_are_exact_by_their_word_fail_what_rounded_ones_meet() -> None:
    """Without a tolerance for them the same embedded weights have order 0: their sum is no 1."""
    method = loads(EMBEDDED.replace("0.166666666667]", "0.166666666668]"))
    assert find_orders(method)["embedded"] == 0
    rounded = loads(f"tolerance: {{embedded: 1e-11}}\n{method.text}")
    assert find_orders(rounded) == {**find_orders(method), "embedded": 4}


def test_one_tolerance_leaves_a_method_without_decimals_exact() -> None:
    """A single tolerance is about the decimals of a file: where embedded weights alone are
    decimals, the method is exact and A-stable.
    """
    text = "tolerance: 1e-25\nA: [[0, 0], [1/2, 1/2]]\nb: [1/2, 1/2]\nembedded: [0.3, 0.7]\n"
    method = loads(f"{text}expect: {{order: 2, a-stable: true, embedded-order: 1}}")
    assert check_method(method).ok
    assert method.tolerance is None
    assert method.embedded_tolerance == fmpq(1, 10**25)


def test_each_verdict_names_the_largest_tolerance_that_it_depends_on() -> None:
    """b, embedded weights and dense output have three tolerances, and so have their orders."""
    method = loads(f"tolerance: {{others: 1e-20, embedded: 1e-4, dense: 1e-7}}\n{PLACES}")
    found = analyse(method.tableau, tolerance=method.tolerance, further=method.further)
    assert found.embedded is not None
    assert found.dense is not None
    assert isinstance(found.order, RoundedOrder)
    assert isinstance(found.embedded.order, RoundedOrder)
    told = [found.order, found.embedded.order, found.dense.order]
    assert [(x.order, x.tolerance) for x in told] == [
        (2, fmpq(1, 10**20)),
        (1, fmpq(1, 10**4)),
        (2, fmpq(1, 10**7)),
    ]
    assert found.dense.ends_at_step
    finer = loads(f"tolerance: {{others: 1e-20, embedded: 1e-6, dense: 1e-9}}\n{PLACES}")
    found = analyse(finer.tableau, tolerance=finer.tolerance, further=finer.further)
    assert found.embedded is not None
    assert found.dense is not None
    assert (found.embedded.order.order, found.dense.order.order) == (0, 1)


def test_dense_output_alone_may_be_rounded() -> None:
    """Rounded dense output beside an exact method has an order within its tolerance; embedded
    weights that are exact keep their exact order.
    """
    text = PLACES.replace("0.66666666666666666667", "2/3").replace("0.99999", "1")
    method = loads(f"tolerance: {{dense: 1e-7}}\n{text}")
    found = analyse(method.tableau, tolerance=method.tolerance, further=method.further)
    assert found.embedded is not None
    assert found.dense is not None
    assert isinstance(found.embedded.order, Order)
    assert (found.order.order, found.embedded.order.order) == (2, 1)
    assert isinstance(found.dense.order, DenseOrder)
    assert (found.dense.order.order, found.dense.order.tolerance) == (2, fmpq(1, 10**7))


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("q", "prk: {q: {A: [[0.3]], b: [1]}, p: {A: [[0.7]], b: [1]}}"),
        ("1", "prk: {q: {A: [[0.3]], b: [1]}, p: {A: [[0.7]], b: [1]}}"),
        ("2", "ark: {A: [[[0.7]], [[0.3]]], b: [[1], [1]]}"),
        ("2", "tableau: {A: [[[[0.7]], null], [[[0.3]], null]], b: [[1], [1]]}"),
        (
            "slow",
            "methods: [{A: [[0.7]], b: [1]}, {name: slow, A: [[0.3]], b: [1]}]\n"
            "transfer: collocation",
        ),
    ],
)
def test_a_colour_has_a_tolerance_of_its_own(key: str, text: str) -> None:
    """By its number or its name: only its numbers are rounded, in every form of a method."""
    method = loads(f"tolerance: {{{key}: 1e-5}}\n{text}")
    rounded = as_meant(method)
    assert not isinstance(rounded, Tableau)
    assert set(rounded.search.box.numbers) == {fmpq(3, 10)}
    assert set(rounded.search.box.radii) == {fmpq(1, 10**5)}
    both = loads(f"tolerance: {{{key}: 1e-5, others: 1e-9}}\n{text}")
    found = as_meant(both)
    assert not isinstance(found, Tableau)
    radii = dict(zip(found.search.box.numbers, found.search.box.radii, strict=True))
    assert radii == {fmpq(3, 10): fmpq(1, 10**5), fmpq(7, 10): fmpq(1, 10**9)}
    assert both.tolerance == fmpq(1, 10**5)


def test_embedded_weights_of_a_colour_are_embedded_first() -> None:
    """The key of what a number is comes before that of its colour."""
    text = "A: [[0.25]]\nb: [1]\nembedded: [0.75]"
    method = loads(f"tolerance: {{1: 1e-5, embedded: 1e-3}}\n{text}")
    assert (method.tolerance, method.embedded_tolerance) == (fmpq(1, 10**5), fmpq(1, 10**3))
    alone = loads(f"tolerance: {{1: 1e-5}}\n{text}")
    assert alone.embedded_tolerance == fmpq(1, 10**5)


def test_a_parameter_has_the_smallest_tolerance_of_its_places() -> None:
    """It is one number: exact where A is exact, though embedded weights with it are rounded."""
    text = "parameters: {g: 0.25, h: 0.125}\nA: [[g]]\nb: [1]\nembedded: [3/4 + g*h]"
    method = loads(f"tolerance: {{embedded: 1e-3}}\n{text}")
    assert method.tolerance is None
    box = method.tableau.__dict__["box"][1]()[0]
    assert (box.numbers, box.radii) == ((fmpq(1, 8),), (fmpq(1, 1000),))


def test_digits_make_each_decimal_off_by_a_unit_of_its_last() -> None:
    """Short decimals beside long ones are exact, whether as embedded weights or elsewhere; zeros
    after the point count as digits.
    """
    text = "A: [[0.5000000000, 0], [0.66666667, 0.1]]\nb: [0.0000025, 0.75]"
    rounded = as_meant(loads(f"tolerance: digits\n{text}"))
    assert not isinstance(rounded, Tableau)
    box = rounded.search.box
    assert dict(zip(box.numbers, box.radii, strict=True)) == {
        fmpq(1, 2): fmpq(1, 10**10),
        fmpq(66666667, 10**8): fmpq(1, 10**8),
        fmpq(25, 10**7): fmpq(1, 10**7),
    }
    assert rounded.tolerance == fmpq(1, 10**7)


def test_a_student_who_copies_decimals_writes_no_number() -> None:
    """Ralston's third-order method to four digits has order 3 within a unit of the last, and not
    within a thousandth of that.
    """
    text = "A: [[], [0.5], [0, 0.75]]\nb: [0.2222, 0.3333, 0.4444]"
    rounded = loads(f"tolerance: digits\n{text}")
    assert rounded.tolerance == fmpq(1, 10**4)
    assert find_orders(rounded)["order"] == 3
    assert find_orders(loads(f"tolerance: 1e-7\n{text}"))["order"] == 0
    mixed = loads(f"tolerance: {{others: digits, embedded: 0.1}}\n{text}\nembedded: [0.4, 0, 0.6]")
    assert (mixed.tolerance, mixed.embedded_tolerance) == (fmpq(1, 10**4), fmpq(1, 10))


@pytest.mark.parametrize(
    ("tolerance", "message", "cure"),
    [
        ("{embeded: 1e-12}", "no part 'embeded'", "did you mean 'embedded'?"),
        ("{3: 1e-12}", "no part '3'", "one of: others, embedded, dense, 1"),
        ("{others: 2}", "between 0 and 1 is expected, not '2'", "for instance 1e-13"),
        ("{others: 1e-9, dense: 1e-9}", "dense has no rounded number", "leave it out"),
        ("{embedded: digit}", "not 'digit'", "digits, for a unit"),
        ("{}", "tolerance is empty", "write for instance"),
        ("[1e-9]", "a single value", ""),
        ("{others: 1e-9, others: 1e-8}", "appears twice", "keep one"),
    ],
)
def test_a_wrong_tolerance_is_one_fault_with_its_cure(
    tolerance: str, message: str, cure: str
) -> None:
    """Unknown keys, numbers out of range, and keys that are about no rounded number."""
    with pytest.raises(MethodFileError) as refused:
        loads(f"tolerance: {tolerance}\n{TWO_THIRDS}embedded: [0.9999, 0]")
    [fault] = refused.value.faults
    assert message in fault.message
    assert cure in (fault.help or "")
    assert fault.line == 1


TWO_COLOURS = (
    "methods: [{{A: [[0.7]], b: [1.0]}}, {{name: {}, A: [[0.3]], b: [1.0]}}]\ntransfer: collocation"
)


@pytest.mark.parametrize("name", ["others", "embedded", "dense", "1"])
def test_a_key_that_is_the_name_of_a_colour_too_is_refused(name: str) -> None:
    """It would mean two things; a name that nothing else has, or that is its own number, does not,
    nor does one that is no key.
    """
    text = TWO_COLOURS.format(f'"{name}"')
    with pytest.raises(MethodFileError) as refused:
        loads(f"tolerance: {{{name}: 1e-5}}\n{text}")
    [fault] = refused.value.faults
    assert "may mean colour 2" in fault.message
    assert (fault.line, fault.help) == (1, "give the method another name")
    assert loads(f"tolerance: {{2: 1e-5}}\n{text}").tolerance == fmpq(1, 10**5)
    own = TWO_COLOURS.format('"2"')
    assert loads(f"tolerance: {{2: 1e-5}}\n{own}").tolerance == fmpq(1, 10**5)


def test_equal_tolerances_have_one_hash() -> None:
    """The order of keys says nothing."""
    offs = {"others": fmpq(1, 100), "embedded": DIGITS}
    one, other = Tolerance(offs, {}), Tolerance(dict(reversed(offs.items())), {})
    assert one == other
    assert hash(one) == hash(other)


def test_digits_of_a_file_without_decimals_are_a_fault() -> None:
    """The word says nothing there."""
    with pytest.raises(MethodFileError, match="the file has none"):
        loads("tolerance: digits\nA: [[0, 0], [2/3, 0]]\nb: [1/4, 3/4]")


@in_whole
def test_written_files_keep_the_tolerance_by_place() -> None:
    """A method that is spelled out has the same rounding when it is read again; what is recovered
    of embedded weights leaves A and b exact.
    """
    method = loads(f"tolerance: {{others: 1e-20, embedded: 1e-4, dense: 1e-7}}\n{PLACES}")
    again = convert(method, "gark").method
    keys = "tolerance", "embedded_tolerance", "dense_tolerance"
    assert [getattr(again, x) for x in keys] == [getattr(method, x) for x in keys]
    exact = loads(f"tolerance: {{embedded: 1e-12}}\n{EMBEDDED}")
    again = convert(exact, "gark").method
    assert (again.tolerance, again.embedded_tolerance) == (None, fmpq(1, 10**12))
    found = convert(exact, "recovered").method
    assert (found.tolerance, found.embedded_tolerance) == (None, fmpq(1, 10**50))
    assert found.embedded is not None
    assert abs(found.embedded[0][0] - fmpq(1, 6)) < fmpq(1, 10**50)


def test_exports_say_how_each_order_is_met() -> None:
    """The head of an exported file: the order exactly, that of the embedded weights within."""
    payload = prepared(loads(f"tolerance: {{embedded: 1e-12}}\n{EMBEDDED}"))
    assert payload.tolerance is None
    sentence = payload.orders.sentence()
    assert sentence == "order 4, embedded order 4 within 1e-12; order conditions met exactly"


ROOTS = {
    "sqrt(1.001)": fmpq(1001, 1000),
    "0 - cbrt(1/2 - 1.501)": fmpq(1501, 1000),
    "root(1 + 0.001, 4)": fmpq(1, 1000),
    "root_of(x - 1.001, 1)": fmpq(1001, 1000),
}


@pytest.mark.parametrize("half", ["0.5", "1/2"])
@pytest.mark.parametrize("root", ROOTS)
def test_a_decimal_under_a_root_is_rounded_like_any_other(root: str, half: str) -> None:
    """Whatever other numbers of the file are: Σ b = 1 holds within 0.002, not within 0.0001."""
    text = f"A: [[0, 0], [{half}, 0]]\nb: [0, '{root}']\n"
    wide, narrow = loads(f"tolerance: 2e-3\n{text}"), loads(f"tolerance: 1e-4\n{text}")
    rounded = as_meant(wide)
    assert not isinstance(rounded, Tableau)
    exact = set() if half == "1/2" else {fmpq(1, 2)}
    assert set(rounded.search.box.numbers) == {ROOTS[root], *exact}
    assert (find_orders(wide)["order"], find_orders(narrow)["order"]) == (2, 0)


def test_a_root_of_a_polynomial_with_decimals_is_as_exact_as_these() -> None:
    """The root is the number that is rounded; by digits, as the coarsest of the decimals."""
    text = 'A: [[1/2]]\nb: ["root_of(1.0000*x^3 - 1.003, 1)"]'
    for tolerance, radius in (("1e-2", fmpq(1, 100)), ("digits", fmpq(1, 1000))):
        method = loads(f"tolerance: {tolerance}\n{text}")
        rounded = as_meant(method)
        assert not isinstance(rounded, Tableau)
        assert rounded.search.box.radii == (radius,)
    exact = 'A: [[1/2]]\nb: ["root_of(x^3 - 1003/1000, 1)"]'
    with pytest.raises(MethodFileError, match="the file has none"):
        loads(f"tolerance: digits\n{exact}")


def test_roots_of_rounded_numbers_have_no_certificate() -> None:
    """The referee adds and multiplies alone."""
    method = loads("tolerance: 2e-3\nA: [[0.5]]\nb: [sqrt(1.001)]")
    with pytest.raises(MethodError, match="under a root of index 2"):
        prove_method_exists(method)


@in_whole
def test_a_root_of_a_rounded_number_moves_beside_unknowns() -> None:
    """A weight sqrt(1.000001) t or sqrt(1.000001 t) is 1 for t = 1 within the rounding."""
    text = "tolerance: 1e-6\nparameters: {t: free}\nA: [[t/2]]\nb: [{}]\ndesign: {order: 2}\n"
    for root in ("sqrt(1.000001)*t", "sqrt(1.000001*t)"):
        found = find_parameters(loads_family(text.replace("{}", root)))
        assert isinstance(found, DesignWithin)
        assert found.best is not None
        assert found.best.order == 2
        assert float(found.best.found[0].values["t"]) == pytest.approx(1, abs=2e-6)


FSAL = "{{A: [[0, 0, 0], [0.5, 0, 0], [0.2, 0.8, 0]], b: [{}, 0.8, 0]}}"


@pytest.mark.parametrize(("weight", "stages", "numbers"), [("0.2", 5, 14), ("0.3", 6, 5)])
def test_where_stages_are_joined_each_coefficient_is_rounded(
    weight: str, stages: int, numbers: int
) -> None:
    """The last row is b as printed, so that the last stage is the first of the next step: 5 stages
    where others within the rounding have 6, and 14 coefficients. With another b all follow the 5
    decimals.
    """
    rounded = as_meant(
        loads(f"tolerance: 1e-3\ncompose: {{of: {FSAL.format(weight)}, steps: [1/2, 1/2]}}")
    )
    assert not isinstance(rounded, Tableau)
    assert (rounded.tableau.space(0).stages, len(rounded.search.box.numbers)) == (stages, numbers)


@in_whole
def test_exports_name_the_order_on_problems_with_time_that_check_names() -> None:
    """Order 2 has b₂ = 1/2, and b₂ c₂ = 1/2 with a c₂ that is exact and not 1 fails. Were the
    exact numbers rounded too, both would hold.
    """
    method = loads("tolerance: 1e-3\nA: [[], [1]]\nb: [0.5, 0.5]\nc: [0, 5009/5000]")
    found = check_method(method).analysis
    assert found.nonautonomous_order is not None
    assert (found.order.order, found.nonautonomous_order.order) == (2, 1)
    orders = prepared(method).orders
    assert (orders.order, orders.nonautonomous) == (2, 1)


@pytest.mark.parametrize("tolerance", ["1e-3", "{embedded: 1e-3}"])
def test_a_wrong_sum_is_told_where_exact_weights_make_it(tolerance: str) -> None:
    """Embedded weights with the sum 1.002, one of them rounded by 0.001: were all three, the sum
    would be 1 within the rounding, as order 1 is not.
    """
    text = "A: [[], [1/2], [0, 1/2]]\nb: [0, 1, 0]\nembedded: [0.5, 1/2, 1/500]"
    found = check_method(loads(f"tolerance: {tolerance}\n{text}")).analysis
    assert found.embedded is not None
    assert found.embedded.order.order == 0
    [wrong] = found.wrong_weights
    assert (wrong.is_embedded, wrong.off) == (True, fmpq(1, 500))


def test_design_takes_each_number_within_its_own_radius() -> None:
    """Unknown weights beside A whose entries have another tolerance than the embedded weights."""
    text = (
        "tolerance: {others: 1e-9, embedded: 1e-4}\nparameters: {t: free}\n"
        "A: [[0, 0], [0.666666667, 0]]\nb: [t, 0.75]\nembedded: [0.9999, 0]\n"
    )
    family = loads_family(text)
    made = filled(family, {"t": fmpq(1, 4)}, 20, fmpq(1, 100)).rounded.search.box
    assert dict(zip(made.numbers, made.radii, strict=True)) == {
        fmpq(666666667, 10**9): fmpq(1, 10**9),
        fmpq(3, 4): fmpq(1, 10**9),
        fmpq(9999, 10**4): fmpq(1, 10**4),
        fmpq(1, 4): fmpq(1, 100),
    }
    found = find_parameters(family, 2)
    assert isinstance(found, DesignWithin)
    assert found.best is not None
    assert found.best.order == 2


def test_the_schema_admits_what_the_reader_takes() -> None:
    """A number, the word, or a mapping of these."""
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft7Validator(method_file_schema())
    beside = {"A": [[0.5]], "b": [1]}
    good = (1e-13, "1e-13", "digits", {"others": 1e-9, "embedded": "digits", "2": 1e-9})
    for tolerance in good:
        assert validator.is_valid({**beside, "tolerance": tolerance})
    for tolerance in ([1e-9], {}, {"others": [1e-9]}):
        assert not validator.is_valid({**beside, "tolerance": tolerance})
