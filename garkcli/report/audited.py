"""``gark audit``: what is wrong with the tables of a source tree."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import PurePath

from garkcli.bridges.audit import CODES, Audited, AuditFinding
from garkcli.bridges.judging import Judged
from garkcli.check.findings import Finding, fingerprint
from garkcli.errors import counted
from garkcli.page.paint import folded
from garkcli.page.plain import printable
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import COUNT, POSITION, TEXT, Schema, nullable, published
from garkcli.report import check_github, check_sarif
from garkcli.report.check_findings import table_cell

SCHEMA = "gark/audit/1"
_WIDTH = 80
_LEVEL: Schema = {"enum": ["error", "warning", "note"]}
_CODE: Schema = {"enum": list(CODES)}


def _number(order: Judged | None) -> int | None:
    return None if order is None else order.order


_FINDING: Record[AuditFinding] = Record(
    Field("code", _CODE, lambda x: x.code),
    Field("level", _LEVEL, lambda x: x.level),
    Field("message", TEXT, lambda x: x.message),
    Field("help", TEXT, lambda x: x.help),
)
_ORDER = nullable(COUNT)
_TABLE: Record[Audited] = Record(
    Field("source", TEXT, lambda x: x.table.source),
    Field("line", POSITION, lambda x: x.table.line),
    Field("format", TEXT, lambda x: x.table.format),
    Field("name", TEXT, lambda x: x.table.name),
    Field("order", _ORDER, lambda x: _number(x.order)),
    Field("declared_order", _ORDER, lambda x: x.table.order),
    Field("embedded_order", _ORDER, lambda x: _number(x.embedded_order)),
    Field("declared_embedded", _ORDER, lambda x: x.table.embedded_order),
    Field("nonautonomous_order", _ORDER, lambda x: _number(x.nonautonomous_order)),
    _FINDING.every("findings", lambda x: x.findings),
)


def _errors(tables: Sequence[Audited]) -> int:
    return sum(x.has_errors for x in tables)


def _unread(tables: Sequence[Audited]) -> int:
    """How many tables are neither judged nor wrong in themselves."""
    return sum(not (x.is_read or x.has_errors) for x in tables)


_SUMMARY: Record[Sequence[Audited]] = Record(
    Field("tables", COUNT, len), Field("wrong", COUNT, _errors), Field("unread", COUNT, _unread)
)
_REPORT: Record[Sequence[Audited]] = Record(
    schema_named(SCHEMA),
    _TABLE.every("tables", lambda x: x),
    _SUMMARY.whole("summary", lambda x: x),
)


def audit_report_schema() -> Schema:
    """The JSON Schema of ``gark audit --format json``."""
    return published("report of gark audit", _REPORT.schema)


def render_text(tables: Sequence[Audited], verbosity: int = 0) -> str:
    """Each table with its findings; those without any where ``verbosity`` is above 0."""
    lines: list[str] = []
    for found in tables:
        told = [x for x in found.findings if _is_told(x, verbosity)]
        if not told and verbosity < 1:
            continue
        lines.append(f"{_place(found)}  {_title(found)}")
        for finding in told:
            lines += _lines(finding.level, finding.message)
            if finding.help:
                lines += _lines("help", finding.help)
    lines.append(_summary(tables))
    return "\n".join(lines) + "\n"


def _is_told(finding: AuditFinding, verbosity: int) -> bool:
    return verbosity >= 0 or finding.level == "error"


def _lines(head: str, text: str) -> list[str]:
    """A sentence with its level before it, folded."""
    told = folded(f"{head}: {printable(text)}", _WIDTH - 4, "    ")
    return [f"    {line}" for line in told]


def _place(found: Audited) -> str:
    return printable(f"{found.table.source}:{found.table.line}")


def _title(found: Audited) -> str:
    name = printable(found.table.name or "a table")
    if found.order is None:
        return name
    words = [f"order {found.order.order}"]
    if found.embedded_order is not None:
        words.append(f"embedded order {found.embedded_order.order}")
    return f"{name}: {', '.join(words)}"


def _summary(tables: Sequence[Audited]) -> str:
    wrong = _errors(tables)
    unread = _unread(tables)
    parts = [counted(len(tables), "table")]
    if wrong or unread < len(tables):
        parts.append(f"{wrong} wrong" if wrong else "none wrong")
    if unread:
        parts.append(f"{unread} could not be read")
    return ", ".join(parts)


def _findings(tables: Sequence[Audited]) -> Iterator[Finding]:
    """The findings as the formats for machines have them."""
    for found in tables:
        file = PurePath(found.table.source).as_posix()
        name = found.table.name
        for x in found.findings:
            key = fingerprint(f"{file}\0{name}\0{x.code}")
            message = f"{name or 'a table'}: {x.message}"
            line = found.table.line
            yield Finding(x.code, file, line, 1, message, x.help, key, x.level)


def _github(tables: Sequence[Audited]) -> str:
    """A workflow command for each finding, and the text for the log."""
    commands = [check_github.annotation(x) for x in _findings(tables)]
    told = "".join(f"{x}\n" for x in commands)
    return told + check_github.inert(render_text(tables, -1))


def _sarif(tables: Sequence[Audited]) -> str:
    return check_sarif.log_of(list(_findings(tables)), CODES)


def _markdown(tables: Sequence[Audited]) -> str:
    """A table of what was found, for the summary of a job."""
    lines = ["| source | name | order | declared | finding |", "|---|---|---|---|---|"]
    for found in tables:
        if not found.findings:
            continue
        declared = found.table.order
        texts = [f"{x.level}: {x.message}" for x in found.findings]
        cells = [
            _place(found),
            found.table.name,
            "" if found.order is None else str(found.order.order),
            "" if declared is None else str(declared),
            "; ".join(texts),
        ]
        lines.append(f"| {' | '.join(map(table_cell, cells))} |")
    lines += ["", f"{_summary(tables)}."]
    return "\n".join(lines) + "\n"


FORMATS: Mapping[str, Callable[[Sequence[Audited]], str]] = {
    "json": _REPORT.text,
    "github": _github,
    "sarif": _sarif,
    "markdown": _markdown,
}
"""What writes each format for machines."""
