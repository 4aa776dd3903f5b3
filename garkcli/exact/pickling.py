"""How exact numbers are copied and travel between processes."""

from __future__ import annotations

import copyreg
from collections.abc import Callable
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
"""What makes a value again, and from what."""
Dyadic: TypeAlias = tuple[int, int]
"""(m, e) for m · 2^e."""


def _rational(number: fmpq) -> Made:
    return fmpq, (int(number.p), int(number.q))


def _polynomial(poly: fmpq_poly) -> Made:
    return fmpq_poly, (poly.coeffs(),)


def _integer_polynomial(poly: fmpz_poly) -> Made:
    return fmpz_poly, ([int(x) for x in poly.coeffs()],)


def _in_several(polynomial: fmpq_mpoly | fmpz_mpoly) -> Made:
    context = polynomial.context()
    kind = fmpq_mpoly_ctx if isinstance(polynomial, fmpq_mpoly) else fmpz_mpoly_ctx
    terms = {tuple(map(int, e)): _plain(a) for e, a in polynomial.to_dict().items()}
    return _in_several_of, (kind, tuple(context.names()), context.ordering(), terms)


def _plain(number: Any) -> Any:
    """A number of python-flint that pickle knows, or one of Python."""
    return number if isinstance(number, fmpq) else int(number)


def _in_several_of(kind: Any, names: tuple[str, ...], ordering: Ordering, terms: Any) -> Any:
    return kind.get(names, ordering).from_dict(terms)


def _matrix(matrix: fmpq_mat) -> Made:
    return fmpq_mat, (matrix.nrows(), matrix.ncols(), matrix.entries())


def _ball(ball: arb) -> Made:
    return _ball_of, (_dyadic(ball.mid()), _dyadic(ball.rad()))


def _dyadic(exact: arb) -> Dyadic:
    mantissa, exponent = exact.man_exp()
    return int(mantissa), int(exponent)


def _ball_of(mid: Dyadic, rad: Dyadic) -> arb:
    mantissa, _ = mid
    # So many bits that the midpoint is not rounded on its way.
    needed = mantissa.bit_length() + 8
    with ctx.workprec(max(ctx.prec, needed)):
        return arb(mid, rad)


def register() -> None:
    """Teach pickle the numbers of python-flint that results are made of."""
    copyreg.pickle(arb, _ball)
    copyreg.pickle(fmpq, _rational)
    copyreg.pickle(fmpq_poly, _polynomial)
    copyreg.pickle(fmpq_mat, _matrix)
    copyreg.pickle(fmpz_poly, _integer_polynomial)
    copyreg.pickle(fmpq_mpoly, _in_several)
    copyreg.pickle(fmpz_mpoly, _in_several)
