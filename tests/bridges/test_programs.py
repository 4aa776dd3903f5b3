"""Exports that run wherever the suite runs: C where there is a compiler, SciPy where it is installed."""

from __future__ import annotations

import re
import runpy
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq
from mpmath import mp, mpf, odefun

from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.bridges.rounding import nearest_float
from garkcli.bridges.structure import table
from garkcli.bridges.trials import SEPARABLE, STEPS, TRIALS, WHOLE, Trial
from garkcli.convergence.convergence import converge
from garkcli.methodfile.load import load, loads
from garkcli.problems.files.load import load_problem
from tests.bridges.test_hostile_names import HOSTILE, named
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

CC = shutil.which("cc") or shutil.which("gcc")
DORMAND_PRINCE = """
name: Dormand-Prince 5(4)
A:
  - [0, 0, 0, 0, 0, 0, 0]
  - [1/5, 0, 0, 0, 0, 0, 0]
  - [3/40, 9/40, 0, 0, 0, 0, 0]
  - [44/45, -56/15, 32/9, 0, 0, 0, 0]
  - [19372/6561, -25360/2187, 64448/6561, -212/729, 0, 0, 0]
  - [9017/3168, -355/33, 46732/5247, 49/176, -5103/18656, 0, 0]
  - [35/384, 0, 500/1113, 125/192, -2187/6784, 11/84, 0]
b: [35/384, 0, 500/1113, 125/192, -2187/6784, 11/84, 0]
embedded: [5179/57600, 0, 7571/16695, 393/640, -92097/339200, 187/2100, 1/40]
"""
RALSTON = """
name: Ralston-Euler
A: [[0, 0], [2/3, 0]]
b: [1/4, 3/4]
embedded: [1, 0]
dense: {degree: 2, weights: [[1, -3/4], [0, 3/4]]}
"""
EXACT = ROOT / "methods/collocation.gark.yaml"


@in_whole
@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_the_end_of_each_trial_is_right(trial: Trial) -> None:
    """Taylor series of 16 digits end at the solution that the programs compare with."""

    def side(_: Any, y: Any) -> list[Any]:
        words = {"y1": "y[0]", "y2": "y[1]", "t": "t", "sin": "sin", "cos": "cos"}
        names = {"y": y, "t": _, "sin": mp.sin, "cos": mp.cos}
        total = [mpf(0), mpf(0)]
        for place in range(len(trial.sides)):
            for k, formula in enumerate(trial.formulas(place, words)):
                exact = re.sub(r"0\.3|0\.5|1\.0", lambda x: f"mpf('{x[0]}')", formula)
                total[k] += eval(exact, {"mpf": mpf, **names})
        return total

    with mp.workdps(16):
        start = [mpf(x) for x in trial.initial]
        end = odefun(side, 0, start)(trial.t_end)
        for found, wanted in zip(end, trial.final, strict=True):
            assert abs(found - mpf(wanted)) < mpf(10) ** -14


def printed(text: str) -> list[tuple[int, str]]:
    """The steps and errors that a program prints."""
    rows = re.findall(r"^ *(\d+)  (\S+e\S+)", text, re.MULTILINE)
    return [(int(n), error) for n, error in rows]


def predicted(method: str, problem: Path) -> list[tuple[int, float]]:
    """What ``gark converge`` finds on the problem file that is written beside the program."""
    read = load_problem(str(problem))
    t_end = read.t_end
    steps = [t_end / fmpq(n) for n in STEPS]
    result = converge(loads(method).tableau, read, t_end, steps)
    pairs = zip(STEPS, result.rows, strict=True)
    return [(n, float(row.error)) for n, row in pairs]


@in_whole
def test_scipy_makes_the_errors_that_gark_predicts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The program that --test writes runs in SciPy, and its errors have the digits of gark's, as
    far as floats bear them out.
    """
    pytest.importorskip("scipy")
    (tmp_path / "dp5.yaml").write_text(DORMAND_PRINCE)
    run = gark("export", "dp5.yaml", "--to", "scipy", "--test", "-o", "dp5.py", cwd=tmp_path)
    assert (run.code, run.out) == (0, "")
    assert run.err == "wrote dp5.py\nwrote dp5_test.py\nwrote dp5_problem.yaml\n"
    runpy.run_path(str(tmp_path / "dp5_test.py"), run_name="__main__")
    found = printed(capsys.readouterr().out)
    assert [n for n, _ in found] == list(STEPS)
    wanted = predicted(DORMAND_PRINCE, tmp_path / "dp5_problem.yaml")
    for (_, error), (_, expected) in zip(found[:3], wanted, strict=False):
        assert error == f"{expected:.3e}"


def test_scipy_class_of_a_method() -> None:
    """Without the last stage where SciPy has it already: 6 evaluations a step and not 7; the error
    weights sum to zero, and the dense output has the weights at its end.
    """
    np = pytest.importorskip("numpy")
    pytest.importorskip("scipy")
    from scipy.integrate import solve_ivp

    for text, stages in ((DORMAND_PRINCE, 6), (RALSTON, 2)):
        written = bridges()["scipy"].written(prepared(loads(text)))
        names: dict[str, Any] = {}
        exec(compile(written, "exported", "exec"), names)
        (solver,) = [x for x in names.values() if getattr(x, "n_stages", 0) == stages]
        assert abs(solver.E.sum()) < 1e-15
        assert np.allclose(solver.P.sum(axis=1), [*solver.B, 0], atol=1e-15)
        run = solve_ivp(
            lambda _, y: -y,
            (0, 1),
            [1.0],
            method=solver,
            first_step=1 / 8,
            max_step=1 / 8,
            rtol=1e3,
            atol=1e6,
            dense_output=True,
        )
        assert run.nfev == 1 + 8 * stages
        assert abs(run.sol(0.3) - np.exp(-0.3)) < 1e-3


def compiled(tmp_path: Path, program: str, *flags: str) -> list[str]:
    """What a C program prints; it compiles without a warning."""
    source = tmp_path / "main.c"
    source.write_text(program)
    assert CC is not None
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]
    subprocess.run(
        [CC, *strict, *flags, str(source), "-o", str(tmp_path / "main")],
        check=True,
        capture_output=True,
        timeout=60,
    )
    done = subprocess.run(
        [str(tmp_path / "main")], check=True, capture_output=True, text=True, timeout=60
    )
    return done.stdout.split()


def printing(payload: Payload, header: str) -> tuple[str, list[float]]:
    """A program that prints every number of a header in hexadecimal, and the nearest floats."""
    name = f"gark_{payload.stem}"
    lines = ["#include <stdio.h>", f'#include "{header}"', "int main(void)", "{"]
    wanted: list[float] = []
    several = payload.size > 1
    for l, blocks in enumerate(payload.A, start=1):
        for m, block in enumerate(blocks, start=1):
            array = f"{name}_A{f'{l}_{m}' if several else ''}"
            for i, row in enumerate(block or ()):
                for j, x in enumerate(row):
                    lines.append(f'  printf("%a\\n", (double){array}[{i}][{j}]);')
                    wanted.append(nearest_float(x))
    for part, rows in (("b", payload.b), ("c", payload.c)):
        for l, row in enumerate(rows, start=1):
            array = f"{name}_{part}{l if several else ''}"
            for i, x in enumerate(row):
                lines.append(f'  printf("%a\\n", (double){array}[{i}]);')
                wanted.append(nearest_float(x))
    return "\n".join([*lines, "  return 0;", "}"]) + "\n", wanted


@pytest.mark.skipif(CC is None, reason="no C compiler")
@pytest.mark.parametrize("digits", [None, 36])
def test_c_headers_are_read_back_bit_by_bit(digits: int | None, tmp_path: Path) -> None:
    """Each number that the compiler makes of a header is the float nearest to the exact one:
    fractions, radicals, decimals.
    """
    payload = prepared(load(str(EXACT)), digits)
    header = bridges()["c"].written(payload)
    (tmp_path / "table.h").write_text(header)
    program, wanted = printing(payload, "table.h")
    used = "-Wno-unused-variable"
    found = compiled(tmp_path, program, used)
    assert [float.fromhex(x) for x in found] == wanted
    assert len(wanted) == 35


@pytest.mark.skipif(CC is None, reason="no C compiler")
def test_c_headers_in_long_double(tmp_path: Path) -> None:
    """One third in long double is the quotient of two of them: no double stands between."""
    payload = prepared(loads(RALSTON))
    (tmp_path / "table.h").write_text(bridges()["c"].written(payload))
    program = (
        '#include <stdio.h>\n#include "table.h"\nint main(void)\n{\n'
        '  printf("%d\\n", gark_ralston_euler_c[1] == 2.0L / 3.0L);\n  return 0;\n}\n'
    )
    found = compiled(tmp_path, program, "-DGARK_LONG_DOUBLE", "-Wno-unused-variable")
    assert found == ["1"]


def test_fortran_fits_its_lines() -> None:
    """No line has more than 100 columns, whatever the method, and none is a bare continuation."""
    for path in sorted(ROOT.glob("methods/*.gark.yaml")):
        text = bridges()["fortran"].written(prepared(load(str(path))))
        assert max(map(len, text.splitlines())) <= 100
        assert text.isascii()


def test_every_program_names_the_command_that_predicts_it() -> None:
    """The head of a program tells how gark prints the same errors."""
    payload = prepared(loads(DORMAND_PRINCE))
    for bridge in bridges().values():
        if bridge.words is None or "rk" not in bridge.kinds:
            continue
        program, problem = bridge.tested(payload, f"m{bridge.suffix}").values()
        assert "gark converge FILE --problem m_problem.yaml" in program
        assert problem == WHOLE.file


def test_the_separable_trial_is_written_for_a_pair() -> None:
    """A method for (q, p) is tried on the pendulum, with kicks and drifts."""
    payload = prepared(load(str(ROOT / "methods/stoermer-verlet.gark.yaml")))
    for name in ("sundials", "petsc"):
        assert SEPARABLE.file in bridges()[name].tested(payload, "m.c").values()
    assert table(prepared(loads(RALSTON))).is_explicit


CLASSICAL = """
A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]
b: [1/6, 1/3, 1/3, 1/6]
"""


def test_erkstep_is_given_what_it_steps_with() -> None:
    """A last node 1 is the end of the step to ERKStep before 6.6.1, which takes the last stage for
    the first of the next one; ARKStep does not.
    """
    for text, stepper in (
        (CLASSICAL, "ARKStep"),
        (DORMAND_PRINCE, "ERKStep"),
        (RALSTON, "ERKStep"),
    ):
        payload = prepared(loads(text))
        written = bridges()["sundials"].written(payload)
        assert f"arkode_{stepper.lower()}.h" in written
        program, _ = bridges()["sundials"].tested(payload, "m.c").values()
        assert f"{stepper}Create(rhs1, " in program


@pytest.mark.skipif(CC is None, reason="no C compiler")
def test_no_name_leaves_the_comments_of_c(tmp_path: Path) -> None:
    """Headers of methods with hostile names and references compile without a warning."""
    lines = []
    for place, name in enumerate(HOSTILE):
        text = named(f"n{place} {name}", "A: [[0]]\nb: [1]\n")
        header = bridges()["c"].written(prepared(loads(text)))
        (tmp_path / f"h{place}.h").write_text(header)
        lines.append(f'#include "h{place}.h"')
    program = "\n".join([*lines, "int main(void) { return 0; }"]) + "\n"
    assert compiled(tmp_path, program, "-Wno-unused-variable") == []


@pytest.mark.parametrize(("target", "mark"), [("fortran", "!"), ("latex", "%"), ("csv", "#")])
def test_heads_are_comments(target: str, mark: str) -> None:
    """Whatever the name, the lines of the head begin with the mark of the language."""
    for name in HOSTILE:
        text = named(name, "A: [[0]]\nb: [1]\n")
        written = bridges()[target].written(prepared(loads(text))).splitlines()
        marked = [line.startswith(mark) for line in written]
        head = marked.index(False)
        assert head >= 5
        assert not any(marked[head:])
