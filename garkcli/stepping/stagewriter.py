"""Writes the lines of a step: named stage values and field evaluations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from garkcli.frozen import Frozen
from garkcli.problems.expr import Vector
from garkcli.problems.straightline import StraightLineCode, code_of
from garkcli.problems.vectorfield import Group, StateLayout
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Stage, StageBlock
from garkcli.stepping.fields import Fields


class Lines:
    def __init__(self, indent: str = "") -> None:
        self.texts: list[str] = []
        self._indent = indent

    def write(self, line: str) -> None:
        self.texts.append(self._indent + line)

    @contextmanager
    def nested(self) -> Iterator[None]:
        """Lines written in this context are nested below the line before."""
        self._indent += " "
        yield
        self._indent = self._indent[:-1]


class StageSum(Frozen):
    """A sum of w f in a stage, and a text for each component."""

    terms: dict[FieldEvaluation, str]
    texts: list[str]


class StageWriter:
    """Writes stage values and evaluations, and keeps the names of their results. ``weights`` has
    the names of w by texts of coefficients, ``first`` the first occurrence of each.
    """

    def __init__(
        self,
        graph: DependencyGraph,
        fields: Fields,
        layout: StateLayout,
        is_for_balls: bool,
        lines: Lines,
    ) -> None:
        self.graph, self.fields = graph, fields
        self.layout, self.d = layout, layout.dimension
        self.is_for_balls = is_for_balls
        self.lines = lines
        self.weights: dict[str, str] = {}
        self.first: list[tuple[Stage | None, FieldEvaluation]] = []
        self.codes: list[StraightLineCode] = []
        self.values: dict[FieldEvaluation, list[str]] = {}
        self.stages: dict[Stage, list[str]] = {}
        self.number = {vertex: i for i, vertex in enumerate((*graph.sums, *graph.evaluations))}
        self._known_sums: list[StageSum] = []

    def explicit(self, block: StageBlock) -> None:
        for vertex in block.order:
            if isinstance(vertex, FieldEvaluation):
                self._evaluate(vertex)
            else:
                self._place(vertex)

    def _evaluate(self, evaluation: FieldEvaluation) -> None:
        components = self.fields[evaluation.colour, evaluation.group].components
        code = self.code(components, evaluation, self.is_for_balls)
        prefix = f"f{self.number[evaluation]}_"
        self.values[evaluation] = self.emit(code, self.arguments(evaluation), prefix)

    def _place(self, stage: Stage) -> None:
        total = self.total(stage, self.graph.sums[stage], stage.group)
        found = []
        for i, text in enumerate(total.texts):
            name = self.start(stage.group, i)
            if text:
                c = self.component(stage, i)
                self.lines.write(f"z{c} = {text}")
                self.lines.write(f"x{c} = {name} + z{c}")
                name, total.texts[i] = f"x{c}", f"z{c}"
            found.append(name)
        self.stages[stage] = found
        self._known_sums.append(total)

    def arguments(self, evaluation: FieldEvaluation) -> list[str]:
        found: list[str] = []
        for stage in self.graph.arguments[evaluation]:
            found += self.stages[stage]
        return found

    def total(
        self, stage: Stage | None, evaluations: Sequence[FieldEvaluation], group: Group
    ) -> StageSum:
        """The sum of w f, built on a known sum that has at least two of its terms."""
        terms: dict[FieldEvaluation, str] = {}
        for evaluation in evaluations:
            if any(f != "0" for f in self.values[evaluation]):
                terms[evaluation] = self.weight(stage, evaluation)
        size = self.layout.size(group)
        base = self._largest_part(terms, size)
        texts = []
        for i in range(size):
            parts = [base.texts[i]] if base.texts[i] else []
            for evaluation, w in terms.items():
                f = self.values[evaluation][i]
                if evaluation not in base.terms and f != "0":
                    parts.append(f"{w}*{f}")
            texts.append(" + ".join(parts))
        return StageSum(terms, texts)

    def _largest_part(self, terms: dict[FieldEvaluation, str], size: int) -> StageSum:
        """The known sum with the most of these terms and no others; empty if none has two."""
        largest = StageSum({}, [""] * size)
        for known in self._known_sums:
            is_part = len(known.terms) > 1 and known.terms.items() <= terms.items()
            if is_part and len(known.terms) > len(largest.terms):
                largest = known
        return largest

    def weight(self, stage: Stage | None, evaluation: FieldEvaluation) -> str:
        """The name of w = h a, or of h b for stage None; equal numbers share a name."""
        text = self.graph.coefficients[stage, evaluation]
        if text not in self.weights:
            self.weights[text] = f"w{len(self.first)}"
            self.first.append((stage, evaluation))
        return self.weights[text]

    def code(
        self, expressions: Vector, evaluation: FieldEvaluation, is_for_balls: bool
    ) -> StraightLineCode:
        arguments = self.fields[evaluation.colour, evaluation.group].arguments
        made = code_of(expressions, arguments, is_for_balls)
        self.codes.append(made)
        return made

    def emit(self, code: StraightLineCode, arguments: Sequence[str], prefix: str) -> list[str]:
        lines, results = code.lines(arguments, prefix)
        for line in lines:
            self.lines.write(line)
        return results

    def start(self, group: Group, i: int) -> str:
        return f"y{self.layout.start(group) + i}"

    def component(self, stage: Stage, i: int) -> str:
        return f"{self.number[stage]}_{i}"


def names(letter: str, count: int) -> list[str]:
    return [f"{letter}{i}" for i in range(count)]
