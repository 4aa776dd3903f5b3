"""The order of a method within its digits: exact, or up to what rounding explains."""

from __future__ import annotations

from functools import cached_property

from flint import fmpq

from garkcli.check.remark import enough
from garkcli.frozen import Frozen, field, replace
from garkcli.methodfile.printed import SLACK, Printed, Units, approximant_units, careless_units
from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans, Witness, find_order
from garkcli.order.rounded import RoundedOrder, RoundedTableau, find_order_within
from garkcli.order.tolerance import small, unnatural
from garkcli.tableau.tableau import Tableau


class Judged(Frozen, eq=False):
    """The order of a method within its digits.

    Attributes:
        is_open: whether the next order is undecided, since rounding may explain the violation.
        rounded: the tableau, and the largest distance of its numbers from a method with the order;
            None if the conditions hold exactly.
        is_limited: whether the search stopped at its limit.
    """

    order: int
    is_open: bool = False
    witness: Witness | None = None
    rounded: tuple[Tableau, fmpq] | None = None
    is_limited: bool = False

    @cached_property
    def tolerance(self) -> fmpq | None:
        """The tolerance, a power of ten, for a file with this order; None if it holds exactly."""
        if self.rounded is None:
            return None
        tableau, off = self.rounded
        exponent = enough(2 * off, self.order, lambda t: RoundedTableau.within(tableau, t))
        return None if exponent is None else fmpq(10) ** exponent

    @property
    def claim(self) -> str:
        return at_least(self.order) if self.is_limited else str(self.order)


def at_least(order: int) -> str:
    return f'">= {order}"'


class Digits(Frozen):
    """``units`` of the last place are for numbers computed from printed ones, ``short`` ones for
    decimals of four or five places, if no coefficient has more.
    """

    printed: Printed
    units: Units
    short: Units = field(default_factory=dict)

    def of(self, tableau: Tableau, slack: int = SLACK) -> RoundedTableau:
        """The tableau with ``slack`` units of the last place per decimal, one per short decimal."""
        units = approximant_units(self.printed, self.units)
        wide = {value: slack * unit for value, unit in units.items()}
        return RoundedTableau.printed(tableau, wide | dict(self.short))

    def careless(self, tableau: Tableau) -> RoundedTableau:
        units = careless_units(self.printed, self.units)
        return RoundedTableau.printed(tableau, units | dict(self.short))


def judged(
    digits: Digits,
    tableau: Tableau,
    declared: int | None = None,
    limit: int | None = None,
    tolerance: fmpq | None = None,
    spans: StageSpans | None = None,
) -> Judged:
    """The order of a tableau with numbers of a source, sought to one beyond the declared one.

    Decimals with many digits count as rounded, each by at most ten units in its last place, and
    conditions hold if this explains their residuals. A residual that a good exact method might have
    is not explained so: then the order is undecided. Short decimals count so if the first residual
    is small, as for the hint of a method file.
    """
    reach = limit or max(DEFAULT_LIMIT, (declared or 0) + 1)
    exact = find_order(tableau, reach, spans)
    if exact.is_lower_bound:
        return Judged(exact.order, is_limited=True)
    if tolerance:
        within = RoundedTableau.within(tableau, tolerance)
        return _judged(find_order_within(within, reach, exact), exact)
    rounded = digits.of(tableau)
    if not rounded.tolerance:
        return Judged(exact.order, witness=exact.witness)
    within_rounding = find_order_within(rounded, reach, exact)
    if within_rounding.order == reach and within_rounding.sizes[-1] <= unnatural(reach):
        return replace(_judged(within_rounding, exact), is_open=False, is_limited=True)
    order = exact.order
    if order < within_rounding.order and digits.short:
        is_explained = within_rounding.sizes[order] <= small(order + 1)
        order = within_rounding.order if is_explained else order
    while order < within_rounding.order and within_rounding.sizes[order] <= unnatural(order + 1):
        order += 1
    if order < within_rounding.order:
        # rounding explains the next residuals, but a good exact method might have them too
        up_to_order = replace(within_rounding, order=order, witness=None)
        return replace(_judged(up_to_order, exact), witness=exact.witness)
    return _judged(within_rounding, exact)


def _judged(found: RoundedOrder, exact: Order) -> Judged:
    is_open = found.witness is None
    if found.order == exact.order:
        return Judged(found.order, is_open, found.witness or exact.witness)
    assert found.rounded is not None
    return Judged(found.order, is_open, found.witness, (found.rounded.tableau, found.rounded.off))
