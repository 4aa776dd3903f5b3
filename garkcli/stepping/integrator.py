"""A method bound to a problem, ready to step: coefficients to the requested digits, and program."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from math import ceil, isfinite
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.doing import doing
from garkcli.errors import GarkError
from garkcli.exact.display import to_ball
from garkcli.frozen import Frozen, Mutable
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.problems.oscillator import terms_of
from garkcli.problems.problem import Problem
from garkcli.problems.straightline import define, enclosed
from garkcli.stepping.dependency import DependencyGraph, dependency_graph, entry
from garkcli.stepping.fields import Fields, fields_of, split_into, stepped_terms, with_clock
from garkcli.stepping.linearly_implicit import LinearlyImplicit, LinearProgram, program_of, steps_of
from garkcli.stepping.newton import MAX_ITERATIONS
from garkcli.stepping.program import Program, write
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.arrays import Floats
    from garkcli.stepping.along_flow import Stepped


FLOAT_PRECISION = 2.0**-52
Real: TypeAlias = Any
"""A float, or the midpoint of a ball with the digits of the integrator."""
Recorder: TypeAlias = Callable[[list[Real]], None]
"""Called with the unknowns after a step: (q, p), shape (2d,), or y, shape (d,)."""
StepProgram: TypeAlias = Callable[
    [list[Real], list[Real], int, int, Recorder | None], tuple[list[Real], list[int], int]
]


class NotSolved(Exception):
    def __init__(self, number: int, residual: float) -> None:
        super().__init__(number, residual)
        self.number, self.residual = number, residual


class Integrator(Frozen):
    """A method on a problem, ready to step.

    Attributes:
        problem: the split problem.
        digits: up to ``FLOAT_DIGITS`` all numbers are floats.
        program: the program of a step.
        coefficients: enclosures of the coefficients of the program, in its order.
        run: the compiled program.
        powers: of h in each coefficient; empty if all are 1.
    """

    problem: Problem
    digits: int
    program: Program | LinearProgram
    coefficients: tuple[arb, ...]
    run: StepProgram
    powers: tuple[int, ...] = ()

    @property
    def bits(self) -> int:
        return _bits(self.digits)

    @property
    def is_for_balls(self) -> bool:
        return self.digits > FLOAT_DIGITS

    def number(self, x: Any) -> Real:
        return arb(x).mid() if self.is_for_balls else float(arb(x))

    def weights(self, h: fmpq) -> list[Real]:
        with _precision(self.digits):
            powers = self.powers or (1,) * len(self.coefficients)
            pairs = zip(self.coefficients, powers, strict=True)
            return [self.number(arb(h) ** k * a) for a, k in pairs]

    def __repr__(self) -> str:
        return f"<Integrator {self.problem.name}: {self.digits} digits>"


class Binding(Frozen, eq=False):
    """A method on a problem, without a number of digits.

    Attributes:
        tableau: with the terms of the problem.
        problem: in as many terms as the tableau has.
        fields: the vector fields of the colours; methods with derivatives step with these as well.
    """

    tableau: Tableau
    problem: Problem
    fields: Fields

    @doing("program of a step")
    def at(self, digits: int = FLOAT_DIGITS) -> Integrator:
        """The integrator with ``digits`` digits; floats up to ``FLOAT_DIGITS``."""
        digits = max(digits, FLOAT_DIGITS)
        method = LinearlyImplicit.of(self.tableau)
        if method is not None:
            return self._linear(method, digits)
        is_for_balls = digits > FLOAT_DIGITS
        program = self._program_for_balls if is_for_balls else self._program_for_floats
        tableau = self.tableau
        powers: tuple[int, ...] = ()
        if self._along_flow is not None:
            tableau = self._along_flow.tableau
            orders = self._along_flow.powers
            powers = tuple(orders[value.colour] for _, value in program.coefficients)
        entries = numeric_entries(tableau, digits + 5)
        with _precision(digits):
            coefficients = tuple(
                entry(tableau, entries, stage, value) for stage, value in program.coefficients
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
        return Integrator(self.problem, digits, program, coefficients, run, powers)

    def _linear(self, method: LinearlyImplicit, digits: int) -> Integrator:
        program = program_of(method, self.problem.layout)
        with _precision(digits):
            run = steps_of(program, self.problem, digits > FLOAT_DIGITS, NotSolved)
            coefficients = tuple(to_ball(x, digits + 5) for x in method.coefficients)
        return Integrator(self.problem, digits, program, coefficients, run)

    @cached_property
    def graph(self) -> DependencyGraph:
        """The computations of a step."""
        along = self._along_flow
        if along is None:
            return dependency_graph(self.tableau, self.fields)
        return along.graph

    @cached_property
    def _along_flow(self) -> Stepped | None:
        """The additive method that takes the steps of a method with derivatives."""
        if not self.tableau.uses_derivatives:
            return None
        from garkcli.stepping.along_flow import along_flow  # few methods need it

        return along_flow(self.tableau, self.problem)

    @property
    def _evaluated(self) -> Fields:
        return self.fields if self._along_flow is None else self._along_flow.fields

    # one text serves any number of digits: its coefficients and constants have names
    @cached_property
    def _program_for_floats(self) -> Program:
        return write(self.graph, self._evaluated, self.problem.layout, is_for_balls=False)

    @cached_property
    def _program_for_balls(self) -> Program:
        return write(self.graph, self._evaluated, self.problem.layout, is_for_balls=True)

    def __repr__(self) -> str:
        return f"<Binding {self.problem.name}: {self.tableau!r}>"


@doing("method for the problem")
def bind(tableau: Tableau, problem: Problem) -> Binding:
    """Binds ``tableau`` to ``problem``, in as many terms or in one with a natural split. Raises
    UsageProblem if it does not suit the structure.

    >>> from garkcli import hamiltonian, integrate, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> made = bind(rk4, hamiltonian("pendulum", 1)).at()
    >>> [round(x, 6) for x in integrate(made, fmpq(1, 10), 10)]
    [1.056272, -0.391965]
    """
    if LinearlyImplicit.of(tableau) is None and not tableau.uses_derivatives:
        tableau.demand_fields("a step")
    made = stepped_terms(tableau, problem)
    split = split_into(problem, terms_of(made))
    made = with_clock(made, split)
    return Binding(made, split, fields_of(made, split))


def _bits(digits: int) -> int:
    return ceil(digits * 3.3219281) + 16


def _precision(digits: int) -> Any:
    return ctx.workprec(_bits(digits))


def _inverted(entries: list[float], n: int) -> Floats:
    return np.asarray(np.linalg.inv(np.array(entries).reshape(n, n)), dtype=np.float64)


def _corrections(inverse: Floats, residuals: list[float]) -> list[float]:
    with np.errstate(all="ignore"):  # an infinite number ends the step
        corrections: list[float] = (inverse @ residuals).tolist()
    return corrections


def _corrections_of_balls(inverse: Floats, residuals: list[arb]) -> list[arb]:
    """Corrections for balls of any size, scaled into the range of floats and back."""
    middles = [arb(r).mid() for r in residuals]
    scale = max(map(abs, middles))
    if scale == 0 or not scale.is_finite():
        return middles
    scaled = [float(r / scale) for r in middles]
    return [(c * scale).mid() for c in (inverse @ scaled).tolist()]


_AHEAD = 64  # most steps in floats by which a trajectory is ahead of who looks at it


class StepFailed(GarkError):
    """The stage equations of a step were not solved."""

    code = "step-fails"

    def __init__(self, number: int, h: fmpq, residual: float) -> None:
        what = "the stage equations were not solved"
        if not isfinite(residual):
            what = "the numbers leave the vector fields"
        super().__init__(
            f"step {number} of size {h}: {what} (residual {residual:.1e})",
            "choose a smaller step size, or an earlier final time: the solution may end there",
        )
        self.number = number
        self.h = h
        self.residual = residual


class RunWork(Frozen):
    """The cost of a run, Newton's method included; each Jacobian has a factorisation."""

    evaluations: int
    iterations: int
    jacobians: int


def trajectory(
    integrator: Integrator,
    h: fmpq,
    count: int,
    initial: Sequence[Any] | None = None,
    every: int = 1,
) -> Iterator[list[Real]]:
    """(q, p) at the start, after each ``every`` of ``count`` steps, and at the end, shape (2d,);
    StepFailed if the stage equations were not solved.
    """
    stepper = Stepper(integrator, h, initial)
    yield stepper.y
    if every > 1 or integrator.is_for_balls:
        while stepper.done < count:
            stepper.advance(min(every, count - stepper.done))
            yield stepper.y
        return
    while stepper.done < count:
        states: list[list[Real]] = []
        try:
            stepper.advance(min(_AHEAD, count - stepper.done), states.append)
        except StepFailed:
            yield from states
            raise
        yield from states


def integrate(
    integrator: Integrator, h: fmpq, count: int, initial: Sequence[Any] | None = None
) -> list[Real]:
    stepper = Stepper(integrator, h, initial)
    stepper.advance(count)
    return stepper.y


class Stepper(Mutable):
    """A trajectory that can be advanced from ``initial``, shape (2d,), or the problem's."""

    integrator: Integrator
    h: fmpq
    initial: Sequence[Any] | None = None
    done: int = 0

    def __post_init__(self) -> None:
        integrator = self.integrator
        start = integrator.problem.initial if self.initial is None else self.initial
        with ctx.workprec(integrator.bits):
            numbers = [integrator.number(x) for x in start]
            # time begins at 0; nothing has been lost or missed before the first step
            others = integrator.program.size - len(numbers)
            # as ``Program`` describes them
            self._numbers: list[Real] = numbers + [integrator.number(0)] * others
        self._weights = integrator.weights(self.h)
        self._jacobians = 0
        self._iterations = [0] * len(integrator.program.repeated)

    @property
    def y(self) -> list[Real]:
        return self._numbers[: self.integrator.problem.layout.unknowns]

    @property
    def work(self) -> RunWork:
        program = self.integrator.program
        repeated = sum(n * k for n, k in zip(self._iterations, program.repeated, strict=True))
        return RunWork(
            self.done * program.evaluations + repeated, sum(self._iterations), self._jacobians
        )

    def advance(self, count: int, record: Recorder | None = None) -> None:
        """Takes ``count`` steps, or raises StepFailed; ``record`` is called after each."""
        try:
            made = self._run(count, record)
        except NotSolved as failure:
            raise StepFailed(failure.number, self.h, failure.residual) from None
        self._numbers, iterations, jacobians = made
        pairs = zip(self._iterations, iterations, strict=True)
        self._iterations = [before + more for before, more in pairs]
        self._jacobians += jacobians
        self.done += count

    def _run(self, count: int, record: Recorder | None) -> tuple[list[Real], list[int], int]:
        integrator = self.integrator
        first = self.done + 1
        if not integrator.is_for_balls:
            return integrator.run(self._numbers, self._weights, first, count, record)
        with ctx.workprec(integrator.bits):
            return integrator.run(self._numbers, self._weights, first, count, record)
