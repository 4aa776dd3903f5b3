"""Readings of the numbers of a source as tables, in addition to those by calls and names."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from garkcli.constructions.registers import FORMS as REGISTERS
from garkcli.frozen import replace
from garkcli.recognise.names import MATRIX, NODES, WEIGHTS
from garkcli.sources.assembling import Meant, NoTable, table_of
from garkcli.sources.finder import STEP, UNRECOGNISED, TableFinder
from garkcli.sources.found import FoundTable, Row, Rows, troubled
from garkcli.sources.overlooked import OTHERS
from garkcli.sources.registers import WRAY
from garkcli.sources.shaping import ZERO, changed, is_zero
from garkcli.sources.signatures import DRIFT_FIRST, NAMED, OTHER_KINDS, Signature
from garkcli.sources.values import Array, Number, Value, computed, integer, items_of

if TYPE_CHECKING:
    from garkcli.arrays import Floats
    from garkcli.recognise.given import Given
    from garkcli.recognise.readings import Reading

_NumbersByRole: TypeAlias = Mapping[str, frozenset[int]]
MOST_OF = 0.75
"""Share of the numbers of a matrix in a reading that contradicts it."""
_BESIDE = frozenset(
    f"{role}{part}"
    for role in ("b", "c", "b_q", "drifts", "kicks", "embedded", "error")
    for part in ("", "1", "2")
)
_TABLEAU = re.compile("tableau|butcher|table|^(?:new|obj|self|this|[0-9]*)$", re.IGNORECASE)
"""Names shared by many methods."""
_OTHERS = frozenset(
    ("Rosenbrock", "modified Patankar", "multirate", "general linear", "exponential", "stochastic")
)
"""Methods with a matrix, weights and other arrays."""
NEAR = 1e-6
"""Sums that differ by less are equal."""
FEWEST_NUMBERS = 4
"""Fewest numbers in arrays that may be a method."""
_FORMS = {
    **{form: Signature([], form) for form in (*REGISTERS, WRAY, "Shu–Osher")},
    "3S*": NAMED,
    "nystrom": NAMED,
    "drift-first": DRIFT_FIRST,
    "composition": DRIFT_FIRST,
    "force-first": Signature(["drifts", "kicks"], "force-first"),
}


def with_readings(finder: TableFinder, tables: Sequence[FoundTable]) -> list[FoundTable]:
    """The tables of a source, each with the readings that may explain its errors, and further
    tables without names if the evidence suffices.
    """
    groups = [x for x in finder.groups if _has_numbers(x.arrays)]
    if not any(_may_have_a_matrix(x) for group in groups for x in group.arrays):
        return list(tables)
    from garkcli.recognise.choosing import readings_of  # numpy takes long to import

    source = _Source(finder)
    written = set(map(id, finder.harvest.numbers))
    numbers_of_tables = [_written_numbers(finder.told.get(id(x), {}), written) for x in tables]
    read_off = [x for x, table in zip(numbers_of_tables, tables, strict=True) if table.is_read]
    everywhere = frozenset(n for x in read_off for own in x.values() for n in own)
    new: list[FoundTable] = []
    made_of: list[_NumbersByRole] = []
    layouts: dict[str, dict[int, str]] = {}
    rivals: dict[int, list[FoundTable]] = {}
    linked: dict[int, float] = {}
    settled: set[int] = set()
    steps = {x.line for x in tables if x.is_read and STEP in x.notes}
    holders: dict[int, frozenset[int]] = {}
    for table, by_role in zip(tables, numbers_of_tables, strict=True):
        order = finder.told.get(id(table), {}).get("order")
        if table.is_read and table.order is not None and order is not None:
            holders[id(order)] = frozenset().union(*by_role.values())
    for reading in readings_of(finder.groups, source.fellows(read_off)):
        # what a table of names has is not idle beside another one
        idle = (x for x in reading.idle if not source.numbers((x,)) <= everywhere)
        reading = replace(reading, idle=tuple(idle))
        numbers = source.numbers(reading.used)
        about = [i for i, x in enumerate(numbers_of_tables) if _is_about(numbers, x)]
        read = [i for i in about if tables[i].is_read]
        bits = reading.linked if reading.form == "rk" else 0.0
        linked |= {i: max(bits, linked.get(i, 0.0)) for i in read}
        errors = source.of_row(reading, "error")
        explained = [
            i
            for i in read
            # a row named b is no difference of weights
            if not reading.idle
            and not (numbers_of_tables[i].get("b", frozenset()) & errors)
            and _explains(reading, numbers, numbers_of_tables[i])
        ]
        is_new = reading.is_enough and not read and not any(tables[i].is_misshapen for i in about)
        # single numbers of a step belong to the step
        group = reading.group
        is_of_step = group is not None and group.line in steps
        is_new = is_new and not (is_of_step and all(x.is_made for x in reading.used))
        # arrays of several tables together are no table
        is_new = is_new and 2 * len(numbers & everywhere) <= len(numbers)
        made_table = source.table(reading) if is_new or explained else None
        if made_table is None:
            continue
        for i in explained:
            if not _is_same(made_table, tables[i]):
                rivals.setdefault(i, []).append(made_table)
        if is_new:
            if reading.declared is not None:
                # a declared order is of one table, in all its readings
                holder = holders.setdefault(source.key(reading.declared.at), numbers)
                is_own = not numbers.isdisjoint(holder)
                made_table = made_table if is_own else replace(made_table, order=None)
            new.append(made_table)
            made_of.append({"": numbers})
            source.learn(reading, layouts)
            settled |= {*about, *_in_place_of(reading, tables)}
    kept = [
        replace(x, rivals=(*x.rivals, *rivals.get(i, ())), linked=float(linked[i]))
        if i in linked
        else x
        for i, x in enumerate(tables)
        if i not in settled
    ]
    known = {n for x in (*numbers_of_tables, *made_of) for own in x.values() for n in own}
    new += source.with_layouts(layouts, known)
    return sorted([*kept, *new, *source.untold([*kept, *new], known)], key=lambda x: x.line)


def _in_place_of(reading: Reading, tables: Sequence[FoundTable]) -> Iterator[int]:
    """The places of unread tables at the lines of a reading."""
    group = reading.group
    lines = {reading.line, *(x.line for x in reading.used), *([group.line] if group else [])}
    for i, x in enumerate(tables):
        if not x.is_read and x.kind not in _OTHERS and x.line in lines:
            yield i


def _has_numbers(arrays: Iterable[Given]) -> bool:
    return sum(len(row) for x in arrays for row in x.rows) >= FEWEST_NUMBERS


def _may_have_a_matrix(x: Given) -> bool:
    return x.is_matrix or len(x.rows[0]) > 1


class _Source:
    """Makes tables from the readings of a source."""

    def __init__(self, finder: TableFinder) -> None:
        self._numbers = finder.harvest.numbers
        self._groups = finder.groups
        self._makers = finder.makers
        self._source, self._format = finder.source, finder.format
        self._texts: dict[int, str] = {}

    def table(self, reading: Reading) -> FoundTable | None:
        """The table of a reading; None if its numbers give none."""
        group = reading.group
        assert group is not None
        owner = reading.used[0].owner.rpartition(".")[2]
        names = [owner, group.title] if not _TABLEAU.search(owner) else [group.title, owner]
        name = next(filter(None, names), reading.used[0].name)
        how = reading.how or "A, b and c by rows"
        note = f"recognised by its numbers: {', '.join(x.name for x in reading.used)}"
        empty = FoundTable(self._source, reading.line, self._format, name, (), (), how=how)
        order = None if reading.declared is None else reading.declared.order
        empty = replace(
            empty, order=order, notes=(note,), is_recognised=True, linked=reading.linked
        )
        empty = replace(empty, idle=tuple(x.name for x in reading.idle))
        if reading.form == "rk":
            kind = _kind(f"{owner} {group.title}")
            return replace(empty, kind=kind) if kind else self._of_rk(reading, empty)
        rows = {role: self._value(x) for role, x in reading.rows.items()}
        if reading.form == "Shu–Osher":
            rows = {"c": rows.pop("alpha"), "A": rows.pop("beta"), **rows}
        if reading.form == "composition":
            rows = _steps(*next(iter(rows.items())), reading.line)
        if reading.form == "nystrom" and "b_q" not in rows:
            return None
        try:
            assembled = table_of(Meant(empty, rows, _FORMS[reading.form], "numbers"))
        except NoTable:
            return None
        if assembled.trouble:
            return None
        return replace(assembled, order=order, how=how, is_recognised=True)

    def _of_rk(self, reading: Reading, empty: FoundTable) -> FoundTable:
        rows = reading.rows
        A = tuple(map(self._row, rows["A"]))
        b = self._row(rows["b"])
        c = self._nodes(rows["c"], A) if "c" in rows else None
        table = replace(empty, A=((A,),), b=(b,), c=(c,))
        if "embedded" in rows:
            return replace(table, embedded=(self._row(rows["embedded"]),))
        if "error" in rows:
            error = self._row(rows["error"])
            low, high = changed("-", b, error), changed("+", b, error)
            return replace(table, embedded=(low,), turned=(high,))
        return table

    def _nodes(self, c: Floats, A: Rows) -> Row:
        """The nodes; a node that is not written is the sum of its row."""
        sums = (" + ".join(f"({x})" for x in row if not is_zero(x)) or ZERO for row in A)
        return tuple(self._text(int(x[-1])) if x[-1] else y for x, y in zip(c, sums, strict=True))

    def _row(self, row: Floats) -> Row:
        return tuple(self._text(int(x[-1])) for x in row)

    def _text(self, at: int) -> str:
        if at not in self._texts:
            self._texts[at] = self._numbers[at].scalar.text
        return self._texts[at]

    def _value(self, x: Floats) -> Value:
        """An array of the numbers in the source."""
        if x.ndim > 2:
            return Array([self._value(row) for row in x])
        return Array([self._numbers[int(entry[-1])] for entry in x])

    def numbers(self, arrays: Iterable[Given]) -> frozenset[int]:
        """A key of the occurrences of numbers in arrays: equal numbers elsewhere have other
        keys.
        """
        entries = (x for of in arrays for row in of.rows for x in row if x.value)
        return frozenset(self.key(x.at) for x in entries)

    def key(self, at: int) -> int:
        """A key of the occurrence of a number."""
        return id(self._numbers[at])

    def fellows(self, tables: Iterable[_NumbersByRole]) -> dict[int, set[int]]:
        """The arrays of the tables with an array, by the ``id`` of each."""
        arrays = [(id(x), self.numbers([x])) for group in self._groups for x in group.arrays]
        of: dict[int, set[int]] = {}
        for table in tables:
            numbers = frozenset().union(*table.values())
            own = {x for x, each in arrays if not numbers.isdisjoint(each)}
            for x in own:
                of.setdefault(x, set()).update(own)
        return of

    def of_row(self, reading: Reading, role: str) -> frozenset[int]:
        """A key of the occurrences of numbers in one row of a reading."""
        row = reading.rows.get(role)
        return frozenset(id(self._numbers[int(x[-1])]) for x in (() if row is None else row))

    def learn(self, reading: Reading, layouts: dict[str, dict[int, str]]) -> None:
        """Adds the roles of the arguments of a call, by their places, from a reading of them; none
        if readings differ.
        """
        of_roles = {role: frozenset(self._keys(self._value(x))) for role, x in reading.rows.items()}
        for _, record in self._makers if reading.form == "rk" else ():
            of_args = [frozenset(self._keys(x)) for x in record.args]
            layout = {of_args.index(x): role for role, x in of_roles.items() if x and x in of_args}
            if len(layout) == len(of_roles) > 1 and not reading.idle:
                is_same = layouts.setdefault(record.kind, layout) == layout
                layouts[record.kind] = layout if is_same else {}

    def with_layouts(
        self, layouts: Mapping[str, Mapping[int, str]], known: set[int]
    ) -> Iterator[FoundTable]:
        """The tables of other calls with the same names as those of readings: too few numbers for
        a reading of their own.

        Args:
            layouts: the roles of their arguments by places.
            known: the numbers of other tables; those of these are added.
        """
        for place, record in self._makers:
            layout = layouts.get(record.kind, {})
            roles = {role: record.args[i] for i, role in layout.items() if i < len(record.args)}
            numbers = {key for x in roles.values() for key in self._keys(x)}
            if not layout or len(roles) < len(layout) or numbers & known:
                continue
            try:
                # another function may have that name
                table = replace(table_of(Meant(place, roles, NAMED, record.kind)), is_sure=False)
            except NoTable:
                continue
            known |= numbers
            yield table

    def _keys(self, value: Value) -> Iterator[int]:
        """Keys of the occurrences of numbers in an array."""
        for x in value.flat() if isinstance(value, Array) else ():
            if isinstance(x, Number) and not x.is_zero:
                yield id(x)

    def untold(self, tables: Iterable[FoundTable], known: set[int]) -> Iterator[FoundTable]:
        """A placeholder for each scope about methods with arrays like those of one, but without a
        table.

        Args:
            tables: of the source.
            known: their numbers; those of the placeholders are added.
        """
        lines = {x.line for x in tables}
        for group in self._groups:
            unread = [x for x in group.arrays if _is_like_a_part(x)]
            unread = [x for x in unread if 2 * len((own := self.numbers([x])) - known) > len(own)]
            values = {abs(x.value) for of in unread for row in of.rows for x in row}
            fractions = sum(not x.is_integer() for x in values)
            is_other = OTHERS.search(group.title) is not None
            if not _may_be_another(unread):
                # interpolants beside a table
                is_other |= not known.isdisjoint(self.numbers(group.arrays))
            least = FEWEST_NUMBERS // 2 if any(x.is_matrix for x in unread) else FEWEST_NUMBERS
            if is_other or not group.speaks or fractions < least:
                continue
            known |= self.numbers(unread)
            if lines.isdisjoint({group.line, *(x.line for x in unread)}):
                line = min(x.line for x in unread)
                place = FoundTable(self._source, line, self._format, group.title, (), (), ())
                yield troubled(place, UNRECOGNISED)


def _is_like_a_part(x: Given) -> bool:
    """Whether an array may belong to a method: by its name, as a triangle, or by its sum."""
    if any(pattern.search(x.name) for pattern in (MATRIX, WEIGHTS, NODES)):
        return x.fractions > 0
    if x.is_matrix:
        return x.fractions > 1 and not any(
            entry.value for i, row in enumerate(x.rows) for entry in row[i + 1 :]
        )
    total = sum(entry.value for entry in x.rows[0])
    return x.fractions > 1 and min(abs(total), abs(total - 1)) < NEAR


def _may_be_another(arrays: Sequence[Given]) -> bool:
    """Whether there are a matrix and weights for it, or two rows of registers."""
    rows = [x.rows[0] for x in arrays if not x.is_matrix]
    has_weights = any(abs(sum(entry.value for entry in row) - 1) < NEAR for row in rows)
    lengths = [len(x.rows[0]) for x in arrays if not (x.is_matrix or x.is_made)]
    return (has_weights and any(x.is_matrix for x in arrays)) or len({*lengths}) < len(lengths)


def _steps(form: str, row: Value, line: int) -> dict[str, Value]:
    """A symmetric composition as drifts and kicks."""
    from garkcli.recognise.compositions import drifts_and_kicks  # numpy takes long to import

    def compute(sign: str, x: Value, y: Value) -> Value:
        return computed(sign, x, y, line)

    drifts, kicks = drifts_and_kicks(form, items_of(row), compute, integer)
    return {"drifts": Array(drifts), "kicks": Array(kicks)}


def _kind(names: str) -> str:
    """The kind of other methods with such names that have a matrix and weights; empty for none."""
    kinds = (kind for pattern, kind in OTHER_KINDS if kind in _OTHERS and pattern.search(names))
    return next(kinds, "")


def _written_numbers(roles: Mapping[str, Value], written: Collection[int]) -> _NumbersByRole:
    """The written numbers of a table, by their roles."""
    arrays = {role: Array([x]).flat() for role, x in roles.items() if isinstance(x, Array)}
    return {
        role: frozenset(
            id(x) for x in of if isinstance(x, Number) and not x.is_zero and id(x) in written
        )
        for role, of in arrays.items()
    }


def _is_about(numbers: frozenset[int], told: _NumbersByRole) -> bool:
    """Whether a reading and a table share most of their numbers; a few may belong to others."""
    all_told = frozenset().union(*told.values())
    common, is_short = 2 * len(numbers & all_told), len(all_told) < FEWEST_NUMBERS
    return common > len(numbers) or (common > len(all_told) and not is_short)


def _explains(reading: Reading, numbers: frozenset[int], told: _NumbersByRole) -> bool:
    """Whether a reading has all nodes and weights of a table, and most of its matrix; embedded
    weights only if its form has them. A few numbers may belong to other tables, too.
    """
    if sum(map(len, told.values())) < FEWEST_NUMBERS:
        return False
    if reading.form == "rk" and "c" in told and not told["c"] and "c" not in reading.rows:
        # nodes that are all zeros count too
        return False
    for role, own in told.items():
        common = len(own & numbers)
        if role.startswith("A") and common < MOST_OF * len(own):
            return False
        if role == "b" and reading.form == "nystrom":
            # rows with the sums c²/2 are its own; weights of a pair may have the name b
            continue
        if role in _BESIDE:
            is_low = role.startswith("e")
            is_had = common > 0 or reading.form != "rk" if is_low else common == len(own)
            if own and not is_had:
                return False
    return True


def _is_same(x: FoundTable, y: FoundTable) -> bool:
    """Whether two tables are the same method."""
    return (x.A, x.b, x.c, x.parts) == (y.A, y.b, y.c, y.parts)
