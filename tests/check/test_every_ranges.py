"""Every value within ranges, against ordinary verdicts at single values."""

from __future__ import annotations

from itertools import product

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.check.analysis import Analysis, analyse
from garkcli.check.every_family import EveryFamily, Range, can_vanish, every_family
from garkcli.errors import MethodError
from garkcli.exact.parametric import Parameters
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from tests.check.test_every_value import LIMIT, checked
from tests.cli.harness import gark
from tests.whole import at_most

BOX = """parameters:
  s: {free: true, range: [1/4, 1/2]}
  t: {free: true, range: [1/4, 1/3]}
"""
CORNERS = [{"s": s, "t": t} for s, t in product(("1/4", "1/2"), ("1/4", "1/3"))]


def ordinary(text: str, values: dict[str, str]) -> Analysis:
    """What is decided of a file with values."""
    return analyse(loads(text, settings=values).tableau, LIMIT)


def made(text: str, is_design: bool = False) -> EveryFamily:
    """The family of a text, with what it wants under ``design`` or without."""
    return every_family(loads_family(text, is_design=is_design))


def test_lost_conjugates_of_several_parameters(tmp_path: object) -> None:
    """Where a weight is zero there is no conjugate: a claim on its order fails, as it does at
    such a value; a range without these values makes it hold.
    """
    method = "A: [[0, 0], [t, 0]]\nb: [1 - s, s]\n"
    free = "parameters: {s: free, t: free}\n" + method
    claims = 'expect: {conjugate-order: ">= 1", pair-order: ">= 1"}\n'
    outcome = checked(tmp_path, free + claims)
    assert [x.holds for x in outcome.claims] == [False, False]
    assert "none where s = 0" in outcome.claims[0].found
    there = ordinary(free, {"s": "0", "t": "1/3"})
    assert there.conjugate_order is None
    assert there.pair_order is None
    inside = BOX + method
    assert checked(tmp_path, inside + claims).exit_code == 0
    for corner in CORNERS:
        found = ordinary(inside, corner).conjugate_order
        assert found is not None
        assert found.order == 1


@pytest.mark.parametrize(
    ("method", "claims"),
    [
        (
            "A: [[0, 0], [s, t]]\nb: [1 - t, t]\n",
            {"stiffly-accurate": False, "diagonally-implicit": True, "explicit": False},
        ),
        ("A: [[0, 0], [s, 0]]\nb: [1 - t, t]\n", {"stiffly-accurate": False, "reducible": False}),
    ],
)
def test_exceptions_lie_within_ranges(
    method: str, claims: dict[str, bool], tmp_path: object
) -> None:
    """What is an exception outside of the ranges alone is none: the claims, and that the order is
    1, hold as they do at the corners.
    """
    texts = [f"{key}: {str(x).lower()}" for key, x in claims.items()]
    text = BOX + method
    expect = f"expect: {{order: 1, {', '.join(texts)}}}\n"
    outcome = checked(tmp_path, text + expect)
    assert [x.claim for x in outcome.claims if not x.holds] == []
    assert len(outcome.claims) == len(claims) + 1
    for corner in CORNERS:
        found = ordinary(text, corner)
        assert found.order.order == 1
        for key, value in claims.items():
            assert found.subject.verdict(key).value is value


def test_exceptions_are_real(tmp_path: object) -> None:
    """A polynomial without real zeros is no exception."""
    text = """parameters: {s: free, t: free}
A: [[s^2 + 1, 0], [t, 1]]
b: [1/2, 1/2]
expect: {explicit: false}
"""
    assert checked(tmp_path, text).exit_code == 0


NUMBERS = st.integers(-3, 3)
ENDS = st.tuples(st.none() | st.integers(-4, -1), st.none() | st.integers(1, 4))


@settings(max_examples=at_most(12, 300), deadline=None)
@given(st.lists(NUMBERS, min_size=9, max_size=9), ENDS, ENDS, st.data())
def test_zeros_within_ranges_are_not_lost(
    coefficients: list[int],
    one: tuple[int | None, int | None],
    other: tuple[int | None, int | None],
    data: st.DataObject,
) -> None:
    """A polynomial that is made zero at a point of the ranges is never said to have no zero; of
    p² + 1 and its negative the same is said.
    """
    ring = Parameters(["s", "t"])
    ranges = {"s": _range(one), "t": _range(other)}
    point = [
        data.draw(st.integers(-9 if a is None else a, 9 if b is None else b))
        for a, b in (one, other)
    ]
    exponents = product(range(3), range(3))
    p = ring.context.from_dict(dict(zip(exponents, coefficients, strict=True)))
    assert can_vanish(p - p(*map(fmpq, point)), ring, ranges)
    positive = p * p + 1
    assert can_vanish(positive, ring, ranges) == can_vanish(-positive, ring, ranges)


def _range(ends: tuple[int | None, int | None]) -> Range:
    least, greatest = (None if x is None else fmpq(x) for x in ends)
    return least, greatest


@pytest.mark.parametrize(
    ("text", "ranges", "expected"),
    [
        ("s + t - 1", {"s": ("1/4", "1/2"), "t": ("1/4", "1/3")}, False),
        ("s + t - 1", {"s": ("1/4", "1/2"), "t": ("1/4", "1/2")}, True),
        ("s*t - 1", {"s": ("0", "1"), "t": ("0", None)}, True),
        ("s*t + 1", {"s": ("0", "1"), "t": ("0", None)}, False),
        ("s*t + 1", {"s": ("0", "1"), "t": (None, "0")}, True),
        ("s*t - 1", {"s": ("0", "1"), "t": (None, "0")}, False),
        ("s^2 + t^2 + 1", {"s": (None, None), "t": (None, None)}, False),
        ("s^2 + t^2", {"s": (None, None), "t": (None, None)}, True),
        ("s^2 - 2", {"s": ("0", "1"), "t": (None, None)}, False),
        ("s^2 - 2", {"s": ("0", "2"), "t": (None, None)}, True),
    ],
)
def test_polynomials_in_boxes(
    text: str, ranges: dict[str, tuple[str | None, str | None]], expected: bool
) -> None:
    """Bilinear ones are decided by their corners, those of one parameter by their roots."""
    ring = Parameters(["s", "t"])
    s, t = ring.context.gens()
    known = {
        "s + t - 1": s + t - 1,
        "s*t - 1": s * t - 1,
        "s*t + 1": s * t + 1,
        "s^2 + t^2 + 1": s**2 + t**2 + 1,
        "s^2 + t^2": s**2 + t**2,
        "s^2 - 2": s**2 - 2,
    }
    ends = {name: tuple(map(_number, x)) for name, x in ranges.items()}
    assert can_vanish(known[text], ring, ends) is expected  # type: ignore[arg-type]


def _number(text: str | None) -> fmpq | None:
    return None if text is None else fmpq(*map(int, text.split("/")))


def test_range_of_a_parameter_that_follows(tmp_path: object) -> None:
    """The nodes are within [0, 1] as their parameter is; one that others fix keeps its range."""
    text = """parameters: {t: {free: true, range: [0, 1]}}
A: [[0, 0], [1/2, 0]]
b: [0, 1]
c: [0, t]
expect: {nodes-in-unit-interval: true}
"""
    assert checked(tmp_path, text).exit_code == 0
    outcome = checked(tmp_path, text.replace("c: [0, t]", "c: [0, 1 - 2*t]"))
    assert [x.holds for x in outcome.claims] == [False]
    both = """parameters: {t: {free: true, range: [0, 1]}, a: {free: true, range: [-3, 3]}}
A: [[0, 0], [a, 0]]
b: [0, 1]
c: [0, 1 - 2*t]
design: {consistent: true}
"""
    every = made(both, is_design=True)
    ranges = {name: tuple(map(str, ends)) for name, ends in every.family.ranges.items()}
    assert ranges in ({"t": ("0", "1")}, {"a": ("-1", "1")})


def test_ranges_that_meet_in_one_number() -> None:
    """It is the value of both parameters, and another is left."""
    text = """parameters:
  a: {free: true, range: [1, 3]}
  t: {free: true, range: [0, 1]}
  s: free
A: [[0, 0], [a, 0]]
b: [1 - s, s]
c: [0, t]
design: {consistent: true}
"""
    every = made(text, is_design=True)
    assert every.family.parameters == ("s",)
    assert str(every.tableau.colours[0].c[1]) == "1"


@pytest.mark.parametrize(
    ("entry", "node", "message"),
    [
        ("1/2", "t", "the file implies t = 1/2, which is outside of its range"),
        ("s*u", "t", "t has a range, and its value s*u follows from others"),
        ("a", "t", "the ranges leave no value of"),
    ],
)
def test_ranges_that_cannot_be_kept_are_refused(entry: str, node: str, message: str) -> None:
    """Nothing is said for every value of what is outside of a range, or may be."""
    text = f"""parameters:
  t: {{free: true, range: [1, 2]}}
  a: {{free: true, range: [3, 4]}}
  s: free
  u: free
A: [[0, 0], [{entry}, 0]]
b: [1 - s, s]
c: [0, {node}]
design: {{consistent: true}}
"""
    with pytest.raises(MethodError) as refused:
        made(text, is_design=True)
    assert message in refused.value.message
    assert refused.value.help


def test_zeros_keep_the_range_of_what_they_fix() -> None:
    """Where s = 2 t with s in [0, 1] and t in [0, 2], t is in [0, 1/2] or s in [0, 1]."""
    every = made("""parameters:
  s: {free: true, range: [0, 1]}
  t: {free: true, range: [0, 2]}
A: [[0, 0], [s, 0]]
b: [1 - t, t]
""")
    s, t = every.ring.context.gens()
    smaller = every.where_zero(s - 2 * t)
    assert smaller is not None
    [(name, ends)] = smaller.family.ranges.items()
    expected = {"s": ("0", "1"), "t": ("0", "1/2")}
    assert tuple(map(str, ends)) == expected[name]


def test_roots_of_numbers_are_no_weights(tmp_path: object) -> None:
    """A weight √2 t is zero where t is, and what is told to be zero is reduced."""
    text = """parameters: {t: free}
A: [[0, 0], [t, 0]]
b: [1 - sqrt(2)*t, sqrt(2)*t]
"""
    every = checked(tmp_path, text).every
    assert every is not None
    assert every.conjugate_order is not None
    assert sorted(every.conjugate_order.poles) == ["t", "t*sqrt(2) - 1"]
    assert ("t", None) in every.conjugate_order.fact.elsewhere
    for order in (every.order, every.conjugate_order):
        assert order.fact.zeros
        assert not any("sqrt(2)^" in p for p in order.fact.zeros)
    assert ordinary(text, {"t": "0"}).conjugate_order is None


SDIRK = "A: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"


@pytest.mark.parametrize(
    ("ends", "is_third", "is_stable"),
    [
        ("[0, 1/2 - sqrt(3)/6]", True, False),
        ("[0, sqrt(3)/9]", False, False),  # 0.192 < 0.211, and a rational end around it is 1
        ("[1/4, 1/sqrt(3)]", False, True),
        ("[sqrt(2)/6, 1/sqrt(3)]", False, False),  # 0.236 < 1/4
        ("[sqrt(3)/6, 'root(2, 3)']", True, True),
    ],
)
def test_algebraic_ends(tmp_path: object, ends: str, is_third: bool, is_stable: bool) -> None:
    """Order 3 is at g = (3 ± √3)/6 = 0.211, 0.789, ends included, and A-stability at g ≥ 1/4."""
    text = f"parameters: {{g: {{free: true, range: {ends}}}}}\n{SDIRK}"
    claims = "expect: {order: 2, a-stable: true}\n"
    outcome = checked(tmp_path, text + claims)
    assert [x.holds for x in outcome.claims] == [not is_third, is_stable]
    written = gark("tableau", "-", "--format", "yaml", stdin=text)
    if "root" in ends:
        assert (written.code, "has no simple radicals" in written.err) == (2, True)
    else:
        again = checked(tmp_path, written.out + claims)
        assert [x.holds for x in again.claims] == [not is_third, is_stable]


def test_algebraic_ends_are_told() -> None:
    """As radicals where these are short, else by a polynomial; a pole beyond them, 1.42 > √2, is
    no exception.
    """
    text = "parameters: {g: {free: true, range: [%s]}}\nA: [['1/(g - 71/50)']]\nb: [1]\n"
    for ends, expected in (
        ("0, sqrt(2)", "where 0 ≤ g ≤ sqrt(2):"),
        ("0, 3/2", "where 50*g - 71 ≠ 0 and 0 ≤ g ≤ 3/2:"),
        ("0, 'root_of(x**3 - x - 1, 1.32)'", "where 0 ≤ g ≤ 2 and -g^3 + g + 1 ≥ 0:"),
    ):
        told = gark("check", "-", stdin=text % ends).out
        assert expected in " ".join(told.split())


def test_algebraic_ends_beside_other_parameters() -> None:
    """Rational ends around them would let in other values: refused."""
    text = "parameters: {g: {free: true, range: [0, sqrt(3)/6]}, b: free}\n"
    with pytest.raises(MethodError, match="has an algebraic end, and 2 parameters are free"):
        made(f"{text}A: [[g, 0], [1 - 2*g, g]]\nb: [1 - b, b]\n")
