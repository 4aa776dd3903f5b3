"""A remark on rounding: the precision of the numbers, the order within it, and the wrong entry.

The error of each number is taken from its last digits. If a method within these errors has a higher
order than the file gives, the remark states the tolerance to write, or else the one wrong entry.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.methodfile.printed import SLACK, as_typed, at_full_length, left_open
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, derived, meant, within_digits
from garkcli.order.repair import Repair
from garkcli.order.rounded import RoundedTableau
from garkcli.order.suspects import suspects
from garkcli.order.tolerance import small, unnatural, within
from garkcli.tableau.tableau import Tableau

COARSEST = -1
"""Only tolerances smaller than ten to this power are proposed."""


class RoundingHint(Frozen):
    """A hint of a missing tolerance, 10 to ``exponent``, or of a wrong entry by its ``repairs``."""

    order: int
    of: str = "order"
    exponent: int | None = None
    repairs: tuple[Repair, ...] = ()

    @property
    def line(self) -> str:
        """The line to write into the method file; empty if an entry is wrong."""
        return "" if self.exponent is None else f"tolerance: 1e{self.exponent}"


def remark_on(
    tableau: Tableau,
    actual: AnyOrder,
    tolerance: fmpq | None,
    of: str = "order",
    limit: int = DEFAULT_LIMIT,
) -> RoundingHint | None:
    """Returns the remark on the digits of a method, b or embedded weights as ``of`` says."""
    if not _is_within(actual, small):
        return None
    full, own = within_digits(tableau, at_full_length), within_digits(tableau, as_typed)
    if full is None or own is None:
        return None
    by_length = within_digits(tableau, left_open)
    is_short = by_length is None or by_length.search.box.radii != own.search.box.radii
    bound = small if is_short else unnatural
    if not _is_within(actual, bound):
        return None
    units = dict(zip(own.search.box.numbers, own.search.box.radii, strict=True))
    order, best = actual.order, None
    judgements = [_judged(full, of, actual, limit)]
    if _is_within(judgements[0][1], bound) and own.search.box.radii != full.search.box.radii:
        judgements.append(_judged(own, of, actual, limit))
    goal = max(within_rounding.order for _, within_rounding in judgements)
    for judged, within_rounding in judgements:
        reached = within_rounding.order
        if reached > order:
            order, best = reached, judged
        if not _is_within(within_rounding, bound):
            break
        off = _off(judged, max(goal, reached + 1), limit, units)
        if off:
            return RoundingHint(max(off.values()), of, None, _most(off))
    if best is None:
        return None
    unit = max(own.search.box.radii) / (1 if is_short else SLACK)
    # the method that was found is the nearest; the one that was meant may be further off, but not
    # by more than a unit of the last place
    likely = min(2 * best.off, max(best.off, unit))
    least = max(likely, (tolerance or fmpq(0)) + best.off)
    exponent = enough(least, order, lambda t: derived(meant(tableau, t), of))
    return None if exponent is None else RoundingHint(order, of, exponent)


def _is_within(order: AnyOrder, bound: Callable[[int], fmpq]) -> bool:
    """Returns whether the residual of the missed order is within the bound for it."""
    missed = order.witness
    return missed is not None and within(missed.residual, bound(order.order + 1))


def _judged(
    rounded: RoundedTableau, of: str, order: AnyOrder, limit: int
) -> tuple[RoundedTableau, AnyOrder]:
    """Returns the method within its digits and its order, ``order`` if these do not explain it."""
    judged = derived(rounded, of)
    assert isinstance(judged, RoundedTableau)
    assert order.witness is not None
    is_explained = judged.explains(order.witness.tree)
    return judged, order_of(judged, limit) if is_explained else order


def _off(
    judged: RoundedTableau, order: int, limit: int, units: Mapping[Number, fmpq]
) -> dict[Repair, int]:
    """Returns entries that may be wrong, beyond their digits, with the order after repair."""
    reached = suspects(judged, order, limit)
    return {
        x: n
        for x, n in reached.items()
        if not within(x.new - x.old, units.get(x.old, ZERO) / SLACK)
    }


def _most(reached: Mapping[Repair, int]) -> tuple[Repair, ...]:
    return tuple(x for x, n in reached.items() if n == max(reached.values()))


def enough(least: fmpq, order: int, within: Callable[[fmpq], AnyTableau]) -> int | None:
    """Returns the exponent of the least power of ten within which the order is reached, or None."""
    exponent = 0
    while fmpq(10) ** (exponent - 1) >= least:
        exponent -= 1
    while exponent < COARSEST:
        if order_of(within(fmpq(10) ** exponent), order).order >= order:
            return exponent
        exponent += 1
    return None
