"""Pictures of stability: regions in the complex plane, the trace over z, the plane of two springs.

They illustrate what was decided exactly and decide nothing. Lines differ in dashes as well as in
colour, so that the figures can be printed in grey.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from flint import fmpq
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

from garkcli.exact.display import to_float
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.report.stability_data import StabilityReport
from garkcli.stability.damping import ImexPair
from garkcli.stability.linear import StabilityFunction
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.springs_plane import SpringsPlane

if TYPE_CHECKING:
    from garkcli.arrays import Array, Complexes, Floats

COLOURS = ("#24558f", "#a02417", "#3f7f3f", "#7a4f9a", "#8a6d1a", "#30777a")
DASHES: tuple[Any, ...] = (
    "solid",
    (0, (6, 2)),
    (0, (2, 2)),
    (0, (8, 2, 2, 2)),
    (0, (1, 2)),
    (0, (4, 1, 1, 1)),
)
Style: TypeAlias = dict[str, Any]
Named: TypeAlias = tuple[str, StabilityFunction]
"""A stability function and what the legend calls it."""
POINTS = 401
"""Points a side of a region."""
SQUARES = 121
"""Squares a side of a region whose squares are decided one by one, odd so that one row is real."""
_AT_POLES = 1e9
"""What is drawn in place of infinity."""
_ABOVE_ALL = 2e9
"""A level that nothing reaches."""


@dataclass(frozen=True)
class Window:
    """A part of the complex plane."""

    left: float
    right: float
    top: float

    def grid(
        self,
    ) -> tuple[Floats, Floats, Complexes]:
        """The real parts, the imaginary parts, and all points, shape (POINTS, POINTS)."""
        x = np.linspace(self.left, self.right, POINTS)
        y = np.linspace(-self.top, self.top, POINTS)
        rows = 1j * y[:, np.newaxis]
        points = x[np.newaxis, :] + rows
        return x, y, points


def values(p: Polynomial, z: Array) -> Array:
    """The values of p at many points, in floats."""
    found: Array = np.polyval(_coefficients(p), z)
    return found


def _coefficients(p: Polynomial) -> list[float]:
    """In floats, the leading one first."""
    return [to_float(a) for a in reversed(p.coefficients)]


def modulus(R: StabilityFunction, z: Array) -> Array:
    """|R| at many points; infinite at poles."""
    with np.errstate(divide="ignore", invalid="ignore"):
        numerators = values(R.numerator, z)
        ratio = numerators / values(R.denominator, z)
        size: Array = np.abs(ratio)
    return size


def _finite(level: Array) -> Array:
    """Numbers to draw in place of infinity."""
    drawn: Array = np.nan_to_num(level, nan=_AT_POLES, posinf=_AT_POLES)
    return drawn


def _draw_axes(axes: Axes) -> None:
    """Both axes of the plane, and its scales alike."""
    thin: Style = {"color": "0.1", "linewidth": 0.8}
    axes.axhline(0.0, **thin)
    axes.axvline(0.0, **thin)
    axes.set_aspect("equal")


def window_of(
    functions: Sequence[StabilityFunction], is_symmetric: bool
) -> Window:
    """A part of the plane with all that happens: zeros of P, poles, where |R| = 1 on the axis."""
    reach = 2.0
    for R in functions:
        for p in (R.numerator, R.denominator):
            if p.degree > 0:
                roots = np.roots(_coefficients(p))
                largest = np.max(np.abs(roots))
                reach = max(reach, float(largest))
    reach *= 1.6
    have_no_poles = all(R.denominator.degree == 0 for R in functions)
    # regions of polynomials are on the left
    right = reach
    if have_no_poles and not is_symmetric:
        right = reach / 4
    return Window(-reach, right, reach)


def stability_figure(
    reports: Sequence[StabilityReport], order_star: bool = False
) -> Figure:
    """What there is to draw of one or several methods.

    Args:
        reports: all with a linear part, or all with an oscillator.
        order_star: draw |R(z)| > |e^z| instead of |R(z)| ≤ 1.
    """
    planes = [report.plane for report in reports if report.plane is not None]
    if planes:
        return springs_figure(planes[0], reports[0].name)
    if all(report.found.linear for report in reports):
        return region_figure(reports, order_star)
    return trace_figure(reports)


def region_figure(
    reports: Sequence[StabilityReport], order_star: bool
) -> Figure:
    """The regions |R(z)| ≤ 1, a panel a direction where there is one method of several colours."""
    pair = None
    first = reports[0]
    if len(reports) == 1 and not order_star:
        colours = first.found.colours
        pair = None if colours is None else colours.pair
    columns = 1 if pair is None else 2
    width = 6.4 * columns
    figure = Figure(figsize=(width, 5.6), layout="constrained")
    grid = figure.subplots(1, columns, squeeze=False)
    panels = grid[0]
    named: list[Named] = []
    for report in reports:
        linear = report.found.linear
        if len(reports) == 1 and len(linear) > 1:
            named += [(_direction(one.name), one.R) for one in linear]
        else:
            whole = linear[0]
            named.append((report.name, whole.R))
    title = _title([report.name for report in reports])
    figure.suptitle(title, fontsize=11, parse_math=False)
    _draw_regions(panels[0], named, order_star)
    if pair is not None:
        of_direction = dict(named)
        explicit = of_direction[_direction_of(first, pair)]
        _draw_damped(panels[1], pair, explicit)
    return figure


def _direction_of(report: StabilityReport, pair: ImexPair) -> str:
    """The label of the explicit colour."""
    colours = report.found.tableau.colours
    explicit = colours[pair.explicit]
    return _direction(explicit.name)


def _draw_damped(
    axes: Axes, pair: ImexPair, explicit: StabilityFunction
) -> None:
    """The z_E with all z_I damped, each square decided at its centre, and the outline without."""
    window = window_of([explicit], is_symmetric=False)
    x = np.linspace(window.left, window.right, SQUARES)
    rows = SQUARES // 2 + 1
    y = np.linspace(0.0, window.top, rows)
    upper = []
    for b in map(_exact, y):
        row = [pair.is_damped(_exact(a), b) for a in x]
        upper.append(row)
    # the picture is its own mirror image: all but the row on the axis once more, upside down
    lower = upper[:0:-1]
    below = -y[:0:-1]
    both = np.concatenate([below, y])
    shades = ListedColormap(["#ffffff", COLOURS[0]])
    axes.pcolormesh(
        x, both, lower + upper, cmap=shades, alpha=0.35, shading="nearest"
    )
    u, v, z = window.grid()
    level = _finite(modulus(explicit, z))
    colour, dashes = _line(1)
    edge: Style = {"colors": [colour], "linestyles": [dashes]}
    axes.contour(u, v, level, levels=[1.0], **edge)
    _draw_axes(axes)
    e = pair.explicit + 1
    i = pair.implicit + 1
    axes.set_xlabel(f"Re z{e}")
    axes.set_ylabel(f"Im z{e}")
    title = f"filled: z{e} with every z{i} damped; dashed: with z{i} = 0"
    axes.set_title(title, fontsize=10, loc="left")


def _exact(x: float) -> fmpq:
    return fmpq(*float(x).as_integer_ratio())


def _direction(name: str) -> str:
    return "all colours alike" if name == "all" else f"colour {name} alone"


def _title(names: Sequence[str]) -> str:
    if len(names) == 1:
        return names[0]
    return f"{len(names)} methods"


def _line(k: int) -> tuple[str, Any]:
    """The colour and the dashes of the k-th line."""
    colour = COLOURS[k % len(COLOURS)]
    dashes = DASHES[k % len(DASHES)]
    return colour, dashes


def _draw_regions(
    axes: Axes, named: Sequence[Named], order_star: bool
) -> None:
    functions = [R for _, R in named]
    window = window_of(functions, order_star)
    x, y, z = window.grid()
    handles = []
    for k, (name, R) in enumerate(named):
        colour, dashes = _line(k)
        level = modulus(R, z)
        bounds = [0.0, 1.0]
        if order_star:
            level = level / np.exp(z.real)
            bounds = [1.0, _ABOVE_ALL]
        finite = _finite(level)
        inside: Style = {"colors": [colour], "alpha": 0.18}
        axes.contourf(x, y, finite, levels=bounds, **inside)
        edge: Style = {"colors": [colour], "linestyles": [dashes]}
        axes.contour(x, y, finite, levels=[1.0], linewidths=1.4, **edge)
        handle = Line2D([], [], color=colour, linestyle=dashes, label=name)
        handles.append(handle)
    _draw_axes(axes)
    axes.set_xlabel("Re z")
    axes.set_ylabel("Im z")
    what = (
        "order star: |R(z)| > |exp z|" if order_star else "filled: |R(z)| ≤ 1"
    )
    axes.set_title(what, fontsize=10, loc="left")
    if len(named) > 1:
        legend = axes.legend(handles=handles, fontsize=9, loc="upper left")
        _write_literally(legend)


def _write_literally(legend: Legend) -> None:
    """Names are no formulas."""
    for text in legend.get_texts():
        text.set_parse_math(False)


def trace_figure(reports: Sequence[StabilityReport]) -> Figure:
    """|tr M|/2 against z, with the stable step sizes shaded where there is one method."""
    figure = Figure(figsize=(7.2, 3.9), layout="constrained")
    axes = figure.subplots()
    found: list[tuple[str, OscillatorStability]] = []
    for report in reports:
        oscillator = report.found.oscillator
        if oscillator is not None:
            found.append((report.name, oscillator))
    last = max(_last_end(oscillator) for _, oscillator in found)
    end = last * 1.25
    z = np.linspace(0.0, end, 1200)
    for k, (name, oscillator) in enumerate(found):
        half = _half_trace(oscillator, z)
        colour, dashes = _line(k)
        axes.plot(z, half, color=colour, linestyle=dashes, label=name)
    if len(found) == 1:
        _, only = found[0]
        _shade_stable(axes, only, end)
    axes.axhline(1.0, color="0.1", linewidth=0.9)
    axes.set_ylim(0.0, 2.0)
    axes.set_xlim(0.0, end)
    axes.set_xlabel("z = hω")
    axes.set_ylabel("|tr M(z)| / 2")
    title = _title([name for name, _ in found])
    axes.set_title(title, fontsize=11, loc="left", parse_math=False)
    if len(found) > 1:
        legend = axes.legend(frameon=False, fontsize=9)
        _write_literally(legend)
    return figure


def _half_trace(oscillator: OscillatorStability, z: Array) -> Array:
    """|tr M|/2 at many points."""
    x = z**2
    ratio = oscillator.trace
    with np.errstate(divide="ignore", invalid="ignore"):
        numerators = values(ratio.numerator, x)
        trace = numerators / values(ratio.denominator, x)
    half: Array = np.abs(trace) / 2
    return half


def _shade_stable(
    axes: Axes, oscillator: OscillatorStability, end: float
) -> None:
    for interval in oscillator.stable:
        low = 0.0
        high = end
        if interval.start is not None:
            low = _root(interval.start)
        if interval.end is not None:
            high = min(_root(interval.end), end)
        axes.axvspan(low, high, color="0.9", linewidth=0)


def _root(x: RealRoot) -> float:
    """The z of x = z²."""
    square = float(x.ball(64))
    z: float = square**0.5
    return z


def _last_end(oscillator: OscillatorStability) -> float:
    ends = [i.end for i in oscillator.stable if i.end is not None]
    if not ends:
        return 8.0
    return _root(ends[-1])


def springs_figure(plane: SpringsPlane, name: str) -> Figure:
    """The plane of the two frequencies: where |tr M| > 2, the resonances, is filled."""
    figure = Figure(figsize=(6.4, 5.2), layout="constrained")
    axes = figure.subplots()
    fast, slow = plane.fast, plane.slow
    shown = _finite(plane.half_trace)
    red = ["#a02417"]
    unstable = [1.0, _ABOVE_ALL]
    inside: Style = {"colors": red, "alpha": 0.35}
    edge: Style = {"colors": red, "linewidths": 1.2}
    axes.contourf(fast, slow, shown, levels=unstable, **inside)
    axes.contour(fast, slow, shown, levels=[1.0], **edge)
    axes.set_xlabel("hω of the fast spring")
    axes.set_ylabel("hω of the slow spring")
    title = f"{name}: filled where unstable"
    axes.set_title(title, fontsize=11, loc="left", parse_math=False)
    return figure
