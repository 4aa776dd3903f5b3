"""In what sense two methods are the same one: which renumbering turns one into the other."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations
from typing import TypeAlias

from flint import fmpq

from garkcli.comparison.grid import (
    Grid,
    Likeness,
    common_sheets,
    enclosed_grid,
    grid_of,
    have_one_shape,
)
from garkcli.conversion.sheet import CannotConvert, Sheet, of_weights
from garkcli.errors import LimitExceeded
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, replace
from garkcli.properties.reduction import reduced
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Row
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Stage: TypeAlias = tuple[int, int]
"""A stage: its colour, and its number there."""
Images: TypeAlias = tuple[tuple[int, ...], ...]
"""For each colour the stages of the other method that its stages are."""
_Candidates: TypeAlias = dict[Stage, list[int]]
MAX_TRIALS = 3000
"""So many stages are tried before the search ends."""


def find_matching(one: Grid, other: Grid, likeness: Likeness) -> Images | None:
    """The stages of ``other`` that the stages of ``one`` are; None where no renumbering does it.

    Args:
        one: a method.
        other: another.
        likeness: when entries count as the same.

    Raises:
        LimitExceeded: more than ``MAX_TRIALS`` stages were tried.
    """
    if not have_one_shape(one, other):
        return None
    candidates: _Candidates = {}
    for l, stages in enumerate(one.stages):
        for i in range(stages):
            own = _own(one, l, i)
            images = (j for j in range(stages) if likeness.rows(own, _own(other, l, j)))
            candidates[l, i] = list(images)
    chosen = next(_Search(one, other, likeness).completions(candidates, {}), None)
    if chosen is None:
        return None
    return tuple(tuple(chosen[l, i] for i in range(stages)) for l, stages in enumerate(one.stages))


def _own(grid: Grid, l: int, i: int) -> Row:
    """What a stage has by itself: its node and its weights of all kinds."""
    return grid.c[l][i], grid.b[l][i], *[weights[l][i] for weights in grid.further]


class _Search:
    """Depth first, the stage with the fewest candidates next."""

    def __init__(self, one: Grid, other: Grid, likeness: Likeness) -> None:
        self.one = one
        self.other = other
        self.likeness = likeness
        self.trials = 0

    def completions(
        self, candidates: _Candidates, chosen: dict[Stage, int]
    ) -> Iterator[dict[Stage, int]]:
        """All ways to choose for the other stages too."""
        if not candidates:
            yield chosen
            return
        stage = min(candidates, key=lambda x: (len(candidates[x]), x))
        for j in candidates[stage]:
            self.trials += 1
            if self.trials > MAX_TRIALS:
                message = f"more than {MAX_TRIALS} renumberings of stages"
                raise LimitExceeded(message, "compare the canonical forms", code="too-many")
            if not self._fits(stage, j, stage, j):
                continue
            rest = self._narrowed(candidates, stage, j)
            if all(rest.values()):
                yield from self.completions(rest, {**chosen, stage: j})

    def _narrowed(self, candidates: _Candidates, stage: Stage, image: int) -> _Candidates:
        """What is left for the other stages."""
        rest: _Candidates = {}
        for other, images in candidates.items():
            if other == stage:
                continue
            is_same_colour = other[0] == stage[0]
            rest[other] = []
            for j in images:
                is_taken = is_same_colour and j == image
                if not is_taken and self._fits(stage, image, other, j):
                    rest[other].append(j)
        return rest

    def _fits(self, x: Stage, image_x: int, y: Stage, image_y: int) -> bool:
        """Whether two stages see each other as their images do."""
        return self._sees(x, image_x, y, image_y) and self._sees(y, image_y, x, image_x)

    def _sees(self, x: Stage, image_x: int, y: Stage, image_y: int) -> bool:
        (l, i), (m, j) = x, y
        block, other = self.one.A[l][m], self.other.A[l][m]
        if block is None or other is None:
            return block is other
        return self.likeness.cells(block[i][j], other[image_x][image_y]) is not False


MOST_COLOURS = 5
"""With more colours no other order of them is tried."""


class Sameness(Frozen):
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
        """Whether the colours are in the same order."""
        return self.colours == tuple(range(len(self.colours)))

    @property
    def keeps_stages(self) -> bool:
        """Whether the stages are in the same order."""
        return all(row == tuple(range(len(row))) for row in self.stages)

    @property
    def is_plain(self) -> bool:
        """Whether the entries are the same as they are."""
        return self.keeps_colours and self.keeps_stages and not self.is_reduced


class Answer(Frozen):
    """Whether two methods are the same.

    Attributes:
        sameness: how; None where they are not, or where it is not known.
        obstacle: why it is not known; empty where it is.
    """

    sameness: Sameness | None
    obstacle: str = ""


class Views(Frozen):
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
    """How two methods are the same, if they are: as they are, with their stages or their colours
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
        same = _as_they_are(views.one, views.other, ZERO) or _once_reduced(views)
        if same is None and allowed:
            same = _as_they_are(views.one, views.other, allowed)
    except LimitExceeded as error:
        return Answer(None, error.message)
    if same is not None and views.sheets is None and not same.allowed:
        # enclosures that overlap prove nothing
        return Answer(None, "the nodes have no simple radicals")
    return Answer(same)


def _plainly(grid: Grid) -> Sameness:
    """The entries as they are."""
    stages = tuple(tuple(range(s)) for s in grid.stages)
    return Sameness(tuple(range(grid.size)), stages)


def _same_algebra(one: Tableau, other: Tableau) -> bool:
    """Whether methods at nodes without simple radicals have the same rational
    numbers.
    """
    if len(one.spaces) != len(other.spaces) or one.size != other.size:
        return False
    for space, second in zip(one.spaces, other.spaces, strict=True):
        if isinstance(space, PointSpace) or space != second:
            return False
    for colour, twin in zip(one.colours, other.colours, strict=True):
        if replace(colour, name="") != replace(twin, name=""):
            return False
    return one.blocks == other.blocks


def _as_they_are(one: Grid, other: Grid, allowed: fmpq) -> Sameness | None:
    """The methods as they are, with their further weights or without."""
    same = _matched(one, other, allowed)
    if same is not None or not (one.further or other.further):
        return same
    same = _matched(one.of_the_step, other.of_the_step, allowed)
    return None if same is None else replace(same, step_only=True)


def _once_reduced(views: Views) -> Sameness | None:
    """The same of what is left of the methods when they are reduced."""
    has_further = bool(views.one.further or views.other.further)
    for step_only in (False, True) if has_further else (False,):
        sheets = [Sheet(x.tableau) if step_only else x for x in views.sheets or ()]
        try:
            smaller = [of_weights(sheet, reduced) for sheet in sheets]
        except CannotConvert:
            continue
        if [x.tableau for x in smaller] != [x.tableau for x in sheets]:
            one, other = map(grid_of, smaller)
            same = _matched(one, other, ZERO)
            if same is not None:
                return replace(same, is_reduced=True, step_only=step_only)
    return None


def _matched(one: Grid, other: Grid, allowed: fmpq) -> Sameness | None:
    """The renumbering of colours and stages that makes one of the other."""
    likeness = Likeness(allowed)
    if likeness.grids(one, other):
        return replace(_plainly(one), allowed=allowed)
    for order in _orders(one, other):
        images = find_matching(one, other.with_colours(order), likeness)
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
        if tuple(other.stages[l] for l in order) == one.stages:
            yield order
