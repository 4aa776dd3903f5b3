"""Long work on a terminal, drawn by rich on stderr from two seconds on: work done, time left.

Exact arithmetic may stay in one library call for minutes, during which no thread of Python runs.
Therefore a separate process draws, and it alone imports rich; where the system cannot fork, the
command itself draws at the start and the end of each task.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple, NoReturn, TypeAlias

from garkcli import doing
from garkcli.doing import Work
from garkcli.errors import printable
from garkcli.terminal import is_drawn_on

if TYPE_CHECKING:
    from rich.live import Live
    from rich.table import Table

PATIENCE = 2.0
"""Seconds before anything appears."""
EVERY = 0.25
"""Seconds between updates."""
BAR = 20
_ASIDE, _END = b"\0", b"\1"  # texts have no such signs


@contextmanager
def watching(what: str) -> Iterator[None]:
    """Shows the tasks that ``garkcli.doing`` reports, or else ``what``, while it is open."""
    if not is_drawn_on(sys.stderr):
        yield
        return
    tasks = Tasks(what, _bars())
    try:
        with doing.telling(tasks):
            yield
    finally:
        tasks.hush()


def _bars() -> Draws:
    if hasattr(os, "fork"):
        with suppress(OSError):
            return Process()
    return Bars()


@contextmanager
def aside() -> Iterator[None]:
    """Removes the drawing while it is open, for other output."""
    tasks = doing.listener()
    if not isinstance(tasks, Tasks):
        yield
        return
    tasks.make_room()
    yield
    tasks.tell()


class Task(NamedTuple):
    number: int
    what: str
    done: int
    total: int | None

    @classmethod
    def read(cls, line: str) -> Task:
        number, done, total, what = line.split("\t", 3)
        return cls(int(number), what, int(done), int(total) if total else None)

    def written(self) -> str:
        total = "" if self.total is None else self.total
        return f"{self.number}\t{self.done}\t{total}\t{printable(self.what)}"


_BETWEEN = "\x1f"
Draws: TypeAlias = "Bars | Process"


class Tasks:
    """The tasks at work, the outermost first; ``what`` if there is none."""

    def __init__(self, what: str, bars: Draws) -> None:
        self.bars = bars
        self._what = what
        self._stack: list[tuple[int, Work]] = []
        self._count = 0
        self._next = 0.0
        self._is_hushed = False
        self.tell()

    def begin(self, work: Work) -> None:
        self._count += 1
        self._stack.append((self._count, work))
        self.tell()

    def changed(self) -> None:
        if monotonic() >= self._next:
            self.tell()

    def end(self, work: Work) -> None:
        """Removes a task; generators may end in another order than they began."""
        self._stack = [x for x in self._stack if x[1] is not work]
        self.tell()

    def hush(self) -> None:
        if not self._is_hushed:
            self._is_hushed = True
            self.bars.end()

    def make_room(self) -> None:
        if not self._is_hushed:
            self.bars.wipe()

    @property
    def at_work(self) -> list[Task]:
        told = [Task(number, x.what, x.done, x.total) for number, x in self._stack]
        return told or [Task(0, self._what, 0, None)]

    def tell(self) -> None:
        if not self._is_hushed:
            self._next = monotonic() + EVERY
            self.bars.draw(self.at_work)


class Bars:
    """A line for each task, with a bar and the time left where the amount of work is known."""

    def __init__(self) -> None:
        self._start = monotonic()
        self._due = self._start + PATIENCE
        self._live: Live | None = None
        self._begun: dict[int, tuple[float, int]] = {}

    @property
    def wait(self) -> float:
        return max(0.0, self._due - monotonic())

    def draw(self, tasks: Sequence[Task]) -> None:
        now = monotonic()
        for task in tasks:
            self._begun.setdefault(task.number, (now, task.done))
        if self.wait:
            return
        with suppress(OSError):  # the terminal may be gone
            if self._live is None:
                self._live = _live()
                self._live.start()
            self._live.update(self._table(tasks, now), refresh=True)
        self._due = monotonic() + EVERY

    def _table(self, tasks: Sequence[Task], now: float) -> Table:
        from rich.progress_bar import ProgressBar
        from rich.table import Table
        from rich.text import Text

        from garkcli.page.plaintext import plain_text

        table = Table.grid(padding=(0, 2, 0, 0))
        for _ in range(4):
            table.add_column()
        ran = duration(now - self._start)
        for task in tasks:
            what = plain_text(printable(task.what), sys.stderr.encoding or "ascii")
            name = Text(what, no_wrap=True, overflow="ellipsis")
            total = task.total or 0
            bar = ProgressBar(total, task.done, BAR, complete_style="green") if total > 1 else ""
            table.add_row(name, bar, Text(self._words(task, now), no_wrap=True), Text(ran))
            ran = ""
        return table

    def _words(self, task: Task, now: float) -> str:
        """Returns the work done, and the time left at the pace so far."""
        if task.total is None or task.total <= 1:
            return str(task.done or "")
        began, before = self._begun[task.number]
        words = f"{task.done} of {task.total}"
        if task.done <= before:
            return words
        left = (now - began) / (task.done - before) * (task.total - task.done)
        return f"{words}, {duration(left)} left"

    def wipe(self) -> None:
        if self._live is not None:
            with suppress(OSError):
                self._live.stop()
            self._live = None

    def end(self) -> None:
        self.wipe()


def _live() -> Live:
    from rich.console import Console
    from rich.live import Live

    class WithCursor(Console):
        """A terminal whose cursor stays: a command may be stopped while the tasks are drawn."""

        def show_cursor(self, show: bool = True) -> bool:
            return show

    console = WithCursor(stderr=True, highlight=False, markup=False)
    return Live(
        console=console,
        auto_refresh=False,
        transient=True,
        redirect_stdout=False,
        redirect_stderr=False,
    )


def duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.0f} h"


class Process:
    def __init__(self) -> None:
        commands, self._commands = os.pipe()
        self._answers, answers = os.pipe()
        parent = os.getpid()
        self._process = os.fork()
        if self._process == 0:
            _draw_for(parent, commands, answers)
        os.close(commands)
        os.close(answers)

    def draw(self, tasks: Sequence[Task]) -> None:
        self._send(_BETWEEN.join(x.written() for x in tasks).encode("utf-8", "replace"))

    def wipe(self) -> None:
        """Waits until the tasks are erased."""
        if self._send(_ASIDE):
            os.read(self._answers, 1)

    def end(self) -> None:
        self._send(_END)
        os.close(self._commands)
        os.close(self._answers)
        os.waitpid(self._process, 0)

    def _send(self, message: bytes) -> bool:
        with suppress(OSError):
            os.write(self._commands, message + b"\n")
            return True
        return False


def _draw_for(parent: int, commands: int, answers: int) -> NoReturn:
    import select

    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # that is for the parent
        bars = Bars()
        tasks: list[Task] = []
        rest = b""
        while os.getppid() == parent:
            ready, _, _ = select.select([commands], [], [], bars.wait or EVERY)
            if ready:
                *messages, rest = (rest + os.read(commands, 65536)).split(b"\n")
                for message in messages:
                    if message == _END:
                        bars.end()
                        os._exit(0)
                    if message == _ASIDE:
                        bars.wipe()
                        os.write(answers, message)
                        tasks = []
                    else:
                        tasks = [*map(Task.read, message.decode().split(_BETWEEN))]
            if tasks:
                bars.draw(tasks)
        bars.end()  # the parent was ended, and has left the tasks
    finally:
        # whatever has happened, the rest of the program is for the parent
        os._exit(0)
