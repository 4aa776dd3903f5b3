"""Ends the command if it is interrupted before it starts or after it is done. The first module that
is imported, it imports none that takes time: ``signal`` makes enumerations for milliseconds.
"""

import _signal  # type: ignore[import-not-found]
import os


def leave(number: int, _frame: object) -> None:
    os._exit(128 + number)


def leave_at_once() -> None:
    """Lets an interrupt end the process silently until the command runs; an ignored one stays
    ignored. Windows has an exit code of its own for it.
    """
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
        _signal.signal(_signal.SIGINT, _signal.SIG_DFL if hasattr(_signal, "SIGHUP") else leave)
