"""Programs that run a table in ARKODE, of SUNDIALS 6.4 to 7."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from garkcli.bridges.c_text import error_function, main_function, side_functions
from garkcli.bridges.comments import C
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Written
from garkcli.bridges.trials import Trial, command_of, trial_of

LIBRARIES = "-lsundials_arkode -lsundials_nvecserial -lm"
_RENAMED = (
    "SStolerances",
    "SetFixedStep",
    "SetLinearSolver",
    "SetMaxNonlinIters",
    "SetNonlinConvCoef",
    "Evolve",
    "Free",
)
_STEPPERS = {
    "erk": "ERKStep",
    "explicit": "ARKStep",
    "dirk": "ARKStep",
    "ark": "ARKStep",
    "sprk": "SPRKStep",
}


def driver(
    payload: Payload, file: str, name: str, kind: str, sides: Sequence[int]
) -> list[Written]:
    """The program, and the problem file.

    Args:
        payload: the method.
        file: the name of the file with its table.
        name: of the function that sets it; of SPRK, that makes it.
        kind: erk, explicit (in ARKStep), dirk, ark or sprk.
        sides: the right-hand sides in the order of SUNDIALS.
    """
    stem = PurePath(file).stem
    trial = trial_of(payload)
    stepper = _STEPPERS[kind]
    program = f"{stem}_test"
    lines = C.lines(
        [
            f"Runs {file} in {stepper} of SUNDIALS.",
            "Build:",
            f"  cc {program}.c {file} {LIBRARIES} -o {program}",
            "The same errors:",
            f"  {command_of(payload, f'{stem}_problem.yaml')}",
        ]
    )
    lines += _includes(kind, stepper)
    lines += _declarations(name, kind)
    if kind == "sprk":
        lines += _parts(trial)
    else:
        lines += side_functions(trial, sides)
        lines += [x for k in range(len(sides)) for x in _wrapped(k + 1)]
    lines += error_function(trial)
    lines += _run(trial, name, kind)
    lines += ["int main(void)", "{", *main_function("run(n, y)"), "  return 0;", "}"]
    return [Written("_test.c", "\n".join(lines) + "\n"), Written("_problem.yaml", trial.file)]


def _includes(kind: str, stepper: str) -> list[str]:
    lines = ["#include <math.h>", "#include <stdio.h>", ""]
    lines.append(f"#include <arkode/arkode_{stepper.lower()}.h>")
    lines.append("#include <nvector/nvector_serial.h>")
    lines.append("#include <sundials/sundials_config.h>")
    if kind in ("dirk", "ark"):
        lines.append("#include <sunlinsol/sunlinsol_dense.h>")
        lines.append("#include <sunmatrix/sunmatrix_dense.h>")
    # from 7 on the integrators share these functions
    lines += ["", "#if SUNDIALS_VERSION_MAJOR >= 7"]
    lines += [f"#define {x} ARKode{x}" for x in _RENAMED]
    lines += ["#define NO_COMM SUN_COMM_NULL", "#else"]
    lines += [f"#define {x} {stepper}{x}" for x in _RENAMED]
    return [*lines, "#define NO_COMM NULL", "#endif", ""]


def _declarations(name: str, kind: str) -> list[str]:
    if kind == "sprk":
        return [f"ARKodeSPRKTable {name}(void);", ""]
    return [f"int {name}_set(void *arkode_mem);", ""]


def _wrapped(number: int) -> list[str]:
    """A right-hand side as SUNDIALS calls it."""
    return [
        f"static int rhs{number}(sunrealtype t, N_Vector y, N_Vector dy, void *data)",
        "{",
        "  (void)data;",
        f"  f{number}(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));",
        "  return 0;",
        "}",
        "",
    ]


def _parts(trial: Trial) -> list[str]:
    """The forces, and the velocities; each leaves zeros in the other part."""
    words = {"y1": "v[0]", "y2": "v[1]", "t": "t", "sin": "sin", "cos": "cos"}
    q, p = trial.formulas(0, words)
    lines = []
    for number, (first, second) in enumerate((("0.0", p), (q, "0.0")), 1):
        lines += [
            f"static int rhs{number}(sunrealtype t, N_Vector y, N_Vector dy, void *data)",
            "{",
            "  const sunrealtype *v = N_VGetArrayPointer(y);",
            "  sunrealtype *dv = N_VGetArrayPointer(dy);",
            "  (void)t;",
            "  (void)data;",
            f"  dv[0] = {first};",
            f"  dv[1] = {second};",
            "  return 0;",
            "}",
            "",
        ]
    return lines


_CREATE = {
    "erk": "ERKStepCreate(rhs1, 0.0, u, ctx)",
    "explicit": "ARKStepCreate(rhs1, NULL, 0.0, u, ctx)",
    "dirk": "ARKStepCreate(NULL, rhs1, 0.0, u, ctx)",
    "ark": "ARKStepCreate(rhs1, rhs2, 0.0, u, ctx)",
    "sprk": "SPRKStepCreate(rhs1, rhs2, 0.0, u, ctx)",
}


def _run(trial: Trial, name: str, kind: str) -> list[str]:
    """The function that takes n steps."""
    first, second = trial.initial
    lines = [
        "static int run(int n, double *y)",
        "{",
        "  SUNContext ctx;",
        "  if (SUNContext_Create(NO_COMM, &ctx))",
        "    return 1;",
        "  N_Vector u = N_VNew_Serial(2, ctx);",
        "  sunrealtype *v = N_VGetArrayPointer(u);",
        "  sunrealtype t = 0.0;",
        f"  v[0] = {first};",
        f"  v[1] = {second};",
        f"  void *mem = {_CREATE[kind]};",
    ]
    if kind == "sprk":
        lines += [
            f"  ARKodeSPRKTable table = {name}();",
            "  int bad = SPRKStepSetMethod(mem, table);",
        ]
    else:
        lines += [
            f"  int bad = {name}_set(mem);",
            "  bad = bad || SStolerances(mem, 1e-12, 1e-12);",
        ]
    if kind in ("dirk", "ark"):
        lines += [
            "  SUNMatrix J = SUNDenseMatrix(2, 2, ctx);",
            "  SUNLinearSolver solver = SUNLinSol_Dense(u, J, ctx);",
            "  bad = bad || SetLinearSolver(mem, solver, J);",
            "  bad = bad || SetMaxNonlinIters(mem, 50);",
            "  bad = bad || SetNonlinConvCoef(mem, 0.01);",
        ]
    lines += [
        f"  bad = bad || SetFixedStep(mem, {trial.t_end}.0 / n);",
        "  for (int k = 0; k < n && !bad; k++)",
        f"    bad = Evolve(mem, {trial.t_end}.0, u, &t, ARK_ONE_STEP) < 0;",
        "  y[0] = v[0];",
        "  y[1] = v[1];",
        f"  bad = bad || fabs(t - {trial.t_end}.0) > 1e-9;",
        "  Free(&mem);",
    ]
    if kind in ("dirk", "ark"):
        lines += ["  SUNLinSolFree(solver);", "  SUNMatDestroy(J);"]
    if kind == "sprk":
        lines.append("  ARKodeSPRKTable_Free(table);")
    return [*lines, "  N_VDestroy(u);", "  SUNContext_Free(&ctx);", "  return bad;", "}", ""]
