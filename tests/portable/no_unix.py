"""Python without what Windows lacks, for the circumstance ``no-unix`` of ``make portable``: what is
written here is run at the start of each process of its virtual environment.
"""

import multiprocessing
import os
import signal
import sys
from pathlib import Path

MODULES = ("fcntl", "grp", "pwd", "pty", "resource", "syslog", "termios")
"""To import one of these is an error."""
OF_OS = ("fork", "forkpty", "geteuid", "mkfifo", "nice")
OF_SIGNAL = ("SIGALRM", "SIGHUP", "SIGPIPE", "SIGUSR1", "alarm", "pthread_sigmask", "setitimer")


def take_away() -> None:
    """From this process; those that it starts are started as on Windows."""
    for name in MODULES:
        sys.modules[name] = None  # type: ignore[assignment]
    for module, names in ((os, OF_OS), (signal, OF_SIGNAL)):
        for name in names:
            if hasattr(module, name):
                delattr(module, name)
    multiprocessing.get_all_start_methods = lambda: ["spawn"]
    multiprocessing.set_start_method("spawn")


def put_into(packages: Path) -> None:
    """Into a folder of packages, where Python looks for what it runs first.

    Args:
        packages: ``site-packages`` of an environment that nothing else uses.
    """
    source = Path(__file__).read_text(encoding="utf-8")
    customize = packages / "sitecustomize.py"
    customize.write_text(f"{source}\n\ntake_away()\n", encoding="utf-8")
