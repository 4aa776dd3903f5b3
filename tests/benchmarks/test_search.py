"""Searches for methods: what a start costs, how many succeed, and whether exact methods come out."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np

from garkcli import find_order, load, loads_family
from garkcli.design.search.least_squares import MAX_STEPS
from garkcli.design.search.run import results
from garkcli.design.search.search import Search
from tests.benchmarks.measuring import GARK, assert_ratio, seconds


def explicit(stages: int) -> str:
    """All coefficients of explicit methods unknown."""
    rows = [["?"] * i + ["0"] * (stages - i) for i in range(stages)]
    lines = [", ".join(f'"{x}"' if x == "?" else x for x in row) for row in rows]
    matrix = "], [".join(lines)
    weights = ", ".join(['"?"'] * stages)
    return f"A: [[{matrix}]]\nb: [{weights}]\n"


def test_six_stages_of_order_five() -> None:
    """A start takes less than 20 ms of the processor, and 30 % of them at least succeed."""
    search = Search(loads_family(explicit(6)), 5)
    starts = list(search.starts(0, 1000))
    solved = len(search.solve(starts))
    spent = seconds(lambda: search.solve(starts), 2)
    assert_ratio("a start of 6 stages, order 5 / 20 ms", spent / 20, 1.0, f"{spent:.2f} ms")
    share = solved / 1000
    assert_ratio("30 % / starts that succeed", 0.3 / share, 1.0, f"{100 * share:.1f} %")


def test_against_one_start_at_a_time() -> None:
    """At least five times faster than scipy's least squares with the same conditions, gradients and
    most steps.
    """
    from scipy.optimize import least_squares

    search = Search(loads_family(explicit(6)), 5)
    starts = list(search.starts(0, 200))

    def residuals(x: np.ndarray) -> np.ndarray:
        return search.conditions.at(x[:, None])[0][:, 0]

    def jacobian(x: np.ndarray) -> np.ndarray:
        return search.conditions.at(x[:, None])[1][:, :, 0]

    def one_by_one() -> None:
        for start in starts[:5]:
            least_squares(residuals, np.array(start), jacobian, max_nfev=MAX_STEPS)

    ours = seconds(lambda: search.solve(starts), 2) / 200
    theirs = seconds(one_by_one, 1) / 5
    detail = f"{1000 * ours:.1f} ms, {1000 * theirs:.1f} ms"
    assert_ratio("a start / a start of scipy", ours / theirs, 1 / 5, detail)


def test_seven_stages_of_order_six(tmp_path: Path) -> None:
    """An exact method within five minutes of the processor, proved again by gark check."""
    (tmp_path / "seven.yaml").write_text(explicit(7), encoding="utf-8")
    found = tmp_path / "found.gark.yaml"
    command = [*GARK, "design", "seven.yaml", "--order", "6", "--search", "100"]
    command += ["--most", "1", "--emit", "found.gark.yaml"]

    def run() -> None:
        subprocess.run(command, cwd=tmp_path, check=True, stdout=subprocess.DEVNULL)

    spent = seconds(run, 1)
    assert find_order(load(str(found))).order >= 6
    subprocess.run([*GARK, "check", str(found)], check=True, stdout=subprocess.DEVNULL)
    assert_ratio("7 stages, order 6, exact / 300 s", spent / 300, 1.0, f"{spent:.1f} s")


def test_five_diagonally_implicit_stages() -> None:
    """More than 60 % of starts succeed for SDIRK methods of five stages and order 4."""
    rows = [
        ", ".join(f"a{i}{j}" if j < i else "g" if j == i else "0" for j in range(5))
        for i in range(5)
    ]
    names = ["g", *(f"a{i}{j}" for i in range(5) for j in range(i))]
    free = ", ".join(f"{name}: free" for name in names)
    weights = ", ".join(['"?"'] * 5)
    text = f"parameters: {{{free}}}\nA: [[{'], ['.join(rows)}]]\nb: [{weights}]\n"
    result = list(results(Search(loads_family(text), 4), 200, most=1))[-1]
    assert result.methods[0].proof == "exact"
    share = result.successes / 200
    assert_ratio("60 % / starts that succeed", 0.6 / share, 1.0, f"{100 * share:.1f} %")
