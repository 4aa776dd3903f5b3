"""Copies and pickles exact numbers."""

from __future__ import annotations

import copyreg
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import flint

Made: TypeAlias = tuple[Callable[..., Any], tuple[Any, ...]]
Dyadic: TypeAlias = tuple[int, int]
"""(m, e) for m · 2^e."""


def _in_several(polynomial: flint.fmpq_mpoly | flint.fmpz_mpoly) -> Made:
    context = polynomial.context()
    kind = (
        flint.fmpq_mpoly_ctx if isinstance(polynomial, flint.fmpq_mpoly) else flint.fmpz_mpoly_ctx
    )
    terms = {
        tuple(map(int, e)): a if isinstance(a, flint.fmpq) else int(a)
        for e, a in polynomial.to_dict().items()
    }
    return _in_several_of, (kind, tuple(context.names()), context.ordering(), terms)


def _in_several_of(kind: Any, names: tuple[str, ...], ordering: flint.Ordering, terms: Any) -> Any:
    return kind.get(names, ordering).from_dict(terms)


def _dyadic(exact: flint.arb) -> Dyadic:
    mantissa, exponent = exact.man_exp()
    return int(mantissa), int(exponent)


def _ball_of(mid: Dyadic, rad: Dyadic) -> flint.arb:
    mantissa, _ = mid
    # So many bits that the midpoint is not rounded on its way.
    needed = mantissa.bit_length() + 8
    with flint.ctx.workprec(max(flint.ctx.prec, needed)):
        return flint.arb(mid, rad)


PARTS: Mapping[type, Callable[[Any], Made]] = {
    flint.arb: lambda x: (_ball_of, (_dyadic(x.mid()), _dyadic(x.rad()))),
    flint.fmpq: lambda x: (flint.fmpq, (int(x.p), int(x.q))),
    flint.fmpq_poly: lambda x: (flint.fmpq_poly, (x.coeffs(),)),
    flint.fmpz_poly: lambda x: (flint.fmpz_poly, ([int(a) for a in x.coeffs()],)),
    flint.fmpq_mat: lambda x: (flint.fmpq_mat, (x.nrows(), x.ncols(), x.entries())),
    flint.fmpq_mpoly: _in_several,
    flint.fmpz_mpoly: _in_several,
}


def register() -> None:
    for kind, parts in PARTS.items():
        copyreg.pickle(kind, parts)
