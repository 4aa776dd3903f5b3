"""The order of a method as its digits show it: exactly, or within what their rounding explains."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flint import arb, fmpq

from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.printed import approximant_units
from garkcli.order.certificate import DEFAULT_LIMIT, Order, Witness, find_order
from garkcli.order.propagation import Propagation, printed_rounding
from garkcli.order.rounded import RoundedOrder, find_order_within
from garkcli.order.suggestion import SLACK
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True, eq=False)
class Judged:
    """What was found of an order.

    Attributes:
        order: as far as conditions hold, exactly or within the rounding.
        is_open: whether the next order is left open: rounding may be why it fails.
        witness: a tree whose condition fails; None where none is known.
        tolerance: within which conditions are met; None where they hold exactly.
        largest: a bound on the residuals up to the order.
        is_limited: whether the search stopped at its limit.
    """

    order: int
    is_open: bool = False
    witness: Witness | None = None
    tolerance: fmpq | None = None
    largest: arb | None = None
    is_limited: bool = False

    @property
    def claim(self) -> str:
        """The order as a method file claims it."""
        return f'">= {self.order}"' if self.is_limited else str(self.order)

    @property
    def file_tolerance(self) -> fmpq | None:
        """The power of ten that a method file has to admit; None where the order is exact."""
        if self.largest is None:
            return None
        exponent = 0
        while fmpq(10) ** (exponent - 1) >= 2 * self.largest and exponent > -900:
            exponent -= 1
        return fmpq(10) ** exponent


def judged(
    method: MethodFile,
    tableau: Tableau,
    declared: int | None = None,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
) -> Judged:
    """The order of a tableau that is made of the numbers of a file.

    Decimals of many digits are taken for rounded: each may be off by ten units of its last place,
    and residuals are met that this explains. No residual that a good exact method might have is
    explained away; then the next order is left open.

    Args:
        method: the file, for how its numbers are written.
        tableau: the method, or the same with embedded weights.
        declared: the order that its source declares; the search goes one further at least.
        limit: where the search stops.
        tolerance: the rounding that the source admits; None where it says none.
    """
    reach = max(limit, (declared or 0) + 1)
    exact = find_order(tableau, reach)
    if exact.is_lower_bound:
        return Judged(exact.order, is_limited=True)
    if tolerance:
        return _within(find_order_within(tableau, tolerance, reach), exact)
    units = _coarsest(approximant_units(method.printed))
    largest = max(units.values(), default=fmpq(0))
    if not largest:
        return _exactly(exact)
    effects = _Effects(printed_rounding(tableau, units))
    found = find_order_within(tableau, largest, reach, effects.effect)
    if found.order == exact.order and found.doubt is None:
        return _exactly(exact)
    return _within(found, exact)


def _coarsest(units: Mapping[Number, fmpq]) -> dict[Number, fmpq]:
    """The last places of rounded decimals, all as coarse as the coarsest.

    A product of two decimals of 15 digits has 30, and is no better than they are.
    """
    largest = max(units.values(), default=fmpq(0))
    return {x: largest if unit else unit for x, unit in units.items()}


class _Effects:
    """What ten units of the last places do to residuals, each order once."""

    def __init__(self, rounding: Propagation) -> None:
        self._rounding = rounding
        self._known: dict[int, arb] = {}

    def effect(self, order: int) -> arb:
        """A bound on it."""
        if order not in self._known:
            self._known[order] = SLACK * self._rounding.effect(order)
        return self._known[order]


def _exactly(exact: Order) -> Judged:
    return Judged(exact.order, witness=exact.witness)


def _within(found: RoundedOrder, exact: Order) -> Judged:
    is_open = found.witness is None
    if found.order == exact.order:
        return Judged(found.order, is_open, exact.witness)
    return Judged(found.order, is_open, found.witness, found.tolerance, found.largest_residual)


def allowed(method: MethodFile) -> fmpq:
    """How far a number of a file may be off: ten units of the last place of its decimals."""
    units = approximant_units(method.printed)
    return SLACK * max(units.values(), default=fmpq(0))
