"""Weak stage order: up to which order what the stages miss never reaches the new value.

D. I. Ketcheson, B. Seibold, D. Shirokoff, D. Zhou, *DIRK schemes with high weak stage order*, 2020,
definition 2. For several colours it is derived in docs/stiff-problems.md.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from functools import cache

from garkcli.deadline import check_time
from garkcli.exact.matrix import Vector, dot
from garkcli.order.simplifying import Defects, defects_of
from garkcli.tableau.meant import AnyTableau


def weak_stage_order(method: AnyTableau, colours: Sequence[int], limit: int) -> int:
    """The largest q, up to a limit, for which b^{l} A^{l,m} ⋯ A^{n,p} (A^{p,r} (c^{r})^(k−1) −
    (c^{p})^k / k) = 0 for k = 1, …, q, every r and all products of blocks between some colours.

    Of a rounded tableau a product counts as zero where rounding explains it.

    Args:
        method: rounded or not.
        colours: between which products are taken: those that are stiff.
        limit: where the search stops.
    """
    defects = defects_of(method)
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
    """A basis of all b^{l} A^{l,m} ⋯ A^{n,p}, each with its last colour p.

    The products are chosen by the entries as they are printed, and computed from the entries of the
    computation: a method whose rounding is the tableau has the same products.
    """
    printed = Defects(defects.tableau) if defects.entries is not defects.tableau else defects
    edges = set(defects.tableau.edges())
    found = {l: Echelon() for l in colours}
    waiting = deque((l, printed.weights(l), defects.weights(l)) for l in colours)
    while waiting:
        check_time()
        l, w, meant = waiting.popleft()
        if not found[l].grows(w):
            continue
        yield l, meant
        for m in colours:
            if (l, m) in edges:
                before = printed.before(l, m, w)
                waiting.append(
                    (m, before, before if printed is defects else defects.before(l, m, meant))
                )


class Echelon:
    """A linear span of vectors of exact numbers, grown by elimination.

    >>> from flint import fmpq
    >>> span = Echelon()
    >>> [span.grows((fmpq(x), fmpq(y))) for x, y in ((0, 2), (0, 1), (3, 1), (1, 1))]
    [True, False, True, False]
    """

    def __init__(self) -> None:
        self._rows: list[tuple[int, Vector]] = []

    def grows(self, vector: Vector) -> bool:
        """Take in a vector; whether it was no combination of those before."""
        for pivot, row in self._rows:
            factor = vector[pivot]
            if factor:
                vector = tuple(x - factor * y for x, y in zip(vector, row, strict=True))
        found = next((j for j, x in enumerate(vector) if x), None)
        if found is None:
            return False
        self._rows.append((found, tuple(x / vector[found] for x in vector)))
        return True
