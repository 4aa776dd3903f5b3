"""Judges a method file for an editor: remarks at their places, a lens, and fixes."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.check.check_file import check_method
from garkcli.check.findings import entry_node, findings
from garkcli.check.outcome import Outcome
from garkcli.deadline import within
from garkcli.errors import HasFreeParameters, MethodFileError, NotDecided, Remark
from garkcli.exact.display import shortest
from garkcli.frozen import Frozen
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.nodes import ScalarNode, position
from garkcli.methodfile.load import loads
from garkcli.order.repair import Repair
from garkcli.report.checked import REPORT
from garkcli.tell.facts import Level
from garkcli.tell.outputs import label, words

SECONDS = 5.0
"""Seconds for a file; then the rest stays undecided."""
ORDERS = ("order", "embedded_order", "conjugate_order", "pair_order")
COLUMNS = 200
LATE = "not decided in time; gark check takes longer"
_TOKEN = re.compile(r"[^\s,\[\]{}:]+")
_KEY = re.compile(r"^([\w-]+):", re.MULTILINE)


class TextSpan(Frozen):
    """Line and columns count from 0."""

    line: int
    start: int
    end: int


class Fix(Frozen):
    title: str
    span: TextSpan
    text: str


class EditorView(Frozen):
    remark: Remark
    span: TextSpan
    fixes: tuple[Fix, ...] = ()


class Judgement(Frozen):
    remarks: tuple[EditorView, ...] = ()
    lens: tuple[str, ...] = ()
    line: int = 0
    exit_code: int = 0


def is_method(name: str, text: str) -> bool:
    r"""Whether a file of this name is meant as a method file.

    >>> is_method("a.gark.yaml", ""), is_method("a.yaml", "b: 1\nA: 2"), is_method("a.yaml", "")
    (True, True, False)
    """
    if name.endswith((".gark.yaml", ".gark.yml")):
        return True
    keys = {*_KEY.findall(text)}
    return bool(keys & {"gark", "expect"}) or {"A", "b"} <= keys or {"methods", "transfer"} <= keys


def judged(text: str, source: str) -> Judgement:
    """The remarks on a method file and its orders, within SECONDS. A file with free parameters has
    a lens that names them, and no remarks.
    """
    line = _line_of_tableau(text)
    try:
        with within(SECONDS):
            outcome = check_method(loads(text, source))
    except HasFreeParameters:
        lens = ("numbers are free: gark check and gark design have more",)
        return Judgement((), lens, line, exit_code=3 if "expect" in _KEY.findall(text) else 0)
    except MethodFileError as error:
        outcome = Outcome(source, source, faults=error.faults, text=text)
    except NotDecided:
        return Judgement((), (LATE,), line, exit_code=3)
    lines = text.splitlines()
    shown = tuple(
        EditorView(x.remark, span_of(lines, x.remark), tuple(_fixes(outcome, x.remark, lines)))
        for x in findings(outcome)
    )
    return Judgement(shown, _orders(outcome), line, outcome.exit_code)


def _line_of_tableau(text: str) -> int:
    for found in _KEY.finditer(text):
        if found[1] in METHOD_FILE.keys and found[1] != "gark":
            return text.count("\n", 0, found.start())
    return 0


def _orders(outcome: Outcome) -> tuple[str, ...]:
    if not outcome.is_read:
        return ()
    dialect = REPORT.dialect(outcome, "text", width=COLUMNS)
    facts = REPORT.form(outcome).named(outcome, ORDERS)
    usual = [x for x in facts.values() if x.is_something and x.level <= Level.USUAL]
    return tuple(f"{label(x, dialect)} {words(x, dialect)}" for x in usual)


def span_of(lines: list[str], remark: Remark) -> TextSpan:
    line, start = max(remark.line, 1) - 1, max(remark.column, 1) - 1
    text = lines[line] if line < len(lines) else ""
    found = _TOKEN.match(text, start)
    return TextSpan(line, start, found.end() if found else min(start + 1, len(text)))


def _fixes(outcome: Outcome, remark: Remark, lines: list[str]) -> Iterator[Fix]:
    if remark.meant:
        yield Fix(f"Write {remark.meant}", span_of(lines, remark), remark.meant)
    blame = outcome.blame
    if blame is None or (
        remark.code != "misprint"
        and (remark.line, remark.column) not in _places_of(blame.of, outcome)
    ):
        return
    for repair in blame.repairs:
        place = _place(outcome.text, repair)
        if place is not None:
            new, old = shortest(repair.new), lines[place.line][place.start : place.end]
            yield Fix(f"Write {new} in place of {old}", place, new)


def _places_of(key: str, outcome: Outcome) -> list[tuple[int, int]]:
    return [(x.line, x.column) for x in outcome.failed_claims if x.claim == key]


def _place(text: str, repair: Repair) -> TextSpan | None:
    node = entry_node(text, repair)
    if not isinstance(node, ScalarNode):
        return None
    line, column = position(node.start_mark)
    return TextSpan(line - 1, column - 1, position(node.end_mark)[1] - 1)
