"""Counts N-trees of any order exactly, without generating a tree.

The trees of order n with root l are the forests of order n - 1 that may be on l, or n - w if a
vertex counts w orders. The Euler transform counts forests from the counts t(1), t(2), … of trees:

    n f(n) = Σ_{k=1..n} c(k) f(n - k),      c(k) = Σ_{d | k} d t(d),      f(0) = 1.

Of these f(n) forests, t(n) are one branch. As the t(n) that c(n) needs is a sum of f(n - 1), the
convolution is one of sequences that are still growing. It is taken in blocks, of half the orders, a
quarter, and so on, each a product of polynomials: O(M(n) log n) with M(n) the time of a product.

Source: Harary and Palmer, *Graphical Enumeration* (1973), chapter 3; Butcher, *B-Series* (2021),
chapter 2; van der Hoeven, "Relax, but don't be too lazy", J. Symb. Comput. 34 (2002) 479.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from typing import TypeAlias

from flint import fmpz, fmpz_poly

from garkcli.errors import TreeError
from garkcli.frozen import Frozen
from garkcli.ntrees.kind import LINEAR, PLAIN, SEVERAL, VertexKind
from garkcli.ntrees.tree import Tree

SHORT = 48
"""Blocks of so many orders are done one by one: products of shorter polynomials gain nothing."""
Edges: TypeAlias = "Sequence[Sequence[bool]]"
"""Whether a vertex of colour l may carry a root of colour m, as ``edges[l][m]``."""


Colours: TypeAlias = tuple[int, ...]


class Admissible(Frozen):
    """A class of N-trees: ``branches[l]`` are the colours, ascending, that may be on a vertex of
    colour l, and ``kinds[l]`` says how many of them, and how many orders the vertex counts.
    """

    colours: int
    branches: tuple[Colours, ...]
    kinds: tuple[VertexKind, ...]

    @classmethod
    def of(
        cls, colours: int, edges: Edges | None = None, linear: Collection[int] = ()
    ) -> Admissible:
        """The class with some linear colours, by default with every edge; TreeError for misfits."""
        if colours < 1:
            message = f"an N-tree needs at least one colour, not {colours}"
            raise TreeError(message, "ask for 1 or more")
        everything = range(colours)
        rows: list[Colours] = [tuple(everything)] * colours
        if edges is not None:
            if {len(edges), *map(len, edges)} != {colours}:
                shape = f"a {colours} by {colours} matrix"
                message = f"edges must be {shape}, one row for each colour"
                raise TreeError(message, "fill it with 0 and 1", code="pasted-tableau")
            rows = [tuple(m for m in everything if row[m]) for row in edges]
        for colour in linear:
            if colour not in everything:
                what = f"linear colour {colour}"
                message = f"{what} is not one of the {colours} colours 0, 1, …"
                raise TreeError(message, "colours count from 0 here", code="wrong-value")
        return cls(
            colours, tuple(rows), tuple(LINEAR if l in linear else PLAIN for l in everything)
        )

    def __post_init__(self) -> None:
        if any(kind.weight < 1 for kind in self.kinds):
            message = "trees with vertices that count no order have no end"
            raise TreeError(message, "their order can be decided all the same", code="wrong-value")

    def is_linear(self, colour: int) -> bool:
        return self.kinds[colour] == LINEAR

    def tree(self, root: int, branches: Iterable[Tree] = ()) -> Tree:
        return Tree(root, branches, self.kinds[root])

    @property
    def leaders(self) -> Colours:
        """For each colour the first one that admits the same branches."""
        first: dict[tuple[Colours, VertexKind], int] = {}
        natures = zip(self.branches, self.kinds, strict=True)
        return tuple(first.setdefault(nature, l) for l, nature in enumerate(natures))


Counts: TypeAlias = tuple[int, ...]


def counts_upto(admissible: Admissible, order: int) -> list[Counts]:
    """Admissible trees of order n ≤ ``order`` with root colour l, as ``counts[n - 1][l]``.

    >>> counts_upto(Admissible.of(2, [[False, True], [True, True]]), 3)
    [(1, 1), (1, 2), (3, 6)]
    """
    leaders = admissible.leaders
    growing = _grown(admissible, leaders, order)
    of_leader = {l: [int(x.trees(n)) for n in range(1, order + 1)] for l, x in growing.items()}
    by_root = [of_leader[leader] for leader in leaders]
    return [*zip(*by_root, strict=True)]


def count_by_root(
    colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()
) -> Counts:
    """The number of N-trees of one order for each root colour; TreeError for an order below 1."""
    return counts_of(Admissible.of(colours, edges, linear), order)


def counts_of(admissible: Admissible, order: int) -> Counts:
    leaders = admissible.leaders
    growing = _grown(admissible, leaders, order)
    return tuple(int(growing[leader].trees(order)) for leader in leaders)


def _grown(admissible: Admissible, leaders: Sequence[int], order: int) -> dict[int, _Growing]:
    """For each leader the forests of order 0, …, order - 1 that it may carry."""
    if order < 1:
        message = f"the order of a tree is at least 1, not {order}"
        raise TreeError(message, "ask for order 1 or more")
    growing: dict[int, _Growing] = {}
    for leader in dict.fromkeys(leaders):
        branches = Counter(leaders[m] for m in admissible.branches[leader])
        growing[leader] = _Growing(order, branches, admissible.kinds[leader])
    block = order
    while block > SHORT:
        block = (block + 1) // 2
    for start in range(0, order, block):
        end = min(start + block, order)
        for n in range(max(start, 1), end):
            for one in growing.values():
                one.see(n, growing)
            for one in growing.values():
                one.grow(n, start)
        for one in growing.values():
            one.spread(end, block)
    return growing


class _Growing:
    def __init__(self, order: int, branches: Counter[int], kind: VertexKind) -> None:
        self.branches = branches
        self.kind = kind
        self.has_several = SEVERAL in kind.arity
        # of any number of branches, where there may be several; else of one at most
        self.f = [fmpz(1)]
        # the trees of each order that may be branches
        self.t = [fmpz(0)]
        # the sums c(n), complete up to the last t
        self.c = [fmpz(0)] * order
        # the part of Σ c(k) f(n - k), 0 < k < n, of blocks that are done
        self.sums = [fmpz(0)] * order

    def trees(self, n: int) -> fmpz:
        rest = n - self.kind.weight
        arity = self.kind.arity
        if rest <= 0:
            return fmpz(rest == 0 and 0 in arity)
        if 1 in arity:
            return self.f[rest]
        return self.f[rest] - self.t[rest] if self.has_several else fmpz(0)

    def see(self, n: int, growing: dict[int, _Growing]) -> None:
        t = fmpz(0)
        for leader, many in self.branches.items():
            t += many * growing[leader].trees(n)
        self.t.append(t)
        if self.has_several:
            for multiple in range(n, len(self.c), n):
                self.c[multiple] += n * t

    def grow(self, n: int, start: int) -> None:
        """Counts the forests of n vertices; blocks before ``start`` have contributed."""
        if not self.has_several:
            self.f.append(self.t[n])
            return
        f = self.f
        c = self.c
        total = self.sums[n] + c[n]
        if start:
            for k in range(start, n):
                total += c[k] * f[n - k]
                total += f[k] * c[n - k]
        else:
            for k in range(1, n):
                total += c[k] * f[n - k]
        f.append(total // n)

    def spread(self, end: int, block: int) -> None:
        """Adds the contributions of the blocks before ``end`` to the sums of later orders.

        ``end`` is the middle of one interval [start, stop) among those that halve [0, 2^k block).
        Every pair of orders i and j = n - i has one interval with max(i, j) in the first half and n
        in the second, so it is counted once. Unless the interval begins at 0, j is below its
        length, hence below ``start``.
        """
        done = end // block
        half = (done & -done) * block  # the largest power of two that divides ``done``
        start = end - half
        stop = min(end + half, len(self.c))
        if not self.has_several or stop <= end:
            return
        f = self.f
        c = self.c
        if start:
            near = stop - start
            late_f = fmpz_poly(f[start:end])
            late_c = fmpz_poly(c[start:end])
            product = late_f * fmpz_poly(c[:near])
            product += late_c * fmpz_poly(f[:near])
        else:
            product = fmpz_poly(f) * fmpz_poly(c[:end])
        later = product.coeffs()[half:]
        # what reaches beyond ``stop`` belongs to larger intervals
        for n, coefficient in zip(range(end, stop), later, strict=False):
            self.sums[n] += coefficient


def count_trees(
    colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()
) -> int:
    """The number of N-trees of one order.

    >>> [count_trees(1, n) for n in range(1, 9)]
    [1, 1, 2, 4, 9, 20, 48, 115]
    >>> count_trees(4, 8)
    4027360
    """
    return sum(count_by_root(colours, order, edges, linear))
