"""Multiderivative Runge–Kutta methods, which use derivatives of f along the solution, as tableaus.

    Y_i = y + Σ_k h^k Σ_j a^k_ij f_k(Y_j),        y_1 = y + Σ_k h^k Σ_j b^k_j f_k(Y_j),

with f_1 = f and f_{k+1} = f_k' f. So h^k f_k(Y_j) is a derivative of h f along the exact solution
through Y_j. Collocation with n nodes in its place changes no condition up to order n:
docs/exact-order.md, section 13.

K. H. Kastlunger, G. Wanner, Computing 9 (1972) 9; R. P. K. Chan, A. Y. J. Tsai, Numer. Algorithms
53 (2010) 171.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from math import factorial, perm

from garkcli.constructions.composition import MAX_STAGES, refuse_large
from garkcli.constructions.infinitesimal import collocation_at, fitting
from garkcli.errors import counted
from garkcli.exact.display import to_float
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Vector
from garkcli.tableau.along_flow import AlongFlow, Weights, flow_nodes, jets_of, weights_of
from garkcli.tableau.stages import Jets, PointSpace
from garkcli.tableau.tableau import Colour, Method, Tableau


class Derivatives(AlongFlow):
    def tableau(self, order: int) -> Tableau:
        """Returns a tableau with the conditions of the method up to an order."""
        flow = _flow(order)
        rows: list[Vector] = []
        for i in range(len(self.b[0])):
            own = self.at_points(tuple(A[i] for A in self.A), order)
            before, after = own[: i * order], own[(i + 1) * order :]
            inside = own[i * order : (i + 1) * order]
            for along in flow.A:
                seen = tuple(x + y for x, y in zip(inside, along, strict=True))
                rows.append((*before, *seen, *after))
        points = tuple(c + x for c in self.nodes for x in flow.c)
        space = Jets(points, order, len(self.A))
        colour = Colour("1", 0, self.at_points(self.b, order), points)
        return Tableau((space,), (colour,), {(0, 0): tuple(rows)})

    @staticmethod
    def at_points(weights: Weights, order: int) -> Vector:
        return tuple(
            sum((x * y[n] for x, y in zip(column, _derivatives(order), strict=False)), start=ZERO)
            for column in zip(*weights, strict=True)
            for n in range(order)
        )

    def arrays(self, count: int) -> tuple[Tableau, ...]:
        """Returns the arrays of ``count`` derivatives f_k, with zeros for unused ones."""
        s = len(self.b[0])
        zeros = (ZERO,) * s
        unused = [((zeros,) * s, zeros)] * (count - len(self.A))
        made = []
        for k, (A, b) in enumerate([*zip(self.A, self.b, strict=True), *unused]):
            nodes = self.nodes if k == 0 else zeros
            colour = Colour("f" + "'" * k, 0, b, nodes)
            made.append(Tableau((PointSpace(nodes),), (colour,), {(0, 0): A}))
        return tuple(made)

    def apparent_order(self, weights: Weights) -> int:
        """Returns the order up to which unbranched trees and quadrature fit, within rounding. It is
        finite: R(z) has degrees of at most s times the number of derivatives.
        """
        return fitting(self._sums(weights))

    def _sums(self, weights: Weights) -> Iterator[tuple[float, float]]:
        A = [[[*map(to_float, row)] for row in matrix] for matrix in self.A]
        b = [[*map(to_float, row)] for row in weights]
        c = [sum(row) for row in A[0]]
        tall = [[1.0] * len(c)]  # the coefficients of the stages on the test equation
        for q in range(1, 2 * len(A) * len(c) + 2):
            used = range(1, min(q, len(A)) + 1)
            bushy = sum(
                perm(q - 1, k - 1) * w * x ** (q - k)
                for k in used
                for w, x in zip(b[k - 1], c, strict=True)
            )
            yield sum(_dot(b[k - 1], tall[q - k]) for k in used), bushy
            tall.append([sum(_dot(A[k - 1][i], tall[q - k]) for k in used) for i in range(len(c))])


def _dot(u: Sequence[float], v: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(u, v, strict=True))


def plan(method: Derivatives, embedded: Weights | None = None) -> int:
    """Returns the apparent order plus one, or less to have fewer stages; raises MethodError."""
    stages, least = len(method.b[0]), len(method.A)
    refuse_large(stages * least, "take fewer stages")
    weights = [method.b] if embedded is None else [method.b, embedded]
    wanted = max(map(method.apparent_order, weights)) + 1
    return max(least, min(wanted, MAX_STAGES // stages))


def is_derivatives(tableau: Tableau) -> bool:
    return tableau.uses_derivatives


def embedded_of(rows: Sequence[Vector], tableau: Tableau) -> Weights:
    return weights_of(rows[0], jets_of(tableau))


def words_of(tableau: Tableau) -> str:
    space = jets_of(tableau)
    stages = counted(space.stages // space.order, "stage")
    return f"multiderivative, {counted(space.derivatives, 'derivative')}, {stages}"


@lru_cache(maxsize=32)
def _flow(order: int) -> Method:
    return collocation_at(flow_nodes(order))


@lru_cache(maxsize=32)
def _derivatives(order: int) -> tuple[Vector, ...]:
    """Returns the functionals from values at the nodes to the derivatives 0, 1, … at 0."""
    basis = list(_flow(order).space.basis_polynomials())
    return tuple(tuple(factorial(k) * polynomial[k] for polynomial in basis) for k in range(order))
