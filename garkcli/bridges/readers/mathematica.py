"""Mathematica: lists by their names or under keys, and {amat, bvec, cvec, evec} of NDSolve."""

from __future__ import annotations

from garkcli.bridges.readers.assignments import Assigned, Walk
from garkcli.bridges.readers.finder import Finder, tables_of
from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.lexing import MATHEMATICA, Token, tokens_of, without
from garkcli.frozen import replace
from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import table_of_blocks
from garkcli.sources.found import FoundTable, Reader, Unreadable
from garkcli.sources.naming import ROLES
from garkcli.sources.scalars import Scalar, Value, is_matrix, is_row, row_of
from garkcli.sources.shaping import difference, square, weights

NAME = "mathematica"
GRAMMAR = Grammar(
    lists={"{": "}"},
    calls={"[": "]"},
    roots={
        "sqrt": "sqrt",
        "cuberoot": "cbrt",
        "surd": "root",
        "rational": "rational",
        "power": "power",
        "root": "algebraic",
    },
    passed=frozenset({"N", "SetPrecision", "Rationalize", "SetAccuracy"}),
    nothing=frozenset({"None", "Null"}),
    is_implicit=True,
)
_ENDS = frozenset({";", ",", "|", "}", "]", "&"})
_ORDERS = {"DifferenceOrder": "order", "EmbeddedDifferenceOrder": "embedded_order"}


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Mathematica source."""
    tokens = without(tokens_of(text, MATHEMATICA), "comment")
    allowance = Allowance()
    walk = Walk(_with_names(_on_their_lines(tokens)), GRAMMAR, _ENDS, _title, allowance)
    walk.names["x"] = Scalar("x")
    return tables_of(walk, _Finder(source, allowance))


def _on_their_lines(tokens: list[Token]) -> list[Token]:
    """The tokens without the ends of lines in brackets, where they end nothing."""
    found = []
    depth = 0
    for token in tokens:
        if token.kind == "sign":
            depth += token.text in "([{"
            depth -= token.text in ")]}"
        if token.kind != "line" or depth <= 0:
            found.append(token)
    return found


def _with_names(tokens: list[Token]) -> list[Token]:
    """The same with ``"A" -> …`` as ``A = …``."""
    tokens = [_variable(token) for token in tokens if token.text != "&"]
    found = list(tokens)
    for place in range(len(tokens) - 1):
        token, behind = tokens[place], tokens[place + 1]
        is_rule = behind.kind == "sign" and behind.text == "->"
        if token.kind == "text" and is_rule:
            found[place] = replace(token, kind="name")
            found[place + 1] = replace(behind, text="=")
    return found


def _variable(token: Token) -> Token:
    """The variable of a pure function, ``#``, as a name."""
    is_slot = token.kind == "sign" and token.text == "#"
    return replace(token, kind="name", text="x") if is_slot else token


def _title(tokens: list[Token], place: int) -> str:
    """The name of an association: ``name = <|``."""
    token = tokens[place]
    if token.kind != "name" or place + 3 >= len(tokens):
        return ""
    signs = [x.text for x in tokens[place + 1 : place + 4]]
    return token.text if signs == ["=", "<", "|"] else ""


class _Finder(Finder):
    """Collects lists into tables."""

    def __init__(self, source: str, allowance: Allowance) -> None:
        super().__init__(source, allowance)
        self._values: dict[str, Value] = {}
        self._line = 0
        self._listed: list[FoundTable] = []

    def end(self) -> None:
        """The tables of what has ended."""
        title = self._scope.title
        found = self._allowance.tables(self._scope.tables(self._source, NAME))
        blocks = table_of_blocks(self._values, self._source, NAME, title, max(self._line, 1))
        if blocks is not None:
            found = [self._allowance.table(blocks)]
        # the lists of {amat, bvec, cvec} are often named before
        listed = [_coefficients_of(table) for table in self._listed]
        self.found += self._listed
        self.found += [x for x in found if _coefficients_of(x) not in listed]
        self._listed = []
        self._values = {}
        self._line = 0

    def assigned(self, event: Assigned) -> None:
        """A list has a name."""
        name = _ORDERS.get(event.name, event.name)
        if name in ROLES:
            self._line = self._line or event.line
            self._values[ROLES[name]] = event.value
        self._scope.add(name, event.value, event.line)
        listed = _coefficients(event, self._source)
        if listed is not None:
            self._listed.append(self._allowance.table(listed))


def _coefficients_of(table: FoundTable) -> tuple[object, ...]:
    return table.A, table.b, table.c


def _coefficients(event: Assigned, source: str) -> FoundTable | None:
    """``f[order_, prec_] := N[{amat, bvec, cvec, evec}, prec]``."""
    value = event.value
    if not isinstance(value, list) or len(value) not in (3, 4):
        return None
    if not is_matrix(value[0]) or not all(is_row(x) for x in value[1:]):
        return None
    try:
        b = weights(value[1])
        A = square(value[0], len(b))
        c = row_of(value[2])
        if len(c) == len(b) - 1:
            c = ("0", *c)
        error = row_of(value[3]) if len(value) == 4 else None
        embedded = None if error is None else (difference(b, error),)
    except Unreadable:
        return None
    first = event.indices[0] if event.indices else 0
    return FoundTable(
        source,
        event.line,
        NAME,
        event.name,
        ((A,),),
        (b,),
        (c,),
        embedded=embedded,
        order=first or None,
    )


READER = Reader(
    NAME, "Mathematica: lists by their names, coefficients of NDSolve", (".wl", ".m", ".wls"), find
)
