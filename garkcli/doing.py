"""What is being done now, for whoever waits for it.

Work that may take long names itself: ``with doing("reference solution", steps) as work``, and says
how far it is by ``work.reach(done)``. Without a listener that is all that happens; the one of the
command line is in ``garkcli.page.progress``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Protocol, TypeVar

from garkcli.frozen import Mutable

T = TypeVar("T")


class Listener(Protocol):
    """Hears what begins, how far it is, and what ends; work may begin within other work."""

    def begin(self, work: Work) -> None:
        """Take note of what is being done from now on."""
        ...

    def changed(self) -> None:
        """Take note that something is further than before."""
        ...

    def end(self, work: Work) -> None:
        """Take note of what is done, or has failed."""
        ...

    def hush(self) -> None:
        """Nobody wants to hear any more."""
        ...


class Work(Mutable, eq=False):
    """One thing that is being done.

    Attributes:
        what: in a few words.
        total: how many parts it has; None where nobody knows.
        listener: who hears, if anybody.
        done: how many of the parts are done.
    """

    what: str
    total: int | None = None
    listener: Listener | None = None
    done: int = 0

    def reach(self, done: int) -> None:
        """So many parts are done."""
        self.done = done
        if self.listener is not None:
            self.listener.changed()

    def __str__(self) -> str:
        """What is being done, and how much of it where there is more than one part."""
        if self.total is not None and self.total > 1:
            return f"{self.what}, {self.done} of {self.total}"
        return f"{self.what}, {self.done}" if self.done else self.what


_listener: ContextVar[Listener | None] = ContextVar("listener", default=None)


def listener() -> Listener | None:
    """Who hears, if anybody."""
    return _listener.get()


@contextmanager
def telling(who: Listener | None) -> Iterator[None]:
    """Tell ``who`` meanwhile, and nobody else; None for nobody at all."""
    token = _listener.set(who)
    try:
        yield
    finally:
        _listener.reset(token)


def hush() -> None:
    """Tell nobody any more: a person types, reads the report, or wants to hear nothing."""
    who = _listener.get()
    if who is not None:
        who.hush()


@contextmanager
def doing(what: str, total: int | None = None) -> Iterator[Work]:
    """Say what is being done.

    >>> with doing("steps", 2) as work:
    ...     work.reach(1)
    """
    who = _listener.get()
    work = Work(what, total, who)
    if who is None:
        yield work
        return
    who.begin(work)
    try:
        yield work
    finally:
        who.end(work)


def counting(what: str, items: Iterable[T], total: int | None = None) -> Iterator[T]:
    """The same items, counted as they go by.

    >>> list(counting("trees", "ab", 2))
    ['a', 'b']
    """
    if _listener.get() is None:
        yield from items
        return
    with doing(what, total) as work:
        for item in items:
            yield item
            work.reach(work.done + 1)
