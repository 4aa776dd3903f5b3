"""The entries of a tableau in balls, for residuals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any, TypeAlias, cast

from flint import arb, arb_mat, ctx, fmpq

from garkcli.exact.display import DIGITS_OF_A_BIT, to_balls
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen, replace
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

Row: TypeAlias = list[arb]
Rows: TypeAlias = list[Row]
MAX_DIGITS = 300
"""The exponents of floats end at 308."""
GUARD_OF_ENTRIES = 32


class Enclosure(Frozen):
    """Balls around the entries of a tableau on point stages, for arithmetic with ``bits``.

    ``A`` is by the keys of ``Tableau.blocks``, shape (s_space, s_colour); ``b`` has columns, shape
    (s_colour, 1).
    """

    bits: int
    stages: tuple[int, ...]
    A: Mapping[Edge, arb_mat]
    b: tuple[arb_mat, ...]


def enclose_tableau(tableau: Tableau, bits: int) -> Enclosure:
    """Returns the entries to ``bits`` bits, nodes of families to at most ``MAX_DIGITS`` digits."""
    digits = int((bits + GUARD_OF_ENTRIES) * DIGITS_OF_A_BIT)
    with ctx.workprec(bits + GUARD_OF_ENTRIES):
        if all(isinstance(space, PointSpace) for space in tableau.spaces):
            A = {key: _balls(block, digits) for key, block in tableau.blocks.items()}
            b = [_balls([colour.b], digits).transpose() for colour in tableau.colours]
        else:
            A, b = _at_nodes(tableau, min(digits, MAX_DIGITS))
    return Enclosure(bits, tuple(space.stages for space in tableau.spaces), A, tuple(b))


def _at_nodes(tableau: Tableau, digits: int) -> tuple[dict[Edge, arb_mat], list[arb_mat]]:
    """A and b of tableaus with families: coordinates become values at nodes."""
    entries = numeric_entries(tableau, digits)
    # Colours that share a stage space have the same rows, so any of them will do.
    colour_of: dict[int, int] = {colour.space: l for l, colour in enumerate(tableau.colours)}
    A: dict[Edge, arb_mat] = {}
    for k, m in tableau.blocks:
        row = entries.A[colour_of[k]]
        A[k, m] = _matrix(row[m] or ())
    return A, [_matrix([row]).transpose() for row in entries.b]


def _matrix(rows: Sequence[Sequence[Cell]]) -> arb_mat:
    return arb_mat([[cast("arb", x) for x in row] for row in rows])


def _balls(rows: Sequence[Sequence[Number]], digits: int) -> arb_mat:
    return arb_mat(len(rows), len(rows[0]), to_balls(chain.from_iterable(rows), digits))


def in_balls(tableau: Tableau, grain: fmpq, bits: int) -> Tableau:
    """Returns the tableau on point stages with balls of radius ``grain`` around nonzero numbers."""
    radius = arb(0, arb(grain).abs_upper())

    digits = int(bits * DIGITS_OF_A_BIT)

    def wide(row: Any) -> Any:
        return tuple(x + radius if x else x for x in to_balls(row, digits))

    with ctx.workprec(bits):
        blocks = {key: tuple(map(wide, block)) for key, block in tableau.blocks.items()}
        colours = tuple(replace(x, b=wide(x.b), c=wide(x.c)) for x in tableau.colours)
    spaces = tuple(PointSpace((ZERO,) * space.stages) for space in tableau.spaces)
    return Tableau(spaces, colours, blocks)
