"""Vector fields that are written out in each stage, ``k2 = -g*sin(x + h/2*l1)``, as calls.

Numbers with names of one family, ``k1``, ``k2``, are values of one function if their expressions
differ in its arguments alone.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from garkcli.frozen import Frozen, fields, replace
from garkcli.sources import ir
from garkcli.sources.step_words import is_sum

_MEMBER = re.compile(r"(?P<head>[^\W\d]{1,40}?)_?(?P<number>[0-9]{1,2})(?P<tail>[^\W\d]{0,40})")
MOST_ARGUMENTS = 12
Values = Mapping[int, ir.Expr]
"""Values of assignments by the identities of these."""


def with_functions(body: ir.Body, has_increments: bool) -> ir.Body | None:
    """Statements with calls in place of expressions of a family; None if there is no family.

    Args:
        body: the statements.
        has_increments: whether the first factor of all expressions is the step.
    """
    values: dict[int, ir.Expr] = {}
    families: dict[tuple[str, str], list[ir.Assign]] = defaultdict(list)
    for x in ir.statements(body):
        match x:
            case ir.Assign(ir.Name(name), value, sign="") if value is not None:
                if match := _MEMBER.fullmatch(name):
                    families[match["head"], match["tail"]].append(x)
    for (head, tail), members in families.items():
        names = [x.target for x in members]
        if 1 < len(members) == len({*names}):
            expressions = [x.value for x in members if x.value is not None]
            calls = _calls(f"{head}{tail}", expressions, has_increments)
            values |= {id(x): call for x, call in zip(members, calls, strict=False)}
    return _replaced(body, values) if values else None


def _replaced(body: Iterable[ir.Statement], values: Values) -> ir.Body:
    made: list[ir.Statement] = []
    for x in body:
        match x:
            case ir.Assign() if id(x) in values:
                x = replace(x, value=values[id(x)])
            case ir.Loop(body=inner):
                x = replace(x, body=_replaced(inner, values))
            case ir.Branch(arms=arms):
                x = replace(x, arms=tuple(_replaced(arm, values) for arm in arms))
        made.append(x)
    return tuple(made)


def _calls(name: str, values: Sequence[ir.Expr], has_increments: bool) -> list[ir.Expr]:
    """Expressions as calls of one function, perhaps times the step; empty if they are none."""
    every = [x for value in values for x in ir.inside(value)]
    if any(isinstance(x, ir.Opaque) for x in every):
        # parts that are not read may differ
        return []
    inner, step = [*values], None
    match values[0]:
        case ir.Binary("*", ir.Name() as factor, _) if has_increments:
            if all(isinstance(x, ir.Binary) and x.left == factor for x in values):
                inner, step = [x.right for x in values if isinstance(x, ir.Binary)], factor
    arguments = [*_arguments(inner)]
    differing = [x for each in arguments for value in each for x in ir.inside(value)]
    if any(isinstance(x, ir.Call) for x in (*inner, *differing)):
        # other functions are there
        return []
    if not 0 < len(arguments) <= MOST_ARGUMENTS or not any(map(is_sum, every)):
        return []
    callee = ir.Name(f"f of {name}")
    calls = [ir.Call(callee, tuple(x)) for x in zip(*arguments, strict=True)]
    return [x if step is None else ir.Binary("*", step, x) for x in calls]


def _arguments(values: Sequence[ir.Expr]) -> Iterator[Sequence[ir.Expr]]:
    """The parts in which expressions differ, each with its form in all of them."""
    first, *others = values
    if all(x == first for x in others):
        return
    parts = [_parts(x) for x in values]
    heads = {(type(x), _head(x)) for x in values}
    if len(heads) == 1 and len({*map(len, parts)}) == 1 and parts[0]:
        found = [x for each in zip(*parts, strict=True) for x in _arguments(each)]
        yield from found or [values]
    else:
        yield values


def _parts(expr: ir.Expr) -> list[ir.Expr]:
    """The expressions in another one; a function is no part of its call."""
    inside: list[Any] = []
    for name in fields(expr):
        part = getattr(expr, name)
        if name != "callee":
            items = part if isinstance(part, tuple) else [part]
            inside += [x for x in items if isinstance(x, Frozen)]
    return inside


def _head(expr: ir.Expr) -> object:
    """All of an expression but its parts."""
    if isinstance(expr, ir.Call):
        return expr.callee, tuple(name for name, _ in expr.named)
    parts = (getattr(expr, name) for name in fields(expr))
    return tuple(x for x in parts if isinstance(x, str | bool))
