"""One problem for several methods, split into different numbers of terms."""

from __future__ import annotations

from dataclasses import replace

from garkcli.problems.hamiltonian import Hamiltonian


def merge_terms(problem: Hamiltonian, terms: int) -> Hamiltonian:
    """The same H in fewer terms, the last of which is the sum of all that remain.

    >>> from garkcli.problems.builtin import hamiltonian
    >>> [str(x) for x in merge_terms(hamiltonian("pendulum", 2), 1).terms]
    ['px**2/2 - cos(x) + 1']
    """
    kept = terms - 1
    first, rest = problem.terms[:kept], problem.terms[kept:]
    return replace(problem, terms=(*first, sum(rest)))
