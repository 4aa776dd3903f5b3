"""Steps of a symplectic pair, eq. (spgqrk), or of a GARK method, on a split Hamiltonian problem.

With Z the increments of the stages over the start of the step, and the colours m of the tableau,

    Z^k_i = h Σ_m Σ_j a^{k,m}_{ij} f^m(y_0 + Z^{rows(m)}_j),
    y_1 = y_0 + h Σ_m Σ_j b^m_j f^m(y_0 + Z^{rows(m)}_j),

where f^m drives positions (V), momenta (F) or both. Explicit parts are computed in order, see
``garkcli.dynamics.structure``; the unknowns of each implicit block by Newton's method with exact Jacobians. The
numbers are floats with compensated summation from step to step, or midpoints of balls with any number of
digits; corrections and Jacobians are floats in both cases, so that each iteration near the solution is worth
the digits of a float.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import ctx, fmpq

from garkcli.dynamics.hamiltonian import FLOAT_DIGITS
from garkcli.dynamics.scheme import Real, Scheme
from garkcli.dynamics.structure import Block, Stage, Value
from garkcli.errors import GarkError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

MAX_ITERATIONS = 50
"""Newton iterations before a step is given up."""
_NEAR = 1e-10  # relative correction below which a Jacobian is good to the digits of a float
_SLOW = 0.1  # contraction above which floats want a new Jacobian


class _NotSolved(Exception):
    """Newton's method has ended with the residual that is the argument."""


class StepFailed(GarkError):
    """The stage equations of a step were not solved."""

    def __init__(self, number: int, h: fmpq, residual: float) -> None:
        what = (
            "the stage equations were not solved" if isfinite(residual) else "the numbers leave the vector fields"
        )
        super().__init__(
            f"step {number} of size {h}: {what} (residual {residual:.1e})", "choose a smaller step size"
        )
        self.number = number
        self.h = h
        self.residual = residual


def trajectory(scheme: Scheme, h: fmpq, count: int, initial: Sequence[Any] | None = None) -> Iterator[list[Real]]:
    """(q, p) after 0, 1, …, ``count`` steps of size ``h``, shape (2d,), from ``initial`` or the problem's values.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    with ctx.workprec(scheme.bits):
        start = [scheme.number(x) for x in (scheme.problem.initial if initial is None else initial)]
    yield list(start)
    state = _State(scheme, h, start)
    for number in range(1, count + 1):
        with ctx.workprec(scheme.bits):
            state.advance(number)
        yield list(state.y)


def final(scheme: Scheme, h: fmpq, count: int, initial: Sequence[Any] | None = None) -> list[Real]:
    """(q, p) after ``count`` steps; see ``trajectory``."""
    *_, last = trajectory(scheme, h, count, initial)
    return last


@dataclass
class _State:
    """Where a trajectory is, and what the last step has left for the next one.

    Attributes:
        y: (q, p), shape (2d,).
        lost: what the floats y have lost in their last digits so far.
        stages: Z of the current step, as lists of d numbers.
        values: f of the current step.
        missed: what the start of Newton's method missed in the last step.
    """

    scheme: Scheme
    step: fmpq
    y: list[Real]
    h: Real = 0.0
    lost: list[float] = field(default_factory=list)
    stages: dict[Stage, list[Real]] = field(default_factory=dict)
    values: dict[Value, list[Real]] = field(default_factory=dict)
    missed: dict[Stage, list[Real]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        with ctx.workprec(self.scheme.bits):
            self.h = self.scheme.number(self.step)
        self.lost = [0.0] * len(self.y)

    def advance(self, number: int) -> None:
        """One step, the ``number``-th."""
        d, scheme = self.scheme.problem.dimension, self.scheme
        try:
            start = self._predicted()
            for block in scheme.blocks:
                if block.unknowns:
                    self._solve(block, start)
                else:
                    self._run(block)
        except (ArithmeticError, ValueError):  # outside the domain of a field, or a singular Jacobian
            raise StepFailed(number, self.step, float("nan")) from None
        except _NotSolved as failure:
            raise StepFailed(number, self.step, failure.args[0]) from None
        increment = [0.0 * self.h] * (2 * d)
        for value, b in scheme.weights.items():
            offset = d if value.group == "p" else 0
            for i, f in enumerate(self.values[value]):
                increment[offset + i] += b * f
        for stage, guess in start.items():
            self.missed[stage] = [z - g for z, g in zip(self.stages[stage], guess, strict=True)]
        self._add([self.h * x for x in increment])
        if not all(isfinite(float(x)) for x in self.y):
            raise StepFailed(number, self.step, float("inf"))

    def _add(self, increment: Sequence[Real]) -> None:
        if self.scheme.digits > FLOAT_DIGITS:
            self.y = [(y + x).mid() for y, x in zip(self.y, increment, strict=True)]
            return
        for i, x in enumerate(increment):
            term = x + self.lost[i]
            total = self.y[i] + term
            self.lost[i] = (self.y[i] - total) + term
            self.y[i] = total

    def _predicted(self) -> dict[Stage, list[Real]]:
        """A start for the unknowns: fields frozen at y_0, and what that missed in the last step."""
        d, scheme = self.scheme.problem.dimension, self.scheme
        unknowns = [stage for block in scheme.blocks for stage in block.unknowns]
        groups = {"q": self.y[:d], "p": self.y[d:]}
        needed = {v for stage in unknowns for v, _ in scheme.sums[stage]}
        frozen = {
            (v.colour, v.group): scheme.functions[v.colour, v.group](
                *(y for s in scheme.arguments[v] for y in groups[s.group])
            )
            for v in {(v.colour, v.group): v for v in needed}.values()
        }
        zero = [0.0] * d
        return {
            stage: [
                self.h * sum(a * frozen[v.colour, v.group][i] for v, a in scheme.sums[stage])
                + self.missed.get(stage, zero)[i]
                for i in range(d)
            ]
            for stage in unknowns
        }

    def _run(self, block: Block) -> None:
        """Compute what is explicit in ``block``."""
        for vertex in block.order:
            if isinstance(vertex, Value):
                function = self.scheme.functions[vertex.colour, vertex.group]
                self.values[vertex] = function(*self._arguments(vertex))
            else:
                self.stages[vertex] = self._combined(vertex)

    def _arguments(self, value: Value) -> list[Real]:
        d = self.scheme.problem.dimension
        return [
            y + z
            for stage in self.scheme.arguments[value]
            for y, z in zip(self.y[d:] if stage.group == "p" else self.y[:d], self.stages[stage], strict=True)
        ]

    def _combined(self, stage: Stage) -> list[Real]:
        """The sum h Σ a f of one stage."""
        terms = [(a, self.values[value]) for value, a in self.scheme.sums[stage]]
        return [self.h * sum(a * f[i] for a, f in terms) for i in range(self.scheme.problem.dimension)]

    def _solve(self, block: Block, start: dict[Stage, list[Real]]) -> None:
        """Newton's method for the unknowns of ``block``; the Jacobian is kept as long as it serves."""
        import numpy as np

        d, balls = self.scheme.problem.dimension, self.scheme.digits > FLOAT_DIGITS
        precision = 10.0**-self.scheme.digits if balls else 2.0**-52
        near = _NEAR if balls else 1e-2
        x = [z for stage in block.unknowns for z in start[stage]]
        inverse: Floats | None = None
        before = float("inf")
        floor = max(abs(float(y)) for y in self.y)
        for _ in range(MAX_ITERATIONS):
            self.stages.update({stage: x[i * d : (i + 1) * d] for i, stage in enumerate(block.unknowns)})
            self._run(block)
            image = [z for stage in block.unknowns for z in self._combined(stage)]
            residual = np.array([float(a - b) for a, b in zip(x, image, strict=True)])
            scale = max(abs(float(z)) for z in x)
            if inverse is None or before > near * scale:
                inverse = np.asarray(np.linalg.inv(np.eye(len(x)) - self._jacobian(block)), dtype=np.float64)
            correction = inverse @ residual
            size = float(np.abs(correction).max())
            if size <= precision * scale or (0.5 * before <= size <= 1e4 * precision * max(scale, floor)):
                return
            if not isfinite(size):
                break
            if size > _SLOW * before:
                inverse = None
            before = size
            x = [a - c for a, c in zip(x, correction.tolist(), strict=True)]
            if balls:
                x = [a.mid() for a in x]
        raise _NotSolved(float(np.abs(residual).max()))

    def _jacobian(self, block: Block) -> Floats:
        """The derivative of the image of the unknowns, by the chain rule along the explicit part, (n, n)."""
        import numpy as np

        d, n = self.scheme.problem.dimension, self.scheme.problem.dimension * len(block.unknowns)
        h = float(self.h)
        slopes: dict[Stage | Value, Floats] = {}
        for i, stage in enumerate(block.unknowns):
            slopes[stage] = np.eye(d, n, i * d)

        def combined(stage: Stage) -> Floats:
            total = np.zeros((d, n))
            for value, a in self.scheme.sums[stage]:
                if value in slopes:
                    total += h * float(a) * slopes[value]
            return total

        for vertex in block.order:
            if isinstance(vertex, Stage):
                slopes[vertex] = combined(vertex)
                continue
            at = [float(x) for x in self._arguments(vertex)]
            slope = np.zeros((d, n))
            for stage in self.scheme.arguments[vertex]:
                if stage in slopes:
                    J = self.scheme.jacobians[vertex.colour, vertex.group, stage.group](*at)
                    slope += np.array(J).reshape(d, d) @ slopes[stage]
            slopes[vertex] = slope
        return np.vstack([combined(stage) for stage in block.unknowns])
