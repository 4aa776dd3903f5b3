"""The problem of a convergence test where none is named: one that sees every tree of the method."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from garkcli.errors import UsageProblem
from garkcli.problems.builtin import GENERIC, GENERIC_RHS, hamiltonian
from garkcli.problems.generic import generic_rhs
from garkcli.problems.oscillator import terms_of
from garkcli.problems.problem import Problem, merge_terms
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import bind
from garkcli.tableau.tableau import Tableau


def seeing_problem(tableaux: Sequence[Tableau], seed: int = 1) -> str:
    """The name of the problem that sees the most trees and is of the form that the structures of
    all methods are for; of most of them where there is none for all.

    It is Hamiltonian unless no method steps a Hamiltonian one: that is so where a colour is linear
    and drives all unknowns. Then it is the one of right-hand sides, linear for these colours.

    Args:
        tableaux: of the methods, at least one.
        seed: of the random coefficients.

    Raises:
        UsageProblem: it is for none of them.

    >>> from garkcli import loads
    >>> seeing_problem([loads("methods: [{family: rk4}]").tableau])
    'generic'
    """
    counts = {}
    for name in GENERIC:
        problems = in_common(name, tableaux, seed)
        counts[name] = sum(map(_fits, tableaux, problems))
        if counts[name] == len(tableaux):
            return name
    # the first of those that are equal
    most = max(counts, key=lambda name: counts[name])
    if counts[most] == 0:
        sides = in_common(GENERIC_RHS, tableaux, seed)
        if any(map(_fits, tableaux, sides)):
            return GENERIC_RHS
        raise UsageProblem(
            "no problem with random coefficients is of the form that the structure is for",
            "name one with --problem",
            code="other-problem",
        )
    return most


def in_common(name: str, tableaux: Sequence[Tableau], seed: int) -> list[Problem]:
    """The problem called ``name`` for each method, with one sum for all of them.

    Its coefficients depend on the number of terms: all methods get that of the method with the
    most, with terms added up where they have fewer.
    """
    terms = [terms_of(with_joined_terms(tableau)) for tableau in tableaux]
    most = max(terms)
    if name == GENERIC_RHS:
        found = [_linear_terms(x) for x, n in zip(tableaux, terms, strict=True) if n == most]
        widest: Problem = generic_rhs(most, seed, frozenset.union(*found))
    else:
        widest = hamiltonian(name, most, seed)
    return [merge_terms(widest, count) for count in terms]


def _linear_terms(tableau: Tableau) -> frozenset[int]:
    """The terms whose colours are linear."""
    return frozenset(x.term for x in tableau.colours if x.is_linear)


def _fits(tableau: Tableau, problem: Problem) -> bool:
    with suppress(UsageProblem):
        bind(tableau, problem)
        return True
    return False
