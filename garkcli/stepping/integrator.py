"""A method on a problem, ready to step: its coefficients in the numbers asked for, and its
program.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.straightline import define, enclosed
from garkcli.stepping.dependency import coupling, entry, fields_of
from garkcli.stepping.matching import matched
from garkcli.stepping.program import Program, write
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

Real: TypeAlias = Any
"""A float, or the midpoint of a ball with the digits of the scheme."""
Record: TypeAlias = Callable[[list[Real]], None]
"""Is given (q, p) after a step, shape (2d,)."""
Run: TypeAlias = Callable[
    [list[Real], list[Real], int, int, Record | None], tuple[list[Real], list[int], int]
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
class Scheme:
    """A method on a problem, ready to step.

    Attributes:
        problem: the split problem; d degrees of freedom.
        digits: of all numbers; up to ``FLOAT_DIGITS`` they are floats.
        program: what a step does.
        coefficients: enclosures of the coefficients that the program asks for, in its order.
        run: the program, made.
    """

    problem: Hamiltonian
    digits: int
    program: Program
    coefficients: tuple[arb, ...]
    run: Run

    @property
    def bits(self) -> int:
        """The precision that balls are computed with."""
        return _bits(self.digits)

    @property
    def is_for_balls(self) -> bool:
        """Whether numbers are balls."""
        return self.digits > FLOAT_DIGITS

    def number(self, x: Any) -> Real:
        """A rational number or ball as the scheme computes with it."""
        return arb(x).mid() if self.is_for_balls else float(arb(x))

    def weights(self, h: fmpq) -> list[Real]:
        """The products of h and the coefficients."""
        with _precision(self.digits):
            return [self.number(arb(h) * a) for a in self.coefficients]


def scheme(tableau: Tableau, problem: Hamiltonian, digits: int = FLOAT_DIGITS) -> Scheme:
    """Prepare the steps of ``tableau`` on ``problem`` with ``digits`` digits.

    Args:
        tableau: of any structure.
        problem: in as many terms as the tableau is for, or in one that has a natural split.
        digits: of all numbers; floats up to ``FLOAT_DIGITS``.

    Raises:
        UsageProblem: the problem is not of the form that the structure is for.

    >>> from garkcli import final, hamiltonian, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> made = scheme(rk4, hamiltonian("pendulum", 1))
    >>> [round(x, 6) for x in final(made, fmpq(1, 10), 10)]
    [1.056272, -0.391965]
    """
    tableau, problem = matched(tableau, problem)
    digits = max(digits, FLOAT_DIGITS)
    fields = fields_of(tableau, problem)
    program = write(coupling(tableau, fields), fields, problem.dimension, digits > FLOAT_DIGITS)
    entries = numeric_entries(tableau, digits + 5)
    with _precision(digits):
        coefficients = tuple(
            entry(tableau, entries, stage, value) for stage, value in program.coefficients
        )
        constants: dict[str, Any] = {
            **enclosed(program.formulas),
            "NotSolved": NotSolved,
            "nan": math.nan,
            "precision": arb(10) ** -digits if digits > FLOAT_DIGITS else 2.0**-52,
            "inverted": _inverted,
            **{f"chain{i}": chain.inverse for i, chain in program.chains.items()},
            "corrections": _corrections_of_balls if digits > FLOAT_DIGITS else _corrections,
        }
        return Scheme(
            problem, digits, program, coefficients, define(program.source, "run", constants)
        )


def _bits(digits: int) -> int:
    return ceil(digits * 3.3219281) + 16


def _precision(digits: int) -> Any:
    return ctx.workprec(_bits(digits))


def _inverted(entries: list[float], n: int) -> Floats:
    import numpy as np

    return np.asarray(np.linalg.inv(np.array(entries).reshape(n, n)), dtype=np.float64)


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
    return [(c * scale).mid() for c in (inverse @ [float(r / scale) for r in middles]).tolist()]
