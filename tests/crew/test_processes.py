"""Processes that do the work side by side."""

from __future__ import annotations

import math
import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable
from multiprocessing.connection import Connection, Pipe
from typing import Any

import pytest

from garkcli.crew import processes
from garkcli.crew.processes import Crew
from garkcli.crew.work import Limit
from garkcli.exact.apart import start_method
from tests.had import needs_fork


def doubled(number: int) -> str:
    """Work that ends."""
    return str(2 * number)


def lost(number: int, how: str) -> str:
    """What is told of an item that ended its worker."""
    return f"{number} ended its worker {how}"


@pytest.mark.skipif(os.name == "nt", reason="needs SIGKILL")
def test_a_worker_that_dies_idle_is_no_items_fault() -> None:
    """Between two rounds one of two workers is killed: the items of the second round all have
    their outcomes.
    """
    with Crew(doubled, 2, lost) as crew:
        first = dict(crew.as_they_come([1, 2, 3, 4]))
        idle = crew.workers[0].process
        assert idle.pid is not None
        os.kill(idle.pid, signal.SIGKILL)
        idle.join()
        second = dict(crew.as_they_come([5, 6, 7, 8]))
    assert first == {0: "2", 1: "4", 2: "6", 3: "8"}
    assert second == {0: "10", 1: "12", 2: "14", 3: "16"}


def test_how_processes_begin(monkeypatch: pytest.MonkeyPatch) -> None:
    """By a fork where that is safe: not on macOS, and not where there is none."""
    known = multiprocessing.get_all_start_methods
    for platform, can_fork, method in (
        ("linux", True, "fork"),
        ("darwin", True, "spawn"),
        ("win32", False, "spawn"),
    ):
        methods = ["fork", "spawn"] if can_fork else ["spawn"]
        monkeypatch.setattr(multiprocessing, "get_all_start_methods", lambda x=methods: x)
        monkeypatch.setattr(sys, "platform", platform)
        assert start_method() == method
    monkeypatch.undo()
    assert start_method() in known()


def test_processes_that_are_not_forked(monkeypatch: pytest.MonkeyPatch) -> None:
    """They get their items and give their outcomes as forked ones do."""
    monkeypatch.setattr(processes, "start_method", lambda: "spawn")
    with Crew(math.factorial, 1, lost) as crew:
        assert dict(crew.as_they_come([3, 4])) == {0: 6, 1: 24}


class _PipeEnd:
    """An end of a pipe that is no ``Connection``, as those of Windows are."""

    def __init__(self, end: Connection[Any, Any]) -> None:
        self._end = end

    def __getattr__(self, name: str) -> Callable[..., Any]:
        found: Callable[..., Any] = getattr(self._end, name)
        return found


@needs_fork
def test_pipes_of_another_type(monkeypatch: pytest.MonkeyPatch) -> None:
    """Outcomes arrive by pipes of whatever type the system has."""

    def piped(_: object) -> tuple[_PipeEnd, _PipeEnd]:
        here, there = Pipe()
        return _PipeEnd(here), _PipeEnd(there)

    forked = multiprocessing.get_context("fork")
    monkeypatch.setattr(type(forked), "Pipe", piped)
    with Crew(doubled, 1, lost) as crew:
        assert dict(crew.as_they_come([1, 2])) == {0: "2", 1: "4"}


def late_from_two(number: int) -> int:
    """Work that ends for small numbers alone."""
    while number > 1:
        time.sleep(1)
    return number


@pytest.mark.parametrize("size", [1, 2])
def test_an_item_has_a_limit(size: int) -> None:
    """The worker of an item that takes too long is ended, and others do the rest."""
    limit = Limit[int, int | str](lambda x: 0.1 if x > 1 else 60.0, lambda x: f"{x} is late")
    with Crew[int, int | str](late_from_two, size, lost, limit) as crew:
        found = dict(crew.as_they_come([0, 2, 1, 3, 1]))
        assert dict(crew.as_they_come([1])) == {0: 1}
    assert found == {0: 0, 1: "2 is late", 2: 1, 3: "3 is late", 4: 1}


def test_how_a_process_ended() -> None:
    """A signal has its name, and the one that systems send for want of memory its reason."""
    assert processes._cause(-9) == "by SIGKILL, as the system does where memory is short"
    assert processes._cause(3) == "with exit code 3"
