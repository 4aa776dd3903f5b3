"""The entry that does not fit the digits of the others: where one alone keeps a method from an
order, the others being off by no more than their rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpq

from garkcli.deadline import check_time
from garkcli.exact.affine import Affine
from garkcli.frozen import replace
from garkcli.order.blame import Repair
from garkcli.order.recovering import FLOOR, Place, Recovery, nearest
from garkcli.order.rounded import RoundedTableau
from garkcli.order.rows import of_tree

if TYPE_CHECKING:
    from garkcli.exact.affine import Floats
    from garkcli.exact.field import Number
    from garkcli.tableau.tableau import Tableau

MOST_NUMBERS = 300
"""Printed numbers of methods for which one is sought."""
MOST_SUSPECTS = 5
"""Candidates of first order, of which no more are tried."""


def suspects(rounded: RoundedTableau, order: int) -> tuple[Repair, ...]:
    """The entries of which one alone, with another value, would leave a method of an order to the
    others within their rounding; those that change least first.

    Args:
        rounded: the method; its numbers are coefficients.
        order: that it would have.
    """
    search = rounded.search
    if len(search.box.numbers) > MOST_NUMBERS:
        return ()
    found = []
    for k, shift in sorted(_candidates(search, order), key=lambda x: abs(x[1]))[:MOST_SUSPECTS]:
        check_time()
        value = _value(search, order, k, shift)
        place = _entry(search.origin, rounded.tableau, k)
        if value is not None and place is not None:
            found.append(Repair(*place, search.box.numbers[k], value))
    return tuple(found)


def _candidates(search: Recovery, order: int) -> Iterator[tuple[int, float]]:
    """Numbers without which first order lets all conditions be met, with the shifts they need."""
    missed = [u for q in range(1, order + 1) for u in search.origin.missed("method", q)]
    system = search.independent({"method": {of_tree(u): [0] for u in missed}}, search.origin)
    if not system:
        return
    rows = search.origin.rows(system)
    for k in range(rows.slopes.shape[1]):
        check_time()
        own = rows.slopes[:, k]
        others = np.delete(rows.slopes, k, axis=1)
        scale = np.maximum(np.abs(others).sum(axis=1), 1e-12 * search.radius)
        c, own, others = rows.middle / scale, own / scale, others / scale[:, None]
        size = float(own @ own)
        if size < FLOOR:
            continue
        x = nearest(_without(others, own), _without(c, own), FLOOR)
        if x is not None:
            yield k, -float(own @ (c + others @ x)) / size


def _without(rows: Floats, direction: Floats) -> Floats:
    """The rows, or one column, less what lies in a direction of their space."""
    rest: Floats = rows - np.multiply.outer(direction, direction @ rows) / (direction @ direction)
    return rest


def _value(search: Recovery, order: int, k: int, shift: float) -> Number | None:
    """What number k is in a method of the order where it may be off by more; None where there is
    none.
    """
    radii = list(search.box.radii)
    unit = radii[k]
    radii[k] = unit * (int(1.5 * abs(shift)) + 2)
    wide = Recovery(replace(search.box, radii=tuple(radii)), search.printed_further)
    if wide.order_of("method", order)[0] < order:
        return None
    number = search.box.numbers[k]
    step = fmpq(1)
    while step > 2 * unit:
        step /= 10
    shift_in_steps = radii[k] * wide.place.shifts[k] / step
    return number + step * (shift_in_steps + fmpq(1, 2)).floor()


def _entry(
    origin: Place, printed: Tableau, k: int
) -> tuple[int, int | None, int | None, int] | None:
    """The first entry of the tableau that is made of number k alone."""
    made = origin.defects("method").tableau.made

    def is_it(x: object) -> bool:
        return isinstance(x, Affine) and set(x.slopes) == {k}

    for l, m in printed.edges():
        block = made.block(l, m)
        assert block is not None
        for i, row in enumerate(block):
            for j, x in enumerate(row):
                if is_it(x):
                    return l, m, i, j
    for l, colour in enumerate(made.colours):
        for j, x in enumerate(colour.b):
            if is_it(x):
                return l, None, None, j
    return None
