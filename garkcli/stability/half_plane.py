"""Whether all roots of a polynomial with complex coefficients lie in the right half plane.

By the theorem of Hermite and Biehler: with Q(iy) = u(y) + i v(y), u of the degree of Q and v of a
smaller one, that is so when the Cauchy index of v/u over the real line is that degree.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb

from garkcli.exact.enclosing import cauchy_index
from garkcli.exact.field import ZERO
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.stability.linear import exact_cauchy_index


def ball_roots_are_right(u: Sequence[arb], v: Sequence[arb]) -> bool | None:
    """Whether Q(iy) = u + iv has all its roots to the right, by Hermite and Biehler."""
    degree = max(len(u), len(v)) - 1
    real, imaginary = _turned(u, v, degree, arb(0))
    index = cauchy_index(real, imaginary)
    if index is None:
        return None
    return index == degree


def exact_roots_are_right(u: Polynomial, v: Polynomial) -> bool:
    """The same exactly."""
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
    """U + iv times the conjugate of its leading coefficient, so that u alone has the degree."""
    count = degree + 1
    u = [*u, *[zero] * (count - len(u))]
    v = [*v, *[zero] * (count - len(v))]
    c = u[degree]
    s = v[degree]
    pairs = list(zip(u, v, strict=True))
    real = [c * x + s * y for x, y in pairs]
    imaginary = [c * y - s * x for x, y in pairs]
    return real, imaginary[:degree]
