"""A progress bar on stderr, on a terminal, for work that lasts longer than half a second."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

T = TypeVar("T")
PATIENCE = 0.5
"""Seconds of work before a bar appears."""
_EVERY = 64


def _is_watched() -> bool:
    """Whether somebody sees standard error; a terminal that cannot move its cursor shows no bar."""
    return sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def tracked(items: Iterable[T], total: int | None, what: str, wanted: bool = True) -> Iterator[T]:
    """The same items; a bar counts them once they have taken longer than ``PATIENCE``.

    Args:
        items: what is worked through.
        total: how many there will be; None where nobody knows.
        what: the word beside the bar.
        wanted: False for a report that goes to the same terminal as the bar, or for ``--quiet``.
    """
    if not wanted or not _is_watched():
        yield from items
        return
    start, iterator = monotonic(), iter(items)
    for done, item in enumerate(iterator, start=1):
        yield item
        if monotonic() - start > PATIENCE:
            yield from _with_bar(iterator, total, done, what)
            return


def _with_bar(items: Iterator[T], total: int | None, done: int, what: str) -> Iterator[T]:
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(what, total=total, completed=done)
        pending = 0
        for item in items:
            yield item
            pending += 1
            if pending == _EVERY or total is None or total < 1000:
                progress.advance(task, pending)
                pending = 0


@contextmanager
def watching(wanted: bool = True) -> Iterator[Callable[[str, int, int], None]]:
    """A function to be told what is being done, how much of it is, and of how much: it shows that
    as one bar.

    The bar appears once all of it has taken longer than ``PATIENCE``, and goes away at the end.

    Args:
        wanted: False for ``--quiet``.
    """
    if not wanted or not _is_watched():
        yield lambda *_: None
        return
    bar = _Bar()
    try:
        yield bar.show
    finally:
        bar.close()


class _Bar:
    """One bar for a sequence of things that are done step by step."""

    def __init__(self) -> None:
        self.start = monotonic()
        self.progress: Progress | None = None
        self.task: TaskID | None = None

    def show(self, what: str, done: int, total: int) -> None:
        """How far ``what`` is now."""
        if self.progress is None:
            if monotonic() - self.start < PATIENCE:
                return
            from rich.console import Console
            from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

            columns = (
                TextColumn("{task.description}"),
                BarColumn(),
                MofNCompleteColumn(),
                TextColumn("steps"),
            )
            self.progress = Progress(*columns, console=Console(stderr=True), transient=True)
            self.task = self.progress.add_task(what, total=total)
            self.progress.start()
        assert self.task is not None
        self.progress.update(self.task, description=what, completed=done, total=total)

    def close(self) -> None:
        """Take the bar away."""
        if self.progress is not None:
            self.progress.stop()
