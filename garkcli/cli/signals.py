"""The signals that end the program, also in the middle of a call of a library in C."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Sent by a person, by whoever ends jobs, and by a terminal that closes; not every system has
all.
"""
INTERRUPTED = 128 + signal.SIGINT
GRACE = 2.0
"""Seconds after a signal in which Python may take note of it."""


class Ended(BaseException):
    """A signal asks the program to end, and nothing is said; no ``except Exception`` keeps it."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_code = 128 + number


@contextmanager
def ending() -> Iterator[None]:
    """Raise ``KeyboardInterrupt`` on an interrupt, and ``Ended`` on the signals that would end the
    program without a word. A process of its own ends it where a call in C goes on all the same.

    A signal that is ignored (``nohup``) or handled already stays so.
    """
    before = {}
    if threading.current_thread() is threading.main_thread():
        known = [getattr(signal, name) for name in ENDING if hasattr(signal, name)]
        usual = {signal.SIG_DFL, signal.default_int_handler}
        before = {x: old for x in known if (old := signal.getsignal(x)) in usual}
    watcher = _Watcher() if before and hasattr(os, "fork") else None

    def end(number: int, _frame: FrameType | None) -> NoReturn:
        if watcher is not None:
            watcher.end()
        if number == signal.SIGINT:
            raise KeyboardInterrupt
        # once is enough: the next one would stop the cleaning up
        signal.signal(number, signal.SIG_IGN)
        raise Ended(number)

    for number in before:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)
        if watcher is not None:
            watcher.end()


class _Watcher:
    """A process that hears of signals at once, and kills this one unless it is ended in time."""

    def __init__(self) -> None:
        heard, self._told = os.pipe()
        parent = os.getpid()
        with warnings.catch_warnings():
            # whatever other threads hold, that process does not need
            warnings.simplefilter("ignore", DeprecationWarning)
            self._process = os.fork()
        if self._process == 0:
            try:
                for name in ENDING:
                    signal.signal(getattr(signal, name), signal.SIG_IGN)
                os.closerange(0, heard)  # readers of the report do not wait for this process
                os.closerange(heard + 1, self._told + 1)
                if os.read(heard, 1):
                    time.sleep(GRACE)
                    if os.getppid() == parent:
                        os.kill(parent, signal.SIGKILL)
            finally:
                # the rest of the program is for the parent
                os._exit(0)
        os.close(heard)
        os.set_blocking(self._told, False)
        # written to by the handler in C, whatever Python is at
        signal.set_wakeup_fd(self._told, warn_on_full_buffer=False)
        # signals of processes that work for this one are none of it
        os.register_at_fork(after_in_child=self._leave)

    def _leave(self) -> None:
        if self._process:
            self._process = 0
            signal.set_wakeup_fd(-1)

    def end(self) -> None:
        """Watch no longer."""
        if self._process:
            process, self._process = self._process, 0
            signal.set_wakeup_fd(-1)
            os.close(self._told)
            os.kill(process, signal.SIGKILL)
            os.waitpid(process, 0)
