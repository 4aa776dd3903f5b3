"""Workers of a Dask cluster; each item has one outcome, however often the cluster did it."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from itertools import islice
from threading import Lock
from types import TracebackType
from typing import Any, Generic

from garkcli.crew.work import Item, Outcome, WorkerLost
from garkcli.deadline import seconds_left
from garkcli.errors import NotDecided, UsageProblem
from garkcli.exact.pickling import register
from garkcli.version import __version__

WINDOW = 400
TIMEOUT = 20
_ONE_AT_A_TIME = Lock()
"""Workers with several threads share the precision of python-flint."""


class Cluster(Generic[Item, Outcome]):
    """The workers of a Dask ``scheduler``, such as ``tcp://host:8786``.

    ``crashed`` makes the outcome of an item that ended several workers. Raises UsageProblem if Dask
    is not installed, the scheduler does not answer, or a worker has no garkcli of this version;
    WorkerLost if the scheduler is gone.
    """

    def __init__(
        self,
        work: Callable[[Item], Outcome],
        scheduler: str,
        crashed: Callable[[Item, str], Outcome],
    ) -> None:
        self.work = work
        self.scheduler = scheduler
        self.crashed = crashed
        self._client: Any = None
        self._quiet = ExitStack()

    def __enter__(self) -> Cluster[Item, Outcome]:
        try:
            from dask.distributed import Client
        except ImportError:
            raise UsageProblem(
                "--scheduler needs Dask", "install garkcli[cluster]", code="missing-package"
            ) from None
        register()
        self._quiet.enter_context(_without_logs())
        try:
            self._client = Client(self.scheduler, timeout=TIMEOUT, set_as_default=False)
        except (AssertionError, OSError, TypeError, ValueError) as error:
            # an address of another kind: what is raised depends on the kind
            self._quiet.close()
            what = (str(error) or type(error).__name__).splitlines()[0]
            message = f"no Dask scheduler answers at {self.scheduler}: {what}"
            raise UsageProblem(message, "dask scheduler starts one", code="worker-lost") from None
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._client.close()
        self._quiet.close()

    @property
    def size(self) -> int:
        """The number of workers, at least one, as workers may come later."""
        return max(1, len(self._client.nthreads()))

    def as_they_come(self, items: Sequence[Item]) -> Iterator[tuple[int, Outcome]]:
        from dask.distributed import as_completed

        running: dict[str, int] = {}
        waiting = iter(range(len(items)))

        def submit(number: int) -> Any:
            arguments = __version__, self.work, items[number]
            future = self._client.submit(_done, *arguments, pure=False)
            running[future.key] = number
            return future

        first = [submit(k) for k in islice(waiting, WINDOW)]
        pool = as_completed(first, loop=self._client.loop, timeout=seconds_left())
        for future in _in_time(pool):
            number = running.pop(future.key)
            yield number, self._outcome(future, items[number])
            future.release()
            for following in islice(waiting, 1):
                pool.add(submit(following))

    def _outcome(self, future: Any, item: Item) -> Outcome:
        from dask.distributed import KilledWorker

        if future.status not in {"finished", "error"}:
            raise WorkerLost(f"the Dask scheduler at {self.scheduler} is gone", "start it again")
        fault = future.exception() if future.status == "error" else None
        if isinstance(fault, KilledWorker):
            return self.crashed(item, "on the cluster, several times")
        if isinstance(fault, ModuleNotFoundError):
            message = f"a worker of {self.scheduler} cannot do the work: {fault}"
            cure = f"install garkcli {__version__} on all workers"
            raise UsageProblem(message, cure, code="worker-lost")
        version: str
        outcome: Outcome
        version, outcome = future.result()
        if version != __version__:
            message = f"a worker of {self.scheduler} has garkcli {version}"
            cure = f"install garkcli {__version__} on all workers"
            raise UsageProblem(message, cure, code="worker-lost")
        return outcome


def _in_time(pool: Any) -> Iterator[Any]:
    try:
        yield from pool
    except TimeoutError:
        raise NotDecided(is_late=True) from None


@contextmanager
def _without_logs() -> Iterator[None]:
    # lost connections are reported in one line
    handlers = logging.getLogger("distributed").handlers
    levels = [handler.level for handler in handlers]
    for handler in handlers:
        handler.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for handler, level in zip(handlers, levels, strict=True):
            handler.setLevel(level)


def _done(version: str, work: Callable[[Item], Outcome], item: Item) -> tuple[str, Outcome | None]:
    """Runs in a worker: its version, and the outcome if the versions agree."""
    if version != __version__:
        return __version__, None
    register()
    with _ONE_AT_A_TIME:
        return __version__, work(item)
