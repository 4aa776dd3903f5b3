"""Several methods in one picture: their stability regions, their errors over step sizes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from flint import fmpq

from garkcli.api.runs import converge
from garkcli.convergence.default_problem import in_common, seeing_problem
from garkcli.errors import GarkError
from garkcli.plots.slopes import Curve
from garkcli.report.costs import curve
from garkcli.stability.linear import stability_function
from garkcli.stability.summary import directions
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures import region
from garkcli.webpage.pictures.convergence import curve_of, draw_curve, frame_of, step_marks
from garkcli.webpage.pictures.drawing import COLOURS
from garkcli.webpage.pictures.large import is_large
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.scales import decade_marks

MOST = len(COLOURS)
"""Methods in one picture; more could not be told apart."""
_TITLE = "Convergence"
Draw: TypeAlias = Callable[[Sequence[GarkMethod]], Picture]


def compared(methods: Sequence[GarkMethod]) -> list[Picture]:
    """The pictures of several methods, the first of them where they are many; those that cannot be
    drawn of two of them at least are left out.
    """
    chosen = methods[:MOST]
    found = []
    draws: Sequence[Draw] = (_regions, _errors)
    for draw in draws:
        try:
            picture = draw(chosen)
        except (NotDrawn, GarkError):
            # the parts of the methods tell why
            continue
        if len(methods) > MOST:
            first = f"{picture.note} Of the first {MOST} methods."
            picture = replace(picture, note=first)
        found.append(picture)
    return found


def _regions(methods: Sequence[GarkMethod]) -> Picture:
    """The regions of all colours alike."""
    names = []
    functions = []
    without = []
    for method in methods:
        tableau = method.tableau
        found = directions(tableau)
        if not found:
            without.append(method.name)
            continue
        _, alike = found[0]
        R = stability_function(tableau, alike)
        names.append(method.name)
        functions.append(R)
    if len(names) < 2:
        raise NotDrawn("")
    picture = region.drawn(names, functions)
    if without:
        none = f"{picture.note} No stability function: {', '.join(without)}."
        picture = replace(picture, note=none)
    return picture


def _errors(methods: Sequence[GarkMethod]) -> Picture:
    """The errors on the problem that sees the most trees of all of them."""
    small = [x for x in methods if not is_large(x)]
    if len(small) < 2:
        raise NotDrawn("")
    tableaus = [x.tableau for x in small]
    name = seeing_problem(tableaus)
    problems = in_common(name, tableaus, 1)
    curves: list[Curve] = []
    sizes: set[fmpq] = set()
    for method, problem in zip(small, problems, strict=True):
        result = converge(method, problem)
        points = curve(result, "h")
        drawn = curve_of(points, method.name)
        if drawn is not None:
            curves.append(drawn)
            sizes.update(row.h for row in result.rows)
    if len(curves) < 2:
        raise NotDrawn("")
    svg = _svg(curves, sorted(sizes))
    note = f"Numerical: all on the problem {name}."
    return Picture("convergence", _TITLE, _description(curves), svg, note)


def _svg(curves: Sequence[Curve], sizes: Sequence[fmpq]) -> str:
    frame = frame_of(curves)
    for k, drawn in enumerate(curves):
        draw_curve(frame, k, drawn, has_points=True)
    up = decade_marks(frame.y.low, frame.y.high, 7)
    marks = step_marks(sizes), up
    labels = "step size h", "error"
    return frame.finished(_TITLE, _description(curves), marks, labels)


def _description(curves: Sequence[Curve]) -> str:
    names = ", ".join(drawn.label for drawn in curves)
    return f"Errors over the step size, both axes logarithmic, of {names}."
