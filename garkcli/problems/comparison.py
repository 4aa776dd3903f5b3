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
    last = terms - 1
    if isinstance(problem, Hamiltonian):
        total = sum(problem.terms[last:])
        return replace(problem, terms=(*problem.terms[:last], total))
    by_component = zip(*problem.terms[last:], strict=True)
    totals = tuple(map(sum, by_component))
    return replace(problem, terms=(*problem.terms[:last], totals))
