"""SciPy: a subclass of ``RungeKutta`` for ``solve_ivp``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import Table, table, vanishes
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.bridges.trials import STEPS, WORDS, command_of, trial_of
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

HERMITE = ((0, 3, -2), (1, -2, 1), (0, -1, 1))
"""The cubic that has the values and slopes of both ends: what b_i, the first and the last slope
are multiplied by, as coefficients of θ, θ² and θ³.
"""


def write(payload: Payload) -> str:
    """The class, with its use."""
    found = table(payload)
    _refuse(payload, found)
    name = payload.class_name()
    lines = HASH.lines(head(payload, *_notes(payload, found)))
    lines += [
        "",
        "import numpy as np",
        "from scipy.integrate._ivp.rk import RungeKutta",
        "",
        "",
        f"class {name}(RungeKutta):",
        *_attributes(payload, found),
    ]
    return "\n".join(lines) + "\n"


def _refuse(payload: Payload, found: Table) -> None:
    """Whether SciPy can hold the method.

    Raises:
        CannotExport: it cannot.
    """
    if not found.is_explicit:
        raise CannotExport(
            f"scipy takes explicit methods, and {payload.name} has implicit stages",
            "sundials, petsc and diffrax take diagonally implicit ones",
        )
    if not vanishes(found.c[0]):
        raise CannotExport(
            "scipy evaluates the first stage at t, and the first node is "
            f"{payload.number(found.c[0])}",
            "where f does not depend on t, set the first node to 0",
        )


def _notes(payload: Payload, found: Table) -> list[str]:
    name = payload.class_name()
    notes = [f"Use: scipy.integrate.solve_ivp(f, (t0, t1), y0, method={name})"]
    if found.embedded is None:
        notes.append(
            "The method has no embedded weights: SciPy sees no error, and takes steps of max_step. "
            "Give first_step and max_step."
        )
    if found.is_fsal:
        notes.append("The last stage is the first of the next step, which SciPy evaluates itself.")
    if found.dense is None:
        notes.append("The method has no dense output: P is the cubic through both ends of a step.")
    return notes


def _attributes(payload: Payload, found: Table) -> list[str]:
    """What the class has; without the last stage where that is f at the new value."""
    kept = found.stages - 1 if found.is_fsal else found.stages
    rows = [row[:kept] for row in found.A[:kept]]
    orders = payload.orders
    estimated = orders.effective
    if orders.embedded is not None:
        estimated = min(orders.embedded, estimated)
    scalars = [
        f"    order = {orders.effective}",
        f"    error_estimator_order = {estimated}",
        f"    n_stages = {kept}",
    ]
    return [
        *scalars,
        *_matrix(payload, "A", rows),
        *_vector(payload, "B", found.b[:kept]),
        *_vector(payload, "C", found.c[:kept]),
        *_vector(payload, "E", _errors(found, kept)),
        *_matrix(payload, "P", _dense(found, kept)),
    ]


def _errors(found: Table, kept: int) -> Row:
    """The differences b̂ − b of the stages, and of f at the new value: the sign that the classes of
    SciPy have.
    """
    if found.embedded is None:
        return (ZERO,) * (kept + 1)
    pairs = zip(found.b, found.embedded, strict=True)
    errors = tuple(other - b for b, other in pairs)
    return errors if kept < found.stages else (*errors, ZERO)


def _dense(found: Table, kept: int) -> Sequence[Row]:
    """The coefficients of θ, θ², … for the stages, and for f at the new value."""
    if found.dense is not None:
        nothing = (ZERO,) * len(found.dense[0])
        if kept < found.stages:
            return found.dense
        return (*found.dense, nothing)
    of_value, of_first, of_last = HERMITE
    rows = [tuple(b * k for k in of_value) for b in found.b[:kept]]
    rows[0] = tuple(x + k for x, k in zip(rows[0], of_first, strict=True))
    last: Row = tuple(map(fmpq, of_last))
    return [*rows, last]


def _vector(payload: Payload, name: str, row: Sequence[Cell]) -> list[str]:
    numbers = payload.numbers(tuple(row), PYTHON)
    begin = f"    {name} = np.array(["
    return filled(numbers, begin, "], dtype=float)")


def _matrix(payload: Payload, name: str, rows: Sequence[Row]) -> list[str]:
    lines = [f"    {name} = np.array(["]
    for row in rows:
        numbers = payload.numbers(row, PYTHON)
        lines += filled(numbers, "        [", "],")
    return [*lines, "    ], dtype=float)"]


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program that takes fixed steps with ``solve_ivp``."""
    trial = trial_of(payload)
    module = PurePath(file).stem
    problem = f"{module}_problem.yaml"
    first, second = trial.formulas(0, {**WORDS, "sin": "sin", "cos": "cos"})
    name = payload.class_name()
    initial = ", ".join(trial.initial)
    final = ", ".join(trial.final)
    same = ("The same errors:", f"  {command_of(payload, problem)}")
    text = "\n".join(
        [
            *HASH.lines([f"Runs {file} in SciPy.", *same]),
            "import importlib.util",
            "from math import cos, log2, sin, sqrt",
            "from pathlib import Path",
            "",
            "from scipy.integrate import solve_ivp",
            "",
            f"path = Path(__file__).with_name({file!a})",
            'spec = importlib.util.spec_from_file_location("table", path)',
            "table = importlib.util.module_from_spec(spec)",
            "spec.loader.exec_module(table)",
            "",
            "",
            "def f(t, y):",
            f"    return [{first}, {second}]",
            "",
            "",
            "before = None",
            'print("steps      error  slope")',
            f"for n in {STEPS}:",
            f"    h = {trial.t_end} / n",
            "    run = solve_ivp(",
            f"        f, (0, {trial.t_end}), [{initial}], method=table.{name},",
            "        first_step=h, max_step=h, rtol=1e3, atol=1e6,",
            "    )",
            "    assert run.success and len(run.t) == n + 1, run.message",
            f"    final = [{final}]",
            "    error = sqrt(sum((x - z) ** 2 for x, z in zip(run.y[:, -1], final)))",
            '    slope = "" if before is None else f"  {log2(before / error):5.2f}"',
            '    print(f"{n:5}  {error:.3e}{slope}")',
            "    before = error",
        ]
    )
    return [Written("_test.py", text + "\n"), Written("_problem.yaml", trial.file)]


BRIDGES = (
    Bridge(
        name="scipy",
        summary="a method of scipy.integrate.solve_ivp, explicit",
        kinds=("rk",),
        suffix=".py",
        write=write,
        test_driver=test_driver,
    ),
)
