"""Blocks that are assigned one by one: ``m.A{1,2} = …``, ``A[1, 2] = …``."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import MAX_COLOURS, table_of_blocks
from garkcli.sources.found import MAX_STAGES, FoundTable
from garkcli.sources.naming import ROLES, Scope
from garkcli.sources.scalars import Scalar, Value, number

_Indexed = dict[tuple[int, ...], Value]


class Cells:
    """What is assigned to the entries of arrays of one structure; indices count from 1.

    Args:
        line: where the first of them stands.
    """

    def __init__(self, line: int) -> None:
        self.line = line
        self._whole: dict[str, Value] = {}
        self._entries: dict[str, _Indexed] = {}

    def put(self, name: str, indices: tuple[int, ...], value: Value) -> None:
        """Note that an array, or an entry of it, has a value."""
        role = ROLES.get(name, name)
        if not indices:
            self._whole[role] = value
            return
        if all(0 < index <= MAX_STAGES for index in indices):
            self._entries.setdefault(role, {})[indices] = value

    def table(self, source: str, format: str, name: str, allowance: Allowance) -> FoundTable | None:
        """The method that they make; None where they make none."""
        allowance.line = self.line
        table = self._table(source, format, name, allowance)
        return None if table is None else allowance.table(table)

    def _table(
        self, source: str, format: str, name: str, allowance: Allowance
    ) -> FoundTable | None:
        entries = self._entries
        blocks = entries.get("A")
        if not blocks:
            return table_of_blocks(self._whole, source, format, name, self.line)
        if all(isinstance(x, Scalar) for x in blocks.values()):
            return self._of_numbers(source, format, name, allowance)
        values: dict[str, Value] = dict(self._whole)
        values["A"] = _grid(blocks, allowance)
        for role in ("b", "c", "embedded", "dense"):
            if role in entries:
                values[role] = _listed(entries[role])
        return table_of_blocks(values, source, format, name, self.line)

    def _of_numbers(
        self, source: str, format: str, name: str, allowance: Allowance
    ) -> FoundTable | None:
        """One matrix whose entries are assigned."""
        scope = Scope(name)
        for role, value in self._whole.items():
            if role not in self._entries:
                scope.add(role, value, self.line)
        for role, entries in self._entries.items():
            if role in ROLES:
                scope.add(role, filled(entries, allowance), self.line)
        return next(scope.tables(source, format), None)


def _grid(blocks: Mapping[tuple[int, ...], Value], allowance: Allowance) -> Value:
    """``A[l][m]``; None where nothing, or nothing but [], is assigned."""
    if any(len(index) != 2 for index in blocks):
        return None
    size = max(max(index) for index in blocks)
    if size > MAX_COLOURS:
        return None
    allowance.spend(size * size)
    numbers = range(1, size + 1)
    rows: list[Value] = []
    for l in numbers:
        row: list[Value] = []
        for m in numbers:
            block = blocks.get((l, m)) or None
            row.append(_as_matrix(block))
        rows.append(row)
    return rows


def _as_matrix(value: Value) -> Value:
    """A block of one row is written like a row, one of one entry like a number."""
    if isinstance(value, Scalar):
        return [[value]]
    if isinstance(value, list) and all(isinstance(x, Scalar) for x in value):
        return [value]
    return value


def _listed(entries: Mapping[tuple[int, ...], Value]) -> Value:
    """The rows of b, c, … in order; one of a single entry is written like a number."""
    size = max(index[0] for index in entries)
    rows: list[Value] = []
    for l in range(1, size + 1):
        row = entries.get((l,))
        is_number = isinstance(row, Scalar)
        rows.append([row] if is_number else row)
    return rows


def filled(entries: Mapping[tuple[int, ...], Value], allowance: Allowance, first: int = 1) -> Value:
    """An array from its entries, with zeros where none is assigned.

    Args:
        entries: by their indices.
        allowance: of the source.
        first: the index that the language begins with.
    """
    numbers = range(first, max(max(index) for index in entries) + 1)
    zero: Value = number("0")
    is_vector = all(len(index) == 1 for index in entries)
    allowance.spend(len(numbers) * (1 if is_vector else len(numbers)))
    if is_vector:
        return [entries.get((i,), zero) for i in numbers]
    rows: list[Value] = []
    for i in numbers:
        row = [entries.get((i, j), zero) for j in numbers]
        rows.append(row)
    return rows
