"""A line fitted to energy errors that oscillate with one known frequency, by least squares:
e + d n + a cos 2θn + b sin 2θn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from garkcli.arrays import Floats

ROUNDING = 2.0**-42
"""Of a slope in all, of the largest error: floats are summed."""
_CHUNK = 65536  # steps that a fit looks at at a time


@dataclass(frozen=True)
class Line:
    """A drift fitted to energy errors, per step, and how good it is."""

    slope: float
    uncertainty: float


def drift_of(errors: Floats, angle: float | None) -> Line:
    """The slope of the errors, in the whole run, and how far it is from those in its halves.

    Args:
        errors: of steps 0, 1, …
        angle: 2θ, by which the oscillation turns in a step; None where there is none.
    """
    import numpy as np

    slope = _slope(errors, angle)
    half = len(errors) // 2
    largest = float(np.abs(errors).max())
    rounding = ROUNDING * largest / len(errors)
    first = _slope(errors[: half + 1], angle)
    second = _slope(errors[half:], angle)
    apart = max(abs(first - slope), abs(second - slope))
    return Line(slope, apart + rounding)


def _slope(errors: Floats, angle: float | None) -> float:
    """The slope per step, by normal equations, whose columns are nearly orthogonal."""
    import numpy as np

    sizes = np.abs(errors)
    largest = float(sizes.max())
    last = len(errors) - 1
    if last < 1 or largest == 0:
        return 0.0
    # two turns within the run: the least for which a wave is no line
    if angle is not None:
        a_step = min(angle, 2 * np.pi - angle)
        if a_step * last < 4 * np.pi:
            angle = None
    size = 2 if angle is None else 4
    gram = np.zeros((size, size))
    moments = np.zeros(size)
    for start in range(0, len(errors), _CHUNK):
        chunk = errors[start : start + _CHUNK]
        part = chunk / largest
        n = np.arange(start, start + len(part), dtype=np.float64)
        level = np.ones_like(n)
        line = n / last - 0.5
        columns = [level, line]
        if angle is not None:
            phase = angle * n
            columns.append(np.cos(phase))
            columns.append(np.sin(phase))
        A = np.stack(columns, axis=1)
        gram += A.T @ A
        moments += A.T @ part
    fitted = np.linalg.solve(gram, moments)
    in_all = float(fitted[1]) * largest
    return in_all / last
