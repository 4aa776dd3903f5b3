"""The region of stability, or the trace on the oscillator."""

from __future__ import annotations

from garkcli.webpage.pictures import OF_STABILITY
from garkcli.webpage.reported import Content, Reported
from garkcli.webpage.sections.pictures import drawn


def content(method: Reported) -> Content | None:
    return drawn(method, OF_STABILITY)
