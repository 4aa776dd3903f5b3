"""Stability of rounded methods: of the method that is meant, known to many bits.

Coefficients of polynomials are balls. One with zero in it counts as zero: so narrow a ball contains
it only if the coefficient vanishes. Statements are decided if they hold for all other numbers.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, arb_mat, arb_poly, ctx, fmpq

from garkcli.exact.display import digits_here, to_ball
from garkcli.exact.enclosing import bits_for
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.polynomial import squared_on_axis
from garkcli.exact.roots import sign
from garkcli.frozen import Frozen, replace
from garkcli.graph import components
from garkcli.stability import ball_polynomials
from garkcli.stability.algebraic import rounded_balls, snapped
from garkcli.stability.ssp import driven_part, stacked
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau


class BallFraction(Frozen):
    """R = P/Q of a rounded method, lowest coefficient first; Q is det(I − zW), P no shorter."""

    P: list[arb]
    Q: list[arb]


def fraction_within(tableau: Tableau, shares: Sequence[Number], tolerance: fmpq) -> BallFraction:
    """Returns P and Q of a rounded method on point stages; ``shares`` are w_l with λ_l = w_l λ."""
    system = stage_system(tableau, [((w,),) for w in shares])
    # how many coefficients each entry of the system is the sum of, each counted |w_l| times
    blocks = {edge: tuple(map(_ones, block)) for edge, block in tableau.blocks.items()}
    colours = tuple(replace(colour, b=_ones(colour.b)) for colour in tableau.colours)
    sizes = [((-w if sign(w) < 0 else w,),) for w in shares]
    summands = stage_system(replace(tableau, blocks=blocks, colours=colours), sizes)
    W = [_widened(row, counts, tolerance) for row, counts in zip(system.W, summands.W, strict=True)]
    Q = _reciprocal(summands.W, arb_mat(W) if W else arb_mat(0, 0))
    b = _widened(system.B[0], summands.B[0], tolerance)
    product = Q * arb_poly(_series(W, b, [to_ball(x) for (x,) in system.E]))
    P = [snapped(product[k]) for k in range(len(W) + 1)]
    denominator = [snapped(Q[k]) for k in range(len(Q))]
    while len(denominator) > 1 and denominator[-1].is_zero():
        denominator.pop()
    while len(P) > len(denominator) and P[-1].is_zero():
        P.pop()
    return BallFraction(P, denominator)


def _ones(row: Vector) -> Vector:
    return tuple(ONE if x else ZERO for x in row)


def _widened(row: Vector, counts: Vector, tolerance: fmpq) -> list[arb]:
    """Sums of ``counts`` coefficients with their rounding; an empty sum is exactly zero."""
    digits, sums = digits_here(), []
    for x, count in zip(row, counts, strict=True):
        radius = to_ball(count, digits) * arb(tolerance)
        sums.append(to_ball(x, digits) + arb(0, radius.upper()))
    return sums


def _reciprocal(pattern: Matrix, W: arb_mat) -> arb_poly:
    """det(I − zW), by components of the graph of the nonzero entries."""
    edges = {i: [j for j, x in enumerate(row) if x] for i, row in enumerate(pattern)}
    product = arb_poly([1])
    for component in components(edges):
        block = arb_mat([[W[i, j] for j in component] for i in component])
        reciprocal = [arb(1), -block[0, 0]]
        if len(component) > 1:
            reciprocal = list(block.charpoly().coeffs())[::-1]
        product = product * arb_poly(reciprocal)
    return product


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


def ssp_within(
    tableau: Tableau, shares: Sequence[Number], tolerance: fmpq
) -> ball_polynomials.Bounds:
    """Brackets the first failure of any condition of ``garkcli.stability.ssp``."""
    pattern, parts = stacked(*driven_part(tableau, shares))
    n = len(pattern)
    K = arb_mat(n, n)
    vectors = [[arb(1)] * n]
    driven = [share for share in shares if share]
    for share, part in zip(driven, parts, strict=True):
        wide = arb_mat([rounded_balls(row, tolerance) for row in part])
        K += wide * to_ball(share, digits_here())
        columns = wide.transpose().tolist()
        vectors += [column for column in columns if not all(x.is_zero() for x in column)]
    denominator = _reciprocal(pattern, -K)
    conditions = [[denominator[k] for k in range(len(denominator))]]
    for vector in vectors:
        conditions += _numerators(denominator, K, vector)
    least = ball_polynomials.UNLIMITED
    for condition in conditions:
        least = ball_polynomials.least(
            [least, ball_polynomials.first_failure(condition, least.high)]
        )
    return least


def _numerators(denominator: arb_poly, matrix: arb_mat, vector: list[arb]) -> list[list[arb]]:
    n = len(vector)
    state = arb_mat([[x] for x in vector])
    series: list[list[arb]] = [[] for _ in range(n)]
    for _ in range(n + 1):
        for i in range(n):
            series[i].append(state[i, 0])
        state = -(matrix * state)
    products = [denominator * arb_poly(terms) for terms in series]
    return [[product[k] for k in range(n + 1)] for product in products]


class StabilityWithin(Frozen):
    """Stability of a rounded method; None stands for undecided. Both ends are of intervals from 0
    on: of −z with |R(z)| ≤ 1, and of y² with |R(iy)| ≤ 1.
    """

    a_stable: bool | None
    l_stable: bool | None
    real: ball_polynomials.Bounds
    imaginary: ball_polynomials.Bounds
    ssp: ball_polynomials.Bounds


def stability_within(
    tableau: Tableau, shares: Sequence[Number], tolerance: fmpq
) -> StabilityWithin:
    """Returns the decided results of a rounded method on point stages; ``shares`` are the w_l."""
    with ctx.workprec(bits_for(tolerance)):
        R = fraction_within(tableau, shares, tolerance)
        E = _margin(R)
        a_stable, l_stable = stiff_stability_within(tableau, shares, tolerance)
        return StabilityWithin(
            a_stable=a_stable,
            l_stable=l_stable,
            real=_real_end(R),
            imaginary=ball_polynomials.first_failure(E),
            ssp=ssp_within(tableau, shares, tolerance),
        )


def stiff_stability_within(
    tableau: Tableau, shares: Sequence[Number], tolerance: fmpq
) -> tuple[bool | None, bool | None]:
    """Whether a method is A-stable and whether it is L-stable, within a tolerance."""
    with ctx.workprec(bits_for(tolerance)):
        R = fraction_within(tableau, shares, tolerance)
        a_stable = ball_polynomials.both(_is_bounded(_margin(R)), _poles_are_right(R))
        return a_stable, ball_polynomials.both(
            a_stable, len(R.P) < len(R.Q) or R.P[len(R.Q) - 1].is_zero()
        )


def _margin(R: BallFraction) -> list[arb]:
    return [*map(snapped, ball_polynomials.difference(squared_on_axis(R.Q), squared_on_axis(R.P)))]


def _is_bounded(E: Sequence[arb]) -> bool | None:
    rest = list(E)
    while rest and rest[-1].is_zero():
        rest.pop()
    while rest and rest[0].is_zero():
        rest.pop(0)
    if not rest:
        return True
    if rest[0] < 0 or rest[-1] < 0:
        return False
    return ball_polynomials.is_positive(rest)


def _poles_are_right(R: BallFraction) -> bool | None:
    found = ball_polynomials.poles_are_right(R.Q)
    if found is False and not ball_polynomials.are_coprime(R.P, R.Q):
        return None  # the root on the left may cancel and be no pole
    return found


def _real_end(R: BallFraction) -> ball_polynomials.Bounds:
    P = arb_poly(ball_polynomials.mirrored(R.P))
    Q = arb_poly(ball_polynomials.mirrored(R.Q))
    margin = Q * Q - P * P
    # the constants of P and Q are 1: that of the margin is zero
    return ball_polynomials.first_failure(
        [arb(0), *(snapped(margin[k]) for k in range(1, len(margin)))]
    )
