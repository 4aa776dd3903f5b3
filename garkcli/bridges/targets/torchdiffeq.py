"""torchdiffeq: a module that registers a solver, explicit methods.

Its steps take the last stage for f(t + h, y at the end), and begin with it: a method without such
a stage gets one, whose weight is 0, at no cost. Between steps it has a polynomial of degree 4
through both ends, their slopes and the middle, whose weights are ours to give.
"""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.python_driver import driver
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import Table
from garkcli.bridges.tables import (
    begins_at_start,
    below_diagonal,
    difference,
    error_weights,
    explicit_table,
    scaled,
    with_last_stage,
)
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

_IMPORTS = (
    "import importlib",
    "",
    "import torch",
    "from torchdiffeq._impl.rk_common import (",
    "    RKAdaptiveStepsizeODESolver,",
    "    _ButcherTableau,",
    ")",
    "",
    "",
    "def _row(*numbers):",
    "    return torch.tensor(numbers, dtype=torch.float64)",
    "",
    "",
)
_HERMITE = "Between steps: the cubic through both ends and their slopes."
_DENSE = "Between steps: the quartic through both ends, their slopes and the middle."
_WITHOUT = "There are no embedded weights: every estimate is 0, steps are as large as they may be."


def write(payload: Payload) -> str:
    """A class of solvers, known to ``odeint`` by the method's name."""
    found = prepared(payload, "torchdiffeq")
    name = payload.class_name()
    notes = [
        "The names imported below are private to torchdiffeq.",
        f'Use: odeint(f, y0, t, method="{payload.stem}").',
        _HERMITE if payload.dense is None else _DENSE,
    ]
    if found.embedded is None:
        notes.append(_WITHOUT)
    lines = HASH.lines(head(payload, *notes))
    lines += [*_IMPORTS, f"class {name}(RKAdaptiveStepsizeODESolver):"]
    orders = payload.orders
    lines += [f"    order = {orders.effective}", "    tableau = _ButcherTableau("]
    lines += _row(payload, "alpha=_row", found.c[1:])
    lines.append("        beta=[")
    for row in below_diagonal(found):
        lines += _row(payload, "    _row", row)
    lines.append("        ],")
    lines += _row(payload, "c_sol=_row", found.b)
    error = error_weights(found) or (ZERO,) * found.stages
    lines += _row(payload, "c_error=_row", error)
    lines.append("    )")
    numbers = payload.numbers(middle(payload, found), PYTHON)
    lines += filled(numbers, "    mid = _row(", ")")
    lines += [
        "",
        "",
        '_solvers = importlib.import_module("torchdiffeq._impl.odeint").SOLVERS',
        f'_solvers["{payload.stem}"] = {name}',
    ]
    return "\n".join(lines) + "\n"


def prepared(payload: Payload, target: str) -> Table:
    """The table with a last stage at the end of the step.

    Raises:
        CannotExport: the method is implicit, or begins elsewhere than at the beginning.
    """
    found = explicit_table(payload, target)
    if not begins_at_start(found):
        raise CannotExport(
            f"the first stage of {target} is at the beginning of a step; that of {payload.name}"
            " has another node",
            "boost, desolve and numpy have such methods",
        )
    return found if found.is_fsal else with_last_stage(found)


def middle(payload: Payload, found: Table) -> Row:
    """The weights of y(t + h/2): by dense output, or those that make the quartic the cubic."""
    if payload.dense is None:
        eighth = fmpq(1, 8)
        halves = [scaled(x, fmpq(1, 2)) for x in found.b]
        halves[0] = difference(halves[0], -eighth)
        halves[-1] = difference(halves[-1], eighth)
        return tuple(halves)
    weights = [_at_middle(x) for x in payload.dense[0]]
    further = found.stages - len(weights)
    return (*weights, *(ZERO,) * further)


def _at_middle(coefficients: Row) -> Cell:
    """The value at 1/2 of the polynomial with these coefficients of θ, θ², …"""
    total: Cell = ZERO
    for power, x in enumerate(coefficients, 1):
        total = difference(total, scaled(x, fmpq(-1, 2**power)))
    return total


def _row(payload: Payload, begin: str, row: Row) -> list[str]:
    return filled(payload.numbers(row, PYTHON), f"        {begin}(", "),")


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program with tolerances that accept every step, and steps bounded by h."""
    first, second = trial_of(payload).formulas(0, _WORDS)
    body = ["", "", "def f(t, y):", f"    return torch.stack([{first}, {second}])", "", ""]
    final = [
        "run = odeint(",
        "    f, torch.tensor(y0, dtype=torch.float64),",
        "    torch.tensor([0.0, t_end], dtype=torch.float64),",
        f'    method="{payload.stem}", rtol=1e3, atol=1e6,',
        '    options={"first_step": h, "max_step": h},',
        ")",
        "y = run[-1]",
    ]
    imports = ["import torch", "from torchdiffeq import odeint"]
    return driver(payload, file, imports, body, final)


_WORDS = {**WORDS, "sin": "torch.sin", "cos": "torch.cos"}


BRIDGES = (
    Bridge(
        name="torchdiffeq",
        summary="torchdiffeq: a module that registers a solver, explicit methods",
        kinds=("rk",),
        suffix=".py",
        write=write,
        test_driver=test_driver,
    ),
)
