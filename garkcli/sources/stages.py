"""The coefficients of a step, from the polynomials that a program evaluates f at.

The arguments of f are sums: a base plus the step times multiples of slopes. A base whose value
after the step is such a sum, too, is a component of the solution; its slopes are its stages. All
components have the same coefficients, or there is no step.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence, Set

from garkcli.frozen import Frozen, replace
from garkcli.sources import ir
from garkcli.sources.positions import is_of_velocities, position_of
from garkcli.sources.values import (
    ZERO,
    Array,
    Form,
    Number,
    Terms,
    Value,
    computed,
    integer,
    is_zero,
    near,
)

NEAR = 1e-3
"""Sums that differ by less are equal."""
MINUS = integer(-1)
CLOSE = 1e-9
"""Coefficients that differ by less are equal."""
Roles = dict[str, Value]


class NoStep(Exception):
    """The computation is no step of a Runge–Kutta method.

    Args:
        looks_like: whether it looks like one: f is evaluated at ``x + h*k`` with another value k of
            f.
        is_idle: whether nothing but stages is computed: the step may be rejected.
    """

    def __init__(self, looks_like: bool = False, is_idle: bool = False) -> None:
        super().__init__()
        self.looks_like = looks_like
        self.is_idle = is_idle


class StageSlope(Frozen):
    """An evaluation of f: its name in polynomials, the callee and its arguments."""

    name: str
    callee: ir.Expr
    args: tuple[Terms | None, ...]


class _Sum(Frozen):
    """A base plus the step times a number or multiples of slopes."""

    base: str
    node: Value
    row: Mapping[str, Value]


class _Component(Frozen):
    """A base with its slopes in order, its value after the step, a second value, an error."""

    slopes: tuple[str, ...]
    result: Mapping[str, Value]
    second: Mapping[str, Value]
    error: Mapping[str, Value]


def terms_of(value: Value | None) -> Terms | None:
    """A value as a polynomial; None for other values."""
    if isinstance(value, Number):
        return {(): value}
    return value.terms if isinstance(value, Form) else None


def without_steps(slopes: Sequence[StageSlope]) -> list[StageSlope]:
    """The slopes without values of functions that compute the step, ``h = courant(y, t)``: these
    are factors of slopes of f, which is given slopes of its own.
    """
    of = {x.name: x.callee for x in slopes}
    terms = [(x, at) for x in slopes for form in x.args for at in form or ()]
    stages = {x.callee for x, at in terms if any(of.get(name) == x.callee for name in at)}
    callees = [{of[name] for name in at if name in of} for _, at in terms]
    steps = set().union(*(x for x in callees if x & stages)) - stages
    return [x for x in slopes if x.callee not in steps]


def step_in(
    slopes: Sequence[StageSlope],
    values: Mapping[str, Value],
    returned: Sequence[str],
    counters: Sequence[str],
    others: Sequence[Terms] = (),
) -> tuple[Roles, bool]:
    """A, b, c, the error and the embedded weights of a step, and whether another result may be the
    step: nothing says which is.

    Args:
        slopes: all evaluations of functions, in order.
        values: at the end, in the order of their last assignments.
        others: what other functions are given, such as an error to a norm.
        returned: the names of the returned values.
        counters: the names that count steps.

    Raises:
        NoStep: there is none.
    """
    step = FollowedStep(slopes, values, returned, counters, others)
    try:
        return step.roles(), step.is_open
    except NoStep:
        if not step.is_backward:
            raise
    backward = [replace(x, args=tuple(map(step.turned, x.args))) for x in slopes]
    turned = {x: step.turned(terms_of(y)) for x, y in values.items()}
    ends = {x: y if (form := turned[x]) is None else Form(form) for x, y in values.items()}
    step = FollowedStep(backward, ends, returned, counters)
    return step.roles(), step.is_open


class FollowedStep:
    """The parts of a step.

    Attributes:
        is_open: whether nothing says which result is the step.
    """

    def __init__(
        self,
        slopes: Sequence[StageSlope],
        values: Mapping[str, Value],
        returned: Sequence[str],
        counters: Sequence[str],
        others: Sequence[Terms] = (),
    ) -> None:
        self._slopes = slopes
        self._counters = counters
        self._names = {x.name for x in slopes}
        self._values = values
        self._forms = {x: form for x, value in values.items() if (form := terms_of(value))}
        self._returned = returned
        self.h = self._step()
        args = {x.name: [self._sum(form) for form in x.args] for x in slopes}
        used = self._used()
        with_slopes = (
            x
            for x in slopes
            if any(y and y.row for y in args[x.name]) or any(map(self._has_slopes, x.args))
        )
        stages = {_whole_of(x.callee) for x in with_slopes} & used
        # others, such as the size of a vector or the control of the step, are no slopes
        self._args = {
            x.name: args[x.name] if not stages or _whole_of(x.callee) in stages else []
            for x in slopes
        }
        given = (y for x in slopes if not self._args[x.name] for y in x.args if y)
        self._others = [*others, *given]
        self._places = {x.name: i for i, x in enumerate(slopes)}
        self._given = ""
        self.is_open = False

    def roles(self) -> Roles:
        """The coefficients of all components, which are the same."""
        components = self._components()
        counts = {len(x.slopes) for x in components.values()}
        slopes = [name for x in components.values() for name in x.slopes]
        if len(counts) != 1 or len({*slopes}) != len(slopes):
            raise NoStep
        stages = counts.pop()
        A = [self._row(i, components) for i in range(stages)]
        nodes = self._nodes(components, A)
        if not nodes and stages < 2 and not self._has_constants(components):
            raise NoStep
        every = [self._weights(x) for x in components.values()]
        if any(not _agree(every[0]["b"], x["b"]) for x in every[1:]):
            raise NoStep
        rows = {**every[0], "c": nodes}
        error = rows.get("error", [])
        main = next(iter(components.values()))
        self._check_positions(components, A, rows["b"])
        is_clear = not error or self._is_returned(main) or not self._is_kept(main, A[-1])
        if not is_clear and _are_apart(rows["b"], A[-1], error):
            if self._error({*main.slopes}, has_second=True):
                # either value may be the step
                raise NoStep
            # only its size is computed
            del rows["error"]
        roles: Roles = {"A": Array([Array(row) for row in A])}
        return roles | {role: Array([*row]) for role, row in rows.items() if row}

    @property
    def is_backward(self) -> bool:
        """Whether some value is a step with -h."""
        sums = (self._sum(form) for form in self._forms.values())
        return any(x is not None and abs(near(*x.row.values()) + 1) < NEAR for x in sums if x)

    def turned(self, form: Terms | None) -> Terms | None:
        """A polynomial with the step in the other direction."""
        if form is None:
            return None
        return {
            at: computed("*", x, MINUS, 0) if at.count(self.h) % 2 else x for at, x in form.items()
        }

    def _check_positions(
        self, components: Mapping[str, _Component], A: Sequence[Sequence[Value]], b: Sequence[Value]
    ) -> None:
        """Checks that positions have the velocities of the stages.

        Raises:
            NoStep: they have others.
        """
        rows = {
            base: {
                name: dict(zip(x.slopes, row, strict=True))
                for name, row in zip(x.slopes, A, strict=True)
            }
            for base, x in components.items()
        }
        for x in components.values():
            for name, row in zip(x.slopes, A, strict=True):
                forms = self._slopes[self._places[name]].args if name in self._places else ()
                weights = dict(zip(x.slopes, row, strict=True))
                if not all(is_of_velocities(y, self.h, rows, weights) for y in forms):
                    raise NoStep
            weights = dict(zip(x.slopes, b, strict=True))
            ends = (form for name, form in self._forms.items() if (name,) in form)
            if not all(is_of_velocities(y, self.h, rows, weights) for y in ends):
                raise NoStep

    # the sums

    def _has_slopes(self, form: Terms | None) -> bool:
        """Whether an argument is a value with multiples of slopes."""
        terms = form or {}
        has_base = any(len(at) == 1 and at[0] not in self._names for at in terms)
        return has_base and any(len(at) > 1 and self._names.intersection(at) for at in terms)

    def _used(self) -> set[ir.Expr]:
        """The functions whose slopes are in some value, or in an argument."""
        forms = (*self._forms.values(), *(y for x in self._slopes for y in x.args if y))
        names = {name for form in forms for at in form if len(at) == 2 for name in at}
        return {_whole_of(x.callee) for x in self._slopes if x.name in names}

    def _step(self) -> str:
        """The name of the step: the factor of the slopes.

        Raises:
            NoStep: there is none.
        """
        factors: Counter[str] = Counter()
        for form in (*self._forms.values(), *(y for x in self._slopes for y in x.args if y)):
            for at in form:
                if len(at) == 2 and len(self._names.intersection(at)) == 1:
                    factors.update(x for x in at if x not in {*self._names, *self._counters})
        if not factors:
            raise NoStep
        return factors.most_common(1)[0][0]

    def _sum(self, form: Terms | None) -> _Sum | None:
        """A polynomial as a sum; None for others."""
        bases: list[str] = []
        counted = ""
        row: dict[str, Value] = {}
        node: Value = ZERO
        for at, x in (form or {}).items():
            others = list(at)
            if is_zero(x):
                continue
            if self.h in others:
                others.remove(self.h)
                if len(others) > 1:
                    return None
                if others and others[0] in self._counters:
                    # t + n*h
                    counted = f" + {near(x)} {others[0]}"
                elif others:
                    row[others[0]] = x
                else:
                    node = x
            elif len(others) == 1 and isinstance(x, Number) and abs(x.near - 1) < NEAR:
                bases += others
            elif not others:
                bases.append(f"{near(x)}")
            else:
                return None
        if len(bases) != 1 or (row and not is_zero(node)):
            return None
        return _Sum(bases[0] + counted, node, row)

    # the components

    def _components(self) -> Mapping[str, _Component]:
        """The components by their bases.

        Raises:
            NoStep: there is none.
        """
        sums = {name: x for name, form in self._forms.items() if (x := self._sum(form)) and x.row}
        bases = dict.fromkeys(x.base for x in sums.values() if is_whole(x.row))
        if not bases:
            sums |= self._increments()
            bases = dict.fromkeys(x.base for x in sums.values() if is_whole(x.row))
        components: dict[str, _Component] = {}
        for base in bases:
            own = [x for of in self._args.values() for x in of if x and x.base == base]
            if not own:
                # no argument of f
                continue
            end = self._forms.get(base.partition("[")[0] + "[the end]")
            if end is not None and ((x := self._sum(end)) is None or x.base != base):
                # what is put behind the end of its list is another value
                raise NoStep
            result, second = self._result(base, sums, own)
            names = {name for x in (result, second, *(x.row for x in own)) for name in x}
            error = self._error(names, bool(second))
            names |= set(error)
            others = names - self._names
            if len(others) == 1 and all(x.row for x in own) and [*bases] == [base] != [*others]:
                # the first slope is an argument; if f is also evaluated at the start, it is a slope
                # of another step
                (self._given,) = others
            elif others:
                raise NoStep
            callees = {self._slopes[self._places[x]].callee for x in names - {self._given}}
            if len(callees) > 1:
                raise NoStep
            ordered = sorted(names, key=lambda x: self._places.get(x, -1))
            components[base] = _Component(tuple(ordered), result, second, error)
        if not components:
            raise NoStep(is_idle=not bases)
        return components

    def _increments(self) -> Mapping[str, _Sum]:
        """The values that a caller adds to the solution, with the step or without it."""
        own = [x for of in self._args.values() for x in of if x and x.row]
        bases = {x.base for x in own}
        # the first slope may be an argument
        given = {name for x in own for name in x.row} - self._names
        slopes = self._names | (given if len(given) == 1 else set())
        found: dict[str, _Sum] = {}
        for name, form in self._forms.items() if len(bases) == 1 else ():
            rows = {x: form[at] for at in form for x in at if x in slopes}
            others = {tuple(x for x in at if x not in slopes) for at in form}
            is_sum = others in ({(self.h,)}, {()}) and len(rows) == len(form)
            if is_sum and is_whole(rows) and (len(rows) > 1 or name in self._returned):
                found[name] = _Sum(min(bases), ZERO, rows)
        return found

    def _result(
        self, base: str, sums: Mapping[str, _Sum], own: Sequence[_Sum]
    ) -> tuple[Mapping[str, Value], Mapping[str, Value]]:
        """The result of the step: the returned value, or the last computed one; for a pair the
        first of its two results, which are no stage values, and the second.

        Raises:
            NoStep: there are more than two.
        """
        of_base = {name: x.row for name, x in sums.items() if x.base == base}
        names = [x for x in self._returned if x in of_base] or [*reversed(of_base)]
        stages = [x.row for x in own]
        others: list[Mapping[str, Value]] = []
        for name in names:
            row = of_base[name]
            if is_whole(row) and not any(_are_equal(row, x) for x in (*stages, *others)):
                others.append(row)
        is_returned = names[0] in self._returned
        ends = (self._forms.get(x, {}) for x in self._returned)
        if len(others) > 2 or (
            # the returned value is another one
            not is_returned and any((base,) in x and len(x) > 1 for x in ends)
        ):
            raise NoStep
        if len(others) == 2:
            # returned values keep their order, a copied value is the result
            is_copied = sum(_are_equal(x, others[0]) for x in of_base.values()) > 1
            self.is_open |= not is_returned and not is_copied
            first, second = others[:: 1 if is_returned or is_copied else -1]
            return first, second
        is_lost = base in self._values and (base,) not in self._forms.get(base, ())
        is_lost &= names[0] not in self._returned
        if not is_whole(of_base[names[0]]) or is_lost or not self._is_end(base, names[0], of_base):
            # its last value is another one
            raise NoStep(is_idle=not is_lost and not others)
        result = of_base[names[0]]
        self.is_open |= not is_returned and base not in of_base
        # a stage value beside another result
        is_pair = others and not _are_equal(result, others[0])
        return result, others[0] if is_pair else {}

    def _is_end(self, base: str, name: str, of_base: Mapping[str, Mapping[str, Value]]) -> bool:
        """Whether a stage value is the result, too: it is returned, copied or takes the place of
        the base, or its slope is part of an error.
        """
        row = of_base[name]
        if name in {base, *self._returned} or sum(_are_equal(row, x) for x in of_base.values()) > 1:
            return True
        here = [x for x, of in self._args.items() if any(y and _are_equal(y.row, row) for y in of)]
        return not here or any(x in self._error({*here, *row}) for x in here)

    def _is_returned(self, component: _Component) -> bool:
        sums = (self._sum(self._forms.get(name)) for name in self._returned)
        return any(x is not None and _are_equal(x.row, component.result) for x in sums)

    def _is_kept(self, component: _Component, row: Sequence[Value]) -> bool:
        """Whether a stage value is still there at the end."""
        of = {x: y for x, y in zip(component.slopes, row, strict=True) if not is_zero(y)}
        sums = map(self._sum, self._forms.values())
        return any(x is not None and _are_equal(x.row, of) for x in sums)

    def _error(self, names: Set[str], has_second: bool = False) -> Mapping[str, Value]:
        """The last value that is the step times slopes, some of the given ones, with the sum 0."""
        others = () if has_second else self._others
        for form in (*reversed(self._forms.values()), *others):
            rows = [at for at in form if len(at) == 2 and self.h in at]
            of = {x: form[at] for at in rows for x in at if x != self.h}
            is_sum = len(rows) == len(form) > 1 and of.keys() <= self._names | names
            if is_sum and abs(near(*of.values())) < NEAR and of.keys() & names:
                return of
        return {}

    # the coefficients

    def _row(self, i: int, components: Mapping[str, _Component]) -> list[Value]:
        """The row of a stage, from all arguments that are components."""
        rows: list[list[Value]] = []
        is_doubtful = False
        for component in components.values():
            name = component.slopes[i]
            if name == self._given:
                return [ZERO] * len(component.slopes)
            slope = self._slopes[self._places[name]]
            for form, x in zip(slope.args, self._args[name], strict=False):
                if x is None:
                    is_doubtful |= self._is_bad(form, slope, components)
                elif x.base in components:
                    slopes = components[x.base].slopes
                    if not x.row.keys() <= {*slopes}:
                        raise NoStep
                    rows.append([x.row.get(y, ZERO) for y in slopes])
                elif not x.row.keys() <= components.keys():
                    # no position, either
                    raise NoStep
        if not rows or is_doubtful or not all(_agree(rows[0], x) for x in rows[1:]):
            raise NoStep
        return rows[0]

    def _is_bad(
        self, form: Terms | None, slope: StageSlope, components: Mapping[str, _Component]
    ) -> bool:
        """Whether an argument is unknown, and differs from that of other evaluations; a position
        whose derivative is a velocity has no slopes of its own.
        """
        if form is None:
            return True
        bases = [at[0] for at in form if len(at) == 1 and at[0] != self.h]
        if any(self._names.intersection(at) for at in form):
            others = [at for at in form if self.h not in at]
            return len(bases) != 1 or len(others) != 1 or bases[0] in components
        same = [x.args for x in self._slopes if x.callee == slope.callee]
        return not all(any(_are_terms(form, y) for y in args) for args in same)

    def _nodes(
        self, components: Mapping[str, _Component], A: Sequence[Sequence[Value]]
    ) -> list[Value]:
        """The nodes from the arguments that are times; empty if there is none.

        Raises:
            NoStep: an argument is a component in some slopes.
        """
        nodes: dict[int, Value] = {}
        positions = {
            (x.callee, j)
            for x in self._slopes
            for j, form in enumerate(x.args)
            if (of := position_of(form, self.h)) is not None and of.velocity in components
        }
        times: dict[tuple[ir.Expr, int], set[str]] = {}
        for component in components.values():
            for i, name in enumerate(component.slopes):
                if name == self._given:
                    nodes.setdefault(i, ZERO)
                    continue
                slope = self._slopes[self._places[name]]
                for j, x in enumerate(self._args[name]):
                    is_position = (slope.callee, j) in positions
                    if x is None or x.base in components or is_position:
                        times.setdefault((slope.callee, j), set()).add("")
                        continue
                    times.setdefault((slope.callee, j), set()).add(x.base)
                    column = [
                        y.node
                        for z in self._slopes
                        if z.callee == slope.callee and j < len(self._args[z.name])
                        for y in [self._args[z.name][j]]
                        if y
                    ]
                    if all(map(is_zero, column)):
                        continue
                    if not _agree([nodes.setdefault(i, x.node)], [x.node]):
                        raise NoStep
        if any(len(x) > 1 and "" in x for x in times.values()):
            raise NoStep
        if len(nodes) < len(A) or any(len(x) > 1 for x in times.values()):
            # the end of the step may be an argument, too
            return []
        ordered = [nodes[i] for i in range(len(A))]
        off = [near(x) - near(*row) for x, row in zip(ordered, A, strict=True)]
        if off[0] < -NEAR and max(off) - min(off) < CLOSE:
            # the time is that of the end of the step
            ordered = [computed("-", x, ordered[0], 0) for x in ordered]
        return ordered

    def _has_constants(self, components: Mapping[str, _Component]) -> bool:
        """Whether an argument is the same in all evaluations, as a time may be."""
        args = (x for of in self._args.values() for x in of)
        return any(x is not None and x.base not in components and not x.row for x in args)

    def _weights(self, component: _Component) -> dict[str, list[Value]]:
        """The weights of a component by their roles."""
        rows = {"b": component.result, "error": component.error}
        if not component.error:
            rows["embedded"] = component.second
        of = {role: [x.get(y, ZERO) for y in component.slopes] for role, x in rows.items() if x}
        if not all(isinstance(x, Number) for row in of.values() for x in row):
            raise NoStep
        return of


def _whole_of(callee: ir.Expr) -> ir.Expr:
    """The function behind one that gives an entry of its value."""
    return callee.of if isinstance(callee, ir.Index) else callee


def is_whole(row: Mapping[str, Value]) -> bool:
    """Whether the slopes times the step have the sum 1, unlike partial sums."""
    return abs(near(*row.values()) - 1) < NEAR


def _are_equal(x: Mapping[str, Value], y: Mapping[str, Value]) -> bool:
    return x.keys() == y.keys() and _agree([*x.values()], [y[name] for name in x])


def _are_terms(x: Terms, y: Terms | None) -> bool:
    """Whether two polynomials are the same."""
    return y is not None and x.keys() == y.keys() and _agree([*x.values()], [y[at] for at in x])


def _agree(x: Sequence[Value], y: Sequence[Value]) -> bool:
    return len(x) == len(y) and all(
        abs(near(a) - near(b)) < CLOSE for a, b in zip(x, y, strict=True)
    )


def _are_apart(b: Sequence[Value], row: Sequence[Value], error: Sequence[Value]) -> bool:
    """Whether two rows differ by plus or minus an error."""
    return any(
        all(
            abs(near(x) - near(y) + sign * near(z)) < NEAR
            for x, y, z in zip(b, row, error, strict=False)
        )
        for sign in (1, -1)
    )
