"""How long an expression gets when it is multiplied out: asked before a Lagrangian is
transformed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import comb, prod
from typing import Any

MAX_TERMS = 3_000
"""Most terms of an equation for a velocity, multiplied out over its common denominator."""


def too_long(lagrangian: Any, velocities: Sequence[Any]) -> Any:
    """The first velocity whose equation p = ∂L/∂v would be too long to be solved; None where there
    is none.

    Equations that are linear in the velocities are solved by elimination, so they are never too
    long.

    Args:
        lagrangian: a sympy expression.
        velocities: its velocities, sympy symbols.

    >>> from sympy.abc import u, x
    >>> too_long((1 + x + u**2) ** 4, [u])
    >>> too_long((1 + x + u + u**2) ** 64, [u])
    u
    """
    moving = set(velocities)
    for v in velocities:
        slope = lagrangian.diff(v)
        if slope.diff(v).free_symbols & moving and _terms(_undone(slope, v), v) > MAX_TERMS:
            return v
    return None


def _undone(f: Any, v: Any) -> Any:
    """What is left of f(v) = c to be multiplied out, once the functions that hold v alone are
    undone.
    """
    while f != v:
        if f.is_Add or f.is_Mul:
            free, rest = f.as_independent(v, as_Add=f.is_Add)
            if free != (0 if f.is_Add else 1):
                f = rest
                continue
        inner = [x for x in f.args if v in x.free_symbols]
        if len(inner) != 1:
            break
        f = inner[0]
    return f


def _terms(f: Any, v: Any) -> int:
    """The terms of the numerator of f multiplied out; squared where a square root has to be squared
    away.
    """
    import sympy

    found = _fraction(f)
    has_root = any(
        v in x.free_symbols and x.exp.is_Rational and x.exp.q == 2 for x in f.atoms(sympy.Pow)
    )
    return max(found.terms ** (2 if has_root else 1), found.inside)


@dataclass(frozen=True)
class _Fraction:
    """The size of an expression as one fraction.

    Attributes:
        terms: those of the numerator, multiplied out.
        factors: the factors of the denominator: the terms and the exponent of each.
        inside: most terms of what stands in functions and roots.
    """

    terms: int
    factors: Mapping[Any, tuple[int, int]]
    inside: int = 1


def _fraction(f: Any) -> _Fraction:
    parts = [_fraction(x) for x in f.args]
    inside = max((x.inside for x in parts), default=1)
    if f.is_Add:
        factors: dict[Any, tuple[int, int]] = {}
        for part in parts:
            for base, (size, power) in part.factors.items():
                factors[base] = size, max(power, factors.get(base, (size, 0))[1])
        terms = sum(x.terms * _missing(factors, x.factors) for x in parts)
        return _Fraction(terms, factors, inside)
    if f.is_Mul:
        product: dict[Any, tuple[int, int]] = {}
        for part in parts:
            for base, (size, power) in part.factors.items():
                product[base] = size, power + product.get(base, (size, 0))[1]
        return _Fraction(prod(x.terms for x in parts), product, inside)
    if f.is_Pow and f.exp.is_Integer:
        base, power = parts[0], int(f.exp)
        if power > 0:
            factors = {x: (size, power * n) for x, (size, n) in base.factors.items()}
            return _Fraction(_power(base.terms, power), factors, inside)
        numerator = _missing({x: (size, -power * n) for x, (size, n) in base.factors.items()}, {})
        return _Fraction(
            numerator, {f.base: (base.terms, -power)} if f.base.free_symbols else {}, inside
        )
    below = max((x.terms for x in parts), default=1)
    if f.is_Pow and f.exp.is_Rational and f.exp.p < 0:
        return _Fraction(1, {f.base ** abs(f.exp): (1, 1)}, max(inside, below))
    return _Fraction(1, {}, max(inside, below))


def _missing(
    all_factors: Mapping[Any, tuple[int, int]], factors: Mapping[Any, tuple[int, int]]
) -> int:
    """The terms of a denominator divided by some of its factors."""
    return prod(
        _power(size, power - factors.get(x, (size, 0))[1])
        for x, (size, power) in all_factors.items()
    )


def _power(terms: int, exponent: int) -> int:
    """The terms of a power of a sum."""
    return comb(terms + exponent - 1, exponent)
