"""What the method is like, and all properties that a file may claim."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.check.analysis import Analysis
from garkcli.check.every_facts import fact_text, told
from garkcli.check.every_value import EveryValue
from garkcli.check.outcome import Outcome
from garkcli.properties.property import Verdict
from garkcli.properties.registry import KEYS, every_property
from garkcli.report.check import CHECKED, verdict_words
from garkcli.report.checked import REPORT
from garkcli.tell.outputs import label, words
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    analysis = method.outcome.analysis
    if analysis is not None:
        keys, left_out = _keys(method)
        return {
            "lines": _lines(method.outcome),
            "verdicts": [_verdict(analysis, key) for key in keys],
            "left_out": left_out,
            "file": method.outcome.file,
        }
    every = method.outcome.every
    if every is None:
        return None
    return {
        "lines": [],
        "verdicts": _of_every_value(every),
        "left_out": [],
        "file": method.outcome.file,
    }


def _keys(method: Reported) -> tuple[list[str], list[str]]:
    """The properties that are told, and those that are left out as they take long."""
    if not method.is_slow:
        return list(KEYS), []
    slow = [one.key for one in every_property() if not one.is_cheap]
    return [key for key in KEYS if key not in slow], slow


def _lines(outcome: Outcome) -> list[tuple[str, str]]:
    """What the method is like, in lines of ``gark check``."""
    d = REPORT.dialect(outcome, "text")
    facts = CHECKED.named(outcome, ("symplectic", "consistent", "method", "by_colour"))
    return [(label(x, d), words(x, d)) for x in facts.values() if x.is_something]


def _verdict(analysis: Analysis, key: str) -> Content:
    """A property, what is true of it, and why."""
    verdict = analysis.subject.verdict(key)
    why = "" if verdict.value is True else verdict.why
    return {"key": key, "text": verdict_words(verdict), "why": why, "mark": _mark(verdict)}


def _mark(verdict: Verdict) -> str:
    """The class of the answer, for its sign."""
    if verdict.value is None:
        return "open" if verdict.is_undecided else "none"
    if verdict.value is True:
        return "yes"
    return "no" if verdict.value is False else "value"


def _of_every_value(every: EveryValue) -> Iterator[Content]:
    name = next(iter(every.parameters), "")
    for key in KEYS:
        text = fact_text(every.verdict(key), name, told)
        yield {"key": key, "text": text, "why": "", "mark": "value"}


SECTION = Section("properties", "Properties", _content)
