"""A number field in ℂ, once for every root of its minimal polynomial.

The norm of p ∈ K[x] is the product of the images of p under all embeddings of K in ℂ. Over ℤ its
coefficients are integers, and balls that hold one integer each are these. The multiplicity of a
real number x in the norm is the sum of those in the images: if balls bound each of them by m_σ, and
Σ m_σ is that of the norm, the bounds are attained. So nothing is divided in K, where numbers get
long.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from flint import acb, acb_mat, acb_poly, arb, arb_poly, ctx, fmpq_poly, fmpz, fmpz_poly

from garkcli.deadline import check_time
from garkcli.exact.display import to_ball
from garkcli.exact.field import NumberField
from garkcli.frozen import Frozen

SPARE = 64
"""Bits beyond those of a coefficient."""
FIRST_BITS = 128
"""Above this precision roots are refined by Newton's method."""
DIGITS = 20
"""First number of digits to tell θ from its conjugates; it doubles until they differ."""
MOST_BITS_APART = 1024
"""Roots closer than so many bits resolve are not isolated."""


class Image(Frozen):
    """An image u + iv under an embedding in ℂ, and its conjugate; in ℝ ``imaginary`` is None."""

    real: arb_poly
    imaginary: arb_poly | None

    @property
    def weight(self) -> int:
        """The number of embeddings that the image represents."""
        return 1 if self.imaginary is None else 2

    @property
    def norm(self) -> arb_poly:
        if self.imaginary is None:
            return self.real
        return self.real * self.real + self.imaginary * self.imaginary

    def multiplicity(self, x: arb) -> int:
        """An upper bound of the multiplicity of the root x."""
        parts = [self.real] if self.imaginary is None else [self.real, self.imaginary]
        count = 0
        while any(len(p) for p in parts) and all(p(x).contains(0) for p in parts):
            count += 1
            parts = [p.derivative() for p in parts]
        return count


@lru_cache(maxsize=64)
def conjugates(field: NumberField, bits: int) -> tuple[acb, ...] | None:
    """Returns the roots of the minimal polynomial with imaginary part ≥ 0, to about ``bits`` bits;
    θ first if the radicals of the field identify it. None if two are too close to isolate.
    """
    check_time()
    modulus = field.modulus.numer()
    if bits <= FIRST_BITS:
        return _first_conjugates(field, modulus)
    wider = conjugates(field, bits // 2 + 8)
    return wider and tuple(_narrowed(modulus, z, bits) for z in wider)


def _first_conjugates(field: NumberField, modulus: fmpz_poly) -> tuple[acb, ...] | None:
    try:
        acb_poly(modulus).roots(maxprec=MOST_BITS_APART)
    except ValueError:
        return None
    with ctx.workprec(FIRST_BITS):
        found: list[Any] = modulus.complex_roots()
        roots = [z for z, _ in found if z.imag.is_zero() or z.imag > 0]
    if not field.radicals:
        return tuple(roots)
    theta = field.element(fmpq_poly([0, 1]))
    nearest = [z for z in roots if z.imag.is_zero()]
    digits = DIGITS
    while len(nearest) > 1:
        check_time()
        ball = to_ball(theta, digits)
        nearest = [z for z in nearest if z.real.overlaps(ball)]
        digits *= 2
    return (*nearest, *(z for z in roots if z is not nearest[0]))


def _narrowed(modulus: fmpz_poly, ball: acb, bits: int) -> acb:
    """Doubles the precision of a root by an interval Newton step."""
    check_time()
    with ctx.workprec(bits + 32):
        middle = acb(ball.real.mid(), ball.imag.mid())
        p = acb_poly(modulus)
        return middle - p(middle) / p.derivative()(ball)


def images(p: Sequence[fmpz_poly], field: NumberField, bits: int) -> list[Image] | None:
    """The images of Σ p_k(θ) x^k in the order of ``conjugates``; None if θ has close conjugates."""
    roots = conjugates(field, bits)
    if roots is None:
        return None
    length = max(map(len, p))
    with ctx.workprec(bits):
        powers = acb_mat([[z**j for j in range(length)] for z in roots])
        rows = (powers * acb_mat([[a[j] for a in p] for j in range(length)])).tolist()
        return [
            Image(
                arb_poly([a.real for a in row]),
                None if z.imag.is_zero() else arb_poly([a.imag for a in row]),
            )
            for z, row in zip(roots, rows, strict=True)
        ]


def over_integers(p: Sequence[fmpq_poly]) -> list[fmpz_poly]:
    """A positive integer multiple of Σ p_k(θ) x^k with integer coefficients."""
    denominator = fmpz(1)
    for a in p:
        denominator = denominator.lcm(a.denom())
    return [a.numer() * (denominator // a.denom()) for a in p]


def norm_in_balls(p: Sequence[fmpz_poly], field: NumberField) -> fmpz_poly | None:
    """Returns an integer multiple of the norm of Σ p_k(θ) x^k ≠ 0; None if ``images`` has none."""
    # a product over the roots of c θ^d + … of polynomials of degree n in θ becomes integral by c^n
    leading = abs(field.modulus.numer().leading_coefficient())
    scale = leading ** (max(map(len, p)) - 1)
    bits = SPARE + max(int(a.height_bits()) for a in p)
    while True:
        found = images(p, field, bits)
        if found is None:
            return None
        with ctx.workprec(bits):
            product = arb_poly([scale])
            for image in found:
                check_time()
                product *= image.norm
            integral = product.unique_fmpz_poly()
        if integral is not None:
            return integral
        bits += max(16, *(_exponent(a.rad()) for a in product.coeffs()))


def _exponent(x: arb) -> int:
    if not x.is_finite():
        return FIRST_BITS
    mantissa, exponent = x.abs_upper().man_exp()
    return int(exponent) + int(mantissa).bit_length()
