"""Mathematica: lists by their names or under keys, and {amat, bvec, cvec, evec} of NDSolve."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.sources import ir
from garkcli.sources.formulas import Formulas
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import MAX_NESTING
from garkcli.sources.reading import tables_in
from garkcli.sources.signatures import NDSOLVE

NAME = "mathematica"
_ROUNDED = frozenset({"N", "SetPrecision", "SetAccuracy", "Rationalize"})
_ORDER = ir.Name("order")


class MathematicaLowering(Formulas):
    def __init__(self, text: str) -> None:
        super().__init__(text, call="[")

    def block(self, start: int = 0, end: int | None = None, depth: int = 0) -> ir.Body:
        end = len(self.tokens) if end is None else end
        parts = [x for x in self.parts(start, end, ";", "\n") if x[0] < x[1]]
        return tuple(y for part in parts for y in self._statement(*part, depth))

    def _statement(self, start: int, end: int, depth: int) -> Iterator[ir.Statement]:
        *targets, value = self.parts(start, end, "=", ":=")
        line = self.tokens[start].line
        if not targets:
            yield from self._inside(*value, depth)
        for target in targets:
            match self.expression(*target):
                case ir.Call(callee=ir.Name(name=name), args=args):
                    body = self._inside(*value, depth)
                    if args and isinstance(args[0], ir.Literal):
                        # coefficients[order, precision_] := …
                        body = (ir.Assign(_ORDER, args[0], line), *body)
                    yield ir.Scope("function", name, body, line)
                case ir.Name(name=name) as made:
                    assigned = ir.Assign(made, self.expression(*value), line)
                    is_entry = isinstance(assigned.value, ir.Fields)
                    yield ir.Scope("entry", name, (assigned,), line) if is_entry else assigned
                case ir.Index() as entry:
                    yield ir.Assign(entry, self.expression(*value), line)

    def _inside(self, start: int, end: int, depth: int) -> ir.Body:
        """The statements in brackets, as in ``With[{x = 1}, …]``, or the table that a value is."""
        value, line = self.expression(start, end), self.tokens[start].line
        listed = _of_ndsolve(value)
        if listed:
            return (ir.Do(ir.Call(ir.Name(NDSOLVE), listed, (("order", _ORDER),)), line),)
        opener = start + (self.sign(start + 1) == "[")
        if self.closes.get(opener, -1) < end - 1 or depth > MAX_NESTING:
            return (ir.Do(value, line),)
        parts = self.parts(opener + 1, self.closes[opener], ",")
        return tuple(x for part in parts for x in self.block(*part, depth + 1))


def _of_ndsolve(value: ir.Expr) -> tuple[ir.Expr, ...]:
    """The lists of ``N[{amat, bvec, cvec, evec}, precision]``; empty for other values."""
    match value:
        case ir.Call(callee=ir.Name(name=name), args=(first, *_)) if name in _ROUNDED:
            value = first
    match value:
        case ir.Items(items=[ir.Items() | ir.Name(), _, _] | [ir.Items() | ir.Name(), _, _, _]):
            return value.items
    return ()


_MATLAB = re.compile(r"^[ \t]*(?:%|function\b|classdef\b|end[ \t]*;?$)", re.MULTILINE)
"""Lines of MATLAB, whose files have the same ending."""


def find(text: str, source: str) -> list[FoundTable]:
    if source.endswith(".m") and _MATLAB.search(text):
        return []
    return tables_in(text, source, NAME, lambda x: MathematicaLowering(x).block(), base=1)


READER = Reader(
    NAME, "Mathematica: lists by their names, coefficients of NDSolve", (".wl", ".m", ".wls"), find
)
