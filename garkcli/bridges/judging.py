"""The order of a method as its digits show it: exactly, or within what their rounding explains."""

from __future__ import annotations

from functools import cached_property

from flint import fmpq

from garkcli.check.remark import enough
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.printed import SLACK, Printed, Units, approximant_units, careless_units
from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans, Witness, find_order
from garkcli.order.rounded import RoundedOrder, RoundedTableau, find_order_within
from garkcli.order.tolerance import unnatural
from garkcli.tableau.tableau import Tableau


class Judged(Frozen, eq=False):
    """What was found of an order.

    Attributes:
        order: as far as conditions hold, exactly or within the rounding.
        is_open: whether the next order is undecided: rounding may be why it fails.
        witness: a tree whose condition fails; None where none is known.
        rounded: the tableau, and by how much the numbers of a method with the order are off; None
            where the conditions hold exactly.
        is_limited: whether the search stopped at its limit.
    """

    order: int
    is_open: bool = False
    witness: Witness | None = None
    rounded: tuple[Tableau, fmpq] | None = None
    is_limited: bool = False

    @cached_property
    def tolerance(self) -> fmpq | None:
        """The power of ten that a method file has to admit for this order; None where the
        conditions hold exactly.
        """
        if self.rounded is None:
            return None
        tableau, off = self.rounded
        exponent = enough(off, self.order, lambda t: RoundedTableau.within(tableau, t))
        return None if exponent is None else fmpq(10) ** exponent

    @property
    def claim(self) -> str:
        """The order as a method file claims it."""
        return at_least(self.order) if self.is_limited else str(self.order)


def at_least(order: int) -> str:
    """An order and all higher ones, as a method file claims them."""
    return f'">= {order}"'


class Digits(Frozen):
    """How exactly the coefficients of a source are written.

    Attributes:
        printed: the coefficients as they are written.
        units: by how much those may be off that were made of printed ones.
    """

    printed: Printed
    units: Units

    def of(self, tableau: Tableau, slack: int = SLACK) -> RoundedTableau:
        """A tableau with what the digits leave open: ten units of the last place of each decimal,
        or ``slack`` of them.
        """
        units = approximant_units(self.printed, self.units)
        wide = {value: slack * unit for value, unit in units.items()}
        return RoundedTableau.printed(tableau, wide)

    def careless(self, tableau: Tableau) -> RoundedTableau:
        """A tableau with what careless rounding may have left."""
        return RoundedTableau.printed(tableau, careless_units(self.printed, self.units))


def judged(
    digits: Digits,
    tableau: Tableau,
    declared: int | None = None,
    limit: int | None = None,
    tolerance: fmpq | None = None,
    spans: StageSpans | None = None,
) -> Judged:
    """The order of a tableau that is made of the numbers of a file.

    Decimals of many digits count as rounded: each may be off by ten units of its last place,
    and conditions are met that this explains. A residual that a good exact method might have is
    not explained away: there the order is undecided.

    Args:
        digits: how exactly its numbers are written.
        tableau: the method, or the same with embedded weights.
        declared: the order that its source declares; the search goes one further at least.
        limit: where the search stops; None for one order beyond the declared one at least.
        tolerance: the rounding that the source admits; None where it says none.
        spans: of the stage vectors, where some are known.
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
    found = find_order_within(rounded, reach, exact)
    if found.order == reach and found.sizes[-1] <= unnatural(reach):
        return replace(_judged(found, exact), is_open=False, is_limited=True)
    order = exact.order
    while order < found.order and found.sizes[order] <= unnatural(order + 1):
        order += 1
    if order < found.order:
        # rounding explains the next residuals, and so might a good method
        met = replace(found, order=order, witness=None)
        return replace(_judged(met, exact), witness=exact.witness)
    return _judged(found, exact)


def _judged(found: RoundedOrder, exact: Order) -> Judged:
    is_open = found.witness is None
    if found.order == exact.order:
        return Judged(found.order, is_open, found.witness or exact.witness)
    assert found.rounded is not None
    return Judged(found.order, is_open, found.witness, (found.rounded.tableau, found.rounded.off))
