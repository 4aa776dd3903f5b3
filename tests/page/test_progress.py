"""What is drawn on stderr about long work: on a terminal alone, and nothing of it stays."""

from __future__ import annotations

import io
import os
import re
import signal
import sys
from itertools import groupby

import pytest

from garkcli.doing import counting, doing, hush, listener, telling
from garkcli.page import progress
from garkcli.page.progress import Bars, Task, Tasks, aside, duration, watching
from tests.had import needs_fork
from tests.listener import Listener

STYLE = re.compile("\x1b\\[[0-9;]*m")


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch, patience: float = 0.0) -> _Terminal:
    """Stderr as a terminal of 60 columns, on which this process draws as soon as it is told
    something, once so many seconds have passed.
    """
    made = _Terminal()
    monkeypatch.setattr("sys.stderr", made)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setattr(progress, "PATIENCE", patience)
    monkeypatch.setattr(progress, "EVERY", 0.0)
    monkeypatch.setattr(progress, "Process", Bars)
    return made


def drawings(shown: str) -> list[list[str]]:
    """The tasks of each update that changed them, a line each."""
    pieces = re.split(r"(?:\r|\x1b\[1A|\x1b\[2K)+", STYLE.sub("", shown))
    found = [[line.rstrip() for line in x.splitlines() if line] for x in pieces if x.strip()]
    return [x for x, _ in groupby(found)]


def test_long_work_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Work within other work has a line below it, with a bar where its amount is known; all is
    erased at the end.
    """
    stderr = terminal(monkeypatch)
    with watching("gark converge"), doing("rk4.yaml"):
        with doing("h = 1/16", 80) as work:
            work.reach(40)
        with doing("files", 1) as work:
            work.reach(1)
    shown = drawings(stderr.getvalue())
    bar, half = "━" * 20, "━" * 10
    assert shown[0] == ["gark converge      0 s"]
    assert shown[1] == ["rk4.yaml      0 s"]
    assert shown[2][1].split() == ["h", "=", "1/16", bar, "0", "of", "80"]
    assert shown[3][1].split()[3].startswith(half)
    assert shown[3][1].split()[4:] == ["40", "of", "80,", "0", "s", "left"]
    assert shown[-2:] == [["rk4.yaml      0 s"], ["gark converge      0 s"]]
    assert stderr.getvalue().endswith("\x1b[1A\x1b[2K")


def test_the_time_left_is_that_of_the_pace_so_far(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 100 parts 20 were done before, and 20 more in 5 seconds: the other 60 take 15."""
    bars = Bars()
    monkeypatch.setattr(progress, "monotonic", lambda: 0.0)
    bars.draw([Task(1, "rows", 20, 100)])
    assert bars._words(Task(1, "rows", 20, 100), 5.0) == "20 of 100"
    assert bars._words(Task(1, "rows", 40, 100), 5.0) == "40 of 100, 15 s left"
    assert bars._words(Task(2, "rows", 7, None), 5.0) == "7"
    assert [duration(x) for x in (99.4, 100, 5999, 6000)] == ["99 s", "2 min", "100 min", "2 h"]


def test_a_task_on_its_way_to_the_process_is_the_same() -> None:
    """Also one with a name that has signs between the fields."""
    for task in (Task(3, "a, b", 1, 7), Task(0, "", 0, None)):
        assert Task.read(task.written()) == task
    assert Task.read(Task(1, "a\tb\x1fc\n", 0, None).written()).what == r"a\tb\x1fc\n"


def test_short_work_has_no_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is shown before so much time has passed."""
    stderr = terminal(monkeypatch, 3600.0)
    with watching("gark check"), doing("order"):
        pass
    assert stderr.getvalue() == ""


@pytest.mark.parametrize("term", ["dumb", "xterm"])
def test_no_line_where_nobody_sees_it(monkeypatch: pytest.MonkeyPatch, term: str) -> None:
    """A file, and a terminal that cannot move its cursor, get nothing: nobody is told at all."""
    stderr = terminal(monkeypatch)
    monkeypatch.setenv("TERM", term)
    if term != "dumb":
        monkeypatch.setattr("sys.stderr", io.StringIO())
    with watching("gark check"):
        assert listener() is None
    assert stderr.getvalue() == ""


def test_nothing_is_drawn_once_nobody_wants_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """With ``--quiet``, or when the report begins on the same terminal."""
    stderr = terminal(monkeypatch)
    with watching("gark check"):
        hush()
        with doing("order"):
            pass
    assert drawings(stderr.getvalue()) == [["gark check      0 s"]]


def test_the_tasks_make_room(monkeypatch: pytest.MonkeyPatch) -> None:
    """The tasks are wiped out before a note, and come back after it."""
    stderr = terminal(monkeypatch)
    with watching("gark check"), aside():
        stderr.write("a note\n")
    before, after = stderr.getvalue().split("a note\n")
    assert before.endswith("\x1b[2K")
    assert drawings(before) == drawings(after) == [["gark check      0 s"]]


def test_a_line_is_one_line_whatever_a_file_is_called(monkeypatch: pytest.MonkeyPatch) -> None:
    """Signs that a terminal acts on are written out, markup is none, and what the terminal would
    break is cut.
    """
    stderr = terminal(monkeypatch)
    with watching("gark check"), doing("a\x1b[2Jb\n[red]" + "c" * 100):
        pass
    _, (shown,), *_ = drawings(stderr.getvalue())
    assert shown.startswith(r"a\x1b[2Jb\n[red]ccc")
    assert len(shown) <= 60


def test_work_that_fails_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """An error takes the drawing away, and what failed is no longer told."""
    stderr = terminal(monkeypatch)

    def work() -> None:
        with watching("gark check"):
            try:
                with doing("order"):
                    raise ArithmeticError
            except ArithmeticError:
                tasks = listener()
                assert isinstance(tasks, Tasks)
                assert tasks.at_work == [Task(0, "gark check", 0, None)]
            raise ValueError("broken")

    with pytest.raises(ValueError, match="broken"):
        work()
    assert stderr.getvalue().endswith("\x1b[2K")
    assert listener() is None


def test_things_are_counted_as_they_go_by() -> None:
    """The same things, with a listener and without; how many went by is known at each."""
    assert list(counting("trees", "abc", 3)) == ["a", "b", "c"]
    who = Listener()
    with telling(who):
        seen = [(x, work.done) for x in counting("trees", "abc", 3) for work in who.told]
    assert seen == [("a", 0), ("b", 1), ("c", 2)]
    assert [str(work) for work in who.told] == ["trees, 3 of 3"]


SCRIPT = """
import sys
from garkcli.doing import doing
from garkcli.page import progress

progress.PATIENCE = 0.0
with progress.watching("gark check"), doing("order"):
    sys.stdin.readline()
    with progress.aside():
        print("a note", file=sys.stderr, flush=True)
    sys.stdin.readline()
"""
"""Work that does nothing until somebody presses return, twice."""


@needs_fork
@pytest.mark.parametrize("ending", ["\n", "\x03"])
def test_a_process_draws_while_the_command_is_at_something_else(ending: str) -> None:
    """The line is there though the command runs no Python; a note has a line of its own; nothing
    stays at the end, be it an interrupt.
    """
    import pty

    process, place = pty.fork()
    if process == 0:
        os.environ["TERM"] = "xterm"
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # in the background of a shell it is ignored
        os.execv(sys.executable, [sys.executable, "-c", SCRIPT])
    shown = ""
    while "order" not in shown:
        shown += os.read(place, 1024).decode()
    os.write(place, b"\n")
    while "a note\r\n" not in shown or "order" not in shown.split("a note\r\n")[1]:
        shown += os.read(place, 1024).decode()
    os.write(place, ending.encode())
    try:
        while more := os.read(place, 1024):
            shown += more.decode()
    except OSError:
        pass  # what a terminal says whose last user is gone
    os.waitpid(process, 0)
    before, after = shown.split("a note\r\n")
    assert before.rstrip("\r\n").endswith("\x1b[2K")
    is_interrupted = ending != "\n"
    assert ("KeyboardInterrupt" in after) is is_interrupted
    last = after.split("Traceback")[0] if is_interrupted else after
    assert last.rstrip("\r\n^C").endswith("\x1b[2K")
    assert "\x1b[?25l" not in shown
