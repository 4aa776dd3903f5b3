"""The set of two parameters for which a family is stable, as a picture."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.design.stable_plane import End, Part, StablePlane, Strip
from garkcli.exact.cells import between
from garkcli.exact.roots import RealRoot
from garkcli.plots.scene import Axis, Curve, Panel, Point, Scene, Shape, polygons

_COLUMNS = 120
"""The number of values of the first parameter at which a strip is drawn."""


def stable_plane_scene(values: StablePlane, title: str) -> Scene:
    """Returns the set near the ends of its strips."""
    x_name, y_name = values.family.ring.names
    ends = [x for strip in values.strips for x in (strip.base.start, strip.base.end)]
    x = Axis.around(x_name, _widened([float(end) for end in ends if end is not None]))
    heights = [
        float(end)
        for strip in values.strips
        if not strip.base.is_point
        for part in strip.parts
        for over in [part.over(RealRoot.rational(between(strip.base.start, strip.base.end)))]
        if over is not None
        for end in (over.start, over.end)
        if end is not None
    ]
    y = Axis.around(y_name, _widened(heights))
    shapes = [_shape(strip, part, x, y) for strip in values.strips for part in strip.parts]
    panel = Panel(
        "A-stability",
        f"The values of {x_name} and {y_name} for which the method is A-stable.",
        x,
        y,
        shapes,
        height=260,
        has_grid=True,
    )
    return Scene(f"A-stable methods of {title}", [panel])


def _widened(numbers: Sequence[float]) -> list[float]:
    found = [*numbers] or [0.0]
    return [min(found) - 1, max(found) + 1]


def _shape(strip: Strip, part: Part, x: Axis, y: Axis) -> Shape:
    """Returns a part over a strip: a region, or a line over a single value."""
    base = strip.base
    if base.is_point:
        assert base.start is not None
        at = float(base.start)
        low, high = (_within(end, y, k) for k, end in enumerate((part.start, part.end)))
        return Curve(0, [(at, low), (at, high)])
    left = x.low if base.start is None else max(x.low, float(base.start))
    right = x.high if base.end is None else min(x.high, float(base.end))
    # beside the ends, where branches may leave
    places = [left + (right - left) * (k + 0.5) / _COLUMNS for k in range(_COLUMNS)]
    lower: list[Point] = []
    upper: list[Point] = []
    for place in places:
        over = part.over(RealRoot.rational(fmpq(round(place * 2**30), 2**30)))
        if over is not None:
            lower.append((place, _within(over.start, y, 0)))
            upper.append((place, _within(over.end, y, 1)))
    if part.start is not None and part.start == part.end:
        return Curve(0, lower)
    return polygons(0, [[*lower, *reversed(upper)]], 0.25, has_outline=False)


def _within(end: End, y: Axis, which: int) -> float:
    """Returns an end within the picture; the lower or upper edge if it is infinite."""
    if not isinstance(end, RealRoot):
        return (y.low, y.high)[which]
    return min(max(float(end), y.low), y.high)
