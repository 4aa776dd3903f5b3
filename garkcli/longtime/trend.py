"""Drift told apart from oscillation, in a signal too long to be kept.

The errors e_0 … e_N of a conserved quantity are a slow trend, an oscillation of many frequencies,
and noise. A line is fitted to a window [a, b] of the run by least squares with the weight

    w(s) = exp(−1/(s(1 − s))),      s = (n/N − a)/(b − a) ∈ (0, 1),

which is smooth and vanishes with all derivatives at both ends. What an oscillation of frequency f
adds to the slope is a Fourier coefficient of w, smaller than any power of 1/f; with equal weights
it would be 1/f² only. Sums of twenty-odd windows are kept, whatever N is.

The uncertainty of the slope is how far the slopes of the halves are from it, and how much those of
the quarters vary. A trend of another shape than a line shows in the averages over the eighths, and
in the ranges of the halves.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, sqrt
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

Shape: TypeAlias = Literal["none", "line", "curve", "step"]
"""What a trend looks like: a line, something that rises or falls all along, or a move to another
level.
"""
LEAST = 64
"""Fewest steps that are judged: eight for each eighth."""
_WHOLE = ((0.0, 1.0),)
_HALVES = tuple((k / 4, k / 4 + 1 / 2) for k in range(3))
_QUARTERS = tuple((k / 8, k / 8 + 1 / 4) for k in range(7))
_EIGHTHS = tuple((k / 8, k / 8 + 1 / 8) for k in range(8))
_WINDOWS = (*_WHOLE, *_HALVES, *_QUARTERS, *_EIGHTHS)
# (length / quarter)^(3/2): how much less noise there is in the slope of all than of a quarter
_SHORTENING = 8.0
# 99 percent of Student's t with the five degrees of freedom that seven overlapping quarters have
_SIGMAS = 4.0
# least part of a rise or fall all along that its slope explains, and of its uncertainty: a wave of
_SHARE = 0.05
# nearly a whole period in each eighth seems to rise too, but has hardly a slope
_APART = 3.0  # how many times their range the first or the last eighth is away from the others
_FLOAT = 2.0**-42  # rounding of the sums, of the largest error


@dataclass(frozen=True)
class Trend:
    """The slow part of one signal e_0 … e_N.

    Attributes:
        slope: of the fitted line, per step.
        uncertainty: of ``slope``.
        shape: "none" where there is no trend to be told from oscillation and noise.
    """

    slope: float
    uncertainty: float
    shape: Shape


class Trends:
    """Collects several signals of the same length, in pieces, and finds the trend of each.

    Args:
        count: N, the number of the last error.
        signals: how many there are.
    """

    def __init__(self, count: int, signals: int) -> None:
        import numpy as np

        self.count = count
        self._largest = np.zeros(signals)
        self._bounds = [(floor(a * count) + 1, ceil(b * count)) for a, b in _WINDOWS]
        self._weights = np.zeros((len(_WINDOWS), 3))  # Σ w, Σ w u, Σ w u² with u = s − ½
        self._sums = np.zeros((len(_WINDOWS), 2, signals))  # Σ w e, Σ w u e
        self._ranges = np.zeros((2, 2, signals))  # half of the run, least and greatest
        self._ranges[:, 0], self._ranges[:, 1] = np.inf, -np.inf

    def add(self, first: int, errors: Floats) -> None:
        """The errors e_first, e_{first+1}, …, shape (m, signals)."""
        import numpy as np

        last = first + len(errors)
        np.maximum(self._largest, np.abs(errors).max(axis=0), out=self._largest)
        middle = self.count // 2
        for half, (start, end) in enumerate(((0, middle + 1), (middle, self.count + 1))):
            part = errors[max(start - first, 0) : max(end - first, 0)]
            if len(part):
                self._ranges[half, 0] = np.minimum(self._ranges[half, 0], part.min(axis=0))
                self._ranges[half, 1] = np.maximum(self._ranges[half, 1], part.max(axis=0))
        for k, ((a, b), (start, end)) in enumerate(zip(_WINDOWS, self._bounds, strict=True)):
            start, end = max(start, first), min(end, last)
            if start >= end:
                continue
            s = (np.arange(start, end) / self.count - a) / (b - a)
            u = s - 0.5
            w = np.exp(4.0 - 1.0 / (s * (1.0 - s)))
            part = errors[start - first : end - first]
            self._weights[k] += w.sum(), w @ u, w @ (u * u)
            self._sums[k] += np.stack([w, w * u]) @ part

    def of(self, signal: int, noise: float = 0.0) -> Trend:
        """The trend of one signal, all of whose errors have been added; ``LEAST`` at least.

        Args:
            signal: which one.
            noise: what the errors are good to; no trend is smaller.
        """
        import numpy as np

        slopes, levels = self._lines(signal)
        slope, halves, quarters, eighths = slopes[0], slopes[1:4], slopes[4:11], levels[11:]
        spread = sqrt(float(np.mean((quarters - slope) ** 2))) / _SHORTENING
        floor_ = noise + _FLOAT * float(self._largest[signal])
        uncertainty = max(float(np.abs(halves - slope).max()), _SIGMAS * spread) + floor_
        shape: Shape = "none"
        if abs(slope) > uncertainty:
            shape = "line"
        elif abs(slope) > _SHARE * uncertainty and self._rises(eighths, abs(slope), floor_):
            shape = "curve"
        elif self._moves(signal, eighths, floor_):
            shape = "step"
        return Trend(float(slope) / self.count, float(uncertainty) / self.count, shape)

    def _lines(self, signal: int) -> tuple[Floats, Floats]:
        """Slopes per run and levels in the middle, of all windows."""
        import numpy as np

        W, Wu, Wuu = self._weights.T
        E, Eu = self._sums[:, :, signal].T
        slopes = (W * Eu - Wu * E) / (W * Wuu - Wu * Wu)
        levels = (E - slopes * Wu) / W
        lengths = np.array([b - a for a, b in _WINDOWS])
        return slopes / lengths, levels

    @staticmethod
    def _rises(levels: Floats, slope: float, floor_: float) -> bool:
        """Whether the levels rise or fall all along, by what the slope can explain."""
        import numpy as np

        total = abs(float(levels[-1] - levels[0]))
        changes = np.diff(levels)
        is_monotone = bool((changes > 0).all() or (changes < 0).all())
        return is_monotone and slope >= _SHARE * total and total > floor_

    def _moves(self, signal: int, levels: Floats, floor_: float) -> bool:
        """Whether the first or last eighth lies apart, or one half of the run leaves the range of
        the other.
        """
        for one, others in ((levels[0], levels[1:]), (levels[-1], levels[:-1])):
            away = max(one - others.max(), others.min() - one)
            if away > _APART * (others.max() - others.min()) + floor_:
                return True
        ranges = self._ranges[:, :, signal]
        for (low, high), (least, greatest) in ((ranges[0], ranges[1]), (ranges[1], ranges[0])):
            if max(greatest - high, low - least) > (high - low) + floor_:
                return True
        return False
