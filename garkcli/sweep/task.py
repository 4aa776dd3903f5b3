"""A piece of a sweep, as it travels between processes: some methods, and the rows of them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from time import process_time
from typing import TypeAlias

from garkcli.sweep.plan import Criteria, Point
from garkcli.sweep.row import Row, row_of

Result: TypeAlias = tuple[str, float]
"""Rows as lines of JSON, and the processor time that they took."""


def rows_of(criteria: Criteria, points: Sequence[Point]) -> Result:
    """The rows of some methods."""
    begin = process_time()
    text = lines([row_of(criteria, point) for point in points])
    return text, process_time() - begin


def lines(rows: Sequence[Row]) -> str:
    """Rows as lines of JSON."""
    return "".join(f"{json.dumps(row)}\n" for row in rows)
