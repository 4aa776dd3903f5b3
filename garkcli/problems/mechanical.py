"""Problems H = T + V, split for the number of terms of a method.

The kinetic energy goes to the first term and the potential to the others: one part each where there
are as many parts as terms, equal shares of all of it otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import fmpq

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
