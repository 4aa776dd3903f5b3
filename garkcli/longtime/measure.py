"""The errors of conserved quantities along a trajectory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from math import ceil, inf, isfinite, nan
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from garkcli import numpy_on_use as np
from garkcli.errors import UsageProblem
from garkcli.exact.display import BITS_OF_A_DIGIT, to_float
from garkcli.problems import problem as problems
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.straightline import function

if TYPE_CHECKING:
    from garkcli.arrays import Floats


class Measure:
    """Evaluates conserved quantities, energy first, relative to the start, where UsageProblem is
    raised if one has no value. ``scale`` is the sum of sizes of the first one's summands; 1 if all
    are zero.
    """

    def __init__(self, problem: problems.Problem, digits: int) -> None:
        self.names = problems.conserved_names(problem)
        self.digits = digits
        self.has_energy = isinstance(problem, Hamiltonian)
        self._bits = 0 if digits <= FLOAT_DIGITS else ceil(BITS_OF_A_DIGIT * digits) + 48
        self._function: Callable[..., list[Any]] = self._precisely(
            lambda: problems.quantities_function(problem, digits)
        )
        number = arb if self._bits else to_float

        def initial_state() -> list[Any]:
            return [number(x) for x in problem.initial]

        start: list[Any] = self._precisely(initial_state)
        self._problem = problem
        arguments = problems.unknowns(problem)
        parts = [problems.summands(problem, k) for k in range(len(self.names))]
        self._summands = [function(own, arguments, False) for own in parts]
        terms_of = self._summands[0]
        if isinstance(problem, Hamiltonian):
            terms_of = function(problem.terms, arguments, False)
        try:
            self._first = self._precisely(lambda: self._function(*start))
            terms = terms_of(*map(to_float, problem.initial))
        except (ArithmeticError, ValueError):
            raise self._no_value(problem) from None
        if not all(isfinite(x) for x in self.sizes(start)):
            raise self._no_value(problem)
        self.initial = tuple(float(x) for x in self._first)
        self.scale = sum(map(abs, terms)) or 1.0

    def errors(self, states: Iterable[Sequence[Any]]) -> Floats:
        """I(y) − I(y_0), shape (states, invariants); nan without a value, inf beyond floats."""
        if not self._bits:
            first: Floats = np.array(self._first)
            return np.array([self._values_of(y) for y in states], dtype=np.float64) - first
        with ctx.workprec(self._bits):
            return np.array(
                [
                    [float(x - a) for x, a in zip(self._values_of(y), self._first, strict=True)]
                    for y in states
                ]
            )

    def sizes(self, y: Sequence[Any]) -> Floats:
        """The sums of the sizes of the summands of each invariant; nan without a value."""
        at = [float(x) for x in y]
        return np.array([sum(map(abs, _values_of(own, at))) for own in self._summands])

    @cached_property
    def _single_invariants(self) -> list[Callable[..., list[Any]]]:
        """Functions of single invariants, for states at which one of them has no value."""
        arguments = problems.unknowns(self._problem)
        return [
            function((x,), arguments, bool(self._bits)) for x in problems.conserved(self._problem)
        ]

    @staticmethod
    def _no_value(problem: problems.Problem) -> UsageProblem:
        return UsageProblem(
            f"the energy or an invariant of {problem.name} has no value at the start",
            "give other initial values",
            code="no-formula",
        )

    def _values_of(self, y: Sequence[Any]) -> list[Any]:
        try:
            return self._function(*y)
        except (ArithmeticError, ValueError):
            return [sum(_values_of(alone, y)) for alone in self._single_invariants]

    def _precisely(self, compute: Callable[[], Any]) -> Any:
        if not self._bits:
            return compute()
        with ctx.workprec(self._bits):
            return compute()


def _values_of(expressions: Callable[..., list[Any]], y: Sequence[Any]) -> list[Any]:
    """Expressions at the state y; a single nan or inf if one of them has no value."""
    try:
        return expressions(*y)
    except OverflowError:
        return [inf]
    except (ArithmeticError, ValueError):
        return [nan]
