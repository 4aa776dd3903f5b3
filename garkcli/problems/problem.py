"""Problems of either kind: a split Hamiltonian, or a right-hand side for each colour."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from garkcli.frozen import replace
from garkcli.problems.deferred import Deferred, ask, names_of
from garkcli.problems.expr import Expr, Exprs, Vector
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian, vector_field
from garkcli.problems.righthandside import RightHandSide, right_hand_side
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import TIME, Group, VectorField, arguments_in

Problem: TypeAlias = Hamiltonian | RightHandSide


def field_of(problem: Problem, term: int, drives: Group) -> VectorField:
    if isinstance(problem, Hamiltonian):
        return vector_field(problem, term, drives)
    return right_hand_side(problem, term)


def unknowns(problem: Problem) -> Deferred:
    groups = [group for group in problem.layout.groups if group != TIME]
    return arguments_in(problem.variables, groups)


def conserved(problem: Problem) -> Vector:
    invariants = problem.invariants
    of = problem.terms if isinstance(problem, Hamiltonian) else invariants

    def make() -> list[Expr]:
        return [x for _, x in problem.quantities]

    if isinstance(of, Deferred) and (not invariants or isinstance(invariants, Deferred)):
        what = "conserved" if invariants else "energy"
        return of.derived(what, make, len(conserved_names(problem)))
    return tuple(make())


def conserved_names(problem: Problem) -> tuple[str, ...]:
    own = ("energy",) if isinstance(problem, Hamiltonian) else ()
    return (*own, *names_of(problem.invariants))


def summands(problem: Problem, k: int) -> Vector:
    quantities = conserved(problem)

    def make() -> Exprs:
        import sympy

        return tuple(sympy.Add.make_args(quantities[k]))

    if isinstance(quantities, Deferred):
        return quantities.derived(f"summands of {k + 1}", make)
    return make()


def texts_of(problem: Problem) -> Any:
    """The terms as sympy writes them: one text each, or one for each component."""

    def write() -> list[Any]:
        if isinstance(problem, Hamiltonian):
            return [str(x) for x in problem.terms]
        return [[str(x) for x in term] for term in problem.terms]

    return ask(problem.terms, "texts", write)


def quantities_function(problem: Problem, digits: int) -> Callable[..., list[Any]]:
    """Returns the conserved quantities, any energy first; in balls beyond ``FLOAT_DIGITS``."""
    return function(conserved(problem), unknowns(problem), digits > FLOAT_DIGITS)


def merge_terms(problem: Problem, terms: int) -> Problem:
    """Returns the problem with the last terms summed."""
    if len(problem.terms) == terms:
        return problem
    last = terms - 1
    if isinstance(problem, Hamiltonian):
        return replace(problem, terms=(*problem.terms[:last], sum(problem.terms[last:])))
    totals = tuple(map(sum, zip(*problem.terms[last:], strict=True)))
    return replace(problem, terms=(*problem.terms[:last], totals))
