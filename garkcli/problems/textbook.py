"""Textbook equations: ẏ = λy, the logistic equation, predator and prey, a pendulum with drag."""

from __future__ import annotations

from flint import fmpq

from garkcli.problems.deferred import Deferred
from garkcli.problems.expr import Exprs, Invariants, rational
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.stiff import shared
from garkcli.problems.vectorfield import TIME, symbols


def dahlquist(terms: int, stiffness: fmpq) -> RightHandSide:
    """ẏ = λ y with λ minus the stiffness; y = e^{λt}. Source: Dahlquist, BIT 3 (1963), 27–43."""
    variables = ("y",)

    def parts() -> list[Exprs]:
        (y,) = symbols(variables, "y")
        return [(-rational(stiffness) * y,)]

    def solution() -> Exprs:
        import sympy

        (t,) = symbols(variables, TIME)
        return (sympy.exp(-rational(stiffness) * t),)

    name = f"dahlquist stiffness={stiffness}"
    return RightHandSide(
        "dahlquist",
        variables,
        shared(name, parts, terms),
        (fmpq(1),),
        fmpq(1),
        exact=Deferred(f"{name} solution", solution, 1),
        stiffness=stiffness,
    )


def logistic(terms: int, _: int) -> RightHandSide:
    """ẏ = y (1 − y) from 1/10: growth and its limit; y = 1/(1 + 9 e^{−t})."""
    variables = ("y",)

    def parts() -> list[Exprs]:
        (y,) = symbols(variables, "y")
        return [(y,), (-(y**2),)]

    def solution() -> Exprs:
        import sympy

        (t,) = symbols(variables, TIME)
        return (1 / (1 + 9 * sympy.exp(-t)),)

    return RightHandSide(
        "logistic",
        variables,
        shared("logistic", parts, terms),
        (fmpq(1, 10),),
        fmpq(2),
        exact=Deferred("logistic solution", solution, 1),
    )


def lotka_volterra(terms: int, _: int) -> RightHandSide:
    """u̇ = u (1 − v), v̇ = v (u − 1): prey and predator, with u − ln u + v − ln v constant. Source:
    Hairer, Lubich and Wanner, Geometric Numerical Integration, section I.1.1.
    """
    variables = ("u", "v")

    def parts() -> list[Exprs]:
        u, v = symbols(variables, "y")
        zero = 0 * u
        return [(u * (1 - v), zero), (zero, v * (u - 1))]

    def invariants() -> Invariants:
        import sympy

        u, v = symbols(variables, "y")
        return (("invariant", u - sympy.log(u) + v - sympy.log(v)),)

    return RightHandSide(
        "lotka-volterra",
        variables,
        shared("lotka-volterra", parts, terms),
        (fmpq(2), fmpq(1)),
        fmpq(2),
        invariants=Deferred("lotka-volterra invariants", invariants, 1, ("invariant",)),
        long_run=(fmpq(1, 10), fmpq(1000)),
    )


def damped_pendulum(terms: int, _: int) -> RightHandSide:
    """q″ = −sin q − q′ (1 + q′²)/4 as q̇ = p, ṗ = g(q, p): a pendulum with linear and cubic drag."""
    variables = ("q", "v")

    def parts() -> list[Exprs]:
        import sympy

        q, v = symbols(variables, "y")
        zero = 0 * q
        return [(v, zero), (zero, -sympy.sin(q) - v * (1 + v**2) / 4)]

    return RightHandSide(
        "damped-pendulum",
        variables,
        shared("damped-pendulum", parts, terms),
        (fmpq(1), fmpq(1, 2)),
        fmpq(2),
    )
