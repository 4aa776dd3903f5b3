"""C tables: SUNDIALS definitions and constructors, structures filled by entries, arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from garkcli.bridges.readers.allowance import Allowance
from garkcli.bridges.readers.c_source import Block, Call, CSource
from garkcli.bridges.readers.cells import filled
from garkcli.bridges.readers.found import (
    MAX_STAGES,
    FoundTable,
    Reader,
    Row,
    Rows,
    Unreadable,
    troubled,
)
from garkcli.bridges.readers.naming import ROLES
from garkcli.bridges.readers.petsc import REGISTERS
from garkcli.bridges.readers.scalars import Scalar, Value, number, whole
from garkcli.bridges.readers.shaping import square, symplectic, weights

NAME = "c"
CREATE = "ARKodeButcherTable_Create"
SPRK = "ARKodeSPRKTable_Create"
_Entries = Mapping[tuple[int, ...], Value]


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a C source, but for those that are registered with PETSc."""
    allowance = Allowance()
    finder = _Finder(source, allowance)
    wanted = frozenset({CREATE, SPRK, *REGISTERS})
    for call in CSource(text, wanted, finder.closed, allowance).calls():
        finder.called(call)
    return finder.found()


class _Finder:
    """Collects tables, and which arrays are those of a constructor."""

    def __init__(self, source: str, allowance: Allowance) -> None:
        self._source = source
        self._allowance = allowance
        self._tables: list[FoundTable] = []
        self._loose: list[FoundTable] = []
        self._used: list[tuple[int, int]] = []
        self._last = 0

    def found(self) -> list[FoundTable]:
        """All tables; arrays that a constructor takes are found once."""
        taken = {(x.A, x.b) for x in self._tables}
        kept = [x for x in self._loose if (x.A, x.b) not in taken and not self._is_used(x)]
        return sorted([*self._tables, *kept], key=lambda x: x.line)

    def _is_used(self, table: FoundTable) -> bool:
        return any(first <= table.line <= last for first, last in self._used)

    def called(self, call: Call) -> None:
        """A constructor was called."""
        self._last = call.line
        if call.name == CREATE:
            self._tables.append(self._allowance.table(_created(call, self._source)))
        if call.name == SPRK:
            self._tables.append(self._allowance.table(_sprk(call, self._source)))

    def closed(self, block: Block) -> None:
        """A block has ended: its members and its arrays."""
        _fill_arrays(block, self._allowance)
        for base, roles in _structures(block).items():
            line = block.member_lines[f"{base}->A"]
            table = _of_members(roles, line, self._source, block.scope.title)
            if table is not None:
                self._tables.append(self._allowance.table(table))
        for stem, cells in block.cells.items():
            of_cells = cells.table(self._source, NAME, stem, self._allowance)
            if of_cells is not None:
                self._loose.append(of_cells)
        if self._last >= block.line > 1:
            self._used.append((block.line, self._last))
        self._loose += self._allowance.tables(block.scope.tables(self._source, NAME))


def _created(call: Call, source: str) -> FoundTable:
    """``ARKodeButcherTable_Create(s, q, p, c, A, b, d)``."""
    empty = FoundTable(source, call.line, NAME, call.title, (), ())
    if len(call.arguments) != 7:
        return troubled(empty, f"{call.name} takes 7 arguments")
    s, q, p, c, A, b, d = call.arguments
    stages = whole(s)
    if stages is None or not 0 < stages <= MAX_STAGES:
        return troubled(empty, "the number of stages is not written out")
    try:
        embedded = None if d is None else (weights(d, stages),)
        return FoundTable(
            source,
            call.line,
            NAME,
            call.title,
            ((square(A, stages),),),
            (weights(b, stages),),
            (weights(c, stages),),
            embedded=embedded,
            order=whole(q),
            embedded_order=whole(p) or None,
        )
    except Unreadable as error:
        return troubled(empty, error.message)


def _sprk(call: Call, source: str) -> FoundTable:
    """``ARKodeSPRKTable_Create(s, q, a, ahat)``: stage i is p += â_i h f(q), q += a_i h v(p)."""
    empty = FoundTable(source, call.line, NAME, call.title, (), ())
    if len(call.arguments) != 4:
        return troubled(empty, f"{call.name} takes 4 arguments")
    stages = whole(call.arguments[0])
    if stages is None or not 0 < stages <= MAX_STAGES:
        return troubled(empty, "the number of stages is not written out")
    try:
        a = weights(call.arguments[2], stages)
        a_hat = weights(call.arguments[3], stages)
    except Unreadable as error:
        return troubled(empty, error.message)
    order = whole(call.arguments[1])
    empty = replace(empty, order=order)
    return symplectic(empty, a, a_hat, is_force_first=True)


def _structures(block: Block) -> Mapping[str, Mapping[str, _Entries]]:
    """The members of each structure whose member A is assigned entry by entry."""
    found: dict[str, dict[str, _Entries]] = {}
    for name, entries in block.members.items():
        base, _, member = name.rpartition("->")
        found.setdefault(base, {})[member] = entries
    return {base: roles for base, roles in found.items() if base and "A" in roles}


def _of_members(
    roles: Mapping[str, _Entries], line: int, source: str, title: str
) -> FoundTable | None:
    """The table of ``B->A[i][j] = …``; zeros are left out there."""
    entries = roles["A"]
    empty = FoundTable(source, line, NAME, title, (), ())
    if not entries or "b" not in roles:
        return None
    sizes = [1 + max(index, default=0) for name in ("A", "b", "c") for index in roles.get(name, ())]
    stages = max(sizes)
    try:
        A = _matrix(entries, stages)
        c = _row(roles["c"], stages) if "c" in roles else None
        embedded = (_row(roles["d"], stages),) if "d" in roles else None
        return FoundTable(
            source,
            line,
            NAME,
            title,
            ((A,),),
            (_row(roles["b"], stages),),
            (c,),
            embedded=embedded,
            order=_single(roles, "q"),
            embedded_order=_single(roles, "p") or None,
        )
    except Unreadable as error:
        return troubled(empty, error.message)


def _single(roles: Mapping[str, _Entries], name: str) -> int | None:
    entries = roles.get(name, {})
    return whole(entries.get(()))


def _entry(entries: _Entries, index: tuple[int, ...]) -> str:
    value = entries.get(index, number("0"))
    if not isinstance(value, Scalar):
        raise Unreadable("a number is expected")
    return value.text


def _matrix(entries: _Entries, stages: int) -> Rows:
    if stages > MAX_STAGES or any(len(index) != 2 for index in entries):
        raise Unreadable("entries with two indices are expected")
    numbers = range(stages)
    return tuple(tuple(_entry(entries, (i, j)) for j in numbers) for i in numbers)


def _row(entries: _Entries, stages: int) -> Row:
    return tuple(_entry(entries, (i,)) for i in range(stages))


def _fill_arrays(block: Block, allowance: Allowance) -> None:
    """Arrays that are filled entry by entry, ``A[1][0] = 0.5``, as if they were written whole."""
    for name, entries in block.members.items():
        if "->" in name or name not in ROLES or not entries:
            continue
        if {len(index) for index in entries} in ({1}, {2}):
            value = filled(entries, allowance, first=0)
            block.scope.add(name, value, block.member_lines[name])


READER = Reader(
    NAME,
    "C: SUNDIALS tables, structures filled entry by entry, arrays",
    (".c", ".h", ".def", ".cc", ".cpp", ".cxx", ".hpp", ".hh", ".cu"),
    find,
)
