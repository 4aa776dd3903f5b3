"""The warnings about a method, which are about no claim."""

from __future__ import annotations

from garkcli.check.findings import warnings
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    """Returns the variables of the template; None without warnings."""
    found = list(warnings(method.outcome))
    return {"warnings": found} if found else None
