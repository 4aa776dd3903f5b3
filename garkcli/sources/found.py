"""A table as it is found in a source: coefficients as text, and what the source says of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.errors import GarkError
from garkcli.frozen import Frozen, field, replace

Row: TypeAlias = tuple[str, ...]
"""Numbers as texts of ``garkcli.exact.expression``."""
Rows: TypeAlias = tuple[Row, ...]
Units: TypeAlias = tuple[tuple[str, fmpq], ...]
"""By how much texts of numbers may be off."""
Grid: TypeAlias = tuple[tuple[Rows | None, ...], ...]

MAX_STAGES = 200
"""Most stages of a table."""
MAX_TABLES = 1_000
"""Most tables that are read from one source."""
MAX_LENGTH = 4_000
"""Longest text of a coefficient, its named constants written out."""
MAX_CHARACTERS = 4_000_000
"""Longest source that is read."""


class Unreadable(GarkError):
    """What is at a place in a source is no value that a reader knows."""


class Misshapen(Unreadable):
    """Numbers that are written out, and are too many or too few for a method."""


class TooLarge(GarkError):
    """A source is too large, or becomes it where its names are written out.

    Attributes:
        line: where the limit was reached, from 1.
    """

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.line = line


class FoundCoupling(Frozen):
    """How the slow stages of a multirate infinitesimal method are coupled, as in method files.

    Attributes:
        c: their nodes, from 0 to the end of the step.
        parts: by ``omega``, the explicit part, and ``gamma``, the implicit one, a matrix for each
            power of τ; row i leads to the stage after stage i.
        embedded: by the same names the rows that lead to the embedded value; empty without them.
        restart: what the forcing of methods is whose fast problems begin with the step; empty of
            others.
    """

    c: Row
    parts: Mapping[str, tuple[Rows, ...]]
    embedded: Mapping[str, Rows]
    restart: str


class FoundTable(Frozen):
    """The coefficients of one method, as a source has them.

    Attributes:
        source: the file, as it was named.
        line: where the table begins, from 1.
        format: the reader that found it.
        name: what the source calls it; empty where it does not.
        A: the blocks A^{l,m}, None where colour l does not see colour m. One block of one colour.
            Colours that share their stages have one row of blocks.
        b: the weights of each colour.
        c: the nodes of each row of blocks, None where the source has none.
        embedded: the weights of the embedded method, a row per colour.
        turned: these weights if their differences from ``b`` have the other sign; None where the
            source fixes the sign.
        dense: ``dense[l][i]`` are the coefficients of θ, θ², … of b_i(θ) of colour l.
        order: the order that the source declares.
        said_order: the order that words beside the table say; None where an order is declared.
        embedded_order: the order of the embedded weights that the source declares.
        flags: properties that the source declares, by their names in method files.
        parts: ``("q", "p")`` of a partitioned method; empty otherwise.
        structure: which vector fields the problem has, as in method files; empty for all.
        linear: the colours with a linear vector field, from 0.
        tolerance: the rounding that the source admits; empty where it says none.
        is_sure: whether the source says that this is a method; otherwise names alone do.
        notes: what people should know of how it was read.
        trouble: what is wrong with the table itself; then it has no coefficients to judge.
        is_source: whether it stands for a source that was not read.
        is_misshapen: whether the trouble is that it has too many or too few numbers.
        kind: of another method, such as Rosenbrock; empty for Runge–Kutta.
        gamma: of a Rosenbrock method γ, whose α is the one block of A; of one as programs store it
            C, whose b is m.
        diagonal: the γ_ii of a method as programs store it.
        error: m − m̂ of such a method; None without embedded weights.
        d: the weights of ∂f/∂t; None where the row sums of γ say it.
        coupling: of a multirate infinitesimal method, whose fast problems are solved exactly; None
            of others.
        is_slow: whether it is the slow method of such a method, whose forcing is constant.
        form: of a method of another form, what its file has under the keys of the coefficients;
            None of others.
        form_stages: how many stages it has.
        base: the name of the table that it is made of, where another source has that.
        is_assembled: whether it was put together from single numbers, by their names.
        units: by how much coefficients may be off that were made of printed ones.
        how: its arrays are stored, in words, where that is read off the numbers.
        idle: arrays beside it with names of nodes or weights, and no role in it.
        linked: bits of what links its matrix and its weights, in the reading of its numbers for
            which most speaks; 0 where there is none.
        is_recognised: whether its numbers alone say that it is a table.
        rivals: other readings of the same numbers, which may explain what is wrong with this one.
        around: the names of the scopes that it is in.
    """

    source: str
    line: int
    format: str
    name: str
    A: Grid
    b: Rows
    c: tuple[Row | None, ...] = (None,)
    embedded: Rows | None = None
    turned: Rows | None = None
    dense: tuple[Rows, ...] | None = None
    order: int | None = None
    said_order: int | None = None
    embedded_order: int | None = None
    flags: Mapping[str, bool] = field(default_factory=dict)
    parts: tuple[str, ...] = ()
    structure: str = ""
    linear: tuple[int, ...] = ()
    tolerance: str = ""
    is_sure: bool = True
    notes: tuple[str, ...] = ()
    trouble: str = ""
    is_misshapen: bool = False
    is_source: bool = False
    kind: str = ""
    gamma: Rows | None = None
    diagonal: Row | None = None
    error: Row | None = None
    d: Row | None = None
    coupling: FoundCoupling | None = None
    is_slow: bool = False
    form: Mapping[str, Any] | None = None
    form_stages: int = 0
    base: str = ""
    is_assembled: bool = False
    units: Units = ()
    how: str = ""
    idle: tuple[str, ...] = ()
    linked: float = 0.0
    is_recognised: bool = False
    rivals: tuple[FoundTable, ...] = ()
    around: str = ""

    @property
    def colours(self) -> int:
        """N, the number of colours."""
        return len(self.b)

    @property
    def stages(self) -> int:
        """The stages of all colours, those that are shared once; the slow ones of a coupling."""
        if self.form is not None:
            return self.form_stages
        if self.coupling is not None:
            return len(self.coupling.c) - 1
        if len(self.A) == 1:
            return len(self.b[0]) if self.b else 0
        return sum(len(row) for row in self.b)

    @property
    def is_multirate(self) -> bool:
        """Whether it is a multirate infinitesimal method."""
        return self.coupling is not None or self.is_slow

    @property
    def is_read(self) -> bool:
        """Whether it has coefficients."""
        return bool(self.b) or self.is_multirate or self.form is not None

    @property
    def is_unlike(self) -> bool:
        """Whether names alone speak for a table, and its shapes against it."""
        return bool(self.trouble) and not self.is_sure

    def __repr__(self) -> str:
        name = self.name or f"line {self.line}"
        return f"<FoundTable {name} of {self.source}>"


Find: TypeAlias = Callable[[str, str], list[FoundTable]]
"""From the text of a source and its name to the tables in it."""


class Reader(Frozen):
    """A format that is read.

    Attributes:
        name: what the format is called.
        summary: what it is, in a few words.
        suffixes: of the files that have it.
        find: the tables in a text; it executes nothing, and raises nothing but ``TooLarge``.
        grammars: the modules of tree-sitter that it parses with.
    """

    name: str
    summary: str
    suffixes: tuple[str, ...]
    find: Find
    grammars: tuple[str, ...] = ()


def unread(source: str, format: str, why: str) -> FoundTable:
    """A place holder for a source that was not read, with the reason."""
    trouble = f"was not read: {why}"
    return FoundTable(source, 1, format, "the source", (), (), (), trouble=trouble, is_source=True)


def troubled(table: FoundTable, trouble: str, is_misshapen: bool = False) -> FoundTable:
    """A place where a table is meant to be, and why it is none."""
    place = FoundTable(table.source, table.line, table.format, table.name, (), (), ())
    orders = {"order": table.order, "embedded_order": table.embedded_order}
    return replace(place, **orders, trouble=trouble, is_misshapen=is_misshapen)
