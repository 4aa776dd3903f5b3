"""Stability of methods with rounded coefficients: what is true of all methods within a tolerance.

Every coefficient that is not zero in the file is a ball of the radius of the tolerance. What
follows for all numbers in the balls is decided; the rest is not, and is never guessed. One thing
more is used: the order p that the method has within its tolerance is taken for its order, so that
|R(iy)|² = 1 + O(y^(p+1)) and the first coefficients of the E-polynomial are zero and not noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_poly, ctx, fmpq

from garkcli.exact.field import Number
from garkcli.stability.ball_signs import (
    are_coprime,
    both,
    difference,
    is_positive,
    mirrored,
    poles_are_right,
    squared_on_axis,
)
from garkcli.stability.bounds import OPEN, Bounds, first_failure
from garkcli.stability.fraction_within import BITS, BallFraction, fraction_within
from garkcli.stability.ssp_within import ssp_within
from garkcli.tableau.tableau import Tableau


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
    with ctx.workprec(BITS):
        R = fraction_within(tableau, shares, tolerance)
        E = _margin(R, order)
        is_stiff = is_stiffly_accurate(tableau, shares)
        a_stable = both(_is_bounded(E, is_stiff), _poles_are_right(R))
        vanishes = _vanishes_at_infinity(R, is_stiff)
        return StabilityWithin(
            a_stable=a_stable,
            l_stable=both(a_stable, vanishes),
            real=_real_end(R),
            imaginary=_imaginary_end(E),
            ssp=ssp_within(tableau, shares, tolerance),
        )


def is_stiffly_accurate(tableau: Tableau, shares: Sequence[Number]) -> bool:
    """Whether a stage is the step, a_ij^{k,m} = b_j^{m} for every colour m that is driven.

    Then R(∞) = 0 where W is regular. Equal coefficients of the file are equal numbers, whatever
    was rounded; equal sums of coefficients of several colours are a chance.

    Args:
        tableau: the method, one coordinate a stage.
        shares: w_l with λ_l = w_l λ; colours with 0 are not driven.
    """
    driven = [m for m, share in enumerate(shares) if share]
    used_spaces = {tableau.colours[m].space for m in driven}
    for k in used_spaces:
        for i in range(tableau.spaces[k].stages):
            if all(_has_weights_of(tableau, k, i, m) for m in driven):
                return True
    return False


def _has_weights_of(tableau: Tableau, k: int, i: int, m: int) -> bool:
    """Whether stage i of space k sees colour m with its weights."""
    weights = tuple(tableau.colours[m].b)
    block = tableau.blocks.get((k, m))
    if block is None:
        return not any(weights)
    return tuple(block[i]) == weights


def _margin(R: BallFraction, order: int) -> list[arb]:
    """The coefficients of E in y²; those that are zero by the order are zero."""
    E = difference(squared_on_axis(R.Q), squared_on_axis(R.P))
    zeros = order // 2 + 1
    for k, a in enumerate(E[:zeros]):
        if a.contains(0):
            E[k] = arb(0)
    return E


def _is_bounded(E: Sequence[arb], is_stiff: bool) -> bool | None:
    """Whether |R(iy)| ≤ 1 for all real y."""
    rest = list(E)
    while rest and rest[-1].is_zero():
        rest.pop()
    while rest and rest[0].is_zero():
        rest.pop(0)
    if not rest:
        return None
    near, far = rest[0], rest[-1]
    if near < 0 or far < 0:
        return False
    if is_stiff and far.contains(0):
        return None
    return is_positive(rest)


def _poles_are_right(R: BallFraction) -> bool | None:
    """Whether all poles have positive real parts."""
    found = poles_are_right(R.Q)
    if found is False and not are_coprime(R.P, R.Q):
        return None  # the root on the left may cancel and be no pole
    return found


def _real_end(R: BallFraction) -> Bounds:
    """The end of the interval of −z on which |R| ≤ 1."""
    P = arb_poly(mirrored(R.P))
    Q = arb_poly(mirrored(R.Q))
    margin = Q * Q - P * P
    # the constants of P and Q are 1: that of the margin is zero
    others = [margin[k] for k in range(1, len(margin))]
    return first_failure([arb(0), *others])


def _imaginary_end(E: Sequence[arb]) -> Bounds:
    """The end of the interval of y² on which |R(iy)| ≤ 1."""
    # rounding hides whether all coefficients are zero
    if all(a.is_zero() for a in E):
        return OPEN
    return first_failure(list(E))


def _vanishes_at_infinity(R: BallFraction, is_stiff: bool) -> bool | None:
    """Whether R(∞) = 0."""
    size = len(R.Q)
    is_regular = size == len(R.P) and not R.Q[-1].contains(0)
    if is_stiff and is_regular:
        return True
    if len(R.P) < size or R.P[size - 1].is_zero():
        return True
    if R.P[size - 1].contains(0):
        return None
    return False
