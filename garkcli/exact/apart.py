"""Runs work in a process of its own, which can be ended in the middle of a call in C."""

from __future__ import annotations

import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, cast

from garkcli.deadline import check_time, clock_left, forget, is_only_small, seconds_left, work_left
from garkcli.ending import ENDING, undone
from garkcli.errors import NotDecided
from garkcli.exact.pickling import register

if TYPE_CHECKING:  # slow to import, and of no use to work that is done here
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess

T = TypeVar("T")
SPARE = 1.0
"""Seconds after the deadline at which a process ends itself."""


LEAST = 0.001
"""The shortest timer, in seconds: 0 would switch it off."""
_CAN_COUNT = hasattr(signal, "setitimer")
"""Whether a process can limit its own time, including that of the processor."""

Task: TypeAlias = tuple[Callable[..., T], tuple[Any, ...]]


def apart(work: Callable[..., T], *arguments: Any) -> T:
    """Returns work(*arguments), computed in a process that the deadline ends, if there is one.

    Arguments and result are pickled. Raises NotDecided if the time is over, the process ends
    without a result (no memory), or only small work is done.
    """
    if seconds_left() is None and not is_only_small():
        return work(*arguments)
    return first_of((work, arguments))


def first_of(*tasks: Task[T]) -> T:
    """Returns the first result of tasks, each in its own process; raises as ``apart``."""
    if is_only_small():
        raise NotDecided
    check_time()
    from multiprocessing.connection import wait

    register()
    with undone(), ExitStack() as stack:
        running = [stack.enter_context(_started(task)) for task in tasks]
        while running:
            ready = wait(running, clock_left() if _CAN_COUNT else seconds_left())
            if not ready:
                raise NotDecided(is_late=True)
            for pipe in cast("list[Connection]", ready):
                try:
                    result: T = pipe.recv()
                except EOFError:  # it ended without a result: no memory, or killed
                    running.remove(pipe)
                else:
                    return result
    # most often the processor time was over
    raise NotDecided(is_late=work_left() is not None)


@contextmanager
def _started(task: Task[Any]) -> Iterator[Connection]:
    from multiprocessing import get_context

    # fork would copy the locks of other threads
    is_alone = threading.active_count() == 1
    processes: Any = get_context(start_method() if is_alone else "spawn")
    here, there = processes.Pipe(duplex=False)
    work, arguments = task
    worker = processes.Process(
        target=_serve, args=(there, work, arguments, clock_left(), work_left()), daemon=True
    )
    try:
        begin(worker)
        there.close()
        yield here
    finally:
        end(worker)
        here.close()


def _serve(
    pipe: Connection,
    work: Callable[..., object],
    arguments: tuple[Any, ...],
    clock: float | None,
    effort: float | None,
) -> None:
    """The body of the process; it ends at the deadline even if its parent has died."""
    without_handlers()
    if _CAN_COUNT:
        if clock is not None:
            signal.setitimer(signal.ITIMER_REAL, clock + SPARE)
        if effort is not None:
            signal.setitimer(signal.ITIMER_PROF, max(effort, LEAST))
    register()
    with suppress(NotDecided, MemoryError):
        pipe.send(work(*arguments))


def without_handlers() -> None:
    """Lets signals end a worker process, except an interrupt, which its parent handles."""
    forget()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP", "SIGALRM", "SIGPROF"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    # last: an interrupt that ``begin`` held back would still be raised
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_SETMASK, ())


def start_method() -> str:
    """``fork``, which keeps loaded modules, but not on macOS: threads of libraries may crash it."""
    from multiprocessing import get_all_start_methods

    can_fork = "fork" in get_all_start_methods() and sys.platform != "darwin"
    return "fork" if can_fork else "spawn"


def begin(process: BaseProcess) -> None:
    """Starts a process; no signal ends this one before it knows of the new one."""
    with _without_signals(), warnings.catch_warnings():
        # the threads are those of numpy's BLAS, which stops them before a fork
        message = "This process .* is multi-threaded"
        warnings.filterwarnings("ignore", message, DeprecationWarning)
        process.start()


@contextmanager
def without_program() -> Iterator[None]:
    """Hides the program from processes that start without a fork and would run it again."""
    program = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = program


def end(process: BaseProcess) -> None:
    if process.pid is not None:
        process.kill()
        process.join()


@contextmanager
def _without_signals() -> Iterator[None]:
    """Holds back signals that end the run, where the system can; they arrive at the end."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [getattr(signal, x) for x in ENDING])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
