"""The region of stability, or the trace on the oscillator."""

from __future__ import annotations

from garkcli.webpage.pictures import OF_STABILITY
from garkcli.webpage.reported import Content, Reported
from garkcli.webpage.sections.pictures import drawn


def content(method: Reported) -> Content | None:
    """Returns the variables of the template; None without such a picture."""
    return drawn(method, OF_STABILITY)
