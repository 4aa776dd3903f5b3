"""Times and memory of whole processes and of calls; benchmarks compare two of them measured in one
run.

Times are those of the processor, ours and that of the processes waited for: what else a machine
has to do is not in them.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GARK = [str(Path(sys.executable).with_name("gark"))]
PYTHON = [sys.executable]
UNIT = 2**20 if sys.platform == "darwin" else 1024
"""Units of ``ru_maxrss`` in a megabyte: bytes on macOS, kilobytes elsewhere."""


def seconds(run: Callable[[], object], repeat: int = 5) -> float:
    """The best of some runs: what the work costs when nothing disturbs it."""
    times = []
    for _ in range(repeat):
        start = _processor_time()
        run()
        times.append(_processor_time() - start)
    return min(times)


def _processor_time() -> float:
    """Of this process and of all children that have ended, to the microsecond."""
    used = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in used)


def process(command: Sequence[str]) -> Callable[[], object]:
    """A run of a whole process, from the root of the checkout; its exit code has to be 0.

    Byte code is kept, as it is where a package is installed, and made by a first run.
    """
    return side_by_side([command])


def side_by_side(commands: Sequence[Sequence[str]]) -> Callable[[], object]:
    """Processes that run at the same time; as :func:`process`."""
    kept = {k: x for k, x in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}

    def run() -> None:
        begun = [
            subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, env=kept)
            for command in commands
        ]
        assert [one.wait() for one in begun] == [0] * len(begun)

    run()
    return run


def interleaved(
    one: Callable[[], object], other: Callable[[], object], repeat: int = 15
) -> tuple[float, float]:
    """The best times of two runs that take turns, so that a busy machine disturbs both alike."""
    pairs = [(seconds(one, 1), seconds(other, 1)) for _ in range(repeat)]
    return min(a for a, _ in pairs), min(b for _, b in pairs)


def peak_megabytes(code: str) -> float:
    """The largest resident size of a Python process that runs ``code``."""
    usage = "resource.getrusage(resource.RUSAGE_SELF).ru_maxrss"
    script = f"{code}\nimport resource; print({usage} / {UNIT})"
    out = subprocess.run(
        [*PYTHON, "-c", script], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    return float(out.split()[-1])


def peak_of_children() -> float:
    """The largest resident size of any process that was waited for, in megabytes."""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / UNIT


def assert_ratio(what: str, ratio: float, target: float, detail: str) -> None:
    """Print one line; fail where the ratio is more than its target."""
    print(f"\n  {what}: {ratio:.3g} (target {target:g}); {detail}")
    assert ratio <= target, f"{what}: {ratio:.3g} is more than {target:g}"
