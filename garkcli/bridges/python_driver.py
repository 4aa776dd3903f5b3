"""What programs of Python that run an exported module have in common."""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.bridges.comments import HASH
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Written
from garkcli.bridges.trials import STEPS, command_of, trial_of


def driver(
    payload: Payload, file: str, imports: Iterable[str], body: Iterable[str], final: Iterable[str]
) -> list[Written]:
    """A program that loads the module ``table``, steps through the time, and prints the errors.

    Args:
        payload: the method.
        file: the module's.
        imports: lines before all.
        body: what stands before the loop, of vector fields and solvers.
        final: the lines that compute ``y`` in n steps of h.
    """
    trial = trial_of(payload)
    stem = file.removesuffix(".py")
    problem = f"{stem}_problem.yaml"
    notes = [
        f"Runs {file}: python {stem}_test.py",
        f"The same errors: {command_of(payload, problem)}",
    ]
    lines = [
        *HASH.lines(notes),
        "import importlib.util",
        "from math import hypot, log2",
        "from pathlib import Path",
        "",
        *imports,
        "",
        f"path = Path(__file__).with_name({file!a})",
        'spec = importlib.util.spec_from_file_location("table", path)',
        "table = importlib.util.module_from_spec(spec)",
        "spec.loader.exec_module(table)",
        f"t_end = {trial.t_end}",
        f"y0 = [{', '.join(trial.initial)}]",
        f"final = [{', '.join(trial.final)}]",
        *body,
        "before = None",
        'print("steps      error  slope")',
        f"for n in {STEPS}:",
        "    h = t_end / n",
        *(f"    {line}" for line in final),
        "    error = hypot(float(y[0]) - final[0], float(y[1]) - final[1])",
        '    slope = "" if before is None else f"  {log2(before / error):5.2f}"',
        '    print(f"{n:5}  {error:.3e}{slope}")',
        "    before = error",
    ]
    text = "\n".join(lines) + "\n"
    return [Written("_test.py", text), Written("_problem.yaml", trial.file)]
