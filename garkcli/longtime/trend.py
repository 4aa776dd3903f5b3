"""Distinguishes drift from oscillation in a signal too long to be stored.

The errors e_0 … e_N of a conserved quantity are a slow trend, an oscillation of many frequencies,
and noise. A line is fitted to a window [a, b] of the run by least squares with the weight

    w(s) = exp(−1/(s(1 − s))),      s = (n/N − a)/(b − a) ∈ (0, 1),

which is smooth and vanishes with all derivatives at both ends. An oscillation of frequency f adds a
Fourier coefficient of w to the slope, smaller than any power of 1/f; with equal weights it would be
1/f² only. About twenty sums are kept for any N.

The uncertainty of the slope, see docs/energy.md, is the distance of the slopes of the halves from
it, and the variation of those of the quarters (noise, correlated or not, and modulations that are
not much longer than the run), plus the change of the height of the oscillation from quarter to
quarter: a modulation of the height modulates the mean too, and a very long one is a line.

A slope below its uncertainty is no drift, one above ten times as much is a drift, and between them
it is undecided. A trend of another shape is a drift if the averages over the eighths keep rising,
or falling, by more than the signal oscillates there. A single move to another level is undecided.
"""

from __future__ import annotations

from math import ceil, floor, sqrt
from typing import TYPE_CHECKING, Literal, TypeAlias

from garkcli import numpy_on_use as np
from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from garkcli.arrays import Floats


def _windows(parts: int, length: int) -> list[tuple[float, float]]:
    """The windows of ``length`` parts, starting at each part of a run of ``parts``."""
    return [(k / parts, (k + length) / parts) for k in range(parts - length + 1)]


_WHOLE = _windows(1, 1)
_HALVES = _windows(4, 2)
_QUARTERS = _windows(8, 2)
_EIGHTHS = _windows(8, 1)
_WINDOWS = (*_WHOLE, *_HALVES, *_QUARTERS, *_EIGHTHS)
OF_HALVES = slice(1, 4)
OF_QUARTERS = slice(4, 11)
OF_EIGHTHS = slice(11, 19)
_FLOAT_SQUARED = 2.0**-40  # rounding of sums of squares, of the mean square


class Windows(Frozen):
    """Lines fitted to windows: slopes per run, levels in the middle, oscillation around (RMS)."""

    slopes: Floats
    levels: Floats
    heights: Floats


Shape: TypeAlias = Literal["none", "line", "curve", "step"]
"""A line, a rise or fall throughout, or a move to another level."""
Finding: TypeAlias = Literal["none", "undecided", "drift"]
"""No trend above oscillation and noise; one that a modulation may explain; a drift."""
LEAST = 64
"""Fewest steps that are judged: eight for each eighth."""
CERTAIN = 10.0
"""Multiple of its uncertainty that no drift exceeds in 480 symplectic runs on two planets."""
# (length / quarter)^(3/2): how much less noise there is in the slope of all than of a quarter
_SHORTENING = 8.0
# 99 percent of Student's t with the five degrees of freedom that seven overlapping quarters have
_SIGMAS = 4.0
_CLEAR = 3.0  # how many times the heights of two eighths their levels differ when one has moved
# how many of the seven moves between eighths are clear in a rise that goes on
_CLIMBS = 4
# how many times their range the first or the last eighth is away from the others
_APART = 3.0
_FLOAT = 2.0**-42  # rounding of the sums, of the largest error


class Trend(Frozen):
    """The slow part of a signal: ``slope`` per step, ``move`` without a line, ``net`` in all."""

    slope: float
    uncertainty: float
    finding: Finding
    shape: Shape
    move: float = 0.0
    net: float = 0.0

    def exceeds(self, bound: float, count: int) -> bool:
        """Whether the trend over ``count`` steps is more than ``bound`` explains."""
        if self.shape == "line":
            return (abs(self.slope) - self.uncertainty) * count > bound
        return max(self.move, self.net) > bound


class Trends:
    """Collects signals of the same length, in pieces, as sums to which trends are fitted. ``count``
    is N; ``ranges`` are extremes of each half, shape (2, 2, signals).
    """

    def __init__(self, count: int, signals: int) -> None:
        windows = len(_WINDOWS)
        self.count = count
        self.largest = np.zeros(signals)
        # numbers of the first step inside each window, and of the step after the last
        self._bounds: list[tuple[int, int]] = []
        for a, b in _WINDOWS:
            self._bounds.append((floor(a * count) + 1, ceil(b * count)))
        # Σ w, Σ w u, Σ w u² with u = s − ½
        self._weights = np.zeros((windows, 3))
        # the first error of each window: x = e − start is of the size of what happens in it
        self._starts = np.zeros((windows, signals))
        # Σ w x, Σ w u x, Σ w x²
        self._sums = np.zeros((windows, 3, signals))
        # half of the run, least and greatest
        self.ranges = np.zeros((2, 2, signals))
        self.ranges[:, 0] = np.inf
        self.ranges[:, 1] = -np.inf

    def add(self, first: int, errors: Floats) -> None:
        """Adds the errors e_first, e_{first+1}, …, shape (m, signals)."""
        np.maximum(self.largest, np.abs(errors).max(axis=0), out=self.largest)
        self._add_to_ranges(first, errors)
        for k, _ in enumerate(_WINDOWS):
            self._add_to_window(k, first, errors)

    def _add_to_ranges(self, first: int, errors: Floats) -> None:
        middle = self.count // 2
        for half, (start, end) in enumerate(((0, middle), (middle, self.count))):
            part = errors[max(start - first, 0) : max(end + 1 - first, 0)]
            if not len(part):
                continue
            least, greatest = self.ranges[half]
            low = part.min(axis=0)
            high = part.max(axis=0)
            np.minimum(least, low, out=least)
            np.maximum(greatest, high, out=greatest)

    def _add_to_window(self, k: int, first: int, errors: Floats) -> None:
        a, b = _WINDOWS[k]
        begin, stop = self._bounds[k]
        start = max(begin, first)
        end = min(stop, first + len(errors))
        if start >= end:
            return
        part = errors[start - first : end - first]
        if start == begin:
            self._starts[k] = part[0]
        x = part - self._starts[k]
        s = (np.arange(start, end) / self.count - a) / (b - a)
        u = s - 0.5
        # the weight w(s) of ``trend``, scaled to 1 in the middle
        exponent = 4.0 - 1.0 / (s * (1.0 - s))
        w = np.exp(exponent)
        rows = np.stack([w, w * u])
        weights = self._weights[k]
        weights[0] += w.sum()
        weights[1] += w @ u
        weights[2] += w @ (u * u)
        sums = self._sums[k]
        sums[:2] += rows @ x
        sums[2] += w @ (x * x)

    def _fitted(self, signal: int) -> Windows:
        W, Wu, Wuu = self._weights.T
        X, Xu, Xx = self._sums[:, :, signal].T
        # the normal equations of level + slope · u, by Cramer's rule
        determinants = W * Wuu - Wu * Wu
        numerators = W * Xu - Wu * X
        slopes = numerators / determinants
        levels = (X - slopes * Wu) / W
        squares = Xx / W
        explained = (levels * X + slopes * Xu) / W
        left = squares - explained
        is_rounding = left < _FLOAT_SQUARED * squares
        left[is_rounding] = 0.0
        lengths = np.array([b - a for a, b in _WINDOWS])
        slopes /= lengths
        levels += self._starts[:, signal]
        return Windows(slopes, levels, np.sqrt(left))

    def of(self, signal: int, noise: float = 0.0) -> Trend:
        """Returns the trend of a whole signal, at least above its ``noise``."""
        found = self._fitted(signal)
        least = noise + _FLOAT * float(self.largest[signal])
        slope = float(found.slopes[0])
        uncertainty = _uncertainty(found) + least
        move = self._move(signal, found, least)
        finding: Finding = "none"
        shape: Shape = "none"
        if abs(slope) > CERTAIN * uncertainty:
            finding, shape = "drift", "line"
        elif _climbs(found, least):
            finding, shape = "drift", "curve"
        elif abs(slope) > uncertainty:
            finding, shape = "undecided", "line"
        elif move > 0.0:
            finding, shape = "undecided", "step"
        elif (move := _net(found, least)) > 0.0:
            finding, shape = "undecided", "curve"
        count = self.count
        levels = found.levels[OF_EIGHTHS]
        net = abs(float(levels[-1] - levels[0]))
        return Trend(slope / count, uncertainty / count, finding, shape, move, net)

    def _move(self, signal: int, found: Windows, least: float) -> float:
        """The distance of an end or a half of the run from the rest; 0 without any."""
        move = _move_of_an_end(found, least)
        first, second = self.ranges[:, :, signal].tolist()
        for one, other in ((first, second), (second, first)):
            low, high = one
            lowest, highest = other
            away = max(highest - high, low - lowest)
            if away > high - low + least:
                move = max(move, away)
        return move


def _move_of_an_end(found: Windows, least: float) -> float:
    """The distance of the first or last eighth from the others; 0 if it is within noise."""
    levels = found.levels[OF_EIGHTHS].tolist()
    height = float(found.heights[OF_EIGHTHS].max())
    first, *after_first = levels
    *before_last, last = levels
    move = 0.0
    for one, others in ((first, after_first), (last, before_last)):
        low = min(others)
        high = max(others)
        away = max(one - high, low - one)
        if away > _APART * (high - low) + height + least:
            move = max(move, away)
    return move


def _uncertainty(found: Windows) -> float:
    """The uncertainty of the slope of the whole run, per run, without rounding."""
    slope = found.slopes[0]
    of_halves = found.slopes[OF_HALVES] - slope
    of_quarters = found.slopes[OF_QUARTERS] - slope
    halves = float(np.abs(of_halves).max())
    variance = float(np.mean(of_quarters**2))
    noise = _SIGMAS * sqrt(variance) / _SHORTENING
    heights = found.heights[OF_QUARTERS]
    modulation = float(heights.max() - heights.min())
    return max(halves, noise) + modulation


def _climbs(found: Windows, least: float) -> bool:
    """Whether levels keep rising, or falling, by more than the signal oscillates: clearly from
    eighth to eighth, or by its height and clearly in total.
    """
    levels = found.levels[OF_EIGHTHS]
    heights = found.heights[OF_EIGHTHS]
    moves = np.diff(levels)
    around = heights[1:] + heights[:-1]
    if _goes_on(moves, _CLEAR * around + least):
        return True
    first, *_, last = levels.tolist()
    net = last - first
    if abs(net) <= CERTAIN * float(heights.max()):
        return False
    return _goes_on(moves, around / 2 + least)


def _goes_on(moves: Floats, clear: Floats) -> bool:
    """Whether many of the moves are clear, all in one direction."""
    is_rise = moves > clear
    is_fall = moves < -clear
    rises = int(is_rise.sum())
    falls = int(is_fall.sum())
    if min(rises, falls) > 0:
        return False
    return max(rises, falls) >= _CLIMBS


def _net(found: Windows, least: float) -> float:
    """The distance of the first and last level, if it is clear and large; else 0."""
    levels: list[float] = found.levels[OF_EIGHTHS].tolist()
    heights: list[float] = found.heights[OF_EIGHTHS].tolist()
    net = abs(levels[-1] - levels[0])
    around = heights[-1] + heights[0]
    range_of_all = max(levels) - min(levels)
    is_clear = net > _CLEAR * around + least
    is_most = net > range_of_all / 2
    if is_clear and is_most:
        return net
    return 0.0
