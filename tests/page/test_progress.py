"""The line on stderr: on a terminal, for long work, and nothing of it stays."""

from __future__ import annotations

import io
import os
import signal
import sys

import pytest

from garkcli.doing import counting, doing, hush, listener, telling
from garkcli.page import progress
from garkcli.page.progress import Pen, ProgressLine, aside, watching
from tests.had import needs_fork
from tests.listener import Listener

WIPED = "\r\x1b[2K"


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch, patience: float = 0.0) -> _Terminal:
    """Stderr as a terminal of 40 columns, and a line that this process draws as soon as it is told
    something, once so many seconds have passed.
    """
    made = _Terminal()
    monkeypatch.setattr("sys.stderr", made)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(progress, "PATIENCE", patience)
    monkeypatch.setattr(progress, "EVERY", 0.0)
    monkeypatch.setattr(progress, "_columns", lambda: 40)
    monkeypatch.setattr(progress, "Process", lambda: Pen(progress._put))
    return made


def test_long_work_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is done within other work stands behind it, with how much of it is done; the line is
    wiped out at the end.
    """
    stderr = terminal(monkeypatch)
    with watching("gark converge"), doing("rk4.yaml"):
        with doing("h = 1/16", 80) as work:
            work.reach(70)
        with doing("files", 1) as work:
            work.reach(1)
    *shown, end = stderr.getvalue().removeprefix(WIPED).split(WIPED)
    assert shown == [
        "gark converge, 0 s",
        "rk4.yaml, 0 s",
        "rk4.yaml: h = 1/16, 0 of 80, 0 s",
        "rk4.yaml: h = 1/16, 70 of 80, 0 s",
        "rk4.yaml, 0 s",
        "rk4.yaml: files, 0 s",
        "rk4.yaml: files, 1, 0 s",
        "rk4.yaml, 0 s",
        "gark converge, 0 s",
    ]
    assert end == ""


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
    assert stderr.getvalue() == f"{WIPED}gark check, 0 s{WIPED}"


def test_the_line_makes_room(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is wiped out before a note, and comes back after it."""
    stderr = terminal(monkeypatch)
    with watching("gark check"), aside():
        stderr.write("a note\n")
    line = f"{WIPED}gark check, 0 s"
    assert stderr.getvalue() == f"{line}{WIPED}a note\n{line}{WIPED}"


def test_a_line_is_one_line_whatever_a_file_is_called(monkeypatch: pytest.MonkeyPatch) -> None:
    """Signs that a terminal acts on are written out, and what the terminal would break is cut."""
    stderr = terminal(monkeypatch)
    with watching("gark check"), doing("a\x1b[2Jb\n" + "c" * 100):
        pass
    _, _, shown, *_ = stderr.getvalue().split(WIPED)
    assert shown.startswith(r"a\x1b[2Jb\n" + "ccc")
    assert len(shown) == 39


def test_work_that_fails_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """An error takes the line away, and what failed is no longer told."""
    stderr = terminal(monkeypatch)

    def work() -> None:
        with watching("gark check"):
            try:
                with doing("order"):
                    raise ArithmeticError
            except ArithmeticError:
                line = listener()
                assert isinstance(line, ProgressLine)
                assert line.text == "gark check"
            raise ValueError("broken")

    with pytest.raises(ValueError, match="broken"):
        work()
    assert stderr.getvalue().endswith(WIPED)
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
    while "order, 0 s" not in shown:
        shown += os.read(place, 1024).decode()
    os.write(place, b"\n")
    while "a note\r\n" not in shown or not shown.split("a note\r\n")[1].startswith(f"{WIPED}order"):
        shown += os.read(place, 1024).decode()
    os.write(place, ending.encode())
    try:
        while more := os.read(place, 1024):
            shown += more.decode()
    except OSError:
        pass  # what a terminal says whose last user is gone
    os.waitpid(process, 0)
    before, after = shown.split("a note\r\n")
    assert before.endswith(WIPED)
    is_interrupted = ending != "\n"
    assert ("KeyboardInterrupt" in after) is is_interrupted
    last = after.split("Traceback")[0] if is_interrupted else after
    assert last.rstrip("\r\n^C").endswith(WIPED.rstrip("\r\n"))
