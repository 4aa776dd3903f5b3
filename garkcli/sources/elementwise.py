"""Expressions and loops for all entries of vectors: comprehensions, ``zip``, ``map``, ``transform``
of C++, ``for (auto &x : v)``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from garkcli.frozen import Frozen, fields, replace
from garkcli.sources import ir

_BY_ENTRIES = frozenset({"transform", "std::transform"})
ITEM = "each item"
"""The name of what a loop takes apart: ``for a, b in …``."""
T = TypeVar("T")


class Each(Frozen):
    """An expression for all entries of vectors.

    Attributes:
        names: of the entries.
        vectors: one for each name; None for a counter.
        body: the expression.
        over: what the names run over.
    """

    names: tuple[str, ...]
    vectors: tuple[ir.Expr | None, ...]
    body: ir.Expr
    over: ir.Expr


def each_in(call: ir.Expr) -> Each | None:
    """The expression for all entries that a call of a comprehension or of ``map`` is; None for
    other calls.
    """
    match call:
        case ir.Call(ir.Name("list of each" | "map"), (ir.Lambda(names, body), over), ()):
            vectors = vectors_of(names, over)
        case ir.Call(ir.Name("map"), (ir.Lambda(names, body), over, *others), ()):
            vectors = (over, *others) if len(names) == 1 + len(others) else ()
        case ir.Call(ir.Name("map"), (ir.Name() as function, over), ()):
            names, vectors = (ITEM,), (over,)
            body = ir.Call(function, (ir.Name(ITEM),))
        case _:
            return None
    return Each(names, vectors, body, over) if vectors else None


def vectors_of(names: Sequence[str], over: ir.Expr) -> tuple[ir.Expr | None, ...]:
    """The vectors that names run over, None for a counter; empty if they do not fit."""
    vectors: list[ir.Expr | None] = []
    waiting = [over]
    while waiting:
        match waiting.pop():
            case ir.Call(ir.Name("zip"), args, ()):
                waiting += reversed(args)
            case ir.Call(ir.Field(of, "zip"), (other,), ()):
                waiting += (other, of)
            case ir.Call(ir.Name("enumerate"), (of,)) | ir.Call(ir.Field(of, "enumerate"), ()):
                vectors.append(None)
                waiting.append(of)
            case ir.Call(ir.Name("range")) if len(names) == 1:
                vectors.append(None)
            case vector:
                vectors.append(vector)
    return tuple(vectors) if len(vectors) == len(names) else ()


def transformed(call: ir.Expr) -> tuple[ir.Expr, Each] | None:
    """The target and the expression of ``std::transform(x, x_end, [y,] z, f)``; None for other
    calls.
    """
    match call:
        case ir.Call(ir.Name(name), (x, _, *others, target, ir.Lambda(names, body))):
            vectors = (x, *others)
            if name in _BY_ENTRIES and len(vectors) == len(names):
                return target, Each(names, vectors, body, x)
    return None


def loop_over(loop: ir.Loop) -> tuple[Mapping[str, ir.Expr | None], ir.Body]:
    """The names of a loop with the vectors that they run over, None for a counter, and its body;
    no names if they do not fit.
    """
    names: tuple[str, ...] = (loop.name,)
    body = loop.body
    match loop.body:
        case (ir.Assign(ir.Items(items), ir.Name(name)), *rest) if name == loop.name == ITEM:
            names = tuple(getattr(x, "name", "") for x in items)
            body = tuple(rest)
    return dict(zip(names, vectors_of(names, loop.over), strict=False)), body


def substituted(
    node: T, values: Mapping[str, ir.Expr], calls: frozenset[ir.Expr] = frozenset()
) -> T:
    """Statements or an expression with other expressions for some names, and calls for entries of
    others.
    """
    if isinstance(node, ir.Name):
        return values.get(node.name, node)  # type: ignore[return-value]
    if isinstance(node, tuple):
        return tuple(substituted(x, values, calls) for x in node)  # type: ignore[return-value]
    if not isinstance(node, Frozen):
        return node
    parts = {name: getattr(node, name) for name in fields(node)}
    made = {name: substituted(x, values, calls) for name, x in parts.items()}
    if isinstance(node, ir.Index) and node.of in calls:
        return ir.Call(made["of"], made["at"])  # type: ignore[return-value]
    changed = {name: x for name, x in made.items() if x is not parts[name] and x != parts[name]}
    return replace(node, **changed) if changed else node
