"""Objectives that only a search minimises: errors of embedded weights, constants of pairs, sizes.

A pair has orders p and q; its errors of order n are ‖e_n‖ and ‖ê_n‖, the 2-norms over the trees of
that order. B, C, E: J. Dormand, P. Prince, *A family of embedded Runge–Kutta formulae*, J. Comput.
Appl. Math. 6 (1980), with q = p − 1; C. Kennedy, M. Carpenter, NASA/TM–2016–219173.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any

from flint import fmpq

from garkcli.design.minimise.objective import ObjectiveSubject, SearchMeasure
from garkcli.design.minimise.squared_error import squared_error
from garkcli.errors import UsageProblem
from garkcli.exact.matrix import characteristic_coefficients
from garkcli.order.conditions import all_conditions
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau


def coefficients_of(tableau: Tableau) -> Iterator[Any]:
    tableau.demand_fields("the size of coefficients")
    blocks = tableau.blocks.values()
    yield from chain(*chain.from_iterable(blocks), *(colour.b for colour in tableau.colours))


def numbers_of(subject: ObjectiveSubject) -> Iterator[Any]:
    yield from coefficients_of(subject.tableau)
    yield from chain.from_iterable(colour.c for colour in subject.tableau.colours)
    yield from chain.from_iterable(subject.further.embedded or ())


def at_infinity(tableau: Tableau, key: str) -> tuple[Any, Any]:
    """Numerator and denominator of R(∞), with the degree of almost all methods. Raises UsageProblem
    if the method has several colours, or R(∞) is infinite.
    """
    colour = tableau.colours[0]
    if tableau.size > 1 or not isinstance(tableau.spaces[colour.space], PointSpace):
        message = f"{key}: R(∞) is computed for methods of one colour, given stage by stage"
        raise UsageProblem(
            message,
            "for a colour of several write R-infinity: {2: 0} under design",
            code="wanted-without-meaning",
        )
    A: Any = tableau.blocks[colour.space, 0]
    denominator = characteristic_coefficients(A)
    reduced = [[x - y for x, y in zip(row, colour.b, strict=True)] for row in A]
    expanded = characteristic_coefficients(tuple(map(tuple, reduced)))
    degree = max(k for k, x in enumerate(denominator) if x)
    if not degree or any(expanded[degree + 1 :]):
        message = f"{key}: R(∞) is infinite"
        cure = "explicit methods have no value there; R-infinity: 0 under design makes it finite"
        raise UsageProblem(message, cure, code="wanted-without-meaning")
    return expanded[degree], denominator[degree]


def _rational(number: Any) -> fmpq:
    rational: fmpq = number
    return rational


def _error(tableau: Tableau, order: int) -> fmpq:
    quotient = squared_error(tableau, order, None)
    return _rational(quotient.numerator / quotient.denominator)


def _largest_error(subject: ObjectiveSubject) -> fmpq:
    conditions = all_conditions(subject.tableau, subject.order + 1)
    errors: list[Any] = [(x.value - x.required) / x.tree.symmetry for x in conditions]
    return max((x * x for x in errors), default=fmpq(0))


def _embedded_error(subject: ObjectiveSubject) -> fmpq:
    tableau, order = subject.embedded
    return _error(tableau, order + 1)


def _quotient(numerator: fmpq, denominator: fmpq) -> fmpq:
    if not denominator:
        message = "B, C and E divide by the error of the embedded weights, which is 0"
        cure = "want a lower embedded-order, so that the estimate is not 0"
        raise UsageProblem(message, cure, code="wanted-without-meaning")
    return numerator / denominator


def _b(subject: ObjectiveSubject) -> fmpq:
    tableau, order = subject.embedded
    return _quotient(_error(tableau, order + 2), _embedded_error(subject))


def _c(subject: ObjectiveSubject) -> fmpq:
    tableau, order = subject.embedded
    rows = zip(tableau.colours, subject.tableau.colours, strict=True)
    difference = tuple(tuple(x - y for x, y in zip(a.b, b.b, strict=True)) for a, b in rows)
    conditions = all_conditions(with_weights(tableau, difference), order + 2)
    total = fmpq(0)
    for x in conditions:
        e: Any = x.value / x.tree.symmetry
        total += len(x.trees) * e * e
    return _quotient(total, _embedded_error(subject))


def _e(subject: ObjectiveSubject) -> fmpq:
    _, order = subject.embedded
    return _quotient(_error(subject.tableau, order + 2), _embedded_error(subject))


def _largest(numbers: Iterator[Any]) -> fmpq:
    return max((x * x for x in numbers), default=fmpq(0))


def _infinity(tableau: Tableau, key: str) -> fmpq:
    numerator, denominator = at_infinity(tableau, key)
    return _rational((numerator / denominator) ** 2)


MEASURES = (
    SearchMeasure(
        "A", "(Σ e(u)²)^½ over the trees of order {next}", lambda x: _error(x.tableau, x.order + 1)
    ),
    SearchMeasure("largest-error", "max |e(u)| over the trees of order {next}", _largest_error),
    SearchMeasure(
        "embedded-A",
        "(Σ ê(u)²)^½ over the trees of order q + 1, q and ê those of the embedded weights",
        _embedded_error,
    ),
    SearchMeasure("B", "‖ê‖ of order q + 2 over ‖ê‖ of order q + 1, q the embedded order", _b),
    SearchMeasure("C", "‖ê − e‖ of order q + 2 over ‖ê‖ of order q + 1, q the embedded order", _c),
    SearchMeasure(
        "D",
        "the largest coefficient, embedded weight or node in size",
        lambda x: _largest(numbers_of(x)),
    ),
    SearchMeasure("E", "‖e‖ of order q + 2 over ‖ê‖ of order q + 1, q the embedded order", _e),
    SearchMeasure(
        "largest", "the largest coefficient in size", lambda x: _largest(coefficients_of(x.tableau))
    ),
    SearchMeasure(
        "nonzero",
        "the number of coefficients that are not 0",
        lambda x: fmpq(sum(map(bool, coefficients_of(x.tableau)))) ** 2,
    ),
    SearchMeasure("infinity", "|R(∞)|", lambda x: _infinity(x.tableau, "infinity")),
    SearchMeasure(
        "embedded-infinity",
        "|R(∞)| of the method with the embedded weights",
        lambda x: _infinity(x.embedded[0], "embedded-infinity"),
    ),
)
