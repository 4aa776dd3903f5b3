"""Wrong sums: weights that do not sum to 1, and rows of blocks that do not sum to the nodes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.frozen import Frozen
from garkcli.order.defects import Defects
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge


class WrongSum(Frozen):
    """A wrong sum of a row of a block, or of b^{l}, with ``m`` and ``i`` None; indices from 0."""

    l: int
    m: int | None
    i: int | None
    total: Number
    wanted: Number
    is_embedded: bool = False

    @property
    def off(self) -> Number:
        return self.total - self.wanted


def wrong_rows(defects: Defects, edges: Iterable[Edge]) -> Iterator[WrongSum]:
    tableau = defects.tableau
    for l, m in edges:
        block = tableau.block(l, m)
        if block is None or not all(isinstance(tableau.space(x), PointSpace) for x in (l, m)):
            continue
        rows = zip(block, tableau.colours[l].c, defects.C(l, m, 1), strict=True)
        for i, (row, node, defect) in enumerate(rows):
            if not defects.vanish([defect]):
                yield WrongSum(l, m, i, sum(row, ZERO), node)


def wrong_weights(defects: Defects, is_embedded: bool = False) -> Iterator[WrongSum]:
    """Weights that do not sum to 1 beyond rounding, shared ones once."""
    seen = []
    for l, colour in enumerate(defects.tableau.colours):
        is_of_points = isinstance(defects.tableau.space(l), PointSpace)
        if (colour.space, colour.b) in seen or not is_of_points:
            continue
        seen.append((colour.space, colour.b))
        if not defects.vanish(defects.B(l, 1)):
            yield WrongSum(l, None, None, sum(colour.b, ZERO), ONE, is_embedded)
