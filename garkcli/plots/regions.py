"""Regions of stability in the complex plane.

They illustrate what was decided exactly and decide nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from math import hypot
from typing import TypeAlias

import numpy as np
from flint import fmpq

from garkcli.exact.roots import RealRoot
from garkcli.plots.plane import Window, log_modulus, modulus, outlined, values, window_of
from garkcli.plots.scene import Area, Axis, Curve, Panel, Point, Rule, Scene, Shape
from garkcli.stability.damping import ImexPair
from garkcli.stability.linear import StabilityFunction
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.springs_plane import SpringsPlane
from garkcli.stability.summary import Stability

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


Named: TypeAlias = tuple[str, StabilityFunction]
"""A stability function and what the legend calls it."""
FILLED = "Filled: |R(z)| ≤ 1."
_STAR = "Order star, filled: |R(z)| > |exp z|."
_HEIGHT = 300
_SQUARES = 120
"""A side of a region whose squares are decided one by one, even: the lower half is the upper one
upside down.
"""
_ABOVE_ONE = 1.001
"""Where |R(z_E, 0)| is larger there is nothing to decide: z_I = 0 is not damped."""
_MOST_ZOOMS = 6
_BLINDLY = 20
_MUCH = 2.5
"""How many times as large a window may be as what is around 0."""
_AROUND = 1.3


def stability_scene(
    methods: Sequence[tuple[str, Stability]],
    is_order_star: bool = False,
    plane: SpringsPlane | None = None,
) -> Scene:
    """What there is to draw of one or several methods.

    Args:
        methods: names and stability, all with a linear part, or all with an oscillator.
        is_order_star: draw |R(z)| > |e^z| instead of |R(z)| ≤ 1.
        plane: draw this plane of two frequencies instead.
    """
    (name, found), *others = methods
    title = f"{len(methods)} methods" if others else name
    if plane is not None:
        return Scene(title, [springs_panel(plane)])
    if not all(x.linear for _, x in methods):
        oscillators = [(name, x.oscillator) for name, x in methods]
        return Scene(title, [trace_panel([(name, x) for name, x in oscillators if x is not None])])
    if others:
        named = [(name, x.linear[0].R) for name, x in methods]
    else:
        named = of_directions([(x.name, x.R) for x in found.linear])
    panels = [region_panel(named, is_order_star)]
    if not others and not is_order_star and found.colours is not None:
        pair = found.colours.pair
        if pair is not None and found.colours.explicit_alone is not None:
            panels.append(pair_panel(pair, found.colours.explicit_alone))
    return Scene(title, panels, is_row=True)


def of_directions(found: Sequence[Named]) -> list[Named]:
    """The functions of a method, "all" first, by what the legend calls them."""
    if len(found) == 1:
        return [("", R) for _, R in found]
    return [
        ("all colours alike" if name == "all" else f"colour {name} alone", R) for name, R in found
    ]


def region_panel(named: Sequence[Named], is_order_star: bool = False) -> Panel:
    """The regions |R(z)| ≤ 1, or the order stars, of some stability functions."""
    functions = [R for _, R in named]
    whole = window_of(functions, is_order_star)
    window = whole if is_order_star else _nearer(whole, functions)
    labels = [name if len(named) > 1 else "" for name, _ in named]
    areas = [
        Area(style, _loops(window, R, is_order_star), 0.16, label=label)
        for style, (label, R) in enumerate(zip(labels, functions, strict=True))
    ]
    note = _STAR if is_order_star else FILLED
    if window != whole:
        note += " Islands around zeros of R that are far away are not in the picture."
    what = "|R(z)| is larger than |exp z|" if is_order_star else "|R(z)| is at most 1"
    description = (
        f"The complex plane from {window.left:.3g} to {window.right:.3g} and from "
        f"{-window.top:.3g} i to {window.top:.3g} i, filled where {what}"
    )
    if len(named) > 1:
        description += f", one outline each for: {', '.join(labels)}"
    title = "Order star" if is_order_star else "Stability region"
    return _in_plane(title, f"{description}.", window, areas, note, "z")


def pair_panel(pair: ImexPair, explicit: StabilityFunction) -> Panel:
    """The z_E for which every z_I in the left half plane is damped, each square decided at its
    centre, and the outline with z_I = 0.
    """
    window = window_of([explicit], is_symmetric=False)
    columns = np.linspace(window.left, window.right, _SQUARES + 1).tolist()
    rows = np.linspace(0.0, window.top, _SQUARES // 2 + 1).tolist()
    squares = []
    for bottom, top in pairwise(rows):
        for low, high in _damped(pair, explicit, columns, (bottom + top) / 2):
            for b, t in ((bottom, top), (-top, -bottom)):
                squares.append([(low, b), (high, b), (high, t), (low, t)])
    e, i = f"z{pair.explicit + 1}", f"z{pair.implicit + 1}"
    areas = [
        Area(0, squares, 0.35, has_outline=False, label=f"{e} with every {i} damped"),
        Area(1, _loops(window, explicit), 0.0, label=f"the same with {i} = 0 alone"),
    ]
    description = (
        f"The complex plane of {e}, filled where |R({e}, {i})| is at most 1 for all {i} in the "
        f"left half plane; outlined where it is for {i} = 0."
    )
    note = (
        f"Filled: the {e} of the explicit colour for which |R({e}, {i})| ≤ 1 for all {i} in "
        "the left half plane, each square decided exactly at its centre."
    )
    return _in_plane("Implicit-explicit pair", description, window, areas, note, e)


def _in_plane(
    title: str, description: str, window: Window, areas: Sequence[Area], note: str, z: str
) -> Panel:
    """Areas with both axes of the complex plane."""
    left, right, top = window.left, window.right, window.top
    axes = [Rule((left, 0.0), (right, 0.0)), Rule((0.0, -top), (0.0, top))]
    x, y = Axis(f"Re {z}", left, right), Axis(f"Im {z}", -top, top)
    return Panel(title, description, x, y, [*areas, *axes], note, _HEIGHT, is_plane=True)


def _damped(
    pair: ImexPair, explicit: StabilityFunction, columns: Sequence[float], b: float
) -> Iterator[tuple[float, float]]:
    """The ends of each run of squares of a row that are damped."""
    centres = [(x + y) / 2 for x, y in pairwise(columns)]
    sizes = modulus(explicit, np.array(centres) + 1j * b).tolist()
    found = [
        size <= _ABOVE_ONE and pair.is_damped(_exact(a), _exact(b))
        for a, size in zip(centres, sizes, strict=True)
    ]
    for is_damped, run in groupby(range(len(found)), found.__getitem__):
        squares = list(run)
        if is_damped:
            yield columns[squares[0]], columns[squares[-1] + 1]


def _exact(x: float) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def _loops(window: Window, R: StabilityFunction, is_order_star: bool = False) -> list[list[Point]]:
    """The outlines of where |R(z)| ≤ 1, or where |R(z)| > |e^z|."""
    x, y = window.grid()
    z = x + 1j * y[:, np.newaxis]
    level = log_modulus(R, z)
    if is_order_star:
        level = z.real - level
    return outlined(x, y, level)


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
        window = Window(window.left * shrunk, window.right * shrunk, top)
    return window


def _reach(window: Window, R: StabilityFunction) -> float:
    """How far from 0 the largest part of a region goes."""
    largest = max(_loops(window, R), key=_extent, default=[])
    return max((hypot(x, y) for x, y in largest), default=0.0)


def _extent(loop: Sequence[Point]) -> float:
    """From its left to its right end."""
    return max(x for x, _ in loop) - min(x for x, _ in loop)
