"""Whether coefficients look rounded: which ``tolerance`` to propose for a file that states none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO, Number
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.blame import blame_of
from garkcli.order.certificate import DEFAULT_LIMIT, Order
from garkcli.order.conditions import coupling_graph
from garkcli.order.listing import count_conditions
from garkcli.order.propagation import Propagation, printed_rounding
from garkcli.order.repairs import Missed, Repair
from garkcli.order.residuals import Sizes, TreeResiduals
from garkcli.order.rounded import FEW_TREES, RoundedOrder, find_order_within
from garkcli.order.tolerance import rounded_up, unnatural, within
from garkcli.tableau.enclosing import enclose_tableau
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import Admissible, counts_upto

SLACK = 10
"""Units of the last place by which a coefficient may be off that was computed in them."""
FEW_CONDITIONS = 2_000
"""Most conditions that are looked at for the entry that is misprinted."""
JUMP = 1000
"""The first residual that is genuine is so many times larger than all those of rounding."""


@dataclass(frozen=True)
class Suggestion:
    """Within ``tolerance`` the order is ``order``, and it is more than the exact one.

    Attributes:
        order: the order that the residuals speak for.
        exponent: the tolerance to propose is 10 to this power.
        rounding: the largest |residual| up to ``order``.
        genuine: the largest |residual| found at the next order.
        worst: the order at which ``rounding`` is reached; 0 where that is not known.
    """

    order: int
    exponent: int
    rounding: arb = field(compare=False)
    genuine: arb = field(compare=False)
    worst: int = 0

    @property
    def tolerance(self) -> fmpq:
        """The power of ten to propose."""
        return fmpq(10) ** self.exponent

    @property
    def line(self) -> str:
        """The line to add to the method file."""
        return f"tolerance: 1e{self.exponent}"


@dataclass(frozen=True)
class Misprint:
    """Residuals that look like rounding, but are larger than the digits of the file explain.

    Attributes:
        order: the order that the method would have.
        residual: the largest |residual| up to there.
        explained: how large rounding of the last digits makes residuals at most.
        repairs: single entries whose change restores the order: one of them is misprinted.
    """

    order: int
    residual: arb = field(compare=False)
    explained: arb = field(compare=False)
    repairs: tuple[Repair, ...]


def find_misprint(
    tableau: Tableau, exact: Order, found: Suggestion, units: Mapping[Number, fmpq]
) -> Misprint | None:
    """Whether the residuals that a tolerance would cover are larger than rounding makes them.

    A coefficient is rounded by one unit of its last place at most, ten where it was computed; what
    that does to residuals is bounded, ``printed_rounding``. A long fraction may be off by one in
    its numerator, so there one entry that makes all conditions hold exactly is a misprint, too.

    Args:
        tableau: the method.
        exact: its exact order.
        found: the tolerance that its residuals suggest.
        units: by how much each printed value may be off.

    Returns:
        None where rounding explains them.
    """
    made = printed_rounding(tableau, units)
    explained = arb(0)
    for order in range(1, found.order + 1):
        explained = explained.max(made.effect(order))
    near = rounded_up(SLACK * explained)
    is_explained = found.rounding <= near
    if is_explained:
        near = ZERO
    # where residuals are largest they depend on the entry most: earlier ones may be its squares
    looked_at = found.worst if near else exact.order + 1
    missed = Missed(looked_at, found.order, tolerance=near, near=near)
    repairs = _few_repairs(tableau, missed)
    largest = max(units.values(), default=ZERO)
    visible: list[Repair] = []
    for repair in repairs:
        unit = largest if is_explained else units.get(repair.old, ZERO)
        change = repair.new - repair.old
        if not within(change, SLACK * unit):
            visible.append(repair)
    if is_explained and not visible:
        return None
    return Misprint(found.order, found.rounding, explained, tuple(visible))


def _few_repairs(tableau: Tableau, missed: Missed) -> tuple[Repair, ...]:
    """The entries that restore an order; none where there are too many conditions to look at."""
    if count_conditions(tableau, missed.order) > FEW_CONDITIONS:
        return ()
    blame = blame_of(tableau, missed)
    return () if blame is None else blame.repairs


def suggest_tolerance(
    tableau: Tableau, exact: Order, limit: int = DEFAULT_LIMIT
) -> Suggestion | None:
    """A tolerance with which a tableau has a higher order than ``exact``, where its coefficients
    look rounded.

    An exact method has small residuals too when its order is high: 10⁻⁷ at order 9 of a good
    explicit method, 10⁻¹² at order 21 of Gauss 10. So residuals are taken for rounding only if,
    from the first order that fails exactly,

    - coefficients are spelled out: the blocks of a family have none that could be rounded;
    - the largest residual of each order n is below 10⁻⁶ and unnaturally small: a thousand times
    smaller than the
      error of x^(n−1) in the best quadrature of about n/2 nodes, (s!)⁴/((2s+1)((2s)!)²) with s =
      ⌊n/2⌋;
    - the largest residual of the first order that is not so small exceeds them a thousand times.

    Rounding is alike at all orders up to that of the method and then jumps; genuine residuals of
    successive orders are of similar size, and no published method known comes near either
    threshold: the passing residuals of the 94 of the catalogue reach 2·10⁻¹⁰ at order 3, and the
    first failing ones start from 2.7·10⁻⁷ at order 13.

    Args:
        tableau: as given in a file without ``tolerance``.
        exact: its exact order.
        limit: the order at which to stop.

    Returns:
        None where nothing speaks for rounding, or where it takes too many trees to tell.
    """
    spelled_out = any(isinstance(space, PointSpace) for space in tableau.spaces)
    if exact.witness is None or not spelled_out:
        return None
    first = abs(to_ball(exact.witness.residual))
    if not first <= unnatural(exact.order + 1):
        return None
    rounding, worst = first, exact.order + 1
    failing = exact.order + 1
    orders = range(failing, limit + 1)
    for order, sizes in _sizes(tableau, first, orders):
        if sizes.bound <= unnatural(order):
            if sizes.bound > rounding:
                rounding, worst = sizes.bound, order
        elif order > failing and sizes.reached >= JUMP * rounding:
            exponent = _exponent(rounding)
            return Suggestion(order - 1, exponent, rounding, sizes.reached, worst)
        else:
            return None
    return None


def suggest_wider(
    tableau: Tableau, found: RoundedOrder, limit: int = DEFAULT_LIMIT
) -> Suggestion | None:
    """A tolerance that would do where that of the file is too tight for its own rounding.

    Entries that are off by t make residuals of several t. Where the residual that misses t is no
    larger than that, ``Propagation``, the power of ten that lets it pass is proposed, if residuals
    jump afterwards.

    Args:
        tableau: the method.
        found: its order within the tolerance of the file.
        limit: the order at which to stop.

    Returns:
        None where the order fails by more than rounding explains.
    """
    if found.witness is None:
        return None
    order = found.order + 1
    reached = abs(to_ball(found.witness.residual))
    if not reached <= unnatural(order):
        return None
    explained = Propagation(tableau, {}, found.tolerance).effect(order)
    if not reached <= explained + found.tolerance:
        return None
    first = _exponent(reached)
    for exponent in range(first, first + 3):
        wider = find_order_within(tableau, fmpq(10) ** exponent, limit)
        if wider.witness is None or wider.order < order:
            return None
        genuine = abs(to_ball(wider.witness.residual))
        if genuine >= JUMP * wider.largest_residual:
            return Suggestion(wider.order, exponent, wider.largest_residual, genuine)
    return None


def _sizes(tableau: Tableau, first: arb, orders: range) -> Iterator[tuple[int, Sizes]]:
    """The sizes of one order after the other, where the trees are many by spans."""
    # six bits for each power of e by which residuals are small
    smallness = -int(first.log().floor().unique_fmpz() or 0)
    bits = 192 + 6 * max(0, smallness)
    enclosure = enclose_tableau(tableau, bits)
    with ctx.workprec(bits):
        spans = ApproximateSpans(tableau, enclosure, JUMP * first)
    trees = TreeResiduals(tableau, enclosure)
    admissible = Admissible.of(tableau.size, *coupling_graph(tableau))
    for order in orders:
        few = sum(counts_upto(admissible, order)[-1]) <= FEW_TREES
        yield order, (trees if few else spans).sizes(order)


def _exponent(rounding: arb) -> int:
    """Of the smallest power of ten that is twice as large as what is taken for rounding, at
    least.
    """
    exponent = 0
    while fmpq(10) ** (exponent - 1) >= 2 * rounding:
        exponent -= 1
    return exponent
