"""The current work, for whoever waits for it: ``with doing("reference solution", steps) as work``,
and ``work.reach(done)``. The listener of the command line is in ``garkcli.page.progress``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Protocol, TypeVar

from garkcli.frozen import Mutable

T = TypeVar("T")


class Listener(Protocol):
    """Receives the beginning, progress and end of work; work may begin within other work."""

    def begin(self, work: Work) -> None: ...

    def changed(self) -> None: ...

    def end(self, work: Work) -> None: ...

    def hush(self) -> None: ...


class Work(Mutable, eq=False):
    """A piece of work; ``total`` is the number of its parts, None if unknown."""

    what: str
    total: int | None = None
    listener: Listener | None = None
    done: int = 0

    def reach(self, done: int) -> None:
        self.done = done
        if self.listener is not None:
            self.listener.changed()

    def __str__(self) -> str:
        if self.total is not None and self.total > 1:
            return f"{self.what}, {self.done} of {self.total}"
        return f"{self.what}, {self.done}" if self.done else self.what


_listener: ContextVar[Listener | None] = ContextVar("listener", default=None)


def listener() -> Listener | None:
    return _listener.get()


@contextmanager
def telling(who: Listener | None) -> Iterator[None]:
    token = _listener.set(who)
    try:
        yield
    finally:
        _listener.reset(token)


def hush() -> None:
    """Stops the listener: a person types or reads the report."""
    who = _listener.get()
    if who is not None:
        who.hush()


@contextmanager
def doing(what: str, total: int | None = None) -> Iterator[Work]:
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
    """The items, counted as they go by."""
    if _listener.get() is None:
        yield from items
        return
    with doing(what, total) as work:
        for item in items:
            yield item
            work.reach(work.done + 1)
