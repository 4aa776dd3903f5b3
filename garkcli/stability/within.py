"""Stability of methods with rounded coefficients: what is true of all methods within a tolerance.

Every coefficient that is not zero in the file is a ball of the radius of the tolerance. What
follows for all numbers in the balls is decided; the rest is not, and is never guessed. One thing
more is used: the order p that the method has within its tolerance is taken for its order, so that
|R(iy)|² = 1 + O(y^(p+1)) and the first coefficients of the E-polynomial are zero and not noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from flint import arb, arb_mat, arb_poly, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.roots import sign
from garkcli.graph import components
from garkcli.stability.bounds import OPEN, Bounds, first_failure
from garkcli.stability.ssp_within import ssp_within
from garkcli.stepping.stage_system import StageSystem, stage_system
from garkcli.tableau.tableau import Tableau

BITS = 256
"""Precision of the balls; far below any tolerance that files have."""
MOST_PIECES = 4000
"""Pieces of an interval on which a sign is tried before it is left undecided."""


@dataclass(frozen=True)
class StabilityWithin:
    """What holds for all methods within a tolerance; None where that is not decided.

    Attributes:
        a_stable: A-stability.
        l_stable: A-stability with R(∞) = 0.
        real: the end of the interval of −z with |R(z)| ≤ 1 that begins at 0.
        imaginary: the end of the interval of y² with |R(iy)| ≤ 1 that begins at 0.
        ssp: the SSP coefficient.
    """

    a_stable: bool | None
    l_stable: bool | None
    real: Bounds
    imaginary: Bounds
    ssp: Bounds


def stability_within(
    tableau: Tableau, shares: Sequence[Number], tolerance: fmpq, order: int
) -> StabilityWithin:
    """What is decided of R and of the SSP coefficient of a method with rounded coefficients.

    Args:
        tableau: the method, one coordinate a stage.
        shares: w_l with λ_l = w_l λ, one a colour.
        tolerance: the largest error of a coefficient that is not zero.
        order: the order that the method has within the tolerance.
    """
    before = ctx.prec
    try:
        ctx.prec = BITS
        system = stage_system(tableau, [((w,),) for w in shares])
        P, Q = _fraction(system, _summands(tableau, shares), tolerance)
        stiff = is_stiffly_accurate(tableau, shares)
        bounded = _is_bounded(P, Q, order, stiff)
        right = _poles_are_right(Q)
        if right is False and not _are_coprime(P, Q):
            right = None  # the root on the left may cancel and be no pole
        a_stable = _both(bounded, right)
        return StabilityWithin(
            a_stable=a_stable,
            l_stable=_both(a_stable, _vanishes_at_infinity(P, Q, stiff)),
            real=_real_end(P, Q),
            imaginary=_imaginary_end(P, Q, order),
            ssp=ssp_within(tableau, shares, tolerance),
        )
    finally:
        ctx.prec = before


def _both(first: bool | None, second: bool | None) -> bool | None:
    """Whether both hold, where one that fails decides."""
    if first is False or second is False:
        return False
    return True if first and second else None


def is_stiffly_accurate(tableau: Tableau, shares: Sequence[Number]) -> bool:
    """Whether a stage is the step, a_ij^{k,m} = b_j^{m} for every colour m that is driven.

    Then R(∞) = 0 where W is regular. Equal coefficients of the file are equal numbers, whatever
    was rounded; equal sums of coefficients of several colours are a chance.

    Args:
        tableau: the method, one coordinate a stage.
        shares: w_l with λ_l = w_l λ; colours with 0 are not driven.
    """
    driven = [m for m, share in enumerate(shares) if share]
    for k in {tableau.colours[m].space for m in driven}:
        for i in range(tableau.spaces[k].stages):
            if all(_is_new_value(tableau, k, i, m) for m in driven):
                return True
    return False


def _is_new_value(tableau: Tableau, k: int, i: int, m: int) -> bool:
    """Whether stage i of space k sees colour m with its weights."""
    weights = tuple(tableau.colours[m].b)
    block = tableau.blocks.get((k, m))
    if block is None:
        return not any(weights)
    return tuple(block[i]) == weights


def _summands(tableau: Tableau, shares: Sequence[Number]) -> StageSystem:
    """How many coefficients each entry of the system is the sum of, each counted |w_l| times.

    Coefficients of colours with the same stages are added. Zeros are structure and do not count.
    """
    blocks = {key: tuple(map(_ones, block)) for key, block in tableau.blocks.items()}
    colours = tuple(replace(colour, b=_ones(colour.b)) for colour in tableau.colours)
    sizes: list[Matrix] = []
    for w in shares:
        size = -w if w and sign(w) < 0 else w
        sizes.append(((size,),))
    return stage_system(replace(tableau, blocks=blocks, colours=colours), sizes)


def _ones(row: Vector) -> Vector:
    return tuple(ONE if x else ZERO for x in row)


def _fraction(
    system: StageSystem, summands: StageSystem, tolerance: fmpq
) -> tuple[list[arb], list[arb]]:
    """The coefficients of P and Q as balls."""
    W = []
    for row, counts in zip(system.W, summands.W, strict=True):
        W.append(_widened(row, counts, tolerance))
    b = _widened(system.B[0], summands.B[0], tolerance)
    n = len(W)
    edges = {i: [j for j in range(n) if summands.W[i][j]] for i in range(n)}
    Q = arb_poly([1])
    for component in components(edges):
        block = arb_mat([[W[i][j] for j in component] for i in component])
        Q = Q * arb_poly(_characteristic(block)[::-1])
    series = [arb(1)]
    state = arb_mat([[to_ball(x)] for (x,) in system.E])
    matrix, weights = arb_mat(W), arb_mat([b])
    for _ in range(n):
        series.append((weights * state)[0, 0])
        state = matrix * state
    product = Q * arb_poly(series)
    return [product[k] for k in range(n + 1)], [Q[k] for k in range(len(Q))]


def _characteristic(block: arb_mat) -> list[arb]:
    """The coefficients of the characteristic polynomial, from the lowest."""
    if block.nrows() == 1:
        return [-block[0, 0], arb(1)]
    return list(block.charpoly().coeffs())


def _widened(row: Vector, counts: Vector, tolerance: fmpq) -> list[arb]:
    """Sums of ``counts`` coefficients with their rounding; what is a sum of none is zero."""
    found = []
    for x, count in zip(row, counts, strict=True):
        ball = to_ball(x, BITS // 4)
        if count:
            radius = to_ball(count, BITS // 4) * arb(tolerance)
            ball += arb(0, radius.upper())
        found.append(ball)
    return found


def _is_bounded(P: list[arb], Q: list[arb], order: int, stiff: bool) -> bool | None:
    """Whether |R(iy)| ≤ 1 for all real y."""
    E = _margin(P, Q, order)
    while E and E[-1].is_zero():
        E.pop()
    first = next((k for k, a in enumerate(E) if not a.is_zero()), None)
    if first is None:
        return None
    rest = E[first:]
    if rest[0] < 0 or rest[-1] < 0:  # near 0 or far away
        return False
    if stiff and rest[-1].contains(0):
        return None
    return _is_positive(rest)


def _margin(P: list[arb], Q: list[arb], order: int) -> list[arb]:
    """The coefficients of E in y²; those that are zero by the order are zero."""
    E = _difference(_squared(Q), _squared(P))
    for k in range(min(order // 2 + 1, len(E))):
        if E[k].contains(0):
            E[k] = arb(0)
    return E


def _real_end(P: list[arb], Q: list[arb]) -> Bounds:
    """The end of the interval of −z on which |R| ≤ 1."""
    p, q = (arb_poly([a * (-1) ** k for k, a in enumerate(f)]) for f in (P, Q))
    margin = q * q - p * p
    # the constants of P and Q are 1: that of the margin is zero
    others = [margin[k] for k in range(1, len(margin))]
    return first_failure([arb(0), *others])


def _imaginary_end(P: list[arb], Q: list[arb], order: int) -> Bounds:
    """The end of the interval of y² on which |R(iy)| ≤ 1."""
    E = _margin(P, Q, order)
    # rounding hides whether all coefficients are zero
    return OPEN if all(a.is_zero() for a in E) else first_failure(E)


def _squared(p: list[arb]) -> list[arb]:
    """|p(iy)|² as a polynomial in y²."""
    real = arb_poly([a * (-1) ** k for k, a in enumerate(p[0::2])])
    imaginary = arb_poly([a * (-1) ** k for k, a in enumerate(p[1::2])])
    total = real * real + arb_poly([0, 1]) * imaginary * imaginary
    return [total[k] for k in range(len(total))]


def _difference(a: list[arb], b: list[arb]) -> list[arb]:
    n = max(len(a), len(b))
    zero = arb(0)
    return [
        (a[k] if k < len(a) else zero) - (b[k] if k < len(b) else zero)
        for k in range(n)
    ]


def _is_positive(coefficients: list[arb]) -> bool | None:
    """Whether a polynomial is positive for all x > 0: on (0, 1], and reversed on (0, 1]."""
    near = _sign_on_unit_interval(coefficients)
    far = _sign_on_unit_interval(coefficients[::-1])
    return _both(near, far)


def _sign_on_unit_interval(coefficients: list[arb]) -> bool | None:
    """Whether it is positive on [0, 1]: True, False where a value is negative, None undecided.

    Pieces are halved until the enclosure of the polynomial on each has a sign.
    """
    p = arb_poly(coefficients)
    pieces = [(fmpq(0), fmpq(1))]
    tried = 0
    while pieces:
        low, high = pieces.pop()
        tried += 1
        if tried > MOST_PIECES:
            return None
        value = p(arb((low + high) / 2, (high - low) / 2))
        if value > 0:
            continue
        middle = (low + high) / 2
        if p(arb(middle)) < 0:
            return False
        pieces += [(low, middle), (middle, high)]
    return True


def _poles_are_right(Q: list[arb]) -> bool | None:
    """Whether all roots of Q have positive real parts, by Routh's scheme of Q(−z)."""
    mirrored = [a * (-1) ** k for k, a in enumerate(Q)][::-1]
    while mirrored and mirrored[0].is_zero():
        mirrored.pop(0)
    upper, lower = mirrored[0::2], mirrored[1::2]
    signs = [upper[0]]
    while lower:
        if lower[0].contains(0):
            return None
        signs.append(lower[0])
        factor = upper[0] / lower[0]
        following = [
            upper[k + 1] - factor * (lower[k + 1] if k + 1 < len(lower) else arb(0))
            for k in range(len(upper) - 1)
        ]
        upper, lower = lower, following
    if all(x > 0 for x in signs) or all(x < 0 for x in signs):
        return True
    return None if any(x.contains(0) for x in signs) else False


def _are_coprime(P: list[arb], Q: list[arb]) -> bool:
    """Whether P and Q have no common root for any of the numbers in the balls.

    That is what a resultant without zero says: the determinant of the Sylvester matrix.
    """
    p, q = len(P) - 1, len(Q) - 1
    size = p + q
    if size == 0:
        return True
    zero = arb(0)
    rows = []
    for k in range(q):
        after = size - p - 1 - k
        rows.append([zero] * k + P + [zero] * after)
    for k in range(p):
        after = size - q - 1 - k
        rows.append([zero] * k + Q + [zero] * after)
    return not arb_mat(rows).det().contains(0)


def _vanishes_at_infinity(P: list[arb], Q: list[arb], stiff: bool) -> bool | None:
    is_regular = len(Q) == len(P) and not Q[-1].contains(0)
    if stiff and is_regular:
        return True
    top = P[len(Q) - 1] if len(P) >= len(Q) else arb(0)
    if top.is_zero():
        return True
    return None if top.contains(0) else False
