"""JSON as in its standard, without Infinity and NaN."""

from __future__ import annotations

import json
from math import isfinite
from typing import Any


def to_json(data: Any, indent: int | None = 2, ascii_only: bool = False) -> str:
    """Returns JSON without a final newline; infinite floats become null.

    >>> to_json({"float": float("inf"), "exact": "10**400"}, indent=None)
    '{"float": null, "exact": "10**400"}'
    """
    return json.dumps(_finite(data), indent=indent, ensure_ascii=ascii_only, allow_nan=False)


def _finite(data: Any) -> Any:
    if isinstance(data, float):
        return data if isfinite(data) else None
    if isinstance(data, dict):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return data
