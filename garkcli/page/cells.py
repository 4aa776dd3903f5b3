"""Entries of tableaus as short text, and which rows of a tableau are shown."""

from __future__ import annotations

from itertools import chain

from flint import arb

from garkcli.exact.display import to_text
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau


def cell_text(cell: Cell, digits: int) -> str:
    """An entry as text: exact, or rounded to ``digits`` significant digits."""
    if not isinstance(cell, arb):
        return to_text(cell)
    if cell.contains(0):
        return "0"
    return without_zeros(cell.str(digits, radius=False))


def without_zeros(decimal: str) -> str:
    """A decimal without zeros at its end.

    >>> without_zeros("0.50000"), without_zeros("1.0000"), without_zeros("2.500e-7")
    ('0.5', '1', '2.5e-7')
    """
    mantissa, e, exponent = decimal.partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + e + exponent


def remark(entries: Entries) -> str:
    """That entries are decimals, and why; empty where none is."""
    decimals = f"decimals, {entries.digits} digits"
    if not entries.have_radicals:
        return f"the nodes have no simple radicals: {decimals}"
    if not entries.is_exact:
        return decimals
    rows = [*entries.c, *entries.b, *(entries.embedded or ())]
    rows += chain(*(entries.dense or ()))
    for block in chain(*entries.A):
        rows += block or []
    cells = chain(*rows)
    if any(isinstance(x, arb) for x in cells):
        return f"rounded coefficients: long fractions as {decimals}"
    return ""


def distinct_rows(tableau: Tableau) -> list[int]:
    """One colour for each stage space: colours that share stages share rows."""
    seen: dict[int, int] = {}
    for l, colour in enumerate(tableau.colours):
        seen.setdefault(colour.space, l)
    return list(seen.values())
