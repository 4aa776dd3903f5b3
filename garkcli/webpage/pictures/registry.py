"""The pictures of a method, in their order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from garkcli.errors import GarkError
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures import convergence, damped, energy, region, trace
from garkcli.webpage.pictures.compared import compared
from garkcli.webpage.pictures.picture import NotDrawn, Picture

Draw: TypeAlias = Callable[[GarkMethod], Picture]

PICTURES: dict[str, tuple[str, Draw]] = {
    "region": ("Stability region", region.draw),
    "pair": ("Implicit-explicit pair", damped.draw),
    "oscillator": ("Oscillator", trace.draw),
    "convergence": ("Convergence", convergence.draw),
    "energy": ("Energy error over a long time", energy.draw),
}
"""Titles and what draws, by name."""


def pictures(method: GarkMethod) -> list[Picture]:
    """All pictures of a method. One that is expected and is not there has no SVG, and a note that
    says why.

    Args:
        method: with numbers as coefficients.
    """
    drawn = [_drawn(name, title, draw, method) for name, (title, draw) in PICTURES.items()]
    return [picture for picture in drawn if picture.svg or picture.note]


def compared_pictures(methods: Sequence[GarkMethod]) -> list[Picture]:
    """Pictures that several methods have together, of the first four."""
    return compared(methods)


def _drawn(name: str, title: str, draw: Draw, method: GarkMethod) -> Picture:
    try:
        return draw(method)
    except NotDrawn as error:
        return Picture(name, title, "", "", str(error))
    except GarkError as error:
        # of a problem that the method is not for
        return Picture(name, title, "", "", f"Not drawn: {error}.")
