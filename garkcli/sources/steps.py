"""Steps that are written out as they are computed: the tableau that they have.

A function evaluates f several times, ``call f(t + h/2, x + h/2*k1, k2)`` or ``k2 = f(…)``, and adds
multiples of the slopes to what it began with. All values are followed as polynomials in the names
that nothing is known of: the time, the value, the step and the slopes. Nothing is guessed from
names, and whatever does not fit makes no table.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.values import ONE, ZERO, Array, Number, Value, computed, literal, negative

Form: TypeAlias = Mapping[tuple[str, ...], Value]
"""A polynomial: what is before each product of names, these in order."""
MAX_TERMS = 4 * MAX_STAGES
NEAR = 1e-3
"""Sums that differ by less are meant to be the same."""


class NoStep(Exception):
    """The computation is no step of a Runge–Kutta method."""


class _Slope(Frozen):
    """An evaluation of f: its name among the forms, what is called, and what it is given."""

    name: str
    callee: ir.Expr
    args: tuple[Form, Form]


class Follower:
    """Follows the statements of a function.

    Args:
        known: the numbers that names stand for.
        has_whole_quotients: whether ``1/2`` is 0.
    """

    def __init__(self, known: Mapping[str, Value], has_whole_quotients: bool = False) -> None:
        self._known = known
        self._has_whole_quotients = has_whole_quotients
        self._forms: dict[str, Form | None] = {}
        self._slopes: list[_Slope] = []
        self._assigned: list[str] = []
        self._is_lost = False

    def follow(self, body: ir.Body) -> None:
        """Some statements, one after the other."""
        for statement in body:
            match statement:
                case ir.Do(value=ir.Call(callee, (*given, ir.Name(name=name)), ())) if given[1:]:
                    self._set(name, self._slope(callee, given))
                case ir.Do(value=ir.Call() as call):
                    # it may change whatever it is given
                    self._lose(_given(call))
                case ir.Do(value=ir.Text()):
                    continue
                case ir.Do(value=ir.Opaque()) | ir.Scope(kind="entry" | "module" | "record"):
                    self._is_lost = True
                case ir.Assign(target=ir.Name(name=name), value=value, sign=sign):
                    if value is None:
                        continue
                    form = self._form(value)
                    if sign in {"+", "-"}:
                        form = self._sum(self._form(ir.Name(name)), form, sign)
                    elif sign not in {"", "."}:
                        form = None
                    self._set(name, form)
                case ir.Assign(target=target):
                    self._lose([target])
                case ir.Branch(arms=arms):
                    self._lose(_targets(arms))
                case ir.Loop(body=inner):
                    self._lose(_targets([inner]))
                case ir.Return(value=ir.Name(name=name)):
                    self._assigned.append(name)
                case ir.Return(value=value):
                    self._set("the value of the function", self._form(value))

    def _set(self, name: str, form: Form | None) -> None:
        value = self._known.get(name)
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
        forms = [self._form(x) for x in args[:2]]
        first, second = forms if len(forms) == 2 else (None, None)
        if first is None or second is None or not any(first) or not any(second):
            return None
        slope = f"slope {len(self._slopes)}"
        self._slopes.append(_Slope(slope, callee, (first, second)))
        return {(slope,): ONE}

    def _form(self, expr: ir.Expr) -> Form | None:
        match expr:
            case ir.Literal(text=text, is_whole=is_whole):
                return {(): literal(text, 0, is_whole)}
            case ir.Name(name=name):
                if name in self._forms:
                    return self._forms[name]
                known = self._known.get(name)
                return {(): known} if isinstance(known, Number) else {(name,): ONE}
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
                product = computed("*", a, b, 0)
                found[at] = computed("+", found.get(at, ZERO), product, 0)
        return found

    # what it makes

    def roles(self) -> dict[str, Value]:
        """A, b, c and the error of the step.

        Raises:
            NoStep: it is none.
        """
        slopes = self._slopes
        names = {x.name for x in slopes}
        if self._is_lost or not 0 < len(slopes) <= MAX_STAGES:
            raise NoStep
        if any(x.callee != slopes[0].callee for x in slopes) or _is_mathematics(slopes[0].callee):
            raise NoStep
        of_slopes = [
            i for x in slopes for i, form in enumerate(x.args) if names & set().union(*form)
        ]
        place = of_slopes[0] if of_slopes else 1
        first = slopes[0].args
        start, time = _only(first[place]), _only(first[1 - place])
        result = next((x for x in reversed(self._assigned) if self._ends(x, start)), None)
        form = self._forms.get(result) if result else None
        if form is None or start == time:
            raise NoStep
        step = self._step(form, names)
        A = [_row(x.args[place], start, step, slopes) for x in slopes]
        b = _row(form, start, step, slopes)
        c = [_node(x.args[1 - place], time, step) for x in slopes]
        total = sum(x.near for x in b if isinstance(x, Number))
        if abs(total - 1) > NEAR or not all(isinstance(x, Number) for x in (*b, *c)):
            raise NoStep
        roles: dict[str, Value] = {
            "A": Array([Array(row) for row in A]),
            "b": Array(b),
            "c": Array(c),
        }
        for name in reversed(self._assigned):
            error = self._forms.get(name)
            if error and name != result and _is_error(error, step, names):
                roles["error"] = Array(_row({**error, (start,): ONE}, start, step, slopes))
                break
        return roles

    def _ends(self, name: str, start: str) -> bool:
        form = self._forms.get(name)
        return form is not None and (start,) in form and len(form) > 1 and start != name

    def _step(self, form: Form, names: set[str]) -> str:
        others = {x for at in form if names & set(at) for x in at if x not in names}
        if len(others) != 1:
            raise NoStep
        return others.pop()


def _is_whole(form: Form, below: Number) -> bool:
    return below.is_whole and all(isinstance(x, Number) and x.is_whole for x in form.values())


def _only(form: Form) -> str:
    """The name that a form is.

    Raises:
        NoStep: it is none.
    """
    if len(form) == 1:
        ((at, value),) = form.items()
        if len(at) == 1 and isinstance(value, Number) and value.value == 1:
            return at[0]
    raise NoStep


def _is_error(form: Form, step: str, names: set[str]) -> bool:
    """Whether it is a sum of slopes times the step whose coefficients cancel."""
    total = sum(x.near for x in form.values() if isinstance(x, Number))
    is_sum = all(len(at) == 2 and step in at and names & set(at) for at in form)
    return len(form) > 1 and is_sum and abs(total) < NEAR


def _row(form: Form, start: str, step: str, slopes: list[_Slope]) -> list[Value]:
    """What is before the slopes.

    Raises:
        NoStep: something else is there, too.
    """
    rest = {at: x for at, x in form.items() if not (isinstance(x, Number) and x.is_zero)}
    one = rest.pop((start,), None)
    if not isinstance(one, Number) or abs(one.near - 1) > NEAR:
        raise NoStep
    row = [rest.pop(tuple(sorted((step, x.name))), ZERO) for x in slopes]
    if rest:
        raise NoStep
    return row


def _node(form: Form, time: str, step: str) -> Value:
    rest = dict(form)
    one, node = rest.pop((time,), None), rest.pop((step,), ZERO)
    if rest or not isinstance(one, Number) or one.value != 1:
        raise NoStep
    return node


def _given(call: ir.Call) -> list[ir.Expr]:
    """What a call may change."""
    return [*call.args, *(x for _, x in call.named)]


def _is_mathematics(callee: ir.Expr) -> bool:
    """Whether a call is of a function that everybody knows, and not of a right-hand side."""
    name = callee.name if isinstance(callee, ir.Name | ir.Field) else ""
    return name.lower() in _MATHEMATICS


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
