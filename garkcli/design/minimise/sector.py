"""The angle α of A(α)-stability, in degrees, as a level for searches."""

from __future__ import annotations

from math import acos, degrees

from flint import arb, ctx, fmpq, fmpz_poly

from garkcli.design.minimise.objective import ORIGIN, LevelObjective, Size
from garkcli.errors import MethodError, NotDecided
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, root_within
from garkcli.stability.linear import StabilityFunction
from garkcli.stability.sector import largest_sector

HALF_TURN = 180
RIGHT = fmpq(90)
MOST_PARTS = 720
"""Bounds are multiples of π divided by at most so many parts, a quarter of a degree."""


class Angle(LevelObjective):
    """A level y = 1 − cos α that users read as α in degrees."""

    def reaches(self, y: Size, bound: fmpq) -> bool:
        assert y is not None
        return not y < rest_of_cosine(bound)

    def inside(self, bound: float) -> float:
        return min(super().inside(bound), float(RIGHT.p))

    def measured(self, y: Size) -> float:
        assert y is not None
        return degrees(acos(1 - float(y)))


def rest_of_cosine(angle: fmpq) -> RealRoot:
    """1 − cos α of an angle in degrees: cos qα = ±1 for a multiple α of π/q. Raises MethodError
    beyond a right angle, or if it is no multiple of a quarter of a degree.
    """
    part = angle / HALF_TURN
    if not 0 < angle <= RIGHT or part.q > MOST_PARTS:
        message = f"design: sector: {angle} is no angle up to 90 in quarters of a degree"
        raise MethodError(message, "write sector: 75", code="wanted-without-meaning")
    parts = int(part.q)
    sign = -1 if part.p % 2 else 1
    multiple = fmpz_poly.chebyshev_t(parts) - sign
    p = Polynomial([fmpq(x) for x in multiple(fmpz_poly([1, -1])).coeffs()])
    return root_within(p, lambda bits: _at(part, bits))


def _at(part: fmpq, bits: int) -> arb:
    with ctx.workprec(bits):
        return 1 - arb.cos_pi_fmpq(part)


def angle_of(R: StabilityFunction) -> Size:
    """1 − cos α for the largest sector with |R| ≤ 1; NotDecided if the degree is too large."""
    sector = largest_sector(R)
    if sector is None:
        raise NotDecided
    c = sector.cosine
    if c is None:
        return ORIGIN
    p = Polynomial([fmpq(x) for x in c.polynomial(fmpz_poly([1, -1])).coeffs()])
    return root_within(p, lambda bits: 1 - c.ball(bits))
