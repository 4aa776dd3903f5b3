"""``gark import``: tables found in sources, declared once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from garkcli.bridges.collecting import TableResult
from garkcli.bridges.judging import Judged
from garkcli.bridges.subject import TableSubject
from garkcli.errors import Remark, counted
from garkcli.report.audited import MOST, WRONG
from garkcli.report.remarks import OF_TABLE
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import Answer, Kind, Level, Row, Rows, Section, Words, itself, maybe
from garkcli.tell.kinds import COUNT, POSITION, TEXT, TEXTS
from garkcli.tell.parts import parts, picture, shown
from garkcli.tell.report import Report

DETAIL, DATA = Level.DETAIL, Level.DATA
ORDER: Kind[int] = Kind(COUNT.what, Words(lambda x, _: str(x), absent="no method"))


class ImportedMethod(NamedTuple):
    result: TableResult
    file: str | None

    @property
    def name(self) -> str:
        return self.result.table.name or self.result.stem

    def order(self, get: Callable[[TableSubject], Judged | None]) -> Answer[int]:
        """The order, as far as the digits of the method determine it."""
        method = self.result.method
        found = None if method is None else get(method)
        if method is None or found is None:
            return Answer(None)
        return Answer(found.order, Status(method.tolerance or None, found.is_limited))


def all_found(results: Sequence[TableResult], files: Mapping[int, str]) -> list[ImportedMethod]:
    return [ImportedMethod(x, files.get(k)) for k, x in enumerate(results)]


def _notes(found: Sequence[ImportedMethod]) -> list[tuple[str, str]]:
    return [(x.name, note) for x in found for note in x.result.notes()]


def _wrong(found: Sequence[ImportedMethod]) -> list[tuple[TableSubject, Sequence[Remark]]]:
    results = (x.result for x in found)
    return [(x.method, x.errors) for x in results if x.method is not None and x.errors]


def _title(found: Sequence[ImportedMethod], _: Plain) -> str:
    told = counted(sum(x.result.method is not None for x in found), "method")
    wrong = len(_wrong(found))
    return f"{told}, {wrong} wrong" if wrong else told


def _texts(found: Sequence[ImportedMethod], _: Plain) -> list[str]:
    return [line for x in found if x.result.method for line in x.result.method.text.splitlines()]


SIZES: Rows[ImportedMethod] = (
    Row("stages", COUNT, lambda x: x.result.table.stages),
    Row("colours", COUNT, lambda x: x.result.table.colours),
    maybe("order", ORDER, lambda x: x.order(lambda m: m.order)),
    maybe("embedded_order", COUNT, lambda x: x.order(lambda m: m.embedded_order)),
)
METHOD: Section[ImportedMethod] = Section(
    Row("source", TEXT, lambda x: x.result.table.source),
    Row("line", POSITION, lambda x: x.result.table.line),
    Row("format", TEXT, lambda x: x.result.table.format),
    Row("name", TEXT, lambda x: x.result.table.name),
    maybe("file", TEXT, lambda x: x.file),
    SIZES,
    Row("notes", TEXTS, lambda x: [*x.result.notes()]),
    Row("findings", parts(OF_TABLE), lambda x: x.result.errors),
)
LINE: Section[ImportedMethod] = Section(
    Row("name", TEXT, lambda x: x.name, label=""),
    SIZES,
    Row("source", TEXT, lambda x: f"{x.result.table.source}:{x.result.table.line}"),
    Row("file", TEXT, lambda x: x.file),
)
NOTE: Section[tuple[str, str]] = Section(
    Row("name", TEXT, lambda x: x[0], label=""), Row("notes", TEXT, lambda x: x[1])
)
REPORT: Report[Sequence[ImportedMethod]] = Report.only(
    "gark/import/1",
    "report of gark import",
    Section(
        itself("methods", parts(METHOD), DATA),
        itself("name", shown(LINE, 0)),
        Row("name", shown(NOTE, 0), _notes),
        Row("wrong_methods", shown(WRONG, MOST), _wrong, label="methods", is_short=True),
        itself("texts", picture(_texts), DETAIL),
        title=_title,
    ),
)


def yaml_text(results: Sequence[TableResult]) -> str:
    return "---\n".join(x.method.text for x in results if x.method is not None)
