"""torchode: a module with a class of explicit methods.

Its cubic between steps takes the slopes of the first and the last stage: a method that has none at
the end of the step gets one, whose weight is 0, and which is the first one of the next step.
"""

from __future__ import annotations

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import error_weights
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.bridges.targets.torchdiffeq import prepared
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

_IMPORTS = (
    "",
    "import torch",
    "from torchode.interpolation import ThirdOrderPolynomialInterpolation",
    "from torchode.single_step_methods.runge_kutta import (",
    "    ButcherTableau,",
    "    ERKInterpolationData,",
    "    ExplicitRungeKutta,",
    ")",
    "",
    "",
)
_END = (
    "    @torch.jit.export",
    "    def build_interpolation(self, data: ERKInterpolationData):",
    "        return ThirdOrderPolynomialInterpolation.from_k(",
    "            data.t0, data.dt, data.y0, data.y1, data.k",
    "        )",
)
_WITHOUT = "There are no embedded weights: every estimate is 0, steps are as large as they may be."


def write(payload: Payload) -> str:
    """A class of single-step methods."""
    found = prepared(payload, "torchode")
    name = payload.class_name()
    notes = [] if found.embedded is not None else [_WITHOUT]
    lines = HASH.lines(head(payload, *notes))
    lines += [*_IMPORTS, f"class {name}(ExplicitRungeKutta):"]
    lines.append("    TABLEAU = ButcherTableau.from_lists(")
    lines += _row(payload, "c=", found.c)
    lines += ["        a=["]
    for i, row in enumerate(found.A):
        lines += _row(payload, "    ", row[:i])
    lines += ["        ],"]
    lines += _row(payload, "b=", found.b)
    error = error_weights(found) or (ZERO,) * found.stages
    lines += _row(payload, "b_err=", error)
    lines += [
        "    )",
        "",
        "    def __init__(self, term=None):",
        f"        super().__init__(term, {name}.TABLEAU)",
        "",
        "    @torch.jit.export",
        "    def convergence_order(self):",
        f"        return {payload.orders.effective}",
        "",
        *_END,
    ]
    return "\n".join(lines) + "\n"


def _row(payload: Payload, begin: str, row: Row) -> list[str]:
    numbers = payload.numbers(row, PYTHON)
    return filled(numbers, f"        {begin}[", "],")


BRIDGES = (
    Bridge(
        name="torchode",
        summary="torchode: a module with a class, explicit methods",
        kinds=("rk",),
        suffix=".py",
        write=write,
    ),
)
