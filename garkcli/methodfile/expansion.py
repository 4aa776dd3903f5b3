"""How long an expression gets when it is multiplied out: asked before a Lagrangian is
transformed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import comb, prod
from typing import Any, TypeAlias

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
        if (
            slope.diff(v).free_symbols & moving
            and _terms(_undone(slope, v), v) > MAX_TERMS
        ):
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
        v in x.free_symbols and x.exp.is_Rational and x.exp.q == 2
        for x in f.atoms(sympy.Pow)
    )
    return max(found.terms ** (2 if has_root else 1), found.inside)


Factors: TypeAlias = Mapping[Any, tuple[int, int]]
"""The factors of a denominator: the terms and the exponent of each."""


@dataclass(frozen=True)
class _Fraction:
    """The size of an expression as one fraction.

    Attributes:
        terms: those of the numerator, multiplied out.
        factors: of the denominator.
        inside: most terms of what stands in functions and roots.
    """

    terms: int
    factors: Factors
    inside: int = 1


def _fraction(f: Any) -> _Fraction:
    parts = [_fraction(x) for x in f.args]
    inside = max((x.inside for x in parts), default=1)
    if f.is_Add:
        return _sum(parts, inside)
    if f.is_Mul:
        return _product(parts, inside)
    if f.is_Pow and f.exp.is_Integer:
        return _integer_power(f, parts[0], inside)
    # a root or a function: one term, whatever stands in it
    inside = max(inside, *(x.terms for x in parts)) if parts else inside
    is_below = f.is_Pow and f.exp.is_Rational and f.exp.p < 0
    factors = {f.base ** abs(f.exp): (1, 1)} if is_below else {}
    return _Fraction(1, factors, inside)


def _sum(parts: Sequence[_Fraction], inside: int) -> _Fraction:
    """Over the least common denominator."""
    common: dict[Any, tuple[int, int]] = {}
    for part in parts:
        for base, (size, power) in part.factors.items():
            _, known = common.get(base, (size, 0))
            common[base] = size, max(power, known)
    terms = sum(x.terms * _missing(common, x.factors) for x in parts)
    return _Fraction(terms, common, inside)


def _product(parts: Sequence[_Fraction], inside: int) -> _Fraction:
    factors: dict[Any, tuple[int, int]] = {}
    for part in parts:
        for base, (size, power) in part.factors.items():
            _, known = factors.get(base, (size, 0))
            factors[base] = size, power + known
    return _Fraction(prod(x.terms for x in parts), factors, inside)


def _integer_power(f: Any, base: _Fraction, inside: int) -> _Fraction:
    exponent = int(f.exp)
    raised = {x: (size, abs(exponent) * n) for x, (size, n) in base.factors.items()}
    if exponent > 0:
        return _Fraction(_power(base.terms, exponent), raised, inside)
    # the denominator of the base comes into the numerator, and the other way round
    below = {f.base: (base.terms, -exponent)} if f.base.free_symbols else {}
    return _Fraction(_missing(raised, {}), below, inside)


def _missing(all_factors: Factors, factors: Factors) -> int:
    """The terms of a denominator divided by some of its factors."""
    found = 1
    for x, (size, power) in all_factors.items():
        _, present = factors.get(x, (size, 0))
        found *= _power(size, power - present)
    return found


def _power(terms: int, exponent: int) -> int:
    """The terms of a power of a sum."""
    return comb(terms + exponent - 1, exponent)
