"""The step of a method on a problem as a program: straight-line Python, one for floats and one for
balls.

The writer follows the blocks of ``garkcli.stepping.dependency`` in order. With the numbers w = h a
and h b given, each stage value is y_0 plus the sum of w times field values, eq. (spgqrk) written
out without its zeros: see ``garkcli.stepping.stagewriter``. The unknowns of an implicit block are
found by Newton's method, see ``garkcli.stepping.newton``. The text has names of ours only: see
``garkcli.problems.straightline``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from garkcli.problems.hamiltonian import GROUPS
from garkcli.problems.straightline import Formula
from garkcli.stepping.chainrule import ChainRule
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Fields, Stage, StageBlock
from garkcli.stepping.newton import NewtonWriter
from garkcli.stepping.stagewriter import names


@dataclass(frozen=True)
class Program:
    """A step as text.

    Attributes:
        source: of ``run(state, w, first, count, record)``. A state is the list of (q, p), what they
            have lost in their last digits, and what the starts of Newton's method missed in the
            last step and how that changed; the result is the new state, the number of iterations of
            each implicit block, and the number of Jacobians. ``record``, unless it is None, is
            called with (q, p) after each step.
        coefficients: of which stage and value the coefficient a is that each w is h times; of no
            stage for b.
        formulas: all that the text was made of.
        size: of a state.
        evaluations: of vector fields outside of Newton's method in one step.
        implicit: the blocks that are solved by Newton's method, in order.
        chains: the Jacobians of those with too many unknowns to be written out, by their places.
    """

    source: str
    coefficients: tuple[tuple[Stage | None, FieldEvaluation], ...]
    formulas: tuple[Formula, ...]
    size: int
    evaluations: int
    implicit: tuple[StageBlock, ...]
    chains: Mapping[int, ChainRule]

    @property
    def repeated(self) -> tuple[int, ...]:
        """Evaluations of vector fields in one iteration of each implicit block."""
        return tuple(
            sum(isinstance(x, FieldEvaluation) for x in block.order) for block in self.implicit
        )


def write(graph: DependencyGraph, fields: Fields, dimension: int, is_for_balls: bool) -> Program:
    """The program of one step of the method with this ``graph`` on vector fields of d =
    ``dimension``.
    """
    return _Writer(graph, fields, dimension, is_for_balls).program()


class _Writer(NewtonWriter):
    """Writes all of a step."""

    def __init__(
        self, graph: DependencyGraph, fields: Fields, dimension: int, is_for_balls: bool
    ) -> None:
        super().__init__(graph, fields, dimension, is_for_balls)
        self.blocks = graph.blocks()
        self.unknowns = [stage for block in self.blocks for stage in block.unknowns]

    def program(self) -> Program:
        """Write everything."""
        implicit = [block for block in self.blocks if block.unknowns]
        body = self._body(implicit)
        y, lost = names("y", 2 * self.d), names("e", 2 * self.d)
        starts = [
            f"{x}{self._component(s, i)}"
            for x in "mn"
            for s in self.unknowns
            for i in range(self.d)
        ]
        state = ", ".join((*y, *lost, *starts))
        counts = names("n", len(implicit))
        w = list(self.weights.values())
        self.lines = ["def run(state, w, first, count, record):"]
        self.indent = " "
        self._write(f"{state}, = state")
        if w:
            self._write(f"{', '.join(w)}, = w")
            if self.is_for_balls:
                self._write("v = list(map(float, w))")
                self._write(f"{', '.join('v' + x for x in w)}, = v")
        self._write(" = ".join((*counts, "jacobians", "0")))
        self._write("number = first")
        self._write("try:")
        with self._nested():
            self._write("for number in range(first, first + count):")
            with self._nested():
                self.lines += body
        self._write(
            "except (ArithmeticError, ValueError):"
        )  # outside the domain of a field, or singular
        self._write(" raise NotSolved(number, nan) from None")
        self._write(f"return [{state}], [{', '.join(counts)}], jacobians")
        made = Program(
            "\n".join(self.lines) + "\n",
            tuple(self.first),
            tuple(self.formulas),
            4 * self.d + 2 * self.d * len(self.unknowns),
            len(self.graph.values) + len(self.frozen),
            tuple(implicit),
            self.chains,
        )
        return replace(made, evaluations=made.evaluations - sum(made.repeated))

    def _body(self, implicit: Sequence[StageBlock]) -> list[str]:
        """One step."""
        self.indent = "   "
        for block in self.blocks:
            if block.unknowns:
                self._newton(block, implicit.index(block))
            else:
                self._explicit(block)
        for k, group in enumerate(GROUPS):
            total = self._total(None, [v for v in self.graph.values if v.group == group])
            for i, change in enumerate(total.texts, k * self.d):
                self._write(f"d{i} = {change or '0.0'}")
        for stage in self.unknowns:
            for i in range(self.d):
                c = self._component(stage, i)
                self._write(f"m{c}, n{c} = z{c} - g{c}, z{c} - g{c} - m{c}")
        for i in range(2 * self.d):
            self._add(i)
        y = names("y", 2 * self.d)
        text = f"({' + '.join(y)})"
        self._write(
            f"if not {text}.is_finite():" if self.is_for_balls else f"if not isfinite{text}:"
        )
        self._write(" raise NotSolved(number, inf)")
        self._write("if record:")
        self._write(f" record([{', '.join(y)}])")
        return self.lines

    def _add(self, i: int) -> None:
        """One component of y_1: compensated in floats."""
        if self.is_for_balls:
            self._write(f"y{i} = (y{i} + d{i}).mid()")
            return
        self._write(f"d{i} += e{i}")
        self._write(f"s = y{i} + d{i}")
        self._write(f"e{i} = y{i} - s + d{i}")
        self._write(f"y{i} = s")
