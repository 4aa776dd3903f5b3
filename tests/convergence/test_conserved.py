"""Whether invariants are kept by the exact solution."""

from __future__ import annotations

import pytest
import sympy
from flint import fmpq

from garkcli.convergence.reference import changing
from garkcli.frozen import replace
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols
from tests.whole import in_whole

KEPLER = hamiltonian("kepler", 2)
(X, Y), (PX, PY) = (symbols(("x", "y"), group) for group in ("q", "p"))
MOMENTUM = X * PY - Y * PX
RADIUS = sympy.sqrt(X**2 + Y**2)


def kepler_with(invariant: sympy.Expr) -> Hamiltonian:
    """Kepler's problem with one invariant, right or wrong."""
    return replace(KEPLER, invariants=(("I", invariant),))


@pytest.mark.parametrize(
    "invariant",
    [
        MOMENTUM,
        PY * MOMENTUM - X / RADIUS,
        -PX * MOMENTUM - Y / RADIUS,
        KEPLER.energy**2,
        MOMENTUM**3 * KEPLER.energy,
    ],
)
def test_invariants_are_kept(invariant: sympy.Expr) -> None:
    """Angular momentum, the vector of Laplace, and functions of them."""
    assert changing(kepler_with(invariant)) == ()


@pytest.mark.parametrize(
    "invariant", [X, X * PX, X * PY + Y * PX, MOMENTUM + PX / 10**9, KEPLER.terms[0]]
)
def test_others_are_told_with_their_change(invariant: sympy.Expr) -> None:
    """Also those that change little, or have no derivative along the solution at the start."""
    ((name, change, time),) = changing(kepler_with(invariant))
    assert name == "I"
    assert time == fmpq(1, 32)
    # a series for the solution, to second order from the perihelion: x = 2/5 − t²/2 (5/2)², y = 2t
    # − …
    if invariant == X:
        assert change == pytest.approx(-(float(time) ** 2) / 2 * 6.25, rel=0.01)


@in_whole
def test_nothing_is_said_without_a_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    """A problem without invariants; and one whose solution ends at once, however few steps are
    tried before that is seen.
    """
    monkeypatch.setattr("garkcli.convergence.reference.MAX_TRIED", 100)
    assert changing(hamiltonian("pendulum", 2)) == ()
    at_once = replace(kepler_with(X), initial=(fmpq(1, 10**6), fmpq(0), fmpq(0), fmpq(0)))
    assert changing(at_once) == ()
