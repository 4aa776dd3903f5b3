"""``--scheduler``: a real Dask cluster of this machine, whose workers are killed half-way."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from garkcli import loads_family
from garkcli.crew.cluster import Cluster, _done
from garkcli.crew.work import WorkerLost
from garkcli.design.search.run import SearchResult, results
from garkcli.errors import UsageProblem
from garkcli.methodfile.search_file import FileSearch
from garkcli.sweep.file import load_plan
from garkcli.sweep.run import sweep
from garkcli.sweep.store import RowStore
from tests.cli.harness import gark

distributed = pytest.importorskip("dask.distributed")
pytestmark = pytest.mark.skipif(os.name == "nt", reason="there are no such signals")

SPEC = """files: explicit.yaml
search: {seeds: 1..4}
methods:
  - {family: [gauss, radau-iia], stages: 1..2}
  - {family: lobatto-iiia, stages: [2, 3]}
transfer: [collocation, {interpolation: tau, collocation: 1 - tau}]
parameters: {tau: {from: 0, to: 1, steps: 40}}
columns: [order, pair-order, stages]
"""
"""336 methods that are given and four that are searched for."""
EXPLICIT = """unknown: {stages: 4, shape: explicit}
design: {order: 4}
"""


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Two workers; one that is killed comes back."""
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as made:
        yield made


def kill_one(cluster: Any) -> int:
    """Kill a worker; its process."""
    process: int = next(iter(cluster.workers.values())).pid
    os.kill(process, signal.SIGKILL)
    return process


def processes(cluster: Any) -> set[int]:
    """Those of the workers."""
    return {worker.pid for worker in cluster.workers.values()}


def test_a_sweep_that_loses_a_worker(cluster: Any, tmp_path: Path) -> None:
    """Every row is there, and once."""
    spec = tmp_path / "spec.yaml"
    spec.write_text(SPEC, encoding="utf-8")
    (tmp_path / "explicit.yaml").write_text(EXPLICIT, encoding="utf-8")
    rows, killed = spec.with_suffix(".jsonl"), 0
    plan = load_plan(str(spec))
    with RowStore(str(rows), False) as store:
        for progress in sweep(plan, store, 1, cluster.scheduler_address):
            if progress.done and not killed:
                killed = kill_one(cluster)
    assert killed not in processes(cluster)
    assert progress.done == len(plan) == 8 * 42 + 4
    found = [json.loads(x) for x in rows.read_text("utf-8").splitlines()]
    assert len({row["key"] for row in found}) == len(found) == len(plan)
    searched = [row["order"] for row in found if "seed" in row]
    assert searched == [4] * 4


def told(result: SearchResult) -> tuple[object, ...]:
    """A result without its time."""
    counts = result.starts, result.successes, result.degenerate
    return (*counts, result.methods)


def test_a_search_that_loses_a_worker(cluster: Any) -> None:
    """The finds are those of one process, to the last digit."""
    asked = FileSearch.of(loads_family(EXPLICIT), 4)
    alone = list(results(asked.search, 150, seed=3))[-1]
    killed = 0
    with Cluster(asked.do, cluster.scheduler_address, lost) as workers:
        assert workers.size == 2
        for result in results(asked.search, 150, 3, workers=workers):
            if result.starts and not killed:
                killed = kill_one(cluster)
    assert killed not in processes(cluster)
    assert len(alone.methods) == 5
    assert told(result) == told(alone)


def lost(_: object, why: str) -> Any:
    """For items that never come to an end."""
    raise WorkerLost(why)


def test_the_command(cluster: Any, tmp_path: Path) -> None:
    """Its report is that of one process."""
    path = tmp_path / "explicit.yaml"
    path.write_text(EXPLICIT, encoding="utf-8")
    command = ["design", str(path), "--search", "40", "--most", "2"]
    there = gark(*command, "--scheduler", cluster.scheduler_address)
    assert there.out == gark(*command).out
    assert (there.code, "exact: order 4" in there.out) == (0, True)


def ends(_: int) -> int:
    """Work that no process outlives."""
    os.kill(os.getpid(), signal.SIGKILL)
    return 0


def test_an_item_that_ends_every_worker(cluster: Any) -> None:
    """It has the outcome that is for those; the others are done."""
    address = cluster.scheduler_address
    with Cluster(ends, address, lambda _, why: why) as workers:  # type: ignore[arg-type, return-value]
        ((number, outcome),) = workers.as_they_come([1])
    assert (number, outcome) == (0, "on the cluster, several times")


def test_another_version(cluster: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers with another version of garkcli are refused before they do anything."""
    assert _done("0.0.0", ends, 1)[1] is None
    monkeypatch.setattr("garkcli.crew.cluster.__version__", "0.0.0")
    address = cluster.scheduler_address
    refused = pytest.raises(UsageProblem, match="has garkcli")
    with Cluster(abs, address, lost) as workers, refused:
        list(workers.as_they_come([1]))


def test_nobody_there() -> None:
    """What is not there is said, with the cure."""
    with pytest.raises(UsageProblem, match="no Dask scheduler answers"):
        Cluster(abs, "nonsense://here", lost).__enter__()


def test_a_scheduler_that_goes_away() -> None:
    """It is said in a line; what was done before is kept by who asked."""
    made = distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=":0")
    with made, Cluster(abs, made.scheduler_address, lost) as workers:
        assert list(workers.as_they_come([-1])) == [(0, 1)]
        coming = workers.as_they_come([-2] * 2000)
        assert next(coming)[1] == 2
        made.close()
        with pytest.raises(WorkerLost, match="is gone"):
            list(coming)
