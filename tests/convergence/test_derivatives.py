"""Methods that use derivatives of f on problems: a step by its definition, and its evaluations."""

from __future__ import annotations

from flint import fmpq
from mpmath import cos, mp, mpf, sin

from garkcli.api.runs import converge
from garkcli.methodfile.load import load, loads
from garkcli.problems.builtin import problem
from garkcli.stepping.integrator import Stepper, bind

THREE = """\
derivatives:
  A: [[[], [1/2]], [[], [1/9, 1/12]], [[], [1/2]]]
  b: [[1/2, 1/2], [1/6, 1/2], [0, 1/12]]
  c: [0, 1/3]
"""
"""The coefficients 1/2 and 1/12 belong to several powers of h; the last stage is implicit, and its
time is no row sum.
"""


def derivatives(t: mpf, y: mpf) -> list[mpf]:
    """Those of the solution of y′ = −y − sin t + cos t."""
    first = -y - sin(t) + cos(t)
    second = -first - cos(t) - sin(t)
    return [first, second, -second + sin(t) - cos(t)]


def test_a_step_by_its_definition() -> None:
    """Y_2 = y + Σ h^k a^k f_k, with f_2 in Y_2 itself, and the end, with 28 digits: each f_k has
    its power of h, and time its own nodes.
    """
    on = problem("prothero-robinson", 1)
    h = fmpq(1, 4)
    stepper = Stepper(bind(loads(THREE).tableau, on).at(30), h)
    stepper.advance(1)
    (found,) = stepper.y
    with mp.workdps(35):
        size, start = mpf(1) / 4, mpf(int(on.initial[0].p)) / int(on.initial[0].q)
        one = derivatives(mpf(0), start)
        known = start + size * one[0] / 2 + size**2 * one[1] / 9 + size**3 * one[2] / 2
        second = known
        for _ in range(60):  # a contraction by h²/12
            second = known + size**2 * derivatives(size / 3, second)[1] / 12
        two = derivatives(size / 3, second)
        end = start + size * (one[0] + two[0]) / 2 + size**2 * (one[1] / 6 + two[1] / 2)
        end += size**3 * two[2] / 12
        assert abs(mpf(found.str(35, radius=False)) - end) < mpf(10) ** -28


def test_no_derivative_is_evaluated_in_vain() -> None:
    """TDRK4 takes f at the first stage alone, and f′f at both."""
    stepper = Stepper(bind(load("tdrk-4").tableau, problem("logistic", 1)).at(), fmpq(1, 4))
    stepper.advance(1)
    assert stepper.work.evaluations == 3


def test_rounded_methods() -> None:
    """The order within the tolerance is the predicted one, up to the plateau."""
    text = "derivatives: {A: [[[], [0.5]], [[], [0.125]]], b: [[1, 0], [0.1666667, 0.3333333]]}"
    found = converge(loads(f"{text}\ntolerance: 1e-7\n"), "pendulum")
    assert (found.predicted_order, found.verdict) == (4, "agree")


def test_linear_steps_are_those_of_the_step_map() -> None:
    """On the oscillator steps one by one give what R(z) does."""
    found = converge(load("tdrk-4"), "oscillator", is_timed=True)
    assert all(row.cost is not None for row in found.rows)
