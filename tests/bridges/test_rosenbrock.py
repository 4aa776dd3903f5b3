"""Rosenbrock methods in other codes: programs step as the method does, tables have its numbers."""

from __future__ import annotations

import re
import runpy
import shutil
import subprocess
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from flint import fmpq
from mpmath import cos, lu_solve, matrix, mp, mpf, sin

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.linear_stages import program_stages
from garkcli.bridges.orders import Orders
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.exact.display import to_decimal
from garkcli.exact.field import Number
from garkcli.methodfile.load import load, loads
from tests.cli.harness import gark

CC = shutil.which("cc") or shutil.which("gcc")
START, STEPS, END = ("1.2", "0.4"), 6, 2
TIMED = """
name: with time
rosenbrock:
  alpha: [[], [1/2]]
  gamma: [[1/3], [2/7, 1/4]]
  b: [1/5, 4/5]
  c: [1/9, 3/4]
  d: [2/11, 1/3]
"""
"""Several γ_ii, and nodes that are no row sums: only what is given can be right."""


def payload(name: str) -> Payload:
    """A method as writers see it; its orders are the matter of other tests."""
    with patch("garkcli.bridges.preparing.find_orders", lambda *_: Orders(2, embedded=1)):
        return prepared(loads(TIMED) if name == "timed" else load(name))


def number(x: Number) -> mpf:
    """A number of a method with the digits of mpmath."""
    return mpf(int(x.p)) / int(x.q) if isinstance(x, fmpq) else mpf(to_decimal(x, 40))


def sides(t: mpf, y: Sequence[mpf]) -> tuple[list[mpf], list[list[mpf]], list[mpf]]:
    """F, ∂f/∂y and ∂f/∂t of y1' = y2 cos t, y2' = −sin y1."""
    f = [y[1] * cos(t), -sin(y[0])]
    return f, [[mpf(0), cos(t)], [-cos(y[0]), mpf(0)]], [-y[1] * sin(t), mpf(0)]


def run(step: Callable[[mpf, list[mpf], mpf], list[mpf]]) -> list[mpf]:
    """The value after all steps."""
    y, h = [mpf(x) for x in START], mpf(END) / STEPS
    for n in range(STEPS):
        y = step(n * h, y, h)
    return y


def printed_run(name: str) -> list[mpf]:
    """By the definition: k_i = f(t + c_i h, y + h Σ α_ij k_j) + h J Σ γ_ij k_j + h d_i ∂f/∂t."""
    row = payload(name).rosenbrock
    assert row is not None
    alpha, gamma, b = row.alpha[0][0], row.gamma[0][0], row.b[0]
    (c,), (d,) = row.nodes

    def step(t: mpf, y: list[mpf], h: mpf) -> list[mpf]:
        k: list[Any] = []
        _, J, slope = sides(t, y)
        jacobian = matrix(J)
        for i in range(len(b)):
            at = [y[r] + h * sum(number(alpha[i][j]) * k[j][r] for j in range(i)) for r in (0, 1)]
            f = matrix(sides(t + number(c[i]) * h, at)[0]) + h * number(d[i]) * matrix(slope)
            for j in range(i):
                f += h * number(gamma[i][j]) * (jacobian * k[j])
            k.append(lu_solve(mp.eye(2) - h * number(gamma[i][i]) * jacobian, f))
        return [y[r] + h * sum(number(x) * v[r] for x, v in zip(b, k, strict=True)) for r in (0, 1)]

    return run(step)


def of_kpp(text: str) -> dict[str, dict[int, str]]:
    """The assignments of a subroutine of KPP."""
    found: dict[str, dict[int, str]] = {}
    for name, place, value in re.findall(r"ros_(\w+)\((\d+)\) = (\S+)", text):
        found.setdefault(name, {})[int(place)] = value.replace("_dp", "")
    return found


def kpp_run(text: str) -> list[mpf]:
    """The step of KPP's integrator: one matrix 1/(h ros_Gamma(1)) − J, and no new f where
    ros_NewF says so.
    """
    given = of_kpp(text)

    def value(name: str, place: int) -> mpf:
        p, _, q = given[name][place].partition("/")
        return mpf(p) / mpf(q or 1)

    stages = len(given["M"])

    def step(t: mpf, y: list[mpf], h: mpf) -> list[mpf]:
        f, J, slope = sides(t, y)
        K: list[Any] = []
        for i in range(1, stages + 1):
            row = (i - 1) * (i - 2) // 2
            if i > 1 and given["NewF"][i] == ".TRUE.":
                at = [
                    y[r] + sum(value("A", row + j) * K[j - 1][r] for j in range(1, i))
                    for r in (0, 1)
                ]
                f = sides(t + value("Alpha", i) * h, at)[0]
            right = matrix(f) + h * value("Gamma", i) * matrix(slope)
            for j in range(1, i):
                right += value("C", row + j) / h * K[j - 1]
            K.append(lu_solve(mp.eye(2) / (h * value("Gamma", 1)) - matrix(J), right))
        return [y[r] + sum(value("M", i + 1) * K[i][r] for i in range(stages)) for r in (0, 1)]

    return run(step)


def assert_near(found: Sequence[Any], wanted: Sequence[mpf]) -> None:
    """Two values are equal but for the rounding of floats."""
    for x, y in zip(found, wanted, strict=True):
        assert abs(mpf(x) - y) < mpf("1e-13")


@pytest.mark.parametrize("name", ["ros3p", "rodas4", "timed", "lassp-34"])
def test_the_step_of_numpy(tmp_path: Path, name: str) -> None:
    """The module steps as the definition says, with time, several γ_ii and stages without one; its
    estimate is the difference of the two results.
    """
    method = payload(name)
    text = bridges()["numpy"].written(method)
    step = _step_of(tmp_path / "method.py", text)
    y, h = [float(x) for x in START], END / STEPS
    for n in range(STEPS):
        made = step(*SIDES[:2], n * h, y, h, SIDES[2])
        y = made if method.embedded is None else made[0]
    assert_near(y, printed_run(name))
    if method.embedded is not None:
        other = _step_of(tmp_path / "other.py", f"{text}\nb = embedded\n")
        value, estimate = step(*SIDES[:2], 0.0, [1.2, 0.4], h, SIDES[2])
        less, _ = other(*SIDES[:2], 0.0, [1.2, 0.4], h, SIDES[2])
        assert_near(estimate, [mpf(x) - mpf(z) for x, z in zip(value, less, strict=True)])


def _step_of(path: Path, text: str) -> Callable[..., Any]:
    path.write_text(text, encoding="utf-8")
    found: Callable[..., Any] = runpy.run_path(str(path))["step"]
    return found


def _side(which: int) -> Callable[..., Any]:
    """F, ∂f/∂y or ∂f/∂t in floats."""
    return lambda t, y: np.array(sides(mpf(t), [mpf(x) for x in y])[which], dtype=float)


SIDES = [_side(which) for which in range(3)]


PROGRAM = """
#include <math.h>
#include <stdio.h>
#include "method.h"
static void f(gark_real t, const gark_real *y, gark_real *r, void *data)
{ (void)data; r[0] = y[1] * cos(t); r[1] = -sin(y[0]); }
static void dfdy(gark_real t, const gark_real *y, gark_real *r, void *data)
{ (void)data; r[0] = 0; r[1] = cos(t); r[2] = -cos(y[0]); r[3] = 0; }
static void dfdt(gark_real t, const gark_real *y, gark_real *r, void *data)
{ (void)data; r[0] = -y[1] * sin(t); r[1] = 0; }
int main(void)
{
  gark_real y[2] = {1.2, 0.4}, error[2], work[100];
  (void)error;
  for (int n = 0; n < 6; n++)
    if (gark_STEM_step(2, f, dfdy, dfdt, 0, n * (2.0 / 6), 2.0 / 6, y, ERROR work))
      return 1;
  printf("%.17g %.17g\\n", y[0], y[1]);
  return 0;
}
"""


@pytest.mark.skipif(CC is None, reason="there is no C compiler")
@pytest.mark.parametrize("name", ["ros3p", "timed"])
def test_the_step_of_c(tmp_path: Path, name: str) -> None:
    """The header compiles without a warning, and steps as the definition says."""
    method = payload(name)
    (tmp_path / "method.h").write_text(bridges()["c"].written(method), encoding="utf-8")
    error = "" if method.embedded is None else "error,"
    program = PROGRAM.replace("STEM", method.stem).replace("ERROR", error)
    (tmp_path / "program.c").write_text(program, encoding="utf-8")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1"]
    command = [str(CC), *flags, "program.c", "-o", "program", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    ran = subprocess.run(["./program"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert_near(ran.stdout.split(), printed_run(name))


@pytest.mark.parametrize("name", ["ros3p", "rodas3", "rodas4", "ros2-small"])
def test_the_step_of_kpp(name: str) -> None:
    """The numbers step in KPP's way as the definition says; f is not evaluated twice."""
    text = bridges()["kpp"].written(payload(name))
    assert_near(kpp_run(text), printed_run(name))
    expected = {"rodas3": ".TRUE. .FALSE. .TRUE. .TRUE.", "ros3p": ".TRUE. .TRUE. .FALSE."}
    if name in expected:
        assert [*of_kpp(text)["NewF"].values()] == expected[name].split()


@pytest.mark.parametrize("name", ["rodas3", "rodas4"])
def test_the_tableau_of_ordinarydiffeq(name: str) -> None:
    """A, C, b and btilde are those of programs, and H gives the dense output at several θ."""
    method = payload(name)
    text = bridges()["ordinarydiffeq"].written(method)
    found = {
        key: [[Fraction(x.replace("//", "/")) for x in line.split()] for line in rows.split(";")]
        for key, rows in re.findall(r"^    (A|C|H) = T\[(.*?)\]", text, re.MULTILINE | re.DOTALL)
    }
    program = program_stages(method)
    for key, rows in {"A": program.stored.A, "C": program.stored.C}.items():
        assert found[key] == [[Fraction(int(x.p), int(x.q)) for x in row] for row in rows]
    if method.dense is None:
        assert "zeros(T, 0, 4)" in text
        return
    m = [Fraction(int(x.p), int(x.q)) for x in program.stored.m]
    assert program.stored.further.dense is not None
    for theta in (Fraction(1, 3), Fraction(4, 5)):
        place = fmpq(theta.numerator, theta.denominator)
        wanted = program.stored.further.dense.at(place)[0]
        for i, x in enumerate(wanted):
            inner = sum(row[i] * theta**k for k, row in enumerate(found["H"]))
            assert theta * (m[i] + (1 - theta) * inner) == Fraction(int(x.p), int(x.q))


def test_petsc_has_the_printed_arrays() -> None:
    """A, Gamma, b and bembed row by row; dense output with θ to the power of the column."""
    method = payload("lassp-34")
    text = bridges()["petsc"].written(method)
    assert 'TSRosWRegister("gark-' in text
    assert ", 2, 4, A, Gamma, b, bembed, 3, binterp)" in text
    row = method.rosenbrock
    assert row is not None
    assert method.dense is not None
    wanted = {"A": row.alpha[0][0], "Gamma": row.gamma[0][0], "binterp": method.dense[0]}
    for name, rows in wanted.items():
        (inside,) = re.findall(rf"{name}\[\d+\] = {{(.*?)}}", text, re.DOTALL)
        terms = re.sub(r"PetscRealConstant\(|\)|\s", "", inside).strip(",").split(",")
        found = [mpf(p) / mpf(q or 1) for p, _, q in (x.partition("/") for x in terms)]
        assert found == [number(x) for cells in rows for x in cells]


@pytest.mark.parametrize(
    ("name", "target", "why"),
    [
        ("lassp-34", "kpp", "a diagonal entry of gamma is 0"),
        ("rodas5", "kpp", "hold 6 stages"),
        ("timed", "kpp", "several γ_ii"),
        ("timed", "ordinarydiffeq", "several γ_ii"),
        ("ros3p", "scipy", "scipy has no Rosenbrock methods"),
        ("ros3p", "fortran", "fortran has no Rosenbrock methods"),
    ],
)
def test_targets_refuse_what_they_cannot_hold(name: str, target: str, why: str) -> None:
    """With the reason."""
    with pytest.raises(CannotExport, match=why):
        bridges()[target].written(payload(name))


def test_nodes_that_petsc_cannot_hold_are_named() -> None:
    """It sums the rows."""
    assert "Left out: c and d" in bridges()["petsc"].written(payload("timed"))
    assert "Left out" not in bridges()["petsc"].written(payload("ros2"))


def test_command() -> None:
    """JSON has exact texts; more digits than a file has are refused."""
    found = gark("export", "ros3p", "--to", "json").out
    assert '"1/2 + sqrt(3)/6"' in found
    assert '"w_order": 1' in found
    assert "does not recover more" in " ".join(
        gark("export", "rodas4", "--to", "c", "--digits", "40").err.split()
    )
    assert "0.78867513459481288225457439025098" in (
        gark("export", "ros3p", "--to", "c", "--digits", "32").out
    )
