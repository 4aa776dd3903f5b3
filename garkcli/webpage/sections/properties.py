"""What the method is like, and all properties that a file may claim."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.check.analysis import Analysis
from garkcli.check.every_value import EveryValue
from garkcli.check.every_words import fact_text
from garkcli.exact.display import decimal
from garkcli.page.paint import Paint
from garkcli.properties.keys import KEYS
from garkcli.properties.property import Verdict
from garkcli.properties.registry import every_property
from garkcli.report.check_conditions import consistent_text
from garkcli.report.check_properties import property_lines, verdict_text
from garkcli.report.every_text import property_text
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    analysis = method.outcome.analysis
    if analysis is not None:
        keys, left_out = _keys(method)
        return {
            "lines": _lines(analysis),
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


def _lines(analysis: Analysis) -> list[tuple[str, str]]:
    """What is worth a word, as ``gark check`` tells it, symplecticity and row sums before it."""
    symplectic = "no"
    names = [colour.name for colour in analysis.tableau.colours]
    near = ""
    if analysis.tolerance is not None:
        near = f" within {decimal(analysis.tolerance)}"
    wrong = analysis.inconsistent
    consistent = consistent_text(wrong, names, "A", near, Paint(False))
    if analysis.symplectic:
        symplectic = f"yes{near}"
    has_further = analysis.embedded is not None or analysis.dense is not None
    return [
        ("symplectic", symplectic),
        ("consistent", consistent),
        *property_lines(analysis.subject, has_further),
    ]


def _verdict(analysis: Analysis, key: str) -> Content:
    """A property, what is true of it, and why."""
    verdict = analysis.subject.verdict(key)
    why = "" if verdict.value is True else verdict.why
    text = verdict_text(verdict)
    return {"key": key, "text": text, "why": why, "mark": _mark(verdict)}


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
