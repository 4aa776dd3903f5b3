"""What takes long, in one line on stderr, on a terminal, once a command has worked for two seconds.

The line says what is being done, how much of it, and for how long the command has worked. It is
wiped out before anything else is written there, and at the end.

Exact arithmetic may stay within one call of a library for minutes, and no thread of Python runs
meanwhile. So a process of its own draws the line; where the system cannot fork, the command itself
does whenever something begins or ends.
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
"""Seconds of work before the line appears."""
EVERY = 0.25
"""Seconds from one line to the next."""
WIPED = "\r\x1b[2K"
_ASIDE, _END = b"\0", b"\1"  # texts have no such signs
_STDERR = 2
_USUAL = 80  # columns


@contextmanager
def watching(what: str) -> Iterator[None]:
    """Show what is being done meanwhile: what ``garkcli.doing`` hears, and before that
    ``what``.

    A terminal that cannot move its cursor shows nothing.
    """
    is_watched = sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
    if not is_watched:
        yield
        return
    line = Line(what, _pen())
    try:
        with doing.telling(line):
            yield
    finally:
        line.hush()


def _pen() -> Draws:
    """A process that draws where there can be one."""
    if hasattr(os, "fork"):
        with suppress(OSError):
            return Process()
    return Pen(_put)


@contextmanager
def aside() -> Iterator[None]:
    """Make room for something else on the terminal meanwhile."""
    line = doing.listener()
    if not isinstance(line, Line):
        yield
        return
    line.make_room()
    yield
    line.tell()


Draws: TypeAlias = "Pen | Process"
"""What draws the line, wipes it out until there is something to be drawn, and ends."""


class Line:
    """What is being done, outermost first.

    Args:
        what: is said where nothing else is.
        pen: draws it.
    """

    def __init__(self, what: str, pen: Draws) -> None:
        self.pen = pen
        self._what = what
        self._stack: list[Work] = []
        self._next = 0.0
        self._is_hushed = False
        self.tell()

    def begin(self, work: Work) -> None:
        """Take note of what is being done from now on."""
        self._stack.append(work)
        self.tell()

    def changed(self) -> None:
        """Take note of how far it is, now and then."""
        if monotonic() >= self._next:
            self.tell()

    def end(self, work: Work) -> None:
        """Take note of what is done; generators may end in another order than they began."""
        self._stack.remove(work)
        self.tell()

    def hush(self) -> None:
        """Show nothing more."""
        if not self._is_hushed:
            self._is_hushed = True
            self.pen.end()

    def make_room(self) -> None:
        """Take the line away until the pen has something to say again."""
        if not self._is_hushed:
            self.pen.wipe()

    @property
    def text(self) -> str:
        """What is being done."""
        return ": ".join(map(str, self._stack)) or self._what

    def tell(self) -> None:
        """Tell the pen what is being done now."""
        if not self._is_hushed:
            self._next = monotonic() + EVERY
            self.pen.draw(self.text)


class Pen:
    """Draws the line every ``EVERY`` seconds, from ``PATIENCE`` on.

    Args:
        put: writes to the terminal.
    """

    def __init__(self, put: Callable[[str], None]) -> None:
        self._put = put
        self._start = monotonic()
        self._due = self._start + PATIENCE
        self._is_shown = False

    @property
    def wait(self) -> float:
        """Seconds until there is something to be drawn."""
        return max(0.0, self._due - monotonic())

    def draw(self, text: str) -> None:
        """Write the line over the one before, if it is time."""
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
        """Take the line away until it is drawn anew."""
        if self._is_shown:
            self._put(WIPED)
            self._is_shown = False

    def end(self) -> None:
        """Take the line away for good."""
        self.wipe()


class Process:
    """A process that draws the line with a ``Pen``, whatever this one is at."""

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
        """Show this from now on, once it is time."""
        self._send(printable(text).encode("utf-8", "replace"))

    def wipe(self) -> None:
        """Take the line away until there is something to be drawn, and wait until it is gone."""
        if self._send(_ASIDE):
            os.read(self._answers, 1)

    def end(self) -> None:
        """Take the line away, and end the process."""
        self._send(_END)
        os.close(self._commands)
        os.close(self._answers)
        os.waitpid(self._process, 0)

    def _send(self, message: bytes) -> bool:
        """Whether the process is there to read it."""
        with suppress(OSError):
            os.write(self._commands, message + b"\n")
            return True
        return False


def _draw_for(parent: int, commands: int, answers: int) -> NoReturn:
    """What the process does, until it has to end or its parent is gone."""
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
    """Of the terminal of stderr."""
    with suppress(OSError):
        # 0 where the terminal does not know
        return os.get_terminal_size(_STDERR).columns or _USUAL
    return _USUAL


def _put(text: str) -> None:
    """Write to the terminal; one that is gone is no reason to stop."""
    with suppress(OSError):
        sys.stderr.write(text)
        sys.stderr.flush()


def _put_at_once(text: str) -> None:
    os.write(_STDERR, text.encode(sys.stderr.encoding or "ascii", "replace"))
