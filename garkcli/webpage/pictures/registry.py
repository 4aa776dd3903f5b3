"""The pictures of a method, in their order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from garkcli.errors import GarkError
from garkcli.methodfile.build import MethodFile
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.webpage.pictures import convergence, damped, energy, region, trace
from garkcli.webpage.pictures.compared import compared
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.subject import Subject

Draw: TypeAlias = Callable[[Subject], Picture]

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
        method: with numbers as coefficients. One from a file that gives ``methods`` is put to work
            on Hamiltonian problems as its symplectic pair, as ``gark converge`` does it.
    """
    subject = _subject(method)
    drawn = [_drawn(name, title, draw, subject) for name, (title, draw) in PICTURES.items()]
    return [picture for picture in drawn if picture.svg or picture.note]


def compared_pictures(methods: Sequence[GarkMethod]) -> list[Picture]:
    """Pictures that several methods have together, of the first four."""
    return compared([_subject(method) for method in methods])


def _subject(method: GarkMethod) -> Subject:
    gives_methods = isinstance(method, MethodFile) and method.form == "methods"
    return Subject(method, gives_methods)


def _drawn(name: str, title: str, draw: Draw, subject: Subject) -> Picture:
    try:
        return draw(subject)
    except NotDrawn as error:
        return Picture(name, title, "", "", str(error))
    except GarkError as error:
        # of a problem that the method is not for
        return Picture(name, title, "", "", f"Not drawn: {error}.")
