"""Programs that run a method in TS of PETSc."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from garkcli.bridges.c_text import error_function, main_function, side_functions
from garkcli.bridges.comments import C
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Written
from garkcli.bridges.trials import Trial, command_of, trial_of

OPTIONS = {
    "-ts_adapt_type": "none",
    "-snes_mf": "",
    "-snes_linesearch_type": "basic",
    "-snes_rtol": "1e-13",
    "-snes_atol": "1e-14",
    "-snes_stol": "1e-15",
    "-ksp_rtol": "1e-8",
}
"""Steps of one size; stages solved as far as the floats go, without a matrix."""
_SIGNATURE = "(TS ts, PetscReal t, Vec u, Vec f, void *ctx)"


def driver(
    payload: Payload, file: str, name: str, kind: str, sides: Sequence[int]
) -> list[Written]:
    """The program, and the problem file.

    Args:
        payload: the method.
        file: the name of the file with its table.
        name: what PETSc calls the method.
        kind: rk, dirk, arkimex or basicsymplectic.
        sides: the right-hand sides, the explicit one first.
    """
    trial = trial_of(payload)
    register = f"gark_{payload.stem}_register"
    lines = [
        *_comment(payload, file),
        "#include <math.h>",
        "#include <stdio.h>",
        "",
        "#include <petscts.h>",
        "",
        f"PetscErrorCode {register}(void);",
        "",
    ]
    if kind == "basicsymplectic":
        lines += _parts(trial)
    else:
        lines += side_functions(trial, sides)
        lines += _right_hand_sides(kind)
    lines += error_function(trial)
    lines += _run(trial, kind, name)
    lines += _main(register)
    return [Written("_test.c", "\n".join(lines) + "\n"), Written("_problem.yaml", trial.file)]


def _comment(payload: Payload, file: str) -> list[str]:
    """What the program does, how it is built, and the command that has the same errors."""
    stem = PurePath(file).stem
    program = f"{stem}_test"
    return C.lines(
        [
            f"Runs {file} in TS of PETSc.",
            "Build:",
            f"  mpicc {program}.c {file} $(pkg-config --cflags --libs PETSc) -lm -o {program}",
            "The same errors:",
            f"  {command_of(payload, f'{stem}_problem.yaml')}",
        ]
    )


def _main(register: str) -> list[str]:
    """PETSc with its options, the method among its own by the function ``register``, and the
    runs.
    """
    prologue = [
        "  PetscFunctionBeginUser;",
        "  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));",
        f"  PetscCall({register}());",
    ]
    for option, value in OPTIONS.items():
        text = f'"{value}"' if value else "NULL"
        prologue.append(f'  PetscCall(PetscOptionsSetValue(NULL, "{option}", {text}));')
    return [
        "int main(int argc, char **argv)",
        "{",
        *main_function("run(n, y)", prologue),
        "  PetscCall(PetscFinalize());",
        "  return 0;",
        "}",
    ]


def _right_hand_sides(kind: str) -> list[str]:
    """The explicit function, and F(t, u, u') = u' - f of the implicit one."""
    lines: list[str] = []
    if kind != "dirk":
        lines += [
            f"static PetscErrorCode explicit_side{_SIGNATURE}",
            "{",
            *_opened("const PetscScalar *y", "u"),
            "  f1(t, y, dy);",
            *_closed("u"),
        ]
    if kind == "rk":
        return lines
    function = "f1" if kind == "dirk" else "f2"
    return [
        *lines,
        "static PetscErrorCode implicit_side(TS ts, PetscReal t, Vec u, Vec v, Vec f, void *ctx)",
        "{",
        *_opened("const PetscScalar *y", "u"),
        f"  {function}(t, y, dy);",
        "  PetscCall(VecRestoreArrayRead(u, &y));",
        "  PetscCall(VecRestoreArray(f, &dy));",
        "  PetscCall(VecAYPX(f, -1.0, v));",
        "  PetscFunctionReturn(0);",
        "}",
        "",
    ]


def _opened(declaration: str, vector: str) -> list[str]:
    """The beginning of a function of vectors."""
    return [
        f"  {declaration};",
        "  PetscScalar *dy;",
        "  PetscFunctionBeginUser;",
        "  (void)ts;",
        "  (void)t;",
        "  (void)ctx;",
        f"  PetscCall(VecGetArrayRead({vector}, &y));",
        "  PetscCall(VecGetArray(f, &dy));",
    ]


def _closed(vector: str) -> list[str]:
    """Its end."""
    return [
        f"  PetscCall(VecRestoreArrayRead({vector}, &y));",
        "  PetscCall(VecRestoreArray(f, &dy));",
        "  PetscFunctionReturn(0);",
        "}",
        "",
    ]


def _parts(trial: Trial) -> list[str]:
    """Velocities of the momenta, and forces at the positions, one number each."""
    words = {"y1": "y[0]", "y2": "y[0]", "t": "t", "sin": "sin", "cos": "cos"}
    q, p = trial.formulas(0, words)
    lines = []
    for name, formula in (("velocity", q), ("force", p)):
        lines += [
            f"static PetscErrorCode {name}{_SIGNATURE}",
            "{",
            *_opened("const PetscScalar *y", "u"),
            f"  dy[0] = {formula};",
            *_closed("u"),
        ]
    return lines


_SETUP = {
    "rk": [
        "  PetscCall(TSSetRHSFunction(ts, NULL, explicit_side, NULL));",
        "  PetscCall(TSSetType(ts, TSRK));",
        '  PetscCall(TSRKSetType(ts, "{name}"));',
    ],
    "dirk": [
        "  PetscCall(TSSetIFunction(ts, NULL, implicit_side, NULL));",
        "  PetscCall(TSSetType(ts, TSARKIMEX));",
        '  PetscCall(TSARKIMEXSetType(ts, "{name}"));',
    ],
    "arkimex": [
        "  PetscCall(TSSetRHSFunction(ts, NULL, explicit_side, NULL));",
        "  PetscCall(TSSetIFunction(ts, NULL, implicit_side, NULL));",
        "  PetscCall(TSSetType(ts, TSARKIMEX));",
        '  PetscCall(TSARKIMEXSetType(ts, "{name}"));',
    ],
    "basicsymplectic": [
        "  IS first, second;",
        "  PetscCall(ISCreateStride(PETSC_COMM_SELF, 1, 0, 1, &first));",
        "  PetscCall(ISCreateStride(PETSC_COMM_SELF, 1, 1, 1, &second));",
        '  PetscCall(TSRHSSplitSetIS(ts, "position", first));',
        '  PetscCall(TSRHSSplitSetIS(ts, "momentum", second));',
        '  PetscCall(TSRHSSplitSetRHSFunction(ts, "position", NULL, velocity, NULL));',
        '  PetscCall(TSRHSSplitSetRHSFunction(ts, "momentum", NULL, force, NULL));',
        "  PetscCall(TSSetType(ts, TSBASICSYMPLECTIC));",
        '  PetscCall(TSBasicSymplecticSetType(ts, "{name}"));',
    ],
}


def _run(trial: Trial, kind: str, name: str) -> list[str]:
    """The function that takes n steps."""
    first, second = trial.initial
    setup = [line.replace("{name}", name) for line in _SETUP[kind]]
    ends = []
    if kind == "basicsymplectic":
        ends = [f"  PetscCall(ISDestroy(&{x}));" for x in ("first", "second")]
    return [
        "static PetscErrorCode run(int n, double *y)",
        "{",
        "  TS ts;",
        "  Vec u;",
        "  const PetscScalar *v;",
        "  PetscFunctionBeginUser;",
        "  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 2, &u));",
        f"  PetscCall(VecSetValue(u, 0, {first}, INSERT_VALUES));",
        f"  PetscCall(VecSetValue(u, 1, {second}, INSERT_VALUES));",
        "  PetscCall(VecAssemblyBegin(u));",
        "  PetscCall(VecAssemblyEnd(u));",
        "  PetscCall(TSCreate(PETSC_COMM_SELF, &ts));",
        *setup,
        "  PetscCall(TSSetSolution(ts, u));",
        f"  PetscCall(TSSetTimeStep(ts, {trial.t_end}.0 / n));",
        f"  PetscCall(TSSetMaxTime(ts, {trial.t_end}.0));",
        "  PetscCall(TSSetMaxSteps(ts, n));",
        "  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));",
        "  PetscCall(TSSetFromOptions(ts));",
        "  PetscCall(TSSolve(ts, u));",
        "  PetscCall(VecGetArrayRead(u, &v));",
        "  y[0] = PetscRealPart(v[0]);",
        "  y[1] = PetscRealPart(v[1]);",
        "  PetscCall(VecRestoreArrayRead(u, &v));",
        "  PetscCall(VecDestroy(&u));",
        *ends,
        "  PetscCall(TSDestroy(&ts));",
        "  PetscFunctionReturn(0);",
        "}",
        "",
    ]
