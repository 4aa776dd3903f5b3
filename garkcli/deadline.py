"""Time limits: ``with within(seconds):`` holds for all work inside, in which loops call
``check_time``. A call in C cannot be interrupted; ``garkcli.exact.apart`` does large ones in
another process. Limits that users set are by the clock; default ones are of processor time, so a
busy machine decides no less.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic
from typing import TypeVar

from garkcli.ending import raise_if_ended
from garkcli.errors import NotDecided

T = TypeVar("T")
SECONDS = 10.0
"""Default limit for stability, in processor seconds."""
FOR_EVER = 1e9
"""Seconds after which no system waits any longer, about thirty years."""
_moment: ContextVar[float | None] = ContextVar("moment", default=None)
"""The reading of ``time.monotonic`` at which the work is given up; None for never."""
_spent: ContextVar[float | None] = ContextVar("spent", default=None)
"""The reading of ``processor_time`` at which the work is given up; None for never."""
_is_small: ContextVar[bool] = ContextVar("is_small", default=False)


@contextmanager
def within(seconds: float | None) -> Iterator[None]:
    """Limits the work inside; an earlier deadline around it stays. None sets no limit.

    >>> with within(0):
    ...     check_time()
    Traceback (most recent call last):
    ...
    garkcli.errors.NotDecided: not decided in the time there is; give it more seconds, or give \
parameters values
    """
    with until(None if seconds is None else monotonic() + seconds):
        yield


@contextmanager
def until(moment: float | None) -> Iterator[None]:
    """Limits the time like ``within``, to a reading of ``time.monotonic``."""
    with _earliest(_moment, moment):
        yield


@contextmanager
def spending(seconds: float | None) -> Iterator[None]:
    """Limits the processor time of the work inside; None sets no new limit, outer ones stay."""
    with _earliest(_spent, None if seconds is None else processor_time() + seconds):
        yield


@contextmanager
def _earliest(limit: ContextVar[float | None], reading: float | None) -> Iterator[None]:
    readings = [x for x in (reading, limit.get()) if x is not None and x < FOR_EVER]
    token = limit.set(min(readings, default=None))
    try:
        yield
    finally:
        limit.reset(token)


def processor_time() -> float:
    """Seconds that this process and its finished children have worked."""
    return sum(os.times()[:4])


@contextmanager
def only_small() -> Iterator[None]:
    """Does only small work inside: work for another process raises ``NotDecided``."""
    token = _is_small.set(True)
    try:
        yield
    finally:
        _is_small.reset(token)


def forget() -> None:
    _moment.set(None)
    _spent.set(None)


def is_only_small() -> bool:
    return _is_small.get()


def clock_left() -> float | None:
    moment = _moment.get()
    return None if moment is None else max(0.0, moment - monotonic())


def work_left() -> float | None:
    spent = _spent.get()
    return None if spent is None else max(0.0, spent - processor_time())


def seconds_left() -> float | None:
    """Seconds until the first limit, of the clock or of processor time; None without limits."""
    return min((x for x in (clock_left(), work_left()) if x is not None), default=None)


def check_time() -> None:
    """Raises ``NotDecided`` if the time is over, and ``Ended`` if a signal asked for the end."""
    raise_if_ended()
    if seconds_left() == 0:
        raise NotDecided(is_late=True)


def checked(items: Iterable[T]) -> Iterator[T]:
    """Yields items until the time is over, then raises NotDecided."""
    for item in items:
        check_time()
        yield item
