"""What ``gark stability`` prints of one file, and algebraic numbers in decimals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import arb, ctx

from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import BITS_A_DIGIT, ball_decimal
from garkcli.exact.roots import RealRoot
from garkcli.stability.slow_interval import SlowInterval
from garkcli.stability.summary import Stability
from garkcli.stability.two_frequencies import TwoFrequencies
from garkcli.tableau.garkmethod import Derivation

if TYPE_CHECKING:
    from garkcli.stability.springs_plane import SpringsPlane


@dataclass(frozen=True)
class StabilityReport:
    """What is printed of one file.

    Attributes:
        file: its path as given.
        name: the name of the method.
        found: its stability.
        springs: the two-frequency problem where it was asked for.
        digits: decimals of algebraic numbers.
        plane: both frequencies in floats, for a picture.
        slow: the two-frequency problem for an interval of slow frequencies.
        derivation: whether the method is the pair or the conjugate of what the file gives.
    """

    file: str
    name: str
    found: Stability
    springs: TwoFrequencies | None = None
    digits: int = 12
    plane: SpringsPlane | None = None
    slow: SlowInterval | None = None
    derivation: Derivation = ""


def factors(p: Polynomial) -> list[tuple[Polynomial, int]]:
    """The irreducible factors over ℚ, with their multiplicities; p itself over a number field."""
    if not p.is_rational or not p:
        return [(p, 1)]
    found = p.to_flint().numer().factor()[1]
    return [(Polynomial.from_flint(factor), power) for factor, power in found]


def degrees(cosine: RealRoot, digits: int) -> str:
    """The angle of a cosine, in degrees."""
    bits = int(digits * BITS_A_DIGIT) + 64
    before = ctx.prec
    try:
        ctx.prec = bits
        angle = cosine.ball(bits).acos() * 180 / arb.pi()
        return ball_decimal(angle, digits)
    finally:
        ctx.prec = before


def square_root(root: RealRoot, digits: int) -> str:
    """The square root of a number that is not negative, as a decimal."""
    bits = int(digits * BITS_A_DIGIT) + 64
    before = ctx.prec
    try:
        ctx.prec = bits
        return ball_decimal(root.ball(bits).sqrt(), digits)
    finally:
        ctx.prec = before
