"""Julia: matrices with // by their names, and what makes tableaus of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from garkcli.bridges.readers.assignments import Assigned, Called, Walk
from garkcli.bridges.readers.cells import Cells
from garkcli.bridges.readers.finder import Finder, tables_of
from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.lexing import JULIA, Token, tokens_of, without
from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import assembled, table_of_blocks
from garkcli.sources.found import FoundTable, Reader, Unreadable, troubled
from garkcli.sources.naming import ROLES
from garkcli.sources.scalars import Value, is_row, rows_of, whole
from garkcli.sources.shaping import square, weights

NAME = "julia"
_TYPES = (
    *("T", "T1", "T2", "Float64", "Float32", "BigFloat", "Rational", "Int"),
    *("BigInt", "convert", "parse", "big", "map", "Vector", "Matrix", "Array"),
    *("SMatrix", "SVector", "collect", "vec", "Complex", "Int64", "Double64"),
    *("transpose", "promote", "similar", "Base", "float", "rational"),
)
GRAMMAR = Grammar(
    lists={},
    matrices={"[": "]"},
    calls={"(": ")"},
    roots={"sqrt": "sqrt", "cbrt": "cbrt", "√": "sqrt"},
    passed=frozenset(_TYPES),
    nothing=frozenset({"nothing", "missing"}),
    commas_join=False,
)
_ENDS = frozenset({";", ")", "end", ","})
_Arguments = Mapping[str, Value]
_TRUTHS = ("true", "false")


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Julia source."""
    tokens = without(tokens_of(text, JULIA), "comment")
    allowance = Allowance()
    walk = Walk(tokens, GRAMMAR, MAKERS, _ENDS, _title, allowance)
    walk.names.update({word: word for word in _TRUTHS})
    return tables_of(walk, _Finder(source, allowance))


def _title(tokens: list[Token], place: int) -> str:
    token = tokens[place]
    if token.kind != "name":
        return ""
    signs = [x.text for x in tokens[place + 1 : place + 3]]
    if signs == ["=", "("] and _holds_names(tokens, place + 3):
        return token.text
    if token.text not in {"function", "struct"}:
        return ""
    behind = tokens[place + 1]
    return behind.text if behind.kind == "name" else ""


def _holds_names(tokens: list[Token], place: int) -> bool:
    """Whether a named tuple begins here: ``(A = …``."""
    inside = [x for x in tokens[place : place + 4] if x.kind != "line"]
    is_name = len(inside) > 1 and inside[0].kind == "name"
    return is_name and inside[1].text == "="


class _Finder(Finder):
    """Collects what is assigned in one function."""

    def __init__(self, source: str, allowance: Allowance) -> None:
        super().__init__(source, allowance)
        self._cells = Cells(1)
        self._made: list[FoundTable] = []
        self._values: dict[str, Value] = {}
        self._line = 1

    def end(self) -> None:
        """The tables of the function; those that a constructor takes are found once."""
        found = self._allowance.tables(self._scope.tables(self._source, NAME))
        blocks = table_of_blocks(self._values, self._source, NAME, self._scope.title, self._line)
        self._values = {}
        if blocks is not None:
            found = [self._allowance.table(blocks)]
        made = {(x.A, x.b) for x in self._made}
        self.found += self._made
        if not self._made:
            self.found += [x for x in found if (x.A, x.b) not in made]
            of_cells = self._cells.table(self._source, NAME, self._scope.title, self._allowance)
            if of_cells is not None and not found:
                self.found.append(of_cells)
        self._made = []
        self._cells = Cells(1)

    def assigned(self, event: Assigned) -> None:
        """A matrix, or an entry of one, was assigned."""
        self._cells.put(event.name, event.indices, event.value)
        if event.indices:
            return
        self._scope.add(event.name, event.value, event.line)
        role = ROLES.get(event.name)
        if role == "A":
            self._line = event.line
        if role is not None:
            self._values[role] = event.value

    def called(self, event: Called) -> None:
        """A tableau was made."""
        empty = FoundTable(self._source, event.line, NAME, self._scope.title, (), ())
        places = [value for key, value in event.arguments if not key]
        named = {key: value for key, value in event.arguments if key}
        if not places:
            # the definition of a constructor, or a method of it
            return
        try:
            table = MAKERS[event.name](empty, places, named)
        except Unreadable as error:
            table = troubled(empty, f"{event.name}: {error.message}")
        if table is not None:
            self._made.append(self._allowance.table(table))


def _explicit(empty: FoundTable, values: list[Value], named: _Arguments) -> FoundTable | None:
    """``ExplicitRKTableau(A, c, α, order; αEEst, adaptiveorder, fsal)``: nodes before weights."""
    if len(values) < 4 or not all(isinstance(x, list) for x in values[:3]):
        return None
    b = weights(values[2])
    A = square(values[0], len(b))
    c = weights(values[1], len(b))
    embedded = None
    for key in ("αEEst", "alphaEEst"):
        if isinstance(named.get(key), list):
            embedded = (weights(named[key], len(b)),)
    flags = {}
    if named.get("fsal") in _TRUTHS:
        flags["fsal"] = named["fsal"] == "true"
    adaptive = whole(named.get("adaptiveorder"))
    return replace(
        empty,
        A=((A,),),
        b=(b,),
        c=(c,),
        embedded=embedded,
        order=whole(values[3]),
        embedded_order=adaptive or None,
        flags=flags,
    )


def _rooted_trees(empty: FoundTable, values: list[Value], named: _Arguments) -> FoundTable | None:
    """``RungeKuttaMethod(A, b, c)`` of RootedTrees.jl."""
    del named
    if len(values) < 2 or not all(isinstance(x, list) for x in values[:2]):
        return None
    b = weights(values[1])
    c = weights(values[2], len(b)) if len(values) > 2 else None
    A = square(values[0], len(b))
    return replace(empty, A=((A,),), b=(b,), c=(c,))


def _additive(empty: FoundTable, values: list[Value], named: _Arguments) -> FoundTable | None:
    """``AdditiveRungeKuttaMethod([A1, A2, …], [b1, b2, …], [c1, c2, …])``."""
    del named
    if len(values) < 2 or not all(isinstance(x, list) for x in values[:2]):
        return None
    matrices, rows = values[0], values[1]
    assert isinstance(matrices, list)
    assert isinstance(rows, list)
    blocks = tuple(rows_of(x) for x in matrices)
    b = tuple(weights(x) for x in rows)
    c = None
    if len(values) > 2 and isinstance(values[2], list) and values[2]:
        nodes = tuple(weights(x) for x in values[2])
        if len(set(nodes)) > 1:
            grid = (blocks,) * len(blocks)
            return replace(empty, A=grid, b=b, c=nodes)
        c = nodes[0]
    return assembled(replace(empty, A=(blocks,), b=b, c=(c,)))


def _runge_kutta_jl(empty: FoundTable, values: list[Value], named: _Arguments) -> FoundTable | None:
    """``Tableau(name, order, a, b, c)`` of RungeKutta.jl."""
    del named
    if len(values) < 5 or not is_row(values[3]):
        return None
    b = weights(values[3])
    A = square(values[2], len(b))
    c = weights(values[4], len(b))
    name = values[0] if isinstance(values[0], str) else empty.name
    order = whole(values[1])
    return replace(empty, name=name, order=order, A=((A,),), b=(b,), c=(c,))


_Make = Callable[[FoundTable, list[Value], _Arguments], "FoundTable | None"]
MAKERS: Mapping[str, _Make] = {
    "ExplicitRKTableau": _explicit,
    "ImplicitRKTableau": _explicit,
    "RungeKuttaMethod": _rooted_trees,
    "AdditiveRungeKuttaMethod": _additive,
    "Tableau": _runge_kutta_jl,
}
"""What makes tableaus, and what the arguments are."""
READER = Reader(
    NAME, "Julia: matrices with //, ExplicitRKTableau, RungeKuttaMethod", (".jl",), find
)
