"""Copies and pickles exact numbers."""

from __future__ import annotations

import copyreg
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from flint import (
    Ordering,
    arb,
    ctx,
    fmpq,
    fmpq_mat,
    fmpq_mpoly,
    fmpq_mpoly_ctx,
    fmpq_poly,
    fmpz_mpoly,
    fmpz_mpoly_ctx,
    fmpz_poly,
)

Made: TypeAlias = tuple[Callable[..., Any], tuple[Any, ...]]
"""A constructor and its arguments."""
Dyadic: TypeAlias = tuple[int, int]
"""(m, e) for m · 2^e."""


def _in_several(polynomial: fmpq_mpoly | fmpz_mpoly) -> Made:
    context = polynomial.context()
    kind = fmpq_mpoly_ctx if isinstance(polynomial, fmpq_mpoly) else fmpz_mpoly_ctx
    terms = {
        tuple(map(int, e)): a if isinstance(a, fmpq) else int(a)
        for e, a in polynomial.to_dict().items()
    }
    return _in_several_of, (kind, tuple(context.names()), context.ordering(), terms)


def _in_several_of(kind: Any, names: tuple[str, ...], ordering: Ordering, terms: Any) -> Any:
    return kind.get(names, ordering).from_dict(terms)


def _dyadic(exact: arb) -> Dyadic:
    mantissa, exponent = exact.man_exp()
    return int(mantissa), int(exponent)


def _ball_of(mid: Dyadic, rad: Dyadic) -> arb:
    mantissa, _ = mid
    # So many bits that the midpoint is not rounded on its way.
    needed = mantissa.bit_length() + 8
    with ctx.workprec(max(ctx.prec, needed)):
        return arb(mid, rad)


PARTS: Mapping[type, Callable[[Any], Made]] = {
    arb: lambda x: (_ball_of, (_dyadic(x.mid()), _dyadic(x.rad()))),
    fmpq: lambda x: (fmpq, (int(x.p), int(x.q))),
    fmpq_poly: lambda x: (fmpq_poly, (x.coeffs(),)),
    fmpz_poly: lambda x: (fmpz_poly, ([int(a) for a in x.coeffs()],)),
    fmpq_mat: lambda x: (fmpq_mat, (x.nrows(), x.ncols(), x.entries())),
    fmpq_mpoly: _in_several,
    fmpz_mpoly: _in_several,
}
"""The constructor and arguments of each type of python-flint that occurs in results."""


def register() -> None:
    """Teaches pickle the types of python-flint."""
    for kind, parts in PARTS.items():
        copyreg.pickle(kind, parts)
