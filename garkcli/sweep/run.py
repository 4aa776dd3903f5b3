"""The computation of missing rows in this process, in others, or on a cluster."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from functools import partial
from time import process_time
from typing import TypeAlias

from garkcli.crew.hiring import hired
from garkcli.errors import UsageProblem
from garkcli.frozen import Mutable
from garkcli.sweep.plan import Criteria, Plan, Point
from garkcli.sweep.row import Row, crashed_row, row_of
from garkcli.sweep.store import RowStore

Result: TypeAlias = tuple[str, float]
"""Rows as lines of JSON, and the processor time used."""


def rows_of(criteria: Criteria, points: Sequence[Point]) -> Result:
    begin = process_time()
    return lines([row_of(criteria, point) for point in points]), process_time() - begin


def lines(rows: Sequence[Row]) -> str:
    return "".join(f"{json.dumps(row)}\n" for row in rows)


CHUNK = 25
"""Methods per task: the overhead of a task is about the cost of one method."""


class Progress(Mutable):
    """The numbers of methods, of rows before, and of added ones, with their time."""

    total: int
    before: int
    done: int = 0
    seconds: float = 0.0


def sweep(plan: Plan, store: RowStore, jobs: int = 1, scheduler: str = "") -> Iterator[Progress]:
    """Adds the missing rows and yields the progress after each task; UsageProblem for rows of
    another sweep or a file that is not resumed, or without the cluster of ``scheduler``.
    """
    missing = []
    for point in plan.points():
        row = store.rows.get(point.key)
        if row is None:
            missing.append(point)
        elif row.get("spec") != plan.criteria.fingerprint(point.template):
            message = f"{store.path} has rows of another spec, such as that of {point.key}"
            cure = "columns, conditions or a method file have changed: choose another --rows"
            raise UsageProblem(message, cure, code="other-file")
    if missing and store.rows and not store.is_resumed:
        raise store.refusal
    progress = Progress(len(plan), len(plan) - len(missing))
    yield progress
    quick = [x for x in missing if not x.template.is_searched]
    tasks = [quick[k : k + CHUNK] for k in range(0, len(quick), CHUNK)]
    tasks += [[x] for x in missing if x.template.is_searched]
    for text, seconds in _results(plan.criteria, tasks, jobs, scheduler):
        for line in text.splitlines():
            store.add(json.loads(line))
            progress.done += 1
        progress.seconds += seconds
        yield progress


def _results(
    criteria: Criteria, tasks: list[list[Point]], jobs: int, scheduler: str
) -> Iterator[Result]:
    ended: list[Sequence[Point]] = []

    def crashed(points: Sequence[Point], why: str) -> Result:
        if len(points) > 1:
            ended.append(points)
            return "", 0.0
        return lines([crashed_row(criteria, points[0], why)]), 0.0

    work = partial(rows_of, criteria)
    jobs = min(jobs, len(tasks))
    with hired(work, crashed, jobs, scheduler) as workers:
        for _, result in workers.as_they_come(tasks):
            yield result
        for _, result in workers.as_they_come([[point] for points in ended for point in points]):
            yield result
