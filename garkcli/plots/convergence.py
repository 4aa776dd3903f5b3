"""Errors over step sizes and over what they cost, with lines of the slopes that orders ask for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from flint import fmpq

from garkcli.convergence.result import Convergence
from garkcli.page.asciiplot import log10
from garkcli.page.figures import scientific
from garkcli.plots.scales import Mark, in_words
from garkcli.plots.scene import Axis, Curve, Panel, Point, Rule, Scene, Shape, capitalized
from garkcli.plots.slopes import place_line
from garkcli.problems.righthandside import RightHandSide
from garkcli.report.convergence import order_text
from garkcli.report.costs import curve
from garkcli.report.problem import name_of

_TITLE = "Convergence"
_HEIGHT = 240
_AXES = {
    "h": "step size h",
    "evaluations": "evaluations of vector fields",
    "seconds": "seconds of processor time",
}
_MOST_STEPS = 6
_LONGEST_STEP = 6  # characters


def convergence_scene(result: Convergence, name: str) -> Scene:
    """Error and energy error of the method called ``name``."""
    observed = order_text(result.observed_order)
    return Scene(f"{name}\n{_about(result)}: observed order {observed}", [errors_panel(result)])


def comparison_scene(named: Sequence[tuple[str, Convergence]], against: str = "h") -> Scene:
    """Errors of several methods.

    Args:
        named: names and results of methods, at least one.
        against: h, evaluations or seconds; the latter two need rows with costs.
    """
    _, first = named[0]
    return Scene(_about(first), [comparison_panel(named, against)])


def errors_panel(result: Convergence) -> Panel:
    """Error and energy error against h, log–log, with a line whose slope is the visible order."""
    order = result.visible_order
    energies = [(row.h, row.energy_error) for row in result.rows if row.energy_error is not None]
    errors = Curve(0, _decades(curve(result, "h")), "error", has_dots=True)
    energy = Curve(2, _decades(energies), "energy error", has_dots=True)
    curves = [x for x in (errors, energy) if x.points]
    if errors.points:
        line = place_line([errors], order, curves, is_whole=True)
        reference = Curve(1, [line.start, line.end], f"reference, slope {order}")
        curves.insert(1, reference)
    sizes = [row.h for row in result.rows]
    observed = order_text(result.observed_order)
    description = (
        f"Error at t = {result.t_end} over the step size, from h = {sizes[0]} to h = {sizes[-1]}, "
        f"both axes logarithmic: the observed order is {observed}, beside a line of slope {order}."
    )
    return _panel(description, curves, [], "h", [result])


def comparison_panel(named: Sequence[tuple[str, Convergence]], against: str = "h") -> Panel:
    """Errors of several methods, log–log, with a line for each visible order."""
    curves: list[Curve] = []
    of_order: dict[int, list[Curve]] = {}
    for style, (name, result) in enumerate(named):
        errors = Curve(style, _decades(curve(result, against)), name, has_dots=True)
        if errors.points:
            curves.append(errors)
            of_order.setdefault(result.visible_order, []).append(errors)
    # errors rise with h, and fall with what they cost
    sign = 1 if against == "h" else -1
    rules = [
        place_line(beside, sign * order, curves) for order, beside in of_order.items() if order > 0
    ]
    names = ", ".join(x.label for x in curves)
    description = f"Errors over the {_AXES[against]}, both axes logarithmic, of {names}."
    return _panel(description, curves, rules, against, [result for _, result in named])


def _panel(
    description: str,
    curves: Sequence[Curve],
    rules: Sequence[Rule],
    against: str,
    results: Sequence[Convergence],
) -> Panel:
    shapes: list[Shape] = [*rules, *curves]
    drawn = [point for x in curves for point in x.points]
    drawn += [end for rule in rules for end in (rule.start, rule.end)]
    given = step_marks([row.h for x in results for row in x.rows]) if against == "h" else []
    x = Axis.around(_AXES[against], [a for a, _ in drawn], True, given)
    y = Axis.around("error", [b for _, b in drawn], True)
    return Panel(_TITLE, description, x, y, shapes, height=_HEIGHT, has_grid=True)


def _decades(points: Iterable[tuple[Any, Any]]) -> list[Point]:
    """The decimal logarithms of points, without those where there are none."""
    return [(log10(x), log10(y)) for x, y in points if y > 0]


def step_marks(sizes: Sequence[fmpq]) -> list[Mark]:
    """The step sizes themselves, as many as there is space for."""
    places = {h: log10(h) for h in sorted(set(sizes), reverse=True)}
    least = (max(places.values()) - min(places.values())) / _MOST_STEPS
    found: list[Mark] = []
    for h, at in places.items():
        if not found or found[-1].at - at >= least:
            exact = str(h)
            label = exact if len(exact) <= _LONGEST_STEP else in_words(scientific(h, 2))
            found.append(Mark(at, label))
    return found


def _about(result: Convergence) -> str:
    """The problem and the time, with a capital."""
    problem = result.problem
    about = capitalized(name_of(result.problem))
    if isinstance(problem, RightHandSide) and problem.stiffness is not None:
        about += f", stiffness {problem.stiffness},"
    return f"{about} to t = {result.t_end}"
