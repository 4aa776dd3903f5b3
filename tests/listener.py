"""A listener of work that takes long, for tests."""

from __future__ import annotations

from garkcli.doing import Work


class Listener:
    """Keeps all that it is told."""

    def __init__(self) -> None:
        self.told: list[Work] = []
        self.is_hushed = False

    def begin(self, work: Work) -> None:
        """Keep the work."""
        self.told.append(work)

    def changed(self) -> None:
        """How far it is stands in the work."""

    def end(self, work: Work) -> None:
        """Nothing ends that has not begun."""
        assert work in self.told

    def hush(self) -> None:
        """Somebody has had enough."""
        self.is_hushed = True
