"""A method on a problem, ready to step: numbers, functions and the order in which to use them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from typing import Any, TypeAlias

from flint import arb, ctx

from garkcli.dynamics.hamiltonian import FLOAT_DIGITS, Group, Hamiltonian
from garkcli.dynamics.structure import Block, Stage, Value, coupling, fields_of
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

Real: TypeAlias = Any
"""A float, or an exact ball with the digits of the scheme."""


@dataclass(frozen=True)
class Scheme:
    """A method on a problem, ready to step.

    Attributes:
        problem: the split problem; d degrees of freedom.
        digits: of all numbers; up to ``FLOAT_DIGITS`` they are floats.
        blocks: explicit and implicit parts, in order.
        arguments: the stages each evaluation looks at.
        sums: each stage as coefficients of evaluations.
        weights: b of each evaluation.
        functions: by colour and group driven.
        jacobians: by colour, group driven and group looked at; of floats, to d² floats.
    """

    problem: Hamiltonian
    digits: int
    blocks: tuple[Block, ...]
    arguments: dict[Value, tuple[Stage, ...]]
    sums: dict[Stage, tuple[tuple[Value, Real], ...]]
    weights: dict[Value, Real]
    functions: dict[tuple[int, Group], Callable[..., list[Real]]]
    jacobians: dict[tuple[int, Group, Group], Callable[..., list[float]]]

    @property
    def bits(self) -> int:
        """The precision that balls are computed with."""
        return ceil(self.digits * 3.3219281) + 16

    def number(self, x: Any) -> Real:
        """A rational number or ball as the scheme computes with it."""
        return float(arb(x)) if self.digits <= FLOAT_DIGITS else arb(x).mid()


def scheme(tableau: Tableau, problem: Hamiltonian, digits: int = FLOAT_DIGITS) -> Scheme:
    """Prepare the steps of ``tableau`` on ``problem`` with ``digits`` digits.

    Raises:
        UsageProblem: the problem is not of the form that the structure is for.
    """
    fields = fields_of(tableau, problem)
    digits = max(digits, FLOAT_DIGITS)
    entries = numeric_entries(tableau, digits + 5)
    blocks = {
        (colour.rows, m): A
        for l, colour in enumerate(tableau.colours)
        for m, A in enumerate(entries.A[l])
        if A is not None
    }
    balls: Any = blocks  # enclosures, because they are numeric
    graph = coupling(tableau, fields, balls)
    bits = ceil(digits * 3.3219281) + 16
    with ctx.workprec(bits):

        def number(x: Any) -> Real:
            return float(x) if digits <= FLOAT_DIGITS else arb(x).mid()

        return Scheme(
            problem,
            digits,
            graph.blocks(),
            dict(graph.arguments),
            {
                s: tuple((v, number(blocks[s.space, v.colour][s.index][v.index])) for v in values)
                for s, values in graph.sums.items()
            },
            {v: number(entries.b[v.colour][v.index]) for v in graph.values},
            {key: f.function(digits) for key, f in fields.items()},
            {(*key, g): f.jacobian(g) for key, f in fields.items() for g in f.depends},
        )
