"""Weak stage order: the order up to which defects of the stages do not reach the new value.

D. I. Ketcheson, B. Seibold, D. Shirokoff, D. Zhou, *DIRK schemes with high weak stage order*, 2020,
definition 2. For several colours it is derived in docs/stiff-problems.md.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from functools import cache

from garkcli.deadline import check_time
from garkcli.exact.matrix import Vector, dot
from garkcli.order.defects import Defects
from garkcli.order.meant import AnyTableau
from garkcli.order.simplifying import defects_of


def weak_stage_order(method: AnyTableau | Defects, colours: Sequence[int], limit: int) -> int:
    """The largest q ≤ ``limit`` to which no defect reaches the new value. b^{l} A^{l,m} ⋯ A^{n,p}
    (A^{p,r} (c^{r})^(k−1) − (c^{p})^k / k) = 0 for k = 1, …, q, every r and all products of blocks
    between ``colours``, the stiff ones.
    """
    defects = method if isinstance(method, Defects) else defects_of(method)
    edges = set(defects.tableau.edges())
    residual = cache(defects.C)

    def vanishes(w: Vector, l: int, k: int) -> bool:
        return defects.vanish(dot(w, residual(*edge, k)) for edge in edges if edge[0] == l)

    def is_missed(k: int) -> bool:
        return not all(defects.vanish(residual(*edge, k)) for edge in edges if edge[0] in colours)

    # up to the stage order nothing is missed, so that nothing can reach the new value
    first = next((k for k in range(1, limit + 1) if is_missed(k)), limit + 1)
    q = limit
    for l, w in _functionals(defects, colours):
        with defects.precision():
            q = next((k - 1 for k in range(first, q + 1) if not vanishes(w, l, k)), q)
        if q < first:
            break
    return q


def _functionals(defects: Defects, colours: Sequence[int]) -> Iterator[tuple[int, Vector]]:
    """A basis of all b^{l} A^{l,m} ⋯ A^{n,p}, each with its last colour p."""
    edges = set(defects.tableau.edges())
    spans = {l: Echelon(defects) for l in colours}
    waiting = deque((l, defects.weights(l)) for l in colours)
    while waiting:
        check_time()
        l, w = waiting.popleft()
        with defects.precision():
            if not spans[l].grows(w):
                continue
        yield l, w
        waiting.extend((m, defects.before(l, m, w)) for m in colours if (l, m) in edges)


class Echelon:
    """A linear span of vectors; ``defects`` decides whether a number is zero."""

    def __init__(self, defects: Defects) -> None:
        self._vanish = defects.vanish
        self._rows: list[tuple[int, Vector]] = []

    def grows(self, vector: Vector) -> bool:
        for pivot, row in self._rows:
            factor = vector[pivot]
            if factor != 0:
                vector = tuple(x - factor * y for x, y in zip(vector, row, strict=True))
        pivot_of_rest = next((j for j, x in enumerate(vector) if not self._vanish([x])), None)
        if pivot_of_rest is None:
            return False
        self._rows.append((pivot_of_rest, tuple(x / vector[pivot_of_rest] for x in vector)))
        return True
