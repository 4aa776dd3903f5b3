"""Why a method cannot be written for a target."""

from __future__ import annotations

from garkcli.errors import GarkError


class CannotExport(GarkError):
    """A target cannot hold the method: ``message`` is the reason, ``help`` the cure."""

    code = "cannot-export"

    def __init__(self, reason: str, cure: str, *, code: str = "") -> None:
        super().__init__(reason, cure, code=code)
        self.reason = reason
        self.cure = cure
