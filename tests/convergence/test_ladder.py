"""Where the default ladder of step sizes begins and ends."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice, pairwise
from math import log2

import pytest
from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.convergence.convergence import converge
from garkcli.convergence.ladder import MAX_ROWS, ROWS, halvings, is_complete, plateau, trimmed
from garkcli.convergence.result import StepSizeRow, observed_order
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.tableau.forms import gark
from tests.stepping.test_step import RECTANGULAR


def rows_of(error: Callable[[float], float], count: int) -> list[StepSizeRow]:
    """Rows with h = 1, 1/2, …"""
    made: list[StepSizeRow] = []
    for k in range(count):
        slope = None if k == 0 else log2(error(2.0 ** (1 - k)) / error(2.0**-k))
        made.append(StepSizeRow(fmpq(1, 2**k), arb(error(2.0**-k)), slope, arb(0)))
    return made


def ladder_of(error: Callable[[float], float]) -> list[StepSizeRow]:
    """The ladder that errors like these make, from a solution of size 1."""
    for count in range(1, 40):
        rows = rows_of(error, count)
        is_small = [row.error < 1 / 32 for row in rows]
        if is_complete(rows, is_small):
            return trimmed(rows, is_small)
    raise AssertionError("the ladder has no end")


@given(order=st.integers(1, 12), a=st.floats(-0.5, 0.5), b=st.floats(-1, 1), c=st.floats(0.01, 100))
def test_ladder_ends_near_the_order(order: int, a: float, b: float, c: float) -> None:
    """Whatever the expansion of the error: it is small at the start, and shows the order at the
    end.
    """
    rows = ladder_of(lambda h: c * h**order * (1 + a * h + b * h * h / 2) ** 2)
    assert ROWS <= len(rows) <= MAX_ROWS
    assert rows[0].error < 1 / 32
    assert rows[0].slope is None
    observed = observed_order(rows)
    assert observed == pytest.approx(order, abs=0.03)
    assert rows[-1].slope == pytest.approx(order, abs=0.1)


def test_ladder_does_not_end_on_half_an_order() -> None:
    """An error of order 5/2 is never taken for settled: an order is a whole number."""
    assert len(ladder_of(lambda h: h**2.5)) == MAX_ROWS


def test_coarse_rows_are_left_out() -> None:
    """Two coarse steps whose errors cancel by chance, as for the pendulum, do not belong to the
    ladder.
    """
    rows = ladder_of(lambda h: h**4 * abs(1 - (1.9 * h) ** 4) / 50)
    assert rows[0].h < fmpq(1, 2)
    assert rows[1].slope == pytest.approx(4, abs=0.5)


def test_plateau_is_small() -> None:
    """Flat rows are a plateau where rounding may have made their errors; a dip of the slope before
    is none.
    """

    def rows(*slopes: float) -> list[StepSizeRow]:
        return [
            StepSizeRow(fmpq(1, 2**k), arb(1) / 100 ** min(k, 4), s, arb(0))
            for k, s in enumerate(slopes)
        ]

    rounding = arb(1) / 10**9
    assert plateau(rows(1, 1, 1), 4, rounding) == 0
    assert plateau(rows(3, 3.9, 4, 4, 2, 0), 4, rounding) == 3
    assert plateau(rows(3, 3.9, 4, 4, 2, 0), 4, arb(0)) == 0
    assert plateau(rows(2, 3.9, 4), 4, rounding) == 0


def test_plateau_stays_and_has_no_say() -> None:
    """Flat rows at the end are no reason to leave out what is before them."""
    rows = rows_of(lambda h: h**4 + 1e-6, 9)
    spoilt = plateau(rows, 4, arb(1e-6))
    assert spoilt > 2
    assert trimmed(rows, [True] * 9, spoilt)[0].h == 1


@given(p=st.integers(1, 10**6), q=st.integers(1, 1000))
def test_halvings_divide_the_time(p: int, q: int) -> None:
    """Each step size divides the time, is half of the one before, and the first is not long."""
    t = fmpq(p, q)
    found = list(islice(halvings(t, fmpq(1), fmpq(8)), 5))
    assert all((t / h).q == 1 for h in found)
    assert all(a == 2 * b for a, b in pairwise(found))
    assert found[0] <= 8


def test_time_has_to_be_positive() -> None:
    """There is nothing to divide."""
    with pytest.raises(UsageProblem, match="not both positive"):
        next(halvings(fmpq(0), fmpq(1), fmpq(8)))


@pytest.mark.parametrize("order", [1, 4])
def test_ladder_fits_the_method(order: int) -> None:
    """On the pendulum: Euler begins with small steps, the rectangular method with large ones; both
    in few rows.
    """
    tableau = RECTANGULAR if order == 4 else gark([diagonal_method("explicit-euler")], {})
    rows = converge(tableau, hamiltonian("pendulum", terms_of(tableau))).rows
    assert len(rows) == ROWS
    assert 1e-6 < float(rows[0].error) < 0.1
    assert rows[0].h == (fmpq(1, 64) if order == 1 else fmpq(1, 2))
