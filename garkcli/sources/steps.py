"""The tableaus of steps that are written out as computations.

A function evaluates f several times, ``call f(t + h/2, x + h/2*k1, k2)`` or ``k2 = f(…)``, and adds
multiples of the slopes to its first value, at once or in loops over components. It is evaluated
again, with polynomials in the unknown names: the time, the value, the step and the slopes; all
paths through branches must give the same step. Nothing is guessed from names, and a computation
that does not fit gives no table.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, TypeGuard

from garkcli.sources import ir
from garkcli.sources.evaluate import MAX_INLINED, Evaluator, Made, OutOfSteps, names_of, shown
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.known import CONVERSIONS
from garkcli.sources.stages import NEAR, NoStep, Roles, StageSlope, step_in, terms_of, without_steps
from garkcli.sources.step_hints import Hints
from garkcli.sources.step_words import (
    CHANGING,
    COPIES,
    MATHEMATICS,
    NO_SLOPES,
    OPERATIONS,
    SUMS,
    TELLING,
    callee_name,
    is_sum,
    tells,
)
from garkcli.sources.values import (
    NULL,
    ONE,
    ZERO,
    Array,
    Form,
    Number,
    SourceRecord,
    Space,
    Terms,
    Unknown,
    Value,
    computed,
    copied,
    is_zero,
    items_of,
    near,
)
from garkcli.sources.written_out import with_functions

MAX_TERMS = 4 * MAX_STAGES
MAX_WAYS = 8
"""Most paths through a function."""
MAX_TURNS = 20
"""Most turns of a loop over stages."""
MAX_STATEMENTS = 400
"""Most statements of a function that is followed in several ways."""
MAX_STATEMENTS_OF_ONE_STAGE = 20
"""Most statements of a function in which a step of one stage is sought."""
MAX_NUMBERS = 6
"""Most numbers tried as the step."""
FEWEST_TURNS = 5
"""Fewest alternating calls of a splitting."""
Place = tuple[str, ...]


def steps_of(body: ir.Body, space: Space, like: Evaluator, is_function: bool = True) -> list[Roles]:
    """A, b, c and the error of the distinct steps of a function: of all of it, or of the branches
    and the loops over time in it.

    Args:
        body: of the function.
        space: the names around it.
        like: an evaluator of its language.
        is_function: whether all of it may be a step, not only the parts.

    Raises:
        NoStep: there is none.
    """
    looks_like = False
    for has_increments in (None, False, True):
        each = body if has_increments is None else with_functions(body, has_increments)
        try:
            if each is not None:
                return _steps_with_calls(each, space, like, is_function)
        except NoStep as error:
            looks_like |= error.looks_like
    raise NoStep(looks_like)


def _steps_with_calls(
    body: ir.Body, space: Space, like: Evaluator, is_function: bool
) -> list[Roles]:
    hints, count = _hints(body, like), sum(1 for _ in ir.statements(body))
    if not hints.of_step or (count > MAX_STATEMENTS_OF_ONE_STAGE and not hints.of_stages):
        raise NoStep
    evaluations, helpers = _calls_in(body, like)
    is_long = count > MAX_STATEMENTS
    modes = [("", False)]
    if helpers and not is_long:
        modes.append(("", True))
    if evaluations > 1 and not is_long and _has_sums_in_calls(body, like):
        # the step may be a number that is set around it
        modes += [(name, False) for name in _numbers_in(body, space)]
    looks_like = has_helpers = False
    for symbol, is_inlined in modes:
        if is_inlined and not has_helpers:
            continue
        own = Space(space)
        own.update({symbol: Form({(symbol,): ONE})} if symbol else {})
        reader = _StepReader(own, like, is_inlined)
        try:
            if is_function:
                return [reader.by_every_way(body)]
        except NoStep as error:
            looks_like |= error.looks_like
        distinct = {shown(SourceRecord("", x)): x for x in reader.in_parts(body)}
        looks_like |= reader.looks_like
        has_helpers |= reader.has_helpers
        if distinct:
            return [*distinct.values()]
    raise NoStep(looks_like)


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
            case ir.Do(value=ir.Call(callee, (part,), ())) if name := callee_name(callee):
                form = terms_of(follower.value(part, names)) or {}
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


class _StepReader:
    """Reads the steps of statements.

    Args:
        space: the names around them.
        like: an evaluator of their language.
        is_inlined: whether calls of functions of the source are followed.

    Attributes:
        looks_like: whether a part of them looks like a step.
        has_helpers: whether a path has calls that would be followed.
    """

    def __init__(self, space: Space, like: Evaluator, is_inlined: bool) -> None:
        self._space = space
        self._like = like
        self._is_inlined = is_inlined
        self.looks_like = self.has_helpers = False

    def by_every_way(self, body: ir.Body, counters: Sequence[str] = ()) -> Roles:
        """The common step of all paths through some statements. A path without a step is left out,
        unless branches have sums.

        Raises:
            NoStep: there is none.
        """
        by_content: dict[object, Roles] = {}
        is_lost = False
        arms = (arm for x in body if isinstance(x, ir.Branch) for arm in x.arms)
        have_sums = any(map(_has_sums, arms))
        for way in reversed(_ways(body)):
            if is_lost and have_sums and not _hints(way, self._like).of_stages:
                # there is no step, and this path does not look like one
                continue
            follower = self._follower(way, counters)
            try:
                try:
                    roles = follower.roles(Space(self._space))
                except NoStep:
                    if not follower.has_others:
                        raise
                    follower = self._follower(way, counters, ignores_others=True)
                    roles = follower.roles(Space(self._space))
            except NoStep as error:
                if error.looks_like:
                    raise
                is_lost = True
            else:
                by_content[shown(SourceRecord("", roles))] = roles
                self._like.followed |= follower.followed
            finally:
                self.has_helpers |= follower.has_helpers
        if len(by_content) != 1 or (is_lost and have_sums):
            raise NoStep(looks_like=bool(by_content))
        _, roles = by_content.popitem()
        if is_lost and len(items_of(roles["b"])) < 2:
            raise NoStep
        return roles

    def _follower(
        self, way: Sequence[ir.Statement], counters: Sequence[str], ignores_others: bool = False
    ) -> Follower:
        return Follower(self._like, way, counters, ignores_others, self._is_inlined)

    def in_parts(self, body: ir.Body, counters: Sequence[str] = ()) -> Iterator[Roles]:
        """The steps with several stages in branches and in loops over time."""
        for statement in body:
            parts: Iterable[tuple[ir.Body, Sequence[str]]] = ()
            if isinstance(statement, ir.Branch):
                parts = ((_plain(arm), counters) for arm in statement.arms)
            elif isinstance(statement, ir.Loop):
                parts = [(statement.body, (*counters, *_counted(statement)))]
            for inside, names in parts:
                if not _may_evaluate(inside, self._like):
                    continue
                try:
                    roles = self.by_every_way(inside, names)
                except NoStep as error:
                    found = [*self.in_parts(inside, names)]
                    self.looks_like |= error.looks_like and not found
                    yield from found
                else:
                    if len(items_of(roles["b"])) > 1:
                        yield roles


def _hints(body: Sequence[ir.Statement], like: Evaluator) -> Hints:
    return Hints(body, like.functions, like.has_whole_quotients)


def _plain(arm: ir.Body) -> ir.Body:
    """The statements of an arm, also of a case of a switch."""
    return arm[0].body if len(arm) == 1 and isinstance(arm[0], ir.Scope) else arm


def _numbers_in(body: ir.Body, space: Space) -> list[str]:
    """Names of numbers that are factors in some statements."""
    names: dict[str, None] = {}
    for x in ir.parts_of(body):
        match x:
            case ir.Binary("*" | "/", left, right):
                names |= {y.name: None for y in (left, right) if isinstance(y, ir.Name)}
    found = [x for x in names if isinstance(space.find(x), Number)]
    return found if len(found) <= MAX_NUMBERS else []


def _has_sums_in_calls(body: ir.Body, like: Evaluator) -> bool:
    return any(is_sum(y) for x in _calls(body, like) for of in x.args for y in ir.inside(of))


def _may_evaluate(body: ir.Body, like: Evaluator) -> bool:
    """Whether statements call a function several times."""
    evaluations, helpers = _calls_in(body, like)
    return evaluations > 1 or helpers > 0


def _calls_in(body: ir.Body, like: Evaluator) -> tuple[int, int]:
    """The most calls of one function, and the number of functions of the source that are called."""
    counts = Counter(x.callee for x in _calls(body, like) if x.args)
    helpers = sum(getattr(x, "name", "") in like.functions for x in counts)
    return max(counts.values(), default=0), helpers


def _calls(body: ir.Body, like: Evaluator) -> Iterator[ir.Call]:
    """The calls in some statements, in Fortran also those that look like entries, without
    mathematics and output of other sources.
    """
    for x in ir.parts_of(body):
        match x:
            case ir.Call(callee):
                name = getattr(callee, "name", "")
                if name in like.functions or callee_name(callee) not in NO_SLOPES:
                    yield x
            case ir.Index(ir.Name() as callee, (_, _, *_) as at) if _is_of_fortran(like):
                yield ir.Call(callee, tuple(at))


def _is_of_fortran(like: Evaluator) -> bool:
    return like.base == 1 and like.has_whole_quotients


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
    for i, statement in enumerate(body):
        arms: list[list[ir.Statement]] = [[statement]]
        if isinstance(statement, ir.Branch):
            inside = [_plain(x) for x in statement.arms]
            staying = [x for x in inside if not (x and isinstance(x[-1], ir.Return))]
            is_total = statement.is_total
            if not staying and not _has_sums(body[i + 1 :]):
                # a step that is accepted is returned
                accepted = [x for x in inside if _has_sums(x[-1:])]
                others = [x for x in inside if x and not _has_sums(x[-1:])]
                if any(_has_multiples(x[-1:], body[:i]) for x in others):
                    # so is another one
                    accepted = inside
                staying, is_total = accepted or staying, is_total or bool(accepted)
            arms = [way for arm in staying for way in _ways(arm)]
            if not is_total:
                arms.append([])
        if len(found) * len(arms) > MAX_WAYS:
            arms = [[statement]]
        found = [[*way, *arm] for way in found for arm in arms]
    return found


def _has_multiples(body: ir.Body, before: ir.Body) -> bool:
    """Whether a value is a multiple of another one that a function gave before."""
    assigned = [x for x in ir.statements(before) if isinstance(x, ir.Assign)]
    called = [x for x in assigned if any(isinstance(y, ir.Call) for y in x.parts)]
    names = {name for x in called for name in names_of(x.target)}
    products = (x for x in ir.parts_of(body) if isinstance(x, ir.Binary))
    return any(isinstance(y, ir.Name) and y.name in names for x in products for y in ir.inside(x))


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
        has_helpers: whether there are calls that would be followed.
    """

    def __init__(
        self,
        like: Evaluator,
        way: Sequence[ir.Statement],
        counters: Sequence[str] = (),
        ignores_others: bool = False,
        is_inlined: bool = False,
    ) -> None:
        super().__init__(like.base, like.allowance, has_whole_quotients=like.has_whole_quotients)
        self.functions = like.functions
        self._is_inlined = is_inlined
        self._opaque: dict[object, str] = {}
        self._once: dict[object, Value] = {}
        self._later: dict[str, Form] = {}
        # in languages with arrays from 0 functions may return a status
        self._way = _for_effect(way) if like.base == 0 else way
        self._counters = counters
        self._ignores_others = ignores_others
        self.has_others = self.has_helpers = False
        self._given: set[str] = set()
        calls = [x.value for x in self._way if isinstance(x, ir.Do) and _is_effect(x.value)]
        callees = [x.callee for x in calls]
        self._f = max(callees, key=callees.count, default=None)
        self._place = _place_changed(self._f, self._way)
        self._has_step_inside = False
        self._slopes: list[StageSlope] = []
        self._returned: list[str] = []
        self._is_lost = False
        self._components: list[str] = []
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
        if loop.name and _is_over_components(loop.name, loop.body):
            self._is_lost |= self._spans.setdefault(len(self._components), loop.over) != loop.over
            self._components.append(loop.name)
            self._run(loop.body, space)
            self._components.pop()
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
        self.has_helpers |= inside.has_helpers

    def _changing(self, call: ir.Call, space: Space) -> None:
        """Executes a call for its effect: a copy, a sum, an evaluation of f, or a change of its
        arguments.
        """
        match call:
            case ir.Call(callee, (target, source, *_), ()) if callee_name(callee) in COPIES:
                self._store(target, self.value(source, space), space, self.line)
            case ir.Call(ir.Field(of=ir.Name() as of, name="Add"), (factor, term), ()):
                self._added("+ * x", (of, factor, term), space)
            case ir.Call(callee, given, ()) if roles := SUMS.get((callee_name(callee), len(given))):
                self._added(roles, given, space)
            case ir.Call(callee, (*args,), ()) if _is_effect(call):
                if callee != self._f and self._is_ignored(call, space):
                    return
                place = self._place if callee == self._f else -1
                target = args.pop(0 if callee_name(callee).endswith("!") else place)
                values = [self.value(x, space) for x in args]
                for x, value in zip(args, values, strict=True):
                    names = _symbols([terms_of(value) or {}])
                    if callee != self._f and any(" " in name for name in names):
                        # slopes may have changed
                        self.spoil(x, space, "changed elsewhere", self.line)
                self._store(target, self._slope(callee, values), space, self.line)
            case ir.Call(ir.Name(name) | ir.Field(name=name)) if tells(name):
                pass
            case _:
                if not self._is_ignored(call, space):
                    self._lose([ir.Do(call, self.line)], space)

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
        target = self._place_of(self._array_behind(target), space)
        if isinstance(target, ir.Name):
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
        return super()._changed(of, space, made)

    def _taken_apart(self, target: ir.Items, value: Value, space: Space, line: int) -> None:
        if len(target.items) == 1 and not isinstance(value, Array):
            self._store(target.items[0], value, space, line)
        elif isinstance(value, Array) or any(name in space for name in names_of(target)):
            super()._taken_apart(target, value, space, line)

    # values

    def _named(self, name: str, space: Space) -> Value:
        if name in self._later:
            return self._later[name]
        if name in space:
            named_value = space[name]
            if isinstance(named_value, Unknown):
                return Form({(f"{name}'{named_value.line}",): ONE})
            return named_value
        named_value = super()._named(name, space)
        if isinstance(named_value, Form):
            return named_value
        has_numbers = any(isinstance(x, Number) for x in Array([named_value]).flat())
        return named_value if has_numbers else Form({(name,): ONE})

    def _entry(self, expr: ir.Index, space: Space) -> Value:
        whole = self._array_behind(expr)
        if whole is expr and len(expr.at) > 1 and _is_of_fortran(self):
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
            at.append(root.name if isinstance(root, ir.Field) else root.at)
            root = root.of
        of = terms_of(self.value(root, space)) if isinstance(root, ir.Name) else None
        if any(" " in name for name in _symbols([of or {}])):
            # an entry of a slope
            return value
        return self._named_by((tuple(of or ()), *(at or [root])))

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
                at += map(_key, forms)
            root = root.of
        of = self._named(root.name, space) if isinstance(root, ir.Name) else NULL
        if is_known or not isinstance(root, ir.Name) or isinstance(of, Array):
            return expr
        if isinstance(of, Form) and len(of.terms) > 1:
            # an entry of a sum
            return expr
        first, *others = at
        match dict(first) if isinstance(first, tuple) and not others else {}:
            case {} as form if len(form) < 3 and (by := _shift(form)) is not None:
                # y[n], y[n + 1]
                head = next(name for (name,) in filter(None, form))
                return ir.Name(f"{root.name}[{head}]" + (f"@{by}" if by else ""))
        return ir.Name(self._opaque.setdefault((root.name, *at), f"entry{len(self._opaque)}"))

    def _array_behind(self, expr: ir.Expr) -> ir.Expr:
        """The array behind an entry that a loop over components takes, or a thread its own one."""
        names = {*self._components, *self._counters}
        while isinstance(expr, ir.Index):
            at = tuple(x for x in expr.at if not (isinstance(x, ir.Name) and x.name in names))
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
        return ir.Name(expr.of.name + (f"@{steps[0]}" if steps[0] else ""))

    def _called(self, call: ir.Call, space: Space) -> Value:
        whole = self._array_behind(ir.Index(call.callee, call.args))
        name = callee_name(call.callee)
        is_entry = isinstance(whole, ir.Name) and name not in CONVERSIONS
        if is_entry and (self._components or self._counters):
            # k1(i), entries of classes in C++
            return self.value(whole, space)
        match call:
            case ir.Call(ir.Name("list of each"), (ir.Lambda(names, body), over), ()):
                if (each := self._of_each(names, body, over, space)) is not None:
                    return each
        args = [self.value(x, space) for x in call.args]
        args += [x for _, y in call.named if isinstance(x := self.value(y, space), Form)]
        if name in CONVERSIONS and len(args) == 1:
            return args[0]
        of = [self.value(call.callee.of, space)] if isinstance(call.callee, ir.Field) else []
        pair = args if len(args) == 2 else [*of, *args]
        if (
            name in OPERATIONS
            and len(pair) == 2
            and all(isinstance(x, Form | Number) for x in pair)
        ):
            return self.combined(OPERATIONS[name], *pair)
        if (followed := self._followed(call, args)) is not None:
            return followed
        if any(isinstance(x, Form) for x in args):
            forms = [x for x in map(terms_of, args) if x is not None]
            if any(" " in x for x in _symbols(forms)) or len(forms) < len(args):
                return self._slope(call.callee, args)
            # what depends on no slope is the same each time
            key = (call.callee, *map(_key, forms))
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

    def _of_each(
        self, names: Sequence[str], body: ir.Expr, over: ir.Expr, space: Space
    ) -> Value | None:
        """An expression for all components of vectors; None for lists of numbers."""
        inner = Space(space)
        match over:
            case ir.Call(ir.Name("range")) if len(names) == 1 and not items_of(
                self.value(over, space)
            ):
                self._components += names
                value = self.value(body, inner)
                del self._components[-1]
                return value
            case ir.Call(ir.Name("zip"), args, ()) if len(args) == len(names):
                values = [self.value(x, space) for x in args]
            case _ if len(names) == 1:
                values = [self.value(over, space)]
            case _:
                return None
        if not any(isinstance(x, Form) for x in values):
            return None
        inner.update(zip(names, values, strict=True))
        return self.value(body, inner)

    def _followed(self, call: ir.Call, args: Sequence[Value]) -> Value | None:
        """The value of a function of the source that computes with slopes or evaluates f; None for
        others.
        """
        callee = call.callee
        function = (
            self.functions.get(callee.name) if isinstance(callee, ir.Name | ir.Field) else None
        )
        if function is None or self._inlined >= MAX_INLINED:
            return None
        names = [x for x in function.parameters if x not in {"self", "this"}]
        if len(names) != len(args) or not (any(map(_is_of_slopes, args)) or _evaluates(function)):
            return None
        self.has_helpers = True
        if not self._is_inlined:
            return None
        inner = Space(self._space.up)
        inner.update(zip(names, map(copied, args), strict=True))
        self.followed.add(function.line)
        self._inlined += 1
        # its loops have names of their own
        spans, self._spans = self._spans, {}
        self._run(function.body, inner)
        self._spans = spans
        self._inlined -= 1
        return inner.returned

    def _slope(self, callee: ir.Expr, args: Sequence[Value]) -> Value:
        """An evaluation of f; unknown for other calls."""
        forms = tuple(map(terms_of, args))
        if not any(form and any(form) for form in forms):
            return self.unknown("a call")
        slope = f"slope {len(self._slopes)}"
        self._slopes.append(StageSlope(slope, callee, forms))
        return Form({(slope,): ONE})

    def negated(self, value: Value) -> Value:
        """The value with the other sign."""
        is_form = isinstance(value, Form)
        return self.combined("-", ZERO, value) if is_form else super().negated(value)

    def combined(self, sign: str, x: Value, y: Value) -> Value:
        """An operation, on polynomials term by term."""
        sign = sign.removeprefix(".")
        left, right = terms_of(x), terms_of(y)
        if sign == "-" and (name := _difference(left, right)):
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
        slopes = [x for x in self._slopes if callee_name(x.callee) not in MATHEMATICS]
        slopes = without_steps(slopes)
        if self._is_lost or not 0 < len(slopes) <= MAX_STAGES:
            raise NoStep(self.looks_like)
        try:
            roles = step_in(slopes, space, self._returned, self._counters)
        except NoStep:
            raise NoStep(self.looks_like) from None
        factors = {
            name
            for slope in slopes
            for form in slope.args
            for at in form or ()
            for name in at
            if len(at) == 2 and " " not in name
        }
        if self._ignores_others and (
            # a slope that nothing uses may have changed
            len(items_of(roles["b"])) < len(slopes)
            # what is given the step may go on with it
            or factors & self._given
        ):
            raise NoStep(self.looks_like)
        return roles

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
    heads = [match for name in names if (match := _AT_A_STEP.fullmatch(name))]
    if len(heads) != 2 or heads[0]["head"] != heads[1]["head"]:
        return ""
    is_next = int(heads[0]["by"] or 0) - int(heads[1]["by"] or 0) == 1
    are_plain = all(z and _is_one(next(iter(z.values()))) for z in (x, y))
    return f"step@{heads[0]['head']}" if is_next and are_plain else ""


_AT_A_STEP = re.compile(r"(?P<head>.*?)(?:@(?P<by>-?[0-9]{1,6}))?")
"""A value of an array at a step, ``t@1``."""


def _symbols(forms: Iterable[Terms]) -> set[str]:
    return {name for form in forms for at in form for name in at}


def _shift(form: Mapping[Place, str]) -> int | None:
    """The integer added to a name; None for other indices."""
    rest = {at: x for at, x in form.items() if at}
    by = form.get((), "0")
    is_name = [*rest.values()] == ["1"] and all(len(at) == 1 for at in rest)
    return int(by) if is_name and by.lstrip("-").isdigit() else None


def _key(form: Terms) -> object:
    """A key that is equal for equal polynomials."""
    return tuple(sorted((at, str(shown(x))) for at, x in form.items()))


def _is_of_slopes(value: Value) -> bool:
    """Whether it is a multiple of slopes, or an array with such ones, unlike an argument of f."""
    if isinstance(value, Array):
        return any(map(_is_of_slopes, value.flat()))
    form = terms_of(value) or {}
    return bool(form) and all(any(" " in name for name in at) for at in form)


def _evaluates(function: ir.Scope) -> bool:
    """Whether a function calls another one that is given to it, or that is a field."""
    for x in ir.parts_of(function.body):
        match x:
            case ir.Call(ir.Name(name)) if name in function.parameters:
                return True
            case ir.Call(ir.Field(), (_, _, *_)):
                return True
    return False


def _has_sums(body: ir.Body) -> bool:
    return any(map(is_sum, ir.parts_of(body)))


def _has_branches(body: ir.Body) -> bool:
    return any(isinstance(x, ir.Branch) for x in ir.statements(body))


def _is_one(value: Value) -> bool:
    return isinstance(value, Number) and abs(value.near - 1) < NEAR


def _is_effect(value: ir.Expr | None) -> TypeGuard[ir.Call]:
    """Whether a call may write a slope into one of its arguments, in Julia the first one."""
    match value:
        case ir.Call(callee, (ir.Name(), _, *_), ()) if callee_name(callee).endswith("!"):
            pass
        case ir.Call(callee, (_, *others), ()) if any(map(_is_place, others)):
            pass
        case _:
            return False
    names = {callee_name(callee)} & (COPIES | TELLING)
    return (callee_name(callee), len(value.args)) not in SUMS and not names


def _is_place(expr: ir.Expr) -> bool:
    """Whether a value may be stored there: a name, an entry ``k[0]``, or a field."""
    of = expr.of if isinstance(expr, ir.Index | ir.Field) else expr
    return isinstance(of, ir.Name)


def _place_changed(callee: ir.Expr | None, way: Iterable[ir.Statement]) -> int:
    """The argument that a function changes: the last one with values that are used elsewhere, and
    no sum before, unlike arguments of f; otherwise the last one.
    """
    if callee is None:
        return -1
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
        return -1
    places = [i for i, of in enumerate(zip(*changed, strict=True)) if all(of)]
    return places[-1] if places else -1


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
