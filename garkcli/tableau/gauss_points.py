"""Gauss methods of many stages on their nodes, in balls.

With the Legendre polynomials p_k that are orthonormal on [0, 1], W_ik = p_k(c_i) and the quadrature
weights B = diag(b), Wᵀ B W = I, and integration from 0 to x is tridiagonal:

    A = W X Wᵀ B,  x_00 = 1/2,  x_{k,k−1} = −x_{k−1,k} = ξ_k = 1/(2 √(4k² − 1)).

The product needs no more bits than the result; Vandermonde matrices need sixteen a stage more.
E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, IV.5.
"""

from __future__ import annotations

from itertools import pairwise

from flint import arb, arb_mat, ctx, fmpq, fmpq_poly

from garkcli.tableau.polynomial_space import PolynomialSpace, integral
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau


def is_gauss(tableau: Tableau) -> bool:
    """Whether a tableau is that of collocation with Gauss nodes."""
    if tableau.size > 1 or not has_gauss_nodes(tableau.spaces[0]):
        return False
    space, colour, block = tableau.spaces[0], tableau.colours[0], tableau.block(0, 0)
    s = space.stages
    if colour.b != integral(s) or colour.c != space.nodes or block is None:
        return False
    top = fmpq_poly([0] * s + [fmpq(1, s)]) % space.modulus  # type: ignore[attr-defined]
    for i, row in enumerate(block):
        wanted = [fmpq(0)] * s
        wanted[-1] = top[i]
        if i:
            wanted[i - 1] = wanted[i - 1] + fmpq(1, i)
        if list(row) != wanted:
            return False
    return True


def has_gauss_nodes(space: StageSpace) -> bool:
    """Whether the stages are at the zeros of a Legendre polynomial."""
    if not isinstance(space, PolynomialSpace):
        return False
    legendre = fmpq_poly.legendre_p(space.stages)(fmpq_poly([-1, 2]))
    return bool(space.modulus == legendre / legendre.leading_coefficient())


def nodes_and_weights(stages: int) -> tuple[list[arb], list[arb]]:
    pairs = [arb.legendre_p_root(stages, k, weight=True) for k in reversed(range(stages))]
    return [(1 + x) / 2 for x, _ in pairs], [w / 2 for _, w in pairs]


_BITS_OF_A_STAGE = 1.3
"""The radius of p_{k+1} is less than 1 + √2 times that of p_k."""


def gauss_rows(stages: int) -> tuple[list[arb], list[list[arb]], list[arb]]:
    """c, A and b at the current precision."""
    with ctx.workprec(ctx.prec + int(_BITS_OF_A_STAGE * stages) + 8):
        c, b = nodes_and_weights(stages)
        W = [_orthonormal(x, stages) for x in c]
    c, b = [+x for x in c], [+x for x in b]  # unary plus rounds
    W = [[+x for x in row] for row in W]
    xi = [1 / (2 * arb(4 * k * k - 1).sqrt()) for k in range(1, stages)]
    moved = [_integrated(row, xi) for row in W]
    back = arb_mat([[w * row[k] for w, row in zip(b, W, strict=True)] for k in range(stages)])
    A = arb_mat(moved) * back
    return c, A.tolist(), b


def _orthonormal(x: arb, count: int) -> list[arb]:
    """p_k = √(2k + 1) P_k by (k + 1) P_{k+1} = (2k + 1) y P_k − k P_{k−1}, y = 2x − 1."""
    y = 2 * x - 1
    legendre = [arb(1), y][:count]
    for k in range(1, count - 1):
        legendre.append(((2 * k + 1) * y * legendre[k] - k * legendre[k - 1]) / (k + 1))
    return [arb(2 * k + 1).sqrt() * value for k, value in enumerate(legendre)]


def _integrated(row: list[arb], xi: list[arb]) -> list[arb]:
    """A row of W times X."""
    integral_row = [arb(0) for _ in row]
    integral_row[0] = row[0] / 2
    for k, (x, (before, after)) in enumerate(zip(xi, pairwise(row), strict=True)):
        integral_row[k] = integral_row[k] + after * x
        integral_row[k + 1] = integral_row[k + 1] - before * x
    return integral_row
