"""In what sense two methods are the same one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import permutations

from flint import fmpq

from garkcli.comparison.grid import Grid, common_sheets, enclosed_grid, grid_of
from garkcli.comparison.likeness import Likeness
from garkcli.comparison.matching import Images, find_matching
from garkcli.conversion.sheet import CannotConvert, Rows, Sheet, of_weights
from garkcli.conversion.stage_classes import stage_classes
from garkcli.errors import LimitExceeded
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Matrix
from garkcli.properties.reduction import reduced
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

MOST_COLOURS = 5
"""With more colours no other order of them is tried."""


@dataclass(frozen=True)
class Sameness:
    """How one method becomes the other; all counted from 0.

    Attributes:
        colours: for each colour of the first the colour of the second that it is.
        stages: for each colour of the first the stages of the second that its stages are.
        is_reduced: whether stages without influence, or equal ones, are left out before.
        step_only: whether further weights, embedded or dense ones, differ all the same.
        allowed: the rounding within which entries are equal; 0 where they are equal exactly.
    """

    colours: tuple[int, ...]
    stages: Images
    is_reduced: bool = False
    step_only: bool = False
    allowed: fmpq = ZERO

    @property
    def keeps_colours(self) -> bool:
        """Whether the colours stand in the same order."""
        return self.colours == tuple(range(len(self.colours)))

    @property
    def keeps_stages(self) -> bool:
        """Whether the stages stand in the same order."""
        return all(row == tuple(range(len(row))) for row in self.stages)

    @property
    def is_plain(self) -> bool:
        """Whether the entries are the same as they stand."""
        return self.keeps_colours and self.keeps_stages and not self.is_reduced


@dataclass(frozen=True)
class Answer:
    """Whether two methods are the same.

    Attributes:
        sameness: how; None where they are not, or where it is not known.
        obstacle: why it is not known; empty where it is.
    """

    sameness: Sameness | None
    obstacle: str = ""


@dataclass(frozen=True)
class Views:
    """Two methods as they are compared.

    Attributes:
        one, other: their entries.
        sheets: the same exactly, from one field; None where enclosures are compared.
    """

    one: Grid
    other: Grid
    sheets: tuple[Sheet, Sheet] | None


def views_of(one: GarkMethod, other: GarkMethod) -> Views:
    """Both methods entry by entry: exactly where that is possible."""
    sheets = common_sheets(one, other)
    if sheets is None:
        return Views(enclosed_grid(one), enclosed_grid(other), None)
    return Views(grid_of(sheets[0]), grid_of(sheets[1]), sheets)


def find_sameness(one: GarkMethod, other: GarkMethod, views: Views, allowed: fmpq) -> Answer:
    """How two methods are the same, if they are: as they stand, with their stages or their colours
    renumbered, or once reduced.

    Args:
        one: a method.
        other: another.
        views: their entries, from ``views_of``.
        allowed: how far rounding may have moved equal entries apart.
    """
    if views.sheets is None and _same_algebra(one.tableau, other.tableau):
        return Answer(_plainly(views.one))
    try:
        found = _found(views, ZERO) or _once_reduced(views)
        if found is None and allowed:
            found = _found(views, allowed)
    except LimitExceeded as error:
        return Answer(None, error.message)
    if found is not None and views.sheets is None and not found.allowed:
        # enclosures that overlap prove nothing
        return Answer(None, "the nodes have no simple radicals")
    return Answer(found)


def _plainly(grid: Grid) -> Sameness:
    """The entries as they stand."""
    stages = tuple(tuple(range(s)) for s in grid.stages)
    return Sameness(tuple(range(grid.size)), stages)


def _same_algebra(one: Tableau, other: Tableau) -> bool:
    """Whether methods at nodes without simple radicals are told by the same rational numbers."""
    if len(one.spaces) != len(other.spaces) or one.size != other.size:
        return False
    for space, second in zip(one.spaces, other.spaces, strict=True):
        if isinstance(space, PointSpace) or space != second:
            return False
    for colour, twin in zip(one.colours, other.colours, strict=True):
        if replace(colour, name="") != replace(twin, name=""):
            return False
    return one.blocks == other.blocks


def _found(views: Views, allowed: fmpq) -> Sameness | None:
    """The methods as they are, with their further weights or without."""
    one, other = views.one, views.other
    found = _matched(one, other, allowed, views.sheets)
    has_further = one.further or other.further
    if found is not None or not has_further:
        return found
    steps = None
    if views.sheets is not None:
        steps = _steps(views.sheets)
    one, other = one.of_the_step, other.of_the_step
    return _marked(_matched(one, other, allowed, steps), step_only=True)


def _marked(found: Sameness | None, **marks: bool) -> Sameness | None:
    """The same with what has to be said of it."""
    return None if found is None else replace(found, **marks)  # type: ignore[arg-type]


def _once_reduced(views: Views) -> Sameness | None:
    """The same of what is left of the methods when they are reduced."""
    if views.sheets is None:
        return None
    found = _matched_when_reduced(views.sheets)
    has_further = views.one.further or views.other.further
    if found is None and has_further:
        found = _matched_when_reduced(_steps(views.sheets))
        found = _marked(found, step_only=True)
    return _marked(found, is_reduced=True)


def _matched_when_reduced(sheets: tuple[Sheet, Sheet]) -> Sameness | None:
    smaller = _smaller(sheets)
    if smaller is None:
        return None
    one, other = _grids(smaller)
    return _matched(one, other, ZERO, smaller)


def _smaller(sheets: tuple[Sheet, Sheet]) -> tuple[Sheet, Sheet] | None:
    """Both methods reduced; None where that changes neither."""
    first, second = sheets
    try:
        one = of_weights(first, reduced)
        other = of_weights(second, reduced)
    except CannotConvert:
        return None
    is_changed = one.tableau != first.tableau
    if is_changed or other.tableau != second.tableau:
        return one, other
    return None


def _steps(sheets: tuple[Sheet, Sheet]) -> tuple[Sheet, Sheet]:
    """The same without further weights."""
    one, other = sheets
    return Sheet(one.tableau), Sheet(other.tableau)


def _grids(sheets: tuple[Sheet, Sheet]) -> tuple[Grid, Grid]:
    return grid_of(sheets[0]), grid_of(sheets[1])


def _matched(
    one: Grid, other: Grid, allowed: fmpq, sheets: tuple[Sheet, Sheet] | None
) -> Sameness | None:
    """The renumbering of colours and stages that makes one of the other."""
    likeness = Likeness(allowed)
    if likeness.grids(one, other):
        return replace(_plainly(one), allowed=allowed)
    for order in _orders(one, other):
        turned = other.with_colours(order)
        classes = None
        if sheets is not None and not allowed:
            classes = _classes(sheets[0], sheets[1], order)
        images = find_matching(one, turned, likeness, classes)
        if images is not None:
            return Sameness(order, images, allowed=allowed)
    return None


def _orders(one: Grid, other: Grid) -> Iterator[tuple[int, ...]]:
    """Orders of the colours of the second method in which it has the stages of the first, its own
    first.
    """
    if one.size != other.size:
        return
    colours = tuple(range(one.size))
    if one.size > MOST_COLOURS:
        yield colours
        return
    for order in permutations(colours):
        stages = tuple(other.stages[l] for l in order)
        if stages == one.stages:
            yield order


def _classes(
    one: Sheet, other: Sheet, order: tuple[int, ...]
) -> tuple[Mapping[tuple[int, int], int], Mapping[tuple[int, int], int]]:
    """Classes of stages of the first method and of the second with its colours in an order."""
    turned = _with_colours(other, order)
    has_alike = one.has_embedded == turned.has_embedded
    if not has_alike or len(one.further) != len(turned.further):
        one, turned = _steps((one, turned))
    first, second = stage_classes([one, turned])
    return first, second


def _with_colours(sheet: Sheet, order: tuple[int, ...]) -> Sheet:
    """A sheet in which each colour has stages of its own, with the colours in an order."""
    old = sheet.tableau
    place: dict[int, int] = {}
    colours = []
    for k, l in enumerate(order):
        place[l] = k
        colours.append(replace(old.colours[l], space=k))
    blocks: dict[Edge, Matrix] = {}
    for (l, m), block in old.blocks.items():
        blocks[place[l], place[m]] = block
    spaces = tuple(old.spaces[l] for l in order)
    tableau = Tableau(spaces, tuple(colours), blocks)
    further = [_chosen(rows, order) for rows in sheet.further]
    return replace(sheet, tableau=tableau, further=tuple(further))


def _chosen(rows: Rows, order: tuple[int, ...]) -> Rows:
    return tuple(rows[l] for l in order)
