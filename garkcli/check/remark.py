"""A remark on rounding: how many digits numbers have, which order they would have, and which entry
is off.

Each number is taken to be off by what its own last digits leave open. Where a method within that
has a higher order than the word of the file gives, exact or within its tolerance, the remark says
which tolerance to write; where there is none, and one entry alone is in the way, which entry.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen
from garkcli.methodfile.printed import SLACK, at_full_length, left_open
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, derived, meant, within_digits
from garkcli.order.repair import Repair
from garkcli.order.rounded import RoundedTableau
from garkcli.order.suspects import suspects
from garkcli.order.tolerance import unnatural, within
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.exact.field import Number

COARSEST = -1
"""No tolerance is proposed that is not below ten to this power."""


class Remark(Frozen):
    """A remark on the digits of a file: the tolerance that it lacks, or the entry that is off.

    Attributes:
        order: that the method would have.
        of: what would have it: ``order``, or ``embedded-order``.
        exponent: the tolerance to write is 10 to this power; None where an entry is off.
        repairs: single entries of which one is off, each with the value that it would have; those
            that change least first.
    """

    order: int
    of: str = "order"
    exponent: int | None = None
    repairs: tuple[Repair, ...] = ()

    @property
    def line(self) -> str:
        """The line to write into the method file; empty where an entry is off."""
        return "" if self.exponent is None else f"tolerance: 1e{self.exponent}"


def remark_on(
    tableau: Tableau,
    found: AnyOrder,
    tolerance: fmpq | None,
    of: str = "order",
    limit: int = DEFAULT_LIMIT,
) -> Remark | None:
    """The remark on the digits of a method; None where they say no more than the file.

    Args:
        tableau: the method, as it was read.
        found: its order, or that of its embedded weights, by the word of the file.
        tolerance: of the file; None where its numbers are exact.
        of: which order that is: ``order``, or ``embedded-order``.
        limit: where the search for orders stops.
    """
    if not _is_rounding(found):
        return None
    full, own = within_digits(tableau, at_full_length), within_digits(tableau, left_open)
    if full is None or own is None:
        return None
    units = dict(zip(own.search.box.numbers, own.search.box.radii, strict=True))
    order, best = found.order, None
    judgements = [_judged(full, of, found, limit)]
    if _is_rounding(judgements[0][1]) and own.search.box.radii != full.search.box.radii:
        judgements.append(_judged(own, of, found, limit))
    goal = max(within_rounding.order for _, within_rounding in judgements)
    for judged, within_rounding in judgements:
        reached = within_rounding.order
        if reached > order:
            order, best = reached, judged
        if not _is_rounding(within_rounding):
            break
        off = _off(judged, max(goal, reached + 1), limit, units)
        if off:
            return Remark(max(off.values()), of, None, _most(off))
    if best is None:
        return None
    exponent = enough(best.off, order, lambda t: derived(meant(tableau, t), of), tolerance or ZERO)
    return None if exponent is None else Remark(order, of, exponent)


def _is_rounding(found: AnyOrder) -> bool:
    """Whether a condition is missed by so little that rounding, or a wrong digit, may be why."""
    missed = found.witness
    return missed is not None and within(missed.residual, unnatural(found.order + 1))


def _judged(
    rounded: RoundedTableau, of: str, found: AnyOrder, limit: int
) -> tuple[RoundedTableau, AnyOrder]:
    """The method within its digits, and its order: the known one where they do not explain
    that it is no higher.
    """
    judged = derived(rounded, of)
    assert isinstance(judged, RoundedTableau)
    assert found.witness is not None
    is_explained = judged.explains(found.witness.tree)
    return judged, order_of(judged, limit) if is_explained else found


def _off(
    judged: RoundedTableau, order: int, limit: int, units: Mapping[Number, fmpq]
) -> dict[Repair, int]:
    """The entries of which one is in the way; one that is short beside the others does not
    where its own digits explain it.
    """
    reached = suspects(judged, order, limit)
    return {
        x: n
        for x, n in reached.items()
        if not within(x.new - x.old, units.get(x.old, ZERO) / SLACK)
    }


def _most(reached: Mapping[Repair, int]) -> tuple[Repair, ...]:
    """The repairs that give the highest order."""
    return tuple(x for x, n in reached.items() if n == max(reached.values()))


def enough(
    off: fmpq, order: int, within: Callable[[fmpq], AnyTableau], tolerance: fmpq = ZERO
) -> int | None:
    """The exponent of the smallest power of ten, beyond a tolerance, within which a method of an
    order is found; None where that is too coarse.

    Args:
        off: by how much numbers of a method of the order are off at most.
        order: of it.
        within: the method as printed, with a tolerance for all its numbers.
        tolerance: that is too tight.
    """
    exponent = 0
    # the method that was found is the nearest; the one that was meant may be further off
    while fmpq(10) ** (exponent - 1) >= max(2 * off, tolerance + off):
        exponent -= 1
    while exponent < COARSEST:
        if order_of(within(fmpq(10) ** exponent), order).order >= order:
            return exponent
        exponent += 1
    return None
