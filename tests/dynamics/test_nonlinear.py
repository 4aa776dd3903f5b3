"""Observed orders on nonlinear problems, the reference solution, and their report."""

from __future__ import annotations

from garkcli.dynamics.examples import hamiltonian
from garkcli.dynamics.nonlinear import Observation, observe
from garkcli.dynamics.problems import terms_of
from garkcli.tableau.tableau import Tableau


def observed(tableau: Tableau, name: str, seed: int = 1) -> Observation:
    """The convergence test with its defaults."""
    return observe(tableau, hamiltonian(name, terms_of(tableau), seed))
