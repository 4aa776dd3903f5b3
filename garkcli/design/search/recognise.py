"""Rational and algebraic numbers recognised from many digits.

The result is a guess, which an exact certificate must confirm; a wrong guess is harmless.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import arb, ctx, fmpq, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

from garkcli.deadline import check_time
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number, NumberField
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import Frozen

MAX_DEGREE = 8


class RecognisedNumbers(Frozen):
    """Numbers of the field of ``root``, 0 for ℚ, whose minimal polynomial is ``modulus``, monic."""

    values: Mapping[str, Number]
    modulus: fmpq_poly
    root: RealRoot


def recognised(numbers: Mapping[str, arb], bits: int) -> RecognisedNumbers | None:
    """Short exact numbers with so many correct bits, balls without radius; None without any."""
    values: dict[str, Number] = {}
    irrational: dict[str, arb] = {}
    for name, number in numbers.items():
        value = rational(number, bits)
        if value is None:
            irrational[name] = number
        else:
            values[name] = value
    if not irrational:
        return RecognisedNumbers(values, fmpq_poly([0, 1]), RealRoot.rational(fmpq(0)))
    minimal = _generator(irrational, bits)
    if minimal is None:
        return None
    polynomial, generator = minimal
    modulus = fmpq_poly(polynomial) / fmpq(polynomial[polynomial.degree()])
    field = NumberField(modulus, ())
    root = _root(modulus, generator)
    if root is None:
        return None
    for name, number in irrational.items():
        coordinates = _coordinates(number, generator, field.degree, bits)
        if coordinates is None:
            return None
        values[name] = field.from_coordinates(coordinates)
    return RecognisedNumbers(values, modulus, root)


def rational(number: arb, bits: int) -> fmpq | None:
    """The rational number with these digits, if it has at most a third as many.

    >>> with ctx.workprec(200):
    ...     rational((arb(22) / 7).mid(), 190)
    22/7
    """
    exact = midpoint(number)
    grain = fmpq(1, fmpz(2) ** (3 * bits // 4))
    simplest = _simplest(exact - grain, exact + grain)
    length = max(simplest.p.bit_length(), simplest.q.bit_length())
    return simplest if length <= bits // 4 else None


def _simplest(low: fmpq, high: fmpq) -> fmpq:
    """The number with the least denominator between two, by continued fractions."""
    if low <= 0 <= high:
        return fmpq(0)
    if high < 0:
        return -_simplest(-high, -low)
    terms: list[fmpz] = []
    while True:
        integral = low.floor()
        if low == integral or integral < high.floor():
            terms.append(integral if low == integral else integral + 1)
            break
        terms.append(integral)
        low, high = 1 / (high - integral), 1 / (low - integral)
    value = fmpq(terms[-1])
    for term in reversed(terms[:-1]):
        value = term + 1 / value
    return value


def _generator(irrational: Mapping[str, arb], bits: int) -> tuple[fmpz_poly, arb] | None:
    """The minimal polynomial of the number with the largest degree, and that number."""
    best: tuple[fmpz_poly, arb] | None = None
    for number in irrational.values():
        polynomial = minimal_polynomial(number, bits)
        if polynomial is None:
            return None
        if best is None or polynomial.degree() > best[0].degree():
            best = polynomial, number
    return best


def minimal_polynomial(number: arb, bits: int) -> fmpz_poly | None:
    """A polynomial of least degree with short coefficients, zero at a number up to its digits.

    >>> with ctx.workprec(300):
    ...     minimal_polynomial(arb(2).sqrt().mid(), 290)
    x^2 + (-2)
    """
    for degree in range(1, MAX_DEGREE + 1):
        check_time()
        with ctx.workprec(bits):
            powers = [number**k for k in range(degree + 1)]
        relation = _relation(powers, bits)
        if relation is not None:
            _, factors = fmpz_poly(relation).factor()
            with ctx.workprec(bits):
                return min((f for f, _ in factors), key=lambda f: abs(f(number)).mid())
    return None


def _relation(numbers: Sequence[arb], bits: int) -> list[fmpz] | None:
    """Short integers with Σ m_k x_k = 0 up to digits (A. Lenstra, H. Lenstra, L. Lovász, 1982)."""
    size = len(numbers)
    scale_bits = 7 * bits // 8
    with ctx.workprec(bits):
        scaled = [(x * arb(2) ** scale_bits + arb(0.5)).floor().mid() for x in numbers]
    rows = []
    for k, x in enumerate(scaled):
        row = [fmpz(int(k == j)) for j in range(size)]
        rows.append([*row, midpoint(x).p])
    shortest = fmpz_mat(rows).lll()
    relation = [shortest[0, j] for j in range(size)]
    # a random lattice has vectors of kept/size bits
    bound = scale_bits // (2 * size)
    longest = max(int(shortest[0, j]).bit_length() for j in range(size + 1))
    return relation if longest <= bound else None


def _coordinates(number: arb, generator: arb, degree: int, bits: int) -> list[fmpq] | None:
    """Coefficients as a polynomial in the generator."""
    with ctx.workprec(bits):
        powers = [generator**k for k in range(degree)]
    relation = _relation([number, *powers], bits)
    if relation is None or not relation[0]:
        return None
    return [fmpq(-x, relation[0]) for x in relation[1:]]


def _root(modulus: fmpq_poly, generator: arb) -> RealRoot | None:
    roots = [root for root, _ in real_roots(Polynomial.from_flint(modulus))]
    if not roots:
        return None
    return min(roots, key=lambda root: abs(root.ball(256) - generator).mid())
