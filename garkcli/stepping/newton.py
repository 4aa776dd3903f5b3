"""The lines of Newton's method for the unknowns of an implicit block.

It starts from the fields at y_0, corrected by what that missed in the last step. Up to two unknowns
floats have a new Jacobian in every iteration, more an inverse in floats that is kept as long as it
serves.

With Δ_k the size of correction k, the next one is foreseen from the rate Θ = Δ_k/Δ_{k−1} as in
Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8: Θ Δ_k with a Jacobian
that is kept, and with a new one C Δ_k², where C = Δ_k/Δ_{k−1}². When that is below round-off, the
correction that was just made is the last.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.problems.vectorfield import Group
from garkcli.stepping.dependency import FieldEvaluation, Stage, StageBlock
from garkcli.stepping.jacobian import JacobianWriter, Slope, identity_minus
from garkcli.stepping.stagewriter import StageWriter, names

MAX_ITERATIONS = 50
"""Most iterations in floats; each further digit allows one more. A Jacobian in floats gains one
digit or more at a time.
"""
_WRITTEN = 24
_DIRECT = 2
"""Most unknowns that floats solve by formulas, with a new Jacobian in every iteration."""

# Parts of the size of the unknowns. A float is good to 1.1e-16 of itself.
# a correction whose square is below round-off: 1e-18
_SQUARED_AWAY = 1e-9
# a foreseen correction that no float can show, with a factor of ten to spare
_BELOW_FLOATS = 1e-17
# a Jacobian one hundredth off gains two digits an iteration: it is kept
_NEAR_FOR_FLOATS = 1e-2
# one made so near gains ten digits, of the sixteen that its floats allow
_NEAR_FOR_BALLS = 1e-10
# a kept Jacobian that gains less than a digit an iteration is made anew
_KEPT_RATE = 0.1
# corrections that do not halve are round-off, where they are small enough:
_STALLED_RATE = 0.5
# in units of the precision; evaluations lose some digits to cancellation
_STALLED_UNITS = 1e4


class NewtonWriter:
    """Writes the lines of Newton's method. ``frozen`` has the names of the fields at y_0."""

    def __init__(self, stages: StageWriter, jacobians: JacobianWriter) -> None:
        self.frozen: dict[tuple[int, Group], list[str]] = {}
        self._stages = stages
        self._jacobians = jacobians
        self._lines = stages.lines
        self._is_for_balls = stages.is_for_balls

    def solve(self, block: StageBlock, index: int) -> None:
        write = self._lines.write
        d = self._stages.d
        unknowns = [f"z{self._stages.component(x, i)}" for x in block.unknowns for i in range(d)]
        is_direct = len(unknowns) <= _DIRECT and not self._is_for_balls
        self._start(block)
        state = names("y", self._stages.layout.unknowns)
        write(f"floor = {_size_of(state)}")
        write("before = 0.0")
        write("done = False")
        if not is_direct:
            write("stale = True")
        write("for iteration in range(iterations):")
        with self._lines.nested():
            for stage in block.unknowns:
                self._place(stage)
            self._stages.explicit(block)
            write("if done:")
            write(" break")
            self._residuals(block)
            if is_direct:
                self._directly(self._jacobians.written_out(block))
            else:
                self._by_inverse(block, len(unknowns), index)
            corrections = names("c", len(unknowns))
            for z, correction in zip(unknowns, corrections, strict=True):
                if self._is_for_balls:
                    write(f"{z} = ({z} - {correction}).mid()")
                else:
                    write(f"{z} -= {correction}")
            write(f"size = {_size_of(corrections)}")
            write(f"scale = {_size_of(unknowns)}")
            self._ending(is_direct)
        write("else:")
        write(" raise NotSolved(number, float(size))")
        write(f"n{index} += iteration + 1")

    def _place(self, stage: Stage) -> None:
        stages = self._stages
        found = []
        for i in range(stages.d):
            c = stages.component(stage, i)
            self._lines.write(f"x{c} = {stages.start(stage.group, i)} + z{c}")
            found.append(f"x{c}")
        stages.stages[stage] = found

    def _start(self, block: StageBlock) -> None:
        """Writes the start: frozen fields plus the extrapolated correction."""
        stages = self._stages
        for stage in block.unknowns:
            for evaluation in stages.graph.sums[stage]:
                self._freeze(evaluation)
        for stage in block.unknowns:
            for i in range(stages.d):
                c = stages.component(stage, i)
                self._lines.write(f"g{c} = {self._frozen_sum(stage, i)}")
                guess = f"g{c} + m{c} + n{c}"
                if self._is_for_balls:
                    guess = f"({guess}).mid()"
                self._lines.write(f"z{c} = {guess}")

    def _frozen_sum(self, stage: Stage, i: int) -> str:
        terms = []
        for evaluation in self._stages.graph.sums[stage]:
            f = self.frozen[evaluation.colour, evaluation.group][i]
            if f != "0":
                w = self._stages.weight(stage, evaluation)
                terms.append(f"{w}*{f}")
        return " + ".join(terms) or "0.0"

    def _freeze(self, evaluation: FieldEvaluation) -> None:
        key = evaluation.colour, evaluation.group
        if key in self.frozen:
            return
        stages = self._stages
        field = stages.fields[key]
        start = []
        for group in field.depends:
            start += [stages.start(group, i) for i in range(stages.layout.size(group))]
        code = stages.code(field.components, evaluation, self._is_for_balls)
        self.frozen[key] = stages.emit(code, start, f"g{evaluation.colour}{evaluation.group}_")

    def _residuals(self, block: StageBlock) -> None:
        k = 0
        for stage in block.unknowns:
            total = self._stages.total(stage, self._stages.graph.sums[stage], stage.group)
            for i, text in enumerate(total.texts):
                c = self._stages.component(stage, i)
                image = text or "0.0"
                self._lines.write(f"r{k} = z{c} - ({image})")
                k += 1

    def _directly(self, J: Sequence[Slope]) -> None:
        """Writes corrections by Cramer's rule for (I − J) c = r."""
        write = self._lines.write
        M = identity_minus(J)
        write("jacobians += 1")
        if len(J) == 1:
            ((slope,),) = M
            write(f"c0 = r0/({slope})")
            return
        (a, b), (c, d) = M
        write(f"a, b, c, d = {a}, {b}, {c}, {d}")
        write("t = a*d - b*c")
        write("c0, c1 = (d*r0 - b*r1)/t, (a*r1 - c*r0)/t")

    def _by_inverse(self, block: StageBlock, n: int, index: int) -> None:
        """Writes corrections by an inverse of I − J that is kept while it converges fast."""
        self._lines.write("if stale:")
        with self._lines.nested():
            if n > _WRITTEN:
                self._jacobians.by_chain_rule(block, index)
            else:
                rows = identity_minus(self._jacobians.written_out(block))
                entries = ", ".join(x for row in rows for x in row)
                self._lines.write(f"inverse = inverted([{entries}], {n})")
            self._lines.write("jacobians += 1")
        residuals = ", ".join(names("r", n))
        corrections = ", ".join(names("c", n))
        self._lines.write(f"{corrections}, = corrections(inverse, [{residuals}])")

    def _ending(self, is_direct: bool) -> None:
        """Writes the tests for convergence and for renewing the Jacobian."""
        write = self._lines.write
        write("if not size < inf:")
        write(" raise NotSolved(number, float(size))")
        squared_away = f"size < {_SQUARED_AWAY:.0e}*scale"
        if is_direct:
            ends = f"{squared_away} or size**3 <= {_BELOW_FLOATS:.0e}*scale*before**2"
        else:
            ends = "size <= precision*scale or size*size <= precision*scale*before"
            if not self._is_for_balls:
                ends += f" or (stale and {squared_away})"
        # or round-off: only a second correction no smaller than the first tells that it is reached
        round_off = f"{_STALLED_UNITS:.0e}*precision*(scale + floor)"
        stalled = f"0 < {_STALLED_RATE}*before <= size <= {round_off}"
        write(f"done = {ends} or {stalled}")
        if not is_direct:
            near = _NEAR_FOR_BALLS if self._is_for_balls else _NEAR_FOR_FLOATS
            slow = f"(iteration > 0 and size > {_KEPT_RATE}*before)"
            write(f"stale = size > {near:.0e}*scale or {slow}")
        write("before = size")


def _size_of(numbers: Sequence[str]) -> str:
    return " + ".join(f"abs({x})" for x in numbers)
