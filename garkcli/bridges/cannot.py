"""The error of a method that a target cannot hold."""

from __future__ import annotations

from garkcli.errors import GarkError


class CannotExport(GarkError):
    """A target cannot hold the method: ``message`` is the reason, ``help`` the cure."""

    code = "cannot-export"
