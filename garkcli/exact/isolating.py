"""Real roots of irreducible polynomials over ℤ in balls."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from flint import arb, ctx, fmpz_poly


class precision:  # noqa: N801 -- used as a function
    """``flint.ctx.prec`` for a while."""

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def __enter__(self) -> None:
        self.before = ctx.prec
        ctx.prec = self.bits

    def __exit__(self, *_: object) -> None:
        ctx.prec = self.before


@lru_cache(maxsize=512)
def isolated(coefficients: tuple[int, ...], bits: int) -> tuple[arb, ...]:
    """The real roots of an irreducible polynomial in ascending order, with about ``bits`` bits.

    python-flint isolates all roots and gives real ones an imaginary part that is exactly zero.

    Args:
        coefficients: the lowest first.
        bits: the precision.
    """
    with precision(bits):
        found: list[Any] = fmpz_poly(list(coefficients)).complex_roots()
        real = [root.real for root, _ in found if root.imag == 0]
        real.sort(key=lambda ball: ball.mid())
        return tuple(real)
