"""Scenes, and that all outputs draw the whole of them."""

from __future__ import annotations

from math import exp
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from flint import fmpq
from matplotlib.backends.backend_agg import FigureCanvasAgg

from garkcli import converge, find_stability, load, long_run
from garkcli.frozen import replace
from garkcli.plots import terminal
from garkcli.plots.convergence import errors_scene
from garkcli.plots.curves import energy_scene
from garkcli.plots.figure import figure
from garkcli.plots.regions import of_directions, region_of, springs_panel, stability_scene
from garkcli.plots.scene import (
    Area,
    Axis,
    Curve,
    Panel,
    RuledLine,
    Scene,
    common_exponent,
    polygons,
)
from garkcli.plots.svg import svg
from garkcli.stability.springs_plane import SpringsPlane
from tests.whole import in_whole


def stability_of(*names: str, is_order_star: bool = False) -> Scene:
    """The scene of the stability of some methods."""
    return stability_scene([(name, find_stability(name)) for name in names], is_order_star)


def scenes() -> list[Scene]:
    """A scene of each kind that results have."""
    rk4, euler = converge("rk4"), converge("forward-euler")
    side = [k / 4 for k in range(9)]
    return [
        errors_scene([("RK4", rk4)]),
        errors_scene([("RK4", rk4), ("Euler", euler)]),
        energy_scene(long_run("rk4", "kepler", 100, "1/16")),
        stability_of("forward-euler", "rk4"),
        stability_of("ark-ars222"),
        stability_of("gauss-3", is_order_star=True),
        stability_of("stoermer-verlet"),
        stability_of("stoermer-verlet", "forest-ruth"),
        Scene(
            "springs",
            [springs_panel(SpringsPlane(side, side, [[a * b for b in side] for a in side]))],
        ),
    ]


@in_whole
def test_all_outputs_draw_all_of_a_scene() -> None:
    """Each panel has its labels, its limits, the names of its legend and the slopes beside lines,
    in a terminal, as a figure and as SVG, which have one path or line for each shape.
    """
    for scene in scenes():
        axes = figure(scene).axes
        for panel, drawn in zip(scene.panels, axes, strict=True):
            root = ET.fromstring(svg(panel))
            texts = [str(x.text) for x in root.iter("text")]
            names = [x.label for x in panel.legend]
            slopes = [x.label for x in panel.shapes if isinstance(x, RuledLine) and x.label]
            assert {panel.x.label, panel.y.label, *names, *slopes} <= {*texts}
            lines = "\n".join(terminal.drawn(panel))
            assert all(x in lines for x in (panel.x.label, panel.y.label, *names, *slopes))
            limits = [x for axis in (panel.x, panel.y) for x in (axis.low, axis.high)]
            assert [*drawn.get_xlim(), *drawn.get_ylim()] == limits
            legend = drawn.get_legend()
            assert names == ([] if legend is None else [x.get_text() for x in legend.get_texts()])
            assert slopes == [x.get_text() for x in drawn.texts]
            assert drawn.get_ylabel() == panel.y.label
            if scene.is_row or panel is scene.panels[-1]:
                assert drawn.get_xlabel() == panel.x.label
            areas = [
                x for x in panel.shapes if isinstance(x, Area) and x.outlines(panel.x, panel.y)
            ]
            nested = root.find("svg")
            assert nested is not None
            assert len(nested.findall("path")) == len(panel.shapes)
            assert len(drawn.get_lines()) == len(panel.shapes) - len(areas)
            assert len(drawn.patches) == sum(1 + x.has_outline for x in areas)
            assert panel.description.endswith(".")


def test_the_outline_of_an_order_star() -> None:
    """Where |R(z)| = |e^z|, out to the ends of its petals."""
    (panel,) = stability_of("gauss-3", is_order_star=True).panels
    area = panel.legend or [x for x in panel.shapes if isinstance(x, Area)]
    assert isinstance(area[0], Area)
    on_edge = 0
    reach = 0.0
    for x, y in (point for loop in area[0].outlines(panel.x, panel.y) for point in loop):
        if x <= panel.x.low + 0.1 or abs(y) >= panel.y.high - 0.1:
            continue  # the edge of the picture
        z = complex(x, y)
        P = 1 + z / 2 + z**2 / 10 + z**3 / 120
        Q = 1 - z / 2 + z**2 / 10 - z**3 / 120
        assert abs(P / Q) / exp(x) == pytest.approx(1, abs=0.02)
        on_edge += 1
        reach = max(reach, x)
    assert on_edge > 50
    assert reach > 4


def test_holes_are_left_out() -> None:
    """A patch of a figure keeps the hole of an area, whose outline turns the other way."""
    outer = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)]
    hole = [(1.0, 1.0), (1.0, 2.0), (2.0, 2.0), (2.0, 1.0)]
    axis = Axis("x", 0.0, 3.0)
    panel = Panel("t", "d.", axis, axis, [polygons(None, [outer, hole], 1.0, has_outline=False)])
    drawn = figure(Scene("", [panel]))
    canvas = FigureCanvasAgg(drawn)
    canvas.draw()
    (axes,) = drawn.axes
    pixels = np.asarray(canvas.buffer_rgba())
    height = len(pixels)

    def shade(x: float, y: float) -> int:
        column, row = axes.transData.transform((x, y))
        return int(pixels[height - 1 - int(row), int(column), 0])

    assert shade(0.5, 1.5) < 100
    assert shade(1.5, 1.5) > 200


def test_little_to_draw() -> None:
    """A curve without points, an area without outlines, points without lines: elements are
    well-formed and have no path without data.
    """
    axis = Axis("x", 0.0, 1.0)
    shapes = [
        Curve(0, []),
        polygons(1, [], 0.5),
        Curve(2, [(0.5, 0.5)], "dot", True, has_line=False),
    ]
    panel = Panel("t", "d.", axis, axis, shapes)
    root = ET.fromstring(svg(panel))
    assert all("0" in str(x.get("d")) for x in root.iter("path"))
    assert len(list(root.iter("circle"))) == 2  # the point, and its entry in the legend
    assert len(figure(Scene("", [panel])).axes) == 1


def test_errors_that_are_no_numbers_or_hardly_any() -> None:
    """A run that has blown up at once, and errors at the lower end of the floats, have a panel."""
    run = long_run("rk4", "kepler", 100, "1/16")
    first = run.invariants[0]
    for errors in ([float("inf")] * len(first.errors), [5e-324] * len(first.errors)):
        history = replace(
            first, errors=tuple(errors), max_error=errors[0], drift=None, verdict="unstable"
        )
        scene = energy_scene(replace(run, invariants=(history,)))
        assert len(figure(scene).axes) == 1
        assert "UNSTABLE" in scene.panels[0].description
    assert common_exponent([5e-324]) == -290


def test_steps_of_a_run_are_exact_marks() -> None:
    """What is below an axis of step sizes are these, at their logarithms."""
    result = converge("rk4", steps=[fmpq(1, 3), fmpq(1, 9)])
    (panel,) = errors_scene([("RK4", result)]).panels
    assert [mark.label for mark in panel.x.marks(6)] == ["1/3", "1/9"]


def test_a_region_without_outline_has_a_patch_in_the_legend() -> None:
    """Of the stable z of an explicit part, in both outputs; curves have their line there."""
    scene = stability_of("ars-343")
    panel = scene.panels[-1]
    kinds = [isinstance(x, Area) and not x.has_outline for x in panel.legend]
    assert kinds == [True, False]
    (*_, axes) = figure(scene).axes
    legend = axes.get_legend()
    assert legend is not None
    assert [type(x).__name__ for x in legend.legend_handles] == ["Rectangle", "Line2D"]
    patches = [x for x in ET.fromstring(svg(panel)).iter() if x.tag.endswith("rect")]
    assert sum(x.get("height") == "10" for x in patches) == 1


def test_parts_of_an_implicit_explicit_method_have_their_names() -> None:
    """In the picture of ``stability``, and in that of a method file."""
    (panel, _) = stability_of("ars-343").panels
    method = load("ars-343")
    alone = region_of(method.tableau, method.tolerance)
    assert alone is not None
    wanted = ["one λ for both parts", "explicit part", "implicit part"]
    for drawn in (panel, alone):
        assert [x.label for x in drawn.shapes if isinstance(x, Area)] == wanted
    R = find_stability("rk4").linear[0].R
    assert [label for label, _ in of_directions([("all", R), ("1", R), ("2", R)])] == [
        "all colours alike",
        "colour 1 alone",
        "colour 2 alone",
    ]
