"""Recognition of the methods of the catalogue: a look-up by one number, then a comparison."""

from __future__ import annotations

from functools import lru_cache
from operator import mul
from typing import TYPE_CHECKING

from flint import arb, fmpq

from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.order.tolerance import rounded_up
from garkcli.tableau.pointwise import Row, in_points, numeric_entries

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from garkcli.check.analysis import Analysis
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau

WINDOW = 1e-5
"""Largest distance between the fingerprints of a method and a rounded copy."""
ROUNDINGS = tuple(fmpq(1, 10**digits) for digits in (15, 14, 13, 12, 11, 10, 9, 8, 7, 6))
"""Distances that a report may state."""
MOST_STAGES = 100
LONGEST = 8
"""Most characters of a rounding that is shown as it is."""
_DIGITS = 9
_ROUNDS = 2


class Known(Frozen):
    """A method of the catalogue that a tableau is, or nearly is, up to the order of the stages.
    ``within`` is the largest distance of entries, None if they are equal. ``step_only``: embedded
    weights differ. ``is_same``: the distance is within the rounding that both files admit.
    """

    method: str
    within: fmpq | None = None
    step_only: bool = False
    is_same: bool = True


def fingerprint(tableau: Tableau) -> float:
    """A number that depends neither on the order of stages and colours nor on superfluous stages.

    It is Σ b·u of stage vectors u = φ(A u), made twice from 𝟙. With a smooth φ all methods of high
    order would give nearly one number, so φ has a peak.

    >>> from garkcli.methodfile.load import loads
    >>> heun = loads("{A: [[0, 0], [1, 0]], b: [1/2, 1/2]}").tableau
    >>> turned = loads("{A: [[0, 1], [0, 0]], b: [1/2, 1/2]}").tableau
    >>> fingerprint(heun) == fingerprint(turned)
    True
    """
    printed = numeric_entries(tableau, 2 * _DIGITS)
    weights = _floats(printed.b)
    blocks = [[_floats(block or ()) for block in row] for row in printed.A]
    vectors = [[1.0] * len(row) for row in weights]
    for _ in range(_ROUNDS):
        # what each stage of a colour sees of all stages, through the peak
        seen = [
            [sum(sum(map(mul, A[i], u)) for A, u in zip(row, vectors, strict=True) if A) for i in s]
            for row, s in zip(blocks, map(range, map(len, vectors)), strict=True)
        ]
        # a product of floats is infinite where a power would be a fault
        vectors = [[1 / (1 + (y := 25 * x - 8) * y) for x in row] for row in seen]
    total: float = sum(sum(map(mul, b, u)) for b, u in zip(weights, vectors, strict=True))
    return round(total, _DIGITS)


def _floats(rows: Sequence[Row]) -> list[list[float]]:
    return [[float(x.mid()) for x in row if isinstance(x, arb)] for row in rows]


def find_known(analysis: Analysis, file: str, text: str) -> Known | None:
    """The method of the catalogue that an analysis is about or next to, except its own file."""
    from garkcli.methodfile.shelves import key_of, package

    if any(own.read() == text for own in package().named(key_of(file))):
        return None
    return known_of(_of_analysis(analysis), text)


def known_of(method: GarkMethod, text: str = "") -> Known | None:
    from garkcli.methodfile.shelves import package

    tableau = method.tableau
    if sum(space.stages for space in tableau.spaces) > MOST_STAGES:
        return None
    number, shelf = fingerprint(tableau), package()
    away = {name: abs(x["fingerprint"] - number) for name, x in shelf.entries.items()}
    near = sorted((distance, name) for name, distance in away.items() if distance <= WINDOW)
    texts = {name: shelf.methods[name][0].read() for _, name in near}
    if not texts or text in texts.values():
        return None
    return _first_same(method, texts)


def _of_analysis(analysis: Analysis) -> GarkMethod:
    from garkcli.tableau.garkmethod import GarkMethod

    embedded = None
    if analysis.embedded is not None:
        points = in_points(analysis.embedded.tableau)
        embedded = None if points is None else tuple(colour.b for colour in points.colours)
    return GarkMethod(tableau=analysis.tableau, tolerance=analysis.tolerance, embedded=embedded)


def _first_same(method: GarkMethod, texts: Mapping[str, str]) -> Known | None:
    from garkcli.comparison.sameness import find_sameness, views_of
    from garkcli.exact.field import ZERO

    others = []
    for name, text in texts.items():
        other = _read(name, text)
        others.append((name, other, views_of(method, other)))
    for least in (ZERO, *ROUNDINGS):
        found = []
        for name, other, views in others:
            admitted = (method.tolerance or ZERO) + (other.tolerance or ZERO)
            if ZERO < least <= admitted:
                continue  # as the first time
            same = find_sameness(method, other, views, max(least, admitted)).sameness
            if same is not None:
                is_apart = same.allowed > admitted
                found.append((same.step_only, same.is_reduced, name, same.allowed, not is_apart))
        if found:
            step_only, _, name, within, is_same = min(found, key=lambda x: x[:3])
            return Known(name, _in_few_digits(within) or None, step_only, is_same)
    return None


def _in_few_digits(rounding: fmpq) -> fmpq:
    """A rounding; one with many digits, a sum of two, is rounded up."""
    return rounding if len(decimal(rounding)) <= LONGEST else rounded_up(arb(rounding))


@lru_cache(maxsize=100)  # many files may be near to one method
def _read(name: str, text: str) -> GarkMethod:
    from garkcli.methodfile.load import loads
    from garkcli.tableau.garkmethod import GarkMethod

    read = loads(text, name)
    return GarkMethod(tableau=read.tableau, tolerance=read.tolerance, embedded=read.embedded)
