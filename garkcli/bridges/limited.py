"""Sources that are read, and tables that are judged, within a limit of time, by a process that can
be ended.

Grammars of tree-sitter are C: deaf while they parse, and on text of another language they may take
time like the square of its length. Their callbacks end older versions of tree-sitter, and leak.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import chain
from typing import Any, TypeVar

from garkcli.bridges.readers.registry import readers_for
from garkcli.bridges.sources import source_text
from garkcli.crew.hiring import hired
from garkcli.crew.work import Limit, WorkerLost, Workers, in_order
from garkcli.doing import counting, doing
from garkcli.frozen import Frozen
from garkcli.sources.found import FoundTable, unread

T = TypeVar("T")
SMALL = 8_000
"""Bytes of a source that this process reads, which saves the start of another: grammars take half a
second for the worst of that length that is known.
"""
FREE_SECONDS = 20
"""Seconds that every source has, a hundred times what one of 50 KB takes on an idle machine."""
BYTES_PER_SECOND = 50_000
"""And one more for so many bytes."""
JUDGING_SECONDS = 60.0
"""Seconds that every table has: a pair of order 10 with its 17 stages takes a third of them."""


class SourceToRead(Frozen):
    """A source that is to be read.

    Attributes:
        name: the path of a file; what another source is called.
        size: in bytes of a file, in characters of a text.
        text: of what is no ordinary file, such as standard input: that is this process's.
    """

    name: str
    size: int
    text: str | None = None


def read_within_limits(
    paths: Iterable[str], read: Callable[[str, str], list[FoundTable]], jobs: int = 1
) -> Iterator[FoundTable]:
    """The tables of all sources, in order; a source whose parser takes too long has a place holder.

    Args:
        paths: of the sources; ``-`` is standard input.
        read: from the text of a source and its name to its tables; both travel between processes.
        jobs: how many processes read them; 0 is one per processor.

    Raises:
        UsageProblem: a source cannot be read.
    """
    given = [_source(path) for path in paths]
    with _crew(_Work(read), given, jobs) as workers:
        for tables in _known(workers, given, "files"):
            yield from tables


def judged_within_limits(
    paths: Iterable[str],
    read: Callable[[str, str], list[FoundTable]],
    judge: Callable[[FoundTable], T],
    late: Callable[[FoundTable, str], T],
    jobs: int = 1,
) -> Iterator[T]:
    """The verdict on each table of all sources, in order.

    Args:
        paths: of the sources; ``-`` is standard input.
        read: from the text of a source and its name to its tables; both travel between processes.
        judge: the verdict on a table; it travels too.
        late: the verdict on a table whose judging takes too long, and how long that is.
        jobs: how many processes work; 0 is one per processor.

    Raises:
        UsageProblem: a source cannot be read.
    """
    given = [_source(path) for path in paths]
    with _crew(_Work(read, judge, late), given, jobs) as workers:
        tables = list(chain.from_iterable(_known(workers, given, "files")))
        yield from _known(workers, tables, "tables")


class _Work(Frozen, eq=False):
    """The reading of sources and, where it is requested, the judging of their tables: either item
    has a limit of time of its own.
    """

    read: Callable[[str, str], list[FoundTable]]
    judge: Callable[[FoundTable], Any] | None = None
    late: Callable[[FoundTable, str], Any] | None = None

    def done(self, item: SourceToRead | FoundTable) -> Any:
        """The outcome of an item, or what kept it from having one: both travel."""
        try:
            if isinstance(item, SourceToRead):
                with doing(item.name):
                    text = source_text(item.name)[0] if item.text is None else item.text
                    return self.read(text, item.name)
            return None if self.judge is None else self.judge(item)
        except Exception as error:
            return error

    def given_up(self, item: SourceToRead | FoundTable) -> Any:
        """The outcome of an item that takes too long."""
        seconds = f"longer than {_limit(item):.0f} s"
        if isinstance(item, FoundTable):
            return None if self.late is None else self.late(item, seconds)
        readers = readers_for(item.name)
        format = readers[0].name if len(readers) == 1 else ""
        return [unread(item.name, format, f"the parser took {seconds}")]


def _crew(
    work: _Work, given: Sequence[SourceToRead], jobs: int
) -> AbstractContextManager[Workers[SourceToRead | FoundTable, Any]]:
    """Who reads and judges: other processes, unless there is little to read."""
    jobs = min(jobs or os.cpu_count() or 1, len(given))
    is_apart = jobs > 1 or any(source.size > SMALL for source in given)
    limit = Limit(_limit, work.given_up) if is_apart else None
    return hired(work.done, _lost, jobs, limit=limit)


def _known(
    workers: Workers[SourceToRead | FoundTable, Any],
    items: Sequence[SourceToRead | FoundTable],
    what: str,
) -> Iterator[Any]:
    """Every outcome in order; what kept an item from having one is raised."""
    for found in counting(what, in_order(workers, items), len(items)):
        if isinstance(found, Exception):
            raise found
        yield found


def _source(path: str) -> SourceToRead:
    if os.path.isfile(path):
        return SourceToRead(path, os.stat(path).st_size)
    text, name = source_text(path)
    return SourceToRead(name, len(text), text)


def _limit(item: SourceToRead | FoundTable) -> float:
    """How long it may take to read a source, or to judge a table."""
    return _seconds(item) if isinstance(item, SourceToRead) else JUDGING_SECONDS


def _seconds(source: SourceToRead) -> float:
    """How long it may take to read a source."""
    return FREE_SECONDS + source.size // BYTES_PER_SECOND


def _lost(item: SourceToRead | FoundTable, why: str) -> Exception:
    name = item.name if isinstance(item, SourceToRead) else f"{item.source}:{item.line}"
    return WorkerLost(f"the reading of {name} was ended {why}", "use fewer --jobs")
