"""Observed orders, against the certificate and against a plain computation."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from flint import arb, fmpq

from garkcli.convergence.convergence import converge
from garkcli.convergence.result import StepSizeRow, observed_order
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.tableau.forms import gark, pair, spelled_out, symplectic_pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation

ONE = fmpq(1)


def collocated(s: int, t: int) -> Tableau:
    """Gauss s × Lobatto IIIA t with collocation blocks."""
    one, other = (diagonal_method("gauss", s), diagonal_method("lobatto-iiia", t))
    return gark([one, other], {(0, 1): collocation(one, other), (1, 0): collocation(other, one)})


def alone(name: str, s: int | None = None) -> Tableau:
    """A single method."""
    return gark([diagonal_method(name, s)], {})


def default(tableau: Tableau, omega: fmpq = ONE) -> Oscillator:
    """The default split."""
    return Oscillator.default(terms_of(tableau), omega)


@pytest.mark.parametrize(
    ("tableau", "order"),
    [
        (alone("explicit-euler"), 1),
        (alone("heun"), 2),
        (alone("kutta"), 3),
        (alone("rk4"), 4),
        (alone("radau-iia", 3), 5),
        (alone("gauss", 8), 16),
        (collocated(2, 3), 4),
        (pair(collocated(2, 3)), 4),
        (symplectic_pair(collocated(2, 3), [0], [1]), 4),
        (pair(collocated(6, 7)), 12),
    ],
)
def test_observed_order_is_the_predicted_one(tableau: Tableau, order: int) -> None:
    """From order 1 to 16 the slope is the order to two decimals: never that of round-off."""
    result = converge(tableau, default(tableau))
    assert result.observed_order == pytest.approx(order, abs=3e-3)
    assert (result.predicted_order, result.visible_order) == (order, order)
    assert result.rows[-1].slope == pytest.approx(order, abs=0.01)
    assert result.agrees


def test_order_can_be_invisible() -> None:
    """The pair of Gauss 2 × Lobatto IIIA 4 by collocation is of order 2, but no unbranched tree
    shows it.
    """
    tableau = pair(collocated(2, 4))
    result = converge(tableau, default(tableau))
    assert result.predicted_order == 2
    assert result.visible_order == 4
    assert result.observed_order == pytest.approx(4, abs=1e-3)
    assert result.agrees


def test_split_decides_what_is_visible() -> None:
    """Gauss 1 × Gauss 2: order 4 while only the second has a field, order 2 as soon as the first
    takes part.
    """
    one, other = diagonal_method("gauss", 1), diagonal_method("gauss", 2)
    tableau = gark([one, other], {(0, 1): collocation(one, other), (1, 0): collocation(other, one)})
    unsplit = converge(tableau, Oscillator(ONE, ((fmpq(0), fmpq(0)), (ONE, ONE))))
    split = converge(tableau, default(tableau))
    assert (unsplit.visible_order, split.visible_order) == (4, 2)
    assert unsplit.observed_order == pytest.approx(4, abs=1e-3)
    assert split.observed_order == pytest.approx(2, abs=1e-3)


def test_errors_are_those_of_stepping() -> None:
    """rk4 with its classical polynomial, stepped in floats: the same errors and energy errors."""
    omega = fmpq(3, 2)
    result = converge(alone("rk4"), default(alone("rk4"), omega), fmpq(6), [fmpq(1, 4), fmpq(1, 8)])
    w = float(omega)
    L = np.array([[0.0, 1.0], [-w * w, 0.0]])
    start = np.array([1.0, w / 2])
    end = np.array([np.cos(6 * w) + np.sin(6 * w) / 2, w * (np.cos(6 * w) / 2 - np.sin(6 * w))])
    for row, h in zip(result.rows, (0.25, 0.125), strict=True):
        R = sum(
            (np.linalg.matrix_power(h * L, k) / f for k, f in enumerate((1, 1, 2, 6, 24))),
            np.zeros((2, 2)),
        )
        q, p = np.linalg.matrix_power(R, round(6 / h)) @ start
        error = np.hypot(q - end[0], (p - end[1]) / w)
        energy_error = abs((p * p + w * w * q * q) / 2 - 5 * w * w / 8)
        assert float(row.error) == pytest.approx(error, rel=1e-6)
        assert float(row.energy_error) == pytest.approx(energy_error, rel=1e-6)


def test_units_do_not_matter() -> None:
    """A faster oscillator in its own units of time has the very same errors."""
    tableau = symplectic_pair(collocated(2, 3), [0], [1])
    slow, fast = (converge(tableau, default(tableau, omega)) for omega in (ONE, fmpq(22, 7)))
    for one, other in zip(slow.rows, fast.rows, strict=True):
        assert float(one.error / other.error) == pytest.approx(1, abs=1e-9)
    assert slow.observed_order == pytest.approx(fast.observed_order)


def test_gauss_conserves_energy_exactly() -> None:
    """Not small: zero. The pair's energy error is not, and it has the order of the method."""
    gauss, tableau = alone("gauss", 2), pair(collocated(2, 3))
    assert all(row.energy_error == 0 for row in converge(gauss, default(gauss)).rows)
    rows = converge(tableau, default(tableau)).rows
    assert float(rows[-2].energy_error / rows[-1].energy_error) == pytest.approx(16, abs=0.1)


def test_coincidence_is_bounded_and_not_called_zero() -> None:
    """Symplectic Euler with ωh = 1 has R⁶ = I: its energy is back after 6 steps, by chance.

    With ω = 1 all entries are whole numbers and the zero is exact; with ω = 3 there are thirds, and
    a bound.
    """
    none, full = ((fmpq(0),),), ((ONE,),)
    tableau = spelled_out(
        [[none, none], [full, none]], [(ONE,), (ONE,)], [None, None]
    )  # p with the new q
    whole = converge(tableau, default(tableau), fmpq(6), [ONE]).rows[0]
    thirds = converge(tableau, default(tableau, fmpq(3)), fmpq(2), [fmpq(1, 3)]).rows[0]
    assert whole.energy_error == 0
    assert thirds.energy_error.contains(0)
    assert not thirds.energy_error.is_zero()
    assert abs(thirds.energy_error) < 1e-60
    assert thirds.error > 0.1


def test_inconsistent_method_has_order_zero() -> None:
    """Weights that sum to 2 move twice as far: no convergence, slope 0, and it says so."""
    tableau = spelled_out([[((fmpq(0),),)]], [(fmpq(2),)], [None])
    result = converge(tableau, default(tableau))
    assert (result.predicted_order, result.visible_order) == (0, 0)
    assert result.observed_order == pytest.approx(0, abs=0.01)
    assert result.agrees


def test_disagreement_is_possible() -> None:
    """Large steps show no order, and one step size none at all: neither agrees."""
    tableau = alone("explicit-euler")
    coarse = converge(tableau, default(tableau), fmpq(4), [fmpq(4), fmpq(2)])
    assert coarse.observed_order is not None
    assert not coarse.agrees
    single = converge(tableau, default(tableau), fmpq(4), [fmpq(1, 8)])
    assert single.observed_order is None
    assert not single.agrees
    right = converge(tableau, default(tableau))
    assert right.agrees
    assert not replace(right, visible=replace(right.visible, order=2)).agrees


def test_rounded_coefficients_end_the_ladder() -> None:
    """rk4 with weights rounded to 10 digits: order 4 within the tolerance; without it the order is
    0, and shows.
    """
    rk4 = diagonal_method("rk4")
    b = tuple(fmpq(x, 10**10) for x in (1666666667, 3333333333, 3333333333, 1666666666))
    tableau = spelled_out([[rk4.A]], [b], [None])
    within = converge(tableau, default(tableau), tolerance=fmpq(1, 10**9))
    assert (within.visible_order, within.predicted_order, within.verdict) == (4, 4, "agree")
    exact = converge(tableau, default(tableau))
    assert (exact.visible_order, exact.verdict) == (0, "agree")


@pytest.mark.parametrize("missed", [12, 30, 90])
def test_a_condition_missed_by_little_shows_in_a_short_time(missed: int) -> None:
    """rk4 with a weight off by 10^−12 … 10^−90: the steps of usual size show 4, tiny ones the order
    0 that the certificate proves.
    """
    rk4 = diagonal_method("rk4")
    b = (*rk4.b[:3], rk4.b[3] + fmpq(1, 10**missed))
    tableau = spelled_out([[rk4.A]], [b], [None])
    result = converge(tableau, default(tableau))
    assert (result.predicted_order, result.visible_order) == (0, 0)
    assert result.short_order == pytest.approx(0, abs=0.01)
    assert result.verdict == "agree"


def test_visible_order_ends_within_a_tolerance() -> None:
    """Gauss 6 within 1e-8: the conditions of unbranched trees of order 12 are smaller than that,
    so every coefficient beyond agrees, and the search ends there: an order above is no misfit.
    """
    gauss = alone("gauss", 6)
    result = converge(gauss, default(gauss), tolerance=fmpq(1, 10**8))
    assert not result.visible.is_sharp
    assert result.verdict == "agree"


@pytest.mark.parametrize("ratio", [fmpq(1, 2), fmpq(2, 3), fmpq(1, 5)])
def test_observed_order_of_a_known_expansion(ratio: fmpq) -> None:
    """Error = h³(1 + h − 2h²): far from its limit each slope is off, the extrapolated order much
    less so.
    """
    h = [fmpq(1, 10) * ratio**k for k in range(4)]
    rows = [StepSizeRow(x, arb(x**3 * (1 + x - 2 * x * x)), None, arb(0)) for x in h]
    assert observed_order(rows) == pytest.approx(3, abs=2e-3)
    plain = observed_order(rows[-2:])
    assert plain is not None
    assert abs(observed_order(rows) - 3) < abs(plain - 3) / 5  # type: ignore[operator]


def test_step_that_does_not_divide_is_refused() -> None:
    """The end time is the same for all rows, or the slope means nothing."""
    with pytest.raises(UsageProblem, match="not a whole number of steps"):
        converge(alone("rk4"), default(alone("rk4")), fmpq(1), [fmpq(2, 7)])


def test_heavy_libraries_are_not_imported() -> None:
    """A convergence test imports neither numpy nor matplotlib nor sympy."""
    code = (
        "import sys; from flint import fmpq; from garkcli.convergence.convergence import converge\n"
        "import garkcli.longtime.energy\n"
        "from garkcli.problems.oscillator import Oscillator\n"
        "from garkcli.families.registry import diagonal_method as d\n"
        "from garkcli.tableau.forms import gark\n"
        "converge(gark([d('rk4')], {}), Oscillator.default(1, fmpq(1)))\n"
        "print([x for x in ('numpy', 'matplotlib', 'sympy') if x in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "[]\n"


def test_too_many_steps_are_refused() -> None:
    """More steps than a power of a matrix is taken to: refused at once, or where the ladder of
    halvings ends.
    """
    with pytest.raises(UsageProblem, match="limit 1000000000000000"):
        converge(alone("rk4"), Oscillator.default(1, fmpq(1)), fmpq(10**18))
    rows = converge(alone("rk4"), Oscillator.default(1, fmpq(1)), fmpq(10**14)).rows
    assert 1 <= len(rows) < 8
