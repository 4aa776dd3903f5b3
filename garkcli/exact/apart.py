"""Work in a process of its own, which can be ended in the middle of a call in C."""

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
"""Seconds behind the deadline after which a process ends by itself."""


LEAST = 0.001
"""Seconds of a timer that ends a process at once; 0 is for never."""
_CAN_COUNT = hasattr(signal, "setitimer")
"""Whether a process can limit its own time, that of the processor too."""

Task: TypeAlias = tuple[Callable[..., T], tuple[Any, ...]]
"""A function of a module and its arguments, which travel to another process."""


def apart(work: Callable[..., T], *arguments: Any) -> T:
    """What a function returns, within the deadline around it; without one it runs in this process.

    Args:
        work: a function of a module.
        arguments: of it; they and the result travel between processes.

    Raises:
        NotDecided: the time is over, the process ended without a result, or only small work is
            done.
    """
    if seconds_left() is None and not is_only_small():
        return work(*arguments)
    return first_of((work, arguments))


def first_of(*tasks: Task[T]) -> T:
    """The result of the task that is done first, each in a process of its own; the others end.

    Args:
        tasks: ways to the same result.

    Raises:
        NotDecided: the time is over, no process had a result, or only small work is done.
    """
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
    """A process that is at a task: the end of the pipe that its result comes out of."""
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
    """What the process does; it ends at the deadline even where nobody is left to end it."""
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
    """Let signals end a process that works for another one, but for an interrupt: that is for the
    process that has the terminal, which ends the others, at its deadline too.
    """
    forget()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP", "SIGALRM", "SIGPROF"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    # last: an interrupt that ``begin`` held back would still be raised
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_SETMASK, ())


def start_method() -> str:
    """How processes begin: ``fork`` keeps the modules that are loaded already.

    Windows has no fork, and on macOS a fork of a process whose libraries have begun threads may
    crash.
    """
    from multiprocessing import get_all_start_methods

    can_fork = "fork" in get_all_start_methods() and sys.platform != "darwin"
    return "fork" if can_fork else "spawn"


def begin(process: BaseProcess) -> None:
    """Start a process that no interrupt reaches: one that is not ready yet would say so. Where this
    one is ended meanwhile, it knows of the other.
    """
    with _without_signals(), warnings.catch_warnings():
        # the threads are those of numpy's BLAS, which stops them before a fork
        message = "This process .* is multi-threaded"
        warnings.filterwarnings("ignore", message, DeprecationWarning)
        process.start()


@contextmanager
def without_program() -> Iterator[None]:
    """Hide the program that calls gark from processes that begin without a fork: they would run it
    again, where it does not ask for its name.
    """
    program = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = program


def end(process: BaseProcess) -> None:
    """End a process, whatever it is at, if it has begun."""
    if process.pid is not None:
        process.kill()
        process.join()


@contextmanager
def _without_signals() -> Iterator[None]:
    """Hold signals that end the run back, where the system can; they arrive at the end."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [getattr(signal, x) for x in ENDING])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
