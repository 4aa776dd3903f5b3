"""Explicit methods known by name, and the optimal strong-stability-preserving methods of order 2.

Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.1; Gottlieb, Ketcheson &
Shu, *Strong Stability Preserving Runge–Kutta and Multistep Time Discretizations*, section 6.1.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Matrix, Vector
from garkcli.families.family import Family, by_stages, of_stages
from garkcli.tableau.tableau import Method, butcher

_ROWS: dict[str, tuple[str, str]] = {
    "explicit-euler": ("", "1"),
    "explicit-midpoint": ("1/2", "0 1"),
    "heun": ("1", "1/2 1/2"),
    "kutta": ("1/2; -1 2", "1/6 2/3 1/6"),
    "rk4": ("1/2; 0 1/2; 0 0 1", "1/6 1/3 1/3 1/6"),
}
"""A below its diagonal from the second row on, rows between semicolons; and b."""
STAGES = {name: len(b.split()) for name, (_, b) in _ROWS.items()}
"""How many stages each named method has."""


def _row(text: str) -> Vector:
    return tuple(_rational(entry) for entry in text.split())


def _rational(text: str) -> fmpq:
    p, _, q = text.partition("/")
    return fmpq(int(p), int(q or 1))


def named(name: str) -> Method:
    """One of the methods of ``STAGES``."""
    below, b = _ROWS[name]
    rows = [_row(row) for row in below.split(";") if row]
    return butcher(_lower(rows), _row(b), name=name)


def ssp2(s: int) -> Method:
    """SSPRK(s, 2): a_{ij} = 1/(s − 1) below the diagonal, b_i = 1/s; it needs s ≥ 2."""
    a = fmpq(1, s - 1)
    rows = [(a,) * i for i in range(1, s)]
    b = (fmpq(1, s),) * s
    return butcher(_lower(rows), b, name=f"SSPRK({s},2)")


def _lower(rows: Sequence[Vector]) -> Matrix:
    """The strictly lower triangular matrix with these rows below its first, which is zero."""
    s = len(rows) + 1
    matrix: list[Vector] = [(ZERO,) * s]
    for row in rows:
        padding = (ZERO,) * (s - len(row))
        matrix.append(row + padding)
    return tuple(matrix)


def _single(name: str, order: str, summary: str) -> Family:
    stages = STAGES[name]
    return Family(name, by_stages(lambda _: named(name)), stages, stages, order, summary)


FAMILIES = (
    _single("explicit-euler", "1", "one explicit stage"),
    _single("explicit-midpoint", "2", "Runge's method"),
    _single("heun", "2", "the explicit trapezoidal rule"),
    _single("kutta", "3", "Kutta's method of order 3"),
    _single("rk4", "4", "the classical Runge-Kutta method"),
    of_stages("ssp2", ssp2, 2, "2", "explicit, strong-stability-preserving"),
)
