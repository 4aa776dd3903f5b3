"""Whether coefficients look rounded: which ``tolerance`` to propose for a file that states none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import FrozenBut
from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.order.approximate_spans import ApproximateSpans, HullSizes
from garkcli.order.blame import Missed, Repair, blame_of
from garkcli.order.certificate import DEFAULT_LIMIT, Order, Witness, find_order
from garkcli.order.conditions import count_conditions, coupling_graph
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.rounded import FEW_TREES, RoundedOrder, RoundedTableau
from garkcli.order.suspects import suspects
from garkcli.order.tolerance import rounded_up, unnatural, within
from garkcli.order.tree_residuals import Sizes, TreeResiduals
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

SLACK = 10
"""Units of the last place by which a coefficient may be off that was computed in them."""
FEW_CONDITIONS = 2_000
"""Most conditions that are examined for the entry that is misprinted."""
JUMP = 1000
"""The first residual that is genuine is so many times larger than all those of rounding."""


class Suggestion(FrozenBut):
    """Within ``tolerance`` the order is ``order``, and it is more than the exact one.

    Attributes:
        order: the order that the residuals speak for.
        exponent: the tolerance to propose is 10 to this power.
        rounding: the largest |residual| up to ``order``.
        genuine: the largest |residual| found at the next order.
        worst: the order at which ``rounding`` is reached; 0 where that is not known.
    """

    besides = frozenset({"rounding", "genuine"})

    order: int
    exponent: int
    rounding: arb
    genuine: arb
    worst: int = 0

    @property
    def tolerance(self) -> fmpq:
        """The power of ten to propose."""
        return fmpq(10) ** self.exponent

    @property
    def line(self) -> str:
        """The line to add to the method file."""
        return f"tolerance: 1e{self.exponent}"


class Misprint(FrozenBut):
    """Residuals that look like rounding, but are larger than the digits of the file explain.

    Attributes:
        order: the order that the method would have.
        residual: a |residual| up to there.
        explained: how large rounding of the last digits makes it at most.
        repairs: single entries whose change restores the order: one of them is misprinted.
    """

    besides = frozenset({"residual", "explained"})

    order: int
    residual: arb
    explained: arb
    repairs: tuple[Repair, ...]


def find_misprint(
    tableau: Tableau, exact: Order, found: Suggestion, units: Mapping[Number, fmpq]
) -> Misprint | None:
    """Whether the residuals that a tolerance would cover are larger than rounding makes them.

    A coefficient is off by one unit of its last place at most, ten where it was computed. A long
    fraction may be off by one in its numerator, so there one entry that makes all conditions hold
    exactly is a misprint, too.

    Args:
        tableau: the method.
        exact: its exact order.
        found: the tolerance that its residuals suggest.
        units: by how much each printed value may be off.

    Returns:
        None where rounding explains them.
    """
    if exact.witness is None:
        return None
    full = RoundedTableau.printed(tableau, _times_slack(_of_full_length(units)))
    if order_of(full, found.order).order < found.order:
        # a digit too many or a wrong one makes a number short, or long, beside all others
        repairs = suspects(full, found.order)
        if repairs:
            return _misprinted(full, exact.witness, found.order, repairs)
    rounded = RoundedTableau.printed(tableau, _times_slack(units))
    within_digits = order_of(rounded, found.order)
    is_explained = within_digits.order >= found.order
    largest = max(units.values(), default=ZERO)
    near = ZERO if is_explained else SLACK * largest
    # where residuals are largest they depend on the entry most: earlier ones may be its squares
    looked_at = found.worst if near else exact.order + 1
    missed = Missed(looked_at, found.order, tolerance=near, near=near)
    visible: list[Repair] = []
    repairs = () if is_explained else suspects(rounded, found.order)
    for repair in repairs or _few_repairs(tableau, missed):
        unit = largest if is_explained else units.get(repair.old, ZERO)
        if not within(repair.new - repair.old, SLACK * unit):
            visible.append(repair)
    if is_explained and not visible:
        return None
    witness = within_digits.witness or exact.witness
    if not visible and rounded.explains(witness.tree):
        return None  # together the conditions exclude each other, but no entry is to blame
    return _misprinted(rounded, witness, found.order, visible)


def _times_slack(units: Mapping[Number, fmpq]) -> dict[Number, fmpq]:
    return {value: SLACK * unit for value, unit in units.items()}


def _of_full_length(units: Mapping[Number, fmpq]) -> dict[Number, fmpq]:
    """By how much values may be off that were printed with as many places, or as many digits, as
    the others: zeros at the end are often left away.
    """
    rounded = {x: unit for x, unit in units.items() if unit and x}
    finest = min(rounded.values(), default=ZERO)
    sizes = {x: rounded_up(abs(to_ball(x))) for x in rounded}
    part = min((unit / sizes[x] for x, unit in rounded.items()), default=ZERO)
    longer = {x: min(unit, max(finest, part * sizes[x])) for x, unit in rounded.items()}
    return {**units, **longer}


def _misprinted(
    rounded: RoundedTableau, witness: Witness, order: int, repairs: Sequence[Repair]
) -> Misprint:
    explained = arb(rounded.allowed(witness.tree))
    return Misprint(order, abs(to_ball(witness.residual)), explained, tuple(repairs))


def misprint_within(rounded: RoundedTableau, found: AnyOrder, limit: int) -> Misprint | None:
    """The entries of a rounded method that alone may keep it from the order that its residuals
    speak for; None where they speak for no other.
    """
    if found.witness is None:
        return None
    if not abs(to_ball(found.witness.residual)) <= unnatural(found.order + 1):
        return None  # which the next line would find, by the trees of all orders
    meant = suggest_tolerance(rounded.tableau, find_order(rounded.tableau, limit), limit)
    if meant is None or meant.order <= found.order:
        return None
    repairs = suspects(rounded, meant.order)
    return _misprinted(rounded, found.witness, meant.order, repairs) if repairs else None


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
    explicit method, 10⁻¹² at order 21 of Gauss 10. So residuals count as rounding only if,
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
    if exact.witness is None or not any(isinstance(space, PointSpace) for space in tableau.spaces):
        return None
    first = abs(to_ball(exact.witness.residual))
    if not first <= unnatural(exact.order + 1):
        return None
    rounding, worst = first, exact.order + 1
    failing = exact.order + 1
    for order, sizes in _sizes(tableau, first, range(failing, limit + 1)):
        if sizes.bound <= unnatural(order):
            if sizes.bound > rounding:
                rounding, worst = sizes.bound, order
        elif order > failing and sizes.reached >= JUMP * rounding:
            exponent = enough(tableau, order - 1, rounding)
            return Suggestion(order - 1, exponent, rounding, sizes.reached, worst)
        else:
            return None
    return None


def suggest_wider(
    rounded: RoundedTableau,
    found: AnyOrder,
    units: Mapping[Number, fmpq],
    limit: int = DEFAULT_LIMIT,
) -> Suggestion | None:
    """A tolerance that would do where that of the file is tighter than its own digits.

    Args:
        rounded: the method with the tolerance of the file.
        found: its order within that.
        units: by how much each printed value may be off.
        limit: the order at which to stop.

    Returns:
        None where the digits do not explain the order that fails, or residuals do not jump after
        those that they explain.
    """
    if found.witness is None or max(units.values(), default=ZERO) <= rounded.tolerance:
        return None
    printed = RoundedTableau.printed(rounded.tableau, units)
    if not printed.explains(found.witness.tree):
        return None
    wider = order_of(printed, limit)
    if wider.witness is None or wider.order <= found.order or not isinstance(wider, RoundedOrder):
        return None
    genuine, rounding = abs(to_ball(wider.witness.residual)), wider.largest_residual
    if not genuine >= JUMP * rounding:
        return None
    return Suggestion(
        wider.order, enough(rounded.tableau, wider.order, rounding), rounding, genuine
    )


def _sizes(tableau: Tableau, first: arb, orders: range) -> Iterator[tuple[int, Sizes | HullSizes]]:
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
        if sum(counts_upto(admissible, order)[-1]) <= FEW_TREES:
            yield order, trees.sizes(order)
        else:
            yield order, spans.sizes(order)


def enough(tableau: Tableau, order: int, rounding: arb) -> int:
    """The exponent of the smallest power of ten that is twice as large as what counts as
    rounding at least, and within which the method has the order.
    """
    exponent = 0
    while fmpq(10) ** (exponent - 1) >= 2 * rounding:
        exponent -= 1
    while exponent < -1:
        if order_of(RoundedTableau.within(tableau, fmpq(10) ** exponent), order).order >= order:
            break
        exponent += 1
    return exponent
