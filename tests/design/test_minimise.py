"""``gark design --minimise``: the best methods of a family, exactly."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Callable
from fractions import Fraction
from itertools import product
from math import cos, pi, sin
from pathlib import Path
from typing import cast

import numpy as np
import pytest
from flint import ctx, fmpq, fmpq_mpoly

from garkcli import find_order, load, loads
from garkcli.deadline import within
from garkcli.design.design import find_parameters
from garkcli.design.ideal import Ideal
from garkcli.design.member import Whose, member
from garkcli.design.minimise import smallest
from garkcli.design.minimise.climbing import climbed
from garkcli.design.minimise.minimise import minimise
from garkcli.design.minimise.objective import LevelObjective
from garkcli.design.minimise.objectives import OBJECTIVES
from garkcli.design.minimise.result import Candidate, Minimum
from garkcli.design.minimise.smallest import Smallest, critical_equations, is_of_one_dimension
from garkcli.design.minimise.squared_error import squared_coupling_error, squared_error
from garkcli.design.parts import Part
from garkcli.design.solutions import value_at
from garkcli.errors import NotDecided
from garkcli.exact.display import to_ball
from garkcli.exact.parametric import Mixed, Parameters, fraction
from garkcli.exact.polynomial_text import root_text
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.order.constants import error_constants
from garkcli.report.rendering import render
from garkcli.tableau.forms import pair
from garkcli.tableau.pointwise import numeric_entries
from tests.cli.harness import gark
from tests.whole import in_whole, sample

TAU = """parameters: {tau: free}
methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 3}
transfer: {interpolation: tau, collocation: 1 - tau}
"""
EXPLICIT2 = """parameters: {c: free}
A: [[0, 0], [c, 0]]
b: [1 - 1/(2*c), 1/(2*c)]
"""


def least(text: str, objective: str, order: int | None = None, whose: Whose = "method") -> Minimum:
    """The minimum over a family."""
    design = find_parameters(loads_family(text), order, whose)
    return minimise(design, OBJECTIVES[objective], 60)


def floats(minimum: Minimum, candidate: Candidate) -> dict[str, float]:
    """The parameters of one method."""
    found = candidate.found
    root = found.solution.real[candidate.index]
    return {
        name: float(value_at(found.solution.values[name], root).ball(80))
        for name in minimum.design.family.parameters
    }


def value(minimum: Minimum) -> str | None:
    """The least value in radicals."""
    assert minimum.value is not None
    return root_text(minimum.value)


@pytest.mark.parametrize(
    ("path", "is_pair", "most"),
    [
        ("methods/rk4.gark.yaml", False, 7),
        ("methods/collocation.gark.yaml", True, 4),
        ("methods/semi-separable.gark.yaml", False, 5),
        ("methods/prk-lobatto-iiia-iiib.gark.yaml", False, 5),
    ],
)
def test_squared_errors_without_trees(path: str, is_pair: bool, most: int) -> None:
    """Σ e(u)² is that of the list of all trees, exactly: of point and polynomial spaces, of blocks
    that are missing and of the symplectic pair. From order 7 on there are trees with a symmetry that
    a root has twice.
    """
    tableau = load(path).tableau
    if is_pair:
        tableau = pair(tableau)
    for order in range(1, most + 1):
        listed = error_constants(tableau, order)
        assert listed is not None
        everything = squared_error(tableau, order, None)
        coupling = squared_coupling_error(tableau, order, None)
        assert everything.numerator / everything.denominator == listed.all.two_squared
        assert coupling.numerator / coupling.denominator == listed.coupling.two_squared


@pytest.mark.parametrize(
    ("path", "is_pair", "order"),
    [
        ("rk4", False, 4),
        ("sdirk-23", False, 3),  # it has sqrt(3)
        pytest.param("methods/collocation.gark.yaml", True, 4, marks=in_whole),
    ],
)
def test_a_method_without_unknowns(path: str, is_pair: bool, order: int) -> None:
    """The value of its objective, which is that of the list of all trees; the condition that fails
    at the next order.
    """
    options = [*["--pair"] * is_pair, "--minimise", "error"]
    told = gark("design", path, *options, "--format", "json")
    assert told.code == 0
    report = json.loads(told.out)
    tableau = load(path).tableau
    tableau = pair(tableau) if is_pair else tableau
    listed = error_constants(tableau, order + 1)
    assert listed is not None
    [method] = report["objective"]["minimisers"]
    assert (report["order"], report["verdict"], method["order"]) == (order + 1, "none", order)
    decimal = float(report["objective"]["value"])
    assert decimal == pytest.approx(float(to_ball(listed.all.two_squared, 80)))
    text = gark("design", path, *options).out
    assert text.startswith(f"{path}: order {order} of the {'pair' if is_pair else 'method'}; error")
    assert f"order {order + 1}  no: the condition of" in text
    assert gark("design", path, *options, "--order", str(order + 1)).code == 1


def test_a_method_that_is_not_stable() -> None:
    """What is wanted besides the order is decided of a method without unknowns too."""
    wanted = ("--minimise", "error", "--order", "3", "--a-stable")
    explicit = gark("design", "rk4", *wanted)
    assert (explicit.code, "does not meet the other requirements" in explicit.out) == (1, True)
    assert gark("design", "sdirk-23", *wanted).code == 0
    assert gark("design", "rk4", "--a-stable").code == 2  # without an objective there is no family


def test_two_explicit_stages() -> None:
    """A. Ralston (1962): c_2 = 2/3. The error is (c/2 − 1/3)²/4 + 1/36, and the gradient of it is
    a multiple of 3c − 2.
    """
    minimum = least(EXPLICIT2, "error")
    assert minimum.extent == "all"
    assert value(minimum) == "1/36"
    [candidate] = minimum.minimisers
    assert floats(minimum, candidate) == {"c": 2 / 3}
    assert minimum.gradient is not None
    assert minimum.gradient.monic()(fmpq(2, 3)) == 0


KUTTA = "unknown: {stages: 4, shape: explicit}\n"


def test_explicit_methods_of_four_stages() -> None:
    """W. Kutta (1901): order 4 is a family in c2 and c3 and three lines, c = (1/2, 1/2), (1/2, 0)
    and (1, 1/2). Members have order 4 by the certificate; one of the family is the 3/8 rule.
    """
    design = find_parameters(loads_family(KUTTA), 4)
    parts = design.parts(design.last)
    nodes = [(str(x.values["c2"]), str(x.values["c3"])) for x in parts]
    assert sorted(nodes) == [("1", "1/2"), ("1/2", "0"), ("1/2", "1/2"), ("c2", "c3")]
    assert all(x.is_free for x in parts)
    for part in parts:
        for k in range(2, 5):
            names = part.ring.names
            at = {name: fmpq(k + 3 * i, 7 + i) for i, name in enumerate(names)}
            values = {x: value_at_point(y, part.ring, at) for x, y in part.values.items()}
            tableau = member(design.tableau, design.family.ring, values)
            assert find_order(tableau).order == 4
    general = next(x for x in parts if x.dimension == 2)
    u, v = fmpq(2, 5), fmpq(3, 5)  # the formulas of Hairer, Nørsett, Wanner, section II.1
    b2 = (2 * v - 1) / (12 * u * (1 - u) * (v - u))
    assert value_at_point(general.values["b2"], general.ring, {"c2": u, "c3": v}) == b2
    third = {"c2": fmpq(1, 3), "c3": fmpq(2, 3)}
    known = load("kutta-38").tableau.block(0, 0)
    assert known is not None
    a32 = value_at_point(general.values["a32"], general.ring, third)
    a43 = value_at_point(general.values["a43"], general.ring, third)
    assert (a32, a43) == (known[2][1], known[3][2])


def value_at_point(x: object, ring: Parameters, at: dict[str, fmpq]) -> fmpq:
    """A function of coordinates at a rational point."""
    over, under = fraction(cast("Mixed", x), ring)
    point = [at[name] for name in ring.names]
    return over(*point) / under(*point)


@in_whole
def test_the_best_of_four_stages_with_a_node() -> None:
    """With c3 = 3/5 the least error of order 4, of all methods, against Kutta's formulas in floats:
    no c2 of a grid has less.
    """
    minimum = least(f"{KUTTA}design: {{fix: {{c3: 3/5}}}}\n", "error", 4)
    assert minimum.extent == "all"
    assert minimum.value is not None
    [candidate] = minimum.minimisers
    found = floats(minimum, candidate)
    at_best = float(minimum.value)
    assert kutta_error(fmpq(round(found["c2"] * 10**9), 10**9)) == pytest.approx(at_best, rel=1e-9)
    assert all(kutta_error(fmpq(k, 100)) > at_best for k in (5, 20, 30, 34, 37, 40, 70, 90, 130))


def kutta_error(u: fmpq) -> float:
    """Σ e(u)² of the method with c2 = u and c3 = 3/5, by the list of all trees."""
    v, one = fmpq(3, 5), fmpq(1)
    b2 = (2 * v - 1) / (12 * u * (1 - u) * (v - u))
    b3 = (1 - 2 * u) / (12 * v * (1 - v) * (v - u))
    b4 = (6 * u * v - 4 * u - 4 * v + 3) / (12 * (1 - u) * (1 - v))
    a32 = v * (v - u) / (2 * u * (1 - 2 * u))
    a43 = (b3 * (1 - v)) / b4
    a42 = (b2 * (1 - u) - b3 * a32) / b4
    rows = [[0, 0, 0, 0], [u, 0, 0, 0], [v - a32, a32, 0, 0], [1 - a42 - a43, a42, a43, 0]]
    text = [[str(x) for x in row] for row in rows]
    weights = [str(x) for x in (one - b2 - b3 - b4, b2, b3, b4)]
    constants = error_constants(loads(f"A: {text}\nb: {weights}\n").tableau, 5)
    assert constants is not None
    return float(fmpq(constants.all.two_squared))


def test_unknown_entries() -> None:
    """The same from three unknowns: b_1 and b_2 are functions of c_2."""
    minimum = least("unknown: {stages: 2, shape: explicit}\n", "error", 2)
    [candidate] = minimum.minimisers
    found = floats(minimum, candidate)
    assert found == pytest.approx({"c2": 2 / 3, "b1": 1 / 4, "b2": 3 / 4})


@pytest.mark.parametrize(
    ("whose", "objective"),
    [
        ("method", "error"),
        pytest.param("method", "error-coupling", marks=in_whole),
        pytest.param("pair", "error", marks=in_whole),
    ],
)
def test_free_transfer(whose: Whose, objective: str) -> None:
    """Where a τ is left: at rational τ beside the minimiser the list of all trees has larger
    errors, and nearly the least at one with ten digits.
    """
    minimum = least(TAU, objective, None, whose)
    [candidate] = minimum.minimisers
    assert minimum.extent == "all"
    assert minimum.value is not None
    tau = floats(minimum, candidate)["tau"]

    def error(shift: Fraction) -> float:
        t = Fraction(round(tau * 10**10), 10**10) + shift
        method = loads(TAU.replace("tau: free", f"tau: {t}"))
        made = method.tableau if whose == "method" else pair(method.tableau)
        listed = error_constants(made, minimum.step.order + 1)
        assert listed is not None
        norms = listed.all if objective == "error" else listed.coupling
        return norms.two**2

    here = error(Fraction(0))
    assert here == pytest.approx(float(minimum.value.ball(80)), rel=1e-9)
    assert here < error(Fraction(1, 100))
    assert here < error(Fraction(-1, 100))


def test_three_explicit_stages() -> None:
    """Two free nodes: the derivatives of the four error coefficients, written down by hand, are
    orthogonal to these there. That no method is less is proved up to rounding.
    """
    minimum = least("unknown: {stages: 3, shape: explicit}\n", "error", 3)
    assert minimum.extent == "nearly"
    [candidate] = minimum.minimisers
    found = floats(minimum, candidate)
    c2, c3 = found["c2"], found["c3"]
    e = [((c2 + c3) / 3 - c2 * c3 / 2 - 1 / 4) / 6, c3 / 6 - 1 / 8, (c2 / 6 - 1 / 12) / 2, -1 / 24]
    by_c2 = [(1 / 3 - c3 / 2) / 6, 0, 1 / 12, 0]
    by_c3 = [(1 / 3 - c2 / 2) / 6, 1 / 6, 0, 0]
    for slopes in (by_c2, by_c3):
        total = sum(x * y for x, y in zip(e, slopes, strict=True))
        assert abs(total) < 1e-15
    assert minimum.value is not None
    squared = sum(x * x for x in e)
    assert float(minimum.value.ball(80)) == pytest.approx(squared, rel=1e-12)


def test_finitely_many() -> None:
    """Of the two SDIRK methods of order 3 that with γ = 1/2 − √3/6 has the smaller coefficients."""
    minimum = least("unknown: {stages: 2, shape: sdirk}\n", "coefficients", 3)
    [candidate] = minimum.minimisers
    gamma = floats(minimum, candidate)["gamma"]
    assert gamma == pytest.approx(0.5 - 3**0.5 / 6)
    entries = [gamma, 1 - 2 * gamma, gamma, 1 / 2, 1 / 2]
    assert minimum.value is not None
    assert float(minimum.value.ball(80)) == pytest.approx(sum(x * x for x in entries))
    assert (minimum.extent, minimum.candidates) == ("all", 2)


def test_the_error_is_the_same_for_every_embedded_weight() -> None:
    """One of the SDIRK methods of order 3 with equal weights is found, whatever its free embedded
    weight: that with γ = 1/2 − √3/6, by the four trees of order 4.
    """
    entries = "A: [[g, 0], [h, g]]\nb: [1/2, 1/2]\nembedded: [t, 1 - t]\n"
    text = "parameters: {g: {free: true}, h: {free: true}, t: {free: true}}\n" + entries

    def error(sign: int) -> float:
        g, h = 0.5 + sign * 3**0.5 / 6, -sign / 3**0.5
        A, b = np.array([[g, 0], [h, g]]), np.array([0.5, 0.5])
        c = A @ np.ones(2)
        found = [
            (b @ c**3 - 1 / 4) / 6,
            b @ (c * (A @ c)) - 1 / 8,
            (b @ A @ c**2 - 1 / 12) / 2,
            b @ A @ A @ c - 1 / 24,
        ]
        return float(sum(x * x for x in found))

    minimum = least(text, "error", 3)
    [candidate] = minimum.minimisers
    assert floats(minimum, candidate)["g"] == pytest.approx(0.5 - 3**0.5 / 6)
    assert minimum.value is not None
    assert error(-1) < error(1)
    assert float(minimum.value.ball(80)) == pytest.approx(error(-1))


def test_zero_is_least() -> None:
    """Three midpoint rules: the error of order 3 is zero at the triple jump, b_1 = 1/(2 − ∛2)."""
    text = "unknown: {stages: 3, shape: [symplectic-dirk, palindromic]}\n"
    minimum = least(text, "error", 2)
    [candidate] = minimum.minimisers
    found = floats(minimum, candidate)
    assert found["b1"] == pytest.approx(1 / (2 - 2 ** (1 / 3)))
    assert value(minimum) == "0"
    assert candidate.found.order is not None
    assert candidate.found.order.order == 4


@pytest.mark.parametrize(
    ("allowed", "at", "least_value"),
    [
        ("{free: true, range: [1, 2]}", 1.0, "5/144"),
        ("{free: true, range: [1/4, 1/2]}", 0.5, "17/576"),
    ],
)
def test_ends_of_a_range(allowed: str, at: float, least_value: str) -> None:
    """Without a critical point within the range an end of it is least."""
    text = EXPLICIT2.replace("{c: free}", f"{{c: {allowed}}}")
    minimum = least(text, "error")
    [candidate] = minimum.minimisers
    assert floats(minimum, candidate) == {"c": at}
    assert value(minimum) == least_value


def test_no_minimum() -> None:
    """With c = 2/3 + 1/s² the least error of Ralston is not reached for any s."""
    text = """parameters: {s: free}
A: [[0, 0], [2/3 + 1/s**2, 0]]
b: [1 - 1/(2*(2/3 + 1/s**2)), 1/(2*(2/3 + 1/s**2))]
"""
    minimum = least(text, "error")
    assert value(minimum) == "1/36"
    assert minimum.minimisers == ()
    ends = [(x.toward.end, x.toward.is_right) for x in minimum.limits]
    assert ends == [(None, False), (None, True)]


def test_coefficients_at_irrational_nodes() -> None:
    """Σ a² + Σ b² of families by name is that of the entries at their nodes, in floats."""
    minimum = least(TAU, "coefficients")
    [candidate] = minimum.minimisers
    tau = floats(minimum, candidate)["tau"]
    t = Fraction(tau).limit_denominator(10**12)
    method = loads(TAU.replace("tau: free", f"tau: {t}"))
    entries = numeric_entries(method.tableau, 25)
    rows = list(entries.b)
    for blocks in entries.A:
        for block in blocks:
            rows += block or ()
    total = sum(float(to_ball(x, 25)) ** 2 for row in rows for x in row)
    assert minimum.value is not None
    assert float(minimum.value.ball(80)) == pytest.approx(total)


@pytest.mark.parametrize(
    ("wishes", "command"),
    [
        ("", "--set a2=2/3 --order 2 --minimise error"),
        ("design: {order: 2}", "--set a2=2/3 --minimise error"),
        ("", "--set a2=2/3 --set 'b1=1 - 3/4' --order 2"),
        ("design: {order: 2}", "--set a2=2/3 --set b1=1/4"),
        ("", "--set a2=2/3 --conjugate --set b1=1/4 --order 1"),
    ],
)
def test_the_head_is_the_command(wishes: str, command: str, tmp_path: Path) -> None:
    """It has every option that was typed, and none else: typed again it gives the same file."""
    file = "parameters: {a2: free, b1: free, b2: free}\nA: [[0, 0], [a2, 0]]\nb: [b1, b2]\n"
    (tmp_path / "my family.yaml").write_text(f"{file}{wishes}\n", encoding="utf-8")
    line = f"gark design 'my family.yaml' {command}"
    texts = []
    for path in ("one.yaml", "two.yaml"):
        out = gark(*shlex.split(line)[1:], "--emit", path, cwd=tmp_path)
        assert out.code == 0, out.err
        texts.append((tmp_path / path).read_text())
        line = texts[-1].splitlines()[0].removeprefix("# found by ").partition(": ")[0]
    assert sorted(shlex.split(line)) == sorted(
        ["gark", "design", "my family.yaml", *shlex.split(command)]
    )
    assert texts[0] == texts[1]


@in_whole
def test_emitted_file(tmp_path: Path) -> None:
    """The minimiser as a root of its polynomial, proved again by ``gark check``; JSON has it with
    the gradient.
    """
    (tmp_path / "tau.yaml").write_text(TAU, encoding="utf-8")
    command = "design tau.yaml --minimise error --pair --format json"
    out = gark(*command.split(), "--emit", "best.yaml", cwd=tmp_path)
    objective = json.loads(out.out)["objective"]
    assert objective["among"] == "all"
    assert objective["gradient"] in objective["minimisers"][0]["values"]["tau"]["root_of"].replace(
        "x", "tau"
    )
    assert gark("check", "best.yaml", cwd=tmp_path).code == 0
    method = load(str(tmp_path / "best.yaml"))
    assert find_order(pair(method.tableau)).order == 4


RANGE3 = "[0, 0, 0], [2*a, 0, 0], [0, 1/2, 0]"


@pytest.mark.parametrize(
    ("text", "objective", "order", "known", "at"),
    [
        ("unknown: {stages: 2, shape: explicit}", "-ssp", 2, "1", {"c2": 1}),
        (
            "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]",
            "-ssp",
            2,
            "4",
            {"g": 1 / 4},
        ),
        (
            "unknown: {stages: 2, shape: sdirk}",
            "-ssp",
            3,
            "1 + sqrt(3)",
            {"gamma": 1 / 2 - 3**0.5 / 6},
        ),
        (
            "parameters: {a: free}\nA: [[0, 0], [a, 0]]\nb: [0, 1]",
            "-stability-interval",
            1,
            "8",
            {"a": 1 / 8},
        ),
        (
            f"parameters: {{a: free}}\nA: [{RANGE3}]\nb: [0, 0, 1]",
            "-imaginary-interval",
            2,
            "2",
            {"a": 1 / 4},
        ),
        (
            "unknown: {stages: 3, shape: splitting}\ndesign: {fix: {b3: 0, a3: a1, b2: b1}}",
            "-stability-interval",
            2,
            "4",
            {"a1": 1 / 4, "a2": 1 / 2},
        ),
    ],
)
def test_greatest_levels(
    text: str, objective: str, order: int, known: str, at: dict[str, float]
) -> None:
    """Optimal SSP methods (S. Gottlieb, C.-W. Shu, 1998; L. Ferracina, M. N. Spijker, 2008), the
    Chebyshev polynomial on the real axis, P. J. van der Houwen's 2 on the imaginary one, and two
    Verlet steps as the most stable symmetric splitting.
    """
    best = least(text, objective, order)
    assert best.extent == "all"
    assert value(best) == known
    [candidate] = best.minimisers
    found = floats(best, candidate)
    assert {name: found[name] for name in at} == pytest.approx(at)


def test_a_maximum_with_an_irrational_value() -> None:
    """R = 1 + z + z²/2 + a z³ is longest stable on the real axis for a = 1/16: the interval ends
    where R = −1, in floats by bisection.
    """
    text = f"parameters: {{a: free}}\nA: [{RANGE3}]\nb: [0, 0, 1]"
    best = least(text, "-real-interval", 2)
    [candidate] = best.minimisers
    assert floats(best, candidate) == {"a": 1 / 16}
    low, high = 6.0, 7.0
    for _ in range(60):
        x = (low + high) / 2
        is_stable = 1 - x + x**2 / 2 - x**3 / 16 >= -1
        low, high = (x, high) if is_stable else (low, x)
    assert best.value is not None
    assert float(best.value.ball(80)) == pytest.approx(low)


def test_infinite_levels() -> None:
    """The θ-method is A-stable for θ ≥ 1/2: one of them stands for all."""
    text = "parameters: {t: free}\nA: [[0, 0], [1 - t, t]]\nb: [1 - t, t]\n"
    best = least(text, "-real-interval", 1)
    assert best.is_infinite
    assert best.extent == "all"
    [candidate] = best.minimisers
    assert candidate.is_constant
    assert floats(best, candidate)["t"] > 0.5


def test_no_maximum() -> None:
    """With a = 1/8 + 1/s² the Chebyshev polynomial is approached as s grows."""
    text = "parameters: {s: free}\nA: [[0, 0], [1/8 + 1/s**2, 0]]\nb: [0, 1]"
    best = least(text, "-real-interval", 1)
    assert value(best) == "8"
    assert best.minimisers == ()
    ends = [(x.toward.end, x.toward.is_right) for x in best.limits]
    assert ends == [(None, False), (None, True)]
    # the same for s > 1, where all weights are positive
    text = """parameters: {s: free}
A: [[0, 0, 0], ["1/4 + 2/s**2", 0, 0], [0, 0, 0]]
b: ["1/(2*s)", 1/2, "1/2 - 1/(2*s)"]
design: {positive-weights: true}
"""
    best = least(text, "-real-interval", 1)
    assert (value(best), best.minimisers) == ("8", ())
    assert [(x.toward.end, x.toward.is_right) for x in best.limits] == [(None, True)]


FOLD = """unknown: {stages: 2, shape: splitting}
design: {fix: {a1: 2, a2: -1}}
"""


def test_a_jump_at_an_end() -> None:
    """The step is bounded up to near hω = 4 as b_1 grows above 1/2 + 3√2/8, where it has a double
    eigenvalue and jumps down: no maximum. The same by traces of the step in floats.
    """
    best = least(FOLD, "-oscillator-interval", 1)
    assert (best.extent, value(best)) == ("all", "4")
    assert best.minimisers == ()
    edge = 1 / 2 + 3 * 2**0.5 / 8
    ends = [x.toward.end for x in best.limits]
    assert [float(x.ball(80)) for x in ends if x is not None] == [
        pytest.approx(1 - edge),
        pytest.approx(edge),
    ]

    def bounded_up_to(b1: float) -> float:
        z, trace = 0.0, 2.0
        while abs(trace) <= 2:
            z += 1e-3
            x, b2 = z * z, 1 - b1
            # drifts of 2 and −1, kicks of b_1 and b_2
            first = ((1.0, 2.0), (-b1 * x, 1 - 2 * b1 * x))
            second = ((1.0, -1.0), (-b2 * x, 1 + b2 * x))
            rows, columns = first, list(zip(*second, strict=True))
            trace = sum(rows[k][0] * columns[k][0] + rows[k][1] * columns[k][1] for k in range(2))
        return z

    assert bounded_up_to(edge - 1e-5) < 3
    assert bounded_up_to(edge + 1e-5) == pytest.approx(4, abs=2e-2)


SEVENTH = """parameters: {t: {free: true, range: [-3, 1/4]}}
A: [[0, 0], ["1/4 + (2*t**7+2*t+1)**2/(100*t)", 0]]
b: [1/2, 1/2]
"""


@pytest.mark.parametrize(("allowed", "is_reached"), [("[-3, 1/4]", True), ("[1/10, 3]", False)])
def test_critical_numbers_of_a_large_degree(allowed: str, is_reached: bool) -> None:
    """At the root of 2t⁷ + 2t + 1 it is R = 1 + z + z²/8 with the interval 8, which no other t has:
    in one range that is the greatest, in the other one a smaller value is, and both are of all.
    """
    best = least(SEVENTH.replace("[-3, 1/4]", allowed), "-real-interval", 1)
    method = "A: [[0, 0], [1/4, 0]]\nb: [1/2, 1/2]\n"
    there = OBJECTIVES["-real-interval"]
    assert isinstance(there, LevelObjective)
    eight = RealRoot.rational(fmpq(8))
    assert there.value(loads(method).tableau) == eight
    assert best.extent == "all"
    assert best.value is not None
    assert (best.value == eight) is is_reached
    [candidate] = best.minimisers
    assert not candidate.is_constant
    if is_reached:
        assert candidate.found.solution.degree == 7
    else:
        assert best.value < eight


@pytest.mark.parametrize(("objective", "direction"), [("-real", -1), ("-imaginary", 1j)])
def test_signs_of_intervals_are_those_of_steps(objective: str, direction: complex) -> None:
    """For an implicit family and many y: 1 − |R| by a step in floats has the sign of the polynomial
    that decides the interval; of the imaginary one in y².
    """
    text = "parameters: {g: free}\nA: [[g, 0], [1/3, 2*g - 1]]\nb: [1/4, 3/4]\n"
    family = loads_family(text)
    level = OBJECTIVES[f"{objective}-interval"]
    assert isinstance(level, LevelObjective)
    (sign,) = level.signs(family.tableau, family.ring).polynomials
    for g in (fmpq(1, 5), fmpq(2, 3), fmpq(-1, 2), fmpq(3)):
        A = np.array([[float(g), 0], [1 / 3, 2 * float(g) - 1]])
        for k in range(1, 30):
            y = fmpq(k, 3) + fmpq(1, 97)
            z = direction * (float(y) if objective == "-real" else float(y) ** 0.5)
            R = 1 + z * np.array([0.25, 0.75]) @ np.linalg.solve(np.eye(2) - z * A, np.ones(2))
            if abs(abs(R) - 1) > 1e-9:
                assert (sign(y, g) > 0) == (abs(R) < 1), (g, y)


FOUR = "parameters: {a: free}\nA: [[0, 0, 0, 0], [1/4, 0, 0, 0], [0, a, 0, 0], [0, 0, 1/2, 0]]\nb: [0, 0, 0, 1]\n"
ONE_LINE = {
    # these have a critical value of a degree above 6 at the greatest
    "three stages": "A: [[0, 0, 0], [a, 0, 0], [a, a**2, 0]]\nb: [0, 1 - a, a]\n",
    "five stages": (
        "A: [[0, 0, 0, 0, 0], [1/5, 0, 0, 0, 0], [0, a, 0, 0, 0], [0, 0, a + 1/6, 0, 0],"
        " [0, 0, 0, 1/2, 0]]\nb: [0, 0, 0, 0, 1]\n"
    ),
    "four stages": FOUR.split("\n", 1)[1],
    "implicit": "A: [[a, 0, 0], [1/2 - a, a, 0], [1 - 2*a, 0, a]]\nb: [1/4, 1/2, 1/4]\n",
    "a denominator": "A: [[0, 0], [1/(1 + a**2), 0]]\nb: [1 - a, a]\n",
}


@pytest.mark.parametrize(
    ("objective", "name"),
    sample([*product(["-imaginary-interval", "-real-interval", "-ssp"], ONE_LINE)], 4),
)
def test_no_rational_parameter_is_better(name: str, objective: str) -> None:
    """The greatest value of one parameter is that of all methods: by the ordinary engine none of
    41 methods with rational parameters has more, and near the best one some have nearly as much.
    """
    text = "parameters: {a: free}\n" + ONE_LINE[name]
    best = least(text, objective, 1)
    assert best.extent == "all"
    level = OBJECTIVES[objective]
    assert isinstance(level, LevelObjective)
    family = loads_family(text)

    def at(a: fmpq) -> float:
        found = level.shown(level.value(member(family.tableau, family.ring, {"a": a})))
        return float("inf") if found is None else float(found)

    greatest = float("inf") if best.is_infinite else float(best.value)  # type: ignore[arg-type]
    scan = max(at(fmpq(k, 40)) for k in range(-60, 61, 3))
    assert scan <= greatest * (1 + 1e-12)
    for candidate in best.minimisers:
        a = floats(best, candidate)["a"]
        near = [at(fmpq(round(a * 10**8) + k, 10**8)) for k in (-1, 0, 1)]
        assert max(near) == pytest.approx(greatest, rel=1e-3, abs=1e-3)


@in_whole
def test_a_level_of_a_large_degree() -> None:
    """The greatest of five stages on the imaginary axis is exact, as a root of its polynomial; the
    value of the method with 30 digits of the parameter agrees.
    """
    text = "parameters: {a: free}\n" + ONE_LINE["five stages"]
    best = least(text, "-imaginary-interval", 1)
    [candidate] = best.minimisers
    assert candidate.found.solution.degree > 6
    assert best.value is not None
    with ctx.workprec(200):
        [values] = [candidate.found.solution.real_values[candidate.index]]
        a = values["a"].ball(150)
    mantissa, exponent = a.mid().man_exp()
    exact = fmpq(mantissa) * fmpq(2) ** int(exponent)
    family = loads_family(text)
    level = OBJECTIVES["-imaginary-interval"]
    assert isinstance(level, LevelObjective)
    sides = []
    for shift in (fmpq(-1, 10**12), fmpq(1, 10**12)):
        found = level.shown(level.value(member(family.tableau, family.ring, {"a": exact + shift})))
        assert found is not None
        sides.append(float(found))
    assert max(sides) == pytest.approx(float(best.value), rel=1e-6)


@in_whole
def test_by_trial() -> None:
    """Two free nodes: the optimal SSP method of three stages and order 3 is found, with no claim
    that it is the best.
    """
    best = least("unknown: {stages: 3, shape: explicit}", "-ssp", 3)
    assert best.extent == "found"
    [candidate] = best.minimisers
    found = floats(best, candidate)
    assert (found["c2"], found["c3"]) == (1, 0.5)
    assert value(best) == "1"
    assert candidate.proof == "numerical"
    assert "greatest ssp found 1: the best of what was found" in render(best)


@pytest.mark.parametrize(
    ("degree", "says"),
    [
        (5, "greatest ssp 0"),
        (9, "order 1 for 1 of 9 solutions; ssp of the methods of order 1: not decided"),
    ],
)
def test_methods_of_large_fields_have_no_level(degree: int, says: str) -> None:
    """The one real method has g⁵ = g + 1, or g⁹ = g + 1: of the second no level is decided, and
    its order is proved.
    """
    family = f"""
parameters: {{g: free}}
A: [[], [1/2], [-g, 1 + g]]
b: ["1/6 + g**{degree} - g - 1", 1/3, 1/2]
"""
    best = least(family, "-ssp", 1)
    assert says in " ".join(render(best).split())


@in_whole
def test_beside_a_critical_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """The smallest coefficients of three stages and order 3, without a Gröbner basis: the
    gradient by finite differences of the exact sums of squares vanishes at c_2 and c_3, up to
    the second differences, and no method is less.
    """
    monkeypatch.setattr(smallest, "MOST_COORDINATES", 1)
    text = "unknown: {stages: 3, shape: explicit}"
    minimum = least(text, "coefficients", 3)
    [candidate] = minimum.minimisers
    assert (candidate.proof, minimum.extent) == ("exists", "nearly")
    solution = candidate.found.solution
    c2, c3 = (Fraction(str(solution.values[x])) for x in ("c2", "c3"))

    def size(c2: Fraction, c3: Fraction) -> Fraction:
        b2 = (Fraction(1, 3) - c3 / 2) / (c2 * (c2 - c3))
        b3 = (Fraction(1, 3) - c2 / 2) / (c3 * (c3 - c2))
        a32 = 1 / (6 * b3 * c2)
        entries = (c2, c3 - a32, a32, 1 - b2 - b3, b2, b3)
        return sum((x * x for x in entries), Fraction(0))

    h = Fraction(1, 10**6)
    here = size(c2, c3)
    for right, left in ((size(c2 + h, c3), size(c2 - h, c3)), (size(c2, c3 + h), size(c2, c3 - h))):
        assert abs(right - left) / (2 * h) < h
        assert right + left > 2 * here
    assert minimum.value is not None
    assert minimum.value.exact == fmpq(here.numerator, here.denominator)


def test_symmetric_splitting() -> None:
    """R. I. McLachlan (1995): the smallest error of five maps and order 2 is at
    1/2 − ∛(2√326 + 36)/12 + 1/(6∛(2√326 + 36)) = 0.1931833275037836.
    """
    text = """unknown: {stages: 3, shape: splitting}
design: {order: 2, fix: {b3: 0, a3: a1, b2: b1}}
"""
    minimum = least(text, "error")
    [candidate] = minimum.minimisers
    root = (2 * 326**0.5 + 36) ** (1 / 3)
    known = 1 / 2 - root / 12 + 1 / (6 * root)
    assert floats(minimum, candidate)["a1"] == pytest.approx(known, abs=1e-15)
    assert known == pytest.approx(0.1931833275037836, abs=1e-15)


@in_whole
def test_entries_without_nodes() -> None:
    """The same methods with unknown entries: nodes are made coordinates, and the least value is the
    same number.
    """
    entries = """A: [[0, 0, 0], ["?", 0, 0], ["?", "?", 0]]
b: ["?", "?", "?"]
"""
    minimum = least(entries, "error", 3)
    other = least("unknown: {stages: 3, shape: explicit}\n", "error", 3)
    assert minimum.value == other.value
    [candidate] = minimum.minimisers
    found = floats(minimum, candidate)
    [known] = other.minimisers
    assert found["a21"] == pytest.approx(floats(other, known)["c2"])


def test_methods_of_higher_order_among_them() -> None:
    """Three stages, order 2: the error is zero at the methods of order 3, a set of dimension 2 of
    which some are shown.
    """
    text = "unknown: {stages: 3, shape: explicit}\n"
    minimum = least(text, "error", 2)
    assert value(minimum) == "0"
    assert minimum.extent == "all"
    for candidate in minimum.minimisers:
        assert candidate.found.order is not None
        assert candidate.found.order.order == 3


def of_squares(head: str, weights: str, *terms: str) -> str:
    """Methods whose sum of errors of order 2 is that of four squares."""
    p, q, r, s = (f'[["{x} + 1/2"]]' for x in terms)
    return f"{head}\ntableau:\n  A: [[{p}, {q}], [{r}, {s}]]\n  b: {weights}\n"


SQUARE_ROOT = of_squares(
    "parameters: {g: {free: true, range: [0, 2]}, h: free, k: free}",
    '[["g^2 - 1"], [1]]',
    *("g*h - 1", "h + k", "k^2*g - 2", "h"),
)
TWO_ROOTS = of_squares(
    "parameters: {g: free, w: {free: true, range: [0, 3]}, h: free, k: free}",
    '[["g^3 - 1"], ["w^2 + g^2*w"]]',
    *("g*h - w", "h + k", "k^2*w - 2", "h"),
)
FREE = of_squares(
    "parameters: {h: free, k: free, l: free}",
    "[[1], [1]]",
    *("h*k - 1", "k + l", "l^2*h - 2", "h - l"),
)
RANGED = of_squares(
    "parameters: {h: {free: true, range: [0, 1/2]}, k: free, l: free}",
    "[[1], [1]]",
    *("h*k - 1", "k + l", "l*h - 2", "h^3 - l"),
)
SADDLE = of_squares(
    "parameters: {h: free, k: free, l: free}", "[[1], [1]]", "h*k*l - 1", "k*h^2", "l", "h - k"
)

ESCAPING = of_squares(
    "parameters: {h: free, k: free, l: free}", "[[1], [1]]", "h*k*l - 1", "k", "k - l", "0"
)
ESCAPING_OVER = of_squares(
    "parameters: {g: {free: true, range: [0, 2]}, h: free, k: free}",
    '[["g^2 - 1"], [1]]',
    *("g*h*k - 1", "k", "0", "0"),
)


@pytest.mark.parametrize(
    ("text", "least_value", "extent"),
    [
        pytest.param(ESCAPING, 1, "critical-points", id="less at infinity"),
        pytest.param(ESCAPING_OVER, 1, "critical-points", id="less at infinity over a root"),
        pytest.param(SQUARE_ROOT, 0.6948288628709869, "nearly", id="over a square root"),
        pytest.param(
            SQUARE_ROOT.replace("[0, 2]", "[-2, 0]"),
            4.480508121877554,
            "nearly",
            id="over the other root",
        ),
        pytest.param(TWO_ROOTS, 2.0012082848057817, "nearly", id="over two roots"),
        pytest.param(FREE, 2.35071713134469, "nearly", id="three coordinates"),
        pytest.param(SADDLE, 0.917608420490083, "nearly", id="two minimisers"),
        pytest.param(RANGED, 285 / 64, "all", id="beside a range"),
    ],
)
def test_quadratic_coordinates(text: str, least_value: float, extent: str) -> None:
    """No method has less where all coordinates but two or an irrational one are in the sum with
    degree two; the values are those of SciPy's BFGS from 60 starts. Values that are approached at
    infinity leave it open.
    """
    minimum = least(text, "error", 1)
    assert float(minimum.value or 0) == pytest.approx(least_value, rel=1e-9)
    assert minimum.extent == extent


@pytest.mark.parametrize("product", ["(g - 1)*(h - 2)", "(h - 1)*(g - 2)"])
def test_a_later_part_may_be_better(product: str) -> None:
    """(k − g)² + (g h − 5)² + (k + 1)² is 2 where g = 1, and 49/9 where h = 2."""
    first, second = ("g", "h") if "(g - 1)" in product else ("h", "g")
    text = of_squares(
        "parameters: {g: free, h: free, k: free}",
        f'[["1 + {product}"], [1]]',
        *(f"k - {first}", f"{first}*{second} - 5", "k + 1", "0"),
    )
    minimum = least(text, "error", 1)
    assert value(minimum) == "2"
    assert minimum.extent == "all"


def test_zero_in_two_parts() -> None:
    """(k − 1)² + (g + h − 4)² is 0 once where g = 1, and once where h = 2: both are shown."""
    text = of_squares(
        "parameters: {g: free, h: free, k: free}",
        '[["1 + (g - 1)*(h - 2)"], [1]]',
        *("k - 1", "g + h - 4", "0", "0"),
    )
    minimum = least(text, "error", 1)
    found = [floats(minimum, x) for x in minimum.minimisers]
    assert sorted((x["g"], x["h"], x["k"]) for x in found) == [(1, 3, 1), (2, 2, 1)]
    assert (value(minimum), minimum.extent) == ("0", "all")


def test_emitted_claims(tmp_path: Path) -> None:
    """A level that files can claim is claimed, and ``gark check`` proves it."""
    (tmp_path / "sdirk.yaml").write_text("unknown: {stages: 2, shape: sdirk}\n")
    command = "design sdirk.yaml --order 3 --minimise -ssp --emit best.yaml"
    assert gark(*command.split(), cwd=tmp_path).code == 0
    text = (tmp_path / "best.yaml").read_text(encoding="utf-8")
    assert text.endswith("expect: {order: 3, ssp-coefficient: 1 + sqrt(3)}\n")
    assert gark("check", "best.yaml", cwd=tmp_path).code == 0


def test_what_is_refused(tmp_path: Path) -> None:
    """Objectives without a meaning for the method, and options that do not go together: exit code
    2; what is not decided: 3.
    """
    (tmp_path / "e.yaml").write_text(EXPLICIT2)
    text = "unknown: {stages: 4, shape: explicit}\n"
    (tmp_path / "many.yaml").write_text(text)
    asked = "design e.yaml --minimise"
    for options, said in (
        ("error-coupling", "has one colour"),
        ("error --output-dir .", "--output-dir writes several"),
        ("error --a-stable", "gives a set of values"),
        ("colour", "no objective 'colour'"),
    ):
        run = gark(*asked.split(), *options.split(), cwd=tmp_path)
        assert (run.code, said in run.err) == (2, True)
    many = "design many.yaml --order 2 --minimise -ssp"
    run = gark(*many.split(), cwd=tmp_path)
    assert (run.code, "not decided" in run.err) == (3, True)


def test_what_gets_better_for_ever() -> None:
    """A trial ends where each step is better than the one before it, after 64 moves of 1/8 from the
    best of the grid; a deadline that is over ends it at once, and says so.
    """
    end = climbed(lambda point: (point[0],), 1)
    assert end == (2 + fmpq(64, 8),)
    with within(0), pytest.raises(NotDecided):
        climbed(lambda point: (point[0],), 1)
    top = climbed(lambda point: (-((point[0] - fmpq(1, 7)) ** 2),), 1)
    assert top == (fmpq(1, 7),)


@pytest.mark.parametrize(
    ("head", "rest"), [("[1, 1]", ""), ("[1, 2]", "design: {nodes-in-unit-interval: true}\n")]
)
def test_a_range_of_one_number(head: str, rest: str) -> None:
    """Of order 1 with the second node 1 alone: its error is that of the list of all trees."""
    matrix = "A: [[0, 0], [g, 0]]\nb: [1, 0]\n"
    text = f"parameters: {{g: {{free: true, range: {head}}}}}\n{matrix}{rest}"
    minimum = least(text, "error", 1)
    [candidate] = minimum.minimisers
    assert floats(minimum, candidate) == {"g": 1.0}
    assert not candidate.is_constant
    listed = error_constants(loads(matrix.replace("g", "1")).tableau, 2)
    assert listed is not None
    assert minimum.value is not None
    assert minimum.value.exact == listed.all.two_squared


def test_a_critical_point_on_an_edge() -> None:
    """s⁴ + r² + (1 − r)² with s ≥ 0 is least at s = 0 and r = 1/2, which is critical and on the
    edge: one method.
    """
    text = """parameters: {s: {free: true, range: [0, 1]}, r: free}
A: [[0, 0], ["s**2", 0]]
b: [r, 1 - r]
"""
    minimum = least(text, "coefficients", 1)
    assert value(minimum) == "1/2"
    [candidate] = minimum.minimisers
    assert floats(minimum, candidate) == {"s": 0.0, "r": 0.5}
    # the other edge has s = 1 and r = 1/2, of value 3/2
    assert minimum.candidates == 2


def test_components_of_several_dimensions() -> None:
    """On the plane x = 0 and the line y = z = 0, taken as one part, (x − 1)² + (y − 1)² is critical
    on the line at (1, 0, 0), which the minors miss: they are not taken for all there are there, but
    on a sphere.
    """
    ring = Parameters(["x", "y", "z"])
    x, y, z = ring.context.gens()
    one = ring.constant(fmpq(1))
    N = (x - 1) ** 2 + (y - 1) ** 2

    def part_of(*zeros: fmpq_mpoly) -> Part:
        values = {name: ring.parameter(name) for name in ring.names}
        return Part(ring, values, (), Ideal(ring, ()).with_zeros(list(zeros)))

    both = part_of(x * y, x * z)
    missed = critical_equations(both, N, one)
    on_line = N.compose(x, y * 0, z * 0).derivative(0)
    point = (1, 0, 0)
    assert on_line(*point) == 0
    assert any(p(*point) != 0 for p in missed)
    assert not is_of_one_dimension(both)
    sphere = part_of(x**2 + y**2 + z**2 - 1)
    assert is_of_one_dimension(sphere)


TWO_PARTS = """
unknown: {stages: 3, shape: [esdirk, stiffly-accurate]}
design: {order: 2, stage-order: 2, range: {gamma: [1/2, 2]}}
"""


def test_a_part_that_is_not_decided_leaves_the_best_of_the_others(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without one part the least value is one that was found; without all it is not decided."""
    family = find_parameters(loads_family(TWO_PARTS))
    whole = minimise(family, "coefficients")
    assert whole.extent != "found"
    over = Smallest.over_whole
    missed: list[Part] = []

    def over_some(self: Smallest, part: Part) -> None:
        if part.dimension in skipped:
            missed.append(part)
            raise NotDecided
        over(self, part)

    monkeypatch.setattr(Smallest, "over_whole", over_some)
    skipped = {0}
    rest = minimise(family, "coefficients")
    assert missed
    assert (rest.extent, rest.value) == ("found", whole.value)
    skipped = {0, 1}
    with pytest.raises(NotDecided):
        minimise(family, "coefficients")


@in_whole
def test_the_best_of_two_parts(tmp_path: Path) -> None:
    """An implicit-explicit pair of stage order 2: c₂ = 0 is a part of its own, which is too curved;
    the best of the other one is that of the file with c₂ = 2γ.
    """
    text = """
unknown: {stages: 4, shape: [imex, stiffly-accurate]}
design: {order: 3, R-infinity: {2: 0}, stage-order: {2: 2}, range: {gamma: [2/5, 1/2]}%s}
"""
    (tmp_path / "two.yaml").write_text(text % "")
    (tmp_path / "one.yaml").write_text(text % ", fix: {c2: 2*gamma}")
    runs = [
        gark("design", f, "--minimise", "error", cwd=tmp_path) for f in ("two.yaml", "one.yaml")
    ]
    for run in runs:
        assert (run.code, "least error found 0.026730736" in run.out) == (0, True)


CIRCLE = """parameters: {{g: free, h: free}}
tableau:
  A:
    - [[["{}"]], [["{}"]]]
    - [[[0]], [[0]]]
  b: [["(g - 2)^2 + (h - 1)^2"], [1]]
"""


@pytest.mark.parametrize(
    ("first", "second", "further", "extent", "entries"),
    [
        ("g", "h", "", "all", lambda g, h: (g, h)),
        ("g - 1", "h^3 + g^2", "", "all", lambda g, h: (g - 1, h**3 + g * g)),
        ("g", "g*h", "", "all", lambda g, h: (g, g * h)),
        (
            "g",
            "h",
            "design: {positive-weights: true, order: 1}\n",
            "critical-points",
            lambda g, h: (g, h),
        ),
    ],
)
def test_a_sum_of_squares_over_a_closed_curve(
    first: str,
    second: str,
    further: str,
    extent: str,
    entries: Callable[[float, float], tuple[float, float]],
) -> None:
    """Order 1 asks for the circle of radius 1 about (2, 1), which bounds g and h. Where all limits are methods, the least critical point is the minimum; a grid of the circle
    has none less.
    """
    text = CIRCLE.format(first, second) + further
    found = minimise(find_parameters(loads_family(text), 1), "coefficients")
    assert found.extent == extent
    assert found.value is not None
    values = []
    for k in range(2000):
        g, h = 2 + cos(k * pi / 1000), 1 + sin(k * pi / 1000)
        values.append(sum(x * x for x in entries(g, h)) + 2)
    assert 0 <= min(values) - float(found.value) < 1e-3


def test_a_denominator_leaves_values_near_its_zeros_open() -> None:
    """Where methods are left out the set is not closed."""
    text = CIRCLE.format("g", "h").replace("[[[0]], [[0]]]", '[[["1/(g - 2)"]], [[0]]]')
    assert "1/(g - 2)" in text
    found = minimise(find_parameters(loads_family(text), 1), "coefficients")
    assert found.extent == "critical-points"


def test_a_curve_may_come_nearer_than_its_critical_points() -> None:
    """Order 1 asks for u²(1 + h²) = 3, where the error of order 2 is a multiple of u². It is critical
    at u² = 3 alone, and as small as one likes for large h.
    """
    text = """parameters: {u: free, h: free}
A: [["1/2 + u", 0], [0, 0]]
b: [1, "u^2*(1 + h^2) - 3"]
"""
    found = minimise(find_parameters(loads_family(text), 1), "error")
    assert (found.value, found.extent) == (RealRoot.rational(fmpq(3)), "critical-points")


def test_the_help_names_every_objective() -> None:
    """``gark design --help`` lists what --minimise takes."""
    text = gark("design", "--help").out.partition("--minimise WHAT")[2].partition("--choose")[0]
    words = set(re.findall(r"[\w-]+", re.sub(r"-\s+", "-", text)))
    assert set(OBJECTIVES) - words == set()


def test_a_bounded_set_has_a_least_value() -> None:
    """Order 1 is a circle: its equation bounds both unknowns, so that the smaller of two critical
    values of the error is the least of all methods, as points of the circle in floats say.
    """
    minimum = least(CIRCLE.format("g", "h"), "error", 1)
    assert (minimum.extent, root_text(minimum.value)) == ("all", "4 - sqrt(10)")
    errors = []
    for k in range(360):
        g, h = 2 + cos(k * pi / 180), 1 + sin(k * pi / 180)
        # trees of order 2: b1 (g, h) - 1/2 for both children of colour 1, -1/2 for those of colour 2
        errors.append((g - 0.5) ** 2 + (h - 0.5) ** 2 + 2 * 0.5**2)
    assert 0 <= min(errors) - float(minimum.value) < 1e-3


def test_the_best_method_is_as_stable_as_wanted(tmp_path: Path) -> None:
    """Though all methods of the family are not decided; alone it cannot be written, and the cure
    leads to the best one.
    """
    text = """
unknown: {stages: 4, shape: [esdirk, stiffly-accurate], embedded: true}
design: {order: 3, embedded-order: 2, stage-order: 2, l-stable: true}
"""
    (tmp_path / "esdirk.yaml").write_text(text, encoding="utf-8")
    given = ("design", "esdirk.yaml", "--set", "bh4=0", "--set", "bh3=1/2")
    told = " ".join(gark(*given, "--minimise", "error", cwd=tmp_path).out.split())
    assert "the best method is L-stable; not decided for all methods of the family" in told
    alone = gark(*given, "--emit", "x.yaml", cwd=tmp_path)
    assert (alone.code, "--minimise error" in alone.err) == (2, True)
    assert "the best method" not in alone.out
