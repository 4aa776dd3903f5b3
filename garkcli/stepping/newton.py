"""The lines of Newton's method for the unknowns of an implicit block.

It starts from the fields at y_0, corrected by what that missed in the last step. Up to two unknowns
floats have a new Jacobian in every iteration, more an inverse in floats that is kept as long as it
serves.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.problems.hamiltonian import Group
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Fields, StageBlock
from garkcli.stepping.jacobian import JacobianWriter, Slope, identity_minus
from garkcli.stepping.stagewriter import names

MAX_ITERATIONS = 50
"""Newton iterations before a step is given up."""
_WRITTEN = 40
"""Up to so many unknowns the Jacobian is written out."""
_DIRECT = 2
"""Up to so many unknowns floats solve by formulas, with a new Jacobian in every iteration."""


class NewtonWriter(JacobianWriter):
    """Writes Newton's method.

    Attributes:
        frozen: the names of the fields at y_0.
    """

    def __init__(
        self, graph: DependencyGraph, fields: Fields, dimension: int, is_for_balls: bool
    ) -> None:
        super().__init__(graph, fields, dimension, is_for_balls)
        self.frozen: dict[tuple[int, Group], list[str]] = {}

    def _newton(self, block: StageBlock, index: int) -> None:
        """Newton's method for the unknowns of ``block``."""
        components = [self._component(stage, i) for stage in block.unknowns for i in range(self.d)]
        zs = [f"z{c}" for c in components]
        is_direct = len(zs) <= _DIRECT and not self.is_for_balls
        self._start(block)
        self._write("floor = " + " + ".join(f"abs({y})" for y in names("y", 2 * self.d)))
        self._write("before = 0.0")
        self._write("done = False")
        if not is_direct:
            self._write("stale = True")
        self._write(f"for iteration in range({MAX_ITERATIONS}):")
        with self._nested():
            for stage in block.unknowns:
                self.stages[stage] = [f"x{self._component(stage, i)}" for i in range(self.d)]
                for i in range(self.d):
                    c = self._component(stage, i)
                    self._write(f"x{c} = {self._y(stage.group, i)} + z{c}")
            self._explicit(block)
            self._write("if done:")
            self._write(" break")
            self._residuals(block)
            if is_direct:
                self._directly(self._jacobian(block))
            else:
                self._by_inverse(block, len(zs), index)
            for k, z in enumerate(zs):
                self._write(f"{z} = ({z} - c{k}).mid()" if self.is_for_balls else f"{z} -= c{k}")
            self._write("size = " + " + ".join(f"abs(c{k})" for k in range(len(zs))))
            self._write("scale = " + " + ".join(f"abs({z})" for z in zs))
            self._ending(is_direct)
        self._write("else:")
        self._write(" raise NotSolved(number, float(size))")
        self._write(f"n{index} += iteration + 1")

    def _start(self, block: StageBlock) -> None:
        """The fields frozen at y_0, and what that missed in the last step, extrapolated."""
        for stage in block.unknowns:
            for value in self.graph.sums[stage]:
                self._freeze(value)
        for stage in block.unknowns:
            for i in range(self.d):
                c = self._component(stage, i)
                terms = [
                    f"{self._weight(stage, v)}*{f}"
                    for v in self.graph.sums[stage]
                    if (f := self.frozen[v.colour, v.group][i]) != "0"
                ]
                self._write(f"g{c} = {' + '.join(terms) or '0.0'}")
                guess = f"g{c} + m{c} + n{c}"
                self._write(f"z{c} = ({guess}).mid()" if self.is_for_balls else f"z{c} = {guess}")

    def _freeze(self, value: FieldEvaluation) -> None:
        key = value.colour, value.group
        if key not in self.frozen:
            groups = self.fields[key].depends
            at = [self._y(group, i) for group in groups for i in range(self.d)]
            made = self._formula(self.fields[key].components, value)
            self.frozen[key] = self._emit(made, at, f"g{value.colour}{value.group}_")

    def _residuals(self, block: StageBlock) -> None:
        k = 0
        for stage in block.unknowns:
            total = self._total(stage, self.graph.sums[stage])
            for i, text in enumerate(total.texts):
                self._write(f"r{k} = z{self._component(stage, i)} - ({text or '0.0'})")
                k += 1

    def _directly(self, J: Sequence[Slope]) -> None:
        """Corrections by Cramer's rule for (I − J) c = r."""
        M = identity_minus(J)
        self._write("jacobians += 1")
        if len(J) == 1:
            self._write(f"c0 = r0/({M[0][0]})")
            return
        (a, b), (c, d) = M
        self._write(f"a, b, c, d = {a}, {b}, {c}, {d}")
        self._write("t = a*d - b*c")
        self._write("c0, c1 = (d*r0 - b*r1)/t, (a*r1 - c*r0)/t")

    def _by_inverse(self, block: StageBlock, n: int, index: int) -> None:
        """Corrections by the inverse of I − J, a matrix of floats, which is kept as long as it
        serves.
        """
        self._write("if stale:")
        with self._nested():
            if n > _WRITTEN:
                self._chain(block, index)
            else:
                entries = [x for row in identity_minus(self._jacobian(block)) for x in row]
                self._write(f"inverse = inverted([{', '.join(entries)}], {n})")
            self._write("jacobians += 1")
        residuals = ", ".join(f"r{k}" for k in range(n))
        self._write(f"{', '.join(names('c', n))}, = corrections(inverse, [{residuals}])")

    def _ending(self, is_direct: bool) -> None:
        """Whether the next correction would be below round-off, and whether the Jacobian still
        serves.
        """
        self._write("if not size < inf:")
        self._write(" raise NotSolved(number, float(size))")
        # the next correction: of the size squared with a new Jacobian, in proportion with an old
        # one
        if is_direct:
            ends = "size < 1e-9*scale or size**3 <= 1e-17*scale*before**2"
        else:
            ends = "size <= precision*scale or size*size <= precision*scale*before"
            if not self.is_for_balls:
                ends += " or (stale and size < 1e-9*scale)"
        # or round-off: only a second correction no smaller than the first tells that it is reached
        self._write(f"done = {ends} or 0 < 0.5*before <= size <= 1e4*precision*(scale + floor)")
        if not is_direct:
            near = "1e-10" if self.is_for_balls else "1e-2"
            self._write(f"stale = size > {near}*scale or (iteration > 0 and size > 0.1*before)")
        self._write("before = size")
