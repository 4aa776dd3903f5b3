"""How exact numbers travel between processes; imported by what sends them."""

from __future__ import annotations

import copyreg

from flint import fmpq, fmpq_poly


def _rational(number: fmpq) -> tuple[type[fmpq], tuple[int, int]]:
    return fmpq, (int(number.p), int(number.q))


def _polynomial(poly: fmpq_poly) -> tuple[type[fmpq_poly], tuple[list[fmpq]]]:
    return fmpq_poly, (poly.coeffs(),)


def register() -> None:
    """Teach pickle the numbers of python-flint that results are made of."""
    copyreg.pickle(fmpq, _rational)
    copyreg.pickle(fmpq_poly, _polynomial)
