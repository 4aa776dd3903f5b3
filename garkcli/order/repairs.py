"""Which single entry of a method, changed, would restore the order that it misses.

A repair is a hint drawn from the failing conditions, never a fact about what a source meant to
print.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from flint import fmpq

from garkcli.errors import ZeroWeight
from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.order.conditions import Condition, conditions
from garkcli.order.deciding import order_of
from garkcli.tableau.meant import AnyTableau, derived, meant, printed
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Edge, Tableau
from garkcli.trees.tree import Tree

MAX_ENTRIES = 2_000
"""Most entries that are tried."""
FEW_CONDITIONS = 4
"""So many failing conditions are solved for an entry of rounded coefficients; the best is kept."""
FEW_CHECKED = 20
"""So many failing conditions are looked at before the order is found."""
NEWTON_STEPS = 3
"""Steps of the simplified Newton's method; each squares a small misprint, nearly."""


@dataclass(frozen=True)
class Repair:
    """An entry that restores the claimed order when it is changed alone.

    ``l, m`` are the block's colours, or ``m`` is None for the weights b^{l}; ``i, j`` the entry
    (``j`` of the weights; then ``i`` is None). All count from 0. ``is_embedded`` tells embedded
    weights from b.
    """

    l: int
    m: int | None
    i: int | None
    j: int
    old: Number
    new: Number
    is_embedded: bool = False

    def carried_out(self, method: Tableau) -> Tableau:
        """The method with this entry changed."""
        place = _Place(self.l, self.m, self.i, self.j, self.old)
        return place.put(method, self.new)


@dataclass(frozen=True)
class Missed:
    """A claimed order that is missed, and how conditions are judged.

    Attributes:
        order: the first failing order.
        claimed: the order that was meant.
        of: what claims it, as it is called in a file.
        which: ``conjugate`` or ``pair`` where it is claimed of that; empty for the method.
        tolerance: the rounding of the coefficients; conditions fail beyond what it explains.
        near: the rounding with which they are restored: more than ``tolerance`` where coefficients
            are rounded, as the entry that is changed carries the rounding of all others.
    """

    order: int
    claimed: int
    of: str = "order"
    which: str = ""
    tolerance: fmpq = ZERO
    near: fmpq = ZERO

    def judged(self, method: Tableau) -> AnyTableau:
        """What the order is claimed of, as its conditions fail.

        Raises:
            ZeroWeight: there is no such thing.
        """
        return derived(meant(method, self.tolerance), self.which)

    def restored(self, method: Tableau) -> AnyTableau | None:
        """The same, as its conditions are restored; None where there is no such thing, or rounding
        may leave none.
        """
        try:
            made = derived(meant(method, self.near), self.which)
        except ZeroWeight:
            return None
        return made if isinstance(made, Tableau) or not made.obstacle else None


def repairs(method: Tableau, missed: Missed, failing: list[Condition]) -> Iterator[Repair]:
    """Entries whose change restores what is claimed: each must solve a failing condition.

    Of exact coefficients one condition tells as much as all; of rounded ones the entry that solves
    it carries their rounding, so that the condition that depends on it most is solved.
    """
    solved = failing[:1]
    if missed.tolerance:
        by_size = sorted(failing, key=_size_of_residual, reverse=True)
        solved = by_size[:FEW_CONDITIONS]
    if not solved:
        return
    for tried, place in enumerate(_places(method)):
        if tried >= MAX_ENTRIES:
            return
        new = _solution(method, missed, place, solved)
        if new is None:
            continue
        changed = missed.restored(place.put(method, new))
        if changed is None:
            continue
        few = failing[:FEW_CHECKED]
        if _holds(changed, few) and order_of(changed, missed.claimed).order >= missed.claimed:
            l, m = place.l, place.m
            i, j = place.i, place.j
            yield Repair(l, m, i, j, place.old, new)


def named_block(tableau: Tableau, edge: Edge) -> Edge:
    """The edge named after the first colour that has these stages: one name for each block."""
    l, m = edge
    spaces = [colour.space for colour in tableau.colours]
    return spaces.index(spaces[l]), m


def named_blocks(tableau: Tableau) -> list[Edge]:
    """The names of all blocks, in order."""
    names = {named_block(tableau, edge) for edge in tableau.edges()}
    return sorted(names)


def _size_of_residual(condition: Condition) -> float:
    return _size(condition.residual)


def _size(number: Number) -> float:
    """|number|, to compare by: what is chosen is then verified exactly."""
    return float(abs(to_ball(number, 20)))


def _holds(method: AnyTableau, failing: Sequence[Condition]) -> bool:
    """Whether some conditions hold that failed: that takes less than finding the order."""
    trees = [condition.tree for condition in failing]
    return all(condition.holds for condition in conditions(method, trees))


@dataclass(frozen=True)
class _Place:
    """One entry of a method: of the block (l, m), or of the weights of l, where m is None."""

    l: int
    m: int | None
    i: int | None
    j: int
    old: Number

    def put(self, method: Tableau, value: Number) -> Tableau:
        """The method with another value there."""
        if self.m is None or self.i is None:
            return _with_weight(method, self.l, self.j, value)
        key = method.colours[self.l].space, self.m
        return _with_entry(method, key, self.i, self.j, value)


def _places(method: Tableau) -> Iterator[_Place]:
    """The entries that are entries of stages: those of stage spaces of points."""
    for l, m in named_blocks(method):
        if not (_has_points(method, l) and _has_points(method, m)):
            continue
        space = method.colours[l].space
        for i, row in enumerate(method.blocks[space, m]):
            for j, old in enumerate(row):
                yield _Place(l, m, i, j, old)
    for l, colour in enumerate(method.colours):
        if not _has_points(method, l):
            continue
        for j, old in enumerate(colour.b):
            yield _Place(l, None, None, j, old)


def _has_points(method: Tableau, l: int) -> bool:
    return isinstance(method.space(l), PointSpace)


def _solution(
    method: Tableau, missed: Missed, place: _Place, failing: Sequence[Condition]
) -> Number | None:
    """The value with which a failing condition holds; None where none depends on the entry.

    Of exact coefficients only conditions that are linear in the entry are solved, by their values
    at the entry and one beyond; of rounded ones all by a few steps of a simplified Newton's method,
    as a misprint is a small change.
    """
    step = missed.near if missed.near else ONE
    trees = [condition.tree for condition in failing]
    changed = place.put(method, place.old + step)
    beyond = _weights(missed, changed, trees)
    if beyond is None:
        return None
    slopes: list[Number] = []
    for moved, condition in zip(beyond, failing, strict=True):
        slopes.append((moved - condition.value) / step)
    sizes = [_size(slope) for slope in slopes]
    best = sizes.index(max(sizes))
    condition, slope = failing[best], slopes[best]
    if not slope:
        return None
    value = place.old - condition.residual / slope
    if missed.near:
        return _refined(method, missed, place, condition, value, slope)
    further = place.put(method, place.old + step + step)
    twice = _weights(missed, further, [condition.tree])
    if twice is None:
        return None
    second_slope = twice[0] - beyond[best]
    is_linear = second_slope == slope
    return value if is_linear else None


def _refined(
    method: Tableau,
    missed: Missed,
    place: _Place,
    condition: Condition,
    value: Number,
    slope: Number,
) -> Number:
    """The root of a condition near ``value``.

    To a hundredth of what the condition is to be restored within.
    """
    grid = missed.near / 100
    for _ in range(NEWTON_STEPS):
        if isinstance(value, fmpq):
            value = (value / grid).floor() * grid
        changed = place.put(method, value)
        found = _weights(missed, changed, [condition.tree])
        if found is None:
            break
        residual = found[0] - condition.required
        value = value - residual / slope
    return value


def _weights(missed: Missed, method: Tableau, trees: Sequence[Tree]) -> list[Number] | None:
    """The elementary weights of some trees; None where the changed method has none."""
    made = missed.restored(method)
    if made is None:
        return None
    return [condition.value for condition in conditions(printed(made), trees)]


def _with_entry(tableau: Tableau, key: Edge, i: int, j: int, value: Number) -> Tableau:
    block = list(tableau.blocks[key])
    block[i] = _with_value(block[i], j, value)
    blocks = {**tableau.blocks, key: tuple(block)}
    return replace(tableau, blocks=blocks)


def _with_value(row: Vector, j: int, value: Number) -> Vector:
    changed = list(row)
    changed[j] = value
    return tuple(changed)


def _with_weight(tableau: Tableau, l: int, j: int, value: Number) -> Tableau:
    """b^{l} changed, together with the weights that are the same row: those of colours with these
    stages.
    """
    old = tableau.colours[l]
    b = _with_value(old.b, j, value)
    colours = []
    for colour in tableau.colours:
        has_stages = colour.space == old.space
        if has_stages and colour.b == old.b:
            colour = replace(colour, b=b)
        colours.append(colour)
    return replace(tableau, colours=tuple(colours))
