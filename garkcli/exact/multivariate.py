"""Polynomials in several variables over ℚ or a number field, and their interpolation along lines.

Along the line t ↦ t v through the origin a polynomial in N variables is one in t, and its
coefficient of t^k is the homogeneous part of degree k at v. With v = (1, x_2, …, x_N) that is a
polynomial of degree at most k in the x, which its values on the lattice of the integers
x_m = o_m + i_m, i_m ≥ 0, Σ i_m ≤ k, determine: Newton's interpolation, axis by axis.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import prod
from typing import TypeAlias

from flint import fmpq

from garkcli.deadline import checked
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.frozen import Frozen

Exponents: TypeAlias = tuple[int, ...]
"""The powers of the variables in a term, or a point of a lattice."""


class Multivariate(Frozen):
    """Σ a_e z^e: pairs of e and a_e ≠ 0, by descending total degree, then exponents."""

    variables: int
    terms: tuple[tuple[Exponents, Number], ...]

    @classmethod
    def of(cls, variables: int, terms: Mapping[Exponents, Number]) -> Multivariate:
        kept = [(exponents, a) for exponents, a in terms.items() if a]
        kept.sort(key=lambda term: (sum(term[0]), term[0]), reverse=True)
        return cls(variables, tuple(kept))

    @property
    def degree(self) -> int:
        """The total degree; −1 for the zero polynomial."""
        if not self.terms:
            return -1
        exponents, _ = self.terms[0]
        return sum(exponents)

    def __add__(self, other: Multivariate) -> Multivariate:
        sums = dict(self.terms)
        for exponents, a in other.terms:
            sums[exponents] = sums.get(exponents, ZERO) + a
        return Multivariate.of(self.variables, sums)

    def __neg__(self) -> Multivariate:
        return Multivariate(self.variables, tuple((exponents, -a) for exponents, a in self.terms))

    def __sub__(self, other: Multivariate) -> Multivariate:
        return self + -other

    def __mul__(self, other: Multivariate) -> Multivariate:
        products: dict[Exponents, Number] = {}
        for (e, a), (f, b) in product(self.terms, other.terms):
            power = tuple(i + j for i, j in zip(e, f, strict=True))
            products[power] = products.get(power, ZERO) + a * b
        return Multivariate.of(self.variables, products)

    def __call__(self, point: Sequence[Number]) -> Number:
        total: Number = ZERO
        for exponents, a in self.terms:
            powers = [x**k for x, k in zip(point, exponents, strict=True) if k]
            total = total + a * prod(powers, start=ONE)
        return total

    def by_last(self) -> list[Multivariate]:
        """The coefficients of 1, x, x², … in the last variable x."""
        powers: list[dict[Exponents, Number]] = []
        for (*others, last), a in self.terms:
            powers += [{} for _ in range(last + 1 - len(powers))]
            powers[last][tuple(others)] = a
        return [Multivariate.of(self.variables - 1, terms) for terms in powers]

    def along(self, direction: Sequence[Number]) -> Polynomial:
        """The polynomial t ↦ p(t v) for the direction v."""
        coefficients: list[Number] = [ZERO] * (self.degree + 1)
        for exponents, a in self.terms:
            single = Multivariate(self.variables, ((exponents, a),))
            k = sum(exponents)
            coefficients[k] = coefficients[k] + single(direction)
        return Polynomial(coefficients)


def lattice(axes: int, degree: int) -> Iterator[Exponents]:
    """The points i ≥ 0 of ℤ^axes with Σ i ≤ degree.

    >>> list(lattice(2, 1))
    [(0, 0), (0, 1), (1, 0)]
    """
    if axes == 0:
        yield ()
        return
    for i in range(degree + 1):
        for rest in lattice(axes - 1, degree - i):
            yield (i, *rest)


def from_lines(lines: Mapping[Exponents, Polynomial], offset: int, degree: int) -> Multivariate:
    """The polynomial whose restriction to t ↦ t (1, o + i_2, …, o + i_N) is ``lines[i]``. i runs
    through the lattice of ``degree``, the total degree or more; o is ``offset``.
    """
    axes = len(next(iter(lines)))
    terms: dict[Exponents, Number] = {}
    for k in range(degree + 1):
        values = {point: lines[point][k] for point in lattice(axes, k)}
        for exponents, a in _interpolated(values, axes, offset, k).items():
            terms[k - sum(exponents), *exponents] = a
    return Multivariate.of(axes + 1, terms)


def through_points(values: Mapping[Exponents, Number], degree: int) -> Multivariate:
    """The polynomial with given values on the lattice of ``degree``, its total degree or more.

    >>> through_points({(0, 0): fmpq(1), (0, 1): fmpq(1), (1, 0): fmpq(3)}, 1).terms
    (((1, 0), 2), ((0, 0), 1))
    """
    axes = len(next(iter(values)))
    return Multivariate.of(axes, _interpolated(values, axes, 0, degree))


def _interpolated(
    values: Mapping[Exponents, Number], axes: int, offset: int, degree: int
) -> dict[Exponents, Number]:
    table = dict(values)
    for axis in range(axes):
        # replace the values along an axis by their forward differences at its first point
        descending = sorted(table, key=lambda point: point[axis], reverse=True)
        for rank in range(1, degree + 1):
            for point in descending:
                i = point[axis]
                if i >= rank:
                    table[point] = table[point] - table[*point[:axis], i - 1, *point[axis + 1 :]]
    # the polynomials (x − o)(x − o − 1) … / i!, of degree i
    basis = [Polynomial([1])]
    last = basis[0]
    for i in range(degree):
        last = last * Polynomial([-(offset + i), 1]) * fmpq(1, i + 1)
        basis.append(last)
    terms: dict[Exponents, Number] = {}
    for point, difference in table.items():
        if not difference:
            continue
        for chosen in checked(product(*[enumerate(basis[i].coefficients) for i in point])):
            exponents = tuple(power for power, _ in chosen)
            a = prod([x for _, x in chosen], start=difference)
            terms[exponents] = terms.get(exponents, ZERO) + a
    return terms
