"""The stability of oscillators: the trace over z, the plane of two springs."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from garkcli.exact.roots import RealRoot
from garkcli.plots.plane import outlined, values
from garkcli.plots.scene import Area, Axis, Curve, Panel, Point, Rule, Shape
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.springs_plane import SpringsPlane

_POINTS = 600
_HIGHEST = 2.0
_WITHOUT_END = 8.0
"""How far z goes where all of it is stable."""


def trace_panel(named: Sequence[tuple[str, OscillatorStability]]) -> Panel:
    """|tr M|/2 over z = hω, with the stable step sizes shaded where there is one method."""
    spans = [_stable(oscillator) for _, oscillator in named]
    highest = [high for found in spans for _, high in found if high]
    end = 1.25 * max(highest, default=_WITHOUT_END)
    shapes: list[Shape] = []
    if len(named) == 1:
        bands = [(low, end if high is None else high) for low, high in spans[0]]
        loops = [[(a, 0.0), (b, 0.0), (b, _HIGHEST), (a, _HIGHEST)] for a, b in bands]
        shapes.append(Area(None, loops, 0.12, has_outline=False))
    for style, (name, oscillator) in enumerate(named):
        label = name if len(named) > 1 else ""
        for part in _parts(oscillator, end):
            shapes.append(Curve(style, part, label))
            label = ""
    shapes.append(Rule((0.0, 1.0), (end, 1.0)))
    names = "; ".join(name for name, _ in named)
    about = f"of {names}" if len(named) > 1 else _spans_text(spans[0])
    return Panel(
        "Oscillator",
        f"Half the modulus of the trace over z; {about}.",
        Axis("z = hω", 0.0, end),
        Axis("|tr M(z)| / 2", 0.0, _HIGHEST),
        shapes,
        "The step matrix M on q̈ = −ω²q"
        + ("; shaded where it is stable." if len(named) == 1 else "."),
    )


def _stable(oscillator: OscillatorStability) -> list[tuple[float, float | None]]:
    """The stable z, as intervals; None where there is no end."""
    return [
        (0.0 if x.start is None else _root(x.start), None if x.end is None else _root(x.end))
        for x in oscillator.stable
    ]


def _root(x: RealRoot) -> float:
    """The z of x = z²."""
    z: float = float(x.ball(64)) ** 0.5
    return z


def _spans_text(spans: Sequence[tuple[float, float | None]]) -> str:
    written = [
        f"from {low:.4g} " + ("on" if high is None else f"to {high:.4g}") for low, high in spans
    ]
    return f"stable {', '.join(written) or 'nowhere'}"


def _parts(oscillator: OscillatorStability, end: float) -> list[list[Point]]:
    """The curve where it is in the frame or just above, cut where it leaves."""
    z = np.linspace(0.0, end, _POINTS)
    ratio = oscillator.trace
    with np.errstate(divide="ignore", invalid="ignore"):
        trace = values(ratio.numerator, z**2) / values(ratio.denominator, z**2)
    half = np.nan_to_num(np.abs(trace) / 2, nan=np.inf)
    # a point above the frame is where a line to it leaves the frame
    heights = np.minimum(half, 2 * _HIGHEST).tolist()
    parts: list[list[Point]] = [[]]
    for here, there in pairwise(zip(z.tolist(), heights, strict=True)):
        if min(here[1], there[1]) > _HIGHEST:
            parts.append([])
            continue
        if not parts[-1]:
            parts[-1].append(here)
        parts[-1].append(there)
    return [part for part in parts if part]


def springs_panel(plane: SpringsPlane) -> Panel:
    """The plane of the two frequencies: where |tr M| > 2, the resonances, is filled."""
    fast, slow = plane.fast, plane.slow
    half = np.nan_to_num(plane.half_trace, nan=np.inf)
    resonances = Area(1, outlined(fast, slow, 1.0 - half), 0.45, has_outline=False)
    x = Axis("hω of the fast spring", float(fast[0]), float(fast[-1]))
    y = Axis("hω of the slow spring", float(slow[0]), float(slow[-1]))
    description = (
        f"The plane of both frequencies, the fast one to {x.high:.3g} and the slow one to "
        f"{y.high:.3g}, filled where the steps are unstable."
    )
    return Panel("Two springs", description, x, y, [resonances], "Filled where unstable.", 240)
