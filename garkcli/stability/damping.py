"""Implicit-explicit pairs: the z_E for which all z_I of the left half plane are damped.

For a fixed z_E = a + ib, |R(z_E, z_I)| ≤ 1 holds for all Re z_I ≤ 0 if all poles of z_I ↦
R(z_E, z_I) lie in the right half plane and |R(z_E, iy)| ≤ 1 for all real y, by the maximum
principle. With R = P/Q the latter says

    E(a, b, y) = |Q(z_E, iy)|² − |P(z_E, iy)|² ≥ 0   for all real y,

E a polynomial with exact coefficients. A single z_E is decided by Sturm's chain in balls, or
exactly if the balls are too wide. On the real axis E is even in y, and the interval of z_E from 0
ends at a root of a discriminant: an algebraic number.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import comb
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.exact.cells import between
from garkcli.exact.display import BITS_OF_A_DIGIT, to_ball
from garkcli.exact.enclosing import cauchy_index, root_count
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.multivariate import Exponents, Multivariate
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.exact.roots import RealRoot, is_nonnegative
from garkcli.frozen import Frozen
from garkcli.graph import components
from garkcli.stability.fraction import Fraction
from garkcli.stability.linear import exact_cauchy_index, poles_are_right
from garkcli.stability.sector import MOST_POINTS, critical_polynomials, roots_between
from garkcli.tableau.tableau import Tableau


def ball_roots_are_right(u: Sequence[arb], v: Sequence[arb]) -> bool | None:
    """Whether Q(iy) has all its roots to the right, by Hermite-Biehler; None if undecided."""
    degree = max(len(u), len(v)) - 1
    real, imaginary = _turned(u, v, degree, arb(0))
    index = cauchy_index(real, imaginary)
    if index is None:
        return None
    return index == degree


def exact_roots_are_right(u: Polynomial, v: Polynomial) -> bool:
    degree = max(u.degree, v.degree)
    if degree < 1:
        return True
    real, imaginary = _turned(u.coefficients, v.coefficients, degree, ZERO)
    f = Polynomial(real)
    g = Polynomial(imaginary)
    if gcd(f, g).degree > 0:
        return False
    return exact_cauchy_index(f, g) == degree


def _turned(
    u: Sequence[Any], v: Sequence[Any], degree: int, zero: Any
) -> tuple[list[Any], list[Any]]:
    """U + iv times the conjugate of its leading coefficient, so only u has the full degree."""
    count = degree + 1
    u = [*u, *[zero] * (count - len(u))]
    v = [*v, *[zero] * (count - len(v))]
    c = u[degree]
    s = v[degree]
    pairs = list(zip(u, v, strict=True))
    real = [c * x + s * y for x, y in pairs]
    imaginary = [c * y - s * x for x, y in pairs]
    return real, imaginary[:degree]


BITS = 192
"""If so many bits are not enough, a point is decided exactly."""


class Ray(Frozen):
    """The z_E with all z_I damped, to ``end`` in −z_E or |Im z_E|; None for ∞."""

    end: RealRoot | None


class ImexPair(Frozen):
    explicit: int
    implicit: int
    R: Fraction

    @cached_property
    def parts(self) -> tuple[tuple[Multivariate, Multivariate], ...]:
        """The real and imaginary parts of P(z_E, iy) and of Q(z_E, iy), in (a, b, y)."""
        return _split(self.R.numerator, self.explicit), _split(self.R.denominator, self.explicit)

    @cached_property
    def margin(self) -> Multivariate:
        (p, q), (u, v) = self.parts
        over = p * p + q * q
        under = u * u + v * v
        return under - over

    @cached_property
    def has_fixed_poles(self) -> bool:
        return not any(exponents[self.explicit] for exponents, _ in self.R.denominator.terms)

    @cached_property
    def fixed_poles_are_right(self) -> bool:
        """Whether the poles lie to the right, if they do not depend on z_E."""
        _, Q = self.R.with_fixed(self.explicit, ZERO)
        return poles_are_right(Q)

    @cached_property
    def _enclosed(self) -> _Enclosed:
        _, (u, v) = self.parts
        return _Enclosed(E=_in_balls(self.margin), u=_in_balls(u), v=_in_balls(v))

    def is_damped(self, a: fmpq, b: fmpq) -> bool:
        """Whether |R(a + ib, z_I)| ≤ 1 for Re z_I ≤ 0; a root of Q there counts as a pole."""
        return self._poles_are_right(a, b) and self._is_bounded(a, b)

    def _is_bounded(self, a: fmpq, b: fmpq) -> bool:
        with ctx.workprec(BITS):
            E = _values(self._enclosed.E, a, b)
            roots = root_count(E) if len(E) > 1 else None
        if roots is None:
            return is_nonnegative(_at(self.margin, a, b))
        return roots == 0 and bool(E[-1] > 0)

    def _poles_are_right(self, a: fmpq, b: fmpq) -> bool:
        if self.has_fixed_poles:
            return self.fixed_poles_are_right
        with ctx.workprec(BITS):
            u = _values(self._enclosed.u, a, b)
            v = _values(self._enclosed.v, a, b)
            found = ball_roots_are_right(u, v)
        if found is not None:
            return found
        _, (real, imaginary) = self.parts
        return exact_roots_are_right(_at(real, a, b), _at(imaginary, a, b))

    def real_ray(self) -> Ray | None:
        """The z_E ≤ 0 from 0 on with all z_I damped; None if undecided."""
        # R has real coefficients: E is even in y, and a polynomial in y²
        by_y = [_on_axis(p, axis=0) for p in self.margin.by_last()]
        return self._ray(by_y[::2], is_in_squares=True)

    def imaginary_ray(self) -> Ray | None:
        """The z_E = ib, b ≥ 0, from 0 on with all z_I damped; b < 0 is its mirror image."""
        by_y = [_on_axis(p, axis=1) for p in self.margin.by_last()]
        return self._ray(by_y, is_in_squares=False)

    def _ray(self, E: Sequence[Polynomial], is_in_squares: bool) -> Ray | None:
        """Returns the largest x with all of [0, x] damped; None if undecided. ``E`` by powers of y
        is in x = |z_E| on the imaginary axis, or, ``is_in_squares``, by powers of y² in x = −z_E.
        """
        zero = RealRoot.rational(ZERO)
        if not self.has_fixed_poles:
            return None
        if not self.fixed_poles_are_right:
            return Ray(zero)
        critical = _critical(E)
        if critical is None:
            return None
        critical += E[:1]  # where it is zero, a root passes through 0
        start = zero
        for end in [*roots_between(critical, zero, None), None]:
            x = between(start, end)
            a, b = ZERO, x
            if is_in_squares:
                a, b = -x, ZERO
            if not self._is_bounded(a, b):
                return Ray(start)
            if end is not None:
                start = end
        return Ray(None)


def imex_pair(tableau: Tableau, R: Fraction | None) -> ImexPair | None:
    """The explicit and the implicit colour of a method with two; None for others or without R."""
    explicit = explicit_colour(tableau)
    if explicit is None or R is None:
        return None
    return ImexPair(explicit, 1 - explicit, R)


def explicit_colour(tableau: Tableau) -> int | None:
    """The explicit colour, if the method has two and the other is implicit; else None."""
    if tableau.size != 2:
        return None
    first, second = (_is_explicit(tableau, l) for l in range(2))
    if first == second:
        return None
    return 0 if first else 1


def _is_explicit(tableau: Tableau, l: int) -> bool:
    block = tableau.block(l, l)
    assert block is not None
    neighbours = {}
    for i, row in enumerate(block):
        needed = [j for j, x in enumerate(row) if x]
        if i in needed:
            return False
        neighbours[i] = needed
    return all(size == 1 for size in map(len, components(neighbours)))


def _critical(E: Sequence[Polynomial]) -> list[Polynomial] | None:
    """Polynomials with the critical points of the roots of E in y; None if too many."""
    degree = len(E) - 1
    if degree < 1:
        return []
    highest = max(coefficient.degree for coefficient in E)
    # the discriminant is a determinant of 2 · degree − 1 rows of coefficients
    count = (2 * degree - 1) * highest + 1
    if count > MOST_POINTS:
        return None
    first = -(count // 2)
    points = [fmpq(k, 4) for k in range(first, first + count)]

    def member(x: fmpq) -> Polynomial:
        return Polynomial([coefficient(x) for coefficient in E])

    return critical_polynomials(member, points)


def _on_axis(p: Multivariate, axis: int) -> Polynomial:
    direction = [-ONE, ZERO]
    if axis:
        direction = [ZERO, ONE]
    return p.along(direction)


def _split(p: Multivariate, explicit: int) -> tuple[Multivariate, Multivariate]:
    """The real and imaginary parts of p(a + ib, iy) as polynomials in (a, b, y)."""
    real: dict[Exponents, Number] = {}
    imaginary: dict[Exponents, Number] = {}
    for exponents, coefficient in p.terms:
        j = exponents[explicit]
        k = exponents[1 - explicit]
        for m in range(j + 1):
            # the term of (a + ib)^j (iy)^k with b^m: i^(m+k) times real numbers
            turns = (m + k) % 4
            amount = coefficient * comb(j, m)
            if turns >= 2:
                amount = -amount
            terms = imaginary if turns % 2 else real
            power = (j - m, m, k)
            terms[power] = terms.get(power, ZERO) + amount
    return Multivariate.of(3, real), Multivariate.of(3, imaginary)


_Terms: TypeAlias = list[tuple[int, int, arb]]
"""Both exponents of (a, b) and the coefficient as a ball."""


class _Enclosed(Frozen):
    """E and the parts of Q by powers of y."""

    E: list[_Terms]
    u: list[_Terms]
    v: list[_Terms]


def _in_balls(p: Multivariate) -> list[_Terms]:
    digits = int(BITS / BITS_OF_A_DIGIT)
    return [
        [(j, k, to_ball(x, digits)) for (j, k), x in coefficient.terms]
        for coefficient in p.by_last()
    ]


def _values(by_y: Sequence[_Terms], a: fmpq, b: fmpq) -> list[arb]:
    x, y = arb(a), arb(b)
    found = []
    for terms in by_y:
        total = arb(0)
        for j, k, coefficient in terms:
            total += coefficient * x**j * y**k
        found.append(total)
    return found


def _at(p: Multivariate, a: fmpq, b: fmpq) -> Polynomial:
    point = (a, b)
    return Polynomial([coefficient(point) for coefficient in p.by_last()])
