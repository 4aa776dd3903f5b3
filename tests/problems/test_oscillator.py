"""The oscillator and its split."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.problems.oscillator import Oscillator, check_structure, example_shares, parse_shares
from garkcli.tableau.forms import gark, spelled_out, symplectic_pair
from garkcli.tableau.tableau import Colour
from garkcli.transfer import collocation

ZERO, ONE, HALF = fmpq(0), fmpq(1), fmpq(1, 2)
METHODS = [diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3)]
Q = gark(METHODS, {(0, 1): collocation(*METHODS), (1, 0): collocation(*METHODS[::-1])})


@pytest.mark.parametrize("terms", [1, 2, 3, 5])
def test_default_is_read_from_its_own_text(terms: int) -> None:
    """The example in error messages is the default split, and it parses."""
    assert parse_shares(example_shares(terms), terms) == Oscillator.default(terms, ONE).shares


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1:0", "1 pairs for 2 terms"),
        ("1:0,1", "'1' is not a pair"),
        ("1:0,1:1", "kinetic shares sum to 2"),
        ("1:0,0:1/2", "potential shares sum to 1/2"),
        ("1:0,0:x", "'x' has no value"),
        ("1:0,0:1/0", "division by zero"),
        ("1:0,0:sqrt(2)", "irrational"),
        ("1:0,:1", "no number here"),
    ],
)
def test_bad_splits_are_named(text: str, said: str) -> None:
    """Each mistake of --split has its own message, and a cure."""
    with pytest.raises(UsageProblem, match=said.replace("(", r"\(")) as caught:
        parse_shares(text, 2)
    assert caught.value.help


def test_frequency_is_positive() -> None:
    """ω = 0 would divide by zero in the scaled error."""
    with pytest.raises(UsageProblem, match="not positive"):
        Oscillator.default(1, ZERO)


def test_parts_of_a_term() -> None:
    """The q and p colours of a term share its field; a y colour has all of it."""
    problem = Oscillator(fmpq(3), ((HALF, fmpq(1, 3)), (HALF, fmpq(2, 3))))
    q, p, y = (problem.matrix(Colour("", 0, (ONE,), (ZERO,), 0, part)) for part in ("q", "p", "y"))
    assert y == ((ZERO, HALF), (fmpq(-3), ZERO))
    assert q == ((ZERO, HALF), (ZERO, ZERO))
    assert p == ((ZERO, ZERO), (fmpq(-3), ZERO))


def test_structure_has_to_have_the_field() -> None:
    """The separable method has neither V² nor F¹: a split that needs one is refused with its
    reason.
    """
    separable = symplectic_pair(Q, [0], [1])
    check_structure(separable, Oscillator.default(2, ONE))
    with pytest.raises(
        UsageProblem, match="term 2 has kinetic energy, but the method has no colour"
    ):
        check_structure(separable, Oscillator(ONE, ((HALF, ZERO), (HALF, ONE))))
    with pytest.raises(UsageProblem, match="term 1 has potential energy"):
        check_structure(separable, Oscillator(ONE, ((ONE, HALF), (ZERO, HALF))))
    check_structure(symplectic_pair(Q, [0], [0, 1]), Oscillator(ONE, ((ONE, HALF), (ZERO, HALF))))


def test_structure_has_to_see_what_the_field_depends_on() -> None:
    """Colour 2 without A^{2,1} cannot have ½p² in colour 1, whose positions it needs."""
    A = ((HALF,),)
    blind = spelled_out([[A, A], [None, A]], [(ONE,), (ONE,)], [None, None])
    with pytest.raises(UsageProblem, match="colour 2 depends on variables driven by colour 1"):
        check_structure(blind, Oscillator.default(2, ONE))
    check_structure(blind, Oscillator(ONE, ((ZERO, ZERO), (ONE, ONE))))


def test_number_of_terms() -> None:
    """A split for another number of terms is refused."""
    with pytest.raises(UsageProblem, match="3 terms, the method 2"):
        check_structure(Q, Oscillator.default(3, ONE))
