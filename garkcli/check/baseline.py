"""What got worse since an earlier JSON report: for projects that do not pass yet, but must not get
worse.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any

from garkcli.errors import UsageProblem

SCHEMA = "gark/check/1"
"""The name of the report that a baseline is."""
ORDERS = ("order", "conjugate_order", "pair_order")


@dataclass(frozen=True)
class Regression:
    """One thing that was better before: in which file, what, how it was, how it is."""

    file: str
    what: str
    before: str
    now: str


def read_baseline(path: str) -> Mapping[str, Mapping[str, Any]]:
    """The files of an earlier report by path.

    Raises:
        UsageProblem: it is not a report of ``gark check --format json``.
    """
    cure = "make one with gark check --format json -o FILE"
    try:
        report = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise UsageProblem(f"--baseline {path}: {error.strerror}", cure) from None
    except (ValueError, RecursionError):
        raise UsageProblem(f"--baseline {path}: not JSON", cure) from None
    if (
        not isinstance(report, dict)
        or report.get("schema") != SCHEMA
        or not isinstance(report.get("files"), list)
    ):
        raise UsageProblem(f"--baseline {path}: not a report of gark check", cure)
    files = [file for file in report["files"] if isinstance(file, dict)]
    return {PurePath(str(file.get("file"))).as_posix(): file for file in files}


def regressions(
    report: Mapping[str, Any], baseline: Mapping[str, Mapping[str, Any]]
) -> list[Regression]:
    """Everything in a JSON report that is worse than in ``baseline``; a file that is new must be
    right.
    """
    found: list[Regression] = []
    for now in report["files"]:
        before = baseline.get(PurePath(now["file"]).as_posix())
        found += _new_file(now) if before is None else _changed(now, before)
    return found


def _new_file(now: Mapping[str, Any]) -> list[Regression]:
    if "errors" in now:
        return [Regression(now["file"], "new file", "none", "unreadable")]
    failing = [claim for claim in now["claims"] if not claim["holds"]]
    return [
        Regression(now["file"], x["claim"], f"new, expected {x['expected']}", x["found"])
        for x in failing
    ]


def _changed(now: Mapping[str, Any], before: Mapping[str, Any]) -> list[Regression]:
    file = now["file"]
    if "errors" in now:
        return [] if "errors" in before else [Regression(file, "file", "a method", "unreadable")]
    if "errors" in before:
        return []  # it can be read now: better, whatever its claims say
    held = {x.get("claim"): x.get("holds") for x in before.get("claims", []) if isinstance(x, dict)}
    found = [
        Regression(
            file,
            x["claim"],
            "held" if held.get(x["claim"]) else "not claimed",
            f"found {x['found']}",
        )
        for x in now["claims"]
        if not x["holds"] and held.get(x["claim"], True)
    ]
    for order in ORDERS:
        old, new = before.get(order), now[order]
        if isinstance(old, int) and (new is None or new < old):
            found.append(Regression(file, order.replace("_", " "), str(old), str(new)))
    return found


def render(found: Sequence[Regression], files: int) -> str:
    """The regressions for people."""
    lines = [f"{x.file}: {x.what} got worse: {x.before} -> {x.now}" for x in found]
    lines.append(f"{files} file{'s' * (files != 1)}: {len(found) or 'nothing'} got worse")
    return "\n".join(lines) + "\n"
