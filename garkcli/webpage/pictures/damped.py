"""Implicit-explicit pairs: the z of the explicit colour for which every z of the implicit one in
the left half plane is damped.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby, pairwise

import numpy as np
from flint import fmpq

from garkcli.plots.plane import modulus, window_of
from garkcli.stability.damping import ImexPair, imex_pair
from garkcli.stability.fraction import stability_fraction
from garkcli.stability.linear import StabilityFunction, stability_function
from garkcli.stability.summary import directions
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures.drawing import Frame, colour
from garkcli.webpage.pictures.elements import Point
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.region import draw_region, finished, frame_of

_COLUMNS = 60
_ROWS = 60
"""Even: the lower half is the upper one upside down."""
_MOST_STAGES = 14
_ABOVE_ONE = 1.001
"""Where |R(z_E, 0)| is larger there is nothing to decide: z_I = 0 is not damped."""
_TITLE = "Implicit-explicit pair"


def draw(method: GarkMethod) -> Picture:
    """The region of one method, each square decided at its centre.

    Raises:
        NotDrawn: it is no such pair, or a large one; or its coefficients are rounded.
    """
    pair, explicit = _pair(method)
    window = window_of([explicit], is_symmetric=False)
    frame = frame_of(window)
    edges = np.linspace(window.left, window.right, _COLUMNS + 1)
    heights = np.linspace(0.0, window.top, _ROWS // 2 + 1)
    for bottom, top in pairwise(heights.tolist()):
        for low, high in _damped(pair, explicit, edges.tolist(), bottom, top):
            _fill(frame, low, high, (bottom, top))
            _fill(frame, low, high, (-top, -bottom))
    draw_region(frame, window, explicit, 1, is_filled=False)
    e = pair.explicit + 1
    i = pair.implicit + 1
    names = f"z{e} with every z{i} damped", f"the same with z{i} = 0 alone"
    frame.legend.extend(enumerate(names))
    description = (
        f"The complex plane of z{e}, filled where |R(z{e}, z{i})| is at most 1 for all z{i} in the "
        f"left half plane; outlined where it is for z{i} = 0."
    )
    labels = f"Re z{e}", f"Im z{e}"
    svg = finished(frame, window, _TITLE, description, labels)
    note = (
        f"Filled: the z{e} of the explicit colour for which |R(z{e}, z{i})| ≤ 1 for all z{i} in "
        "the left half plane, each square decided exactly at its centre."
    )
    return Picture("pair", _TITLE, description, svg, note)


def _pair(method: GarkMethod) -> tuple[ImexPair, StabilityFunction]:
    """The pair, and R of its explicit colour alone."""
    tableau = method.tableau
    alone = directions(tableau)[1:]
    is_small = sum(method.stages) <= _MOST_STAGES
    is_exact = method.tolerance is None
    found = None
    if len(alone) == 2 and is_small and is_exact:
        R = stability_fraction(tableau)
        found = imex_pair(tableau, R)
    if found is None:
        raise NotDrawn("")
    _, shares = alone[found.explicit]
    return found, stability_function(tableau, shares)


def _damped(
    pair: ImexPair, explicit: StabilityFunction, edges: list[float], bottom: float, top: float
) -> Iterator[Point]:
    """The ends of each run of squares of a row that are damped."""
    b = (bottom + top) / 2
    centres = [(x + y) / 2 for x, y in pairwise(edges)]
    row = np.array(centres) + 1j * b
    sizes = modulus(explicit, row)
    exact_b = _exact(b)
    found = []
    for a, size in zip(centres, sizes.tolist(), strict=True):
        is_damped = False
        if size <= _ABOVE_ONE:
            is_damped = pair.is_damped(_exact(a), exact_b)
        found.append(is_damped)
    every = range(len(found))
    for is_damped, run in groupby(every, found.__getitem__):
        first, *others = run
        last = others[-1] if others else first
        if is_damped:
            yield edges[first], edges[last + 1]


def _exact(x: float) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def _fill(frame: Frame, low: float, high: float, span: Point) -> None:
    bottom, top = span
    paint = colour(0)
    frame.rectangle(
        (low, bottom),
        (high, top),
        style=f"fill:{paint}",
        fill_opacity="0.35",
        shape_rendering="crispEdges",  # no seams between squares
    )
