"""What some tests need of the system; it is asked for, not concluded from the system's name."""

from __future__ import annotations

import os
import signal

import pytest

from garkcli.exact.apart import start_method

try:
    import fcntl
except ImportError:
    _HAS_LOCKS = False
else:
    _HAS_LOCKS = hasattr(fcntl, "lockf")

needs_fork = pytest.mark.skipif(
    start_method() != "fork", reason="workers see no change to this process"
)
needs_fifos = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no FIFOs")
needs_locks = pytest.mark.skipif(not _HAS_LOCKS, reason="there are no locks")
needs_signals = pytest.mark.skipif(
    not hasattr(signal, "SIGHUP"), reason="signals between processes"
)
