"""numpy, imported when one of its names is first used."""

from __future__ import annotations

from typing import Any


def __getattr__(name: str) -> Any:
    """Raises UsageProblem if numpy is not installed."""
    if name.startswith("__"):
        raise AttributeError(name)
    try:
        import numpy as np
    except ImportError:
        from garkcli.errors import UsageProblem

        message = "this needs numpy, which is not installed here"
        cure = "exact coefficients do without it"
        raise UsageProblem(message, cure, code="missing-package") from None
    value = getattr(np, name)
    globals()[name] = value  # the next use finds it at once
    return value
