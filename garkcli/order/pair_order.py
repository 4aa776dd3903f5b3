"""The order of the symplectic pair by simplifying conditions (docs/pair-order.md)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.defects import Defects
from garkcli.order.meant import AnyTableau
from garkcli.order.simplifying import defects_of
from garkcli.tableau.tableau import Tableau


class SimplifyingCondition(Frozen):
    """A simplifying condition of one colour or block.

    Attributes:
        letter: B, C or D; ``even`` is b_l(c^k A^{l,m} c^k) = 1/(2 (k + 1)²).
        number: n of B(n), k of C(k), D(k) and ``even``.
        m: the second colour of the block A^{l,m}; ``l`` for B.
    """

    letter: Literal["B", "C", "D", "even"]
    number: int
    l: int
    m: int


class PairCriterion(Frozen):
    """The order that the criterion gives, with the further conditions of the next one that fail. If
    nodes are row sums and edges are closed under reversal, the pair has at least this order;
    exactly this order if all weights are positive and no colour is linear.
    """

    order: int
    missing: tuple[SimplifyingCondition, ...]


def added(order: int) -> Iterator[tuple[Literal["B", "C", "D", "even"], int]]:
    """The conditions that an order needs beyond those of the orders below.

    >>> list(added(5)), list(added(6))
    ([('B', 5), ('C', 2), ('D', 2)], [('B', 6), ('even', 2)])
    """
    yield "B", order
    k = (order - 1) // 2
    if order % 2 == 0:
        yield "even", k
    elif k:
        yield "C", k
        yield "D", k


def pair_criterion(method: AnyTableau, limit: int = DEFAULT_LIMIT) -> PairCriterion:
    r"""The largest order of the pair that the criterion proves, up to ``limit``.

    In a rounded method a condition holds if rounding explains its defect.

    >>> from garkcli import loads
    >>> ssprk3 = loads("A: [[0, 0, 0], [1, 0, 0], [1/4, 1/4, 0]]\nb: [1/6, 1/6, 2/3]").tableau
    >>> pair_criterion(ssprk3).order
    2
    """
    defects = defects_of(method)
    for order in range(1, limit + 1):
        missing = tuple(_missing(defects, order))
        if missing:
            return PairCriterion(order - 1, missing)
    return PairCriterion(limit, ())


def missing_of_block(
    tableau: Tableau, edge: tuple[int, int], order: int
) -> list[SimplifyingCondition]:
    defects, (l, m) = defects_of(tableau), edge
    needed = [
        SimplifyingCondition(letter, number, l, m)
        for lower in range(1, order + 1)
        for letter, number in added(lower)
        if letter != "B"
    ]
    return [x for x in needed if not defects.vanish(defects.of(x.letter, l, m, x.number))]


def _missing(defects: Defects, order: int) -> Iterator[SimplifyingCondition]:
    tableau = defects.tableau
    diagonal = [(l, l) for l in range(tableau.size)]
    for letter, number in added(order):
        for l, m in diagonal if letter == "B" else tableau.edges():
            if not defects.vanish(defects.of(letter, l, m, number)):
                yield SimplifyingCondition(letter, number, l, m)
