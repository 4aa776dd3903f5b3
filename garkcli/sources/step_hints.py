"""Hints that statements may be a step, by the names in them alone.

A step adds multiples of slopes to a value that f is given, ``x + h*f(t, x)``: some sum has a call
of f times a symbol, and a name from the arguments of f.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable
from functools import reduce

from garkcli.frozen import Frozen, fields
from garkcli.sources import ir
from garkcli.sources.elementwise import Each, each_in, loop_over, transformed
from garkcli.sources.evaluate import names_of, plain_name
from garkcli.sources.known import CONVERSIONS
from garkcli.sources.step_words import (
    APPENDING,
    COPIES,
    ELEMENTARY,
    NO_SLOPES,
    NO_VALUES,
    OF_ARRAYS,
    SUMS,
    callee_name,
    operation_of,
)


class _Made(Frozen):
    """A value: the functions whose slopes it has, those whose slopes are multiplied by a symbol,
    and the names that may be its base.
    """

    slopes: frozenset[ir.Expr] = frozenset()
    multiples: frozenset[ir.Expr] = frozenset()
    bases: frozenset[str] = frozenset()

    def __or__(self, other: _Made) -> _Made:
        if self is _EMPTY or other is _EMPTY or self is other:
            return self if other is _EMPTY else other
        both = self.slopes | other.slopes, self.multiples | other.multiples
        return _Made(*both, self.bases | other.bases)

    def times(self, other: _Made) -> _Made:
        """The product; that with a number has slopes and bases as before."""
        if self is _EMPTY or other is _EMPTY:
            return self | other
        every = self.slopes | self.multiples | other.slopes | other.multiples
        return _Made(frozenset(), every) if every else _SYMBOL


_EMPTY = _Made()
"""A literal: no factor that may be the step."""
_SYMBOL = _Made()
"""A product of names without slopes, which may be the step; compared by identity."""
_SUMS = {"add", *(name for name, _ in SUMS)}


def may_add_multiples(body: ir.Body, functions: Collection[str]) -> bool:
    """Whether statements have sums and products, or calls that may be sums: of such functions, and
    of those of the source. Others have no fields.
    """
    signs: set[str] = set()
    for statement in ir.statements(body):
        if isinstance(statement, ir.Scope | ir.Branch | ir.Loop):
            continue
        if isinstance(statement, ir.Assign):
            signs.add(statement.sign[-1:])
        for x in statement.parts:
            if isinstance(x, ir.Binary):
                signs.add(x.sign[-1:])
            elif isinstance(x, ir.Call):
                name = callee_name(x.callee)
                is_sum = operation_of(name) is not None or name in _SUMS
                if is_sum or getattr(x.callee, "name", "") in functions:
                    return True
    return not signs.isdisjoint("+-") and not signs.isdisjoint("*/@")


class Hints:
    """Names in statements that hint at a step, over all branches and twice over outer loops.

    Args:
        body: the statements.
        functions: the functions of the source.
        has_status: whether functions may change their arguments and return a status.

    Attributes:
        fields: functions f that may be vector fields of a step: a sum has a name that f is given
            and a multiple of a slope of f, or both are given to a function of the source; f has
            several arguments, or is called several times.
        are_any: whether there are multiples of slopes, which a caller may add to its value.
        of_stages: whether one of them is given multiples of slopes of a function that is given
            multiples of its slopes; the two may be one. Mathematics is none of them.
    """

    def __init__(
        self, body: Iterable[ir.Statement], functions: Collection[str], has_status: bool = False
    ) -> None:
        self._functions = functions
        self._has_status = has_status
        self._named: dict[str, _Made] = {}
        self._lambdas: dict[ir.Expr, ir.Lambda] = {}
        self._given: dict[ir.Expr, set[str]] = defaultdict(set)
        self._passed: dict[ir.Expr, set[ir.Expr]] = defaultdict(set)
        self._calls: Counter[ir.Expr] = Counter()
        self._of_several: set[ir.Expr] = set()
        self._sums: list[_Made] = []
        self._multiples: set[ir.Expr] = set()
        self._is_inside = False
        self._over(body)
        again = {f for f, count in self._calls.items() if count > 1}
        several = again | self._of_several
        passed = self._passed
        self.fields = {
            f
            for x in self._sums
            for f in x.multiples & several
            if callee_name(f) not in ELEMENTARY
            for g in {f, *(g for g in several if f in passed[g])}
            if not x.bases.isdisjoint(self._given[g])
        }
        self.are_any = any(callee_name(f) not in ELEMENTARY for f in self._multiples & several)
        self.of_stages = any(
            g in passed[f] and f in passed[g]
            for f in self.fields & again
            for g in again
            if callee_name(g) not in ELEMENTARY
        )

    def _over(self, body: Iterable[ir.Statement]) -> None:
        for statement in body:
            match statement:
                case ir.Assign(ir.Name() as target, ir.Lambda() as function):
                    self._lambdas[target] = function
                case ir.Assign(target, value, sign=sign) if value is not None:
                    made = self._value(value)
                    if self._has_status and isinstance(value, ir.Call):
                        # status = f(t, x, k)
                        self._effected(value)
                    if sign not in {"", "."}:
                        made = self._combined(sign, made, self._value(target))
                    elif not isinstance(target, ir.Name):
                        self._value(target)
                    self._stored(target, made)
                case ir.Do(ir.Call(ir.Field(of, name), (value,))) if name in APPENDING:
                    self._stored(of, self._value(value))
                case ir.Do(ir.Call(ir.Name("push!"), (of, value))):
                    self._stored(of, self._value(value))
                case ir.Do(ir.Call() as call):
                    self._effected(call)
                case ir.Return(value):
                    self._value(value)
                case ir.Branch(arms):
                    for arm in arms:
                        self._over(arm)
                case ir.Loop(name, over, inner):
                    self._stored(ir.Name(name), self._value(over))
                    for entry, vector in loop_over(statement)[0].items():
                        self._stored(ir.Name(entry), self._value(vector))
                        if vector is not None:
                            # the loop may change its entries
                            self._stored(vector, self._named.get(entry, _EMPTY))
                    is_outer, self._is_inside = not self._is_inside, True
                    self._over(inner)
                    if is_outer:
                        # what a turn makes, the next one uses
                        self._over(inner)
                        self._is_inside = False
                case ir.Scope(kind="entry", body=inner):
                    self._over(inner)

    def _effected(self, call: ir.Call) -> None:
        """Any argument of a call may be its result."""
        if (changed := transformed(call)) is not None:
            target, each = changed
            self._stored(target, self._each(each))
            return
        made = self._called(call, is_effect=True)
        of = [call.callee.of] if isinstance(call.callee, ir.Field) else []
        for target in (*call.args, *of):
            self._stored(target, made)

    def _stored(self, target: ir.Expr, made: _Made) -> None:
        for name in names_of(target):
            self._named[name] = self._of_name(name) | made

    def _value(self, expr: object) -> _Made:
        match expr:
            case ir.Literal() | ir.Text():
                return _EMPTY
            case ir.Name(name):
                return _EMPTY if name in NO_VALUES else self._of_name(name)
            case ir.Binary(sign, left, right):
                return self._combined(sign, self._value(left), self._value(right))
            case ir.Call():
                return self._called(expr)
            case ir.Field(of, name):
                of_whole = _EMPTY if plain_name(expr) else self._value(of)
                return of_whole | self._of_name(name)
            case ir.Index(of, (_, _, *_) as at):
                # f(t, y) in Fortran
                return self._called(ir.Call(of, tuple(at))) | self._value(of)
            case ir.Index(of, at):
                self._all(at)
                return self._value(of)
            case Frozen():
                return self._all([getattr(expr, x) for x in fields(expr)])
            case tuple():
                return self._all(expr)
        return _EMPTY

    def _all(self, parts: Iterable[object]) -> _Made:
        return reduce(_Made.__or__, map(self._value, parts), _EMPTY)

    def _of_name(self, name: str) -> _Made:
        made = self._named.get(name)
        if made is None:
            made = self._named[name] = _Made(bases=frozenset({name}))
        return made

    def _combined(self, sign: str, x: _Made, y: _Made) -> _Made:
        if sign.endswith(("+", "-")):
            made = x | y
            if made.multiples:
                self._sums.append(made)
            return made
        is_divided = "/" in sign and (y.slopes or y.multiples)
        is_product = ("*" in sign or "/" in sign or sign == "@") and not is_divided
        # nothing else is linear in slopes
        product = x.times(y) if is_product else _SYMBOL
        self._multiples |= product.multiples
        return product

    def _each(self, each: Each) -> _Made:
        for name, vector in zip(each.names, each.vectors, strict=True):
            self._stored(ir.Name(name), self._value(vector))
        return self._value(each.body)

    def _called(self, call: ir.Call, is_effect: bool = False) -> _Made:
        if (each := each_in(call)) is not None:
            return self._each(each)
        if (function := self._lambdas.pop(call.callee, None)) is not None:
            for parameter, x in zip(function.parameters, call.args, strict=False):
                self._stored(ir.Name(parameter), self._value(x))
            made = self._value(function.body)
            self._lambdas[call.callee] = function
            return made
        callee, name = call.callee, callee_name(call.callee)
        count = len(call.args) + len(call.named)
        given = self._all((*call.args, *(x for _, x in call.named)))
        # k1(i) is an entry
        of = self._value(callee.of if isinstance(callee, ir.Field) else callee)
        made = given | of
        is_sum = (name, count) in SUMS or name == "add"
        is_sum |= operation_of(name) is not None and not is_effect
        is_other = name in NO_SLOPES | COPIES or (name in CONVERSIONS and len(call.args) == 1)
        if not count or (is_other and not is_sum):
            return made
        if is_sum or getattr(callee, "name", "") in self._functions:
            made = _Made(frozenset(), made.slopes | made.multiples, made.bases)
            self._multiples |= made.multiples
            self._sums.append(made)
            if is_sum:
                return made
        elif name not in OF_ARRAYS:
            made = _Made(of.slopes, of.multiples) if isinstance(callee, ir.Field) else of
        self._given[callee] |= given.bases
        self._passed[callee] |= given.multiples
        self._calls[callee] += 1
        if count > 1:
            self._of_several.add(callee)
        return made | _Made(frozenset({callee}))
