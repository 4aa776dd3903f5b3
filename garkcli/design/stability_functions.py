"""The stability function of a family, its coefficients rational functions of the parameters.

With the stage system of ``garkcli.stepping.linear`` it is det(I − z(W − E B)) / det(I − zW).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Any

from flint import fmpq, fmpq_mpoly

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import characteristic_coefficients
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.exact.polynomial import squared_on_axis
from garkcli.frozen import Frozen
from garkcli.stability.summary import directions
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau

Coefficients = tuple[Any, ...]


class FamilyFunction(Frozen):
    """R = P/Q in lowest terms, Q(0) = 1, of ``all`` colours, or of the one named with λ ≠ 0."""

    name: str
    numerator: Coefficients
    denominator: Coefficients

    @property
    def at_infinity(self) -> Any:
        """R(∞) for almost every value; None if R is unbounded."""
        P, Q = self.numerator, self.denominator
        if len(P) > len(Q):
            return None
        if len(P) < len(Q):
            return ZERO
        return P[-1] / Q[-1]

    @property
    def e_polynomial(self) -> Coefficients:
        """|Q(iy)|² − |P(iy)|² as a polynomial in x = y²."""
        P = squared_on_axis(self.numerator)
        Q = squared_on_axis(self.denominator)
        return _trimmed([q - p for q, p in zip_longest(Q, P, fillvalue=ZERO)])


def family_functions(tableau: Tableau, ring: Parameters) -> tuple[FamilyFunction, ...]:
    """R for all colours together, then for each alone if there are several. Empty if colours drive
    positions or momenta only, or are not coupled.
    """
    return tuple(function_of(tableau, ring, *direction) for direction in directions(tableau))


def function_of(
    tableau: Tableau, ring: Parameters, name: str, shares: Sequence[Number]
) -> FamilyFunction:
    system = stage_system(tableau, [((w,),) for w in shares])
    [weights] = system.B
    damped: list[tuple[Any, ...]] = []
    for row, (one,) in zip(system.W, system.E, strict=True):
        pairs = zip(row, weights, strict=True)
        damped.append(tuple(a - one * b for a, b in pairs))
    P = characteristic_coefficients(tuple(damped))
    return FamilyFunction(name, *_in_lowest_terms(P, characteristic_coefficients(system.W), ring))


def _in_lowest_terms(
    P: Sequence[Any], Q: Sequence[Any], ring: Parameters
) -> tuple[Coefficients, Coefficients]:
    common = common_denominator([*P, *Q], ring)
    p = joined(P, common, ring)
    q = joined(Q, common, ring)
    factor = p.gcd(q)
    numerator = _by_power(p // factor, ring)
    denominator = _by_power(q // factor, ring)
    scale = denominator[0]
    return _trimmed([a / scale for a in numerator]), _trimmed([a / scale for a in denominator])


def joined(coefficients: Sequence[Any], common: fmpq_mpoly, ring: Parameters) -> fmpq_mpoly:
    larger = Parameters(["_z", *ring.names])
    terms = {}
    for k, a in enumerate(coefficients):
        p, q = fraction(a, ring)
        cleared = p * (common // q)
        for exponents, c in cleared.to_dict().items():
            terms[k, *map(int, exponents)] = c
    return larger.context.from_dict(terms)


def _by_power(polynomial: Any, ring: Parameters) -> list[Any]:
    powers: dict[int, dict[tuple[int, ...], fmpq]] = {}
    for exponents, a in polynomial.to_dict().items():
        k, *rest = map(int, exponents)
        powers.setdefault(k, {})[tuple(rest)] = a
    one = ring.constant(ONE)
    return [
        ring.quotient(ring.context.from_dict(powers.get(k, {})), one)
        for k in range(max(powers) + 1)
    ]


def _trimmed(coefficients: Sequence[Any]) -> Coefficients:
    kept = list(coefficients)
    while kept and not kept[-1]:
        kept.pop()
    return tuple(kept)
