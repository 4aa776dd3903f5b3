"""The renumberings that turn one method into another."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations
from typing import TypeAlias

from flint import fmpq

from garkcli.comparison import grid as grids
from garkcli.conversion.sheet import CannotConvert, Sheet, of_weights
from garkcli.deadline import checked
from garkcli.errors import LimitExceeded
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, replace
from garkcli.properties.reduction import reduced
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Row
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Stage: TypeAlias = tuple[int, int]
"""A colour and the number of one of its stages."""
Images: TypeAlias = tuple[tuple[int, ...], ...]
"""For each colour, the corresponding stages of the other method."""
_Candidates: TypeAlias = dict[Stage, list[int]]
MAX_TRIALS = 3000


def find_matching(one: grids.Grid, other: grids.Grid, likeness: grids.Likeness) -> Images | None:
    """Returns stages of ``other`` for those of ``one``, or None; LimitExceeded if too many."""
    if not grids.have_one_shape(one, other):
        return None
    candidates: _Candidates = {}
    for l, stages in enumerate(one.stages):
        for i in range(stages):
            own = _own(one, l, i)
            images = (j for j in range(stages) if likeness.rows(own, _own(other, l, j)))
            candidates[l, i] = list(images)
    chosen = next(_SamenessSearch(one, other, likeness).completions(candidates, {}), None)
    if chosen is None:
        return None
    return tuple(tuple(chosen[l, i] for i in range(stages)) for l, stages in enumerate(one.stages))


def _own(grid: grids.Grid, l: int, i: int) -> Row:
    return grid.c[l][i], grid.b[l][i], *[weights[l][i] for weights in grid.further]


class _SamenessSearch:
    """A depth-first search; the stage with the fewest candidates is next."""

    def __init__(self, one: grids.Grid, other: grids.Grid, likeness: grids.Likeness) -> None:
        self.one = one
        self.other = other
        self.likeness = likeness
        self.trials = 0

    def completions(
        self, candidates: _Candidates, chosen: dict[Stage, int]
    ) -> Iterator[dict[Stage, int]]:
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
        """Returns whether the entries that couple two stages equal those of their images."""
        return self._sees(x, image_x, y, image_y) and self._sees(y, image_y, x, image_x)

    def _sees(self, x: Stage, image_x: int, y: Stage, image_y: int) -> bool:
        (l, i), (m, j) = x, y
        block, other = self.one.A[l][m], self.other.A[l][m]
        if block is None or other is None:
            return block is other
        return self.likeness.cells(block[i][j], other[image_x][image_y]) is not False


MOST_COLOURS = 5
"""Most colours of which other orders than the given one are tried."""


class Sameness(Frozen):
    """The correspondence of two methods: ``colours`` and ``stages`` of the second for those of the
    first, from 0; ``is_reduced`` if redundant or equal stages were removed, ``step_only`` if
    further weights differ.
    """

    colours: tuple[int, ...]
    stages: Images
    is_reduced: bool = False
    step_only: bool = False
    allowed: fmpq = ZERO

    @property
    def keeps_colours(self) -> bool:
        return self.colours == tuple(range(len(self.colours)))

    @property
    def keeps_stages(self) -> bool:
        return all(row == tuple(range(len(row))) for row in self.stages)

    @property
    def is_plain(self) -> bool:
        """Whether the entries are equal without renumbering or reduction."""
        return self.keeps_colours and self.keeps_stages and not self.is_reduced


class SamenessResult(Frozen):
    """The result of a search; ``obstacle`` says why it is unknown."""

    sameness: Sameness | None
    obstacle: str = ""


class Views(Frozen):
    """The entries of two methods, and the exact ones in one field if all are exact."""

    one: grids.Grid
    other: grids.Grid
    sheets: tuple[Sheet, Sheet] | None


def views_of(one: GarkMethod, other: GarkMethod) -> Views:
    sheets = grids.common_sheets(one, other)
    if sheets is None:
        return Views(grids.enclosed_grid(one), grids.enclosed_grid(other), None)
    return Views(grids.grid_of(sheets[0]), grids.grid_of(sheets[1]), sheets)


def find_sameness(
    one: GarkMethod, other: GarkMethod, views: Views, allowed: fmpq
) -> SamenessResult:
    """Returns how methods correspond, if rounding moves entries apart by ``allowed`` at most."""
    if views.sheets is None and _same_algebra(one.tableau, other.tableau):
        return SamenessResult(_plainly(views.one))
    try:
        same = _as_they_are(views.one, views.other, ZERO) or _once_reduced(views)
        if same is None and allowed:
            same = _as_they_are(views.one, views.other, allowed)
    except LimitExceeded as error:
        return SamenessResult(None, error.message)
    if same is not None and views.sheets is None and not same.allowed:
        # enclosures that overlap prove nothing
        return SamenessResult(None, "the nodes have no simple radicals")
    return SamenessResult(same)


def _plainly(grid: grids.Grid) -> Sameness:
    stages = tuple(tuple(range(s)) for s in grid.stages)
    return Sameness(tuple(range(grid.size)), stages)


def _same_algebra(one: Tableau, other: Tableau) -> bool:
    """Whether methods at nodes without simple radicals have the same rational coefficients."""
    if len(one.spaces) != len(other.spaces) or one.size != other.size:
        return False
    for space, second in zip(one.spaces, other.spaces, strict=True):
        if isinstance(space, PointSpace) or space != second:
            return False
    for colour, twin in zip(one.colours, other.colours, strict=True):
        if replace(colour, name="") != replace(twin, name=""):
            return False
    return one.blocks == other.blocks


def _as_they_are(one: grids.Grid, other: grids.Grid, allowed: fmpq) -> Sameness | None:
    """Matches the methods without reduction, first with their further weights and then without."""
    same = _matched(one, other, allowed)
    if same is not None or not (one.further or other.further):
        return same
    same = _matched(one.of_the_step, other.of_the_step, allowed)
    return None if same is None else replace(same, step_only=True)


def _once_reduced(views: Views) -> Sameness | None:
    has_further = bool(views.one.further or views.other.further)
    for step_only in (False, True) if has_further else (False,):
        sheets = [Sheet(x.tableau) if step_only else x for x in views.sheets or ()]
        try:
            smaller = [of_weights(sheet, reduced) for sheet in sheets]
        except CannotConvert:
            continue
        if [x.tableau for x in smaller] != [x.tableau for x in sheets]:
            one, other = map(grids.grid_of, smaller)
            same = _matched(one, other, ZERO)
            if same is not None:
                return replace(same, is_reduced=True, step_only=step_only)
    return None


def _matched(one: grids.Grid, other: grids.Grid, allowed: fmpq) -> Sameness | None:
    likeness = grids.Likeness(allowed)
    if likeness.grids(one, other):
        return replace(_plainly(one), allowed=allowed)
    for order in _orders(one, other):
        images = find_matching(one, other.with_colours(order), likeness)
        if images is not None:
            return Sameness(order, images, allowed=allowed)
    return None


def _orders(one: grids.Grid, other: grids.Grid) -> Iterator[tuple[int, ...]]:
    """Yields orders of colours of ``other`` with equal stages, the given one first."""
    if one.size != other.size:
        return
    colours = tuple(range(one.size))
    if one.size > MOST_COLOURS:
        yield colours
        return
    for order in checked(permutations(colours)):
        if tuple(other.stages[l] for l in order) == one.stages:
            yield order
