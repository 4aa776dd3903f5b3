"""The lines of a step: stage values and evaluations of fields, each with a name of its own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from garkcli.problems.hamiltonian import Group
from garkcli.problems.straightline import Formula, formula
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Fields, Stage, StageBlock


@dataclass(frozen=True)
class Sum:
    """A sum of w f that a stage has: the w of each evaluation, and a text a component, empty where
    it is zero.
    """

    terms: dict[FieldEvaluation, str]
    texts: list[str]


class StageWriter:
    """Writes lines and remembers the names of what they compute.

    Args:
        graph: of the method on the problem.
        fields: its vector fields.
        dimension: d.
        is_for_balls: whether the numbers are balls.
    """

    def __init__(
        self, graph: DependencyGraph, fields: Fields, dimension: int, is_for_balls: bool
    ) -> None:
        self.graph, self.fields, self.d, self.is_for_balls = graph, fields, dimension, is_for_balls
        self.lines: list[str] = []
        self.indent = ""
        self.weights: dict[str, str] = {}  # names of the numbers w
        self.first: list[
            tuple[Stage | None, FieldEvaluation]
        ] = []  # where each of them occurs first
        self.sums: list[Sum] = []
        self.formulas: list[Formula] = []
        self.values: dict[FieldEvaluation, list[str]] = {}
        self.stages: dict[Stage, list[str]] = {}
        self.number = {vertex: i for i, vertex in enumerate((*graph.sums, *graph.values))}

    def _explicit(self, block: StageBlock) -> None:
        """All vertices of ``block`` but its unknowns."""
        for vertex in block.order:
            if isinstance(vertex, FieldEvaluation):
                made = self._formula(self.fields[vertex.colour, vertex.group].components, vertex)
                self.values[vertex] = self._emit(
                    made, self._arguments(vertex), f"f{self.number[vertex]}_"
                )
            else:
                self._place(vertex)

    def _place(self, stage: Stage) -> None:
        """The stage value itself, y_0 and the sum."""
        total = self._total(stage, self.graph.sums[stage])
        found = []
        for i, text in enumerate(total.texts):
            y = self._y(stage.group, i)
            if text:
                c = self._component(stage, i)
                self._write(f"z{c} = {text}")
                self._write(f"x{c} = {y} + z{c}")
                y, total.texts[i] = f"x{c}", f"z{c}"
            found.append(y)
        self.stages[stage] = found
        self.sums.append(total)

    def _arguments(self, value: FieldEvaluation) -> list[str]:
        return [x for stage in self.graph.arguments[value] for x in self.stages[stage]]

    def _total(self, stage: Stage | None, values: Sequence[FieldEvaluation]) -> Sum:
        """The sums of w f over ``values``; from a sum that is known, where that has at least two of
        the terms.

        In a composition of short steps each stage goes on from the one before, and so costs no more
        than that.
        """
        terms = {value: self._weight(stage, value) for value in values if any(self._nonzero(value))}
        known = [x for x in self.sums if len(x.terms) > 1 and x.terms.items() <= terms.items()]
        base = max(known, key=lambda x: len(x.terms), default=Sum({}, [""] * self.d))
        texts = []
        for i in range(self.d):
            rest = [
                f"{w}*{self.values[v][i]}"
                for v, w in terms.items()
                if v not in base.terms and self._nonzero(v)[i]
            ]
            texts.append(" + ".join([base.texts[i]] * bool(base.texts[i]) + rest))
        return Sum(terms, texts)

    def _nonzero(self, value: FieldEvaluation) -> list[bool]:
        return [f != "0" for f in self.values[value]]

    def _weight(self, stage: Stage | None, value: FieldEvaluation) -> str:
        text = self.graph.coefficients[stage, value]
        if text not in self.weights:
            self.weights[text] = f"w{len(self.first)}"
            self.first.append((stage, value))
        return self.weights[text]

    def _formula(
        self,
        expressions: Sequence[object],
        value: FieldEvaluation,
        is_for_balls: bool | None = None,
    ) -> Formula:
        arguments = self.fields[value.colour, value.group].arguments
        made = formula(
            tuple(expressions),
            arguments,
            self.is_for_balls if is_for_balls is None else is_for_balls,
        )
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


def names(letter: str, count: int) -> list[str]:
    """The names of ``count`` numbers."""
    return [f"{letter}{i}" for i in range(count)]
