"""C: a header with constant arrays, for any real type."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.c_text import array, c_style, heading
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import named_arrays
from garkcli.tableau.pointwise import Row

STYLE = c_style("GARK_REAL_C")
_TYPE = """\
#ifndef GARK_REAL_C
#if defined(GARK_LONG_DOUBLE)
typedef long double gark_real;
#define GARK_REAL_C(x) x##L
#elif defined(GARK_FLOAT128)
typedef __float128 gark_real;
#define GARK_REAL_C(x) x##Q
#else
typedef double gark_real;
#define GARK_REAL_C(x) x
#endif
#endif"""


def write(payload: Payload) -> str:
    """The header; several vector fields have arrays ``A1_2``, ``b2`` with their numbers."""
    name = f"gark_{payload.stem}"
    guard = f"{name.upper()}_H"
    notes = (
        "Numbers are double; long double with -DGARK_LONG_DOUBLE, __float128 with -DGARK_FLOAT128.",
    )
    lines = heading(payload, *notes)
    lines += [f"#ifndef {guard}", f"#define {guard}", "", _TYPE, ""]
    constants = ",\n  ".join(_constants(payload, name))
    lines += ["enum {", f"  {constants}", "};", ""]
    for part, rows in named_arrays(payload):
        is_matrix = len(rows) > 1 or part[0] in "Ad"
        height = f"[{len(rows)}]" if is_matrix else ""
        width = f"[{len(rows[0])}]"
        declaration = f"static const gark_real {name}_{part}{height}{width}"
        lines += _one(payload, declaration, rows, is_matrix)
    return "\n".join([*lines, "", f"#endif /* {guard} */"]) + "\n"


def _one(payload: Payload, declaration: str, rows: Sequence[Row], is_matrix: bool) -> list[str]:
    """A vector, or a matrix with braces around its rows."""
    if not is_matrix:
        return array(payload, declaration, rows, STYLE)
    lines = [f"{declaration} = {{"]
    for row in rows:
        inner = array(payload, "", (row,), STYLE)
        numbers = [f"  {line}" for line in inner[1:-1]]
        lines += ["  {", *numbers, "  },"]
    return [*lines, "};"]


def _constants(payload: Payload, name: str) -> list[str]:
    """Numbers of stages and orders."""
    found = []
    for l, stages in enumerate(payload.stages, start=1):
        number = "" if payload.size == 1 else str(l)
        found.append(f"{name}_stages{number} = {stages}")
    found.append(f"{name}_order = {payload.orders.order}")
    if payload.orders.embedded is not None:
        found.append(f"{name}_embedded_order = {payload.orders.embedded}")
    return found


BRIDGES = (
    Bridge(
        name="c",
        summary="a C header with constant arrays",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".h",
        write=write,
        reads_back=True,
    ),
)
