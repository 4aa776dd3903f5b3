"""Steps that are written out as they are computed: the tableau that they have.

A function evaluates f several times, ``call f(t + h/2, x + h/2*k1, k2)`` or ``k2 = f(…)``, and adds
multiples of the slopes to what it began with, at once or in loops over components. All values are
followed as polynomials in the names that nothing is known of: the time, the value, the step and the
slopes; where the way parts, every way must be the same step. Nothing is guessed from names, and
whatever does not fit makes no table.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.known import CONVERSIONS
from garkcli.sources.values import ONE, ZERO, Array, Number, Value, computed, literal, negative

Form: TypeAlias = Mapping[tuple[str, ...], Value]
"""A polynomial: what is before each product of names, these in order."""
Known: TypeAlias = Callable[[str], Value | None]
"""The number or the array of a name."""
Columns: TypeAlias = Sequence[str]
"""The names of slopes, in order."""
MAX_TERMS = 4 * MAX_STAGES
MAX_WAYS = 8
"""Most ways through a function."""
NEAR = 1e-3
"""Sums that differ by less are meant to be the same."""


class NoStep(Exception):
    """The computation is no step of a Runge–Kutta method.

    Args:
        looks_like: whether it looks like one: f is evaluated at ``x + h*k``, where k is another
            value of f.
    """

    def __init__(self, looks_like: bool = False) -> None:
        super().__init__()
        self.looks_like = looks_like


class _Slope(Frozen):
    """An evaluation of f: its name among the forms, what is called, and what it is given."""

    name: str
    callee: ir.Expr
    args: tuple[Form | None, ...]


def step_of(body: ir.Body, known: Known, has_whole_quotients: bool) -> dict[str, Value]:
    """A, b, c and the error of the step that a function is: the same by every way through it.

    Raises:
        NoStep: it is none.
    """
    found: dict[str, dict[str, Value]] = {}
    for way in _ways(body):
        roles = _step_by(way, known, has_whole_quotients)
        found[" ".join(f"{name} {_shown(x)}" for name, x in roles.items())] = roles
    if len(found) != 1:
        raise NoStep(looks_like=bool(found))
    return found.popitem()[1]


def _step_by(
    way: Sequence[ir.Statement], known: Known, has_whole_quotients: bool
) -> dict[str, Value]:
    """The step of one way, where calls give slopes, or else change their last argument."""
    looks_like = False
    for is_last_changed in (False, True):
        follower = Follower(known, has_whole_quotients, is_last_changed)
        follower.follow(way)
        try:
            return follower.roles()
        except NoStep:
            looks_like |= follower.looks_like
    raise NoStep(looks_like)


def _shown(value: Value) -> str:
    if isinstance(value, Array):
        return f"({' '.join(map(_shown, value.items))})"
    return value.scalar.text if isinstance(value, Number) else "?"


def _ways(body: ir.Body) -> list[list[ir.Statement]]:
    """The ways through some statements; an arm that leaves is none, and too many stay a branch."""
    found: list[list[ir.Statement]] = [[]]
    for statement in body:
        arms: list[list[ir.Statement]] = [[statement]]
        if isinstance(statement, ir.Branch):
            staying = [x for x in statement.arms if not _leaves(x)]
            arms = [way for arm in staying for way in _ways(arm)]
            if not statement.is_total:
                arms.append([])
        if len(found) * len(arms) > MAX_WAYS:
            arms = [[statement]]
        if len(arms) == 1:
            for way in found:
                way += arms[0]
        else:
            found = [[*way, *arm] for way in found for arm in arms]
    return found


def _leaves(body: ir.Body) -> bool:
    return bool(body) and isinstance(body[-1], ir.Return)


class Follower:
    """Follows statements without branches.

    Args:
        known: the numbers and arrays that names stand for.
        has_whole_quotients: whether ``1/2`` is 0.
        is_last_changed: whether ``status = f(t, x, k)`` gives k the slope.
        counters: names that count steps: ``x[n]`` is a value, as x is.
    """

    def __init__(
        self,
        known: Known,
        has_whole_quotients: bool = False,
        is_last_changed: bool = False,
        counters: Sequence[str] = (),
    ) -> None:
        self._known = known
        self._has_whole_quotients = has_whole_quotients
        self._is_last_changed = is_last_changed
        self._counters = counters
        self._has_step_inside = False
        self._forms: dict[str, Form | None] = {}
        self._slopes: list[_Slope] = []
        self._assigned: list[str] = []
        self._returned: list[str] = []
        self._is_lost = False
        self._components: list[str] = []
        self._spans: dict[int, ir.Expr] = {}

    def follow(self, body: Iterable[ir.Statement]) -> None:
        """Some statements, one after the other."""
        for statement in body:
            match statement:
                case ir.Do(value=ir.Call() as call):
                    self._called(call)
                case ir.Assign(value=ir.Call(args=(_, _, *_)) as call) if self._is_last_changed:
                    self._called(call)
                case ir.Do(value=ir.Text()):
                    continue
                case ir.Do(value=ir.Opaque()) | ir.Scope(kind="entry" | "module" | "record"):
                    self._is_lost = True
                case ir.Assign(target=target, value=value, sign=sign) if value is not None:
                    self._assign(self._whole(target), value, sign)
                case ir.Branch(arms=arms):
                    self._lose(_targets(arms))
                case ir.Loop(name=name, over=over, body=inner):
                    if name and _is_over_components(name, inner):
                        span = self._spans.setdefault(len(self._components), over)
                        self._is_lost |= span != over
                        self._components.append(name)
                        self.follow(inner)
                        self._components.pop()
                    else:
                        self._lose(_targets([inner]))
                        self._look_inside(name, inner)
                case ir.Return(value=value):
                    for i, x in enumerate(value.items if isinstance(value, ir.Items) else [value]):
                        name = x.name if isinstance(x, ir.Name) else f"value {i} of the function"
                        if not isinstance(x, ir.Name):
                            self._set(name, self._form(x))
                        self._returned.append(name)

    def _look_inside(self, name: str, body: ir.Body) -> None:
        """Note whether a loop has what looks like a step in it: one step after the other."""
        follower = Follower(
            self._known, self._has_whole_quotients, self._is_last_changed, (*self._counters, name)
        )
        follower.follow(body)
        self._has_step_inside |= follower.looks_like

    def _called(self, call: ir.Call) -> None:
        """A call for its effect: a copy, an evaluation of f, or a change of what it is given."""
        match call:
            case ir.Call(callee, (ir.Name(name=name), source, *_), ()) if _is_copy(callee):
                self._set(name, self._form(source))
            case ir.Call(callee, (_, *_, ir.Name(name=name)) as args, ()):
                slope = self._slope(callee, args[:-1])
                if slope is None:
                    self._lose(_given(call))
                self._set(name, slope)
            case _:
                self._lose(_given(call))

    def _assign(self, target: ir.Expr, value: ir.Expr, sign: str) -> None:
        form = self._form(value)
        if not isinstance(target, ir.Name):
            self._lose([target])
            return
        if sign in {"+", "-"}:
            form = self._sum(self._form(target), form, sign)
        elif sign not in {"", "."}:
            form = None
        self._set(target.name, form)

    def _set(self, name: str, form: Form | None) -> None:
        value = self._known(name)
        if form is None and isinstance(value, Number):
            form = {(): value}
        self._forms[name] = form
        self._assigned.append(name)

    def _lose(self, targets: Iterable[ir.Expr]) -> None:
        for target in targets:
            while isinstance(target, ir.Index | ir.Field):
                target = target.of
            if isinstance(target, ir.Name):
                self._forms[target.name] = None

    def _slope(self, callee: ir.Expr, args: Sequence[ir.Expr]) -> Form | None:
        """An evaluation of f; None where a call is none."""
        forms = tuple(map(self._form, args))
        if self._components or not any(form and any(form) for form in forms):
            return None
        slope = f"slope {len(self._slopes)}"
        self._slopes.append(_Slope(slope, callee, forms))
        return {(slope,): ONE}

    def _whole(self, expr: ir.Expr) -> ir.Expr:
        """The array of which a loop takes one entry after the other."""
        names = {*self._components, *self._counters}
        while isinstance(expr, ir.Index) and all(
            isinstance(x, ir.Name) and x.name in names for x in expr.at
        ):
            expr = expr.of
        return expr

    def _entry(self, expr: ir.Expr) -> Value | None:
        """The entry of an array that is known, at a place that is written out."""
        match expr:
            case ir.Name(name=name) if name not in self._forms:
                return self._known(name)
            case ir.Index(of=of, at=at):
                found = self._entry(of)
                for place in at:
                    i = int(place.text) if isinstance(place, ir.Literal) and place.is_whole else -1
                    if not isinstance(found, Array):
                        return None
                    i -= found.base
                    found = found.items[i] if 0 <= i < len(found.items) else None
                return found
        return None

    def _form(self, expr: ir.Expr) -> Form | None:
        match self._whole(expr):
            case ir.Literal(text=text, is_whole=is_whole):
                return {(): literal(text, 0, is_whole)}
            case ir.Name(name=name):
                if name in self._forms:
                    return self._forms[name]
                known = self._known(name)
                if isinstance(known, Array):
                    return None
                return {(): known} if isinstance(known, Number) else {(name,): ONE}
            case ir.Index() as entry:
                known = self._entry(entry)
                return {(): known} if isinstance(known, Number) else None
            case ir.Call(ir.Name(name=name), (value,), ()) if name in CONVERSIONS:
                return self._form(value)
            case ir.Call(callee, args, ()):
                return self._slope(callee, args)
            case ir.Unary(sign=sign, of=of):
                form = self._form(of)
                if form is None or sign != "-":
                    return form
                return {at: negative(x, 0) for at, x in form.items()}
            case ir.Binary(sign=sign, left=left, right=right):
                x, y = self._form(left), self._form(right)
                if sign.lstrip(".") in {"+", "-"}:
                    return self._sum(x, y, sign.lstrip("."))
                return self._product(x, y, sign.lstrip("."))
        return None

    def _sum(self, x: Form | None, y: Form | None, sign: str) -> Form | None:
        if x is None or y is None or len(x) + len(y) > MAX_TERMS:
            return None
        found = dict(x)
        for at, value in y.items():
            found[at] = computed(sign, found.get(at, ZERO), value, 0)
        return {at: z for at, z in found.items() if not (isinstance(z, Number) and z.is_zero)}

    def _product(self, x: Form | None, y: Form | None, sign: str) -> Form | None:
        if x is None or y is None or sign not in {"*", "/"}:
            return None
        if sign == "/":
            below = y.get(()) if len(y) == 1 else None
            if not isinstance(below, Number) or (self._has_whole_quotients and _is_whole(x, below)):
                return None
            return {at: computed("/", value, below, 0) for at, value in x.items()}
        found: dict[tuple[str, ...], Value] = {}
        if len(x) * len(y) > MAX_TERMS:
            return None
        for left, a in x.items():
            for right, b in y.items():
                at = tuple(sorted((*left, *right)))
                found[at] = computed("+", found.get(at, ZERO), computed("*", a, b, 0), 0)
        return found

    # what it makes

    def roles(self) -> dict[str, Value]:
        """A, b, c and the error of the step.

        Raises:
            NoStep: it is none.
        """
        callees = [x.callee for x in self._slopes if not _is_mathematics(x.callee)]
        if self._is_lost or len(self._slopes) > MAX_STAGES:
            raise NoStep
        for i, callee in enumerate(callees):
            if callee not in callees[:i]:
                try:
                    return self._of([x for x in self._slopes if x.callee == callee])
                except NoStep:
                    continue
        raise NoStep

    @property
    def looks_like(self) -> bool:
        """Whether f is evaluated at ``x + h*k``, where k is another value of f, in a loop too."""
        if self._has_step_inside:
            return True
        called = {x.name: x.callee for x in self._slopes if not _is_mathematics(x.callee)}
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

    def _of(self, slopes: Sequence[_Slope]) -> dict[str, Value]:
        """The same where these are the evaluations of f."""
        names = [x.name for x in slopes]
        width = len(slopes[0].args)
        if any(len(x.args) != width for x in slopes):
            raise NoStep
        columns = [_known_forms(x.args[i] for x in slopes) for i in range(width)]
        seen = [i for i, forms in enumerate(columns) if set(names) & _symbols(forms)]
        place = seen[0] if seen else min(1, width - 1)
        values = columns[place]
        starts = [at[0] for at, x in (values or [{}])[0].items() if len(at) == 1 and _is_one(x)]
        if not values or len(starts) != 1:
            raise NoStep
        start = starts[0]
        result, form = self._result(start, values)
        step = _step(form, set(names))
        others = {x.name for x in self._slopes} - set(names)
        used = {x for each in self._forms.values() for at in each or () if step in at for x in at}
        if used & others or (others and len(names) == 1):
            # values of another function take part in the step
            raise NoStep
        nodes = _nodes([x for i, x in enumerate(columns) if i != place], step)
        given = {x for each in (*values, form) for at in each if step in at for x in at}
        given -= {step, start, *names}
        is_elsewhere = all(len(x) > 1 for x in values)
        if len(given) == 1 and nodes and is_elsewhere and not any(" " in x for x in given):
            # the first slope is an argument; where f is evaluated at the start too, that is
            # a slope of another step
            names, values, nodes = [*given, *names], [{(start,): ONE}, *values], [ZERO, *nodes]
        if not nodes and len(names) < 2:
            raise NoStep
        A = [_row(x, start, step, names) for x in values]
        b = _row(form, start, step, names)
        total = sum(x.near for x in b if isinstance(x, Number))
        if abs(total - 1) > NEAR or not all(isinstance(x, Number) for x in (*b, *nodes)):
            raise NoStep
        error: list[Value] = []
        for name in reversed(self._assigned):
            of_error = self._forms.get(name)
            if of_error and name != result and _is_error(of_error, step, set(names)):
                error = _row({**of_error, (start,): ONE}, start, step, names)
                if result not in self._returned and _are_apart(b, A[-1], error):
                    # either may be the step
                    raise NoStep
                break
        while len(b) > 1 and all(_is_zero(row[-1]) for row in (*A, b, error) if row):
            # what is evaluated for the next step
            A, b, nodes, error = [x[:-1] for x in A[:-1]], b[:-1], nodes[:-1], error[:-1]
        roles: dict[str, Value] = {"A": Array([Array(row) for row in A]), "b": Array(b)}
        rows = {"c": nodes, "error": error}
        return roles | {role: Array(row) for role, row in rows.items() if row}

    def _result(self, start: str, values: Sequence[Form]) -> tuple[str, Form]:
        """What the step comes to, with its name: what is returned, or else what is computed last.

        Raises:
            NoStep: nothing; or one of several, as those of a pair, which are no values of stages.
        """
        names = [x for x in self._returned if self._ends(x, start)]
        names = names or [x for x in reversed(self._assigned) if self._ends(x, start)]
        found = {x: form for x in names if (form := self._forms[x]) is not None}
        others = {
            str(sorted((at, _shown(x)) for at, x in form.items()))
            for form in found.values()
            if form not in values
        }
        if not found or len(others) > 1:
            raise NoStep
        return next(iter(found.items()))

    def _ends(self, name: str, start: str) -> bool:
        form = self._forms.get(name)
        return form is not None and (start,) in form and len(form) > 1


def _known_forms(forms: Iterator[Form | None]) -> list[Form]:
    """The forms of an argument of f; none where one of them is not known."""
    found = list(forms)
    return [] if None in found else [x for x in found if x is not None]


def _symbols(forms: Iterable[Form]) -> set[str]:
    return {name for form in forms for at in form for name in at}


def _step(form: Form, names: set[str]) -> str:
    """The name of the step."""
    others = {x for at in form if names & set(at) for x in at if x not in names}
    if len(others) != 1:
        raise NoStep
    return others.pop()


def _nodes(columns: Sequence[Sequence[Form]], step: str) -> list[Value]:
    """The nodes by the argument that is a time; none where there is no such argument.

    Raises:
        NoStep: another argument changes from slope to slope.
    """
    found: list[Value] = []
    for forms in columns:
        if len({tuple(sorted(form)) for form in forms}) > 1 or step in _symbols(forms):
            times = {at for form in forms for at in form if at != (step,)}
            if len(times) != 1:
                raise NoStep
            (time,) = times
            found = [_node(form, time, step) for form in forms]
    is_single = any(len(forms) == 1 for forms in columns)
    return found or [ZERO] * is_single


def _is_one(value: Value) -> bool:
    return isinstance(value, Number) and abs(value.near - 1) < NEAR


def _is_zero(value: Value) -> bool:
    return isinstance(value, Number) and value.is_zero


def _are_apart(b: Sequence[Value], row: Sequence[Value], error: Sequence[Value]) -> bool:
    """Whether two rows differ by an error, or by minus it."""
    near = [[x.near for x in each if isinstance(x, Number)] for each in (b, row, error)]
    return any(
        all(abs(x - y + sign * z) < NEAR for x, y, z in zip(*near, strict=False))
        for sign in (1, -1)
    )


def _is_whole(form: Form, below: Number) -> bool:
    return below.is_whole and all(isinstance(x, Number) and x.is_whole for x in form.values())


def _is_error(form: Form, step: str, names: set[str]) -> bool:
    """Whether it is a sum of slopes times the step whose coefficients cancel."""
    total = sum(x.near for x in form.values() if isinstance(x, Number))
    is_sum = all(len(at) == 2 and step in at and names & set(at) for at in form)
    return len(form) > 1 and is_sum and abs(total) < NEAR


def _row(form: Form, start: str, step: str, names: Columns) -> list[Value]:
    """What is before the slopes.

    Raises:
        NoStep: something else is there, too.
    """
    rest = {at: x for at, x in form.items() if not _is_zero(x)}
    if not _is_one(rest.pop((start,), ZERO)):
        raise NoStep
    row = [rest.pop((min(step, x), max(step, x)), ZERO) for x in names]
    if rest:
        raise NoStep
    return row


def _node(form: Form, time: tuple[str, ...], step: str) -> Value:
    rest = dict(form)
    one, node = rest.pop(time, None), rest.pop((step,), ZERO)
    if rest or not isinstance(one, Number) or one.value != 1:
        raise NoStep
    return node


def _is_over_components(name: str, body: ir.Body) -> bool:
    """Whether a loop computes arrays entry by entry, and nothing across entries."""
    assigned = [x for x in body if isinstance(x, ir.Assign)]
    entries = [x for x in assigned if isinstance(x.target, ir.Index)]
    others = [x for x in assigned if not isinstance(x.target, ir.Index)]
    are_own = all(ir.Name(name) in x.target.at for x in entries if isinstance(x.target, ir.Index))
    are_plain = len(assigned) == len(body) and not any(x.sign for x in others)
    inner = body[0] if len(body) == 1 else None
    if isinstance(inner, ir.Loop):
        return bool(inner.name) and _is_over_components(inner.name, inner.body)
    return are_plain and are_own and bool(entries)


def _given(call: ir.Call) -> list[ir.Expr]:
    """What a call may change."""
    return [*call.args, *(x for _, x in call.named)]


def _is_mathematics(callee: ir.Expr) -> bool:
    """Whether a call is of a function that everybody knows, and not of a right-hand side."""
    return _name(callee) in _MATHEMATICS


def _is_copy(callee: ir.Expr) -> bool:
    return _name(callee).removeprefix("std::") in _COPIES


def _name(callee: ir.Expr) -> str:
    return callee.name.lower() if isinstance(callee, ir.Name | ir.Field) else ""


_COPIES = {"memcpy", "dbl_memcpy", "copyto!"}
"""Functions that give their first argument the value of their second one."""
_MATHEMATICS = {
    *("min", "max", "minimum", "maximum", "fmin", "fmax", "amin", "amax", "clamp", "clip"),
    *("hypot", "atan2", "arctan2", "pow", "power", "mod", "rem", "div", "fmod", "copysign"),
    *("dot", "cross", "kron", "norm", "axpy", "isclose", "allclose", "merge", "ifelse", "where"),
}
"""Functions of two numbers, by the names that languages have for them."""


def _targets(arms: Iterable[ir.Body]) -> list[ir.Expr]:
    found: list[ir.Expr] = []
    for body in arms:
        for statement in body:
            match statement:
                case ir.Assign(target=target):
                    found.append(target)
                case ir.Do(value=ir.Call() as call):
                    found += _given(call)
                case ir.Scope(body=inside):
                    found += _targets([inside])
                case ir.Branch(arms=inner):
                    found += _targets(inner)
                case ir.Loop(body=inside):
                    found += _targets([inside])
    return found
