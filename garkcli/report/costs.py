"""What errors cost: points of plots, and costs of equal errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import ceil, floor
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.convergence.result import Convergence, Cost
from garkcli.page.asciiplot import log10
from garkcli.page.figures import scientific

Tested: TypeAlias = Sequence[tuple[str, Convergence]]
"""The results by the letters of their methods."""
_GOALS = 6  # errors at which costs are compared


def amount(cost: Cost | None, what: str) -> float | None:
    """How much of ``what`` a row has cost: evaluations or seconds; None where that is not known."""
    if cost is None:
        return None
    return float(cost.evaluations) if what == "evaluations" else cost.seconds


def curve(result: Convergence, against: str) -> Iterator[tuple[float | fmpq, arb]]:
    """The points (x, error) of a plot against h, evaluations or seconds, where both are known and
    positive.
    """
    for row in result.rows:
        x: float | fmpq | None = amount(row.cost, against) if against != "h" else row.h
        if x is not None and row.error > 0:
            yield x, row.error


def at_equal_errors(tested: Tested, what: str) -> list[tuple[str, list[tuple[str, str]]]]:
    """For each method what errors of 10^k cost, where it has larger and smaller ones."""
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
    """What an error costs, by its decimal logarithm; empty where that is not known."""
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
