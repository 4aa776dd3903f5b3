"""The step of a method on a problem as straight-line Python, for floats or for balls.

The writer follows the blocks of ``dependency`` in order. With w = h a and h b given, each stage
value is y_0 plus the sum of w times field values, eq. (spgqrk) without its zeros; Newton's method
finds the unknowns of an implicit block. All names in the text are our own.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from garkcli.frozen import Frozen, replace
from garkcli.problems.straightline import StraightLineCode
from garkcli.problems.vectorfield import StateLayout
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Stage, StageBlock
from garkcli.stepping.fields import Fields
from garkcli.stepping.jacobian import ChainRule, JacobianWriter
from garkcli.stepping.newton import NewtonWriter
from garkcli.stepping.stagewriter import Lines, StageWriter, names

_INSIDE = "   "  # of the function, its try and its loop


class Program(Frozen):
    """A step as text.

    Attributes:
        source: of ``run(state, w, first, count, record)``. A state has the numbers, time last,
            their compensations, and the errors of the starts of Newton's method in the last step
            with their changes; results are the new state, the iterations of each implicit block,
            and the number of Jacobians. ``record``, if any, gets the numbers without time after
            each step.
        coefficients: the stage and evaluation of the coefficient a in each w = h a; no stage for b.
        evaluations: field evaluations outside of Newton's method in one step.
    """

    source: str
    coefficients: tuple[tuple[Stage | None, FieldEvaluation], ...]
    codes: tuple[StraightLineCode, ...]
    size: int
    evaluations: int
    implicit: tuple[StageBlock, ...]
    chains: Mapping[int, ChainRule]

    @property
    def repeated(self) -> tuple[int, ...]:
        """Evaluations of vector fields in one iteration of each implicit block."""
        counts = [
            sum(isinstance(x, FieldEvaluation) for x in block.order) for block in self.implicit
        ]
        return tuple(counts)


def write(
    graph: DependencyGraph, fields: Fields, layout: StateLayout, is_for_balls: bool
) -> Program:
    return _ProgramWriter(graph, fields, layout, is_for_balls).program()


class _ProgramWriter:
    def __init__(
        self, graph: DependencyGraph, fields: Fields, layout: StateLayout, is_for_balls: bool
    ) -> None:
        self.body = Lines(_INSIDE)
        self.stages = StageWriter(graph, fields, layout, is_for_balls, self.body)
        self.jacobians = JacobianWriter(self.stages)
        self.newton = NewtonWriter(self.stages, self.jacobians)
        self.graph = graph
        self.layout = layout
        self.d = layout.dimension
        self.is_for_balls = is_for_balls
        self.blocks = graph.blocks()
        self.implicit = tuple(block for block in self.blocks if block.unknowns)
        self.unknowns = [stage for block in self.blocks for stage in block.unknowns]

    def program(self) -> Program:
        self._write_step()
        text = "\n".join(self._around(self.body.texts)) + "\n"
        # the numbers and what they lost; of each unknown what was missed, and how that changed
        size = 2 * self.layout.total + 2 * (self.d * len(self.unknowns))
        evaluations = len(self.graph.evaluations) + len(self.newton.frozen)
        made = Program(
            source=text,
            coefficients=tuple(self.stages.first),
            codes=tuple(self.stages.codes),
            size=size,
            evaluations=evaluations,
            implicit=self.implicit,
            chains=self.jacobians.chains,
        )
        return replace(made, evaluations=evaluations - sum(made.repeated))

    def _around(self, body: list[str]) -> list[str]:
        y = names("y", self.layout.total)
        lost = names("e", self.layout.total)
        components = []
        for stage, i in product(self.unknowns, range(self.d)):
            components.append(self.stages.component(stage, i))
        missed = [f"m{c}" for c in components]
        state = ", ".join((*y, *lost, *missed, *(f"n{c}" for c in components)))
        counts = names("n", len(self.implicit))
        numbers = ", ".join(counts)
        weights = list(self.stages.weights.values())

        lines = Lines()
        lines.write("def run(state, w, first, count, record):")
        with lines.nested():
            lines.write(f"{state}, = state")
            if weights:
                every = ", ".join(weights)
                lines.write(f"{every}, = w")
            if weights and self.is_for_balls:  # as floats for the Jacobians
                floats = ", ".join(f"v{x}" for x in weights)
                lines.write("v = list(map(float, w))")
                lines.write(f"{floats}, = v")
            lines.write(" = ".join((*counts, "jacobians", "0")))
            lines.write("number = first")
            lines.write("try:")
            with lines.nested():
                lines.write("for number in range(first, first + count):")
                lines.texts += body
            # outside the domain of a field, or a singular matrix
            lines.write("except (ArithmeticError, ValueError):")
            lines.write(" raise NotSolved(number, nan) from None")
            lines.write(f"return [{state}], [{numbers}], jacobians")
        return lines.texts

    def _write_step(self) -> None:
        write = self.body.write
        for block in self.blocks:
            if block.unknowns:
                self.newton.solve(block, self.implicit.index(block))
            else:
                self.stages.explicit(block)
        self._write_increments()
        for stage in self.unknowns:
            for i in range(self.d):
                c = self.stages.component(stage, i)
                missed = f"z{c} - g{c}"
                write(f"m{c}, n{c} = {missed}, {missed} - m{c}")
        for i in range(self.layout.total):
            self._add(i)
        y = names("y", self.layout.unknowns)
        total = " + ".join(y)
        state = ", ".join(y)
        if self.is_for_balls:
            write(f"if not ({total}).is_finite():")
        else:
            write(f"if not isfinite({total}):")
        write(" raise NotSolved(number, inf)")
        write("if record:")
        write(f" record([{state}])")

    def _write_increments(self) -> None:
        changes: list[str] = []
        for group in self.layout.groups:
            driving = [x for x in self.graph.evaluations if x.group == group]
            changes += self.stages.total(None, driving, group).texts
        for i, change in enumerate(changes):
            self.body.write(f"d{i} = {change or '0.0'}")

    def _add(self, i: int) -> None:
        """Writes one component of y_1, compensated in floats."""
        write = self.body.write
        if self.is_for_balls:
            write(f"y{i} = (y{i} + d{i}).mid()")
            return
        write(f"d{i} += e{i}")
        write(f"s = y{i} + d{i}")
        write(f"e{i} = y{i} - s + d{i}")
        write(f"y{i} = s")
