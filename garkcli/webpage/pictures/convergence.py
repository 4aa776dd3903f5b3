"""Errors over step sizes, with the slope that the order asks for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import floor
from typing import Any

from flint import arb, fmpq

from garkcli.api.runs import converge
from garkcli.convergence.result import Convergence
from garkcli.page.asciiplot import log10
from garkcli.plots.slopes import Curve, place_line
from garkcli.report.convergence import order_text, predicted
from garkcli.report.convergence_data import problem_name
from garkcli.report.costs import curve
from garkcli.tableau.garkmethod import GarkMethod, word_for
from garkcli.webpage.pictures.drawing import Frame
from garkcli.webpage.pictures.elements import Point
from garkcli.webpage.pictures.large import is_large
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.scales import Mark, decade_marks

_HEIGHT = 240
_TITLE = "Convergence"
_MOST_LABELS = 6
_RADIUS = 3


def draw(method: GarkMethod) -> Picture:
    """The convergence test of one method, on the problem that sees every tree of it.

    Raises:
        NotDrawn: it is large, makes no error, or is for no such problem.
    """
    if is_large(method):
        raise NotDrawn(
            "The method has too many stages to be tested for a picture; gark converge does it."
        )
    result = converge(method)
    svg = svg_of(result)
    note = _note(result)
    return Picture("convergence", _TITLE, _description(result), svg, note)


def svg_of(result: Convergence) -> str:
    """Errors over step sizes as an SVG element.

    Raises:
        NotDrawn: there are fewer than two errors.
    """
    errors = curve_of(curve(result, "h"), "error")
    if errors is None or len(errors.xs) < 2:
        raise NotDrawn("The method makes no error on the problem of the test.")
    order = result.visible_order
    energies = curve_of(_energy_errors(result), "energy error")
    curves = [x for x in (errors, energies) if x is not None]
    reference = place_line([errors], order, curves, is_whole=True)
    slope = Curve(reference.xs, reference.ys, f"slope {order}", {})
    frame = frame_of([*curves, slope])
    draw_curve(frame, 0, errors, has_points=True)
    draw_curve(frame, 1, slope, has_points=False)
    if energies is not None:
        draw_curve(frame, 2, energies, has_points=True)
    description = _description(result)
    sizes = [row.h for row in result.rows if row.error > 0]
    up = decade_marks(frame.y.low, frame.y.high, 7)
    marks = step_marks(sizes), up
    return frame.finished(_TITLE, description, marks, ("step size h", "error"))


def _energy_errors(result: Convergence) -> list[tuple[fmpq, arb]]:
    found = []
    for row in result.rows:
        error = row.energy_error
        if error is not None and error > 0:
            found.append((row.h, error))
    return found


def curve_of(points: Iterable[tuple[Any, Any]], label: str) -> Curve | None:
    """Points in decimal logarithms; None where there are none."""
    pairs = [(log10(x), log10(y)) for x, y in points]
    if not pairs:
        return None
    xs, ys = zip(*pairs, strict=True)
    return Curve(xs, ys, label, {})


def frame_of(curves: Sequence[Curve]) -> Frame:
    """With a twentieth of its width, and of its height, around the curves."""
    xs: list[float] = []
    ys: list[float] = []
    for drawn in curves:
        xs += drawn.xs
        ys += drawn.ys
    return Frame.of(_ends(xs), _ends(ys), _HEIGHT)


def _ends(numbers: list[float]) -> Point:
    low = min(numbers)
    high = max(numbers)
    around = 0.05 * (high - low) or 0.5
    return low - around, high + around


def draw_curve(frame: Frame, k: int, drawn: Curve, has_points: bool) -> None:
    """Draw the k-th curve, with dots at its points or without, and name it in the legend."""
    points = list(zip(drawn.xs, drawn.ys, strict=True))
    frame.curve(k, points, 1.6)
    if has_points:
        frame.dots(k, points, _RADIUS)
    frame.legend.append((k, drawn.label))


def step_marks(sizes: Sequence[fmpq]) -> list[Mark]:
    """The step sizes themselves, as many as there is space for."""
    apart = -(-len(sizes) // _MOST_LABELS)
    return [Mark(log10(h), _size(h)) for h in sizes[::apart]]


def _size(h: fmpq) -> str:
    exact = str(h)
    if len(exact) <= 6:
        return exact
    exponent = floor(log10(h))
    digits = float(arb(h) / arb(10) ** exponent)
    return f"{digits:.2g}e{exponent}"


def _description(result: Convergence) -> str:
    sizes = [row.h for row in result.rows]
    observed = order_text(result.observed_order)
    return (
        f"Error at t = {result.t_end} over the step size, from h = {sizes[0]} to h = {sizes[-1]}, "
        f"both axes logarithmic: the observed order is {observed}, beside a line of slope "
        f"{result.visible_order}."
    )


def _note(result: Convergence) -> str:
    observed = order_text(result.observed_order)
    name = problem_name(result)
    text = (
        f"Numerical: the {word_for(result.method)} on the problem {name} to t = {result.t_end}. "
        f"Observed order {observed}, proved order {predicted(result)}: {_VERDICTS[result.verdict]}."
    )
    if result.plateau:
        text += " The last errors are those of the rounded coefficients."
    return text


_VERDICTS = {
    "agree": "they agree",
    "disagree": "they do not agree",
    "undecided": "these steps do not decide whether they agree",
    "reduced": "steps that do not resolve a stiff problem show a smaller one",
}
