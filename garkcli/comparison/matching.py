"""Which renumbering of its stages turns one method into another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias

from garkcli.comparison.grid import Grid
from garkcli.comparison.likeness import Likeness, have_one_shape
from garkcli.errors import LimitExceeded
from garkcli.tableau.pointwise import Row

Stage: TypeAlias = tuple[int, int]
"""A stage: its colour, and its number there."""
Images: TypeAlias = tuple[tuple[int, ...], ...]
"""For each colour the stages of the other method that its stages are."""
_Classes: TypeAlias = tuple[Mapping[Stage, int], Mapping[Stage, int]]
_Candidates: TypeAlias = dict[Stage, list[int]]
MAX_TRIALS = 3000
"""So many stages are tried before the search ends."""


def find_matching(
    one: Grid, other: Grid, likeness: Likeness, classes: _Classes | None = None
) -> Images | None:
    """The stages of ``other`` that the stages of ``one`` are; None where no renumbering does it.

    Args:
        one: a method.
        other: another.
        likeness: when entries count as the same.
        classes: stages in different classes are known to be different.

    Raises:
        LimitExceeded: more than ``MAX_TRIALS`` stages were tried.
    """
    if not have_one_shape(one, other):
        return None
    candidates: _Candidates = {}
    for l, stages in enumerate(one.stages):
        for i in range(stages):
            own = _own(one, l, i)
            candidates[l, i] = []
            for j in range(stages):
                if _are_apart(classes, (l, i), (l, j)):
                    continue
                if likeness.rows(own, _own(other, l, j)):
                    candidates[l, i].append(j)
    search = _Search(one, other, likeness)
    chosen = next(search.completions(candidates, {}), None)
    if chosen is None:
        return None
    images = []
    for l, stages in enumerate(one.stages):
        images.append(tuple(chosen[l, i] for i in range(stages)))
    return tuple(images)


def _are_apart(classes: _Classes | None, stage: Stage, other: Stage) -> bool:
    """Whether classes are known, and tell two stages apart."""
    if classes is None:
        return False
    first, second = classes
    return first[stage] != second[other]


def _own(grid: Grid, l: int, i: int) -> Row:
    """What a stage has by itself: its node and its weights of all kinds."""
    further = [weights[l][i] for weights in grid.further]
    return grid.c[l][i], grid.b[l][i], *further


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
                raise LimitExceeded(
                    f"more than {MAX_TRIALS} renumberings of stages",
                    "compare the canonical forms",
                    code="too-many",
                )
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
        alike = self.likeness.cells(block[i][j], other[image_x][image_y])
        return alike is not False
