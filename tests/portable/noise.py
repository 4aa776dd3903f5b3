"""A plugin of pytest: functions of libm and of LAPACK are off by some units of the last place, as
they are on another processor or with another library.
"""

from __future__ import annotations

import math
import os
import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

SEED = "GARK_NOISE"
"""The variable of the environment that chooses the noise."""
EXACT = ("inf", "isfinite", "sqrt")
"""Of what programs for floats call: numbers, and what IEEE 754 rounds correctly."""
LAPACK = ("eig", "eigh", "eigvals", "inv", "lstsq", "pinv", "qr", "solve", "svd")
UNITS = 2
"""As far as results are off, in units of the last place; for LAPACK twice that."""


def off(choose: random.Random, x: Any) -> Any:
    """A float near to ``x``; anything else as it is.

    >>> abs(off(random.Random(1), 1.0) - 1) <= UNITS * math.ulp(1.0)
    True
    >>> off(random.Random(1), 0.0)
    0.0
    """
    if not isinstance(x, float) or not math.isfinite(x) or not x:
        return x
    return x + choose.randint(-UNITS, UNITS) * math.ulp(x)


def arrays_off(choose: random.Random, x: Any) -> Any:
    """Arrays of floats near to those of a result of ``numpy.linalg``."""
    if isinstance(x, np.ndarray) and x.dtype.kind in "fc":
        noise = [choose.randint(-2 * UNITS, 2 * UNITS) for _ in range(x.size)]
        return x * (1 + np.reshape(noise, x.shape) * 2.0**-52)
    if isinstance(x, tuple):
        parts = [arrays_off(choose, part) for part in x]
        return type(x)(*parts) if hasattr(x, "_fields") else tuple(parts)
    return x


def pytest_configure(config: pytest.Config) -> None:  # noqa: ARG001 -- the name pytest knows
    """Put the noise in."""
    from garkcli.problems.straightline import FLOATS

    choose = random.Random(os.environ.get(SEED, "1"))
    assert isinstance(FLOATS, dict)
    for name in FLOATS.keys() - {*EXACT}:
        FLOATS[name] = _with_noise(FLOATS[name], choose, off)
    for name in LAPACK:
        noisy = _with_noise(getattr(np.linalg, name), choose, arrays_off)
        setattr(np.linalg, name, noisy)


def _with_noise(
    function: Callable[..., Any],
    choose: random.Random,
    disturb: Callable[[random.Random, Any], Any],
) -> Callable[..., Any]:
    def noisy(*arguments: Any, **options: Any) -> Any:
        return disturb(choose, function(*arguments, **options))

    return noisy
