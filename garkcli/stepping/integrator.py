"""A method on a problem, ready to step: its coefficients in the numbers asked for, and its
program.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import ceil
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.doing import doing
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.problems.oscillator import terms_of
from garkcli.problems.problem import Problem
from garkcli.problems.straightline import define, enclosed
from garkcli.stepping.dependency import DependencyGraph, dependency_graph, entry
from garkcli.stepping.fields import Fields, fields_of, stepped_terms, with_clock
from garkcli.stepping.matching import split_into
from garkcli.stepping.newton import MAX_ITERATIONS
from garkcli.stepping.program import Program, write
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.arrays import Floats


FLOAT_PRECISION = 2.0**-52
"""The distance from 1 to the next float."""
Real: TypeAlias = Any
"""A float, or the midpoint of a ball with the digits of the integrator."""
Recorder: TypeAlias = Callable[[list[Real]], None]
"""Is given the unknowns after a step: (q, p), shape (2d,), or y, shape (d,)."""
StepProgram: TypeAlias = Callable[
    [list[Real], list[Real], int, int, Recorder | None], tuple[list[Real], list[int], int]
]
"""See ``Program.source``."""


class NotSolved(Exception):
    """The step of this number has not been solved: the last correction of Newton's method, or no
    number.
    """

    def __init__(self, number: int, residual: float) -> None:
        super().__init__(number, residual)
        self.number, self.residual = number, residual


@dataclass(frozen=True)
class Integrator:
    """A method on a problem, ready to step.

    Attributes:
        problem: the split problem.
        digits: of all numbers; up to ``FLOAT_DIGITS`` they are floats.
        program: what a step does.
        coefficients: enclosures of the coefficients that the program asks for, in its order.
        run: the program, made.
    """

    problem: Problem
    digits: int
    program: Program
    coefficients: tuple[arb, ...]
    run: StepProgram

    @property
    def bits(self) -> int:
        """The precision that balls are computed with."""
        return _bits(self.digits)

    @property
    def is_for_balls(self) -> bool:
        """Whether numbers are balls."""
        return self.digits > FLOAT_DIGITS

    def number(self, x: Any) -> Real:
        """A rational number or ball as the integrator computes with it."""
        return arb(x).mid() if self.is_for_balls else float(arb(x))

    def weights(self, h: fmpq) -> list[Real]:
        """The products of h and the coefficients."""
        with _precision(self.digits):
            return [self.number(arb(h) * a) for a in self.coefficients]

    def __repr__(self) -> str:
        return f"<Integrator {self.problem.name}: {self.digits} digits>"


@dataclass(frozen=True, eq=False)
class Binding:
    """A method on a problem, before it is said with how many digits it steps.

    Attributes:
        tableau: with the terms that the problem has.
        problem: in as many terms as the tableau is for.
        fields: the vector fields of the colours.
    """

    tableau: Tableau
    problem: Problem
    fields: Fields

    @doing("program of a step")
    def at(self, digits: int = FLOAT_DIGITS) -> Integrator:
        """The steps with numbers of ``digits`` digits; floats up to ``FLOAT_DIGITS``."""
        digits = max(digits, FLOAT_DIGITS)
        is_for_balls = digits > FLOAT_DIGITS
        program = self._program_for_balls if is_for_balls else self._program_for_floats
        entries = numeric_entries(self.tableau, digits + 5)
        with _precision(digits):
            coefficients = tuple(
                entry(self.tableau, entries, stage, value) for stage, value in program.coefficients
            )
            names: dict[str, Any] = {
                **enclosed(program.codes),
                "NotSolved": NotSolved,
                "nan": math.nan,
                "precision": arb(10) ** -digits if is_for_balls else FLOAT_PRECISION,
                "iterations": MAX_ITERATIONS + (digits if is_for_balls else 0),
                "inverted": _inverted,
                **{f"chain{i}": chain.inverse for i, chain in program.chains.items()},
                "corrections": _corrections_of_balls if is_for_balls else _corrections,
            }
            run = define(program.source, "run", names)
        return Integrator(self.problem, digits, program, coefficients, run)

    @cached_property
    def graph(self) -> DependencyGraph:
        """What has to be computed in a step."""
        return dependency_graph(self.tableau, self.fields)

    # one text serves any number of digits: its coefficients and constants have names
    @cached_property
    def _program_for_floats(self) -> Program:
        return write(self.graph, self.fields, self.problem.layout, is_for_balls=False)

    @cached_property
    def _program_for_balls(self) -> Program:
        return write(self.graph, self.fields, self.problem.layout, is_for_balls=True)

    def __repr__(self) -> str:
        return f"<Binding {self.problem.name}: {self.tableau!r}>"


@doing("method for the problem")
def bind(tableau: Tableau, problem: Problem) -> Binding:
    """Make ``tableau`` and ``problem`` for each other, to step with any number of digits.

    Args:
        tableau: of any structure.
        problem: in as many terms as the tableau is for, or in one that has a natural split.

    Raises:
        UsageProblem: the problem is not of the form that the structure is for.

    >>> from garkcli import hamiltonian, integrate, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> made = bind(rk4, hamiltonian("pendulum", 1)).at()
    >>> [round(x, 6) for x in integrate(made, fmpq(1, 10), 10)]
    [1.056272, -0.391965]
    """
    made = stepped_terms(tableau, problem)
    split = split_into(problem, terms_of(made))
    made = with_clock(made, split)
    return Binding(made, split, fields_of(made, split))


def _bits(digits: int) -> int:
    return ceil(digits * 3.3219281) + 16


def _precision(digits: int) -> Any:
    return ctx.workprec(_bits(digits))


def _inverted(entries: list[float], n: int) -> Floats:
    import numpy as np

    matrix = np.array(entries).reshape(n, n)
    return np.asarray(np.linalg.inv(matrix), dtype=np.float64)


def _corrections(inverse: Floats, residuals: list[float]) -> list[float]:
    import numpy as np

    with np.errstate(all="ignore"):  # what is not finite ends the step
        corrections: list[float] = (inverse @ residuals).tolist()
    return corrections


def _corrections_of_balls(inverse: Floats, residuals: list[arb]) -> list[arb]:
    """The same for balls of any size: they are scaled into the range of floats, and back."""
    middles = [arb(r).mid() for r in residuals]
    scale = max(map(abs, middles))
    if scale == 0 or not scale.is_finite():
        return middles
    scaled = [float(r / scale) for r in middles]
    corrections = (inverse @ scaled).tolist()
    return [(c * scale).mid() for c in corrections]
