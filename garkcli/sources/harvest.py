"""Every array of numbers in a source, scope by scope, with any name."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import PurePath

from garkcli.frozen import Mutable, field, replace
from garkcli.recognise.given import (
    FLOAT,
    MOST_BITS,
    NOTHING,
    PER_DIGIT,
    DeclaredOrder,
    Entry,
    Given,
    Group,
    bits_of,
    bits_of_rounded,
)
from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.evaluate import IN_A_BRANCH, Evaluator
from garkcli.sources.naming import speaks
from garkcli.sources.values import (
    FILL,
    ONE,
    Array,
    Null,
    Number,
    SourceRecord,
    Space,
    Unknown,
    Value,
    items_of,
    whole,
)

MOST_ENTRIES = 2_000
"""Longer arrays are data, not coefficients."""
LARGEST = 1e12
"""Bound on coefficients."""
MOST_LEVELS = 5
MOST_ROOM = 40
"""Longer rows may have unused room behind their numbers."""
_DECIMAL = re.compile(r"[-+]?(\d*)\.?(\d*)(?:e([-+]?\d+))?")
_LONG = re.compile(r"\d+\.(\d{5,})")
_FAMILY = re.compile(
    r"(?P<stem>.*?[^\d_])_?(?P<i>\d{1,4})(?:_(?P<j>\d{1,2}))?(?P<tail>_?[A-Za-z]*)"
)
_ROW = re.compile(r"(?P<stem>.*?[^\d_])_?(?P<i>\d{1,2})(?P<tail>\D*)")
_LETTER = re.compile(r"(?P<letter>[abcw])_(?P<behind>[a-z]\w+)", re.IGNORECASE)
_INDICES = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_SETTER = re.compile(r"set|fill|assign", re.IGNORECASE)
_ORDER = re.compile(
    r"(?:^|[._])(?:p|q|order\w*|rk_?order|expected_order|__order__|p_?order|ord)$", re.IGNORECASE
)
NEAR_ONE = 1e-6
"""Sums of weights that differ from 1 by less are 1."""
MOST_INDEX = 40
MOST_BESIDE = 3
"""Most single numbers tried as a diagonal."""
MOST_ORDER = 20

_Rows = tuple[tuple[Entry, ...], ...]
_Numbers = dict[tuple[int, ...], tuple[Entry, int]]


class Harvester(Evaluator):
    """Evaluates a source and keeps the arrays of each scope.

    Args:
        source: its name.
        format: of its language.
        base, allowance, is_growing, has_whole_quotients: as for an evaluator.

    Attributes:
        groups: the scopes, inner ones first.
        harvest: the numbers of their arrays.
        made, rows: arrays of the last scope assembled from numbers or from rows with related names.
    """

    def __init__(
        self, source: str, format: str, base: int, allowance: Allowance, *is_so: bool
    ) -> None:
        super().__init__(base, allowance, *is_so)
        self.source = source
        self.format = format
        self.groups: list[Group] = []
        self.harvest = Harvest()
        self.made: list[Given] = []
        self.rows: list[Given] = []
        self._before: dict[int, list[Given]] = defaultdict(list)
        self._placed: dict[tuple[int, str], _Numbers] = defaultdict(dict)
        self._handles: dict[int, tuple[int, Space]] = {}

    def replaced(self, scope: ir.Scope, space: Space, name: str) -> None:
        """Harvests an array before a new value replaces it."""
        line = space.lines.get(name, scope.line)
        self._before[id(space)] += self.harvest.arrays(name, space[name], line)

    def refilled(self, scope: ir.Scope, record: SourceRecord, name: str) -> None:
        """Harvests a field before a new value replaces it."""
        del scope
        path = f"{record.key or record.kind}.{name}"
        self._before[0] += self.harvest.arrays(path, record.fields.get(name), self.line)

    def ended(self, scope: ir.Scope, space: Space) -> None:
        """Harvests the arrays of a scope that ends."""
        gathered = Gathered()
        for name, value in space.items():
            self.harvest.gather(name, value, space.lines.get(name, scope.line), gathered)
        for record in space.calls:
            self.harvest.gather(record.key or record.kind, record, record.line, gathered)
        arrays = gathered.arrays
        if isinstance(space.returned, Array | SourceRecord):
            arrays += self.harvest.arrays(scope.name, space.returned, scope.line)
        arrays += self._before.pop(id(space), []) + self._before.pop(0, [])
        for (owner, name), numbers in list(self._placed.items()):
            if owner == id(space):
                del self._placed[owner, name]
                if len({*map(len, numbers)}) == 1:
                    arrays += _filled(name, numbers, scope.line, self.base)
        known = {x.key for x in arrays}
        self.made = [x for x in _families(gathered.singles) if x.key not in known]
        self.rows = list(_of_rows([*arrays, *self.made]))
        arrays = _in_records([*arrays, *self.made, *self.rows])
        arrays = [_with_beside(x, gathered.singles) for x in arrays]
        if not arrays and id(space) not in self._handles:
            return
        around = None if space.up is None else self._handle(space.up)
        names = [*(x.name for x in self._scopes), *(x.name for x in arrays), scope.title]
        is_about_methods = speaks(" ".join([*names, PurePath(self.source).name]))
        place = self._handle(space), around
        unknown = [name for name, x in space.items() if isinstance(x, Array) and _is_lost(x)]
        self.groups.append(
            Group(
                place, scope.line, scope.title, arrays, gathered.orders, is_about_methods, unknown
            )
        )

    def _handle(self, space: Space) -> int:
        """A unique number for a scope, not reused when the scope is gone."""
        return self._handles.setdefault(id(space), (len(self._handles), space))[0]

    def _called(self, call: ir.Call, space: Space) -> Value:
        name = call.callee.name if isinstance(call.callee, ir.Name | ir.Field) else ""
        if len(call.args) in (2, 3) and not call.named and _SETTER.match(name):
            *at, number = [self.value(x, space) for x in call.args]
            places = [n for x in at if (n := whole(x)) is not None and 0 <= n <= MOST_INDEX]
            is_known = isinstance(number, Number) and _is_moderate(number)
            if len(places) == len(at) and isinstance(number, Number) and is_known:
                entry = self.harvest.entry(number)
                self._placed[id(space), name][tuple(places)] = entry, self.line
        return super()._called(call, space)


class Gathered(Mutable):
    """The arrays of a scope.

    Attributes:
        arrays: of numbers.
        singles: single numbers, with their lines.
        orders: integers called orders.
    """

    arrays: list[Given] = field(default_factory=list)
    singles: dict[str, tuple[Entry, int]] = field(default_factory=dict)
    orders: list[DeclaredOrder] = field(default_factory=list)


class Harvest:
    """The numbers of a source.

    Attributes:
        numbers: all numbers, by the places in entries.
    """

    def __init__(self) -> None:
        self.numbers: list[Number] = [FILL, ONE]

    def gather(self, name: str, value: Value, line: int, found: Gathered) -> None:
        """Adds the arrays, single numbers and orders of a value."""
        numbers: Mapping[str, Value] = {name: value}
        if isinstance(value, SourceRecord):
            line = value.line or line
            numbers = {f"{name}.{key}": x for key, x in value.fields.items()}
        for key, x in numbers.items():
            if isinstance(x, Number) and x.is_given and _is_moderate(x):
                entry = self.entry(x)
                found.singles[key] = entry, line
                n = whole(x)
                if n is not None and 1 <= n <= MOST_ORDER and _ORDER.search(key):
                    found.orders.append(DeclaredOrder(key, n, entry.at))
        if isinstance(value, Array | SourceRecord):
            found.arrays += self.arrays(name, value, line)

    def arrays(self, name: str, value: Value | None, line: int, level: int = 0) -> Iterator[Given]:
        """The arrays of numbers in a value, at any depth."""
        if level > MOST_LEVELS:
            return
        if isinstance(value, SourceRecord):
            line = value.line or line
            rows = [x for x in value.fields.values() if isinstance(x, Array)]
            if len(rows) == len(value.fields) > 1 and all(map(str.isdigit, value.fields)):
                yield from self.arrays(name, Array([*rows]), line, level + 1)
                return
            for key, x in value.fields.items():
                yield from self.arrays(f"{name}.{key}" if name else key, x, line, level + 1)
            for i, x in enumerate(value.args):
                yield from self.arrays(f"{name or value.kind}.{i}", x, line, level + 1)
        elif isinstance(value, Array) and 0 < len(value.items) <= MOST_ENTRIES:
            nodes = self._with_nodes(name, value.items, line)
            yield from nodes or self._of_items(name, [*map(_flatter, value.items)], line, level)

    def _with_nodes(self, name: str, items: Sequence[Value], line: int) -> list[Given]:
        """Rows behind their nodes, ``{c, {a, …}}``; empty for other rows."""
        pairs = [x.items for x in items if isinstance(x, Array) and len(x.items) == 2]
        rows = [x[1].items for x in pairs if isinstance(x[1], Array)]
        lengths = [*map(len, rows)]
        if not len(rows) == len(items) > 1 or lengths != sorted(lengths) or lengths[-1] < 2:
            return []
        nodes, known = self._row([x[0] for x in pairs]), [self._row(x) for x in rows]
        found = tuple(x for x in known if x is not None)
        if nodes is None or len(found) < len(known):
            return []
        return [Given(f"{name}.c", line, (nodes,)), Given(f"{name}.A", line, found, is_matrix=True)]

    def _of_items(self, name: str, items: list[Value], line: int, level: int) -> Iterator[Given]:
        inner = [x for x in items if isinstance(x, Array)]
        if not inner:
            row = self._row(items)
            if row is not None:
                # the rest of the room is never written
                written = (i for i, x in enumerate(items) if not _is_empty(x))
                count = len(row) if len(row) <= MOST_ROOM else 1 + max(written, default=0)
                if count > 1 or row[0].value:
                    yield Given(name, line, (row[:count],))
                return
        elif len(items) == 1:
            yield from self.arrays(name, items[0], line, level + 1)
            return
        elif all(isinstance(x, Array) or _is_empty(x) for x in items):
            rows = [self._row(x.items) if isinstance(x, Array) else () for x in items]
            whole_rows = tuple(x for x in rows if x is not None)
            if len(whole_rows) == len(rows) and (len(rows) > 1 or len(whole_rows[0]) > 1):
                if all(len(x) == 1 for x in whole_rows):
                    yield Given(name, line, (tuple(x[0] for x in whole_rows),))
                else:
                    yield Given(name, line, whole_rows, is_matrix=True)
                return
        for i, x in enumerate(items):
            if isinstance(x, Array | SourceRecord):
                yield from self.arrays(f"{name}.{i}", x, line, level + 1)

    def _row(self, items: Iterable[Value]) -> tuple[Entry, ...] | None:
        """A row of numbers; None if one is unknown."""
        entries: list[Entry] = []
        for x in items:
            if isinstance(x, Number) and _is_moderate(x):
                entries.append(self.entry(x))
            elif _is_empty(x) and not isinstance(x, Null):
                entries.append(NOTHING)
            else:
                return None
        return tuple(entries)

    def value(self, x: Given) -> Value:
        """An array of the numbers in the source."""
        rows = [Array([self.numbers[entry.at] for entry in row]) for row in x.rows]
        return Array([*rows]) if x.is_matrix else rows[0]

    def entry(self, x: Number) -> Entry:
        """A number with the precision of its text."""
        if x is FILL or x.is_zero:
            return NOTHING
        self.numbers.append(x)
        at, least = len(self.numbers) - 1, abs(x.near) * FLOAT
        if x.written is None:
            return Entry(x.near, least, 20.0 if x.value is None else bits_of(x.value), at)
        text = x.written.text.strip("()").lower()
        plain = _DECIMAL.fullmatch(text)
        if plain:
            digits = len((plain[1] + plain[2]).lstrip("0"))
            unit = 10.0 ** (int(plain[3] or 0) - len(plain[2])) if digits < 19 else 0.0
            places = len(plain[2]) - int(plain[3] or 0)
            rounded = bits_of_rounded(Fraction(x.near), places) if 0 < places < 19 else MOST_BITS
            return Entry(x.near, max(unit, least), min(rounded, PER_DIGIT * digits), at)
        places = min((len(d) for d in _LONG.findall(text)), default=0)
        if places:
            # computed from decimals
            unit = 3 * 10.0**-places * max(1.0, abs(x.near))
            return Entry(x.near, max(unit, least), min(MOST_BITS, PER_DIGIT * places), at)
        return Entry(x.near, least, min(40.0, 1.5 * len(text)), at)


def _families(singles: Mapping[str, tuple[Entry, int]]) -> Iterator[Given]:
    """Arrays of numbers with names that differ in their indices: ``a21``, ``b_1``."""
    families: dict[tuple[str, int], _Numbers] = defaultdict(dict)
    beside: dict[str, list[Entry]] = defaultdict(list)
    for name, (entry, line) in singles.items():
        match = _FAMILY.fullmatch(name.translate(_INDICES))
        if match is None:
            beside[name.rpartition(".")[0]].append(entry)
            continue
        stem = f"{match['stem']}{match['tail']}"
        i, j = match["i"], match["j"]
        if j is not None:
            families[stem, 2][int(i), int(j)] = entry, line
            continue
        if len(i) > 1:
            cut = len(i) - 1 - (len(i) == 4)
            families[stem, 2][int(i[:cut]), int(i[cut:])] = entry, line
        if len(i) == 1 or (len(i) == 2 and i[0] != "0"):
            families[stem, 1][(int(i),)] = entry, line
    for (stem, indices), numbers in families.items():
        if indices == 1 and (10,) not in numbers:
            # c21 beside c2 has two indices
            numbers = {at: x for at, x in numbers.items() if at[0] < 10}
        highest = max((max(at) for at in numbers), default=0)
        is_sparse = indices == 1 and (len(numbers) < 2 or len(numbers) < 0.4 * highest)
        if highest <= MOST_INDEX and not is_sparse and (len(numbers) > 1 or highest == 2):
            line = min(line for _, line in numbers.values())
            first = 0 if any(0 in at for at in numbers) else 1
            others = [x for x in beside[stem.rpartition(".")[0]] if not x.value.is_integer()]
            for x in _filled(stem, numbers, line, first):
                yield replace(x, beside=tuple(others[:MOST_BESIDE])) if x.is_matrix else x


def _with_beside(x: Given, singles: Mapping[str, tuple[Entry, int]]) -> Given:
    """A matrix with the single numbers of its record, one of which may be its diagonal."""
    if not x.is_matrix or x.beside or len(x.rows) < 2:
        return x
    of = [e for name, (e, _) in singles.items() if name.rpartition(".")[0] == x.owner]
    of = [e for e in of if not e.value.is_integer()]
    return replace(x, beside=tuple(of)) if 0 < len(of) <= MOST_BESIDE else x


def _filled(name: str, numbers: _Numbers, line: int, first: int) -> Iterator[Given]:
    """An array of numbers at given places, with zeros elsewhere."""
    last = max(max(at) for at in numbers)
    indices = range(min(first, last), last + 1)

    def entry(*at: int) -> Entry:
        return numbers[at][0] if at in numbers else NOTHING

    if all(len(at) == 1 for at in numbers):
        yield Given(name, line, (tuple(entry(i) for i in indices),), is_made=True)
    else:
        rows = tuple(tuple(entry(i, j) for j in indices) for i in indices)
        heads = rows[: 1 + max(i for i, *_ in numbers) - indices[0]]
        if len(heads) == 2 < len(rows) and all(_is_one(x) for x in heads):
            # b11 to b23 are two rows of weights
            for i, row in enumerate(heads, start=1):
                yield Given(f"{name}{i}", line, (row,), is_made=True)
            return
        yield Given(name, line, rows, is_matrix=True, is_made=True)


def _is_one(row: Sequence[Entry]) -> bool:
    """Whether a row has the sum 1."""
    return abs(sum(x.value for x in row) - 1) < NEAR_ONE


def _of_rows(arrays: Sequence[Given]) -> Iterator[Given]:
    """Matrices of rows with numbers in their names: ``a2``, ``a3``, …"""
    families: dict[str, dict[int, Given]] = defaultdict(dict)
    for x in arrays:
        match = None if x.is_matrix else _ROW.fullmatch(x.name)
        if match is not None:
            families[f"{match['stem']}{match['tail']}"][int(match["i"])] = x
    for stem, rows in families.items():
        numbers = sorted(rows)
        lengths = [len(rows[i].rows[0]) for i in numbers]
        are_growing = all(y - x == 1 for x, y in pairwise(lengths))
        is_gapless = numbers[-1] - numbers[0] + 1 == len(numbers) > (1 if lengths == [1, 2] else 2)
        if is_gapless and (are_growing or len({*lengths}) == 1):
            of = tuple(rows[i].rows[0] for i in numbers)
            yield Given(stem, rows[numbers[0]].line, of, is_matrix=True, is_made=True)


def _in_records(arrays: Sequence[Given]) -> list[Given]:
    """Renames arrays that share a suffix after a letter, ``a_im`` and ``b_im``, to fields of a
    record, ``im.a`` and ``im.b``, if a matrix and weights are among them.
    """
    parts = {x.name: match for x in arrays if (match := _LETTER.fullmatch(x.name))}
    heads: dict[str, set[str]] = defaultdict(set)
    spelled: dict[str, str] = {}
    for match in parts.values():
        heads[match["behind"].lower()].add(match["letter"].lower())
        spelled.setdefault(match["behind"].lower(), match["behind"])
    records = {tail for tail, of in heads.items() if "a" in of and of & {"b", "w"}}

    def placed(x: Given) -> Given:
        match = parts.get(x.name)
        if match is None or match["behind"].lower() not in records:
            return x
        return replace(x, name=f"{spelled[match['behind'].lower()]}.{match['letter']}")

    return [placed(x) for x in arrays]


def _flatter(value: Value) -> Value:
    """A row without brackets around its single numbers."""
    items = items_of(value)
    inner = [x for x in items if isinstance(x, Array)]
    if len(items) < 2 or not inner or any(len(x.items) != 1 for x in inner):
        return value
    return Array([x.items[0] if isinstance(x, Array) else x for x in items])


def _is_moderate(x: Number) -> bool:
    """Whether a number may be a coefficient; this excludes infinities from comparisons."""
    return math.isfinite(x.near) and abs(x.near) < LARGEST


def _is_lost(value: Array) -> bool:
    """Whether a row of numbers was written, and one of them is unknown."""
    items = value.items
    return len(items) > 1 and any(isinstance(x, Unknown) and not _is_empty(x) for x in items)


def _is_empty(value: Value) -> bool:
    """Whether nothing was written at a place, except in another branch of the program."""
    is_unset = isinstance(value, Unknown) and (
        value.reason == "never assigned" or (value.reason == IN_A_BRANCH and not value.was_written)
    )
    return value is FILL or is_unset or isinstance(value, Null)
