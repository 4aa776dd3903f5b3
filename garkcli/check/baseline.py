"""The changes for the worse since an earlier JSON report."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import PurePath
from typing import Any, TypeAlias

from garkcli.errors import UsageProblem
from garkcli.files import read_bytes
from garkcli.frozen import Frozen

File: TypeAlias = Mapping[str, Any]
Earlier: TypeAlias = Mapping[str, File]
SCHEMA = "gark/check/1"
ORDERS = (
    "order",
    "conjugate_order",
    "pair_order",
    "nonautonomous_order",
    "embedded_order",
    "embedded_nonautonomous_order",
    "dense_order",
)


class Regression(Frozen):
    file: str
    what: str
    before: str
    now: str


MAX_BYTES = 256 * 2**20
"""Some hundred thousand files."""
_CURE = "make one with gark check --format json -o FILE"


def read_baseline(path: str) -> Earlier:
    """Reads the files of a complete JSON report by path; raises UsageProblem."""
    try:
        report = json.loads(_text(path))
    except (ValueError, RecursionError):
        raise _refused(path, "not JSON") from None
    if not isinstance(report, dict) or report.get("schema") != SCHEMA:
        raise _refused(path, "not a report of gark check")
    files = report.get("files")
    if not isinstance(files, list) or not all(map(_is_whole, files)):
        raise _refused(path, "a damaged report of gark check")
    return {_path_of(file): file for file in files}


def _path_of(file: File) -> str:
    return PurePath(file["file"]).as_posix()


def _text(path: str) -> str:
    """Returns the content of a file; devices, pipes and large files are refused unread."""
    try:
        is_large = os.path.exists(path) and os.path.getsize(path) > MAX_BYTES
        data = b"" if is_large else read_bytes(path, MAX_BYTES)
    except OSError as error:
        raise _refused(path, error.strerror or "cannot be read") from None
    if is_large or len(data) > MAX_BYTES:
        raise _refused(path, f"more than {MAX_BYTES} bytes")
    return data.decode("utf-8")


def _refused(path: str, why: str) -> UsageProblem:
    return UsageProblem(f"--baseline {path}: {why}", _CURE, code="option-value")


def _is_whole(file: object) -> bool:
    if not isinstance(file, dict) or not isinstance(file.get("file"), str):
        return False
    if "errors" in file:
        return True
    # True is no number here
    are_orders = all(type(file.get(order)) in (int, type(None)) for order in ORDERS)
    claims = file.get("claims")
    return are_orders and isinstance(claims, list) and all(map(_is_whole_claim, claims))


def _is_whole_claim(claim: object) -> bool:
    if not isinstance(claim, dict):
        return False
    return isinstance(claim.get("claim"), str) and type(claim.get("holds", 0)) in (bool, type(None))


def regressions(report: Mapping[str, Any], baseline: Earlier) -> list[Regression]:
    """Returns the changes for the worse; a new file has to pass."""
    changes: list[Regression] = []
    for now in report["files"]:
        before = baseline.get(_path_of(now))
        changes += _new_file(now) if before is None else _changed(now, before)
    return changes


def _new_file(now: File) -> list[Regression]:
    file = now["file"]
    if "errors" in now:
        return [Regression(file, "new file", "none", "unreadable")]
    return [
        Regression(file, x["claim"], f"new, expected {x['expected']}", x["found"])
        for x in now["claims"]
        if not x["holds"]
    ]


def _changed(now: File, before: File) -> list[Regression]:
    file = now["file"]
    if "errors" in before:
        return []  # no worse; where it can be read now better, whatever its claims say
    if "errors" in now:
        return [Regression(file, "file", "a method", "unreadable")]
    held = {claim["claim"]: claim["holds"] for claim in before["claims"]}
    words = {True: "held", None: "undecided"}
    changes = []
    for claim in now["claims"]:
        name, holds = claim["claim"], claim["holds"]
        was = held.get(name, True)
        if not holds and (was or (was is None and holds is False)):
            before_it = words[was] if name in held else "not claimed"
            changes.append(Regression(file, name, before_it, f"found {claim['found']}"))
    for order in ORDERS:
        old, new = before.get(order), now.get(order)
        if type(old) is int and (new is None or new < old):
            changes.append(Regression(file, order.replace("_", " "), str(old), str(new)))
    return changes
