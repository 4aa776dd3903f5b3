"""Nyström and nonlinearly partitioned methods on problems: their steps by their definitions, and
what they are not for.
"""

from __future__ import annotations

import pytest
from flint import fmpq
from mpmath import mp, mpf, sin

from garkcli.api.runs import converge
from garkcli.api.stepped import stepped
from garkcli.constructions.nystrom import Nystrom
from garkcli.errors import UsageProblem
from garkcli.methodfile.load import load
from garkcli.problems.builtin import problem
from garkcli.stepping.integrator import Stepper, bind


def stepped_once(name: str, on: str, h: fmpq) -> list[mpf]:
    """The state after one step, with 30 digits."""
    tableau, _, _ = stepped(load(name).tableau, None, on)
    stepper = Stepper(bind(tableau, problem(on, 2)).at(30), h)
    stepper.advance(1)
    return [mpf(x.str(35, radius=False)) for x in stepper.y]


@pytest.mark.parametrize("name", ["fine-34", "nystrom-4"])
def test_a_step_by_its_definition(name: str) -> None:
    """Q = q + c h q′ + h² Σ ā g and Q′ = q′ + h Σ a g, from q = 1, q′ = 1/2, with 28 digits."""
    with mp.workdps(35):
        method = Nystrom.of(load(name).tableau)
        h, q, v = mpf(1) / 8, mpf(1), mpf(1) / 2

        def number(x: fmpq) -> mpf:
            return mpf(int(x.p)) / int(x.q)

        k: list[mpf] = []
        assert method.A is not None
        for c, abar, a in zip(method.c, method.Abar, method.A, strict=True):
            at = q + number(c) * h * v
            at += h**2 * sum(number(x) * y for x, y in zip(abar, k, strict=False))
            slope = v + h * sum(number(x) * y for x, y in zip(a, k, strict=False))
            k.append(-sin(at) - slope * (1 + slope**2) / 4)
        end_q = q + h * v + h**2 * sum(number(x) * y for x, y in zip(method.bbar, k, strict=True))
        end_v = v + h * sum(number(x) * y for x, y in zip(method.b, k, strict=True))
        found = stepped_once(name, "damped-pendulum", fmpq(1, 8))
        assert abs(found[0] - end_q) < mpf(10) ** -28
        assert abs(found[1] - end_v) < mpf(10) ** -28


def test_a_step_of_two_arguments() -> None:
    """IMEX-NPRK1[21] on y′ = y − y²: Y = y + h (Y − y²), so Y = (y − h y²)/(1 − h)."""
    with mp.workdps(35):
        (found,) = stepped_once("imex-nprk-21", "logistic", fmpq(1, 4))
        y, h = mpf(1) / 10, mpf(1) / 4
        assert abs(found - (y - h * y**2) / (1 - h)) < mpf(10) ** -28


@pytest.mark.parametrize(
    ("name", "on", "message"),
    [
        ("nystrom-5-positions", "damped-pendulum", "for q″ = g"),
        ("nystrom-4", "lotka-volterra", "not written so"),
        ("nystrom-4", "prothero-robinson", "not written so"),
        ("nystrom-4", "double-pendulum", "depends on q"),
        ("nystrom-4", "generic-separable", "to be linear"),
    ],
)
def test_what_is_refused(name: str, on: str, message: str) -> None:
    """Problems with q′ for methods without, other right-hand sides, other kinetic energies."""
    with pytest.raises(UsageProblem, match=message):
        converge(name, on)
