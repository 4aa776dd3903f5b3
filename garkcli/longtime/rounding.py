"""Bounds on the effect of rounding of floats and coefficients; see docs/energy.md."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from math import ceil, isinf, log10
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.display import to_float
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import TIME, symbols
from garkcli.tableau.pointwise import entries
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.arrays import Floats


_UNIT = 2.0**-53  # of floats
_HIGHER = 2.0  # for the terms of higher order in h and in the tolerance


def unit_round_off(digits: int) -> float:
    return _UNIT if digits <= FLOAT_DIGITS else 10.0**-digits


def power_of_ten(x: float) -> float:
    """The least power of ten from ``x`` on, the same on every machine; 0 and infinity stay."""
    if x <= 0 or isinf(x):
        return max(x, 0.0)
    return float(f"1e{ceil(log10(x))}")


class Exchange:
    """The energy exchanged by the two halves of the equations of motion, summed over all steps.

    Attributes:
        first: Σ Δq·Δp, with its sign: h² Σ q̇·ṗ to leading order.
        second: Σ |Δq·Δ²p| + |Δp·Δ²q|: h³ Σ |q̇·p̈| + |ṗ·q̈| to leading order.
    """

    def __init__(self) -> None:
        self.steps = 0
        self.first = 0.0
        self.second = 0.0

    def add(self, states: Floats) -> None:
        """Adds consecutive states, shape (m, 2d); pieces overlap in two states."""
        if len(states) < 3:
            return
        d = states.shape[1] // 2
        moves = np.diff(states, axis=0)[:-1]
        bends = np.diff(states, 2, axis=0)
        q, p = moves[:, :d], moves[:, d:]
        q_bends, p_bends = bends[:, :d], bends[:, d:]
        products = q * p
        self.steps += len(moves)
        self.first += float(products.sum())
        for crossed in (q * p_bends, p * q_bends):
            self.second += float(np.abs(crossed.sum(axis=1)).sum())

    def powers(self, h: float) -> tuple[float, float]:
        """Per unit of time |mean of q̇·p̈|, and the mean of |q̇·p̈| + |ṗ·q̈|."""
        count = max(self.steps, 1)
        first = abs(self.first) / (count * h**2)
        return first, self.second / (count * h**3)


def energy_rate(
    tableau: Tableau, tolerance: fmpq | None, h: float, powers: tuple[float, float]
) -> float:
    """Returns the energy per unit of time that rounded coefficients can cause, to leading order."""
    if tolerance is None:
        return 0.0
    weights, sums = sensitivity(tableau)
    first, second = powers
    return _HIGHER * to_float(tolerance) * (weights * first + sums * h * second)


def invariant_rate(
    tableau: Tableau,
    tolerance: fmpq | None,
    problem: RightHandSide,
    states: Iterable[tuple[float, Sequence[Any]]],
) -> float:
    """The change of the first invariant I per unit of time that rounded coefficients can cause: a
    stage with too much weight moves I by h ∂I/∂y·f^{l}, which cancels only in the sum. ``states``
    are pairs of time and y; those at which I has no slope are ignored.
    """
    if tolerance is None:
        return 0.0
    y = symbols(problem.variables, "y")
    _, first = problem.invariants[0]
    gradient = [first.diff(x) for x in y]
    moved = []
    for term in problem.terms:
        products = [g * f for g, f in zip(gradient, term, strict=True)]
        moved.append(sum(products))
    rates = function(tuple(moved), (*y, *symbols(problem.variables, TIME)), False)
    largest = 0.0
    for time, y_then in states:
        with suppress(ArithmeticError, ValueError):
            largest = max(largest, sum(map(abs, rates(*map(float, y_then), time))))
    stages = max(len(row) for row in entries(tableau).b)
    return _HIGHER * to_float(tolerance) * stages * largest


def sensitivity(tableau: Tableau) -> tuple[float, float]:
    """The changes of the conditions of orders 1 and 2 when coefficients change by one unit: the
    number of stages if positions and momenta have weights of their own, whose sums can differ, else
    0; and Σ_l Σ_i |c^l_i| + s |b^l_i|.
    """
    printed = entries(tableau)
    stages = max(len(row) for row in printed.b)
    is_split = any(colour.part != "y" for colour in tableau.colours)
    of_order_1 = 2.0 * stages if is_split else 0.0
    return of_order_1, _sum_of_sizes(printed.c) + stages * _sum_of_sizes(printed.b)


def _sum_of_sizes(rows: Iterable[Iterable[Any]]) -> float:
    every = (x for row in rows for x in row)
    return sum(abs(float(x) if isinstance(x, arb) else to_float(x)) for x in every)
