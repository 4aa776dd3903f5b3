"""A table in a source: coefficients as text, and the declarations around them."""

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
"""Bounds on the errors of numbers by their texts."""
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
    """A place in a source has no value that a reader knows."""


class Misshapen(Unreadable):
    """Explicit numbers that are too many or too few for a method."""


class TooLarge(GarkError):
    """A source is too large, or becomes too large by expanding its names.

    Attributes:
        line: where the limit was reached, from 1.
    """

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.line = line


class FoundCoupling(Frozen):
    """The coupling of the slow stages of a multirate infinitesimal method, as in method files.

    Attributes:
        c: the nodes of the slow stages, from 0 to the end of the step.
        parts: by ``omega``, the explicit part, and ``gamma``, the implicit one, a matrix for each
            power of τ; row i leads to the stage after stage i.
        embedded: the rows to the embedded value by the same names; empty without them.
        restart: the kind of forcing if fast problems begin with the step; empty for others.
    """

    c: Row
    parts: Mapping[str, tuple[Rows, ...]]
    embedded: Mapping[str, Rows]
    restart: str


class FoundTable(Frozen):
    """The coefficients of one method in a source.

    Attributes:
        source: the path of the file as given.
        line: the first line of the table, from 1.
        format: the reader that found it.
        name: in the source; empty if it has none.
        A: the blocks A^{l,m}, None if colour l does not depend on colour m. One block of one
            colour. Colours that share their stages have one row of blocks.
        b: the weights of each colour.
        c: the nodes of each row of blocks, None if the source has none.
        embedded: the embedded weights of each colour.
        turned: the embedded weights if their differences from ``b`` have the other sign; None if
            the source fixes the sign.
        dense: ``dense[l][i]`` are the coefficients of θ, θ², … of b_i(θ) of colour l.
        order: the order declared in the source.
        said_order: the order in comments and docstrings; None if an order is declared.
        embedded_order: the order of the embedded weights declared in the source.
        flags: properties declared in the source, by their names in method files.
        parts: ``("q", "p")`` of a partitioned method; empty otherwise.
        structure: of the vector fields, as in method files; empty for general ones.
        linear: the colours with a linear vector field, from 0.
        tolerance: the rounding given in the source; empty if it gives none.
        is_sure: whether the source says that this is a method; otherwise only names are evidence.
        notes: remarks for users on its reading.
        trouble: the reason why the table cannot be judged; then it has no coefficients.
        is_source: whether it stands for a source that was not read.
        is_misshapen: whether the trouble is that it has too many or too few numbers.
        kind: of a method that is not read, such as Rosenbrock; empty for Runge–Kutta.
        gamma: γ of a Rosenbrock method, with α as the one block of A; C in stored form, with m as
            b.
        diagonal: the γ_ii of a method in stored form.
        error: m − m̂ of such a method; None without embedded weights.
        d: the weights of ∂f/∂t; None if they are the row sums of γ.
        coupling: of a multirate infinitesimal method with exact fast problems; None for others.
        is_slow: whether it is the slow method of such a method with constant forcing.
        form: for a method of another form the keys of its file with the coefficients; None for
            others.
        form_stages: its number of stages.
        base: the name of the table that it is made of, in another source.
        is_assembled: whether it was assembled from single numbers by their names.
        borrows: whether names in it have values that other sources of the tree give them.
        units: error bounds of coefficients computed from printed ones.
        how: the storage of its arrays in words, if recognised from the numbers.
        idle: arrays beside it with names of nodes or weights, but without a role.
        linked: bits of evidence that link its matrix and its weights, in the best reading of its
            numbers; 0 without a reading.
        is_recognised: whether only its numbers are evidence for a table.
        rivals: other readings of the same numbers, which may explain errors of this one.
        around: the names of the scopes around it.
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
    borrows: bool = False
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
        """The number of stages of all colours, with shared stages counted once; of the slow stages
        for a coupling.
        """
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
        """Whether only names are evidence for a table, and its shapes are against it."""
        return bool(self.trouble) and not self.is_sure

    def __repr__(self) -> str:
        name = self.name or f"line {self.line}"
        return f"<FoundTable {name} of {self.source}>"


Find: TypeAlias = Callable[[str, str], list[FoundTable]]
"""From the text of a source and its name to the tables in it."""


class Reader(Frozen):
    """A format that is read.

    Attributes:
        name: the word for the format.
        summary: the format in a few words.
        suffixes: the endings of its files.
        find: finds the tables in a text; it executes nothing, and raises only ``TooLarge``.
        grammars: the modules of tree-sitter for its parser.
    """

    name: str
    summary: str
    suffixes: tuple[str, ...]
    find: Find
    grammars: tuple[str, ...] = ()


def unread(source: str, format: str, why: str) -> FoundTable:
    """A placeholder for a source that was not read, with the reason."""
    trouble = f"was not read: {why}"
    return FoundTable(source, 1, format, "the source", (), (), (), trouble=trouble, is_source=True)


def troubled(table: FoundTable, trouble: str, is_misshapen: bool = False) -> FoundTable:
    """A placeholder for a table that cannot be read, with the reason."""
    place = FoundTable(table.source, table.line, table.format, table.name, (), (), ())
    orders = {"order": table.order, "embedded_order": table.embedded_order}
    return replace(place, **orders, trouble=trouble, is_misshapen=is_misshapen)
