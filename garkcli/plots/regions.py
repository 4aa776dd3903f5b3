"""Regions of stability in the complex plane, as illustrations of exact decisions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from itertools import groupby, pairwise
from sys import float_info
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq, fmpq_poly

from garkcli.constructions.same_stability import on_test_equation
from garkcli.errors import MethodError
from garkcli.exact.display import to_float
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, replace
from garkcli.graph import components
from garkcli.plots import scene
from garkcli.stability.damping import ImexPair, explicit_colour
from garkcli.stability.linear import StabilityFunction, stability_function
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.summary import Stability, directions
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.stability.springs_plane import SpringsPlane

_POINTS = 600
_HIGHEST = 2.0
_WITHOUT_END = 8.0
"""The end of the z-axis if all z are stable."""


def trace_panel(named: Sequence[tuple[str, OscillatorStability]]) -> scene.Panel:
    """Returns |tr M|/2 over z = hω, with the stable step sizes shaded if there is one method."""
    spans = [_stable(oscillator) for _, oscillator in named]
    highest = [high for found in spans for _, high in found if high]
    end = 1.25 * max(highest, default=_WITHOUT_END)
    shapes: list[scene.Shape] = []
    if len(named) == 1:
        bands = [(low, end if high is None else high) for low, high in spans[0]]
        loops = [[(a, 0.0), (b, 0.0), (b, _HIGHEST), (a, _HIGHEST)] for a, b in bands]
        shapes.append(scene.polygons(None, loops, 0.12, has_outline=False))
    for style, (name, oscillator) in enumerate(named):
        label = name if len(named) > 1 else ""
        for part in _parts(oscillator, end):
            shapes.append(scene.Curve(style, part, label))
            label = ""
    shapes.append(scene.RuledLine((0.0, 1.0), (end, 1.0)))
    names = "; ".join(name for name, _ in named)
    about = f"of {names}" if len(named) > 1 else _spans_text(spans[0])
    return scene.Panel(
        "Oscillator",
        f"Half the modulus of the trace over z; {about}.",
        scene.Axis("z = hω", 0.0, end),
        scene.Axis("|tr M(z)| / 2", 0.0, _HIGHEST),
        shapes,
        "The step matrix M on q̈ = −ω²q"
        + ("; shaded where it is stable." if len(named) == 1 else "."),
    )


def _stable(oscillator: OscillatorStability) -> list[tuple[float, float | None]]:
    return [
        (0.0 if x.start is None else _root(x.start), None if x.end is None else _root(x.end))
        for x in oscillator.stable
    ]


def _root(x: RealRoot) -> float:
    z: float = float(x.ball(64)) ** 0.5
    return z


def _spans_text(spans: Sequence[tuple[float, float | None]]) -> str:
    written = [
        f"from {low:.4g} " + ("on" if high is None else f"to {high:.4g}") for low, high in spans
    ]
    return f"stable {', '.join(written) or 'nowhere'}"


def _parts(oscillator: OscillatorStability, end: float) -> list[list[scene.Point]]:
    """Returns the pieces of the curve within the frame or just above."""
    ratio = oscillator.trace
    sides = _floats(ratio.numerator), _floats(ratio.denominator)
    points = []
    for k in range(_POINTS):
        z = end * k / (_POINTS - 1)
        over, under = (abs(_value(p, z**2)) for p in sides)
        # a point above the frame is where a line to it leaves the frame
        is_above = over >= 4 * _HIGHEST * under
        points.append((z, 2 * _HIGHEST if is_above else over / under / 2))
    parts: list[list[scene.Point]] = [[]]
    for here, there in pairwise(points):
        if min(here[1], there[1]) > _HIGHEST:
            parts.append([])
            continue
        if not parts[-1]:
            parts[-1].append(here)
        parts[-1].append(there)
    return [part for part in parts if part]


def springs_panel(plane: SpringsPlane) -> scene.Panel:
    """Returns the plane of the two frequencies, with the resonances, |tr M| > 2, filled."""
    fast, slow, half = plane.fast, plane.slow, plane.half_trace

    def is_unstable(x: float, y: float) -> bool:
        column, row = (
            round(at / side[-1] * (len(side) - 1)) for at, side in ((x, fast), (y, slow))
        )
        return half[row][column] > 1

    def outlines(*_: scene.Axis) -> scene.Loops:
        from garkcli.plots.plane import outlined

        return outlined(fast, slow, [[1.0 - value for value in row] for row in half])

    resonances = scene.Area(1, is_unstable, outlines, 0.45, has_outline=False)
    x = scene.Axis("hω of the fast spring", fast[0], fast[-1])
    y = scene.Axis("hω of the slow spring", slow[0], slow[-1])
    description = (
        f"The plane of both frequencies, the fast one to {x.high:.3g} and the slow one to "
        f"{y.high:.3g}, filled where the steps are unstable."
    )
    return scene.Panel(
        "Two springs", description, x, y, [resonances], "Filled where unstable.", 240
    )


Named: TypeAlias = tuple[str, StabilityFunction]
_MOST_GROWTH = 700.0
_EDGE = 1 + 1e-9
"""Keeps points on the boundary inside on every machine."""
FILLED = "Filled: |R(z)| ≤ 1."
PRINTED = "Of the digits as printed, not of all methods within the tolerance."
_STAR = "Order star, filled: |R(z)| > |exp z|."
_HEIGHT = 300
_SQUARES = 120
"""Squares on a side of a region; even, as its halves mirror each other."""
_ABOVE_ONE = 1.001
"""If |R(z_E, 0)| is larger, nothing has to be decided: z_I = 0 is not damped."""
_MOST_ZOOMS = 6
_BLINDLY = 20
_COARSE = 80
"""Cells on a side of the grid that is searched for regions; 0 is one of its nodes."""
_MUCH = 2.5
"""The largest ratio between the size of a window and that of the region around 0."""
_AROUND = 1.3
_FAR = 1e6
"""A zero or pole so many times farther than the others is from a coefficient rounded from 0."""


def stability_scene(
    methods: Sequence[tuple[str, Stability]],
    is_order_star: bool = False,
    plane: SpringsPlane | None = None,
) -> scene.Scene:
    """Returns the scene of methods that all have a linear part or all an oscillator, of order
    stars, |R(z)| > |e^z|, or of a ``plane`` of two frequencies.
    """
    (name, found), *others = methods
    title = f"{len(methods)} methods" if others else name
    if plane is not None:
        return scene.Scene(title, [springs_panel(plane)])
    if not all(x.linear for _, x in methods):
        traces = [(name, x.oscillator) for name, x in methods if x.oscillator is not None]
        if not traces:
            cure = "choose a method whose stability is decided"
            raise MethodError("there is nothing to draw", cure, code="arrays")
        return scene.Scene(title, [trace_panel(traces)])
    if others:
        named = [(name, x.linear[0].R) for name, x in methods]
    else:
        pair = found.colours.pair if found.colours is not None else None
        explicit = pair.explicit if pair is not None else None
        named = of_directions([(x.name, x.R) for x in found.linear], explicit)
    region = region_panel(named, is_order_star)
    if any(x.tolerance is not None for _, x in methods):
        region = replace(region, note=f"{region.note} {PRINTED}")
    panels = [region]
    if not others and not is_order_star and found.colours is not None:
        pair = found.colours.pair
        if pair is not None and found.colours.explicit_alone is not None:
            panels.append(pair_panel(pair, found.colours.explicit_alone))
    return scene.Scene(title, panels, is_row=True)


def region_of(
    tableau: Tableau, tolerance: fmpq | None, is_order_star: bool = False, most: int = 4
) -> scene.Panel | None:
    """Returns regions |R(z)| ≤ 1 or order stars of all colours alike and each alone, or None."""
    linear = tableau if tableau.is_gark else on_test_equation(tableau, tolerance)
    found = [] if linear is None else directions(linear)
    if linear is None or not found:
        return None
    named = [(name, stability_function(linear, shares)) for name, shares in found[:most]]
    panel = region_panel(of_directions(named, explicit_colour(linear)), is_order_star)
    more = len(found) - len(named)
    left_out = f" The regions of the last {more} colours alone are left out." if more else ""
    printed = f" {PRINTED}" if tolerance is not None else ""
    return replace(panel, note=panel.note + left_out + printed)


def of_directions(found: Sequence[Named], explicit: int | None = None) -> list[Named]:
    """Returns labels for the legend; ``explicit`` is the explicit colour of two, or None."""
    if len(found) == 1:
        return [("", R) for _, R in found]
    if explicit is not None:
        parts = [f"{'explicit' if l == explicit else 'implicit'} part" for l in range(2)]
        labels = ["one λ for both parts", *parts]
    else:
        labels = [
            "all colours alike" if name == "all" else f"colour {name} alone" for name, _ in found
        ]
    return [(label, R) for label, (_, R) in zip(labels, found, strict=True)]


def region_panel(named: Sequence[Named], is_order_star: bool = False) -> scene.Panel:
    functions = [R for _, R in named]
    labels = [name if len(named) > 1 else "" for name, _ in named]
    areas = [
        _area(style, R, 0.16, label, is_order_star)
        for style, (label, R) in enumerate(zip(labels, functions, strict=True))
    ]
    whole = _window_of(functions, is_order_star)
    window = whole if is_order_star else _nearer(whole, areas)
    note = _STAR if is_order_star else FILLED
    if any(size > window.top for size in _sizes(functions)):
        note += " What R does far away is not in the picture."
    what = "|R(z)| is larger than |exp z|" if is_order_star else "|R(z)| is at most 1"
    description = (
        f"The complex plane from {window.left:.3g} to {window.right:.3g} and from "
        f"{-window.top:.3g} i to {window.top:.3g} i, filled where {what}"
    )
    if len(named) > 1:
        description += f", one outline each for: {', '.join(labels)}"
    title = "Order star" if is_order_star else "Stability region"
    return _in_plane(title, f"{description}.", window, areas, note, "z")


def pair_panel(pair: ImexPair, explicit: StabilityFunction) -> scene.Panel:
    """Returns the z_E with every z_I damped, decided by points, and the outline for z_I = 0."""
    near = _area(1, explicit, 0.0, edge=_ABOVE_ONE)

    @cache
    def is_damped(a: float, b: float) -> bool:
        return near.holds(a, b) and pair.is_damped(_exact(a), _exact(b))

    window = _window_of([explicit], is_symmetric=False)
    e, i = f"z{pair.explicit + 1}", f"z{pair.implicit + 1}"
    areas = [
        scene.Area(
            0,
            lambda a, b: is_damped(a, abs(b)),
            partial(_squares, is_damped),
            0.35,
            has_outline=False,
            label=f"{e} with every {i} damped",
        ),
        _area(1, explicit, 0.0, f"the same with {i} = 0 alone"),
    ]
    description = (
        f"The complex plane of {e}, filled where |R({e}, {i})| is at most 1 for all {i} in the "
        f"left half plane; outlined where it is for {i} = 0."
    )
    note = (
        f"Filled: the {e} of the explicit colour for which |R({e}, {i})| ≤ 1 for all {i} in "
        "the left half plane, each cell decided exactly at its centre."
    )
    return _in_plane("Implicit-explicit pair", description, window, areas, note, e)


def _in_plane(
    title: str, description: str, window: _Window, areas: Sequence[scene.Area], note: str, z: str
) -> scene.Panel:
    left, right, top = window.left, window.right, window.top
    axes = [scene.RuledLine((left, 0.0), (right, 0.0)), scene.RuledLine((0.0, -top), (0.0, top))]
    x, y = scene.Axis(f"Re {z}", left, right), scene.Axis(f"Im {z}", -top, top)
    return scene.Panel(title, description, x, y, [*areas, *axes], note, _HEIGHT, is_plane=True)


def _squares(
    is_damped: Callable[[float, float], bool], x: scene.Axis, y: scene.Axis
) -> scene.Loops:
    """Returns the squares of a grid whose centres are damped, with neighbours in a row joined."""
    columns = [x.low + (x.high - x.low) * k / _SQUARES for k in range(_SQUARES + 1)]
    rows = [2 * y.high * k / _SQUARES for k in range(_SQUARES // 2 + 1)]
    found = []
    for bottom, top in pairwise(rows):
        decided = [is_damped((a + b) / 2, (bottom + top) / 2) for a, b in pairwise(columns)]
        for is_inside, run in groupby(range(_SQUARES), decided.__getitem__):
            squares = [*run]
            low, high = columns[squares[0]], columns[squares[-1] + 1]
            if is_inside:
                for b, t in ((bottom, top), (-top, -bottom)):
                    found.append([(low, b), (high, b), (high, t), (low, t)])
    return found


def _exact(x: float) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def _floats(p: Polynomial) -> list[float]:
    """Returns the coefficients, the leading one first, within the range of floats."""
    return [min(max(to_float(a), -float_info.max), float_info.max) for a in p.coefficients[::-1]]


def _value(coefficients: Sequence[float], x: float) -> float:
    value = 0.0
    for a in coefficients:
        value = value * x + a
    return value


def _sizes_at(coefficients: Sequence[float], row: Sequence[complex]) -> list[float]:
    """Returns the absolute values of a polynomial, infinite beyond floats."""
    first, *rest = coefficients
    values = [complex(first)] * len(row)
    for a in rest:
        values = [value * z + a for value, z in zip(values, row, strict=True)]
    try:
        return [*map(abs, values)]
    except OverflowError:
        return [math.hypot(value.real, value.imag) for value in values]


def _area(
    style: int,
    R: StabilityFunction,
    opacity: float,
    label: str = "",
    is_order_star: bool = False,
    edge: float = _EDGE,
) -> scene.Area:
    P, Q = _floats(R.numerator), _floats(R.denominator)

    def over(row: Sequence[complex]) -> list[float]:
        return _sizes_at(P, row)

    def under(row: Sequence[complex]) -> list[float]:
        sizes = _sizes_at(Q, row)
        if not is_order_star:
            return sizes
        return [x * math.exp(min(z.real, _MOST_GROWTH)) for x, z in zip(sizes, row, strict=True)]

    small, large = (under, over) if is_order_star else (over, under)

    def holds(x: float, y: float) -> bool:
        point = [complex(x, y)]
        return small(point)[0] <= large(point)[0] * edge

    def outlines(x: scene.Axis, y: scene.Axis) -> scene.Loops:
        from garkcli.plots.plane import compared

        return compared(small, large, x, y)

    return scene.Area(style, holds, outlines, opacity, label=label)


class _Window(Frozen):
    left: float
    right: float
    top: float


def _window_of(functions: Sequence[StabilityFunction], is_symmetric: bool) -> _Window:
    """Returns the window of zeros, poles and points |R| = 1 on the axis."""
    reach = 2.0
    for size in _sizes(functions):
        if size > _FAR * reach:
            break
        reach = max(reach, size)
    reach *= 1.6
    have_no_poles = all(R.denominator.degree == 0 for R in functions)
    # regions of polynomials are on the left
    return _Window(-reach, reach / 4 if have_no_poles and not is_symmetric else reach, reach)


def _sizes(functions: Sequence[StabilityFunction]) -> list[float]:
    sizes = []
    for R in functions:
        for p in (R.numerator, R.denominator):
            made = fmpq_poly([_exact(a) for a in reversed(_floats(p))])
            roots: list[Any] = made.complex_roots()
            sizes += [float(abs(root)) for root, _ in roots]
    return sorted(sizes)


def _nearer(window: _Window, areas: Sequence[scene.Area]) -> _Window:
    """Returns a part of the window if the region around 0 is small in it."""
    for _ in range(_MOST_ZOOMS):
        reach = max(_reach(window, area) for area in areas)
        # nothing is seen of what is smaller than a cell
        top = _AROUND * reach or window.top / _BLINDLY
        if top > window.top / _MUCH:
            return window
        # both sides keep their share
        shrunk = top / window.top
        window = _Window(window.left * shrunk, window.right * shrunk, top)
    return window


def _reach(window: _Window, area: scene.Area) -> float:
    """Returns how far the widest part of a region extends, on a coarse grid."""
    wide, high = (window.right - window.left) / _COARSE, window.top / (_COARSE // 2)
    inside = {
        (j, i): complex(window.left + wide * j, high * i)
        for j in range(_COARSE + 1)
        for i in range(_COARSE // 2 + 1)
        if area.holds(window.left + wide * j, high * i)
    }
    beside = {
        (j, i): [x for x in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)) if x in inside]
        for j, i in inside
    }

    def width(part: Sequence[tuple[int, int]]) -> int:
        return max(j for j, _ in part) - min(j for j, _ in part)

    widest = max(components(beside), key=width, default=())
    return max((abs(inside[x]) for x in widest), default=0.0)
