"""What every language is lowered to: expressions and statements, few and without types."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal as Choice
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Name:
    """A name; in C++ with its namespaces."""

    name: str


@dataclass(frozen=True, slots=True)
class Literal:
    """A number as it is printed; whole numbers divide as whole numbers in some languages."""

    text: str
    is_whole: bool = False


@dataclass(frozen=True, slots=True)
class Text:
    """A text in quotes."""

    text: str


@dataclass(frozen=True, slots=True)
class Field:
    """``of.name``, ``of->name``."""

    of: Expr
    name: str


@dataclass(frozen=True, slots=True)
class Range:
    """From ``first`` to ``last``, both included; None is the end of the array on that side."""

    first: Expr | None = None
    last: Expr | None = None


@dataclass(frozen=True, slots=True)
class Index:
    """``of[at, …]``; a ``Range`` takes a slice."""

    of: Expr
    at: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Call:
    """A call with its arguments, those with a name apart."""

    callee: Expr
    args: tuple[Expr, ...]
    named: tuple[tuple[str, Expr], ...] = ()


@dataclass(frozen=True, slots=True)
class Unary:
    """A sign before a value."""

    sign: str
    of: Expr


@dataclass(frozen=True, slots=True)
class Binary:
    """An operation on two values: ``+ - * /``, ``//`` of whole numbers, ``^``, or unknown."""

    sign: str
    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    items: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Rows:
    """A matrix by its rows, ``[a b; c d]``; blocks are joined.

    A single row is a matrix in Julia, a single column is one in MATLAB; the other is a list.
    """

    rows: tuple[tuple[Expr, ...], ...]
    is_row_a_matrix: bool = True


@dataclass(frozen=True, slots=True)
class Transposed:
    """``of'``, ``of.T``."""

    of: Expr


@dataclass(frozen=True, slots=True)
class Fields:
    """Values by their names: a named tuple, a dictionary, designated initialisers."""

    pairs: tuple[tuple[str, Expr], ...]


@dataclass(frozen=True, slots=True)
class Lambda:
    """A function of one expression: a macro, ``f(x) = …``."""

    parameters: tuple[str, ...]
    body: Expr


@dataclass(frozen=True, slots=True)
class Nothing:
    """``NULL``, ``None``, ``nothing``."""


@dataclass(frozen=True, slots=True)
class Opaque:
    """What has no meaning here."""

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
    | Nothing
    | Opaque
)


@dataclass(frozen=True, slots=True)
class Assign:
    """A target has a value from a line on.

    Attributes:
        target: a name, a field, an entry; ``Items`` where a list is taken apart.
        value: None where a name is declared alone.
        sign: of ``+=`` and the like; ``.`` fills an array.
        extents: of an array, None for one that its values give.
        is_real: whether whole numbers become real ones.
    """

    target: Expr
    value: Expr | None
    line: int
    sign: str = ""
    extents: tuple[Expr | None, ...] = ()
    is_real: bool = False


@dataclass(frozen=True, slots=True)
class Do:
    """An expression for its effect: a call."""

    value: Expr
    line: int


@dataclass(frozen=True, slots=True)
class Return:
    """The value of a function; nothing where it has none."""

    value: Expr
    line: int


Kind: TypeAlias = Choice["module", "function", "class", "record", "entry"]


@dataclass(frozen=True, slots=True)
class Scope:
    """A function, a class, the fields of a record, an entry of a list of macros.

    Attributes:
        kind: which of them.
        name: of it.
        body: what is in it.
        line: where it begins, from 1.
        parameters: of a function, or the fields of a record, with their values where they have one.
        types: the parameters that are types: calling one converts.
        bases: of a class.
    """

    kind: Kind
    name: str
    body: tuple[Statement, ...]
    line: int
    parameters: tuple[tuple[str, Expr | None], ...] = ()
    types: frozenset[str] = frozenset()
    bases: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Branch:
    """One of several ways; without ``is_total`` none may be taken.

    Attributes:
        conditions: one a way, as far as there is one.
        arms: the ways.
    """

    conditions: tuple[Expr, ...]
    arms: tuple[tuple[Statement, ...], ...]
    line: int
    is_total: bool = False


@dataclass(frozen=True, slots=True)
class Loop:
    """A body for every value of a name; an empty name is a loop that is not followed."""

    name: str
    over: Expr
    body: tuple[Statement, ...]
    line: int


Statement: TypeAlias = Assign | Do | Return | Scope | Branch | Loop
Body: TypeAlias = tuple[Statement, ...]
