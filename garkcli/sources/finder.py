"""Tables among the values of a source: by calls that make them, by records, by names."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

from garkcli.frozen import Mutable, field, replace
from garkcli.recognise.names import MATRIX
from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.assembling import (
    BESIDE,
    Meant,
    NoTable,
    Roles,
    is_complete,
    may_be_coefficients,
    not_read,
    table_of,
)
from garkcli.sources.couplings import FORM as COUPLING
from garkcli.sources.evaluate import shown
from garkcli.sources.found import FoundTable, troubled
from garkcli.sources.harvest import Harvester
from garkcli.sources.linear_stages import (
    roles_by_names,
    roles_by_sums,
    roles_of_arguments,
    roles_of_kpp,
)
from garkcli.sources.naming import ROLES, role_of, roles_of_parts, speaks
from garkcli.sources.overlooked import overlooked, sized
from garkcli.sources.rklab import blocks_in
from garkcli.sources.scalar_names import NEAR, whole_families
from garkcli.sources.signatures import (
    DRIFT_FIRST,
    KPP,
    NAMED,
    PARTS,
    PRINTED,
    SIGNATURES,
    Signature,
    kind_of,
    other_kind,
)
from garkcli.sources.stages import NoStep
from garkcli.sources.steps import splitting_of, steps_of
from garkcli.sources.values import (
    FILL,
    NULL,
    Array,
    Null,
    Number,
    SourceRecord,
    Space,
    Type,
    Unknown,
    Value,
    Word,
    copied,
    described,
    first_unknown,
    is_matrix,
    is_written,
    items_of,
    near,
    whole,
)

_NUMBERED = re.compile(
    r"(?:(?P<stem>\w{1,200}?)_)?(?P<word>A|b|c|embedded|bhat|dense)"
    r"_?(?P<at>[0-9]{1,2}(?:_[0-9]{1,2})?)"
)
"""Names of arrays with the numbers of vector fields."""
_WHOLE = re.compile(
    r"(?:(?P<stem>\w{1,200}?)_)??(?:butcher_?)?(?:tableau|table|matrix)(?:_?matrix)?"
)
"""Names of whole tableaus, and of their matrices."""
_TABLE = "ARKodeButcherTable_Alloc"
_PARTS = " "
"""The stem of the arrays of an explicit and an implicit part."""
_RANKS = {word: i for i, word in enumerate(ROLES)}
_OBJECT = re.compile("the call [A-Z][a-z]")
"""A call that makes an object of a class, not an array of nodes or weights."""
_ORDERS = ("order", "embedded_order")
"""Numbers of a structure that belong to the arrays beside it."""
_COUPLINGS = frozenset({"MRIStepCoupling_Alloc", "MRIStepCoupling_MIStoMRI"})
_MADE = frozenset({"", _TABLE, "ARKodeSPRKTable_Alloc", *_COUPLINGS})
"""Records that are filled after they are made."""


NUMBERED = "A and b have numbers: methods of their own, or parts of one"
ANEW = "A is assigned anew without b, or b without A"
A_STEP = "a step"
"""The maker of the table of a written-out step."""
SURELY = 100.0
"""Bits of evidence that link the matrix and weights of a step: all of it is one computation."""
STEP = "the coefficients are those of a step that is written out"
UNRECOGNISED = "it looks like a tableau, but A, b and c could not be identified"


class _Group(Mutable):
    """Values with related names.

    Attributes:
        roles: the values by their roles.
        ranks: the rank of the name of each role; the lowest counts.
        places: their names, with lines.
        taken: whether A and b are in a table already.
        unread: nodes and embedded weights with unknown entries.
    """

    roles: Roles = field(default_factory=dict)
    ranks: dict[str, int] = field(default_factory=dict)
    places: list[tuple[str, int]] = field(default_factory=list)
    taken: dict[str, bool] = field(default_factory=dict)
    unread: Roles = field(default_factory=dict)


class TableFinder(Harvester):
    """Evaluates one source and collects its tables.

    Args:
        source: its name.
        format: of its language.
        base, allowance, is_growing, has_whole_quotients: as for an evaluator.

    Attributes:
        told: the values of each table by its ``id``.
        makers: the calls with arguments in it, each with a table without coefficients.
    """

    def __init__(
        self, source: str, format: str, base: int, allowance: Allowance, *is_so: bool
    ) -> None:
        super().__init__(source, format, base, allowance, *is_so)
        self._meant: list[Meant] = []
        self._other: dict[tuple[str, int], FoundTable] = {}
        self._users: dict[tuple[str, int], dict[str, Value | None]] = {}
        self._taken: set[tuple[str, int]] = set()
        self._refilled: dict[int, Value] = {}
        self._halves: set[tuple[str, int]] = set()
        self._made: set[int] = set()
        self.told: dict[int, Roles] = {}
        self.makers: list[tuple[FoundTable, SourceRecord]] = []

    def tables(self, body: ir.Body, text: str) -> list[FoundTable]:
        """The distinct tables of a source; arrays passed to a call are found with it."""
        by_content: dict[object, FoundTable] = {}
        used: set[str] = set()
        read: set[object] = set()
        doubtful: dict[object, object] = {}
        for meant in self._meant:
            is_part = meant.maker == A_STEP and meant.table.line in self.followed
            if is_part and len(items_of(meant.roles["b"])) < 2:
                # an Euler step inside another step
                continue
            users = self._users.get((meant.maker, meant.table.line), {})
            for order in users.values():
                if order is not None:
                    meant.roles.setdefault("order", order)
            try:
                table = table_of(meant)
            except NoTable:
                continue
            if meant.maker == A_STEP and "embedded" in meant.roles and table.embedded:
                # either array may be the step
                other = replace(table, b=table.embedded, embedded=table.b, linked=SURELY)
                table = replace(table, rivals=(other,))
            if table.name.startswith("_") and len(users) == 1:
                table = replace(table, name=next(iter(users)))
            entries = () if table.trouble else Array(list(meant.roles.values())).flat()
            used |= {sized(x.near) for x in entries if isinstance(x, Number)}
            self.told[id(table)] = meant.roles
            key = (table.A, table.b, table.c, table.line, table.name)
            self.allowance.table(table, is_kept=key not in by_content)
            by_content.setdefault(key, table)
            if {"A", "b"} <= set(meant.roles):
                numbers = shown(meant.roles["A"]), shown(meant.roles["b"])
                if table.trouble:
                    doubtful[key] = numbers
                else:
                    read.add(numbers)
        # a call that takes the arrays of another table
        by_content = {key: x for key, x in by_content.items() if doubtful.get(key) not in read}
        told = (*by_content.values(), *self._other.values())
        lines_of_tables = [x.line for x in told if not x.is_unlike]
        unlike = {x.line: x.trouble for x in told if x.is_unlike}
        lost = {place: why for place, why in self.lost.items() if place[1] not in self.followed}
        for scope in overlooked(body, text, self.source, lines_of_tables, used, lost):
            own = (scope.line, *(x.line for x in scope.body))
            trouble = next((unlike[x] for x in own if x in unlike), "")
            kind = "" if trouble else other_kind(scope.name)
            trouble = trouble or self.lost.get((scope.kind, scope.line), UNRECOGNISED)
            self._unread(scope.title, scope.line, trouble, kind)
        # after a branch that assigns the nodes there is the table without them
        with_nodes = {(x.A, x.b, x.line) for x in by_content.values() if any(x.c)}
        kept = [x for x in by_content.values() if any(x.c) or (x.A, x.b, x.line) not in with_nodes]
        tables = [*kept, *self._other.values()]
        sure = {(x.A, x.b, order) for x in tables if x.is_sure and x.b for order in (x.order, None)}
        kept = [x for x in tables if x.is_sure or not x.b or (x.A, x.b, x.order) not in sure]
        lines = {x.line for x in kept if x.b}
        kept = [x for x in kept if not x.trouble or x.line not in lines]
        return sorted(kept, key=lambda x: x.line)

    # a scope

    def ended(self, scope: ir.Scope, space: Space) -> None:
        """Collects the tables of a scope: by calls and records, by the names of arrays, as a
        written-out step, by the names of numbers.
        """
        super().ended(scope, space)
        records = [x.fields for x in space.values() if isinstance(x, SourceRecord) and not x.kind]
        packed = roles_of_kpp(space)
        packed = packed or next(filter(None, (roles_of_kpp(x, "") for x in records)), None)
        if packed is not None:
            self._of_kpp(packed, scope)
            return
        records_made = list(space.calls)
        if isinstance(space.returned, SourceRecord) and space.returned not in records_made:
            records_made.append(space.returned)
        records_made += [
            x for x in space.values() if isinstance(x, SourceRecord) and x.kind in _MADE
        ]
        self.makers += [
            (self._place(x.key or scope.title, x.line), x) for x in records_made if x.args
        ]
        if scope.kind == "class":
            self._declared_by_class(scope, space)
        count, first = self._count(), len(self._meant)
        halves = (x for each in records_made for x in _halves_of(each.args))
        self._halves |= {(x.kind, x.line) for x in halves}
        for record in records_made:
            if (record.kind, record.line) not in self._halves:
                self._of_record(record, scope)
        stored = roles_by_sums(space) if self._count() == count else None
        if stored is not None:
            self._of_kpp(stored, scope)
            return
        says_rosenbrock = kind_of(scope.title) == "Rosenbrock"
        if self._count() == count and self._of_rosenbrock(scope, space, says_rosenbrock):
            return
        rows = [x for x in self.rows if (role_of(x.name) or "")[1:] == ("A",)]
        values = {x.name: self.harvest.value(x) for x in rows} | dict(space)
        lines = {x.name: x.line for x in rows} | space.lines
        known = {shown(x) for meant in self._meant[first:] for x in meant.roles.values()}
        if self._count() == count or known:
            self._of_names(values, lines, scope, known)
        has_none = self._count() == count or self._has_no_table(first, count)
        before = self._count()
        looks_like_a_step = has_none and self._of_step(scope, space)
        count = before if has_none and self._count() == before else count
        if self._count() == count and self.made:
            # c10 is an entry of c
            by_kind = sorted(self.made, key=lambda x: not x.is_matrix)
            named = {x.name.replace(".", "::"): x for x in by_kind}
            arrays = whole_families({name: self.harvest.value(x) for name, x in named.items()})
            self._made = set(map(id, arrays.values()))
            self._of_names(arrays, {name: x.line for name, x in named.items()}, scope)
        if self._count() > count or self._of_rosenbrock(scope, space, is_told=True):
            return
        if scope is not self._scopes[-1] or scope.kind == "entry":
            self._told_lost(scope, space)
        if looks_like_a_step:
            self.lost[scope.kind, scope.line] = "a step that is not followed"

    def _of_kpp(self, roles: Mapping[str, Value], scope: ir.Scope) -> None:
        """Adds the Rosenbrock method of a scope in stored form."""
        place = self._place(scope.title, scope.line)
        self._meant.append(Meant(place, dict(roles), SIGNATURES[KPP], KPP))

    def _told_lost(self, scope: ir.Scope, space: Space) -> None:
        """Reports a matrix with unknown entries in a program without branches."""
        for name, value in space.items():
            is_named = speaks(f"{name} {scope.title}") and MATRIX.search(name)
            line = space.lines.get(name, 0)
            if not is_named or not is_matrix(value) or line < scope.line:
                continue
            entries = list(value.flat())
            lost = next((x for x in entries if isinstance(x, Unknown) and not x.was_written), None)
            is_written_out = any(isinstance(x, Number) and x.is_given for x in entries)
            if lost is not None and lost.reason != "never assigned" and is_written_out:
                self._unread(scope.title, line, f"{lost.reason}, line {lost.line}, is not known")

    def _of_rosenbrock(self, scope: ir.Scope, space: Space, is_told: bool) -> bool:
        """Whether the arrays of a scope, or its single numbers, are a Rosenbrock method, perhaps
        with a misprint: one in printed form only if ``is_told`` says what it is.
        """
        # c2, … and c21, … are a list and a matrix of one name
        made = [(x.name, self.harvest.value(x)) for x in self.made]
        return self._of_letters(scope.title, scope.line, (*space.items(), *made), is_told)

    def _of_letters(
        self, title: str, line: int, named: Iterable[tuple[str, Value]], is_told: bool = False
    ) -> bool:
        """Whether arrays and numbers with the letters of papers are a Rosenbrock method, which has
        two matrices.
        """
        named = list(named)
        if sum(is_matrix(x) for _, x in named) < 2:
            return False
        kinds: tuple[dict[str, Value], ...] = ({}, {}, {})
        for name, value in named:
            plain = name.rpartition("::")[2].rpartition(".")[2].strip("_")
            if is_matrix(value) and all(len(items_of(x)) == 1 for x in value.items):
                value = Array([items_of(x)[0] for x in value.items])
            kind = 2 if isinstance(value, Number) else int(not is_matrix(value))
            kinds[kind].setdefault(plain, value)
            kinds[kind].setdefault(plain.lower(), value)
        matrices, vectors, numbers = kinds
        roles, form = roles_by_names(matrices, vectors, numbers)
        is_sure = bool(form) or kind_of(title) == "Rosenbrock"
        if not form:
            roles, form = roles_by_names(matrices, vectors, numbers, is_told=True)
            if form == "rosenbrock" and not is_told:
                # its α and b may be a Runge–Kutta method
                return False
        if form:
            place = self._place(title, line, is_sure=is_sure)
            self._meant.append(Meant(place, dict(roles), Signature([], form), "Rosenbrock"))
        return bool(form)

    def _has_no_table(self, first: int, count: int) -> bool:
        """Whether the arrays since then only have the names of a table."""
        if self._count() - count > len(self._meant) - first:
            return False
        for meant in self._meant[first:]:
            try:
                table_of(meant)
            except NoTable:
                continue
            return False
        return True

    def _count(self) -> int:
        return len(self._meant) + len(self._other)

    def replaced(self, scope: ir.Scope, space: Space, name: str) -> None:
        """Makes a table of complete arrays before one of them is assigned anew; an array of such a
        table does not combine with later ones.
        """
        super().replaced(scope, space, name)
        stem_and_role = role_of(name)
        is_one = stem_and_role is not None and stem_and_role[1] in {"A", "b", "c", "embedded"}
        is_taken = (name, space.lines.get(name, 0)) in self._taken
        if stem_and_role is None or not is_one or is_taken or _is_general_linear(space):
            return
        self.allowance.spend(len(space))
        roles = {x: each[1] for x in space if (each := role_of(x)) and each[0] == stem_and_role[0]}
        if not {"A", "b"} <= set(roles.values()):
            return
        # calls take arrays of this scope
        calls = [x for x in space.calls if x.kind in SIGNATURES or other_kind(x.kind)]
        known = {shown(x) for call in calls for x in (*call.args, *call.fields.values())}
        # entries of arrays that stay may be assigned later
        self._of_names({x: copied(space[x]) for x in roles}, space.lines, scope, known)
        self._taken |= {(x, space.lines.get(x, 0)) for x in roles}

    def refilled(self, scope: ir.Scope, record: SourceRecord, name: str) -> None:
        """Makes a table of a structure before its matrix or weights are replaced."""
        super().refilled(scope, record, name)
        both = _matrix_and_weights(record)
        is_one = ROLES.get(name) in {"A", "b"} and name in record.fields
        is_whole = is_one and len(both) == 2 and all(map(is_written, both.values()))
        if is_whole and id(record.fields[name]) not in self._refilled:
            self._of_record(record, scope)
            self._refilled |= both

    def _declared_by_class(self, scope: ir.Scope, space: Space) -> None:
        """The order of a class is for the table that it uses, or the only one that its constructor
        makes; a table with a private name gets the name of its only user.
        """
        order = space.get("order", space.get("ORDER", space.get("Order")))
        around = " ".join(x.title for x in self._scopes)
        made = [x for x in self._meant if f"{x.table.around} ".startswith(f"{around} ")]
        if len(made) == 1 and made[0].maker != A_STEP and isinstance(order, Number):
            made[0].roles.setdefault("order", order)
        for record in space.values():
            if isinstance(record, SourceRecord):
                users = self._users.setdefault((record.kind, record.line), {})
                users[scope.name] = order if isinstance(order, Number) else None

    # records and calls

    def _of_record(self, record: SourceRecord, scope: ir.Scope) -> None:
        if len({x in self._refilled for x in _matrix_and_weights(record)}) > 1:
            self._unread(self._name(record, scope), self.line, ANEW)
            return
        named = record.fields.items()
        if not record.kind and self._of_letters(self._name(record, scope), record.line, named):
            return
        signature = SIGNATURES.get(record.kind, NAMED)
        if signature is PARTS and record.args and len(record.args) != len(PARTS.roles):
            # a call of that name with other arguments
            signature = NAMED
        # its arrays may change after it is a table
        fields = {name: copied(x) for name, x in record.fields.items()}
        name = self._name(record, scope)
        # Rosenbrock methods are read only if all numbers are written
        is_known = not any(map(first_unknown, record.args[3:6]))
        is_named = signature is NAMED or (signature.form == "rosenbrock" and not is_known)
        kind = other_kind(record.kind) if is_named else ""
        is_entry = scope.kind == "entry" and (kind or record.kind in {_TABLE, *_COUPLINGS})
        line = scope.line if is_entry else record.line
        if kind == "Rosenbrock" and not record.args:
            of_arguments, form = roles_of_arguments(fields)
            if form:
                place, computed = self._place(name, line, is_sure=True), Signature([], form)
                self._meant.append(Meant(place, dict(of_arguments), computed, record.kind))
                return
        if kind:
            values = [*record.args, *fields.values()]
            is_use = any(map(_is_given, values))
            has_numbers = any(isinstance(x, Array) or whole(x) for x in values)
            if len(values) >= 3 and (has_numbers or not is_use):
                self._unread(name, line, kind=kind)
            return
        is_short = not record.args and len(fields) < 2
        if signature is not NAMED and is_short and signature.form != "slow":
            return
        values = [x for x in record.args if not isinstance(x, Type)]
        roles: Roles = dict(zip(signature.roles, values, strict=False))
        roles.pop("-", None)
        if signature.form == "halves":
            halves = _halves_of(values)
            if not halves and not any(map(_is_given, values)):
                self._unread(name, line, f"{record.kind} takes two tables that are written out")
            for part, half in zip("12", halves, strict=False):
                own = _roles_of(half.fields, ROLES)
                roles |= {f"{role}{part}": x for role, x in own.items()}
            signature = PARTS
        parts = roles_of_parts(fields)
        if parts:
            roles, signature = {role: fields[name] for name, role in parts.items()}, PARTS
        if any(map(_is_given, roles.values())):
            return
        role_names = (
            {x: x for x in fields} if record.kind == PRINTED else {**ROLES, **signature.named}
        )
        roles = _roles_of({} if parts else fields, role_names) | roles
        if signature is NAMED and _have_hats(roles):
            signature = PARTS
        is_coupling = signature.form in {COUPLING, "slow"}
        if not (is_complete(roles) or signature.has_default_weights or is_coupling):
            return
        if signature.is_guess and not all(isinstance(roles.get(x), Array) for x in ("A", "b")):
            return
        if signature.counts and len(record.args) not in signature.counts:
            wanted = " or ".join(map(str, signature.counts))
            self._unread(name, line, f"{record.kind} takes {wanted} arguments")
            return
        is_sure = not signature.is_guess and (signature is not NAMED or record.kind == _TABLE)
        place = self._place(name, line, is_sure=is_sure)
        self._meant.append(Meant(place, roles, signature, record.kind or "record"))

    def _name(self, record: SourceRecord, scope: ir.Scope) -> str:
        """The name of a table: a title, a constant, or the function that makes it."""
        signature = SIGNATURES.get(record.kind, NAMED)
        first = record.args[0] if record.args else None
        if isinstance(first, Word):
            return first.text
        if isinstance(first, Unknown) and (*signature.roles, "title")[0] == "title":
            name = first.reason.removeprefix("the name ")
            if name != first.reason and " " not in name:
                return name
        is_entry = (scope.kind == "entry" or record.kind in _MADE - {""}) and scope.name
        is_of_class = scope.kind == "class" and _WHOLE.fullmatch(record.key)
        return scope.name if is_entry or is_of_class else record.key or scope.title

    # arrays by their names

    def _of_names(
        self,
        values: Mapping[str, Value],
        lines: Mapping[str, int],
        scope: ir.Scope,
        known: Collection[object] = (),
    ) -> None:
        """Adds tables of arrays, except those with a matrix known from a record."""
        if not any(isinstance(x, Array | SourceRecord) for x in values.values()):
            return
        if _is_general_linear(values):
            self._unread(scope.title, scope.line, kind="general linear")
            return
        beside = _matrices_beside_weights(values)
        tableaus = [
            (key, block, lines.get(key, lines.get(name, scope.line)))
            for name, value in values.items()
            if name not in beside and not _is_matrix_of_stages(name)
            for key, block in blocks_in(name, value, scope.title)
        ]
        for key, block, line in tableaus:
            own = scope.title if len(tableaus) == 1 and scope.title else key
            place = self._place(own, line, is_sure=len(items_of(block["A"])) > 1)
            self._meant.append(Meant(place, dict(block), maker="B"))
        if tableaus:
            return
        records = [x for x in values.values() if isinstance(x, SourceRecord) and not x.kind]
        fields = _roles_of(records[0].fields, ROLES) if len(records) == 1 else {}
        is_table = "A" in fields or "b" in fields
        orders = {x: fields[x] for x in _ORDERS if x in fields and not is_table}
        for stem, group in self._groups(values, lines, scope, beside).items():
            roles = _with_grid(group.roles)
            matrices = {shown(roles[x]) for x in ("A", "A1", "A2") if x in roles}
            if known and not (is_complete(roles) and matrices.isdisjoint(known)):
                continue
            if not is_complete(roles):
                b = group.roles.get("b 1")
                if "A 1" in group.roles and abs(near(b) - 1) < NEAR:
                    self._unread(stem or scope.title, group.places[0][1], NUMBERED)
                continue
            roles = orders | roles
            title = roles.pop("title", None)
            name = title.text if isinstance(title, Word) else stem.strip() or scope.title
            are_parts = stem == _PARTS or _have_hats(roles)
            bases = scope.bases if scope.kind == "class" else ()
            is_sure = "RungeKutta" in {x.rpartition(".")[2] for x in bases}
            begin = scope.line if is_sure else min(line for _, line in group.places)
            if len({*group.taken.values()}) > 1 and "gamma1" not in roles:
                if may_be_coefficients(roles):
                    self._unread(name, max(line for _, line in group.places), ANEW)
                continue
            notes = not_read(group.unread)
            is_made = isinstance(roles.get("A"), Array) and id(roles["A"]) in self._made
            remarks = {"is_assembled": is_made, "notes": notes}
            place = self._place(name, begin, is_sure=is_sure, **remarks)
            signature = PARTS if are_parts else DRIFT_FIRST if "drifts" in roles else NAMED
            self._meant.append(Meant(place, roles, signature, bases=bases))

    def _groups(
        self,
        values: Mapping[str, Value],
        lines: Mapping[str, int],
        scope: ir.Scope,
        beside: Mapping[str, tuple[str, str]],
    ) -> Mapping[str, _Group]:
        """The values with roles told by their names, grouped by the common parts of the names;
        ``beside`` has further roles.
        """
        parts = {x: (_PARTS, role) for x, role in roles_of_parts(values).items()}
        # after the branch zeros may get numbers
        is_arm = scope is not self._scopes[-1]
        groups: dict[str, _Group] = defaultdict(_Group)
        for name, value in values.items():
            owner, _, plain = name.rpartition("::")
            numbered = _NUMBERED.fullmatch(plain) if isinstance(value, Array) else None
            stem_and_role = parts.get(name) or beside.get(name) or role_of(plain.lstrip("_"))
            if numbered and name not in parts:
                stem, role = numbered["stem"] or "", f"{ROLES[numbered['word']]} {numbered['at']}"
            elif stem_and_role is not None and _fits(stem_and_role[1], value):
                # RK6Solver::a belongs to its class
                stem, role = stem_and_role[0] or owner, stem_and_role[1]
                if is_arm and role in {"c", "c1", "c2"} and not is_written(value):
                    continue
            else:
                is_made = isinstance(value, Unknown) or (
                    isinstance(value, SourceRecord) and value.kind
                )
                is_array = is_made and not _OBJECT.match(described(value))
                if stem_and_role is not None and stem_and_role[1] in BESIDE and is_array:
                    groups[stem_and_role[0] or owner].unread[stem_and_role[1]] = value
                continue
            group, place = groups[stem], (name, lines.get(name, scope.line))
            rank = _RANKS.get(plain, -1)
            is_old = role in _ORDERS and place in self._taken
            # q and p are orders in structures, and anything elsewhere
            is_other = role in _ORDERS and len(plain) == 1
            if is_old or is_other or rank > group.ranks.setdefault(role, rank):
                # the order of the table before; A beside β is the matrix
                continue
            group.ranks[role] = rank
            group.roles[role] = value
            group.places.append(place)
            if role in {"A", "b"}:
                group.taken[role] = place in self._taken
        return groups

    def _of_step(self, scope: ir.Scope, space: Space) -> bool:
        """Adds the method of a function that is a step; whether another function looks like a
        step.
        """
        if scope.kind not in {"function", "module"}:
            return False
        signature = NAMED
        try:
            found = steps_of(scope.body, space, self, scope.kind == "function")
        except NoStep as error:
            try:
                found, signature = [splitting_of(scope.body, space, self)], DRIFT_FIRST
            except NoStep:
                return error.looks_like
        place = self._place(scope.title, scope.line, notes=(STEP,))
        self._meant += [Meant(place, roles, signature, maker=A_STEP) for roles in found]
        return False

    def _place(self, name: str, line: int, **told: Any) -> FoundTable:
        """A table without its coefficients."""
        around = " ".join(x.title for x in self._scopes)
        return FoundTable(self.source, line, self.format, name, (), (), around=around, **told)

    def _unread(self, name: str, line: int, trouble: str = "", kind: str = "") -> None:
        """Adds a place with a table of another kind, or one that is not read."""
        place = replace(self._place(name, line), c=(), kind=kind)
        self.allowance.table(place, is_kept=(name, line) not in self._other)
        self._other[name, line] = place if kind else troubled(place, trouble)


def _is_matrix_of_stages(name: str) -> bool:
    """Whether the name is of A, or of a block of it, so it is no whole tableau."""
    plain = name.rpartition("::")[2]
    stem_and_role = role_of(plain)
    return (stem_and_role is not None and stem_and_role[1] == "A") or _NUMBERED.fullmatch(
        plain
    ) is not None


def _matrices_beside_weights(values: Mapping[str, Value]) -> Mapping[str, tuple[str, str]]:
    """Matrices called tableaus with one row per weight, with stems and roles."""
    counts = {
        role_of(name): len(x.items)
        for name, x in values.items()
        if isinstance(x, Array) and not x.is_matrix
    }
    return {
        name: (match["stem"] or "", "A")
        for name, value in values.items()
        if is_matrix(value)
        and (match := _WHOLE.fullmatch(name)) is not None
        and counts.get((match["stem"] or "", "b")) == len(value.items)
    }


def _have_hats(roles: Roles) -> bool:
    """Whether matrix and weights are there with and without a hat, which marks the explicit
    part.
    """
    return {"A", "b", "A1", "embedded"} <= set(roles)


def _matrix_and_weights(record: SourceRecord) -> dict[int, Value]:
    """A and b of a record by their identities, which distinguish them from others with equal
    numbers.
    """
    return {id(x): x for key, x in record.fields.items() if ROLES.get(key) in {"A", "b"}}


def _is_general_linear(values: Mapping[str, Value]) -> bool:
    """Whether there are matrices A, B and U."""
    cases = [[values.get(x) for x in case] for case in ("ABU", "abu")]
    return any(all(map(is_matrix, case)) for case in cases)


def _is_given(value: Value) -> bool:
    """Whether a value is an argument, or a part of one: then a table is used, not made."""
    return isinstance(value, Unknown) and "the argument" in value.reason


def _fits(role: str, value: Value) -> bool:
    """Whether a value fits its role."""
    if role in {"order", "order1", "order2", "embedded_order", "stages"}:
        return isinstance(value, Number)
    if role in {"title", "fsal"}:
        return isinstance(value, Word)
    # Euler's method has no rows behind the first one
    return isinstance(value, Array) and (bool(value.items) or role in {"A", "c"})


def _with_grid(numbered: Roles) -> Roles:
    """Blocks ``A1_2`` and weights ``b1`` as nested arrays; b1 and b2, or b4 and b5, beside a single
    A are the weights and the embedded ones.
    """
    of = {
        tuple(role.replace("_", " ").split(" ")): x for role, x in numbered.items() if " " in role
    }
    roles = {role: x for role, x in numbered.items() if " " not in role}
    blocks = [at[1:] for at in of if at[0] == "A"]
    if blocks and all(len(at) == 2 for at in blocks):
        count = max(int(x) for at in blocks for x in at)
        numbers = [str(l) for l in range(1, count + 1)]
        rows = [Array([of.get(("A", l, m), NULL) for m in numbers]) for l in numbers]
        roles["A"] = Array(list(rows))
        for role in {at[0] for at in of if len(at) == 2}:
            roles[role] = Array([of.get((role, l), NULL) for l in numbers])
    elif not blocks and len(numbers := sorted(at[1] for at in of if at[0] == "b")) == 2:
        low, high = (of["b", number] for number in numbers)
        roles = {"b": low, "embedded": high, **roles}
    empty = {x for x in ("A", "c") if isinstance(roles.get(x), Array) and not items_of(roles[x])}
    if "A" in empty and len(items_of(roles.get("b"))) == 1:
        roles["A"] = Array([Array([FILL])])
    return {x: y for x, y in roles.items() if x not in empty or items_of(y)}


def _halves_of(values: Sequence[Value]) -> Sequence[SourceRecord]:
    """The two tables combined by a call; empty if it has other arguments."""
    tables = [x for x in values if isinstance(x, SourceRecord)]
    return tables if len(tables) == len(values) == 2 else ()


def _roles_of(fields: Mapping[str, Value], told: Mapping[str, str]) -> Roles:
    """The roles of values with names; a separate first node and a separate diagonal are
    inserted.
    """
    roles: Roles = {}
    named = [(told.get(key, ""), key, x) for key, x in fields.items() if not isinstance(x, Null)]
    # a flag says that there are some
    named = [x for x in named if not (x[0] in BESIDE and isinstance(x[-1], Word))]
    has_low = any(role == "embedded" for role, _, _ in named)
    for role, key, value in named:
        # P is an order if it is a number, and Q beside embedded weights, not beside an estimate
        is_order = role == "dense" and isinstance(value, Number)
        if role and (has_low or key != "Q"):
            roles.setdefault("order" if is_order else role, value)
    if isinstance(fields.get("c1"), Number) and "c" in roles:
        roles["c"] = Array([fields["c1"], *items_of(roles["c"])])
    single = {x: y for x, y in roles.items() if x in ("A", "b", "c") and isinstance(y, Number)}
    if "A" in fields and {"A", "b"} <= set(single):
        # numbers are matrices with one entry
        roles |= {x: Array([y]) for x, y in single.items()} | {"A": Array([Array([single["A"]])])}
    diagonal = items_of(fields.get("a_diagonal"))
    rows = [items_of(x) or [x] for x in items_of(roles.get("A"))]
    rows = [[]] * (len(rows) == len(diagonal) - 1) + rows
    if rows and len(rows) == len(diagonal):
        pairs = enumerate(zip(rows, diagonal, strict=True))
        roles["A"] = Array([Array([*row[:i], x]) for i, (row, x) in pairs])
    return roles
