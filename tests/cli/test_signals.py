"""Runs that are ended from outside: they clean up, say nothing, and have the code of the signal."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.cli.harness import ROOT
from tests.had import needs_signals
from tests.whole import in_whole

pytestmark = needs_signals
PATIENCE = 60.0
"""Seconds to wait for a sign of life, on a machine that is very busy."""
# nothing to be fast enough for: millions of trees
FOR_EVER = ("trees", "-N", "2", "-n", "12", "--yes", "--format", "ndjson")
# much more than a pipe holds
LONG = ("trees", "-N", "2", "-n", "10", "--yes", "--format", "ndjson")


def _as_from_a_terminal() -> None:
    """What a job in the background inherits, ignored interrupts, is not what is tested here."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


@contextmanager
def running(*arguments: str, ignoring: bool = False) -> Iterator[subprocess.Popen[bytes]]:
    """The program at work; it is gone at the end."""
    with subprocess.Popen(
        [sys.executable, "-m", "garkcli", *arguments],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=None if ignoring else _as_from_a_terminal,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for(folder: Path, process: subprocess.Popen[bytes]) -> None:
    """Wait until the program has begun to write into ``folder``."""
    end = time.monotonic() + PATIENCE
    while not any(path.stat().st_size for path in folder.iterdir()):
        assert process.poll() is None
        assert time.monotonic() < end
        time.sleep(0.02)


@in_whole
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_report_that_is_cut_short_leaves_nothing(name: str, tmp_path: Path) -> None:
    """A signal while a file is being written takes it back: no file, no temporary one, no word, and
    128 plus the number of the signal.
    """
    number = getattr(signal, name)
    with running(*FOR_EVER, "-o", str(tmp_path / "trees.ndjson")) as process:
        wait_for(tmp_path, process)
        process.send_signal(number)
        out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out, err) == (128 + number, b"", b"")
    assert list(tmp_path.iterdir()) == []


@in_whole
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_reader_that_does_not_read_holds_nothing_up(name: str) -> None:
    """A program that waits for the pipe to have room ends at the signal, not when somebody reads."""
    number = getattr(signal, name)
    with running(*LONG) as process:
        assert process.stdout is not None
        assert process.stdout.read(1) == b"{"
        process.send_signal(number)
        assert process.wait(timeout=PATIENCE) == -number  # of which a shell makes 128 + number
        assert process.stderr is not None
        assert process.stderr.read() == b""


@in_whole
def test_signals_that_are_ignored_stay_so(tmp_path: Path) -> None:
    """Under ``nohup`` a terminal that closes does not end the run; SIGTERM still does."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with running(*FOR_EVER, "-o", str(tmp_path / "trees"), ignoring=True) as process:
            wait_for(tmp_path, process)
            process.send_signal(signal.SIGHUP)
            size = next(tmp_path.iterdir()).stat().st_size
            end = time.monotonic() + PATIENCE
            while next(tmp_path.iterdir()).stat().st_size <= size:
                assert process.poll() is None
                assert time.monotonic() < end
                time.sleep(0.02)
            process.send_signal(signal.SIGTERM)
            assert process.wait(timeout=PATIENCE) == 128 + signal.SIGTERM
    finally:
        signal.signal(signal.SIGHUP, before)
    assert list(tmp_path.iterdir()) == []


INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
module = sys.argv[1]
class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupting())
sys.argv = ["gark", *sys.argv[2:]]
from garkcli.__main__ import main
main()
"""
"""Run gark, and interrupt it where it begins to import a module."""
EARLY = ("garkcli.cli", "garkcli.cli.main", "click", "garkcli.cli.table", "garkcli.page.progress")
LATER = ("garkcli.cli.checking", "flint", "garkcli.report.check_text")


@pytest.mark.parametrize("module", EARLY + LATER)
def test_an_interrupt_while_it_starts_says_nothing(module: str) -> None:
    """From the first import of the command on ^C ends it without a word, by the signal."""
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, module, "check", "methods/rectangular.gark.yaml"],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, b"", b"")


@in_whole
def test_the_library_leaves_interrupts_alone() -> None:
    """Whoever imports gark, its command line included, keeps the handler of signals, also after a
    command ran.
    """
    script = (
        "import signal\n"
        "import garkcli\n"
        "garkcli.project_schema()\n"
        "from garkcli.cli import main\n"
        "try:\n"
        "    main(['--version'])\n"
        "except SystemExit:\n"
        "    print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        preexec_fn=_as_from_a_terminal,
    )
    assert done.stdout.splitlines()[-1] == "True"
