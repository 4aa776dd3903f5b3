"""Bits of the numbers of a method that its identities explain.

An identity is worth the bits to which it holds, or the length of the longest number in it that no
other has taken, whichever is less. Nodes are row sums, weights have the sum 1, and order conditions
hold; what links no weights to a matrix says nothing of both.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from garkcli.frozen import Frozen
from garkcli.ntrees.table import TreeTable
from garkcli.recognise.given import LENGTH, UNIT, VALUE

if TYPE_CHECKING:
    from garkcli.arrays import Floats

HIGHEST = 8
"""Conditions of higher orders are not tried."""
NEARLY = 22.0
"""An identity that holds to so many bits is meant."""
COPY = 3.0
"""Most bits of a row with one entry: a copy is no equation."""
FEW = 4.0
"""Most bits of an order where there is one weight."""
SHORT, LONG = 24.0, 45.0
"""Bits of numbers: where half of them are long, short ones are not rounded."""
MOST = 50.0
ROUNDING = 5e-14
COARSEST = 1e-2
"""If digits explain more than this, every condition would hold."""


@lru_cache(maxsize=1)
def _trees() -> TreeTable:
    return TreeTable.upto(1, HIGHEST)


def conditions(A: Floats, b: Floats) -> Iterator[tuple[Floats, Floats]]:
    """The residuals of the order conditions, an order at a time, and the sizes of their terms.

    Args:
        A: shape (s, s).
        b: shape (s,).
    """
    table = _trees()
    both, weights = np.stack([A, np.abs(A)]).transpose(0, 2, 1), (b, np.abs(b))
    rows = np.ones((2, len(table), len(b)))
    for order in range(1, HIGHEST + 1):
        ids = table.ids(order, 0)
        here = slice(ids.start, ids.stop)
        if order > 1:
            rows[:, here] = rows[:, table.stem[here]] * (rows[:, table.branch[here]] @ both)
        wanted = 1 / table.gamma[here]
        yield rows[0, here] @ weights[0] - wanted, rows[1, here] @ weights[1] + wanted


def unit_of(*arrays: Floats | None) -> float:
    """The coarsest unit of some numbers; short ones among many long ones are exact."""
    given = [x.reshape(-1, x.shape[-1]) for x in arrays if x is not None and x.size]
    if not given:
        return 0.0
    numbers = np.concatenate(given)
    lengths = numbers[:, LENGTH]
    if 2 * (lengths >= LONG).sum() >= (lengths > 0).sum():
        numbers = numbers[(lengths == 0) | (lengths >= SHORT)]
    return float(numbers[:, UNIT].max(initial=0.0))


def agreement(residual: float, size: float, tolerance: float) -> float:
    """To how many bits a residual is zero, beside the size of what cancels."""
    size = max(size, 1e-3)
    return min(MOST, -float(np.log2(max(abs(residual), tolerance / 30, size * 2e-16) / size)))


def order_of(A: Floats, b: Floats, unit: float, highest: int = HIGHEST) -> int:
    """The order of plain matrices and weights within their units."""
    for order, (residuals, sizes) in enumerate(conditions(A, b), start=1):
        wide = (30 * unit * len(b) ** 0.5 + ROUNDING) * (1 + order / 2)
        if order > highest or (np.abs(residuals) > wide * np.maximum(1, sizes)).any():
            return order - 1
    return HIGHEST


def sums_of_rows(A: Floats) -> tuple[Floats, Floats, Floats]:
    """The sums of rows, of sizes, and of units in them."""
    values = A[..., VALUE]
    return values.sum(1), np.abs(values).sum(1), A[..., UNIT].sum(1)


def row_sums(
    A: Floats, c: Floats, power: int = 1, sums: tuple[Floats, Floats, Floats] | None = None
) -> tuple[Floats, Floats, Floats]:
    """Returns the residuals of the row sums against c, or c²/2, the sizes of their terms, and
    what their digits explain; ``sums`` are those of A if they are known.
    """
    nodes = c[:, VALUE]
    total, sizes, units = sums_of_rows(A) if sums is None else sums
    off = total - (nodes if power == 1 else nodes**2 / 2)
    sizes = sizes + np.abs(nodes)
    return off, sizes, 12 * (units + c[:, UNIT]) + 1e-14 * sizes


class Evidence(Frozen, eq=False):
    """The evidence for a matrix, weights and nodes.

    Attributes:
        bits: all of it.
        order: as far as conditions hold within the digits.
        nearly: as far as they hold to ``NEARLY`` bits.
        row_bits: of the row sums.
        rows: how many of them say something.
        several: how many rows with several entries are among those that hold.
        wrong_rows: those whose sum is another than their node.
        near_rows: those whose sum is nearly their node.
        linked: bits of the conditions of order 2 and higher.
    """

    bits: float
    order: int
    nearly: int
    row_bits: float
    rows: int
    several: int
    wrong_rows: tuple[int, ...]
    near_rows: tuple[int, ...]
    linked: float

    @property
    def is_plain(self) -> bool:
        """Whether every identity that is tried holds."""
        return not (self.wrong_rows or self.near_rows) and self.order == self.nearly


def _taken(*lengths: Floats) -> float:
    """The greatest length in some arrays, which no other identity has then."""
    longest = max(lengths, key=lambda x: float(x.max()) if x.size else -1.0)
    if not longest.size:
        return 0.0
    place = np.unravel_index(int(longest.argmax()), longest.shape)
    found = float(longest[place])
    longest[place] = 0
    return found


def evidence(A: Floats, b: Floats, c: Floats | None) -> Evidence:
    """The evidence for a method with numbers of the shapes (s, s, 4), (s, 4) and (s, 4)."""
    of_A, of_b = A[..., LENGTH].copy(), b[:, LENGTH].copy()
    of_c = np.zeros(0) if c is None else c[:, LENGTH].copy()
    is_alone = np.count_nonzero(b[:, VALUE]) < 2
    row_bits, rows, several = 0.0, 0, 0
    wrong: list[int] = []
    nearly_right: list[int] = []
    nodes = b if c is None else c
    off, sizes, explained = row_sums(A, nodes)
    for i in range(len(b)) if c is not None else ():
        if not sizes[i]:
            continue
        agreed = agreement(off[i], sizes[i], explained[i])
        is_met = abs(off[i]) <= explained[i]
        if not is_met and agreed < NEARLY:
            wrong.append(i)
            continue
        is_copy = np.count_nonzero(A[i, :, VALUE]) == 1
        bits = min(agreed, _taken(of_A[i], of_c[i : i + 1]))
        bits = min(bits, COPY) if is_copy else bits
        row_bits, rows, several = row_bits + bits, rows + (bits >= 1), several + (not is_copy)
        nearly_right += [] if is_met else [i]
    unit = unit_of(A, b)
    order = nearly = 0
    linked = total = 0.0
    is_met = True
    for q, (residuals, scales) in enumerate(conditions(A[..., VALUE], b[:, VALUE]), start=1):
        wide = (30 * unit * len(b) ** 0.5 + ROUNDING) * (1 + q / 2)
        gained = 0.0
        for residual, scale in zip(residuals.tolist(), scales.tolist(), strict=True):
            tolerance = wide * max(1.0, scale)
            agreed = agreement(residual, scale, tolerance)
            if tolerance > COARSEST:
                is_met = False
                break
            if not abs(residual) <= tolerance:
                is_met = False
                # without nodes nothing else ties these numbers to a method
                if agreed < NEARLY or unit > 1e-7 or c is None:
                    break
            gained += min(agreed, _taken(*((of_b,) if q == 1 else (of_b, of_c, of_A))))
        else:
            gained = min(gained, FEW) if is_alone else gained
            total, linked = (gained, linked) if q == 1 else (total, linked + gained)
            nearly, order = q, q if is_met else order
            continue
        break
    # weights with the sum 1 say nothing of a matrix beside them, as far as nothing links them
    total = min(total, linked) if linked else min(total, 3.0, row_bits)
    bits = row_bits + linked + total
    wrong_rows, near_rows = tuple(wrong), tuple(nearly_right)
    return Evidence(bits, order, nearly, row_bits, rows, several, wrong_rows, near_rows, linked)
