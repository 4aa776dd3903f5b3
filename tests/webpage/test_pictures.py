"""The pictures of a method as SVG of our own."""

from __future__ import annotations

import html
import re
from itertools import pairwise
from math import hypot
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from garkcli import convert, from_arrays, load, loads
from garkcli.frozen import replace
from garkcli.plots.plane import Point, outlines
from garkcli.plots.scene import linear_marks, shortened
from garkcli.plots.svg import STYLE, colour
from garkcli.webpage.pictures import Picture, compared_pictures, pictures
from tests.whole import in_whole

MOST_CHARACTERS = 60_000
RK4 = [[0, 0, 0, 0], ["1/2", 0, 0, 0], [0, "1/2", 0, 0], [0, 0, 1, 0]]
WEIGHTS = ["1/6", "1/3", "1/3", "1/6"]
EULERS = "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [[1, 0], [0, 1]]}"
HOSTILE = '<script>alert("&")</script>'


def by_name(found: list[Picture]) -> dict[str, Picture]:
    """Pictures by their names."""
    return {picture.name: picture for picture in found}


@pytest.fixture(scope="module")
def of_rk4() -> dict[str, Picture]:
    """The pictures of the classical method, by name."""
    return by_name(pictures(from_arrays(RK4, WEIGHTS)))


@pytest.fixture(scope="module")
def of_coupled() -> dict[str, Picture]:
    """The pictures of the paper's collocation example."""
    method = load("methods/collocation.gark.yaml")
    return by_name(pictures(method))


def parsed(picture: Picture) -> ET.Element:
    """The picture as XML."""
    return ET.fromstring(picture.svg)


def is_inside(loops: list[list[Point]], x: float, y: float) -> bool:
    """Whether an odd number of the loops' sides lies to the right of a point."""
    crossings = 0
    for loop in loops:
        for (a, b), (c, d) in pairwise([*loop, loop[0]]):
            if (b > y) != (d > y):
                crossings += a + (c - a) * (y - b) / (d - b) > x
    return crossings % 2 == 1


@given(
    arrays(
        float,
        st.tuples(st.integers(2, 6), st.integers(2, 6)),
        elements=st.sampled_from([-1.0, -0.25, 0.25, 1.0]),
    )
)
def test_outlines_surround_what_is_inside(level: np.ndarray) -> None:
    """A node of any grid lies within the outlines exactly where its value is negative."""
    loops = outlines(level, tolerance=0.0)
    rows, columns = level.shape
    for i in range(rows):
        for j in range(columns):
            # a little beside the node: sides end on lines between nodes
            inside = is_inside(loops, j + 1e-6, i + 1e-6)
            assert inside == (level[i, j] < 0)


def test_thinned_outlines_stay_on_the_line() -> None:
    """The outline of a disc is its circle within the tolerance, with far fewer points."""
    x = np.arange(40.0) - 19.3
    level = np.hypot(x[np.newaxis, :], x[:, np.newaxis]) - 12.0
    (whole,) = outlines(level, tolerance=0.0)
    (loop,) = outlines(level, tolerance=0.1)
    assert len(loop) < len(whole) / 2
    far = [abs(hypot(a - 19.3, b - 19.3) - 12.0) for a, b in loop]
    assert max(far) < 0.15


def test_a_hole_is_an_outline_too() -> None:
    """A ring has two outlines; with the even-odd rule its middle stays empty."""
    x = np.arange(40.0) - 19.3
    radius = np.hypot(x[np.newaxis, :], x[:, np.newaxis])
    loops = outlines(np.abs(radius - 10.0) - 3.0, tolerance=0.05)
    assert len(loops) == 2
    assert not is_inside(loops, 19.3, 19.3)
    assert is_inside(loops, 29.3, 19.31)


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6), st.integers(3, 9))
def test_marks_are_round_and_few(low: float, width: float, most: int) -> None:
    """Marks lie between the ends, at most one more than asked for, and are evenly apart."""
    marks = linear_marks(low, low + width, most)
    assert len(marks) <= most + 1
    around = 1e-6 * (abs(low) + width)
    assert all(low - around <= x.at <= low + width + around for x in marks)


@in_whole
def test_pictures_stand_in_a_page(
    of_rk4: dict[str, Picture], of_coupled: dict[str, Picture]
) -> None:
    """Well-formed, small, named for a screen reader, without ids, addresses or fixed letters, in
    colours that the page may set.
    """
    drawn = [x for x in (*of_rk4.values(), *of_coupled.values()) if x.svg]
    names = [x.name for x in drawn]
    assert names == [
        "region",
        "convergence",
        "energy",
        "region",
        "oscillator",
        "convergence",
        "energy",
    ]
    for picture in drawn:
        svg = parsed(picture)
        assert svg.get("role") == "img"
        assert svg[0].tag == "title"
        assert svg[0].text == picture.title
        assert svg[1].text == picture.description
        assert picture.note.endswith(".")
        assert " id=" not in picture.svg
        assert "http" not in picture.svg
        assert "font-family" not in picture.svg
        assert "var(--picture-1," in picture.svg
        assert len(picture.svg) < MOST_CHARACTERS
    assert "--picture-4:" in STYLE


def test_the_same_method_gives_the_same_pictures(of_rk4: dict[str, Picture]) -> None:
    """Nothing is drawn by lot or by the clock."""
    again = pictures(from_arrays(RK4, WEIGHTS))
    assert again == list(of_rk4.values())


def test_the_outline_of_the_region_is_where_r_has_modulus_one(of_rk4: dict[str, Picture]) -> None:
    """Points of the outline, taken back through the marks of both axes, have |R(z)| = 1 for the
    polynomial that everybody knows.
    """
    svg = parsed(of_rk4["region"])
    nested = svg.find("svg")
    assert nested is not None
    unit, x0, y0 = _plane(svg)
    data = str(nested[0].get("d"))
    pairs = re.findall(r"(-?[\d.]+) (-?[\d.]+)", data)
    assert len(pairs) > 20
    for a, b in pairs:
        z = complex((float(a) - x0) / unit, (y0 - float(b)) / unit)
        R = 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24
        assert abs(abs(R) - 1) < 0.02


def _plane(svg: ET.Element) -> tuple[float, float, float]:
    """Units of the picture in 1, and where 0 is, from the marks below."""
    below = {}
    beside = {}
    for text in svg.findall("text"):
        label = str(text.text).replace("−", "-")
        if re.fullmatch(r"-?\d+", label):
            is_below = text.get("text-anchor") == "middle"
            where = below if is_below else beside
            axis = "x" if is_below else "y"
            where[int(label)] = float(str(text.get(axis)))
    unit = (below[0] - below[-2]) / 2
    assert beside[-2] - beside[0] == pytest.approx(2 * unit, abs=0.2)
    return unit, below[0], beside[0] - 4


def test_a_pole_at_a_rounding_of_zero_is_not_in_the_picture() -> None:
    region = by_name(pictures(loads("A: [[1e-25]]\nb: [1]\n")))["region"]
    assert "What R does far away" in region.note
    _, ends, _ = str(region.svg).partition("from -3.2 to 3.2")
    assert ends


def test_what_is_in_the_picture_is_not_said_to_be_missing() -> None:
    region = by_name(pictures(loads("A: [[0, 0], [2, 0]]\nb: [-1/2, 3/2]\n")))["region"]
    assert region.note == "Filled: |R(z)| ≤ 1."


def test_coefficients_beyond_floats_are_drawn() -> None:
    region = by_name(pictures(loads("A: [[0, 0], [1e200, 0]]\nb: [1, -1e300]\n")))["region"]
    assert "<svg" in str(region.svg)


@in_whole
@pytest.mark.parametrize("name", ["feagin-12", "feagin-14"])
def test_a_small_region_is_seen_from_near(name: str) -> None:
    """Feagin's methods have zeros of R up to a thousand times as far as their regions, which fill
    the picture all the same; that nothing else is drawn of so many rounded stages is said.
    """
    found = by_name(pictures(load(name)))
    region = found["region"]
    assert "What R does far away" in region.note
    nested = parsed(region).find("svg")
    assert nested is not None
    data = str(nested[0].get("d"))
    heights = [float(y) for y in re.findall(r" (-?[\d.]+)", data)]
    assert max(heights) - min(heights) > float(str(nested.get("height"))) / 3
    assert "oscillator" not in found
    assert "too many stages" in found["energy"].note


def test_dots_of_the_convergence_picture_have_the_slope(of_rk4: dict[str, Picture]) -> None:
    """Between the two smallest steps the error falls as the order says, by the scales of the
    marks.
    """
    svg = parsed(of_rk4["convergence"])
    marks = {str(x.text): x for x in svg.findall("text")}
    half = float(str(marks["1/8"].get("x"))) - float(str(marks["1/16"].get("x")))
    up = float(str(marks["10⁻¹²"].get("y"))) - float(str(marks["10⁻¹⁰"].get("y")))
    nested = svg.find("svg")
    assert nested is not None
    dots = nested.findall("circle")
    errors = [x for x in dots if "picture-1" in str(x.get("style"))]
    high, low = (float(str(x.get("cy"))) for x in errors[-2:])
    decades = (low - high) / (up / 2)
    assert decades / np.log10(2) == pytest.approx(4, abs=0.05)
    assert half > 0
    assert "Observed order 4.00, visible order 4" in of_rk4["convergence"].note


@in_whole
def test_what_is_put_to_work_does_not_depend_on_the_file(of_coupled: dict[str, Picture]) -> None:
    """Diagonal methods and their transfer rule step as the method that they make, which is not
    symplectic; its pair steps where the pair is given, and its energy does not drift.
    """
    assert "Numerical: the method on" in of_coupled["convergence"].note
    assert "Numerical: the method on" in of_coupled["energy"].note
    coupled = load("methods/collocation.gark.yaml")
    spelled_out = by_name(pictures(convert(coupled, "gark").method))
    assert spelled_out["energy"].svg == of_coupled["energy"].svg
    found = by_name(pictures(coupled.pair))
    assert "Numerical: the pair on" in found["convergence"].note
    assert "Numerical: the pair on" in found["energy"].note
    assert "bounded" in found["energy"].note
    assert "its drift" not in found["energy"].svg


def test_a_drift_is_drawn(of_rk4: dict[str, Picture]) -> None:
    """The classical method loses energy, and the picture has the line of it."""
    assert "DRIFTS, largest error" in of_rk4["energy"].note
    assert ">its drift, −" in of_rk4["energy"].svg


@in_whole
def test_an_implicit_explicit_pair_has_its_region() -> None:
    """What is filled of forward and backward Euler, R = (1 + z1)/(1 − z2), is the disc |1 + z1| ≤ 1:
    its area, but for the squares on the edge, and all of it on the left.
    """
    pair = by_name(pictures(loads(EULERS)))["pair"]
    assert "decided exactly" in pair.note
    svg = parsed(pair)
    nested = svg.find("svg")
    assert nested is not None
    unit, x0, _ = _plane(svg)
    area = 0.0
    (filled,) = [x for x in nested.findall("path") if x.get("fill-opacity") == "0.35"]
    for loop in str(filled.get("d")).removesuffix("Z").split("Z"):
        left, bottom, right, _, _, top, *_ = map(float, re.findall(r"-?[\d.]+", loop))
        area += (right - left) * (bottom - top) / unit**2
        assert right < x0 + 1
    assert area == pytest.approx(np.pi, rel=0.08)


def test_what_is_not_drawn_has_a_reason() -> None:
    """Large methods are not put to work, and a sentence says so."""
    stages = 41
    zeros = [[0] * stages for _ in range(stages)]
    weights = [1] + [0] * (stages - 1)
    found = by_name(pictures(from_arrays(zeros, weights)))
    assert found["region"].svg
    for name in ("convergence", "energy"):
        assert found[name].svg == ""
        assert "too many stages" in found[name].note


@in_whole
def test_names_from_files_are_text() -> None:
    """A name of a colour is no markup, and a long one is cut."""
    method = loads("ark: {A: [[[1/2]], [[1]]], b: [[1], [1]]}")
    first, second = method.tableau.colours
    colours = (replace(first, name=HOSTILE), second)
    tableau = replace(method.tableau, colours=colours)
    region = pictures(replace(method, tableau=tableau, name=HOSTILE))[0]
    labels = [x.text for x in parsed(region).findall("text")]
    assert any(HOSTILE in str(label) for label in labels)
    assert "<script" not in region.svg
    assert len(shortened("x" * 500, 46)) == 46
    assert shortened("a\x1b[0m", 46) == r"a\x1b[0m"


@in_whole
def test_circles_are_told_from_noise() -> None:
    """The region of a method with |R| = 1 on the whole imaginary axis has one straight side there:
    what rounding does on the axis is not seen.
    """
    gauss = loads("methods: [{family: gauss, stages: 2}]")
    region = pictures(gauss)[0]
    nested = parsed(region).find("svg")
    assert nested is not None
    assert str(nested[0].get("d")).count("M") == 1


@in_whole
def test_several_methods_are_in_one_picture() -> None:
    """Regions and errors of the first four, told apart by dashes and named; large methods and
    those without a region are left out, and one method alone has no picture with others.
    """
    names = ["forward-euler", "heun-3", "feagin-12", "stoermer-verlet"]
    methods = [load(name) for name in names]
    regions, errors = compared_pictures([*methods, methods[0]])
    assert "Of the first 4 methods." in errors.note
    assert ">Heun's method of order 3<" in html.unescape(regions.svg)
    assert ">Feagin 12<" in regions.svg
    assert "Verlet" not in regions.svg
    verlet = methods[3].name
    assert f"No stability function: {verlet}." in regions.note
    assert "Feagin" not in errors.svg
    assert "Verlet" in errors.svg
    dashed = errors.svg.count("stroke-dasharray")
    assert dashed == 2 * 2  # curves and legend, of all but the first
    assert compared_pictures(methods[:1]) == []


def lightness(colour: str) -> float:
    """The relative luminance of ``#rrggbb``, as WCAG 2 defines it."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("paper", ["#ffffff", "#111111", "#1e1e1e"])
def test_curves_are_seen_on_any_page(paper: str) -> None:
    """A page without our styles, such as a notebook, may be light or dark: the colours that curves
    then have differ from both by 3 to 1, as WCAG 2 asks of pictures.
    """
    found = {re.sub(r"^var\(--picture-\d,(.*)\)$", r"\1", colour(k)) for k in range(4)}
    assert len(found) == 4
    for one in found:
        low, high = sorted([lightness(one), lightness(paper)])
        assert (high + 0.05) / (low + 0.05) >= 3
