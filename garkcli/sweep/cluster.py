"""A sweep on a Dask cluster: tasks carry all they need, and what a lost worker had is done again.

Rows are written by the process that asked, once a task has come back: a task that runs twice is
written once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from garkcli.errors import UsageProblem
from garkcli.sweep.plan import Criteria, Point
from garkcli.sweep.row import crashed_row
from garkcli.sweep.task import Result, lines, rows_of

WINDOW = 400
"""Tasks that the cluster has at a time."""
TIMEOUT = 20
"""Seconds to wait for a scheduler."""


def on_cluster(
    criteria: Criteria, tasks: Sequence[Sequence[Point]], scheduler: str
) -> Iterator[Result]:
    """The results of tasks, as they come.

    Args:
        criteria: what is told of each method.
        tasks: some methods each.
        scheduler: its address, such as ``tcp://host:8786``.

    Raises:
        UsageProblem: Dask is not installed, or nobody answers there.
    """
    try:
        from dask.distributed import Client, as_completed
    except ImportError:
        raise UsageProblem(
            "--scheduler needs Dask", "install garkcli[cluster]"
        ) from None
    try:
        client = Client(scheduler, timeout=TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        what = str(error).splitlines()[0]
        raise UsageProblem(
            f"no Dask scheduler answers at {scheduler}: {what}",
            "dask scheduler starts one",
        ) from None
    waiting = list(reversed([tuple(points) for points in tasks]))
    running: dict[Any, tuple[Point, ...]] = {}

    def submit(points: tuple[Point, ...]) -> Any:
        future = client.submit(rows_of, criteria, points, pure=False)
        running[future.key] = points
        return future

    with client:
        count = min(WINDOW, len(waiting))
        first = [submit(waiting.pop()) for _ in range(count)]
        pool = as_completed(first, loop=client.loop)
        for future in pool:
            points = running.pop(future.key)
            fault = future.exception() if future.status == "error" else None
            if fault is None:
                yield future.result()
            elif len(points) > 1:
                waiting += [(point,) for point in points]
            else:
                why = f"on the cluster: {type(fault).__name__}"
                yield lines([crashed_row(criteria, points[0], why)]), 0.0
            future.release()
            while waiting and len(running) < WINDOW:
                pool.add(submit(waiting.pop()))
