"""Number fields ℚ(θ): arithmetic with radicals that is never rounded.

An element is a polynomial in θ modulo the minimal polynomial of θ, in python-flint. Rational
elements are plain ``fmpq``, so a number here is ``fmpq | Algebraic`` and zero is falsy in both.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from math import prod
from typing import Any, TypeAlias, cast

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz, nmod, nmod_poly

from garkcli.exact.apart import apart
from garkcli.exact.nodes import Expression
from garkcli.exact.pickling import register
from garkcli.exact.rewriting import format_expression
from garkcli.exact.span import pivot_columns
from garkcli.upward import answered

register()  # methods are copied, and sent to other processes

ZERO = fmpq(0)
ONE = fmpq(1)
FIRST_PRIME = 2**31 + 1
PRIMES_WITHIN = 10_000
LONG = 50_000
"""Size of a number, degree times bits, beyond which its inverse takes tenths of a second."""
Word: TypeAlias = tuple[int, ...]
"""A product of radicals, as their indices in ascending order."""


def _inverse(x: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    gcd, cofactor, _ = x.xgcd(modulus)
    return cofactor / gcd[0]


def modulo(poly: fmpq_poly, p: int) -> nmod_poly:
    """A polynomial modulo a prime. Raises ZeroDivisionError if p divides a denominator."""
    return nmod_poly(poly.numer(), p) * ~nmod(int(poly.denom()), p)


class NumberField:
    """K = ℚ(θ) = ℚ[x]/(modulus), with pairs of generating radicals and their elements. Without
    ``radicals`` elements are written in θ.
    """

    def __init__(
        self, modulus: fmpq_poly, radicals: Sequence[tuple[Expression, fmpq_poly]]
    ) -> None:
        self.modulus = modulus
        self.degree: int = modulus.degree()
        self.radicals = tuple(radicals)

    def is_same(self, other: NumberField) -> bool:
        """Whether the fields are equal: the radicals tell which root θ is."""
        if other is self:
            return True
        return (
            bool(self.radicals)
            and self.modulus == other.modulus
            and self.radicals == other.radicals
        )

    @cached_property
    def place(self) -> tuple[int, int] | None:
        """A prime p and a simple root of the minimal polynomial modulo p; None if no tried prime
        has one. They map elements with denominators prime to p to F_p.
        """
        primes = (fmpz(n) for n in range(FIRST_PRIME, FIRST_PRIME + PRIMES_WITHIN, 2))
        for p in filter(fmpz.is_prime, primes):
            with suppress(ZeroDivisionError):
                for root, power in modulo(self.modulus, int(p)).roots():
                    if power == 1:
                        return int(p), int(root)
        return None

    def element(self, poly: fmpq_poly) -> Number:
        """The class of ``poly``; a plain rational if it is constant."""
        poly %= self.modulus
        if poly.degree() < 1:
            return poly[0]
        return Algebraic(self, poly)

    def from_coordinates(self, coordinates: Sequence[fmpq]) -> Number:
        return self.element(fmpq_poly(list(coordinates)))

    @cached_property
    def monomials(self) -> tuple[Word, ...]:
        """A basis of K over ℚ of products of radicals, as tuples of indices into ``radicals``."""
        return self._basis[0]

    @cached_property
    def _basis(self) -> tuple[tuple[Word, ...], fmpq_mat]:
        """The monomials and the inverse of their matrix in powers of θ."""
        if not self.radicals:
            powers = tuple((0,) * k for k in range(self.degree))
            size = range(self.degree)
            unit = [[fmpq(i == j) for j in size] for i in size]
            return powers, fmpq_mat(unit)
        chosen: list[Word] = []
        columns: list[list[fmpq]] = []
        level: dict[Word, fmpq_poly] = {(): fmpq_poly([1])}
        while level:
            words = list(level)
            candidates = [self._column(level[word]) for word in words]
            pivots = pivot_columns(fmpq_mat([*columns, *candidates]).transpose())
            known = len(columns)
            new = [j - known for j in pivots if j >= known]
            new_words = [words[j] for j in new]
            chosen += new_words
            columns += [candidates[j] for j in new]
            if len(columns) == self.degree:
                break
            # the products with one factor more; the indices of a word do not descend; multiples of
            # dependent products are dependent
            extended: dict[Word, fmpq_poly] = {}
            for word, product in {word: level[word] for word in new_words}.items():
                for index in range(word[-1] if word else 0, len(self.radicals)):
                    _, radical = self.radicals[index]
                    extended[*word, index] = product * radical % self.modulus
            level = extended
        return tuple(chosen), fmpq_mat(columns).transpose().inv()

    def _column(self, poly: fmpq_poly) -> list[fmpq]:
        return [poly[k] for k in range(self.degree)]

    def powers(self, word: Word, latex: bool = False) -> Iterator[tuple[str, int]]:
        if not self.radicals:
            if word:
                yield r"\theta" if latex else "theta", len(word)
            return
        for index, power in Counter(word).items():
            radical, _ = self.radicals[index]
            yield format_expression(radical, latex), power

    def in_radicals(self, number: Algebraic) -> list[fmpq]:
        _, inverse = self._basis
        return (inverse * fmpq_mat(self.degree, 1, self._column(number.poly))).entries()


class Algebraic:
    __slots__ = ("field", "poly")

    def __init__(self, field: NumberField, poly: fmpq_poly) -> None:
        self.field = field
        self.poly = poly

    def _poly_of(self, other: object) -> fmpq_poly | None:
        if isinstance(other, Algebraic):
            if not self.field.is_same(other.field):
                raise TypeError("numbers of two different fields")
            return other.poly
        if isinstance(other, (fmpq, fmpz, int)):
            return fmpq_poly([other])
        return None

    def _of_sum(self, poly: fmpq_poly) -> Number:
        return Algebraic(self.field, poly) if poly.degree() > 0 else poly[0]

    def __add__(self, other: object) -> Number:
        poly = self._poly_of(other)
        if poly is None:
            return NotImplemented
        return self._of_sum(self.poly + poly)

    __radd__ = __add__

    def __sub__(self, other: object) -> Number:
        poly = self._poly_of(other)
        if poly is None:
            return NotImplemented
        return self._of_sum(self.poly - poly)

    def __rsub__(self, other: object) -> Number:
        return -(self - other)

    def __neg__(self) -> Algebraic:
        return Algebraic(self.field, -self.poly)

    def __mul__(self, other: object) -> Number:
        poly = self._poly_of(other)
        if poly is None:
            return NotImplemented
        return self.field.element(self.poly * poly)

    __rmul__ = __mul__

    def inverse(self) -> Number:
        modulus = self.field.modulus
        bits = max(int(self.poly.numer().height_bits()), int(modulus.numer().height_bits()))
        is_long = self.field.degree * bits > LONG
        found = apart(_inverse, self.poly, modulus) if is_long else _inverse(self.poly, modulus)
        return self.field.element(found)

    def __truediv__(self, other: object) -> Number:
        if isinstance(other, Algebraic):
            return self * other.inverse()
        if isinstance(other, (fmpq, fmpz, int)):
            return Algebraic(self.field, self.poly / fmpq(other))
        return NotImplemented

    def __rtruediv__(self, other: object) -> Number:
        return self.inverse() * other  # type: ignore[operator]

    def __pow__(self, exponent: object) -> Number:
        if not isinstance(exponent, int):
            return NotImplemented
        result: Number = ONE
        base: Number = self
        if exponent < 0:
            base = self.inverse()
        for bit in f"{abs(exponent):b}":
            result = result * result
            if bit == "1":
                result = result * base
        return result

    def __float__(self) -> float:
        """The nearest float, for display only."""
        value: float = answered(self, "float")
        return value

    def _sympy_(self) -> Any:
        return answered(self, "sympy")

    def __bool__(self) -> bool:
        return True  # zero is rational, hence never an Algebraic

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Algebraic):
            return self.poly == other.poly and self.field.is_same(other.field)
        return False

    def __hash__(self) -> int:
        # of integers: flint hashes fractions by Python's, a slow import
        return hash((tuple(self.poly.numer()), self.poly.denom()))

    def terms(self) -> Iterator[tuple[fmpq, Word]]:
        """Pairs of a coefficient and a word of ``NumberField.monomials``."""
        coefficients = self.field.in_radicals(self)
        for coefficient, word in zip(coefficients, self.field.monomials, strict=True):
            if coefficient:
                yield coefficient, word

    def __repr__(self) -> str:
        text = ""
        for coefficient, word in self.terms():
            sign = " - " if coefficient < 0 else " + "
            text += sign + self.term(coefficient, word)
        if text.startswith(" - "):
            return "-" + text.removeprefix(" - ")
        return text.removeprefix(" + ")

    def term(self, coefficient: fmpq, word: Word, size: str = "") -> str:
        """An unsigned multiple of radicals such as ``4*sqrt(3)/27``."""
        factors = []
        for factor, power in self.field.powers(word):
            if power > 1:
                factor += f"**{power}"
            factors.append(factor)
        if size:
            return "*".join([size, *factors])
        numerator = abs(coefficient.p)
        denominator = coefficient.q
        if numerator != 1 or not factors:
            factors.insert(0, str(numerator))
        product = "*".join(factors)
        if denominator == 1:
            return product
        return f"{product}/{denominator}"


Number: TypeAlias = fmpq | Algebraic


def poly_of(number: Number) -> fmpq_poly:
    return number.poly if isinstance(number, Algebraic) else fmpq_poly([number])


def with_radicals(number: Number, radicals: Sequence[Any]) -> Any:
    if not isinstance(number, Algebraic):
        return number
    total: Any = ZERO
    for coefficient, word in number.terms():
        total = total + prod((radicals[i] for i in word), start=coefficient)
    return total


def coordinates(number: Number, degree: int) -> list[fmpq]:
    if isinstance(number, Algebraic):
        return [number.poly[k] for k in range(degree)]
    return [number] + [ZERO] * (degree - 1)


def flat(numbers: Iterable[Number], degree: int) -> list[fmpq]:
    if degree == 1:
        return cast("list[fmpq]", list(numbers))
    return [x for number in numbers for x in coordinates(number, degree)]


def sum_of_products(pairs: Sequence[tuple[Number, Number]]) -> Number:
    """Σ x y over pairs with at least one irrational number each, reduced once."""
    irrational = (x for x in pairs[0] if isinstance(x, Algebraic))
    field = next(irrational).field
    total = fmpq_poly()
    for x, y in pairs:
        total += _in_theta(x, field) * _in_theta(y, field)
    return field.element(total)


def _in_theta(number: Number, field: NumberField) -> fmpq_poly | fmpq:
    if not isinstance(number, Algebraic):
        return number
    if number.field is not field:
        raise TypeError("numbers of two different fields")
    return number.poly
