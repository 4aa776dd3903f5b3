"""How much of a long test is in a run: a sample, or with ``make whole`` everything."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TypeVar
from zlib import crc32

import pytest

T = TypeVar("T")

IS_WHOLE = os.environ.get("GARK_WHOLE") == "1"
IS_RENEWED = os.environ.get("GARK_UPDATE_SNAPSHOTS") == "1"
"""Whether recorded texts are written anew: ``make snapshots``."""


def sample(items: Sequence[T], every: int) -> list[T]:
    """Every so many of some items, from the first on; all of them in ``make whole``."""
    return list(items[:: 1 if IS_WHOLE else every])


def sample_of_files(files: Sequence[Path], every: int) -> list[Path]:
    """About one in so many files, by their names: a new file changes nothing for the others."""
    return [x for x in files if IS_WHOLE or crc32(x.name.encode()) % every == 0]


def at_most(few: int, all_: int) -> int:
    """A number of examples, or a limit, in the suite; and the larger one in ``make whole``."""
    return all_ if IS_WHOLE else few


FEW_CASES = 4
"""So many cases of one test run where the whole suite does; in ``make whole`` all of them."""


def few_cases(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Those that run: of a test with many cases the first, the last and some between them."""
    cases: dict[str, list[pytest.Item]] = {}
    for item in items:
        cases.setdefault(item.nodeid.split("[")[0], []).append(item)
    chosen: set[pytest.Item] = set()
    for those in cases.values():
        last = len(those) - 1
        is_short = last < FEW_CASES or those[0].get_closest_marker("every_case")
        steps = range(last + 1) if is_short else range(FEW_CASES)
        chosen.update(those[i if is_short else i * last // (FEW_CASES - 1)] for i in steps)
    return [item for item in items if item in chosen]


in_whole = pytest.mark.skipif(not IS_WHOLE, reason="it takes long: make whole")
"""For a test, or a case of one, whose kind shorter ones stand for."""
renewed_in_whole = pytest.mark.skipif(
    not (IS_WHOLE or IS_RENEWED), reason="it takes long: make whole"
)
"""The same for a test that writes what it compares."""
