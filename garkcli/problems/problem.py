"""What is integrated, of either kind: a split Hamiltonian, or a right-hand side for each colour."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from garkcli.frozen import replace
from garkcli.problems.expr import Exprs
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian, vector_field
from garkcli.problems.righthandside import RightHandSide, right_hand_side
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import TIME, Group, VectorField, symbols

Problem: TypeAlias = Hamiltonian | RightHandSide
"""What a method steps."""


def field_of(problem: Problem, term: int, drives: Group) -> VectorField:
    """The vector field of one term that drives a group."""
    if isinstance(problem, Hamiltonian):
        return vector_field(problem, term, drives)
    return right_hand_side(problem, term)


def unknowns(problem: Problem) -> Exprs:
    """The symbols of a state, time excluded."""
    names: Exprs = ()
    for group in problem.layout.groups:
        if group != TIME:
            names += symbols(problem.variables, group)
    return names


def quantities_function(problem: Problem, digits: int) -> Callable[..., list[Any]]:
    """What is conserved, the energy first where there is one, as a function of the unknowns:
    floats, or balls for more ``digits``.

    For balls the rational constants are enclosed once, at the precision in force now.
    """
    expressions = tuple(x for _, x in problem.quantities)
    return function(expressions, unknowns(problem), digits > FLOAT_DIGITS)


def merge_terms(problem: Problem, terms: int) -> Problem:
    """The same sum in fewer terms, the last of which is the sum of all that remain.

    >>> from garkcli.problems.builtin import hamiltonian
    >>> [str(x) for x in merge_terms(hamiltonian("pendulum", 2), 1).terms]
    ['px**2/2 - cos(x) + 1']
    """
    last = terms - 1
    if isinstance(problem, Hamiltonian):
        return replace(problem, terms=(*problem.terms[:last], sum(problem.terms[last:])))
    totals = tuple(map(sum, zip(*problem.terms[last:], strict=True)))
    return replace(problem, terms=(*problem.terms[:last], totals))
