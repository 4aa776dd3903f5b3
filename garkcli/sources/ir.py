"""The common form of all languages: few kinds of expressions and statements, without types."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import Literal as Choice
from typing import TypeAlias

from garkcli.frozen import Frozen, fields


class Name(Frozen):
    """A name; in C++ with its namespaces."""

    name: str


class Literal(Frozen):
    """A number as printed; integers divide as integers in some languages."""

    text: str
    is_whole: bool = False


class Text(Frozen):
    """A text in quotes."""

    text: str


class Field(Frozen):
    """``of.name``, ``of->name``."""

    of: Expr
    name: str


class Range(Frozen):
    """From ``first`` to ``last``, both included; None for the end of the array on that side."""

    first: Expr | None = None
    last: Expr | None = None


class Index(Frozen):
    """``of[at, …]``; a ``Range`` takes a slice."""

    of: Expr
    at: tuple[Expr, ...]


class Call(Frozen):
    """A call with its positional and named arguments."""

    callee: Expr
    args: tuple[Expr, ...]
    named: tuple[tuple[str, Expr], ...] = ()


class Unary(Frozen):
    """A sign before a value."""

    sign: str
    of: Expr


class Binary(Frozen):
    """An operation on two values: ``+ - * /``, ``//`` of integers, ``^``, or unknown."""

    sign: str
    left: Expr
    right: Expr


class Items(Frozen):
    """A list."""

    items: tuple[Expr, ...]


class Rows(Frozen):
    """A matrix by its rows, ``[a b; c d]``; blocks are joined.

    A single row is a matrix in Julia, a single column is one in MATLAB; the other is a list.
    """

    rows: tuple[tuple[Expr, ...], ...]
    is_row_a_matrix: bool = True


class Transposed(Frozen):
    """``of'``, ``of.T``."""

    of: Expr


class Fields(Frozen):
    """Values by their names: a named tuple, a dictionary, designated initialisers; in ``line``."""

    pairs: tuple[tuple[str, Expr], ...]
    line: int = 0


class Lambda(Frozen):
    """A function of one expression: a macro, ``f(x) = …``."""

    parameters: tuple[str, ...]
    body: Expr


class Either(Frozen):
    """One of two values, ``x if … else y``."""

    values: tuple[Expr, Expr]


class Nothing(Frozen):
    """``NULL``, ``None``, ``nothing``."""


class Opaque(Frozen):
    """An expression without a known meaning."""

    reason: str


Expr: TypeAlias = (
    Name
    | Literal
    | Text
    | Field
    | Range
    | Index
    | Call
    | Unary
    | Binary
    | Items
    | Rows
    | Transposed
    | Fields
    | Lambda
    | Either
    | Nothing
    | Opaque
)


class _Statement(Frozen):
    """Any statement."""

    @cached_property
    def every_name(self) -> frozenset[Name]:
        """The names in it."""
        return frozenset(x for x in inside(self) if isinstance(x, Name))


class _Valued(_Statement):
    """A statement with a value."""

    @cached_property
    def parts(self) -> tuple[object, ...]:
        """The value with all its parts."""
        return tuple(inside(getattr(self, "value", None)))

    @cached_property
    def names(self) -> frozenset[Name]:
        """The names in the value."""
        return frozenset(x for x in self.parts if isinstance(x, Name))


class Assign(_Valued):
    """An assignment to a target.

    Attributes:
        target: a name, a field, an entry; ``Items`` if a list is unpacked.
        value: None for a declaration without value.
        sign: of ``+=`` and similar operators; ``.`` fills an array.
        extents: of an array, None for one determined by its values.
        is_real: whether integers become real numbers.
    """

    target: Expr
    value: Expr | None
    line: int
    sign: str = ""
    extents: tuple[Expr | None, ...] = ()
    is_real: bool = False


class Do(_Valued):
    """An expression for its effect: a call."""

    value: Expr
    line: int


class Return(_Valued):
    """The return of a value; Nothing without value."""

    value: Expr
    line: int


Kind: TypeAlias = Choice["module", "function", "class", "entry"]


class Scope(_Statement):
    """A function, a class, an entry of a list of macros.

    Attributes:
        kind: of the scope.
        name: of the scope.
        body: its statements.
        line: its first line, from 1.
        parameters: of a function.
        types: the parameters that are types: calling one converts.
        bases: of a class.
        of: the declared type of the first argument of a function, which owns it in languages with
            multiple dispatch.
        gives: the name of its return value in its class; empty if it needs arguments.
    """

    kind: Kind
    name: str
    body: tuple[Statement, ...]
    line: int
    parameters: tuple[str, ...] = ()
    types: frozenset[str] = frozenset()
    bases: tuple[str, ...] = ()
    of: str = ""
    gives: str = ""

    @property
    def title(self) -> str:
        """The name of the scope for users."""
        return self.of or self.name


class Branch(_Statement):
    """One of several branches; without ``is_total`` perhaps none is taken.

    Attributes:
        arms: the branches.
    """

    arms: tuple[tuple[Statement, ...], ...]
    line: int
    is_total: bool = False


class Loop(_Statement):
    """A body for every value of a name; with an empty name a loop that is not followed."""

    name: str
    over: Expr
    body: tuple[Statement, ...]
    line: int


Statement: TypeAlias = Assign | Do | Return | Scope | Branch | Loop
Body: TypeAlias = tuple[Statement, ...]


def statements(body: Iterable[Statement]) -> Iterator[Statement]:
    """Statements with all nested ones."""
    for statement in body:
        yield statement
        match statement:
            case Branch(arms=arms):
                for arm in arms:
                    yield from statements(arm)
            case Loop(body=inner) | Scope(body=inner):
                yield from statements(inner)


def parts_of(body: Iterable[Statement]) -> Iterator[object]:
    """The parts of all values in statements."""
    for statement in statements(body):
        if isinstance(statement, _Valued):
            yield from statement.parts


def inside(node: object) -> Iterator[object]:
    """An expression with all its parts, itself first."""
    waiting = [node]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Frozen):
            yield node
            if not isinstance(node, Name | Literal):
                waiting += [getattr(node, name) for name in reversed(fields(node))]
        elif isinstance(node, tuple):
            waiting += reversed(node)
