"""The properties of the method that a file may claim."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from markupsafe import Markup

from garkcli.check.every_facts import fact_reason
from garkcli.check.outcome import Outcome
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import every_property, find
from garkcli.properties.verdict import Verdict
from garkcli.report.check import CHECKED, verdict_words, within
from garkcli.report.checked import REPORT
from garkcli.report.methods import TYPES
from garkcli.tell.dialect import Status
from garkcli.tell.outputs import label, words
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    outcome = method.outcome
    of_test_equation = outcome.rosenbrock or outcome.derivatives
    if not (outcome.every or outcome.analysis or of_test_equation):
        return None  # no kind of method else has properties
    keys = [*KEYS]
    if of_test_equation is not None:
        keys = [key for key in KEYS if key in of_test_equation.subject.keys]
    slow: list[str] = []
    if method.is_slow and outcome.every is None:
        slow = [one.key for one in every_property() if not one.is_cheap]
    verdicts = [_verdict(outcome, key) for key in keys if key not in slow]
    lines = _lines(outcome) if outcome.analysis is not None else []
    is_brief = not (method.has_details or outcome.every)
    return {
        "lines": [*lines, *_brief(verdicts)] if is_brief else lines,
        "verdicts": [] if is_brief else verdicts,
        "left_out": slow,
        "file": outcome.file,
    }


def _lines(outcome: Outcome) -> list[tuple[Markup, Markup]]:
    """Returns the lines of ``gark check`` about symplecticity, consistency and structure."""
    d = Typeset(**REPORT.signs(outcome))
    facts = CHECKED.named(outcome, ("symplectic", "consistent", "method", "by_colour"))
    found = [x for x in facts.values() if x.is_something]
    return [(Markup(label(x, d)), Markup(words(x, d))) for x in found]


def _brief(verdicts: Sequence[Content]) -> Iterator[tuple[str, str]]:
    """Yields properties that it has and lacks, and the numbers that no section shows."""
    for said, mark in {"it is": "yes", "it is not": "no", "not decided": "open"}.items():
        named = [x["key"] for x in verdicts if x["mark"] == mark]
        if mark == "no":
            named = [key for key in named if key.replace("-", "_") not in TYPES]
        if named:
            yield said, ", ".join(named)
    for verdict in verdicts:
        if verdict["mark"] == "value" and find(verdict["key"]).is_cheap:
            yield verdict["key"], verdict["text"]


def _verdict(outcome: Outcome, key: str) -> Content:
    d = Typeset()
    if outcome.every is not None:
        fact = fact_reason(outcome.every.verdict(key), outcome.every.parameters[0])
        return {"key": key, "text": Markup(fact.words(d)), "why": "", "mark": "value"}
    analysis = outcome.analysis or outcome.rosenbrock or outcome.derivatives
    assert analysis is not None
    verdict = analysis.subject.verdict(key)
    text = Markup(d.known(verdict_words(verdict).words(d), Status(within(analysis, key))))
    why = Markup("" if verdict.value is True else d.reason(verdict.reason))
    return {"key": key, "text": text, "why": why, "mark": _mark(verdict)}


def _mark(verdict: Verdict) -> str:
    if verdict.value is None:
        return "open" if verdict.is_undecided else "none"
    if verdict.value is True:
        return "yes"
    return "no" if verdict.value is False else "value"
