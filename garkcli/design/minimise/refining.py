"""A critical point near a point, proved to exist by Krawczyk's test.

It is no exact number, and none is needed: the coordinates of a part are free, so that the rational
point beside it is a method as well, of the same order and, but for rounding, the same value.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq, fmpq_mpoly

from garkcli.design.search.krawczyk import is_proved
from garkcli.design.search.points import Fixings, polished
from garkcli.design.search.rational import RationalFunction, as_float, with_gradients
from garkcli.exact.parametric import Parameters

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array

BITS = 256
"""Of Newton's method and the test, which then encloses the point to half as many."""
DECIMALS = 20
"""Of the rational point beside it."""
NEAR = fmpq(1, 100)
"""How far from the point that is given it may be."""


class _Equations:
    """Polynomials that are to be zero, as ``Fixings`` takes them."""

    def __init__(self, polynomials: Sequence[fmpq_mpoly], ring: Parameters) -> None:
        one = ring.constant(fmpq(1))
        self.functions = [RationalFunction(ring.quotient(p, one), ring) for p in polynomials]

    def at(self, points: Array) -> tuple[Array, Array]:
        """Values, shape (equations, points), and derivatives, shape (equations, unknowns,
        points).
        """
        return with_gradients(self.functions, points)


def critical_point_near(
    point: Sequence[fmpq],
    gradient: Sequence[fmpq_mpoly],
    nonzero: Sequence[fmpq_mpoly],
    ring: Parameters,
) -> tuple[fmpq, ...] | None:
    """A rational point within 10^−DECIMALS of a common zero of some polynomials; None where none is
    proved to exist near.

    Args:
        point: near which it is looked for.
        gradient: the polynomials, as many as unknowns.
        nonzero: polynomials that are not to vanish there.
        ring: of the unknowns.
    """
    system: Any = _Equations(gradient, ring)
    start = [as_float(x) for x in point]
    found = polished(Fixings(system), start, BITS)
    if found is None:
        return None
    one = ring.constant(fmpq(1))
    others = [RationalFunction(ring.quotient(p, one), ring) for p in nonzero]
    if not is_proved(Fixings(system), found, BITS, others):
        return None
    rounded = tuple(_rounded(x) for x in found[:, 0])
    moved = zip(rounded, point, strict=True)
    if any(abs(x - y) > NEAR for x, y in moved):
        return None
    return rounded


def _rounded(x: arb) -> fmpq:
    """The nearest number with so many decimals."""
    mantissa, exponent = x.mid().man_exp()
    exact = fmpq(mantissa) * fmpq(2) ** int(exponent)
    scale = 10**DECIMALS
    return fmpq((exact * scale + fmpq(1, 2)).floor(), scale)
