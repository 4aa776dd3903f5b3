"""Why a method cannot be written for a target."""

from __future__ import annotations

from garkcli.errors import GarkError


class CannotExport(GarkError):
    """A target cannot hold the method: ``message`` is the reason, ``help`` the cure."""

    code = "cannot-export"
