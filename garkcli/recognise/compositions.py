"""Symmetric compositions, of which programs store half of the coefficients, or one row of them:
steps of a method and its adjoint in turns, or of a symmetric method of order 2.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from garkcli.recognise.evidence import ROUNDING, agreement, unit_of
from garkcli.recognise.given import LENGTH, VALUE, Given
from garkcli.recognise.readings import Reading

if TYPE_CHECKING:
    from garkcli.arrays import Floats

T = TypeVar("T")
Compute = Callable[[str, T, T], T]
"""A sum, difference, product or quotient by its sign."""
FEWEST, MOST_STEPS = 2, 40
FORMS: Mapping[str, str] = {
    "adjoint": "half of the coefficients of a symmetric composition of a method and its adjoint",
    "middle": "half of the coefficients of a symmetric composition, up to the middle",
    "halves": "half of the coefficients of a symmetric composition, whose middle is left out",
    "palindrome": "the coefficients of a symmetric composition",
}
"""The storage of a row, in words."""
_SIGNS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def drifts_and_kicks(
    form: str, row: Sequence[T], compute: Compute[T], whole: Callable[[int], T]
) -> tuple[list[T], list[T]]:
    """A composition of the steps of drift and kick, as numbers of any kind.

    >>> drifts_and_kicks("adjoint", [0.5], lambda sign, x, y: x + y, float)
    ([0.5, 0.5], [1.0, 0.0])
    """
    if form == "adjoint":
        steps = [*row, *reversed(row)]
        kicks = [compute("+", x, y) for x, y in zip(steps[::2], steps[1::2], strict=True)]
        ends, inner = (steps[0], steps[-1]), zip(steps[1:-1:2], steps[2:-1:2], strict=True)
        drifts = [compute("+", x, y) for x, y in inner]
    else:
        kicks = _in_full(form, row, compute, whole)
        two = whole(2)
        ends = (compute("/", kicks[0], two), compute("/", kicks[-1], two))
        drifts = [compute("/", compute("+", x, y), two) for x, y in pairwise(kicks)]
    return [ends[0], *drifts, ends[1]], [*kicks, whole(0)]


def _in_full(
    form: str, row: Sequence[T], compute: Compute[T], whole: Callable[[int], T]
) -> list[T]:
    """All coefficients of a composition of steps of order 2."""
    if form == "palindrome":
        return list(row)
    if form == "middle":
        return [*row, *reversed(row[:-1])]
    middle = whole(1)
    for x in row:
        middle = compute("-", middle, compute("*", whole(2), x))
    return [*row, middle, *reversed(row)]


def composition(x: Given) -> Iterator[Reading]:
    """The ways in which a row is a symmetric composition of order 4 at least: those of even order
    follow from symmetry, that of order 1 is a sum. One may begin at the end of the step or in its
    middle.
    """
    row = x.numbers
    if not FEWEST <= len(row) <= MOST_STEPS or len({*abs(row[:, VALUE])} - {0.0}) < FEWEST:
        return
    if np.abs(row[:, VALUE] + row[::-1, VALUE] - 1).max() <= ROUNDING:
        # nodes of a quadrature rule: those of Gauss happen to be half of a composition
        return
    for form in FORMS:
        first = _in_form(form, x, row)
        # conditions of low order are those of the turned row, except its middle
        is_possible = first is not None or form == "middle"
        second = _in_form(form, x, row[::-1]) if is_possible else None
        ways = [way for way in (first, second) if way is not None]
        if ways:
            yield max(ways, key=lambda way: way[0])[1]


def _in_form(form: str, x: Given, row: Floats) -> tuple[int, Reading] | None:
    """A row as a composition of a form, with the order that it has for one problem."""
    values = row[:, VALUE].tolist()
    if form == "palindrome" and (len(values) < 3 or values != values[::-1]):
        return None
    steps = drifts_and_kicks(form, values, lambda sign, a, b: _SIGNS[sign](a, b), float)
    tolerance = ROUNDING + 12 * unit_of(row) * len(steps[0])
    if max(abs(sum(z) - 1) for z in steps) > tolerance or max(map(abs, steps[0])) >= 1e3:
        return None
    found = _reading(form, x, row, steps, tolerance)
    return None if found is None else (_order_of_one(*steps), found)


def _order_of_one(drifts: Sequence[float], kicks: Sequence[float]) -> int:
    """The order for one linear problem: where it differs, that of methods does."""
    n = 5
    D, K = np.triu(np.ones((n, n)), 1), np.tril(np.arange(1.0, n * n + 1).reshape(n, n) / n**2, -1)
    errors = []
    for h in (1 / 8, 1 / 16):
        found = np.eye(n)
        for drift, kick in zip(drifts, kicks, strict=True):
            found = _exponential(kick * h * K) @ _exponential(drift * h * D) @ found
        errors.append(max(float(np.abs(found - _exponential(h * (D + K))).max()), 1e-16))
    return round(float(np.log2(errors[0] / errors[1]))) - 1


def _exponential(M: Floats) -> Floats:
    found, term = np.eye(len(M)), np.eye(len(M))
    for i in range(1, 30):
        term = term @ M / i
        found = found + term
    return found


def _reading(
    form: str, x: Given, row: Floats, steps: tuple[list[float], list[float]], tolerance: float
) -> Reading | None:
    """A composition whose drifts and kicks have the sum 1; None if its order is below 3."""
    drifts, kicks = steps
    # a step of order 3 of a splitting has two conditions, which are one of steps of order 2
    moments = (_moment(kicks, drifts), _moment(drifts, [0.0, *kicks]))
    if max(abs(z) for z in moments) > 5 * tolerance:
        return None
    half = row[: (len(row) + 1) // 2] if form == "palindrome" else row
    left = sorted(half[:, LENGTH], reverse=True)
    identities = [*([0.0] if form != "halves" else []), *moments[: 1 + (form == "adjoint")]]
    bits = sum(min(z, agreement(y, 1, tolerance)) for z, y in zip(left, identities, strict=False))
    how = FORMS[form]
    return Reading("composition", {form: row}, how, float(bits), 4, float(bits), (x,), x.line)


def _moment(weights: Sequence[float], steps: Sequence[float]) -> float:
    """Returns Σ wᵢ Cᵢ² − 1/3, with the sums C of the steps up to each weight."""
    at, total = 0.0, 0.0
    for weight, step in zip(weights, steps, strict=False):
        at += step
        total += weight * at**2
    return total - 1 / 3
