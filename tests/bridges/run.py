"""``make bridges``: methods in the codes that people run, against ``gark converge``.

    python -m tests.bridges.run [--only NAME[,NAME…]] [--list]

A name may be the beginning of several.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from garkcli import catalogue
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.bridges.trials import STEPS
from tests.bridges.comparing import allowed, own_errors
from tests.bridges.machine import CACHE, CC, FORTRAN, ROOT, NotHad, need
from tests.bridges.methods import METHODS, READ_BACK
from tests.bridges.read_back import (
    DOUBLE,
    EXTENDED,
    QUAD,
    Precision,
    read_back_c,
    read_back_fortran,
)
from tests.bridges.runners import RUNNERS, Failed, Program, Ready, Runner

LEAST = 1000
"""So much larger than what rounding leaves is the largest error, or nothing is compared."""


@dataclass(frozen=True)
class Outcome:
    """What came of one method in one code.

    Attributes:
        code: with its version.
        kind: of the method.
        method: its name.
        error: of the smallest steps, in that code.
        away: the largest difference between an error there and ours.
        share: of the differences that rounding may leave, the largest.
        note: what went wrong; empty where all is well.
    """

    code: str
    kind: str
    method: str
    error: float = 0.0
    away: float = 0.0
    share: float = 0.0
    note: str = ""

    @property
    def is_good(self) -> bool:
        """Whether it ran, and rounding explains the differences."""
        return not self.note


@cache
def of_name(name: str) -> tuple[Payload, tuple[float, ...]]:
    """What writers get of a method, and its errors in gark."""
    method = catalogue[name]
    payload = prepared(method)
    return payload, tuple(own_errors(method, payload))


def tried(runner: Runner, ready: Ready, kind: str, name: str) -> Outcome:
    """One method in one code."""
    code = f"{runner.name} {ready.version}"
    payload, ours = of_name(name)
    folder = CACHE / "runs" / f"{runner.name} {name}".replace(" ", "-").lower()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    try:
        stem = _written(runner, payload, folder)
    except CannotExport as refusal:
        return Outcome(code, kind, name, note=f"refused: {refusal.message}")
    program = Program(folder, stem)
    try:
        found = program.errors(ready.commands(stem))
    except (Failed, OSError, subprocess.TimeoutExpired) as error:
        return Outcome(code, kind, name, note=f"{error} ({_place(folder)})")
    finally:
        text = "\n".join(program.record)
        (folder / "record.txt").write_text(text, encoding="utf-8")
    if [n for n, _ in found] != list(STEPS):
        note = f"rows are missing ({_place(folder)})"
        return Outcome(code, kind, name, note=note)
    return compared(runner, payload, Outcome(code, kind, name), ours, found)


def _place(folder: Path) -> Path:
    return folder.relative_to(ROOT) / "record.txt"


def _written(runner: Runner, payload: Payload, folder: Path) -> str:
    """The table, the program and the problem file; the name without its ending."""
    bridge = bridges()[runner.target]
    stem = payload.stem
    file = stem + bridge.suffix
    (folder / file).write_text(bridge.written(payload), encoding="utf-8")
    for ending, program in bridge.tested(payload, file).items():
        path = folder / f"{stem}{ending}"
        # people are shown four digits of an error, we compare them all
        text = program.replace(".3e", ".16e")
        path.write_text(text, encoding="utf-8")
    return stem


def compared(
    runner: Runner,
    payload: Payload,
    outcome: Outcome,
    ours: Sequence[float],
    found: Sequence[tuple[int, float]],
) -> Outcome:
    """The errors of a code against ours."""
    away = 0.0
    share = 0.0
    is_solved = outcome.kind in ("DIRK", "IMEX")
    solver = runner.solver if is_solved else 0.0
    for own, (steps, error) in zip(ours, found, strict=True):
        limit = allowed(payload, steps, solver, runner.reading)
        away = max(away, abs(error - own))
        share = max(share, abs(error - own) / limit)
    last = found[-1][1]
    steps, largest = found[0]
    told = largest / allowed(payload, steps, solver, runner.reading)
    note = "" if told >= LEAST else "the errors are within what rounding leaves"
    if share > 1:
        note = "the errors are others"
    return Outcome(outcome.code, outcome.kind, outcome.method, last, away, share, note)


def outcomes(runners: Sequence[Runner]) -> Iterator[Outcome | str]:
    """All of them, as they come; texts for codes that could not be had."""
    tasks: list[Callable[[], Outcome]] = []
    for runner in runners:
        print(f"{runner.name}: is it there?", flush=True)
        try:
            ready = runner.ready()
        except NotHad as reason:
            yield f"{runner.name}: not to be had: {reason}"
            continue
        tasks += [
            lambda runner=runner, ready=ready, kind=kind, name=name: tried(
                runner, ready, kind, name
            )
            for kind in runner.kinds
            for name in METHODS[kind]
        ]
    for name in {name for names in METHODS.values() for name in names}:
        of_name(name)  # once, before several threads ask for it
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for outcome in pool.map(lambda task: task(), tasks):
            word = outcome.note or "the same errors"
            print(f"{outcome.code}, {outcome.method}: {word}", flush=True)
            yield outcome


def read_back() -> Iterator[Outcome | str]:
    """The tables of C and Fortran, bit by bit."""
    names = [name for found in METHODS.values() for name in found]
    ways = (
        ("c", CC, read_back_c, (DOUBLE, EXTENDED, QUAD)),
        ("fortran", FORTRAN, read_back_fortran, (DOUBLE, QUAD)),
    )
    for target, tool, way, precisions in ways:
        try:
            need(tool)
        except NotHad as reason:
            yield f"{target}: not to be had: {reason}"
            continue
        for precision in precisions:
            for name in (*names, *READ_BACK):
                yield _bits(target, way, precision, name)


def _bits(
    target: str,
    way: Callable[[Payload, str, Path, Precision], list[str]],
    precision: Precision,
    name: str,
) -> Outcome:
    code = f"{target} {precision.name}"
    folder = CACHE / "read-back" / f"{target}-{name}"
    folder.mkdir(parents=True, exist_ok=True)
    payload = prepared(catalogue[name])
    text = bridges()[target].written(payload)
    try:
        wrong = way(payload, text, folder, precision)
    except subprocess.CalledProcessError as error:
        wrong = [error.stderr.strip().splitlines()[-1]]
    note = f"not the nearest: {', '.join(wrong[:3])}" if wrong else ""
    return Outcome(code, "bits", name, note=note)


def table(found: Sequence[Outcome]) -> str:
    """One line each.

    >>> print(table([Outcome("x 1.2", "SPRK", "y", 1.5e-3, 2e-16, 0.004)]))
    code   kind  method      error  difference  of rounding
    x 1.2  SPRK  y       1.500e-03       2e-16        0.004
    """
    headings = ("code", "kind", "method")
    names = [(x.code, x.kind, x.method) for x in found]
    columns = zip(headings, *names, strict=True)
    widths = [max(map(len, column)) for column in columns]
    lines = [f"{_padded(headings, widths)}      error  difference  of rounding"]
    for outcome, words in zip(found, names, strict=True):
        numbers = f"  {outcome.error:9.3e}  {outcome.away:10.0e}  {outcome.share:11.3f}"
        tail = f"  {outcome.note}" if outcome.note else numbers
        lines.append(_padded(words, widths) + tail)
    return "\n".join(lines)


def _padded(words: Sequence[str], widths: Sequence[int]) -> str:
    pairs = zip(words, widths, strict=True)
    return "  ".join(word.ljust(width) for word, width in pairs)


def chosen(only: str) -> list[Runner]:
    """Those whose names begin with one of the words, in any capitals; all without a word.

    Raises:
        SystemExit: a word that no name begins with.
    """
    words = [word.lower() for word in only.split(",") if word]
    for word in words:
        if not any(x.name.lower().startswith(word) for x in RUNNERS):
            names = ", ".join(x.name for x in RUNNERS)
            raise SystemExit(f"no code begins with {word!r}; there are {names}")
    starts = tuple(words)
    return [x for x in RUNNERS if not words or x.name.lower().startswith(starts)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what was asked for; 1 where something failed, else 0."""
    parser = argparse.ArgumentParser(description="methods in the codes that people run")
    parser.add_argument("--only", default="", help="names, or their beginnings, with commas")
    parser.add_argument("--list", action="store_true", help="the codes")
    options = parser.parse_args(arguments)
    runners = chosen(options.only)
    if options.list:
        for runner in runners:
            kinds = ", ".join(runner.kinds)
            print(f"{runner.name:14} {runner.target:12} {kinds}")
        return 0
    CACHE.mkdir(exist_ok=True)
    missing: list[str] = []
    ran: list[Outcome] = []
    bits: list[Outcome] = []
    for found in outcomes(runners):
        ran.append(found) if isinstance(found, Outcome) else missing.append(found)
    if not options.only:
        for found in read_back():
            bits.append(found) if isinstance(found, Outcome) else missing.append(found)
    bad = [x for x in (*ran, *bits) if not x.is_good]
    if ran:
        print()
        print(table(ran))
    if bits:
        print()
        print(summary(bits))
    print()
    for line in missing:
        print(line)
    print(f"{len(ran) + len(bits) - len(bad)} passed, {len(bad)} failed")
    return int(bool(bad) or not ran)


def summary(bits: Sequence[Outcome]) -> str:
    """How many tables were read back, code by code, and what was wrong."""
    lines = []
    for code in dict.fromkeys(x.code for x in bits):
        of_code = [x for x in bits if x.code == code]
        good = sum(x.is_good for x in of_code)
        lines.append(f"{code}: {good} of {len(of_code)} tables bit by bit")
        lines += [f"  {x.method}: {x.note}" for x in of_code if not x.is_good]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
