"""What ``--problem`` names: a built-in problem, split for the method at hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.dynamics.hamiltonian import Hamiltonian
    from garkcli.tableau.tableau import Tableau


def find_problem(name_or_path: str, tableau: Tableau, seed: int | None = None) -> Hamiltonian:
    """The problem called so, split into the terms that ``tableau`` has; ``seed`` is for ``generic``.

    Raises:
        UsageProblem: there is no such problem, or it takes no seed.
    """
    from garkcli.dynamics.examples import hamiltonian
    from garkcli.dynamics.problems import terms_of
    from garkcli.dynamics.structure import fitted

    if seed is not None and name_or_path != "generic":
        raise UsageProblem(f"--seed is for the problem generic, not for {name_or_path}", "leave it out")
    return hamiltonian(name_or_path, terms_of(fitted(tableau)), 1 if seed is None else seed)
