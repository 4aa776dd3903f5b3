"""The verdicts of ``gark energy`` on 80 random systems of two planets, of three symplectic methods
and of two that are not; the figures of docs/energy.md.
"""

from __future__ import annotations

from collections import Counter

import pytest
from flint import fmpq

from garkcli.longtime.history import LongRun
from garkcli.longtime.longtime import long_run
from garkcli.methodfile.load import load, loads
from garkcli.problems.files.load import loads_problem
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import StepFailed
from tests.benchmarks.measuring import ROOT
from tests.longtime.planets import GAUSS_2, RALSTON, RK4, STOERMER_VERLET, YOSHIDA_4, two_planets

SYSTEMS = 80
SYMPLECTIC = {"Störmer-Verlet": STOERMER_VERLET, "Yoshida 4": YOSHIDA_4, "Gauss 2": GAUSS_2}
OTHERS = {"RK4": RK4, "Ralston": RALSTON}


STEPS = 10_000


def run(source: str, seed: int, h: fmpq) -> LongRun:
    """10 000 steps of one method on one system."""
    made = loads(source) if ":" in source else load(str(ROOT / source))
    tableau = with_joined_terms(made.tableau)
    return long_run(tableau, loads_problem(two_planets(seed)), STEPS * h, h)


def verdicts(name: str, source: str, h: fmpq) -> Counter[str]:
    """How many of the systems get which verdict on their energy."""
    found: Counter[str] = Counter()
    for seed in range(SYSTEMS):
        try:
            verdict: str = run(source, seed, h).energy.verdict
        except StepFailed:
            verdict = "step failed"
        found[verdict] += 1
    print(f"\n  {name}, h = {h}: {dict(found)}")
    return found


@pytest.mark.parametrize("h", [fmpq(3, 20), fmpq(1, 20)], ids=str)
@pytest.mark.parametrize("name", SYMPLECTIC)
def test_symplectic_methods_do_not_drift(name: str, h: fmpq) -> None:
    """Not on one of the systems."""
    found = verdicts(name, SYMPLECTIC[name], h)
    assert found["drifts"] == 0
    assert found["bounded"] > SYSTEMS * 0.9


@pytest.mark.parametrize("h", [fmpq(3, 20), fmpq(1, 20)], ids=str)
@pytest.mark.parametrize("name", OTHERS)
def test_others_drift(name: str, h: fmpq) -> None:
    """On all systems but those that they break up."""
    found = verdicts(name, OTHERS[name], h)
    assert found["bounded"] == 0
    assert found["drifts"] + found["unstable"] > SYSTEMS * 0.95
