"""The tableaus of steps that are written out as computations.

A function evaluates f several times, ``call f(t + h/2, x + h/2*k1, k2)`` or ``k2 = f(…)``, and adds
multiples of the slopes to its first value, at once or in loops over components. It is evaluated
again, with polynomials in the unknown names: the time, the value, the step and the slopes; all
paths through branches must give the same step. Nothing is guessed from names, and a computation
that does not fit gives no table.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice, pairwise
from typing import Any, TypeGuard

from garkcli.frozen import Frozen, replace
from garkcli.sources import ir
from garkcli.sources.evaluate import Evaluator, OutOfSteps, Space, names_of, shown
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.known import CONVERSIONS
from garkcli.sources.values import (
    ONE,
    ZERO,
    Array,
    Form,
    Number,
    SourceRecord,
    Terms,
    Unknown,
    Value,
    computed,
    is_zero,
    items_of,
    near,
)

MAX_TERMS = 4 * MAX_STAGES
MAX_WAYS = 8
"""Most paths through a function."""
FEWEST_TURNS = 5
"""Fewest alternating calls of a splitting."""
NEAR = 1e-3
"""Sums that differ by less are equal."""
Roles = dict[str, Value]
Place = tuple[str, ...]


class NoStep(Exception):
    """The computation is no step of a Runge–Kutta method.

    Args:
        looks_like: whether it looks like one: f is evaluated at ``x + h*k`` with another value k of
            f.
    """

    def __init__(self, looks_like: bool = False) -> None:
        super().__init__()
        self.looks_like = looks_like


class _Slope(Frozen):
    """An evaluation of f: its name in polynomials, the callee and its arguments."""

    name: str
    callee: ir.Expr
    args: tuple[Terms | None, ...]


def step_of(body: ir.Body, space: Space, like: Evaluator, is_function: bool = True) -> Roles:
    """A, b, c and the error of the step of a function, or of a loop in it over time.

    Args:
        body: of the function.
        space: the names around it.
        like: an evaluator of its language.
        is_function: whether all of it may be a step, not only the loops.

    Raises:
        NoStep: there is none.
    """
    try:
        if not is_function:
            raise NoStep
        return _by_every_way(body, space, like)
    except NoStep as error:
        of_loops = list(_in_loops(body, space, like))
        if len({shown(SourceRecord("", x)) for x in of_loops}) != 1:
            raise NoStep(error.looks_like or bool(of_loops)) from None
        return of_loops[0]


def splitting_of(body: ir.Body, space: Space, like: Evaluator) -> Roles:
    """The weights of two functions called in alternation with parts of one step, ``x.drift(0.5*h);
    x.kick(h)``; those of the first one count as drifts.

    Raises:
        NoStep: there are no such calls.
    """
    follower, names = Follower(like, ()), Space(space)
    turns: list[tuple[str, Place, Value]] = []
    for statement in body:
        match statement:
            case ir.Do(value=ir.Call(callee, (part,), ())) if name := _name(callee):
                form = _terms(follower.value(part, names)) or {}
                turns += [(name, at, x) for at, x in form.items() if at and len(form) == 1]
    callees = list(dict.fromkeys(name for name, _, _ in turns))
    are_in_turns = all(x[0] != y[0] for x, y in pairwise(turns))
    if len(turns) < FEWEST_TURNS or len(callees) != 2 or not are_in_turns:
        raise NoStep
    drifts, kicks = ([x for name, _, x in turns if name == callee] for callee in callees)
    if len({at for _, at, _ in turns}) > 1 or any(
        abs(near(*x) - 1) > NEAR for x in (drifts, kicks)
    ):
        raise NoStep
    kicks += [ZERO] * (len(drifts) - len(kicks))
    return {"drifts": Array([*drifts]), "kicks": Array([*kicks])}


def _by_every_way(
    body: ir.Body, space: Space, like: Evaluator, counters: Sequence[str] = ()
) -> Roles:
    """The common step of all paths through some statements.

    Raises:
        NoStep: there is none.
    """
    by_content: dict[object, Roles] = {}
    is_lost = False
    for way in reversed(_ways(body)):
        follower = Follower(like, way, counters)
        try:
            try:
                roles = follower.roles(Space(space))
            except NoStep:
                if not follower.has_others:
                    raise
                roles = Follower(like, way, counters, ignores_others=True).roles(Space(space))
        except NoStep as error:
            if error.looks_like:
                raise
            is_lost = True
        else:
            by_content[shown(SourceRecord("", roles))] = roles
    if is_lost or len(by_content) != 1:
        raise NoStep(looks_like=bool(by_content))
    return by_content.popitem()[1]


def _in_loops(
    body: ir.Body, space: Space, like: Evaluator, counters: Sequence[str] = ()
) -> Iterator[Roles]:
    """The steps with several stages in loops over time."""
    for statement in body:
        arms = statement.arms if isinstance(statement, ir.Branch) else ()
        for arm in arms:
            yield from _in_loops(arm, space, like, counters)
        if not isinstance(statement, ir.Loop):
            continue
        names = (*counters, *_counted(statement))
        try:
            roles = _by_every_way(statement.body, space, like, names)
        except NoStep:
            yield from _in_loops(statement.body, space, like, names)
        else:
            if len(items_of(roles["b"])) > 1:
                yield roles


def _counted(loop: ir.Loop) -> Iterator[str]:
    """The counters of a loop."""
    if loop.name:
        yield loop.name
    for x in loop.body:
        # n += 1; n = n + 1
        match x:
            case ir.Assign(ir.Name(name), ir.Literal("1"), sign="+"):
                yield name
            case ir.Assign(ir.Name(name), ir.Binary("+", ir.Name(old), ir.Literal("1"))):
                yield from [name] if name == old else []


def _ways(body: ir.Body) -> list[list[ir.Statement]]:
    """The paths through some statements, without arms that return; with too many paths branches
    stay.
    """
    found: list[list[ir.Statement]] = [[]]
    for statement in body:
        arms: list[list[ir.Statement]] = [[statement]]
        if isinstance(statement, ir.Branch):
            staying = [x for x in statement.arms if not (x and isinstance(x[-1], ir.Return))]
            arms = [way for arm in staying for way in _ways(arm)]
            if not statement.is_total:
                arms.append([])
        if len(found) * len(arms) > MAX_WAYS:
            arms = [[statement]]
        found = [[*way, *arm] for way in found for arm in arms]
    return found


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
            used.update(y for y in ir.inside(x.value) if isinstance(y, ir.Name))
        else:
            used.update(y for y in ir.inside(x) if isinstance(y, ir.Name))
    return [
        ir.Do(x.value, x.line)
        if isinstance(x, ir.Assign)
        and isinstance(x.target, ir.Name)
        and _is_effect(x.value)
        and x.value.callee not in with_values
        else x
        for x in way
    ]


class Follower(Evaluator):
    """Evaluates statements without branches, with polynomials for unknown names.

    Args:
        like: an evaluator of the language.
        way: the statements.
        counters: names that count steps: ``x[n]`` is a value like x.
        ignores_others: whether to ignore other functions that are called for their effect like f,
            such as limiters or output; then all slopes must be used.

    Attributes:
        has_others: whether there are such functions.
    """

    def __init__(
        self,
        like: Evaluator,
        way: Sequence[ir.Statement],
        counters: Sequence[str] = (),
        ignores_others: bool = False,
    ) -> None:
        super().__init__(like.base, like.allowance, has_whole_quotients=like.has_whole_quotients)
        # in languages with arrays from 0 functions may return a status
        self._way = _for_effect(way) if like.base == 0 else way
        self._counters = counters
        self._ignores_others = ignores_others
        self.has_others = False
        calls = [x.value for x in self._way if isinstance(x, ir.Do) and _is_effect(x.value)]
        callees = [x.callee for x in calls]
        self._f = max(callees, key=callees.count, default=None)
        self._place = _place_changed([x for x in calls if x.callee == self._f], self._way)
        self._has_step_inside = False
        self._slopes: list[_Slope] = []
        self._values = 0
        self._returned: list[str] = []
        self._is_lost = False
        self._components: list[str] = []
        self._spans: dict[int, ir.Expr] = {}
        self._space = Space()

    def _step(self, statement: ir.Statement, space: Space) -> None:
        match statement:
            case ir.Do(value=ir.Call() as call):
                self._changing(call, space)
            case ir.Do(value=ir.Opaque()) | ir.Scope(kind="entry" | "module"):
                self._is_lost = True
            case ir.Assign(value=None) | ir.Do() | ir.Scope():
                pass
            case ir.Branch():
                self._lose([statement], space)
            case ir.Return(value=value):
                for i, x in enumerate(value.items if isinstance(value, ir.Items) else [value]):
                    name = x.name if isinstance(x, ir.Name) else f"value {i} of the function"
                    if not isinstance(x, ir.Name):
                        self._store(ir.Name(name), self.value(x, space), space, self.line)
                    self._returned.append(name)
            case _:
                super()._step(statement, space)

    def _loop(self, loop: ir.Loop, space: Space) -> None:
        if loop.name and _is_over_components(loop.name, loop.body):
            self._is_lost |= self._spans.setdefault(len(self._components), loop.over) != loop.over
            self._components.append(loop.name)
            self._run(loop.body, space)
            self._components.pop()
            return
        self._lose(loop.body, space)
        # one step after the other
        inside = Follower(self, loop.body, (*self._counters, loop.name))
        inside.follow(Space(space.up))
        self._has_step_inside |= inside.looks_like

    def _changing(self, call: ir.Call, space: Space) -> None:
        """Executes a call for its effect: a copy, a sum, an evaluation of f, or a change of its
        arguments.
        """
        match call:
            case ir.Call(callee, (target, source, *_), ()) if _name(callee) in _COPIES:
                self._store(target, self.value(source, space), space, self.line)
            case ir.Call(ir.Field(of=ir.Name() as of, name="Add"), (factor, term), ()):
                self._added("+ * x", (of, factor, term), space)
            case ir.Call(callee, given, ()) if roles := _SUMS.get((_name(callee), len(given))):
                self._added(roles, given, space)
            case ir.Call(callee, (*args,), ()) if _is_effect(call):
                if callee != self._f and self._is_ignored(call, space):
                    return
                place = self._place if callee == self._f else -1
                target = args.pop(0 if _name(callee).endswith("!") else place)
                values = [self.value(x, space) for x in args]
                for x, value in zip(args, values, strict=True):
                    if callee != self._f and any(" " in x for x in _symbols([_terms(value) or {}])):
                        # slopes may have changed
                        self.spoil(x, space, "changed elsewhere", self.line)
                self._store(target, self._slope(callee, values), space, self.line)
            case ir.Call(ir.Name(name) | ir.Field(name=name)) if name.lower() in _TELLING:
                pass
            case _:
                if not self._is_ignored(call, space):
                    self._lose([ir.Do(call, self.line)], space)

    def _is_ignored(self, call: ir.Call, space: Space) -> bool:
        """Whether a call changes nothing that matters: it gets no slope, only values of y."""
        of = [call.callee.of] if isinstance(call.callee, ir.Field) else []
        forms = [_terms(self.value(x, space)) or {} for x in (*call.args, *of) if _is_place(x)]
        has_slope = any(
            any(" " in name for at in form for name in at)
            and not any(len(at) == 1 and " " not in at[0] for at in form)
            for form in forms
        )
        is_other = not has_slope and not _name(call.callee).endswith("!")
        self.has_others |= is_other
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
        target = self._array_behind(target)
        if isinstance(target, ir.Name):
            # names are in the order of their last assignments
            space.pop(target.name, None)
        super()._store(target, value, space, line)

    def _places(self, target: ir.Expr, space: Space) -> list[tuple[Any, Any]]:
        if isinstance(target, ir.Name) and isinstance(space.find(target.name), Unknown):
            # names assigned in the function are unknown before it is followed
            space.setdefault(target.name, self.unknown("never assigned"))
        return super()._places(target, space)

    def _taken_apart(self, target: ir.Items, value: Value, space: Space, line: int) -> None:
        if isinstance(value, Array) or any(name in space for name in names_of(target)):
            super()._taken_apart(target, value, space, line)

    # values

    def _named(self, name: str, space: Space) -> Value:
        if name in space:
            return space[name]
        named_value = super()._named(name, space)
        has_numbers = any(isinstance(x, Number) for x in Array([named_value]).flat())
        return named_value if has_numbers else Form({(name,): ONE})

    def _entry(self, expr: ir.Index, space: Space) -> Value:
        whole = self._array_behind(expr)
        if whole is expr and len(expr.at) > 1 and self.base == 1 and self.has_whole_quotients:
            # f(t, y) in Fortran
            of = self.value(expr.of, space)
            if isinstance(of, Form) and of.terms.keys() == {(getattr(expr.of, "name", ""),)}:
                return self._slope(expr.of, [self.value(x, space) for x in expr.at])
        if whole is expr:
            return super()._entry(expr, space)
        entry = self.value(whole, space)
        return self.unknown("an entry") if isinstance(entry, Array) else entry

    def _array_behind(self, expr: ir.Expr) -> ir.Expr:
        """The array behind an entry that a loop over components takes, or a thread its own one."""
        names = {*self._components, *self._counters}
        if isinstance(expr, ir.Index):
            unknown = (x for x, value in self._space.items() if isinstance(value, Unknown))
            names.update(islice(unknown, 1))
        while isinstance(expr, ir.Index) and all(
            isinstance(x, ir.Name) and x.name in names for x in expr.at
        ):
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
        return ir.Name(expr.of.name + (f"@{steps[0]}" if steps[0] else ""))

    def _called(self, call: ir.Call, space: Space) -> Value:
        if call.named:
            return self.unknown("a call with names")
        whole = self._array_behind(ir.Index(call.callee, call.args))
        if isinstance(whole, ir.Name) and (self._components or self._counters):
            # k1(i), entries of classes in C++
            return self.value(whole, space)
        args = [self.value(x, space) for x in call.args]
        match call:
            case ir.Call(ir.Name(name=name), (_,)) if name in CONVERSIONS:
                return args[0]
        if any(isinstance(x, Form) for x in args):
            return self._slope(call.callee, args)
        called_value = super()._called(call, space)
        if isinstance(called_value, Unknown) and not any(
            isinstance(x, Unknown | Array) for x in args
        ):
            # y = state(): a value independent of the step
            self._values += 1
            return Form({(f"value{self._values}",): ONE})
        return called_value

    def _slope(self, callee: ir.Expr, args: Sequence[Value]) -> Value:
        """An evaluation of f; unknown for other calls."""
        forms = tuple(map(_terms, args))
        if self._components or not any(form and any(form) for form in forms):
            return self.unknown("a call")
        slope = f"slope {len(self._slopes)}"
        self._slopes.append(_Slope(slope, callee, forms))
        return Form({(slope,): ONE})

    def negated(self, value: Value) -> Value:
        """The value with the other sign."""
        is_form = isinstance(value, Form)
        return self.combined("-", ZERO, value) if is_form else super().negated(value)

    def combined(self, sign: str, x: Value, y: Value) -> Value:
        """An operation, on polynomials term by term."""
        sign = sign.removeprefix(".")
        left, right = _terms(x), _terms(y)
        if sign == "-" and (name := _difference(left, right)):
            return Form({(name,): ONE})
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
        callees = {x.callee: 0 for x in self._slopes if _name(x.callee) not in _MATHEMATICS}
        for callee in () if self._is_lost or len(self._slopes) > MAX_STAGES else callees:
            try:
                return self._of([x for x in self._slopes if x.callee == callee])
            except NoStep:
                continue
        try:
            return self._of_system([[x for x in self._slopes if x.callee == y] for y in callees])
        except NoStep:
            raise NoStep(self.looks_like) from None

    def _of_system(self, each: Sequence[Sequence[_Slope]]) -> Roles:
        """The roles if several functions make the slopes of several values, ``x' = f(x, v)`` and
        ``v' = g(x, v)``, with the same coefficients.
        """
        known = [x.args for slopes in each for x in slopes]
        if self._is_lost or len(each) < 2 or len({(len(x), len(x[0].args)) for x in each}) > 1:
            raise NoStep
        columns = [[args[i] or {} for args in known] for i in range(len(known[0]))]
        own: list[int] = []
        for slopes in each:
            names = {x.name for x in slopes}
            own += [i for i, forms in enumerate(columns) if names & _symbols(forms)]
        if len({*own}) != len(own) or len(own) != len(each):
            raise NoStep
        by_content: dict[object, Roles] = {}
        for slopes, at in zip(each, own, strict=True):
            others = {*own} - {at}
            separate = [
                replace(x, args=tuple(y for i, y in enumerate(x.args) if i not in others))
                for x in slopes
            ]
            roles = self._of(separate, is_system=True)
            by_content[shown(SourceRecord("", roles))] = roles
        if len(by_content) != 1:
            raise NoStep
        return by_content.popitem()[1]

    @property
    def looks_like(self) -> bool:
        """Whether f is evaluated at ``x + h*k`` with another value k of f, also in a loop."""
        if self._has_step_inside:
            return True
        called = {x.name: x.callee for x in self._slopes if _name(x.callee) not in _MATHEMATICS}
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

    def _of(self, slopes: Sequence[_Slope], is_system: bool = False) -> Roles:
        """The roles for the evaluations of f, or of one of several such functions."""
        names = [x.name for x in slopes]
        width = len(slopes[0].args)
        if any(len(x.args) != width for x in slopes):
            raise NoStep
        columns = [_known_forms(x.args[i] for x in slopes) for i in range(width)]
        seen = [i for i, forms in enumerate(columns) if set(names) & _symbols(forms)]
        values = columns.pop(seen[0] if seen else min(1, width - 1))
        starts = [at[0] for at, x in (values or [{}])[0].items() if len(at) == 1 and _is_one(x)]
        if len(starts) != 1:
            raise NoStep
        start = starts[0]
        if (start,) not in (_terms(self._space.get(start, Form({(start,): ONE}))) or ()):
            # its last value is another one
            raise NoStep
        result, form, second = self._result(start, values)
        step = _step(form, set(names))
        others = {x.name for x in self._slopes} - set(names)
        forms = [_terms(x) or {} for x in self._space.values()]
        if others and not is_system and (len(names) == 1 or others & _besides(forms, step)):
            # values of another function take part in the step
            raise NoStep
        nodes = _nodes(columns, step)
        given = _besides((*values, form), step) - {step, start, *names}
        is_elsewhere = all(len(x) > 1 for x in values)
        if len(given) == 1 and nodes and is_elsewhere and not any(" " in x for x in given):
            # the first slope is an argument; if f is also evaluated at the start, it is a slope of
            # another step
            names, values, nodes = [*given, *names], [{(start,): ONE}, *values], [ZERO, *nodes]
        if not nodes and len(names) < 2:
            raise NoStep
        places = [(x,) for x in names]
        A = [_before(x, (start,), step, places) for x in values]
        b = _before(form, (start,), step, places)
        if abs(near(*b) - 1) > NEAR or not all(isinstance(x, Number) for x in (*b, *nodes)):
            raise NoStep
        unused = [all(is_zero(row[j]) for row in (*A, b)) for j in range(len(b))]
        if self._ignores_others and any(unused):
            raise NoStep
        error: list[Value] = []
        for name in reversed(self._space):
            of_error = _terms(self._space[name])
            if of_error and name != result and _is_error(of_error, step, set(names)):
                error = _before({**of_error, (start,): ONE}, (start,), step, places)
                if result not in self._returned and _are_apart(b, A[-1], error):
                    # either value may be the step
                    raise NoStep
                break
        low = _before(second, (start,), step, places) if second and not error else []
        while len(b) > 1 and all(is_zero(row[-1]) for row in (*A, b, error, low) if row):
            # evaluations for the next step
            A, b, nodes = [x[:-1] for x in A[:-1]], b[:-1], nodes[:-1]
            error, low = error[:-1], low[:-1]
        roles: Roles = {"A": Array([Array(row) for row in A]), "b": Array(b)}
        rows = {"c": nodes, "error": error, "embedded": low}
        return roles | {role: Array(row) for role, row in rows.items() if row}

    def _result(self, start: str, values: Sequence[Terms]) -> tuple[str, Terms, Terms]:
        """The result of the step with its name: the returned value, or the last computed one; for a
        pair the first of its two results, which are no stage values, and the second.

        Raises:
            NoStep: there is no result, or more than two.
        """
        names = [x for x in self._returned if self._ends(x, start)]
        names = names or [x for x in reversed(self._space) if self._ends(x, start)]
        forms = {x: form for x in names if (form := _terms(self._space[x])) is not None}
        others = {
            str(sorted((at, shown(x)) for at, x in form.items())): name
            for name, form in forms.items()
            if form not in values and _is_one_in_all(form)
        }
        if not forms or len(others) > 2:
            raise NoStep
        if len(others) == 2:
            # the last computed value comes first, returned values keep their order
            first, second = [*others.values()][:: 1 if names[0] in self._returned else -1]
            return first, forms[first], forms[second]
        name, form = next(iter(forms.items()))
        return name, form, {}

    def _ends(self, name: str, start: str) -> bool:
        form = _terms(self._space.get(name))
        return form is not None and (start,) in form and len(form) > 1


def _steps_from(at: ir.Expr, counters: Sequence[str]) -> int | None:
    """The number of steps from a counter to an index; None for other indices."""
    match at:
        case ir.Name(name) if name in counters:
            return 0
        case ir.Binary("+" | "-" as sign, ir.Name(name), ir.Literal(text)) if name in counters:
            return int(f"{sign}{text}") if text.isdigit() else None
        case ir.Binary("+", ir.Literal(text), ir.Name(name)) if name in counters:
            return int(text) if text.isdigit() else None
    return None


def _difference(x: Terms | None, y: Terms | None) -> str:
    """The name of the step between two times of an array, ``t[n + 1] - t[n]``; empty for others."""
    names = [next(iter(z))[0] for z in (x, y) if z and len(z) == 1 and len(next(iter(z))) == 1]
    heads = [name.partition("@") for name in names]
    if len(heads) != 2 or heads[0][0] != heads[1][0]:
        return ""
    is_next = int(heads[0][2] or 0) - int(heads[1][2] or 0) == 1
    are_plain = all(z and _is_one(next(iter(z.values()))) for z in (x, y))
    return f"step@{heads[0][0]}" if is_next and are_plain else ""


def _terms(value: Value | None) -> Terms | None:
    """A value as a polynomial; None for other values."""
    if isinstance(value, Number):
        return {(): value}
    return value.terms if isinstance(value, Form) else None


def _known_forms(forms: Iterator[Terms | None]) -> list[Terms]:
    """The polynomials of an argument of f; empty if one is unknown."""
    known = list(forms)
    return [] if None in known else [x for x in known if x is not None]


def _symbols(forms: Iterable[Terms]) -> set[str]:
    return {name for form in forms for at in form for name in at}


def _besides(forms: Iterable[Terms], step: str) -> set[str]:
    """The names in terms with the step."""
    return {name for form in forms for at in form if step in at for name in at}


def _step(form: Terms, names: set[str]) -> str:
    """The name of the step."""
    others = {x for at in form if names & set(at) for x in at if x not in names}
    if len(others) != 1:
        raise NoStep
    return others.pop()


def _nodes(columns: Sequence[Sequence[Terms]], step: str) -> list[Value]:
    """The nodes from the time argument; empty if there is none.

    Raises:
        NoStep: another argument differs between slopes.
    """
    nodes: list[Value] = []
    for forms in columns:
        if len({tuple(sorted(form)) for form in forms}) > 1 or step in _symbols(forms):
            times = {at for form in forms for at in form if at != (step,)}
            if len(times) != 1:
                raise NoStep
            (time,) = times
            nodes = [_before(form, time, step, [()])[0] for form in forms]
    is_single = any(len(forms) == 1 for forms in columns)
    return nodes or [ZERO] * is_single


def _is_one_in_all(form: Terms) -> bool:
    """Whether the slopes times the step have the sum 1, unlike partial sums."""
    return abs(near(*(x for at, x in form.items() if len(at) == 2)) - 1) < NEAR


def _is_one(value: Value) -> bool:
    return isinstance(value, Number) and abs(value.near - 1) < NEAR


def _are_apart(b: Sequence[Value], row: Sequence[Value], error: Sequence[Value]) -> bool:
    """Whether two rows differ by plus or minus an error."""
    return any(
        all(
            abs(near(x) - near(y) + sign * near(z)) < NEAR
            for x, y, z in zip(b, row, error, strict=False)
        )
        for sign in (1, -1)
    )


def _is_error(form: Terms, step: str, names: set[str]) -> bool:
    """Whether it is a sum of slopes times the step with coefficients that cancel."""
    is_sum = all(len(at) == 2 and step in at and names & set(at) for at in form)
    return len(form) > 1 and is_sum and abs(near(*form.values())) < NEAR


def _before(form: Terms, base: Place, step: str, places: Sequence[Place]) -> list[Value]:
    """The coefficients of the step times each of some names, in a polynomial ``base`` + ….

    Raises:
        NoStep: there are other terms.
    """
    rest = {at: x for at, x in form.items() if not is_zero(x)}
    is_based = _is_one(rest.pop(base, ZERO))
    row = [rest.pop(tuple(sorted((*x, step))), ZERO) for x in places]
    if rest or not is_based:
        raise NoStep
    return row


def _is_effect(value: ir.Expr | None) -> TypeGuard[ir.Call]:
    """Whether a call may write a slope into one of its arguments, in Julia the first one."""
    match value:
        case ir.Call(callee, (ir.Name(), _, *_), ()) if _name(callee).endswith("!"):
            pass
        case ir.Call(callee, (_, *others), ()) if any(map(_is_place, others)):
            pass
        case _:
            return False
    names = {_name(callee)} & (_COPIES | _TELLING)
    return (_name(callee), len(value.args)) not in _SUMS and not names


def _is_place(expr: ir.Expr) -> bool:
    """Whether a value may be stored there: a name, an entry ``k[0]``, or a field."""
    of = expr.of if isinstance(expr, ir.Index | ir.Field) else expr
    return isinstance(of, ir.Name)


def _place_changed(calls: Sequence[ir.Call], way: Iterable[ir.Statement]) -> int:
    """The argument that a function changes: the last one with values that are used elsewhere,
    otherwise the last one.
    """
    if not any(_is_place(x) for call in calls for x in call.args[1:-1]):
        return -1
    assigned = (x.value for x in ir.statements(way) if isinstance(x, ir.Assign))
    used = {y for x in assigned for y in ir.inside(x) if isinstance(y, ir.Name)}
    counts = {len(x.args) for x in calls}
    for i in reversed(range(1, counts.pop())) if len(counts) == 1 else ():
        arguments = [x.args[i] for x in calls]
        if all(map(_is_place, arguments)) and used & {y for x in arguments for y in ir.inside(x)}:
            return i
    return -1


def _is_over_components(name: str, body: ir.Body) -> bool:
    """Whether a loop computes arrays entry by entry, with nothing across entries."""
    assigned = [x for x in body if isinstance(x, ir.Assign)]
    entries = [x for x in assigned if isinstance(x.target, ir.Index)]
    others = [x for x in assigned if not isinstance(x.target, ir.Index)]
    are_own = all(ir.Name(name) in x.target.at for x in entries if isinstance(x.target, ir.Index))
    are_plain = len(assigned) == len(body) and not any(x.sign for x in others)
    inner = body[0] if len(body) == 1 else None
    if isinstance(inner, ir.Loop):
        return bool(inner.name) and _is_over_components(inner.name, inner.body)
    return are_plain and are_own and bool(entries)


def _name(callee: ir.Expr) -> str:
    return callee.name.lower() if isinstance(callee, ir.Name | ir.Field) else ""


_TELLING = {
    *("print", "println", "printf", "fprintf", "disp", "append", "push", "push_back", "add"),
    *("push!", "emplace_back", "write", "writeln"),
}
"""Functions that store or print their arguments without changing them."""
_COPIES = {"memcpy", "dbl_memcpy", "copyto!"}
"""Functions that assign their second argument to their first."""
_SUMS = {
    (name, len(roles.split())): roles
    for name, roles in (
        *(("add", "x x ="), ("add", "x * x ="), ("add", "* x * x ="), ("vecwaxpy", "= * x x")),
        *(("vecaxpy", "+ * x"), ("n_vlinearsum", "* x * x ="), ("axpy!", "* x +")),
    )
}
"""Functions that add vectors, by name and number of arguments: of MFEM, PETSc and SUNDIALS."""
_MATHEMATICS = {
    *("min", "max", "minimum", "maximum", "fmin", "fmax", "amin", "amax", "clamp", "clip"),
    *("hypot", "atan2", "arctan2", "pow", "power", "mod", "rem", "div", "fmod", "copysign"),
    *("dot", "cross", "kron", "norm", "axpy", "isclose", "allclose", "merge", "ifelse", "where"),
}
"""Functions of two numbers in various languages."""
