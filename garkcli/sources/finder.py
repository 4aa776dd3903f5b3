"""Tables among the values of a source: by the calls that make them, by records, by names."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.assembling import Meant, NoTable, Roles, is_complete, table_of
from garkcli.sources.evaluate import Evaluator, Space
from garkcli.sources.found import FoundTable, troubled
from garkcli.sources.naming import ROLES, role_of, roles_of_parts
from garkcli.sources.rklab import blocks_in
from garkcli.sources.scalar_names import FEWEST_COEFFICIENTS, are_coefficients, scalar_roles
from garkcli.sources.signatures import (
    CONSTRUCTOR,
    DRIFT_FIRST,
    PARTS,
    PRINTED,
    SIGNATURES,
    other_kind,
)
from garkcli.sources.steps import NoStep, step_of
from garkcli.sources.values import (
    Array,
    Null,
    Number,
    Record,
    Type,
    Unknown,
    Value,
    Word,
    is_written,
    items_of,
    whole,
)

_NUMBERED = re.compile(
    r"(?:(?P<stem>\w{1,200}?)_)?(?P<word>A|b|c|embedded|bhat|dense)"
    r"_?(?P<l>[0-9]{1,2})(?:_(?P<m>[0-9]{1,2}))?"
)
"""Names of arrays with the numbers of vector fields."""
_ARRAY = re.compile(r"(?P<stem>\w{1,200}?)_(?P<role>(?:a[0-9]{1,2}|b|db|c)|[ab]_type)")
"""Names of classes that are arrays."""
_WHOLE = re.compile(
    r"(?:(?P<stem>\w{1,200}?)_)??(?:butcher_?)?(?:tableau|table|matrix)(?:_?matrix)?"
)
"""Names of whole tableaus, and of their matrices."""
_TABLE = "ARKodeButcherTable_Alloc"
_MADE = frozenset({"", _TABLE, "ARKodeSPRKTable_Alloc"})
"""Records that are filled after they are made."""


UNRECOGNISED = "numbers with the names of coefficients whose roles are not recognised"


class TableFinder(Evaluator):
    """Evaluates one source, and collects its tables.

    Args:
        source: what it is called.
        format: of its language.
        base, allowance, is_growing, has_whole_quotients: as those of an evaluator.
    """

    def __init__(
        self, source: str, format: str, base: int, allowance: Allowance, *is_so: bool
    ) -> None:
        super().__init__(base, allowance, *is_so)
        self._source = source
        self._format = format
        self._meant: list[Meant] = []
        self._other: dict[tuple[str, int], FoundTable] = {}
        self._orders: dict[tuple[str, int], Number] = {}
        self._users: dict[tuple[str, int], set[str]] = {}
        self._arrays: dict[str, dict[str, tuple[Array, int]]] = {}
        self._taken: set[tuple[str, int]] = set()

    def tables(self) -> list[FoundTable]:
        """All of them, each once; arrays that a call takes are found with it."""
        found: dict[object, FoundTable] = {}
        for meant in [*self._meant, *self._of_classes()]:
            declared = self._orders.get((meant.maker, meant.line))
            if declared is not None:
                meant.roles.setdefault("order", declared)
            users = self._users.get((meant.maker, meant.line), ())
            if meant.name.startswith("_") and len(users) == 1:
                meant = replace(meant, name=next(iter(users)))
            try:
                table = table_of(meant, self._source, self._format)
            except NoTable:
                continue
            key = (table.A, table.b, table.c, table.line, table.name)
            self.allowance.table(table, is_kept=key not in found)
            found.setdefault(key, table)
        tables = [*found.values(), *self._other.values()]
        sure = {(x.A, x.b) for x in tables if x.is_sure and x.b}
        kept = [x for x in tables if x.is_sure or not x.b or (x.A, x.b) not in sure]
        read = {x.line for x in kept if x.b}
        kept = [x for x in kept if not x.trouble or x.line not in read]
        return sorted(kept, key=lambda x: x.line)

    # a scope

    def ended(self, scope: ir.Scope, space: Space) -> None:
        """The tables of a scope: by calls and records, by the names of arrays, as a step that is
        written out, by the names of numbers.
        """
        named = _ARRAY.fullmatch(scope.name)
        entries = space.get("this")
        if named and isinstance(entries, Array):
            self._arrays.setdefault(named["stem"], {})[named["role"]] = entries, scope.line
            return
        made = list(space.calls)
        if isinstance(space.returned, Record) and space.returned not in made:
            made.append(space.returned)
        made += [x for x in space.values() if isinstance(x, Record) and x.kind in _MADE]
        if scope.kind == "class":
            self._declared_by_class(scope, space)
        count = self._count()
        for record in made:
            self._of_record(record, scope)
        values, lines = dict(space), space.lines
        if self._count() == count:
            self._of_names(values, lines, scope)
        looks_like_a_step = self._count() == count and self._of_step(scope, space)
        if self._count() > count:
            return
        for owner, own in _by_owner(values).items():
            line = scope.line if not owner else min(lines.get(f"{owner}::{x}", 1) for x in own)
            self._of_scalars(owner or scope.title, own, line)
        if self._count() > count:
            return
        if looks_like_a_step:
            self._unread(scope.title, scope.line, "a step that is not followed")
        elif CONSTRUCTOR.fullmatch(scope.name):
            numbers = Array(list(values.values())).flat()
            fractions = sum(isinstance(x, Number) and not x.is_whole for x in numbers)
            if fractions < FEWEST_COEFFICIENTS:
                return
            self._unread(scope.title, scope.line, UNRECOGNISED, other_kind(scope.name))

    def _count(self) -> int:
        return len(self._meant) + len(self._other)

    def replaced(self, scope: ir.Scope, space: Space, name: str) -> None:
        """Arrays that are complete are a table before one of them is assigned anew; one that is in
        such a table already is not with those that were assigned since.
        """
        told = role_of(name)
        if told is None or told[1] not in {"A", "b", "c", "embedded"}:
            return
        if any(x.kind in SIGNATURES or other_kind(x.kind) for x in space.calls):
            # calls take the arrays of this scope
            return
        if _is_general_linear(space):
            return
        stem = told[0]
        names = [x for x in space if (role_of(x) or ("", ""))[0] == stem and role_of(x)]
        roles = {told[1] for told in map(role_of, names) if told}
        given = {(x, space.lines.get(x, 0)) for x in names}
        if not {"A", "b"} <= roles or (name, space.lines.get(name, 0)) in self._taken:
            return
        self._taken |= given
        self._of_names({x: space[x] for x in names}, space.lines, scope)

    def _of_classes(self) -> Iterator[Meant]:
        """Tables whose arrays are classes: a1, a2, …, b, db, c."""
        for stem, arrays in self._arrays.items():
            if {"a_type", "b_type"} <= set(arrays):
                (drifts, line), (kicks, _) = arrays["a_type"], arrays["b_type"]
                of_steps: Roles = {"drifts": drifts, "kicks": kicks}
                yield Meant("", line, of_steps, "", DRIFT_FIRST, is_sure=True)
            rows = [arrays.get(f"a{i}") for i in range(1, len(arrays) + 1)]
            A = [Array([]), *(x[0] for x in rows if x is not None)]
            roles: Roles = {"A": Array(list(A))}
            for role, name in (("b", "b"), ("c", "c"), ("error", "db")):
                if name in arrays:
                    roles[role] = arrays[name][0]
            if "b" in roles and len(A) > 1:
                line = min(line for _, line in arrays.values())
                name = stem.removesuffix("_coefficients")
                yield Meant(name, line, roles, "", None, is_sure=True)

    def _declared_by_class(self, scope: ir.Scope, space: Space) -> None:
        """The order of a class is that of the table which it uses; a table whose name is private
        has that of the only class which uses it.
        """
        used = {(x.kind, x.line) for x in space.values() if isinstance(x, Record)}
        order = space.get("order", space.get("ORDER"))
        if isinstance(order, Number):
            self._orders |= dict.fromkeys(used, order)
        for place in used:
            self._users.setdefault(place, set()).add(scope.name)

    # records and calls

    def _of_record(self, record: Record, scope: ir.Scope) -> None:
        kind = other_kind(record.kind)
        if kind and record.kind not in SIGNATURES:
            values = [*record.args, *record.fields.values()]
            is_use = any(isinstance(x, Unknown) and _is_given(x) for x in values)
            has_numbers = any(isinstance(x, Array) or whole(x) for x in values)
            if len(values) >= 3 and (has_numbers or not is_use):
                line = scope.line if scope.kind == "entry" else record.line
                name = self._name(record, scope)
                self._unread(name, line, kind=kind)
            return
        signature = SIGNATURES.get(record.kind)
        fields = record.fields
        roles: Roles = {}
        if signature is not None:
            if not record.args and len(fields) < 2:
                return
            values = [x for x in record.args if not isinstance(x, Type)]
            roles = dict(zip(signature.roles, values, strict=False))
            roles.pop("-", None)
            if any(map(_is_given, roles.values())):
                return
        for name, value in fields.items():
            role = name if record.kind == PRINTED else ROLES.get(name)
            if signature is not None and name in signature.named:
                role = signature.named[name]
            if role is not None and not isinstance(value, Null):
                roles.setdefault(role, value)
        parts = roles_of_parts(fields)
        if parts:
            roles, signature = {role: fields[name] for name, role in parts.items()}, PARTS
        if signature is PARTS and any(map(_is_given, roles.values())):
            return
        _with_diagonal(roles, fields)
        if record.kind == _TABLE and not is_written(fields.get("d")):
            roles.pop("embedded", None)
        if "title" not in roles or not isinstance(roles["title"], Word):
            roles.pop("title", None)
        are_arrays = all(isinstance(roles.get(x), Array) for x in ("A", "b"))
        if signature and signature.is_guess and not are_arrays:
            return
        if signature is None and not is_complete(roles):
            self._of_scalars(self._name(record, scope), fields, record.line)
            return
        if not is_complete(roles) and not (signature and signature.has_default_weights):
            return
        line = record.line
        if record.kind == _TABLE and scope.kind == "entry":
            line = scope.line
        counts = signature.counts if signature else ()
        if counts and len(record.args) not in counts:
            told = f"{record.kind} takes {' or '.join(map(str, counts))} arguments"
            self._unread(self._name(record, scope), line, told)
            return
        is_sure = bool(signature and not signature.is_guess) or record.kind == _TABLE
        self._meant.append(
            Meant(
                self._name(record, scope), line, roles, record.kind or "record", signature, is_sure
            )
        )

    def _name(self, record: Record, scope: ir.Scope) -> str:
        """What people call a table: a title, a constant, the function that makes it."""
        signature = SIGNATURES.get(record.kind)
        first = record.args[0] if record.args else None
        if isinstance(first, Word):
            return first.text
        if isinstance(first, Unknown) and (signature is None or signature.roles[0] == "title"):
            name = first.reason.removeprefix("the name ")
            if name != first.reason and " " not in name:
                return name
        is_entry = (scope.kind == "entry" or record.kind in _MADE - {""}) and scope.name
        return scope.name if is_entry else record.key or scope.title

    # arrays by their names

    def _of_names(
        self, values: Mapping[str, Value], lines: Mapping[str, int], scope: ir.Scope
    ) -> None:
        if _is_general_linear(values):
            self._unread(scope.title, scope.line, kind="general linear")
            return
        beside = _matrices_beside_weights(values)
        tableaus = [
            (key, dict(block), lines.get(key, lines.get(name, scope.line)))
            for name, value in values.items()
            if name not in beside and not _is_matrix_of_stages(name)
            for key, block in blocks_in(name, value, scope.title)
        ]
        for key, block, line in tableaus:
            own = scope.title if len(tableaus) == 1 and scope.title else key
            self._meant.append(Meant(own, line, block, "B", None, is_sure=True))
        if tableaus:
            return
        parts = roles_of_parts(values)
        if parts:
            line = min(lines.get(x, scope.line) for x in parts)
            of_parts = {role: values[name] for name, role in parts.items()}
            self._meant.append(Meant(scope.title, line, of_parts, "", PARTS))
            values = {name: x for name, x in values.items() if name not in parts}
        groups: dict[str, Roles] = {}
        blocks: dict[str, dict[str, dict[tuple[int, ...], Value]]] = {}
        begins: dict[str, int] = {}
        for name, value in values.items():
            owner, _, plain = name.rpartition("::")
            told = beside.get(name) or role_of(plain.lstrip("_"))
            numbered = _NUMBERED.fullmatch(plain)
            line = lines.get(name, scope.line)
            if numbered and isinstance(value, Array):
                stem = numbered["stem"] or ""
                at = tuple(int(x) for x in (numbered["l"], numbered["m"]) if x)
                role = ROLES[numbered["word"]]
                blocks.setdefault(stem, {}).setdefault(role, {})[at] = value
            elif told is not None and _fits(told[1], value):
                # RK6Solver::a belongs to its class
                stem = told[0] or owner
                groups.setdefault(stem, {})[told[1]] = value
            else:
                continue
            begins[stem] = min(line, begins.get(stem, line))
        for stem, of_role in blocks.items():
            if "A" in of_role and all(len(at) == 2 for at in of_role["A"]):
                groups[stem] = {**groups.get(stem, {}), **_grid(of_role)}
            elif stem in groups and set(of_role.get("b", ())) == {(1,), (2,)}:
                # b1 and b2 beside one A: the weights and the embedded ones
                pair = {"b": of_role["b"][1,], "embedded": of_role["b"][2,]}
                groups[stem] = {**pair, **groups[stem]}
        for stem, roles in groups.items():
            if {"A", "c", "gamma"} <= set(roles) and _is_triangle(roles["c"], roles["gamma"]):
                # α, β, γ are the matrix in one row, the weights and the nodes
                roles |= {"A": roles["c"], "b": roles["A"], "c": roles.pop("gamma")}
            if not is_complete(roles):
                continue
            title = roles.pop("title", None)
            signature = None
            if {"A", "b", "A1", "embedded"} <= set(roles):
                # an implicit part, and the explicit one with a hat
                signature = PARTS
            name = stem or scope.title
            if isinstance(title, Word):
                name = title.text
            bases = scope.bases if scope.kind == "class" else ()
            meant = Meant(name, begins[stem], roles, "", signature, bases=bases)
            if "RungeKutta" in {x.rpartition(".")[2] for x in bases}:
                meant = replace(meant, is_sure=True, line=scope.line)
            self._meant.append(meant)

    def _of_step(self, scope: ir.Scope, space: Space) -> bool:
        """The method of a function that is a step; whether another one looks like a step."""
        if scope.kind != "function":
            return False
        try:
            roles = step_of(scope.body, space, self)
        except NoStep as error:
            return error.looks_like
        note = "the coefficients are those of a step that is written out"
        meant = Meant(scope.title, scope.line, roles, "a step", None, is_sure=True, notes=(note,))
        self._meant.append(meant)
        return False

    def _unread(self, name: str, line: int, trouble: str = "", kind: str = "") -> None:
        """A place with a table that is of another kind, or else not read."""
        found = FoundTable(self._source, line, self._format, name, (), (), (), kind=kind)
        self._other[name, line] = found if kind else troubled(found, trouble)

    def _of_scalars(self, name: str, values: Mapping[str, Value], line: int) -> None:
        """Coefficients with names of their own: a21, b1."""
        found = scalar_roles(values)
        if found is None:
            if are_coefficients(values):
                self._unread(name, line, UNRECOGNISED)
            return
        if found.kind:
            self._unread(name, line, kind=found.kind)
            return
        self._meant.append(
            Meant(name, line, found.roles, "", None, notes=found.notes, is_assembled=True)
        )


def _is_matrix_of_stages(name: str) -> bool:
    """Whether the name is one of A, or of a block of it: it is no whole tableau then."""
    plain = name.rpartition("::")[2]
    told = role_of(plain)
    return (told is not None and told[1] == "A") or _NUMBERED.fullmatch(plain) is not None


def _matrices_beside_weights(values: Mapping[str, Value]) -> Mapping[str, tuple[str, str]]:
    """Matrices called tableaus that have a row per weight, with what their names tell."""
    counts = {
        role_of(name): len(x.items)
        for name, x in values.items()
        if isinstance(x, Array) and not x.is_matrix
    }
    return {
        name: (told["stem"] or "", "A")
        for name, value in values.items()
        if isinstance(value, Array)
        and value.is_matrix
        and (told := _WHOLE.fullmatch(name)) is not None
        and counts.get((told["stem"] or "", "b")) == len(value.items)
    }


def _is_general_linear(values: Mapping[str, Value]) -> bool:
    """Whether there are matrices A, B and U."""
    cases = [[values.get(x) for x in case] for case in ("ABU", "abu")]
    return any(all(isinstance(x, Array) and x.is_matrix for x in case) for case in cases)


def _by_owner(values: Mapping[str, Value]) -> Mapping[str, Mapping[str, Value]]:
    """The values by the class that they belong to: ``RKF45::a21``."""
    found: dict[str, dict[str, Value]] = {}
    for name, value in values.items():
        owner, _, plain = name.rpartition("::")
        found.setdefault(owner, {})[plain] = value
    return found


def _is_given(value: Value) -> bool:
    """Whether a value is an argument, or a part of one: then a table is used, and none is made."""
    return isinstance(value, Unknown) and "the argument" in value.reason


def _fits(role: str, value: Value) -> bool:
    """Whether a value may be what its name says."""
    if role in {"order", "embedded_order", "stages"}:
        return isinstance(value, Number)
    if role in {"title", "fsal"}:
        return isinstance(value, Word)
    return isinstance(value, Array) and bool(value.items)


def _grid(of_role: Mapping[str, Mapping[tuple[int, ...], Value]]) -> Roles:
    """Blocks ``A1_2`` and weights ``b1`` as nested arrays."""
    found: Roles = {}
    count = max(max(at) for at in of_role["A"])
    numbers = range(1, count + 1)
    blocks = of_role["A"]
    found["A"] = Array([Array([blocks.get((l, m), Null()) for m in numbers]) for l in numbers])
    for role, rows in of_role.items():
        if role != "A" and all(len(at) == 1 for at in rows):
            found[role] = Array([rows.get((l,), Null()) for l in numbers])
    return found


def _is_triangle(entries: Value, row: Value) -> bool:
    """Whether there is an entry for each pair of what is in a row."""
    m, n = (len(items_of(x)) for x in (entries, row))
    return n > 0 and 2 * m == n * (n - 1) and not any(isinstance(x, Array) for x in items_of(row))


def _with_diagonal(roles: Roles, fields: Mapping[str, Value]) -> None:
    """A diagonal that is apart is put into the matrix."""
    diagonal = items_of(fields.get("a_diagonal"))
    rows = [items_of(x) or [x] for x in items_of(roles.get("A"))]
    rows = [[]] * (len(rows) == len(diagonal) - 1) + rows
    if rows and len(rows) == len(diagonal):
        pairs = enumerate(zip(rows, diagonal, strict=True))
        roles["A"] = Array([Array([*row[:i], x]) for i, (row, x) in pairs])
