"""Problems: built in, from files, or as objects, split into the terms that a method needs."""

from __future__ import annotations

import os
from typing import TypeAlias

from flint import fmpq

from garkcli.api.numbers import Number, Whole, rational_or_none, whole
from garkcli.errors import MethodError, UsageProblem
from garkcli.problems import builtin
from garkcli.problems.files.load import load_problem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator, parse_shares, terms_of
from garkcli.problems.problem import Problem
from garkcli.stepping.fields import split_into, with_joined_terms
from garkcli.tableau.tableau import Tableau

AnyProblem: TypeAlias = "Problem | Oscillator | str | os.PathLike[str]"
"""A problem; the name of a built-in one, or the path of a problem file."""
OSCILLATOR = "oscillator"


def problem(
    name: str, terms: Whole = 1, seed: Whole = 1, stiffness: Number | None = None
) -> Problem:
    """The built-in problem called ``name``, Hamiltonian or not, split into terms.

    Args:
        name: the name in ``gark list problems``.
        terms: the number of terms, one for each colour of a method.
        seed: the seed of random coefficients.
        stiffness: the stiffness of a stiff problem; 1 by default.

    Raises:
        UsageProblem: there is no such problem, it cannot be split so, or it has no stiffness.

    >>> problem("van-der-pol", 2, stiffness=1000).terms[0]
    (z, 0)
    """
    return builtin.problem(
        name,
        whole(terms, "terms", 1),
        whole(seed, "seed"),
        rational_or_none(stiffness, "stiffness"),
    )


def hamiltonian(name: str, terms: Whole = 1, seed: Whole = 1) -> Hamiltonian:
    """The built-in Hamiltonian problem called ``name``, split into terms.

    Args:
        name: the name in ``gark list problems``.
        terms: the number of terms, one for each colour of a method.
        seed: the seed of random coefficients.

    Raises:
        UsageProblem: there is no such problem, it cannot be split so, or it is not Hamiltonian.

    >>> hamiltonian("pendulum", 2).terms
    (px**2/2, 1 - cos(x))
    """
    return builtin.hamiltonian(name, whole(terms, "terms", 1), whole(seed, "seed"))


def demand_name(given: object) -> None:
    if not isinstance(given, (str, os.PathLike)):
        message = f"a problem is expected, not {type(given).__name__}"
        cure = "give the name of a built-in one, or what load_problem returns"
        raise MethodError(message, cure, code="arrays")


def problem_for(
    given: AnyProblem,
    tableau: Tableau,
    seed: int | None = None,
    stiffness: fmpq | None = None,
    omega: fmpq | None = None,
    split: str | None = None,
) -> Problem | Oscillator:
    """Returns the problem for an argument; a name has as many terms as the method has fields.

    ``split`` are the shares of the oscillator, ω is 1 by default. Raises UsageProblem for unknown
    problems or options, MethodFileError for faults.
    """
    if isinstance(given, (Problem, Oscillator)):
        return given
    demand_name(given)
    if os.fspath(given) == OSCILLATOR:
        terms = terms_of(tableau)
        frequency = fmpq(1) if omega is None else omega
        if split:
            return Oscillator(frequency, parse_shares(split, terms))
        return Oscillator.default(terms, frequency)
    return _to_step(given, tableau, seed, stiffness)


def _to_step(
    given: str | os.PathLike[str], tableau: Tableau, seed: int | None, stiffness: fmpq | None = None
) -> Problem:
    text = os.fspath(given)
    builtin.check_seed(text, seed)
    if builtin.is_path(text) or not isinstance(given, str):
        return split_for(load_problem(text, stiffness), tableau)
    terms = terms_of(with_joined_terms(tableau))
    return builtin.problem(text, terms, 1 if seed is None else seed, stiffness)


def split_for(problem: Problem, tableau: Tableau) -> Problem:
    """Returns the problem in as many terms as the method; UsageProblem without a split."""
    return split_into(problem, terms_of(with_joined_terms(tableau)))


def to_step(given: AnyProblem, tableau: Tableau, seed: int | None = None) -> Problem:
    """Returns the problem; UsageProblem for the oscillator, whose step maps are exact."""
    found = problem_for(given, tableau, seed)
    if isinstance(found, Problem):
        return found
    message = "the oscillator has exact step maps"
    raise UsageProblem(message, "take the problem split-oscillator", code="other-problem")


def hamiltonian_for(given: AnyProblem, tableau: Tableau, seed: int | None = None) -> Hamiltonian:
    """Returns the problem; raises UsageProblem unless it is Hamiltonian."""
    found = _to_step(OSCILLATOR, tableau, seed) if given == OSCILLATOR else None
    found = found or to_step(given, tableau, seed)
    if isinstance(found, Hamiltonian):
        return found
    message = f"{found.name} is not Hamiltonian"
    cure = "take one with energy, such as pendulum or kepler; gark converge takes all problems"
    raise UsageProblem(message, cure, code="other-problem")
