"""Gröbner bases over ℚ by python-flint, large ones in a process, or by msolve if time is short."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any, TypeAlias

from flint import fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from garkcli.deadline import check_time
from garkcli.design.msolve import basis_by_msolve, find_msolve, is_basis
from garkcli.errors import NotDecided
from garkcli.exact.apart import apart, first_of

Exponents: TypeAlias = tuple[int, ...]
FEW_TERMS = 300
SMALL = (50, 200, 1500)
"""Most polynomials, terms of one, bits of a coefficient, of a basis made in this process."""
_Way: TypeAlias = Callable[..., tuple[list[fmpz_mpoly], int]]


def is_small(polynomials: Sequence[fmpz_mpoly]) -> bool:
    return sum(len(p) for p in polynomials) <= FEW_TERMS


def groebner_basis(polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
    """The reduced Gröbner basis of generators that are not all zero; NotDecided if time is over."""
    check_time()
    with suppress(_TooLarge):
        return _basis(polynomials, context, is_bounded=True)
    return apart(_basis_apart, list(polynomials))


def grown_basis(
    known: Sequence[fmpz_mpoly],
    generators: Sequence[fmpz_mpoly],
    new: Sequence[fmpz_mpoly],
    context: fmpz_mpoly_ctx,
) -> tuple[list[fmpz_mpoly], int]:
    """The reduced Gröbner basis with ``new`` polynomials, and how many of them are in it.

    Without zeros these are the fewest first ones that leave none. ``known`` is a basis,
    ``generators`` are of the same ideal. One after the other or all at once may be faster, as bases
    in between may be larger than the last: large ones are tried both ways in parallel. Raises
    NotDecided if the time is over.
    """
    check_time()
    for way, first in ((_in_turn, known), (_at_once, generators)):
        with suppress(_TooLarge):
            return way(list(first), list(new), context, is_bounded=True)
    return first_of(
        (_grown_apart, (_at_once, list(generators), list(new))),
        (_grown_apart, (_in_turn, list(known), list(new))),
    )


def _in_turn(
    basis: list[fmpz_mpoly], new: list[fmpz_mpoly], context: fmpz_mpoly_ctx, is_bounded: bool
) -> tuple[list[fmpz_mpoly], int]:
    for k, p in enumerate(new, start=1):
        if is_bounded and not is_small([*basis, p]):
            raise _TooLarge
        rest = remainder(p, basis, context)
        if rest:
            basis = _basis([*basis, rest], context, is_bounded)
        if _is_everything(basis):
            return basis, k
    return basis, len(new)


def _at_once(
    generators: list[fmpz_mpoly], new: list[fmpz_mpoly], context: fmpz_mpoly_ctx, is_bounded: bool
) -> tuple[list[fmpz_mpoly], int]:
    basis = _basis([*generators, *new], context, is_bounded)
    k = len(new)
    if _is_everything(basis):
        for k in range(1, len(new) + 1):
            if _is_everything(_basis([*generators, *new[:k]], context, is_bounded)):
                break
    return basis, k


def _is_everything(basis: Sequence[fmpz_mpoly]) -> bool:
    return bool(basis) and basis[0].is_constant()


def remainder(p: fmpz_mpoly, basis: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx) -> fmpz_mpoly:
    if not basis or not p:
        return p
    vector = fmpz_mpoly_vec(list(basis), context)
    dividend: Any = p  # the types of python-flint lack the method
    rest: fmpz_mpoly = dividend.reduction_primitive_part(vector)
    return rest


class _TooLarge(Exception):
    """A Gröbner basis is not small."""


def _basis(
    polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, is_bounded: bool
) -> list[fmpz_mpoly]:
    if is_bounded and not is_small(polynomials):
        raise _TooLarge
    vector: Any = fmpz_mpoly_vec(list(polynomials), context)
    if not is_bounded:
        return reduced(list(vector.buchberger_naive()), context)
    vector = fmpz_mpoly_vec(reduced(polynomials, context, is_whole=False), context)
    basis, is_whole = vector.buchberger_naive(limits=SMALL)
    if not is_whole:
        raise _TooLarge
    return reduced(list(basis), context)


def reduced(
    polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, is_whole: bool = True
) -> list[fmpz_mpoly]:
    """Generators, each reduced once by those with smaller leading monomials, the smallest first.
    For a Gröbner basis (``is_whole``) the primitive reduced one. python-flint's ``autoreduction``
    takes a hundred times as long for many polynomials and may not end in lexicographic order.
    """
    done: list[fmpz_mpoly] = []
    known: list[Exponents] = []
    for p in sorted(filter(None, polynomials), key=lambda p: degrevlex(leading(p))):
        if is_whole and any(divides(smaller, leading(p)) for smaller in known):
            continue
        _, rest = p.primitive()
        if done:
            dividend: Any = rest  # the types of python-flint lack the method
            rest = dividend.reduction_primitive_part(fmpz_mpoly_vec(done, context))
        if rest:
            done.append(rest if rest.leading_coefficient() > 0 else -rest)
            known.append(leading(rest))
    return done


def leading(p: fmpz_mpoly) -> Exponents:
    return tuple(int(x) for x in p.monoms()[0])


def degrevlex(exponents: Exponents) -> tuple[int, ...]:
    return sum(exponents), *(-e for e in reversed(exponents))


def divides(a: Exponents, b: Exponents) -> bool:
    return all(x <= y for x, y in zip(a, b, strict=True))


def unproved_basis(polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
    """The Gröbner basis by msolve, verified to be one of an ideal that contains the polynomials.
    Raises NotDecided if msolve is not installed, has no answer in time, or fails the test.
    """
    check_time()
    program = find_msolve()
    if program is None:
        raise NotDecided
    nonzero = [p for p in polynomials if p]
    basis = basis_by_msolve(program, nonzero, context)
    if basis is None:
        raise NotDecided
    verified = apart(_verified, basis, nonzero)
    if verified is None:
        raise NotDecided
    return verified


def _basis_apart(polynomials: list[fmpz_mpoly]) -> list[fmpz_mpoly]:
    return _basis(polynomials, polynomials[0].context(), is_bounded=False)


def _grown_apart(
    way: _Way, first: list[fmpz_mpoly], new: list[fmpz_mpoly]
) -> tuple[list[fmpz_mpoly], int]:
    return way(first, new, new[0].context(), is_bounded=False)


def _verified(basis: list[fmpz_mpoly], given: list[fmpz_mpoly]) -> list[fmpz_mpoly] | None:
    context = given[0].context()
    return reduced(basis, context) if is_basis(basis, given, context) else None
