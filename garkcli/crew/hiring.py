"""Chooses who does the work; the outcomes do not depend on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from garkcli.crew.work import Alone, Item, Limit, Outcome, Workers


@contextmanager
def hired(
    work: Callable[[Item], Outcome],
    crashed: Callable[[Item, str], Outcome],
    jobs: int = 1,
    scheduler: str = "",
    limit: Limit[Item, Outcome] | None = None,
) -> Iterator[Workers[Item, Outcome]]:
    """Returns workers as a context manager; none is left behind.

    ``crashed`` makes the outcome of an item that ended its worker, from how it ended. A
    ``scheduler`` is used instead of ``jobs`` processes; a ``limit`` needs one process at least.
    Raises UsageProblem if the cluster cannot be used.
    """
    if scheduler:
        from garkcli.crew.cluster import Cluster

        with Cluster(work, scheduler, crashed) as cluster:
            yield cluster
    elif jobs < 2 and limit is None:
        yield Alone(work)
    else:
        from garkcli.crew.processes import MOST_WORKERS, Crew

        with Crew(work, min(jobs, MOST_WORKERS), crashed, limit) as crew:
            yield crew
