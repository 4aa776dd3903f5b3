"""Steps against a plain loop of leapfrog, and against the solvers of scipy over a thousand Kepler
periods.
"""

from __future__ import annotations

import json
from math import hypot, log10, pi, sin, sqrt
from time import process_time

import numpy as np
from flint import arb, ctx, fmpq

from garkcli import load, loads
from garkcli.problems.builtin import hamiltonian
from garkcli.stepping.integrator import Stepper, bind, trajectory
from tests.benchmarks.measuring import ROOT, assert_ratio, interleaved
from tests.catalogue.method_files import method_file

STEPS = 1_000_000
PERIODS = 1000
PER_PERIOD = {110: 1e-8, 60: 5e-6}
"""Steps of the method of order 10 in one Kepler period, and the final error that they are for."""
START = (0.4, 0.0, 0.0, 2.0)


def test_pendulum_against_leapfrog() -> None:
    """A million steps of the rectangular method, of order 4 and implicit, in the time of 40 million
    of leapfrog.
    """
    made = bind(
        load(str(ROOT / "methods/rectangular.gark.yaml")).tableau, hamiltonian("pendulum", 2)
    ).at()

    def leapfrog() -> None:
        q, p, h = 1.0, 0.5, 0.1
        for _ in range(STEPS):
            p -= h / 2 * sin(q)
            q += h * p
            p -= h / 2 * sin(q)

    ours, theirs = interleaved(lambda: Stepper(made, fmpq(1, 10)).advance(STEPS), leapfrog, 3)
    assert_ratio(
        "rectangular pendulum / leapfrog loop", ours / theirs, 40, f"{ours:.2f} s, {theirs:.3f} s"
    )


def energy(y: list[float]) -> float:
    """H of Kepler's problem."""
    return (y[2] ** 2 + y[3] ** 2) / 2 - 1 / hypot(y[0], y[1])


def test_kepler_against_scipy() -> None:
    """A thousand periods, eccentricity 0.6: less time for a correct digit than scipy's fastest
    solver needs.

    scipy's solvers do not get to 1e-8 at all, so the tightest tolerances that serve them are
    compared; at the error of the fastest we are compared at equal error too. The energy of ours is
    bounded, theirs drifts.
    """
    ours = {n: _ours(n) for n in PER_PERIOD}
    theirs = [_scipy("DOP853", 2.3e-14, 1e-16), _scipy("LSODA", 1e-13, 1e-13)]
    (seconds, error), best = ours[110], min(theirs, key=_a_digit)
    detail = f"{seconds:.2f} s to {error:.1e}, {best[0]:.1f} s to {best[1]:.1e}"
    assert_ratio(
        "Kepler to 1e-8, time a digit / scipy", _a_digit(ours[110]) / _a_digit(best), 1.0, detail
    )
    (seconds, error), fastest = ours[60], min(theirs)
    assert error < fastest[1]
    detail = f"{seconds:.2f} s to {error:.1e}, {fastest[0]:.1f} s to {fastest[1]:.1e}"
    assert_ratio("Kepler at equal error, time / scipy", seconds / fastest[0], 1.0, detail)


def _a_digit(run: tuple[float, float]) -> float:
    """Seconds for a correct digit, from seconds and error."""
    seconds, error = run
    return -seconds / log10(error)


def _ours(per_period: int) -> tuple[float, float]:
    """Seconds and final error; the energy error of the last ten periods has to be that of the first
    ten.
    """
    entry = json.loads(
        (ROOT / "tests/catalogue/data/sprk_Sofroniou_10_36.json").read_text(encoding="utf-8")
    )
    made = bind(loads(method_file(entry)).tableau, hamiltonian("kepler", 2)).at()
    with ctx.workprec(120):
        period = fmpq(int((2 * arb.pi() * 10**30).floor().unique_fmpz()), 10**30)
    h = period / per_period
    start = process_time()
    state = Stepper(made, h)
    state.advance(PERIODS * per_period)
    seconds = process_time() - start
    error = float(np.linalg.norm(np.subtract(state.y, START)))
    assert error < PER_PERIOD[per_period]

    def largest(initial: list[float]) -> float:
        path = trajectory(made, h, 10 * per_period, initial)
        return max(abs(energy(y) - energy(list(START))) for y in path)

    first, last = largest(list(START)), largest(state.y)
    print(
        f"\n  {seconds:.2f} s, error {error:.1e}; largest energy error {first:.1e} at first, {last:.1e} at last"
    )
    assert last < 1.2 * first
    return seconds, error


def _scipy(method: str, rtol: float, atol: float) -> tuple[float, float]:
    """Seconds and final error of one of scipy's solvers; its energy error has to grow, as we say it
    does.
    """
    from scipy.integrate import solve_ivp

    def field(_: float, y: np.ndarray) -> tuple[float, ...]:
        q0, q1, p0, p1 = y
        r2 = q0 * q0 + q1 * q1
        w = -1 / (r2 * sqrt(r2))
        return p0, p1, w * q0, w * q1

    times = [2 * pi * k for k in (PERIODS // 100, PERIODS)]
    start = process_time()
    solved = solve_ivp(
        field, (0, times[-1]), START, method=method, rtol=rtol, atol=atol, t_eval=times
    )
    seconds = process_time() - start
    early, late = (abs(energy(y.tolist()) - energy(list(START))) for y in solved.y.T)
    error = float(np.linalg.norm(solved.y[:, -1] - START))
    print(
        f"  scipy {method}: {seconds:.1f} s, error {error:.1e}; energy error {early:.1e}, then {late:.1e}"
    )
    assert late > 10 * early
    return seconds, error
