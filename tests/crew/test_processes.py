"""Processes that do the work side by side."""

from __future__ import annotations

import os
import signal

import pytest

from garkcli.crew.processes import Crew


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
