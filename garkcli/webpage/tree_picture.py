"""A tree as a picture within the page, made of dots that all trees share."""

from __future__ import annotations

from collections.abc import Iterable

from markupsafe import Markup, escape

from garkcli.ntrees.drawing import PALETTE, layout
from garkcli.ntrees.tree import Tree

STEP_X = 22
STEP_Y = 24
RADIUS = 8
MARGIN = 2
"""Sizes in pixels."""


def tree_picture(tree: Tree, title: str, has_colours: bool) -> Markup:
    """Returns a picture of a tree with the root at the bottom, as Butcher draws them.

    ``title`` is for screen readers; ``has_colours`` puts the numbers of colours on the dots.
    """
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
    """Returns the name of the dot of a colour, counted from 0."""
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
