"""Problems H = T + V in terms: T first, then parts of V if these fit, or equal shares."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from flint import arb, fmpq

from garkcli.frozen import Frozen
from garkcli.problems.deferred import Deferred
from garkcli.problems.expr import Expr, Exprs, Invariants
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols

Energy: TypeAlias = Callable[[Exprs, Exprs], Any]


def half_square(_: Exprs, p: Exprs) -> Expr:
    return sum(x**2 for x in p) / 2


class Mechanical(Frozen):
    """H = T + Σ potentials(q); ``invariants`` are first integrals besides H."""

    variables: tuple[str, ...]
    potentials: Callable[..., Exprs]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    kinetic: Energy = half_square
    invariants: tuple[tuple[str, Callable[..., Expr]], ...] = ()
    long_run: tuple[fmpq, fmpq] | None = None

    def problem(self, name: str, terms: int) -> Hamiltonian:
        whole = Deferred(f"{name} terms=1", lambda: self._split(1), 1)
        split = Deferred(f"{name} terms={terms}", lambda: self._split(terms), terms, total=whole)
        invariants: Invariants = ()
        if self.invariants:
            names = tuple(what for what, _ in self.invariants)
            invariants = Deferred(f"{name} invariants", self._conserved, len(names), names)
        return Hamiltonian(
            name,
            self.variables,
            split,
            self.initial,
            self.t_end,
            invariants,
            long_run=self.long_run,
        )

    def _conserved(self) -> list[tuple[str, Expr]]:
        q, p = symbols(self.variables, "q"), symbols(self.variables, "p")
        return [(name, of(*q, *p)) for name, of in self.invariants]

    def _split(self, terms: int) -> Exprs:
        import sympy

        q, p = symbols(self.variables, "q"), symbols(self.variables, "p")
        T = self.kinetic(q, p)
        parts = self.potentials(*q)
        V = sum(parts)
        if terms == 1:
            return (T + V,)
        if terms - 1 == len(parts):
            return (T, *parts)
        shares = terms - 1
        return (T, *[sympy.expand(V / shares)] * shares)


def numbers(text: str) -> tuple[fmpq, ...]:
    return tuple(map(fmpq, text.split()))


def spring(q: Expr) -> Exprs:
    """½ω²q² with ω = 1."""
    return (q**2 / 2,)


def two_springs(x: Expr, y: Expr) -> Exprs:
    """½x² and ½(5/2)²(y − x)²."""
    return x**2 / 2, 25 * (y - x) ** 2 / 8


def pendulum_potential(x: Expr) -> Exprs:
    """1 − cos q."""
    return (_height(x),)


def _height(angle: Expr) -> Expr:
    """The height of the end of a rod of length 1 above its lowest place."""
    import sympy

    return 1 - sympy.cos(angle)


def henon_heiles_potential(x: Expr, y: Expr) -> Exprs:
    """½|q|² + x²y − y³/3."""
    return ((x**2 + y**2) / 2 + x**2 * y - y**3 / 3,)


def kepler_potential(x: Expr, y: Expr) -> Exprs:
    """−1/|q|."""
    import sympy

    return (-1 / sympy.sqrt(x**2 + y**2),)


def angular_momentum(x: Expr, y: Expr, px: Expr, py: Expr) -> Expr:
    return x * py - y * px


def springs(*q: Expr) -> Exprs:
    """Springs between walls: V = Σ r²/2 + αr³/3 + βr⁴/4, α = 1/4, β = 1/2."""
    left, right = (0, *q), (*q, 0)
    V = 0
    for a, b in zip(left, right, strict=True):
        r = b - a
        V += r**2 / 2
        V += r**3 / 12  # α/3
        V += r**4 / 8  # β/4
    return (V,)


def rods_potential(a: Expr, b: Expr) -> Exprs:
    """V of the upper and of the lower mass at the ends of two rods of length 1."""
    upper = _height(a)
    return upper, upper + _height(b)


def rods(q: Exprs, _: Exprs) -> Expr:
    """T of two rods of length 1 with masses 1, in absolute angles."""
    import sympy

    from garkcli.problems.lagrangian import legendre_transform
    from garkcli.problems.mass import velocities

    names = ("a", "b")
    a, b = q
    u, w = velocities(names)
    kinetic = u**2 + w**2 / 2 + u * w * sympy.cos(a - b)
    return legendre_transform(kinetic, names, dict.fromkeys(q, arb(0)))
