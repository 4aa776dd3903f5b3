"""The pictures: stability, errors over step sizes, energy."""

from __future__ import annotations

from markupsafe import Markup

from garkcli.webpage.pictures import Picture, pictures
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    if method.method is None or not method.has_pictures:
        return None
    drawn = [_shown(picture) for picture in pictures(method.method)]
    return {"pictures": drawn} if drawn else None


def _shown(picture: Picture) -> Content:
    """A picture, whose SVG is made of numbers and of text that is escaped there."""
    return {"about": picture, "svg": Markup(picture.svg)}


SECTION = Section("pictures", "Pictures", _content)
