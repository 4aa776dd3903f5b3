"""Random numbers of our own: those of the publication, spread as they should be."""

from __future__ import annotations

from collections import Counter

from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st
from sympy import Add, Rational

from garkcli.problems.builtin import hamiltonian
from garkcli.problems.draw import Draw
from garkcli.problems.vectorfield import symbols


def test_published_numbers() -> None:
    """The first numbers of SplitMix64 from two seeds, as its authors' program prints them."""
    draw = Draw(1234567)
    assert [draw.word() for _ in range(5)] == [
        6457827717110365317,
        3203168211198807973,
        9817491932198370423,
        4593380528125082431,
        16408922859458223821,
    ]
    assert Draw(0).word() == 0xE220A8397B1DCDAF


@given(st.integers(), st.integers(-1000, 1000), st.integers(0, 1000))
def test_numbers_are_within_their_bounds(seed: int, low: int, width: int) -> None:
    """``between`` includes both ends and nothing beyond; one seed gives one sequence."""
    draw, again = Draw(seed), Draw(seed)
    for _ in range(20):
        x = draw.between(low, low + width)
        assert low <= x <= low + width
        assert again.between(low, low + width) == x
    assert draw.sign() in {-1, 1}


def test_every_number_is_drawn() -> None:
    """A die of six sides and a sign, 6000 times: each about as often as the others.

    The counts are the same on every machine; 150 is five standard deviations of a fair die.
    """
    draw = Draw(5)
    sides = Counter(draw.between(1, 6) for _ in range(6000))
    assert set(sides) == set(range(1, 7))
    assert all(abs(count - 1000) < 150 for count in sides.values())
    signs = Counter(draw.sign() for _ in range(6000))
    assert abs(signs[1] - 3000) < 200


def test_generic_is_the_same_everywhere() -> None:
    """The start of ``generic`` and its first term, number by number: no version of Python and no
    library changes them unseen.
    """
    problem = hamiltonian("generic", 2)
    assert problem.initial == (fmpq(1, 50), fmpq(-9, 50), fmpq(1, 10), fmpq(1, 50))
    y = (*symbols(problem.variables, "q"), *symbols(problem.variables, "p"))
    powers = (
        ((10, 7, -10, 8), Rational(-17, 3200)),
        ((-9, -8, -4, 11), Rational(19, 3200)),
        ((-3, -4, -3, 10), Rational(-1, 160)),
    )
    term = Add(
        *(
            factor * (1 + Add(*(Rational(a, 20) * x for a, x in zip(slopes, y, strict=True)))) ** 8
            for slopes, factor in powers
        )
    )
    assert problem.terms[0] == term
