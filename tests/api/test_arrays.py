"""``from_arrays``: numbers of every kind become the method that the file with their text describes."""

from __future__ import annotations

import random
from decimal import Decimal
from fractions import Fraction
from sys import float_info
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpq_mat, fmpz
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli import MethodFileError, diagonal_method, find_order, from_arrays, loads
from garkcli.errors import MethodError
from garkcli.exact.display import to_text
from garkcli.exact.given import number_text
from garkcli.families.registry import BY_STAGES
from tests.oracles.draws import fractions
from tests.whole import at_most

FRACTIONS = fractions(-3, 3, 12)


@st.composite
def arrays(draw: st.DrawFn) -> tuple[list[list[Fraction]], list[Fraction]]:
    """A square matrix and weights of the same length."""
    s = draw(st.integers(1, 4))
    row = st.lists(FRACTIONS, min_size=s, max_size=s)
    return draw(st.lists(row, min_size=s, max_size=s)), draw(row)


@given(arrays())
@settings(max_examples=at_most(10, 25), deadline=None)
def test_arrays_are_the_file_that_says_the_same(
    given_arrays: tuple[list[list[Fraction]], list[Fraction]],
) -> None:
    """The tableau is that of a file written by hand, and so is its order."""
    A, b = given_arrays
    rows = ", ".join(f"[{', '.join(map(str, row))}]" for row in A)
    file = loads(f"tableau: {{A: [{rows}], b: [{', '.join(map(str, b))}]}}")
    made = from_arrays(A, b)
    assert made.tableau == file.tableau
    assert find_order(made) == find_order(file)


@given(arrays())
@settings(max_examples=at_most(10, 25), deadline=None)
def test_entries_go_round(given_arrays: tuple[list[list[Fraction]], list[Fraction]]) -> None:
    """A, b and c of the method are the numbers that were given, and make it again."""
    A, b = given_arrays
    made = from_arrays(A, b)
    assert [[Fraction(int(x.p), int(x.q)) for x in row] for row in made.A] == A
    assert [Fraction(int(x.p), int(x.q)) for x in made.b] == b
    assert [Fraction(int(x.p), int(x.q)) for x in made.c] == [sum(row) for row in A]
    assert from_arrays(made.A, made.b, made.c).tableau == made.tableau
    assert loads(made.text).tableau == made.tableau


@given(st.floats(-10, 10, allow_subnormal=False), st.integers(0, 14))
@settings(max_examples=50)
def test_a_short_float_is_the_decimal_it_prints(x: float, digits: int) -> None:
    """A float of a decimal of at most 15 digits is that decimal, exactly, and no other."""
    text = f"{x:.{digits}e}"
    assume(not 0 < abs(float(text)) < float_info.min)
    wanted = Fraction(Decimal(text))
    (found,) = from_arrays([[0]], [float(text)]).b
    assert Fraction(int(found.p), int(found.q)) == wanted


RK2 = loads("A: [[0, 0], [1/2, 0]]\nb: [0, 1]").tableau


def kinds() -> dict[str, tuple[Any, Any]]:
    """The explicit midpoint rule in numbers of every kind."""
    import numpy as np
    import sympy

    half = sympy.Rational(1, 2)
    return {
        "ints and text": ([[0, 0], ["1/2", 0]], [0, 1]),
        "Fractions": (((0, 0), (Fraction(1, 2), 0)), (0, Fraction(1))),
        "floats": ([[0.0, 0.0], [0.5, 0.0]], [0.0, 1.0]),
        "Decimals": ([[0, 0], [Decimal("0.5"), 0]], [Decimal(0), Decimal(1)]),
        "FLINT": ([[fmpz(0), 0], [fmpq(1, 2), 0]], [fmpz(0), fmpq(1)]),
        "FLINT's matrices": (fmpq_mat([[0, 0], [fmpq(1, 2), 0]]), fmpq_mat([[0, 1]])),
        "NumPy": (np.array([[0, 0], [0.5, 0]]), np.array([0, 1])),
        "NumPy's objects": (np.array([[0, 0], [Fraction(1, 2), 0]], dtype=object), (0, 1)),
        "NumPy's numbers": ([[np.int64(0), 0], [np.float64(0.5), 0]], [np.int8(0), np.float32(1)]),
        "NumPy's short floats": (np.array([[0, 0], [0.5, 0]], dtype=np.float32), [0, 1]),
        "SymPy": ([[0, 0], [half, 0]], [sympy.Integer(0), sympy.S.One]),
        "SymPy's matrices": (sympy.Matrix([[0, 0], [half, 0]]), sympy.Matrix([0, 1])),
        "generators": ((row for row in ((0, 0), (Fraction(1, 2), 0))), iter([0, 1])),
        "a triangle": ([[], [Fraction(1, 2)]], [0, 1]),
    }


@pytest.mark.parametrize("kind", kinds())
def test_numbers_of_every_kind(kind: str) -> None:
    """However the numbers come, the method is the same."""
    A, b = kinds()[kind]
    assert from_arrays(A, b).tableau == RK2


def test_radicals_of_sympy_stay_exact() -> None:
    """Sums, products, powers and roots of SymPy are the numbers they stand for."""
    import sympy

    assert number_text(sympy.sqrt(2), "x", False) == "sqrt(2)"
    assert number_text(sympy.root(2, 5), "x", False) == "root(2, 5)"
    x = sympy.sqrt(3) / 6
    quarter, half = sympy.Rational(1, 4), sympy.Rational(1, 2)
    made = from_arrays(sympy.Matrix([[quarter, quarter - x], [quarter + x, quarter]]), [half, half])
    wanted = diagonal_method("gauss", 2).A
    assert [[to_text(x) for x in row] for row in made.A] == [
        [to_text(x) for x in row] for row in wanted
    ]
    odd = [
        sympy.root(2, 3) - sympy.Rational(1, 3) ** 2,
        1 / (1 + sympy.sqrt(2)),
        sympy.root(5, 4) ** 3,
    ]
    texts = ["cbrt(2) - 1/9", "1/(1 + sqrt(2))", "root(5, 4)**3"]
    found, wanted = (from_arrays([[0] * 3] * 3, b).b for b in (odd, texts))
    assert [to_text(x) for x in found] == [to_text(x) for x in wanted]


def test_exact_entries_of_a_method_make_it_again() -> None:
    """The printed entries of a family are coefficients: with them as arrays its order is the same."""
    for name, stages in (("gauss", 3), ("lobatto-iiia", 4), ("radau-iia", 2), ("rk4", 4)):
        family = diagonal_method(name, stages)
        made = from_arrays(family.A, family.b, family.c)
        assert find_order(made).order == find_order(family).order
        assert [to_text(x) for x in made.b] == [to_text(x) for x in family.b]


def test_several_colours() -> None:
    """Nested blocks are the method of a tableau file; None is a block that is not there."""
    made = from_arrays([[[[0]], None], [[[1]], [["1/2"]]]], [[1], [1]])
    text = "tableau: {A: [[[[0]], null], [[[1]], [[1/2]]]], b: [[1], [1]]}"
    assert made.tableau == loads(text).tableau
    assert made.A[1, 2] is None
    assert made.A[2, 1] == ((1,),)
    assert from_arrays(made.A, made.b, made.c).tableau == made.tableau


@given(arrays())
def test_embedded_weights_stand_beside_b(
    given_arrays: tuple[list[list[Fraction]], list[Fraction]],
) -> None:
    """They are those of a file that says the same, and go round; without them there are none."""
    A, b = given_arrays
    weights = list(reversed(b))
    made = from_arrays(A, b, embedded=weights)
    assert from_arrays(A, b).embedded is None
    assert made.embedded is not None
    (found,) = made.embedded
    assert [Fraction(int(x.p), int(x.q)) for x in found] == weights
    again = from_arrays(made.A, made.b, made.c, found)
    assert again.further == made.further
    assert loads(made.text).further == made.further


def test_embedded_weights_of_every_kind() -> None:
    """NumPy's arrays, matrices of SymPy, a row per colour; a wrong one has its place."""
    import numpy as np
    import sympy

    A, b = [[0, 0], [1, 0]], [0.5, 0.5]
    for row in (np.array([1.0, 0.0]), sympy.Matrix([1, 0]), ("1", 0)):
        assert from_arrays(A, b, embedded=row).embedded == ((1, 0),)
    two = from_arrays([[[[0]], None], [[[1]], [["1/2"]]]], [[1], [1]], embedded=[[0], [1]])
    assert two.embedded == ((0,), (1,))
    with pytest.raises(MethodError, match=r"^embedded, entry 2: 0\.3333"):
        from_arrays(A, b, embedded=[1, 1 / 3])
    with pytest.raises(MethodFileError, match="embedded has 3 entries"):
        from_arrays(A, b, embedded=[1, 0, 0])


def test_rounded_floats_ask_for_a_tolerance() -> None:
    """A float of 17 digits is refused unless the rounding is named; then the order holds within it."""
    x = 3**0.5 / 6
    A, b = [[0.25, 0.25 - x], [0.25 + x, 0.25]], [0.5, 0.5]
    with pytest.raises(MethodError, match="rounded number"):
        from_arrays([[5e-324]], [1])  # the only digit that so small a float has
    with pytest.raises(MethodError, match="rounded number") as caught:
        from_arrays(A, b)
    assert caught.value.message.startswith("A, row 1, entry 2")
    assert "tolerance=" in caught.value.help
    made = from_arrays(A, b, tolerance="1e-15")
    assert made.tolerance == fmpq(1, 10**15)
    assert find_order(made).order == 4
    assert find_order(made.tableau).order < 4


@pytest.mark.parametrize(
    "entry",
    [True, 1j, float("nan"), float("inf"), Decimal("NaN"), object(), b"1", None, {}, {1: 2}],
)
def test_what_is_no_number_is_refused(entry: Any) -> None:
    """Neither truth values nor complex numbers nor anything else passes for a coefficient."""
    with pytest.raises((MethodError, MethodFileError)):
        from_arrays([[0, 0], [entry, 0]], [0, 1])


def test_sympy_that_is_no_real_radical_is_refused() -> None:
    """Symbols, transcendental numbers, floats and roots of negative numbers have no exact text."""
    import sympy

    for entry in (sympy.Symbol("x"), sympy.pi, sympy.Float(0.1), sympy.root(-8, 3), sympy.I):
        with pytest.raises(MethodError):
            from_arrays([[entry]], [1])


def test_faults_of_arrays_have_their_place() -> None:
    """Shapes and texts are told as those of a file, whose text shows them."""
    with pytest.raises(MethodFileError) as caught:
        from_arrays([[0, 0], ["1/0x", 0]], [0, 1, 1])
    shown = str(caught.value)
    assert "b has 3 entries, A is 2 by 2" in shown
    assert "A, row 2, entry 1: unexpected 'x'" in shown
    assert shown.count("^") == 2


def test_a_name_is_a_name() -> None:
    """Whatever stands in a name is text, not YAML."""
    name = 'a: "b" # {c}\n- d'
    assert from_arrays([[0]], [1], name=name).name == 'a: "b" # {c} - d'


def test_random_order_four_methods_keep_their_order() -> None:
    """Kutta's family of order 4 with rational nodes: exact arrays are of order 4, printed ones within
    their rounding.
    """
    seeds = random.Random(7)
    for _ in range(5):
        t = Fraction(seeds.randint(1, 9), seeds.randint(1, 9))
        A = [
            [],
            [Fraction(1, 2)],
            [Fraction(1, 2) - 1 / (6 * t), 1 / (6 * t)],
            [0, 1 - 3 * t, 3 * t],
        ]
        b = [Fraction(1, 6), Fraction(2, 3) - t, t, Fraction(1, 6)]
        assert find_order(from_arrays(A, b)).order == 4
        rounded = [[float(x) for x in row] for row in A]
        made = from_arrays(rounded, [float(x) for x in b], tolerance="1e-14")
        assert find_order(made).order == 4


def test_every_family_shows_its_entries() -> None:
    """The entries of families are those of the tableau as it is printed, not of a polynomial basis."""
    for name, family in BY_STAGES.items():
        method = diagonal_method(name, max(2, family.smallest) if family.largest > 4 else None)
        s = method.stages[0]
        assert len(method.A) == len(method.b) == len(method.c) == s
        assert sum(method.b[1:], start=method.b[0]) == 1
    lobatto = diagonal_method("lobatto-iiia", 3)
    assert str(lobatto.A[1][0]) == "5/24"


def test_an_explicit_method_without_its_last_column() -> None:
    """Solvers keep s rows of s − 1 entries, zero from the diagonal on: the method is that of the
    whole matrix. A column short of anything else is a wrong shape.
    """
    whole = np.array([[0, 0, 0], [0.5, 0, 0], [-1, 2, 0]])
    b = ["1/6", "2/3", "1/6"]
    assert from_arrays(whole[:, :2], b).A == from_arrays(whole, b).A
    short = [[0, 0], ["1/2", 1], [-1, 2]]
    with pytest.raises(MethodFileError, match="A is 3 by 2"):
        from_arrays(short, b)
