"""The pictures: stability, errors over step sizes, energy."""

from __future__ import annotations

from importlib.util import find_spec

from garkcli.upward import found
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    if method.method is None or not method.has_pictures:
        return None
    if find_spec("garkcli.webpage.pictures") is None:
        return None
    drawn = found("webpage.pictures", "pictures")(method.method)
    return {"pictures": drawn} if drawn else None


SECTION = Section("pictures", "Pictures", _content)
