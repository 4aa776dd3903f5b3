"""Polynomials in one variable over ℚ or a number field, and their real roots.

A real root is kept as an irreducible polynomial over ℚ with the number of the root, so that roots
are equal exactly when they are the same number. Enclosures only tell apart what is known to differ.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache, total_ordering
from typing import Any, Self

from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly, fmpz_poly

from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Algebraic, Number, NumberField, coordinates

FIRST_BITS = 64
"""The precision at which signs are tried first; it doubles until they are decided."""


class Polynomial:
    """Σ a_k x^k with exact coefficients.

    Args:
        coefficients: a_0, a_1, …; zeros at the end are dropped.

    >>> x = Polynomial([0, 1])
    >>> (x * x - 2) % (x - 1)
    Polynomial([-1])
    """

    __slots__ = ("coefficients",)

    def __init__(self, coefficients: Iterable[Number | int]) -> None:
        kept = [fmpq(a) if isinstance(a, int) else a for a in coefficients]
        while kept and not kept[-1]:
            kept.pop()
        self.coefficients: tuple[Number, ...] = tuple(kept)

    @classmethod
    def from_flint(cls, poly: fmpq_poly | fmpz_poly) -> Self:
        """The same polynomial, from python-flint."""
        return cls([fmpq(a) for a in poly.coeffs()])

    @property
    def degree(self) -> int:
        """The degree; −1 of the zero polynomial."""
        return len(self.coefficients) - 1

    @property
    def leading(self) -> Number:
        """The leading coefficient; 0 of the zero polynomial."""
        return self.coefficients[-1] if self.coefficients else ZERO

    @property
    def field(self) -> NumberField | None:
        """The number field of the coefficients; None when all are rational."""
        return next(
            (a.field for a in self.coefficients if isinstance(a, Algebraic)), None
        )

    @property
    def is_rational(self) -> bool:
        """Whether all coefficients are rational."""
        return self.field is None

    def to_flint(self) -> fmpq_poly:
        """The same polynomial for python-flint; its coefficients are rational."""
        return fmpq_poly([a for a in self.coefficients if isinstance(a, fmpq)])

    def __bool__(self) -> bool:
        return bool(self.coefficients)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polynomial) and self.coefficients == other.coefficients

    def __hash__(self) -> int:
        return hash(self.coefficients)

    def __repr__(self) -> str:
        return f"Polynomial([{', '.join(str(a) for a in self.coefficients)}])"

    def __neg__(self) -> Polynomial:
        return Polynomial([-a for a in self.coefficients])

    def __add__(self, other: Polynomial | Number | int) -> Polynomial:
        right = _as_polynomial(other)
        n = max(len(self.coefficients), len(right.coefficients))
        return Polynomial([self[k] + right[k] for k in range(n)])

    def __sub__(self, other: Polynomial | Number | int) -> Polynomial:
        return self + -_as_polynomial(other)

    def __mul__(self, other: Polynomial | Number | int) -> Polynomial:
        right = _as_polynomial(other)
        if self.is_rational and right.is_rational:
            return Polynomial.from_flint(self.to_flint() * right.to_flint())
        product: list[Number] = [ZERO] * max(
            len(self.coefficients) + len(right.coefficients), 1
        )
        for i, a in enumerate(self.coefficients):
            for j, b in enumerate(right.coefficients):
                product[i + j] = product[i + j] + a * b
        return Polynomial(product)

    def __pow__(self, exponent: int) -> Polynomial:
        result = Polynomial([1])
        for _ in range(exponent):
            result = result * self
        return result

    def __getitem__(self, k: int) -> Number:
        """The coefficient of x^k, zero beyond the degree."""
        return self.coefficients[k] if k < len(self.coefficients) else ZERO

    def __divmod__(self, divisor: Polynomial) -> tuple[Polynomial, Polynomial]:
        """Quotient and remainder.

        Raises:
            ZeroDivisionError: the divisor is zero.
        """
        if not divisor:
            raise ZeroDivisionError("division by the zero polynomial")
        if self.is_rational and divisor.is_rational:
            quotient, remainder = divmod(self.to_flint(), divisor.to_flint())
            return Polynomial.from_flint(quotient), Polynomial.from_flint(remainder)
        inverse = ONE / divisor.leading
        rest = list(self.coefficients)
        quotients: list[Number] = [ZERO] * max(self.degree - divisor.degree + 1, 0)
        for k in reversed(range(len(quotients))):
            factor = rest[k + divisor.degree] * inverse
            quotients[k] = factor
            for j, b in enumerate(divisor.coefficients):
                rest[k + j] = rest[k + j] - factor * b
        return Polynomial(quotients), Polynomial(rest)

    def __floordiv__(self, divisor: Polynomial) -> Polynomial:
        return divmod(self, divisor)[0]

    def __mod__(self, divisor: Polynomial) -> Polynomial:
        return divmod(self, divisor)[1]

    def monic(self) -> Polynomial:
        """The multiple with leading coefficient 1; zero stays zero."""
        return self * (ONE / self.leading) if self else self

    def derivative(self) -> Polynomial:
        """The derivative."""
        return Polynomial([a * k for k, a in enumerate(self.coefficients)][1:])

    def reversed(self, degree: int) -> Polynomial:
        """The polynomial x^degree p(1/x)."""
        return Polynomial([self[degree - k] for k in range(degree + 1)])

    def substituted(self, inner: Polynomial) -> Polynomial:
        """The composition p(inner(x)), by Horner's rule."""
        result = Polynomial([])
        for a in reversed(self.coefficients):
            result = result * inner + a
        return result

    def __call__(self, x: Number) -> Number:
        """The value at an exact number, by Horner's rule."""
        value: Number = ZERO
        for a in reversed(self.coefficients):
            value = value * x + a
        return value

    def enclosed_at(self, x: arb) -> arb:
        """The value at a ball, at the current precision."""
        digits = int(ctx.prec / 3.32) + 1
        value = arb(0)
        for a in reversed(self.coefficients):
            value = value * x + to_ball(a, digits)
        return value

    def square_free(self) -> Polynomial:
        """The monic polynomial with the same roots, each once."""
        return (self // gcd(self, self.derivative())).monic()

    def norm(self) -> fmpz_poly:
        """A polynomial over ℤ that has all roots of this one, and those of its conjugates.

        The norm of p ∈ K[x] is the determinant of multiplication by p on K[x] over ℚ[x]; it is
        found from its values at integers.
        """
        field = self.field
        if field is None:
            return self.to_flint().numer()
        degree = field.degree * self.degree
        points = [fmpq(k - degree // 2) for k in range(degree + 1)]
        values = [_norm_of(self(point), field) for point in points]
        return interpolated(points, values).to_flint().numer()


def _as_polynomial(value: Polynomial | Number | int) -> Polynomial:
    return value if isinstance(value, Polynomial) else Polynomial([value])


def _norm_of(number: Number, field: NumberField) -> fmpq:
    """The norm of an element of a field over ℚ."""
    d = field.degree
    powers = [
        field.from_coordinates([fmpq(int(i == k)) for i in range(d)]) for k in range(d)
    ]
    return fmpq_mat([coordinates(number * power, d) for power in powers]).det()


def interpolated(points: Sequence[fmpq], values: Sequence[Number]) -> Polynomial:
    """The polynomial of least degree through points, by Newton's divided differences.

    Args:
        points: distinct rational numbers.
        values: its values there.

    >>> interpolated([fmpq(0), fmpq(1), fmpq(2)], [fmpq(1), fmpq(2), fmpq(5)])
    Polynomial([1, 0, 1])
    """
    table = list(values)
    for k in range(1, len(points)):
        for i in reversed(range(k, len(points))):
            table[i] = (table[i] - table[i - 1]) / (points[i] - points[i - k])
    result = Polynomial([])
    for point, value in zip(reversed(points), reversed(table), strict=True):
        result = result * Polynomial([-point, ONE]) + value
    return result


def resultant(a: Polynomial, b: Polynomial) -> Number:
    """The resultant of two polynomials ≠ 0, by Euclid's algorithm.

    >>> resultant(Polynomial([-1, 1]), Polynomial([-3, 1]))
    -2
    """
    result: Number = ONE
    while b.degree > 0:
        rest = a % b
        if not rest:
            return ZERO
        if a.degree % 2 and b.degree % 2:
            result = -result
        result = result * b.leading ** (a.degree - rest.degree)
        a, b = b, rest
    return result * b.leading**a.degree


def gcd(a: Polynomial, b: Polynomial) -> Polynomial:
    """The monic greatest common divisor; 0 of two zeros.

    >>> gcd(Polynomial([-1, 0, 1]), Polynomial([1, 1]))
    Polynomial([1, 1])
    """
    if a.is_rational and b.is_rational:
        return Polynomial.from_flint(a.to_flint().gcd(b.to_flint())).monic()
    while b:
        a, b = b, (a % b).monic()
    return a.monic()


def sign(number: Number) -> int:
    """The sign of an exact number, −1, 0 or 1: zero is known exactly, the rest by enclosures."""
    if not isinstance(number, Algebraic):
        return (number > 0) - (number < 0)
    digits = FIRST_BITS * 3 // 10
    while True:
        ball = to_ball(number, digits)
        if ball > 0 or ball < 0:
            return 1 if ball > 0 else -1
        digits *= 2


@total_ordering
@dataclass(frozen=True)
class RealRoot:
    """A real algebraic number.

    Attributes:
        polynomial: its minimal polynomial over ℤ, primitive with a positive leading coefficient.
        number: which of the real roots of that it is, counted from 0 in ascending order.
    """

    polynomial: fmpz_poly
    number: int

    def __hash__(self) -> int:
        return hash((tuple(int(a) for a in self.polynomial.coeffs()), self.number))

    @classmethod
    def rational(cls, value: fmpq) -> RealRoot:
        """A rational number as a root."""
        return cls(fmpz_poly([-value.p, value.q]), 0)

    @property
    def exact(self) -> fmpq | None:
        """The number itself where it is rational."""
        if self.polynomial.degree() > 1:
            return None
        return -fmpq(self.polynomial[0]) / fmpq(self.polynomial[1])

    def ball(self, bits: int) -> arb:
        """An enclosure with about ``bits`` correct bits."""
        if self.exact is not None:
            with _precision(bits):
                return arb(self.exact)
        return _real_roots(tuple(int(a) for a in self.polynomial.coeffs()), bits)[
            self.number
        ]

    def __lt__(self, other: RealRoot) -> bool:
        if self.polynomial == other.polynomial:
            return self.number < other.number
        bits = FIRST_BITS
        while True:
            mine, theirs = self.ball(bits), other.ball(bits)
            if mine < theirs or mine > theirs:
                return bool(mine < theirs)
            bits *= 2

    def __repr__(self) -> str:
        return f"RealRoot({self.polynomial}, {self.number})"


class _precision:  # noqa: N801 -- used as a function
    """``flint.ctx.prec`` for a while."""

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def __enter__(self) -> None:
        self.before = ctx.prec
        ctx.prec = self.bits

    def __exit__(self, *_: object) -> None:
        ctx.prec = self.before


@lru_cache(maxsize=512)
def _real_roots(coefficients: tuple[int, ...], bits: int) -> tuple[arb, ...]:
    """The real roots of an irreducible polynomial in ascending order.

    python-flint isolates all roots and gives real ones an imaginary part that is exactly zero.
    """
    with _precision(bits):
        found: list[Any] = fmpz_poly(list(coefficients)).complex_roots()
        real = [root.real for root, _ in found if root.imag == 0]
        return tuple(sorted(real, key=lambda ball: ball.mid()))


def real_roots(p: Polynomial) -> list[tuple[RealRoot, int]]:
    """The distinct real roots in ascending order, with their multiplicities.

    Over a number field they are among the roots of the norm; which ones is decided by gcds.

    Raises:
        ValueError: p is zero.

    >>> real_roots(Polynomial([2, -3, 0, 1]))
    [(RealRoot(x + 2, 0), 1), (RealRoot(x + (-1), 0), 2)]
    """
    if not p:
        raise ValueError("every number is a root of the zero polynomial")
    found: list[tuple[RealRoot, int]] = []
    for factor, power in p.norm().factor()[1]:
        primitive = factor if factor[factor.degree()] > 0 else -factor
        count = len(_real_roots(tuple(int(a) for a in primitive.coeffs()), FIRST_BITS))
        for number in range(count):
            root = RealRoot(primitive, number)
            multiplicity = power if p.is_rational else multiplicity_at(p, root)
            if multiplicity:
                found.append((root, multiplicity))
    return sorted(found, key=lambda pair: pair[0])


def multiplicity_at(p: Polynomial, root: RealRoot) -> int:
    """How often ``root`` is a root of p ≠ 0, decided exactly."""
    multiplicity = 0
    while p and sign_at(p, root) == 0:
        multiplicity += 1
        p = p.derivative()
    return multiplicity


def sign_at(p: Polynomial, root: RealRoot) -> int:
    """The sign of p at a real algebraic number, decided exactly."""
    value = root.exact
    if value is not None:
        return sign(p(value))
    if not p or vanishes_at(p, root):
        return 0
    bits = FIRST_BITS
    while True:
        with _precision(bits):
            ball = p.enclosed_at(root.ball(bits))
        if ball > 0 or ball < 0:
            return 1 if ball > 0 else -1
        bits *= 2


def vanishes_at(p: Polynomial, root: RealRoot) -> bool:
    """Whether p is zero at a real algebraic number.

    With q the minimal polynomial and g = gcd(p, q), q = g · (q/g) has no multiple root, so that
    the number is a root of exactly one of the two factors; an enclosure shows of which it is none.
    """
    q = Polynomial.from_flint(root.polynomial)
    g = gcd(p, q)
    if g.degree == 0:
        return False
    if g.degree == q.degree:
        return True
    other = q // g
    bits = FIRST_BITS
    while True:
        with _precision(bits):
            ball = root.ball(bits)
            if not g.enclosed_at(ball).contains(0):
                return False
            if not other.enclosed_at(ball).contains(0):
                return True
        bits *= 2
