"""The parts of pages that are made from the entries of the glossary."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from garkcli.glossary.faults import TOPICS, FaultKind, FindingKind, faults_of, findings_of
from garkcli.glossary.key import Key, keys_of
from garkcli.report.field_texts import fields_of, text_of
from garkcli.report.schemas import REPORTS, report_schema


def codes_page() -> str:
    """Every code of an error in Markdown, a table a topic: what it means, and the cure."""
    parts = []
    for topic, title in TOPICS.items():
        parts.append(f"### {title}\n\n{_codes_table(faults_of(topic))}")
    return "\n".join(parts)


def _codes_table(kinds: Iterable[FaultKind | FindingKind]) -> str:
    rows = [(f"`{x.code}`", _cell(x.text), _cell(x.cure)) for x in kinds]
    return _table(("code", "what it means", "what to do"), rows)


def keys_table(kind: str) -> str:
    """The keys of a kind of files as a table in Markdown; ``kind`` is of ``glossary.key.KINDS``."""
    rows = []
    for key in keys_of(kind).values():
        example = key.example.replace("|", "\\|")
        rows.append((f"`{key.path}`", _cell(_said(key)), f"`{example}`"))
    return _table(("key", "what it is", "example"), rows)


def _said(key: Key) -> str:
    """What a key is, and what holds without it."""
    if key.default is None:
        return key.text
    default = str(key.default)
    if isinstance(key.default, bool):
        default = default.lower()
    return f"{key.text} By default {default}."


def findings_table(command: str) -> str:
    """The findings of a command as a table in Markdown."""
    return _codes_table(findings_of(command).values())


def fields_table() -> str:
    """Every field of every report as a table in Markdown: its name, its reports, what it holds."""
    reports: dict[tuple[str, str], dict[str, None]] = {}
    for report in REPORTS:
        for path, schema in fields_of(report_schema(report), (report,)):
            field = (path[-1], text_of(path) + _one_of(schema))
            reports.setdefault(field, {})[report] = None
    rows = []
    for (name, text), named in sorted(reports.items()):
        rows.append((f"`{name}`", ", ".join(named), _cell(text)))
    return _table(("field", "in the reports", "what it holds"), rows)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [_row(heads), "|" + "---|" * len(heads)]
    lines += map(_row, rows)
    return "\n".join(lines) + "\n"


def _row(cells: Sequence[str]) -> str:
    return f"|{'|'.join(cells)}|"


def _one_of(schema: Any) -> str:
    """The words that the values of a field are; nothing where they are others."""
    words = schema.get("enum", []) if isinstance(schema, dict) else []
    named = [x for x in words if isinstance(x, str) and x]
    return "" if not 1 < len(named) <= _MOST_WORDS else f" One of: {', '.join(named)}."


_MOST_WORDS = 13


def _cell(text: str) -> str:
    """A text in a cell of a table: its signs are no signs of Markdown."""
    for sign in "\\*_|":
        text = text.replace(sign, f"\\{sign}")
    return text
