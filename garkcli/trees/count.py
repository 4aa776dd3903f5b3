"""How many N-trees there are: exact counts of any order, without generating a tree.

The trees of order n with root l are the forests of order n - 1 that may stand on l, and forests are
counted from trees by the Euler transform: for a forest whose trees have the counts t(1), t(2), …

    n f(n) = Σ_{k=1..n} c(k) f(n - k),      c(k) = Σ_{d | k} d t(d),      f(0) = 1.

Source: Harary and Palmer, *Graphical Enumeration* (1973), chapter 3; Butcher, *B-Series* (2021), chapter 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

Edges: TypeAlias = "Sequence[Sequence[bool]]"
"""``edges[l][m]``: a vertex of colour l may carry a branch whose root has colour m; colours from 0."""


@dataclass(frozen=True)
class Admissible:
    """Which N-trees are meant: the colours, the edges between them, and the linear colours.

    ``branches[l]`` are the colours, in increasing order, that may stand on a vertex of colour l. A vertex
    of a linear colour carries one branch at most: its vector field is linear in what it sees.
    """

    colours: int
    branches: tuple[tuple[int, ...], ...]
    linear: frozenset[int]

    @classmethod
    def of(cls, colours: int, edges: Edges | None = None, linear: Collection[int] = ()) -> Admissible:
        """Check and freeze; no ``edges`` means every edge.

        Raises ``ValueError`` when ``edges`` is not a colours × colours matrix or a colour does not exist.
        """
        if colours < 1:
            raise ValueError(f"an N-tree needs at least one colour, not {colours}")
        everything = tuple(range(colours))
        if edges is None:
            rows = (everything,) * colours
        else:
            if len(edges) != colours or any(len(row) != colours for row in edges):
                raise ValueError(f"edges must be a {colours} by {colours} matrix, one row for each colour")
            rows = tuple(tuple(m for m in everything if row[m]) for row in edges)
        strangers = [colour for colour in linear if not 0 <= colour < colours]
        if strangers:
            raise ValueError(f"linear colour {strangers[0]} is not one of the {colours} colours 0, 1, …")
        return cls(colours, rows, frozenset(linear))

    def is_linear(self, colour: int) -> bool:
        """Whether a vertex of this colour carries one branch at most."""
        return colour in self.linear

    def twin(self, colour: int) -> int:
        """The first colour on which the same branches may stand: the trees differ in their roots only."""
        natures = [(row, other in self.linear) for other, row in enumerate(self.branches)]
        return natures.index(natures[colour])


def counts_upto(admissible: Admissible, order: int) -> list[tuple[int, ...]]:
    """``counts[n - 1][l]``: the number of admissible trees of order n with root colour l, n = 1, …, order.

    >>> counts_upto(Admissible.of(2, [[False, True], [True, True]]), 3)
    [(1, 1), (1, 2), (3, 6)]
    """
    if order < 1:
        raise ValueError(f"the order of a tree is at least 1, not {order}")
    twins = [admissible.twin(colour) for colour in range(admissible.colours)]
    forests: dict[int, list[int]] = {leader: [1] for leader in twins}  # f(n) of what stands on a colour
    divisor_sums: dict[int, list[int]] = {leader: [0] * order for leader in twins}  # c(n)
    counts = [tuple(1 for _ in twins)]
    for n in range(1, order):
        for leader, f in forests.items():
            c = divisor_sums[leader]
            t = sum(counts[n - 1][colour] for colour in admissible.branches[leader])
            for multiple in range(n, order, n):
                c[multiple] += n * t
            alone = admissible.is_linear(leader)
            f.append(t if alone else sum(c[k] * f[n - k] for k in range(1, n + 1)) // n)
        counts.append(tuple(forests[leader][n] for leader in twins))
    return counts


def count_by_root(
    colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()
) -> tuple[int, ...]:
    """The number of N-trees of one order for each root colour.

    ``edges`` and ``linear`` as in :class:`Admissible`; raises ``ValueError`` for an order below 1.

    >>> count_by_root(2, 4)
    (26, 26)
    """
    return counts_upto(Admissible.of(colours, edges, linear), order)[-1]


def count_trees(colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()) -> int:
    """The number of N-trees of one order.

    >>> [count_trees(1, n) for n in range(1, 9)]
    [1, 1, 2, 4, 9, 20, 48, 115]
    >>> count_trees(4, 8)
    4027360
    """
    return sum(count_by_root(colours, order, edges, linear))
