"""Polynomials in one variable over ℚ or a number field."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Self

from flint import arb, ctx, fmpq, fmpq_mpoly, fmpq_poly, fmpz_poly, nmod_poly

from garkcli.deadline import check_time
from garkcli.exact.common_divisors import candidates
from garkcli.exact.conjugates import Image, images, norm_in_balls, over_integers
from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Algebraic, Number, NumberField, modulo, poly_of
from garkcli.exact.matrix import Matrix, characteristic_coefficients, is_rational, to_flint
from garkcli.graph import components


class Polynomial:
    """Σ a_k x^k with exact coefficients a_0, a_1, …; zeros at the end are dropped.

    >>> x = Polynomial([0, 1])
    >>> (x * x - 2) % (x - 1)
    Polynomial([-1])
    """

    __slots__ = ("_images", "_norm", "coefficients")

    def __init__(self, coefficients: Iterable[Number | int]) -> None:
        kept = [fmpq(a) if isinstance(a, int) else a for a in coefficients]
        while kept and not kept[-1]:
            kept.pop()
        self.coefficients: tuple[Number, ...] = tuple(kept)
        self._norm: fmpz_poly | None = None
        self._images: dict[int, list[Image] | None] = {}

    @classmethod
    def from_flint(cls, poly: fmpq_poly | fmpz_poly) -> Self:
        return cls([fmpq(a) for a in poly.coeffs()])

    @property
    def degree(self) -> int:
        """The degree; −1 for the zero polynomial."""
        return len(self.coefficients) - 1

    @property
    def leading(self) -> Number:
        if not self.coefficients:
            return ZERO
        return self.coefficients[-1]

    @property
    def field(self) -> NumberField | None:
        for a in self.coefficients:
            if isinstance(a, Algebraic):
                return a.field
        return None

    @property
    def is_rational(self) -> bool:
        return self.field is None

    def to_flint(self) -> fmpq_poly:
        return fmpq_poly(list(self.coefficients))  # type: ignore[arg-type]

    def __bool__(self) -> bool:
        return bool(self.coefficients)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Polynomial):
            return False
        return self.coefficients == other.coefficients

    def __hash__(self) -> int:
        return hash(self.coefficients)

    def __reduce__(self) -> tuple[Callable[..., Polynomial], tuple[object, ...]]:
        return type(self), (self.coefficients,)  # images are made again

    def __repr__(self) -> str:
        coefficients = ", ".join(map(str, self.coefficients))
        return f"Polynomial([{coefficients}])"

    def __neg__(self) -> Polynomial:
        return Polynomial([-a for a in self.coefficients])

    def __add__(self, other: Polynomial | Number | int) -> Polynomial:
        right = _as_polynomial(other)
        coefficients = [self[k] + right[k] for k in range(max(self.degree, right.degree) + 1)]
        return Polynomial(coefficients)

    def __sub__(self, other: Polynomial | Number | int) -> Polynomial:
        return self + -_as_polynomial(other)

    def __mul__(self, other: Polynomial | Number | int) -> Polynomial:
        right = _as_polynomial(other)
        if self.is_rational and right.is_rational:
            return Polynomial.from_flint(self.to_flint() * right.to_flint())
        product: list[Number] = [ZERO] * (len(self.coefficients) + len(right.coefficients))
        for i, a in enumerate(self.coefficients):
            check_time()
            for k, b in enumerate(right.coefficients, start=i):
                product[k] = product[k] + a * b
        return Polynomial(product)

    def __pow__(self, exponent: int) -> Polynomial:
        result = Polynomial([1])
        for _ in range(exponent):
            result = result * self
        return result

    def __getitem__(self, k: int) -> Number:
        """The coefficient of x^k, zero beyond the degree."""
        if k >= len(self.coefficients):
            return ZERO
        return self.coefficients[k]

    def __divmod__(self, divisor: Polynomial) -> tuple[Polynomial, Polynomial]:
        """Quotient and remainder. Raises ZeroDivisionError if the divisor is zero."""
        if not divisor:
            raise ZeroDivisionError("division by the zero polynomial")
        if self.is_rational and divisor.is_rational:
            in_flint = divmod(self.to_flint(), divisor.to_flint())
            quotient, remainder = map(Polynomial.from_flint, in_flint)
            return quotient, remainder
        inverse = ONE / divisor.leading
        rest = list(self.coefficients)
        quotients: list[Number] = [ZERO] * max(self.degree - divisor.degree + 1, 0)
        for k in reversed(range(len(quotients))):
            check_time()
            factor = rest[k + divisor.degree] * inverse
            quotients[k] = factor
            for j, b in enumerate(divisor.coefficients, start=k):
                rest[j] = rest[j] - factor * b
        return Polynomial(quotients), Polynomial(rest)

    def __floordiv__(self, divisor: Polynomial) -> Polynomial:
        return divmod(self, divisor)[0]

    def __mod__(self, divisor: Polynomial) -> Polynomial:
        return divmod(self, divisor)[1]

    def monic(self) -> Polynomial:
        if not self:
            return self
        return self * (ONE / self.leading)

    def derivative(self) -> Polynomial:
        return Polynomial([a * k for k, a in enumerate(self.coefficients)][1:])

    def reversed(self, degree: int) -> Polynomial:
        return Polynomial([self[k] for k in range(degree, -1, -1)])

    def substituted(self, inner: Polynomial) -> Polynomial:
        result = Polynomial([])  # Horner's rule
        for a in reversed(self.coefficients):
            result = result * inner + a
        return result

    def __call__(self, x: Number) -> Number:
        value: Number = ZERO
        for a in reversed(self.coefficients):
            value = value * x + a
        return value

    def enclosed_at(self, x: arb) -> arb:
        digits = int(ctx.prec / 3.32) + 1
        value = arb(0)
        for a in reversed(self.coefficients):
            value = value * x + to_ball(a, digits)
        return value

    def square_free(self) -> Polynomial:
        """The monic polynomial with the same roots, each simple."""
        return (self // gcd(self, self.derivative())).monic()

    def norm(self) -> fmpz_poly:
        """A polynomial over ℤ whose roots are those of this one and its conjugates."""
        if self._norm is None:
            self._norm = self._norm_of(self.field)
        return self._norm

    def _norm_of(self, field: NumberField | None) -> fmpz_poly:
        if field is None:
            return self.to_flint().numer()
        found = norm_in_balls(over_integers([poly_of(a) for a in self.coefficients]), field)
        return self._norm_by_resultants(field) if found is None else found

    def images(self, field: NumberField, bits: int) -> list[Image] | None:
        if bits not in self._images:
            integral = over_integers([poly_of(a) for a in self.coefficients])
            self._images[bits] = images(integral, field, bits)
        return self._images[bits]

    def _norm_by_resultants(self, field: NumberField) -> fmpz_poly:
        """The norm by interpolation at integers, for conjugates that are too close to isolate."""
        degree = field.degree * self.degree
        first = -(degree // 2)
        points = [fmpq(first + k) for k in range(degree + 1)]
        values = []
        for point in points:
            check_time()
            # the norm of a(θ) is its resultant with the minimal polynomial of θ
            values.append(field.modulus.resultant(poly_of(self(point))))
        return interpolated(points, values).to_flint().numer()


def _as_polynomial(value: Polynomial | Number | int) -> Polynomial:
    if isinstance(value, Polynomial):
        return value
    return Polynomial([value])


def squared_on_axis(p: Sequence[Any]) -> list[Any]:
    """Coefficients in x = y² of |p(iy)|² = Σ (−1)^((j − k)/2) p_j p_k x^((j + k)/2), j + k even.

    >>> squared_on_axis([1, 2, 3])  # (1 − 3x)² + 4x
    [1, -2, 9]
    """
    total = [a * 0 for a in p]
    for j, a in enumerate(p):
        for k in range(j, len(p), 2):
            term = a * p[k]
            sign = -1 if (k - j) % 4 else 1
            power = (j + k) // 2
            total[power] = total[power] + term * (sign if k == j else 2 * sign)
    return total


def in_one(p: fmpq_mpoly, variable: int = 0) -> Polynomial:
    powers = {int(e[variable]): fmpq(a) for e, a in p.to_dict().items()}
    return Polynomial([powers.get(k, ZERO) for k in range(max(powers, default=-1) + 1)])


def interpolated(points: Sequence[fmpq], values: Sequence[Number]) -> Polynomial:
    """The polynomial of least degree through distinct points, by Newton's divided differences.

    >>> interpolated([fmpq(0), fmpq(1), fmpq(2)], [fmpq(1), fmpq(2), fmpq(5)])
    Polynomial([1, 0, 1])
    """
    table = list(values)
    for k in range(1, len(points)):
        check_time()
        for i in reversed(range(k, len(points))):
            distance = points[i] - points[i - k]
            difference = table[i] - table[i - 1]
            table[i] = difference / distance
    result = Polynomial([])
    for point, difference in zip(reversed(points), reversed(table), strict=True):
        check_time()
        result = result * Polynomial([-point, ONE]) + difference
    return result


def subresultant(a: Polynomial, b: Polynomial, k: int) -> Number:
    """The principal subresultant coefficient of index k of a and b, deg a ≥ deg b, by Euclid.

    The first nonzero one has the degree of the greatest common divisor as its index; that of index
    0 is the resultant (S. Basu, R. Pollack, M.-F. Roy, section 8.3).

    >>> x = Polynomial([0, 1])
    >>> subresultant(x * (x - 1), x * (x - 3), 0), subresultant(x * (x - 1), x * (x - 3), 1)
    (0, -2)
    """
    result: Number = ONE
    while b.degree > k:
        rest = a % b
        if not rest:
            return ZERO
        if (a.degree - k) % 2 and (b.degree - k) % 2:
            result = -result
        result = result * b.leading ** (a.degree - rest.degree)
        a, b = b, rest
    if b.degree < k:
        return ZERO
    return result * b.leading ** (a.degree - k)


def gcd(a: Polynomial, b: Polynomial) -> Polynomial:
    """The monic greatest common divisor; 0 for two zeros.

    >>> gcd(Polynomial([-1, 0, 1]), Polynomial([1, 1]))
    Polynomial([1, 1])
    """
    if a.is_rational and b.is_rational:
        return Polynomial.from_flint(a.to_flint().gcd(b.to_flint())).monic()
    if not a or not b:
        return (a or b).monic()
    field = a.field or b.field
    assert field is not None
    if _are_coprime_modulo_a_prime(a, b, field):
        return Polynomial([1])
    over, under = ([poly_of(x) for x in p.coefficients] for p in (a, b))
    divisors = (Polynomial(map(field.element, g)) for g in candidates(over, under, field))
    return next(g for g in divisors if not a % g and not b % g)


def _are_coprime_modulo_a_prime(a: Polynomial, b: Polynomial, field: NumberField) -> bool:
    """A common divisor over the field would have degree ≥ 1 modulo the prime too."""
    if field.place is None:
        return False
    p, root = field.place
    try:
        f, g = (
            nmod_poly([int(modulo(poly_of(x), p)(root)) for x in q.coefficients], p) for q in (a, b)
        )
    except ZeroDivisionError:  # p divides a denominator
        return False
    return f.degree() == a.degree and f.gcd(g).degree() == 0


def reciprocal_characteristic(W: Matrix) -> Polynomial:
    """det(I − z W), the product over the strongly connected components of the graph of W.

    >>> half = fmpq(1, 2)
    >>> reciprocal_characteristic(((half, half), (half, half)))
    Polynomial([1, -1])
    """
    neighbours: dict[int, list[int]] = {}
    for i, row in enumerate(W):
        neighbours[i] = [j for j, w in enumerate(row) if w]
    result = Polynomial([1])
    for component in components(neighbours):
        result = result * _dense(tuple(tuple(W[i][j] for j in component) for i in component))
    return result


def _dense(W: Matrix) -> Polynomial:
    size = len(W)
    if size == 1:
        [[entry]] = W
        return Polynomial([ONE, -entry])
    if is_rational(W):
        return Polynomial.from_flint(to_flint(W, size).charpoly()).reversed(size)
    return Polynomial(characteristic_coefficients(W))
