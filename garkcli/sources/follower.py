"""Follows the statements of a step, with polynomials for unknown values."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import reduce
from itertools import islice
from typing import Any, TypeGuard

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.elementwise import Each, each_in, loop_over, substituted, transformed
from garkcli.sources.evaluate import MAX_INLINED, Evaluator, Made, OutOfSteps, names_of
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.known import CALLS, CONVERSIONS
from garkcli.sources.polynomials import (
    Place,
    components_of,
    difference,
    difference_of_symbols,
    is_of_slopes,
    is_sum_with_slopes,
    kept_names,
    key_of,
    keys_of,
    renamed,
    shift,
    symbols,
    with_parts,
)
from garkcli.sources.second_order import nystrom_in
from garkcli.sources.stages import NoStep, Roles, StageSlope, step_in, terms_of, without_steps
from garkcli.sources.step_words import (
    APPENDING,
    CHANGING,
    COPIES,
    DOTS,
    ELEMENTARY,
    MATHEMATICS,
    NO_SLOPES,
    SHAPES,
    SUMS,
    TELLING,
    TEXTS,
    callee_name,
    is_sum,
    operation_of,
    tells,
)
from garkcli.sources.values import (
    NULL,
    ONE,
    ZERO,
    Array,
    Form,
    Function,
    Number,
    SourceRecord,
    Space,
    Terms,
    Unknown,
    Value,
    computed,
    copied,
    integer,
    is_zero,
    items_of,
)
from garkcli.sources.values import whole as whole_number

NEVER = ir.Opaque("never assigned")
"""The value of an array without entries, ``new double[n]``."""
MAX_TERMS = 4 * MAX_STAGES
MAX_TURNS = 20
"""Most turns of a loop over stages."""
SOME = 50
"""Entries of an array that tell whether it has numbers."""


class Follower(Evaluator):
    """Evaluates statements without branches, with polynomials for unknown names.

    Args:
        like: an evaluator of the language.
        way: the statements.
        counters: names that count steps: ``x[n]`` is a value like x.
        ignores_others: whether to ignore other functions that are called for their effect like f,
            such as limiters or output; then all slopes must be used.
        inlined: the functions of the source that are followed.

    Attributes:
        has_others: whether there are such functions.
        helpers: the functions of the source that compute with slopes or evaluate f.
        is_open: whether nothing says which result is the step.
    """

    def __init__(
        self,
        like: Evaluator,
        way: Sequence[ir.Statement],
        counters: Sequence[str] = (),
        ignores_others: bool = False,
        inlined: Set[str] = frozenset(),
    ) -> None:
        super().__init__(like.base, like.allowance, has_whole_quotients=like.has_whole_quotients)
        self.functions = like.functions
        self._functions_inlined = inlined
        self._opaque: dict[object, str] = {}
        self._once: dict[object, Value] = {}
        self._later: dict[str, Form] = {}
        # in languages with arrays from 0 functions may return a status
        self._way = _for_effect(way) if like.base == 0 else way
        self._counters = counters
        self._ignores_others = ignores_others
        self.has_others = False
        self.helpers: set[str] = set()
        self.is_open = False
        self._given: set[str] = set()
        calls = [x.value for x in self._way if isinstance(x, ir.Do) and _is_effect(x.value)]
        callees = [x.callee for x in calls]
        self._f = max(callees, key=callees.count, default=None)
        places = _places_changed(self._f, self._way)
        self._place = places[-1] if places else -1
        if self._f is not None and len(places) > 1:
            self._way = _with_results(self._f, places, self._way)
        self._has_step_inside = False
        self._slopes: list[StageSlope] = []
        self._values_given: dict[str, Sequence[Value]] = {}
        self._returned: list[str] = []
        self._is_lost = False
        self._components: list[str] = []
        self._stages: set[ir.Expr] = set()
        self._effects: set[str] = set()
        self._turned: dict[str, int] = {}
        self._spans: dict[int, ir.Expr] = {}
        self._space = Space()

    def _step(self, statement: ir.Statement, space: Space) -> None:
        match statement:
            case ir.Do(value=ir.Call() as call):
                self._changing(call, space)
            case ir.Do(value=ir.Opaque(reason=reason)) if reason not in CHANGING:
                pass
            case ir.Do(value=ir.Opaque()) | ir.Scope(kind="entry" | "module"):
                self._is_lost = True
            case ir.Assign(value=None) | ir.Do() | ir.Scope():
                pass
            case ir.Assign(ir.Name(name)) if {*counter_of(statement)} & {*self._counters}:
                # what follows is at the next step
                self._turned[name] = self._turned.get(name, 0) + 1
            case ir.Assign(ir.Name(name), ir.Fields(())):
                # k = {}; k[1] = …
                space[name] = Array([], is_growing=True, fill=self.unknown("never assigned"))
            case ir.Branch():
                self._lose([statement], space)
            case ir.Return(value=value) if self._inlined:
                space.returned = self.value(value, space)
            case ir.Return(value=value):
                for i, x in enumerate(value.items if isinstance(value, ir.Items) else [value]):
                    name = x.name if isinstance(x, ir.Name) else f"value {i} of the function"
                    if not isinstance(x, ir.Name):
                        self._store(ir.Name(name), self.value(x, space), space, self.line)
                    self._returned.append(name)
            case _:
                super()._step(statement, space)

    def _loop(self, loop: ir.Loop, space: Space) -> None:
        if all(isinstance(x, ir.Assign) and x.value == NEVER for x in loop.body):
            # makes room for arrays
            return
        if loop.name and _is_over_components(loop.name, loop.body):
            self._is_lost |= self._spans.setdefault(len(self._components), loop.over) != loop.over
            self._components.append(loop.name)
            self._run(loop.body, space)
            self._components.pop()
            return
        entries, inner = loop_over(loop)
        vectors = {name: x for name, x in entries.items() if x is not None}
        if any(isinstance(self.value(x, space), Form) for x in vectors.values()):
            # names of entries stand for those of the vectors
            counters = [name for name, x in entries.items() if x is None]
            self._components += counters
            self._run(substituted(inner, vectors), space)
            del self._components[len(self._components) - len(counters) :]
            return
        stages = items_of(self.value(loop.over, space)) if loop.name else []
        if 0 < len(stages) <= MAX_TURNS and not _has_branches(loop.body):
            for stage in stages:
                space[loop.name] = stage
                self._run(loop.body, space)
            return
        self._lose(loop.body, space)
        # one step after the other
        inside = Follower(self, loop.body, (*self._counters, loop.name))
        inside.follow(Space(space.up))
        self._has_step_inside |= inside.looks_like
        self.helpers |= inside.helpers

    def _changing(self, call: ir.Call, space: Space) -> None:
        """Executes a call for its effect: a copy, a sum, an evaluation of f, or a change of its
        arguments.
        """
        if (changed := transformed(call)) is not None:
            target, each = changed
            made = self._of_each(each, space)
            self._store(target, made or self.unknown("a list"), space, self.line)
            return
        match call:
            case ir.Call(ir.Field(of, name), (item,), ()) if name in APPENDING:
                self._appended(of, item, space)
            case ir.Call(ir.Name("push!"), (of, item), ()):
                self._appended(of, item, space)
            case ir.Call(callee, (target, source, *_), ()) if callee_name(callee) in COPIES:
                self._store(target, self.value(source, space), space, self.line)
            case ir.Call(ir.Field(of=ir.Name() as of, name="Add"), (factor, term), ()):
                self._added("+ * x", (of, factor, term), space)
            case ir.Call(callee, given, ()) if roles := SUMS.get((callee_name(callee), len(given))):
                self._added(roles, given, space)
            case ir.Call() if self._changed_by_helper(call, space):
                pass
            case ir.Call(callee, (*args,), ()) if _is_effect(call):
                if callee != self._f and self._is_ignored(call, space):
                    return
                place = self._place if callee == self._f else -1
                if not callee_name(callee).endswith("!") and not _is_place(args[place]):
                    self._lose([ir.Do(call, self.line)], space)
                    return
                target = args.pop(0 if callee_name(callee).endswith("!") else place)
                values = [self.value(x, space) for x in args]
                for x, value in zip(args, values, strict=True):
                    names = symbols([terms_of(value) or {}])
                    if callee != self._f and any(" " in name for name in names):
                        # slopes may have changed
                        self.spoil(x, space, "changed elsewhere", self.line)
                made = self._slope(callee, values)
                self._effects |= symbols([terms_of(made) or {}])
                self._store(target, made, space, self.line)
            case ir.Call(ir.Name(name) | ir.Field(name=name)) if tells(name):
                pass
            case _:
                if not self._is_ignored(call, space):
                    self._lose([ir.Do(call, self.line)], space)

    def _changed_by_helper(self, call: ir.Call, space: Space) -> bool:
        """Whether a call is one of a function of the source that changes its arguments, which is
        given slopes besides and is followed.
        """
        function = self._function_of(call)
        if function is None or len(function.parameters) != len(call.args):
            return False
        changed = _changed_parameters(function)
        given = dict(zip(function.parameters, call.args, strict=True))
        values = {name: self.value(x, space) for name, x in given.items()}
        if not changed or not any(is_of_slopes(values[x]) for x in values if x not in changed):
            return False
        self.helpers.add(function.name)
        if function.name not in self._functions_inlined:
            return False
        inner = self._run_inside(function, values)
        for name in changed:
            self._store(given[name], inner[name], space, self.line)
        return True

    def _function_of(self, call: ir.Call) -> ir.Scope | None:
        """The function of the source that a call may follow."""
        if self._inlined >= MAX_INLINED or not isinstance(call.callee, ir.Name | ir.Field):
            return None
        return self.functions.get(call.callee.name)

    def _run_inside(self, function: ir.Scope, values: Mapping[str, Value]) -> Space:
        """The names of a function after it, from the values of its arguments."""
        inner = Space(self._space.up)
        inner.update({name: copied(x) for name, x in values.items()})
        self.followed.add(function.line)
        self._inlined += 1
        # its loops have names of their own
        spans, self._spans = self._spans, {}
        self._run(function.body, inner)
        self._spans = spans
        self._inlined -= 1
        return inner

    def _appended(self, of: ir.Expr, item: ir.Expr, space: Space) -> None:
        """Puts a value behind the end of a list, or of an unknown one."""
        value, values = self.value(item, space), self.value(of, space)
        if isinstance(values, Array):
            values.items.append(copied(value))
        else:
            self._store(_end_of(of), value, space, self.line)

    def _is_ignored(self, call: ir.Call, space: Space) -> bool:
        """Whether a call changes nothing that matters: it gets no slope, only values of y."""
        of = [call.callee.of] if isinstance(call.callee, ir.Field) else []
        forms = [terms_of(self.value(x, space)) or {} for x in (*call.args, *of) if _is_place(x)]
        has_slope = any(
            any(" " in name for at in form for name in at)
            and not any(len(at) == 1 and " " not in at[0] for at in form)
            for form in forms
        )
        is_other = not has_slope and not callee_name(call.callee).endswith("!")
        self.has_others |= is_other
        if is_other:
            values = (terms_of(self.value(x, space)) or {} for x in call.args)
            self._given |= {at[0] for form in values for at in form if len(form) == len(at) == 1}
        return self._ignores_others and is_other

    def _added(self, roles: str, args: Sequence[ir.Expr], space: Space) -> None:
        """Adds vectors: ``*`` is a factor of the next one, ``=`` and ``+`` are the target."""
        total: Value = ZERO
        factor: Value = ONE
        target: ir.Expr | None = None
        for role, arg in zip(roles.split(), args, strict=True):
            if role in "=+":
                target = arg
            if role in "+x":
                term = self.combined("*", factor, self.value(arg, space))
                total, factor = self.combined("+", total, term), ONE
            if role == "*":
                factor = self.value(arg, space)
        if target is not None:
            self._store(target, total, space, self.line)

    def _lose(self, body: Iterable[ir.Statement], space: Space) -> None:
        """Makes the targets of assignments and the arguments of calls unknown."""
        for x in ir.statements(body):
            targets: Iterable[ir.Expr] = ()
            match x:
                case ir.Assign(target=target):
                    targets = [target]
                case ir.Do(value=ir.Call(callee, args, named)):
                    # k.negate()
                    of = [callee.of] if isinstance(callee, ir.Field) else []
                    targets = [*of, *args, *(given for _, given in named)]
            for target in targets:
                self.spoil(target, space, "changed elsewhere", self.line)

    def spoil(self, target: ir.Expr, space: Space, reason: str, line: int) -> None:
        """Makes the values of the names in a target unknown."""
        space.update(dict.fromkeys(names_of(target), Unknown(reason, line)))

    def _store(self, target: ir.Expr, value: Value, space: Space, line: int) -> None:
        match target:
            case ir.Index(
                ir.Name() | ir.Field(of=ir.Name()) as columns,
                (ir.Range(None, None), _) | (_, ir.Range(None, None)),
            ):
                if is_of_slopes(value) and columns not in self._stages:
                    # K(:, 1) = f(t, y)
                    self._stages.add(columns)
                    super()._store(columns, Array([], is_growing=True), space, line)
        target = self._place_of(self._array_behind(target), space)
        if isinstance(target, ir.Name):
            if isinstance(value, Form) and (symbols := difference_of_symbols(value.terms)):
                # h = end - t
                end, first = symbols
                value = step = Form({(f"step@{end}",): ONE})
                self._later[end] = Form({(first,): ONE, **step.terms})
            if isinstance(value, Form) and _is_scaled(value.terms, target.name):
                # h = factor*h
                value = Form({(f"{target.name}'{line}",): ONE})
            # names are in the order of their last assignments
            space.pop(target.name, None)
            if isinstance(value, Unknown):
                # any value, or an array that is filled later
                value = Unknown("never assigned", line)
        super()._store(target, value, space, line)

    def _places(self, target: ir.Expr, space: Space) -> list[tuple[Any, Any]]:
        if isinstance(target, ir.Name) and isinstance(space.find(target.name), Unknown):
            # names assigned in the function are unknown before it is followed
            space.setdefault(target.name, self.unknown("never assigned"))
        return super()._places(target, space)

    def _changed(self, of: ir.Expr, space: Space, made: Made) -> Made | None:
        if isinstance(made, Array) and made.fill is None:
            made.fill = self.unknown("never assigned")
        before = space.get(of.name) if isinstance(of, ir.Name) else None
        if isinstance(made, SourceRecord) and isinstance(before, Form):
            symbols = [name for at in before.terms for name in at]
            if isinstance(of, ir.Name) and len(symbols) == 1:
                # the fields that are not changed are those of the value before
                made.key, space[of.name] = symbols[0], made
                return made
        return super()._changed(of, space, made)

    def _taken_apart(self, target: ir.Items, value: Value, space: Space, line: int) -> None:
        if len(target.items) == 1 and not isinstance(value, Array):
            self._store(target.items[0], value, space, line)
        elif isinstance(value, Form):
            for i, each in enumerate(target.items):
                at = [(key_of({(): integer(i + self.base)}),)]
                self._store(each, self._part(value.terms, at), space, line)
        elif isinstance(value, Array) or any(name in space for name in names_of(target)):
            super()._taken_apart(target, value, space, line)

    # values

    def _named(self, name: str, space: Space) -> Value:
        if name in space:
            named_value = space[name]
            if isinstance(named_value, Unknown):
                return Form({(f"{name}'{named_value.line}",): ONE})
            return named_value
        if name in self._later:
            return self._later[name]
        named_value = super()._named(name, space)
        if isinstance(named_value, Form):
            return named_value
        some = islice(Array([named_value]).flat(), SOME)
        has_numbers = any(isinstance(x, Number | Form) for x in some)
        return named_value if has_numbers else Form({(name,): ONE})

    def _entry(self, expr: ir.Index, space: Space) -> Value:
        whole = self._array_behind(expr)
        if whole is expr and len(expr.at) > 1 and is_of_fortran(self):
            # f(t, y) in Fortran
            of = self.value(expr.of, space)
            if isinstance(of, Form) and of.terms.keys() == {(getattr(expr.of, "name", ""),)}:
                return self._slope(expr.of, [self.value(x, space) for x in expr.at])
        if whole is not expr:
            entry = self.value(whole, space)
            return self.unknown("an entry") if isinstance(entry, Array) else entry
        if (place := self._place_of(expr, space)) is not expr:
            return self.value(place, space)
        return self._or_opaque(super()._entry(expr, space), expr, space)

    def _field(self, expr: ir.Field, space: Space) -> Value:
        of = self.value(expr.of, space) if isinstance(expr.of, ir.Name) else NULL
        if isinstance(of, Array) and of.items and all(map(is_zero, of.flat())):
            # a structure of zeros
            return ZERO
        if (place := self._place_of(expr, space)) is not expr:
            return self.value(place, space)
        return self._or_opaque(super()._field(expr, space), expr, space)

    def _or_opaque(self, value: Value, expr: ir.Expr, space: Space) -> Value:
        """A value; for an unknown entry or field of an unknown value its name."""
        if not isinstance(value, Unknown):
            return value
        at: list[object] = []
        root = expr
        while isinstance(root, ir.Index | ir.Field):
            at.append(root.name if isinstance(root, ir.Field) else self._at(root.at, space))
            root = root.of
        of = terms_of(self.value(root, space)) if isinstance(root, ir.Name) else None
        if of is None and isinstance(root, ir.Name):
            # the entries of a record or an array that are unchanged
            whole = space.find(root.name)
            of = {((isinstance(whole, SourceRecord) and whole.key) or root.name,): ONE}
        if any(" " in name for name in symbols([of or {}])):
            return self._part(of or {}, at)
        return self._named_by((tuple(of or ()), *(at or [root])))

    def _at(self, at: Iterable[ir.Expr], space: Space) -> object:
        """Indices by their values; an unknown one is itself."""
        forms = [terms_of(self.value(x, space)) for x in at]
        return tuple(x if form is None else key_of(form) for x, form in zip(at, forms, strict=True))

    def _part(self, form: Terms, at: Sequence[object]) -> Value:
        """An entry of a sum of vectors: the sum of their entries."""
        parts: dict[Place, Value] = {}
        for term, factor in form.items():
            slopes = [x for x in self._slopes if x.name in term]
            if len(slopes) > 1 or (not slopes and len(term) > 1):
                return self.unknown("an entry of a product")
            names = list(term)
            if slopes:
                of = slopes[0]
                entry = f"{of.name}: {at}"
                if all(x.name != entry for x in self._slopes):
                    callee = ir.Index(of.callee, (ir.Text(f"{at}"),))
                    self._slopes.append(StageSlope(entry, callee, of.args))
                    self._values_given[entry] = self._values_given[of.name]
                names = [entry if x == of.name else x for x in term]
            elif term:
                names = [name for x in self._named_by(((term,), *at)).terms for name in x]
            parts[tuple(sorted(names))] = factor
        return Form(parts)

    def _named_by(self, key: object) -> Form:
        """A value that is unknown, but equal for equal keys."""
        return Form({(self._opaque.setdefault(key, f"value{len(self._opaque)}"),): ONE})

    def _place_of(self, expr: ir.Expr, space: Space) -> ir.Expr:
        """The name of an entry at an unknown index, ``y[n + 1]`` or ``y[n].x``; otherwise the
        place.
        """
        root: ir.Expr = expr
        at: list[object] = []
        is_known = True
        while isinstance(root, ir.Index | ir.Field):
            if isinstance(root, ir.Field):
                at.append(root.name)
            else:
                forms = [terms_of(self.value(x, space)) or {} for x in root.at]
                is_known &= not any(map(any, forms))
                at += map(key_of, forms)
            root = root.of
        of = self._named(root.name, space) if isinstance(root, ir.Name) else NULL
        if is_known or not isinstance(root, ir.Name) or isinstance(of, Array):
            return expr
        if isinstance(of, Form) and len(of.terms) > 1:
            # an entry of a sum
            return expr
        first, *others = at
        match dict(first) if isinstance(first, tuple) and not others else {}:
            case {} as form if len(form) < 3 and (by := shift(form)) is not None:
                # y[n], y[n + 1]
                head = next(name for (name,) in filter(None, form))
                return ir.Name(f"{root.name}[{head}]" + (f"@{by}" if by else ""))
        return ir.Name(self._opaque.setdefault((root.name, *at), f"entry{len(self._opaque)}"))

    def _array_behind(self, expr: ir.Expr) -> ir.Expr:
        """The array behind an entry that a loop over components takes, or a thread its own one."""
        names = {*self._components, *(x for x in self._counters if x not in self._turned)}
        while isinstance(expr, ir.Index):
            at = tuple(x for x in expr.at if not (isinstance(x, ir.Name) and x.name in names))
            if expr.of in self._stages:
                at = tuple(x for x in at if x != ir.Range())
            if len(at) == len(expr.at):
                break
            if at:
                return ir.Index(expr.of, at)
            expr = expr.of
        return self._at_a_time(expr) if self._counters else expr

    def _at_a_time(self, expr: ir.Expr) -> ir.Expr:
        """The value of an array at a step: ``x[n]``, ``x(:, n)`` and ``x[n - 1]`` are separate
        values.
        """
        if not isinstance(expr, ir.Index) or not isinstance(expr.of, ir.Name):
            return expr
        at = [x for x in expr.at if x != ir.Range()]
        steps = [_steps_from(x, self._counters) for x in at]
        if len(steps) != 1 or steps[0] is None:
            return expr
        names = {x.name for x in ir.inside(at[0]) if isinstance(x, ir.Name)}
        by = steps[0] + sum(self._turned.get(name, 0) for name in names)
        return ir.Name(expr.of.name + (f"@{by}" if by else ""))

    def _called(self, call: ir.Call, space: Space) -> Value:
        whole = self._array_behind(ir.Index(call.callee, call.args))
        name = callee_name(call.callee)
        is_entry = isinstance(whole, ir.Name) and name not in CONVERSIONS
        if is_entry and (self._components or self._counters):
            # k1(i), entries of classes in C++
            return self.value(whole, space)
        if (each := each_in(call)) and (entries := self._of_each(each, space)) is not None:
            return entries
        if name.rpartition("::")[2] in TEXTS:
            return self.unknown("a text")
        args = [self.value(x, space) for x in call.args if not _is_of_rest(x)]
        args += [x for _, y in call.named if isinstance(x := self.value(y, space), Form)]
        if name in CONVERSIONS and len(args) == 1:
            return args[0]
        of = [self.value(call.callee.of, space)] if isinstance(call.callee, ir.Field) else []
        if name in SHAPES and isinstance(of[0] if of else NULL, Form):
            return of[0]
        if name in DOTS and len(args) == 2 and all(isinstance(x, Array) for x in args):
            return self._weighted(*args)
        if (
            name == "sum"
            and isinstance(args[0] if args else NULL, Form)
            and (all(isinstance(x, Number) for x in args[1:]))
        ):
            # of stages with weights, along one axis
            return args[0]
        if name in {"pow", "power"} and len(args) == 2 and isinstance(args[0], Form):
            return self.combined("^", *args)
        pair = args if len(args) == 2 else [*of, *args]
        function = self._function_of(call)
        # a function of JavaScript without parameters takes any number of arguments
        is_of_many = function is not None and not function.parameters
        if (
            (sign := operation_of(name)) is not None
            and (len(pair) == 2 or (sign == "+" and is_of_many and args))
            and all(isinstance(x, Form | Number) for x in pair)
        ):
            return reduce(lambda x, y: self.combined(sign, x, y), pair)
        if (followed := self._followed(call, args)) is not None:
            return followed
        local = space.find(call.callee.name) if isinstance(call.callee, ir.Name) else NULL
        if isinstance(local, Function) and args and all(map(is_of_slopes, args)):
            return self.applied(local, args)
        parts = args
        if name not in CALLS or any(isinstance(x, Form) for x in args):
            parts = [y for x in args for y in components_of(x)]
        if any(isinstance(x, Form) for x in parts):
            forms = [x for x in map(terms_of, parts) if x is not None]
            if any(" " in x for x in symbols(forms)) or len(forms) < len(parts):
                return self._slope(call.callee, args)
            # what depends on no slope is the same each time
            key = (call.callee, *map(key_of, forms))
            if key not in self._once:
                self._once[key] = self._slope(call.callee, args)
            return self._once[key]
        called_value = super()._called(call, space)
        if isinstance(called_value, Unknown) and not any(
            isinstance(x, Unknown | Array) for x in args
        ):
            # y = state(): a value independent of the step
            return self._named_by(call)
        return called_value

    def _of_each(self, each: Each, space: Space) -> Value | None:
        """An expression for all components of vectors; None for lists of numbers."""
        values = [NULL if x is None else self.value(x, space) for x in each.vectors]
        if None in each.vectors and len(values) == 1:
            if isinstance(self.value(each.over, space), Array):
                return None
        elif not any(isinstance(x, Form) for x in values):
            return None
        inner = Space(space)
        pairs = zip(each.names, each.vectors, values, strict=True)
        inner.update({name: value for name, x, value in pairs if x is not None})
        counters = [name for name, x in zip(each.names, each.vectors, strict=True) if x is None]
        self._components += counters
        value = self.value(each.body, inner)
        del self._components[len(self._components) - len(counters) :]
        return value

    def _followed(self, call: ir.Call, args: Sequence[Value]) -> Value | None:
        """The value of a function of the source that computes with slopes or evaluates f; None for
        others.
        """
        function = self._function_of(call)
        if function is None:
            return None
        names = [x for x in function.parameters if x not in {"self", "this"}]
        if len(names) != len(args):
            return None
        is_local = any(x is function for x in self._way)
        if any(map(is_of_slopes, args)) or _evaluates(function, is_local):
            self.helpers.add(function.name)
        is_helper = function.name in self.helpers | self._functions_inlined
        if not is_helper or not self._functions_inlined:
            return None
        return self._run_inside(function, dict(zip(names, args, strict=True))).returned

    def _slope(self, callee: ir.Expr, args: Sequence[Value]) -> Value:
        """An evaluation of f; unknown for other calls."""
        forms = tuple(terms_of(y) for x in args for y in components_of(x))
        if not any(form and any(form) for form in forms):
            return self.unknown("a call")
        slope = f"slope {len(self._slopes)}"
        self._slopes.append(StageSlope(slope, callee, forms))
        self._values_given[slope] = [copied(x) for x in args]
        return Form({(slope,): ONE})

    def _aligned(self) -> list[StageSlope]:
        """The evaluations with equally many arguments of each function: a vector beside lists has
        entries, too.
        """
        shapes: dict[tuple[ir.Expr, int], set[tuple[object, ...]]] = {}
        for slope in self._slopes:
            for j, value in enumerate(self._values_given.get(slope.name, ())):
                if keys := keys_of(value, self.base):
                    shapes.setdefault((slope.callee, j), set()).add(keys)
        return [self._aligned_to(x, shapes) for x in self._slopes]

    def _aligned_to(
        self, slope: StageSlope, shapes: Mapping[tuple[ir.Expr, int], Set[tuple[object, ...]]]
    ) -> StageSlope:
        parts: list[Value] = []
        for j, value in enumerate(self._values_given.get(slope.name, ())):
            keys = shapes.get((slope.callee, j), frozenset())
            if isinstance(value, Form) and len(keys) == 1:
                parts += [self._part(value.terms, [key]) for key in next(iter(keys))]
            else:
                parts += components_of(value)
        return replace(slope, args=tuple(map(terms_of, parts)))

    def negated(self, value: Value) -> Value:
        """The value with the other sign."""
        is_form = isinstance(value, Form)
        return self.combined("-", ZERO, value) if is_form else super().negated(value)

    def combined(self, sign: str, x: Value, y: Value) -> Value:
        """An operation, on polynomials term by term."""
        sign = sign.removeprefix(".")
        is_matrix_product = sign == "*" and self.base == 1 and not self.has_whole_quotients
        if sign == "@" or (is_matrix_product and isinstance(x, Array) and isinstance(y, Array)):
            return self._weighted(x, y)
        if isinstance(x, Array) != isinstance(y, Array) and any(
            isinstance(z, Form) for z in (x, y)
        ):
            return self._entrywise(sign, x, y)
        left, right = terms_of(x), terms_of(y)
        if sign == "^" and left and (power := whole_number(y)) in (2, 3):
            return self.combined("*", x, self.combined("^", x, integer(power - 1)))
        if sign == "^" and left and power == 1:
            return x
        if sign == "-" and (name := difference(left, right)):
            head, step = name.removeprefix("step@"), Form({(name,): ONE})
            self._later[f"{head}@1"] = Form({(head,): ONE, (name,): ONE})
            return step
        if not isinstance(x, Form) and not isinstance(y, Form):
            return super().combined(sign, x, y)
        if left is None or right is None or len(left) * len(right) > MAX_TERMS:
            return self.unknown("an operation")
        terms: dict[tuple[str, ...], Value] = {}
        if sign in {"+", "-"}:
            terms.update(left)
            for at, value in right.items():
                terms[at] = computed(sign, terms.get(at, ZERO), value, 0)
        elif sign == "*" or (sign == "/" and not any(right)):
            for at, value in left.items():
                for other, factor in right.items():
                    both = tuple(sorted((*at, *other)))
                    product = computed(sign, value, factor, 0)
                    terms[both] = computed("+", terms.get(both, ZERO), product, 0)
        else:
            return self.unknown("an operation")
        return Form({at: z for at, z in terms.items() if not is_zero(z)})

    def _entrywise(self, sign: str, x: Value, y: Value) -> Value:
        """An operation on an unknown value and a list: a vector with its entries, or a factor."""
        count = max(len(items_of(x)), len(items_of(y)))
        each = [self._entries_of(z, count, sign in {"+", "-"}) for z in (x, y)]
        return self.array(self.combined(sign, *pair) for pair in zip(*each, strict=True))

    def _entries_of(self, value: Value, count: int, is_vector: bool) -> list[Value]:
        if isinstance(value, Array):
            return value.items
        if not is_vector or not isinstance(value, Form):
            return [value] * count
        return [
            self._part(value.terms, [(key_of({(): integer(i + self.base)}),)]) for i in range(count)
        ]

    def _weighted(self, x: Value, y: Value) -> Value:
        """The product of lists of stages and of weights."""
        lists = [[z for of in items_of(v) for z in items_of(of) or [of]] for v in (x, y)]
        are_open = [any(isinstance(z, Form) for z in of) for of in lists]
        if len(lists[0]) == len(lists[1]) and sum(are_open) == 1:
            return self._dot(*lists)
        return self.unknown("a product") if any(are_open) else super().combined("*", x, y)

    # the result

    def follow(self, space: Space) -> None:
        """Evaluates the statements."""
        self._space = space
        try:
            self._run(tuple(self._way), space)
        except OutOfSteps:
            self._is_lost = True

    def roles(self, space: Space) -> Roles:
        """A, b, c and the error of the step in the statements.

        Raises:
            NoStep: there is none.
        """
        self.follow(space)
        self._slopes = self._aligned()
        slopes = [x for x in self._slopes if callee_name(x.callee) not in MATHEMATICS]
        slopes = without_steps(slopes)
        if self._is_lost or not 0 < len(slopes) <= MAX_STAGES:
            raise NoStep(self.looks_like)
        values = with_parts(space)
        if kept := kept_names(values):
            # x = xs[n] at the end of a turn
            slopes = [replace(x, args=tuple(renamed(y, kept) for y in x.args)) for x in slopes]
            forms = {name: renamed(terms_of(x), kept) for name, x in values.items()}
            values = {
                name: x if (y := forms[name]) is None else Form(y) for name, x in values.items()
            }
        returned = [x for name in self._returned for x in values if _PARTED.split(x)[0] == name]
        of_f = {x.callee for x in slopes}
        others = [y for x in self._slopes if x.callee not in of_f for y in x.args if y]
        try:
            roles, self.is_open = step_in(slopes, values, returned, self._counters, others)
        except NoStep as error:
            try:
                roles = nystrom_in(slopes, values, returned)
            except NoStep:
                raise NoStep(self.looks_like, error.is_idle) from None
        if len(items_of(roles["b"])) < 2 and self._may_have_changed(slopes, values):
            raise NoStep(self.looks_like)
        factors = {
            name
            for slope in slopes
            for form in slope.args
            for at in form or ()
            for name in at
            if len(at) == 2 and " " not in name
        }
        if self._ignores_others and (
            # a single stage is changed by the others
            len(items_of(roles["b"])) < 2
            # a slope that nothing uses may have changed
            or len(items_of(roles["b"])) < len(slopes)
            # what is given the step may go on with it
            or factors & self._given
        ):
            raise NoStep(self.looks_like)
        return roles

    def _may_have_changed(self, slopes: Sequence[StageSlope], values: Mapping[str, Value]) -> bool:
        """Whether a function that is called for its effect is no vector field, and is given a sum
        with slopes, which it may change: a guess that it improves.
        """
        forms = [form for value in values.values() if (form := terms_of(value))]
        forms += [form for x in slopes for form in x.args if form]
        used = {name for form in forms for at in form if len(at) > 1 for name in at}
        fields = {x.callee for x in slopes if x.name in used}
        return any(
            x.name in self._effects
            and x.callee not in fields
            and any(is_sum_with_slopes(form or {}) for form in x.args)
            for x in slopes
        )

    @property
    def may_ignore_others(self) -> bool:
        """Whether there may be a step without them."""
        return self.has_others and not self._is_lost

    @property
    def looks_like(self) -> bool:
        """Whether f is evaluated at ``x + h*k`` with another value k of f, also in a loop."""
        if self._has_step_inside:
            return True
        slopes = [x for x in self._slopes if callee_name(x.callee) not in MATHEMATICS]
        called = {x.name: x.callee for x in slopes}
        return any(
            called.get(name) == called.get(x.name, "") and any(len(each) == 1 for each in form)
            for x in self._slopes
            if len(x.args) > 1
            for form in x.args
            if form
            for at in form
            for name in at
            if len(at) == 2
        )


def _is_scaled(terms: Terms, name: str) -> bool:
    """Whether a polynomial is the product of a name and others, none of them a slope."""
    (at, *others) = terms or [()]
    return not others and len(at) == len({*at}) > 1 and name in at and " " not in "".join(at)


_PARTED = re.compile(r"[.\[]")
_SHORT = re.compile("[0-9]{1,6}")
_NO_FIELDS = MATHEMATICS | ELEMENTARY


def _for_effect(way: Sequence[ir.Statement]) -> list[ir.Statement]:
    """The statements with calls for their effect in place of assignments of unused return values,
    ``status = f(t, x, k)``.
    """
    if not any(isinstance(x, ir.Assign) and _is_effect(x.value) for x in way):
        return list(way)
    used: set[object] = set()
    with_values: set[ir.Expr] = set()
    for x in reversed(way):
        if isinstance(x, ir.Assign):
            if isinstance(x.value, ir.Call) and x.target in used:
                with_values.add(x.value.callee)
            used.update(x.names)
            if not isinstance(x.target, ir.Name):
                # file << x << y
                used.update(y for y in ir.inside(x.target) if isinstance(y, ir.Name))
        else:
            used |= x.every_name
    return [
        ir.Do(x.value, x.line)
        if isinstance(x, ir.Assign)
        and isinstance(x.target, ir.Name)
        and _is_effect(x.value)
        and x.value.callee not in with_values
        else x
        for x in way
    ]


def _changed_parameters(function: ir.Scope) -> list[str]:
    """The parameters with entries or fields that a function changes."""
    targets = (x.target for x in ir.statements(function.body) if isinstance(x, ir.Assign))
    changed = {y for x in targets if isinstance(x, ir.Index | ir.Field) for y in names_of(x)}
    return [x for x in function.parameters if x in changed]


def _end_of(of: ir.Expr) -> ir.Expr:
    """The place behind the end of a list that is unknown."""
    return ir.Index(of, (ir.Name("the end"),))


def _steps_from(at: ir.Expr, counters: Sequence[str]) -> int | None:
    """The number of steps from a counter to an index; None for other indices."""
    match at:
        case ir.Name(name) if name in counters:
            return 0
        case ir.Binary("+" | "-" as sign, ir.Name(name), ir.Literal(text)) if name in counters:
            return int(f"{sign}{text}") if _SHORT.fullmatch(text) else None
        case ir.Binary("+", ir.Literal(text), ir.Name(name)) if name in counters:
            return int(text) if _SHORT.fullmatch(text) else None
    return None


def _evaluates(function: ir.Scope, is_local: bool) -> bool:
    """Whether a function calls another one that is given to it, or that is a field; a local one
    calls what is given to the function around it.
    """
    for x in ir.parts_of(function.body):
        match x:
            case ir.Call(ir.Name(name)) if name in function.parameters:
                return True
            case ir.Call(callee=callee) if is_local and callee_name(callee) not in NO_SLOPES:
                return True
            case ir.Call(ir.Field(name=name), (_, _, *_)) if name.lower() not in _NO_FIELDS:
                return True
    return False


def _has_branches(body: ir.Body) -> bool:
    return any(isinstance(x, ir.Branch) for x in ir.statements(body))


def _is_effect(value: ir.Expr | None) -> TypeGuard[ir.Call]:
    """Whether a call may write a slope into one of its arguments, in Julia the first one."""
    match value:
        case ir.Call(callee, (ir.Name(), _, *_), ()) if callee_name(callee).endswith("!"):
            pass
        case ir.Call(callee, (_, *others), ()) if any(map(_is_place, others)):
            pass
        case _:
            return False
    if any(isinstance(x, ir.Text) for x in ir.inside(value)):
        # output to a file
        return False
    names = {callee_name(callee)} & (COPIES | TELLING)
    return (callee_name(callee), len(value.args)) not in SUMS and not names


def _is_of_rest(expr: ir.Expr) -> bool:
    """Whether it stands for further arguments, which are the same in all calls: ``*args``."""
    return isinstance(expr, ir.Opaque) and "splat" in expr.reason


def _is_place(expr: ir.Expr) -> bool:
    """Whether a value may be stored there: a name, an entry ``k[0]``, or a field."""
    of = expr.of if isinstance(expr, ir.Index | ir.Field) else expr
    return isinstance(of, ir.Name)


def _with_results(
    callee: ir.Expr, places: Sequence[int], way: Sequence[ir.Statement]
) -> list[ir.Statement]:
    """The statements with ``k, l = f(x, y)`` in place of ``f(x, y, k, l)``, if these names are
    others in each of several calls.
    """
    made: list[ir.Statement] = []
    results: list[ir.Expr] = []
    for x in way:
        match x:
            case ir.Do(ir.Call(of, args, named), line) if of == callee:
                targets = [args[i] for i in places]
                results += targets
                others = tuple(y for i, y in enumerate(args) if i not in places)
                x = ir.Assign(ir.Items(tuple(targets)), ir.Call(of, others, named), line)
        made.append(x)
    is_called_once = len(results) == len(places)
    return list(way) if is_called_once or len({*results}) < len(results) else made


def _places_changed(callee: ir.Expr | None, way: Iterable[ir.Statement]) -> list[int]:
    """The arguments that a function may change: those with values that are used elsewhere, and no
    sum before, unlike arguments of f.
    """
    if callee is None:
        return []
    assigned = [x for x in ir.statements(way) if isinstance(x, ir.Assign)]
    used = {y for x in assigned for y in x.names}
    sums: set[str] = set()
    changed: list[list[bool]] = []
    for x in ir.statements(way):
        match x:
            case ir.Assign(target) if any(map(is_sum, x.parts)):
                sums |= {*names_of(target)}
            case ir.Do(ir.Call(of, args)) if of == callee:
                names = [{y for y in ir.inside(z) if isinstance(y, ir.Name)} for z in args]
                changed.append(
                    [
                        _is_place(arg) and bool(own & used) and sums.isdisjoint(y.name for y in own)
                        for arg, own in zip(args, names, strict=True)
                    ]
                )
    if len({*map(len, changed)}) != 1:
        return []
    return [i for i, of in enumerate(zip(*changed, strict=True)) if all(of)]


def _is_over_components(name: str, body: ir.Body) -> bool:
    """Whether a loop computes arrays entry by entry, with nothing across entries."""
    body = tuple(x for x in body if not (isinstance(x, ir.Do) and _tells_entry(x.value, name)))
    assigned = [x for x in body if isinstance(x, ir.Assign)]
    entries = [x for x in assigned if isinstance(x.target, ir.Index)]
    others = [x for x in assigned if not isinstance(x.target, ir.Index)]
    are_own = all(ir.Name(name) in x.target.at for x in entries if isinstance(x.target, ir.Index))
    are_plain = len(assigned) == len(body) and not any(x.sign for x in others)
    inner = body[0] if len(body) == 1 else None
    if isinstance(inner, ir.Loop):
        return bool(inner.name) and _is_over_components(inner.name, inner.body)
    return are_plain and are_own and bool(entries)


def _tells_entry(value: ir.Expr, name: str) -> bool:
    """Whether a call stores or prints an entry, at the index with a name."""
    is_of_entry = any(x == ir.Name(name) for x in ir.inside(value))
    return isinstance(value, ir.Call) and tells(callee_name(value.callee)) and is_of_entry


def is_of_fortran(like: Evaluator) -> bool:
    return like.base == 1 and like.has_whole_quotients


def counter_of(statement: ir.Statement) -> Iterator[str]:
    """The name that a statement counts: ``n += 1``, ``n = n + 1``."""
    match statement:
        case ir.Assign(ir.Name(name), ir.Literal("1"), sign="+"):
            yield name
        case ir.Assign(ir.Name(name), ir.Binary("+", ir.Name(old), ir.Literal("1"))):
            yield from [name] if name == old else []
