"""The costs of equal errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from math import ceil, floor
from typing import TypeAlias

from flint import arb

from garkcli.convergence.result import Convergence, curve
from garkcli.page.figures import log10, scientific

Tested: TypeAlias = Sequence[tuple[str, Convergence]]
"""The results by the letters of their methods."""
_GOALS = 6  # errors at which costs are compared


def at_equal_errors(tested: Tested, what: str) -> list[tuple[str, list[tuple[str, str]]]]:
    """The cost of errors of 10^k for each method, interpolated between its steps."""
    curves = {
        letter: [(log10(error), log10(x)) for x, error in curve(result, what)]
        for letter, result in tested
    }
    goals = _goals([[error for error, _ in points] for points in curves.values()])
    return [
        (letter, [(f"1e{k}", _amount(_between(points, k), what)) for k in goals])
        for letter, points in curves.items()
        if goals
    ]


def _amount(decades: float | None, what: str) -> str:
    """10 to that power, in the digits of its kind; empty if it is unknown."""
    if decades is None:
        return ""
    x = 10**decades
    return str(round(x)) if what == "evaluations" else scientific(arb(x), 2)


def _goals(errors: Sequence[Sequence[float]]) -> list[int]:
    """Whole decades, thinned out evenly, that at least two methods reach, or one where no two
    do.
    """
    reached: Counter[int] = Counter()
    for ys in errors:
        if len(ys) > 1:
            reached.update(range(ceil(min(ys)), floor(max(ys)) + 1))
    shared = [k for k, count in reached.items() if count > 1]
    decades = sorted(shared or reached, reverse=True)
    return decades[:: max(1, ceil(len(decades) / _GOALS))]


def _between(points: Sequence[tuple[float, float]], goal: float) -> float | None:
    """The second coordinate where the first is ``goal``, on the line between two neighbours."""
    for (a, x), (b, y) in pairwise(points):
        is_between = min(a, b) <= goal <= max(a, b)
        if is_between and a != b:
            return x + (y - x) * (goal - a) / (b - a)
    return None
