"""Worker processes that run side by side; a lost one is replaced."""

from __future__ import annotations

import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, nullcontext, suppress
from time import monotonic
from typing import TYPE_CHECKING, Generic, cast

from garkcli.crew.work import Item, Limit, Outcome
from garkcli.deadline import FOR_EVER, check_time, seconds_left
from garkcli.doing import telling
from garkcli.ending import undone
from garkcli.exact.apart import begin, end, start_method, without_handlers, without_program
from garkcli.exact.pickling import register

if TYPE_CHECKING:  # slow to import, and of no use to work that is not shared
    from multiprocessing.connection import Connection
    from multiprocessing.context import BaseContext
    from multiprocessing.process import BaseProcess

MOST_WORKERS = 60
"""Windows waits for at most 63 things at a time, some of which are its own."""
PATIENCE = 10
"""The limit by the clock, as a multiple of that of processor time."""
BATCH = 8
"""Most items at hand for a worker, so that it need not wait for the next."""


class _Worker(Generic[Item, Outcome]):
    """A process that does the items it is sent, by their indices, one after the other. The current
    one may be late at ``due``, is late at ``last`` on the clock, and after the processor time
    ``most``.
    """

    def __init__(
        self,
        context: BaseContext,
        work: Callable[[Item], Outcome],
        others: Sequence[Connection],
        is_own: bool,
    ) -> None:
        self.items: deque[int] = deque()
        self.due = self.last = self.most = FOR_EVER
        self.connection, other = context.Pipe()
        # a forked worker has the ends of this process too; while it holds them nobody hears that
        # this process has ended
        is_forked = context.get_start_method() == "fork"
        not_its_own = [self.connection, *others] if is_forked else []
        self.process: BaseProcess = context.Process(  # type: ignore[attr-defined]
            target=_serve, args=(other, work, not_its_own), daemon=True
        )
        self._is_own, self._other = is_own, other

    def begin(self) -> None:
        with without_program() if self._is_own else nullcontext():
            begin(self.process)
        self._other.close()

    def send(self, number: int, item: Item) -> None:
        self.items.append(number)
        with suppress(OSError):
            self.connection.send(item)

    def limit(self, seconds: float) -> None:
        now = monotonic()
        self.due, self.last = now + seconds, now + PATIENCE * seconds
        self.most = _worked(self.process) + seconds

    def is_late(self) -> bool:
        """Whether the item's time is over; extends the limit by the processor time left."""
        now = monotonic()
        if self.due <= now < self.last:
            self.due = min(now + max(0.0, self.most - _worked(self.process)), self.last)
        return self.due <= now

    def end(self) -> None:
        self.connection.close()
        end(self.process)


class Crew(Generic[Item, Outcome]):
    """Worker processes, of which a lost one is replaced, and the work left for them. ``crashed``
    makes the outcome of an item that ended its worker, from how it ended. A ``limit`` is for work
    of gark itself, not of the calling program.
    """

    def __init__(
        self,
        work: Callable[[Item], Outcome],
        size: int,
        crashed: Callable[[Item, str], Outcome],
        limit: Limit[Item, Outcome] | None = None,
    ) -> None:
        from multiprocessing import get_context

        register()
        # a source may be read in a program that has threads, whose locks a fork would copy
        is_threaded = limit is not None and threading.active_count() > 1
        self.context: BaseContext = get_context("spawn" if is_threaded else start_method())
        self.work = work
        self.items: Sequence[Item] = ()
        self.crashed = crashed
        self.limit = limit
        self.waiting: deque[int] = deque()
        self.size = size
        self.workers: list[_Worker[Item, Outcome]] = []
        self._stack = ExitStack()

    def __enter__(self) -> Crew[Item, Outcome]:
        self._stack.enter_context(undone())
        self._stack.callback(self._end)
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def _end(self) -> None:
        for worker in self.workers:
            worker.end()

    def as_they_come(self, items: Sequence[Item]) -> Iterator[tuple[int, Outcome]]:
        """Yields each outcome with the index of its item; more items may follow."""
        from multiprocessing.connection import wait

        self.items = items
        self.waiting = deque(range(len(items)))
        # workers that died when they had nothing to do: no item is to blame for it
        for worker in [x for x in self.workers if not x.process.is_alive()]:
            worker.end()
            self.workers.remove(worker)
        for worker in self.workers:
            self._supply(worker)
        self._hire()
        while any(worker.items for worker in self.workers):
            by_connection = {worker.connection: worker for worker in self.workers}
            ready = wait(list(by_connection), self._seconds_left())
            if not ready:
                yield from self._end_late()
            for found in ready:
                # of a type of its own on Windows
                connection = cast("Connection", found)
                worker = by_connection[connection]
                number = worker.items[0] if worker.items else -1
                try:
                    outcome = connection.recv()
                except (EOFError, OSError):
                    yield from self._bury(worker)
                    continue
                worker.items.popleft()
                self._begin(worker)
                self._supply(worker)
                yield number, outcome

    def _hire(self) -> None:
        while len(self.workers) < self.size and self.waiting:
            others = [worker.connection for worker in self.workers]
            is_own = self.limit is not None
            worker: _Worker[Item, Outcome] = _Worker(self.context, self.work, others, is_own)
            self.workers.append(worker)
            worker.begin()
            self._supply(worker)

    def _supply(self, worker: _Worker[Item, Outcome]) -> None:
        most = max(1, min(BATCH, len(self.waiting) // self.size))
        while self.waiting and len(worker.items) < most:
            number = self.waiting.popleft()
            worker.send(number, self.items[number])
            if len(worker.items) == 1:
                self._begin(worker)

    def _begin(self, worker: _Worker[Item, Outcome]) -> None:
        # an item that is already done is never late
        if self.limit is not None and worker.items:
            worker.limit(self.limit.seconds(self.items[worker.items[0]]))

    def _seconds_left(self) -> float | None:
        left = seconds_left()
        if self.limit is None:
            return left
        until_due = max(0.0, min(x.due for x in self.workers if x.items) - monotonic())
        return until_due if left is None else min(left, until_due)

    def _end_late(self) -> Iterator[tuple[int, Outcome]]:
        check_time()
        for worker in [x for x in self.workers if x.items and x.is_late()]:
            yield from self._bury(worker, is_late=True)

    def _bury(
        self, worker: _Worker[Item, Outcome], is_late: bool = False
    ) -> Iterator[tuple[int, Outcome]]:
        # its item is blamed, the others go back to the queue
        worker.end()
        self.workers.remove(worker)
        items = list(worker.items)
        self.waiting.extendleft(reversed(items[1:]))
        if items:
            item = self.items[items[0]]
            if is_late and self.limit is not None:
                yield items[0], self.limit.late(item)
            else:
                yield items[0], self.crashed(item, _cause(worker.process.exitcode))
        self._hire()


def _worked(process: BaseProcess) -> float:
    # the processor time of another process if the system tells it, else the clock
    if sys.platform == "linux" and process.pid is not None:
        with suppress(OSError):
            return time.clock_gettime((~process.pid << 3) | 2)  # as clock_getcpuclockid(3) has it
    return monotonic()


def _cause(code: int | None) -> str:
    import signal

    if code is None or code >= 0:
        return f"with exit code {code}"
    name = f"signal {-code}"
    with suppress(ValueError):
        name = signal.Signals(-code).name
    more = ", as the system does where memory is short" if name == "SIGKILL" else ""
    return f"by {name}{more}"


def _serve(
    connection: Connection, work: Callable[[Item], Outcome], not_its_own: Sequence[Connection]
) -> None:
    # an interrupt is left to the process with the terminal, which ends the workers
    without_handlers()
    register()
    for other in not_its_own:
        other.close()
    # the terminal is that of the process that hired this one
    with telling(None), suppress(EOFError, OSError):
        while True:
            connection.send(work(connection.recv()))
