"""``gark design --a-stable`` with two parameters: cells of the plane, against single methods."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

import pytest
from flint import fmpq

from garkcli import loads
from garkcli.design.fewer import step_polynomials
from garkcli.design.member import TABLEAUS, Whose, is_stable
from garkcli.design.stability_kinds import Slice
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.errors import MethodFileError, ZeroWeight
from garkcli.exact.cells import Interval, between, has
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.methodfile.family import loads_family
from garkcli.plots.curves import stable_plane_scene
from garkcli.plots.scene import Area
from garkcli.stability.linear import is_a_stable, real_and_imaginary, stability_function
from garkcli.tableau.family import RequiredStability
from garkcli.tableau.forms import on_linear_problems
from tests.cli.harness import gark
from tests.whole import at_most, in_whole, sample

FREE = "parameters: {g: free, d: free}\n"
DIRK = f"{FREE}A: [[g, 0], [1 - d, d]]\nb: [1/2, 1/2]\n"
STIFF = f"{FREE}A: [[g, 0], [1/2, d]]\nb: [1 - d, d]\n"
SDIRK = f"{FREE}A: [[g, 0], [1 - 2*g, g]]\nb: [1 - d, d]\n"
THREE = f"{FREE}A: [[g, 0, 0], [1/2 - g, g, 0], [d, 1 - d - g, g]]\nb: [d, 1 - d - g, g]\n"
BILINEAR = f"{FREE}A: [[g, d], [1/3, g*d]]\nb: [3/4, 1/4]\n"
FULL = f"{FREE}A: [[g, d], [1/2, 1/3]]\nb: [3/4, 1/4]\n"


def plane(text: str) -> StableValues:
    """The set for a family."""
    found = stable_set(loads_family(text), "a-stable")
    assert found.is_plane
    return found


def contains(values: StableValues, g: fmpq, d: fmpq) -> bool:
    """Whether a pair of rational numbers belongs to the set."""
    root, other = RealRoot.rational(g), RealRoot.rational(d)
    for strip in values.strips:
        if has([strip], root):
            over = [part.over(root) for part in strip.parts]
            return any(x is not None and has([x], other) for x in over)
    return False


def is_single_stable(
    text: str, g: fmpq, d: fmpq, wanted: Wanted = "a-stable", whose: Whose = "method"
) -> bool:
    """One method by the ordinary engine; False outside of the ranges, and where there is none."""
    family = loads_family(text)
    for name, x in (("g", g), ("d", d)):
        least, greatest = family.ranges[name]
        if (least is not None and x < least) or (greatest is not None and greatest < x):
            return False
    try:
        method = loads(text, settings={"g": str(g), "d": str(d)})
        tableau = on_linear_problems(TABLEAUS[whose](method.tableau))
    except (MethodFileError, ZeroWeight):
        return False
    return is_stable(RequiredStability(wanted), tableau)


@pytest.mark.parametrize("text", [DIRK, STIFF, SDIRK, FULL])
def test_the_step_of_a_family_is_that_of_its_members(text: str) -> None:
    """On ẏ = y it is R(z) of the single method; on (q, p)˙ = (p, −q), entry by entry, the complex
    number R(iz) = (Pr + iPi)/(Qr + iQi) as a matrix.
    """
    family = loads_family(text)
    for z, g, d in ((fmpq(2, 3), fmpq(1, 5), fmpq(3, 4)), (fmpq(-3), fmpq(2), fmpq(-1, 2))):
        R = stability_function(loads(text, settings={"g": str(g), "d": str(d)}).tableau)
        D, [N] = step_polynomials(family.tableau, family.ring, [((fmpq(1),),)])
        assert N(z, g, d) * R.denominator(z) == R.numerator(z) * D(z, g, d)
        turn = ((fmpq(0), fmpq(1)), (fmpq(-1), fmpq(0)))
        D, numerators = step_polynomials(family.tableau, family.ring, [turn])
        (pr, pi), (qr, qi) = (
            [part(z) for part in real_and_imaginary(p)] for p in (R.numerator, R.denominator)
        )
        real, imaginary = pr * qr + pi * qi, pi * qr - pr * qi
        wanted = [real, imaginary, -imaginary, real]
        found = [entry(z, g, d) * (qr * qr + qi * qi) for entry in numerators]
        assert found == [x * D(z, g, d) for x in wanted]


ROOTS = DIRK.replace("[1/2, 1/2]", "[sqrt(2)/3, 1 - sqrt(2)/3]")
CUBIC = DIRK.replace("[1/2, 1/2]", "['root_of(x^3 - x - 1, 1)', '1 - root_of(x^3 - x - 1, 1)']")
POLES = f"{FREE}A: [[g, 0], [1/(d - 1), d/(g - 1)]]\nb: [1/2, 1/2]\n"
WEIGHTS = f"{FREE}A: [[g, 0], [1/2, d]]\nb: [1 - g, g]\n"
BOUNDED = (
    "parameters: {g: {free: true, range: [1/5, 3/2]}, d: {free: true, range: [1/4, 2]}}\n"
    + DIRK.removeprefix(FREE)
)
COUPLED = """parameters: {g: free, d: free}
methods: [{family: lobatto-iiia, stages: 2}, {family: gauss, stages: 1}]
transfer: {default: collocation, blocks: {"2,1": [[g, d]]}}
structure: semi-separable
"""
PARTITIONED = """parameters: {g: free, d: free}
prk:
  q: {A: [[g, 0], [1/2, 1/2]], b: [1/2, 1/2]}
  p: {A: [[1/2, 0], [d, 0]], b: [1/2, 1/2]}
"""
WITHOUT_VALUES = PARTITIONED, "p-stable"


@pytest.mark.parametrize(
    ("text", "wanted", "whose"),
    [
        (DIRK, "a-stable", "method"),
        (THREE, "a-stable", "method"),
        (SDIRK, "l-stable", "method"),
        (ROOTS, "a-stable", "method"),
        (BOUNDED, "l-stable", "method"),
        (COUPLED, "p-stable", "method"),
        *(
            pytest.param(*x, marks=in_whole)
            for x in (
                (STIFF, "a-stable", "method"),
                (STIFF, "l-stable", "method"),
                (SDIRK, "a-stable", "method"),
                (FULL, "a-stable", "method"),
                (FULL, "l-stable", "method"),
                (BILINEAR, "a-stable", "method"),
                (ROOTS, "l-stable", "method"),
                (CUBIC, "a-stable", "method"),
                (POLES, "a-stable", "method"),
                (BOUNDED, "a-stable", "method"),
                (WEIGHTS, "a-stable", "conjugate"),
                (COUPLED, "i-stable", "method"),
                (PARTITIONED, "i-stable", "method"),
                (PARTITIONED, "p-stable", "method"),
            )
        ),
    ],
)
def test_random_and_critical_points(text: str, wanted: Wanted, whose: Whose) -> None:
    """Rational points on a grid, at random, and beside the ends over some g: in the set exactly
    where the single method is stable.
    """
    values = stable_set(loads_family(text).on_linear_problems, wanted, whose)
    assert values.is_plane
    assert values.undecided == ()
    dice = Random(1)
    points = [
        (fmpq(i, 4), fmpq(k, 4)) for i in range(-4, 9, 2) for k in range(-6, 11, at_most(2, 1))
    ]
    points += [
        (fmpq(dice.randint(-20, 40), 13), fmpq(dice.randint(-30, 60), 17))
        for _ in range(at_most(10, 60))
    ]
    ends = [x.start.exact for x in values.strips if x.start is not None and x.start.exact]
    inside = [between(x.start, x.end) for x in values.strips if not x.is_point]
    for g in (fmpq(-1), fmpq(1, 8), fmpq(1, 3), fmpq(3, 4), fmpq(6), *ends, *inside):
        for strip in values.strips:
            if has([strip], RealRoot.rational(g)):
                for part in strip.parts:
                    x = part.over(RealRoot.rational(g))
                    assert x is not None
                    for end in (x.start, x.end):
                        if end is not None:
                            near = end.exact or fmpq(round(float(end) * 10**6), 10**6)
                            points += [
                                (g, near + shift)
                                for shift in (-fmpq(1, 10**4), 0, fmpq(1, 10**4))
                                if shift or end.exact
                            ]
    found = [is_single_stable(text, g, d, wanted, whose) for g, d in points]
    assert {*found} == ({True, False} if (text, wanted) != WITHOUT_VALUES else {False})
    assert [contains(values, g, d) for g, d in points] == found


@in_whole
def test_the_report() -> None:
    """The set of the DIRK with weights 1/2, which for 0 < g < 1/2 is (1 − g)/2 ≤ d ≤ (1 − g)/(2 − 4g)."""
    run = gark("design", "-", "--a-stable", stdin=DIRK)
    assert run.code == 0
    assert run.out.splitlines()[1:] == [
        "  0 ≤ g < 1/2  -1/2*g + 1/2 ≤ d ≤ (g - 1)/(4*g - 2)",
        "  1/2 ≤ g < 1  -1/2*g + 1/2 ≤ d",
        "  g = 1        every d",
        "  1 < g        (g - 1)/(4*g - 2) ≤ d",
    ]
    data = json.loads(gark("design", "-", "--a-stable", "--format", "json", stdin=DIRK).out)
    (part,) = data["set"][0]["parts"]
    assert part["to"] == {
        "function": "(g - 1)/(4*g - 2)",
        "curve": "4*g*d - g - 2*d + 1",
        "branch": 1,
    }
    text = gark("design", "-", "--a-stable", stdin=STIFF).out
    assert "g ≤ 0          d = root 2 in d of -2*g*d + 2*g + 2*d^2 - d" in text


def test_the_plane_beside_an_order() -> None:
    """With an order that every value has, the set is that without it."""
    asked = gark("design", "-", "--order", "1", "--a-stable", "--format", "json", stdin=DIRK)
    alone = gark("design", "-", "--a-stable", "--format", "json", stdin=DIRK)
    assert asked.code == alone.code == 0
    [stable] = json.loads(asked.out)["stable"]
    assert stable["set"] == json.loads(alone.out)["set"]
    text = gark("design", "-", "--order", "1", "--a-stable", stdin=DIRK).out
    assert "A-stable for exactly these g and d" in " ".join(text.split())
    assert "1 < g        (g - 1)/(4*g - 2) ≤ d" in text


def test_a_root_set_beside_two_parameters() -> None:
    """A number that --set makes irrational is one among the coefficients: R depends on it, and the
    first strip begins at a number of its field.
    """
    text = DIRK.replace("d: free}", "d: free, s: free}").replace("[1/2, 1/2]", "[s, 1 - s]")
    run = gark("design", "-", "--a-stable", "--set", "s=sqrt(2)/3", stdin=text)
    assert run.code == 0
    assert "1 - 3*sqrt(2)/4 ≤ g ≤ 0  d = root 1 in d of -2*g^2 + 4*g" in run.out


def test_two_linear_forms_of_three_parameters() -> None:
    """R depends on t + v and u: with v = 0 the set is that of t and u, and the ends are told in the
    forms.
    """
    text = "parameters: {t: free, u: free, v: free}\nA: [[t + v, 0], [u, t + v]]\nb: [1/2, 1/2]\n"
    values = stable_set(loads_family(text), "l-stable")
    assert values.names == ("t + v", "u")
    fixed = stable_set(loads_family(text, settings={"v": "0"}), "l-stable")
    assert values.found == fixed.found
    run = gark("design", "-", "--l-stable", stdin=text)
    assert "for exactly these t + v and u\n" in run.out
    assert "u = -2*(t + v)^2 + 2*(t + v)" in run.out


def test_no_values_and_explicit_methods() -> None:
    """Explicit methods have no values, and the exit code says so."""
    text = f"{FREE}A: [[0, 0], [g, 0]]\nb: [1 - d, d]\n"
    run = gark("design", "-", "--a-stable", stdin=text)
    assert run.code == 1
    assert "A-stable for no value of g and d" in run.out


IRRATIONAL = "parameters: {g: free, h: free}\nA: [[1/2]]\nb: ['1 + (g^2 - 2)^2 + (h - g)^2']\n"


def test_single_irrational_points() -> None:
    """R(z) = (1 + z (b − 1/2))/(1 − z/2) is A-stable for |b − 1/2| ≤ 1/2 and b ≥ 1: for b = 1, so
    at (±√2, ±√2) with one sign, over which alone g is stable.
    """
    values = plane(IRRATIONAL)
    assert values.undecided == ()
    points = [(strip, part) for strip in values.strips for part in strip.parts]
    assert len(points) == 2
    for sign, (base, part) in zip((-1, 1), points, strict=True):
        assert base.is_point
        assert base.start is not None
        over = part.over(base.start)
        assert over is not None
        assert over.is_point
        assert base.start == over.start
        assert float(base.start) == pytest.approx(sign * 2**0.5)
    run = gark("design", "-", "--a-stable", stdin=IRRATIONAL)
    assert (run.code, "h = -sqrt(2)" in run.out, "h = sqrt(2)" in run.out) == (0, True, True)
    # the other sign of the factor is stable nowhere, at the points too
    none = plane(IRRATIONAL.replace("A: [[1/2]]", "A: [[1/4]]"))
    assert none.strips == none.undecided == ()


@pytest.mark.parametrize("text", [DIRK, pytest.param(SDIRK, marks=in_whole)])
@pytest.mark.parametrize(
    ("g", "p", "near"),
    [
        ("sqrt(2)/2", Polynomial([-1, 0, 2]), 0.7071067811865476),
        ("2 - sqrt(3)", Polynomial([1, -4, 1]), 0.2679491924311227),
        ("sqrt(2)", Polynomial([-2, 0, 1]), 1.4142135623730951),
    ],
)
def test_an_irrational_value_beside_a_free_parameter(
    text: str, g: str, p: Polynomial, near: float
) -> None:
    """With g set to a number the values of d are those of the plane over it, and single methods
    are as stable as they say.
    """
    line = stable_set(loads_family(text, settings={"g": g}), "a-stable")
    assert isinstance(line, StableValues)
    assert line.undecided == ()
    [root] = [x for x, _ in real_roots(p) if abs(float(x) - near) < 1e-9]
    values = plane(text)
    over = [x.over(root) for s in values.strips if has([s], root) for x in s.parts]
    assert list(line.found) == over
    for d in (fmpq(-1), fmpq(1, 8), fmpq(1, 2), fmpq(7, 5), fmpq(4)):
        method = loads(text, settings={"g": g, "d": str(d)})
        assert has(line.found, d) is is_a_stable(stability_function(method.tableau))


CIRCLE = """parameters: {g: free, d: free}
tableau:
  A:
    - [[["g"]], [["d"]]]
    - [[[0]], [[0]]]
  b: [["(g - 2)^2 + (d - 1)^2"], [1]]
"""


def test_a_curve_past_critical_values_of_degree_8() -> None:
    """The set is a branch of a curve: over critical values of a large degree limits are A-stable,
    and other points where curves meet the line are not.
    """
    values = plane(CIRCLE)
    assert values.undecided == ()
    [strip] = values.strips
    assert strip.start is not None
    assert strip.end is not None
    assert strip.start.exact == 1
    assert float(strip.end) == pytest.approx(4.95013386925)
    [part] = strip.parts
    assert part.start == part.end


def test_limits_beside_a_slice() -> None:
    """Limits of stable methods say all where one curve crosses a line once; where it touches the
    line, or two meet, only that they are stable if stability is closed.
    """
    touching, crossing = Polynomial([1, -2, 1]), Polynomial([-2, 1])
    limits = (Interval(RealRoot.rational(fmpq(1)), None, has_start=True),)
    members = Slice(loads_family(SDIRK), "method", (touching, crossing), limits)
    for t, known in ((0, False), (2, True), (3, True)):
        assert members.known(fmpq(t), is_closed=False) is known
    assert members.known(fmpq(1), is_closed=True) is True
    assert members.known(fmpq(1), is_closed=False) is None
    twice = Slice(loads_family(SDIRK), "method", (crossing, crossing * 3), limits)
    assert twice.known(fmpq(2), is_closed=False) is None
    lines = Slice(loads_family(SDIRK), "method", None, limits)
    assert [lines.known(fmpq(t), is_closed=True) for t in (0, 2)] == [None, True]


@in_whole
def test_curves_that_cross_at_irrational_points() -> None:
    """Where curves cross over an irrational g outside of the set, |R| > 1 is proved there, so that
    the strips beside it are one: no end of a strip is irrational here.
    """
    for text in sample([DIRK, STIFF, SDIRK], 3):
        ends = [x for strip in plane(text).strips for x in (strip.start, strip.end)]
        assert all(x is None or x.exact is not None for x in ends)


@in_whole
def test_the_picture() -> None:
    """Inside of the drawn areas are the values of the set, up to the breadth of a column; a single g
    is a line.
    """
    values = plane(DIRK)
    (panel,) = stable_plane_scene(values, "DIRK").panels
    kinds = [type(shape).__name__ for shape in panel.shapes]
    assert kinds == ["Area", "Area", "Curve", "Area"]
    area = panel.shapes[0]
    assert isinstance(area, Area)
    (loop,) = area.outlines(panel.x, panel.y)
    for g, d in loop:
        if d < panel.y.high:
            # (1 − g)/2 and (1 − g)/(2 − 4g)
            assert min(abs(d - (1 - g) / 2), abs(d - (1 - g) / (2 - 4 * g))) < 1e-6


@in_whole
def test_the_picture_in_a_file(tmp_path: Path) -> None:
    """``--plot`` writes it, and is refused where there is no plane."""
    file = str(tmp_path / "plane.svg")
    assert gark("design", "-", "--a-stable", "--plot", file, stdin=DIRK).code == 0
    assert "<svg" in Path(file).read_text(encoding="utf-8")
    for options, text in (
        (("--a-stable",), DIRK.replace("d: free", "d: 1/2")),
        (("--order", "2"), DIRK),
    ):
        run = gark("design", "-", *options, "--plot", file, stdin=text)
        assert run.code == 2
        assert "two parameters" in run.err
