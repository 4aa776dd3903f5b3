"""The stability region |R(z)| ≤ 1: of all colours alike, and of each alone with the others at 0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from garkcli.plots.plane import Window, modulus, window_of
from garkcli.stability.linear import StabilityFunction, stability_function
from garkcli.stability.summary import directions
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures.contours import Point, outlines
from garkcli.webpage.pictures.drawing import INSIDE, Frame, colour, dashes
from garkcli.webpage.pictures.elements import path_of
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.scales import linear_marks

if TYPE_CHECKING:
    from garkcli.arrays import Floats

_HEIGHT = 300
_NODES = 180
"""Nodes a side of the grid; even, so that none is on the imaginary axis of a symmetric one, where
|R| may be 1.
"""
MOST_CURVES = 4
_FLAT = 3.0
"""What logarithms are cut off at, near zeros and poles."""
_THINNED = 0.04  # cells
_MOST_ZOOMS = 6
_BLINDLY = 20
_MUCH = 2.5
"""How many times as large a window may be as what is around 0."""
_AROUND = 1.3
_TITLE = "Stability region"


def draw(method: GarkMethod) -> Picture:
    """The regions of one method, in one picture.

    Raises:
        NotDrawn: the linear test equation has no meaning for it.
    """
    found = directions(method.tableau)
    if not found:
        raise NotDrawn(
            "There is no stability function: colours drive positions or momenta only, or do not "
            "see one another."
        )
    names = []
    functions = []
    for name, shares in found[:MOST_CURVES]:
        R = stability_function(method.tableau, shares)
        functions.append(R)
        names.append(_label(name, len(found)))
    picture = drawn(names, functions)
    more = len(found) - len(names)
    if more == 0:
        return picture
    left_out = f" The regions of the last {more} colours alone are left out."
    return replace(picture, note=picture.note + left_out)


def drawn(names: Sequence[str], functions: Sequence[StabilityFunction]) -> Picture:
    """The regions of some stability functions, in one picture."""
    whole = window_of(functions, is_symmetric=False)
    window = _nearer(whole, functions)
    frame = frame_of(window)
    for k, R in enumerate(functions):
        draw_region(frame, window, R, k)
    if len(names) > 1:
        frame.legend.extend(enumerate(names))
    description = _description(names, window)
    labels = "Re z", "Im z"
    svg = finished(frame, window, _TITLE, description, labels)
    note = "Filled: |R(z)| ≤ 1."
    if window != whole:
        note += " Islands around zeros of R that are far away are not in the picture."
    return Picture("region", _TITLE, description, svg, note)


def _label(name: str, count: int) -> str:
    if count == 1:
        return "|R(z)| ≤ 1"
    return "all colours alike" if name == "all" else f"colour {name} alone"


def _nearer(window: Window, functions: Sequence[StabilityFunction]) -> Window:
    """A part of the window where the regions around 0 fill too little of it, for zeros of R that
    are far away.
    """
    for _ in range(_MOST_ZOOMS):
        reach = max(_reach(window, R) for R in functions)
        # nothing is seen of what is smaller than a cell
        top = _AROUND * reach or window.top / _BLINDLY
        if top > window.top / _MUCH:
            return window
        # both sides keep their share
        shrunk = top / window.top
        left = window.left * shrunk
        right = window.right * shrunk
        window = Window(left, right, top)
    return window


def _reach(window: Window, R: StabilityFunction) -> float:
    """How far from 0 the largest part of a region goes."""
    x = np.linspace(window.left, window.right, _NODES)
    y = np.linspace(-window.top, window.top, _NODES)
    loops = outlines(_level(R, x, y), _THINNED)
    largest = max(loops, key=_extent, default=[])
    points = [_in_plane(point, x, y) for point in largest]
    return max((hypot(a, b) for a, b in points), default=0.0)


def _extent(loop: Sequence[Point]) -> float:
    """From its left to its right end."""
    columns = [column for column, _ in loop]
    return max(columns) - min(columns)


def frame_of(window: Window) -> Frame:
    """A frame for a part of the plane, both scales alike."""
    across = window.right - window.left
    up = 2 * window.top
    unit = min(INSIDE / across, _HEIGHT / up)
    width = across * unit
    height = up * unit
    horizontal = window.left, window.right
    vertical = -window.top, window.top
    return Frame.of(horizontal, vertical, height, width)


def finished(
    frame: Frame, window: Window, title: str, description: str, labels: tuple[str, str]
) -> str:
    """The picture with both axes of the plane."""
    frame.line((window.left, 0.0), (window.right, 0.0))
    frame.line((0.0, -window.top), (0.0, window.top))
    across = linear_marks(window.left, window.right, 6)
    up = linear_marks(-window.top, window.top, 6)
    return frame.finished(title, description, (across, up), labels)


def draw_region(
    frame: Frame, window: Window, R: StabilityFunction, k: int, is_filled: bool = True
) -> None:
    """Where |R(z)| ≤ 1, as the k-th curve and what it surrounds."""
    x = np.linspace(window.left, window.right, _NODES)
    y = np.linspace(-window.top, window.top, _NODES)
    level = _level(R, x, y)
    data = ""
    for loop in outlines(level, _THINNED):
        points = [_in_plane(point, x, y) for point in loop]
        data += path_of(frame.place(points)) + "Z"
    if not data:
        return
    paint = colour(k)
    frame.path(
        data,
        style=f"fill:{paint};stroke:{paint}",
        fill_opacity="0.16" if is_filled else "0",
        fill_rule="evenodd",
        stroke_width=1.6,
        stroke_dasharray=dashes(k),
    )


def _level(R: StabilityFunction, x: Floats, y: Floats) -> Floats:
    """Log |R| at the nodes, cut off; poles are outside."""
    z = x[np.newaxis, :] + 1j * y[:, np.newaxis]
    size = modulus(R, z)
    with np.errstate(divide="ignore"):
        logarithm = np.log(size)
    level: Floats = np.clip(np.nan_to_num(logarithm, nan=_FLAT), -_FLAT, _FLAT)
    return level


def _in_plane(point: Point, x: Floats, y: Floats) -> Point:
    """From columns and rows to the complex plane."""
    column, row = point
    across = float(x[1] - x[0])
    up = float(y[1] - y[0])
    return float(x[0]) + column * across, float(y[0]) + row * up


def _description(names: Sequence[str], window: Window) -> str:
    where = (
        f"The complex plane from {window.left:.3g} to {window.right:.3g} and from "
        f"{-window.top:.3g} i to {window.top:.3g} i, filled where |R(z)| is at most 1"
    )
    if len(names) == 1:
        return f"{where}."
    return f"{where}, one outline each for: {', '.join(names)}."
