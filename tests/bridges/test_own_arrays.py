"""Nyström, nonlinearly partitioned and multiderivative methods in other codes: programs step as the
method does, JSON has all of it.
"""

from __future__ import annotations

import json
import runpy
import shutil
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from mpmath import cos, mpf, sin

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.orders import Orders
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.methodfile.load import load, loads
from tests.bridges.test_rosenbrock import number
from tests.cli.harness import gark

CC = shutil.which("cc") or shutil.which("gcc")
START, STEPS, END = (1.2, 0.4), 4, 1
JETS = """
name: jets
derivatives:
  A: [[[], [1/2]], [[], [1/9]], [[], [1/50]]]
  b: [[2/3, 1/3], [1/6, 0], [0, 1/40]]
  c: [1/9, 3/4]
  embedded: [[1, 0], [0, 1/2], [0, 0]]
"""
PAIRS = """
name: pairs
nprk:
  a: [[], [[0, 1/3], [1/7, 1/5]], [[0, 1/4, 1/8], [1/9], [1/6, 0, 1/11]]]
  b: [[0, 1/2, 0], [1/4, 0, 0], [0, 0, 1/4]]
  embedded: [[1], [0, 0, 1/10]]
"""
EXPLICIT_PAIRS = "name: ex\nnprk: {a: [[], [[1/2]], [[0, 1], [1/3]]], b: [[0, 1/2], [0, 0, 1/2]]}\n"
LATE_PAIRS = "nprk: {a: [[[0, 1/2]], [[1]]], b: [[1]]}"
TEXTS = {"jets": JETS, "pairs": PAIRS, "explicit pairs": EXPLICIT_PAIRS, "late pairs": LATE_PAIRS}
NAMES = ["fine-34", "dprkn-43", "tdrk-5", "jets", "imex-nprk-42b", "pairs", "explicit pairs"]
Vector = list[mpf]


def payload(name: str) -> Payload:
    """A method as writers see it; its orders are the matter of other tests."""
    with patch("garkcli.bridges.preparing.find_orders", lambda *_: Orders(2, embedded=1)):
        return prepared(loads(TEXTS[name]) if name in TEXTS else load(name))


def of_mpmath(array: Any) -> Any:
    """The entries of an array with the digits of mpmath."""
    return [*map(of_mpmath, array)] if isinstance(array, tuple) else number(array)


def combined(start: Sequence[mpf], *terms: tuple[mpf, Sequence[mpf]]) -> Vector:
    """Start + Σ weight · slope."""
    return [y + sum(w * slope[r] for w, slope in terms) for r, y in enumerate(start)]


def force(t: mpf, q: Sequence[mpf], v: Sequence[mpf] | None = None) -> Vector:
    """G(t, q, q′), or g(t, q)."""
    v = v or [mpf(0), mpf(0)]
    return [-sin(q[1]) * cos(t) - v[0] * v[1] / 3, q[0] * q[1] - v[1] / 5]


def along(k: int, t: mpf, y: Sequence[mpf]) -> Vector:
    """The k-th derivative of the solution of y1′ = y2 t, y2′ = −y1 y2."""
    a, b = y
    f = [b * t, -a * b]
    second = [f[1] * t + b, -f[0] * b - a * f[1]]
    third = [second[1] * t + 2 * f[1], -second[0] * b - 2 * f[0] * f[1] - a * second[1]]
    return [f, second, third][k - 1]


def pair(u: Sequence[mpf], v: Sequence[mpf]) -> Vector:
    """F(u, v)."""
    return [u[0] * v[1] - v[0], u[1] ** 2 / 4 - v[0] * v[1]]


def first(u: Sequence[mpf], v: Sequence[mpf]) -> list[Vector]:
    """∂F/∂u."""
    return [[v[1], mpf(0)], [mpf(0), u[1] / 2]]


def second(u: Sequence[mpf], v: Sequence[mpf]) -> list[Vector]:
    """∂F/∂v."""
    return [[mpf(-1), u[0]], [-v[1], -v[0]]]


def by_definition(kind: str, own: dict[str, Any], t: mpf, y: Sequence[mpf], h: mpf) -> Vector:
    """A step as papers define it, with the velocities behind the positions."""
    c, b = own["c"], own["b"]
    s = range(len(c))
    if kind == "nystrom":
        q, v, k = y[:2], y[2:], list[Vector]()
        for i in s:
            at = combined(q, (c[i] * h, v), *((h**2 * own["Abar"][i][j], k[j]) for j in range(i)))
            arguments = [at]
            if "A" in own:
                arguments.append(combined(v, *((h * own["A"][i][j], k[j]) for j in range(i))))
            k.append(force(t + c[i] * h, *arguments))
        ends = [(h**2 * x, slope) for x, slope in zip(own["bbar"], k, strict=True)]
        new = combined(q, (h, v), *ends)
        return [*new, *combined(v, *((h * x, k[i]) for i, x in enumerate(b)))]
    if kind == "derivatives":
        f: dict[tuple[int, int], Vector] = {}
        orders = range(len(b))
        for i in s:
            seen = [(h ** (k + 1) * own["A"][k][i][j], f[k, j]) for k in orders for j in range(i)]
            at = combined(y, *seen)
            f |= {(k, i): along(k + 1, t + c[i] * h, at) for k in orders}
        return combined(y, *((h ** (k + 1) * b[k][i], f[k, i]) for k in orders for i in s))
    stages = [list(y) for _ in s]
    for _ in range(60):  # fixed points, far within the step
        values = {(j, k): pair(stages[j], stages[k]) for j in s for k in s}
        stages = [
            combined(y, *((h * own["a"][i][j][k], x) for (j, k), x in values.items())) for i in s
        ]
    return combined(y, *((h * b[j][k], x) for (j, k), x in values.items()))


def expected(name: str, embedded: bool = False) -> Vector:
    """The value after all steps, or the estimate of the first."""
    method = payload(name)
    assert method.own is not None
    own = {key: of_mpmath(x) for key, x in method.own.items()}
    h, y = mpf(END) / STEPS, [mpf(x) for x in START]
    if method.kind == "nystrom":
        y += [mpf("0.3"), mpf("-0.2")]
    if embedded:
        other = {**own, "b": own["embedded"], "bbar": own.get("embedded_bbar")}
        pairs = [by_definition(method.kind, x, mpf(0), y, h) for x in (own, other)]
        return [a - b for a, b in zip(*pairs, strict=True)]
    for n in range(STEPS):
        y = by_definition(method.kind, own, n * h, y, h)
    return y


def assert_near(found: Sequence[Any], wanted: Sequence[mpf]) -> None:
    """Two values are equal but for the rounding of floats."""
    for x, y in zip(found, wanted, strict=True):
        assert abs(mpf(x) - y) < mpf("1e-13")


@pytest.mark.parametrize("name", NAMES)
def test_the_step_of_numpy(tmp_path: Path, name: str) -> None:
    """The module steps as the definition says, and estimates the difference of the results."""
    method = payload(name)
    path = tmp_path / "method.py"
    path.write_text(bridges()["numpy"].written(method), encoding="utf-8")
    step: Callable[..., Any] = runpy.run_path(str(path))["step"]
    assert method.own is not None
    has_estimate = "embedded" in method.own
    h, y = END / STEPS, np.array(START)
    v, estimate = np.array([0.3, -0.2]), None
    for n in range(STEPS):
        if method.kind == "nystrom":
            q, v, *errors = step(_in_floats(force), n * h, y, v, h)
            made, error = [*q, *v], [*map(float, np.ravel(errors))]
            y = q
        else:
            sides = [_in_floats(pair), _in_floats(first), _in_floats(second)]
            given = (_in_floats(along), n * h) if method.kind == "derivatives" else sides
            given = given[:1] if name == "explicit pairs" else given
            made = step(*given, y, h)
            y, error = made if has_estimate else (made, [])
            made = y
        estimate = error if estimate is None else estimate
    assert_near(made, expected(name))
    if has_estimate:
        assert estimate is not None
        assert_near(estimate, expected(name, embedded=True))


def _in_floats(side: Callable[..., Any]) -> Callable[..., Any]:
    def called(*given: Any) -> Any:
        numbers = [
            x if isinstance(x, int) else mpf(x) if np.ndim(x) == 0 else [*map(mpf, x)]
            for x in given
        ]
        return np.array(side(*numbers), dtype=float)

    return called


SIDES = {
    "nystrom": """
static void g(gark_real t, const gark_real *q, VELOCITY gark_real *r, void *data)
{ (void)data; r[0] = -sin(q[1]) * cos(t) - V0 * V1 / 3; r[1] = q[0] * q[1] - V1 / 5; }
#define STEP(n) gark_STEM_step(2, g, 0, (n) * 0.25, 0.25, y, y + 2, ERRORS work)
""",
    "derivatives": """
static void g(int k, gark_real t, const gark_real *y, gark_real *r, void *data)
{
  gark_real f[2] = {y[1] * t, -y[0] * y[1]};
  gark_real s[2] = {f[1] * t + y[1], -f[0] * y[1] - y[0] * f[1]};
  (void)data;
  r[0] = k == 1 ? f[0] : k == 2 ? s[0] : s[1] * t + 2 * f[1];
  r[1] = k == 1 ? f[1] : k == 2 ? s[1] : -s[0] * y[1] - 2 * f[0] * f[1] - y[0] * s[1];
}
#define STEP(n) gark_STEM_step(2, g, 0, (n) * 0.25, 0.25, y, ERRORS work)
""",
    "nprk": """
static void g(const gark_real *u, const gark_real *v, gark_real *r, void *data)
{ (void)data; r[0] = u[0] * v[1] - v[0]; r[1] = u[1] * u[1] / 4 - v[0] * v[1]; }
static void du(const gark_real *u, const gark_real *v, gark_real *r, void *data)
{ (void)data; r[0] = v[1]; r[1] = 0; r[2] = 0; r[3] = u[1] / 2; }
static void dv(const gark_real *u, const gark_real *v, gark_real *r, void *data)
{ (void)data; r[0] = -1; r[1] = u[0]; r[2] = -v[1]; r[3] = -v[0]; }
#define STEP(n) if (gark_STEM_step(2, g, du, dv, 0, 0.25, y, ERRORS work)) return 1
""",
}
PROGRAM = """
#include <math.h>
#include <stdio.h>
#include "method.h"
SIDES
int main(void)
{
  gark_real y[4] = {1.2, 0.4, 0.3, -0.2}, first[4] = {0}, error[4] = {0}, work[100];
  (void)error;
  for (int n = 0; n < 4; n++) {
    STEP(n);
    for (int r = 0; n == 0 && r < 4; r++)
      first[r] = error[r];
  }
  for (int r = 0; r < 4; r++)
    printf("%.17g %.17g ", y[r], first[r]);
  return 0;
}
"""


@pytest.mark.skipif(CC is None, reason="there is no C compiler")
@pytest.mark.parametrize("name", ["fine-34", "dprkn-43", "jets", "pairs"])
def test_the_step_of_c(tmp_path: Path, name: str) -> None:
    """The header compiles without a warning, steps as the definition says, and estimates."""
    method = payload(name)
    has_velocities = name == "fine-34"
    sides = SIDES[method.kind].replace("VELOCITY", "const gark_real *v," if has_velocities else "")
    for i in ("0", "1"):
        sides = sides.replace(f"V{i}", f"v[{i}]" if has_velocities else "0.0")
    errors = "error, error + 2," if method.kind == "nystrom" else "error,"
    program = PROGRAM.replace("SIDES", sides).replace("ERRORS", errors)
    (tmp_path / "method.h").write_text(bridges()["c"].written(method), encoding="utf-8")
    (tmp_path / "program.c").write_text(program.replace("STEM", method.stem), encoding="utf-8")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1"]
    command = [str(CC), *flags, "program.c", "-o", "program", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    ran = subprocess.run(["./program"], cwd=tmp_path, capture_output=True, text=True, check=True)
    printed = ran.stdout.split()
    wanted = expected(name)
    assert_near(printed[: 2 * len(wanted) : 2], wanted)
    assert_near(printed[1 : 2 * len(wanted) : 2], expected(name, embedded=True))


@pytest.mark.parametrize("name", NAMES)
def test_json_has_the_whole_method(name: str) -> None:
    """A method file with the arrays of the JSON is the same method."""
    method = payload(name)
    found = json.loads(bridges()["json"].written(method))
    form = {key: found[key] for key in ("Abar", "a", "A", "bbar", "b", "embedded") if key in found}
    if method.kind != "nprk":
        form["c"] = found["c"]
    if method.kind == "nystrom":
        form["embedded"] = {"bbar": found["embedded_bbar"], "b": found["embedded"]}
    again = loads(json.dumps({found["kind"]: form}))
    assert again.tableau == method.tableau
    assert again.embedded == (loads(TEXTS[name]) if name in TEXTS else load(name)).embedded


@pytest.mark.parametrize(
    ("name", "target", "why"),
    [
        ("fine-34", "scipy", "scipy has no Nyström methods"),
        ("tdrk-4", "petsc", "petsc has no multiderivative methods"),
        ("imex-nprk-21", "sundials-mri", "sundials-mri has no nonlinearly partitioned methods"),
        ("obreshkov-6", "numpy", "needs itself or a later one, and the step is explicit"),
        ("late pairs", "c", "needs a later one"),
    ],
)
def test_targets_refuse_what_they_cannot_hold(name: str, target: str, why: str) -> None:
    """With the reason, and the targets that hold the method."""
    with pytest.raises(CannotExport, match=why) as refusal:
        bridges()[target].written(payload(name))
    assert "json" in str(refusal.value.help)


def test_command() -> None:
    """The head has the orders, which are proved; no digits are made up."""
    found = gark("export", "dprkn-43", "--to", "json").out
    assert '"embedded_order": 3' in found
    assert (
        "order 5; every order condition decided exactly"
        in gark("export", "tdrk-5", "--to", "c").out
    )
