"""Fortran: a module with constant arrays, of at most 100 columns."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.comments import BANG, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import named_arrays
from garkcli.tableau.pointwise import Row

STYLE = Style(digits=39, longest=80, fraction="{p}.0_wp/{q}.0_wp", decimal="{x}_wp")
"""39 digits are enough for real128; a longer number would not fit a line."""
WIDTH = 98


def write(payload: Payload) -> str:
    """The module; several vector fields have arrays ``A_1_2``, ``b_2`` with their numbers."""
    name = f"gark_{payload.stem}"
    note = "Change wp for another precision; the digits are enough for real128."
    lines = BANG.lines(head(payload, note))
    lines += [
        f"module {name}",
        "  use, intrinsic :: iso_fortran_env, only: wp => real64",
        "  implicit none",
        "  private :: wp",
        f"  integer, parameter :: order = {payload.orders.order}",
    ]
    if payload.orders.embedded is not None:
        embedded = payload.orders.embedded
        lines.append(f"  integer, parameter :: embedded_order = {embedded}")
    for l, stages in enumerate(payload.stages, start=1):
        stages_name = f"stages{_number(payload, l)}"
        lines.append(f"  integer, parameter :: {stages_name} = {stages}")
    for part, rows in named_arrays(payload, "_"):
        is_matrix = part.startswith(("A", "dense"))
        lines += _matrix(payload, part, rows) if is_matrix else _vector(payload, part, rows[0])
    return "\n".join([*lines, f"end module {name}"]) + "\n"


def _number(payload: Payload, l: int) -> str:
    """What tells the arrays of vector fields from each other."""
    return "" if payload.size == 1 else f"_{l}"


def _vector(payload: Payload, name: str, row: Row, access: str = "") -> list[str]:
    begin = f"  real(wp), parameter{access} :: {name}({len(row)}) = [ &"
    numbers = filled(payload.numbers(row, STYLE), "      ", " ]", continuation=" &", width=WIDTH)
    return [begin, *numbers]


def _matrix(payload: Payload, name: str, rows: Sequence[Row]) -> list[str]:
    """Row by row, because a statement has a limited number of lines."""
    lines: list[str] = []
    names = []
    for i, row in enumerate(rows, start=1):
        row_name = f"{name}_row{i}"
        names.append(row_name)
        lines += _vector(payload, row_name, row, ", private")
    shape = f"[{len(rows)}, {len(rows[0])}]"
    size = f"{len(rows)}, {len(rows[0])}"
    lines.append(f"  real(wp), parameter :: {name}({size}) = reshape([ &")
    lines += filled(names, "      ", " ], &", continuation=" &", width=WIDTH)
    lines.append(f"      {shape}, order=[2, 1])")
    return lines


BRIDGES = (
    Bridge(
        name="fortran",
        summary="a Fortran module with constant arrays",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".f90",
        write=write,
        reads_back=False,
    ),
)
