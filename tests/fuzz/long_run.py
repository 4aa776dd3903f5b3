"""Files at scale, in worker processes with limits.

Run as ``python tests/fuzz/long_run.py --cases 200000 --seed 1 --jobs 2``; with ``--problems`` for
problem files.

A case is a fault when anything but ``MethodFileError`` comes out of the loader, when the loader
takes longer than five seconds or needs more than 500 MB, or when the worker dies. Methods that load
and are small are analysed too, for as long as two seconds; there only an exception is a fault.
Seconds are those of the processor: how busy the machine is makes no difference.

The alarm kills the worker rather than raising in it, so that no call into C escapes it; the next
worker goes on after the case that did it. Prints one line of JSON; each faulty input is saved, and
the exit code is 1 when there are any.
"""

from __future__ import annotations

import argparse
import json
import resource
import signal
import sys
import warnings
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from time import perf_counter, process_time
from typing import Literal

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from garkcli.check.analysis import analyse
from garkcli.errors import GarkError, MethodFileError
from garkcli.methodfile.load import loads
from garkcli.problems.files.load import loads_problem
from garkcli.tableau.tableau import Tableau
from tests.fuzz.hostile import hostile_files, hostile_problems
from tests.fuzz.inputs import method_file, radical_file, seeds
from tests.fuzz.problem_inputs import SMALL, problem_file, problem_seeds

SECONDS = 5.0
"""Longest time of the loader, of the processor."""
MEGABYTES = 500
"""Most memory of a worker beyond that of its start."""
ANALYSIS_SECONDS = 2.0
"""How long an analysis may take before it is left, of the processor."""
BATCH = 2_000
"""Cases for one worker."""
RARE = 400
"""Every so many cases, one with many radicals."""
GOOD = "methods: [{family: gauss, stages: 2}]"
"""A method to begin with."""
FAULTS = Path(".hypothesis") / "faults"
"""Where faulty inputs are saved."""


@dataclass(frozen=True)
class Case:
    """What came of one case; ``seconds`` are those of the loader, of the processor."""

    number: int
    kind: Literal["loaded", "refused", "fault"]
    seconds: float = 0.0
    analysis: Literal["none", "done", "left"] = "none"
    error: str = ""


@dataclass(frozen=True)
class Cases:
    """Where inputs come from: the random generators with a seed, or the hostile files when there is
    none.

    ``seconds`` is the longest time of the loader, of the processor.
    """

    seed: int | None
    are_problems: bool = False
    seconds: float = SECONDS

    def load(self, text: str) -> Tableau | None:
        """What is tried: a method to analyse further, or a problem."""
        if self.are_problems:
            loads_problem(text)
            return None
        return loads(text).tableau

    def hostile(self) -> Mapping[str, str]:
        """The hostile files by name."""
        return hostile_problems() if self.are_problems else hostile_files()

    def reader(self) -> Callable[[int], str]:
        """The input of each number."""
        if self.seed is None:
            hostile = list(self.hostile().values())
            return hostile.__getitem__
        files = problem_seeds() if self.are_problems else seeds()

        def text_of(number: int) -> str:
            random = Random(f"{self.seed}/{number}")
            if self.are_problems:
                return problem_file(random, files)
            return method_file(random, files) if number % RARE else radical_file(random)

        return text_of


class _LateError(Exception):
    """An analysis took too long."""


def work(cases: Cases, numbers: range, results: Connection) -> None:
    """In a worker: run ``numbers`` and send what came of each."""
    warnings.simplefilter("error")  # a warning is a fault too
    text_of = cases.reader()
    cases.load(
        SMALL[0] if cases.are_problems else GOOD
    )  # what is imported late is no part of the first case
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[0])
    roof = pages * resource.getpagesize() + MEGABYTES * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (roof, roof))
    for number in numbers:
        results.send(_run(cases, number, text_of(number)))
    results.close()


def _run(cases: Cases, number: int, text: str) -> Case:
    start = process_time()
    try:
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # ends the worker
        signal.setitimer(signal.ITIMER_PROF, cases.seconds)
        tableau = cases.load(text)
    except MethodFileError as error:
        seconds = process_time() - start
        if not error.faults or any(fault.line < 1 or fault.column < 1 for fault in error.faults):
            return Case(number, "fault", seconds, error="a fault without a place")
        return Case(number, "refused", seconds)
    except Exception as error:
        return Case(number, "fault", process_time() - start, error=repr(error)[:200])
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    seconds = process_time() - start
    if tableau is None or tableau.size > 3 or any(space.stages > 6 for space in tableau.spaces):
        return Case(number, "loaded", seconds)
    try:
        return Case(number, "loaded", seconds, "done" if _is_analysed(tableau) else "left")
    except Exception as error:
        return Case(number, "fault", seconds, error=f"analyse: {error!r}"[:200])


def _is_analysed(tableau: Tableau) -> bool:
    def late(*_: object) -> None:
        raise _LateError

    signal.signal(signal.SIGPROF, late)
    try:
        signal.setitimer(signal.ITIMER_PROF, ANALYSIS_SECONDS)
        analyse(tableau, limit=12)
    except _LateError:
        return False
    except GarkError as error:
        raise RuntimeError(f"{type(error).__name__} from a method that loads") from error
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return True


def run(cases: Cases, numbers: range) -> list[Case]:
    """Run ``numbers`` in as many workers as it takes."""
    done: list[Case] = []
    while len(done) < len(numbers):
        receiver, sender = get_context("spawn").Pipe(duplex=False)
        worker = get_context("spawn").Process(
            target=work, args=(cases, numbers[len(done) :], sender)
        )
        worker.start()
        sender.close()
        done += _received(receiver)
        worker.join()
        if len(done) < len(numbers):
            late = worker.exitcode == -signal.SIGPROF
            error = (
                f"longer than {cases.seconds:g} s"
                if late
                else f"the worker ended with {worker.exitcode}"
            )
            done.append(
                Case(numbers[len(done)], "fault", cases.seconds if late else 0.0, error=error)
            )
    return done


def _received(receiver: Connection) -> Iterable[Case]:
    while True:
        try:
            yield receiver.recv()
        except EOFError:
            return


def summary(results: list[Case], elapsed: float) -> dict[str, float]:
    """The figures of a run: ``slowest`` and ``loading`` are processor seconds, ``seconds`` those of
    a clock.
    """
    count = {
        kind: sum(case.kind == kind for case in results) for kind in ("loaded", "refused", "fault")
    }
    return {
        "cases": len(results),
        "loaded": count["loaded"],
        "analysed": sum(case.analysis == "done" for case in results),
        "analyses left": sum(case.analysis == "left" for case in results),
        "refused": count["refused"],
        "faults": count["fault"],
        "slowest": round(max((case.seconds for case in results), default=0.0), 3),
        "loading": round(sum(case.seconds for case in results), 1),
        "seconds": round(elapsed, 1),
    }


def main() -> int:
    """Run and report."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--hostile", action="store_true", help="files made to be slow or large, not random ones"
    )
    parser.add_argument("--problems", action="store_true", help="problem files, not method files")
    parser.add_argument("--faults", type=Path, default=FAULTS, help="where to save faulty inputs")
    options = parser.parse_args()
    cases = Cases(None if options.hostile else options.seed, options.problems)
    names = list(cases.hostile()) if options.hostile else []
    total, batch = (len(names), 8) if options.hostile else (options.cases, BATCH)
    start = perf_counter()
    with ThreadPoolExecutor(options.jobs) as threads:
        shares = [range(k, min(k + batch, total)) for k in range(0, total, batch)]
        results = [
            case for share in threads.map(lambda share: run(cases, share), shares) for case in share
        ]
    faults, text_of = ([case for case in results if case.kind == "fault"], cases.reader())
    for case in faults:
        options.faults.mkdir(parents=True, exist_ok=True)
        name = names[case.number].replace(" ", "-") if names else f"{options.seed}-{case.number}"
        file = options.faults / f"{name}{'.problem' if options.problems else '.gark'}.yaml"
        file.write_text(text_of(case.number), encoding="utf-8", errors="surrogatepass")
        print(f"{file}: {case.error}", file=sys.stderr)
    print(json.dumps(summary(results, perf_counter() - start)))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
