"""What the list of built-in problems is made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

from flint import fmpq

from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.mechanical import Mechanical
from garkcli.problems.problem import Problem
from garkcli.problems.righthandside import RightHandSide

Maker: TypeAlias = Callable[[int, int], Problem]
"""Makes a problem of a number of terms and a seed."""
StiffMaker: TypeAlias = Callable[[int, fmpq], RightHandSide]
"""Makes a problem of a number of terms and a stiffness."""


@dataclass(frozen=True)
class BuiltIn:
    """A built-in problem.

    Attributes:
        name: what ``--problem`` takes.
        summary: one line for ``gark list``.
        formula: H, or the sum of the right-hand sides, for people.
        sees: which trees it sees, for people.
        make: makes it.
        takes_seed: whether its coefficients depend on the seed.
        is_hamiltonian: whether it is; otherwise its terms are right-hand sides.
        stiff: makes it with a stiffness, where it has one to be chosen.
    """

    name: str
    summary: str
    formula: str
    sees: str
    make: Maker
    takes_seed: bool = False
    is_hamiltonian: bool = True
    stiff: StiffMaker | None = None

    @property
    def takes_stiffness(self) -> bool:
        """Whether it has a stiffness to be chosen."""
        return self.stiff is not None


def mechanical(name: str, summary: str, formula: str, sees: str, made: Mechanical) -> BuiltIn:
    """An entry for H = T + V, without a seed."""

    def make(terms: int, _: int) -> Hamiltonian:
        return made.problem(name, terms)

    return BuiltIn(name, summary, formula, sees, make)


def stiff_one(name: str, summary: str, formula: str, sees: str, made: StiffMaker) -> BuiltIn:
    """An entry for stiff right-hand sides; their stiffness is 1 where none is chosen."""

    def make(terms: int, _: int) -> RightHandSide:
        return made(terms, fmpq(1))

    entry = BuiltIn(name, summary, formula, sees, make, is_hamiltonian=False)
    return replace(entry, stiff=made)
