"""Explicit methods known by name, and the optimal strong-stability-preserving methods of order 2.

Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.1; Gottlieb, Ketcheson &
Shu, *Strong Stability Preserving Runge–Kutta and Multistep Time Discretizations*, section 6.1.
"""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.matrix import Matrix
from garkcli.tableau.method import Method, butcher

_ROWS: dict[str, tuple[tuple[tuple[str, ...], ...], tuple[str, ...]]] = {
    "explicit-euler": ((), ("1",)),
    "explicit-midpoint": ((("1/2",),), ("0", "1")),
    "heun": ((("1",),), ("1/2", "1/2")),
    "kutta": ((("1/2",), ("-1", "2")), ("1/6", "2/3", "1/6")),
    "rk4": ((("1/2",), ("0", "1/2"), ("0", "0", "1")), ("1/6", "1/3", "1/3", "1/6")),
}
STAGES = {name: len(b) for name, (_, b) in _ROWS.items()}
"""How many stages each named method has."""


def _rational(text: str) -> fmpq:
    p, _, q = text.partition("/")
    return fmpq(int(p), int(q or 1))


def named(name: str) -> Method:
    """One of the methods of ``STAGES``."""
    rows, b = _ROWS[name]
    return butcher(
        _lower([[_rational(x) for x in row] for row in rows]),
        tuple(map(_rational, b)),
        name=name,
    )


def ssp2(s: int) -> Method:
    """SSPRK(s, 2): a_{ij} = 1/(s − 1) below the diagonal, b_i = 1/s; it needs s ≥ 2."""
    rows = [[fmpq(1, s - 1)] * i for i in range(1, s)]
    return butcher(_lower(rows), (fmpq(1, s),) * s, name=f"SSPRK({s},2)")


def _lower(rows: list[list[fmpq]]) -> Matrix:
    s = len(rows) + 1
    return tuple(tuple(row) + (fmpq(0),) * (s - len(row)) for row in ([], *rows))
