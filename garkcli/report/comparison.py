"""``gark converge`` with several methods: side by side, a verdict each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import ceil, floor
from string import ascii_lowercase, ascii_uppercase
from typing import NamedTuple, TypeAlias

from flint import arb, fmpq

from garkcli.convergence.result import Convergence, curve
from garkcli.convergence.result import StepSizeRow as Step
from garkcli.errors import Remark, counted
from garkcli.frozen import Frozen
from garkcli.page.figures import log10, order_text, scientific
from garkcli.page.schema import Schema, one_of, published
from garkcli.plots.convergence import errors_scene
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.righthandside import RightHandSide
from garkcli.report import convergence as alone
from garkcli.report.problem import Stepped
from garkcli.report.remarks import FAULT
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Row, Rows, Section, SectionChoice, itself, maybe, via
from garkcli.tell.kinds import COUNT, TEXT, TRUTH, constant
from garkcli.tell.parts import SAID, answer, part, parts, plot, rows_of, shown, told
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
Tested: TypeAlias = Sequence[tuple[str, Convergence]]
_GOALS = 6  # errors at which costs are compared
_LONGEST = 60  # characters of a Hamiltonian that are still shown
MOST_METHODS = 20
"""Rows of a usual table in a terminal."""


class ConvergedMethod(Frozen):
    file: str
    name: str
    result: Convergence | None
    faults: tuple[Remark, ...]
    exit_code: int


class ConvergedMethods(Frozen):
    """``against`` is the axis of the plot: step sizes, evaluations or seconds."""

    entries: Sequence[ConvergedMethod]
    has_work: bool = False
    against: str = "h"

    @property
    def named(self) -> list[LetteredMethod]:
        """The methods, with their files if two have the same name."""
        names = Counter(x.name for x in self.entries)
        return [
            LetteredMethod(
                letter, f"{x.name} ({x.file})" if names[x.name] > 1 else x.name, x, self.has_work
            )
            for letter, x in zip(letters(len(self.entries)), self.entries, strict=True)
        ]

    @property
    def tested(self) -> Tested:
        return [(x.letter, x.entry.result) for x in self.named if x.entry.result is not None]


class LetteredMethod(NamedTuple):
    letter: str
    name: str
    entry: ConvergedMethod
    has_work: bool

    @property
    def test(self) -> alone.ConvergenceReport | None:
        result, name = self.entry.result, self.entry.name
        return None if result is None else alone.ConvergenceReport(result, name, self.has_work)


def letters(count: int) -> list[str]:
    """A, B, …, Z, a, …, z, and numbers beyond."""
    single = [*ascii_uppercase, *ascii_lowercase]
    return [*single, *(str(k) for k in range(len(single) + 1, count + 1))][:count]


def _verdict(x: LetteredMethod, d: Plain) -> str:
    if x.entry.result is None:
        return d.bad("FAILED")
    verdict = x.entry.result.verdict
    return d.note(verdict) if verdict == "reduced" else alone.verdict_words(x.entry.result, d)


OF_TEST: Rows[Convergence] = (
    itself("observed", told(lambda x, _: order_text(x.observed_order))),
    Row("visible", COUNT, alone.visible),
    Row("predicted", COUNT, alone.predicted),
)
METHOD: Section[LetteredMethod] = Section(
    Row("letter", TEXT, lambda x: x.letter, label=""),
    via(lambda x: x.entry.result, OF_TEST),
    itself("verdict", told(_verdict)),
    Row("method", TEXT, lambda x: x.name),
)


def _remarks(compared: ConvergedMethods) -> list[tuple[str, str]]:
    said: list[tuple[str, str]] = []
    seen: dict[str, list[str]] = {}
    for x in compared.named:
        texts = [fault.message for fault in x.entry.faults]
        if x.test is not None:
            result = x.test.result
            seen.setdefault(result.visible.trees, []).append(x.letter)
            texts = [str(alone.predicted(result).reason)] if result.hides_failure else []
            texts += [text for text in alone.notes(x.test) if text != alone.NO_TIME]
        said += [(x.letter, text) for text in texts]
    said += [(", ".join(who) if len(seen) > 1 else "note", text) for text, who in seen.items()]
    others = {result.jacobian for _, result in compared.tested} - {"exact"}
    said += [("Jacobian", taken) for taken in sorted(others)]
    costs = [row.cost for _, result in compared.tested for row in result.rows]
    if compared.has_work and any(x is None or x.seconds is None for x in costs):
        said.append(("note", alone.NO_TIME))
    if compared.has_work and at_equal_errors(compared.tested, "evaluations"):
        said.append(
            ("note", "costs of equal errors are read off between rows, on logarithmic scales")
        )
    return said


class StepErrors(NamedTuple):
    h: fmpq
    rows: dict[str, Step]


def _sizes(compared: ConvergedMethods) -> list[StepErrors]:
    rows = {letter: {row.h: row for row in x.rows} for letter, x in compared.tested}
    found = {h for of_one in rows.values() for h in of_one}
    return [
        StepErrors(h, {letter: x[h] for letter, x in rows.items() if h in x})
        for h in sorted(found, reverse=True)
    ]


def _errors(x: StepErrors, d: Plain) -> Iterator[tuple[str, str]]:
    for letter, row in x.rows.items():
        yield f"error {letter}", d.prose(scientific(row.error))
        yield f"slope {letter}", "" if row.slope is None else f"{row.slope:.2f}"


SIZE: Section[StepErrors] = Section(
    Row("h", alone.STEP_SIZE, lambda x: x.h), itself("errors", rows_of(_errors))
)


class StepCost(NamedTuple):
    letter: str
    row: Step


WORK: Section[StepCost] = Section(
    Row("letter", TEXT, lambda x: x.letter, label=""),
    Row("h", alone.STEP_SIZE, lambda x: x.row.h),
    itself("error", told(lambda x, d: d.prose(scientific(x.row.error)))),
    maybe("cost", part(alone.COST), lambda x: x.row.cost),
)


def at_equal_errors(tested: Tested, what: str) -> list[tuple[str, list[tuple[str, str]]]]:
    """The cost of errors of 10^k for each method, interpolated between its steps."""
    curves = {
        letter: [(log10(error), log10(x)) for x, error in curve(result, what)]
        for letter, result in tested
    }
    goals = _goals([[error for error, _ in points] for points in curves.values()])
    return [
        (letter, [(f"1e{k}", _amount(_between(points, k), what)) for k in goals])
        for letter, points in curves.items()
        if goals
    ]


def _amount(decades: float | None, what: str) -> str:
    """10^decades, in the digits of its kind; empty if unknown."""
    if decades is None:
        return ""
    x = 10**decades
    return str(round(x)) if what == "evaluations" else scientific(arb(x), 2)


def _goals(errors: Sequence[Sequence[float]]) -> list[int]:
    """Whole decades that at least two methods reach, thinned out evenly."""
    reached: Counter[int] = Counter()
    for ys in errors:
        if len(ys) > 1:
            reached.update(range(ceil(min(ys)), floor(max(ys)) + 1))
    shared = [k for k, count in reached.items() if count > 1]
    decades = sorted(shared or reached, reverse=True)
    return decades[:: max(1, ceil(len(decades) / _GOALS))]


def _between(points: Sequence[tuple[float, float]], goal: float) -> float | None:
    """The second coordinate at the first one ``goal``, on the line between two neighbours."""
    for (a, x), (b, y) in pairwise(points):
        is_between = min(a, b) <= goal <= max(a, b)
        if is_between and a != b:
            return x + (y - x) * (goal - a) / (b - a)
    return None


EQUAL: Section[tuple[str, list[tuple[str, str]]]] = Section(
    Row("letter", TEXT, lambda x: x[0], label=""), itself("costs", rows_of(lambda x, _: x[1]))
)


def _work(compared: ConvergedMethods) -> list[StepCost]:
    return [
        StepCost(letter, row)
        for letter, result in compared.tested
        for row in result.rows
        if compared.has_work
    ]


def _equal(what: str) -> Row[ConvergedMethods]:
    return Row(
        f"{what}_at_equal_errors",
        shown(EQUAL, MOST_METHODS),
        lambda c: at_equal_errors(c.tested, what) if c.has_work else [],
        label=f"{what} for an error of",
    )


def _remark_rows(remarks: Sequence[tuple[str, str]], d: Plain) -> list[tuple[str, str]]:
    return [(x, d.prose(text)) for x, text in remarks]


def _problem(compared: ConvergedMethods) -> str:
    if not compared.tested:
        return ""
    _, first = compared.tested[0]
    return f"{_about(first)}; to t = {first.t_end}"


def _about(result: Convergence) -> str:
    problem = result.problem
    if isinstance(problem, Oscillator):
        return f"oscillator; q̈ = −ω²q, ω = {problem.omega}"
    if isinstance(problem, RightHandSide):
        stiffness = problem.stiffness
        return problem.name + ("" if stiffness is None else f", stiffness {stiffness}")
    text = str(problem.energy).replace("**", "^")
    return problem.name + (f"; H = {text}" if len(text) <= _LONGEST else "")


def _answer(compared: ConvergedMethods, d: Plain) -> str:
    """``3 methods: 2 agree, 1 DISAGREES``."""
    found = Counter(x.result.verdict if x.result else "failed" for x in compared.entries)
    good, bad = found["agree"], found["disagree"]
    texts = [
        d.good("1 agrees" if good == 1 else f"{good} agree") if good else "",
        d.bad("1 DISAGREES" if bad == 1 else f"{bad} DISAGREE") if bad else "",
        f"{found['reduced']} reduced by stiffness" if found["reduced"] else "",
        d.note(f"{found['undecided']} undecided") if found["undecided"] else "",
        d.bad(f"{found['failed']} FAILED") if found["failed"] else "",
    ]
    return f"{counted(len(compared.entries), 'method')}: {', '.join(filter(None, texts))}"


HEAD: Rows[LetteredMethod] = (
    Row("file", TEXT, lambda x: x.entry.file),
    Row("ok", TRUTH, lambda x: x.entry.exit_code == 0),
)
SCHEMA: Row[object] = Row(
    "schema", constant(alone.REPORT.schema_name), lambda _: alone.REPORT.schema_name
)


def _test(x: LetteredMethod) -> alone.ConvergenceReport | None:
    return x.test


TESTED: dict[type[Stepped], Section[LetteredMethod]] = {
    kind: Section(HEAD, SCHEMA, via(_test, section.rows)) for kind, section in alone.FORMS.items()
}
UNTESTED: Section[LetteredMethod] = Section(
    HEAD,
    Row("name", TEXT, lambda x: x.entry.name),
    Row("errors", parts(FAULT), lambda x: x.entry.faults),
)
RESULT: Section[LetteredMethod] = SectionChoice(
    lambda x: UNTESTED if x.test is None else TESTED[type(x.test.result.problem)],
    UNTESTED,
    *TESTED.values(),
)


class StepLine(NamedTuple):
    entry: ConvergedMethod
    step: alone.StepTold


LINE: Rows[StepLine] = (
    Row("file", TEXT, lambda x: x.entry.file),
    Row("method", TEXT, lambda x: x.entry.name),
)
SUMMARY: Section[ConvergedMethods] = Section(
    Row("files", COUNT, lambda c: len(c.entries)),
    Row("failed", COUNT, lambda c: sum(x.exit_code != 0 for x in c.entries)),
)


def _lines(c: ConvergedMethods) -> tuple[Section[StepLine], list[StepLine]]:
    steps = alone.WORKED if c.has_work else alone.STEP
    found = [StepLine(x.entry, step) for x in c.named if x.test for step in alone.steps(x.test)]
    return Section(LINE, via(lambda x: x.step, steps.rows)), found


REPORT: Report[ConvergedMethods] = Report.only(
    "gark/converge-comparison/1",
    "report of gark converge of several methods",
    Section(
        answer(_answer),
        Row("problem_in_words", SAID, _problem, label="problem"),
        Row("remarks", rows_of(_remark_rows), _remarks),
        Row("methods", shown(METHOD, MOST_METHODS), lambda x: x.named, label=""),
        Row("sizes", shown(SIZE, MOST_METHODS), _sizes, label="errors"),
        Row("work", shown(WORK, MOST_METHODS), _work),
        _equal("evaluations"),
        _equal("seconds"),
        plot(
            lambda c: errors_scene(c.tested, c.against),
            lambda c: any([*curve(x, c.against)] for _, x in c.tested),
        ),
        Row("results", parts(RESULT), lambda x: x.named, DATA),
        itself("summary", part(SUMMARY), DATA),
    ),
    lines=_lines,
)


def schema() -> Schema:
    return published(alone.REPORT.title, one_of(*alone.REPORT.documents, *REPORT.documents))
