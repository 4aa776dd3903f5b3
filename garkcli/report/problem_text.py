"""A problem and its split in one line."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem
from garkcli.problems.righthandside import RightHandSide
from garkcli.tableau.garkmethod import GarkMethod

_LONGEST = 80
"""Characters of the terms that are still shown; longer ones are counted."""


def describe(problem: Oscillator | Problem) -> str:
    """A problem and its split in one line."""
    if isinstance(problem, Hamiltonian):
        return _described(problem)
    if isinstance(problem, RightHandSide):
        return _described_fields(problem)
    energies = [_energy(k, v) for k, v in problem.shares]
    return f"q̈ = −ω²q, ω = {problem.omega}; {_numbered(energies)}"


def driving(problem: Oscillator | Problem, method: GarkMethod | None) -> list[str]:
    """What the colours of a method do with the terms of a Hamiltonian, where its file does not say
    it by a partition: no line, or one.
    """
    if method is None or isinstance(problem, RightHandSide):
        return []
    if method.tableau.is_partitioned or method.tableau.size == 1:
        return []
    return ["colour l steps the whole vector field of H{l}"]


def _numbered(energies: Sequence[str]) -> str:
    """The terms of a Hamiltonian by the numbers of their colours."""
    numbered = enumerate(energies, start=1)
    terms = [f"H{{{l}}}: {text}" for l, text in numbered]
    return ", ".join(terms)


def _energy(k: object, v: object) -> str:
    terms = []
    for share, energy in ((k, "½p²"), (v, "½ω²q²")):
        if share == 1:
            terms.append(energy)
        elif share != 0:
            terms.append(f"{share}·{energy}")
    return " + ".join(terms) or "0"


def _described(problem: Hamiltonian) -> str:
    texts = [_formula(term) for term in problem.terms]
    if not _is_short(texts):
        count = len(texts)
        terms = f"{count} terms" if count > 1 else "one term"
        positions = ", ".join(problem.variables)
        return f"{problem.name}, H in {terms} of {positions} and their momenta"
    return f"{problem.name}; {_numbered(texts)}"


def _described_fields(problem: RightHandSide) -> str:
    name = problem.name
    if problem.stiffness is not None:
        name += f", stiffness {problem.stiffness}"
    fields = []
    for l, term in enumerate(problem.terms, start=1):
        components = [_formula(x) for x in term]
        side = ", ".join(components)
        if len(components) > 1:
            side = f"({side})"
        fields.append(f"f{{{l}}}: {side}")
    if _is_short(fields):
        shown = ", ".join(fields)
        return f"{name}; {shown}"
    sides = "one right-hand side"
    if len(fields) > 1:
        sides = f"{len(fields)} right-hand sides"
    variables = ", ".join(problem.variables)
    return f"{name}, {sides} of {variables}"


def _formula(expression: object) -> str:
    """An expression of sympy with powers as people write them."""
    return str(expression).replace("**", "^")


def _is_short(texts: Sequence[str]) -> bool:
    return sum(map(len, texts)) <= _LONGEST
