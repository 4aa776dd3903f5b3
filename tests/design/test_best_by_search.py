"""``gark design --search --minimise``: objectives in floats against the exact ones, and optima that
are known.
"""

from __future__ import annotations

import json
import re
import sys
from math import acos, cos, degrees, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import fmpq

from garkcli import find_parameters, load, loads, loads_family, minimise, search_methods
from garkcli.design.design import stable_sets
from garkcli.design.member import further_member, member
from garkcli.design.minimise.measures import MEASURES
from garkcli.design.minimise.objective import (
    LevelObjective,
    Objective,
    ObjectiveSubject,
    SearchMeasure,
    WeightedSum,
)
from garkcli.design.minimise.sector import rest_of_cosine
from garkcli.design.minimise.sums import objective_of
from garkcli.design.search.goals import objective_on
from garkcli.design.search.optimum import Optimisation, Optimum
from garkcli.design.search.search import Search
from garkcli.design.search.tasks import HIGHEST, Least, Missing
from garkcli.design.stable_set import stable_set
from garkcli.errors import MethodError, MethodFileError, UsageProblem
from garkcli.exact.display import to_ball
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.order.constants import error_constants
from garkcli.problems.draw import Draw
from garkcli.report.search import _shown
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.sector import largest_sector
from garkcli.tableau.embedded import with_weights
from garkcli.tell.dialect import Plain
from tests.cli.harness import gark
from tests.whole import in_whole

EXPLICIT3 = "unknown: {stages: 3, shape: explicit}\ndesign: {order: 2}"
SSP33 = "unknown: {stages: 3, shape: explicit}\ndesign: {order: 3}"
SSP43 = "unknown: {stages: 4, shape: explicit}\ndesign: {order: 3}"
IMEX = "unknown: {stages: 3, shape: imex}\ndesign: {order: 2}"
SPLITTING = "unknown: {stages: 3, shape: splitting}\ndesign: {order: 2}"
SDIRK = "unknown: {stages: 3, shape: [sdirk, stiffly-accurate]}\ndesign: {order: 2}"
ROSENBROCK = "unknown: {stages: 3, shape: rosenbrock}\ndesign: {order: 2}"


def program(text: str, objective: str) -> tuple[Search, Optimisation]:
    """The search of a family, and its minimisation."""
    family = loads_family(text)
    assert family.order is not None
    search = Search(family, family.order, objective=objective)
    return search, search.program


def points(search: Search, count: int, seed: int = 1) -> list[list[fmpq]]:
    """Methods at rational values of the unknowns; they need no order."""
    draw = Draw(seed)
    names = search.family.ring.names
    return [[fmpq(draw.word() % 61 + 5, 60) for _ in names] for _ in range(count)]


def floats(point: list[fmpq]) -> Any:
    return np.array([int(x.p) / int(x.q) for x in point])


PAIR = """
unknown: {stages: 4, shape: explicit, embedded: true}
design: {order: 3, embedded-order: 2}
"""
IMPLICIT_PAIR = """
unknown: {stages: 3, shape: sdirk, embedded: true}
design: {order: 2, embedded-order: 1}
"""
IMEX_PAIR = """
unknown: {stages: 3, shape: imex, embedded: true}
design: {order: 2, embedded-order: 1}
"""


@pytest.mark.parametrize("text", [PAIR, IMPLICIT_PAIR, IMEX_PAIR])
@pytest.mark.parametrize("measure", MEASURES, ids=lambda x: x.key)
def test_measures_in_floats_are_the_exact_ones(text: str, measure: SearchMeasure) -> None:
    """In floats by trees, exactly by spans and conditions; gradients by differences."""
    if measure.key.endswith("infinity") and text != IMPLICIT_PAIR:
        with pytest.raises(UsageProblem, match="R\\(∞\\) is"):
            program(text, measure.key)
        return
    search, made = program(text, measure.key)
    ring, family = search.family.ring, search.family
    for point in points(search, 2):
        values = dict(zip(ring.names, point, strict=True))
        further = further_member(family.further, ring, values)
        tableau = member(search.tableau, ring, values)
        exact = measure.squared(ObjectiveSubject.of(family, tableau, search.order, further))
        x = floats(point)
        assert made.total.value(x) ** 2 == pytest.approx(int(exact.p) / int(exact.q), rel=1e-9)
        task = Least(made.total, x)
        z = np.append(x, task.guess(x))
        look = task.at(z)
        assert look.value == pytest.approx(made.total.value(x))
        if measure.key == "nonzero":
            continue
        assert_gradient(lambda z, task=task: task.at(z).value, z, look.gradient)
        for k in range(len(look.signs)):
            assert_gradient(lambda z, task=task, k=k: task.at(z).signs[k], z, look.of_signs[k])


@pytest.mark.parametrize("key", ["A", "embedded-A", "E"])
def test_constants_of_a_published_pair(key: str) -> None:
    """Of Bogacki and Shampine's pair they are norms that ``gark check`` and ``gark list`` tell."""
    family = loads_family(
        "unknown: {stages: 4, shape: [explicit, stiffly-accurate], embedded: true}\n"
        "design: {order: 3, embedded-order: 2, fix: {c2: 1/2, c3: 3/4, bh1: 7/24, bh4: 1/8}}"
    )
    [method] = search_methods(family, 3, 3, objective=key).methods
    told = json.loads(gark("check", "bogacki-shampine-3", "-v", "--format", "json").out)
    constants = error_constants(load("bogacki-shampine-3").tableau, 4)
    assert constants is not None
    own = constants.all.two
    estimate = told["files"][0]["error_estimate"]["leading_term"]["all"]["two_norm"]
    wanted = {"A": own, "embedded-A": estimate, "E": own / estimate}[key]
    assert float(method.objective or "") == pytest.approx(wanted, rel=1e-10)


@pytest.mark.parametrize("text", [EXPLICIT3, IMEX, SPLITTING, SDIRK, ROSENBROCK])
@pytest.mark.parametrize("objective", ["error", "error-coupling", "coefficients"])
def test_smooth_objectives_are_the_exact_ones(text: str, objective: str) -> None:
    """Sums over trees in floats are the exact ones without a list of trees; so are gradients, by
    differences.
    """
    if objective == "error-coupling" and text not in (IMEX, SPLITTING):
        with pytest.raises(UsageProblem, match="one colour"):
            program(text, objective)
        return
    if objective == "coefficients" and text == ROSENBROCK:
        return
    search, made = program(text, objective)
    exact = objective_on(objective, search.tableau)
    [(_, goal)] = made.total.smooth
    assert isinstance(exact, Objective)
    for point in points(search, 3):
        values = dict(zip(search.family.ring.names, point, strict=True))
        tableau = member(search.tableau, search.family.ring, values)
        quotient = exact.formula(ObjectiveSubject(tableau, search.order), None)
        wanted = quotient.numerator / quotient.denominator
        value, gradient = goal.at(floats(point))
        assert value == pytest.approx(int(wanted.p) / int(wanted.q), rel=1e-10)
        assert_gradient(lambda x, goal=goal: goal.at(x)[0], floats(point), gradient)


def assert_gradient(function: Any, x: Any, gradient: Any) -> None:
    """Derivatives are those of central differences."""
    for k in range(len(x)):
        step = np.zeros(len(x))
        step[k] = 1e-6
        slope = (function(x + step) - function(x - step)) / 2e-6
        # weights near 0 magnify rounding
        assert gradient[k] == pytest.approx(slope, rel=1e-4, abs=2e-3)


RK4 = """
parameters: {t: {free: true}}
A: [[0, 0, 0, 0], [t, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]
b: [1/6, 1/3, 1/3, 1/6]
design: {order: 4}
"""
VERLET = """
parameters: {t: free}
prk: {q: {A: [[0, 0], [t, 1/2]], b: [1/2, 1/2]}, p: {A: [[1/2, 0], [1/2, 0]], b: [1/2, 1/2]}}
design: {order: 2}
"""


@pytest.mark.parametrize(
    ("text", "objective"),
    [
        (RK4, "-real-interval"),
        (RK4, "-imaginary-interval"),
        (VERLET, "-oscillator-interval"),
        (SSP33, "-ssp"),
        (SDIRK, "-sector"),
    ],
)
def test_levels_hold_up_to_the_exact_one(text: str, objective: str) -> None:
    """The inequalities in floats hold a little below the level that is decided exactly, and fail a
    little above; their derivatives are those of differences.
    """
    search, made = program(text, objective)
    exact = objective_on(objective, search.tableau)
    [(_, goal)] = made.total.levels
    assert isinstance(exact, LevelObjective)
    names = search.family.ring.names
    point = {"-ssp": SSP33_POINT, "-sector": SDIRK_POINT}.get(objective, [fmpq(1, 2)])
    values = dict(zip(names, point, strict=True))
    found = exact.measured(exact.value(member(search.tableau, search.family.ring, values)))
    assert found is not None
    level = float(found)
    x = floats(point)
    below, slopes = goal.at(np.append(x, 0.99 * level))
    above, _ = goal.at(np.append(x, 1.02 * level))
    assert min(below) >= -1e-12
    assert min(above) < 0
    for k in range(len(below)):
        assert_gradient(lambda z, k=k: goal.at(z)[0][k], np.append(x, 0.99 * level), slopes[k])


SSP33_POINT = [fmpq(1), fmpq(1, 2), fmpq(1, 4), fmpq(1, 6), fmpq(1, 6), fmpq(2, 3)]
"""c2, c3, a32 and the weights of Shu and Osher's method."""
SDIRK_POINT = [fmpq(1, 6), fmpq(1, 2), fmpq(1, 2), fmpq(1, 3)]
"""γ, c2 and weights of a method of order 1, whose angle is 83.4 degrees."""


def test_conditions_at_one_point_are_those_at_many() -> None:
    """Products of matrices and sums entry by entry agree, also beside polynomial stages."""
    families = [EXPLICIT3, IMEX, SPLITTING, ROSENBROCK, POLYNOMIAL]
    for text in families:
        search = Search(loads_family(text), 3)
        for point in points(search, 2):
            values, slopes = search.conditions.at(floats(point)[:, None])
            alone, slopes_alone = search.conditions.at_one(floats(point))
            assert np.allclose(values[:, 0], alone, atol=1e-13)
            assert np.allclose(slopes[:, :, 0], slopes_alone, atol=1e-12)


POLYNOMIAL = """
parameters: {t: free}
methods: [gauss-2, gauss-3]
transfer: {interpolation: t, conjugate-collocation: 1 - t}
"""


def best(text: str, objective: str, starts: int = 12, most: int = 1) -> Any:
    """The result of a search for the best method of the order that the file wants."""
    family = loads_family(text)
    assert family.order is not None
    return search_methods(family, family.order, starts, most=most, objective=objective)


def test_an_ssp_method_of_print_comes_out_exactly() -> None:
    """Kraaijevanger's method of four stages and order 3 has the radius 2; with order 4 there is
    none of four stages.
    """
    [method] = best(SSP43, "-ssp").methods
    assert (method.proof, method.order, method.objective) == ("exact", 3, "2")
    assert method.values["c2"] == "1/2"
    assert method.values["b4"] == "1/2"


def test_the_least_error_is_that_of_the_exact_minimum() -> None:
    """Ralston's method among two stages of order 2, decided exactly and found."""
    text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]\n"
    family = loads_family(text + "design: {order: 2}")
    exact = minimise(family, "error")
    [method] = search_methods(family, 2, 10, objective="error").methods
    assert method.values == {"t": "2/3"}
    assert exact.value is not None
    assert float(method.objective or "") == pytest.approx(float(exact.value.ball(64)))


def test_signs_and_ranges_are_constraints() -> None:
    """The best method with a node in a range ends at the range's end; weights stay positive."""
    text = (
        "unknown: {stages: 2, shape: explicit}\n"
        "design: {order: 2, range: {c2: [3/4, 1]}, positive-weights: true}"
    )
    [method] = best(text, "error").methods
    assert method.values["c2"] == "3/4"


def test_stability_is_a_constraint() -> None:
    """The least error of two L-stable stages of order 2 is that of the smaller γ."""
    text = (
        "unknown: {stages: 2, shape: [sdirk, stiffly-accurate]}\ndesign: {order: 2, l-stable: true}"
    )
    [method] = best(text, "error").methods
    assert method.values["gamma"] == "1 - sqrt(2)/2"


def real_root(*coefficients: float) -> float:
    """The one real root of a polynomial, its highest coefficient first."""
    [root] = [x.real for x in np.roots(coefficients) if abs(x.imag) < 1e-9]
    return float(root)


def longest_real_interval() -> float:
    """That of R = 1 − x + x²/2 − x³/6 + κ x⁴: R + 1 has a double zero, and R = 1 at the end."""
    double = real_root(1, -6, 18, -48)
    kappa = (1 - double + double**2 / 2) / (4 * double**3)
    return real_root(kappa, -1 / 6, 1 / 2, -1)


@pytest.mark.parametrize(
    ("objective", "greatest"),
    [("-real-interval", longest_real_interval()), ("-imaginary-interval", 8**0.5)],
)
def test_intervals_on_which_a_value_touches_one(objective: str, greatest: float) -> None:
    """With R = 1 + z + z²/2 + z³/6 + κ z⁴ the real interval is longest where |R| = 1 within it, and
    the imaginary one where |R|² loses its term y⁴: short numbers keep both sides.
    """
    [method] = best(SSP43, objective, 3).methods
    assert method.proof == "exact"
    assert greatest - 1e-5 < float(method.objective) <= greatest


@in_whole
def test_an_interval_on_the_imaginary_axis() -> None:
    """Five stages of order 4 in two registers: more than the 3.34 of Carpenter and Kennedy's method
    (NASA TM 109112, 1994); no such method has more than 2√3, where |R|² loses its term y⁶.
    """
    text = "unknown: {stages: 5, shape: low-storage}\ndesign: {order: 4}"
    [method] = best(text, "-imaginary-interval", 20).methods
    assert method.proof == "exists"
    assert 3.34 < float(method.objective) < 2 * 3**0.5 + 1e-4


def test_methods_are_told_the_best_first() -> None:
    """Several optima are in the order of the objective, each once."""
    found = best("unknown: {stages: 2, shape: dirk}\ndesign: {order: 3}", "coefficients", 20, 3)
    numbers = [float(method.objective) for method in found.methods]
    assert numbers == sorted(numbers)
    assert len({tuple(x.values.items()) for x in found.methods}) == len(found.methods)


def test_without_scipy_the_cure_is_a_line_to_type(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """SciPy is an extra."""
    monkeypatch.setitem(sys.modules, "scipy.optimize", None)
    file = tmp_path / "ssp.yaml"
    file.write_text(SSP43, encoding="utf-8")
    result = gark("design", str(file), "--search", "3", "--minimise=-ssp")
    assert result.code == 2
    assert 'pip install "garkcli[design]"' in result.err


def test_the_command_writes_the_best_ones(tmp_path: Path) -> None:
    """--output-dir goes with a search; files say what was minimised and its value."""
    file = tmp_path / "ssp.yaml"
    file.write_text(SSP43, encoding="utf-8")
    result = gark(
        "design", str(file), "--search", "6", "--minimise=-ssp", "--output-dir", str(tmp_path)
    )
    assert result.code == 0, result.err
    assert "greatest ssp found 2, the best of 6 starts" in " ".join(result.out.split())
    [made] = tmp_path.glob("ssp-1.gark.yaml")
    text = made.read_text(encoding="utf-8")
    assert "--minimise -ssp" in text
    assert gark("check", str(made)).code == 0


def test_objectives_without_meaning_are_refused() -> None:
    """A linear problem that stages do not see has no interval."""
    family: FamilyFile = loads_family(SPLITTING)
    with pytest.raises(UsageProblem, match="linear test equation"):
        search_methods(family, 2, 3, objective="-real-interval")
    with pytest.raises(UsageProblem, match="no objective"):
        search_methods(family, 2, 3, objective="speed")


def test_sums_are_their_terms() -> None:
    """The objective of the method is the sum of its terms, one by one; levels count negative."""
    text = "unknown: {stages: 3, shape: explicit}\ndesign: {order: 2}"
    [both] = best(text, "error + largest/100 - ssp/50", 6).methods
    family = loads_family(text)
    exact = {name: fmpq(*map(int, value.split("/"))) for name, value in both.values.items()}
    tableau = member(family.tableau, family.ring, exact)
    total = 0.0
    for name, weight in {"error": 1, "largest": 0.01, "-ssp": -0.02}.items():
        one = objective_of(name)
        if isinstance(one, Objective):
            quotient = one.formula(ObjectiveSubject(tableau, 2), None)
            total += weight * float(quotient.numerator / quotient.denominator)
        elif isinstance(one, SearchMeasure):
            total += weight * float(one.squared(ObjectiveSubject(tableau, 2))) ** 0.5
        elif isinstance(one, LevelObjective):
            total += weight * float(one.value(tableau).ball(64))  # type: ignore[union-attr]
    assert float(both.objective) == pytest.approx(total, rel=1e-10)


def test_sums_are_exact_where_their_terms_are() -> None:
    """Of two weights the minimum is between those of the terms, and attained."""
    family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]")
    exact = minimise(family, "100*error + coefficients")
    [method] = search_methods(family, 2, 6, objective="100*error + coefficients").methods
    assert exact.value is not None
    assert float(method.objective or "") == pytest.approx(float(exact.value.ball(64)))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("A*B", "a sum of names"),
        ("A/B", "a sum of names"),
        ("1 + A", "a number alone"),
        ("0*A", "a number alone"),
        ("A - A", "a number alone"),
        ("sqrt(A)", "a sum of names"),
        ("A +", "the text ends"),
        ("2*speed", "no objective 'speed'"),
        ("ssp", "a sum maximises ssp"),
        ("A - largest", "a sum minimises largest"),
        ("A - stability-interval", "the name of two intervals"),
        ("", "no number here"),
    ],
)
def test_sums_that_are_none_are_refused(text: str, says: str) -> None:
    """With words and a cure, before any work."""
    with pytest.raises(UsageProblem, match=says) as raised:
        objective_of(text)
    assert raised.value.help


def test_sums_are_read_as_people_write_them() -> None:
    """Hyphens within names are no signs; numbers may be on either side."""
    found = objective_of("error-coupling/2 + 3*(largest + 2*D) - 1/10*imaginary-interval")
    assert isinstance(found, WeightedSum)
    assert {x.key: str(w) for w, x in found.terms} == {
        "error-coupling": "1/2",
        "largest": "3",
        "D": "6",
        "-imaginary-interval": "-1/10",
    }


def test_a_search_alone_minimises_sizes(tmp_path: Path) -> None:
    """Without --search the command says so before any work."""
    file = tmp_path / "ssp.yaml"
    file.write_text(SSP43, encoding="utf-8")
    result = gark("design", str(file), "--minimise", "error + largest")
    assert result.code == 2
    assert "only a search minimises largest" in result.err
    assert "--search N\n" in result.err
    result = gark("design", str(file), "--minimise", "A")
    assert "--search N; error is its square" in result.err


def test_the_least_largest_coefficient() -> None:
    """Three stages of order 2 with entries up to m: 1/2 = Σ b c ≤ m m + m 2m."""
    text = "unknown: {stages: 3, shape: explicit}\ndesign: {order: 2}"
    [method] = best(text, "largest", 8).methods
    assert float(method.objective) == pytest.approx((1 / 6) ** 0.5, rel=2e-7)


def test_numbers_that_nobody_reads_are_shown_in_decimals() -> None:
    """Long fractions and radicals; a number beside a named root, and a short one, stay."""
    long = "100000000000000000000000001/300000000000000000000000000"
    root = f"1/2 + sqrt(2)*{long}"
    assert _shown(long, Plain()) == "0.333333333333333333333333…"
    assert _shown(root, Plain()).startswith("0.97140452079103168")
    assert _shown(f"r*{long}", Plain()) == f"r*{long}"
    assert _shown("1/3", Plain()) == "1/3"


def test_no_error_is_one_order_more() -> None:
    """Where the least error is none the method has exact numbers and the next order."""
    found = best("unknown: {stages: 4, shape: explicit}\ndesign: {order: 3}", "error", 8, 1)
    [method] = found.methods
    assert (method.proof, method.order, method.objective) == ("exact", 4, "0")


def test_no_error_is_zero_for_radicals_too() -> None:
    """Two stages of order 4 are those of Gauss."""
    [method] = best("unknown: {stages: 2, shape: full}\ndesign: {order: 3}", "error", 8, 1).methods
    assert (method.proof, method.order, method.objective) == ("exact", 4, "0")
    assert "sqrt(3)" in "".join(method.values.values())


def test_solutions_that_the_optimiser_leaves_are_counted() -> None:
    """SDIRK methods of two stages are L-stable for no γ in the range."""
    text = (
        "unknown: {stages: 2, shape: [sdirk, stiffly-accurate]}\n"
        "parameters: {gamma: {free: true, range: [1/50, 1/5]}}\n"
        "design: {order: 1, a-stable: true}"
    )
    found = best(text, "error", 3)
    assert not found.methods
    assert found.degenerate == found.successes > 0


def test_intervals_of_radicals_are_exact() -> None:
    """Rounded numbers miss the conditions of order 2, and then |R(iy)| > 1 for small y."""
    text = (
        'A: [[0, 0, 0], ["?", 0, 0], ["?", "?", 0]]\n'
        'b: ["?", "?", "?"]\n'
        "c: [0, sqrt(2)/2, 1]\n"
        "design: {order: 2, consistent: true}"
    )
    [method] = best(text, "-imaginary-interval", 3).methods
    assert "sqrt(2)" in method.values["b2"]
    assert float(method.objective or "") == pytest.approx(2, rel=1e-7)


def test_a_minimum_is_no_larger_than_its_start() -> None:
    """The optimiser may leave a better start; short numbers found before stay short."""
    [method] = best("unknown: {stages: 3, shape: imex}\ndesign: {order: 2}", "-ssp", 1).methods
    assert method.objective == "1.5"
    assert all(len(value) <= 5 for value in method.values.values())


def test_levels_have_a_highest() -> None:
    """The interval of an A-stable method is infinite; in floats all long ones are alike."""
    _, made = program(
        "parameters: {g: free}\nA: [[g]]\nb: [1]\ndesign: {order: 1}", "-real-interval"
    )
    for g in (1.0, 3.0):
        found = made.evaluated(np.array([g]))
        assert found is not None
        assert found.value == -HIGHEST


@in_whole
def test_processes_do_not_change_what_is_found(tmp_path: Path) -> None:
    """Two processes take larger batches; the methods, their starts and all counts are the same."""
    file = tmp_path / "dirk.yaml"
    file.write_text("unknown: {stages: 3, shape: dirk}\ndesign: {order: 3}\n", encoding="utf-8")
    asked = "--search", "150", "--minimise", "coefficients", "--most", "3", "--format", "json"
    one, two = (json.loads(gark("design", str(file), *asked, "-j", j).out) for j in ("1", "2"))
    for report in (one, two):
        del report["seconds"]
    assert one == two


@pytest.mark.parametrize(
    ("key", "bound"),
    [
        ("ssp", "3/2"),
        pytest.param("real-interval", "7/2", marks=in_whole),
        pytest.param("imaginary-interval", "12/5", marks=in_whole),
    ],
)
def test_levels_may_be_wanted(key: str, bound: str) -> None:
    """The best method has the level, exactly; the least error without it has not."""
    text = "unknown: {stages: 4, shape: explicit}\ndesign: {order: 3"
    level = objective_on(f"-{key}", loads_family(f"{text}}}").tableau)
    assert isinstance(level, LevelObjective)

    def size(wanted: str, objective: str) -> float:
        family = loads_family(f"{text}{wanted}}}")
        [method] = search_methods(family, 3, 8, objective=objective, most=1).methods
        found = search_files(method, family)
        value = level.shown(level.value(found.tableau))
        assert value is not None
        return float(value.ball(64))

    assert size(f", {key}: {bound}", "largest") >= float(fmpq(*map(int, bound.split("/"))))
    assert size("", "largest") < float(fmpq(*map(int, bound.split("/"))))


def search_files(method: Any, family: FamilyFile) -> Any:
    """The file of a method that a search has found."""
    return loads(with_values(family, method.values, "found", "order: 3"))


def test_levels_are_refused_without_a_search(tmp_path: Path) -> None:
    """With words and a cure, in the command and in Python."""
    text = SSP33.replace("order: 3", "order: 3, ssp: 1/2")
    file = tmp_path / "ssp.yaml"
    file.write_text(text, encoding="utf-8")
    result = gark("design", str(file))
    assert result.code == 2
    assert "ssp: 1/2 needs a search" in result.err
    for call in (find_parameters, lambda x: minimise(x, "error")):
        with pytest.raises(MethodError, match="needs a search"):
            call(loads_family(text))


def test_emitted_pairs_claim_their_embedded_order(tmp_path: Path) -> None:
    """By the certificate of the embedded weights; gark check confirms it."""
    file = tmp_path / "pair.yaml"
    file.write_text(PAIR, encoding="utf-8")
    made = tmp_path / "made.gark.yaml"
    result = gark("design", str(file), "--search", "4", "--emit", str(made))
    assert result.code == 0, result.err
    text = made.read_text(encoding="utf-8")
    assert re.search(r"order: 3, embedded-order: [23]", text)
    check = gark("check", str(made))
    assert check.code == 0
    assert re.search(r"claims hold +order: 3, embedded-order: [23]", check.out)


ALEXANDER = "unknown: {stages: 3, shape: [sdirk, stiffly-accurate]}\ndesign: {order: 3"
"""Order 3 leaves three numbers γ: A(75.58°)-stable with 0.159, L-stable with 0.436, and 2.4."""


@pytest.mark.parametrize(("bound", "gamma"), [("75", 0.158984), ("76", 0.435867), ("90", 0.435867)])
def test_a_sector_may_be_wanted(bound: str, gamma: float) -> None:
    """The least error has the γ that R = P/(1 − γz)³ leaves; R(∞) = 0 for each."""
    family = loads_family(f"{ALEXANDER}, sector: {bound}}}")
    [method] = search_methods(family, 3, 12, objective="A", most=1).methods
    assert method.proof == "exact"
    found = search_files(method, family)
    assert float(to_ball(found.tableau.blocks[0, 0][0][0], 20)) == pytest.approx(gamma, abs=1e-6)
    sector = largest_sector(stability_function(found.tableau))
    assert sector is not None
    assert sector.cosine is not None
    assert degrees(acos(float(sector.cosine))) >= float(bound)


@pytest.mark.parametrize("angle", [fmpq(90), fmpq(60), fmpq(45), fmpq(1, 2), fmpq(151, 2)])
def test_cosines_of_angles_are_algebraic(angle: fmpq) -> None:
    """By Chebyshev's polynomials, against the cosine of floats."""
    found = rest_of_cosine(angle)
    assert float(found) == pytest.approx(1 - cos(radians(int(angle.p) / int(angle.q))), rel=1e-12)
    exact = {fmpq(90): fmpq(1), fmpq(60): fmpq(1, 2)}.get(angle)
    assert found.exact == exact


@pytest.mark.parametrize("angle", ["91", "0", "1/7"])
def test_angles_that_are_none_are_refused(angle: str) -> None:
    with pytest.raises(MethodFileError, match="is no angle"):
        loads_family(f"{ALEXANDER}, sector: {angle}}}")


@pytest.mark.parametrize(("stages", "least"), [(3, 4), pytest.param(4, 7, marks=in_whole)])
def test_coefficients_that_are_not_zero_are_counted(stages: int, least: int) -> None:
    """Three stages of order 3 need b3 a32 a21 = 1/6 and another weight; Kutta's method of order 4
    has four weights and one entry a row.
    """
    text = f"unknown: {{stages: {stages}, shape: explicit}}\ndesign: {{order: {stages}}}"
    [method] = best(text, "nonzero", 20).methods
    assert method.objective == str(least)
    tableau = search_files(method, loads_family(text)).tableau
    entries = [x for row in tableau.blocks[0, 0] for x in row] + list(tableau.colours[0].b)
    assert sum(map(bool, entries)) == least


EMBEDDED = """
parameters: {g: free}
A: [[0, 0], [1/2, 1/2]]
b: [1/2, 1/2]
embedded: [1 - g, g]
design: {order: 2, a-stable: true, embedded-KIND-stable: true}
"""
"""R̂ = 1 + z + …/(1 − z/2) grows like (g − 1/2) z²/(1 − z/2)."""


@pytest.mark.parametrize(("kind", "values"), [("a", ["1/2"]), ("l", [])])
def test_stability_with_the_embedded_weights(kind: str, values: list[str]) -> None:
    """Its set is that of the method with them in place of b."""
    design = find_parameters(loads_family(EMBEDDED.replace("KIND", kind)))
    [_, found] = stable_sets(design)
    assert found.is_embedded
    assert [str(x.start.exact) for x in found.found if x.start is not None] == values
    alone = EMBEDDED.replace("b: [1/2, 1/2]\nembedded:", "b:").split("design")[0]
    same = stable_set(loads_family(alone), "a-stable" if kind == "a" else "l-stable")
    assert same.found == found.found


def test_a_search_wants_stability_with_the_embedded_weights() -> None:
    """The best pair has it; the best without it has not."""
    text = "unknown: {stages: 3, shape: [sdirk, stiffly-accurate], embedded: true}\ndesign: "
    wanted = "{order: 3, l-stable: true, embedded-order: 2, embedded-a-stable: true}"
    for plain, is_stable in (
        (wanted, True),
        (wanted.replace(", embedded-a-stable: true", ""), None),
    ):
        family = loads_family(text + plain)
        [method] = search_methods(family, 3, 10, objective="embedded-A", most=1).methods
        found = search_files(method, family)
        swapped = with_weights(found.tableau, found.embedded)
        if is_stable:
            assert is_a_stable(stability_function(swapped))
            assert not is_l_stable(stability_function(swapped))


def test_stability_with_embedded_weights_needs_such() -> None:
    with pytest.raises(MethodFileError, match="needs embedded weights, and is for all colours"):
        loads_family("unknown: {stages: 2, shape: sdirk}\ndesign: {embedded-a-stable: true}")


def test_the_distance_from_wants_is_its_own_variable() -> None:
    """The first phase minimises y where all inequalities hold up to y."""
    search, made = program("unknown: {stages: 3, shape: explicit}\ndesign: {order: 2, ssp: 1}", "A")
    task = Missing(made.total)
    x = floats(points(search, 1)[0])
    assert task.at(np.append(x, 0.25)).value == 0.25
    assert task.at(np.append(x, 0.5)).gradient[-1] == 1.0


def test_less_by_a_share() -> None:
    """0.9 is less than 1 by more than 5 %, 0.96 is not; of levels, which have a minus, too."""
    one, level = Optimum(1.0, ()), Optimum(-1.0, ())
    assert Optimum(0.9, ()).is_less(one, 0.05)
    assert not Optimum(0.96, ()).is_less(one, 0.05)
    assert Optimum(0.96, ()).is_less(one)
    assert not one.is_less(one)
    assert Optimum(-1.1, ()).is_less(level, 0.05)
    assert not Optimum(-1.04, ()).is_less(level, 0.05)
