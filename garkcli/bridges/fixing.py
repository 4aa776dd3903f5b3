"""Numbers of a source that another sign, digit or value mends: tried in its text and read again.

A repair is sure where the source that is read again has one table that differs, without an error,
and no other repair of that size gives it the same orders.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import gcd

from flint import fmpq

from garkcli.bridges.audit import MAX_BLAMED, Audited, audit, subject_of
from garkcli.bridges.elsewhere import declared_orders, with_declared
from garkcli.bridges.readers.registry import find_tables, readers_for
from garkcli.bridges.sources import source_text
from garkcli.bridges.subject import Subject, read
from garkcli.doing import doing
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.files import is_stream, read_bytes
from garkcli.frozen import Frozen
from garkcli.methodfile.printed import SLACK
from garkcli.order.blame import Missed, blame_of
from garkcli.order.sums import WrongSum, wrong_rows
from garkcli.sources.found import MAX_CHARACTERS, FoundTable
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.tableau import Tableau

MOST_TRIED = 200
"""So many repairs of a table are read again at most: of more none is sure."""
REACH = 400
"""Lines before and behind the first one of a table that may have its numbers."""
LONGEST = 60
"""Characters of the longest number that is mended."""
SLOPE = 1000
"""A number that conditions of a rounded table ask for may be off by so many times the rounding."""
SURE_ORDER = 3
"""An entry with any other value is sure from this order on: a lower one has few conditions."""
LEAST_ORDER = 2
"""An order that is restored says something of a number from this one on."""
_NUMBER = re.compile(r"(?P<whole>\d+)?(?:\.(?P<part>\d*))?(?:[eEdD](?P<power>[-+]?\d{1,3}))?")
_TOKEN = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d{1,3}(?!\d))?")
_OVER = re.compile(r"[\w.()\s]*/{1,2}[\w.(\s]*")
"""What is between a numerator and its denominator, names of functions and types besides."""
_NAMED = re.compile(r"(\w+)[\"']?(?:\[[^\]=]*\])*\s*[:=](?![:=])")
_MINUS = re.compile(r"-(?=\s*(?:\w+\(\s*)?$)")
"""The sign at the end of what is before a number."""


class Mended(Frozen):
    """A source with repairs.

    Attributes:
        source: its path.
        before: its text.
        after: the same with the repairs; equal where nothing is sure.
        wrong: how many tables have errors.
        mended: how many of these have none any more.
    """

    source: str
    before: str
    after: str
    wrong: int
    mended: int


class _Wanted(Frozen):
    """A value that another number may have to have.

    Attributes:
        old, new: the number in the table.
        allowed: by how much the new one may be another.
        is_sure: whether it may be any other number: otherwise a sign or a digit is wrong.
        is_estimate: whether it is one of an error estimate, False for one of embedded weights;
            None for others.
    """

    old: fmpq
    new: fmpq
    allowed: fmpq
    is_sure: bool = False
    is_estimate: bool | None = None


class _Edit(Frozen):
    """A line with a repair.

    Attributes:
        text: of the line.
        place: its number, and the column of what is mended, from 0.
        is_estimate: whether that is one of an error estimate.
    """

    text: str
    place: tuple[int, int]
    is_estimate: bool

    def carried_out(self, text: str) -> str:
        """A source with the line."""
        lines = text.split("\n")
        lines[self.place[0]] = self.text
        return "\n".join(lines)


class _Place(Frozen):
    """Where a text has a positive number: one token, or two with a quotient between them."""

    line: int
    tokens: tuple[re.Match[str], ...]

    @property
    def value(self) -> fmpq:
        """The number that is there."""
        return self.with_value(0, self.tokens[0][0])

    def with_value(self, k: int, text: str) -> fmpq:
        """The number with another text for token k."""
        values = [_value(text if k == i else x[0]) for i, x in enumerate(self.tokens)]
        return values[0] if len(values) == 1 else values[0] / values[1] if values[1] else ZERO

    def is_as_short(self, k: int, text: str) -> bool:
        """Whether a fraction in lowest terms stays one with another text for token k."""
        texts = [x[0] for x in self.tokens]
        return _common(texts) > 1 or _common([*texts[:k], text, *texts[k + 1 :]]) == 1


def mended_sources(found: Iterable[Audited], paths: Iterable[str]) -> Iterator[Mended]:
    """Every source with errors, with the repairs that are sure; nothing is written.

    Args:
        found: the tables of all sources.
        paths: of the sources.

    Raises:
        UsageProblem: a source cannot be read.
    """
    wrong = dict.fromkeys(x.table.source for x in found if x.has_errors)
    orders = declared_orders(paths)
    for source in wrong:
        # nothing is written back into a stream, nor into text of another encoding
        text = "" if is_stream(source) else _text_of(source)
        if text:
            with doing(source):
                yield _mended(source, text, orders)


def _text_of(source: str) -> str:
    """The text of a file with its line ends; empty where it is no UTF-8."""
    parsed, _ = source_text(source)
    try:
        text = read_bytes(source, MAX_CHARACTERS).decode("utf-8")
    except UnicodeDecodeError:
        return ""
    # what is parsed has no mark at its beginning
    return text if text == parsed else ""


def _mended(source: str, text: str, orders: Mapping[str, int]) -> Mended:
    def tables_in(text: str) -> list[FoundTable]:
        tables = find_tables(text, source, readers_for(source))
        return list(with_declared(tables, text, orders))

    tables, before, wrong, mended = tables_in(text), text, 0, 0
    for k in range(len(tables)):
        found = audit(tables[k])
        if found is None or not found.has_errors:
            continue
        wrong += 1
        better = _better(text, tables, k, found, tables_in)
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
    """The text with the repair of table k; empty where none is sure."""
    if found.method is None or found.order is None or found.table.gamma is not None:
        return ""
    wanted, before = list(_wanted(subject_of(tables[k], read(tables[k])))), _orders(found)
    for is_whole in (False, True):
        edits = dict.fromkeys(_edits(text, tables[k].line, wanted, is_whole))
        fitting = _fitting(edits, text, tables, k, tables_in)
        if fitting is None:
            return ""
        best = max((orders for orders, _ in fitting), default=before)
        fitting = [(orders, edit) for orders, edit in fitting if orders == best]
        # one condition, the sum of weights, is met by many numbers
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
    """The repairs that leave no error in table k, with its orders then; None of too many."""
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
    """Whether table k is the only one that another text of a source has otherwise."""
    if len(tables) != len(others):
        return False
    return [i for i, (x, y) in enumerate(zip(tables, others, strict=True)) if x != y] == [k]


def _has_estimate(table: FoundTable) -> bool:
    """Whether the embedded weights are read as b and an estimate, not as weights."""
    rows = zip(table.b, table.embedded or (), strict=False)
    pairs = [pair for row in rows for pair in zip(*row, strict=True)]
    return all(y == x or y.startswith((f"{x} - (", f"{x} + (")) for x, y in pairs)


def _orders(found: Audited) -> tuple[int, int]:
    """Those of a table and of its embedded weights."""
    assert found.order is not None
    return found.order.order, 0 if found.embedded_order is None else found.embedded_order.order


def _wanted(subject: Subject) -> Iterator[_Wanted]:
    """The numbers of which one may be wrong, with the values that would mend the table."""
    tableau, table, rounding = subject.tableau, subject.table, subject.rounded.tolerance
    allowed = (1 + sum(space.stages for space in tableau.spaces)) * rounding

    def values(
        pairs: Iterable[tuple[Number, Number]],
        is_sure: bool = False,
        slope: int = 1,
        is_estimate: bool | None = None,
    ) -> Iterator[_Wanted]:
        for old, new in pairs:
            if not (isinstance(old, fmpq) and isinstance(new, fmpq)):
                continue
            # a long number is no misprint of 0
            if abs(new - old) > allowed and (old or not rounding):
                is_any = is_sure and not rounding
                yield _Wanted(old, new, slope * allowed, is_any, is_estimate)

    rows = list(wrong_rows(subject.rounded.defects, tableau.edges()))
    if len(rows) == 1:
        (row,) = rows
        entries = _entries(tableau, row)
        is_met = not subject.misses_order and subject.order.order >= SURE_ORDER
        yield from values([(row.wanted, row.total)], is_sure=is_met)
        yield from values((x, x - row.off) for x in entries)
    embedded = subject.method.embedded or ()
    weights = [colour.b for colour in tableau.colours]
    for b in weights:
        yield from values((x, x + ONE - sum(b, ZERO)) for x in b)
    for b, other in zip(weights, embedded, strict=False):
        total = sum(other, ZERO)
        yield from values(((x, x + ONE - total) for x in other), is_estimate=False)
        # of an estimate a source has differences, with either sign, or what looks like weights
        pairs = [
            (s * (x - y), s * (x - y + total - ONE))
            for s in (1, -1)
            for x, y in zip(b, other, strict=True)
        ]
        yield from values([*pairs, *((x, x - total) for x in other)], is_estimate=True)
    if subject.misses_order:
        found = _blamed(subject, tableau, table.order, is_embedded=False)
        yield from values(*found, slope=SLOPE)
    elif subject.embedded_order is not None:
        found = _blamed(
            subject, with_weights(tableau, embedded), table.embedded_order, is_embedded=True
        )
        yield from values(*found, slope=SLOPE, is_estimate=False)


def _entries(tableau: Tableau, row: WrongSum) -> Vector:
    """The entries of a row that is not its node."""
    assert row.m is not None
    assert row.i is not None
    return (tableau.block(row.l, row.m) or ())[row.i]


def _blamed(
    subject: Subject, tableau: Tableau, declared: int | None, is_embedded: bool
) -> tuple[list[tuple[Number, Number]], bool]:
    """Entries with the values that restore a declared order, and whether there is one alone."""
    order = subject.embedded_order if is_embedded else subject.order
    stages = sum(space.stages for space in tableau.spaces)
    if order is None or order.witness is None or stages > MAX_BLAMED or not declared:
        return [], False
    if order.order >= declared:
        return [], False
    rounded = subject.digits.of(tableau, slack=100 * SLACK)
    missed = Missed(order.witness.tree.order, declared, is_embedded=is_embedded)
    blame = blame_of(rounded if rounded.tolerance else tableau, missed)
    repairs = () if blame is None else blame.repairs
    return [(x.old, x.new) for x in repairs], len(repairs) == 1 and declared >= SURE_ORDER


def _edits(text: str, line: int, wanted: Sequence[_Wanted], is_whole: bool) -> Iterator[_Edit]:
    """The text with one repair each, those that are next to the line of the table first.

    Args:
        text: of the source.
        line: where the table begins, from 1.
        wanted: which numbers may be wrong.
        is_whole: whether any other number is put there; otherwise another sign or digit.
    """
    lines = text.split("\n")
    first = max(line - 1 - REACH, 0)
    places = [
        place
        for n, part in enumerate(lines[first : line + REACH], first)
        for place in _places(part, n)
    ]
    for place in sorted(places, key=lambda x: abs(x.line + 1 - line)):
        value, old, start = place.value, lines[place.line], place.tokens[0].start()
        for each in wanted:
            if value != abs(each.old) or (is_whole and not each.is_sure):
                continue
            before = [*lines[max(place.line - REACH, 0) : place.line], old[:start]]
            is_estimate = _is_in_estimate(before)
            if each.is_estimate not in (None, is_estimate):
                continue
            for new in _written(old, place, each) if is_whole else _mistyped(old, place, each):
                yield _Edit(new, (place.line, start), is_estimate)


def _is_in_estimate(before: Sequence[str]) -> bool:
    """Whether the name that is assigned last is one of an error estimate."""
    named = (_NAMED.findall(line) for line in reversed(before))
    name = next((names[-1] for names in named if names), "")
    return "err" in name.lower() or name in {"E", "e", "evec"}


def _places(line: str, number: int) -> Iterator[_Place]:
    """The numbers of a line."""
    tokens = [x for x in _TOKEN.finditer(line) if len(x[0]) <= LONGEST]
    yield from (_Place(number, (x,)) for x in tokens)
    for over, under in pairwise(tokens):
        if _OVER.fullmatch(line[over.end() : under.start()]) and _value(under[0]):
            yield _Place(number, (over, under))


def _mistyped(line: str, place: _Place, wanted: _Wanted) -> Iterator[str]:
    """A line with another sign, or another digit, of a number."""
    start, is_turned = place.tokens[0].start(), wanted.old * wanted.new < 0
    if is_turned:
        if abs(wanted.old + wanted.new) <= wanted.allowed:
            yield _turned(line, start)
        return
    near = [
        (abs(place.with_value(k, text) - abs(wanted.new)), k, text)
        for k, token in enumerate(place.tokens)
        for text in _slips(token[0])
        if _value(text) != _value(token[0]) and place.is_as_short(k, text)
    ]
    for _, k, text in sorted(x for x in near if x[0] <= wanted.allowed)[:3]:
        token = place.tokens[k]
        yield line[: token.start()] + text + line[token.end() :]


def _turned(line: str, start: int) -> str:
    """A line with the other sign of the number at a place."""
    before, after = line[:start], line[start:]
    plain = _MINUS.sub("", before)
    return plain + after if plain != before else f"{before}-{after}"


def _slips(number: str) -> Iterator[str]:
    """A number with one character more, less or another, or with two exchanged."""
    found: dict[str, None] = {}
    for k in range(len(number) + 1):
        head, tail = number[:k], number[k:]
        texts = [head + x + tail for x in "0123456789."]
        if tail:
            texts += [head + tail[1:], *(head + x + tail[1:] for x in "0123456789")]
            texts.append(head + tail[1::-1] + tail[2:])
        found |= dict.fromkeys(texts)
    is_long = number[:1] == "0" and number[1:2].isdigit()
    for text in found:
        # 012 is 10 in some languages
        if _TOKEN.fullmatch(text) and text != number and (is_long or not re.match(r"0\d", text)):
            yield text


def _written(line: str, place: _Place, wanted: _Wanted) -> Iterator[str]:
    """A line with another number, written as the old one is."""
    p, q = abs(int(wanted.new.p)), int(wanted.new.q)
    first, last = place.tokens[0], place.tokens[-1]
    point = re.sub(r"^\d*|[eEdD].*$", "", first[0])
    if len(place.tokens) > 1:
        between = line[first.end() : last.start()]
        new = f"{p}{point}{between}{q}{re.sub(r'^[0-9]*|[eEdD].*$', '', last[0])}"
    else:
        decimal = _decimal(p, q) if point else ""
        end = ".0" if point else ""
        new = decimal or (f"{p}{end}" if q == 1 else f"{p}{end}/{q}{end}")
    changed = line[: first.start()] + new + line[last.end() :]
    yield _turned(changed, first.start()) if wanted.old * wanted.new < 0 else changed


def _common(texts: Sequence[str]) -> int:
    """What whole numbers have in common; 1 of others, and of a single number."""
    values = [_value(x) for x in texts]
    whole = [int(x.p) for x in values if x.q == 1]
    return gcd(*whole) if len(whole) == len(values) > 1 else 1


def _decimal(p: int, q: int) -> str:
    """A short decimal; empty where there is none."""
    places = next((k for k in range(1, 9) if 10**k % q == 0), 0)
    if not places:
        return ""
    digits = str(p * 10**places // q).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def _value(text: str) -> fmpq:
    """The number that a token is, without a sign."""
    found = _NUMBER.fullmatch(text)
    assert found is not None
    whole, part, power = found["whole"] or "", found["part"] or "", int(found["power"] or 0)
    return fmpq(int(f"0{whole}{part}")) * fmpq(10) ** (power - len(part))
