"""One problem for several methods, split into different numbers of terms."""

from __future__ import annotations

from dataclasses import replace

from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import Problem


def merge_terms(problem: Problem, terms: int) -> Problem:
    """The same sum in fewer terms, the last of which is the sum of all that remain.

    >>> from garkcli.problems.builtin import hamiltonian
    >>> [str(x) for x in merge_terms(hamiltonian("pendulum", 2), 1).terms]
    ['px**2/2 - cos(x) + 1']
    """
    kept = terms - 1
    if isinstance(problem, Hamiltonian):
        first, rest = problem.terms[:kept], problem.terms[kept:]
        return replace(problem, terms=(*first, sum(rest)))
    sides = problem.terms[kept:]
    merged = tuple(sum(components) for components in zip(*sides, strict=True))
    return replace(problem, terms=(*problem.terms[:kept], merged))
