"""The forms ``shu-osher`` and ``low-storage`` of method files, read and written."""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq

from garkcli import load, loads
from garkcli.check.check_file import check_method
from garkcli.cli.tableaux import forms
from garkcli.conversion.convert import convert
from garkcli.conversion.sheet import CannotConvert
from garkcli.errors import MethodFileError
from garkcli.exact.display import to_decimal
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark

CARPENTER_KENNEDY = """
tolerance: 1e-24
low-storage:
  form: 2N
  A: [0, -567301805773/1357537059087, -2404267990393/2016746695238, -3550918686646/2091501179385,
      -1275806237668/842570457699]
  B: [1432997174477/9575080441755, 5161836677717/13612068292357, 1720146321549/2090206949498,
      3134564353537/4481467310338, 2277821191437/14882151754819]
expect: {order: 4}
"""
"""M. H. Carpenter, C. A. Kennedy, NASA TM-109112 (1994)."""
SSP_54 = """
tolerance: 1e-13
shu-osher:
  alpha: [[1], [0.444370493651235, 0.555629506348765], [0.620101851488403, 0, 0.379898148511597],
    [0.178079954393132, 0, 0, 0.821920045606868],
    [0, 0, 0.517231671970585, 0.096059710526147, 0.386708617503269]]
  beta: [[0.391752226571890], [0, 0.368410593050371], [0, 0, 0.251891774271694],
    [0, 0, 0, 0.544974750228521], [0, 0, 0, 0.063692468666290, 0.226007483236906]]
expect: {order: 4}
"""
"""R. J. Spiteri, S. J. Ruuth, SIAM J. Numer. Anal. 40 (2002) 469, SSP(5,4)."""
WILLIAMSON = "low-storage: {form: 2N, A: [0, -5/9, -153/128], B: [1/3, 15/16, 8/15]}\n"
SSP_33 = "shu-osher: {alpha: [[1], [3/4, 1/4], [1/3, 0, 2/3]], beta: [[1], [0, 1/4], [0, 0, 2/3]]}"
HEUN = "A: [[], [1]]\nb: [1/2, 1/2]"


def test_published_methods_are_those_of_the_catalogue() -> None:
    """The 2N and Shu–Osher forms as papers print them are the tableaus of the catalogue, with their
    orders and no higher ones.
    """
    for text, name, grain in (
        (CARPENTER_KENNEDY, "carpenter-kennedy-4", fmpq(0)),
        (SSP_54, "ssp-54", fmpq(1, 10**7)),
    ):
        method, known = loads(text), load(name)
        assert _distance(method.tableau, known.tableau) <= grain
        outcome = check_method(method)
        assert outcome.exit_code == 0
        assert not outcome.analysis.order.is_lower_bound  # type: ignore[union-attr]
    assert loads(WILLIAMSON).tableau.colours[0].b == (fmpq(1, 6), fmpq(3, 10), fmpq(8, 15))
    assert loads(SSP_33).tableau == load("ssp-33").tableau


def _distance(one: Tableau, other: Tableau) -> fmpq:
    return max(abs(x - y) for x, y in zip(one.entries, other.entries, strict=True))  # type: ignore


@pytest.mark.parametrize(
    ("text", "to"),
    [
        (WILLIAMSON, "2N"),
        (SSP_33, "shu-osher"),
        (HEUN, "2N"),
        (HEUN, "2R"),
        (HEUN + "\nembedded: [1, 0]\nc: [0, 1/2]", "shu-osher"),
        ("A: [[], [1/2], [1/6, 2/3]]\nb: [1/6, 1/3, 1/2]", "2R"),
        ("A: [[], [1/2], [1/6, 2/3], [1/3, 1/5, 1/7]]\nb: [1/6, 1/3, 1/4, 1/4]", "4R"),
    ],
)
def test_round_trips(text: str, to: str) -> None:
    """A method in another form is the same one: A, b, c and embedded weights to the letter."""
    method = loads(text)
    made = convert(method, to).method
    assert made.form == ("shu-osher" if to == "shu-osher" else "low-storage")
    assert made.tableau == method.tableau
    assert made.further == method.further


def test_random_methods_round_trip() -> None:
    """Methods made in a form go to their tableaus and back to the numbers that they were made of;
    with one entry changed they have no such form, or another method in it.
    """
    dice = Random(4)
    for _ in range(15):
        s = dice.randint(2, 5)

        def numbers(count: int) -> list[str]:
            return [
                f"{dice.choice([-1, 1]) * dice.randint(1, 5)}/{dice.randint(1, 4)}"
                for _ in range(count)
            ]

        A, B = ["0", *numbers(s - 1)], numbers(s)
        method = loads(f"low-storage: {{form: 2N, A: [{', '.join(A)}], B: [{', '.join(B)}]}}")
        assert convert(convert(method).method, "2N").method.tableau == method.tableau
        n = dice.randint(2, min(s, 4))
        rows = ", ".join(f"[{', '.join(numbers(s - k))}]" for k in range(1, n))
        A_of = rows.strip("[]") if n == 2 else rows
        b = ", ".join(numbers(s))
        method = loads(f"low-storage: {{form: {n}R, A: [{A_of}], b: [{b}]}}")
        spelled_out = convert(method).method
        assert convert(spelled_out, f"{n}R").method.tableau == method.tableau
        if s > n:
            entries = [list(row) for row in spelled_out.tableau.blocks[0, 0]]
            entries[-1][0] += 1
            text = ", ".join(f"[{', '.join(map(str, row))}]" for row in entries)
            with pytest.raises(CannotConvert, match=f"no {n}R form"):
                convert(loads(f"A: [{text}]\nb: [{b}]"), f"{n}R")


@pytest.mark.parametrize(
    ("method", "to", "why"),
    [
        ("rk4", "2N", "no 2N form: the slopes of stages"),
        ("rk4", "2R", r"no 2R form: a\[3,1\] is not b\[1\]"),
        ("rk4", "shu-osher", "the SSP coefficient is 0"),
        ("gauss-2", "2N", "explicit methods, and this one is implicit"),
        ("ars-222", "2R", "of methods of one colour"),
        ("ssp-54", "2N", "no 2N form: the slopes of stages 3 and 4"),
        ("ssp-54", "shu-osher", "no exact Shu–Osher form"),
        ("forward-euler", "2R", "1 stage needs fewer registers"),
    ],
)
def test_what_has_no_such_form(method: str, to: str, why: str) -> None:
    """It is said why, decided exactly."""
    with pytest.raises(CannotConvert, match=why):
        convert(load(method), to)


def test_rounded_methods_have_forms_too() -> None:
    """Carpenter and Kennedy's method comes back with the numbers that they print. From A and b in
    16 digits its factors have 16, within a tolerance that leaves the order 4: the same method;
    with one entry off by more than its tolerance there is no form.
    """
    made = convert(load("carpenter-kennedy-4"), "2N").method
    assert made.tolerance == fmpq(1, 10**24)
    assert made.tableau == load("carpenter-kennedy-4").tableau
    published = loads(CARPENTER_KENNEDY)
    A, (colour,) = published.tableau.blocks[0, 0], published.tableau.colours
    rows = [", ".join("0" if not x else to_decimal(x, 16) for x in row) for row in (*A, colour.b)]
    text = f"A: [[{'], ['.join(rows[:-1])}]]\nb: [{rows[-1]}]"
    rounded = loads(f"{text}\ntolerance: 1e-15")
    found = convert(rounded, "2N").method
    assert found.tolerance is not None
    assert fmpq(1, 10**15) <= found.tolerance <= fmpq(1, 10**12)
    assert found.order == 4
    assert _distance(found.tableau, published.tableau) <= found.tolerance
    moved = text.replace("A: [[0, 0, 0, 0, 0], [0.1", "A: [[0, 0, 0, 0, 0], [0.2")
    assert moved != text
    with pytest.raises(CannotConvert, match="no 2N form"):
        convert(loads(f"{moved}\ntolerance: 1e-15"), "2N")


def test_rounded_entries_that_are_one_number() -> None:
    """Wray's method with a_31 in other digits than b_1 has two registers, within the tolerance;
    with fewer digits allowed it has not.
    """
    text = "A: [[], [0.53333], [0.25001, 0.41667]]\nb: [0.25, 0, 0.75]\ntolerance: "
    made = convert(loads(f"{text}2e-5"), "2R").method
    assert (made.form, made.order) == ("low-storage", 3)
    assert made.b[0] == made.A[2][0] == fmpq(1, 4)
    with pytest.raises(CannotConvert, match=r"a\[3,1\] is not b\[1\]"):
        convert(loads(f"{text}5e-6"), "2R")


def test_the_help_lists_every_form() -> None:
    """The line of ``--to`` has all words that it takes."""
    text = gark("convert", "--help").out
    told = text[text.index("--to FORM") : text.index("--stages")].replace(",", " ").split()
    assert [x for x in forms() if x not in "".join(told) and f"{x}." not in told] == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("low-storage: {form: 2N, A: [0]}", "2N needs B"),
        ("low-storage: {form: 2N, A: [0], B: [1], b: [1]}", "2N has no b"),
        ("low-storage: {form: 2N, A: [0, 1, 2], B: [1]}", "a row of 3 for 1 stage\\n"),
        ("low-storage: {form: 3R, A: [[1, 2]], b: [1, 2, 3]}", "A of 3R has 1 diagonal"),
        ("low-storage: {form: 2R, A: [1, 2, 3, 4], b: [1, 2]}", "diagonal 1 has 4 entries"),
        ("low-storage: {form: 4X, A: [1], B: [1]}", "4X"),
        ("shu-osher: {alpha: [[1]], beta: [[1], [1]]}", "alpha has 1 row, beta has 2"),
        ("shu-osher: {alpha: [[1, 1]], beta: [[1, 0]]}", "the method is implicit"),
        (
            "low-storage: {form: 2S, gamma1: [0, 1/2], gamma2: [1, 1], delta: [1, 0], beta: [1, 1]}",
            "begins at 1.5",
        ),
        (WILLIAMSON.replace("}", ", c: [0, 1]}"), "c has 2 entries for 3 stages"),
        (WILLIAMSON.replace("}", ", embedded: [0, 1]}"), "embedded has 2 entries for 3 stages"),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(text)


def test_rounding_and_parameters_follow_the_scheme() -> None:
    """A printed number is off by the tolerance wherever the scheme uses it; a parameter of a scheme
    is one of the method.
    """
    text = WILLIAMSON.replace("8/15", "0.53333").replace("-5/9", "-0.55556")
    outcome = check_method(loads(f"tolerance: 1e-5\n{text}expect: {{order: 3}}"))
    assert outcome.exit_code == 0
    assert check_method(loads(f"tolerance: 1e-7\n{text}expect: {{order: 3}}")).exit_code == 1
    free = WILLIAMSON.replace("8/15", "p") + "parameters: {p: 8/15}"
    assert loads(free).tableau == loads(WILLIAMSON).tableau
