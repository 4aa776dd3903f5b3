"""Repairs of a sign, digit or number of a source, tried in its text, which is read again.

A repair is certain if exactly one table of the new text differs and has no error, and no other
repair of that size gives it the same orders.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from flint import fmpq

from garkcli.bridges.audit import Audited, audit, repairs_of, subject_of
from garkcli.bridges.elsewhere import declared_orders, with_declared
from garkcli.bridges.misprints import Wanted, mistyped, places, written
from garkcli.bridges.readers.registry import find_tables, readers_for
from garkcli.bridges.sources import source_text
from garkcli.bridges.subject import TableSubject, read
from garkcli.check.culprit import misprints
from garkcli.doing import doing
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.files import is_stream, read_bytes
from garkcli.frozen import Frozen
from garkcli.order.sums import WrongSum, wrong_rows
from garkcli.sources.found import MAX_CHARACTERS, FoundTable
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.tableau import Tableau

MOST_TRIED = 100
REACH = 400
"""Lines around the first line of a table that may hold its numbers."""
SLOPE = 1000
"""Conditions of a rounded table determine a number up to so many times the rounding."""
ROUGHLY = fmpq(1, 10**6)
"""Relative error of a new number of a Rosenbrock method."""
SURE_ORDER = 3
"""Least order at which a new value of an entry is certain: lower ones have few conditions."""
LEAST_ORDER = 2
"""Least order whose restoration is evidence for a number."""
_NAMED = re.compile(r"(\w+)[\"']?(?:\[[^\]=]*\])*\s*[:=](?![:=])")


class Mended(Frozen):
    """``wrong`` tables have errors, ``mended`` ones were repaired; ``before`` is empty for texts
    that are not UTF-8 or begin with a byte order mark.
    """

    source: str
    before: str
    after: str
    wrong: int
    mended: int


class _Edit(Frozen):
    """``place`` is the line, and the column of the repair, from 0."""

    text: str
    place: tuple[int, int]
    is_estimate: bool

    def carried_out(self, text: str) -> str:
        lines = text.split("\n")
        lines[self.place[0]] = self.text
        return "\n".join(lines)


def mended_sources(found: Iterable[Audited], paths: Iterable[str]) -> Iterator[Mended]:
    """Sources with errors, with the certain repairs; no file changes."""
    wrong = Counter(x.table.source for x in found if x.has_errors)
    orders = declared_orders(paths)
    for source, count in wrong.items():
        if is_stream(source):
            continue  # standard input cannot be written back
        text = _text_of(source)
        if text:
            with doing(source):
                yield _mended(source, text, orders)
        else:
            yield Mended(source, text, text, count, 0)


def _text_of(source: str) -> str:
    """The text with its line ends; empty if it is not UTF-8."""
    parsed, _ = source_text(source)
    try:
        text = read_bytes(source, MAX_CHARACTERS).decode("utf-8")
    except UnicodeDecodeError:
        return ""
    # the parsed text has no byte order mark
    return text if text == parsed else ""


def _mended(source: str, text: str, orders: Mapping[str, int]) -> Mended:
    def tables_in(text: str) -> list[FoundTable]:
        tables = find_tables(text, source, readers_for(source))
        return list(with_declared(tables, text, orders))

    tables, before, wrong, mended = tables_in(text), text, 0, 0
    for k in range(len(tables)):
        verdict = audit(tables[k])
        if verdict is None or not verdict.has_errors:
            continue
        wrong += 1
        better = _better(text, tables, k, verdict, tables_in)
        if better:
            text, tables, mended = better, tables_in(better), mended + 1
    return Mended(source, before, text, wrong, mended)


def _better(
    text: str,
    tables: Sequence[FoundTable],
    k: int,
    found: Audited,
    tables_in: Callable[[str], list[FoundTable]],
) -> str:
    is_other = found.table.is_multirate or found.table.form
    if found.method is None or found.order is None or is_other:
        return ""
    wanted, before = list(_wanted_in(tables[k])), _orders(found)
    for is_whole in (False, True):
        edits = dict.fromkeys(_edits(text, tables[k].line, wanted, is_whole))
        fitting = _fitting(edits, text, tables, k, tables_in)
        if fitting is None:
            return ""
        best = max((orders for orders, _ in fitting), default=before)
        fitting = [(orders, edit) for orders, edit in fitting if orders == best]
        # the sum of weights, one condition, has many solutions
        changed = [x for x, y in zip(best, before, strict=True) if x != y]
        if len({edit.place for _, edit in fitting}) == 1:
            is_sure = best >= before and min(changed, default=LEAST_ORDER) >= LEAST_ORDER
            return fitting[0][1].carried_out(text) if is_sure else ""
        if fitting:
            return ""
    return ""


def _fitting(
    edits: Iterable[_Edit],
    text: str,
    tables: Sequence[FoundTable],
    k: int,
    tables_in: Callable[[str], list[FoundTable]],
) -> list[tuple[tuple[int, int], _Edit]] | None:
    fitting, elsewhere, tried = [], set(), 0
    for edit in edits:
        if edit.place in elsewhere:
            continue
        tried += 1
        if tried > MOST_TRIED:
            return None
        others = tables_in(edit.carried_out(text))
        if others == tables:
            elsewhere.add(edit.place)
        if not _differs_alone(tables, others, k):
            continue
        again = audit(others[k])
        if again is None or not again.is_read or again.has_errors:
            continue
        if not edit.is_estimate or _has_estimate(others[k]):
            fitting.append((_orders(again), edit))
    return fitting


def _differs_alone(tables: Sequence[FoundTable], others: Sequence[FoundTable], k: int) -> bool:
    if len(tables) != len(others):
        return False
    return [i for i, (x, y) in enumerate(zip(tables, others, strict=True)) if x != y] == [k]


def _has_estimate(table: FoundTable) -> bool:
    rows = zip(table.b, table.embedded or (), strict=False)
    pairs = [pair for row in rows for pair in zip(*row, strict=True)]
    return all(y == x or y.startswith((f"{x} - (", f"{x} + (")) for x, y in pairs)


def _orders(found: Audited) -> tuple[int, int]:
    assert found.order is not None
    return found.order.order, 0 if found.embedded_order is None else found.embedded_order.order


def _wanted_in(table: FoundTable) -> Iterator[Wanted]:
    if table.gamma is None:
        yield from _wanted(subject_of(table, read(table)))
        return
    from garkcli.bridges.rosenbrock import with_row_orders  # few sources have them

    subject = with_row_orders(table)
    for x in misprints(subject.method, subject.order, table.order):
        # the table is read again, and has no error then
        yield Wanted(x.old, x.new, abs(x.new) * ROUGHLY, False, None)


def _wanted(subject: TableSubject) -> Iterator[Wanted]:
    """The numbers that may be wrong, with the values that would mend the table."""
    tableau, table, rounding = subject.tableau, subject.table, subject.rounded.tolerance
    allowed = (1 + sum(space.stages for space in tableau.spaces)) * rounding

    def values(
        pairs: Iterable[tuple[Number, Number]],
        is_sure: bool = False,
        slope: int = 1,
        is_estimate: bool | None = None,
    ) -> Iterator[Wanted]:
        for old, new in pairs:
            if not (isinstance(old, fmpq) and isinstance(new, fmpq)):
                continue
            # a long number is no misprint of 0
            if abs(new - old) > allowed and (old or not rounding):
                yield Wanted(old, new, slope * allowed, is_sure, is_estimate)

    rows = list(wrong_rows(subject.rounded.defects, tableau.edges()))
    if len(rows) == 1:
        (row,) = rows
        entries = _entries(tableau, row)
        is_met = not rounding and not subject.misses_order and subject.order.order >= SURE_ORDER
        yield from values([(row.wanted, row.total)], is_sure=is_met)
        yield from values((x, x - row.off) for x in entries)
    embedded = subject.method.embedded or ()
    weights = [colour.b for colour in tableau.colours]
    for b in weights:
        yield from values((x, x + ONE - sum(b, ZERO)) for x in b)
    for b, other in zip(weights, embedded, strict=False):
        total = sum(other, ZERO)
        yield from values(((x, x + ONE - total) for x in other), is_estimate=False)
        # a source holds differences for an estimate, with either sign, or numbers that look like
        # weights
        pairs = [
            (s * (x - y), s * (x - y + total - ONE))
            for s in (1, -1)
            for x, y in zip(b, other, strict=True)
        ]
        yield from values([*pairs, *((x, x - total) for x in other)], is_estimate=True)
    if subject.misses_order or rows:
        entries_and_certainty = _blamed(subject, tableau, table.order, is_embedded=False)
        yield from values(*entries_and_certainty, slope=SLOPE)
    elif subject.embedded_order is not None:
        entries_and_certainty = _blamed(
            subject, with_weights(tableau, embedded), table.embedded_order, is_embedded=True
        )
        yield from values(*entries_and_certainty, slope=SLOPE, is_estimate=False)


def _entries(tableau: Tableau, row: WrongSum) -> Vector:
    assert row.m is not None
    assert row.i is not None
    return (tableau.block(row.l, row.m) or ())[row.i]


def _blamed(
    subject: TableSubject, tableau: Tableau, declared: int | None, is_embedded: bool
) -> tuple[list[tuple[Number, Number]], bool]:
    found = subject.embedded_order if is_embedded else subject.order
    if is_embedded and not declared:
        return [], False
    repairs, order, is_exact = repairs_of(subject, tableau, found, declared, is_embedded)
    is_sure = len(repairs) == 1 and order >= SURE_ORDER and is_exact
    return [(x.old, x.new) for x in repairs], is_sure


def _edits(text: str, line: int, wanted: Sequence[Wanted], is_whole: bool) -> Iterator[_Edit]:
    """Lines with one repair each, nearest first: the new number, or another sign or digit."""
    lines = text.split("\n")
    first = max(line - 1 - REACH, 0)
    all_places = [
        place
        for n, part in enumerate(lines[first : line + REACH], first)
        for place in places(part, n)
    ]
    for place in sorted(all_places, key=lambda x: abs(x.line + 1 - line)):
        value, old, start = place.value, lines[place.line], place.tokens[0].start()
        for each in wanted:
            if value != abs(each.old) or (is_whole and not each.is_sure):
                continue
            before = [*lines[max(place.line - REACH, 0) : place.line], old[:start]]
            is_estimate = _is_in_estimate(before)
            if each.is_estimate not in (None, is_estimate):
                continue
            for new in written(old, place, each) if is_whole else mistyped(old, place, each):
                yield _Edit(new, (place.line, start), is_estimate)


def _is_in_estimate(before: Sequence[str]) -> bool:
    named = (_NAMED.findall(line) for line in reversed(before))
    name = next((names[-1] for names in named if names), "")
    return "err" in name.lower() or name in {"E", "e", "evec"}
