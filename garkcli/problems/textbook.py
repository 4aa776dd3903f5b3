"""The equations of every first lecture: ẏ = λy, the logistic equation, predator and prey."""

from __future__ import annotations

from flint import fmpq

from garkcli.problems.expr import rational
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.stiff import shared
from garkcli.problems.vectorfield import TIME, symbols


def dahlquist(terms: int, stiffness: fmpq) -> RightHandSide:
    """ẏ = λ y with λ minus the stiffness; y = e^{λt}.

    Source: Dahlquist, BIT 3 (1963), 27–43.
    """
    import sympy

    variables = ("y",)
    (y,) = symbols(variables, "y")
    (t,) = symbols(variables, TIME)
    rate = -rational(stiffness)
    return RightHandSide(
        "dahlquist",
        variables,
        shared([(rate * y,)], terms),
        (fmpq(1),),
        fmpq(1),
        exact=(sympy.exp(rate * t),),
        stiffness=stiffness,
    )


def logistic(terms: int, _: int) -> RightHandSide:
    """ẏ = y (1 − y) from 1/10: growth, and what limits it; y = 1/(1 + 9 e^{−t})."""
    import sympy

    variables = ("y",)
    (y,) = symbols(variables, "y")
    (t,) = symbols(variables, TIME)
    return RightHandSide(
        "logistic",
        variables,
        shared([(y,), (-(y**2),)], terms),
        (fmpq(1, 10),),
        fmpq(2),
        exact=(1 / (1 + 9 * sympy.exp(-t)),),
    )


def lotka_volterra(terms: int, _: int) -> RightHandSide:
    """u̇ = u (1 − v), v̇ = v (u − 1): prey and predator, with u − ln u + v − ln v constant.

    Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, section I.1.1.
    """
    import sympy

    variables = ("u", "v")
    u, v = symbols(variables, "y")
    zero = 0 * u
    invariant = u - sympy.log(u) + v - sympy.log(v)
    return RightHandSide(
        "lotka-volterra",
        variables,
        shared([(u * (1 - v), zero), (zero, v * (u - 1))], terms),
        (fmpq(2), fmpq(1)),
        fmpq(2),
        invariants=(("invariant", invariant),),
        long_run=(fmpq(1, 10), fmpq(1000)),
    )
