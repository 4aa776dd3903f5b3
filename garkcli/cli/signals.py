"""Signals that end the program: what is half done is taken back, and nothing is said."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

ENDING = ("SIGTERM", "SIGHUP")
"""Sent by whoever ends jobs, and by a terminal that closes; not every system has both."""
READER_GONE = 128 + 13
"""The exit code where nobody reads the report: that of a program that SIGPIPE ends."""
INTERRUPTED = 128 + signal.SIGINT


class Ended(BaseException):
    """A signal asks the program to end; no ``except Exception`` keeps it."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_code = 128 + number


@contextmanager
def ending() -> Iterator[None]:
    """Raise ``Ended`` on the signals that would end the program without a word.

    A signal that is ignored (``nohup``) or handled already stays so.
    """
    changed = []
    if threading.current_thread() is threading.main_thread():
        known = [getattr(signal, name) for name in ENDING if hasattr(signal, name)]
        changed = [number for number in known if signal.getsignal(number) is signal.SIG_DFL]
    for number in changed:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number in changed:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    # once is enough: the next one would stop the cleaning up
    signal.signal(number, signal.SIG_IGN)
    raise Ended(number)
