"""What ``make bridges`` runs and compares, without another code."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import cos, hypot, sin
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli import catalogue
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.bridges.rounding import nearest_float
from garkcli.bridges.structure import composition, shared, table
from garkcli.bridges.trials import STEPS, TRIALS, WHOLE, WORDS, Trial
from garkcli.frozen import replace
from tests.bridges import machine
from tests.bridges.comparing import SIZES, allowed, own_errors
from tests.bridges.machine import NotHad, Tool, need
from tests.bridges.methods import METHODS
from tests.bridges.read_back import differing, rounded
from tests.bridges.run import Outcome, chosen, compared
from tests.bridges.runners import RUNNERS, Runner

Field = Callable[[float, list[float]], list[float]]
RUNNER = RUNNERS[0]


def fields(trial: Trial) -> list[Field]:
    """Each right-hand side of a problem, and their sum."""
    codes = [
        [compile(x, trial.name, "eval") for x in trial.formulas(side, WORDS)]
        for side in range(len(trial.sides))
    ]

    def field(chosen: list[list[Any]]) -> Field:
        def value(t: float, y: list[float]) -> list[float]:
            names = {"t": t, "y": y, "sin": sin, "cos": cos}
            parts = [[eval(code, names) for code in side] for side in chosen]
            return [sum(part[k] for part in parts) for k in (0, 1)]

        return value

    return [field(codes), *[field([side]) for side in codes]]


def floats(payload: Payload, steps: int) -> float:
    """The error of an explicit method in floats, by a loop of our own."""
    found = table(payload)
    A = [[nearest_float(x) for x in row] for row in found.A]
    b = [nearest_float(x) for x in found.b]
    c = [nearest_float(x) for x in found.c]
    field, *_ = fields(WHOLE)
    h = WHOLE.t_end / steps
    y = [float(x) for x in WHOLE.initial]
    for n in range(steps):
        slopes: list[list[float]] = []
        for row, node in zip(A, c, strict=True):
            stage = list(y)
            for a, slope in zip(row, slopes, strict=False):
                stage = [z + h * a * k for z, k in zip(stage, slope, strict=True)]
            slopes.append(field(n * h + node * h, stage))
        for weight, slope in zip(b, slopes, strict=True):
            y = [z + h * weight * k for z, k in zip(y, slope, strict=True)]
    ends = [float(x) for x in WHOLE.final]
    return hypot(y[0] - ends[0], y[1] - ends[1])


@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_the_sizes_of_problems_are_bounds(trial: Trial) -> None:
    """Values, slopes and Lipschitz constants along the solution, by differences, lie below."""
    sizes = SIZES[trial.name]
    whole, *parts = fields(trial)
    h = trial.t_end / 200
    y = [float(x) for x in trial.initial]
    for n in range(200):
        assert max(map(abs, y)) <= sizes.value
        for field in (whole, *parts):
            here = field(n * h, y)
            assert max(map(abs, here)) <= sizes.slope
            rows = [0.0, 0.0]
            for k in (0, 1):
                moved = list(y)
                moved[k] += 1e-6
                there = field(n * h, moved)
                for i in (0, 1):
                    rows[i] += abs(there[i] - here[i]) / 1e-6
            assert max(rows) <= sizes.lipschitz + 1e-5
        half = [z + h / 2 * k for z, k in zip(y, whole(n * h, y), strict=True)]
        slope = whole((n + 0.5) * h, half)
        y = [z + h * k for z, k in zip(y, slope, strict=True)]


@pytest.fixture(scope="module")
def kutta() -> tuple[Payload, list[float]]:
    """The 3/8 rule, and the errors that gark finds."""
    method = catalogue["kutta-38"]
    payload = prepared(method)
    return payload, own_errors(method, payload)


def test_floats_are_within_the_bound(kutta: tuple[Payload, list[float]]) -> None:
    """A second way to step in floats makes the errors of gark, as far as rounding lets it."""
    payload, ours = kutta
    found = [(n, floats(payload, n)) for n in STEPS]
    outcome = compared(RUNNER, payload, Outcome("", "", ""), ours, found)
    assert outcome.is_good
    assert outcome.share < 1
    assert outcome.away < 1e-14


@pytest.mark.parametrize("place", ["A", "b", "c"])
def test_a_wrong_digit_is_beyond_the_bound(place: str, kutta: tuple[Payload, list[float]]) -> None:
    """The tenth digit of one entry is enough: it is no rounding."""
    payload, ours = kutta
    wrong = fmpq(1, 10**10)
    A, b, c = payload.A[0][0], payload.b[0], payload.c[0]
    assert A is not None
    if place == "A":
        A = (*A[:3], (A[3][0], A[3][1] + wrong, *A[3][2:]))
    if place == "b":
        b = (b[0] + wrong, *b[1:])
    if place == "c":
        c = (*c[:2], c[2] + wrong, c[3])
    other = replace(payload, A=((A,),), b=(b,), c=(c,))
    found = [(n, floats(other, n)) for n in STEPS]
    outcome = compared(RUNNER, payload, Outcome("", "", ""), ours, found)
    assert outcome.note == "the errors are others"


def test_solvers_and_readings_widen_the_bound(kutta: tuple[Payload, list[float]]) -> None:
    """Stages that are solved for, and numbers taken out by a formula, are off by as much more."""
    payload, _ = kutta
    bare = allowed(payload, 8)
    assert 0 < bare < 1e-12
    assert bare < allowed(payload, 8, solver=1e-12) < bare + 1e-10
    assert bare < allowed(payload, 8, reading=100) < bare + 1e-13


def test_what_is_run_is_there() -> None:
    """Targets have programs for the kinds that are run, and methods are of their kinds."""
    kinds = {"explicit": "rk", "DIRK": "rk", "IMEX": "ark", "SPRK": "prk"}
    for runner in RUNNERS:
        bridge = bridges()[runner.target]
        assert bridge.words is not None
        assert {kinds[kind] for kind in runner.kinds} <= {*bridge.kinds}
    assert len({runner.name for runner in RUNNERS}) == len(RUNNERS)


def test_methods_are_of_their_kinds() -> None:
    """By what the tables are."""
    payloads = {
        kind: [prepared(catalogue[name]) for name in names[:1]] for kind, names in METHODS.items()
    }
    (explicit,), (dirk,) = payloads["explicit"], payloads["DIRK"]
    assert table(explicit).is_explicit
    assert table(dirk).is_diagonally_implicit
    assert not table(dirk).is_explicit
    (imex,), (sprk,) = payloads["IMEX"], payloads["SPRK"]
    assert [x.is_explicit for x in shared(imex)] == [True, False]
    assert composition(sprk) is not None


@given(st.fractions(max_denominator=10**20))
def test_rounding_to_53_bits_is_that_of_floats(x: Any) -> None:
    """The nearest number of 53 bits is the nearest float."""
    exact = fmpq(x.numerator, x.denominator)
    assert float(rounded(exact, 53)) == nearest_float(exact)


def test_a_bit_that_differs_is_found(kutta: tuple[Payload, list[float]]) -> None:
    """The last bit of one entry."""
    payload, _ = kutta
    arrays = [("A", 16), ("b", 4), ("c", 4)]
    found = table(payload)
    cells = [x for row in found.A for x in row] + [*found.b, *found.c]
    values = [rounded(x, 53) for x in cells]
    assert differing(payload, arrays, values, 53) == []
    values[4] *= 1 + Fraction(1, 2**52)
    assert differing(payload, arrays, values, 53) == ["A[4]"]


def test_beginnings_choose() -> None:
    """Several words, each the beginning of several names; a word of no name is said."""
    names = [runner.name for runner in chosen("sund,BOOST")]
    assert names == ["Boost.Odeint", "SUNDIALS", "SUNDIALS 7"]
    assert len(chosen("")) == len(RUNNERS)
    with pytest.raises(SystemExit, match="no code begins with 'sunk'"):
        chosen("sunk")


def test_what_is_not_to_be_had_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without apt, and without root, the reason and the cure are named; nothing is installed."""
    tool = Tool("Nothing", ("no-such-program-anywhere",), "no-package")
    monkeypatch.setattr(machine.shutil, "which", lambda _: None)
    with pytest.raises(NotHad, match="Nothing: install it by hand"):
        need(tool)
    machine._install.cache_clear()
    monkeypatch.setattr(machine.shutil, "which", lambda name: name)
    monkeypatch.setattr(machine.os, "geteuid", lambda: 1000, raising=False)
    with pytest.raises(NotHad, match="as root, apt-get install no-package"):
        need(tool)
    machine._install.cache_clear()


def test_outcomes_without_rows_are_no_success() -> None:
    """A refusal, or a program that fails, is told in the table."""
    assert not Outcome("x", "DIRK", "y", note="refused: so").is_good
    assert isinstance(RUNNER, Runner)
