"""Panels in the signs of a terminal."""

from __future__ import annotations

from itertools import pairwise

import pytest
from flint import arb, fmpq

from garkcli import converge, find_stability
from garkcli.frozen import replace
from garkcli.page.plaintext import plain_text
from garkcli.plots.convergence import errors_scene
from garkcli.plots.regions import stability_scene
from garkcli.plots.scene import Axis, Curve, Panel, RuledLine, polygons
from garkcli.plots.terminal import COLUMNS, SEVERAL, drawn

LIMITS = Axis("x", 0.0, 6.0), Axis("y", 0.0, 6.0)


def cells(lines: list[str]) -> list[str]:
    """What is inside the frame, line by line."""
    end = next(k for k, line in enumerate(lines) if "└" in line)
    start = lines[end].index("└") + 1
    inside = [line[start:] for line in lines[:end] if line[start - 1 : start] in ("│", "┤")]
    return [line.ljust(len(lines[end]) - start) for line in inside]


def test_points_are_on_a_straight_line() -> None:
    """Points of error = h² rise from the lower left to the upper right, in equal steps."""
    result = converge("heun", steps=[fmpq(1, 10**k) for k in range(4)])
    rows = tuple(replace(row, error=arb(row.h) ** 2, energy_error=None) for row in result.rows)
    (panel,) = errors_scene([("heun", replace(result, rows=rows))]).panels
    at = [(i, line.index("•")) for i, line in enumerate(cells(drawn(panel))) if "•" in line]
    assert len(at) == 4
    gaps = [(b[0] - a[0], a[1] - b[1]) for a, b in pairwise(at)]
    assert max(x for x, _ in gaps) - min(x for x, _ in gaps) <= 1
    assert max(y for _, y in gaps) - min(y for _, y in gaps) <= 1


def test_errors_below_the_floats() -> None:
    """Errors that no float can hold are plotted all the same."""
    result = converge("heun", steps=[1, fmpq(1, 2), fmpq(1, 4)])
    rows = tuple(
        replace(row, error=arb(10) ** (-400 * k), energy_error=None)
        for k, row in enumerate(result.rows, start=1)
    )
    (panel,) = errors_scene([("heun", replace(result, rows=rows))]).panels
    lines = drawn(panel)
    assert panel.y.low < -1200
    assert sum(line.count("•") for line in cells(lines)) == 3


def test_letters_mark_their_points() -> None:
    """Points of two methods in one frame; where they fall together there is a sign for that. A
    name that is no letter has a sign in the legend.
    """
    one, two = ([(k, float(k)) for k in (1, 3, 5)], [(k, 6.0 - k) for k in (1, 3, 5)])
    curves = [Curve(k, points, "AB"[k], has_dots=True) for k, points in enumerate((one, two))]
    lines = drawn(Panel("", "", *LIMITS, curves))
    text = "".join(cells(lines))
    assert [text.count(x) for x in ("A", "B", SEVERAL)] == [2, 2, 1]
    assert lines[-1] == f"{SEVERAL} several"
    named = [replace(curve, label=name) for curve, name in zip(curves, ("one", "two"), strict=True)]
    lines = drawn(Panel("", "", *LIMITS, named))
    assert lines[-1] == "• one   ○ two"


def test_a_line_joins_its_points() -> None:
    """Every column between the ends of a line is drawn on, and what it passes upright."""
    line = Curve(0, [(0, 0), (3, 6), (3.1, 0), (6, 1)])
    inside = cells(drawn(Panel("", "", *LIMITS, [line])))
    assert all(any(x in "•│" for x in column) for column in zip(*inside, strict=True))
    assert max(sum(x == "│" for x in column) for column in zip(*inside, strict=True)) > 5


@pytest.mark.parametrize("factor", [1e-300, 1.0, 1e300])
@pytest.mark.parametrize("points", [[], [(0.0, 0.0)], [(0.0, 1.0), (0.0, -1.0)]])
def test_little_to_draw(points: list[tuple[float, float]], factor: float) -> None:
    """No point, one, no breadth, the ends of the floats, and terminals of a column."""
    scaled = [(x, y * factor) for x, y in points]
    y = Axis("y", -factor, factor)
    panel = Panel("", "", LIMITS[0], y, [Curve(0, scaled)])
    text = "\n".join([*drawn(panel), *drawn(panel, columns=1)])
    assert "nan" not in text
    assert "inf" not in text


def test_a_hole_stays_empty() -> None:
    """An area is filled between its outlines alone."""
    outer = [(0.5, 0.5), (5.5, 0.5), (5.5, 5.5), (0.5, 5.5)]
    hole = [(2.0, 2.0), (2.0, 4.0), (4.0, 4.0), (4.0, 2.0)]
    inside = cells(drawn(Panel("", "", *LIMITS, [polygons(0, [outer, hole], 1.0)])))
    middle = inside[len(inside) // 2]
    assert middle.split() == ["█" * len(x) for x in middle.split()]
    assert len(middle.split()) == 2


def test_cells_of_a_region_are_decided_one_by_one() -> None:
    """A sign is where |1 + z + z²/2 + z³/6 + z⁴/24| ≤ 1 at its place, which the axes tell."""
    (panel,) = stability_scene([("RK4", find_stability("rk4"))]).panels
    inside = cells(drawn(panel))
    last, width = len(inside) - 1, len(inside[0])
    for i, line in enumerate(inside):
        y = panel.y.high * (last - 2 * i) / last
        for j, sign in enumerate(line):
            z = complex(panel.x.low + (panel.x.high - panel.x.low) * j / (width - 1), y)
            R = 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24
            if sign != "│" and abs(abs(R) - 1) > 1e-6:
                assert (sign == "█") == (abs(R) < 1)


@pytest.mark.parametrize("columns", [38, COLUMNS])
@pytest.mark.parametrize("name", ["ark-ars222", "stoermer-verlet"])
def test_ascii_is_as_wide(name: str, columns: int) -> None:
    """Without other signs lines are as long at most, and their frames are below each other."""

    def spelt(text: str) -> str:
        return plain_text(text, "ascii")

    for panel in stability_scene([(name, find_stability(name))]).panels:
        lines = drawn(panel, spelt, columns)
        made = spelt("\n".join(lines)).splitlines()
        assert max(map(len, made)) <= columns
        assert len(cells(drawn(panel, columns=columns))) == len(cells(lines))
        for line, plain in zip(lines, made, strict=True):
            assert plain.isascii()
            assert line.find("┤") in (-1, plain.find("+"))


def test_signs_of_a_legend_differ_in_ascii() -> None:
    """A straight line is made of dots there too, not of the stars of the first curve."""

    def spelt(text: str) -> str:
        return plain_text(text, "ascii")

    axis = Axis("x", 0.0, 1.0)
    curves = [Curve(0, [(0, 0), (0.5, 1), (1, 0)], "first"), Curve(1, [(0, 0), (1, 1)], "line")]
    assert spelt(drawn(Panel("", "", axis, axis, curves), spelt)[-1]).split() == (
        ["*", "first", ".", "line"]
    )


def test_names_from_outside_are_harmless() -> None:
    """Controls in a name of a curve, a label of an axis and a note are written as text."""
    hostile = "\x1b[31m"
    axis = Axis(hostile, 0.0, 1.0)
    lines = drawn(Panel("", "", axis, axis, [Curve(0, [(0, 0)], hostile)], note=hostile))
    assert "\x1b" not in "".join(lines)
    assert "".join(lines).count("x1b[31m") == 4


def test_labels_of_rules_are_on_no_point() -> None:
    """The slope beside a line, where there is space for it."""
    rule = RuledLine((0, 0), (6, 6), "slope 1")
    dots = Curve(0, [(x / 4, 3.6) for x in range(24)], has_dots=True)
    text = "\n".join(drawn(Panel("", "", *LIMITS, [rule, dots])))
    assert "slope 1" in text
