"""The errors of the conserved quantities along a trajectory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import islice
from math import ceil, inf
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.problems.hamiltonian import (
    FLOAT_DIGITS,
    GROUPS,
    Hamiltonian,
    energy_function,
    symbols,
)
from garkcli.problems.straightline import function

if TYPE_CHECKING:
    from garkcli.arrays import Floats


class Measure:
    """The energy and the other invariants of states, against those of the start.

    Args:
        problem: with at least one invariant, its energy.
        digits: that the states have.

    Attributes:
        names: "energy", then those of the problem.
        initial: the values at the start.
        scale: the sum of the sizes of the terms of H at the start; 1 where all are zero.
        digits: that the states have.

    Errors:
        UsageProblem: one of them has no value at the start.
    """

    def __init__(self, problem: Hamiltonian, digits: int) -> None:
        self.names = ("energy", *(name for name, _ in problem.invariants))
        self.digits = digits
        self._bits = 0 if digits <= FLOAT_DIGITS else ceil(3.33 * digits) + 48
        self._function: Callable[..., list[Any]] = self._precisely(
            lambda: energy_function(problem, digits)
        )
        number = arb if self._bits else to_float
        start: list[Any] = self._precisely(lambda: [number(x) for x in problem.initial])
        measured = [problem.energy]
        measured += [x for _, x in problem.invariants]
        summands: list[Any] = []
        self._lengths = []
        for expression in measured:
            own = _summands(expression)
            summands += own
            self._lengths.append(len(own))
        q, p = (symbols(problem.variables, group) for group in GROUPS)
        arguments = (*q, *p)
        self._summands = function(tuple(summands), arguments, False)
        terms_of = function(tuple(problem.terms), arguments, False)
        try:
            self._first = self._precisely(lambda: self._function(*start))
            initial = map(to_float, problem.initial)
            terms = terms_of(*initial)
            self.sizes([float(x) for x in start])
        except (ArithmeticError, ValueError):
            raise UsageProblem(
                f"the energy or an invariant of {problem.name} has no value at the start",
                "give other initial values",
            ) from None
        self.initial = tuple(float(x) for x in self._first)
        self.scale = sum(map(abs, terms)) or 1.0

    def errors(self, states: Iterable[Sequence[Any]]) -> Floats:
        """I(y) − I(y_0) of each state y, shape (states, invariants); infinite where y is outside
        the domain.
        """
        import numpy as np

        if not self._bits:
            first: Floats = np.array(self._first)
            values = [self._values_of(y) for y in states]
            return np.array(values, dtype=np.float64) - first
        with ctx.workprec(self._bits):
            rows = []
            for y in states:
                differences = self._differences(y)
                rows.append([float(x) for x in differences])
            return np.array(rows)

    def sizes(self, y: Sequence[Any]) -> Floats:
        """The sums of the sizes of the summands of each invariant at the state y, in floats.

        Raises:
            ArithmeticError, ValueError: y is outside of the domain.
        """
        import numpy as np

        arguments = map(float, y)
        values = iter(self._summands(*arguments))
        sizes = []
        for length in self._lengths:
            own = islice(values, length)
            sizes.append(sum(abs(x) for x in own))
        return np.array(sizes)

    def _differences(self, y: Sequence[Any]) -> list[Any]:
        pairs = zip(self._values_of(y), self._first, strict=True)
        return [x - first for x, first in pairs]

    def _values_of(self, y: Sequence[Any]) -> list[Any]:
        try:
            return self._function(*y)
        except (ArithmeticError, ValueError):
            return [inf] * len(self.names)

    def _precisely(self, compute: Callable[[], Any]) -> Any:
        if not self._bits:
            return compute()
        with ctx.workprec(self._bits):
            return compute()


def _summands(expression: Any) -> tuple[Any, ...]:
    """What a sympy expression is the sum of."""
    import sympy

    return tuple(sympy.Add.make_args(expression))
