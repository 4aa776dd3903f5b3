"""Sources that are read within a limit of time, by a process that can be ended.

Grammars of tree-sitter are C: deaf while they parse, and on text of another language they may take
time like the square of its length. Their callbacks end older versions of tree-sitter, and leak.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, TypeVar

from garkcli.bridges.readers.registry import readers_for
from garkcli.bridges.sources import source_text
from garkcli.crew.hiring import hired
from garkcli.crew.work import Limit, WorkerLost, in_order
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
BYTES_PER_TABLE = 1_500
"""And one more for so many of the first ``FULL`` bytes, which a method has that is judged in less
than a second within the rounding of its decimals.
"""
FULL = 60_000
"""A longer source is seldom full of methods."""


class Source(Frozen):
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
    paths: Iterable[str],
    work: Callable[[str, str], list[T]],
    late: Callable[[FoundTable], T],
    jobs: int = 1,
) -> Iterator[list[T]]:
    """The outcome of each source, in order.

    Args:
        paths: of the sources; ``-`` is standard input.
        work: from the text of a source and its name to the outcome; both travel between processes.
        late: the outcome of a source that was not read, as its parser took too long.
        jobs: how many processes read them; 0 is one per processor.

    Raises:
        UsageProblem: a source cannot be read.
    """
    given = [_source(path) for path in paths]
    jobs = min(jobs or os.cpu_count() or 1, len(given))
    is_apart = jobs > 1 or any(source.size > SMALL for source in given)
    limit = Limit(_seconds, partial(_late, late)) if is_apart else None
    done: Callable[[Source], list[T] | Exception] = partial(_done, work)
    with hired(done, _lost, jobs, limit=limit) as workers:
        for found in counting("files", in_order(workers, given), len(given)):
            if isinstance(found, Exception):
                raise found
            yield found


def _source(path: str) -> Source:
    if os.path.isfile(path):
        return Source(path, os.stat(path).st_size)
    text, name = source_text(path)
    return Source(name, len(text), text)


def _seconds(source: Source) -> float:
    """How long it may take to read a source."""
    tables = min(source.size, FULL) // BYTES_PER_TABLE
    return FREE_SECONDS + tables + source.size // BYTES_PER_SECOND


def _done(work: Callable[[str, str], list[T]], source: Source) -> list[T] | Exception:
    """The outcome of one source, or what kept it from being read: both travel."""
    try:
        with doing(source.name):
            text = source_text(source.name)[0] if source.text is None else source.text
            return work(text, source.name)
    except Exception as error:
        return error


def _late(outcome: Callable[[FoundTable], T], source: Source) -> list[T] | Exception:
    why = f"the parser took longer than {_seconds(source):.0f} s"
    readers = readers_for(source.name)
    return [outcome(unread(source.name, readers[0].name if len(readers) == 1 else "", why))]


def _lost(source: Source, why: str) -> list[Any] | Exception:
    return WorkerLost(f"the reading of {source.name} was ended {why}", "use fewer --jobs")
