"""The one place where it is chosen who does the work; whoever does, the outcomes are the same."""

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
    """Workers for as long as there is work; none is left behind.

    Args:
        work: from an item to its outcome; both, and ``work``, travel between processes.
        crashed: the outcome of an item that ended its worker, and how.
        jobs: processes of this machine.
        scheduler: the address of a Dask scheduler, to work there instead.
        limit: how long an item may take a worker of this machine; there is one, then.

    Raises:
        UsageProblem: there is no cluster.
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
