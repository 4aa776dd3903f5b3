"""Reading of sources and judging of tables within a time limit, by a process that can be ended.

Grammars of tree-sitter are C code: they cannot be interrupted, and on text of another language they
may take quadratic time. Their callbacks crash older versions of tree-sitter, and leak.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import chain
from typing import Any, TypeVar

from garkcli.bridges.readers.registry import readers_for
from garkcli.bridges.sources import source_text
from garkcli.crew.hiring import hired
from garkcli.crew.work import Limit, WorkerLost, Workers, in_order
from garkcli.doing import counting, doing
from garkcli.errors import GarkError
from garkcli.frozen import Frozen
from garkcli.sources.found import FoundTable, unread

T = TypeVar("T")
SMALL = 8_000
"""Bytes of a source read in this process: the worst known text takes grammars half a second."""
FREE_SECONDS = 20
"""Seconds for every source: a hundred times those for 50 KB on an idle machine."""
BYTES_PER_SECOND = 50_000
JUDGING_SECONDS = 60.0
"""Seconds for every table: a pair of order 10 with its 17 stages takes a third of them."""


class SourceToRead(Frozen):
    """``size`` is in bytes or characters; only this process reads a ``text``, as standard input."""

    name: str
    size: int
    text: str | None = None


def read_within_limits(
    paths: Iterable[str], read: Callable[[str, str], list[FoundTable]], jobs: int = 1
) -> Iterator[FoundTable]:
    """A placeholder if a parser takes too long; ``read`` is picklable."""
    sources = [_source(path) for path in paths]
    with _crew(_Work(read), sources, jobs) as workers:
        for tables in _known(workers, sources, "files"):
            yield from tables


def judged_within_limits(
    paths: Iterable[str],
    read: Callable[[str, str], list[FoundTable]],
    judge: Callable[[FoundTable], T],
    late: Callable[[FoundTable, str], T],
    jobs: int = 1,
) -> Iterator[T]:
    """``late`` judges tables that take too long; ``read`` and ``judge`` are picklable."""
    sources = [_source(path) for path in paths]
    with _crew(_Work(read, judge, late), sources, jobs) as workers:
        tables = list(chain.from_iterable(_known(workers, sources, "files")))
        yield from _known(workers, tables, "tables")


class _Work(Frozen, eq=False):
    read: Callable[[str, str], list[FoundTable]]
    judge: Callable[[FoundTable], Any] | None = None
    late: Callable[[FoundTable, str], Any] | None = None

    def done(self, item: SourceToRead | FoundTable) -> Any:
        """The result for an item, or the exception: both are picklable."""
        try:
            if isinstance(item, SourceToRead):
                with doing(item.name):
                    text = source_text(item.name)[0] if item.text is None else item.text
                    return self.read(text, item.name)
            return None if self.judge is None else self.judge(item)
        except Exception as error:
            # a fault in one source is a note there: the others are read
            if isinstance(error, GarkError | MemoryError | OSError) or not isinstance(
                item, SourceToRead
            ):
                return error
            if "--debug" in sys.argv:
                return error
            what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
            return _unread(item, f"internal fault: {what}; please report it, with the file")

    def given_up(self, item: SourceToRead | FoundTable) -> Any:
        seconds = f"longer than {_limit(item):.0f} s"
        if isinstance(item, FoundTable):
            return None if self.late is None else self.late(item, seconds)
        return _unread(item, f"the parser took {seconds}")


def _unread(item: SourceToRead, why: str) -> list[FoundTable]:
    readers = readers_for(item.name)
    return [unread(item.name, readers[0].name if len(readers) == 1 else "", why)]


def _crew(
    work: _Work, given: Sequence[SourceToRead], jobs: int
) -> AbstractContextManager[Workers[SourceToRead | FoundTable, Any]]:
    """Other processes, unless there is little to read."""
    jobs = min(jobs or os.cpu_count() or 1, len(given))
    is_apart = jobs > 1 or any(source.size > SMALL for source in given)
    limit = Limit(_limit, work.given_up) if is_apart else None
    return hired(work.done, _lost, jobs, limit=limit)


def _known(
    workers: Workers[SourceToRead | FoundTable, Any],
    items: Sequence[SourceToRead | FoundTable],
    what: str,
) -> Iterator[Any]:
    for result in counting(what, in_order(workers, items), len(items)):
        if isinstance(result, Exception):
            raise result
        yield result


def _source(path: str) -> SourceToRead:
    if os.path.isfile(path):
        return SourceToRead(path, os.stat(path).st_size)
    text, name = source_text(path)
    return SourceToRead(name, len(text), text)


def _limit(item: SourceToRead | FoundTable) -> float:
    return _seconds(item) if isinstance(item, SourceToRead) else JUDGING_SECONDS


def _seconds(source: SourceToRead) -> float:
    return FREE_SECONDS + source.size // BYTES_PER_SECOND


def _lost(item: SourceToRead | FoundTable, why: str) -> Exception:
    name = item.name if isinstance(item, SourceToRead) else f"{item.source}:{item.line}"
    return WorkerLost(f"the reading of {name} was ended {why}", "use fewer --jobs")
