"""Nineteen tasks of designers, by ``gark design`` and by plain programs with SciPy in one run.

    python -m tests.benchmarks.designer_tasks [NAME ...] [--jobs N]

A line a task: the objective that each reaches, the word for gark's proof, and processor seconds. A
plain program takes as many starts as gark, or a minute, and proves nothing.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from garkcli import load
from garkcli.exact.display import to_ball
from garkcli.tableau.pointwise import numeric_entries
from tests.benchmarks import plain_tasks as plain
from tests.benchmarks.measuring import GARK, seconds
from tests.benchmarks.plain_search import Problem, least


@dataclass(frozen=True)
class Task:
    """A task.

    Attributes:
        name: its name.
        file: the file for ``gark design``.
        minimise: the argument of ``--minimise``.
        starts: of the search, and of the plain program.
        problem: of the plain program.
        known: the objective of a method in print, with its authors.
        is_search: whether gark searches; else it decides about all methods.
        start: a method at which gark and the plain program start.
    """

    name: str
    file: str
    minimise: str
    starts: int
    problem: Callable[[], Problem]
    known: str
    is_search: bool = True
    start: str | None = None


TSITOURAS = "tsitouras-5"


def from_tsitouras(largest: float) -> Problem:
    """Pairs from that of Tsitouras on."""
    method = load(TSITOURAS)
    [[A]], embedded = numeric_entries(method.tableau).A, method.further.embedded
    assert A is not None
    assert embedded is not None
    block = np.array([[float(x) for x in row] for row in A])
    return plain.fsal_pair(
        block, np.array([float(to_ball(x, 64)) for x in embedded[0]]), 5, largest
    )


def shape(stages: int, shapes: str, wants: str) -> str:
    return f"unknown: {{stages: {stages}, shape: {shapes}}}\ndesign: {{{wants}}}\n"


TASKS = (
    Task(
        "ssp-5-4",
        shape(5, "explicit", "order: 4"),
        "-ssp",
        12,
        partial(plain.ssp, 5, 4),
        "1.508180, Kraaijevanger",
    ),
    Task(
        "ssp-10-4",
        shape(10, "explicit", "order: 4"),
        "-ssp",
        6,
        partial(plain.ssp, 10, 4),
        "6, Ketcheson",
    ),
    Task(
        "explicit-3-3",
        shape(3, "explicit", "order: 3"),
        "error",
        20,
        partial(plain.explicit_error, 3, 3),
        "0.00174800, Ralston",
        is_search=False,
    ),
    Task(
        "explicit-4-4",
        shape(4, "explicit", "order: 4"),
        "error",
        20,
        partial(plain.explicit_error, 4, 4),
        "0.000187799, Ralston",
    ),
    Task(
        "explicit-7-5",
        shape(7, "[explicit, stiffly-accurate]", "order: 5, fix: {b2: 0}"),
        "error",
        300,
        partial(plain.fsal_error, 7, 5),
        "1.593e-7, Dormand and Prince",
    ),
    Task(
        "explicit-7-54",
        "unknown: {stages: 7, shape: [explicit, stiffly-accurate], embedded: true}\n"
        "design: {order: 5, embedded-order: 4, fix: {b2: 0, bh2: 0}, largest-coefficient: 13}\n",
        "error",
        1,
        partial(from_tsitouras, 13),
        "1.919e-8, Tsitouras",
        start=TSITOURAS,
    ),
    Task(
        "sdirk-3-3",
        shape(3, "[sdirk, stiffly-accurate]", "order: 3, l-stable: true"),
        "error",
        20,
        plain.sdirk_error,
        "0.000882354, Alexander",
    ),
    Task(
        "esdirk-6-4",
        shape(
            6,
            "[esdirk, stiffly-accurate]",
            "order: 4, stage-order: 2, l-stable: true, nodes-in-unit-interval: true,"
            " range: {gamma: [1/5, 1/2]}",
        ),
        "error",
        20,
        partial(plain.esdirk_error, 6, 4),
        "3.349e-6, Kennedy and Carpenter",
    ),
    Task(
        "imex-4-3",
        shape(
            4, "[imex, stiffly-accurate]", "order: 3, R-infinity: {2: 0}, range: {gamma: [1/5, 1]}"
        ),
        "error",
        20,
        partial(plain.imex_error, 4, 3, 1.0),
        "",
    ),
    Task(
        "imex-6-4",
        shape(
            6,
            "[imex, stiffly-accurate]",
            "order: 4, R-infinity: {2: 0}, range: {gamma: [1/5, 1/2]}",
        ),
        "error",
        20,
        partial(plain.imex_error, 6, 4, 0.5),
        "",
    ),
    Task(
        "low-storage-5-4",
        shape(5, "low-storage", "order: 4"),
        "-imaginary-interval",
        12,
        partial(plain.low_storage_interval, 5, 4),
        "3.34, Carpenter and Kennedy",
    ),
    Task("nystrom-4-5", shape(4, "nystrom", "order: 5"), "error", 12, plain.nystrom_error, ""),
    Task(
        "composition-9-6",
        shape(9, "[symplectic-dirk, palindromic]", "order: 6"),
        "error",
        60,
        partial(plain.composition_error, 9, 6),
        "",
    ),
    Task(
        "composition-17-8",
        shape(17, "[symplectic-dirk, palindromic]", "order: 8"),
        "error",
        40,
        partial(plain.composition_error, 17, 8),
        "",
    ),
    Task(
        "splitting-6-4",
        shape(7, "[splitting, palindromic]", "order: 4"),
        "error",
        60,
        plain.splitting_error,
        "1.833e-7, Blanes and Moan",
    ),
    Task(
        "multirate-3-3",
        shape(3, "mri", "order: 3, fix: {c2: 1/3, c3: 2/3}"),
        "error",
        12,
        partial(plain.multirate_error, (0.0, 1 / 3, 2 / 3), 3),
        "",
    ),
    Task(
        "multirate-5-4",
        shape(5, "mri", "order: 4, fix: {c2: 1/5, c3: 2/5, c4: 3/5, c5: 4/5}"),
        "error",
        4,
        partial(plain.multirate_error, (0.0, 0.2, 0.4, 0.6, 0.8), 4),
        "",
    ),
    Task(
        "rosenbrock-4-4",
        shape(4, "rosenbrock", "order: 4, w-order: 2, l-stable: true"),
        "error",
        12,
        plain.rosenbrock_error,
        "",
    ),
    Task(
        "sdirk-2-3",
        shape(2, "sdirk", "order: 3, a-stable: true"),
        "error",
        20,
        plain.crouzeix_error,
        "0.0187, Nørsett and Crouzeix",
        is_search=False,
    ),
)


def by_gark(task: Task, jobs: int) -> tuple[str, str, float]:
    """The objective, the word for the proof, and processor seconds of a whole process."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"{task.name}.yaml")
        file.write_text(task.file, encoding="utf-8")
        command = [*GARK, "design", str(file), f"--minimise={task.minimise}", "--format", "json"]
        if task.is_search:
            command += ["--search", str(task.starts), "--jobs", str(jobs)]
            command += [] if task.start is None else ["--start", task.start]
        outputs: list[str] = []

        def run() -> None:
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            outputs.append(done.stdout or done.stderr)

        took = seconds(run, 1)
    try:
        document = json.loads(outputs[0])
    except ValueError:
        return outputs[0].splitlines()[0][:40], "–", took
    if not task.is_search:
        best = document["objective"]
        return best["value"], best["minimisers"][0]["proof"], took
    if not document["methods"]:
        return "–", "–", took
    best = document["methods"][0]
    return best["objective"], best["proof"], took


def by_scipy(task: Task) -> tuple[str, int, float]:
    """The objective, the starts that a minute is enough for, and processor seconds."""
    found: list[tuple[float | None, int]] = []
    took = seconds(lambda: found.append(least(task.problem(), task.starts)), 1)
    [(value, starts)] = found
    if value is None:
        return "–", starts, took
    return f"{-value if task.minimise.startswith('-') else value:.6g}", starts, took


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="tasks of designers, by gark and by SciPy alone")
    parser.add_argument("names", nargs="*", help="tasks; all without")
    parser.add_argument("--jobs", type=int, default=2, help="processes of gark")
    options = parser.parse_args(arguments)
    print(
        f"{'task':17} {'starts':>6} {'gark':>16} {'proof':16} {'s':>6} {'starts':>6} {'SciPy':>12}"
        f" {'s':>6}  known"
    )
    for task in TASKS:
        if options.names and task.name not in options.names:
            continue
        value, proof, ours = by_gark(task, options.jobs)
        plain_value, starts, theirs = by_scipy(task)
        print(
            f"{task.name:17} {task.starts:6} {value:>16.16} {proof:16} {ours:6.1f} {starts:6}"
            f" {plain_value:>12} {theirs:6.1f}  {task.known}",
            flush=True,
        )


if __name__ == "__main__":
    main()
