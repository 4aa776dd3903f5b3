"""Dedalus 3: a class of implicit-explicit methods.

The last rows of its matrices are the weights, so both methods have to end with a stage at the new
value, and its first stage is explicit: what is not there is put in, with the weight 0.
"""

from __future__ import annotations

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Rows, Table, vanishes
from garkcli.bridges.tables import imex_tables, with_first_stage, with_last_stage
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.exact.field import ONE
from garkcli.tableau.pointwise import Row

_IMPORTS = (
    "",
    "import numpy as np",
    "from dedalus.core.timesteppers import RungeKuttaIMEX, add_scheme",
    "",
    "",
    "@add_scheme",
)
_PUT_IN = (
    "A last stage is put in, at the new value and explicit: the matrix of the time derivatives is"
    " solved with alone there."
)


def write(payload: Payload) -> str:
    """A scheme; H is the implicit method, A the explicit one."""
    pair = imex_tables(payload, "dedalus")
    begins = all(_begins(found) for found in pair)
    if not begins:
        pair = with_first_stage(pair[0]), with_first_stage(pair[1])
    ends = all(_ends(found) for found in pair)
    if not ends:
        pair = with_last_stage(pair[0]), with_last_stage(pair[1])
    explicit, implicit = pair
    lines = HASH.lines(head(payload, *([] if ends else [_PUT_IN])))
    lines += [*_IMPORTS, f"class {payload.class_name()}(RungeKuttaIMEX):"]
    # the first stage is not counted
    lines += [f"    stages = {explicit.stages - 1}"]
    lines += _row(payload, "    c = np.array([", explicit.c, "], dtype=float)")
    lines += _matrix(payload, "A", explicit.A)
    lines += _matrix(payload, "H", implicit.A)
    return "\n".join(lines) + "\n"


def _begins(found: Table) -> bool:
    return all(map(vanishes, found.A[0]))


def _ends(found: Table) -> bool:
    """Whether the last stage is at the new value; a single one is the first too."""
    return found.stages > 1 and found.A[-1] == found.b and found.c[-1] == ONE


def _matrix(payload: Payload, name: str, rows: Rows) -> list[str]:
    lines = [f"    {name} = np.array(["]
    for row in rows:
        lines += _row(payload, "        [", row, "],")
    return [*lines, "    ], dtype=float)"]


def _row(payload: Payload, begin: str, row: Row, end: str) -> list[str]:
    return filled(payload.numbers(row, PYTHON), begin, end)


BRIDGES = (
    Bridge(
        name="dedalus",
        summary="Dedalus 3: a class, IMEX methods",
        kinds=("ark", "prk", "gark"),
        suffix=".py",
        write=write,
    ),
)
