"""Ends the command if it is interrupted before it starts or after it is done.

The first module that the command imports: it imports only what is part of the interpreter, because
``signal`` takes milliseconds to make enumerations.
"""

import _signal  # type: ignore[import-not-found]
import os


def leave(number: int, _frame: object) -> None:
    """Ends the process at once, silently: nothing has to be cleaned up."""
    os._exit(128 + number)


def leave_at_once() -> None:
    """Lets an interrupt end the process silently, without a traceback of imports, until the command
    runs; an ignored one stays ignored.

    Windows has an exit code of its own for a process that an interrupt ends.
    """
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
        _signal.signal(_signal.SIGINT, _signal.SIG_DFL if hasattr(_signal, "SIGHUP") else leave)
