"""What becomes of the powers of a matrix, decided exactly."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.families.registry import diagonal_method
from garkcli.longtime.history import stability
from garkcli.longtime.longtime import long_run
from garkcli.methodfile.load import loads
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stepping.linear import linear_step
from garkcli.tableau.forms import gark

entries = st.builds(fmpq, st.integers(-6, 6), st.integers(1, 4))


@given(entries, entries, entries, entries)
def test_fate_is_that_of_the_eigenvalues(a: fmpq, b: fmpq, c: fmpq, d: fmpq) -> None:
    """Wherever floats can tell, the eigenvalues say the same."""
    found = stability(((a, b), (c, d)))
    sizes = sorted(
        abs(
            np.linalg.eigvals(
                [
                    [float(a.p) / float(a.q), float(b.p) / float(b.q)],
                    [float(c.p) / float(c.q), float(d.p) / float(d.q)],
                ]
            )
        )
    )
    assert found.is_symplectic == (a * d - b * c == 1)
    if sizes[1] > 1 + 1e-6:
        assert found.fate == "unstable"
    elif sizes[1] < 1 - 1e-6:
        assert found.fate == "contractive"
    elif sizes[0] < 1 - 1e-6:
        assert found.fate == "marginal"


@given(entries, entries, entries)
def test_area_preserved(a: fmpq, b: fmpq, c: fmpq) -> None:
    """With det R = 1 orbits turn if and only if |tr R| < 2; on the border only for R = ±I."""
    if not a:
        return
    R = ((a, b), (c, (1 + b * c) / a))
    found = stability(R)
    trace = a + (1 + b * c) / a
    assert found.is_symplectic
    if abs(trace) == 2:
        assert found.fate == ("unstable" if b or c else "elliptic")
    else:
        assert found.fate == ("elliptic" if abs(trace) < 2 else "unstable")


@pytest.mark.parametrize(
    ("R", "fate"),
    [
        (((1, 0), (0, 1)), "elliptic"),
        (((-1, 0), (0, -1)), "elliptic"),
        (((1, 1), (0, 1)), "unstable"),
        (((1, 0), (0, -1)), "marginal"),
        (((0, 1), (1, 0)), "marginal"),
        (((1, 0), (0, 0)), "marginal"),
        (((2, 0), (0, -1)), "unstable"),
        (((0, 0), (0, 0)), "contractive"),
    ],
)
def test_borders(R: tuple[tuple[int, int], tuple[int, int]], fate: str) -> None:
    """Where floats could not tell."""
    assert stability(tuple(tuple(fmpq(x) for x in row) for row in R)).fate == fate


def test_irrational_steps() -> None:
    """The determinant of a step with square roots is decided too."""
    tableau = loads("""
ark:
  A: [[[1 - sqrt(2)/2, 0], [sqrt(2) - 1, 1 - sqrt(2)/2]]]
  b: [[1/2, 1/2]]
""").tableau
    R = linear_step(tableau, Oscillator.default(terms_of(tableau), fmpq(1))).at(fmpq(1, 2))
    assert stability(R).fate == "contractive"


@pytest.mark.parametrize(
    ("name", "stages", "fate"),
    [
        ("gauss", 2, "elliptic"),
        ("rk4", None, "contractive"),
        ("explicit-euler", None, "unstable"),
        ("radau-iia", 2, "contractive"),
    ],
)
def test_methods(name: str, stages: int | None, fate: str) -> None:
    """What is known of them, at h = 1/2; and so does the energy go."""
    tableau = gark([diagonal_method(name, stages)], {})
    result = long_run(tableau, Oscillator.default(1, fmpq(1)), fmpq(20), fmpq(1, 2))
    assert result.stability.fate == fate
    last = result.energy.errors[-1]
    assert {"elliptic": last == 0, "contractive": last < 0, "unstable": last > 0}[fate]


def test_leapfrog_is_stable_up_to_its_bound() -> None:
    """ωh < 2, and not at 2 nor beyond."""
    tableau = loads("""
prk:
  q: {A: [[0], [1]], b: [1], c: [0, 1]}
  p: {A: [[1/2, 0]], b: [1/2, 1/2], c: [1/2]}
structure: separable
""").tableau
    step = linear_step(tableau, Oscillator.default(terms_of(tableau), fmpq(1)))
    fates = [stability(step.at(h)).fate for h in (fmpq(1), fmpq(199, 100), fmpq(2), fmpq(201, 100))]
    assert fates == ["elliptic", "elliptic", "unstable", "unstable"]
