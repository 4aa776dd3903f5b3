"""Rational functions of unknowns with their gradients, for many points at once.

Points are columns of arrays of floats, or of balls (``flint.arb`` in arrays of objects): the same
code serves the search and its proofs. Floats are added, multiplied and divided entry by entry in a
fixed order, and no library chooses an order of summation: the results are the same to the last bit
on every machine with IEEE arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, fmpq, fmpq_mpoly

from garkcli.exact.enclosing import midpoint
from garkcli.exact.parametric import Parameters, fraction
from garkcli.frozen import Frozen

if TYPE_CHECKING:
    import numpy as np

    Array: TypeAlias = np.ndarray[Any, np.dtype[Any]]

Constant: TypeAlias = Callable[[fmpq], Any]


def as_float(number: fmpq) -> float:
    # Python divides integers with one rounding
    return int(number.p) / int(number.q)


def as_ball(number: fmpq) -> arb:
    return arb(number)


def in_decimals(ball: arb, count: int) -> int:
    """The middle of a ball times 10^count as the nearest integer, half up."""
    return int((midpoint(ball) * 10**count + fmpq(1, 2)).floor())


class SparsePolynomial(Frozen):
    """Coefficients, each with the unknowns in its monomial, repeated by their exponents."""

    terms: tuple[tuple[fmpq, tuple[int, ...]], ...]

    @cached_property
    def in_floats(self) -> list[tuple[float, tuple[int, ...]]]:
        return [(as_float(a), factors) for a, factors in self.terms]

    @classmethod
    def of(cls, polynomial: fmpq_mpoly) -> SparsePolynomial:
        terms = []
        for exponents, a in sorted(polynomial.to_dict().items()):
            factors: list[int] = []
            for unknown, exponent in enumerate(exponents):
                factors += [unknown] * int(exponent)
            terms.append((a, tuple(factors)))
        return cls(tuple(terms))

    def at(self, points: Array, constant: Constant) -> Any:
        total: Any = None
        terms: Iterable[tuple[Any, tuple[int, ...]]] = self.in_floats
        if constant is not as_float:
            terms = ((constant(a), factors) for a, factors in self.terms)
        for number, factors in terms:
            term: Any = number
            for unknown in factors:
                term = points[unknown] * term
            total = term if total is None else total + term
        return constant(fmpq(0)) if total is None else total


class Slope(Frozen):
    """A value, at each point or constant, with its derivatives that are not identically zero."""

    value: Any
    derivatives: tuple[tuple[int, Any], ...]


class RationalFunction:
    def __init__(self, number: object, ring: Parameters) -> None:
        p, q = fraction(number, ring)
        self.is_zero = not p
        self.numerator = SparsePolynomial.of(p)
        self.denominator = None if q.is_one() else SparsePolynomial.of(q)
        self.derivatives: list[tuple[int, tuple[SparsePolynomial, SparsePolynomial]]] = []
        for unknown in range(len(ring.names)):
            of_p, of_q = p.derivative(unknown), q.derivative(unknown)
            if of_p or of_q:
                self.derivatives.append(
                    (unknown, (SparsePolynomial.of(of_p), SparsePolynomial.of(of_q)))
                )

    def at(self, points: Array, constant: Constant) -> Slope:
        value = self.numerator.at(points, constant)
        if self.denominator is None:
            derivatives = [
                (unknown, p.at(points, constant)) for unknown, (p, _) in self.derivatives
            ]
            return Slope(value, tuple(derivatives))
        q = self.denominator.at(points, constant)
        value = value / q
        derivatives = []
        for unknown, (of_p, of_q) in self.derivatives:
            change = of_p.at(points, constant) - value * of_q.at(points, constant)
            derivatives.append((unknown, change / q))
        return Slope(value, tuple(derivatives))


def polynomial_functions(
    polynomials: Iterable[fmpq_mpoly], ring: Parameters
) -> list[RationalFunction]:
    one = ring.constant(fmpq(1))
    return [RationalFunction(ring.quotient(p, one), ring) for p in polynomials]


def over_box(function: RationalFunction, box: Array) -> arb:
    # a constant is one number
    value: Any = function.at(box, as_ball).value
    ball: arb = value if isinstance(value, arb) else value[0]
    return ball


class System:
    def __init__(self, functions: list[RationalFunction]) -> None:
        self.functions = functions

    def at(self, points: Array) -> tuple[Array, Array]:
        """Values, shape (functions, points), and derivatives, (functions, unknowns, points)."""
        return with_gradients(self.functions, points)


def with_gradients(functions: Sequence[RationalFunction], points: Array) -> tuple[Array, Array]:
    """Values, shape (functions, points), and derivatives, (functions, unknowns, points). ``points``
    have the shape (unknowns, points), of floats or of balls.
    """
    import numpy as np

    constant: Constant = as_ball if points.dtype == object else as_float
    zero = constant(fmpq(0))
    unknowns, count = points.shape
    values = np.full((len(functions), count), zero, points.dtype)
    gradients = np.full((len(functions), unknowns, count), zero, points.dtype)
    for number, function in enumerate(functions):
        slope = function.at(points, constant)
        values[number] = slope.value
        for unknown, derivative in slope.derivatives:
            gradients[number, unknown] = derivative
    return values, gradients
