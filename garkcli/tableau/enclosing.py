"""A tableau entry by entry in balls: what residuals are computed with when coefficients are
rounded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias, cast

from flint import arb, arb_mat, ctx

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.tableau import Edge, Tableau

MAX_DIGITS = 300
"""Digits to which entries of polynomial stage spaces are enclosed at most; the exponents of floats
end at 308.
"""
GUARD = 32
"""Bits that entries are enclosed more finely than the arithmetic that uses them."""


DIGITS_OF_A_BIT = 0.302
"""Decimal digits of a bit, log10(2) rounded up."""
_Blocks: TypeAlias = dict[Edge, arb_mat]
_Enclosed: TypeAlias = tuple[_Blocks, list[arb_mat]]
"""A and b, see ``Enclosure``."""


@dataclass(frozen=True)
class Enclosure:
    """Balls around the entries of a tableau, one coordinate a stage whatever the stage spaces are.

    Attributes:
        bits: the precision of the arithmetic meant for them.
        stages: s of each stage space.
        A: the block of each pair (space, colour) as in ``Tableau.blocks``, shape (s_space,
            s_colour).
        b: the weights of each colour as a column, shape (s_colour, 1).
    """

    bits: int
    stages: tuple[int, ...]
    A: Mapping[Edge, arb_mat]
    b: tuple[arb_mat, ...]


def enclose_tableau(tableau: Tableau, bits: int) -> Enclosure:
    """The entries to ``bits`` bits.

    Where all coefficients are spelled out any number of bits is reached; the nodes of families are
    known to ``MAX_DIGITS`` digits at most.
    """
    digits = int((bits + GUARD) * DIGITS_OF_A_BIT)
    is_spelled_out = all(isinstance(space, PointSpace) for space in tableau.spaces)
    with ctx.workprec(bits + GUARD):
        if is_spelled_out:
            A, b = _spelled_out(tableau, digits)
        else:
            A, b = _at_nodes(tableau, min(digits, MAX_DIGITS))
    return Enclosure(bits, tuple(space.stages for space in tableau.spaces), A, tuple(b))


def enclose_nodes(tableau: Tableau, bits: int) -> list[list[arb]]:
    """The nodes to ``bits`` bits, a row a colour; those of families as ``enclose_tableau`` has
    them.
    """
    digits = int((bits + GUARD) * DIGITS_OF_A_BIT)
    with ctx.workprec(bits + GUARD):
        if all(isinstance(space, PointSpace) for space in tableau.spaces):
            return [_balls([colour.c], digits).entries() for colour in tableau.colours]
        entries = numeric_entries(tableau, min(digits, MAX_DIGITS))
        return [[cast("arb", x) for x in row] for row in entries.c]


def _spelled_out(tableau: Tableau, digits: int) -> _Enclosed:
    """A and b of coefficients that are given one by one."""
    A: _Blocks = {key: _balls(block, digits) for key, block in tableau.blocks.items()}
    return A, [_balls([colour.b], digits).transpose() for colour in tableau.colours]


def _at_nodes(tableau: Tableau, digits: int) -> _Enclosed:
    """A and b where stages of families are among them: coordinates become values at nodes."""
    entries = numeric_entries(tableau, digits)
    # Colours that share a stage space have the same rows, so any of them will do.
    colour_of: dict[int, int] = {colour.space: l for l, colour in enumerate(tableau.colours)}
    A: _Blocks = {}
    for k, m in tableau.blocks:
        row = entries.A[colour_of[k]]
        block = row[m] or ()
        A[k, m] = _matrix(block)
    return A, [_matrix([row]).transpose() for row in entries.b]


def _matrix(rows: Sequence[Sequence[Cell]]) -> arb_mat:
    balls = [[cast("arb", x) for x in row] for row in rows]
    return arb_mat(balls)


def _balls(rows: Sequence[Sequence[Number]], digits: int) -> arb_mat:
    known: dict[Number, arb] = {}
    enclosed: list[list[arb]] = []
    for row in rows:
        for x in row:
            if x not in known:
                known[x] = to_ball(x, digits)
        enclosed.append([known[x] for x in row])
    return arb_mat(enclosed)
