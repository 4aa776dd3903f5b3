"""Low-storage and similar forms of explicit methods, if they exist; decided exactly."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.constructions.registers import in_two_registers
from garkcli.conversion.sheet import CannotConvert
from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.order.tolerance import within
from garkcli.stability.ssp import ssp_coefficient
from garkcli.tableau.tableau import Tableau

Printed: TypeAlias = "tuple[str, Mapping[str, Any]]"
"""The key of the form with its keys: words, rows and matrices."""
InForm: TypeAlias = "Callable[[Tableau, fmpq | None], Printed]"
"""Makes the form from a tableau and the rounding of its numbers, None for exact ones."""


def explicit(tableau: Tableau, form: str) -> tuple[Matrix, Vector]:
    """CannotConvert for implicit methods, several colours, and constant vector fields."""
    if tableau.size != 1 or tableau.is_partitioned or tableau.colours[0].is_linear:
        raise CannotConvert(f"{form} is a form of methods of one colour", "--to gark has several")
    b = tableau.colours[0].b
    A = tableau.blocks.get((0, 0))
    if A is None:
        message = f"{form} is a form for vector fields of y, and this method has none"
        raise CannotConvert(message, "--to spelled-out has every method")
    if any(x for i, row in enumerate(A) for x in row[i:]):
        message = f"{form} is a form of explicit methods, and this one is implicit"
        raise CannotConvert(message, "--to spelled-out has every method")
    return A, b


def in_2n(tableau: Tableau, tolerance: fmpq | None = None) -> Printed:
    """CannotConvert if the method has no such form, exactly or within the tolerance."""
    A, b = explicit(tableau, "2N")
    found = in_two_registers(A, b)
    if isinstance(found, int) and tolerance:
        found = in_two_registers(A, b, tolerance)
        if not isinstance(found, int):
            found = _rounded(found[0], tolerance), _rounded(found[1], tolerance)
    if isinstance(found, int):
        message = f"no 2N form: the slopes of stages {found} and {found + 1} enter in no one ratio"
        raise CannotConvert(message, "--to spelled-out has every method")
    factors, weights = found
    return "low-storage", {"form": "2N", "A": tuple(map(_number, factors)), "B": tuple(weights)}


def in_registers(registers: int) -> InForm:
    """Van der Houwen's form: the lower entries of a column are the weight of its stage."""
    form = f"{registers}R"

    def convert(tableau: Tableau, tolerance: fmpq | None) -> Printed:
        A, b = explicit(tableau, form)
        for i, row in enumerate(A):
            for j in range(i - registers + 1):
                if not within(row[j] - b[j], tolerance or ZERO):
                    message = f"no {form} form: a[{i + 1},{j + 1}] is not b[{j + 1}]"
                    cure = "more registers, or --to spelled-out, which has every method"
                    raise CannotConvert(message, cure)
        rows = tuple(
            tuple(A[i][i - below] for i in range(below, len(b))) for below in range(1, registers)
        )
        if not all(rows):
            few = f"{len(b)} stages need" if len(b) > 1 else "1 stage needs"
            raise CannotConvert(f"no {form} form: {few} fewer registers", "--to spelled-out")
        return "low-storage", {"form": form, "A": rows[0] if registers == 2 else rows, "b": b}

    return convert


def in_shu_osher(tableau: Tableau, _: fmpq | None = None) -> Printed:
    """The canonical form of Shu and Osher, whose numbers are not negative: with the SSP coefficient
    r of the printed digits and K = (A; bᵀ), α = r K (I + r K)⁻¹ and β = α/r.
    """
    A, b = explicit(tableau, "shu-osher")
    found = ssp_coefficient(tableau)
    root = None if found is None else found.value
    r = None if root is None else root.exact
    if r is None:
        message = "no exact Shu–Osher form: the SSP coefficient is no number with simple radicals"
        raise CannotConvert(message, "--to spelled-out has every method")
    if not r:
        message = "no Shu–Osher form without negative numbers: the SSP coefficient is 0"
        raise CannotConvert(message, "--to spelled-out has every method")
    try:
        rows: list[list[Number]] = []
        for i, row in enumerate([*A, b]):
            known = range(min(i, len(b)))
            made: list[Number] = []
            for j in known:
                others = (row[k] * rows[k][j] for k in known if j < k)
                made.append(row[j] - r * sum(others, start=ZERO))
            rows.append(made)
        beta = tuple(map(tuple, rows[1:]))
        return "shu-osher", {
            "alpha": tuple(tuple(r * x for x in row) for row in beta),
            "beta": beta,
        }
    except TypeError:  # numbers of two fields
        message = "no exact Shu–Osher form: the SSP coefficient is in another number field"
        raise CannotConvert(message, "--to spelled-out has every method") from None


def _rounded(numbers: Sequence[Any], tolerance: fmpq) -> list[Number]:
    digits = len(str((1 / tolerance).floor()))
    unit = fmpq(10) ** -digits
    near = (midpoint(to_ball(_number(x), 2 * digits)) for x in numbers)
    return [unit * (x / unit + fmpq(1, 2)).floor() for x in near]


def _number(x: Any) -> Number:
    return fmpq(x) if isinstance(x, int) else x
