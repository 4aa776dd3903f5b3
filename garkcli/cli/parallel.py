"""Many files side by side, with the same outcome as one after the other, whatever becomes of a
worker.
"""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from typing import TYPE_CHECKING

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.errors import Fault
from garkcli.methodfile.load import NO_SETTINGS

if TYPE_CHECKING:  # slow to import, and of no use to a check of one file
    from multiprocessing.connection import Connection
    from multiprocessing.context import BaseContext
    from multiprocessing.process import BaseProcess

Work = Callable[[str], Outcome]
MOST_WORKERS = 60
"""Windows waits for 63 things at a time, a few of which are its own."""
BATCH = 8
"""Files that a worker has at hand: it should not wait while another's outcome is read."""


def check_files(
    paths: Sequence[str],
    limit: int,
    want_constants: bool,
    jobs: int,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Iterator[Outcome]:
    """Check ``paths`` in their order, ``jobs`` of them at a time.

    A file that ends its worker, by a lack of memory or a signal, has an outcome that says so, and
    the others are checked as if nothing had been.
    """
    check = partial(
        check_file, limit=limit, want_constants=want_constants, settings=settings
    )
    work: Work = partial(_checked, check)
    jobs = min(jobs, len(paths), MOST_WORKERS)
    if jobs < 2 or "-" in paths:
        yield from map(work, paths)
        return
    with _Crew(work, paths, jobs) as crew:
        yield from crew.outcomes()


def _checked(check: Work, path: str) -> Outcome:
    """The outcome of one file, also where the program has a fault."""
    try:
        return check(path)
    except Exception as error:
        if "--debug" in sys.argv:
            raise
        what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
        return _crashed(
            path, f"internal fault: {what}", "please report it, with the file"
        )


def _crashed(path: str, what: str, cure: str) -> Outcome:
    return Outcome(path, path, faults=(Fault(what, cure),), is_crash=True)


class _Worker:
    """A process that checks the files it is sent, one after the other."""

    def __init__(self, context: BaseContext, work: Work) -> None:
        self.files: deque[int] = deque()
        self.connection, other = context.Pipe()
        self.process: BaseProcess = context.Process(  # type: ignore[attr-defined]
            target=_serve, args=(other, work), daemon=True
        )
        # a worker that is interrupted before it is ready would say so
        with _without_interrupts():
            self.process.start()
        other.close()

    def send(self, number: int, path: str) -> None:
        """One more file; a worker that has died is found out when it does not answer."""
        self.files.append(number)
        with suppress(OSError):
            self.connection.send(path)

    def end(self) -> None:
        """End the process, whatever it is at."""
        self.connection.close()
        self.process.kill()
        self.process.join()


class _Crew:
    """Workers, and what is left for them."""

    def __init__(self, work: Work, paths: Sequence[str], size: int) -> None:
        import multiprocessing

        from garkcli.exact.pickling import register

        register()
        # fork keeps the modules that are loaded already, where the system has it
        method = "fork" if "fork" in multiprocessing.get_all_start_methods() else None
        self.context: BaseContext = multiprocessing.get_context(method)
        self.work = work
        self.paths = paths
        self.waiting = deque(range(len(paths)))
        self.size = size
        self.workers: list[_Worker] = []

    def __enter__(self) -> _Crew:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self.workers:
            worker.end()

    def outcomes(self) -> Iterator[Outcome]:
        """Every outcome, in the order of the files."""
        ready: dict[int, Outcome] = {}
        following = 0
        for number, outcome in self._as_they_come():
            ready[number] = outcome
            while following in ready:
                yield ready.pop(following)
                following += 1

    def _as_they_come(self) -> Iterator[tuple[int, Outcome]]:
        from multiprocessing.connection import Connection, wait

        self._hire()
        while any(worker.files for worker in self.workers):
            by_connection = {worker.connection: worker for worker in self.workers}
            for found in wait(list(by_connection)):
                assert isinstance(found, Connection)
                worker = by_connection[found]
                number = worker.files[0] if worker.files else -1
                try:
                    outcome = found.recv()
                except (EOFError, OSError):
                    yield from self._bury(worker)
                    continue
                worker.files.popleft()
                self._supply(worker)
                yield number, outcome

    def _hire(self) -> None:
        """As many workers as there is work for."""
        while len(self.workers) < self.size and self.waiting:
            worker = _Worker(self.context, self.work)
            self.workers.append(worker)
            self._supply(worker)

    def _supply(self, worker: _Worker) -> None:
        """Files ahead of what a worker is at, fewer when there are few for all."""
        most = max(1, min(BATCH, len(self.waiting) // self.size))
        while self.waiting and len(worker.files) < most:
            number = self.waiting.popleft()
            worker.send(number, self.paths[number])

    def _bury(self, worker: _Worker) -> Iterator[tuple[int, Outcome]]:
        """A worker that died: the file it was at is to blame, the others go back."""
        worker.end()
        self.workers.remove(worker)
        files = list(worker.files)
        self.waiting.extendleft(reversed(files[1:]))
        if files:
            why = _cause(worker.process.exitcode)
            cure = "check it alone; where memory is short use fewer --jobs"
            yield (
                files[0],
                _crashed(self.paths[files[0]], f"its check was ended {why}", cure),
            )
        self._hire()


def _cause(code: int | None) -> str:
    """What ended a process.

    >>> _cause(-9), _cause(3)
    ('by SIGKILL, as the system does where memory is short', 'with exit code 3')
    """
    import signal

    if code is None or code >= 0:
        return f"with exit code {code}"
    name = f"signal {-code}"
    with suppress(ValueError):
        name = signal.Signals(-code).name
    more = ", as the system does where memory is short" if name == "SIGKILL" else ""
    return f"by {name}{more}"


def _serve(connection: Connection, work: Work) -> None:
    """What a worker does; it ends when nobody sends any more.

    An interrupt is for the process that has the terminal, which ends the workers.
    """
    import signal

    from garkcli.exact.pickling import register

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    register()
    with suppress(EOFError, OSError):
        while True:
            connection.send(work(connection.recv()))


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Hold interrupts back, where the system can; they arrive at the end."""
    import signal

    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
