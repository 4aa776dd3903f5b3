"""How much of a long test is in a run: a sample, or with ``make whole`` everything."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

import pytest

T = TypeVar("T")

IS_WHOLE = os.environ.get("GARK_WHOLE") == "1"


def sample(items: Sequence[T], every: int) -> list[T]:
    """Every so many of some items, from the first on; all of them in ``make whole``."""
    return list(items[:: 1 if IS_WHOLE else every])


def at_most(few: int, all_: int) -> int:
    """A number of examples, or a limit, in the suite; and the larger one in ``make whole``."""
    return all_ if IS_WHOLE else few


in_whole = pytest.mark.skipif(not IS_WHOLE, reason="it takes long: make whole")
"""For a test, or a case of one, whose kind shorter ones stand for."""
