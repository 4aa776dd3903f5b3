"""Entries of tableaus as short text, and the rows of printed tableaus."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from flint import arb

from garkcli.exact.display import shortest
from garkcli.tableau.pointwise import Cell, Entries, Row
from garkcli.tableau.tableau import Tableau


def cell_text(cell: Cell, digits: int) -> str:
    if not isinstance(cell, arb):
        return shortest(cell)
    if cell.contains(0):
        return "0"
    return without_zeros(cell.str(digits, radius=False))


def without_zeros(decimal: str) -> str:
    """Returns a decimal without trailing zeros.

    >>> without_zeros("0.50000"), without_zeros("1.0000"), without_zeros("2.500e-7")
    ('0.5', '1', '2.5e-7')
    """
    mantissa, e, exponent = decimal.partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + e + exponent


def remark(entries: Entries) -> str:
    """Returns why entries are decimals; empty if all are exact."""
    decimals = f"decimals, {entries.digits} digits"
    if not entries.have_radicals:
        return f"the nodes have no simple radicals: {decimals}"
    if not entries.is_exact:
        return decimals
    rows = [*entries.c, *entries.b, *(entries.embedded or ())]
    rows += chain(*(entries.dense or ()))
    for block in chain(*entries.A):
        rows += block or []
    if any(isinstance(x, arb) for x in chain(*rows)):
        return f"rounded coefficients: long fractions as {decimals}"
    return ""


def distinct_rows(tableau: Tableau) -> list[int]:
    """Returns one colour for each stage space."""
    seen: dict[int, int] = {}
    for l, colour in enumerate(tableau.colours):
        seen.setdefault(colour.space, l)
    return list(seen.values())


def parts_of(tableau: Tableau) -> Iterator[tuple[str, Sequence[int], Sequence[int]]]:
    """Yields the tables of a tableau: a letter or none, the colours of rows and of columns."""
    shown = distinct_rows(tableau)
    if not tableau.is_partitioned:
        yield "", shown, range(tableau.size)
        return
    for letter, part in (("Q", "q"), ("P", "p")):
        driven = [m for m, colour in enumerate(tableau.colours) if colour.part == part]
        seeing = [l for l in shown if any(tableau.block(l, m) is not None for m in driven)]
        yield letter, seeing, driven


class TableauLine(NamedTuple):
    """A row of a printed tableau, ``place`` from 0; None for weights and for missing blocks."""

    place: int
    colour: int | None
    node: Cell | None
    groups: list[Row | None]

    @property
    def is_first(self) -> bool:
        return self.place == 0


def lines_of(
    entries: Entries, stages: Sequence[int], colours: Sequence[int]
) -> Iterator[TableauLine]:
    for l in stages:
        blocks = [entries.A[l][m] for m in colours]
        for i, node in enumerate(entries.c[l]):
            yield TableauLine(i, l, node, [None if x is None else x[i] for x in blocks])
    for k, weights in enumerate(filter(None, (entries.b, entries.embedded))):
        yield TableauLine(k, None, None, [weights[m] for m in colours])
