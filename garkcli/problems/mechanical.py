"""Problems H = T + V, split for the number of terms of a method.

The kinetic energy goes to the first term and the potential to the others: one part each where there
are as many parts as terms, equal shares of all of it otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import arb, fmpq

from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols


def half_square(_: tuple[Any, ...], p: tuple[Any, ...]) -> Any:
    """The kinetic energy ½|p|² of unit masses."""
    return sum(x**2 for x in p) / 2


@dataclass(frozen=True)
class Mechanical:
    """H = T + Σ potentials(q).

    Attributes:
        variables: names of the positions.
        potentials: the parts of the potential, of the positions.
        initial: q(0), then p(0).
        t_end: the final time of a convergence test.
        kinetic: T of the positions and of the momenta.
        invariants: names, and expressions in positions and momenta.
        long_run: a step size and a time that show the motion over a long time.
    """

    variables: tuple[str, ...]
    potentials: Callable[..., tuple[Any, ...]]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    kinetic: Callable[[tuple[Any, ...], tuple[Any, ...]], Any] = half_square
    invariants: Callable[..., tuple[tuple[str, Any], ...]] = lambda *_: ()
    long_run: tuple[fmpq, fmpq] | None = None

    def problem(self, name: str, terms: int) -> Hamiltonian:
        """The problem in ``terms`` terms."""
        q, p = symbols(self.variables, "q"), symbols(self.variables, "p")
        return Hamiltonian(
            name,
            self.variables,
            self._split(q, p, terms),
            self.initial,
            self.t_end,
            self.invariants(*q, *p),
            long_run=self.long_run,
        )

    def _split(
        self, q: tuple[Any, ...], p: tuple[Any, ...], terms: int
    ) -> tuple[Any, ...]:
        import sympy

        T, parts = self.kinetic(q, p), self.potentials(*q)
        V = sum(parts)
        if terms == 1:
            return (T + V,)
        if terms - 1 == len(parts):
            return (T, *parts)
        share = sympy.expand(V / (terms - 1))
        return (T, *(share,) * (terms - 1))


def cosine(x: Any) -> Any:
    """Cos x."""
    import sympy

    return sympy.cos(x)


def kepler_potential(x: Any, y: Any) -> tuple[Any, ...]:
    """−1/|q|."""
    import sympy

    return (-1 / sympy.sqrt(x**2 + y**2),)


def springs(*q: Any) -> tuple[Any, ...]:
    """Springs between walls with quadratic and cubic forces, α = 1/4, β = 1/2: V = Σ r²/2 + αr³/3 +
    βr⁴/4.
    """
    left, right = (0, *q), (*q, 0)
    V = 0
    for a, b in zip(left, right, strict=True):
        r = b - a
        V += r**2 / 2 + r**3 / 12 + r**4 / 8
    return (V,)


def rods(q: tuple[Any, ...], _: tuple[Any, ...]) -> Any:
    """T of two rods of length 1 with masses 1, in absolute angles: its mass matrix depends on their
    difference.
    """
    import sympy

    from garkcli.problems.lagrangian import legendre_transform
    from garkcli.problems.mass import velocities

    (a, b), (u, w) = q, velocities(("a", "b"))
    kinetic = u**2 + w**2 / 2 + u * w * sympy.cos(a - b)
    return legendre_transform(kinetic, ("a", "b"), dict.fromkeys(q, arb(0)))
