"""``make mutants``: small changes in the mathematical rooms, and which of them no test sees.

    python -m tests.mutants.run [--count N] [--seed N] [--rooms NAME[,NAME…]] [--again]

A change is made in a copy of the repository, in ``.mutants``. The tests of ``make whole`` that run
its line are run until one fails, those of its own room first, and the fastest first.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import queue
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from tests.mutants.places import (
    ROOMS,
    ROOT,
    Mutation,
    lines_of_statement,
    reason,
    reason_of_proposal,
    sample,
    source,
)

CACHE = ROOT / ".mutants"
"""Copies, the record and results; ignored by git, and safe to delete."""
RECORD = CACHE / "record.json"
RESULTS = CACHE / "results.json"
TESTS = (
    *(f"tests/{room}" for room in ROOMS),
    *(f"garkcli/{room}" for room in ROOMS),
    *("tests/oracles", "tests/paper", "tests/families", "tests/transfer", "tests/constructions"),
    *("tests/check", "tests/catalogue", "tests/comparison", "tests/conversion", "tests/api"),
    *("tests/cli", "tests/convergence", "tests/longtime", "tests/methodfile", "tests/report"),
    *("tests/integration/test_existence.py", "tests/integration/test_referee.py"),
    *("tests/docs/test_transcripts.py", "tests/docs/test_tutorials.py"),
)
"""Recorded tests: folders and files. Others write texts or packages, which say little of a
number.
"""
PROCESSES = 2
"""Copies in which tests run at the same time."""
MOST_SECONDS = 120.0
"""Tests of other rooms are run for so long, by what the record says."""
PROPOSES = "only proposed"
"""The fate of a survivor that no verdict hangs on."""
FORGIVEN = 0.05
"""The share of mutants that may survive without a reason."""
T = TypeVar("T")


@dataclass(frozen=True)
class Record:
    """Which tests run which lines of the package as it is.

    Attributes:
        code: a digest of the package; another one needs another record.
        files: one of each file of tests.
        seconds: the processor time of each test that passes.
        lines: by file and test, the lines that it runs.
    """

    code: str
    files: Mapping[str, str]
    seconds: Mapping[str, float]
    lines: Mapping[str, Mapping[str, Sequence[int]]]

    def tests_of(self, mutation: Mutation) -> list[str]:
        """Those that run the statement, or any line of the file where an import runs it."""
        by_test = self.lines.get(mutation.path, {})
        wanted = lines_of_statement(source(mutation.path), mutation.at[0])
        seen = {*(wanted or ())}
        found = [x for x, lines in by_test.items() if wanted is None or not seen.isdisjoint(lines)]
        return sorted((x for x in found if x in self.seconds), key=self.seconds.__getitem__)

    def changed_files(self) -> list[str]:
        """Files of tests that the record does not know as they are."""
        return [path for path, text in digests().items() if self.files.get(path) != text]


@dataclass(frozen=True)
class Outcome:
    """What came of one mutant.

    Attributes:
        mutation: the change.
        fate: killed, killed by a limit, survived, known to survive, or only proposed.
        tests: how many tests run its line.
        seconds: how long it took.
    """

    mutation: Mutation
    fate: str
    tests: int
    seconds: float

    def __str__(self) -> str:
        ran = f"{self.tests} tests run it" if self.tests else "no test runs it"
        return told(self.mutation, f": {self.fate}; {ran}")


def told(mutation: Mutation, said: str = "") -> str:
    """Where a change is, its lines, and why it need not be killed where that is known."""
    was, becomes = mutation.difference
    lines = [f"{mutation.path}:{mutation.at[0]}{said}"]
    lines += [f"  - {line}" for line in was.splitlines()]
    lines += [f"  + {line}" for line in becomes.splitlines()]
    why = reason(mutation) or reason_of_proposal(mutation.path, mutation.at[0])
    return "\n".join([*lines, *([f"  {why}"] if why else [])])


def digests() -> dict[str, str]:
    """One of each file of tests."""
    roots = [ROOT / name for name in TESTS]
    paths = [p for root in roots for p in ([root] if root.is_file() else root.rglob("test_*.py"))]
    return {path.relative_to(ROOT).as_posix(): digest([path]) for path in sorted(paths)}


def digest(paths: Sequence[Path]) -> str:
    """The same for the same texts."""
    whole = hashlib.sha256()
    for path in paths:
        whole.update(path.read_bytes())
    return whole.hexdigest()


def copy(name: str) -> Path:
    """A copy of what git knows or would add, as it is now."""
    folder = CACHE / name
    shutil.rmtree(folder, ignore_errors=True)
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for path in names.split("\0"):
        if (ROOT / path).is_file():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / path, folder / path)
    return folder


def pytest_in(
    tree: Path, said: Path, plugin: str, *arguments: str, **variables: str
) -> subprocess.Popen[bytes]:
    """A run of pytest in a copy, as the leader of its processes; what it prints is kept.

    No sample is taken: a case of ``make whole`` kills as many as one of the suite.
    """
    command = [sys.executable, "-m", "pytest", "-p", f"tests.mutants.{plugin}", *arguments]
    return subprocess.Popen(
        command,
        cwd=tree,
        env={**os.environ, "PYTHONPATH": str(tree), "GARK_WHOLE": "1", **variables},
        stdin=subprocess.DEVNULL,
        stdout=said.open("wb"),
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )


def recorded(is_anew: bool) -> Record:
    """The record of the package as it is; made where there is none."""
    code = digest(sorted((ROOT / "garkcli").rglob("*.py")))
    if RECORD.exists() and not is_anew:
        record = Record(**json.loads(RECORD.read_text(encoding="utf-8")))
        if record.code == code:
            return record
    print("which tests run which lines: all are run once …", flush=True)
    tree = copy("record")
    parts = CACHE / "parts"
    shutil.rmtree(parts, ignore_errors=True)
    parts.mkdir()
    side_by_side(partial(record_part, parts=parts), TESTS, [tree] * PROCESSES)
    seconds: dict[str, float] = {}
    lines: dict[str, dict[str, list[int]]] = {}
    for part in sorted(parts.glob("*.json")):
        found = json.loads(part.read_text(encoding="utf-8"))
        seconds |= found["seconds"]
        for path, by_test in found["lines"].items():
            lines.setdefault(path, {}).update(by_test)
    record = Record(code, digests(), seconds, lines)
    RECORD.write_text(json.dumps(vars(record)), encoding="utf-8")
    return record


def record_part(tests: str, tree: Path, parts: Path) -> None:
    """Run the tests of one folder."""
    name = tests.removesuffix(".py").replace("/", "-")
    variables = {"GARK_RECORD": str(parts / f"{name}.json"), "GARK_ROOMS": ",".join(ROOMS)}
    said = parts / f"{name}.txt"
    process = pytest_in(tree, said, "recording", "-n", "0", tests, **variables)
    if process.wait() > 1:
        raise SystemExit(f"the tests of {tests} did not run, see {said}")


def stages(mutation: Mutation, record: Record) -> Iterator[tuple[list[str], list[str]]]:
    """Tests to run, and files to run whole: first those of the room, then the others."""
    room = mutation.path.split("/")[1]
    own, others = [], []
    for test in record.tests_of(mutation):
        (own if test.startswith((f"tests/{room}/", f"garkcli/{room}/")) else others).append(test)
    changed = record.changed_files()
    yield own, [path for path in changed if path.startswith(f"tests/{room}/")]
    left = MOST_SECONDS
    kept = []
    for test in others:
        left -= record.seconds[test]
        if left > 0:
            kept.append(test)
    yield kept, []


def judge(mutation: Mutation, record: Record, tree: Path, now: Iterator[int]) -> Outcome:
    """Run the tests of one mutant in a copy, which is as before afterwards."""
    start = time.monotonic()
    file = tree / mutation.path
    original = file.read_text(encoding="utf-8")
    fate = "survived"
    try:
        put(mutation.text, file, next(now))
        for tests, files in stages(mutation, record):
            if (tests or files) and fate == "survived":
                fate = run_tests(tree, tests, files, record)
    finally:
        put(original, file, next(now))
    if fate == "survived" and reason_of_proposal(mutation.path, mutation.at[0]):
        fate = PROPOSES
    count = len(record.tests_of(mutation))
    return Outcome(mutation, fate, count, time.monotonic() - start)


def put(text: str, file: Path, time_of_change: int) -> None:
    """Write a file with a time of change."""
    file.write_text(text, encoding="utf-8")
    os.utime(file, (time_of_change, time_of_change))


def run_tests(tree: Path, tests: list[str], files: list[str], record: Record) -> str:
    """What becomes of the mutant in a copy."""
    seconds = 30 + 2 * int(sum(record.seconds[test] for test in tests)) + 60 * len(files)
    choice = tree / "choice.json"
    choice.write_text(json.dumps({"tests": tests, "files": files, "seconds": seconds}), "utf-8")
    paths = sorted({*files, *(test.partition("::")[0] for test in tests)})
    options = ("-n", "0", "-x", "--tb=no", "--no-header", *paths)
    process = pytest_in(tree, tree / "said.txt", "choosing", *options, GARK_CHOICE=str(choice))
    try:
        code = process.wait(timeout=20 * seconds)
    except subprocess.TimeoutExpired:
        code = -signal.SIGKILL
    finally:
        end_all(process)
    if code == 0:
        return "survived"
    return "killed" if code > 0 else "killed by a limit"


def end_all(process: subprocess.Popen[bytes]) -> None:
    """End what a run of pytest started, and itself."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def judged(mutations: Sequence[Mutation], record: Record) -> list[Outcome]:
    """The outcomes of all mutants; survivors are told at once."""
    outcomes = []
    unknown = []
    for mutation in mutations:
        if reason(mutation):
            count = len(record.tests_of(mutation))
            outcomes.append(Outcome(mutation, "known to survive", count, 0.0))
        else:
            unknown.append(mutation)
    # a time of its own for each text of a file: by that and its length Python knows the byte code
    now = iter(range(10**9, 2 * 10**9, 10))

    def one(mutation: Mutation, tree: Path) -> None:
        outcome = judge(mutation, record, tree, now)
        outcomes.append(outcome)
        if outcome.fate in {"survived", PROPOSES}:
            print(outcome, flush=True)

    side_by_side(one, unknown, [copy(str(number)) for number in range(PROCESSES)])
    return outcomes


def side_by_side(task: Callable[[T, Path], None], inputs: Sequence[T], trees: list[Path]) -> None:
    """Do a task for each input, with so many copies at a time, each in one task."""
    free: queue.SimpleQueue[Path] = queue.SimpleQueue()
    for tree in trees:
        free.put(tree)

    def do(x: T) -> None:
        tree = free.get()
        try:
            task(x, tree)
        finally:
            free.put(tree)

    with ThreadPoolExecutor(len(trees)) as crew:
        list(crew.map(do, inputs))


def summary(outcomes: Sequence[Outcome]) -> str:
    """One line.

    >>> mutation = Mutation("garkcli/exact/field.py", (1, 0), "AddNot", 0)
    >>> print(summary([Outcome(mutation, fate, 3, 1.0) for fate in ("killed", "survived")]))
    2 mutants: 1 killed, 1 survived (50.0 %)
    """
    fates = [outcome.fate for outcome in outcomes]
    counts = [f"{fates.count(fate)} {fate}" for fate in sorted({*fates})]
    share = 100 * fates.count("survived") / max(len(fates), 1)
    return f"{len(fates)} mutants: {', '.join(counts)} ({share:.1f} %)"


def survivors() -> list[Mutation]:
    """Those of the run before."""
    kept = json.loads(RESULTS.read_text(encoding="utf-8"))
    return [Mutation(x["path"], tuple(x["at"]), x["operator"], x["occurrence"]) for x in kept]


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw, run, tell; 1 where more mutants survive than may."""
    parser = argparse.ArgumentParser(description="changes that no test sees")
    parser.add_argument("--count", type=int, default=300, help="how many mutants")
    parser.add_argument("--seed", type=int, default=1, help="which sample")
    parser.add_argument("--rooms", default=",".join(ROOMS), help="rooms, with commas")
    parser.add_argument("--again", action="store_true", help="the survivors of the run before")
    parser.add_argument("--anew", action="store_true", help="record anew which tests run what")
    parser.add_argument("--list", action="store_true", help="list the mutants; run nothing")
    options = parser.parse_args(arguments)
    if options.again:
        mutations = survivors()
    else:
        mutations = sample(options.count, options.seed, options.rooms.split(","))
    if options.list:
        for mutation in mutations:
            print(told(mutation))
        return 0
    CACHE.mkdir(exist_ok=True)
    outcomes = judged(mutations, recorded(options.anew))
    alive = [x for x in outcomes if x.fate == "survived"]
    RESULTS.write_text(json.dumps([vars(x.mutation) for x in alive]), encoding="utf-8")
    for outcome in outcomes:
        if outcome.fate == "known to survive":
            print(outcome)
    print(summary(outcomes))
    return int(len(alive) > FORGIVEN * len(outcomes))


if __name__ == "__main__":
    sys.exit(main())
