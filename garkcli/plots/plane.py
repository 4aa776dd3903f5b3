"""Functions over the complex plane, in floats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from garkcli.exact.display import to_float
from garkcli.exact.polynomial import Polynomial
from garkcli.plots.contours import outlines
from garkcli.plots.scene import Point
from garkcli.stability.linear import StabilityFunction

if TYPE_CHECKING:
    from garkcli.arrays import Array, Floats

_NODES = 300
"""Nodes a side of a grid; even, so that none is on the imaginary axis of a symmetric one, where |R|
may be 1.
"""
_FLAT = 3.0
"""What levels are cut off at, such as logarithms near zeros and poles."""
_THINNED = 0.06  # cells


@dataclass(frozen=True)
class Window:
    """A part of the complex plane."""

    left: float
    right: float
    top: float

    def grid(self) -> tuple[Floats, Floats]:
        """The real parts and the imaginary parts of the nodes."""
        x = np.linspace(self.left, self.right, _NODES)
        y = np.linspace(-self.top, self.top, _NODES)
        return x, y


def outlined(x: Floats, y: Floats, level: Floats) -> list[list[Point]]:
    """The outlines of where ``level`` ≤ 0 on the grid of x and y, with the area on their left.

    What is not a number is outside.
    """
    across, up = float(x[1] - x[0]), float(y[1] - y[0])
    left, bottom = float(x[0]), float(y[0])
    cut_off = np.clip(np.nan_to_num(level, nan=_FLAT), -_FLAT, _FLAT)
    loops = outlines(cut_off, _THINNED)
    return [[(left + column * across, bottom + row * up) for column, row in loop] for loop in loops]


def values(p: Polynomial, z: Array) -> Array:
    """The values of p at many points, in floats."""
    found: Array = np.polyval(_coefficients(p), z)
    return found


def _coefficients(p: Polynomial) -> list[float]:
    """In floats, the leading one first."""
    return [to_float(a) for a in reversed(p.coefficients)]


def modulus(R: StabilityFunction, z: Array) -> Array:
    """|R| at many points; infinite at poles."""
    with np.errstate(divide="ignore", invalid="ignore"):
        size: Array = np.abs(values(R.numerator, z) / values(R.denominator, z))
    return size


def log_modulus(R: StabilityFunction, z: Array) -> Floats:
    """Log |R| at many points; infinite at zeros and poles."""
    with np.errstate(divide="ignore"):
        logarithm: Floats = np.log(modulus(R, z))
    return logarithm


def window_of(functions: Sequence[StabilityFunction], is_symmetric: bool) -> Window:
    """A part of the plane with all that happens: zeros of P, poles, where |R| = 1 on the axis."""
    reach = 2.0
    for R in functions:
        for p in (R.numerator, R.denominator):
            if p.degree > 0:
                largest = np.max(np.abs(np.roots(_coefficients(p))))
                reach = max(reach, float(largest))
    reach *= 1.6
    have_no_poles = all(R.denominator.degree == 0 for R in functions)
    # regions of polynomials are on the left
    right = reach / 4 if have_no_poles and not is_symmetric else reach
    return Window(-reach, right, reach)
