"""``gark import``: what was found in sources, declared once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from garkcli.bridges.collecting import Result
from garkcli.bridges.finding import AuditFinding
from garkcli.bridges.subject import Subject
from garkcli.errors import counted
from garkcli.frozen import replace
from garkcli.report.audited import FINDING, MOST, WRONG
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Answer, Level, Row, Section, Status, maybe
from garkcli.tell.kinds import COUNT, POSITION, TEXT, TEXTS
from garkcli.tell.parts import parts, picture, shown
from garkcli.tell.report import Report

DETAIL, DATA = Level.DETAIL, Level.DATA
ORDER = replace(COUNT, absent="no method")


class Found(NamedTuple):
    """A result with the file that it was written to."""

    result: Result
    file: str | None

    @property
    def name(self) -> str:
        """What people call it."""
        return self.result.table.name or self.result.stem

    def order(self, of: str) -> Answer:
        """An order of its method, as its digits let it be known."""
        method = self.result.method
        found = None if method is None else getattr(method, of)
        if method is None or found is None:
            return Answer(None)
        return Answer(found.order, Status(method.tolerance or None, found.is_limited))


def all_found(results: Sequence[Result], files: Mapping[int, str]) -> list[Found]:
    """Results in order, with where each was written, by its number from 0."""
    return [Found(x, files.get(k)) for k, x in enumerate(results)]


def _notes(found: Sequence[Found]) -> list[tuple[str, str]]:
    """What people should know of each."""
    return [(x.name, note) for x in found for note in x.result.notes()]


def _wrong(found: Sequence[Found]) -> list[tuple[Subject, Sequence[AuditFinding]]]:
    """The methods that are not what their sources declare."""
    results = (x.result for x in found)
    return [(x.method, x.errors) for x in results if x.method is not None and x.errors]


def _title(found: Sequence[Found], _: Plain) -> str:
    """How many methods there are, and how many are wrong."""
    told = counted(sum(x.result.method is not None for x in found), "method")
    wrong = len(_wrong(found))
    return f"{told}, {wrong} wrong" if wrong else told


def _texts(found: Sequence[Found], _: Plain) -> list[str]:
    """The method files."""
    return [line for x in found if x.result.method for line in x.result.method.text.splitlines()]


SIZES = (
    Row("stages", COUNT, "result.table.stages"),
    Row("colours", COUNT, "result.table.colours"),
    maybe("order", ORDER, lambda x: x.order("order")),
    maybe("embedded_order", COUNT, lambda x: x.order("embedded_order")),
)
METHOD = Section(
    Row("source", TEXT, "result.table.source"),
    Row("line", POSITION, "result.table.line"),
    Row("format", TEXT, "result.table.format"),
    Row("name", TEXT, "result.table.name"),
    maybe("file", TEXT),
    *SIZES,
    Row("notes", TEXTS, lambda x: [*x.result.notes()]),
    Row("findings", parts(FINDING), "result.errors"),
)
LINE = Section(
    Row("name", TEXT, label=""),
    *SIZES,
    Row("source", TEXT, lambda x: f"{x.result.table.source}:{x.result.table.line}"),
    Row("file", TEXT),
)
NOTE = Section(Row("name", TEXT, "0", label=""), Row("notes", TEXT, "1"))
REPORT: Report[Sequence[Found]] = Report.only(
    "gark/import/1",
    "report of gark import",
    Section(
        Row("methods", parts(METHOD), ".", DATA),
        Row("name", shown(LINE, 0), "."),
        Row("name", shown(NOTE, 0), _notes),
        Row("wrong_methods", shown(WRONG, MOST), _wrong, label="methods", is_short=True),
        Row("texts", picture(_texts), ".", DETAIL),
        title=_title,
    ),
)


def yaml_text(results: Sequence[Result]) -> str:
    """The method files, parted as YAML parts documents."""
    return "---\n".join(x.method.text for x in results if x.method is not None)
