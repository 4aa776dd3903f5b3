"""One line on stderr about long work, on a terminal, once a command has run for two seconds.

The line says what is being done, how much of it, and how long the command has run. It is erased
before anything else is written there, and at the end.

Exact arithmetic may stay in one library call for minutes, during which no thread of Python runs.
Therefore a separate process draws the line; where the system cannot fork, the command itself does
at the start and the end of each task.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from time import monotonic
from typing import NoReturn, TypeAlias

from garkcli import doing
from garkcli.doing import Work
from garkcli.errors import printable

PATIENCE = 2.0
"""The time before the line appears, in seconds."""
EVERY = 0.25
"""The time between updates, in seconds."""
WIPED = "\r\x1b[2K"
_ASIDE, _END = b"\0", b"\1"  # texts have no such signs
_STDERR = 2
_USUAL = 80  # columns


@contextmanager
def watching(what: str) -> Iterator[None]:
    """Shows what is being done while it is open: the tasks that ``garkcli.doing`` reports, or else
    ``what``.

    A terminal that cannot move its cursor shows nothing.
    """
    is_watched = sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
    if not is_watched:
        yield
        return
    line = ProgressLine(what, _pen())
    try:
        with doing.telling(line):
            yield
    finally:
        line.hush()


def _pen() -> Draws:
    """Returns a process that draws, if the system can fork."""
    if hasattr(os, "fork"):
        with suppress(OSError):
            return Process()
    return Pen(_put)


@contextmanager
def aside() -> Iterator[None]:
    """Removes the line while it is open, for other output on the terminal."""
    line = doing.listener()
    if not isinstance(line, ProgressLine):
        yield
        return
    line.make_room()
    yield
    line.tell()


Draws: TypeAlias = "Pen | Process"
"""Draws the line, erases it until the next update, and ends."""


class ProgressLine:
    """The tasks at work, the outermost first.

    ``what`` is shown while there is none.
    """

    def __init__(self, what: str, pen: Draws) -> None:
        self.pen = pen
        self._what = what
        self._stack: list[Work] = []
        self._next = 0.0
        self._is_hushed = False
        self.tell()

    def begin(self, work: Work) -> None:
        self._stack.append(work)
        self.tell()

    def changed(self) -> None:
        """Updates the line from time to time."""
        if monotonic() >= self._next:
            self.tell()

    def end(self, work: Work) -> None:
        """Removes a task; generators may end in another order than they began."""
        self._stack.remove(work)
        self.tell()

    def hush(self) -> None:
        """Ends the line."""
        if not self._is_hushed:
            self._is_hushed = True
            self.pen.end()

    def make_room(self) -> None:
        """Erases the line until the next update."""
        if not self._is_hushed:
            self.pen.wipe()

    @property
    def text(self) -> str:
        return ": ".join(map(str, self._stack)) or self._what

    def tell(self) -> None:
        """Sends the tasks to the pen."""
        if not self._is_hushed:
            self._next = monotonic() + EVERY
            self.pen.draw(self.text)


class Pen:
    """Draws the line every ``EVERY`` seconds, after ``PATIENCE``; ``put`` writes to the
    terminal.
    """

    def __init__(self, put: Callable[[str], None]) -> None:
        self._put = put
        self._start = monotonic()
        self._due = self._start + PATIENCE
        self._is_shown = False

    @property
    def wait(self) -> float:
        return max(0.0, self._due - monotonic())

    def draw(self, text: str) -> None:
        """Writes the line over the previous one, if it is time."""
        if self.wait:
            return
        from garkcli.page.plaintext import plain_text

        now = monotonic()
        told = f"{text}, {int(now - self._start)} s"
        plain = plain_text(printable(told), sys.stderr.encoding or "ascii")
        # a line that the terminal breaks could not be wiped out
        self._put(f"{WIPED}{plain[: _columns() - 1]}")
        self._is_shown = True
        self._due = now + EVERY

    def wipe(self) -> None:
        """Erases the line until the next update."""
        if self._is_shown:
            self._put(WIPED)
            self._is_shown = False

    def end(self) -> None:
        """Erases the line for good."""
        self.wipe()


class Process:
    """A process that draws the line with a ``Pen``, independent of this one."""

    def __init__(self) -> None:
        commands, self._commands = os.pipe()
        self._answers, answers = os.pipe()
        parent = os.getpid()
        self._process = os.fork()
        if self._process == 0:
            _draw_for(parent, commands, answers)
        os.close(commands)
        os.close(answers)

    def draw(self, text: str) -> None:
        self._send(printable(text).encode("utf-8", "replace"))

    def wipe(self) -> None:
        """Erases the line until the next update, and waits until that is done."""
        if self._send(_ASIDE):
            os.read(self._answers, 1)

    def end(self) -> None:
        self._send(_END)
        os.close(self._commands)
        os.close(self._answers)
        os.waitpid(self._process, 0)

    def _send(self, message: bytes) -> bool:
        """Sends a message; returns False if the process is gone."""
        with suppress(OSError):
            os.write(self._commands, message + b"\n")
            return True
        return False


def _draw_for(parent: int, commands: int, answers: int) -> NoReturn:
    """Runs the process until it is ended or its parent is gone."""
    import select

    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # that is for the parent
        pen = Pen(_put_at_once)
        text, rest = "", b""
        while os.getppid() == parent:
            ready, _, _ = select.select([commands], [], [], pen.wait or EVERY)
            if ready:
                *messages, rest = (rest + os.read(commands, 65536)).split(b"\n")
                for message in messages:
                    if message == _END:
                        pen.end()
                        os._exit(0)
                    if message == _ASIDE:
                        pen.wipe()
                        os.write(answers, message)
                    text = "" if message == _ASIDE else message.decode()
            if text:
                pen.draw(text)
        pen.end()  # the parent was ended, and has left the line
    finally:
        # whatever has happened, the rest of the program is for the parent
        os._exit(0)


def _columns() -> int:
    """Returns the width of the terminal of stderr."""
    with suppress(OSError):
        # 0 where the terminal does not know
        return os.get_terminal_size(_STDERR).columns or _USUAL
    return _USUAL


def _put(text: str) -> None:
    """Writes to the terminal, and ignores that it may be gone."""
    with suppress(OSError):
        sys.stderr.write(text)
        sys.stderr.flush()


def _put_at_once(text: str) -> None:
    os.write(_STDERR, text.encode(sys.stderr.encoding or "ascii", "replace"))
