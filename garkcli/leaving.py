"""Silent interrupts before the command runs; imports no ``signal``, which takes milliseconds."""

import _signal  # type: ignore[import-not-found]
import os


def leave(number: int, _frame: object) -> None:
    os._exit(128 + number)


def leave_at_once() -> None:
    """Silences interrupts until the command runs; Windows has an exit code of its own for it."""
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
        _signal.signal(_signal.SIGINT, _signal.SIG_DFL if hasattr(_signal, "SIGHUP") else leave)
