"""``gark design --search``: methods found from random starts, each with what is proved of it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import find_order, find_property, load, loads, loads_family, search_methods
from garkcli.crew.work import Alone, WorkerLost
from garkcli.design.design import find_parameters
from garkcli.design.search.least_squares import damped_step, least_squares
from garkcli.design.search.nearest import nearest_member
from garkcli.design.search.points import Fixings, is_proved, polished, rank
from garkcli.design.search.recognise import minimal_polynomial, rational, recognised
from garkcli.design.search.residuals import Generators, Residuals
from garkcli.design.search.run import FoundMethod, SearchResult, SolutionTask, decimals, results
from garkcli.design.search.search import BITS, Search
from garkcli.design.search.snap import values_near
from garkcli.errors import NotDecided
from garkcli.exact.field import Algebraic
from garkcli.frozen import replace
from garkcli.methodfile.family import FamilyFile
from garkcli.order.admissible import elementary_weight
from garkcli.report.schemas import report_schema
from garkcli.tableau.embedded import with_weights
from tests.cli.harness import gark
from tests.whole import at_most, in_whole

SDIRK2 = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
RATIONAL = "parameters: {t: free, u: free}\nA: [[1/(1 + t**2), u], [t*u, u/t]]\nb: [1/t, 1 - 1/t]\n"
RADICAL = "parameters: {t: free}\nA: [[t, 0], [sqrt(3)/3, t]]\nb: [1/2, 1/2]\n"
NINTH = "parameters: {t: free}\nA: [[t**9 + t/3]]\nb: [1]\n"
HALF = fmpq(1, 2)
UNBOUNDED = """unknown: {stages: 2, shape: sdirk}
design: {R-infinity: 0, fix: {gamma: 0}}
"""
TWICE = """parameters: {t: free}
prk:
  q: {A: [[t**9 + t/3]], b: [1]}
  p: {A: [["t*(t**9 + t/3 - 1/2) + 1/2"]], b: [1]}
"""
TAU = """parameters: {tau: free}
methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 4}
transfer: {interpolation: tau, collocation: 1 - tau}
"""
SPLITTING = """parameters: {a1: free, a2: free, a3: free, a4: free, b1: free, b2: free, b3: free, b4: free}
prk:
  q: {A: [[0, 0, 0, 0], [a1, 0, 0, 0], [a1, a2, 0, 0], [a1, a2, a3, 0]], b: [a1, a2, a3, a4]}
  p: {A: [[b1, 0, 0, 0], [b1, b2, 0, 0], [b1, b2, b3, 0], [b1, b2, b3, b4]], b: [b1, b2, b3, b4]}
structure: separable
"""


def explicit(stages: int) -> str:
    """All coefficients of explicit methods unknown."""
    numbers = range(1, stages + 1)
    names = [f"a{i}{j}" for i in numbers for j in range(1, i)]
    names += [f"b{i}" for i in numbers]
    rows = [[f"a{i}{j}" if j < i else "0" for j in numbers] for i in numbers]
    matrix = ", ".join(f"[{', '.join(row)}]" for row in rows)
    free = ", ".join(f"{name}: free" for name in names)
    weights = ", ".join(f"b{i}" for i in numbers)
    return f"parameters: {{{free}}}\nA: [{matrix}]\nb: [{weights}]\n"


def system_of(family: FamilyFile, order: int) -> Residuals:
    """The conditions of a family."""
    relations = [radical.relation for radical in family.radicals]
    return Residuals(family.tableau, family.ring, order, relations)


def finished(search: Search, starts: int, seed: int = 0, most: int = 5) -> SearchResult:
    """The result of a whole search."""
    return list(results(search, starts, seed, most))[-1]


@pytest.mark.parametrize(
    ("text", "values"),
    [
        (explicit(3), {name: f"{k}/7" for k, name in enumerate(["a21", "a31", "a32", "b1", "b2", "b3"])}),
        (RATIONAL, {"t": "3/2", "u": "-2/5"}),
        (TWICE, {"t": "1/3"}),
        (TAU, {"tau": "2/5"}),
        (SPLITTING, {f"{x}{k}": f"{k + 2}/9" for x in "ab" for k in range(1, 5)}),
    ],
    ids=["explicit", "rational", "two colours", "polynomial stages", "splitting"],
)  # fmt: skip
def test_residuals_are_those_of_the_conditions(text: str, values: dict[str, str]) -> None:
    """Over the tree table, in floats and in balls, what ``conditions`` computes tree by tree; and the
    gradients are the differences of residuals.
    """
    family = loads_family(text)
    system = system_of(family, 4)
    exact = [fmpq(*map(int, (values[x] + "/1").split("/")[:2])) for x in family.ring.names]
    point = np.array([[float(x.p) / float(x.q)] for x in exact])
    found, gradients = system.at(point)
    balls = np.empty((len(exact), 1), object)
    balls[:, 0] = [arb(x) for x in exact]
    enclosed, slopes = system.at(balls)
    tableau = loads(text, settings=values).tableau
    table = system.table
    for number in range(len(table)):
        order, gamma = int(table.order[number]), int(table.gamma[number])
        weight = elementary_weight(tableau, table.tree(number))
        wanted = (weight - fmpq(1, gamma)) * fmpq(gamma, order)
        assert isinstance(wanted, fmpq)
        with ctx.workprec(300):  # flint makes a ball of the number first
            assert enclosed[number, 0].contains(wanted)
        assert found[number, 0] == pytest.approx(float(wanted.p) / float(wanted.q), abs=1e-12)
    step = 1e-6
    for unknown in range(len(exact)):
        ahead, behind = point.copy(), point.copy()
        ahead[unknown] += step
        behind[unknown] -= step
        slope = (system.at(ahead)[0] - system.at(behind)[0]) / (2 * step)
        assert gradients[:, unknown] == pytest.approx(slope, abs=1e-6)
        middles = [float(x.mid()) for x in slopes[:, unknown, 0]]
        assert gradients[:, unknown, 0] == pytest.approx(middles, abs=1e-12)


def test_of_two_methods_near_a_solution_the_stable_one_is_taken() -> None:
    """With the nodes and weights of Radau IIA, order 3 is d = 3a − 1, and R has the leading
    coefficients 5/6 − 2a and 2a − 2/3: A-stable from a = 3/8 on. Near 0.36 the shortest a is 1/3,
    and the shortest d belongs to 2/5.
    """
    text = "parameters: {a: free, d: free}\nA: [[a, 1/3 - a], [1 - d, d]]\nb: [3/4, 1/4]\n"
    values = []
    for wanted in ("", "design: {a-stable: true}\n"):
        find = Search(loads_family(text + wanted), 3).find(1, [0.36, 0.08])
        assert find is not None
        assert find.found is not None
        assert find.is_stable
        values.append(find.found.solution.values)
    plain, stable = values
    assert plain == {"a": fmpq(1, 3), "d": 0}
    assert stable == {"a": fmpq(2, 5), "d": fmpq(1, 5)}
    for a, holds in ((plain, False), (stable, True)):
        settings = {name: str(value) for name, value in a.items()}
        assert find_property(loads(text, settings=settings).tableau, "a-stable").value is holds


@pytest.mark.parametrize(
    ("ends", "is_success"),
    [("0, 1/3", False), ("2/3, 1", False), ("0, 1/2", True), ("1/2, 1", True)],
)
def test_successes_are_within_their_range(ends: str, is_success: bool) -> None:
    """One stage of order 2 has the entry 1/2: no success where its range ends before, or begins
    behind; one at either end.
    """
    text = f"parameters: {{t: {{free: true, range: [{ends}]}}}}\nA: [[t]]\nb: [1]\n"
    search = Search(loads_family(text), 2)
    found = search.solve(list(search.starts(0, 4)))
    assert [k for k, _ in found] == (list(range(4)) if is_success else [])
    assert [point for _, [point] in found] == pytest.approx([0.5] * len(found))


def test_starts_spread_over_their_range() -> None:
    """Without one over [0, 1], every fourth over [-2, 2]."""
    text = "parameters: {t: {free: true, range: [3, 4]}, u: free}\nA: [[t]]\nb: [u]\n"
    starts = np.array(list(Search(loads_family(text), 2).starts(0, 40)))
    (t, u), wide = starts.transpose(), starts[3::4, 1]
    assert 3 <= min(t) < 3.1
    assert 3.9 < max(t) <= 4
    assert 0 <= min(np.delete(u, slice(3, None, 4))) < 0.1
    assert 0.9 < max(np.delete(u, slice(3, None, 4))) <= 1
    assert -2 <= min(wide) < -1
    assert 1 < max(wide) <= 2


def test_what_happens_to_a_start_does_not_depend_on_the_others() -> None:
    """To the last bit: one at a time, all at once, in another order."""
    search = Search(loads_family(explicit(4)), 4)
    columns = np.array(list(search.starts(5, 3))).transpose().copy()
    together = least_squares(search.conditions.at, columns)
    turned = least_squares(search.conditions.at, columns[:, ::-1].copy())
    assert np.array_equal(turned.points[:, ::-1], together.points)
    assert together.succeeded.any()
    for k in range(3):
        alone = least_squares(search.conditions.at, columns[:, k : k + 1].copy())
        assert np.array_equal(alone.points[:, 0], together.points[:, k])
        assert alone.succeeded[0] == together.succeeded[k]


def test_floats_are_the_same_everywhere() -> None:
    """Where two starts end, to the last bit, as recorded: whatever the processor and the library."""
    search = Search(loads_family(explicit(4)), 4)
    columns = np.array(list(search.starts(8, 2))).transpose().copy()
    minima = least_squares(search.conditions.at, columns)
    ends = [float(x).hex() for x in minima.points[0]]
    assert ends == ["0x1.e261fd4ae0d95p-2", "0x1.f012a5290e310p-2"]


@pytest.mark.parametrize("shape", [(3, 5), (5, 3), (4, 4)])
def test_the_damped_step(shape: tuple[int, int]) -> None:
    """It is that of linear algebra, whichever of both matrices is smaller."""
    random = np.random.default_rng(1)
    J, r = random.normal(size=(*shape, 2)), random.normal(size=(shape[0], 2))
    damping = np.array([0.1, 2.0])
    step = damped_step(r, J, damping)
    for k in range(2):
        normal = J[:, :, k].T @ J[:, :, k] + damping[k] * np.eye(shape[1])
        wanted = np.linalg.solve(normal, -J[:, :, k].T @ r[:, k])
        assert step[:, k] == pytest.approx(wanted, abs=1e-9)


def test_starts_are_the_same_everywhere() -> None:
    """Whole numbers decide them, the published ones of SplitMix64; those of a range are within."""
    starts = list(Search(loads_family(SDIRK2), 3).starts(1234567, 2))
    words = (6457827717110365317, 3203168211198807973)
    assert starts == [[(word >> 11) / 2**53] for word in words]
    ranged = SDIRK2.replace("g: free", "g: {free: true, range: [1/4, 1/3]}")
    search = Search(loads_family(ranged), 3)
    assert all(1 / 4 <= x <= 1 / 3 for (x,) in search.starts(2, 50))
    assert finished(search, 20).methods == []


@pytest.mark.parametrize(
    ("text", "order", "starts"),
    [
        (SDIRK2, 3, 10),
        (RADICAL, 3, 10),
        (explicit(3), 3, 5),
        pytest.param(explicit(4), 4, 8, marks=in_whole),
    ],
    ids=["sdirk", "radical", "explicit 3", "explicit 4"],
)
def test_finds_are_methods(text: str, order: int, starts: int, tmp_path: Path) -> None:
    """Every file has its claim, and the order is that of the ordinary certificate."""
    (tmp_path / "family.yaml").write_text(text, encoding="utf-8")
    source, folder = str(tmp_path / "family.yaml"), tmp_path / "found"
    arguments = ["design", source, "--order", str(order), "--search", str(starts)]
    run = gark(*arguments, "--output-dir", str(folder), "--format", "json")
    report = json.loads(run.out)
    jsonschema.validate(report, report_schema("design-search"))
    assert (run.code, report["starts"]) == (0, starts)
    assert 0 < len(report["methods"]) <= 5
    for method in report["methods"]:
        assert (method["proof"], method["residual"]) == ("exact", "0")
        read = loads(Path(method["file"]).read_text(encoding="utf-8"))
        assert find_order(read).order == method["order"] >= order
    assert gark("check", str(folder)).code == 0


def test_both_sdirk_methods() -> None:
    """All of two stages and order 3 are found, in radicals; a sign that is given decides."""
    methods = search_methods(loads_family(SDIRK2), 3, starts=20).methods
    assert {x.values["g"] for x in methods} == {"1/2 + sqrt(3)/6", "1/2 - sqrt(3)/6"}
    (one,) = finished(Search(loads_family(RADICAL), 3), 20).methods
    assert one.values["t"] == "1/2 - sqrt(3)/6"


@in_whole
def test_degenerate_solutions() -> None:
    """τ = 1 is a double solution: least squares end near it, and it is told exactly."""
    search = Search(loads_family(TAU), 3, "pair")
    (one,) = finished(search, 1).methods
    assert (one.proof, one.order, dict(one.values)) == ("exact", 4, {"tau": "1"})


def forest_ruth() -> list[float]:
    """The splitting of order 4 with b_1 = 0, at which the conditions are degenerate."""
    g = 1 / (2 - 2 ** (1 / 3))
    return [g / 2, (1 - g) / 2, (1 - g) / 2, g / 2, 0.0, g, 1 - 2 * g, g]


@in_whole
def test_a_degenerate_point_is_no_method() -> None:
    """Beside the double solution of Forest and Ruth residuals are 1e-9 and no method is there.

    Seven of the equations pass Krawczyk's test at the point; all of them do not, and what is found
    from it is the solution, exactly, or nothing.
    """
    search = Search(loads_family(SPLITTING), 4)
    system = search.conditions
    start = np.array(forest_ruth())[:, None]
    _, jacobians = system.at(start)
    _, _, v = np.linalg.svd(jacobians[:, :, 0])
    beside = start + 5e-5 * v[-1][:, None]
    values, jacobians = system.at(beside)
    assert 1e-11 < np.max(np.abs(values)) < 1e-7
    chosen = rank(jacobians[:, :, 0], 1e-4)
    assert len(chosen) == 7

    free = Fixings(system)
    with ctx.workprec(BITS):
        solved = Part(system, chosen.rows, chosen.columns, beside[:, 0])
        x = solved.polish()
        assert is_proved(solved, x, 256)  # type: ignore[arg-type]
        assert not is_proved(free, solved.whole(x), 256)
    assert polished(free, [float(a) for a in beside[:, 0]], 212) is None
    found = search.find(1, [float(a) for a in beside[:, 0]])
    assert found is None or found.proof == "exact"


class Part:
    """Some equations in some unknowns, the others as they are."""

    def __init__(
        self, system: Residuals, rows: tuple[int, ...], columns: tuple[int, ...], point: Any
    ) -> None:
        self.system = system
        self.rows, self.columns = list(rows), list(columns)
        self.point = [arb(float(x)) for x in point]

    def whole(self, x: Any) -> Any:
        """A point of all unknowns."""
        made = np.empty((len(self.point), 1), object)
        made[:, 0] = self.point
        made[self.columns] = x
        return made

    def at(self, x: Any) -> tuple[Any, Any]:
        """As that of a system."""
        values, gradients = self.system.at(self.whole(x))
        return values[self.rows], gradients[self.rows][:, self.columns]

    def polish(self) -> Any:
        """Newton's method with floats in place of its matrix: seven more digits a step or so."""
        x = np.empty((7, 1), object)
        x[:, 0] = [self.point[k] for k in self.columns]
        for _ in range(60):
            values, gradients = self.at(x)
            matrix = np.array([[float(a.mid()) for a in row] for row in gradients[:, :, 0]])
            inverse = np.linalg.inv(matrix)
            for i in range(7):
                change = sum((arb(inverse[i, j]) * values[j, 0] for j in range(7)), arb(0))
                x[i, 0] = (x[i, 0] - change).mid()
        return x


@in_whole
def test_existence_is_proved_or_not(tmp_path: Path) -> None:
    """A root of degree 9 is proved to exist; where a second equation has it too, nothing is proved
    and the word is numerical. Both files say so, and hold within their decimals.
    """
    for text, proof in ((NINTH, "exists"), (TWICE, "numerical")):
        (tmp_path / "family.yaml").write_text(text, encoding="utf-8")
        source, target = (str(tmp_path / "family.yaml"), tmp_path / "one.gark.yaml")
        arguments = ["design", source, "--order", "2", "--search", "6"]
        run = gark(*arguments, "--emit", str(target), "--format", "json")
        (method,) = json.loads(run.out)["methods"]
        assert method["proof"] == proof
        assert method["residual"] == "1e-246"
        t = float(method["values"]["t"])
        assert t**9 + t / 3 == pytest.approx(0.5)
        assert gark("check", str(target)).code == 0
        words = {"exists": "proved to exist", "numerical": "numerical"}
        assert words[proof] in target.read_text(encoding="utf-8")
        assert words[proof] in gark(*arguments).out


@pytest.mark.parametrize(
    ("group", "wanted", "proof"),
    [
        ("positive", lambda t: 1 - t, "exists"),
        ("positive", lambda t: t - 1, None),
        ("not_negative", lambda t: 1 - t, "exists"),
        ("not_negative", lambda t: t - 1, None),
        ("not_negative", lambda t: t**9 + t / 3 - HALF, "numerical"),
        ("nonzero", lambda t: t - 1, "exists"),
        ("nonzero", lambda t: t**9 + t / 3 - HALF, None),
    ],
)
def test_signs_of_what_is_not_exact(
    group: str, wanted: Callable[[Any], Any], proof: str | None
) -> None:
    """What is to be positive, not negative or not zero decides about a root of degree 9 too; the
    signs at it in floats by bisection. Zero to all digits is nowhere a proof.
    """
    family = loads_family(NINTH)
    t = family.ring.context.gen(0)
    signed = replace(family, **{group: (wanted(t),)})  # type: ignore[arg-type]
    finds = finished(Search(signed, 2), 6).methods
    assert [x.proof for x in finds] == ([] if proof is None else [proof])
    low, high = 0.0, 1.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if x**9 + x / 3 < 0.5 else (low, x)
    sign = wanted(fmpq(*low.as_integer_ratio()))
    if abs(sign) < fmpq(1, 10**12):
        assert proof != "exists"
    else:
        assert (proof == "exists") == (sign > 0 or group == "nonzero")


def test_short_numbers_have_the_wanted_signs() -> None:
    """Those with a weight 0, or less, are left out on the way: each find is exact."""
    text = "unknown: {stages: 3, shape: explicit}\ndesign: {order: 3, positive-weights: true}"
    methods = search_methods(loads_family(text), 3, starts=8).methods
    assert methods
    for method in methods:
        assert (method.proof, method.order) == ("exact", 3)
        assert all(x > 0 for x in loads(text, settings=dict(method.values)).b)


def test_what_must_not_vanish_decides_exact_finds() -> None:
    """γ = 0 makes R(∞) infinite: where R(∞) = 0 is wanted no start leads to a method, as the
    equations alone have solutions, and exactly there is none.
    """
    family = loads_family(UNBOUNDED)
    assert finished(Search(family, 1), 2).methods == []
    assert finished(Search(replace(family, nonzero=()), 1), 2).methods
    assert find_parameters(family, 1).steps[-1].kind == "none"


def test_krawczyk_needs_a_zero() -> None:
    """No zero of g² − g + 1/6 near 1/2, one near each root; a function that must not vanish is
    looked at.
    """
    family = loads_family(SDIRK2)
    generators = Generators(family.tableau, family.ring, 3)
    system = Fixings(generators)
    assert len(generators.functions) == 1
    for near, is_there in ((0.5, False), (0.2, False), (0.5 - 3**0.5 / 6, True)):
        x = polished(system, [near], 300) if is_there else None
        point = np.array([[arb(near)]], object) if x is None else x
        assert is_proved(system, point, 300) == is_there
        if is_there:
            assert not is_proved(system, point, 300, generators.functions)


@given(
    st.fractions(-50, 50, max_denominator=10**6),
    st.fractions(-9, 9, max_denominator=99),
    st.sampled_from([2, 3, 5, 7]),
)
@settings(max_examples=at_most(10, 200), deadline=None)
def test_recognition(p: Any, q: Any, radicand: int) -> None:
    """Numbers p and p + q √n are known again by their digits, in one field."""
    bits = 512
    a, b = fmpq(p.numerator, p.denominator), fmpq(q.numerator, q.denominator)
    with ctx.workprec(bits + 20):
        root = arb(radicand).sqrt()
        numbers = {"a": arb(a).mid(), "x": (a + b * root).mid(), "y": (root - a).mid()}
    assert rational(numbers["a"], bits) == a
    found = recognised(numbers, bits)
    assert found is not None
    assert found.values["a"] == a
    y = found.values["y"]
    assert isinstance(y, Algebraic)
    assert (y + a) * (y + a) == radicand
    assert found.values["x"] - (y + a) * b == a


def test_what_is_not_recognised() -> None:
    """π is no short number, and a root of high degree is left alone."""
    with ctx.workprec(400):
        pi = arb.pi().mid()
    assert rational(pi, 380) is None
    assert minimal_polynomial(pi, 380) is None
    with ctx.workprec(100):
        assert decimals(arb("-0.0625"), 3) == "-0.062"
        assert decimals(arb("123456.75"), 1) == "123456.8"


@pytest.mark.parametrize("present", [0.05, -0.1, 0.0, 0.49, 3.98])
def test_short_numbers_are_near(present: float) -> None:
    """The shortest first, none twice, none far away; zero behind them unless it is the value."""
    short, more, *fine = values_near(present)
    assert all(abs(x - fmpq(*present.as_integer_ratio())) <= fmpq(1, 8) for x in short + more)
    lengths = [x.q for x in short + more if x]
    assert lengths == sorted(lengths)
    assert len(set(map(str, short + more))) == len(short + more)
    if abs(present) < 0.12:
        zeros = [k for k, x in enumerate(short + more) if not x]
        assert zeros == ([0] if present == 0 else [len(short + more) - 1])
    assert [len(x) for x in fine] == [1, 1, 1]


@in_whole
def test_the_same_finds_with_several_processes(tmp_path: Path) -> None:
    """What is found does not hang on how many work."""
    (tmp_path / "family.yaml").write_text(explicit(3), encoding="utf-8")
    arguments = ["design", str(tmp_path / "family.yaml"), "--order", "3"]
    arguments += ["--search", "9", "--seed", "4", "--most", "3"]
    assert gark(*arguments).out == gark(*arguments, "-j", "2").out


FOUR = "unknown: {stages: 4, shape: explicit%s}\ndesign: {order: %d}\n"


def test_a_search_starts_at_a_method(tmp_path: Path) -> None:
    """The first start solves the conditions where the method is of the file: it is found, by every
    seed; another method of the order leads to itself too.
    """
    path = tmp_path / "four.yaml"
    path.write_text(FOUR % ("", 4), encoding="utf-8")
    for name, c2, c3 in (("rk4", "1/2", "1/2"), ("kutta-38", "1/3", "2/3")):
        run = gark("design", str(path), "--search", "1", "--start", name, "--format", "json")
        data = json.loads(run.out)
        jsonschema.validate(data, report_schema("design-search"))
        [method] = data["methods"]
        assert (data["first_start"], method["start"], method["proof"]) == (name, 1, "exact")
        assert (method["values"]["c2"], method["values"]["c3"]) == (c2, c3)
    run = gark("design", str(path), "--search", "1", "--start", "rk4")
    assert "1 of 1 start solves the conditions in floats, the first at rk4" in " ".join(
        run.out.split()
    )


def test_a_search_starts_near_a_method_of_another_kind() -> None:
    """An entry that the file lacks does not count; one unknown at two places is between both."""
    family = loads_family("parameters: {s: free, t: free}\nA: [[0, 0], [s, 0]]\nb: [1 - t, t]")
    heun = loads("{A: [[0, 0], [1, 1/2]], b: [1/2, 1/2]}")
    assert nearest_member(family, heun.tableau, heun.further) == pytest.approx([1, 1 / 2])
    shared = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - t, t]")
    # (t − 1)² + 2 (t − 1/2)² is least at t = 2/3
    assert nearest_member(shared, heun.tableau, heun.further) == pytest.approx([2 / 3])


def test_embedded_weights_are_of_the_start() -> None:
    """Those of Bogacki and Shampine are solved for with the rest."""
    family = loads_family(FOUR % (", embedded: true", 3))
    method = load("bogacki-shampine-3")
    point = nearest_member(family, method.tableau, method.further)
    values = dict(zip(family.parameters, point, strict=True))
    assert values["bh1"] == pytest.approx(7 / 24)
    assert values["bh4"] == pytest.approx(1 / 8)


def test_the_embedded_order_of_a_find(tmp_path: Path) -> None:
    """Text and JSON have the order of the embedded weights that the emitted file has."""
    text = "unknown: {stages: 4, shape: explicit, embedded: true}\n"
    wanted = "design: {order: 3, embedded-order: 2, fix: {bh4: 0}}\n"
    path = tmp_path / "found.gark.yaml"
    call = "design", "-", "--search", "4", "--most", "1"
    run = gark(*call, "--format", "json", "--emit", str(path), stdin=text + wanted)
    [method] = json.loads(run.out)["methods"]
    own, further = load(str(path)).tableau, load(str(path)).further
    assert further.embedded is not None
    assert method["embedded_order"] == find_order(with_weights(own, further.embedded)).order >= 2
    said = " ".join(gark(*call, stdin=text + wanted).out.split())
    assert f"order 3 and embedded order {method['embedded_order']}, by the certificate" in said


def test_a_start_has_the_stages_of_the_file(tmp_path: Path) -> None:
    """Heun's two stages are refused for four, and so is a start without a search."""
    path = tmp_path / "four.yaml"
    path.write_text(FOUR % ("", 4), encoding="utf-8")
    run = gark("design", str(path), "--search", "1", "--start", "heun")
    assert run.code == 2
    assert "the start has 2 stages for 1 vector field, the methods of the file 4" in run.err
    run = gark("design", str(path), "--start", "rk4")
    assert run.code == 2
    assert "--start goes with --search" in run.err


def test_nothing_found_and_misuse(tmp_path: Path) -> None:
    """No method is no proof that there is none: exit code 3. What does not go together is said."""
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    run = gark("design", str(path), "--order", "5", "--search", "4")
    assert run.code == 3
    assert "does not say that there is none" in run.out
    cases: list[tuple[list[str], str]] = [
        (["--search", "3"], "--order"),
        (["--seed", "3"], "--search"),
    ]
    for arguments, word in cases:
        wrong = gark("design", str(path), *arguments)
        assert wrong.code == 2
        assert word in wrong.err


@pytest.mark.parametrize(
    ("end", "code", "said"),
    [
        (KeyboardInterrupt(), 130, "interrupted"),
        (WorkerLost("lost"), 3, "a process was lost"),
        (NotDecided(), 0, "the time of --seconds was over"),
    ],
)
def test_an_end_in_the_middle_keeps_what_is_found(
    end: BaseException, code: int, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interrupted in the second proof, a worker lost or the time over: the first method is reported
    and written.
    """
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    work: Callable[..., Any] = Alone.as_they_come
    calls: list[int] = []

    def until(self: Alone[Any, Any], tasks: Any) -> Any:
        if isinstance(tasks[0], SolutionTask):
            calls.append(1)
            if len(calls) > 1:
                raise end
        return work(self, tasks)

    monkeypatch.setattr(Alone, "as_they_come", until)
    arguments = ["--order", "3", "--search", "9", "--output-dir", str(tmp_path / "out")]
    run = gark("design", str(path), *arguments)
    assert run.code == code
    assert f"then {said}" in " ".join(run.out.split())
    assert len(list((tmp_path / "out").iterdir())) == 1


@pytest.mark.parametrize("end", [KeyboardInterrupt(), NotDecided(), WorkerLost("lost")])
def test_an_end_before_a_find_leaves_the_file(
    end: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where nothing is found yet, the file of --emit stays what it was."""
    path, kept = tmp_path / "family.yaml", tmp_path / "kept.gark.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    kept.write_text("what was there\n", encoding="utf-8")

    def ended(*_: object) -> Any:
        raise end

    monkeypatch.setattr(Alone, "as_they_come", ended)
    arguments = ["--order", "3", "--search", "9", "--emit", str(kept)]
    assert gark("design", str(path), *arguments).code in {3, 130}
    assert kept.read_text(encoding="utf-8") == "what was there\n"
    assert sorted(x.name for x in tmp_path.iterdir()) == ["family.yaml", "kept.gark.yaml"]


def test_the_file_is_of_what_is_proved_most(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a numerical find and an exact one after it --emit writes the exact one."""
    path, made = tmp_path / "family.yaml", tmp_path / "made.gark.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    work: Callable[..., Any] = SolutionTask.result
    first: list[object] = []

    def weaker(self: SolutionTask, search: Search) -> object:
        found = work(self, search)
        assert isinstance(found, FoundMethod)
        if first:
            return found
        first.append(found)
        digits = {"g": "0.7886751345948128822545743902509787278238"}
        return replace(found, proof="numerical", values=digits, residual="1e-246")

    monkeypatch.setattr(SolutionTask, "result", weaker)
    arguments = ["--order", "3", "--search", "9", "--emit", str(made)]
    run = gark("design", str(path), *arguments)
    assert run.out.index("numerical: residuals") < run.out.index("exact: order 3")
    assert "# exact: order: 3" in made.read_text(encoding="utf-8")
    assert gark("check", str(made)).code == 0


def test_seconds_end_a_search(tmp_path: Path) -> None:
    """A search ends with --seconds, with what was found by then: nothing, and exit code 3."""
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    many = ["--order", "3", "--search", "1000000", "--seconds", "1e-9"]
    run = gark("design", str(path), *many)
    assert (run.code, "the time of --seconds was over" in run.out) == (3, True)
