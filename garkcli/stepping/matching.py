"""A problem in the number of terms that a method is for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from garkcli.errors import UsageProblem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import Problem
from garkcli.problems.vectorfield import symbols


def split_into(problem: Problem, terms: int) -> Problem:
    """``problem`` with as many terms.

    One term is the sum. A Hamiltonian of one term is split in the natural way: the summands with
    momenta make the first term, those of the positions alone the others, in equal shares.

    Raises:
        UsageProblem: there is no natural split.
    """
    found = len(problem.terms)
    if found == terms:
        return problem
    if terms == 1:
        return problem.unsplit()
    if found == 1 and isinstance(problem, Hamiltonian):
        split = _natural(problem, terms)
        if split is not None:
            return replace(problem, terms=split)
    plural = "s" if found > 1 else ""
    cure = f"give a list of {terms} in its file"
    if found > 1:
        cure += f", or choose a method for {found}"
    elif isinstance(problem, Hamiltonian):
        cure += ": no sum of parts with and without momenta"
    message = f"{problem.name} has {found} term{plural}, the method is for {terms}"
    raise UsageProblem(message, cure, code="other-problem")


def _natural(problem: Hamiltonian, terms: int) -> tuple[Any, ...] | None:
    """T and shares of V, for H = T(q, p) + V(q); None where there is only one of them."""
    import sympy

    momenta = set(symbols(problem.variables, "p"))
    summands = sympy.Add.make_args(problem.terms[0])
    kinetic: list[Any] = []
    potential: list[Any] = []
    for x in summands:
        part = kinetic if x.free_symbols & momenta else potential
        part.append(x)
    if not kinetic or not any(x.free_symbols for x in potential):
        return None
    V = sympy.Add(*potential)
    share = sympy.expand(V / (terms - 1))
    return (sympy.Add(*kinetic), *(share,) * (terms - 1))
