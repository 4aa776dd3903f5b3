"""``make portable``: the suite under other circumstances, and a table of what came of it.

    python -m tests.portable.run [--list] [--only NAME[,NAME…]]

A name may be the beginning of several: ``--only kernel,floors``.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

from tests.portable.circumstances import Circumstance, circumstances
from tests.portable.venvs import CACHE, ROOT, NotHad, python_of


@dataclass(frozen=True)
class Outcome:
    """What came of one run; ``passed`` is ``None`` where there was none."""

    name: str
    passed: int | None = None
    failed: int = 0
    skipped: int = 0
    seconds: float = 0.0
    note: str = ""

    @property
    def is_good(self) -> bool:
        """Nothing failed: what could not be had has not failed."""
        return not self.failed and (self.passed is None or self.passed > 0)


def run(circumstance: Circumstance) -> Outcome:
    """The tests of one circumstance; what they print is kept in a file."""
    name = circumstance.name
    try:
        variables = circumstance.variables()
        python = python_of(circumstance.venv)
        tree = circumstance.tree(python)
    except NotHad as reason:
        return Outcome(name, note=f"not to be had: {reason}")
    record, report = CACHE / f"{name}.txt", CACHE / f"{name}.xml"
    report.unlink(missing_ok=True)
    pytest = [str(python), "-m", "pytest", f"--junitxml={report}", *circumstance.tests]
    start = time.monotonic()
    with record.open("wb") as out:
        subprocess.run(
            [*circumstance.wrapper, *pytest],
            cwd=tree,
            env=variables,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            check=False,
        )
    seconds = time.monotonic() - start
    where = record.relative_to(ROOT)
    if not report.exists():
        return Outcome(name, failed=1, seconds=seconds, note=f"did not run: {where}")
    passed, failed, skipped = counted(report.read_text(encoding="utf-8"))
    bad = failed or not passed
    return Outcome(name, passed, failed, skipped, seconds, f"see {where}" if bad else "")


def counted(report: str) -> tuple[int, int, int]:
    """Passed, failed and skipped tests of a report in JUnit's format.

    >>> counted('<testsuites><testsuite tests="9" failures="1" errors="2" skipped="3"/>'
    ...         '</testsuites>')
    (3, 3, 3)
    """
    (suite,) = ET.fromstring(report).iter("testsuite")
    tests, failures, errors, skipped = (
        int(suite.attrib[key]) for key in ("tests", "failures", "errors", "skipped")
    )
    failed = failures + errors
    return tests - failed - skipped, failed, skipped


def table(outcomes: Sequence[Outcome]) -> str:
    """One line each.

    >>> print(table([Outcome("floors", 9, 0, 1, 7.2), Outcome("locale", note="not to be had: x")]))
    circumstance  passed  failed  skipped  seconds
    floors             9       0        1        7
    locale             –       –        –        –  not to be had: x
    """
    width = max(len("circumstance"), *(len(outcome.name) for outcome in outcomes))
    lines = [f"{'circumstance':{width}}  passed  failed  skipped  seconds"]
    for outcome in outcomes:
        ran = outcome.passed is not None or outcome.failed
        numbers = (outcome.passed or 0, outcome.failed, outcome.skipped, round(outcome.seconds))
        cells = [str(number) if ran else "–" for number in numbers]
        passed, failed, skipped, seconds = cells
        line = f"{outcome.name:{width}}  {passed:>6}  {failed:>6}  {skipped:>7}  {seconds:>7}"
        lines.append(f"{line}  {outcome.note}".rstrip())
    return "\n".join(lines)


def chosen(only: str) -> list[Circumstance]:
    """Those whose names begin with one of the words; all without a word.

    Raises:
        SystemExit: a word that no name begins with.
    """
    found = list(circumstances())
    words = [word for word in only.split(",") if word]
    for word in words:
        if not any(circumstance.name.startswith(word) for circumstance in found):
            names = ", ".join(circumstance.name for circumstance in found)
            raise SystemExit(f"no circumstance begins with {word!r}; there are {names}")
    return [x for x in found if not words or x.name.startswith(tuple(words))]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what was asked for; the number of circumstances under which something failed, 0 or 1."""
    parser = argparse.ArgumentParser(description="the suite under other circumstances")
    parser.add_argument("--only", default="", help="names, or their beginnings, with commas")
    parser.add_argument("--list", action="store_true", help="what there is on this machine")
    options = parser.parse_args(arguments)
    wanted = chosen(options.only)
    if options.list:
        for circumstance in wanted:
            print(f"{circumstance.name:20} {circumstance.what}")
        return 0
    CACHE.mkdir(exist_ok=True)
    outcomes = []
    for circumstance in wanted:
        print(f"{circumstance.name}: {circumstance.what} …", flush=True)
        outcomes.append(run(circumstance))
    print()
    print(table(outcomes))
    return int(not all(outcome.is_good for outcome in outcomes))


if __name__ == "__main__":
    sys.exit(main())
