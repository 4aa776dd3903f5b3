"""Solutions that are as stable as is wanted, their files, and how their values are written."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from flint import fmpq, fmpq_poly, fmpz_poly

from garkcli import minimise, render
from garkcli.design.choices import accepted_methods
from garkcli.design.design import Design, find_parameters, stable_sets
from garkcli.design.ideal import Ideal
from garkcli.design.member import Whose, is_stable
from garkcli.design.minimise.line import Within
from garkcli.design.parts import Part
from garkcli.design.stable_parts import StablePart, joined, point_of
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.errors import MethodFileError
from garkcli.exact.cells import Interval, has, where
from garkcli.exact.domain import square_free
from garkcli.exact.field import NumberField
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import root_text
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.report.schemas import report_schema
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.tableau.family import RequiredStability
from tests.cli.harness import gark
from tests.whole import in_whole

SDIRK = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
THREE = "unknown: {stages: 3, shape: sdirk}\ndesign: {order: 4, a-stable: true}\n"


@pytest.fixture(scope="module")
def three() -> Design:
    """SDIRK methods of three stages and order 4, A-stable ones wanted."""
    return find_parameters(loads_family(THREE))


@in_whole
def test_of_three_methods_one_is_a_stable(three: Design) -> None:
    """S. P. Nørsett 1974: of the three γ of order 4 the largest alone is A-stable; that method says the same when it
    is loaded with its values as roots of a polynomial.
    """
    [found] = three.last.found
    assert (found.accepted, found.unstable, found.open) == ((2,), (0, 1), ())
    [chosen] = accepted_methods(three)
    gamma = chosen.values["gamma"]
    assert "root_of(3*x**3 - 3*x + 1" in gamma
    method = loads(THREE.split("design")[0], settings=chosen.values)
    assert is_a_stable(stability_function(method.tableau))


def test_order_and_stability_as_a_command(tmp_path: Path) -> None:
    """Both solutions of order 3 are told, one is taken and written with both claims, which hold;
    no solution is L-stable; where every value has the order the set of values is given.
    """
    path, made = tmp_path / "family.yaml", tmp_path / "made.yaml"
    path.write_text(SDIRK, encoding="utf-8")
    asked = ["design", str(path), "--order", "3"]
    run = gark(*asked, "--a-stable", "--emit", str(made))
    assert run.code == 0
    assert "not A-stable, which is wanted" in run.out
    text = made.read_text(encoding="utf-8")
    assert "expect: {order: 3, a-stable: true}" in text
    assert gark("check", str(made)).code == 0
    assert gark(*asked, "--l-stable").code == 1
    both = gark(*asked, "--a-stable", "--format", "json").out
    data = json.loads(both)
    jsonschema.validate(data, report_schema("design"))
    assert [x["stable"] for x in data["solutions"]] == [False, True]
    every = gark("design", str(path), "--order", "2", "--l-stable", "--format", "json")
    data = json.loads(every.out)
    jsonschema.validate(data, report_schema("design"))
    assert [x["point"] for x in data["stable"][0]["set"]] == ["1 - sqrt(2)/2", "1 + sqrt(2)/2"]


def test_wishes_that_have_no_meaning() -> None:
    """P-stability of one colour is refused with its cure."""
    text = "unknown: {stages: 2, shape: imex}\ndesign: {p-stable: {2: true}}\n"
    with pytest.raises(MethodFileError, match="for all colours together"):
        loads_family(text)


TWO = "unknown: {stages: 2, shape: sdirk}\ndesign: {order: 2, %s: true}\n"


@pytest.mark.parametrize(
    ("kind", "ends"), [("a-stable", ["1/4"]), ("l-stable", ["1 - sqrt(2)/2", "1 + sqrt(2)/2"])]
)
def test_stable_methods_of_a_family_of_two_dimensions(kind: str, ends: list[str]) -> None:
    """R of SDIRK methods of two stages and order 2 depends on gamma alone: the set is that of the
    family of one parameter, and methods beside its ends are stable or not as it says.
    """
    found = find_parameters(loads_family(TWO % kind))
    [values] = stable_sets(found)
    assert found.last.known.is_real is True
    assert values.names == ("gamma",)
    shown = [root_text(end) for x in values.found for end in (x.start, x.end) if end is not None]
    assert list(dict.fromkeys(shown)) == ends
    alone = stable_set(loads_family(SDIRK), "a-stable" if kind == "a-stable" else "l-stable")
    assert values.found == alone.found
    text = "parameters: {g: %s, c: 3/5}\nA: [[g, 0], [c - g, g]]\nb: [1 - (1/2 - g)/(c - g), (1/2 - g)/(c - g)]\n"
    for g, stable in (("1/5", False), ("1/4", True), ("2", True), ("1 - sqrt(2)/2", True)):
        R = stability_function(loads(text % f'"{g}"').tableau)
        assert is_a_stable(R) is stable
        assert is_l_stable(R) is (g == "1 - sqrt(2)/2")


def test_the_best_of_the_stable_methods() -> None:
    """Of A-stable methods the least error is that of one of both methods of order 3; of the theta
    methods the least coefficients are at the end of the stable ones, where no derivative vanishes.
    """
    free = minimise(
        loads_family("unknown: {stages: 2, shape: sdirk}\ndesign: {order: 2}\n"), "error"
    )
    stable = minimise(loads_family(TWO % "a-stable"), "error")
    assert (len(free.minimisers), len(stable.minimisers)) == (2, 1)
    [best] = stable.minimisers
    assert root_text(best.found.solution.real_values[best.index]["gamma"]) == "1/2 + sqrt(3)/6"
    theta = "parameters: {t: free}\nA: [[t]]\nb: [1]\ndesign: {order: 1%s}\n"
    least = minimise(loads_family(theta % ", a-stable: true"), "coefficients")
    assert (least.value, least.extent) == (RealRoot.rational(fmpq(5, 4)), "all")
    assert "of all methods of order 1 that are A-stable" in " ".join(render(least).split())
    assert minimise(loads_family(theta % ""), "coefficients").value == RealRoot.rational(fmpq(1))


def test_the_least_error_of_l_stable_methods() -> None:
    """17/18 − 2√2/3 at gamma = 1 − √2/2, and none is less: by the certificate's engine over ℚ(√2),
    and by all trees at many other nodes with gamma to 30 digits.
    """
    least = minimise(loads_family(TWO % "l-stable"), "error")
    assert least.value is not None
    assert root_text(least.value) == "17/18 - 2*sqrt(2)/3"
    assert least.extent == "nearly"
    gamma = fmpq(292893218813452475599155637895, 10**30)
    errors = []
    for k in range(-20, 40):
        c = fmpq(2 * k + 1, 19)
        b = (fmpq(1, 2) - gamma) / (c - gamma)
        A, weights, nodes = [[gamma, fmpq(0)], [c - gamma, gamma]], [1 - b, b], [gamma, c]
        product = [sum(a * x for a, x in zip(row, nodes, strict=True)) for row in A]
        cubic = sum(w * x * x for w, x in zip(weights, nodes, strict=True)) - fmpq(1, 3)
        tall = sum(w * x for w, x in zip(weights, product, strict=True)) - fmpq(1, 6)
        errors.append(cubic**2 / 4 + tall**2)  # σ of [τ, τ] is 2
    about = fmpq(17, 18) - fmpq(2, 3) * (2 - 2 * gamma)
    assert min(errors) > about - fmpq(1, 10**20)
    assert min(errors) < about + fmpq(1, 1000)


def test_what_is_open_bounds_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the stability of some methods is open, the best is that of what was found."""
    monkeypatch.setattr(StablePart, "is_decided", property(lambda _: False))
    least = minimise(loads_family(TWO % "l-stable"), "error")
    assert least.value is not None
    assert root_text(least.value) == "17/18 - 2*sqrt(2)/3"
    assert least.extent == "found"


@in_whole
def test_a_search_for_stable_methods(tmp_path: Path) -> None:
    """Each find is A-stable and its file claims it; one start leads to a method that is not."""
    path, folder = tmp_path / "family.yaml", tmp_path / "found"
    path.write_text(
        "unknown: {stages: 3, shape: sdirk}\ndesign: {a-stable: true}\n", encoding="utf-8"
    )
    asked = ["design", str(path), "--order", "3", "--search", "8", "--format", "json"]
    run = gark(*asked, "--output-dir", str(folder))
    data = json.loads(run.out)
    jsonschema.validate(data, report_schema("design-search"))
    assert (len(data["methods"]), data["unstable"]) == (5, 1)
    files = sorted(folder.iterdir())
    assert all("a-stable: true" in x.read_text(encoding="utf-8") for x in files)
    assert gark("check", *map(str, files)).code == 0


def test_values_in_a_set() -> None:
    """T + 1/t is in [√5, 3] for t between the roots of t² − √5 t + 1 and of t² − 3 t + 1."""
    root5, three = RealRoot(fmpz_poly([-5, 0, 1]), 1), RealRoot.rational(fmpq(3))
    numerator, denominator = Polynomial([1, 0, 1]), Polynomial([0, 1])
    within = Within(numerator, denominator, (Interval(root5, three, has_start=True, has_end=True),))
    for x in where(within.holds, within.polynomials):
        assert x.start is not None
        assert x.end is not None
        assert sorted(round(t + 1 / t, 9) for t in (float(x.start), float(x.end))) == [
            2.236067977,
            3.0,
        ]
    assert not within.holds(fmpq(0))


IMEX = """unknown: {stages: 4, shape: [imex, stiffly-accurate]}
design:
  order: 3
  R-infinity: {2: 0}
  l-stable: {2: true}
  fix: {b1: 0, c2: gamma, c3: (1 + gamma)/2, e42: e43, e32: 2/5}
"""


@in_whole
def test_implicit_explicit_methods_with_an_l_stable_part() -> None:
    """Four stages of order 3: of the three γ with R(∞) = 0, the roots of 6γ³ − 18γ² + 9γ − 1, one
    makes the implicit part L-stable, 0.4358… (R. Alexander 1977); its method is proved.
    """
    found = find_parameters(loads_family(IMEX))
    [one] = found.last.found
    assert (one.accepted, one.unstable) == ((1,), (0, 2))
    [chosen] = accepted_methods(found)
    assert chosen.order == 3
    method = loads(IMEX.split("design")[0], settings=chosen.values)
    R = stability_function(method.tableau, [fmpq(0), fmpq(1)])
    assert is_l_stable(R)


@in_whole
def test_the_best_implicit_explicit_method_with_an_l_stable_part() -> None:
    """e43 is free besides gamma: where gamma is written down as the root that is L-stable there is
    one solution, the same.
    """
    free = IMEX.replace("e42: e43, e32: 2/5", "e32: 2/5")
    found = minimise(loads_family(free), "coefficients")
    assert found.extent == "nearly"
    [best] = found.minimisers
    values = best.found.solution.real_values[best.index]
    assert float(values["gamma"]) == pytest.approx(0.4358665215)
    text = free.replace("  l-stable: {2: true}\n", "").replace("b1: 0,", "b1: 0, gamma: %s,")
    given = "'root_of(6*x**3 - 18*x**2 + 9*x - 1, 0.43586652)'"
    other = minimise(loads_family(text % given), "coefficients")
    assert other.value == found.value


def test_all_solutions_are_written(tmp_path: Path) -> None:
    """Each of several solutions has a file of its own, whose claim gark check proves."""
    path, folder = tmp_path / "two.gark.yaml", tmp_path / "all"
    path.write_text(SDIRK, encoding="utf-8")
    run = gark("design", str(path), "--order", "3", "--output-dir", str(folder))
    assert run.code == 0
    files = sorted(folder.iterdir())
    assert [x.name for x in files] == ["two-1.gark.yaml", "two-2.gark.yaml"]
    texts = [x.read_text(encoding="utf-8") for x in files]
    assert texts[0] != texts[1]
    assert gark("check", *map(str, files), "--require-claims").code == 0
    none = gark("design", str(path), "--order", "2", "--output-dir", str(folder))
    assert (none.code, "no order has finitely many" in none.err) == (2, True)


def test_radicands_have_no_square_factors() -> None:
    """Squares of large primes are taken out: (x − 1)² = 2 · 10007² has the roots 1 ± 10007 √2."""
    prime = 10007
    root = RealRoot(fmpz_poly([1 - 2 * prime**2, -2, 1]), 1)
    assert root_text(root) == f"1 + {prime}*sqrt(2)"
    large = fmpq(3 * prime**2 * 1000003**2)
    assert square_free(large) == 3
    beyond = fmpq(2 * (2**61 - 1) ** 2)  # 123 bits, the square of a prime
    assert square_free(beyond) == 2


def test_elements_without_radicals_are_written_in_theta() -> None:
    """A field of which only the polynomial is known has elements that can be printed."""
    field = NumberField(fmpq_poly([-2, 0, 0, 1]), ())
    assert str(field.element(fmpq_poly([1, fmpq(-1, 2), 3]))) == ("1 - theta/2 + 3*theta**2")


@pytest.mark.parametrize(
    ("kind", "least", "greatest", "code", "told"),
    [
        ("l-stable", "0", "1", 0, "L-stable for exactly gamma = 1 - sqrt(2)/2 unknowns"),
        ("l-stable", "1/2", "1", 1, "order 2 for no method of the file"),
        ("a-stable", "0", "1/3", 3, "A-stable for exactly 1/4 ≤ gamma ≤ 1/3 unknowns"),
    ],
)
def test_stable_values_are_within_the_range(
    kind: str, least: str, greatest: str, code: int, told: str
) -> None:
    """What a file excludes is in no set, and where all of it is excluded there is no method."""
    run = gark(
        *("design", "-"),
        stdin=(
            "unknown: {stages: 2, shape: sdirk}\n"
            f"design: {{order: 2, {kind}: true, range: {{gamma: [{least}, {greatest}]}}}}\n"
        ),
    )
    assert run.code == code
    assert told in " ".join(run.out.split())


@pytest.mark.parametrize(
    ("diagonal", "b", "code", "told"),
    [
        ("s - 1", "1/2 + s**2 + t**2", 1, "order 1 of the method; not A-stable, which is wanted"),
        ("s + 1", "1/2 + s**2 + t**2", 0, "order 1 of the method, proved, A-stable"),
        ("s + 1", "3/2 + s**2 + t**2", 1, "A-stable: no real value of order 1 that the file"),
    ],
)
def test_what_is_known_of_real_points(diagonal: str, b: str, code: int, told: str) -> None:
    """Of s² + t² = 0 the one real point is known, and whether it is stable, with the poles ±1; of
    s² + t² = −1 there is none: neither is called not decided.
    """
    run = gark(
        *("design", "-"),
        stdin=(
            f"parameters: {{s: free, t: free}}\nA: [[{diagonal}, 0], [t, {diagonal}]]\n"
            f"b: [{b}, 1/2]\ndesign: {{order: 1, a-stable: true}}\n"
        ),
    )
    assert run.code == code
    text = " ".join(run.out.split())
    assert (told in text, "not decided" in text) == (True, False)


def test_the_set_with_other_wishes() -> None:
    """Which of the stable methods have positive weights is not looked at: the set is told apart
    from that, and is the one without it.
    """
    text = "unknown: {stages: 2, shape: sdirk}\ndesign: {order: 2, l-stable: true"
    alone = gark("design", "-", stdin=f"{text}}}").out.split("unknowns")[0]
    beside = gark("design", "-", stdin=f"{text}, positive-weights: true}}").out.split("unknowns")[0]
    assert " ".join(beside.split()) == " ".join(alone.split()).replace(
        "L-stable for", "L-stable, apart from what else is wanted, for"
    )
    told = gark("design", "-", "--format", "json", stdin=f"{text}, positive-weights: true}}")
    [values] = json.loads(told.out)["stable"]
    assert values["apart"]


BESIDE = """
parameters: {g: free, d: free}
A: [[g, "1/2 - g + (g - %s)*(g - 2)"], [0, g]]
b: [1, "(g - %s)*d"]
design: {order: 2, a-stable: true}
"""
"""A line g = … with any d, and a point g = 2 with d = 0."""


@pytest.mark.parametrize(("line", "says"), [("1", "g = 1 or g = 2"), ("(-1)", "g = 2")])
def test_a_stable_point_beside_a_line(line: str, says: str) -> None:
    """G = 1 is A-stable with any d, g = −1 is not; g = 2 is: the set has all that are."""
    run = gark("design", "-", stdin=BESIDE % (line, line))
    assert (run.code, f"A-stable for exactly {says}\n" in run.out) == (0, True)
    point = gark("design", "-", "--set", "d=0", stdin=BESIDE % (line, line))
    assert "g = 2: order 2 of the method, proved, A-stable" in point.out


def test_stable_sets_are_of_families_that_have_the_order() -> None:
    """Two numbers have order 3, each with its own answer; all have order 2, and a set of them is
    stable.
    """
    text = (
        "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\ndesign: {a-stable: true}"
    )
    assert stable_sets(find_parameters(loads_family(text), 3)) == ()
    (found,) = stable_sets(find_parameters(loads_family(text), 2))
    assert [x.start for x in found.found] == [RealRoot.rational(fmpq(1, 4))]


@pytest.mark.parametrize("first", ["d", "e"])
def test_an_unknown_on_the_diagonal_that_is_no_coordinate(first: str) -> None:
    """Order 2 of b = (1/2, 1/2) asks for d + e = 1, and |R(∞)| = |1 − 1/(2de)| ≤ 1 for d = e = 1/2:
    the set is told for d, whichever of both the line is described by.
    """
    other = {"d": "e", "e": "d"}[first]
    text = f"""
parameters: {{{first}: free, {other}: free}}
A: [[d, 0], [0, e]]
b: [1/2, 1/2]
design: {{order: 2, a-stable: true}}
"""
    run = gark("design", "-", stdin=text)
    assert "A-stable for exactly d = 1/2\n" in run.out


def test_parts_of_one_set_with_a_point() -> None:
    """Stage order 2 of three ESDIRK stages asks for c₂ (c₂ − 2γ) = 0: a line, another one with
    γ = 1/2, and two points; the L-stable ones have γ = 1 ± √2/2, as on the line alone.
    """
    text = "unknown: {stages: 3, shape: [esdirk, stiffly-accurate]}\ndesign: {order: 2, "
    whole = find_parameters(loads_family(text + "l-stable: true, stage-order: 2}"))
    line = find_parameters(
        loads_family(text + "l-stable: true, stage-order: 2, fix: {c2: 2*gamma}}")
    )
    (found,), (alone,) = whole.last.known.stable, line.last.known.stable
    assert (found.names, found.found) == (("gamma",), alone.found)
    assert [float(x.start.ball(64)) for x in found.found] == pytest.approx(
        [1 - 2**0.5 / 2, 1 + 2**0.5 / 2]
    )


@pytest.mark.parametrize(
    ("text", "order", "whose", "form"),
    [
        (
            "parameters: {g: free, w: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
            "embedded: [w, 1 - w]\ndesign: {a-stable: true}",
            2,
            "method",
            "g",
        ),
        pytest.param(
            "parameters: {t1: free, t2: free}\nmethods: [gauss-2, gauss-3]\n"
            "transfer: {interpolation: t1, conjugate-collocation: t2, legendre: 1 - t1 - t2}\n"
            "design: {p-stable: true}",
            4,
            "pair",
            "t1 - 2/3*t2",
            marks=in_whole,
        ),
    ],
)
def test_several_parameters_of_which_every_value_has_the_order(
    text: str, order: int, whose: Whose, form: str
) -> None:
    """The set is that of the file without an order: in the one form on which the step depends."""
    family = loads_family(text)
    design = find_parameters(family, order, whose)
    [values] = stable_sets(design)
    assert design.last.known.is_real
    alone = stable_set(family, values.wanted, whose)
    assert alone.found == values.found
    assert alone.names == values.names == (form,)


def test_values_of_parts_together() -> None:
    """A value that one part leaves open is open unless another part has it, or it is out of the
    range of the unknown.
    """
    family = loads_family(SDIRK.replace("free", "{free: true, range: [0, 10]}"))
    part = Part(family.ring, {}, (), Ideal(family.ring))
    values = (RealRoot.rational(fmpq(x)) for x in (0, 1, 3, 5, 10, 20))
    zero, one, three, five, ten, twenty = values
    sets = [
        ((Interval(five, None),), (one, five, twenty)),
        ((Interval(zero, three, has_start=True, has_end=True),), ()),
    ]
    kinds = [StableValues(family, "method", "a-stable", *x) for x in sets]
    everything = (Interval(None, None),)
    (together,) = joined(family, [StablePart(part, (x,), (everything,)) for x in kinds])
    assert together.found == (*sets[1][0], Interval(five, ten, has_end=True))
    assert together.undecided == (five,)


@pytest.mark.parametrize("is_stable", [True, False])
@pytest.mark.parametrize("on_line", [True, False, None])
def test_a_point_beside_a_line(is_stable: bool, on_line: bool | None) -> None:
    """No set is told where of two methods with the value 1, a point and one of a line, one is
    stable; it is told where the line has no such method.
    """
    family = loads_family(SDIRK)
    context = family.ring.context
    line = Part(family.ring, {}, (), Ideal(family.ring))
    point = Part(family.ring, {}, (), Ideal(family.ring).with_zeros([context.gen(0) - 1]))
    one = RealRoot.rational(fmpq(1))
    alone = (point_of(one),)
    above = Interval(one, None, has_start=bool(on_line))
    of_point = StableValues(family, "method", "a-stable", alone if is_stable else (), ())
    of_line = StableValues(family, "method", "a-stable", (above,), ())
    attained = (Interval(None, one), above) if on_line is None else (Interval(None, None),)
    parts = [StablePart(point, (of_point,), (alone,)), StablePart(line, (of_line,), (attained,))]
    told = joined(family, parts)
    if on_line is not None and on_line is not is_stable:
        assert told == ()
    else:
        assert told[0].found == (Interval(one, None, has_start=is_stable),)


WEIGHED = """parameters: {g: free, d: free, s: free}
A: [[g, 0], [1 - d, d]]
b: [s, 1 - s]
"""


@pytest.mark.parametrize(
    ("weight", "kind"),
    [
        ("sqrt(2)", "a-stable"),
        pytest.param("sqrt(2)", "l-stable", marks=in_whole),
        ("root_of(x^3 - x - 1, 1)", "a-stable"),
    ],
)
def test_methods_of_an_order_with_an_irrational_number(weight: str, kind: Wanted) -> None:
    """Order 2 asks for g s + 1 - s = 1/2: one g for the weight s that is meant, irrational beside
    the free d. The set of d is that of single methods.
    """
    family = loads_family(WEIGHED + f"design: {{{kind}: true}}\n", settings={"s": weight})
    step = find_parameters(family, 2).last
    [values] = step.known.stable
    assert values.names == ("d",)
    assert step.has_methods is values.has_values
    g = f"1 - 1/(2*({weight}))"
    for d in (fmpq(k, 8) for k in range(-16, 25)):
        method = loads(WEIGHED, settings={"s": weight, "g": g, "d": str(d)})
        assert has(values.found, d) is is_stable(RequiredStability(kind), method.tableau)


def test_the_two_coordinates_of_a_family_of_an_order() -> None:
    """A solution set with two free coordinates on which the step depends has the plane of the file
    that is written in them.
    """
    text = "parameters: {g: free, d: free, e: free}\nA: [[g, 0], [1 - d, d]]\nb: [e, 1/2]\n"
    step = find_parameters(loads_family(text + "design: {a-stable: true}\n"), 1).last
    [values] = step.known.stable
    plane = stable_set(loads_family(text, settings={"e": "1/2"}), "a-stable")
    assert (values.names, values.found) == (plane.names, plane.found)
    assert step.has_methods is True


def test_two_irrational_coordinates() -> None:
    """Orders 1 of both colours ask for g² = 2 and w² = 3; R = 1 + z/(1 − (g h − w) z) in the second
    is A-stable for g h − w ≥ 1/2.
    """
    text = (
        "parameters: {g: {free: true, range: [0, 3]}, w: {free: true, range: [0, 3]}, h: free}\n"
        'ark:\n  A: [[[0]], [["g*h - w"]]]\n  b: [["g^2 - 1"], ["w^2 - 2"]]\n'
        "design: {a-stable: {2: true}}\n"
    )
    step = find_parameters(loads_family(text), 1).last
    [values] = step.known.stable
    assert values.names == ("h",)
    [interval] = values.found
    assert interval.start is not None
    assert (interval.has_start, interval.end) == (True, None)
    assert float(interval.start) == pytest.approx((1 / 2 + 3**0.5) / 2**0.5)
    assert step.has_methods is True


def test_three_coordinates_and_two_forms_of_them() -> None:
    """The step depends on h + k and on the second node alone; the set is that of single methods, by
    |R| on the imaginary axis.
    """
    text = (
        "parameters: {h: free, k: free, l: free, g: {free: true, range: [0, 3]}}\n"
        'A: [["h + k", 0], ["l", "h + k"]]\nb: ["g^2/4", 1/2]\n'
    )
    step = find_parameters(loads_family(text + "design: {a-stable: true}\n"), 1).last
    [values] = step.known.stable
    assert values.names == ("h + k", "c2")
    verdicts = set()
    y = 1j * np.linspace(0.01, 60, 3000)
    for s in (fmpq(1, 5), fmpq(1, 3), fmpq(1, 2), fmpq(2)):
        for c in (fmpq(k, 7) for k in range(-7, 50, 3)):
            a, node = float(s), float(c)
            # R = 1 + z bᵀ(I − zA)⁻¹𝟙
            first = 1 / (1 - a * y)
            R = 1 + y * (first + (1 + y * (node - a) * first) * first) / 2
            is_in = any(
                has([strip], s)
                and has([x for p in strip.parts if (x := p.over(RealRoot.rational(s)))], c)
                for strip in values.strips
            )
            verdicts.add(is_in)
            assert is_in is bool((abs(R) <= 1 + 1e-9).all())
    assert verdicts == {True, False}
