"""The trace of the step matrix on the harmonic oscillator, and where it is stable."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from garkcli.exact.roots import RealRoot
from garkcli.plots.plane import values
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.summary import directions, usual_oscillator
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures.drawing import Frame
from garkcli.webpage.pictures.elements import Point
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.scales import linear_marks

_HEIGHT = 200
_POINTS = 360
_HIGHEST = 2.0
_WITHOUT_END = 8.0
"""How far z goes where all of it is stable."""
_TITLE = "Oscillator"
_ROUNDED = "With rounded coefficients nothing is decided about the oscillator."
_NO_SPLIT = "The method has no split for the oscillator."
_NO_AREAS = "The steps on the oscillator do not keep areas: the trace alone does not decide."


def draw(method: GarkMethod) -> Picture:
    """|tr M|/2 over z = hω of one method.

    Raises:
        NotDrawn: it has no split for the oscillator, or its steps do not keep areas, so that the
            trace alone does not decide; or its coefficients are rounded.
    """
    if method.tolerance is not None:
        raise NotDrawn(_unless_linear(method, _ROUNDED))
    found = usual_oscillator(method.tableau)
    if found is None:
        raise NotDrawn(_unless_linear(method, _NO_SPLIT))
    if not found.determinant.is_one:
        raise NotDrawn(_unless_linear(method, _NO_AREAS))
    ends = _ends(found)
    highest = [high for _, high in ends if high]
    end = 1.25 * max(highest, default=_WITHOUT_END)
    frame = Frame.of((0.0, end), (0.0, _HIGHEST), _HEIGHT)
    for low, high in ends:
        until = end if high is None else high
        _shade(frame, low, until)
    for part in _parts(found, end):
        frame.curve(0, part, 1.6)
    frame.line((0.0, 1.0), (end, 1.0))
    description = _description(ends)
    marks = linear_marks(0.0, end, 6), linear_marks(0.0, _HIGHEST, 4)
    labels = "z = hω", "|tr M(z)| / 2"
    svg = frame.finished(_TITLE, description, marks, labels)
    note = "The step matrix M on q̈ = −ω²q; shaded where it is stable."
    return Picture("oscillator", _TITLE, description, svg, note)


def _unless_linear(method: GarkMethod, why: str) -> str:
    """Why it is not drawn; empty where the region tells what there is to tell."""
    is_linear = bool(directions(method.tableau))
    return "" if is_linear else why


def _ends(found: OscillatorStability) -> list[tuple[float, float | None]]:
    """The stable z, as intervals; None where there is no end."""
    intervals = []
    for interval in found.stable:
        low = 0.0
        high = None
        if interval.start is not None:
            low = _root(interval.start)
        if interval.end is not None:
            high = _root(interval.end)
        intervals.append((low, high))
    return intervals


def _root(x: RealRoot) -> float:
    """The z of x = z²."""
    square = float(x.ball(64))
    z: float = square**0.5
    return z


def _shade(frame: Frame, low: float, high: float) -> None:
    frame.rectangle((low, 0.0), (high, _HIGHEST), fill_opacity="0.12")


def _parts(found: OscillatorStability, end: float) -> list[list[Point]]:
    """The curve where it is in the frame or just above, cut where it leaves."""
    z = np.linspace(0.0, end, _POINTS)
    x = z**2
    with np.errstate(divide="ignore", invalid="ignore"):
        trace = values(found.trace.numerator, x)
        trace = trace / values(found.trace.denominator, x)
    half = np.nan_to_num(np.abs(trace) / 2, nan=np.inf)
    # a point above the frame is where a line to it leaves the frame
    heights = np.minimum(half, 2 * _HIGHEST).tolist()
    parts: list[list[Point]] = [[]]
    points = zip(z.tolist(), heights, strict=True)
    for here, there in pairwise(points):
        lower = min(here[1], there[1])
        if lower > _HIGHEST:
            parts.append([])
            continue
        last = parts[-1]
        if not last:
            last.append(here)
        last.append(there)
    return [part for part in parts if part]


def _description(ends: list[tuple[float, float | None]]) -> str:
    spans = []
    for low, high in ends:
        until = "on" if high is None else f"to {high:.4g}"
        spans.append(f"from {low:.4g} {until}")
    where = ", ".join(spans) or "nowhere"
    return f"Half the modulus of the trace over z; stable {where}."
