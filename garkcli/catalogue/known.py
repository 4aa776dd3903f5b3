"""Which method of the catalogue a tableau is: looked up by one number, then held against it."""

from __future__ import annotations

from functools import lru_cache
from operator import mul
from typing import TYPE_CHECKING

from flint import arb, fmpq

from garkcli.frozen import Frozen
from garkcli.tableau.pointwise import in_points, numeric_entries

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from garkcli.check.analysis import Analysis
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.pointwise import Row
    from garkcli.tableau.tableau import Tableau

WINDOW = 1e-5
"""How far apart the fingerprints of a method and of its rounded copy may be."""
ROUNDINGS = tuple(fmpq(1, 10**digits) for digits in (15, 14, 13, 12, 11, 10, 9, 8, 7, 6))
"""The largest distance between entries of different methods in a report."""
MOST_STAGES = 100
"""Tableaus with more stages are not looked up."""
_DIGITS = 9
_ROUNDS = 2


class Known(Frozen):
    """A method of the catalogue that a tableau is, or nearly is, up to the numbers of its stages.

    Attributes:
        method: its name.
        within: how far apart entries are at most; None where they are the same exactly.
        step_only: whether embedded weights differ, or one of the two has none.
        is_same: whether that is within the rounding that both files admit.
    """

    method: str
    within: fmpq | None = None
    step_only: bool = False
    is_same: bool = True


def fingerprint(tableau: Tableau) -> float:
    """A number that renumbering stages or colours and leaving out superfluous stages do not change.

    It is Σ b·u of stage vectors u = φ(A u), made twice from 𝟙. With a smooth φ all methods of high
    order would give nearly one number, so that φ has a peak.

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


def find_known(analysis: Analysis, text: str) -> Known | None:
    """The method of the catalogue that was checked, or one next to it; None where there is none.

    Args:
        analysis: what was found of it.
        text: of its file; a file of the catalogue is not told that it is itself.
    """
    return known_of(_of_analysis(analysis), text)


def known_of(method: GarkMethod, text: str = "") -> Known | None:
    """The same for a method and its embedded weights, wherever they are from."""
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
    """The method that was checked, without its dense output."""
    from garkcli.tableau.garkmethod import GarkMethod

    embedded = None
    if analysis.embedded is not None:
        points = in_points(analysis.embedded.tableau)
        embedded = None if points is None else tuple(colour.b for colour in points.colours)
    return GarkMethod(tableau=analysis.tableau, tolerance=analysis.tolerance, embedded=embedded)


def _first_same(method: GarkMethod, texts: Mapping[str, str]) -> Known | None:
    """The first of some methods, given by their files, that a method is."""
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
            return Known(name, within or None, step_only, is_same)
    return None


@lru_cache(maxsize=100)  # many files may be near to one method
def _read(name: str, text: str) -> GarkMethod:
    """A method of the catalogue, by its file."""
    from garkcli.methodfile.load import loads
    from garkcli.tableau.garkmethod import GarkMethod

    read = loads(text, name)
    return GarkMethod(tableau=read.tableau, tolerance=read.tolerance, embedded=read.embedded)
