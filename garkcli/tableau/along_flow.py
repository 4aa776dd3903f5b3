"""Methods that use derivatives of f along the solution, and their tableaus."""

from __future__ import annotations

from math import factorial
from typing import TypeVar

from flint import fmpq

from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Matrix, Vector, dot
from garkcli.frozen import Frozen
from garkcli.tableau.forms import gark
from garkcli.tableau.stages import Jets, PointSpace
from garkcli.tableau.tableau import Colour, Tableau, butcher

Weights = tuple[Vector, ...]
T = TypeVar("T", bound="AlongFlow")


class AlongFlow(Frozen):
    """A method that uses derivatives of f along the solution, f_1 = f, f_2 = f' f, …

    ``A`` has their matrices, of shape (s, s), and ``b`` their weights; ``c`` is None for row sums
    of the first.
    """

    A: tuple[Matrix, ...]
    b: Weights
    c: Vector | None = None

    @classmethod
    def of(cls: type[T], tableau: Tableau) -> T:
        """The inverse of ``tableau``: ``of(method.tableau(n)) == method``, with its nodes."""
        space = jets_of(tableau)
        firsts = range(0, space.stages, space.order)
        rows = [weights_of(tableau.blocks[0, 0][i], space) for i in firsts]
        A = tuple(zip(*rows, strict=True))
        c = tuple(space.nodes[i] for i in firsts)
        return cls(A, weights_of(tableau.colours[0].b, space), c)

    @property
    def nodes(self) -> Vector:
        return _sums(self.A[0]) if self.c is None else self.c

    @property
    def additive(self) -> Tableau:
        """The method with a colour for each f_k on shared stages; its coefficients are those of
        h^k.
        """
        pairs = enumerate(zip(self.A, self.b, strict=True))
        colours, blocks = [], {}
        for k, (A, b) in pairs:
            colours.append(Colour(str(k + 1), 0, b, self.nodes, term=k))
            blocks[0, k] = A
        return Tableau((PointSpace(self.nodes),), tuple(colours), blocks)

    @property
    def on_test_equation(self) -> Tableau:
        """The Runge–Kutta method with the same R(z), with f_k = λ^k y.

        Its stages are 1, then Y_i, and 1 + z^{k−1} Y_i = 1 + z ((1 + z^{k−2} Y_i) − 1).
        """
        s, n = len(self.b[0]), len(self.A)

        def row(weights: Weights) -> Vector:
            later = [x for of_k in weights[1:] for x in of_k]
            return (-sum(later, start=ZERO), *weights[0], *later)

        def before(i: int, k: int) -> Vector:
            """The weights of 1 + z^{k−1} Y_i."""
            places = [(j, l) for l in range(1, n + 1) for j in range(s)]
            chosen = [ONE if place == (i, k - 1) else ZERO for place in places]
            return (-ONE if k > 2 else ZERO, *chosen)

        rows = [row(tuple(A[i] for A in self.A)) for i in range(s)]
        rows += [before(i, k) for k in range(2, n + 1) for i in range(s)]
        return gark([butcher(((ZERO,) * (n * s + 1), *rows), row(self.b))], {})


def jets_of(tableau: Tableau) -> Jets:
    space = tableau.spaces[0]  # time may be beside it
    assert isinstance(space, Jets)
    return space


def flow_nodes(order: int) -> tuple[fmpq, ...]:
    """Nodes on the exact solution, relative to its beginning: 0, 1, −1, 2, …"""
    return tuple(fmpq((n + 1) // 2 * (1 if n % 2 else -1)) for n in range(order))


def weights_of(row: Vector, space: Jets) -> Weights:
    nodes = flow_nodes(space.order)
    parts = [row[i : i + space.order] for i in range(0, len(row), space.order)]
    weights = []
    for k in range(space.derivatives):
        powers = [x**k * fmpq(1, factorial(k)) for x in nodes]
        weights.append(tuple(dot(part, powers) for part in parts))
    return tuple(weights)


def _sums(matrix: Matrix) -> Vector:
    return tuple(sum(row, start=ZERO) for row in matrix)
