"""From what a walk over a source meets to tables, one part of the source after the other."""

from __future__ import annotations

from garkcli.bridges.readers.assignments import Assigned, Begun, Walk
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import FoundTable
from garkcli.sources.naming import Scope


class Finder:
    """Collects arrays into tables.

    Args:
        source: what the source is called.
        allowance: of it.

    Attributes:
        found: the tables so far.
    """

    def __init__(self, source: str, allowance: Allowance) -> None:
        self.found: list[FoundTable] = []
        self._source = source
        self._allowance = allowance
        self._scope = Scope()

    def begin(self, title: str) -> None:
        """Another part begins: a function, a branch, an association."""
        self.end()
        self._scope = Scope(title)

    def end(self) -> None:
        """A part ends: what is collected are its tables."""
        raise NotImplementedError

    def assigned(self, event: Assigned) -> None:
        """A name has a value."""
        raise NotImplementedError


def tables_of(walk: Walk, finder: Finder) -> list[FoundTable]:
    """The tables of a source, by their lines."""
    for event in walk.events():
        match event:
            case Begun():
                finder.begin(event.title)
            case Assigned():
                finder.assigned(event)
    finder.end()
    return sorted(finder.found, key=lambda x: x.line)
