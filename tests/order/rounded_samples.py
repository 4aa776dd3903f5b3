"""Tableaus with rounded coefficients: the catalogue, and constructions of the paper spelled out in
decimals.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from random import Random
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.exact.enclosing import enclose
from garkcli.exact.expression import parse
from garkcli.frozen import replace
from garkcli.tableau.forms import spelled_out
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.catalogue.catalogue import entries, tableau
from tests.oracles import samples

ENTRIES = entries()
ROUNDED = [name for name, entry in ENTRIES.items() if not entry["exact"]]
EXACT = [name for name, entry in ENTRIES.items() if entry["exact"]]


def nearest(number: arb, digits: int) -> fmpq:
    """A number cut off after so many decimal places."""
    places = fmpq(10) ** digits
    return fmpq((number * arb(places)).mid().floor().unique_fmpz()) / places  # type: ignore[arg-type]


def published(name: str) -> Tableau:
    """A method of the catalogue, its radicals rounded to 80 digits."""
    return tableau({**ENTRIES[name], "blocks": _without_radicals(ENTRIES[name]["blocks"])})


def _without_radicals(blocks: Any) -> Any:
    if isinstance(blocks, dict):
        return {key: _without_radicals(x) for key, x in blocks.items()}
    if isinstance(blocks, list):
        return [_without_radicals(x) for x in blocks]
    if not re.search("sqrt|cbrt|root", blocks):
        return blocks
    with ctx.workprec(400):
        return str(nearest(enclose(parse(blocks)), 80))


def in_decimals(exact: Tableau, digits: int) -> Tableau:
    """All entries of a tableau, stage by stage, cut off after so many decimal places."""
    found = numeric_entries(exact, digits + 10)

    def rounded(rows: Sequence[Sequence[Any]]) -> tuple[tuple[fmpq, ...], ...]:
        with ctx.workprec(4 * digits + 64):
            return tuple(tuple(nearest(x, digits) for x in row) for row in rows)

    A = [[None if block is None else rounded(block) for block in row] for row in found.A]
    return spelled_out(A, rounded(found.b), rounded(found.c))


def gauss_lobatto(stages: int, digits: int) -> Tableau:
    """Gauss and Lobatto IIIA with one stage more, coupled by collocation, in decimals: order 2 ·
    ``stages``.
    """
    names = f"gauss {stages}", f"lobatto-iiia {stages + 1}"
    return in_decimals(samples.everywhere(collocation, *names), digits)


def rounded(tableau: Tableau, dice: Random, size: fmpq) -> Tableau:
    """Every coefficient that is not 0 moved by a random amount up to ``size``."""

    def moved(row: tuple[fmpq, ...]) -> tuple[fmpq, ...]:
        return tuple(x + size * fmpq(dice.randint(-100, 100), 100) if x else x for x in row)

    blocks = {key: tuple(moved(row) for row in block) for key, block in tableau.blocks.items()}  # type: ignore[arg-type]
    colours = tuple(replace(x, b=moved(x.b)) for x in tableau.colours)  # type: ignore[arg-type]
    return Tableau(tableau.spaces, colours, blocks)
