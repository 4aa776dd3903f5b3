"""Vector fields that are written out in each stage, ``k2 = -g*sin(x + h/2*l1)``, as calls.

Numbers with names of one family, ``k1``, ``k2``, are values of one function if their expressions
differ in its arguments alone.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence, Set
from typing import Any

from garkcli.frozen import Frozen, fields, replace
from garkcli.sources import ir
from garkcli.sources.elementwise import substituted

_MEMBER = re.compile(r"(?P<head>[^\W\d]{1,40}?)_?(?P<number>[0-9]{1,2})(?P<tail>[^\W\d]{0,40})")
_DIGITS = re.compile("[0-9]+")
_OF = "f of "
_EULER = re.compile("^(?!.*(implicit|backward|semi|symplectic)).*euler", re.IGNORECASE)
MOST_ARGUMENTS = 12
Values = Mapping[int, ir.Expr]
"""Values of assignments by the identities of these."""


def with_functions(body: ir.Body, has_increments: bool) -> ir.Body | None:
    """Statements with calls in place of expressions of a family; None if there is no family.

    Args:
        body: the statements.
        has_increments: whether the first factor of all expressions of some family is the step.
    """
    values: dict[int, ir.Expr] = {}
    families: dict[tuple[str, str], list[ir.Assign]] = defaultdict(list)
    for x in ir.statements(body):
        match x:
            case ir.Assign(target, value, sign="") if value is not None:
                name, entry = _parted(target)
                if match := _MEMBER.fullmatch(name):
                    families[match["head"], match["tail"] + entry].append(x)
    for (head, tail), members in families.items():
        names = [x.target for x in members]
        if 1 < len(members) == len({*names}):
            expressions = [x.value for x in members if x.value is not None]
            calls = _calls(f"{head}{tail}", expressions, has_increments)
            values |= {id(x): call for x, call in zip(members, calls, strict=False)}
    if has_increments and not any(isinstance(x, ir.Binary) for x in values.values()):
        # the same as without increments
        return None
    return _replaced(body, values) if values else None


def is_written_out(callee: ir.Expr) -> bool:
    """Whether a function stands for expressions of a family."""
    return isinstance(callee, ir.Name) and callee.name.startswith(_OF)


def with_calls(body: ir.Body) -> ir.Body:
    """Statements of Fortran with calls in place of what looks like entries, ``f(u + h*k)``, and
    ``f%eval(t, u + h*k)``.
    """
    targets = (x.target for x in ir.statements(body) if isinstance(x, ir.Assign))
    assigned = {x.of for x in targets if isinstance(x, ir.Index)}
    entries = (x for x in ir.parts_of(body) if isinstance(x, ir.Index))
    entries = (x for x in entries if len(x.at) == 1 or isinstance(x.of, ir.Field))
    called = {x.of for x in entries if any(map(_is_multiple, ir.inside(x.at)))}
    functions = frozenset(called - assigned)
    return substituted(body, {}, functions) if functions else body


def with_euler_steps(body: ir.Body, functions: Container[str]) -> ir.Body:
    """Statements with ``v = u + h*f(u)`` in place of ``call euler(u, v)``, and this sum for
    ``euler(u)``, if functions of other sources are explicit Euler steps by name.
    """
    given: dict[str, list[ir.Call]] = defaultdict(list)
    for x in ir.parts_of(body):
        match x:
            case ir.Call(ir.Name(name) | ir.Field(name=name)) if _EULER.search(name):
                given[name].append(x)
    for_effect = [x.value for x in ir.statements(body) if isinstance(x, ir.Do)]
    steps = {
        name
        for name, calls in given.items()
        if len(calls) > 1 and name not in functions
        if _are_of_one_step([x.args[2 if x in for_effect else 1 :] for x in calls])
    }
    return _with_sums(body, steps) if steps else body


def _are_of_one_step(further: Sequence[Sequence[ir.Expr]]) -> bool:
    """Whether the further arguments of calls, of which one may be the step, are equal or flags."""
    if len({*map(len, further)}) > 1:
        return False
    of_each = [{*of} for of in zip(*further, strict=True)]
    return all(len(of) == 1 or all(map(_is_flag, of)) for of in of_each)


def _is_flag(expr: ir.Expr) -> bool:
    match expr:
        case ir.Name(name):
            return name.lower() in {"true", "false"}
        case ir.Opaque(reason):
            return "boolean" in reason
    return False


def _with_sums(node: Any, steps: Set[str]) -> Any:
    if isinstance(node, tuple):
        return tuple(_with_sums(x, steps) for x in node)
    if not isinstance(node, Frozen):
        return node
    match node:
        case ir.Do(ir.Call(ir.Name(name), (of, target, *_)), line) if name in steps:
            return ir.Assign(target, _euler_step(name, of), line)
        case ir.Call(ir.Name(name) | ir.Field(name=name), (of, *_)) if name in steps:
            return _euler_step(name, _with_sums(of, steps))
    parts = {name: getattr(node, name) for name in fields(node)}
    made = {name: _with_sums(x, steps) for name, x in parts.items()}
    changed = {name: x for name, x in made.items() if x is not parts[name] and x != parts[name]}
    return replace(node, **changed) if changed else node


def _euler_step(name: str, of: ir.Expr) -> ir.Expr:
    slope = ir.Call(ir.Name(f"{_OF}{name}"), (of,))
    return ir.Binary("+", of, ir.Binary("*", ir.Name(f"step_of_{name}"), slope))


def _is_multiple(expr: object) -> bool:
    """Whether it is a product of names, which no index is."""
    match expr:
        case ir.Binary("*", left, right):
            return not isinstance(left, ir.Literal) and not isinstance(right, ir.Literal)
    return False


def _parted(target: ir.Expr) -> tuple[str, str]:
    """The name in a target, and its entry or field, ``k1[0]``, ``k1.x``; empty for others."""
    match target:
        case ir.Name(name):
            return name, ""
        case ir.Index(ir.Name(name), (ir.Literal(at),)):
            return name, f"[{at}]"
        case ir.Field(ir.Name(name), field):
            return name, f".{field}"
    return "", ""


def with_one_function(body: ir.Body, functions: Mapping[str, ir.Scope]) -> ir.Body:
    """Statements with calls of one function in place of those of a family, ``f1(y)``, ``f2(z)``,
    whose members differ in numbers alone, as a vector field does at different times.

    Args:
        body: the statements.
        functions: of the source.
    """
    local = {x.name: x for x in ir.statements(body) if isinstance(x, ir.Scope)}
    called = {getattr(x.callee, "name", "") for x in ir.parts_of(body) if isinstance(x, ir.Call)}
    members: dict[str, list[ir.Scope]] = defaultdict(list)
    for name in called:
        scope = local.get(name, functions.get(name))
        if scope is not None and (match := _MEMBER.fullmatch(scope.name)) is not None:
            members[match["head"]].append(scope)
    families: dict[tuple[str, object], set[str]] = defaultdict(set)
    for head, scopes in members.items():
        for scope in scopes if len(scopes) > 1 else ():
            families[head, _shape((scope.parameters, scope.body))].add(scope.name)
    values: dict[str, ir.Expr] = {
        name: ir.Name(f"each {head}")
        for (head, _), names in families.items()
        if len(names) > 1
        for name in names
    }
    return substituted(body, values) if values else body


def _shape(node: object) -> object:
    """Statements without the numbers in them, those of names too."""
    match node:
        case ir.Literal():
            return "#"
        case str():
            return _DIGITS.sub("#", node)
        case tuple():
            return tuple(map(_shape, node))
        case Frozen():
            return (type(node), *(_shape(getattr(node, x)) for x in fields(node)))
    # a line
    return None


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
    if not 0 < len(arguments) <= MOST_ARGUMENTS:
        return []
    callee = ir.Name(f"{_OF}{name}")
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
