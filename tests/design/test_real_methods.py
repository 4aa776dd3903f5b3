"""Whether there are real methods, where there is none, and what the exit code says of it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import find_order, loads
from garkcli.design.critical import smooth_points
from garkcli.design.design import find_parameters
from garkcli.design.ideal import Ideal
from garkcli.exact.parametric import Parameters
from garkcli.methodfile.family import loads_family
from tests.cli.harness import gark
from tests.whole import at_most

TWO = "A: [[0, 0], [{}, 0]]\nb: [0, 1]\n"
FREE = "parameters: {{{}}}\n"


def family(entry: str, *names: str) -> str:
    """Two explicit stages; the node is an expression in some parameters."""
    parameters = ", ".join(x if ":" in x else f"{x}: free" for x in names)
    return f"parameters: {{{parameters}}}\n" + TWO.format(f'"{entry}"')


SURFACES = """parameters: {{x: free, y: free, z: free}}
tableau:
  A:
    - [[[1/2]], [[1/2]]]
    - [[[1/2]], [[1/2]]]
  b: [["1 + {}"], ["1 + {}"]]
"""


def reached(text: str, order: int) -> bool | None:
    """Whether real methods have an order."""
    return find_parameters(loads_family(text), order).reaches(order)


@pytest.mark.parametrize(
    ("text", "solutions"),
    [
        (family("1/2 + x**2 + y**2", "x", "y"), [{"x": 0, "y": 0}]),
        (family("1/2 + x**2 + (y - 3)**2 + (z - x)**4", "x", "y", "z"), [{"x": 0, "y": 3, "z": 0}]),
        (family("1/2 - (x**2 + y**2)*(x**2 + 1)", "x", "y"), [{"x": 0, "y": 0}]),
        (family("1/2 + (x - y)**2 + (y**2 - 2)**2", "x", "y"), None),
        (family("1/2 + x**4*y**2 + x**2*y**4 - 3*x**2*y**2 + 1", "x", "y"), None),
    ],
)
def test_real_points_of_complex_sets(text: str, solutions: list[dict[str, int]] | None) -> None:
    """Isolated real solutions of a complex family of a larger dimension, sums of squares and others:
    each has the order by the certificate, and no other value near has.
    """
    step = find_parameters(loads_family(text), 2).last
    assert step.ideal is not None
    assert (step.kind, step.has_methods) == ("family", True)
    assert step.ideal.dimension > 0
    assert step.known.within is not None
    assert step.known.within.ideal.dimension == 0
    found = [
        {name: values[name] for name in values}
        for one in step.found
        for values in one.solution.real_values
    ]
    assert all(one.order is not None and one.order.order == 2 for one in step.found)
    if solutions is not None:
        exact = [{name: x.exact for name, x in values.items()} for values in found]
        assert exact == solutions
    else:
        # y = x = ±√2; |x| = |y| = 1
        count = {2: 2, 1: 4}
        assert len(found) in count.values()


@pytest.mark.parametrize(
    "entry", ["3/2 + x**2 + y**2", "1 + x**4 + 2*y**2", "(x**2 + 1)*(y**2 + 1) + 1/2"]
)
def test_families_without_real_methods(entry: str, tmp_path: Path) -> None:
    """A complex family with no real value: exit code 1, also without --order for the first one."""
    path = tmp_path / "family.yaml"
    path.write_text(family(entry, "x", "y"), encoding="utf-8")
    run = gark("design", str(path), "--order", "2")
    assert (run.code, "none of them is real" in run.out) == (1, True)
    data = json.loads(gark("design", str(path), "--order", "2", "--format", "json").out)
    assert (data["verdict"], data["reached"], data["dimension"]) == ("family", False, 1)
    assert (data["real_ideal"], data["solutions"]) == (["1"], [])
    assert gark("design", str(path)).code == 0
    never = "parameters: {x: free, y: free}\nA: [[0]]\nb: [2 + x**2 + y**2]\n"
    path.write_text(never, encoding="utf-8")
    assert gark("design", str(path)).code == 1


def test_a_double_factor_is_no_other_set() -> None:
    """The zeros of (x − y)² are those of x − y, complex ones too: nothing is said of real ones
    apart.
    """
    step = find_parameters(loads_family(family("1/2 + (x - y)**2", "x", "y")), 2).last
    assert (step.kind, step.has_methods, step.known.within) == ("family", True, None)


RANGED = "{{free: true, range: [{}, {}]}}"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        # on a curve in the plane, also in a narrow window, at its end, and where there is none
        (family("1/2 + x*y - 1", "x", "y"), True),
        (family("x**2 + y**2 - 1/2", f"x: {RANGED.format('99/100', 2)}", "y"), True),
        (family("x**2 + y**2 - 1/2", f"x: {RANGED.format(1, 2)}", "y"), True),
        (family("x**2 + y**2 - 1/2", f"x: {RANGED.format('1001/1000', 2)}", "y"), False),
        (
            family("1/2 + 1/x - y", f"x: {RANGED.format(0, 2)}", f"y: {RANGED.format(0, '1/3')}"),
            False,
        ),
        (
            family("1/2 + 1/x - y", f"x: {RANGED.format(0, 3)}", f"y: {RANGED.format(0, '1/3')}"),
            True,
        ),
        # of one unknown, and of roots
        (family("1/2 + t", f"t: {RANGED.format(0, 1)}"), True),
        (family("1/2 + sqrt(t) + 1/10", "t"), False),
        (family("1/2 + sqrt(t)", "t"), True),
        (family("1/2 + x**2 - y**3 + z", "x", "y", "z"), True),
    ],
)
def test_real_methods_of_families(text: str, expected: bool | None) -> None:
    """Cells of the line and of the plane decide; in several unknowns a method is found."""
    assert reached(text, 2) is expected


@pytest.mark.parametrize("least", ["29999/10000", "30001/10000"])
def test_what_is_not_decided(least: str, tmp_path: Path) -> None:
    """Of x³ + y³ + z³ = 2.9999 in the unit cube there are points in a corner alone, of 3.0001 none:
    neither is found out, the report says so, and the exit code is 3.
    """
    path = tmp_path / "family.yaml"
    cube = (f"{x}: {RANGED.format(0, 1)}" for x in "xyz")
    path.write_text(family(f"1/2 + x**3 + y**3 + z**3 - {least}", *cube), encoding="utf-8")
    run = gark("design", str(path), "--order", "2")
    said = "whether a real value of them is a method that the file admits is not decided"
    assert (run.code, said in " ".join(run.out.split())) == (3, True)
    data = json.loads(gark("design", str(path), "--order", "2", "--format", "json").out)
    assert data["reached"] is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('parameters: {t: free}\nA: [[0, 0], ["1/(2*t)", 0]]\nb: [1 - t, t]\n', "t ≠ 0"),
        (
            'parameters: {t: free}\nA: [[0, 0], ["1/(2*sqrt(t))", 0]]\nb: ["1 - sqrt(t)", "sqrt(t)"]\n',
            "sqrt(t) ≠ 0 and sqrt(t) is real",
        ),
        (
            'parameters: {t: {free: true, range: [1/4, 1]}}\nA: [[0, 0], ["1/(2*t)", 0]]\nb: [1 - t, t]\n',
            "1/4 ≤ t ≤ 1",
        ),
        ('parameters: {t: free}\nA: [[0, 0], ["t/t/2", 0]]\nb: [0, 1]\n', "t ≠ 0"),
        ('parameters: {t: free}\nA: [[0, 0], ["(t**2 + 1)/(t**2 + 1)/2", 0]]\nb: [0, 1]\n', ""),
        (
            "parameters: {t: free}\nA: [[0, 0], [1/2, 0]]\nb: [0, 1]\nc: [0, t]\n"
            "design: {nodes-in-unit-interval: true}\n",
            "0 ≤ t ≤ 1",
        ),
    ],
)
def test_every_value_names_its_exceptions(text: str, said: str, tmp_path: Path) -> None:
    """Where a denominator vanishes, a root is not real, outside of a range or of what is wanted."""
    path = tmp_path / "family.yaml"
    path.write_text(text, encoding="utf-8")
    run = gark("design", str(path), "--order", "2")
    assert run.code == 0
    line = next(x for x in run.out.splitlines() if x.startswith("  order 1") and "every" in x)
    assert line.endswith(f"every value where {said}" if said else "every value")


def test_every_value_of_none() -> None:
    """A range of one number that is no method: conditions hold for every value, and there is none."""
    text = 'parameters: {t: {free: true, range: [0, 0]}}\nA: [[0, 0], ["t/t/2", 0]]\nb: [0, 1]\n'
    found = find_parameters(loads_family(text), 2)
    assert (found.last.kind, found.reaches(2)) == ("every-value", False)


def test_roots_may_be_zero() -> None:
    """√t at t = 0 is a method, as ``gark check`` says, and a solution."""
    text = family("1/2 + sqrt(t)", "t")
    [one] = find_parameters(loads_family(text), 2).last.found
    assert one.accepted == (0,)
    assert find_order(loads(text, settings={"t": "0"})).order == 2


def test_exit_codes(tmp_path: Path) -> None:
    """0 a method is found, 1 there is none, 3 it is not decided."""
    path = tmp_path / "family.yaml"
    cases = [
        (family("t", "t"), ["--order", "2"], 0),
        (family("t**2 + 1", "t"), ["--order", "2"], 1),
        (family("t", f"t: {RANGED.format(0, '1/4')}"), ["--order", "2"], 1),
        (family("t", "t"), ["--order", "3"], 1),
        ("parameters: {t: free}\nA: [[0]]\nb: [t**2 + 2]\n", [], 1),
        ("unknown: {stages: 6, shape: full}\n", ["--order", "9", "--seconds", "0.05"], 3),
        # the field of the solutions is too large for their stability
        (
            'parameters: {t: free}\nA: [["t", 0], [0, "t"]]\nb: ["t**7 - t - 1/2", 1/2]\n',
            ["--order", "1", "--a-stable"],
            3,
        ),
    ]
    for text, options, code in cases:
        path.write_text(text, encoding="utf-8")
        run = gark("design", str(path), *options)
        assert run.code == code, (text, run.out, run.err)


@pytest.mark.parametrize(
    ("first", "second", "squares"),
    [
        ("x**2 + y**2 + z**2 - 1", "(x + y + z)**2 - 3", (1 / 3, 1 / 3, 1 / 3)),
        ("x**2 + 2*y**2 + 3*z**2 - 1", "(x + 2*y + 3*z)**2 - 6", (1 / 6, 1 / 6, 1 / 6)),
        ("x**2 + 4*y**2 + z**2 - 1", "(x - 2*y + z)**2 - 3", (1 / 3, 1 / 12, 1 / 3)),
    ],
)
def test_planes_that_touch(first: str, second: str, squares: tuple[float, ...]) -> None:
    """Two planes touch an ellipsoid: of the curve in which they meet it two points are real, at
    which the gradients are dependent.
    """
    step = find_parameters(loads_family(SURFACES.format(first, second)), 1).last
    assert (step.kind, step.has_methods) == ("family", True)
    assert step.known.within is not None
    assert step.known.within.ideal.dimension == 0
    points = [x for one in step.found for x in one.solution.real_values]
    assert len(points) == 2
    for point in points:
        assert [float(point[x]) ** 2 for x in "xyz"] == pytest.approx(list(squares))


def test_planes_that_miss() -> None:
    """A plane further off meets the ellipsoid in no real point, one nearer in some."""
    for square, is_met in ((7, False), (5, True)):
        plane = f"(x + 2*y + 3*z)**2 - {square}"
        assert reached(SURFACES.format("x**2 + 2*y**2 + 3*z**2 - 1", plane), 1) is is_met


def test_a_small_surface_is_met_by_critical_points() -> None:
    """A sphere of radius 1/1000 that no short rational value meets has a point nearest to another;
    a denominator or a sign that is wanted may exclude it.
    """
    sphere = "(x - 5/7)**2 + (y - 3/11)**2 + (z - 2/13)**2 - 1/1000000"
    assert reached(family(f"1/2 + {sphere}", "x", "y", "z"), 2) is True
    far = family(f"1/2 + {sphere}", "x", "y", "z: {free: true, range: [1, 2]}")
    assert reached(far, 2) is None


def test_sets_without_as_many_generators_as_their_codimension() -> None:
    """A component of a smaller dimension would be missed, so nothing is told of a complex curve with
    the real point (1, 0, 0) beside it, nor of the cone over the twisted cubic; a circle has a point
    that is nearest to another one, and one that is furthest away.
    """
    ring = Parameters(["x", "y", "z", "w"])
    x, y, z, w = ring.context.gens()
    beside = Ideal(ring).with_zeros([x * y, x * z, (x - 1) * (y * y + z * z + 1), w])
    assert smooth_points(beside) is None
    cone = Ideal(ring).with_zeros([x * z - y * y, y * w - z * z, x * w - y * z])
    assert smooth_points(cone) is None
    assert smooth_points(Ideal(ring, [x])) is None
    found = smooth_points(Ideal(ring).with_zeros([x * x + y * y - 2, z, w]))
    assert found is not None
    assert sum(len(point.real) for point in found.points) == 2


@pytest.mark.parametrize(
    ("curve", "beyond", "has_methods"),
    [
        ("x**2 - 2", None, True),
        ("y**2 - 1000001", True, True),
        ("x*y - 3", None, True),
        ("(x**2 - 2)*(x**2 + y**2 + 1)", None, True),
        ("x**2 + y**2 + 1", False, False),
    ],
)
def test_methods_where_no_sample_is(
    curve: str, beyond: bool | None, has_methods: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Weights are positive for 1000 < y < 1001 alone, far from every sample: points between critical
    values of y or x decide. Beyond the limit of degrees a curve without a sample is undecided.
    """
    family = loads_family(
        "parameters: {x: free, y: free}\nA: [[0, 0], [0, 0]]\n"
        f'b: [y - 1000, "1001 - y + {curve}"]\ndesign: {{positive-weights: true}}'
    )
    assert find_parameters(family, 1).last.has_methods is has_methods
    monkeypatch.setattr("garkcli.design.real_points.MOST_DEGREE", 1)
    assert find_parameters(family, 1).last.has_methods is beyond


BOX = [k / 24 for k in range(25)]
TERMS = st.dictionaries(
    st.tuples(st.integers(0, 3), st.integers(0, 2)), st.integers(-4, 4), min_size=1, max_size=5
)


@given(TERMS, st.booleans())
@settings(max_examples=at_most(12, 150))
def test_random_curves_in_a_box(terms: dict[tuple[int, int], int], is_open: bool) -> None:
    """A curve p(x, y) = 0 meets the unit square, with or without the edges x = 0 and x = 1, if p has
    both signs inside; it does not if |p| is larger everywhere than its slopes allow.
    """
    p = " + ".join(f"({a})*x**{i}*y**{j}" for (i, j), a in terms.items()) + " + 1/7"
    names = "{x: {free: true, range: [0, 1]}, y: {free: true, range: [0, 1]}}"
    text = f"parameters: {names}\nA: [[0, 0], [0, 0]]\nb: [x, '1 - x + {p}']\n"
    text += "design: {positive-weights: true}\n" if is_open else ""
    found = find_parameters(loads_family(text), 1).last.has_methods
    values = {
        (x, y): sum(a * x**i * y**j for (i, j), a in terms.items()) + 1 / 7
        for x in BOX
        for y in BOX
    }
    inside = [value for (x, _), value in values.items() if 0 < x < 1]
    slope = sum(abs(a) * (i + j) for (i, j), a in terms.items()) / 24
    if min(inside) < 0 < max(inside):
        assert found is True
    elif min(map(abs, values.values())) > slope:
        assert found is False
