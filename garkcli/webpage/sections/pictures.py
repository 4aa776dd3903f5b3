"""Pictures of steps: errors against step sizes, energy."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from garkcli.webpage.mathml import Typeset
from garkcli.webpage.pictures import OF_STEPS, Picture, compared_pictures, pictures
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    if method.has_pictures and method.free is not None:
        return {"free": method.free, "file": method.outcome.file}
    return drawn(method, OF_STEPS if _has_energy(method) else OF_STEPS[:1])


def _has_energy(method: Reported) -> bool:
    """Returns whether energies matter: the method is made for them, or with details."""
    outcome = method.outcome
    is_made = outcome.analysis is not None and outcome.analysis.symplectic
    return method.has_details or method.tells_pair or is_made


def drawn(method: Reported, names: Sequence[str]) -> Content | None:
    if method.method is None or not method.has_pictures:
        return None
    found = [_shown(picture) for picture in pictures(method.method, names)]
    return {"pictures": found} if found else None


def of_several(methods: Sequence[Reported]) -> list[Content]:
    drawn = [x.method for x in methods if x.has_pictures]
    given = [method for method in drawn if method is not None]
    return [] if len(given) < 2 else [_shown(picture) for picture in compared_pictures(given)]


def _shown(picture: Picture) -> Content:
    """Returns a picture, whose SVG consists of numbers and escaped text."""
    note = Markup(Typeset().prose(picture.note))
    return {"about": picture, "svg": Markup(picture.svg), "note": note}
