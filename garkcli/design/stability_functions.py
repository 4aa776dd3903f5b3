"""The stability function of a family, its coefficients rational functions of the parameters.

With the stage system of ``garkcli.stepping.stage_system`` it is det(I − z(W − E B)) / det(I − zW).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from garkcli.design.wants.r_infinity import characteristic_coefficients
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.stepping.stage_system import stage_system
from garkcli.tableau.tableau import Tableau

Coefficients = tuple[Any, ...]
"""Those of 1, z, z², …, rational functions of the parameters."""


@dataclass(frozen=True)
class FamilyFunction:
    """R = P/Q in lowest terms, with Q(0) = 1.

    Attributes:
        name: which colours are driven: ``all``, or the name of one with the others at 0.
        numerator: P.
        denominator: Q.
    """

    name: str
    numerator: Coefficients
    denominator: Coefficients

    @property
    def at_infinity(self) -> Any:
        """R(∞) for almost every value; None where R is unbounded."""
        P, Q = self.numerator, self.denominator
        if len(P) > len(Q):
            return None
        return fmpq(0) if len(P) < len(Q) else P[-1] / Q[-1]

    @property
    def e_polynomial(self) -> Coefficients:
        """|Q(iy)|² − |P(iy)|² as a polynomial in x = y²."""
        P, Q = _squared(self.numerator), _squared(self.denominator)
        size = max(len(P), len(Q))
        differences = [_at(Q, k) - _at(P, k) for k in range(size)]
        return _trimmed(differences)


def family_functions(
    tableau: Tableau, ring: Parameters
) -> tuple[FamilyFunction, ...]:
    """R for all colours together, then for each colour alone where there are several.

    Empty where colours drive positions or momenta only, or do not see one another.
    """
    colours = range(tableau.size)
    is_complete = all(
        tableau.block(l, m) is not None for l in colours for m in colours
    )
    if tableau.is_partitioned or not is_complete:
        return ()
    found = [_function(tableau, ring, "all", [fmpq(1)] * tableau.size)]
    if tableau.size > 1:
        for l in colours:
            shares = [fmpq(int(m == l)) for m in colours]
            name = tableau.colours[l].name
            found.append(_function(tableau, ring, name, shares))
    return tuple(found)


def _function(
    tableau: Tableau, ring: Parameters, name: str, shares: Sequence[fmpq]
) -> FamilyFunction:
    system = stage_system(tableau, [((w,),) for w in shares])
    [weights] = system.B
    damped: list[tuple[Any, ...]] = []
    for row, (one,) in zip(system.W, system.E, strict=True):
        pairs = zip(row, weights, strict=True)
        damped.append(tuple(a - one * b for a, b in pairs))
    P = characteristic_coefficients(tuple(damped))
    Q = characteristic_coefficients(system.W)
    return FamilyFunction(name, *_in_lowest_terms(P, Q, ring))


def _in_lowest_terms(
    P: Sequence[Any], Q: Sequence[Any], ring: Parameters
) -> tuple[Coefficients, Coefficients]:
    larger = Parameters(["_z", *ring.names])
    common = common_denominator([*P, *Q], ring)

    def polynomial(coefficients: Sequence[Any]) -> Any:
        terms = {}
        for k, a in enumerate(coefficients):
            p, q = fraction(a, ring)
            cleared = p * (common // q)
            for exponents, c in cleared.to_dict().items():
                terms[(k, *map(int, exponents))] = c
        return larger.context.from_dict(terms)

    p, q = polynomial(P), polynomial(Q)
    factor = p.gcd(q)
    numerator, denominator = p // factor, q // factor
    rows = _by_power(numerator, ring), _by_power(denominator, ring)
    scale = rows[1][0]
    over = tuple(tuple(a / scale for a in row) for row in rows)
    return _trimmed(over[0]), _trimmed(over[1])


def _by_power(polynomial: Any, ring: Parameters) -> list[Any]:
    """The coefficients of 1, z, z², …"""
    powers: dict[int, dict[tuple[int, ...], fmpq]] = {}
    for exponents, a in polynomial.to_dict().items():
        k, *rest = map(int, exponents)
        powers.setdefault(k, {})[tuple(rest)] = a
    one = ring.constant(fmpq(1))
    found = []
    for k in range(max(powers) + 1):
        terms = ring.context.from_dict(powers.get(k, {}))
        found.append(ring.quotient(terms, one))
    return found


def _trimmed(coefficients: Sequence[Any]) -> Coefficients:
    kept = list(coefficients)
    while kept and not kept[-1]:
        kept.pop()
    return tuple(kept)


def _at(coefficients: Coefficients, k: int) -> Any:
    return coefficients[k] if k < len(coefficients) else fmpq(0)


def _squared(p: Coefficients) -> Coefficients:
    """|p(iy)|² in x = y²: Σ (−1)^((j − k)/2) p_j p_k x^((j + k)/2) over even j + k."""
    size = len(p)
    out: list[Any] = [fmpq(0)] * size
    for j in range(size):
        for k in range(size):
            if (j + k) % 2 == 0:
                sign = -1 if (j - k) // 2 % 2 else 1
                out[(j + k) // 2] = out[(j + k) // 2] + sign * p[j] * p[k]
    return tuple(out)
