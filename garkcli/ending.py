"""Ends runs on signals: at once, or after cleaning up. Python hears of a signal between two of its
own steps, and a call in C may go on for minutes. So the system ends the run, and Python handles
signals only where there is something to undo: half-written files, processes that work for this one.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from types import FrameType
from typing import NoReturn

from garkcli.frozen import Mutable
from garkcli.leaving import leave

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Signals from a person, from a job scheduler, and from a terminal that closes."""


class Ended(BaseException):
    """A signal asks the program to end, and nothing is said; no ``except Exception`` keeps it."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_code = 128 + number


class _RunningWork(Mutable, eq=False):
    """A run of the command line, with things to undo, and the signal that ended it or 0."""

    signals: list[int]
    undoing: int = 0
    ended: int = 0


_run: ContextVar[_RunningWork | None] = ContextVar("run", default=None)
"""The run whose signals are handled; None in other programs, which handle their own."""


@contextmanager
def at_once() -> Iterator[None]:
    """Lets signals, unless ignored (``nohup``) or handled, end the process by themselves inside,
    except inside ``undone``. Windows has an exit code of its own for interrupts, so Python handles
    them there.
    """
    by_system = hasattr(signal, "SIGHUP")
    inside = signal.SIG_DFL if by_system else signal.default_int_handler
    before = {}
    if threading.current_thread() is threading.main_thread():
        known = [getattr(signal, name) for name in (ENDING if by_system else ENDING[:1])]
        usual = (signal.SIG_DFL, signal.default_int_handler, leave)
        before = {x: handler for x in known if (handler := signal.getsignal(x)) in usual}
    token = _run.set(_RunningWork([*before] if by_system else []))
    for number in before:
        signal.signal(number, inside)
    try:
        yield
    finally:
        _run.reset(token)
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def undone() -> Iterator[None]:
    """Raises KeyboardInterrupt or Ended at a signal inside; calls in C inside should be short."""
    run = _run.get()
    if run is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    run.undoing += 1
    try:
        # generators may end in another order than they began: the last one puts the signals back
        if run.undoing == 1:
            for number in run.signals:
                is_interrupt = number == signal.SIGINT
                signal.signal(number, signal.default_int_handler if is_interrupt else _end)
        yield
    finally:
        run.undoing -= 1
        if not run.undoing:
            for number in run.signals:
                signal.signal(number, signal.SIG_DFL)


def raise_if_ended() -> None:
    """Raises ``Ended`` again if a library in C lost that exception."""
    run = _run.get()
    if run is not None and run.ended:
        raise Ended(run.ended)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    # once is enough: the next one would stop the cleaning up
    signal.signal(number, signal.SIG_IGN)
    if run := _run.get():
        run.ended = number
    raise Ended(number)
