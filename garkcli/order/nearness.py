"""The distance of a rounded method from its print, and a printed number that alone is far off.

The shifts x, in units of the radii, are the least ones that meet rows with slopes J: they are in
the span of the rows, on which P projects. If one of them costs nothing, |x|² falls by x_k²/P_kk,
number k is x_k/P_kk off, and the others are left with x − (x_k/P_kk) P e_k. A number is a suspect
if it alone leaves next to nothing to all others: rounding moves them all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.affine import Affine
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.order.bounded import orthonormal
from garkcli.order.existence import is_proved_to_exist

if TYPE_CHECKING:
    from garkcli.exact.affine import Floats
    from garkcli.order.recovering import Recovery

FEWEST_ROWS = 5
"""Fewest independent rows; with fewer many numbers are suspects by chance."""
FAR = 0.5
"""Least shift of a suspect: rounding to a last place moves a number by half a unit of it."""
NEXT_TO_NOTHING = 0.1
"""Largest shift of the other numbers, as a part of the suspect's."""


class EntryAddress(Frozen):
    """An entry of a method; indices are from 0.

    ``letter`` is a, b, c, ``embedded`` or ``dense``; ``l`` and ``m`` are the colours of a block,
    ``i`` and ``j`` row and column. In vectors ``m`` is None, and ``i``
    the power of θ minus one for dense output, else None.
    """

    letter: str
    l: int
    m: int | None
    i: int | None
    j: int


class Nearness(Frozen):
    """The distance of the print from the method that it is taken to mean.

    Attributes:
        distance: the largest shift of a printed number, in units of its radius; to two digits.
        entry: an entry with this number; None if no number is off.
        suspect: an entry whose printed number alone is far off; None if there is none.
        is_full: whether the conditions are met fully, not to second order only.
        is_proved: whether a method of the order is proved to exist; False says nothing.
    """

    distance: fmpq
    entry: EntryAddress | None
    suspect: EntryAddress | None
    is_full: bool
    is_proved: bool


def nearness(search: Recovery, order: int) -> Nearness:
    place = search.settled
    shifts = np.array([to_float(x) for x in place.shifts])
    sizes = [_two_digits(x) for x in np.abs(shifts)]
    distance = max(sizes, default=fmpq(0))
    entry = suspect = None
    if distance:
        entry = _entry_of(search, sizes.index(distance))
        k = _suspect(search, shifts)
        suspect = None if k is None else _entry_of(search, k)
    is_full = not place.slack
    is_proved = is_full and order > 0 and is_proved_to_exist(search, order)
    return Nearness(distance, entry, suspect, is_full, is_proved)


def _two_digits(x: float) -> fmpq:
    """A size in hundredths, after millionths: floats end in noise."""
    millionths = fmpq(round(x * 10**6), 10**6)
    unit = fmpq(1, 100)
    return unit * (millionths / unit + fmpq(1, 2)).floor()


def _suspect(search: Recovery, shifts: Floats) -> int | None:
    if not any(search.wanted.values()):
        return None
    return far_alone(orthonormal(search.place.rows(search.wanted).slopes), shifts)


def far_alone(basis: Floats, shifts: Floats) -> int | None:
    """Returns the number that alone is far off, or None; ``basis`` is one of the slopes."""
    if len(basis) < FEWEST_ROWS:
        return None
    projector = basis.T @ basis
    shifts = projector @ shifts  # the least, without ends
    share = np.diag(projector)
    far = np.flatnonzero(share > 1e-6)
    left = np.full(len(shifts), np.inf)
    for k in far:
        rest = shifts - shifts[k] / share[k] * projector[k]
        rest[k] = 0.0
        left[k] = np.abs(rest).max()
    best = int(np.argmin(left))
    off = abs(shifts[best] / share[best])
    others = np.delete(left, best)
    is_alone = not (others < 2 * NEXT_TO_NOTHING * off).any()
    return best if off > FAR and left[best] < NEXT_TO_NOTHING * off and is_alone else None


def _entry_of(search: Recovery, k: int) -> EntryAddress:
    """The first entry that is a printed number itself, or else one that depends on it."""
    with ctx.workprec(search.bits):
        made = search.box.around(search.origin.shifts).made
    size = made.size // (1 + len(search.printed_further.rows))
    found: list[tuple[int, EntryAddress]] = []

    def look(entry: EntryAddress, x: Any) -> None:
        if isinstance(x, Affine) and x.slopes.get(k):
            found.append((len(x.slopes), entry))

    for (space, m), block in made.blocks.items():
        l = next(l for l, colour in enumerate(made.colours) if colour.space == space)
        for i, row in enumerate(block):
            for j, x in enumerate(row):
                look(EntryAddress("a", l, m, i, j), x)
    for number, colour in enumerate(made.colours):
        which, l = divmod(number, size)
        for j, x in enumerate(colour.b):
            look(_weight(search, which, l, j), x)
    for l, colour in enumerate(made.colours[:size]):
        for j, x in enumerate(colour.c):
            look(EntryAddress("c", l, None, None, j), x)
    return min(found, key=lambda x: x[0])[1]


def _weight(search: Recovery, row: int, l: int, j: int) -> EntryAddress:
    if not row:
        return EntryAddress("b", l, None, None, j)
    if search.printed_further.embedded is not None:
        if row == 1:
            return EntryAddress("embedded", l, None, None, j)
        row -= 1
    return EntryAddress("dense", l, None, row - 1, j)
