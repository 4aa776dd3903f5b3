"""Extrapolated Euler methods and the extrapolated midpoint rule, of any order.

The basic method takes the step in n_1, n_2, … parts, and its error, a polynomial in h, is
extrapolated to h = 0: W. Gragg, *On extrapolation algorithms for ordinary initial value problems*,
SIAM J. Numer. Anal. 2 (1965); E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential
Equations I*, II.9. Shared parts are computed once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import UnknownFamily
from garkcli.exact.matrix import solve
from garkcli.families.family import NONSTIFF, MethodFamily, Option, Options, Recipe
from garkcli.families.stagelist import START, StageList, Weights, combined
from garkcli.tableau.tableau import Method

SEQUENCES = ("harmonic", "romberg", "bulirsch")
"""1, 2, 3, 4, …; 1, 2, 4, 8, …; 1, 2, 3, 4, 6, 8, 12, …"""
SEQUENCE = Option(
    "sequence",
    "The numbers of parts of the step that an extrapolated family combines.",
    SEQUENCES,
    default="harmonic",
    shown="romberg",
)
ORDER = Option("order", "The order that the family is extrapolated to.", smallest=1, shown="4")
Steps: TypeAlias = Callable[[StageList, int], Weights]
"""The result of the basic method after so many parts of the step."""


def sequence(name: str, length: int) -> tuple[int, ...]:
    """The first numbers of a sequence.

    >>> sequence("bulirsch", 7)
    (1, 2, 3, 4, 6, 8, 12)
    """
    if name == "harmonic":
        return tuple(range(1, length + 1))
    if name == "romberg":
        return tuple(2**k for k in range(length))
    numbers = [1, 2, 3]
    while len(numbers) < length:
        numbers.append(2 * numbers[-2])
    return tuple(numbers[:length])


def extrapolation_weights(parts: Sequence[int], powers: Sequence[int]) -> tuple[fmpq, ...]:
    """w_j with Σ w_j = 1 and Σ w_j n_j^(−k) = 0 for the powers k of h, one fewer than the n_j.

    >>> extrapolation_weights([1, 2], [1])
    (-1, 2)
    """
    rows = []
    right = []
    for k in (0, *powers):
        rows.append(tuple(fmpq(1, n**k) for n in parts))
        right.append((fmpq(k == 0),))
    weights = [row[0] for row in solve(tuple(rows), tuple(right))]
    return tuple(w for w in weights if isinstance(w, fmpq))


def _euler(stages: StageList, n: int) -> Weights:
    h = fmpq(1, n)
    value = START
    for _ in range(n):
        value = combined([(1, value), (1, {stages.slope_at(value): h})])
    return value


def _implicit_euler(stages: StageList, n: int) -> Weights:
    h = fmpq(1, n)
    value = START
    for _ in range(n):
        value = combined([(1, value), (1, {stages.implicit_slope(value, h): h})])
    return value


def _midpoint(stages: StageList, n: int) -> Weights:
    """Gragg's rule: Euler, then y_{i+1} = y_{i−1} + 2h f(y_i); n is even."""
    h = fmpq(1, n)
    before, value = START, START
    for i in range(n):
        slope = stages.slope_at(value)
        leap = {slope: h if i == 0 else 2 * h}
        before, value = value, combined([(1, before), (1, leap)])
    return value


def _extrapolated(name: str, steps: Steps, parts: Sequence[int], powers: Sequence[int]) -> Method:
    stages = StageList()
    weights = extrapolation_weights(parts, powers)
    results = [steps(stages, n) for n in parts]
    return stages.method(name, combined(zip(weights, results, strict=True)))


def _explicit(name: str, steps: Steps, parts: Sequence[int], powers: Sequence[int]) -> Recipe:
    return Recipe(1 + sum(parts) - len(parts), lambda _: _extrapolated(name, steps, parts, powers))


def euler(order: int, options: Options) -> Recipe:
    parts = sequence(str(options["sequence"]), order)
    return _explicit(f"extrapolated Euler {order}", _euler, parts, range(1, order))


def implicit_euler(order: int, options: Options) -> Recipe:
    """Diagonally implicit."""
    parts = sequence(str(options["sequence"]), order)
    name = f"extrapolated implicit Euler {order}"
    powers = range(1, order)
    return Recipe(sum(parts), lambda _: _extrapolated(name, _implicit_euler, parts, powers))


def midpoint(order: int, options: Options) -> Recipe:
    """Gragg's explicit midpoint rule without smoothing; UnknownFamily if the order is odd."""
    if order % 2:
        message = f"extrapolated-midpoint with order {order} does not exist"
        raise UnknownFamily(message, "it has even orders", code="cannot-construct")
    half = sequence(str(options["sequence"]), order // 2)
    parts = [2 * n for n in half]
    return _explicit(f"extrapolated midpoint {order}", _midpoint, parts, range(2, order, 2))


def _family(
    name: str, recipe: Callable[[int, Options], Recipe], smallest: int, summary: str
) -> MethodFamily:
    return MethodFamily(name, recipe, smallest, 60, "order", summary, ORDER, (SEQUENCE,), NONSTIFF)


FAMILIES = (
    _family("extrapolated-euler", euler, 1, "explicit Euler, extrapolated"),
    _family("extrapolated-implicit-euler", implicit_euler, 1, "implicit Euler, extrapolated; dirk"),
    _family("extrapolated-midpoint", midpoint, 2, "Gragg's rule, of even orders"),
)
