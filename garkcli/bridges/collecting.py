"""The tables of sources as methods with distinct names."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain, count
from pathlib import PurePath

from garkcli.bridges.audit import is_unrecognised, settled
from garkcli.bridges.claiming import imported
from garkcli.bridges.elsewhere import declared_orders, with_bases, with_declared
from garkcli.bridges.limited import read_within_limits
from garkcli.bridges.plausible import is_plausible
from garkcli.bridges.readers.registry import demand_grammars, find_tables, reader_named, readers_for
from garkcli.bridges.recognising import Recognised, recognised
from garkcli.bridges.sources import STDIN_NAME
from garkcli.bridges.subject import TableSubject
from garkcli.errors import MethodFileError, Remark
from garkcli.exact.display import decimal
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.folders import no_one
from garkcli.page.plaintext import plain_line
from garkcli.sources.finder import UNRECOGNISED
from garkcli.sources.found import FoundTable

SUFFIX = ".gark.yaml"
_SAID = {"unread", "sign"}
_SMALL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


class TableResult(Frozen, eq=False):
    """A table with its method; ``trouble`` says why there is none. ``stem`` names its file
    uniquely.
    """

    table: FoundTable
    stem: str = ""
    method: TableSubject | None = None
    recognised: Recognised | None = None
    trouble: str = ""

    @property
    def errors(self) -> Sequence[Remark]:
        """Findings that contradict the source, or that no method can have."""
        findings = () if self.method is None else self.method.findings
        return [x for x in findings if x.level == "error" or x.claims]

    @property
    def file_name(self) -> str:
        return f"{self.stem}{SUFFIX}"

    def notes(self) -> Iterator[str]:
        yield from self.table.notes
        if self.trouble:
            yield self.trouble
        if self.method is None:
            return
        tolerance = self.method.tolerance
        if tolerance:
            yield f"coefficients are rounded: tolerance {decimal(tolerance)}"
        remarks = [x for x in self.method.findings if x not in self.errors and x.code not in _SAID]
        yield from (x.message for x in remarks)
        if self.method.sign:
            yield self.method.sign
        if self.method.order.is_open and not any(x.code == "open" for x in remarks):
            yield f"its digits do not decide whether it has order {self.method.order.order + 1}"
        if self.recognised is not None:
            yield from self.recognised.notes()


def collected(
    paths: Iterable[str],
    format: str | None = None,
    is_recognising: bool = False,
    is_as_found: bool = False,
    left_out: Callable[[FoundTable], None] = no_one,
) -> Iterator[TableResult]:
    """``left_out`` receives tables that may be no methods; UsageProblem for unreadable sources."""
    if format is not None:
        reader_named(format)
    used: set[str] = set()
    sources = list(paths)
    demand_grammars(sources, format)
    work = partial(_tables, format=format, orders=declared_orders(sources), others=sources)
    for table in read_within_limits(sources, work):
        if table.is_unlike:
            continue
        table = settled(table)
        name = plain_line(table.name) or default_name(table.source)
        result = _result(table, name, is_recognising, is_as_found)
        method = result.method
        is_other = method is not None and not is_plausible(table, method.method)
        # with a named format all arrays are meant
        if is_other and format is None:
            left_out(table)
            continue
        yield replace(result, stem=_unique(stem_of(name), used))


def _tables(
    text: str, source: str, format: str | None, orders: Mapping[str, int], others: Sequence[str]
) -> list[FoundTable]:
    chosen = readers_for(source) if format is None else [reader_named(format)]
    tables = with_bases(find_tables(text, source, chosen), source, others)
    return list(with_declared(tables, text, orders))


def _result(table: FoundTable, name: str, is_recognising: bool, is_as_found: bool) -> TableResult:
    if table.kind:
        return TableResult(table, trouble=f"a {table.kind} table is none of a Runge–Kutta method")
    if table.trouble:
        return TableResult(table, trouble=table.trouble)
    try:
        if table.form is not None:
            from garkcli.bridges.exported import judged_export  # few sources have them

            return TableResult(table, method=judged_export(table, name, is_as_found))
        if table.gamma is not None or table.is_multirate:
            from garkcli.bridges.rosenbrock import imported_row  # few sources have them

            return TableResult(table, method=imported_row(table, name, is_as_found))
        method = imported(table, name, is_as_found)
    except MethodFileError as error:
        return TableResult(table, trouble=error.faults[0].message)
    if table.order and is_unrecognised(method):
        return TableResult(table, trouble=UNRECOGNISED)
    if not is_recognising:
        return TableResult(table, method=method)
    recognition = recognised(method, name, is_as_found)
    return TableResult(table, method=recognition.method, recognised=recognition)


def default_name(source: str) -> str:
    if source == STDIN_NAME:
        return "method"
    return PurePath(source).name.split(".")[0] or "method"


def stem_of(name: str) -> str:
    """The stem of a file name: lower case, words joined by hyphens.

    >>> stem_of("RalstonEuler"), stem_of("3/8 rule"), stem_of("...")
    ('ralston-euler', '3-8-rule', 'method')
    """
    words = re.findall("[a-z0-9]+", _SMALL.sub("-", plain_line(name)).lower())
    return "-".join(words)[:60].strip("-") or "method"


def _unique(stem: str, used: set[str]) -> str:
    names = chain([stem], (f"{stem}-{number}" for number in count(2)))
    unused = next(x for x in names if x not in used)
    used.add(unused)
    return unused
