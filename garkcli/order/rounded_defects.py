"""By how much B, C, D and symplecticity are missed by the methods that a tableau may be a rounding
of: a ball an entry, which holds 0 where rounding explains the defect.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager
from typing import Any

from flint import arb, ctx

from garkcli.exact.linear_map import EntrywiseMap
from garkcli.exact.matrix import Matrix
from garkcli.order.defects import Defects
from garkcli.tableau.rounded import RoundedTableau


class RoundedDefects(Defects):
    """The defects over the box of a tableau.

    Their entries belong to stages, also where the exact defects are elements of a stage algebra.
    """

    def __init__(self, rounded: RoundedTableau) -> None:
        super().__init__(rounded.tableau, rounded.in_balls)
        self._bits = rounded.bits

    def precision(self) -> AbstractContextManager[object]:
        return ctx.workprec(self._bits)

    def vanish(self, defects: Iterable[Any]) -> bool:
        """Whether rounding explains them all."""
        return all(x.is_finite() and x.contains(0) for x in map(arb, defects))

    def _made_ready(self, block: Matrix) -> EntrywiseMap:
        return EntrywiseMap(block)
