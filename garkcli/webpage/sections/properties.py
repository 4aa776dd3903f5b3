"""What the method is like, and all properties that a file may claim."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.check.analysis import Analysis
from garkcli.check.every_value import EveryValue
from garkcli.check.every_words import fact_text
from garkcli.properties.keys import KEYS
from garkcli.properties.property import Verdict
from garkcli.report.check_properties import property_lines, verdict_text
from garkcli.report.every_text import property_text
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    analysis = method.outcome.analysis
    if analysis is not None:
        return {"lines": _lines(analysis), "verdicts": _verdicts(analysis)}
    every = method.outcome.every
    if every is None:
        return None
    return {"lines": [], "verdicts": _of_every_value(every)}


def _lines(analysis: Analysis) -> list[tuple[str, str]]:
    """What is worth a word, as ``gark check`` tells it, symplecticity and row sums before it."""
    symplectic = "yes" if analysis.symplectic else "no"
    consistent = "no"
    if not analysis.inconsistent:
        consistent = "yes, the nodes are the row sums of every block"
    has_further = analysis.embedded is not None or analysis.dense is not None
    return [
        ("symplectic", symplectic),
        ("consistent", consistent),
        *property_lines(analysis.subject, has_further),
    ]


def _verdicts(analysis: Analysis) -> Iterator[Content]:
    """Each property, what is true of it, and why."""
    for key in KEYS:
        verdict = analysis.subject.verdict(key)
        why = "" if verdict.value is True else verdict.why
        text = verdict_text(verdict)
        yield {"key": key, "text": text, "why": why, "mark": _mark(verdict)}


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
        text = fact_text(every.verdict(key), name, property_text)
        yield {"key": key, "text": text, "why": "", "mark": "value"}


SECTION = Section("properties", "Properties", _content)
