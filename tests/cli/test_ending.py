"""Every command ends at a signal, whatever it is at: in the middle of a call in C too."""

from __future__ import annotations

import os
import select
import signal
import sys
import traceback
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout, suppress
from io import StringIO
from pathlib import Path
from typing import NoReturn

import flint
import pytest

from garkcli.cli.main import _exit_code
from garkcli.deadline import check_time
from garkcli.ending import Ended, at_once, undone
from tests.cli.harness import NAMES
from tests.had import needs_fork
from tests.whole import IS_WHOLE

pytestmark = needs_fork
PATIENCE = 60.0
"""Seconds to wait on a machine that is very busy; it takes a moment elsewhere."""
WORKED = 0.05
"""Seconds of processor time after which a command is at its work."""
FILES = {
    "long.m": "A = [1 ...\n" * 20_000,
    "dirk.yaml": "unknown: {stages: 7, shape: dirk}\n",
    "ssp.yaml": "unknown: {stages: 10, shape: explicit}\n",
    "spec.yaml": "methods: [{family: gauss, stages: 100..120}]\ncolumns: [order, error]\n",
}
LONG = {
    "check": ["check gauss-200", "check -j 2 gauss-200 gauss-199"],
    "show": ["show gauss-200"],
    "plot": ["plot gauss-200 --what tree"],
    "report": ["report gauss-200 -o page.html"],
    "stability": ["stability gauss-200"],
    "conditions": ["conditions -n 20", "conditions gauss-20 -n 14 -o table.txt"],
    "trees": ["trees -N 2 -n 12 --yes"],
    "modified": ["modified gauss-12 -n 12"],
    "converge": ["converge gauss-40"],
    "energy": ["energy gauss-4 --problem pendulum --t-end 1000000 --digits 30"],
    "new": ["new x.gark.yaml --family gauss-200 --family gauss-199"],
    "tableau": ["tableau gauss-200"],
    "conjugate": ["conjugate gauss-200"],
    "convert": ["convert gauss-200"],
    "reduce": ["reduce gauss-200"],
    "diff": ["diff gauss-200 gauss-199"],
    "design": [
        "design dirk.yaml --order 7 --seconds 1000",
        "design dirk.yaml --order 7 --search 1000000",
        "design dirk.yaml --order 7 --search 1000000 --jobs 2",
        "design ssp.yaml --order 4 --search 1000000 --minimise=-ssp",
    ],
    "sweep": ["sweep spec.yaml", "sweep spec.yaml --jobs 2"],
    "import": ["import long.m"],
    "audit": ["audit long.m"],
    "export": ["export gauss-200 --to numpy -o x.py"],
    "claims": ["claims gauss-200"],
    "certificate": ["certificate gauss-200"],
    "lsp": ["lsp --once gauss-200"],
}
"""Runs of each command that take minutes, where another command is not enough."""
SHORT = {
    "list": "it reads an index, and files within limits",
    "explain": "it looks up a word",
    "cite": "it reads the head of a file within limits",
    "schema": "it writes what is declared",
}
"""Why the others never work for long."""


def test_every_command_is_tried() -> None:
    """A new command has an input here that takes long, or the reason why it has none."""
    assert LONG.keys() | SHORT.keys() == NAMES
    assert not LONG.keys() & SHORT.keys()


@pytest.mark.parametrize(
    ("line", "name"),
    [
        (line, name)
        for k, line in enumerate(line for lines in LONG.values() for line in lines)
        for name in (("SIGINT", "SIGTERM") if IS_WHOLE else ("SIGINT", "SIGTERM")[k % 2 :][:1])
    ],
)
def test_a_command_ends_at_a_signal(line: str, name: str, tmp_path: Path) -> None:
    """Its exit code is that of the signal, nothing is said, and no half of a file is left. Each command
    is ended by one of the signals, in ``make whole`` by both.
    """
    for file, text in FILES.items():
        (tmp_path / file).write_text(text)
    before = {*tmp_path.iterdir()}
    number = getattr(signal, name)
    said = tmp_path.parent / "said"

    def work() -> int:
        os.chdir(tmp_path)
        with said.open("w") as err, redirect_stderr(err), redirect_stdout(StringIO()):
            return _exit_code(line.split())

    code = _ended(work, number)
    assert (code, said.read_text()) == (128 + number, "")
    left = {*tmp_path.iterdir()} - before
    assert {x.name for x in left} <= {"spec.jsonl"}


def _in_c() -> int:
    """One call of a library in C for very long."""
    with at_once():
        flint.fmpz_poly([1 + 10**2000, -2 * 10**1000, 1]).complex_roots()
    return 0


def _in_python() -> int:
    """Work that undoes something, and for longer than a thing that is begun behind it."""
    with at_once():
        first, second = undone(), undone()
        first.__enter__()
        try:
            second.__enter__()
            first.__exit__(None, None, None)
            while True:
                pass
        except KeyboardInterrupt:
            return 5


def _afterwards() -> int:
    """Work behind something that has been undone."""
    with at_once():
        with undone():
            pass
        flint.fmpz_poly([1 + 10**2000, -2 * 10**1000, 1]).complex_roots()
    return 0


def _with_a_lost_exception() -> int:
    """Work in which a library loses the exception of a signal; loops look for it."""
    with at_once(), undone():
        with suppress(Ended):
            os.kill(os.getpid(), signal.SIGTERM)
        try:
            check_time()
        except Ended as ended:
            return ended.exit_code
    return 1


def test_a_lost_exception_is_raised_again() -> None:
    before = signal.getsignal(signal.SIGTERM)
    assert _with_a_lost_exception() == 128 + signal.SIGTERM
    assert signal.getsignal(signal.SIGTERM) == before
    check_time()


@pytest.mark.parametrize(("work", "code"), [(_in_c, 130), (_in_python, 5), (_afterwards, 130)])
def test_where_python_hears_of_signals(work: Callable[[], int], code: int) -> None:
    """Where something has to be undone; elsewhere the system ends the process, which Python, in a
    call of C, would not.
    """
    assert _ended(work, signal.SIGINT) == code


def _ended(work: Callable[[], int], number: int) -> int:
    """The exit code, as a shell has it, of a process that is sent a signal once it is at work."""
    here, there = os.pipe()
    process = os.fork()
    if process == 0:
        _begin(work, there)
    os.close(there)
    try:
        assert select.select([here], [], [], PATIENCE)[0]
        assert os.read(here, 1), "the work has ended"
        os.kill(process, number)
        # the end of the pipe is closed where the process, and those that work for it, are gone
        while ready := select.select([here], [], [], PATIENCE)[0]:
            if not os.read(here, 100):
                break
        assert ready
    finally:
        os.kill(process, signal.SIGKILL)
        _, status = os.waitpid(process, 0)
        os.close(here)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


def _begin(work: Callable[[], int], sign: int) -> NoReturn:
    """Work in this process; it gives a sign once it has worked for a while, or has others work."""
    try:
        os.setpgid(0, 0)
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        # written to by C, whatever Python is at
        os.set_blocking(sign, False)
        signal.set_wakeup_fd(sign, warn_on_full_buffer=False)
        signal.signal(signal.SIGVTALRM, lambda *_: None)
        signal.setitimer(signal.ITIMER_VIRTUAL, WORKED)
        os.register_at_fork(after_in_parent=lambda: os.write(sign, b"."))
        code = work()
        sys.stderr.flush()
        os._exit(code)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
    finally:
        os._exit(99)
