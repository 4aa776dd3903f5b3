"""Lines fitted to windows of a signal that is too long to be kept, from sums."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from garkcli.arrays import Floats


def _windows(parts: int, length: int) -> list[tuple[float, float]]:
    """The windows of ``length`` parts, one after every part of a run in so many."""
    found = []
    for k in range(parts - length + 1):
        begin = k / parts
        end = (k + length) / parts
        found.append((begin, end))
    return found


_WHOLE = _windows(1, 1)
_HALVES = _windows(4, 2)
_QUARTERS = _windows(8, 2)
_EIGHTHS = _windows(8, 1)
_WINDOWS = (*_WHOLE, *_HALVES, *_QUARTERS, *_EIGHTHS)
OF_HALVES = slice(1, 4)
OF_QUARTERS = slice(4, 11)
OF_EIGHTHS = slice(11, 19)
_FLOAT_SQUARED = 2.0**-40  # rounding of sums of squares, of the mean square


@dataclass(frozen=True)
class Windows:
    """What is fitted to the windows of one signal.

    Attributes:
        slopes: of the lines, per run, shape (windows,).
        levels: of the lines, in the middle.
        heights: root mean squares of what oscillates around the lines.
    """

    slopes: Floats
    levels: Floats
    heights: Floats


class Sums:
    """The sums of several signals of the same length from which lines are fitted.

    Args:
        count: N, the number of the last error.
        signals: how many there are.

    Attributes:
        count: N.
        largest: the size of the largest error of each signal.
        ranges: the least and the greatest error of each half of the run, shape (2, 2, signals).
    """

    def __init__(self, count: int, signals: int) -> None:
        import numpy as np

        windows = len(_WINDOWS)
        self.count = count
        self.largest = np.zeros(signals)
        # numbers of the first step inside each window, and of the step after the last
        self._bounds: list[tuple[int, int]] = []
        for a, b in _WINDOWS:
            begin = floor(a * count) + 1
            stop = ceil(b * count)
            self._bounds.append((begin, stop))
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
        """The errors e_first, e_{first+1}, …, shape (m, signals)."""
        import numpy as np

        largest = np.abs(errors).max(axis=0)
        np.maximum(self.largest, largest, out=self.largest)
        self._add_to_ranges(first, errors)
        for k, _ in enumerate(_WINDOWS):
            self._add_to_window(k, first, errors)

    def _add_to_ranges(self, first: int, errors: Floats) -> None:
        import numpy as np

        middle = self.count // 2
        halves = ((0, middle), (middle, self.count))
        for half, (start, end) in enumerate(halves):
            begin = max(start - first, 0)
            stop = max(end + 1 - first, 0)
            part = errors[begin:stop]
            if not len(part):
                continue
            least, greatest = self.ranges[half]
            low = part.min(axis=0)
            high = part.max(axis=0)
            np.minimum(least, low, out=least)
            np.maximum(greatest, high, out=greatest)

    def _add_to_window(self, k: int, first: int, errors: Floats) -> None:
        import numpy as np

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
        steps = np.arange(start, end)
        place = steps / self.count
        s = (place - a) / (b - a)
        u = s - 0.5
        # the weight w(s) of ``trend``, scaled to 1 in the middle
        product = s * (1.0 - s)
        exponent = 4.0 - 1.0 / product
        w = np.exp(exponent)
        wu = w * u
        rows = np.stack([w, wu])
        weights = self._weights[k]
        weights[0] += w.sum()
        weights[1] += w @ u
        weights[2] += w @ (u * u)
        sums = self._sums[k]
        sums[:2] += rows @ x
        sums[2] += w @ (x * x)

    def fitted(self, signal: int) -> Windows:
        """The lines through all windows."""
        import numpy as np

        W, Wu, Wuu = self._weights.T
        X, Xu, Xx = self._sums[:, :, signal].T
        # the normal equations of level + slope · u, by Cramer's rule
        determinants = W * Wuu - Wu * Wu
        numerators = W * Xu - Wu * X
        slopes = numerators / determinants
        levels = (X - slopes * Wu) / W
        squares = Xx / W
        products = levels * X + slopes * Xu
        explained = products / W
        left = squares - explained
        is_rounding = left < _FLOAT_SQUARED * squares
        left[is_rounding] = 0.0
        lengths = np.array([b - a for a, b in _WINDOWS])
        slopes /= lengths
        levels += self._starts[:, signal]
        heights = np.sqrt(left)
        return Windows(slopes, levels, heights)
