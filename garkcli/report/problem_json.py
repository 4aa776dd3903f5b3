"""Which problem was stepped, in JSON reports."""

from __future__ import annotations

from typing import Any

from garkcli.page.record import Field
from garkcli.page.schema import EXACT, TEXT, Schema, array, nullable
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.righthandside import RightHandSide
from garkcli.report.problem import Stepped, name_of


def _split(problem: Oscillator) -> list[list[str]]:
    pairs = []
    for kinetic, potential in problem.shares:
        pairs.append([str(kinetic), str(potential)])
    return pairs


def _hamiltonians(problem: Hamiltonian) -> list[str]:
    return [str(term) for term in problem.terms]


def _sides(problem: RightHandSide) -> list[list[str]]:
    sides = []
    for term in problem.terms:
        components = [str(x) for x in term]
        sides.append(components)
    return sides


def _stiffness(problem: RightHandSide) -> str | None:
    if problem.stiffness is None:
        return None
    return str(problem.stiffness)


_LISTS: Schema = array(array(EXACT))
_LISTS_OF_TEXT: Schema = array(array(TEXT))
NAME: Field[Stepped] = Field("problem", TEXT, name_of)
_OSCILLATOR: tuple[Field[Oscillator], ...] = (
    Field("omega", EXACT, lambda x: str(x.omega)),
    Field("split", _LISTS, _split),
)
_HAMILTONIAN: tuple[Field[Hamiltonian], ...] = (Field("hamiltonian", array(TEXT), _hamiltonians),)
_RIGHT_HAND_SIDE: tuple[Field[RightHandSide], ...] = (
    Field("right_hand_sides", _LISTS_OF_TEXT, _sides),
    Field("stiffness", nullable(EXACT), _stiffness),
)
TERMS: dict[type[Stepped], tuple[Field[Any], ...]] = {
    Oscillator: _OSCILLATOR,
    Hamiltonian: _HAMILTONIAN,
    RightHandSide: _RIGHT_HAND_SIDE,
}
"""By the kind of the problem: ω and the shares (k_l, v_l) of each term, the terms H^{l} as text, or
the components of each term f^{l}.
"""
