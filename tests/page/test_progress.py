"""The bar on stderr: on a terminal, for long work, and nothing of it stays."""

from __future__ import annotations

import io

import pytest

from garkcli.page import progress
from garkcli.page.progress import watching


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch, patience: float = 0.0) -> _Terminal:
    """Stderr as a terminal, and a bar that appears after so many seconds; no fixture, which would
    be undone.
    """
    made = _Terminal()
    monkeypatch.setattr("sys.stderr", made)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(progress, "PATIENCE", patience)
    return made


def test_long_work_has_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is done and how far it is, in one bar that goes on from thing to thing, and is wiped out
    at the end.
    """
    stderr = terminal(monkeypatch)
    with watching() as watch:
        watch("h = 1/8", 1, 40)
        watch("h = 1/16", 70, 80)
    assert "h = 1/8" in stderr.getvalue()
    assert "h = 1/16" in stderr.getvalue()
    assert "70/80" in stderr.getvalue()
    assert stderr.getvalue().endswith("\x1b[2K")  # the last line is cleared


def test_short_work_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is shown before so much time has passed."""
    stderr = terminal(monkeypatch, 60.0)
    with watching() as watch:
        watch("h = 1/8", 40, 40)
    assert stderr.getvalue() == ""


def test_quiet_work_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no bar is wanted there is none, however long it takes."""
    stderr = terminal(monkeypatch)
    with watching(False) as watch:
        watch("h = 1/8", 1, 40)
    assert stderr.getvalue() == ""


def test_bar_goes_when_work_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """An error takes the bar away with it."""
    stderr = terminal(monkeypatch)

    def work() -> None:
        with watching() as watch:
            watch("h = 1/8", 1, 40)
            raise ValueError("broken")

    with pytest.raises(ValueError, match="broken"):
        work()
    assert stderr.getvalue().endswith("\x1b[2K")
