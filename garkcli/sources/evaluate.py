"""The exact values in sources, unknown if any part is unknown; nothing is executed.

Every scope is walked once, with a budget of steps; calls of functions with several statements are
not followed. Each arm of a branch is walked with its own copies of names, and ends like a scope;
after the branch the names assigned in it are unknown.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, repeat
from typing import Any, TypeAlias, TypeGuard, TypeVar

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.elementwise import ITEM
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.known import (
    CONSTANTS,
    CONVERSIONS,
    NO_SIZE,
    SAME,
    KnownCall,
    conversion,
    in_words,
    result,
)
from garkcli.sources.signatures import SIGNATURES, other_kind
from garkcli.sources.values import (
    FILL,
    NULL,
    ZERO,
    Array,
    Function,
    Null,
    Number,
    SourceRecord,
    Space,
    Type,
    Unknown,
    Value,
    Word,
    computed,
    copied,
    described,
    integer,
    is_matrix,
    is_written,
    items_of,
    literal,
    negative,
    real,
    size,
    transposed,
    truncated,
    whole,
)

MAX_STEPS = 60_000
"""Most steps for one function."""
MAX_TURNS = 4_000
"""Most iterations of a loop."""
FEW_TURNS = 100
"""Loops with so many turns are followed, if their steps are not too many."""
MAX_DEPTH = 80
"""Deepest nesting of expressions."""
PER_NAME = 10
"""Characters counted for each name that an arm of a branch copies."""
MAX_INLINED = 3
"""Deepest nesting of calls of functions of one expression, as the work may double each time."""
_GROWING = frozenset({"push_back", "append", "emplace_back"})
_GROWN = frozenset({"push!", "append!", "pushfirst!", "prepend!"})
"""Functions that append their further arguments, or the items in them, to their first one."""
_OF_ARRAYS = frozenset({"reshape", "transpose", "sum", "flatten", "ravel"})
"""Methods that are functions of the array."""
_GETTERS = frozenset({"get_index", "get", "getEntry", "coeff"})
"""Methods that return an entry."""
_SETTERS = frozenset({"set_index", "set", "setEntry"})
"""Methods that assign to an entry, with its indices before the number."""
_EMPTYING = frozenset({"resize", "clear", "reinit"})
"""Methods after which an array has only later entries."""
_METHODS = _GROWING | _EMPTYING | {"reserve", "fill"}


IN_A_BRANCH = "assigned in one of several branches"
_NO_EXTENT = "an extent that is not known"
NO_SIZES = frozenset({_NO_EXTENT, NO_SIZE})
"""Reasons of arrays whose entries are all assigned later."""


class OutOfSteps(Exception):
    """A function takes too many steps."""


Place: TypeAlias = tuple[Any, Any]
"""A container of a value, and the name or index of the value in it."""
Made = TypeVar("Made", Array, SourceRecord)


class Evaluator:
    """Walks over the statements of one source.

    Args:
        base: the index of the first entry of an array.
        allowance: of the source.
        is_growing: whether all arrays grow.
        has_whole_quotients: whether ``1/2`` is 0.

    Attributes:
        lost: reasons why scopes are not read, by their kinds and lines.
        functions: the functions of the source by name, if only one has the name.
        followed: the lines of functions that are parts of steps.
    """

    def ended(self, scope: ir.Scope, space: Space) -> None:
        """Called when a scope ends, or an arm of a branch in it."""

    def replaced(self, scope: ir.Scope, space: Space, name: str) -> None:
        """Called before an array is assigned anew."""

    def refilled(self, scope: ir.Scope, record: SourceRecord, name: str) -> None:
        """Called before a field is assigned anew."""

    def __init__(
        self,
        base: int,
        allowance: Allowance,
        is_growing: bool = False,
        has_whole_quotients: bool = False,
    ) -> None:
        self.base = base
        self.allowance = allowance
        self.line = 1
        self.lost: dict[tuple[str, int], str] = {}
        self._scopes: list[ir.Scope] = [ir.Scope("module", "", (), 1)]
        self._is_growing = is_growing
        self.has_whole_quotients = has_whole_quotients
        self._steps = 0
        self._depth = 0
        self._inlined = 0
        self._lengths: list[int] = []
        self._owner = ""
        self._of_cases: dict[str, dict[str, Value]] = {}
        self._gives: dict[str, Value | None] = {}
        self.functions: Mapping[str, ir.Scope] = {}
        self.followed: set[int] = set()

    def module(self, body: ir.Body) -> None:
        """Walks over the whole source."""
        self.functions = _functions(body)
        self._walked(ir.Scope("module", "", body, 1), Space())

    def array(self, items: Iterable[Value]) -> Array:
        """An array of this language."""
        return Array(list(items), self._is_growing)

    def unknown(self, reason: str) -> Unknown:
        """An unknown value at the current line."""
        return Unknown(reason, self.line)

    # statements

    def _walked(self, scope: ir.Scope, space: Space) -> None:
        self._scopes.append(scope)
        try:
            self._run(scope.body, space)
            self.ended(scope, space)
        except OutOfSteps:
            self.lost[scope.kind, scope.line] = "it takes too much work to read"
        finally:
            self._scopes.pop()

    def _run(self, body: ir.Body, space: Space) -> None:
        for statement in body:
            if space.returned is None:
                self._step(statement, space)

    def _step(self, statement: ir.Statement, space: Space) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            raise OutOfSteps
        self.line = self.allowance.line = statement.line
        match statement:
            case ir.Assign():
                self._assign(statement, space)
            case ir.Do(value=value):
                self.value(value, space)
            case ir.Return(value=value):
                space.returned = self.value(value, space)
            case ir.Scope():
                self._scope(statement, space)
            case ir.Branch():
                self._branch(statement, space)
            case ir.Loop():
                self._loop(statement, space)

    def _scope(self, scope: ir.Scope, space: Space) -> None:
        if scope.name.startswith("_") and self._scopes[-1].kind == "class":
            # for __init__, _step the class has the public name
            scope = replace(scope, name=self._scopes[-1].name)
        inner = Space(space)
        for name in scope.parameters:
            inner[name] = Unknown(f"the argument {name}", scope.line)
        inner.update({name: Type() for name in scope.types})
        match scope.body:
            case (ir.Return(value=value),) if not isinstance(value, (ir.Call, ir.Fields)):
                if scope.kind == "function" and scope.name not in {*space, scope.gives}:
                    space[scope.name] = Function(scope.parameters, value, inner)
        before, self._steps = self._steps, 0
        self._walked(scope, inner)
        self._steps = before
        if scope.kind == "function" and not {*scope.parameters} - {*scope.types, "self"}:
            self._gives[scope.name] = inner.returned
        if isinstance(inner.get("this"), Array):
            # the entries of a class that is an array
            is_class = scope.kind == "class"
            self._store(
                ir.Name(scope.name if is_class else "this"), inner["this"], space, scope.line
            )
        if scope.name == "order" and isinstance(inner.returned, Number):
            # a method of a class that returns the order
            space[scope.name] = inner.returned
        elif scope.gives not in {"", *space} and isinstance(inner.returned, Array | Number):
            self._store(ir.Name(scope.gives), inner.returned, space, scope.line)
        if scope.kind == "entry":
            self._remember(scope, inner)

    def _remember(self, scope: ir.Scope, space: Space) -> None:
        """Remembers the numbers of a case for cases of the same title in other functions, and for
        the cases in it.
        """
        inside = (x for x in ir.statements(scope.body) if isinstance(x, ir.Scope))
        for title in {scope.name, *(x.name for x in inside if x.kind == "entry")}:
            known = self._of_cases.setdefault(title, {})
            for name, value in space.items():
                if isinstance(value, Number):
                    is_other = name in known and shown(known[name]) != shown(value)
                    known[name] = self.unknown(IN_A_BRANCH) if is_other else value

    def _branch(self, branch: ir.Branch, space: Space) -> None:
        for arm in filter(_has_numbers, branch.arms):
            known = [*space.values(), *space.calls]
            self.allowance.spend(PER_NAME * len(known) + sum(map(size, known)))
            each = space.fork()
            self._run(arm, each)
            self.ended(replace(self._scopes[-1], kind="module", body=arm), each)
        for target, line in _targets([branch]):
            self.spoil(target, space, IN_A_BRANCH, line)

    def _loop(self, loop: ir.Loop, space: Space) -> None:
        over = self.value(loop.over, space) if loop.name else self.unknown("a loop")
        if self.has_whole_quotients and ir.Name(loop.name) in [x for x, _ in _targets(loop.body)]:
            # for (auto &x : v) x = 0;
            self.spoil(loop.over, space, "changed in a loop", loop.line)
            over = self.unknown("a loop")
        turns = len(items_of(over))
        is_short = turns < FEW_TURNS or turns * _size_of(loop.body) < MAX_STEPS
        if isinstance(over, Array) and turns <= MAX_TURNS and is_short and _is_plain(loop.body):
            for item in over.items:
                space[loop.name] = item
                self._run(loop.body, space)
            if over.items and loop.name == ITEM:
                space.pop(ITEM, None)
            return
        if loop.name and self._is_filled(loop, space):
            return
        for target, line in _targets(loop.body):
            self.spoil(target, space, "assigned in a loop", line)

    def _is_filled(self, loop: ir.Loop, space: Space) -> bool:
        """Whether a loop of unknown length sets the entries of arrays without values to zero, and
        does nothing else; an array without entries so far has zeros then.
        """
        filled: dict[str, Array] = {}
        for statement, counters in _within(loop, frozenset()):
            if not isinstance(statement, ir.Assign) or statement.sign or statement.value is None:
                return False
            name, at = _entry_of(statement.target)
            value = self.value(statement.value, space)
            is_zero = isinstance(value, Number) and value.is_zero
            if not (name and at and at <= counters and is_zero):
                return False
            old = space.find(name)
            if isinstance(old, Array) and any(map(_has_value, old.flat())):
                # it may set some entries alone
                return False
            made = Array([], is_growing=True, fill=value)
            filled[name] = old.map(lambda _: ZERO) if isinstance(old, Array) and old.items else made
        for name, array in filled.items():
            space[name] = array
            space.lines.setdefault(name, loop.line)
        return bool(filled)

    def spoil(self, target: ir.Expr, space: Space, reason: str, line: int) -> None:
        """Makes all entries of an array, or a name, unknown."""
        unknown = Unknown(reason, line)
        written = replace(unknown, was_written=True)
        record, key = self._record_of(target, space)
        named: dict[str, Value] = space if record is None else record.fields
        for name in names_of(target) if record is None else [key]:
            old = named.get(name)
            named[name] = unknown
            if isinstance(old, Array) and (old.items or old.fill is not None):
                named[name] = old.map(lambda x: written if _was_written(x) else unknown)
            elif isinstance(old, Number) and old.is_zero and isinstance(target, ir.Index):
                # A = 0, with entries filled in several branches
                named[name] = Array([], is_growing=True, fill=unknown)

    def _record_of(self, target: ir.Expr, space: Space) -> tuple[SourceRecord | None, str]:
        """The record of the scope with the field that an assignment changes, and its key."""
        while isinstance(target, ir.Index):
            target = target.of
        if isinstance(target, ir.Field) and isinstance(target.of, ir.Name):
            record = space.get(target.of.name)
            if isinstance(record, SourceRecord):
                return record, target.name
        return None, ""

    def _assign(self, statement: ir.Assign, space: Space) -> None:
        target, line = statement.target, statement.line
        value: Value = self.unknown("never assigned")
        if statement.value is not None:
            self._owner = target.name.rpartition("::")[0] if isinstance(target, ir.Name) else ""
            value = self.value(statement.value, space)
            self._owner = ""
        if isinstance(value, SourceRecord) and not value.key:
            # RK["Heun"] = …
            key = self.value(target.at[-1], space) if isinstance(target, ir.Index) else NULL
            name = target.name if isinstance(target, ir.Name) else ""
            value.key = key.text if isinstance(key, Word) else name
        if isinstance(target, ir.Items):
            self._taken_apart(target, value, space, line)
            return
        if statement.sign and statement.sign != ".":
            value = self.combined(statement.sign, self.value(target, space), value)
        if statement.extents:
            sizes = [None if x is None else self.value(x, space) for x in statement.extents]
            value = self._extended(value, sizes, is_filled=statement.value is not None)
        if statement.is_real:
            value = real(value)
        if statement.sign == ".":
            old = self.value(target, space)
            if isinstance(old, Array) and not isinstance(value, Array):
                filling = value
                value = old.map(lambda _: filling)
        self._store(target, value, space, line)

    def _taken_apart(self, target: ir.Items, value: Value, space: Space, line: int) -> None:
        items = items_of(value)
        if len(items) != len(target.items):
            items = [self.unknown(f"a part of {described(value)}")] * len(target.items)
        for each, item in zip(target.items, items, strict=True):
            self._store(each, item, space, line)

    def _extended(self, value: Value, sizes: Sequence[Value | None], is_filled: bool) -> Value:
        """An array with declared extents, filled as in C."""
        counts = [None if x is None else whole(x) for x in sizes]
        for size_, count in zip(sizes, counts, strict=True):
            if size_ is not None and (count is None or not 0 <= count <= MAX_STAGES**2):
                is_array = isinstance(value, Array) and is_filled
                return value if is_array else self.unknown(_NO_EXTENT)
        if math.prod(filter(None, counts)) > MAX_STAGES**2:
            return self.unknown(f"an array of more than {MAX_STAGES**2} entries")
        fill: Value = FILL if is_filled else self.unknown("never assigned")
        shaped = self._shaped(value if is_filled else None, counts, fill)
        self.allowance.spend(size(shaped))
        return shaped

    def _shaped(self, value: Value | None, counts: Sequence[int | None], fill: Value) -> Value:
        if not counts:
            return fill if value is None else value
        if isinstance(value, (Unknown, SourceRecord)):
            return value
        items: list[Value] = []
        if value is not None:
            items = list(value.items) if isinstance(value, Array) else [value]
        columns = counts[1] if len(counts) > 1 else None
        if columns and items and not any(isinstance(x, Array) for x in items):
            rows = range(0, len(items), columns)
            items = [Array(items[i : i + columns]) for i in rows]
        count = len(items) if counts[0] is None else counts[0]
        self.allowance.spend(count)
        padded: list[Value | None] = [*items, *[None] * (count - len(items))]
        return self.array(self._shaped(x, counts[1:], fill) for x in padded)

    # places of assignments

    def _store(self, target: ir.Expr, value: Value, space: Space, line: int) -> None:
        self.allowance.spend(size(value))
        if isinstance(value, Array) or not isinstance(target, ir.Name):
            # arrays are never shared, and no record contains itself
            value = copied(value)
        name = plain_name(target)
        if not name:
            self._put(target, value, space, line)
            return
        old = space.get(name) if isinstance(target, ir.Name) else None
        is_other = isinstance(value, Array) and shown(old or NULL) != shown(value)
        if is_other and any(map(_was_written, Array(items_of(old)).flat())):
            self.replaced(self._scopes[-1], space, name)
        space[name] = value
        space.lines[name] = line

    def _places(self, target: ir.Expr, space: Space) -> list[Place]:
        """The places of an expression; none if unknown."""
        name = plain_name(target)
        if name:
            outer = None if name in space else space.find(name)
            if outer is not None:
                space[name] = copied(outer)
            return [(space, name)]
        match target:
            case ir.Field(of=of, name=key) | ir.Index(of=of, at=(ir.Text(text=key),)):
                record = self._changed(of, space, SourceRecord("", {}, (), self.line))
                return [] if record is None else [(record.fields, key)]
            case ir.Index(of=of, at=at):
                array = self._changed(of, space, Array([], is_growing=True))
                return [] if array is None else self._entries(array, at, space)
        return []

    def _changed(self, of: ir.Expr, space: Space, made: Made) -> Made | None:
        """The array or record that is changed, made if there is none."""
        places = self._places(of, space)
        if len(places) != 1:
            return None
        ((inside, key),) = places
        old = inside.get(key) if isinstance(inside, dict) else inside[key]
        if isinstance(old, type(made)):
            return old
        is_free = old is None or isinstance(old, Unknown)
        if isinstance(made, Array) and _is_an_argument(old, str(key)):
            # an argument is filled: the other entries are those of the caller
            made.fill = old
        elif isinstance(made, Array) and isinstance(old, Number):
            # A = 0, if nothing is known of the array so far
            is_free, made.fill = True, FILL if old.is_zero else old
        elif isinstance(made, Array) and isinstance(old, Unknown) and old.reason in NO_SIZES:
            made.fill = self.unknown("never assigned")
        elif isinstance(made, Array) and isinstance(old, Unknown) and _is_of_a_call(old):
            # the other entries are those that the function gave it
            made.fill = old
        elif isinstance(made, Array):
            is_free = old is None or isinstance(old, Null) or _is_unset(old)
        if not is_free:
            return None
        inside[key] = made
        if isinstance(made, SourceRecord) and self._scopes[-1].kind == "module":
            made.key = str(key)
        if inside is space:
            space.lines.setdefault(str(key), self.line)
        return made

    def _put(self, target: ir.Expr, value: Value, space: Space, line: int) -> None:
        """Assigns to fields and entries; an unknown index spoils its array."""
        if isinstance(target, ir.Index) and self.base and isinstance(value, Number):
            is_line = _is_line(self.value(target.of, space), target.at)
            target = ir.Index(target.of, (_FIRST, *target.at)) if is_line else target
        places = self._places(target, space)
        items: Sequence[Value] = [value] * len(places)
        match target:
            case ir.Index(at=at) if isinstance(value, Array) and any(map(_is_range, at)):
                is_whole = len(value.items) == len(places)
                # a column in a row of MATLAB has its entries
                is_column = len(at) > 1 and all(len(items_of(x)) == 1 for x in value.items)
                items = value.items if is_whole and not is_column else list(value.flat())
            case ir.Field(of=of, name=key) | ir.Index(of=of, at=(ir.Text(text=key),)):
                if isinstance(target, ir.Index):
                    space.lines[key] = line
                record = self.value(of, space) if isinstance(value, Array) else NULL
                old = record.fields.get(key, NULL) if isinstance(record, SourceRecord) else value
                if isinstance(record, SourceRecord) and shown(old) != shown(value):
                    self.refilled(self._scopes[-1], record, key)
        if len(items) == len(places) > 0:
            for (inside, key), item in zip(places, items, strict=True):
                row = items_of(inside[key]) if isinstance(inside, list) else []
                if len(row) == 1 and isinstance(item, Number):
                    # an entry of a column
                    row[0] = item
                else:
                    inside[key] = item
        elif isinstance(target, ir.Index):
            self.spoil(target.of, space, "an entry at an unknown place", line)

    def _entries(self, array: Array, at: Sequence[ir.Expr], space: Space) -> list[Place]:
        """The entries at indices."""
        places: list[Place] = []
        for i in self._numbers(at[0], array, space) if at else ():
            if array.is_growing and len(array.items) <= i < MAX_STAGES:
                self.allowance.spend(i)
                more = range(len(array.items), i + 1)
                is_row = len(at) > 1 and isinstance(array.fill, Number)
                array.items += (
                    Array([], is_growing=True, fill=array.fill) if is_row else array.fill or FILL
                    for _ in more
                )
            if not 0 <= i < len(array.items):
                return []
            if len(at) == 1:
                places.append((array.items, i))
                continue
            row = array.items[i]
            if array.is_growing and (_is_unset(row) or row is array.fill):
                row = array.items[i] = Array([], is_growing=True, fill=array.fill)
            inner = self._entries(row, at[1:], space) if isinstance(row, Array) else []
            if not inner:
                return []
            places += inner
        return places

    def _numbers(self, at: ir.Expr, box: Array, space: Space) -> Sequence[int]:
        """The indices from 0 of an expression; none if unknown."""
        count = len(box.items)
        self._lengths.append(count)
        ends = [at.first, at.last] if isinstance(at, ir.Range) else [at, at]
        values = [None if x is None else self.value(x, space) for x in ends]
        self._lengths.pop()
        first, last = (
            default if x is None else self._from_0(whole(x), count)
            for x, default in zip(values, (0, count - 1), strict=True)
        )
        if first is None or last is None or last - first > MAX_TURNS:
            return ()
        return range(first, last + 1)

    def _from_0(self, i: int | None, count: int) -> int | None:
        """An index from 0; in languages that begin with 0 negative ones count from the end."""
        return i if i is None else i + count if i < 0 == self.base else i - self.base

    # expressions

    def value(self, expr: ir.Expr, space: Space) -> Value:
        """The value of an expression."""
        self._steps += 1
        if self._depth > MAX_DEPTH or self._steps > 50 * MAX_STEPS:
            return self.unknown("an expression that is too deep")
        self._depth += 1
        evaluated = self._value(expr, space)
        self._depth -= 1
        return evaluated

    def _value(self, expr: ir.Expr, space: Space) -> Value:
        match expr:
            case ir.Literal(text=text, is_whole=is_whole):
                return literal(text, self.line, is_whole)
            case ir.Name(name=name):
                return self._named(name, space)
            case ir.Text(text=text):
                return Word(text)
            case ir.Nothing():
                return NULL
            case ir.Items(items=items):
                return self._listed(items, space)
            case ir.Rows():
                return self._rows(expr, space)
            case ir.Unary(sign=sign, of=of):
                value = self.value(of, space)
                return self.negated(value) if sign == "-" else value
            case ir.Binary(sign=sign, left=left, right=right):
                return self.combined(sign, self.value(left, space), self.value(right, space))
            case ir.Call():
                return self._called(expr, space)
            case ir.Index():
                return self._entry(expr, space)
            case ir.Field():
                return self._field(expr, space)
            case ir.Fields(pairs=pairs, line=line):
                line = line or self.line
                fields = {name: self._kept(self.value(x, space)) for name, x in pairs}
                for name, value in fields.items():
                    if isinstance(value, SourceRecord):
                        value.key = name
                record = SourceRecord("", fields, (), line)
                space.calls.append(record)
                return record
            case ir.Transposed(of=of):
                return transposed(self.value(of, space), self.line)
            case ir.Range(first=first, last=last):
                return self._ranged(first, last, space)
            case ir.Lambda(parameters=parameters, body=body):
                return Function(parameters, body, space)
            case ir.Either():
                return self.unknown("either of two values")
            case ir.Opaque(reason=reason):
                return self.unknown(reason)

    def _kept(self, value: Value) -> Value:
        """A copy of a value for another one to hold, with its own arrays."""
        if isinstance(value, Array):
            self.allowance.spend(size(value))
            return copied(value)
        return value

    def _named(self, name: str, space: Space) -> Value:
        if name == "the argument":
            return self.unknown(name)
        if name == "end" and self._lengths:
            return integer(self._lengths[-1] - 1 + self.base)
        named_value = space.find(name)
        if named_value is not None:
            return named_value
        for scope in reversed(self._scopes):
            if scope.kind == "entry" and name in self._of_cases.get(scope.name, {}):
                return self._of_cases[scope.name][name]
        for owner in (self._owner, *(x.name.rpartition("::")[0] for x in reversed(self._scopes))):
            # members of the class of a member or a function
            named_value = space.find(f"{owner}::{name}") if owner else None
            if named_value is not None:
                return named_value
        plain = name.rpartition("::")[2]
        if plain in CONSTANTS:
            return CONSTANTS[plain]
        if plain in CONVERSIONS:
            return Type(plain)
        return in_words(plain) or self.unknown(f"the name {name}")

    def _listed(self, items: Sequence[ir.Expr], space: Space) -> Value:
        return self.array(self._kept(self.value(x, space)) for x in items)

    def _rows(self, rows: ir.Rows, space: Space) -> Value:
        values = [[self._kept(self.value(x, space)) for x in row] for row in rows.rows]
        values = [row for row in values if row]
        if not any(isinstance(x, Array) for row in values for x in row):
            is_list = len(values) == 1 and not rows.is_row_a_matrix
            is_column = rows.is_row_a_matrix and all(len(row) == 1 for row in values)
            if is_list or is_column:
                return self.array(x for row in values for x in row)
            return self.array(self.array(row) for row in values)
        return self._blocks(values)

    def _blocks(self, values: Sequence[Sequence[Value]]) -> Value:
        """Blocks beside and below one another; a list is a column, unless only a row fits."""
        if len(values) == 1 and len(values[0]) == 1:
            return values[0][0]
        if all(len(row) == 1 for row in values):
            return self.array(y for (x,) in values for y in items_of(x) or [x])
        joined: list[Value] = []
        for row in values:
            height = max(len(x.items) if is_matrix(x) else 1 for x in row)
            blocks = [_lines(x, height) for x in row]
            if any(len(x) != height for x in blocks):
                return self.unknown("blocks that do not fit together")
            joined += [self.array(chain(*parts)) for parts in zip(*blocks, strict=True)]
        return joined[0] if len(values) == len(joined) == 1 else self.array(joined)

    def _ranged(self, first: ir.Expr | None, last: ir.Expr | None, space: Space) -> Value:
        ends = [None if x is None else whole(self.value(x, space)) for x in (first, last)]
        if ends[0] is None or ends[1] is None or ends[1] - ends[0] > MAX_TURNS:
            return self.unknown("a range")
        return self.array(integer(i) for i in range(ends[0], ends[1] + 1))

    def _field(self, expr: ir.Field, space: Space) -> Value:
        if name := plain_name(expr):
            return self._named(name, space)
        of = self.value(expr.of, space)
        if isinstance(of, SourceRecord) and expr.name in of.fields:
            return of.fields[expr.name]
        if isinstance(of, Array) and expr.name == "T":
            return transposed(of, self.line)
        if isinstance(of, Array) and expr.name == "length":
            return integer(len(of.items))
        if isinstance(of, Unknown):
            # np.pi, math.sqrt: members of a module
            member = self._named(expr.name, Space())
            return of if isinstance(member, Unknown) else member
        return self.unknown(f"the field {expr.name}")

    def _entry(self, expr: ir.Index, space: Space) -> Value:
        of = self.value(expr.of, space)
        at = list(expr.at)
        while at and isinstance(of, SourceRecord) and isinstance(at[0], ir.Text):
            key = at.pop(0)
            assert isinstance(key, ir.Text)
            of = of.fields.get(key.text, self.unknown(f"the key {key.text}"))
        if not at:
            return of
        if isinstance(of, Type):
            # T[1, 2]
            return self._listed(at, space)
        if not isinstance(of, Array):
            return of if isinstance(of, Unknown) else self.unknown("an entry of what is no array")
        return self._sliced(of, at, space)

    def _sliced(self, of: Array, at: Sequence[ir.Expr], space: Space) -> Value:
        numbers = self._numbers(at[0], of, space)
        if self.base and numbers and numbers[0] > 0 and _is_line(of, at):
            return self._sliced(of, (_FIRST, *at), space)
        is_slice = _is_range(at[0])
        if not numbers and not is_slice:
            return self.unknown("an entry at an unknown place")
        if any(not 0 <= i < len(of.items) for i in numbers):
            return self.unknown("an entry that is not there")
        items: list[Value] = []
        for i in numbers:
            item = of.items[i]
            if len(at) > 1:
                if not isinstance(item, Array):
                    return item if isinstance(item, Unknown) else self.unknown("a slice")
                item = self._sliced(item, at[1:], space)
            items.append(item)
        return self.array(items) if is_slice else items[0]

    def negated(self, value: Value) -> Value:
        """The value with the other sign."""
        return negative(value, self.line)

    def combined(self, sign: str, x: Value, y: Value) -> Value:
        """An operation, entry by entry on arrays."""
        if isinstance(x, Array) or isinstance(y, Array):
            return self._each(sign, x, y)
        are_whole = all(isinstance(v, Number) and v.is_whole for v in (x, y))
        if sign == "/" and self.has_whole_quotients and are_whole:
            return truncated(x, y, self.line)
        return computed(sign, x, y, self.line)

    def _each(self, sign: str, x: Value, y: Value) -> Value:
        if isinstance(x, Array) and isinstance(y, Array):
            if sign == "*" and (x.is_matrix or y.is_matrix):
                return self._product(x, y)
            if len(x.items) != len(y.items):
                return self.unknown("arrays of different lengths")
        combined = self.array(())
        left, right = (z.items if isinstance(z, Array) else repeat(z) for z in (x, y))
        for a, b in zip(left, right, strict=False):
            item = self.combined(sign, a, b)
            self.allowance.spend(0 if isinstance(item, Array) else size(item))
            combined.items.append(item)
        return combined

    def _product(self, x: Array, y: Array) -> Value:
        """A product of matrices in MATLAB and Julia; a list is a row on the left, a column on the
        right.
        """
        rows = [items_of(row) for row in x.items] if x.is_matrix else [x.items]
        turned = transposed(y, self.line) if y.is_matrix else y
        columns = [*map(items_of, items_of(turned))] if is_matrix(turned) else [items_of(turned)]
        is_known = self.base == 1 and not self.has_whole_quotients
        if not is_known or {*map(len, rows)} != {*map(len, columns)} or not rows[0]:
            return self.unknown("a product of matrices")
        self.allowance.spend(len(rows) * len(columns) * len(rows[0]))
        entries = [[self._dot(row, column) for column in columns] for row in rows]
        if not y.is_matrix:
            return self.array(row[0] for row in entries)
        return self.array(map(self.array, entries)) if x.is_matrix else self.array(entries[0])

    def _dot(self, x: Sequence[Value], y: Sequence[Value]) -> Value:
        first, *others = (self.combined("*", a, b) for a, b in zip(x, y, strict=True))
        for each in others:
            first = self.combined("+", first, each)
        return first

    # calls

    def _called(self, call: ir.Call, space: Space) -> Value:
        callee = call.callee
        name = callee.name if isinstance(callee, ir.Name | ir.Field) else ""
        if isinstance(callee, ir.Field) and name in _METHODS:
            return self._method(callee.of, name, call.args, space)
        if name in _GROWN and call.args:
            return self._grown(call.args[0], name, call.args[1:], space)
        match callee:
            case ir.Field(of=ir.Index(of=ir.Field(of=of, name="at"), at=at), name="set"):
                return self._with_entries(of, at, call.args, space)
        if isinstance(callee, ir.Field) and name in _SETTERS and len(call.args) in (2, 3):
            is_array = bool(items_of(self.value(callee.of, space)))
            if is_array:
                entry = self.value(call.args[-1], space)
                self._store(ir.Index(callee.of, call.args[:-1]), entry, space, self.line)
                return NULL
        line = self.line
        args = [self.value(x, space) for x in call.args]
        named = {key: self.value(x, space) for key, x in call.named}
        target = space.find(name) if isinstance(callee, ir.Name) else None
        if isinstance(target, Function) and len(target.parameters) == len(args):
            return self.applied(target, args)
        plain = name.rpartition("::")[2]
        if isinstance(target, Type) and target.name:
            plain, target = target.name, None
        if isinstance(target, Type) or (_is_an_argument(target, name) and len(args) == 1):
            return conversion(args, self.line) if args else self.unknown(f"the call {name}")
        if isinstance(target, Array) and args:
            return self._sliced(target, call.args, space)
        if isinstance(callee, ir.Field) and plain in _GETTERS and len(args) in (1, 2):
            owner = self.value(callee.of, space)
            if isinstance(owner, Array) and all(whole(x) is not None for x in args):
                return self._sliced(owner, call.args, space)
        if isinstance(callee, ir.Field) and plain in _OF_ARRAYS:
            owner = self.value(callee.of, space)
            args = [owner, *args] if isinstance(owner, Array) else args
        built = result(KnownCall(plain, call, named, self), args)
        if built is not None:
            return built
        has_none = target is None and not named and all(isinstance(x, Type) for x in args)
        if has_none and isinstance(given := self._gives.get(name), Array | Number):
            return copied(given)
        if isinstance(callee, ir.Field) and isinstance(target := self.value(callee, space), Array):
            return self._sliced(target, call.args, space) if args else target
        if isinstance(callee, ir.Field) and plain in SAME:
            return self.value(callee.of, space)
        if isinstance(callee, ir.Field) and plain == "back" and not args:
            items = items_of(self.value(callee.of, space))
            if items:
                return copied(items[-1])
        if plain.endswith("!"):
            for arg in call.args:
                changed = space.find(arg.name) if isinstance(arg, ir.Name) else None
                # the changed argument comes first
                if isinstance(changed, Array) and not (arg != call.args[0] and is_written(changed)):
                    self.spoil(arg, space, f"changed by {plain}", self.line)
        if not _may_make_a_table(plain, args, named):
            return self.unknown(f"the call {plain}")
        are_halves = plain in SIGNATURES and SIGNATURES[plain].form == "halves"
        # another record in it is a table of its own
        separate: list[Value] = [
            self.unknown(described(x)) if isinstance(x, SourceRecord) and not are_halves else x
            for x in (*args, *named.values())
        ]
        fields = dict(zip(named, separate[len(args) :], strict=True))
        if not args and plain in SIGNATURES and SIGNATURES[plain].counts:
            # the known call takes its arguments by place, so the names of arguments decide
            plain = ""
        record = SourceRecord(plain, fields, separate[: len(args)], line)
        space.calls.append(record)
        return record

    def applied(self, function: Function, args: Sequence[Value]) -> Value:
        """The value of a function of one expression."""
        if self._inlined >= MAX_INLINED:
            return self.unknown("calls that are nested too deep")
        if len(args) == 1 < len(function.parameters) and isinstance(args[0], Array):
            # for each (x, y) of pairs
            args = args[0].items
        if len(args) != len(function.parameters):
            return self.unknown("a call with other arguments")
        inner = Space(function.space)
        inner.update(zip(function.parameters, args, strict=True))
        self._inlined += 1
        value = self.value(function.body, inner)
        self._inlined -= 1
        return value

    def _with_entries(
        self, of: ir.Expr, at: Sequence[ir.Expr], given: Sequence[ir.Expr], space: Space
    ) -> Value:
        """``A.at[1, 0].set(x)``: a copy of an array with other entries."""
        inner = Space(space)
        name = ir.Name("the array")
        inner[name.name] = copied(self.value(of, space))
        if len(given) != 1:
            return self.unknown("the call set")
        self._put(ir.Index(name, tuple(at)), self.value(given[0], space), inner, self.line)
        return inner[name.name]

    def _method(self, of: ir.Expr, name: str, args: Sequence[ir.Expr], space: Space) -> Value:
        """Changes an array in place by a method."""
        if name in _EMPTYING:
            self._store(of, Array([], is_growing=True), space, self.line)
        box = self._changed(of, space, Array([], is_growing=True))
        values = [self.value(x, space) for x in args]
        if box is not None and name == "fill" and len(values) == 1:
            filling = values[0]
            box.items, box.fill = box.map(lambda _: filling).items, filling
        elif box is not None and name in _GROWING and values:
            self.allowance.spend(size(values[0]))
            box.items.append(copied(values[0]))
        return NULL

    def _grown(self, of: ir.Expr, name: str, args: Sequence[ir.Expr], space: Space) -> Value:
        """An array extended by a function."""
        box = self._changed(of, space, Array([], is_growing=True))
        values: list[Value] = [self.value(x, space) for x in args]
        if name in {"append!", "prepend!"} and all(isinstance(x, Array) for x in values):
            values = [y for x in values for y in items_of(x)]
        elif name in {"append!", "prepend!"}:
            box = None
        if box is None:
            self.spoil(of, space, f"changed by {name}", self.line)
            return NULL
        self.allowance.spend(sum(map(size, values)))
        at = 0 if name in {"pushfirst!", "prepend!"} else len(box.items)
        box.items[at:at] = map(copied, values)
        return box


def _functions(body: ir.Body) -> Mapping[str, ir.Scope]:
    """The functions of a source by their names, without those with equal names."""
    found: dict[str, list[ir.Scope]] = {}
    for x in ir.statements(body):
        if isinstance(x, ir.Scope) and x.kind == "function":
            found.setdefault(x.name.rpartition("::")[2], []).append(x)
    return {name: of[0] for name, of in found.items() if len(of) == 1}


def _is_unset(value: Value) -> bool:
    """Whether nothing was written there so far."""
    return value is FILL or (isinstance(value, Unknown) and value.reason == "never assigned")


_FIRST = ir.Literal("1", is_whole=True)
"""The index of the first row in languages that count from 1."""


def _is_line(value: Value, at: Sequence[ir.Expr]) -> bool:
    """Whether one index is that of an entry in the only row of a matrix."""
    return is_matrix(value) and len(value.items) == len(at) == 1


def _is_of_a_call(value: Unknown) -> bool:
    return value.reason.startswith("the call ")


def _was_written(value: Value) -> bool:
    """Whether a number was written there, known or no longer known."""
    is_lost = isinstance(value, Unknown) and value.was_written
    return is_lost or (isinstance(value, Number) and value.is_given)


def plain_name(expr: ir.Expr) -> str:
    """The name in an expression, also as ``self.name``; empty for others."""
    match expr:
        case ir.Name(name=name) | ir.Field(of=ir.Name(name="self" | "this" | "cls"), name=name):
            return name
    return ""


def names_of(target: ir.Expr) -> Iterator[str]:
    """The names with values that an assignment changes."""
    while not plain_name(target):
        match target:
            case ir.Index(of=of) | ir.Field(of=of) | ir.Call(callee=ir.Field(of=of)):
                # A.row(1).head(2) is a part of A
                target = of
            case _:
                break
    for x in target.items if isinstance(target, ir.Items) else ():
        yield from names_of(x)
    if name := plain_name(target):
        yield name


def _is_range(at: ir.Expr) -> TypeGuard[ir.Range]:
    return isinstance(at, ir.Range)


def _may_make_a_table(name: str, args: Sequence[Value], named: Mapping[str, Value]) -> bool:
    """Whether a call gets arrays or several numbers, or makes tables by its name."""
    values = [*args, *named.values()]
    if name in SIGNATURES or any(isinstance(x, Array) for x in values):
        return True
    return len(values) > 2 and (
        bool(other_kind(name)) or sum(isinstance(x, Number) for x in values) > 2
    )


def _is_an_argument(value: Value | None, name: str) -> bool:
    """Whether a function is an argument: ``T(0.5)`` converts."""
    return isinstance(value, Unknown) and value.reason == f"the argument {name}"


def _has_numbers(body: ir.Body) -> bool:
    """Whether fractions, decimals, lists or entries are assigned or passed to calls."""
    return any(map(_is_numeric, ir.parts_of(body)))


def _is_numeric(expr: object) -> bool:
    match expr:
        case ir.Literal(text=text, is_whole=is_whole):
            return "." in text or not is_whole
        case ir.Items(items=items):
            return bool(items)
        case ir.Rows() | ir.Binary(sign="/", left=ir.Literal()):
            return True
    return False


def _size_of(body: ir.Body) -> int:
    """The number of expressions in statements."""
    return sum(1 for _ in ir.parts_of(body))


def _is_plain(body: ir.Body) -> bool:
    """Whether a body has no branches."""
    return not any(isinstance(x, ir.Branch | ir.Scope | ir.Return) for x in body)


def _within(
    loop: ir.Loop, counters: frozenset[str]
) -> Iterator[tuple[ir.Statement, frozenset[str]]]:
    """The statements of a loop and of those in it, with the counters around each."""
    counters |= {loop.name}
    for statement in loop.body:
        if isinstance(statement, ir.Loop):
            yield from _within(statement, counters)
        else:
            yield statement, counters


def _has_value(entry: Value) -> bool:
    """Whether an entry was set, and not to zero."""
    if isinstance(entry, Number):
        return not entry.is_zero
    return isinstance(entry, Unknown) and entry.was_written


def _entry_of(target: ir.Expr) -> tuple[str, frozenset[str]]:
    """The array of an entry, with the names that are its indices; empty for other targets."""
    at: list[ir.Expr] = []
    while isinstance(target, ir.Index):
        at += target.at
        target = target.of
    names = frozenset(x.name for x in at if isinstance(x, ir.Name))
    is_entry = isinstance(target, ir.Name) and len(names) == len(at)
    return (target.name, names) if isinstance(target, ir.Name) and is_entry else ("", frozenset())


def _targets(body: Iterable[ir.Statement]) -> Iterator[tuple[ir.Expr, int]]:
    """The targets of assignments in statements, with their lines."""
    for statement in ir.statements(body):
        match statement:
            case ir.Assign(target=target, line=line):
                yield target, line
            case ir.Do(value=ir.Call(callee=ir.Field(of=of, name=name)), line=line):
                if name in _METHODS | _SETTERS:
                    yield of, line
            case ir.Do(value=ir.Call(callee=ir.Name(name=name), args=(of, *_)), line=line):
                if name in _GROWN:
                    yield of, line


def shown(value: Value) -> object:
    """A key that is equal for values with equal texts."""
    match value:
        case Number():
            return value.scalar.text
        case Array(items=items):
            return tuple(map(shown, items))
        case SourceRecord(kind=kind, fields=fields):
            return kind, tuple((name, shown(x)) for name, x in fields.items())
        case Word(text=text):
            return text
    return type(value).__name__


def _lines(value: Value, height: int) -> list[list[Value]]:
    """A block as rows: a list is a row if one row is wanted, otherwise a column."""
    if not isinstance(value, Array):
        return [[value]]
    if value.is_matrix:
        return list(map(items_of, value.items))
    return [value.items] if height == 1 else [[x] for x in value.items]
