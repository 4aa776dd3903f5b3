"""Optima of a search along a curve, as a picture."""

from __future__ import annotations

from math import log10

from garkcli.design.search.curve import Curve as Optima
from garkcli.errors import MethodError
from garkcli.plots.scene import Axis, Curve, Panel, Scene

FACTOR = 20.0
"""An axis is logarithmic if its largest number is more than this times the smallest."""

NOTHING = 1e-6
"""It is not if the smallest is a smaller part of the largest: rounding in place of zero."""


def curve_scene(optima: Optima, title: str) -> Scene:
    """The knots, and lines between them.

    Raises:
        MethodError: there is none.
    """
    knots = optima.knots
    if not knots:
        raise MethodError("there is nothing to draw", "try more starts", code="arrays")
    across, is_log_across = _coordinates([x.across for x in knots])
    up, is_log_up = _coordinates([x.up for x in knots])
    points = list(zip(across, up, strict=True))
    what = f"{optima.up} against {optima.across}"
    panel = Panel(
        "Pareto front" if optima.is_front else "Optima",
        f"{what}: the best of {optima.starts} starts, in floats.",
        Axis.around(optima.across, across, is_log_across),
        Axis.around(optima.up, up, is_log_up),
        [Curve(0, points, what, has_dots=True)],
        height=240,
        has_grid=True,
    )
    return Scene(title, [panel])


def _coordinates(numbers: list[float]) -> tuple[list[float], bool]:
    least, greatest = min(numbers), max(numbers)
    is_logarithmic = greatest > FACTOR * least and least > NOTHING * greatest
    return [log10(x) for x in numbers] if is_logarithmic else numbers, is_logarithmic
