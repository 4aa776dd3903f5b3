"""The step of a method on a problem as a program: straight-line Python, one for floats and one for balls.

The writer follows the blocks of ``garkcli.dynamics.structure`` in order. With the numbers w = h a and h b given,
each stage value is y_0 plus the sum of w times field values, eq. (spgqrk) written out without its zeros. The
unknowns of an implicit block are found by Newton's method, whose Jacobian is written out too, by the chain rule
along the explicit part of the block. The text has names of ours only: see ``garkcli.dynamics.formula``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TypeAlias

from garkcli.dynamics.chainrule import ChainRule
from garkcli.dynamics.formula import Formula, formula
from garkcli.dynamics.hamiltonian import GROUPS, Group
from garkcli.dynamics.structure import Block, Coupling, Fields, Stage, Value

MAX_ITERATIONS = 50
"""Newton iterations before a step is given up."""
_WRITTEN = 40
"""Up to so many unknowns the Jacobian is written out."""
_DIRECT = 2
"""Up to so many unknowns floats solve by formulas, with a new Jacobian in every iteration."""
Slope: TypeAlias = dict[int, str]
"""The derivative of one number by the unknowns that it depends on, as texts."""


@dataclass(frozen=True)
class Program:
    """A step as text.

    Attributes:
        source: of ``run(state, w, first, count, record)``. A state is the list of (q, p), what they have lost in
            their last digits, and what the starts of Newton's method missed in the last step and how that changed;
            the result is the new state, the number of iterations of each implicit block, and the number of
            Jacobians. ``record``, unless it is None, is called with (q, p) after each step.
        coefficients: of which stage and value the coefficient a is that each w is h times; of no stage for b.
        formulas: all that the text was made of.
        size: of a state.
        evaluations: of vector fields outside of Newton's method in one step.
        implicit: the blocks that are solved by Newton's method, in order.
        chains: the Jacobians of those with too many unknowns to be written out, by their places.
    """

    source: str
    coefficients: tuple[tuple[Stage | None, Value], ...]
    formulas: tuple[Formula, ...]
    size: int
    evaluations: int
    implicit: tuple[Block, ...]
    chains: Mapping[int, ChainRule]

    @property
    def repeated(self) -> tuple[int, ...]:
        """Evaluations of vector fields in one iteration of each implicit block."""
        return tuple(sum(isinstance(x, Value) for x in block.order) for block in self.implicit)


def write(graph: Coupling, fields: Fields, dimension: int, is_for_balls: bool) -> Program:
    """The program of one step of the method with this ``graph`` on vector fields of d = ``dimension``."""
    return _Writer(graph, fields, dimension, is_for_balls).program()


@dataclass(frozen=True)
class _Sum:
    """A sum of w f that a stage has: the w of each evaluation, and a text a component, empty where it is zero."""

    terms: dict[Value, str]
    texts: list[str]


class _Writer:
    """Writes lines and remembers the names of what they compute."""

    def __init__(self, graph: Coupling, fields: Fields, dimension: int, is_for_balls: bool) -> None:
        self.graph, self.fields, self.d, self.is_for_balls = graph, fields, dimension, is_for_balls
        self.lines: list[str] = []
        self.indent = ""
        self.weights: dict[str, str] = {}  # names of the numbers w
        self.first: list[tuple[Stage | None, Value]] = []  # where each of them occurs first
        self.sums: list[_Sum] = []
        self.formulas: list[Formula] = []
        self.values: dict[Value, list[str]] = {}
        self.stages: dict[Stage, list[str]] = {}
        self.number = {vertex: i for i, vertex in enumerate((*graph.sums, *graph.values))}
        self.blocks = graph.blocks()
        self.unknowns = [stage for block in self.blocks for stage in block.unknowns]
        self.frozen: dict[tuple[int, Group], list[str]] = {}
        self.chains: dict[int, ChainRule] = {}

    def program(self) -> Program:
        """Write everything."""
        implicit = [block for block in self.blocks if block.unknowns]
        body = self._body(implicit)
        y, lost = _names("y", 2 * self.d), _names("e", 2 * self.d)
        starts = [f"{x}{self._component(s, i)}" for x in "mn" for s in self.unknowns for i in range(self.d)]
        state = ", ".join((*y, *lost, *starts))
        counts = _names("n", len(implicit))
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
        self._write("except (ArithmeticError, ValueError):")  # outside the domain of a field, or singular
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

    def _body(self, implicit: Sequence[Block]) -> list[str]:
        """One step."""
        self.indent = "   "
        for block in self.blocks:
            if block.unknowns:
                self._newton(block, implicit.index(block))
            else:
                self._explicit(block)
        for k, group in enumerate(GROUPS):
            total = self._total(None, [v for v in self.graph.values if v.group == group])
            for i, text in enumerate(total.texts, k * self.d):
                self._write(f"d{i} = {text or '0.0'}")
        for stage in self.unknowns:
            for i in range(self.d):
                c = self._component(stage, i)
                self._write(f"m{c}, n{c} = z{c} - g{c}, z{c} - g{c} - m{c}")
        for i in range(2 * self.d):
            self._add(i)
        self._write(f"if not {self._finite(_names('y', 2 * self.d))}:")
        self._write(" raise NotSolved(number, inf)")
        self._write("if record:")
        self._write(f" record([{', '.join(_names('y', 2 * self.d))}])")
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

    def _finite(self, names: Sequence[str]) -> str:
        total = " + ".join(names)
        return f"({total}).is_finite()" if self.is_for_balls else f"isfinite({total})"

    # one vertex

    def _explicit(self, block: Block) -> None:
        for vertex in block.order:
            if isinstance(vertex, Value):
                made = self._formula(self.fields[vertex.colour, vertex.group].components, vertex)
                self.values[vertex] = self._emit(made, self._arguments(vertex), f"f{self.number[vertex]}_")
            else:
                self._place(vertex)

    def _place(self, stage: Stage) -> None:
        """The stage value itself, y_0 and the sum."""
        total = self._total(stage, self.graph.sums[stage])
        names = []
        for i, text in enumerate(total.texts):
            y = self._y(stage.group, i)
            if text:
                c = self._component(stage, i)
                self._write(f"z{c} = {text}")
                self._write(f"x{c} = {y} + z{c}")
                y, total.texts[i] = f"x{c}", f"z{c}"
            names.append(y)
        self.stages[stage] = names
        self.sums.append(total)

    def _arguments(self, value: Value) -> list[str]:
        return [x for stage in self.graph.arguments[value] for x in self.stages[stage]]

    def _total(self, stage: Stage | None, values: Sequence[Value]) -> _Sum:
        """The sums of w f over ``values``; from a sum that is known, where that has at least two of the terms.

        In a composition of short steps each stage goes on from the one before, and so costs no more than that.
        """
        terms = {value: self._weight(stage, value) for value in values if any(self._nonzero(value))}
        known = [x for x in self.sums if len(x.terms) > 1 and x.terms.items() <= terms.items()]
        base = max(known, key=lambda x: len(x.terms), default=_Sum({}, [""] * self.d))
        texts = []
        for i in range(self.d):
            rest = [
                f"{w}*{self.values[v][i]}" for v, w in terms.items() if v not in base.terms and self._nonzero(v)[i]
            ]
            texts.append(" + ".join([base.texts[i]] * bool(base.texts[i]) + rest))
        return _Sum(terms, texts)

    def _nonzero(self, value: Value) -> list[bool]:
        return [f != "0" for f in self.values[value]]

    def _weight(self, stage: Stage | None, value: Value) -> str:
        text = self.graph.coefficients[stage, value]
        if text not in self.weights:
            self.weights[text] = f"w{len(self.first)}"
            self.first.append((stage, value))
        return self.weights[text]

    def _formula(self, expressions: Sequence[object], value: Value, is_for_balls: bool | None = None) -> Formula:
        arguments = self.fields[value.colour, value.group].arguments
        made = formula(tuple(expressions), arguments, self.is_for_balls if is_for_balls is None else is_for_balls)
        self.formulas.append(made)
        return made

    def _emit(self, made: Formula, arguments: Sequence[str], prefix: str) -> list[str]:
        lines, results = made.lines(arguments, prefix)
        for line in lines:
            self._write(line)
        return results

    def _y(self, group: Group, i: int) -> str:
        return f"y{i + (self.d if group == 'p' else 0)}"

    def _component(self, stage: Stage, i: int) -> str:
        return f"{self.number[stage]}_{i}"

    def _write(self, line: str) -> None:
        self.lines.append(self.indent + line)

    @contextmanager
    def _nested(self) -> Iterator[None]:
        self.indent += " "
        yield
        self.indent = self.indent[:-1]

    # implicit blocks

    def _newton(self, block: Block, index: int) -> None:
        """Newton's method for the unknowns of ``block``."""
        components = [self._component(stage, i) for stage in block.unknowns for i in range(self.d)]
        zs = [f"z{c}" for c in components]
        is_direct = len(zs) <= _DIRECT and not self.is_for_balls
        self._start(block)
        scale = "floor = " + " + ".join(f"abs({y})" for y in _names("y", 2 * self.d))
        self._write(scale)
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

    def _start(self, block: Block) -> None:
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

    def _freeze(self, value: Value) -> None:
        key = value.colour, value.group
        if key not in self.frozen:
            groups = self.fields[key].depends
            at = [self._y(group, i) for group in groups for i in range(self.d)]
            made = self._formula(self.fields[key].components, value)
            self.frozen[key] = self._emit(made, at, f"g{value.colour}{value.group}_")

    def _residuals(self, block: Block) -> None:
        k = 0
        for stage in block.unknowns:
            total = self._total(stage, self.graph.sums[stage])
            for i, text in enumerate(total.texts):
                self._write(f"r{k} = z{self._component(stage, i)} - ({text or '0.0'})")
                k += 1

    def _directly(self, J: Sequence[Slope]) -> None:
        """Corrections by Cramer's rule for (I − J) c = r."""
        M = _identity_minus(J)
        self._write("jacobians += 1")
        if len(J) == 1:
            self._write(f"c0 = r0/({M[0][0]})")
            return
        (a, b), (c, d) = M
        self._write(f"a, b, c, d = {a}, {b}, {c}, {d}")
        self._write("t = a*d - b*c")
        self._write("c0, c1 = (d*r0 - b*r1)/t, (a*r1 - c*r0)/t")

    def _by_inverse(self, block: Block, n: int, index: int) -> None:
        """Corrections by the inverse of I − J, a matrix of floats, which is kept as long as it serves."""
        self._write("if stale:")
        with self._nested():
            if n > _WRITTEN:
                self._chain(block, index)
            else:
                entries = [x for row in _identity_minus(self._jacobian(block)) for x in row]
                self._write(f"inverse = inverted([{', '.join(entries)}], {n})")
            self._write("jacobians += 1")
        residuals = ", ".join(f"r{k}" for k in range(n))
        self._write(f"{', '.join(_names('c', n))}, = corrections(inverse, [{residuals}])")

    def _ending(self, is_direct: bool) -> None:
        """Whether the next correction would be below round-off, and whether the Jacobian still serves."""
        self._write("if not size < inf:")
        self._write(" raise NotSolved(number, float(size))")
        # the next correction: of the size squared with a new Jacobian, in proportion with an old one
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

    # the chain rule

    def _chain(self, block: Block, index: int) -> None:
        """The Jacobian by ``ChainRule`` from the derivatives of the fields."""
        # all weights first: their places are what the chain rule knows them by
        pairs = [(stage, value) for stage in self.graph.sums for value in self.graph.sums[stage]]
        places = {pair: int(self._weight(*pair).removeprefix("w")) for pair in pairs}
        chain = self.chains[index] = ChainRule(block, self.graph, self.d, places)
        entries = []
        for value in chain.values:
            by = [(s, k) for v, s in chain.arguments if v == value for k in range(self.d)]
            rows = self._derivatives(value, by)
            for first in range(0, len(by), self.d):
                entries += [x for row in rows for x in row[first : first + self.d]]
        numbers = ", ".join("0.0" if x == "0" else x for x in entries)
        self._write(f"inverse = chain{index}([{numbers}], {'v' if self.is_for_balls else 'w'})")

    def _jacobian(self, block: Block) -> list[Slope]:
        """The derivative of the image of the unknowns, row by row, from lines that are written here."""
        slopes: dict[tuple[Stage | Value, int], Slope] = {}
        for k, stage in enumerate(block.unknowns):
            for i in range(self.d):
                slopes[stage, i] = {k * self.d + i: "1.0"}
        for vertex in block.order:
            for i, row in enumerate(
                self._slopes_of_value(vertex, slopes)
                if isinstance(vertex, Value)
                else [self._slope_of_sum(vertex, i, slopes) for i in range(self.d)]
            ):
                slopes[vertex, i] = self._named(row, f"s{self.number[vertex]}_{i}_")
        return [self._slope_of_sum(stage, i, slopes) for stage in block.unknowns for i in range(self.d)]

    def _slope_of_sum(self, stage: Stage, i: int, slopes: Mapping[tuple[Stage | Value, int], Slope]) -> Slope:
        v = "v" if self.is_for_balls else ""
        return _sums(
            (v + self._weight(stage, value), slope)
            for value in self.graph.sums[stage]
            if (slope := slopes.get((value, i)))
        )

    def _slopes_of_value(self, value: Value, slopes: Mapping[tuple[Stage | Value, int], Slope]) -> list[Slope]:
        by = [(stage, k) for stage in self.graph.arguments[value] for k in range(self.d) if (stage, k) in slopes]
        rows = [list(zip(row, (slopes[x] for x in by), strict=True)) for row in self._derivatives(value, by)]
        return [_sums((entry, slope) for entry, slope in row if entry != "0" and slope) for row in rows]

    def _derivatives(self, value: Value, by: Sequence[tuple[Stage, int]]) -> list[list[str]]:
        """The derivatives of an evaluation by some components of its arguments, d rows."""
        field = self.fields[value.colour, value.group]
        arguments = self._arguments(value)
        if self.is_for_balls:
            prefix = f"X{self.number[value]}_"
            for k, x in enumerate(arguments):
                self._write(f"{prefix}{k} = float({x})")
            arguments = [f"{prefix}{k}" for k in range(len(arguments))]
        columns = {g: field.derivative(g) for g in field.depends}
        flat = [columns[stage.group][i][k] for i in range(self.d) for stage, k in by]
        made = self._formula(flat, value, False)
        entries = iter(self._emit(made, arguments, f"j{self.number[value]}_"))
        return [[next(entries) for _ in by] for _ in range(self.d)]

    def _named(self, row: Slope, prefix: str) -> Slope:
        """The same with composite texts given names."""
        made = {}
        for column, text in row.items():
            if not text.isidentifier() and not text.replace(".", "").isdigit():
                self._write(f"{prefix}{column} = {text}")
                text = f"{prefix}{column}"
            made[column] = text
        return made


def _names(letter: str, count: int) -> list[str]:
    return [f"{letter}{i}" for i in range(count)]


def _sums(terms: Iterator[tuple[str, Slope]]) -> Slope:
    """Σ factor · slope, without multiplications by one."""
    total: dict[int, list[str]] = {}
    for factor, slope in terms:
        for column, text in slope.items():
            product = factor if text == "1.0" else text if factor == "1.0" else f"{factor}*{text}"
            total.setdefault(column, []).append(product)
    return {column: " + ".join(texts) if len(texts) > 1 else texts[0] for column, texts in total.items()}


def _identity_minus(J: Sequence[Slope]) -> list[list[str]]:
    n = len(J)
    ones = [["1.0" if i == k else "0.0" for k in range(n)] for i in range(n)]
    return [[f"{ones[i][k]} - ({row[k]})" if k in row else ones[i][k] for k in range(n)] for i, row in enumerate(J)]
