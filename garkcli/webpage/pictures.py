"""The pictures of the page, with the trees."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial

from markupsafe import Markup, escape

from garkcli.api.runs import converge, long_run
from garkcli.constructions.nystrom import is_nystrom, partitioned
from garkcli.constructions.same_stability import on_test_equation
from garkcli.convergence.convergence import in_common, seeing_problem
from garkcli.errors import GarkError
from garkcli.frozen import Frozen, replace
from garkcli.longtime.longtime import usual
from garkcli.ntrees.drawing import PALETTE, layout
from garkcli.ntrees.tree import Tree
from garkcli.page.figures import order_text
from garkcli.plots.convergence import comparison_panel, errors_panel
from garkcli.plots.curves import became_of, history_panel
from garkcli.plots.regions import pair_panel, region_of, region_panel, trace_panel
from garkcli.plots.scene import Panel
from garkcli.plots.svg import ON_ANY, svg
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.report.convergence import verdict_words
from garkcli.stability.damping import imex_pair
from garkcli.stability.fraction import stability_fraction
from garkcli.stability.linear import stability_function
from garkcli.stability.oscillator import usual_oscillator
from garkcli.stability.summary import directions
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import StepFailed
from garkcli.tableau.garkmethod import GarkMethod, word_for
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain

STEP_X = 22
STEP_Y = 24
RADIUS = 8
MARGIN = 2
"""Margin in pixels."""


def tree_picture(tree: Tree, title: str, has_colours: bool) -> Markup:
    """Returns a tree with the root at the bottom, as Butcher draws it; ``title`` is read aloud."""
    vertices = layout(tree)
    edge = RADIUS + MARGIN
    top = max(v.y for v in vertices)
    places = []
    for v in vertices:
        x = round(edge + v.x * STEP_X)
        y = edge + (top - v.y) * STEP_Y
        places.append((x, y))
    lines = []
    dots = []
    for v, (x, y) in zip(vertices, places, strict=True):
        dots.append(f'<use href="#{dot_name(v.colour, has_colours)}" x="{x}" y="{y}"/>')
        if v.parent >= 0:
            start_x, start_y = places[v.parent]
            lines.append(f"M{start_x} {start_y}L{x} {y}")
    width = edge + max(x for x, _ in places)
    height = edge + max(y for _, y in places)
    size = f'viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
    path = "".join(lines)
    edges = f'<path d="{path}"/>' if path else ""
    drawn = "".join(dots)
    said = escape(title)
    return Markup(f'<svg class="tree" role="img" {size}><title>{said}</title>{edges}{drawn}</svg>')


def dot_name(colour: int, has_colours: bool) -> str:
    return f"dot{colour + 1}" if has_colours else "dot"


def dots(counts: Iterable[int]) -> Markup:
    """Returns the definitions of the dots for methods with these numbers of colours."""
    most = max(counts, default=1)
    found = [f'<circle id="dot" class="dot plain" r="{RADIUS - 2}"/>']
    for colour in range(most):
        fill, ink = PALETTE[colour % len(PALETTE)]
        disc = f'<circle class="dot" r="{RADIUS}" fill="{fill}"/>'
        number = f'<text class="digit" y="4" fill="{ink}">{colour + 1}</text>'
        found.append(f'<g id="dot{colour + 1}">{disc}{number}</g>')
    defined = "".join(found)
    return Markup(
        f'<svg class="defs" width="0" height="0" aria-hidden="true"><defs>{defined}</defs></svg>'
    )


MOST = len(ON_ANY)
"""Most curves in a picture; more could not be distinguished."""
STEPS = 5000
_POINTS = 600
MOST_STAGES = 40
"""Most stages of a method that is run for a picture."""
MOST_ROUNDED_STAGES = 20
"""Most stages with rounded coefficients, whose order takes longer."""
MOST_STAGES_OF_PAIR = 14
"""Most stages of an implicit-explicit pair that is drawn."""


class Picture(Frozen):
    """A picture, named for addresses and classes; an empty ``svg`` has its reason in ``note``."""

    name: str
    title: str
    description: str
    svg: str
    note: str


class NotDrawn(Exception):
    """The reason in a sentence; ``is_expected`` if somebody misses the picture."""

    def __init__(self, reason: str, is_expected: bool = True) -> None:
        super().__init__(reason)
        self.is_expected = is_expected


def _is_gark(method: GarkMethod) -> bool:
    return method.tableau.is_gark


def _of_stability(method: GarkMethod) -> Tableau | None:
    """Returns the tableau with the R(z) of a method, its own or one with the same, or None."""
    if _is_gark(method):
        return method.tableau
    return on_test_equation(method.tableau, method.tolerance)


OF_STABILITY = "region", "pair", "oscillator"
OF_STEPS = "convergence", "energy"


def pictures(
    method: GarkMethod, names: Sequence[str] = (*OF_STABILITY, *OF_STEPS)
) -> list[Picture]:
    """Returns pictures; an expected one that cannot be drawn is a note."""
    drawn = []
    for name in names:
        title, draw = PICTURES[name]
        if not _is_drawn_of(name, method):
            continue
        try:
            drawn.append(_picture(name, *draw(method)))
        except NotDrawn as error:
            if error.is_expected:
                drawn.append(Picture(name, title, "", "", str(error)))
        except GarkError as error:
            # of a problem that the method is not for
            drawn.append(Picture(name, title, "", "", f"Not drawn: {error}."))
    return drawn


def _is_drawn_of(name: str, method: GarkMethod) -> bool:
    if _is_gark(method) or name == "region":
        return True
    return name == "oscillator" and is_nystrom(method.tableau)


def compared_pictures(methods: Sequence[GarkMethod]) -> list[Picture]:
    """Returns the pictures of the first methods together, without those of fewer than two."""
    chosen = methods[:MOST]
    first = f" Of the first {MOST} methods." if len(methods) > MOST else ""
    found = []
    for name, draw in (("region", _regions), ("convergence", _comparison)):
        try:
            panel, note = draw(chosen)
        except (NotDrawn, GarkError):
            # the parts of the methods tell why
            continue
        found.append(_picture(name, panel, note + first))
    return found


def _picture(name: str, panel: Panel, note: str) -> Picture:
    return Picture(name, panel.title, panel.description, svg(panel), note)


def _region(method: GarkMethod, is_order_star: bool = False) -> tuple[Panel, str]:
    panel = region_of(method.tableau, method.tolerance, is_order_star, MOST)
    if panel is None:
        if not _is_gark(method):
            raise NotDrawn("A method of this kind has no stability function.", False)
        raise NotDrawn(
            "There is no stability function: colours drive positions or momenta only, or do not "
            "depend on each other."
        )
    return panel, panel.note


def _pair(method: GarkMethod) -> tuple[Panel, str]:
    """Returns the z of the explicit colour for which every z of the implicit one is damped."""
    alone = directions(method.tableau)[1:]
    is_small = sum(method.stages) <= MOST_STAGES_OF_PAIR
    if len(alone) != 2 or not is_small or method.tolerance is not None:
        raise NotDrawn("The method is no small exact pair of two methods.", False)
    imex = imex_pair(method.tableau, stability_fraction(method.tableau))
    if imex is None:
        raise NotDrawn("The method is no pair of an implicit and an explicit method.", False)
    _, shares = alone[imex.explicit]
    panel = pair_panel(imex, stability_function(method.tableau, shares))
    return panel, panel.note


def _oscillator(method: GarkMethod) -> tuple[Panel, str]:
    tableau = method.tableau
    if is_nystrom(tableau):
        tableau = partitioned(tableau, method.tolerance)
    rounded = method.tolerance is not None
    found = None if rounded else usual_oscillator(tableau)
    linear = _of_stability(method)
    has_region = linear is not None and bool(directions(linear))
    if found is None or (has_region and not found.determinant.is_one):
        why = "The method has no split for the oscillator."
        if rounded:
            why = "With rounded coefficients nothing is decided about the oscillator."
        elif found is not None:
            why = "The trace, which is drawn, decides nothing: the determinant of a step is not 1."
        # the region tells what there is to tell
        raise NotDrawn(why, is_expected=not has_region)
    panel = trace_panel([(method.name, found)])
    return panel, panel.note


def _convergence(method: GarkMethod) -> tuple[Panel, str]:
    """Returns the convergence test, on the problem for which every tree of the method matters."""
    _refuse_large(method, "gark converge", "be tested")
    result = converge(method)
    if sum(row.error > 0 for row in result.rows) < 2:
        raise NotDrawn("The method makes no error on the problem of the test.")
    observed = order_text(result.observed_order)
    name = result.problem.name
    note = (
        f"Numerical: the {word_for(result.method)} on the problem {name} to t = {result.t_end}. "
        f"Observed order {observed}, visible order {result.visible_order}: "
        f"{verdict_words(result, Plain())}."
    )
    if result.plateau:
        note += " The last errors are those of the rounded coefficients."
    return errors_panel(result), note


def _energy(method: GarkMethod) -> tuple[Panel, str]:
    """Returns the energy error over a long time, on a Kepler orbit."""
    _refuse_large(method, "gark energy", "be run")
    problem = hamiltonian("kepler", terms_of(with_joined_terms(method.tableau)))
    step, _ = usual(problem)
    try:
        run = long_run(method, problem, STEPS * step, step, points=_POINTS)
    except StepFailed as error:
        raise NotDrawn(f"A step fails on Kepler's problem: {error.message}.") from None
    history, steps = run.invariants[0], f"{run.steps} steps of {run.step}"
    if history.verdict in ("exact", "round-off"):
        where = f"{steps} on the problem {run.problem.name}"
        raise NotDrawn(f"The {history.name} error stays below round-off in {where}.")
    where = f"Kepler's problem, {steps}"
    note = f"Numerical: the {word_for(run.method)} on {where}; {became_of(history)}."
    return history_panel(run, history), note


def _is_large(method: GarkMethod) -> bool:
    """Returns whether steps would take too long for a picture."""
    most = MOST_STAGES if method.tolerance is None else MOST_ROUNDED_STAGES
    return sum(method.stages) > most


def _refuse_large(method: GarkMethod, command: str, what: str) -> None:
    if _is_large(method):
        message = f"The method has too many stages to {what} for a picture; {command} does it."
        raise NotDrawn(message)


PICTURES: dict[str, tuple[str, Callable[[GarkMethod], tuple[Panel, str]]]] = {
    "region": ("Stability region", _region),
    "pair": ("Implicit-explicit pair", _pair),
    "oscillator": ("Oscillator", _oscillator),
    "convergence": ("Convergence", _convergence),
    "energy": ("Energy error over a long time", _energy),
}


def panel_named(name: str, method: GarkMethod) -> Panel:
    """Returns one of PICTURES, or ``star``; NotDrawn without one, GarkError if it cannot be."""
    if name in PICTURES and name != "convergence" and not _is_drawn_of(name, method):
        kinds = "GARK and Nyström methods" if name == "oscillator" else "GARK methods"
        raise NotDrawn(f"The picture is of {kinds}, and this method is of another kind.")
    draw = partial(_region, is_order_star=True) if name == "star" else PICTURES[name][1]
    panel, note = draw(method)
    return replace(panel, note=note)


_TOO_FEW = "Fewer than two methods have such a picture."


def _regions(methods: Sequence[GarkMethod]) -> tuple[Panel, str]:
    named = []
    without = []
    for method in methods:
        tableau = _of_stability(method)
        found = [] if tableau is None else directions(tableau)
        if tableau is not None and found:
            named.append((method.name, stability_function(tableau, found[0][1])))
        else:
            without.append(method.name)
    if len(named) < 2:
        raise NotDrawn(_TOO_FEW)
    panel = region_panel(named)
    none = f" No stability function: {', '.join(without)}." if without else ""
    return panel, panel.note + none


def _comparison(methods: Sequence[GarkMethod]) -> tuple[Panel, str]:
    """Returns the errors on the problem for which the most trees of the methods matter."""
    small = [x for x in methods if _is_gark(x) and not _is_large(x)]
    if len(small) < 2:
        raise NotDrawn(_TOO_FEW)
    tableaus = [x.tableau for x in small]
    name = seeing_problem(tableaus)
    results = [
        converge(method, problem)
        for method, problem in zip(small, in_common(name, tableaus, 1), strict=True)
    ]
    panel = comparison_panel([(x.name, result) for x, result in zip(small, results, strict=True)])
    if len(panel.legend) < 2:
        raise NotDrawn(_TOO_FEW)
    return panel, f"Numerical: all on the problem {name}."
