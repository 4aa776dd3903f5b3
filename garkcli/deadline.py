"""How long work may take: a deadline holds for everything that is done inside it.

Whoever limits work writes ``with within(seconds):`` around it. Loops that may take long call
``check_time``, which raises ``NotDecided`` once the time is over. A call of a library in C cannot
be interrupted; ``garkcli.exact.apart`` does large ones in a process of their own.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic

from garkcli.errors import NotDecided

FOR_EVER = 1e9
"""Seconds after which no system waits any longer, about thirty years."""
_moment: ContextVar[float | None] = ContextVar("moment", default=None)
"""The reading of ``time.monotonic`` at which the work is given up; None for never."""
_is_small: ContextVar[bool] = ContextVar("is_small", default=False)
"""Whether only work that is small is done."""


@contextmanager
def within(seconds: float | None) -> Iterator[None]:
    """Limit what is done inside; an earlier deadline around it stays. None sets no limit.

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
    """The same by the reading of ``time.monotonic`` at which it ends."""
    moments = [x for x in (moment, _moment.get()) if x is not None and x < FOR_EVER]
    token = _moment.set(min(moments, default=None))
    try:
        yield
    finally:
        _moment.reset(token)


@contextmanager
def only_small() -> Iterator[None]:
    """Do only what is small inside: what would need a process of its own raises ``NotDecided``."""
    token = _is_small.set(True)
    try:
        yield
    finally:
        _is_small.reset(token)


def forget() -> None:
    """Set no limit from now on: in a process that another one ends."""
    _moment.set(None)


def is_only_small() -> bool:
    """Whether only work that is small is done."""
    return _is_small.get()


def seconds_left() -> float | None:
    """How much of the time is left, 0 where it is over; None where there is no limit."""
    moment = _moment.get()
    return None if moment is None else max(0.0, moment - monotonic())


def check_time() -> None:
    """Give up where the time is over.

    Raises:
        NotDecided: it is.
    """
    moment = _moment.get()
    if moment is not None and monotonic() >= moment:
        raise NotDecided(is_late=True)
