"""R(z) = P/Q of methods with rounded coefficients: P and Q with balls as coefficients.

A coefficient that is not zero in the file is a ball of the radius of the tolerance; zeros are
structure. The precision is that of the caller.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from flint import arb, arb_mat, arb_poly, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.roots import sign
from garkcli.graph import components
from garkcli.stepping.stage_system import StageSystem, stage_system
from garkcli.tableau.tableau import Tableau

BITS = 256
"""Precision of the balls; far below any tolerance that files have."""
DIGITS = BITS // 4
"""Digits of exact numbers that become balls."""


@dataclass(frozen=True)
class BallFraction:
    """R = P/Q for all methods within a tolerance, coefficients from the lowest.

    Attributes:
        P: the numerator, one coefficient more than there are unknown stage values.
        Q: the denominator det(I − zW); no longer than P.
    """

    P: list[arb]
    Q: list[arb]


def fraction_within(tableau: Tableau, shares: Sequence[Number], tolerance: fmpq) -> BallFraction:
    """P and Q of a method with rounded coefficients.

    Args:
        tableau: the method, one coordinate a stage.
        shares: w_l with λ_l = w_l λ, one a colour.
        tolerance: the largest error of a coefficient that is not zero.
    """
    fields = [((w,),) for w in shares]
    system = stage_system(tableau, fields)
    summands = _summands(tableau, shares)
    W = []
    for row, counts in zip(system.W, summands.W, strict=True):
        W.append(_widened(row, counts, tolerance))
    Q = _denominator(W, summands.W)
    b = _widened(system.B[0], summands.B[0], tolerance)
    initial = [to_ball(x) for (x,) in system.E]
    product = Q * arb_poly(_series(W, b, initial))
    degree = len(W)
    numerator = [product[k] for k in range(degree + 1)]
    return BallFraction(numerator, _coefficients(Q))


def _summands(tableau: Tableau, shares: Sequence[Number]) -> StageSystem:
    """How many coefficients each entry of the system is the sum of, each counted |w_l| times.

    Coefficients of colours with the same stages are added. Zeros are structure and do not count.
    """
    blocks: dict[tuple[int, int], Matrix] = {}
    for edge, block in tableau.blocks.items():
        blocks[edge] = tuple(_ones(row) for row in block)
    colours = []
    for colour in tableau.colours:
        ones = _ones(colour.b)
        colours.append(replace(colour, b=ones))
    counted = replace(tableau, blocks=blocks, colours=tuple(colours))
    sizes: list[Matrix] = []
    for w in shares:
        is_negative = bool(w) and sign(w) < 0
        size = -w if is_negative else w
        sizes.append(((size,),))
    return stage_system(counted, sizes)


def _ones(row: Vector) -> Vector:
    return tuple(ONE if x else ZERO for x in row)


def _widened(row: Vector, counts: Vector, tolerance: fmpq) -> list[arb]:
    """Sums of ``counts`` coefficients with their rounding; what is a sum of none is zero."""
    found = []
    for x, count in zip(row, counts, strict=True):
        ball = to_ball(x, DIGITS)
        if count:
            times = to_ball(count, DIGITS)
            radius = times * arb(tolerance)
            ball += arb(0, radius.upper())
        found.append(ball)
    return found


def _denominator(W: list[list[arb]], pattern: Matrix) -> arb_poly:
    """det(I − zW), component by component of the graph of the entries that are not zero."""
    edges: dict[int, list[int]] = {}
    for i, row in enumerate(pattern):
        edges[i] = [j for j, x in enumerate(row) if x]
    Q = arb_poly([1])
    for component in components(edges):
        rows = [W[i] for i in component]
        block = [[row[j] for j in component] for row in rows]
        from_lowest = _characteristic(arb_mat(block))
        reciprocal = from_lowest[::-1]
        Q = Q * arb_poly(reciprocal)
    return Q


def _characteristic(block: arb_mat) -> list[arb]:
    """The coefficients of the characteristic polynomial, from the lowest."""
    if block.nrows() == 1:
        return [-block[0, 0], arb(1)]
    return list(block.charpoly().coeffs())


def _series(W: list[list[arb]], b: list[arb], initial: list[arb]) -> list[arb]:
    """The first coefficients of R as a power series: 1, and b W^{k−1} E."""
    series = [arb(1)]
    if not W:
        return series
    state = arb_mat([[x] for x in initial])
    matrix = arb_mat(W)
    weights = arb_mat([b])
    for _ in W:
        increment = weights * state
        series.append(increment[0, 0])
        state = matrix * state
    return series


def _coefficients(p: arb_poly) -> list[arb]:
    return [p[k] for k in range(len(p))]
