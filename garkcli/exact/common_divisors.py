"""Common divisors of polynomials over a number field K = ℚ(θ), modulo primes.

Euclid's algorithm over K has fractions that grow with each step. Modulo a prime p it has none, over
F_p[y]/(f) for the minimal polynomial f of θ: if the leading coefficients that it divides by are
units there, and so is that of one of the polynomials, its result has at least the degree of the
common divisor over K; if the degrees agree, it is that divisor modulo p. Rational reconstruction
from enough primes gives candidates, and one that divides both polynomials is the divisor. (J. von
zur Gathen, J. Gerhard, *Modern Computer Algebra*, chapter 6.)
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isqrt
from typing import TypeAlias

from flint import fmpq, fmpq_poly, fmpz, nmod_poly

from garkcli.deadline import check_time
from garkcli.exact.field import NumberField, modulo

FIRST = 2**62 + 1
"""The search for primes starts here; python-flint computes with them in one word."""
_Residues: TypeAlias = list[nmod_poly]
"""A polynomial over F_p[y]/(f), lowest coefficient first, without leading zeros."""


def candidates(
    a: Sequence[fmpq_poly], b: Sequence[fmpq_poly], field: NumberField
) -> Iterator[list[fmpq_poly]]:
    """Yields monic candidates for the common divisor; coefficients in θ are lowest first."""
    number = FIRST
    modulus, known, length = 1, [], None
    wanted, primes = 1, 0
    while True:
        number += 2
        if not fmpz(number).is_prime():
            continue
        check_time()
        found = _modulo_prime(a, b, field, number)
        if found is None or (length is not None and len(found) > length):
            continue
        values = [int(x[k]) for x in found[:-1] for k in range(field.degree)]
        if length is None or len(found) < length:
            modulus, known, length, primes = 1, [0] * len(values), len(found), 0
        inverse = pow(modulus, -1, number)
        known = [
            x + modulus * ((v - x) * inverse % number) for x, v in zip(known, values, strict=True)
        ]
        modulus *= number
        primes += 1
        if primes >= wanted:
            wanted = 1 + primes * 3 // 2
            fractions = _fractions(known, modulus)
            if fractions is not None:
                n = field.degree
                rows = [fractions[k : k + n] for k in range(0, len(fractions), n)]
                yield [*map(fmpq_poly, rows), fmpq_poly([1])]


def _modulo_prime(
    a: Sequence[fmpq_poly], b: Sequence[fmpq_poly], field: NumberField, p: int
) -> _Residues | None:
    """The monic common divisor over F_p[y]/(f); None if p is not suitable."""
    try:
        f = modulo(field.modulus, p)
        u, v = ([modulo(x, p) % f for x in q] for q in (a, b))
    except ZeroDivisionError:  # p divides a denominator
        return None
    if f.degree() < field.degree or f.gcd(f.derivative()).degree():
        return None
    while v:
        inverse = _inverse(v[-1], f)
        if inverse is None:
            return None
        v = [x * inverse % f for x in v]
        u, v = v, _remainder(u, v, f)
    return u


def _inverse(x: nmod_poly, f: nmod_poly) -> nmod_poly | None:
    common, cofactor, _ = x.xgcd(f)
    return cofactor if common.degree() == 0 else None


def _remainder(u: _Residues, v: _Residues, f: nmod_poly) -> _Residues:
    rest = list(u)
    while len(rest) >= len(v):
        leading = rest.pop()
        if leading:
            for k, x in enumerate(v[:-1], start=len(rest) + 1 - len(v)):
                rest[k] = (rest[k] - leading * x) % f
    while rest and not rest[-1]:
        rest.pop()
    return rest


def _fractions(values: Sequence[int], modulus: int) -> list[fmpq] | None:
    """Rational reconstruction of small fractions from residues; None if one fails."""
    bound = isqrt(modulus // 2)
    denominator = 1
    fractions = []
    for value in values:
        # most often the denominator of those before is one of this one too
        before, rest = modulus, value * denominator % modulus
        if modulus - rest <= bound:
            rest -= modulus
        former, factor = 0, 1
        while abs(rest) > bound:
            quotient = before // rest
            before, rest = rest, before - quotient * rest
            former, factor = factor, former - quotient * factor
        denominator *= abs(factor)
        if denominator > bound:
            return None
        fractions.append(fmpq(rest if factor > 0 else -rest, denominator))
    return fractions
