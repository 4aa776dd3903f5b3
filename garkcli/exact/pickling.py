"""How exact numbers travel between processes; imported by what sends them."""

from __future__ import annotations

import copyreg

from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly


def _rational(number: fmpq) -> tuple[type[fmpq], tuple[int, int]]:
    return fmpq, (int(number.p), int(number.q))


def _polynomial(poly: fmpq_poly) -> tuple[type[fmpq_poly], tuple[list[fmpq]]]:
    return fmpq_poly, (poly.coeffs(),)


def _matrix(matrix: fmpq_mat) -> tuple[type[fmpq_mat], tuple[int, int, list[fmpq]]]:
    return fmpq_mat, (matrix.nrows(), matrix.ncols(), matrix.entries())


def _ball(ball: arb) -> tuple[object, tuple[tuple[int, int], tuple[int, int]]]:
    (mid, mid_exponent), (rad, rad_exponent) = (
        ball.mid().man_exp(),
        ball.rad().man_exp(),
    )
    return _ball_of, ((int(mid), int(mid_exponent)), (int(rad), int(rad_exponent)))


def _ball_of(mid: tuple[int, int], rad: tuple[int, int]) -> arb:
    with ctx.workprec(max(ctx.prec, mid[0].bit_length() + 8)):
        return arb(mid, rad)


def register() -> None:
    """Teach pickle the numbers of python-flint that results are made of."""
    copyreg.pickle(arb, _ball)  # type: ignore[arg-type]
    copyreg.pickle(fmpq, _rational)
    copyreg.pickle(fmpq_poly, _polynomial)
    copyreg.pickle(fmpq_mat, _matrix)
