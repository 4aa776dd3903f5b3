"""``gark audit``: what is wrong with the tables of a source tree."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import PurePath
from typing import NamedTuple

from garkcli.bridges.audit import Audited
from garkcli.bridges.judging import Judged
from garkcli.bridges.subject import TableSubject
from garkcli.check.findings import Finding, fingerprint
from garkcli.errors import Remark, counted
from garkcli.frozen import replace
from garkcli.page.look import PLAIN, Look
from garkcli.report.remarks import OF_TABLE, annotation, commands_off, log_of, remark_rows
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Row, Section, maybe
from garkcli.tell.kinds import COUNT, POSITION, TEXT
from garkcli.tell.parts import answer, part, parts, rows_of, shown
from garkcli.tell.report import FORMATS as TOLD
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
MOST = 100


class Audit(NamedTuple):
    tables: Sequence[Audited]
    errors_alone: bool = False

    @property
    def wrong(self) -> list[tuple[Audited, Sequence[Remark]]]:
        if self.errors_alone:
            found = ((x, [y for y in x.findings if y.level == "error"]) for x in self.tables)
            return [(x, findings) for x, findings in found if findings]
        return [(x, list(x.findings)) for x in self.tables if _is_doubtful(x)]


def _is_doubtful(found: Audited) -> bool:
    return any(x.level != "note" for x in found.findings)


def place_and_orders(found: Audited | TableSubject, d: Plain) -> str:
    """``a.py:3 rk4: order 4``."""
    words = [] if found.order is None else [f"order {_least(found.order)}"]
    if words and found.embedded_order is not None:
        words.append(f"embedded order {_least(found.embedded_order)}")
    if found.table.is_source:
        return d.prose(found.table.source)
    name = ": ".join(filter(None, [found.table.name or "a table", ", ".join(words)]))
    return d.prose(f"{found.table.source}:{found.table.line} {name}")


def _least(order: Judged) -> str:
    return f"at least {order.order}" if order.is_limited else str(order.order)


def _answer(x: Audit, _: Plain) -> str:
    """``3 tables in 2 files, 1 wrong``."""
    late = sum(found.table.is_source for found in x.tables)
    wrong, unread = _errors(x.tables), _unread(x.tables) - late
    others = sum(bool(found.table.kind) for found in x.tables)
    judged = [found for found in x.tables if found.is_read or found.has_errors]
    sources = {found.table.source for found in judged}
    where = f" in {counted(len(sources), 'file')}" if len(sources) > 1 else ""
    told = "no table is read"
    if judged:
        result = f"{wrong} wrong" if wrong else "none wrong"
        told = f"{counted(len(judged), 'table')}{where}, {result}"
    texts = [told]
    noted = sum(bool(x.findings) and not _is_doubtful(x) for x in judged)
    if noted:
        texts.append(f"{noted} with notes alone")
    if others:
        verb = "is" if others == 1 else "are"
        texts.append(f"{others} of other methods {verb} not judged")
    if late:
        texts.append(f"{counted(late, 'source')} {'was' if late == 1 else 'were'} not read")
    if unread:
        verbs = "looks like a table and was" if unread == 1 else "look like tables and were"
        more = f"{unread} more" if judged else str(unread)
        texts.append(f"{more} {verbs} not read: -v lists them, --strict fails on them")
    elif (noted or others) and not late:
        texts[-1] += ": -v lists them"
    return "; ".join(texts)


def _errors(tables: Sequence[Audited]) -> int:
    return sum(x.has_errors for x in tables)


def _unread(tables: Sequence[Audited]) -> int:
    return sum(x.looks_like for x in tables)


def _number(order: Judged | None) -> int | None:
    return None if order is None else order.order


def _count(key: str, get: Callable[[Audited], int | None]) -> Row[Audited]:
    return maybe(key, COUNT, get, DETAIL)


TABLE: Section[Audited] = Section(
    Row("source", TEXT, lambda x: x.table.source, DATA),
    Row("line", POSITION, lambda x: x.table.line, DATA),
    Row("format", TEXT, lambda x: x.table.format, DETAIL),
    Row("name", TEXT, lambda x: x.table.name, DATA),
    maybe("order", COUNT, lambda x: _number(x.order), DATA),
    _count("declared_order", lambda x: x.table.order),
    maybe("embedded_order", COUNT, lambda x: _number(x.embedded_order), DATA),
    _count("declared_embedded", lambda x: x.table.embedded_order),
    _count("nonautonomous_order", lambda x: _number(x.nonautonomous_order)),
    Row("findings", parts(OF_TABLE), lambda x: x.findings, DATA),
    Row("findings_in_words", rows_of(remark_rows), lambda x: x.findings, DETAIL),
    title=place_and_orders,
)
WRONG: Section[tuple[Audited | TableSubject, Sequence[Remark]]] = Section(
    Row("findings_in_words", rows_of(remark_rows), lambda x: x[1]),
    title=lambda x, d: place_and_orders(x[0], d),
)
SUMMARY: Section[Sequence[Audited]] = Section(
    Row("tables", COUNT, len), Row("wrong", COUNT, _errors), Row("unread", COUNT, _unread)
)
REPORT: Report[Audit] = Report.only(
    "gark/audit/1",
    "report of gark audit",
    Section(
        answer(_answer),
        Row("tables", parts(TABLE), lambda x: x.tables, DETAIL),
        Row("wrong_tables", shown(WRONG, MOST), lambda x: x.wrong, label="tables", is_short=True),
        Row("summary", part(SUMMARY), lambda x: x.tables, DATA),
    ),
)


def _findings(tables: Sequence[Audited]) -> Iterator[Finding]:
    for found in tables:
        file = PurePath(found.table.source).as_posix()
        name = found.table.name
        for x in found.findings:
            key = fingerprint(f"{file}\0{name}\0{x.code}")
            message = f"{name or 'a table'}: {x.message}"
            remark = replace(x, message=message, line=found.table.line, column=1)
            yield Finding(remark, x.code, file, key)


def _rendered(
    tables: Sequence[Audited],
    look: Look = PLAIN,
    verbosity: int = 0,
    width: int = 80,
    format: str = "text",
) -> str:
    audit, verbosity = Audit(tables, verbosity < 0), max(verbosity, 0)
    return REPORT.render([audit], format, look, verbosity, width=width)


def _github(tables: Sequence[Audited], *_: object) -> str:
    """A workflow command for each finding, and the text for the log."""
    told = "".join(f"{x}\n" for x in [annotation(x) for x in _findings(tables)])
    return told + commands_off(_rendered(tables, verbosity=-1))


FORMATS: Mapping[str, Callable[..., str]] = {
    **{format: partial(_rendered, format=format) for format in TOLD},
    "github": _github,
    "sarif": lambda tables, *_: log_of(list(_findings(tables)), "audit"),
}
