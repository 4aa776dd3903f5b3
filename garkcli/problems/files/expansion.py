"""The length of an expression once multiplied out, found before a Lagrangian is transformed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import comb, prod
from typing import TypeAlias

from garkcli.frozen import Frozen
from garkcli.problems.expr import Expr, Vector

MAX_TERMS = 3_000
"""Most terms of an equation for a velocity, over its common denominator."""


def too_long(lagrangian: Expr, velocities: Vector) -> Expr:
    """Returns the first velocity whose equation p = ∂L/∂v is too long to solve, or None. Linear
    equations are never too long: elimination solves them.
    """
    for v in velocities:
        slope = lagrangian.diff(v)
        is_linear = slope.diff(v).free_symbols.isdisjoint(velocities)
        if not is_linear and _terms(_undone(slope, v), v) > MAX_TERMS:
            return v
    return None


def _undone(f: Expr, v: Expr) -> Expr:
    """Returns the rest of f(v) = c after inverting the functions that only hold v."""
    while f != v:
        if f.is_Add or f.is_Mul:
            is_sum = f.is_Add
            free, rest = f.as_independent(v, as_Add=is_sum)
            neutral = 0 if is_sum else 1
            if free != neutral:
                f = rest
                continue
        inner = [x for x in f.args if v in x.free_symbols]
        if len(inner) != 1:
            break
        f = inner[0]
    return f


def _terms(f: Expr, v: Expr) -> int:
    """Returns the number of terms of a multiplied-out numerator, squared with a root."""
    import sympy

    size = _fraction(f)
    # odd powers of square roots with v in them
    powers = [x.exp for x in f.atoms(sympy.Pow) if v in x.free_symbols]
    has_root = any(exponent.is_Rational and exponent.q == 2 for exponent in powers)
    return max(size.terms**2 if has_root else size.terms, size.inside)


Size: TypeAlias = tuple[int, int]
Factors: TypeAlias = Mapping[Expr, Size]


class _Fraction(Frozen):
    """The terms of a multiplied-out numerator, the denominator, and the most terms in functions."""

    terms: int
    factors: Factors
    inside: int = 1


def _fraction(f: Expr) -> _Fraction:
    parts = [_fraction(x) for x in f.args]
    inside = max((x.inside for x in parts), default=1)
    if f.is_Add:
        return _sum(parts, inside)
    if f.is_Mul:
        return _product(parts, inside)
    if f.is_Pow and f.exp.is_Integer:
        return _integer_power(f, parts[0], inside)
    # a root or a function: one term, with anything in it
    inside = max(inside, *(part.terms for part in parts), 1)
    is_below = f.is_Pow and f.exp.is_Rational and f.exp.p < 0
    return _Fraction(1, {f.base ** abs(f.exp): (1, 1)} if is_below else {}, inside)


def _sum(parts: Sequence[_Fraction], inside: int) -> _Fraction:
    common: dict[Expr, Size] = {}
    for part in parts:
        for base, (size, power) in part.factors.items():
            _, known = common.get(base, (size, 0))
            common[base] = size, max(power, known)
    terms = sum(part.terms * _missing(common, part.factors) for part in parts)
    return _Fraction(terms, common, inside)


def _product(parts: Sequence[_Fraction], inside: int) -> _Fraction:
    factors: dict[Expr, Size] = {}
    for part in parts:
        for base, (size, power) in part.factors.items():
            _, known = factors.get(base, (size, 0))
            factors[base] = size, power + known
    return _Fraction(prod(x.terms for x in parts), factors, inside)


def _integer_power(f: Expr, base: _Fraction, inside: int) -> _Fraction:
    exponent = int(f.exp)
    times = abs(exponent)
    raised = {x: (size, times * n) for x, (size, n) in base.factors.items()}
    if exponent > 0:
        return _Fraction(_power(base.terms, exponent), raised, inside)
    # the denominator of the base comes into the numerator, and the other way round
    below = {f.base: (base.terms, times)} if f.base.free_symbols else {}
    return _Fraction(_missing(raised, {}), below, inside)


def _missing(all_factors: Factors, factors: Factors) -> int:
    sizes = all_factors.items()
    return prod(_power(size, power - factors.get(x, (size, 0))[1]) for x, (size, power) in sizes)


def _power(terms: int, exponent: int) -> int:
    return comb(terms + exponent - 1, exponent)
