"""Tableaus of ``gark tableau``, ``conjugate``, ``convert`` and ``reduce``, declared once.

Numbers are exact strings, with floats of the same shape beside them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from flint import arb

from garkcli.exact.display import to_float, to_text
from garkcli.exact.parametric import Parametric
from garkcli.page.cells import cell_text, remark
from garkcli.page.schema import DERIVATION, NUMBER, NUMERAL, Schema, array, nullable
from garkcli.page.tableau_text import readable
from garkcli.report.check import COLOURS, colours_of
from garkcli.tableau import pointwise
from garkcli.tableau.garkmethod import Derivation, GarkMethod
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau
from garkcli.tell.facts import Kind, Level, Row, Section, optional, via
from garkcli.tell.kinds import TEXT, TRUTH, constant
from garkcli.tell.parts import drawing, part, parts, sentence
from garkcli.tell.report import Report

DATA = Level.DATA


class Shown(NamedTuple):
    """A tableau with the entries that are shown of it.

    Attributes:
        is_rounded: whether people read long fractions as decimals.
    """

    tableau: Tableau
    entries: Entries
    name: str
    derivation: Derivation = ""
    is_rounded: bool = False

    @property
    def readable(self) -> Entries:
        """The entries for people."""
        return readable(self.entries) if self.is_rounded else self.entries


def of_method(method: GarkMethod, digits: int | None = None) -> Shown:
    """A method, its entries in decimals of so many digits where these are named."""
    entries = method.entries
    if digits is not None:
        entries = pointwise.entries(method.tableau, digits).beside(method.further)
        entries = entries.in_decimals(digits)
    is_rounded = method.tolerance is not None
    return Shown(method.tableau, entries, method.name, method.derivation, is_rounded)


def _float(cell: Cell | Parametric) -> float | None:
    if isinstance(cell, Parametric):
        return None
    return float(cell) if isinstance(cell, arb) else to_float(cell)


def _numeral(entries: Entries, cell: Cell) -> str:
    return cell_text(cell, entries.digits) if isinstance(cell, arb) else to_text(cell)


def _entries(entry: Schema, change: Callable[[Entries, Cell], object]) -> list[Row]:
    """c, A, b and further weights with their entries changed into what ``entry`` describes."""

    def rows(entries: Entries, found: Sequence[Sequence[Cell]] | None) -> Any:
        return found and [[change(entries, x) for x in row] for row in found]

    def several(entries: Entries, found: Sequence[Any] | None) -> Any:
        return found and [rows(entries, x) for x in found]

    matrix = array(array(entry))
    return [
        Row("c", Kind(matrix), lambda x: rows(x, x.c), DATA),
        Row(
            "A", Kind(array(array(nullable(matrix)))), lambda x: [several(x, y) for y in x.A], DATA
        ),
        Row("b", Kind(matrix), lambda x: rows(x, x.b), DATA),
        optional("embedded", Kind(matrix), lambda x: rows(x, x.embedded), DATA),
        optional("dense", Kind(array(matrix)), lambda x: several(x, x.dense), DATA),
    ]


FLOATS = Section(*_entries(NUMBER, lambda _, x: _float(x)))
TABLEAU = Section(
    Row("name", TEXT, level=DATA),
    Row("derivation", Kind(DERIVATION), level=DATA),
    Row("exact", TRUTH, "entries.is_exact", DATA),
    sentence(lambda x: remark(x.readable)),
    Row("colours", parts(COLOURS), lambda x: colours_of(x.tableau), DATA),
    *via(lambda x: x.entries, _entries(NUMERAL, _numeral)),
    Row("float", part(FLOATS), "entries", DATA),
    Row("tableau", drawing(lambda x, d: d.tableau(x.tableau, x.readable)), "."),
    title=lambda x, d: d.prose(x.name),
)
SCHEMA = "gark/tableau/1"
REPORT: Report[Shown] = Report.only(
    SCHEMA,
    "tableau of gark tableau, conjugate, convert and reduce",
    TABLEAU,
    lambda _: {"is_inserted": True},
)
DOCUMENT = Section(Row("schema", constant(SCHEMA), lambda _: SCHEMA), *TABLEAU.rows)
"""The same within another document."""
