"""Explicit methods known by name, and optimal strong-stability-preserving methods.

Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.1; Gottlieb, Ketcheson &
Shu, *Strong Stability Preserving Runge–Kutta and Multistep Time Discretizations*, 6.1, of order 2;
of order 3, with n² stages: D. Ketcheson, *Highly efficient strong stability-preserving Runge–Kutta
methods with low-storage implementations*, SIAM J. Sci. Comput. 30 (2008), 4.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from flint import fmpq

from garkcli.errors import UnknownFamily
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Matrix, Vector
from garkcli.families import family
from garkcli.families.stagelist import START, StageList, Weights, combined
from garkcli.reference import Reference
from garkcli.tableau.tableau import Method, butcher

_ROWS: dict[str, tuple[str, str]] = {
    "explicit-euler": ("", "1"),
    "explicit-midpoint": ("1/2", "0 1"),
    "heun": ("1", "1/2 1/2"),
    "kutta": ("1/2; -1 2", "1/6 2/3 1/6"),
    "rk4": ("1/2; 0 1/2; 0 0 1", "1/6 1/3 1/3 1/6"),
}
"""The rows of A below its diagonal, from the second on, separated by semicolons; and b."""
STAGES = {name: len(b.split()) for name, (_, b) in _ROWS.items()}


def _row(text: str) -> Vector:
    return tuple(fmpq(*Fraction(entry).as_integer_ratio()) for entry in text.split())


def named(name: str) -> Method:
    below, b = _ROWS[name]
    rows = [_row(row) for row in below.split(";") if row]
    return butcher(_lower(rows), _row(b), name=name)


def ssp2(s: int) -> Method:
    """SSPRK(s, 2): a_{ij} = 1/(s − 1) below the diagonal, b_i = 1/s; s ≥ 2."""
    a = fmpq(1, s - 1)
    rows = [(a,) * i for i in range(1, s)]
    return butcher(_lower(rows), (fmpq(1, s),) * s, name=f"SSPRK({s},2)")


def _lower(rows: Sequence[Vector]) -> Matrix:
    s = len(rows) + 1
    matrix: list[Vector] = [(ZERO,) * s]
    matrix.extend(row + (ZERO,) * (s - len(row)) for row in rows)
    return tuple(matrix)


def _single(name: str, order: str, summary: str) -> family.MethodFamily:
    stages = STAGES[name]
    recipe = family.by_stages(lambda _: named(name))
    return family.MethodFamily(
        name, recipe, stages, stages, order, summary, reference=family.NONSTIFF
    )


def ssp3(s: int, _: family.Options) -> family.Recipe:
    """SSPRK(n², 3); UnknownFamily if s is not a square."""
    n = isqrt(s)
    if n * n != s:
        message = f"ssp3 with {s} stages does not exist"
        raise UnknownFamily(message, "it has 4, 9, 16, … stages", code="wrong-value")
    return family.Recipe(s, lambda _: _ssp3(n))


def _ssp3(n: int) -> Method:
    """Euler steps of length 1/(n² − n); in the middle an average with an earlier value."""
    s = n * n
    length = fmpq(1, s - n)
    middle = n * (n + 1) // 2
    earlier = (n - 1) * (n - 2) // 2
    stages = StageList()
    values: list[Weights] = [START]
    for i in range(1, s + 1):
        gained = {stages.slope_at(values[-1]): length}
        value = combined([(1, values[-1]), (1, gained)])
        if i == middle:
            whole = 2 * n - 1
            value = combined([(fmpq(n, whole), values[earlier]), (fmpq(n - 1, whole), value)])
        values.append(value)
    return stages.method(f"SSPRK({s},3)", values[-1])


SSP = Reference(
    authors=("D. I. Ketcheson",),
    title="Highly efficient strong stability-preserving Runge-Kutta methods with low-storage "
    "implementations",
    journal="SIAM J. Sci. Comput.",
    volume="30",
    pages="2113-2136",
    year="2008",
    doi="10.1137/07070485X",
)
FAMILIES = (
    _single("explicit-euler", "1", "one explicit stage"),
    _single("explicit-midpoint", "2", "Runge's method"),
    _single("heun", "2", "the explicit trapezoidal rule"),
    _single("kutta", "3", "Kutta's method of order 3"),
    _single("rk4", "4", "the classical Runge-Kutta method"),
    family.of_stages("ssp2", ssp2, 2, "2", "explicit, strong-stability-preserving", SSP),
    family.MethodFamily(
        "ssp3",
        ssp3,
        4,
        family.MAX_STAGES,
        "3",
        "s = n^2; strong-stability-preserving",
        reference=SSP,
    ),
)
