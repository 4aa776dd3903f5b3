"""What pictures of stability share: functions over the complex plane, in floats, and lines that
differ in dashes as well as in colour, so that the figures can be printed in grey.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from garkcli.exact.display import to_float
from garkcli.exact.polynomial import Polynomial
from garkcli.stability.linear import StabilityFunction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.legend import Legend

    from garkcli.arrays import Array, Complexes, Floats

COLOURS = ("#24558f", "#a02417", "#3f7f3f", "#7a4f9a", "#8a6d1a", "#30777a")
DASHES: tuple[Any, ...] = (
    "solid",
    (0, (6, 2)),
    (0, (2, 2)),
    (0, (8, 2, 2, 2)),
    (0, (1, 2)),
    (0, (4, 1, 1, 1)),
)
Style: TypeAlias = dict[str, Any]
POINTS = 401
"""Points a side of a region."""
_AT_POLES = 1e9
"""What is drawn in place of infinity."""
ABOVE_ALL = 2e9
"""A level that nothing reaches."""


@dataclass(frozen=True)
class Window:
    """A part of the complex plane."""

    left: float
    right: float
    top: float

    def grid(self) -> tuple[Floats, Floats, Complexes]:
        """The real parts, the imaginary parts, and all points, shape (POINTS, POINTS)."""
        x = np.linspace(self.left, self.right, POINTS)
        y = np.linspace(-self.top, self.top, POINTS)
        rows = 1j * y[:, np.newaxis]
        points = x[np.newaxis, :] + rows
        return x, y, points


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
        numerators = values(R.numerator, z)
        ratio = numerators / values(R.denominator, z)
        size: Array = np.abs(ratio)
    return size


def finite(level: Array) -> Array:
    """Numbers to draw in place of infinity."""
    drawn: Array = np.nan_to_num(level, nan=_AT_POLES, posinf=_AT_POLES)
    return drawn


def window_of(functions: Sequence[StabilityFunction], is_symmetric: bool) -> Window:
    """A part of the plane with all that happens: zeros of P, poles, where |R| = 1 on the axis."""
    reach = 2.0
    for R in functions:
        for p in (R.numerator, R.denominator):
            if p.degree > 0:
                roots = np.roots(_coefficients(p))
                largest = np.max(np.abs(roots))
                reach = max(reach, float(largest))
    reach *= 1.6
    have_no_poles = all(R.denominator.degree == 0 for R in functions)
    # regions of polynomials are on the left
    right = reach
    if have_no_poles and not is_symmetric:
        right = reach / 4
    return Window(-reach, right, reach)


def draw_axes(axes: Axes) -> None:
    """Both axes of the plane, and its scales alike."""
    thin: Style = {"color": "0.1", "linewidth": 0.8}
    axes.axhline(0.0, **thin)
    axes.axvline(0.0, **thin)
    axes.set_aspect("equal")


def line_style(k: int) -> tuple[str, Any]:
    """The colour and the dashes of the k-th line."""
    colour = COLOURS[k % len(COLOURS)]
    dashes = DASHES[k % len(DASHES)]
    return colour, dashes


def title_of(names: Sequence[str]) -> str:
    """The name of one method, the number of several."""
    if len(names) == 1:
        return names[0]
    return f"{len(names)} methods"


def write_literally(legend: Legend) -> None:
    """Names are no formulas."""
    for text in legend.get_texts():
        text.set_parse_math(False)
